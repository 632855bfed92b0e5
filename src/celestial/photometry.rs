//! Photometry of the night: magnitudes, surface brightness, S10(V), and how spectral lines are put on a grid of wavelengths.
//!
//! V = -2.5 log10(F / F_0), F = integral of E(lambda) V(lambda) lambda d lambda / integral of V(lambda) lambda d lambda,
//!
//! E: irradiance [W m-2 nm-1]; V(lambda): passband (Bessell 1990, PASP 102, 1181, table 2); lambda: counts photons; F_0 =
//! 3.631e-11 W m-2 nm-1 (Bessell, Castelli & Plez 1998, A&A 333, 231, table A2).
//! Illuminance of a star of V = 0: 2.54e-6 lx (Allen, Astrophysical Quantities); its luminance spread over a square
//! arcsecond or, for V = 10, over a square degree gives the conversions of surface brightness.

use crate::spectrum::observer;
use crate::units::LUMINOUS_EFFICACY;
use std::f64::consts::PI;

/// Mean irradiance in the V band of a star of V = 0 [W m-2 nm-1].
pub const V_ZERO_IRRADIANCE: f64 = 3.631e-11;

/// Illuminance outside the air of a star of V = 0 [lx].
pub const V_ZERO_ILLUMINANCE: f64 = 2.54e-6;

/// Square degrees in a steradian.
pub const SQUARE_DEGREES_PER_STERADIAN: f64 = (180.0 / PI) * (180.0 / PI);

/// Luminance of 1 S10(V), a star of V = 10 in each square degree [cd m-2]: 0.834e-6.
pub const S10_LUMINANCE: f64 = 1e-4 * V_ZERO_ILLUMINANCE * SQUARE_DEGREES_PER_STERADIAN;

/// Luminance of 0 magnitudes per square arcsecond [cd m-2]: 1.08e5.
pub const ZERO_MAGNITUDE_PER_ARCSECOND2_LUMINANCE: f64 = V_ZERO_ILLUMINANCE * SQUARE_DEGREES_PER_STERADIAN * 3600.0 * 3600.0;

const V_BAND_START_NM: f64 = 470.0;

#[rustfmt::skip]
const V_BAND: [f64; 24] = [
    0.0, 0.030, 0.163, 0.458, 0.780, 0.967, 1.0, 0.973, 0.898, 0.792, 0.684, 0.574,
    0.461, 0.359, 0.270, 0.197, 0.135, 0.081, 0.045, 0.025, 0.017, 0.013, 0.009, 0.0,
];

/// Luminance of a surface of `magnitude` per square arcsecond in V [cd m-2].
pub fn luminance_of_surface_brightness(magnitude: f64) -> f64 {
    ZERO_MAGNITUDE_PER_ARCSECOND2_LUMINANCE * 10f64.powf(-0.4 * magnitude)
}

/// Surface brightness in V of a luminance [cd m-2], in magnitudes per square arcsecond.
pub fn surface_brightness_of_luminance(luminance: f64) -> f64 {
    -2.5 * (luminance / ZERO_MAGNITUDE_PER_ARCSECOND2_LUMINANCE).log10()
}

/// Magnitude V of `irradiance`, a function of the wavelength [nm] in W m-2 nm-1, at steps of 2 nm.
pub fn v_magnitude(irradiance: impl Fn(f64) -> f64) -> f64 {
    -2.5 * (v_band_mean(irradiance) / V_ZERO_IRRADIANCE).log10()
}

/// Mean of `spectrum` (a function of the wavelength [nm]) in the V band, weighted by photons.
pub fn v_band_mean(spectrum: impl Fn(f64) -> f64) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for step in 0..=115 {
        let wavelength = V_BAND_START_NM + 2.0 * f64::from(step);
        let weight = v_band(wavelength) * wavelength;
        sum += weight * spectrum(wavelength);
        weights += weight;
    }
    sum / weights
}

/// Response of the V band at `wavelength_nm`, 1 at 530 nm, linear between the 10 nm steps of the table.
pub fn v_band(wavelength_nm: f64) -> f64 {
    interpolated(&V_BAND, (wavelength_nm - V_BAND_START_NM) / 10.0).unwrap_or(0.0)
}

/// Linear interpolation in `values` at a fractional index, none outside.
pub(super) fn interpolated(values: &[f64], position: f64) -> Option<f64> {
    let last = values.len() - 1;
    if !(0.0..=last as f64).contains(&position) {
        return None;
    }
    let left = (position as usize).min(last.saturating_sub(1));
    let fraction = position - left as f64;
    Some(values[left] + fraction * (values[(left + 1).min(last)] - values[left]))
}

