//! Haze: its extinction, single scattering albedo and asymmetry by wavelength.
//!
//! The types are those of OPAC (Hess, Koepke & Schult 1998) at 80 % relative humidity, computed with Mie theory over their log-normal
//! modes (`data/scripts/aerosol_types.py`; that reproduces OPAC's table 4 at 550 nm within 0.003 in albedo and asymmetry).
//! Their scale heights are OPAC's optical depth divided by its extinction at the ground, rounded.

use super::names::words;
use crate::spectrum::CubicSpline;
use crate::spectrum::binned::columns;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Wavelength at which the amount of aerosol is given [nm].
pub const REFERENCE_NM: f64 = 550.0;

/// A kind of aerosol.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum AerosolType {
    /// No aerosol at all.
    None,
    /// Remote continental air, nearly without soot. Also read as `rural`.
    #[default]
    ContinentalClean,
    /// Continental air with some soot.
    ContinentalAverage,
    /// Continental air polluted by man.
    ContinentalPolluted,
    /// Air over a city: much soot.
    Urban,
    /// Air over the open sea: sea salt and sulphate.
    MaritimeClean,
    /// Mineral dust.
    Desert,
    /// Air over the Antarctic: sulphate droplets.
    Antarctic,
    /// The haze of the original thesis: extinction proportional to wavelength^-0.84 (its section 6.2.2), scattering only. The thesis
    /// says that its asymmetry is close to one and gives no number: 0.8 here.
    Thesis,
}

words!(AerosolType, "aerosol", {
    None => "none",
    ContinentalClean => "continental_clean" | "rural",
    ContinentalAverage => "continental_average",
    ContinentalPolluted => "continental_polluted",
    Urban => "urban",
    MaritimeClean => "maritime_clean",
    Desert => "desert",
    Antarctic => "antarctic",
    Thesis => "thesis",
});

/// Optical properties of one kind of aerosol at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AerosolOptics {
    /// Extinction relative to that at 550 nm.
    pub relative_extinction: f64,
    /// Scattering divided by extinction (0 to 1).
    pub single_scattering_albedo: f64,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
}

impl AerosolType {
    /// Properties at `wavelength_nm`. Between 350 and 800 nm from the table; outside, the extinction continues with the exponent of
    /// the outermost 50 nm and the rest stays.
    pub fn optics(self, wavelength_nm: f64) -> AerosolOptics {
        let Some(table) = self.table() else {
            let relative_extinction = angstrom(wavelength_nm, 0.84);
            return AerosolOptics { relative_extinction, single_scattering_albedo: 1.0, asymmetry: 0.8 };
        };
        AerosolOptics {
            relative_extinction: table.relative_extinction(wavelength_nm),
            single_scattering_albedo: table.albedo.value(wavelength_nm).min(1.0),
            asymmetry: table.asymmetry.value(wavelength_nm),
        }
    }

    /// Scale height of the exponential vertical profile [km].
    pub fn scale_height_km(self) -> f64 {
        match self {
            Self::MaritimeClean => 1.0,
            Self::Thesis => 1.2,
            Self::Antarctic => 6.0,
            _ => 2.0,
        }
    }

    fn table(self) -> Option<&'static Table> {
        let index = match self {
            Self::None | Self::Thesis => return None,
            Self::ContinentalClean => 0,
            Self::ContinentalAverage => 1,
            Self::ContinentalPolluted => 2,
            Self::Urban => 3,
            Self::MaritimeClean => 4,
            Self::Desert => 5,
            Self::Antarctic => 6,
        };
        Some(&TABLES[index])
    }
}

/// Angstrom's law: extinction relative to 550 nm, (wavelength / 550 nm)^-exponent.
pub fn angstrom(wavelength_nm: f64, exponent: f64) -> f64 {
    (wavelength_nm / REFERENCE_NM).powf(-exponent)
}

struct Table {
    log_wavelengths: Vec<f64>,
    log_extinction: CubicSpline,
    albedo: CubicSpline,
    asymmetry: CubicSpline,
}

