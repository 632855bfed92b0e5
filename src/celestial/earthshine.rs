//! Earthshine: the light of the Earth on the Moon.
//!
//! E_earth = (2 / 3) A*(lambda) f(theta) (R_earth / distance)^2 E_sun,   f(theta) = ((pi - theta) cos theta + sin theta) / pi
//!
//! A*: apparent albedo of the Earth, the albedo of a Lambertian sphere that would send the same light (0.3, varies by 10 % with clouds
//! and with the side that is turned to the Moon); theta: phase angle of the Earth, seen from the Moon; f: Lambert's phase function.
//! Source: Goode et al., Geophysical Research Letters 28, 1671 (2001), eqs. 1-3; A* = 0.30: Palle et al., Journal of Geophysical
//! Research 108, 4710 (2003).
//!
//! The spectrum is a grey part (clouds, ground) and a part of molecules as lambda^-4, in the proportion that makes the colour of earthlight
//! B - V = 0.44 (Thejll et al., Astronomy & Astrophysics 563, A38, 2014), where the Sun has 0.64. Oxygen and water bands and the red
//! edge of plants, some per cent each, are left out. Near new Moon the nearly full Earth scatters back more than a Lambertian sphere,
//! by up to a quarter (Su et al. 2018, Atmospheric Chemistry and Physics 18, 11 429: DSCOVR): that is left out too.

use crate::units::EARTH_RADIUS_KM;
use std::f64::consts::PI;

/// A* at 550 nm.
const APPARENT_ALBEDO_550: f64 = 0.30;

/// Part of A* at 550 nm that goes as lambda^-4: 10^(0.4 (0.64 - 0.44)) = 1.20 between 440 and 550 nm.
const MOLECULAR_SHARE: f64 = 0.14;

/// Apparent albedo of the Earth at `wavelength_nm`.
pub fn apparent_albedo(wavelength_nm: f64) -> f64 {
    APPARENT_ALBEDO_550 * (1.0 - MOLECULAR_SHARE + MOLECULAR_SHARE * (550.0 / wavelength_nm).powi(4))
}

/// Lambert's phase function: 1 for the full Earth (`phase` 0), 0 for the new one (pi) [radians].
pub fn phase_function(phase: f64) -> f64 {
    let phase = phase.clamp(0.0, PI);
    ((PI - phase) * phase.cos() + phase.sin()) / PI
}

/// Irradiance of the Earth at the Moon divided by that of the Sun at the Moon, at `wavelength_nm`, for the Earth's `phase` angle
/// [radians] and the distance of the two.
pub fn irradiance_ratio(wavelength_nm: f64, phase: f64, earth_distance_km: f64) -> f64 {
    2.0 / 3.0 * apparent_albedo(wavelength_nm) * phase_function(phase) * (EARTH_RADIUS_KM / earth_distance_km).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lambert_full_half_new() {
        assert!((phase_function(0.0) - 1.0).abs() < 1e-15 && phase_function(PI).abs() < 1e-15);
        assert!((phase_function(0.5 * PI) - 1.0 / PI).abs() < 1e-15);
    }

    #[test]
    fn earthlight_is_bluer_than_sunlight_by_a_fifth_of_a_magnitude() {
        // checked against: Thejll et al. 2014: B - V of earthlight 0.44 +- 0.02, Sun 0.64
        let color = -2.5 * (apparent_albedo(440.0) / apparent_albedo(550.0)).log10();
        assert!((color + 0.20).abs() < 0.01, "{color}");
    }

    #[test]
    fn the_full_earth_sends_what_a_lambertian_sphere_does() {
        // Geometric albedo 2 / 3 of 0.3, times the square of the Earth's angular radius: 0.2 / 60.34^2.
        let ratio = irradiance_ratio(550.0, 0.0, 384_400.0);
        assert!((ratio / (0.2 / 60.336_f64.powi(2)) - 1.0).abs() < 1e-4, "{ratio}");
    }
}
