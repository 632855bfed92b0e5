//! The light of the planets: sunlight, coloured by their geometric albedo.
//!
//! E(lambda) = C p(lambda) E_sun(lambda), C such that the magnitude is V. p: geometric albedo in the bands U, B, V, Rc, R, Ic, I
//! of Mallama, Krobusek & Pavlov 2017 (Icarus 282, 19, table 7), at their effective wavelengths, linear between them; Rc and R
//! are averaged. The change of colour with the phase angle is left out (0.1 magnitudes of B - V for Mercury and Mars at large
//! phase angles).

use super::photometry::{V_ZERO_IRRADIANCE, v_band_mean};
use crate::ephemeris::Planet;
use crate::numerics::locate;
use crate::spectrum::solar;

/// Effective wavelengths of the bands U, B, V, mean of Rc and R, Ic, I [nm].
const BANDS_NM: [f64; 6] = [360.0, 436.0, 549.0, 670.0, 798.0, 900.0];

/// Geometric albedos in those bands.
const fn albedos(planet: Planet) -> [f64; 6] {
    match planet {
        Planet::Mercury => [0.087, 0.105, 0.142, 0.165, 0.180, 0.208],
        Planet::Venus => [0.348, 0.658, 0.689, 0.683, 0.640, 0.584],
        Planet::Mars => [0.060, 0.088, 0.170, 0.269, 0.285, 0.330],
        Planet::Jupiter => [0.358, 0.443, 0.538, 0.504, 0.389, 0.321],
        Planet::Saturn => [0.203, 0.339, 0.499, 0.607, 0.543, 0.423],
        Planet::Uranus => [0.502, 0.561, 0.488, 0.233, 0.089, 0.079],
        Planet::Neptune => [0.578, 0.562, 0.442, 0.204, 0.072, 0.067],
    }
}

/// Geometric albedo of `planet` at `wavelength_nm`; the end values outside 360 to 900 nm.
pub fn geometric_albedo(planet: Planet, wavelength_nm: f64) -> f64 {
    let albedos = albedos(planet);
    let (band, share) = locate(&BANDS_NM, wavelength_nm);
    albedos[band] + share * (albedos[band + 1] - albedos[band])
}

/// Spectral irradiance outside the air of `planet` at magnitude `v_magnitude`, at `wavelengths_nm` (means over 10 nm) [W m-2
/// nm-1].
pub fn planet_irradiance(planet: Planet, v_magnitude: f64, wavelengths_nm: &[f64]) -> Vec<f64> {
    let sunlight = |wavelength: f64| solar::irradiance(wavelength, solar::BAND_WIDTH_NM) * geometric_albedo(planet, wavelength);
    let scale = 10f64.powf(-0.4 * v_magnitude) * V_ZERO_IRRADIANCE / v_band_mean(sunlight);
    wavelengths_nm.iter().map(|&wavelength| scale * sunlight(wavelength)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::photometry::v_magnitude;
    use super::*;

    #[test]
    fn the_magnitude_comes_out_again() {
        for planet in Planet::ALL {
            let v = v_magnitude(|w| planet_irradiance(planet, -2.5, &[w])[0]);
            assert!((v + 2.5).abs() < 1e-9, "{}: {v}", planet.name());
        }
    }

    #[test]
    fn colours_are_the_published_ones() {
        // checked against: B - V of Allen's Astrophysical Quantities (2000), table 12.10; Sun 0.653 (Ramirez et al. 2012)
        for (planet, b_minus_v) in [
            (Planet::Mercury, 0.97),
            (Planet::Mars, 1.36),
            (Planet::Jupiter, 0.83),
            (Planet::Saturn, 1.04),
            (Planet::Uranus, 0.56),
            (Planet::Neptune, 0.41),
        ] {
            let got = 0.653 + 2.5 * (geometric_albedo(planet, 549.0) / geometric_albedo(planet, 436.0)).log10();
            assert!((got - b_minus_v).abs() < 0.07, "{}: {got}", planet.name());
        }
    }
}
