//! Random numbers and the directions drawn with them.
//!
//! Each function draws exactly from the density that it names, by inversion or rejection; none is an approximation.

use glam::DVec3;
use std::f64::consts::TAU;

/// The generator SplitMix64 (Steele, Lea & Flood 2014): 64 bits of state, passes BigCrush.
pub(in crate::light) struct Random {
    state: u64,
}

impl Random {
    /// An independent stream for each pair of `seed` and `stream`.
    pub fn new(seed: u64, stream: u64) -> Self {
        Self { state: mix(mix(seed) ^ stream.wrapping_mul(0xD134_2543_DE82_EF95)) }
    }

    /// Uniform in [0, 1), 53 bits.
    pub fn uniform(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        (mix(self.state) >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }
}

fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Two unit vectors that make a right-handed frame with the unit vector `axis` (Duff et al. 2017).
pub(super) fn frame(axis: DVec3) -> (DVec3, DVec3) {
    let sign = 1.0_f64.copysign(axis.z);
    let a = -1.0 / (sign + axis.z);
    let b = axis.x * axis.y * a;
    (DVec3::new(1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x), DVec3::new(b, sign + axis.y * axis.y * a, -axis.y))
}

/// The direction at angle acos(`cosine`) from the unit vector `axis`, at a uniformly random azimuth about it.
pub(in crate::light) fn around(axis: DVec3, cosine: f64, random: &mut Random) -> DVec3 {
    let (first, second) = frame(axis);
    let (sine_azimuth, cosine_azimuth) = (TAU * random.uniform()).sin_cos();
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    (axis * cosine + (first * cosine_azimuth + second * sine_azimuth) * sine).normalize()
}

/// A direction of the hemisphere about the unit vector `up` with density cosine / pi.
pub(super) fn lambertian(up: DVec3, random: &mut Random) -> DVec3 {
    let cosine = (1.0 - random.uniform()).sqrt();
    around(up, cosine, random)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal_everywhere() {
        for axis in [DVec3::Z, -DVec3::Z, DVec3::X, DVec3::new(0.6, -0.48, -0.64), DVec3::new(1e-9, 0.0, -1.0).normalize()] {
            let (a, b) = frame(axis);
            assert!(a.cross(b).distance(axis) < 1e-12);
            assert!((a.length() - 1.0).abs() < 1e-12 && (b.length() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn lambertian_directions_have_a_mean_cosine_of_two_thirds() {
        let mut random = Random::new(7, 0);
        let up = DVec3::new(0.48, 0.6, 0.64);
        let n = 100_000;
        let mean = (0..n).map(|_| lambertian(up, &mut random)).sum::<DVec3>() / n as f64;
        assert!(mean.distance(up * (2.0 / 3.0)) < 0.006);
    }

    #[test]
    fn streams_differ_and_repeat() {
        let draw = |seed, stream| Random::new(seed, stream).uniform();
        assert_eq!(draw(3, 5), draw(3, 5));
        assert_ne!(draw(3, 5), draw(3, 6));
        assert_ne!(draw(3, 5), draw(4, 5));
    }
}
