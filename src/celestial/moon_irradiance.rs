//! The light of the whole Moon: ROLO (Kieffer & Stone, Astronomical Journal 129, 2887, 2005).
//!
//! ```text
//! ln A_k = sum a_ik g^i + sum b_jk Phi^(2j-1) + c1 phi + c2 theta + c3 Phi phi + c4 Phi theta
//!        + d1k exp(-g / p1) + d2k exp(-g / p2) + d3k cos((g - p3) / p4)                           (eq. 10)
//! E = A Omega / pi  E_sun  (1 au / Sun-Moon)^2 (384 400 km / observer-Moon)^2                     (eqs. 8, 9)
//! ```
//!
//! A_k: disc-equivalent reflectance in band k: the disc's mean of pi L / E_sun over all its solid angle Omega, dark part included. g: phase
//! angle (in radians with a, in degrees with d and p); Phi: selenographic longitude of the Sun, positive while the Moon
//! waxes (radians); theta, phi: selenographic latitude and longitude of the observer (degrees). Coefficients: the paper's, model 311g.
//! Some transcriptions have theta and phi exchanged in the terms of c; a map of the Moon, which a test in `moon_disc.rs` integrates,
//! decides for this form.
//!
//! The bands scatter by some per cent around a smooth spectrum, an error of their calibration. As in the paper, the
//! spectrum is that of Apollo 16 soil times (u + v lambda) fitted to the bands, here to those from 350 to 882 nm and for each
//! geometry. The paper adds 5 % of breccia 67455 to the soil; the fit takes up most of that.
//!
//! # Range
//! Measured from 1.55 to 97 degrees of phase. Towards 0 the formula is continued: 0 is 35 % brighter than 4 degrees, where
//! spacecraft saw more than 40 % (Buratti, Hillier & Wang 1996, Icarus 124, 490): V is -13.05 at 0, -12.89 at 1.55 degrees. Above 97
//! degrees A goes on as a uniform sphere under the disc function of `moon_reflectance.rs` with an exponential surface phase function
//! that keeps A and its slope continuous (colour and asymmetry stay those of 97 degrees). It passes within 0.25 mag of Allen's table up to 150 degrees, and 0 at 180.
//!
//! # Accuracy
//! 1 % relative; the absolute scale is uncertain by 5 to 10 % (the paper), and later measurements are brighter: Velikodsky et al. 2011
//! (Icarus 214, 30) by 13 %.

use super::moon_reflectance::uniform_disc;
use crate::ephemeris::MOON_RADIUS_KM;
use crate::error::{Result, check_range};

/// Distance for which the paper's solid angle of the Moon, 6.4177e-5 sr, holds [km].
pub const STANDARD_DISTANCE_KM: f64 = 384_400.0;

/// End of the range of phase angles that were measured [degrees].
pub const LARGEST_MEASURED_PHASE_DEG: f64 = 97.0;

struct Band {
    wavelength_nm: f64,
    a: [f64; 4],
    b: [f64; 3],
    d: [f64; 3],
}

const fn band(wavelength_nm: f64, a: [f64; 4], b: [f64; 3], d: [f64; 3]) -> Band {
    Band { wavelength_nm, a, b, d }
}

