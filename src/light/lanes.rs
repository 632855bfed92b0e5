//! Fixed-width blocks of wavelengths: the innermost dimension of every hot loop, so that the compiler turns it into vector instructions.

/// One number for each wavelength of a block.
pub type Lanes<const N: usize> = [f32; N];

/// `value` in every lane.
#[inline(always)]
pub fn splat<const N: usize>(value: f32) -> Lanes<N> {
    [value; N]
}

/// `accumulator += a * b`, lane by lane.
#[inline(always)]
pub fn add_product<const N: usize>(accumulator: &mut Lanes<N>, a: &Lanes<N>, b: &Lanes<N>) {
    for n in 0..N {
        accumulator[n] += a[n] * b[n];
    }
}

/// `accumulator += factor * a`, lane by lane.
#[inline(always)]
pub fn add_scaled<const N: usize>(accumulator: &mut Lanes<N>, factor: f32, a: &Lanes<N>) {
    for n in 0..N {
        accumulator[n] += factor * a[n];
    }
}

/// The lanes of `a + fraction * (b - a)`.
#[inline(always)]
pub fn lerp<const N: usize>(a: &Lanes<N>, b: &Lanes<N>, fraction: f32) -> Lanes<N> {
    let mut out = [0.0; N];
    for n in 0..N {
        out[n] = a[n] + fraction * (b[n] - a[n]);
    }
    out
}

/// exp(-x) of each lane; see [`exp`].
#[inline(always)]
pub fn exp_minus<const N: usize>(x: &Lanes<N>) -> Lanes<N> {
    let mut out = [0.0; N];
    for n in 0..N {
        out[n] = exp_one(-x[n]);
    }
    out
}

/// Exponential function of each lane, for arguments up to 80; relative error below 3e-7, zero below -60
/// (what is darker than e^-60 is dark, and numbers too small for normal arithmetic would slow every loop behind).
#[inline(always)]
pub fn exp<const N: usize>(x: &Lanes<N>) -> Lanes<N> {
    let mut out = [0.0; N];
    for n in 0..N {
        out[n] = exp_one(x[n]);
    }
    out
}

/// [`exp`] of one number.
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
    fn exp_follows_the_library_function() {
        for i in -5900..7900 {
            let x = i as f32 * 0.01;
            let exact = f64::from(x).exp();
            assert!((f64::from(exp_one(x)) / exact - 1.0).abs() < 3e-7, "exp({x})");
        }
        assert_eq!(exp_one(-61.0), 0.0);
    }
}
