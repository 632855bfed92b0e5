//! Spectra of the lamps whose light the sky scatters back.
//!
//! `data/lamps.csv`: CIE 015:2018, HP1 (high pressure sodium) and LED-B3 (white LED, 4103 K). What the air scatters is bluer than
//! the lamps: half of it is taken as scattered by molecules (lambda^-4.09) and half by haze (lambda^-1.3), at 550 nm, as in clear
//! air with an aerosol optical depth of 0.1.

use super::photometry::{interpolated, luminous, visible_nm};
use crate::error::{Result, check_range};
use crate::spectrum::binned::columns;
use std::sync::LazyLock;

static TABLE: LazyLock<[Vec<f64>; 3]> = LazyLock::new(|| columns(include_str!("../../data/lamps.csv")));

/// A mixture of street lamps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamps {
    led: f64,
}

impl Default for Lamps {
    /// Half of the light from LEDs, half from sodium lamps.
    fn default() -> Self {
        Self { led: 0.5 }
    }
}

impl Lamps {
    /// A mixture with the fraction `led` (0 to 1) of the luminance of the sky from white LEDs, the rest from high pressure sodium
    /// lamps.
    ///
    /// # Errors
    /// [`crate::Error::Input`] if `led` is outside its range.
    pub fn new(led: f64) -> Result<Self> {
        Ok(Self { led: check_range("led_fraction", led, 0.0, 1.0, "")? })
    }

    /// Spectral radiance at `wavelengths_nm` of scattered light of luminance 1 cd m-2 [W m-2 sr-1 nm-1].
    pub fn scattered_spectrum(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        let [sodium, led] = [1, 2].map(|lamp| {
            let fine: Vec<f64> = visible_nm().map(|w| scattered(lamp, w)).collect();
            luminous(&fine)
        });
        wavelengths_nm.iter().map(|&w| (1.0 - self.led) * scattered(1, w) / sodium + self.led * scattered(2, w) / led).collect()
    }
}

/// Light of lamp `column` after scattering, in arbitrary units: mean over 10 nm.
fn scattered(column: usize, wavelength_nm: f64) -> f64 {
    let [wavelengths, ..] = &*TABLE;
    let ratio = 550.0 / wavelength_nm;
    let position = |w: f64| (w - wavelengths[0]) / (wavelengths[1] - wavelengths[0]);
    let at = |w: f64| interpolated(&TABLE[column], position(w)).unwrap_or(0.0);
    let mean = 0.25 * at(wavelength_nm - 5.0) + 0.5 * at(wavelength_nm) + 0.25 * at(wavelength_nm + 5.0);
    mean * 0.5 * (ratio.powf(4.09) + ratio.powf(1.3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spectra_have_unit_luminance() {
        let fine: Vec<f64> = visible_nm().collect();
        for led in [0.0, 0.3, 1.0] {
            let luminance = luminous(&Lamps::new(led).unwrap().scattered_spectrum(&fine));
            assert!((luminance - 1.0).abs() < 1e-12, "{led}: {luminance}");
        }
        assert!(Lamps::new(1.1).is_err());
    }

    #[test]
    fn sodium_is_orange_and_diodes_are_blue() {
        let ratio = |led: f64| {
            let spectrum = Lamps::new(led).unwrap().scattered_spectrum(&[450.0, 590.0]);
            spectrum[0] / spectrum[1]
        };
        assert!(ratio(0.0) < 0.25 && ratio(1.0) > 1.0, "{} {}", ratio(0.0), ratio(1.0));
    }
}