/// Coefficients by band up to 882 nm (the other eleven are infrared).
const BANDS: [Band; 21] = [
    band(350.0, [-2.67511, -1.78539, 0.50612, -0.25578], [0.03744, 0.00981, -0.00322], [0.34185, 0.01441, -0.01602]),
    band(355.1, [-2.71924, -1.74298, 0.44523, -0.23315], [0.03492, 0.01142, -0.00383], [0.33875, 0.01612, -0.00996]),
    band(405.0, [-2.35754, -1.72134, 0.40337, -0.21105], [0.03505, 0.01043, -0.00341], [0.35235, -0.03818, -0.00006]),
    band(412.3, [-2.34185, -1.74337, 0.42156, -0.21512], [0.03141, 0.01364, -0.00472], [0.36591, -0.05902, 0.00080]),
    band(414.4, [-2.43367, -1.72184, 0.43600, -0.22675], [0.03474, 0.01188, -0.00422], [0.35558, -0.03247, -0.00503]),
    band(441.6, [-2.31964, -1.72114, 0.37286, -0.19304], [0.03736, 0.01545, -0.00559], [0.37935, -0.09562, 0.00970]),
    band(465.8, [-2.35085, -1.66538, 0.41802, -0.22541], [0.04274, 0.01127, -0.00439], [0.33450, -0.02546, -0.00484]),
    band(475.0, [-2.28999, -1.63180, 0.36193, -0.20381], [0.04007, 0.01216, -0.00437], [0.33024, -0.03131, 0.00222]),
    band(486.9, [-2.23351, -1.68573, 0.37632, -0.19877], [0.03881, 0.01566, -0.00555], [0.36590, -0.08945, 0.00678]),
    band(544.0, [-2.13864, -1.60613, 0.27886, -0.16426], [0.03833, 0.01189, -0.00390], [0.37190, -0.10629, 0.01428]),
    band(549.1, [-2.10782, -1.66736, 0.41697, -0.22026], [0.03451, 0.01452, -0.00517], [0.36814, -0.09815, -0.00000]),
    band(553.8, [-2.12504, -1.65970, 0.38409, -0.20655], [0.04052, 0.01009, -0.00388], [0.37206, -0.10745, 0.00347]),
    band(665.1, [-1.88914, -1.58096, 0.30477, -0.17908], [0.04415, 0.00983, -0.00389], [0.37141, -0.13514, 0.01248]),
    band(693.1, [-1.89410, -1.58509, 0.28080, -0.16427], [0.04429, 0.00914, -0.00351], [0.39109, -0.17048, 0.01754]),
    band(703.6, [-1.92103, -1.60151, 0.36924, -0.20567], [0.04494, 0.00987, -0.00386], [0.37155, -0.13989, 0.00412]),
    band(745.3, [-1.86896, -1.57522, 0.33712, -0.19415], [0.03967, 0.01318, -0.00464], [0.36888, -0.14828, 0.00958]),
    band(763.7, [-1.85258, -1.47181, 0.14377, -0.11589], [0.04435, 0.02000, -0.00738], [0.39126, -0.16957, 0.03053]),
    band(774.8, [-1.80271, -1.59357, 0.36351, -0.20326], [0.04710, 0.01196, -0.00476], [0.36908, -0.16182, 0.00830]),
    band(865.3, [-1.74561, -1.58482, 0.35009, -0.19569], [0.04142, 0.01612, -0.00550], [0.39200, -0.18837, 0.00978]),
    band(872.6, [-1.76779, -1.60345, 0.37974, -0.20625], [0.04645, 0.01170, -0.00424], [0.39354, -0.19360, 0.00568]),
    band(882.0, [-1.73011, -1.61156, 0.36115, -0.19576], [0.04847, 0.01065, -0.00404], [0.40714, -0.21499, 0.01146]),
];

/// Coefficients of all bands: c in 1 / degree, p in degrees.
const C: [f64; 4] = [0.000_341_15, -0.001_342_5, 0.000_959_06, 0.000_662_29];
const P: [f64; 4] = [4.060_54, 12.8802, -30.5858, 16.7498];

/// Bidirectional reflectance (30, 0 degrees) of Apollo 16 soil 62231 (Pieters 1999, New Views of the Moon II, abstract 8025: RELAB
/// average) at 350, 375, ... 900 nm.
const SOIL_62231: [f64; 23] = [
    0.08815, 0.09605, 0.10331, 0.11075, 0.11740, 0.12432, 0.13049, 0.13636, 0.14196, 0.14713, 0.15204, 0.15715, 0.16168, 0.16601,
    0.17002, 0.17343, 0.17715, 0.17974, 0.18270, 0.18506, 0.18675, 0.18823, 0.18938,
];

