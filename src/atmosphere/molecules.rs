//! Scattering by the air's molecules.
//!
//! sigma = 24 pi^3 (n^2 - 1)^2 / (lambda^4 N_s^2 (n^2 + 2)^2) F
//!
//! sigma: cross-section of one molecule [m2]; lambda: wavelength [m]; n: refractive index of dry air at 288.15 K and 1013.25 hPa
//! (Peck & Reeder 1972, eq. 2, corrected to 360 ppm of CO2); N_s: its number density [m-3]; F: King factor of air with 360 ppm of CO2.
//! Source: Bodhaine, Wood, Dutton & Slusser, J. Atmos. Oceanic Technol. 16, 1854 (1999), eqs. 4-6, 17-22.

use super::standard_atmosphere::StandardAtmosphere;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Number density of air at 288.15 K and 1013.25 hPa [m-3] (Bodhaine et al. 1999).
const STANDARD_DENSITY_PER_M3: f64 = 2.546_899e25;

/// Carbon dioxide in parts per volume. 420 ppm instead changes the cross-section by 7e-5.
const CARBON_DIOXIDE: f64 = 360e-6;

/// n - 1 of dry air at 288.15 K and 1013.25 hPa at `wavelength_nm`; the formula holds from 230 to 1690 nm.
pub fn standard_refractivity(wavelength_nm: f64) -> f64 {
    let wavenumber_squared = (1000.0 / wavelength_nm).powi(2);
    let at_300_ppm = 8_060.51 + 2_480_990.0 / (132.274 - wavenumber_squared) + 17_455.7 / (39.329_57 - wavenumber_squared);
    at_300_ppm * 1e-8 * (1.0 + 0.54 * (CARBON_DIOXIDE - 300e-6))
}

/// n - 1 of the air of the US Standard Atmosphere 1976 at `altitude_m` above sea level: proportional to the number density.
pub fn refractivity(altitude_m: f64, wavelength_nm: f64) -> f64 {
    refractivity_in(StandardAtmosphere::UsStandard1976, altitude_m, wavelength_nm)
}

/// n - 1 of the air of `atmosphere` at `altitude_m` above sea level.
pub fn refractivity_in(atmosphere: StandardAtmosphere, altitude_m: f64, wavelength_nm: f64) -> f64 {
    standard_refractivity(wavelength_nm) * atmosphere.number_density_per_m3(altitude_m / 1000.0) / STANDARD_DENSITY_PER_M3
}

/// King factor F = (6 + 3 d) / (6 - 7 d) of air, d its depolarisation ratio.
pub fn king_factor(wavelength_nm: f64) -> f64 {
    let inverse_square = (1000.0 / wavelength_nm).powi(2);
    let nitrogen = 1.034 + 3.17e-4 * inverse_square;
    let oxygen = 1.096 + 1.385e-3 * inverse_square + 1.448e-4 * inverse_square * inverse_square;
    let dioxide_percent = CARBON_DIOXIDE * 100.0;
    (78.084 * nitrogen + 20.946 * oxygen + 0.934 + dioxide_percent * 1.15) / (78.084 + 20.946 + 0.934 + dioxide_percent)
}

/// Depolarisation ratio of natural light, d = 6 (F - 1) / (3 + 7 F).
pub fn depolarisation(wavelength_nm: f64) -> f64 {
    let king = king_factor(wavelength_nm);
    6.0 * (king - 1.0) / (3.0 + 7.0 * king)
}

/// Scattering cross-section of one molecule of air [m2].
pub fn cross_section_m2(wavelength_nm: f64) -> f64 {
    let index_squared = (1.0 + standard_refractivity(wavelength_nm)).powi(2);
    let lorentz = (index_squared - 1.0) / (index_squared + 2.0);
    let wavelength_m = wavelength_nm * 1e-9;
    24.0 * PI.powi(3) * lorentz.powi(2) / (wavelength_m.powi(4) * STANDARD_DENSITY_PER_M3.powi(2)) * king_factor(wavelength_nm)
}

/// Vertical optical depth of the molecules of the US Standard Atmosphere 1976 above sea level.
pub fn sea_level_optical_depth(wavelength_nm: f64) -> f64 {
    static COLUMN_PER_M2: LazyLock<f64> = LazyLock::new(|| StandardAtmosphere::UsStandard1976.column_per_m2());
    cross_section_m2(wavelength_nm) * *COLUMN_PER_M2
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(got: f64, expected: f64, relative: f64) {
        assert!((got / expected - 1.0).abs() < relative, "{got} is not {expected}");
    }

    #[test]
    fn published_values_at_550_nm() {
        // checked against: Peck & Reeder 1972 (300 ppm of CO2) 2.77823e-4; the correction to 360 ppm is 3e-5 of it
        close(standard_refractivity(550.0), 2.77823e-4, 4e-5);
        // checked against: Bodhaine et al. 1999, King factor 1.04881 and table 3, cross-section 4.5102e-27 cm2
        close(king_factor(550.0), 1.04881, 1e-5);
        close(cross_section_m2(550.0), 4.5102e-31, 2e-4);
        close((6.0 + 3.0 * depolarisation(550.0)) / (6.0 - 7.0 * depolarisation(550.0)), king_factor(550.0), 1e-12);
    }

    #[test]
    fn published_optical_depths_at_sea_level() {
        // checked against: Bodhaine et al. 1999, table 3 (sea level, 45 degrees north)
        for (wavelength, depth) in [(400.0, 0.360_52), (550.0, 0.097_15), (700.0, 0.036_46)] {
            close(sea_level_optical_depth(wavelength), depth, 1.5e-3);
        }
    }

    #[test]
    fn refractivity_follows_the_density() {
        close(refractivity(0.0, 550.0), standard_refractivity(550.0), 1e-4);
        let (ground, high) = (refractivity(0.0, 550.0), refractivity(8000.0, 550.0));
        let us = StandardAtmosphere::UsStandard1976;
        close(high / ground, us.number_density_per_m3(8.0) / us.number_density_per_m3(0.0), 1e-12);
    }
}
