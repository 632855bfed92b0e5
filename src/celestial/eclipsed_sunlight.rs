//! The Sun behind the Moon.
//!
//! Visible fraction of the light at wavelength lambda, with r the distance from the Sun's centre in its radii, mu = sqrt(1 - r^2) and
//! A_k the coefficients of limb darkening:
//! ```text
//! V(lambda) = sum over k of A_k M_k / sum over k of A_k pi 2 / (k + 2),
//! M_k = integral from 0 to 1 of mu^k 2 arccos((m^2 - r^2 - d^2) / (2 r d)) r dr
//! ```
//! m: radius of the Moon, d: separation of the centres, in radii of the Sun; the arc cosine is half of the circle's part that is free.
//! It is exact for round discs; mountains of the Moon (1 in 1000 of its radius) decide the last seconds before totality and are not
//! here.
//!
//! # The sky under the umbra
//! The light field of the air is symmetric around the Earth-Sun axis only while the Sun shines alike on all of it. During an eclipse
//! it is not: the shadow is 100 to 250 km wide, the lit air beyond it shines from all around the horizon. [`remaining_sky_light`] is
//! the approximation: until shortly before totality the sky is the normal one times V (good to 99.8 % obscuration by measurement:
//! Sharp, Silverman & Lloyd, Applied Optics 10, 1207, 1971); at totality a remainder is left that was scattered into the umbra: the
//! zenith has 1e-4 of its normal radiance, the sky nearly symmetric around the zenith and darkest there (Shaw, Applied Optics 14, 388,
//! 1975); radiance and irradiance fall by three to four orders of magnitude, and the corona adds little (Emde & Mayer, Atmospheric
//! Chemistry and Physics 7, 2259, 2007). In all some 3e-4 of the diffuse light is left, a few lux as eclipse watchers measure it
//! (Mollmann & Vollmer, European Journal of Physics 27, 1299, 2006).

use super::limb_darkening::{DISC_MEAN_OF_POWERS, coefficients, mean_intensity, relative_intensity};
use super::{angle, check_unit_vector};
use crate::error::{Result, check_range};
use crate::numerics::gauss::legendre;
use glam::DVec3;
use std::f64::consts::PI;

/// Sky radiance left in the zenith at totality, over the normal one.
pub const ZENITH_REMAINDER: f64 = 1e-4;

/// The same at the horizon: ten times (chosen, so that the diffuse irradiance keeps 3e-4).
pub const HORIZON_REMAINDER: f64 = 1e-3;

/// The light of the Sun behind the Moon: how much of it is left, of which colour, and from which part of the disc. Magnitude, kind and position angles of the
/// eclipse are geometry: [`crate::ephemeris::SolarEclipse`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EclipsedSunlight {
    sun_direction: DVec3,
    moon_direction: DVec3,
    sun_radius: f64,
    moon_radius: f64,
}

impl EclipsedSunlight {
    /// From unit vectors to the centres (in any one frame) and the angular radii [degrees], 0.05 to 5.
    pub fn new(sun_direction: DVec3, sun_radius_deg: f64, moon_direction: DVec3, moon_radius_deg: f64) -> Result<Self> {
        check_range("sun_radius_deg", sun_radius_deg, 0.05, 5.0, "degrees")?;
        check_range("moon_radius_deg", moon_radius_deg, 0.05, 5.0, "degrees")?;
        check_unit_vector("sun_direction", sun_direction)?;
        check_unit_vector("moon_direction", moon_direction)?;
        Ok(Self {
            sun_direction,
            moon_direction,
            sun_radius: sun_radius_deg.to_radians(),
            moon_radius: moon_radius_deg.to_radians(),
        })
    }

    /// Unit vector to the Sun's centre.
    pub fn sun_direction(&self) -> DVec3 {
        self.sun_direction
    }

    /// Unit vector to the Moon's centre.
    pub fn moon_direction(&self) -> DVec3 {
        self.moon_direction
    }

    /// Angular radius of the Sun [radians].
    pub fn sun_radius(&self) -> f64 {
        self.sun_radius
    }

