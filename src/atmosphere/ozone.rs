//! Absorption by ozone, which makes the zenith blue after sunset.
//!
//! tau(lambda) = sigma(lambda) x column. The cross-section is averaged over the band that a wavelength stands for, because the
//! Chappuis and Wulf bands have structure of a few nm. Cross-sections: Brion et al. 1998 (295 K; between 200 and 295 K the
//! Chappuis band changes by about 1 %) and, up to 345 nm, Malicet et al. 1995 (228 K). Serdyuchenko et al. 2014 is 1 to 3 % lower
//! between 500 and 650 nm: that is how far laboratories differ.

use crate::spectrum::binned::{BinnedSpectrum, columns};
use std::sync::LazyLock;

/// One Dobson unit [molecules cm-2]: 0.01 mm of gas at 273.15 K and 1013.25 hPa.
pub const MOLECULES_PER_CM2_IN_DOBSON_UNIT: f64 = 2.6868e16;

/// Widest and narrowest band a cross-section is averaged over [nm].
const BAND_WIDTHS_NM: (f64, f64) = (1.0, 25.0);

static CROSS_SECTION_CM2: LazyLock<BinnedSpectrum> = LazyLock::new(|| {
    let [wavelengths, sections] = columns(include_str!("../../data/ozone.csv"));
    BinnedSpectrum::new(wavelengths[0] as u32, sections)
});

/// Mean absorption cross-section [cm2] of one molecule over the band of `band_width_nm` around `wavelength_nm`. The table covers
/// 300 to 829 nm; beyond 829 nm the absorption is below 3 % of its maximum and taken as zero.
pub fn cross_section_cm2(wavelength_nm: f64, band_width_nm: f64) -> f64 {
    CROSS_SECTION_CM2.mean(wavelength_nm, band_width_nm)
}

/// Width of the band that each of `wavelengths_nm` (ascending) stands for [nm]: the mean distance to its neighbours, from 1 to 25 nm;
/// 10 nm for a single wavelength.
pub fn band_width(wavelengths_nm: &[f64]) -> Vec<f64> {
    let last = wavelengths_nm.len().saturating_sub(1);
    (0..wavelengths_nm.len())
        .map(|i| {
            let (left, right) = (i.saturating_sub(1), (i + 1).min(last));
            if left == right {
                return 10.0;
            }
            let mean = (wavelengths_nm[right] - wavelengths_nm[left]) / (right - left) as f64;
            mean.clamp(BAND_WIDTHS_NM.0, BAND_WIDTHS_NM.1)
        })
        .collect()
}

/// Vertical optical depth of a column of `dobson_units` at each of `wavelengths_nm`, averaged over their bands.
pub fn optical_depth(wavelengths_nm: &[f64], dobson_units: f64) -> Vec<f64> {
    let column = dobson_units * MOLECULES_PER_CM2_IN_DOBSON_UNIT;
    let widths = band_width(wavelengths_nm);
    wavelengths_nm.iter().zip(widths).map(|(&wavelength, width)| cross_section_cm2(wavelength, width) * column).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cross_sections_are_within_the_spread_of_the_laboratories() {
        // checked against: Serdyuchenko et al. 2014, 233 K: 5.02e-21 cm2 at 600 nm, 2.32e-22 cm2 at 450 nm (10 nm means);
        // JPL 2006 recommendation: 5.13e-21 at 600 nm, 1.85e-22 at 450 nm (5 nm means)
        assert!((cross_section_cm2(600.0, 10.0) / 5.02e-21 - 1.0).abs() < 0.04);
        assert!((cross_section_cm2(600.0, 5.0) / 5.13e-21 - 1.0).abs() < 0.01);
        assert!((cross_section_cm2(450.0, 5.0) / 1.85e-22 - 1.0).abs() < 0.03);
    }

    #[test]
    fn three_hundred_units_absorb_four_percent_at_600_nm() {
        let depth = optical_depth(&[600.0], 300.0)[0];
        assert!((depth - 0.0410).abs() < 0.001, "{depth}");
        assert_eq!(optical_depth(&[600.0], 0.0)[0], 0.0);
    }

    #[test]
    fn bands_reach_to_the_neighbours() {
        assert_eq!(band_width(&[400.0, 410.0, 430.0, 530.0]), [10.0, 15.0, 25.0, 25.0]);
        assert_eq!(band_width(&[500.0]), [10.0]);
        assert_eq!(band_width(&[500.0, 500.1]), [1.0, 1.0]);
    }
}
