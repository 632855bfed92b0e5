//! Fixed-width blocks of wavelengths: the innermost dimension of every hot loop, so that the compiler turns it into vector instructions.

use std::ops::{Deref, DerefMut};

/// Width of the blocks of wavelengths.
pub const LANES: usize = 32;

/// One number for each wavelength of a block. It begins where a line of the cache does: a vector that lies across two of them is loaded at half the speed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Lanes<const N: usize>([f32; N]);

impl<const N: usize> Lanes<N> {
    /// The number that `of` gives for the index of each lane.
    #[inline(always)]
    pub fn from_fn(of: impl FnMut(usize) -> f32) -> Self {
        Self(std::array::from_fn(of))
    }

    /// `of` each lane.
    #[inline(always)]
    pub fn map(mut self, mut of: impl FnMut(f32) -> f32) -> Self {
        // A loop, as the array's own `map` is not always inlined, and outside the vector code of its caller it is slow.
        for value in &mut self.0 {
            *value = of(*value);
        }
        self
    }

    /// All numbers of `many`, one after the other.
    pub fn concat(many: &[Self]) -> Vec<f32> {
        many.iter().flat_map(|lanes| lanes.0).collect()
    }

    /// The inverse of [`Self::concat`]; what is left of a last one is dropped.
    pub fn split(numbers: &[f32]) -> Vec<Self> {
        numbers.as_chunks::<N>().0.iter().copied().map(Self).collect()
    }
}

impl<const N: usize> Deref for Lanes<N> {
    type Target = [f32; N];

    #[inline(always)]
    fn deref(&self) -> &[f32; N] {
        &self.0
    }
}

impl<const N: usize> DerefMut for Lanes<N> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f32; N] {
        &mut self.0
    }
}

impl<'a, const N: usize> IntoIterator for &'a Lanes<N> {
    type Item = &'a f32;
    type IntoIter = std::slice::Iter<'a, f32>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<const N: usize> IntoIterator for Lanes<N> {
    type Item = f32;
    type IntoIter = std::array::IntoIter<f32, N>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

/// `value` in every lane.
#[inline(always)]
pub fn splat<const N: usize>(value: f32) -> Lanes<N> {
    Lanes([value; N])
}

/// `accumulator += a * b`, lane by lane; in a copy, as a compiler that cannot tell whether `a` or `b` changes with the accumulator adds one lane after the other.
#[inline(always)]
pub fn add_product<const N: usize>(accumulator: &mut Lanes<N>, a: &Lanes<N>, b: &Lanes<N>) {
    let mut sum = *accumulator;
    for n in 0..N {
        sum[n] += a[n] * b[n];
    }
    *accumulator = sum;
}

/// `accumulator += factor * a`, lane by lane, in a copy as [`add_product`].
#[inline(always)]
pub fn add_scaled<const N: usize>(accumulator: &mut Lanes<N>, factor: f32, a: &Lanes<N>) {
    let mut sum = *accumulator;
    for n in 0..N {
        sum[n] += factor * a[n];
    }
    *accumulator = sum;
}

/// The lanes of `a + fraction * (b - a)`.
#[inline(always)]
pub fn lerp<const N: usize>(a: &Lanes<N>, b: &Lanes<N>, fraction: f32) -> Lanes<N> {
    let mut out = splat(0.0);
    for n in 0..N {
        out[n] = a[n] + fraction * (b[n] - a[n]);
    }
    out
}

/// exp(-x) of each lane; see [`exp_one`].
#[inline(always)]
pub fn exp_minus<const N: usize>(x: &Lanes<N>) -> Lanes<N> {
    let mut out = splat(0.0);
    for n in 0..N {
        out[n] = exp_one(-x[n]);
    }
    out
}

/// `a * b + c`: rounded once, in one instruction, if `FUSED`. That is for processors that have it ([`processor_fuses`]); on others it would be a slow function.
#[inline(always)]
pub fn multiply_add<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Whether the version of a `#[multiversion]` function in which this stands is for a processor that multiplies and adds in one instruction.
macro_rules! processor_fuses {
    () => {
        multiversion::target::match_target! { "x86_64+fma" => true, "aarch64" => true, _ => false }
    };
}
pub(crate) use processor_fuses;

/// Exponential function for arguments up to 80; relative error below 3e-7, zero below -60
/// (what is darker than e^-60 is dark, and numbers too small for normal arithmetic would slow every loop behind).
#[inline(always)]
pub fn exp_one(x: f32) -> f32 {
    // Adding 1.5 * 2^23 rounds to the nearest integer and leaves it in the lowest bits, without a conversion that would not vectorise.
    const ROUND: f32 = 12_582_912.0;
    const LN2_HIGH: f32 = 0.693_359_4;
    const LN2_LOW: f32 = -2.121_944_4e-4;
    let clamped = x.clamp(-60.0, 80.0);
    let rounded = clamped * std::f32::consts::LOG2_E + ROUND;
    let whole = rounded - ROUND;
    let rest = clamped - whole * LN2_HIGH - whole * LN2_LOW;
    let series = 1.0
        + rest
            * (1.0 + rest * (0.5 + rest * (0.166_666_67 + rest * (0.041_666_67 + rest * (8.333_333e-3 + rest * 1.388_889e-3)))));
    let power = f32::from_bits(rounded.to_bits().wrapping_add(127) << 23);
    if x < -60.0 { 0.0 } else { series * power }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_are_numbers_in_a_row() {
        let numbers: Vec<f32> = (0..35).map(|i| i as f32).collect();
        let lanes = Lanes::<16>::split(&numbers);
        assert_eq!(lanes.len(), 2);
        assert_eq!(Lanes::concat(&lanes), numbers[..32]);
        assert_eq!(lanes[1].map(|x| -x)[3], -19.0);
        assert_eq!(lanes.as_ptr() as usize % 64, 0);
    }

    #[test]
    fn exp_follows_the_library_function() {
        for i in -5900..7900 {
            let x = i as f32 * 0.01;
            let exact = f64::from(x).exp();
            assert!((f64::from(exp_one(x)) / exact - 1.0).abs() < 3e-7, "exp({x})");
        }
        assert_eq!(exp_one(-61.0), 0.0);
    }
}
