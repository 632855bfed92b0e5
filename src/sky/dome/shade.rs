//! Radiance in many directions of one circle: the hot loop of every probe.
//!
//! The fields are the innermost dimension: a direction reads its functions of the scattering angle as vectors, interpolates the fields in azimuth as vectors, and sums the products.

use super::half::Circle;
use super::lanes::Lanes;
use crate::light::{BLOCK, FunctionRows, Located};
use crate::sky::PolarisingFilter;
use pulp::{Arch, Simd, WithSimd};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Directions that are treated together.
pub(super) const CHUNK: usize = 64;

/// Directions of one circle, and the Sun: angles in radians, azimuths from north through east.
pub(super) struct Places<'a> {
    pub altitude: f64,
    pub sun_altitude: f64,
    pub sun_azimuth: f64,
    /// At most [`CHUNK`].
    pub azimuths: &'a [f64],
}

/// Where directions are relative to the Sun, and what a filter makes of them.
pub(super) struct Looks {
    /// Azimuths from the Sun [turns, 0 to 1/2, either way].
    from_sun: [f32; CHUNK],
    located: [Located; CHUNK],
    /// Through a filter, what the dipoles' field, Q and U count.
    filtered: Option<[[f32; 3]; CHUNK]>,
}

impl Looks {
    #[inline(always)]
    pub fn new(lanes: &Lanes, places: &Places) -> Self {
        // Haversine of the angle to the Sun: exact for small angles in single precision.
        let height = (0.5 * (places.altitude - places.sun_altitude)).sin().powi(2) as f32;
        let cosines = (places.altitude.cos() * places.sun_altitude.cos()) as f32;
        let mut from_sun = [0.0_f32; CHUNK];
        for (from_sun, azimuth) in from_sun.iter_mut().zip(places.azimuths) {
            let turns = (azimuth - places.sun_azimuth) * (1.0 / TAU);
            *from_sun = (turns - turns.round()).abs() as f32;
        }
        let mut located = [Located::default(); CHUNK];
        for (located, &from_sun) in located.iter_mut().zip(&from_sun) {
            let sine = half_sine(from_sun);
            *located = FunctionRows::locate(height + cosines * sine * sine);
        }
        Self { from_sun, located, filtered: lanes.filter().map(|filter| filter_factors(filter, places)) }
    }

    /// What each field of `block` counts in direction `i`.
    #[inline(always)]
    pub fn factors(&self, lanes: &Lanes, i: usize, block: usize) -> [f32; BLOCK] {
        let mut factors = lanes.rows().values(self.located[i], block);
        if let Some(filtered) = &self.filtered {
            for (mask, factor) in lanes.filter_lanes(block).iter().zip(filtered[i]) {
                for n in 0..BLOCK {
                    factors[n] += factor * mask[n];
                }
            }
        }
        factors
    }
}

/// Writes the radiance of at most [`CHUNK`] directions of one circle.
pub(super) fn shade(circle: &Circle, places: &Places, out: &mut [[f32; 3]]) {
    Arch::new().dispatch(Shading { circle, places, out });
}

/// The work of [`shade`], for vectors of any width. Left to itself the compiler gathers single numbers here.
struct Shading<'a> {
    circle: &'a Circle<'a>,
    places: &'a Places<'a>,
    out: &'a mut [[f32; 3]],
}

impl WithSimd for Shading<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { circle, places, out } = self;
        let lanes = circle.lanes();
        let intervals = circle.intervals();
        let looks = Looks::new(lanes, places);
        let positions = looks.from_sun.map(|from_sun| 2.0 * from_sun * intervals as f32);
        out.fill([0.0; 3]);
        let mut start = 0;
        while start < out.len() {
            let interval = (positions[start] as usize).min(intervals - 1);
            let same = |p: &f32| (*p as usize).min(intervals - 1) == interval;
            let end = start + positions[start..out.len()].iter().take_while(|p| same(p)).count();
            for block in 0..lanes.rows().blocks() {
                let cubics = circle.cubics(interval, block);
                for v in 0..(lanes.count() - block * BLOCK).min(BLOCK).div_ceil(S::F32_LANES) {
                    let cubics = cubics.each_ref().map(|powers| powers.each_ref().map(|c| S::as_simd_f32s(c).0[v]));
                    let [xs, ys, zs] = cubics;
                    let filtered = looks.filtered.as_ref().map(|filtered| {
                        (filtered, lanes.filter_lanes(block).each_ref().map(|lanes| S::as_simd_f32s(lanes).0[v]))
                    });
                    for i in start..end {
                        let (below, above, fraction) = lanes.rows().around(looks.located[i], block);
                        let (below, above) = (S::as_simd_f32s(below).0[v], S::as_simd_f32s(above).0[v]);
                        let mut factor = simd.mul_add_e_f32s(simd.splat_f32s(fraction), simd.sub_f32s(above, below), below);
                        if let Some((filtered, lanes)) = &filtered {
                            for (&lanes, &filtered) in lanes.iter().zip(&filtered[i]) {
                                factor = simd.mul_add_e_f32s(simd.splat_f32s(filtered), lanes, factor);
                            }
                        }
                        let x = simd.splat_f32s(positions[i] - interval as f32);
                        let sum = |c: &[S::f32s; 4]| {
                            let value = simd.mul_add_e_f32s(x, c[3], c[2]);
                            let value = simd.mul_add_e_f32s(x, value, c[1]);
                            let value = simd.mul_add_e_f32s(x, value, c[0]);
                            simd.reduce_sum_f32s(simd.mul_f32s(factor, value))
                        };
                        out[i][0] += sum(&xs);
                        out[i][1] += sum(&ys);
                        out[i][2] += sum(&zs);
                    }
                }
            }
            start = end;
        }
        for value in out.as_flattened_mut() {
            // What is not a number stays so, for the painter to see.
            *value = if *value < 0.0 { 0.0 } else { *value };
        }
    }
}

/// What the filter makes of the dipoles' field and of Q and U.
fn filter_factors(filter: &PolarisingFilter, places: &Places) -> [[f32; 3]; CHUNK] {
    let mut out = [[0.0; 3]; CHUNK];
    for (out, &azimuth) in out.iter_mut().zip(places.azimuths) {
        let [q, u] = filter.weights(places.altitude, azimuth);
        let around = places.sun_azimuth - azimuth;
        let [a, b] = crate::light::transverse(places.altitude.sin(), around, FRAC_PI_2 - places.sun_altitude);
        // The fields know azimuths on one side of the Sun: U changes sign on the other.
        let side = if around.sin() < 0.0 { -1.0 } else { 1.0 };
        *out = [(q * (b * b - a * a) - 2.0 * u * a * b) as f32, q as f32, (side * u) as f32];
    }
    out
}

/// sin(pi turns) for 0 to 1/2 turns; error below 1e-7.
#[inline(always)]
fn half_sine(turns: f32) -> f32 {
    let x = turns * std::f32::consts::PI;
    let y = x * x;
    x * (1.0 + y * (-0.166_666_67 + y * (8.333_333e-3 + y * (-1.984_127e-4 + y * (2.755_731_9e-6 - y * 2.505_21e-8)))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn half_sines_are_those_of_the_library() {
        for i in 0..=500 {
            let turns = f64::from(i) / 1000.0;
            assert!((f64::from(half_sine(turns as f32)) - (PI * turns).sin()).abs() < 3e-7, "{turns}");
        }
    }
}
