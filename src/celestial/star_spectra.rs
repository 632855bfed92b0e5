//! The light of a star from its V and B - V.
//!
//! E(lambda) = 10^(-0.4 V) S(B - V, lambda), S: spectrum of a star of that colour and V = 0, from the library of Pickles (1998,
//! PASP 110, 863): main sequence to G5, giants to K5, a supergiant of type M2, and that one reddened for stars redder than 1.7.
//! Linear in the logarithm between the 26 colours of `data/star_spectra.csv`. One colour stands for one spectrum: stars of other
//! luminosity classes and metallicities differ from it by some per cent, the coolest giants (M5 and later, B - V back to 1.2) by
//! more.

use super::photometry::interpolated;
use super::stars::Star;
use crate::numerics::locate;
use std::sync::LazyLock;

/// First wavelength [nm] and step of the table.
const TABLE_START_NM: f64 = 360.0;
const TABLE_STEP_NM: f64 = 5.0;

/// Colours of the rows of [`StarSpectra`]: from, step, number. The step is a tenth of the scatter of catalogued colours.
const FIRST_B_MINUS_V: f64 = -0.4;
const B_MINUS_V_STEP: f64 = 0.02;
const ROWS: usize = 171;

struct Table {
    b_minus_v: Vec<f64>,
    /// For V = 0 [W m-2 nm-1].
    spectra: Vec<Vec<f64>>,
}

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let mut table = Table { b_minus_v: Vec::new(), spectra: Vec::new() };
    for line in include_str!("../../data/star_spectra.csv").lines().filter(|line| !line.starts_with('#')).skip(1) {
        let mut cells = line.split(',').map(|cell| cell.parse::<f64>().expect("an embedded table has a number in each cell"));
        table.b_minus_v.extend(cells.next());
        table.spectra.push(cells.map(|value| value * 1e-11).collect());
    }
    table
});

/// Spectral irradiance at `wavelength_nm` (360 to 830; the end value outside) of a star of V = 0 and colour `b_minus_v` [W m-2
/// nm-1].
pub(super) fn zero_magnitude_irradiance(b_minus_v: f64, wavelength_nm: f64) -> f64 {
    let table = &*TABLE;
    let (row, fraction) = locate(&table.b_minus_v, b_minus_v);
    let value = |row: usize| between_nodes(&table.spectra[row], wavelength_nm);
    value(row) * (value(row + 1) / value(row)).powf(fraction)
}

/// Wavelengths of the table [nm].
pub(super) fn nodes_nm() -> Vec<f64> {
    (0..TABLE.spectra[0].len()).map(|i| TABLE_START_NM + TABLE_STEP_NM * i as f64).collect()
}

/// Value at `wavelength_nm` of what is given at [`nodes_nm`]; the end value outside.
pub(super) fn between_nodes(values: &[f64], wavelength_nm: f64) -> f64 {
    let end = (values.len() - 1) as f64;
    interpolated(values, ((wavelength_nm - TABLE_START_NM) / TABLE_STEP_NM).clamp(0.0, end)).unwrap_or(0.0)
}

/// Spectra of stars of V = 0 at given wavelengths, one row for every 0.02 magnitudes of B - V, so that any number of stars costs
/// a multiplication each.
#[derive(Clone, Debug, PartialEq)]
pub struct StarSpectra {
    wavelengths: usize,
    rows: Vec<f64>,
}

impl StarSpectra {
    /// The table for `wavelengths_nm` (at least one; 360 to 830, outside the end values are kept).
    pub fn new(wavelengths_nm: &[f64]) -> Self {
        let colour = |row: usize| FIRST_B_MINUS_V + B_MINUS_V_STEP * row as f64;
        let rows = (0..ROWS)
            .flat_map(|row| wavelengths_nm.iter().map(move |&wavelength| zero_magnitude_irradiance(colour(row), wavelength)))
            .collect();
        Self { wavelengths: wavelengths_nm.len(), rows }
    }

    /// Number of rows: colours B - V from -0.4 in steps of 0.02.
    pub const fn row_count(&self) -> usize {
        ROWS
    }

    /// Row of the colour nearest to `b_minus_v`.
    pub fn row_of(&self, b_minus_v: f64) -> usize {
        let position = (b_minus_v - FIRST_B_MINUS_V) / B_MINUS_V_STEP + 0.5;
        (position.max(0.0) as usize).min(ROWS - 1)
    }

    /// Spectral irradiance of a star of V = 0 of row `row` (below [`Self::row_count`]) [W m-2 nm-1].
    pub fn row(&self, row: usize) -> &[f64] {
        &self.rows[row * self.wavelengths..(row + 1) * self.wavelengths]
    }