/// The Moon as a whole, as it is lit and seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoonPhase {
    /// Angle at the Moon between Sun and observer, 0 (full) to 180 (new) [degrees].
    pub phase_angle_deg: f64,
    /// Selenographic longitude of the Sun, -180 to 180, positive while the Moon waxes [degrees].
    pub sun_longitude_deg: f64,
    /// Selenographic latitude of the observer [degrees].
    pub observer_latitude_deg: f64,
    /// Selenographic longitude of the observer [degrees].
    pub observer_longitude_deg: f64,
}

impl MoonPhase {
    /// Checks the ranges: phase 0 to 180, longitudes -180 to 180, latitude -90 to 90 degrees.
    pub fn validate(&self) -> Result<()> {
        check_range("phase_angle_deg", self.phase_angle_deg, 0.0, 180.0, "degrees")?;
        check_range("sun_longitude_deg", self.sun_longitude_deg, -180.0, 180.0, "degrees")?;
        check_range("observer_latitude_deg", self.observer_latitude_deg, -90.0, 90.0, "degrees")?;
        check_range("observer_longitude_deg", self.observer_longitude_deg, -180.0, 180.0, "degrees")?;
        Ok(())
    }

    /// The disc-equivalent reflectance A of this geometry, for all wavelengths.
    pub fn reflectance(&self) -> DiscReflectance {
        let limit = LARGEST_MEASURED_PHASE_DEG;
        let phase = self.phase_angle_deg.clamp(0.0, limit);
        let sun = self.sun_longitude_deg.clamp(-limit, limit);
        let measured = BANDS.each_ref().map(|band| self.band_reflectance(band, phase, sun));
        let mut fit = DiscReflectance::fit(&measured);
        if self.phase_angle_deg > limit {
            let beyond = continuation(self.phase_angle_deg.min(180.0));
            fit.level *= beyond;
            fit.slope *= beyond;
        }
        fit
    }

    /// Eq. 10 for one band at a phase angle and a longitude of the Sun [degrees].
    fn band_reflectance(&self, band: &Band, phase_deg: f64, sun_longitude_deg: f64) -> f64 {
        let (g, phi) = (phase_deg.to_radians(), sun_longitude_deg.to_radians());
        let (latitude, longitude) = (self.observer_latitude_deg, self.observer_longitude_deg);
        let phase = band.a.iter().rev().fold(0.0, |sum, a| sum * g + a);
        let asymmetry = phi * (band.b[0] + phi * phi * (band.b[1] + phi * phi * band.b[2]));
        let libration = C[0] * longitude + C[1] * latitude + phi * (C[2] * longitude + C[3] * latitude);
        let opposition = band.d[0] * (-phase_deg / P[0]).exp() + band.d[1] * (-phase_deg / P[1]).exp();
        (phase + asymmetry + libration + opposition + band.d[2] * ((phase_deg - P[2]) / P[3]).cos()).exp()
    }
}

/// Disc-equivalent reflectance by wavelength: Apollo soil times (level + slope (lambda - 600 nm)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscReflectance {
    level: f64,
    /// [nm-1].
    slope: f64,
}

/// Middle of the fit [nm].
const MIDDLE_NM: f64 = 600.0;

impl DiscReflectance {
    /// Least squares over the bands' ratios to the soil.
    fn fit(measured: &[f64; BANDS.len()]) -> Self {
        let (mut sum, mut first, mut second, mut value, mut moment) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (band, measured) in BANDS.iter().zip(measured) {
            let (x, y) = (band.wavelength_nm - MIDDLE_NM, measured / soil(band.wavelength_nm));
            sum += 1.0;
            first += x;
            second += x * x;
            value += y;
            moment += x * y;
        }
        let determinant = sum * second - first * first;
        Self { level: (second * value - first * moment) / determinant, slope: (sum * moment - first * value) / determinant }
    }