impl Table {
    fn relative_extinction(&self, wavelength_nm: f64) -> f64 {
        let nodes = &self.log_wavelengths;
        let last = nodes.len() - 1;
        let x = wavelength_nm.ln();
        let slope = |a: usize, b: usize| {
            (self.log_extinction.value(nodes[b]) - self.log_extinction.value(nodes[a])) / (nodes[b] - nodes[a])
        };
        let beyond = if x < nodes[0] {
            slope(0, 1) * (x - nodes[0])
        } else if x > nodes[last] {
            slope(last - 1, last) * (x - nodes[last])
        } else {
            0.0
        };
        (self.log_extinction.value(x) + beyond).exp()
    }
}

static TABLES: LazyLock<Vec<Table>> = LazyLock::new(|| {
    let [types, wavelengths, extinction, albedo, asymmetry] = columns(include_str!("../../data/aerosol_types.csv"));
    let rows = types.iter().filter(|&&number| number == 0.0).count();
    (0..types.len() / rows)
        .map(|number| {
            let range = number * rows..(number + 1) * rows;
            let wavelengths = &wavelengths[range.clone()];
            let log_wavelengths: Vec<f64> = wavelengths.iter().map(|w| w.ln()).collect();
            let log_extinction: Vec<f64> = extinction[range.clone()].iter().map(|e| e.ln()).collect();
            Table {
                log_extinction: CubicSpline::new(&log_wavelengths, &log_extinction),
                log_wavelengths,
                albedo: CubicSpline::new(wavelengths, &albedo[range.clone()]),
                asymmetry: CubicSpline::new(wavelengths, &asymmetry[range]),
            }
        })
        .collect()
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_those_of_opac_at_550_nm() {
        // checked against: Hess, Koepke & Schult 1998, table 4, 80 % humidity: single scattering albedo, asymmetry, Angstrom exponent
        // 500-800 nm
        let table = [
            (AerosolType::ContinentalClean, 0.972, 0.709, 1.42),
            (AerosolType::ContinentalAverage, 0.925, 0.703, 1.42),
            (AerosolType::ContinentalPolluted, 0.892, 0.698, 1.45),
            (AerosolType::Urban, 0.817, 0.689, 1.43),
            (AerosolType::MaritimeClean, 0.997, 0.772, 0.08),
            (AerosolType::Desert, 0.888, 0.729, 0.17),
            (AerosolType::Antarctic, 1.000, 0.784, 0.73),
        ];
        for (kind, albedo, asymmetry, exponent) in table {
            let optics = kind.optics(550.0);
            assert!((optics.relative_extinction - 1.0).abs() < 1e-4, "{}", kind.name());
            assert!((optics.single_scattering_albedo - albedo).abs() < 0.003, "{}: {optics:?}", kind.name());
            assert!((optics.asymmetry - asymmetry).abs() < 0.003, "{}: {optics:?}", kind.name());
            let ratio = kind.optics(800.0).relative_extinction / kind.optics(500.0).relative_extinction;
            assert!((-ratio.ln() / 1.6_f64.ln() - exponent).abs() < 0.03, "{}", kind.name());
        }
    }

    #[test]
    fn the_table_continues_without_a_step() {
        for kind in [AerosolType::Urban, AerosolType::Desert] {
            for edge in [350.0, 800.0] {
                let (below, above) = (kind.optics(edge - 1e-6), kind.optics(edge + 1e-6));
                assert!((below.relative_extinction / above.relative_extinction - 1.0).abs() < 1e-6);
            }
            assert!(kind.optics(950.0).relative_extinction < kind.optics(800.0).relative_extinction);
        }
    }

    #[test]
    fn the_haze_of_the_thesis_follows_its_exponent() {
        let ratio = AerosolType::Thesis.optics(400.0).relative_extinction / AerosolType::Thesis.optics(800.0).relative_extinction;
        assert!((ratio - 2.0_f64.powf(0.84)).abs() < 1e-12);
    }
}
