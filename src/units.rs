//! Unit policy and the few conversion constants that the whole crate shares.
//!
//! SI units throughout; wavelengths in nm; angles in degrees where a name ends in `_deg` and in radians elsewhere;
//! altitudes of the atmosphere in km (names end in `_km`), heights of observers in m (names end in `_m`).
//! Spectral radiance in W m-2 sr-1 nm-1, spectral irradiance in W m-2 nm-1.

use crate::words::words;
use serde::{Deserialize, Serialize};

/// Maximum luminous efficacy of radiation, CIE 1931 observer [lm W-1] (CIE 018:2019; 683.002 by the 2019 SI definition at 540 THz).
pub const LUMINOUS_EFFICACY: f64 = 683.0;

/// Integral of the CIE 1931 colour matching function ybar over wavelength [nm].
pub const Y_INTEGRAL_NM: f64 = 106.857;

/// Astronomical unit [km] (IAU 2012 resolution B2).
pub const ASTRONOMICAL_UNIT_KM: f64 = 149_597_870.7;

/// Nominal solar radius [km] (IAU 2015 resolution B3).
pub const SOLAR_RADIUS_KM: f64 = 695_700.0;

/// Mean radius of the Earth [km] (IUGG).
pub const EARTH_RADIUS_KM: f64 = 6_371.0;

/// What the number 1.0 in a picture stands for.
///
/// XYZ values inside the crate are integrals of spectral radiance times the colour matching functions over wavelength;
/// a scale multiplies all three by [`Scale::factor`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Scale {
    /// Y = luminance / 683 lm W-1 [W m-2 sr-1]: what Blender's own physical sky gives.
    #[default]
    Blender,
    /// Y = mean of spectral radiance weighted by ybar [W m-2 sr-1 nm-1]: what Mitsuba's `sunsky` gives.
    Mitsuba,
    /// Y = luminance [cd m-2].
    Luminance,
}

words!(Scale, "scale", { Blender => "blender", Mitsuba => "mitsuba", Luminance => "luminance" });

impl Scale {
    /// Factor that turns an integral over wavelength [W m-2 sr-1] into this scale.
    pub const fn factor(self) -> f64 {
        match self {
            Self::Blender => 1.0,
            Self::Mitsuba => 1.0 / Y_INTEGRAL_NM,
            Self::Luminance => LUMINOUS_EFFICACY,
        }
    }

    /// Luminance of Y = 1 in this scale [cd m-2].
    pub const fn white_luminance(self) -> f64 {
        LUMINOUS_EFFICACY / self.factor()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scale_says_the_same_luminance() {
        for scale in Scale::ALL {
            let y = 100.0 / LUMINOUS_EFFICACY * scale.factor();
            assert!((y * scale.white_luminance() - 100.0).abs() < 1e-12);
        }
    }

    #[test]
    fn names_are_the_same_in_text_and_json() {
        for scale in Scale::ALL {
            assert_eq!(scale.name().parse::<Scale>().unwrap(), scale);
            assert_eq!(serde_json::to_string(&scale).unwrap(), format!("\"{scale}\""));
        }
        let message = "Blender".parse::<Scale>().unwrap_err().to_string();
        assert_eq!(message, "scale = \"Blender\": must be blender, mitsuba or luminance");
    }
}
