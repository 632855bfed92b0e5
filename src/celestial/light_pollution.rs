//! Light pollution: artificial light that the lower air scatters back, as it arrives at the ground.
//!
//! L(z) = (L_zenith - L_natural) (1 - 10^(-0.4 k X(z))) / (1 - 10^(-0.4 k)),   X(z) = 1 / sqrt(1 - 0.96 sin^2 z),
//!
//! z: zenith angle; X: air mass of scattered light, 5 at the horizon; k: extinction in V, 0.3 magnitudes. This is the brightness
//! of air that is lit evenly and dims its own light: Krisciunas & Schaefer 1991 (PASP 103, 1033), eqs. 3 and 15, made for
//! moonlight. It gives 2.3 times the zenith at 75 degrees and 3.1 at the horizon (all-sky pictures of cities: 2 to 4; the domes
//! of single cities, and how they depend on azimuth, are not in it). L_natural: 22.0 magnitudes per square arcsecond (Falchi et
//! al. 2016, Science Advances 2, e1600377). The light starts below the air that scatters it: do not extinguish it again.

use super::diffuse::DiffuseLight;
use super::lamps::Lamps;
use super::photometry::luminance_of_surface_brightness;
use crate::error::{Error, Result, check_range};
use glam::DVec3;

/// Natural brightness of the zenith [magnitudes per square arcsecond, V].
const NATURAL_ZENITH: f64 = 22.0;

/// Extinction [magnitudes per air mass, V].
const EXTINCTION: f64 = 0.3;

/// Scattered artificial light. Scalar: luminance [cd m-2]. Directions: z up; below the horizon as at the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPollution {
    zenith_luminance: f64,
    lamps: Lamps,
}

impl LightPollution {
    /// The artificial part of a sky whose moonless zenith has `zenith_brightness` (14 to 22) [magnitudes per square arcsecond,
    /// V]; 22 is the natural sky: none.
    ///
    /// # Errors
    /// [`crate::Error::Input`] if the brightness is outside its range.
    pub fn new(zenith_brightness: f64, lamps: Lamps) -> Result<Self> {
        check_range("zenith_brightness", zenith_brightness, 14.0, NATURAL_ZENITH, "magnitudes per square arcsecond")?;
        let zenith_luminance =
            luminance_of_surface_brightness(zenith_brightness) - luminance_of_surface_brightness(NATURAL_ZENITH);
        Ok(Self { zenith_luminance, lamps })
    }

    /// The artificial light of the Bortle class `class` (1 to 9): see [`bortle_zenith_brightness`].
    ///
    /// # Errors
    /// [`crate::Error::Input`] if there is no such class.
    pub fn bortle(class: u8, lamps: Lamps) -> Result<Self> {
        Self::new(bortle_zenith_brightness(class)?, lamps)
    }

    /// Artificial luminance of the zenith [cd m-2].
    pub fn zenith_luminance(&self) -> f64 {
        self.zenith_luminance
    }
}

impl DiffuseLight<1> for LightPollution {
    fn spectra(&self, wavelengths_nm: &[f64]) -> [Vec<f64>; 1] {
        [self.lamps.scattered_spectrum(wavelengths_nm)]
    }

    fn scalars(&self, direction: DVec3) -> [f64; 1] {
        let cosine = direction.z.clamp(0.0, 1.0);
        let air_mass = 1.0 / (1.0 - 0.96 * (1.0 - cosine * cosine)).sqrt();
        let scattered = |mass: f64| 1.0 - 10f64.powf(-0.4 * EXTINCTION * mass);
        [self.zenith_luminance * scattered(air_mass) / scattered(1.0)]
    }
}

/// Brightness of the moonless zenith of the Bortle class `class` (1, best, to 9) [magnitudes per square arcsecond, V].
///
/// Bortle (Sky & Telescope, February 2001) defined the classes by what is seen; these are the middles of the ranges that are
/// commonly given for them (class 4, for example: 20.49 to 21.69), so 0.5 magnitudes either way is a matter of taste.
///
/// # Errors
/// [`Error::Input`] if there is no such class.
pub fn bortle_zenith_brightness(class: u8) -> Result<f64> {
    match class {
        1 => Ok(21.99),
        2 => Ok(21.94),
        3 => Ok(21.79),
        4 => Ok(21.09),
        5 => Ok(20.0),
        6 => Ok(19.22),
        7 => Ok(18.66),
        8 => Ok(18.0),
        9 => Ok(17.5),
        _ => Err(Error::input("bortle", class, "a whole number from 1 to 9")),
    }
}

#[cfg(test)]
mod tests {
    use super::super::photometry::surface_brightness_of_luminance;
    use super::*;

    #[test]
    fn artificial_and_natural_light_give_the_zenith() {
        let city = LightPollution::new(18.0, Lamps::default()).unwrap();
        let sum = city.luminance(DVec3::Z) + luminance_of_surface_brightness(22.0);
        assert!((surface_brightness_of_luminance(sum) - 18.0).abs() < 1e-9);
        assert_eq!(LightPollution::new(22.0, Lamps::default()).unwrap().scalars(DVec3::X), [0.0]);
    }

    #[test]
    fn the_horizon_is_brighter() {
        let city = LightPollution::new(19.0, Lamps::default()).unwrap();
        let ratio = |zenith_deg: f64| {
            let angle = zenith_deg.to_radians();
            city.scalars(DVec3::new(angle.sin(), 0.0, angle.cos()))[0] / city.zenith_luminance()
        };
        // By hand: X(75 deg) = 3.10, (1 - 0.4246) / (1 - 0.7586) = 2.38; X(90 deg) = 5, (1 - 0.2512) / (1 - 0.7586) = 3.10
        assert!((ratio(75.0) - 2.38).abs() < 0.01 && (ratio(90.0) - 3.10).abs() < 0.01, "{} {}", ratio(75.0), ratio(90.0));
        assert_eq!(ratio(100.0), ratio(90.0));
        assert!((0..90).all(|z| ratio(f64::from(z)) < ratio(f64::from(z + 1))));
    }

    #[test]
    fn classes_darken_and_bad_ones_are_refused() {
        assert!((1..9).all(|c| bortle_zenith_brightness(c).unwrap() > bortle_zenith_brightness(c + 1).unwrap()));
        let message = bortle_zenith_brightness(0).unwrap_err().to_string();
        assert_eq!(message, "bortle = 0: must be a whole number from 1 to 9");
        assert!(LightPollution::new(23.0, Lamps::default()).is_err());
    }
}
