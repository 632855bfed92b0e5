//! How a probe can be laid out.

use super::view::View;
use crate::error::{Error, Result};
use crate::words::words;
use serde::{Deserialize, Serialize};

/// How directions are laid out in the image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Projection {
    /// Longitude along x, latitude along y; see [`LatLong`](super::LatLong).
    #[default]
    LatLong,
    /// Equidistant fisheye, zenith in the centre; see [`Fisheye`](super::Fisheye).
    Fisheye,
}

words!(Projection, "projection", { LatLong => "latlong", Fisheye => "fisheye" });

/// Where the rows of a latitude-longitude image lie; a fisheye image has no such choice and ignores it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Rows {
    /// Zenith angle of row j is pi (j + 0.5) / H: Blender and most viewers.
    #[default]
    Centre,
    /// Zenith angle of row j is pi j / (H - 1), the first and last rows are the poles: Mitsuba.
    Corner,
}

words!(Rows, "rows", { Centre => "centre", Corner => "corner" });

/// How much of the sphere the image holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Extent {
    /// The whole sphere.
    #[default]
    Full,
    /// The half above the horizontal plane.
    Upper,
}

words!(Extent, "extent", { Full => "full", Upper => "upper" });

impl Projection {
    /// Height of an image `width` pixels wide [pixels]: width for a fisheye; for latitude-longitude half of the width, or a quarter for the upper half.
    pub const fn height(self, width: usize, extent: Extent) -> usize {
        match (self, extent) {
            (Self::Fisheye, _) => width,
            (Self::LatLong, Extent::Full) => width / 2,
            (Self::LatLong, Extent::Upper) => width / 4,
        }
    }

    /// Checks that an image `width` pixels wide divides into whole rows and halves.
    ///
    /// # Errors
    /// [`Error::Input`] that names the width.
    pub fn check_width(self, width: usize, extent: Extent) -> Result<()> {
        if !width.is_multiple_of(2) {
            return Err(Error::input("width", width, "even"));
        }
        match (self, extent) {
            (Self::LatLong, Extent::Upper) if !width.is_multiple_of(4) => {
                Err(Error::input("width", width, "a multiple of 4 for the upper half (the image is 4:1)"))
            }
            (Self::LatLong | Self::Fisheye, _) => Ok(()),
        }
    }

    /// The view of a probe, which a fisheye shows in full.
    pub const fn view(self, rows: Rows, extent: Extent) -> View {
        match self {
            Self::LatLong => View::LatLong { rows },
            Self::Fisheye => View::Fisheye {
                field_of_view_deg: match extent {
                    Extent::Full => 360.0,
                    Extent::Upper => 180.0,
                },
            },
        }
    }
}
