//! How brightness is spread over the Moon's disc: Akimov's disc function.
//!
//! ```text
//! r = A_eq(alpha) a D,   D = cos(alpha / 2) cos(pi / (pi - alpha) (gamma - alpha / 2)) cos(beta)^(alpha / (pi - alpha)) / cos(gamma)
//! ```
//!
//! r: radiance factor (pi L / E); alpha: phase angle; gamma, beta: photometric longitude, from the observer's sub-point towards the Sun's,
//! and latitude; a: relative albedo of the place. D = 1 everywhere at full Moon: no limb darkening. It falls to 0 at the terminator.
//! Derived for an extremely rough, undulated surface; it has no parameter and fits the Moon better than Lommel-Seeliger's or Hapke's.
//! Source: Akimov 1988, in the form of Shkuratov et al., Planetary and Space Science 59, 1326 (2011), section 3; used by Velikodsky et al.,
//! Icarus 214, 30 (2011).
//!
//! Maria and highlands have different phase functions: their contrast grows with phase angle. [`contrast`] is the exponent of the map.

use crate::numerics::gauss::legendre;
use std::f64::consts::{FRAC_PI_2, PI};

/// D for `phase` alpha and the photometric `longitude` gamma and `latitude` beta [radians]; 0 where it is night or out of sight.
pub fn disc_function(phase: f64, longitude: f64, latitude: f64) -> f64 {
    if longitude <= phase - FRAC_PI_2 || longitude >= FRAC_PI_2 || phase >= PI {
        return 0.0;
    }
    let lit = PI - phase;
    let across = (PI / lit * (longitude - 0.5 * phase)).cos().max(0.0) / longitude.cos().max(1e-9);
    (0.5 * phase).cos() * across * latitude.cos().max(0.0).powf(phase / lit)
}

/// Mean of D over the whole disc (dark part included) of a sphere: 1 at full Moon, 0 at new.
pub fn uniform_disc(phase: f64) -> f64 {
    let lit = PI - phase;
    if lit <= 0.0 {
        return 0.0;
    }
    // Over gamma in closed form: 2 lit / pi; over beta the integral of cos^(2 + alpha / (pi - alpha)), in the variable sin(beta) = s.
    let power = 0.5 * (1.0 + phase / lit);
    // The integrand is about 1 / sqrt(power) wide: a piece for its bulk and one for its tail.
    let width = (3.0 * (2.0 / (1.0 + power)).sqrt()).min(1.0);
    let pieces = [(0.0, width), (width, 1.0)];
    let integral: f64 = pieces
        .iter()
        .map(|&(from, to)| {
            // t with s = to - (to - from) t^2 removes the root at the end s = 1.
            legendre(24)
                .into_iter()
                .map(|(t, weight)| {
                    let s = to - (to - from) * t * t;
                    weight * 2.0 * t * (to - from) * (1.0 - s * s).max(0.0).powf(power)
                })
                .sum::<f64>()
        })
        .sum();
    (0.5 * phase).cos() * (2.0 * lit / PI) * 2.0 * integral / PI
}

/// Exponent of the relative albedo at `phase` [radians].
///
/// The map (`moon_map.rs`) is normalised to a phase of 60 degrees, where highlands are 2.5 times as bright as maria; at full Moon the
/// factor is about 2 (Pohn & Wildey 1970, USGS Professional Paper 599-E: normal albedos). An exponential phase function whose
/// steepness is linear in the logarithm of the albedo makes the exponent linear in phase. Chosen to join the two; constant above 90
/// degrees.
pub fn contrast(phase: f64) -> f64 {
    0.78 + 0.22 * phase.clamp(0.0, FRAC_PI_2) / (PI / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_full_moon_is_flat_to_the_limb() {
        for longitude in [-1.5, -1.0, 0.0, 0.7, 1.5] {
            for latitude in [-1.5, 0.0, 1.2] {
                assert!((disc_function(0.0, longitude, latitude) - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn light_falls_to_nothing_at_the_terminator() {
        for phase in [0.5, 1.57, 2.5] {
            let terminator = phase - FRAC_PI_2;
            assert_eq!(disc_function(phase, terminator - 0.01, 0.1), 0.0);
            assert!(disc_function(phase, terminator + 1e-4, 0.1) < 1e-3);
            // It rises towards the bright limb.
            let values = [0.1, 0.4, 0.9].map(|share| disc_function(phase, terminator + share * (PI - phase), 0.0));
            assert!(values[0] < values[1] && values[1] < values[2], "{values:?}");
        }
    }

    #[test]
    fn a_uniform_disc_has_its_closed_forms() {
        // At 0: 1. At 90 degrees: cos 45 (2 / pi)(pi / 2) integral of cos^3 = 4 / 3, over pi.
        assert!((uniform_disc(0.0) - 1.0).abs() < 1e-9, "{}", uniform_disc(0.0));
        let half = std::f64::consts::FRAC_1_SQRT_2 * (4.0 / 3.0) / PI;
        assert!((uniform_disc(FRAC_PI_2) / half - 1.0).abs() < 1e-9);
        // At 120 degrees: cos 60 (2 / 3) (integral of cos^4 = 3 pi / 8) / pi.
        assert!((uniform_disc(2.0 * PI / 3.0) / (0.5 * (2.0 / 3.0) * 3.0 / 8.0) - 1.0).abs() < 1e-9);
        // Just before new Moon: cos(beta)^n becomes a Gaussian, sqrt(2 pi / n).
        let lit: f64 = 0.01;
        let narrow = (0.5 * lit).sin() * (2.0 * lit / PI) * (2.0 * PI / (1.0 + PI / lit)).sqrt() / PI;
        assert!((uniform_disc(PI - lit) / narrow - 1.0).abs() < 5e-3, "{} {narrow}", uniform_disc(PI - lit));
        assert_eq!(uniform_disc(PI), 0.0);
    }
}