    /// Angular radius of the Moon [radians].
    pub fn moon_radius(&self) -> f64 {
        self.moon_radius
    }

    /// Angle between the centres [radians].
    pub fn separation(&self) -> f64 {
        angle(self.sun_direction, self.moon_direction)
    }

    /// Part of the Sun's light at `wavelength_nm` that is not covered, 0 to 1.
    pub fn visible_fraction(&self, wavelength_nm: f64) -> f64 {
        self.visible_fractions(&[wavelength_nm])[0]
    }

    /// [`Self::visible_fraction`] at each of `wavelengths_nm`.
    pub fn visible_fractions(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        let moments = self.moments();
        wavelengths_nm
            .iter()
            .map(|&wavelength| {
                let a = coefficients(wavelength);
                let seen: f64 = (0..6).map(|k| a[k] * moments[k]).sum();
                let all: f64 = (0..6).map(|k| a[k] * PI * DISC_MEAN_OF_POWERS[k]).sum();
                (seen / all).clamp(0.0, 1.0)
            })
            .collect()
    }

    /// Radiance of the Sun's disc in `direction` (unit vector) over its mean over the whole disc, at `wavelength_nm`; 0 beside the
    /// disc and where the Moon is.
    pub fn relative_radiance(&self, direction: DVec3, wavelength_nm: f64) -> f64 {
        let distance = angle(direction, self.sun_direction) / self.sun_radius;
        if distance > 1.0 || self.covers(direction) {
            return 0.0;
        }
        let mu = (1.0 - distance * distance).max(0.0).sqrt();
        relative_intensity(mu, wavelength_nm) / mean_intensity(wavelength_nm)
    }

    /// Whether the Moon's disc stands in `direction` (unit vector).
    pub fn covers(&self, direction: DVec3) -> bool {
        angle(direction, self.moon_direction) < self.moon_radius
    }

