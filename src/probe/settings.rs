//! What a probe is asked to be.

use crate::error::{Result, check_range};
use crate::parameter::parameters;
use crate::projection::{Extent, Grid, Projection, Rows, View};
use crate::spectrum::{ColorSpace, Gamut};
use crate::units::Scale;
use crate::words::{Words, words};
use serde::{Deserialize, Serialize};

/// Least width of a probe [pixels].
pub const MIN_WIDTH: usize = 64;
/// Greatest width of a probe [pixels].
pub const MAX_WIDTH: usize = 16384;

/// What is seen below the true horizon.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
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

words!(GroundView, "ground", { On => "on", Off => "off", Mirrored => "mirrored" });

parameters! {
    /// All that describes a probe apart from the light itself. The keys are the same in JSON.
    pub struct ProbeSettings in "probe", named "" in messages {
        /// Width of the picture, an even number.
        ///
        /// A multiple of four for the upper half of a latitude-longitude picture, which is 4:1.
        width: usize = 2048 => whole(MIN_WIDTH as u32, MAX_WIDTH as u32, "pixels").default("2048").option("width", "PX")
            .more("The height follows: half of it for a full latitude-longitude picture, a quarter for its upper half, the same for a fisheye.");
        /// How directions are laid out.
        projection: Projection = Projection::default() => words(Projection::WORDS).default("\"latlong\"").option("projection", "NAME")
            .more("A fisheye has the zenith in its centre.");
        /// Where the rows of a latitude-longitude picture lie.
        rows: Rows = Rows::default() => words(Rows::WORDS).default("\"centre\"").option("rows", "NAME")
            .more("centre is for Blender and most viewers, corner for Mitsuba: first and last row on the poles.");
        /// The full sphere, or its upper half.
        extent: Extent = Extent::default() => words(Extent::WORDS).default("\"full\"").option("extent", "NAME");
        /// How far the sky in the picture is turned clockwise as seen from above, to the right.
        ///
        /// What stands at an azimuth is drawn where azimuth + turn would be, in a latitude-longitude picture turn / 360 of the width further right. Directions, such as the
        /// Sun's azimuth, stay those of the world.
        #[serde(skip_serializing_if = "is_zero")]
        turn_deg: f64 = 0.0 => number(-360.0, 360.0, "degrees").default("0.0").option("turn", "DEG")
            .more("In a latitude-longitude picture by turn / 360 of its width.");
        /// What is seen below the horizon: the lit ground, black, or the sky again.
        ground: GroundView = GroundView::default() => words(GroundView::WORDS).default("\"on\"").option("ground-view", "NAME");
        /// Draw the Sun's disc.
        sun_disc: bool = true => flag().default("true").option("sun-disc", "").off("no-sun-disc")
            .more("With its exact energy at every width; left out to light the scene with a Sun lamp.");
        /// Draw the Moon's disc; planets and stars always are.
        moon_disc: bool = true => flag().default("true").option("moon-disc", "").off("no-moon-disc")
            .more("Left out to light the scene with a lamp for it.");
        /// What the number 1.0 in a pixel stands for.
        scale: Scale = Scale::default() => words(Scale::WORDS).default("\"blender\"").option("scale", "NAME")
            .more("blender: luminance / 683; mitsuba: mean W m-2 sr-1 nm-1; luminance: cd m-2.");
        /// Colour space of the pixels, always linear.
        color_space: ColorSpace = ColorSpace::default() => words(ColorSpace::WORDS).default("\"lin_rec709\"").option("color-space", "NAME");
        /// What becomes of colours outside that space.
        gamut: Gamut = Gamut::default() => words(Gamut::WORDS).default("\"desaturate\"").option("gamut", "NAME")
            .more("desaturate: towards the grey of their luminance. clip: negative numbers become 0. keep: they stay negative.");
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
        self.projection.height(self.width, self.extent)
    }

    /// What the image says of its projection.
    pub const fn view(&self) -> View {
        self.projection.view(self.rows, self.extent)
    }

    /// The geometry of the image; for settings that [`Self::validate`] accepts.
    pub fn grid(&self) -> Grid {
        self.view().grid((self.width, self.height()), self.turn_deg)
    }

    /// Checks that an image of these settings can be made.
    ///
    /// # Errors
    /// [`Error::Input`] that names the width, if it is out of range or does not divide into whole rows, or the turn, if it is out of range.
    pub fn validate(&self) -> Result<()> {
        self.check_ranges()?;
        self.projection.check_width(self.width, self.extent)
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