/// Whole nanometres of the standard observer.
pub(super) fn visible_nm() -> impl Iterator<Item = f64> {
    (observer::RANGE_NM.0..=observer::RANGE_NM.1).map(f64::from)
}

/// Luminous quantity (cd m-2 from W m-2 sr-1 nm-1, lx from W m-2 nm-1) of a spectrum given at [`visible_nm`].
pub(super) fn luminous(spectrum: &[f64]) -> f64 {
    let sum: f64 = visible_nm().zip(spectrum).map(|(w, value)| value * observer::matching_functions(w)[1]).sum();
    sum * LUMINOUS_EFFICACY
}

/// Adds a line of `power` at `line_nm` to `spectrum` (power per nm at `wavelengths_nm`, ascending).
///
/// The line is shared between the two neighbouring wavelengths by its distance and divided by the width of their cells (half way
/// to each neighbour), so that sums over the grid keep its energy and its mean wavelength. Left out if it lies outside the grid;
/// on a grid of one wavelength the cell is taken as 10 nm wide.
pub fn add_line(spectrum: &mut [f64], wavelengths_nm: &[f64], line_nm: f64, power: f64) {
    let last = wavelengths_nm.len() - 1;
    if last == 0 {
        if (line_nm - wavelengths_nm[0]).abs() <= 5.0 {
            spectrum[0] += power / 10.0;
        }
        return;
    }
    if !(wavelengths_nm[0]..=wavelengths_nm[last]).contains(&line_nm) {
        return;
    }
    let right = wavelengths_nm.partition_point(|&w| w <= line_nm).clamp(1, last);
    let left = right - 1;
    let fraction = (line_nm - wavelengths_nm[left]) / (wavelengths_nm[right] - wavelengths_nm[left]);
    let cell = |i: usize| 0.5 * (wavelengths_nm[(i + 1).min(last)] - wavelengths_nm[i.saturating_sub(1)]);
    spectrum[left] += power * (1.0 - fraction) / cell(left);
    spectrum[right] += power * fraction / cell(right);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{solar, wavelengths, xyz_weights};

    #[test]
    fn the_sun_has_its_magnitude() {
        // checked against: Willmer 2018, ApJS 236, 47, table 3: V of the Sun -26.76 (Vega system, Johnson V -26.76)
        let sun = v_magnitude(|w| solar::irradiance(w, 2.0));
        assert!((sun + 26.76).abs() < 0.02, "{sun}");
    }

    #[test]
    fn units_of_surface_brightness_agree() {
        // checked against: by definition 1 S10(V) is 10 + 2.5 log10(3600^2) = 27.78 magnitudes per square arcsecond
        assert!((surface_brightness_of_luminance(S10_LUMINANCE) - 27.78).abs() < 0.005);
        // checked against: Garstang 1986, PASP 98, 364: L = 34.08 exp(20.7233 - 0.92104 V) nanolambert; 1 nL = 1e-5 / pi cd m-2
        let garstang = 34.08 * (20.7233f64 - 0.92104 * 22.0).exp() * 1e-5 / PI;
        assert!((luminance_of_surface_brightness(22.0) / garstang - 1.0).abs() < 0.01, "{garstang}");
        assert!((surface_brightness_of_luminance(luminance_of_surface_brightness(21.3)) - 21.3).abs() < 1e-12);
    }

    #[test]
    fn a_line_keeps_energy_and_colour_on_any_grid() {
        for count in [16, 32, 64] {
            let grid = wavelengths(count);
            let weights = xyz_weights(&grid, |_| 1.0);
            for line in [430.2, 557.7, 589.3, 630.0] {
                let mut spectrum = vec![0.0; count];
                add_line(&mut spectrum, &grid, line, 2.0);
                let y: f64 = spectrum.iter().zip(&weights).map(|(s, w)| s * w[1]).sum();
                let expected = 2.0 * observer::matching_functions(line)[1];
                // The curvature of ybar over a cell is what linear sharing loses.
                let allowed = if count == 16 { 0.08 } else { 0.02 };
                assert!((y / expected - 1.0).abs() < allowed || (y - expected).abs() < 0.004, "{count}, {line}: {y} {expected}");
            }
        }
        let mut outside = vec![0.0; 2];
        add_line(&mut outside, &[400.0, 500.0], 557.7, 1.0);
        assert_eq!(outside, [0.0, 0.0]);
    }
}