    /// A at `wavelength_nm`, 350 to 900 nm (that of the ends outside).
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let wavelength = wavelength_nm.clamp(350.0, 900.0);
        soil(wavelength) * (self.level + self.slope * (wavelength - MIDDLE_NM))
    }
}

/// Reflectance of the soil, 350 to 900 nm.
fn soil(wavelength_nm: f64) -> f64 {
    let position = ((wavelength_nm - 350.0) / 25.0).clamp(0.0, (SOIL_62231.len() - 1) as f64);
    let left = (position as usize).min(SOIL_62231.len() - 2);
    SOIL_62231[left] + (SOIL_62231[left + 1] - SOIL_62231[left]) * (position - left as f64)
}

/// Slope of ln A near 550 nm at 97 degrees, without the terms of the Sun's longitude [per degree].
fn slope_at_the_limit() -> f64 {
    let phase = |deg: f64| MoonPhase {
        phase_angle_deg: deg,
        sun_longitude_deg: 0.0,
        observer_latitude_deg: 0.0,
        observer_longitude_deg: 0.0,
    };
    let logarithm =
        |deg: f64| -> f64 { BANDS[9..12].iter().map(|band| phase(deg).band_reflectance(band, deg, 0.0).ln()).sum::<f64>() / 3.0 };
    logarithm(LARGEST_MEASURED_PHASE_DEG + 0.5) - logarithm(LARGEST_MEASURED_PHASE_DEG - 0.5)
}

/// A at a phase angle above 97 degrees over that at 97.
fn continuation(phase_deg: f64) -> f64 {
    use std::sync::LazyLock;
    // Of the surface: what the disc function does not explain.
    static STEEPNESS: LazyLock<f64> = LazyLock::new(|| {
        let limit = LARGEST_MEASURED_PHASE_DEG;
        slope_at_the_limit() - (uniform_disc((limit + 0.5).to_radians()) / uniform_disc((limit - 0.5).to_radians())).ln()
    });
    let limit = LARGEST_MEASURED_PHASE_DEG;
    uniform_disc(phase_deg.to_radians()) / uniform_disc(limit.to_radians()) * (*STEEPNESS * (phase_deg - limit)).exp()
}

