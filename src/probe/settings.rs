//! What a probe is asked to be.

use crate::error::{Error, Result, check_range};
use crate::spectrum::{ColorSpace, Gamut};
use crate::units::Scale;
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// Least width of a probe [pixels].
pub const MIN_WIDTH: usize = 64;
/// Greatest width of a probe [pixels].
pub const MAX_WIDTH: usize = 16384;

/// How directions are laid out in the image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Projection {
    /// Longitude along x, latitude along y; see [`LatLong`](super::LatLong).
    #[default]
    LatLong,
    /// Equidistant fisheye, zenith in the centre; see [`Fisheye`](super::Fisheye).
    Fisheye,
}

/// Where the rows of a latitude-longitude image lie; a fisheye image has no such choice and ignores it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rows {
    /// Zenith angle of row j is pi (j + 0.5) / H: Blender and most viewers.
    #[default]
    Centre,
    /// Zenith angle of row j is pi j / (H - 1), the first and last rows are the poles: Mitsuba.
    Corner,
}

/// How much of the sphere the image holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Extent {
    /// The whole sphere.
    #[default]
    Full,
    /// The half above the horizontal plane.
    Upper,
}

/// What is seen below the true horizon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum GroundView {
    /// The ground as the light shows it.
    #[default]
    On,
    /// Black below the true horizon.
    Off,
    /// The smooth sky of the upper half, flipped about the horizontal plane. Discs are not mirrored: they would light scenes
    /// from below.
    Mirrored,
}

macro_rules! names {
    ($type:ident, $parameter:literal, $allowed:literal, $($name:literal => $value:ident),+) => {
        impl $type {
            /// The name that users write.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$value => $name),+ }
            }
        }

        impl FromStr for $type {
            type Err = Error;

            fn from_str(text: &str) -> Result<Self> {
                match text {
                    $($name => Ok(Self::$value),)+
                    _ => Err(Error::input($parameter, format!("{text:?}"), $allowed)),
                }
            }
        }
    };
}

names!(Projection, "projection", "latlong or fisheye", "latlong" => LatLong, "fisheye" => Fisheye);
names!(Rows, "rows", "centre or corner", "centre" => Centre, "corner" => Corner);
names!(Extent, "extent", "full or upper", "full" => Full, "upper" => Upper);
names!(GroundView, "ground", "on, off or mirrored", "on" => On, "off" => Off, "mirrored" => Mirrored);

/// All that describes a probe apart from the light itself. The keys are the same in JSON.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ProbeSettings {
    /// Width [pixels]: even, [`MIN_WIDTH`] to [`MAX_WIDTH`]; a multiple of four for the upper half of a latitude-longitude image,
    /// which is 4:1. The height follows.
    pub width: usize,
    /// How directions are laid out.
    pub projection: Projection,
    /// Where the rows of a latitude-longitude image lie.
    pub rows: Rows,
    /// The whole sphere or its upper half.
    pub extent: Extent,
    /// How far the sky in the image is turned clockwise as seen from above, -360 to 360 [degrees]: what stands at an azimuth is drawn where azimuth + turn would be,
    /// in a latitude-longitude image turn / 360 of the width further right. Directions, such as the Sun's azimuth, stay those of the world.
    #[serde(skip_serializing_if = "is_zero")]
    pub turn_deg: f64,
    /// What is seen below the horizon.
    pub ground: GroundView,
    /// Whether the Sun's disc is drawn.
    pub sun_disc: bool,
    /// Whether the Moon's disc is drawn; planets and stars always are.
    pub moon_disc: bool,
    /// What the number 1.0 stands for.
    pub scale: Scale,
    /// The colour space of the pixels.
    pub color_space: ColorSpace,
    /// What happens to colours outside that space.
    pub gamut: Gamut,
}

impl Default for ProbeSettings {
    fn default() -> Self {
        Self {
            width: 2048,
            projection: Projection::default(),
            rows: Rows::default(),
            extent: Extent::default(),
            turn_deg: 0.0,
            ground: GroundView::default(),
            sun_disc: true,
            moon_disc: true,
            scale: Scale::default(),
            color_space: ColorSpace::default(),
            gamut: Gamut::default(),
        }
    }
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl ProbeSettings {
    /// The turn that brings an azimuth into the middle of a latitude-longitude image [degrees], -180 to 180.
    ///
    /// # Errors
    /// [`Error::Input`] for `centre` outside -360 to 360 degrees.
    pub fn turn_to_centre(azimuth_deg: f64) -> Result<f64> {
        check_range("centre", azimuth_deg, -360.0, 360.0, "degrees")?;
        let turn = (90.0 - azimuth_deg).rem_euclid(360.0);
        Ok(if turn > 180.0 { turn - 360.0 } else { turn })
    }

    /// Height of the image [pixels]: width for a fisheye; for latitude-longitude half of the width, or a quarter for the upper half.
    pub fn height(&self) -> usize {
        match (self.projection, self.extent) {
            (Projection::Fisheye, _) => self.width,
            (Projection::LatLong, Extent::Full) => self.width / 2,
            (Projection::LatLong, Extent::Upper) => self.width / 4,
        }
    }

    /// Checks that an image of these settings can be made.
    ///
    /// # Errors
    /// [`Error::Input`] that names the width, if it is out of range or does not divide into whole rows, or the turn, if it is out of range.
    pub fn validate(&self) -> Result<()> {
        check_range("turn_deg", self.turn_deg, -360.0, 360.0, "degrees")?;
        check_range("width", self.width as f64, MIN_WIDTH as f64, MAX_WIDTH as f64, "pixels")?;
        if !self.width.is_multiple_of(2) {
            return Err(Error::input("width", self.width, "even"));
        }
        if self.projection == Projection::LatLong && self.extent == Extent::Upper && !self.width.is_multiple_of(4) {
            return Err(Error::input("width", self.width, "a multiple of 4 for the upper half (the image is 4:1)"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_that_cannot_be_are_refused_by_name() {
        let with = |width, extent| ProbeSettings { width, extent, ..Default::default() }.validate();
        assert!(with(64, Extent::Full).is_ok() && with(16384, Extent::Upper).is_ok() && with(66, Extent::Full).is_ok());
        for (width, extent) in
            [(0, Extent::Full), (62, Extent::Full), (65, Extent::Full), (16386, Extent::Full), (66, Extent::Upper)]
        {
            let message = with(width, extent).unwrap_err().to_string();
            assert!(message.starts_with(&format!("width = {width}: must be ")), "{message}");
        }
    }

    #[test]
    fn json_uses_lower_case_names_and_knows_its_keys() {
        let settings: ProbeSettings =
            serde_json::from_str(r#"{"rows": "corner", "ground": "mirrored", "projection": "fisheye"}"#).unwrap();
        assert_eq!(
            (settings.rows, settings.ground, settings.projection),
            (Rows::Corner, GroundView::Mirrored, Projection::Fisheye)
        );
        assert!(serde_json::from_str::<ProbeSettings>(r#"{"widht": 64}"#).is_err());
        let text = serde_json::to_string(&ProbeSettings::default()).unwrap();
        assert_eq!(serde_json::from_str::<ProbeSettings>(&text).unwrap(), ProbeSettings::default());
    }

    #[test]
    fn names_read_back() {
        for name in ["on", "off", "mirrored"] {
            assert_eq!(name.parse::<GroundView>().unwrap().name(), name);
        }
        assert_eq!("center".parse::<Rows>().unwrap_err().to_string(), "rows = \"center\": must be centre or corner");
    }
}
