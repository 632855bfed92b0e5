//! The ground's Lambertian albedo by wavelength.
//!
//! The presets are rounded, representative values chosen for this project (whole surfaces as the sky sees them, not close-ups);
//! none is a measurement of one place. Snow is clean and fresh (0.96 to 0.98 in the visible by Grenfell, Warren & Mullen, J. Geophys.
//! Res. 99, 18669 (1994), less a little dust); the sea is a wind-roughened surface under a whole sky, about 0.06, and blue water.

use crate::error::{Error, Result, check_range};
use crate::numerics::CubicSpline;
use crate::parameter::{Checked, Parameter};
use crate::words::words;
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Wavelengths of the presets [nm].
const WAVELENGTHS_NM: [f64; 12] = [380.0, 430.0, 480.0, 520.0, 550.0, 580.0, 620.0, 670.0, 690.0, 710.0, 740.0, 800.0];

/// A kind of ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Surface {
    /// A meadow.
    #[default]
    Grass,
    /// A wood from above, with its shadows.
    Forest,
    /// Bare dry earth.
    Soil,
    /// Pale sand.
    Desert,
    /// Clean fresh snow.
    Snow,
    /// The open sea.
    Sea,
    /// A city: roofs, streets, some trees.
    City,
    /// Worn asphalt.
    Asphalt,
}

words!(Surface, "ground", {
    Grass => "grass",
    Forest => "forest",
    Soil => "soil",
    Desert => "desert",
    Snow => "snow",
    Sea => "sea",
    City => "city",
    Asphalt => "asphalt",
});

impl Surface {
    /// Albedo at `wavelength_nm` (0 to 1); the end values are kept outside 380 to 800 nm.
    pub fn albedo(self, wavelength_nm: f64) -> f64 {
        CubicSpline::new(&WAVELENGTHS_NM, &self.values()).value(wavelength_nm).clamp(0.0, 1.0)
    }

    fn values(self) -> [f64; 12] {
        match self {
            Self::Grass => [0.030, 0.035, 0.042, 0.065, 0.100, 0.080, 0.058, 0.042, 0.060, 0.150, 0.350, 0.450],
            Self::Forest => [0.020, 0.022, 0.025, 0.038, 0.055, 0.045, 0.035, 0.028, 0.038, 0.090, 0.210, 0.290],
            Self::Soil => [0.055, 0.070, 0.090, 0.110, 0.130, 0.155, 0.180, 0.205, 0.212, 0.220, 0.230, 0.250],
            Self::Desert => [0.120, 0.150, 0.200, 0.250, 0.290, 0.340, 0.380, 0.410, 0.420, 0.430, 0.440, 0.460],
            Self::Snow => [0.940, 0.950, 0.955, 0.955, 0.950, 0.945, 0.935, 0.920, 0.910, 0.905, 0.890, 0.870],
            Self::Sea => [0.085, 0.080, 0.075, 0.068, 0.064, 0.061, 0.060, 0.060, 0.060, 0.060, 0.060, 0.060],
            Self::City => [0.085, 0.095, 0.105, 0.115, 0.125, 0.130, 0.140, 0.145, 0.150, 0.155, 0.160, 0.175],
            Self::Asphalt => [0.070, 0.075, 0.082, 0.088, 0.092, 0.096, 0.100, 0.105, 0.107, 0.109, 0.112, 0.118],
        }
    }
}

/// What the ground is: a preset, or one albedo for all wavelengths. In JSON a word or a number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "WordOrNumber", into = "WordOrNumber")]
pub enum Ground {
    /// A spectral preset.
    Surface(Surface),
    /// The same albedo (0 to 1) at all wavelengths.
    Albedo(f64),
}

impl Default for Ground {
    fn default() -> Self {
        Self::Surface(Surface::default())
    }
}

impl Ground {
    /// Albedo at each of `wavelengths_nm` (0 to 1).
    pub fn albedo(self, wavelengths_nm: &[f64]) -> Vec<f64> {
        match self {
            Self::Surface(surface) => wavelengths_nm.iter().map(|&wavelength| surface.albedo(wavelength)).collect(),
            Self::Albedo(albedo) => vec![albedo; wavelengths_nm.len()],
        }
    }

    /// Checks a number's range.
    ///
    /// # Errors
    /// [`Error::Input`] for `ground`.
    pub fn validate(self) -> Result<()> {
        match self {
            Self::Surface(_) => Ok(()),
            Self::Albedo(albedo) => check_range("ground", albedo, 0.0, 1.0, "").map(|_| ()),
        }
    }
}

impl Checked for Ground {
    fn check(&self, row: &Parameter, name: &str) -> Result<()> {
        match self {
            Self::Surface(_) => Ok(()),
            Self::Albedo(albedo) => albedo.check(row, name),
        }
    }
}

impl FromStr for Ground {
    type Err = Error;

    /// Reads a preset's name or a number.
    fn from_str(text: &str) -> Result<Self> {
        let ground = match text.parse() {
            Ok(albedo) => Self::Albedo(albedo),
            Err(_) => Self::Surface(text.parse()?),
        };
        ground.validate()?;
        Ok(ground)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "ground must be a name such as \"grass\" or a number from 0 to 1")]
enum WordOrNumber {
    Number(f64),
    Word(String),
}

impl TryFrom<WordOrNumber> for Ground {
    type Error = Error;

    fn try_from(value: WordOrNumber) -> Result<Self> {
        let ground = match value {
            WordOrNumber::Number(albedo) => Self::Albedo(albedo),
            WordOrNumber::Word(word) => Self::Surface(word.parse()?),
        };
        ground.validate()?;
        Ok(ground)
    }
}

impl From<Ground> for WordOrNumber {
    fn from(ground: Ground) -> Self {
        match ground {
            Ground::Surface(surface) => Self::Word(surface.name().to_owned()),
            Ground::Albedo(albedo) => Self::Number(albedo),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_stay_albedos_between_their_values() {
        for surface in Surface::ALL {
            for wavelength in (300..=1000).step_by(5) {
                let spline = CubicSpline::new(&WAVELENGTHS_NM, &surface.values()).value(f64::from(wavelength));
                assert!((0.015..0.97).contains(&spline), "{} at {wavelength} nm: {spline}", surface.name());
            }
        }
        let grass = Surface::Grass;
        assert!(grass.albedo(550.0) > grass.albedo(450.0) && grass.albedo(550.0) > grass.albedo(670.0));
        assert!(Surface::Sea.albedo(450.0) > Surface::Sea.albedo(650.0));
    }

    #[test]
    fn a_word_or_a_number_is_read_and_written() {
        for (text, ground) in [("\"snow\"", Ground::Surface(Surface::Snow)), ("0.25", Ground::Albedo(0.25))] {
            assert_eq!(serde_json::from_str::<Ground>(text).unwrap(), ground);
            assert_eq!(serde_json::to_string(&ground).unwrap(), text);
        }
        assert_eq!("0.3".parse::<Ground>().unwrap().albedo(&[400.0, 500.0]), [0.3, 0.3]);
        for (text, start) in
            [("1.5", "ground = 1.5: must be"), ("\"moss\"", "ground = \"moss\": must be"), ("[1]", "ground must be")]
        {
            let message = serde_json::from_str::<Ground>(text).unwrap_err().to_string();
            assert!(message.starts_with(start), "{message}");
        }
        assert!("NaN".parse::<Ground>().is_err());
    }
}