    /// Spectral irradiance of `star` outside the air [W m-2 nm-1].
    pub fn irradiance(&self, star: &Star) -> Vec<f64> {
        let scale = 10f64.powf(-0.4 * star.v_magnitude);
        self.row(self.row_of(star.b_minus_v)).iter().map(|value| value * scale).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::photometry::{V_ZERO_ILLUMINANCE, luminous, v_magnitude, visible_nm};
    use super::*;

    /// Mean over a band of Bessell (1990), weighted by photons, of a star of V = 0.
    fn band_mean(start: f64, response: &[f64], step: f64, b_minus_v: f64) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for i in 0..=((response.len() - 1) as f64 * step) as usize {
            let wavelength = start + i as f64;
            let weight = wavelength * interpolated(response, i as f64 / step).unwrap();
            sum += weight * zero_magnitude_irradiance(b_minus_v, wavelength);
            weights += weight;
        }
        sum / weights
    }

    #[rustfmt::skip]
    const B_BAND: [f64; 21] = [
        0.0, 0.030, 0.134, 0.567, 0.920, 0.978, 1.0, 0.978, 0.935, 0.853, 0.740, 0.640, 0.536, 0.424, 0.325, 0.235, 0.150, 0.095, 0.043, 0.009, 0.0,
    ];
    /// To 830 nm, where the table of spectra ends; 1 % of the band lies beyond.
    #[rustfmt::skip]
    const R_BAND: [f64; 29] = [
        0.0, 0.23, 0.74, 0.91, 0.98, 1.0, 0.98, 0.96, 0.93, 0.90, 0.86, 0.81, 0.78, 0.72, 0.67, 0.61, 0.56, 0.51, 0.46, 0.40,
        0.35, 0.308, 0.266, 0.224, 0.182, 0.14, 0.118, 0.096, 0.074,
    ];

    #[test]
    fn a_star_of_magnitude_zero_is_one_for_every_colour() {
        for b_minus_v in [-0.4, -0.2, 0.0, 0.31, 0.65, 1.05, 1.5, 1.85, 2.6, 3.2] {
            let v = v_magnitude(|w| zero_magnitude_irradiance(b_minus_v, w));
            assert!(v.abs() < 0.012, "B - V {b_minus_v}: V {v}");
        }
    }

    #[test]
    fn the_colour_comes_out_again() {
        for b_minus_v in [-0.3, -0.15, 0.0, 0.2, 0.4, 0.65, 0.8, 1.0, 1.2, 1.3, 1.6, 1.9, 2.5] {
            // Zero point: Bessell, Castelli & Plez 1998, table A2, 6.32e-11 W m-2 nm-1 in B.
            let got = -2.5 * (band_mean(360.0, &B_BAND, 10.0, b_minus_v) / 6.32e-11).log10();
            assert!((got - b_minus_v).abs() < 0.035, "{b_minus_v}: {got}");
        }
    }

    #[test]
    fn red_light_is_that_of_the_standards() {
        // V - R relative to an A0 star, so that the zero point and the cut tail of the band drop out.
        let v_minus_r = |colour: f64| {
            let ratio = |c: f64| band_mean(550.0, &R_BAND, 10.0, c);
            2.5 * (ratio(colour) / ratio(0.0)).log10()
        };
        // checked against: Sun B - V 0.653, V - R 0.352 (Ramirez et al. 2012, ApJ 752, 5); Pickles' F0V and K1III: 0.185, 0.560
        for (colour, expected) in [(0.653, 0.352), (0.302, 0.185), (1.021, 0.560)] {
            assert!((v_minus_r(colour) - expected).abs() < 0.03, "{colour}: {}", v_minus_r(colour));
        }
    }

    #[test]
    fn white_stars_give_the_published_illuminance() {
        let spectrum: Vec<f64> = visible_nm().map(|w| zero_magnitude_irradiance(0.0, w)).collect();
        assert!((luminous(&spectrum) / V_ZERO_ILLUMINANCE - 1.0).abs() < 0.03, "{}", luminous(&spectrum));
    }

    #[test]
    fn rows_are_the_table() {
        let spectra = StarSpectra::new(&[450.0, 550.0, 650.0]);
        let star = Star { place: glam::DVec3::X, motion: glam::DVec3::ZERO, v_magnitude: 5.0, b_minus_v: 0.6 };
        let irradiance = spectra.irradiance(&star);
        assert!((irradiance[1] / (0.01 * zero_magnitude_irradiance(0.6, 550.0)) - 1.0).abs() < 1e-9);
        assert_eq!(spectra.row_of(-9.0), 0);
        assert_eq!(spectra.row_of(9.0), spectra.row_count() - 1);
        assert_eq!(spectra.row(3).len(), 3);
    }
}