    /// M_k of the module's equation.
    fn moments(&self) -> [f64; 6] {
        let (moon, separation) = (self.moon_radius / self.sun_radius, self.separation() / self.sun_radius);
        let mut knots = vec![0.0, 1.0];
        knots.extend([(moon - separation).abs(), moon + separation].into_iter().filter(|&knot| knot > 0.0 && knot < 1.0));
        knots.sort_by(f64::total_cmp);
        let rule = legendre(32);
        let mut moments = [0.0; 6];
        for piece in knots.windows(2) {
            let (middle, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
            for &(x, weight) in &rule {
                // Roots at both ends of each piece.
                let r = middle - half * (PI * x).cos();
                let mu = (1.0 - r * r).max(0.0).sqrt();
                let mut power = weight * half * PI * (PI * x).sin() * r * 2.0 * free_half_arc(r, moon, separation);
                for moment in &mut moments {
                    *moment += power;
                    power *= mu;
                }
            }
        }
        moments
    }
}

/// Half of the arc of the circle with radius r around the Sun's centre that the Moon leaves free [radians].
pub(super) fn free_half_arc(r: f64, moon: f64, separation: f64) -> f64 {
    if separation < 1e-12 {
        return if r < moon { 0.0 } else { PI };
    }
    ((moon * moon - r * r - separation * separation) / (2.0 * r * separation)).clamp(-1.0, 1.0).acos().clamp(0.0, PI)
}

/// Sky light left over the normal sky's, in the direction of `altitude` above the horizon [radians], when the part `visible` of the
/// Sun's light (0 to 1, [`EclipsedSunlight::visible_fraction`]) is seen. See the module's remark on the sky under the umbra.
pub fn remaining_sky_light(visible: f64, altitude: f64) -> f64 {
    let horizon = (1.0 - altitude.sin().clamp(0.0, 1.0)).powi(3);
    let remainder = ZENITH_REMAINDER + (HORIZON_REMAINDER - ZENITH_REMAINDER) * horizon;
    let visible = visible.clamp(0.0, 1.0);
    visible + remainder * (1.0 - visible)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn eclipse(moon_over_sun: f64, separation_over_sun: f64) -> EclipsedSunlight {
        let radius: f64 = 0.2666;
        let away = (radius * separation_over_sun).to_radians();
        EclipsedSunlight::new(DVec3::Y, radius, DVec3::new(0.0, away.cos(), away.sin()), radius * moon_over_sun).unwrap()
    }

    /// Area of two circles' overlap in closed form.
    fn lens(s: f64, r: f64, d: f64) -> f64 {
        s * s * ((d * d + s * s - r * r) / (2.0 * d * s)).acos() + r * r * ((d * d + r * r - s * s) / (2.0 * d * r)).acos()
            - 0.5 * ((-d + s + r) * (d + s - r) * (d - s + r) * (d + s + r)).sqrt()
    }

    #[test]
    fn the_area_is_that_of_two_circles() {
        let covered = |moon: f64, separation: f64| 1.0 - eclipse(moon, separation).moments()[0] / PI;
        for (moon, separation) in [(1.0, 1.0), (1.03, 0.5), (1.03, 0.031), (0.95, 0.2), (0.95, 0.0501), (1.05, 2.0), (0.5, 0.9)] {
            let ours = covered(moon, separation);
            let exact = lens(1.0, moon, separation) / PI;
            assert!((ours - exact).abs() < 1e-7, "{moon} {separation}: {ours} {exact}");
        }
        assert!((covered(0.9, 0.0) - 0.81).abs() < 1e-9);
        assert_eq!(covered(1.03, 0.01), 1.0);
        assert!(covered(1.0, 2.0 + 1e-9) < 1e-9);
    }

    #[test]
    fn a_thin_crescent_keeps_its_accuracy_and_is_redder() {
        // A crescent of width w at the limb: the light is less than its area says, and red more than blue.
        let eclipse = eclipse(1.03, 0.031);
        let free = 1.0 - lens(1.0, 1.03, 0.031) / PI;
        let [blue, red] = [420.0, 680.0].map(|wavelength| eclipse.visible_fraction(wavelength));
        assert!(blue < red && red < 0.6 * free && blue > 0.1 * free, "{blue} {red} {free}");
    }

    #[test]
    fn drawn_pixels_add_up_to_the_visible_fraction() {
        let eclipse = eclipse(1.02, 0.7);
        let radius = eclipse.sun_radius();
        let pixels = 800;
        let mut sum = 0.0;
        for row in 0..pixels {
            for column in 0..pixels {
                let at = |i: i32| (2.0 * (f64::from(i) + 0.5) / f64::from(pixels) - 1.0) * radius;
                let direction = DVec3::new(at(column), 1.0, at(row)).normalize();
                sum += eclipse.relative_radiance(direction, 550.0);
            }
        }
        let mean = sum * 4.0 / (f64::from(pixels).powi(2) * PI);
        assert!((mean / eclipse.visible_fraction(550.0) - 1.0).abs() < 1e-3, "{mean} {}", eclipse.visible_fraction(550.0));
    }

    #[test]
    fn the_sky_keeps_a_ten_thousandth() {
        assert_eq!(remaining_sky_light(1.0, 0.3), 1.0);
        assert_eq!(remaining_sky_light(0.0, 0.5 * PI), ZENITH_REMAINDER);
        assert!((remaining_sky_light(0.5, 0.0) - 0.5).abs() < 1e-3);
        // Of an even sky's irradiance 2e-4 is left, of a real one, brighter near the horizon, more.
        let irradiance: f64 = legendre(16).into_iter().map(|(s, w)| 2.0 * s * w * remaining_sky_light(0.0, s.asin())).sum();
        assert!((1.5e-4..4e-4).contains(&irradiance), "{irradiance}");
    }

    #[test]
    fn bad_input_is_named() {
        let error = EclipsedSunlight::new(DVec3::ZERO, 0.26, DVec3::X, 0.26).unwrap_err().to_string();
        assert!(error.starts_with("sun_direction"), "{error}");
        assert!(EclipsedSunlight::new(DVec3::X, f64::NAN, DVec3::X, 0.26).is_err());
    }
}
