//! The Sun's irradiance outside the atmosphere at 1 au: ASTM E490-00a (2000), integrated in bands, never sampled.
//!
//! At 1 au it gives 1366 W m-2 over all wavelengths and 133.3 klx (CIE 1931); Darula, Kittler & Gueymard (2005) recommend
//! 133.334 klx as the luminous solar constant. The extraterrestrial column of ASTM G173 gives 133.1 klx; 10 nm means of the two
//! differ by 1.7 % at 400 nm and by less than 1.1 % above 450 nm.

use super::binned::{BinnedSpectrum, columns};
use std::sync::LazyLock;

static SPECTRUM: LazyLock<BinnedSpectrum> = LazyLock::new(|| {
    let [wavelengths, irradiance] = columns(include_str!("../../data/solar_spectrum.csv"));
    BinnedSpectrum::new(wavelengths[0] as u32, irradiance)
});

/// Band width of the means that the library uses for single wavelengths [nm].
pub const BAND_WIDTH_NM: f64 = 10.0;

/// Mean solar irradiance at 1 au over the band of `band_width_nm` around `wavelength_nm` [W m-2 nm-1].
/// The table covers 300 to 1000 nm; a band that reaches beyond is averaged over its covered part, one outside gives 0.
pub fn irradiance(wavelength_nm: f64, band_width_nm: f64) -> f64 {
    SPECTRUM.mean(wavelength_nm, band_width_nm)
}

/// Low and high edge of the table [nm].
pub fn range_nm() -> (f64, f64) {
    SPECTRUM.range_nm()
}

/// Means over 10 nm around each of `wavelengths_nm` [W m-2 nm-1]; see [`irradiance`].
pub fn band_means(wavelengths_nm: &[f64]) -> Vec<f64> {
    wavelengths_nm.iter().map(|&wavelength| irradiance(wavelength, BAND_WIDTH_NM)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::observer;
    use crate::units::LUMINOUS_EFFICACY;

    #[test]
    fn bands_are_those_of_the_standard() {
        // checked against: mean of the ten values of ASTM E490-00a from 395.5 to 404.5 nm, 1.4827
        assert!((irradiance(400.0, 10.0) - 1.4827).abs() < 0.008);
        // checked against: SPECTRL2 (Bird & Riordan 1986), extraterrestrial 10 nm values at 500 and 550 nm, revised Neckel & Labs
        assert!((irradiance(500.0, 10.0) - 1.909).abs() < 0.02);
        assert!((irradiance(550.0, 10.0) - 1.892).abs() < 0.02);
        assert_eq!(band_means(&[500.0])[0], irradiance(500.0, 10.0));
    }

    #[test]
    fn the_sun_at_one_astronomical_unit_gives_its_luminous_constant() {
        let luminous: f64 = (360..=830).map(|w| irradiance(w.into(), 1.0) * observer::matching_functions(w.into())[1]).sum();
        // checked against: Darula, Kittler & Gueymard, Solar Energy 79 (2005), 133 334 lx
        assert!((luminous * LUMINOUS_EFFICACY / 133_334.0 - 1.0).abs() < 1e-3, "{}", luminous * LUMINOUS_EFFICACY);
    }
}