/// Irradiance of the Moon outside the air divided by that of the Sun at 1 au, at `wavelength_nm`, on a surface that faces it.
pub fn irradiance_ratio(
    reflectance: &DiscReflectance,
    wavelength_nm: f64,
    observer_distance_km: f64,
    sun_distance_au: f64,
) -> f64 {
    let radius = MOON_RADIUS_KM / observer_distance_km;
    reflectance.at(wavelength_nm) * radius * radius / (sun_distance_au * sun_distance_au)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::{observer, solar};
    use crate::units::LUMINOUS_EFFICACY;

    fn phase(deg: f64) -> MoonPhase {
        MoonPhase { phase_angle_deg: deg.abs(), sun_longitude_deg: deg, observer_latitude_deg: 0.0, observer_longitude_deg: 0.0 }
    }

    /// Illuminance at the standard distances [lx].
    fn lux(phase: MoonPhase) -> f64 {
        let reflectance = phase.reflectance();
        (380..=780)
            .map(f64::from)
            .map(|w| {
                irradiance_ratio(&reflectance, w, STANDARD_DISTANCE_KM, 1.0)
                    * solar::irradiance(w, 1.0)
                    * observer::matching_functions(w)[1]
            })
            .sum::<f64>()
            * LUMINOUS_EFFICACY
    }

    /// V by illuminance, the Sun at 1 au being -26.76 (Willmer 2018).
    fn magnitude(lux: f64) -> f64 {
        -26.76 - 2.5 * (lux / 133_300.0).log10()
    }

    #[test]
    fn bands_are_those_of_the_paper_within_their_scatter() {
        // checked against: Kieffer & Stone 2005: the bands scatter by some 4 % around the smooth spectrum
        for deg in [5.0, 30.0, 60.0, 90.0] {
            let phase = phase(deg);
            let smooth = phase.reflectance();
            let residuals =
                BANDS.each_ref().map(|band| phase.band_reflectance(band, deg, deg) / smooth.at(band.wavelength_nm) - 1.0);
            let rms = (residuals.iter().map(|r| r * r).sum::<f64>() / residuals.len() as f64).sqrt();
            println!("{deg} deg: rms {:.3}, {residuals:.3?}", rms);
            assert!(rms < 0.045, "{deg}: {rms}");
        }
    }

    #[test]
    fn full_half_and_new() {
        for deg in [0.0, 1.55, 7.0, -7.0, 45.0, -45.0, 90.0, -90.0, 97.0, 120.0, 150.0, 170.0] {
            println!("{deg:6.2} deg: {:.5} lx, V {:.2}", lux(phase(deg)), magnitude(lux(phase(deg))));
        }
        // checked against: Kieffer & Stone 2005 as integrated for this project: 0.28 lx at 7, 0.10 to 0.11 at 45, 0.03 at 90 degrees
        let mean = |deg: f64| 0.5 * (lux(phase(deg)) + lux(phase(-deg)));
        assert!((mean(7.0) - 0.28).abs() < 0.01, "{}", mean(7.0));
        assert!((mean(45.0) - 0.105).abs() < 0.006, "{}", mean(45.0));
        assert!((mean(90.0) - 0.03).abs() < 0.003, "{}", mean(90.0));
        // checked against: Krisciunas & Schaefer 1991 after Allen: V = -12.73 + 0.026 g (linear part, without opposition effect)
        for deg in [7.0, 20.0, 40.0] {
            let allen = -12.73 + 0.026 * deg;
            assert!((magnitude(mean(deg)) - allen).abs() < 0.08, "{deg}: {} {allen}", magnitude(mean(deg)));
        }
    }

    #[test]
    fn the_waxing_moon_is_brighter() {
        for deg in [45.0, 60.0, 90.0] {
            let ratio = lux(phase(deg)) / lux(phase(-deg));
            println!("{deg}: {ratio}");
            assert!((1.07..1.17).contains(&ratio), "{deg}: {ratio}");
        }
    }

    #[test]
    fn the_crescent_fades_as_allen_says_and_to_nothing() {
        let limit = lux(phase(LARGEST_MEASURED_PHASE_DEG));
        let next = lux(phase(LARGEST_MEASURED_PHASE_DEG + 1e-6));
        assert!((next / limit - 1.0).abs() < 1e-6);
        // checked against: Allen, Astrophysical Quantities, phase law: magnitudes fainter than full, from 100 degrees (3.04) on
        let at_100 = magnitude(lux(phase(100.0)));
        for (deg, allen) in [(110.0, 3.48), (120.0, 3.93), (130.0, 4.44), (140.0, 5.07), (150.0, 5.9)] {
            let fainter = magnitude(lux(phase(deg))) - at_100;
            println!("{deg}: {fainter:.2}, Allen {:.2}", allen - 3.04);
            assert!((fainter - (allen - 3.04)).abs() < 0.25, "{deg}: {fainter}");
        }
        assert_eq!(lux(phase(180.0)), 0.0);
        let mut last = f64::INFINITY;
        for step in 0..=360 {
            let now = lux(phase(f64::from(step) * 0.5));
            assert!(now < last && now.is_finite());
            last = now;
        }
    }

    #[test]
    fn out_of_range_is_named() {
        assert!(phase(181.0).validate().unwrap_err().to_string().starts_with("phase_angle_deg = 181"));
        assert!(phase(f64::NAN).validate().is_err());
    }
}
