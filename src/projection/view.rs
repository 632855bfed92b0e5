//! What a picture says of where its pixels look: its projection, with the one number that goes with it.

use super::choices::Rows;
use super::fisheye::Fisheye;
use super::grid::Grid;
use super::latlong::LatLong;
use super::perspective::Perspective;
use crate::words::words;
use std::fmt;
use std::ops::RangeInclusive;

/// Where the pixels of a picture look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// All directions, twice as wide as high: row 0 at the zenith, columns by azimuth, the left border joins the right one. A probe of the upper half of the
    /// sky is the upper half of such a picture.
    LatLong {
        /// Where the centres of the rows lie.
        rows: Rows,
    },
    /// A pinhole camera.
    Perspective {
        /// Angle between the left and the right border [degrees], above 0 to 179.
        horizontal_field_of_view_deg: f64,
    },
    /// A circle, distance from its centre in proportion to the angle from the zenith.
    Fisheye {
        /// Angle between opposite borders [degrees], above 0 to 360.
        field_of_view_deg: f64,
    },
}

/// Horizontal field of view of a perspective picture of which nobody says it [degrees]: Blender's first camera, 50 mm on 36 mm.
pub const DEFAULT_FIELD_OF_VIEW_DEG: f64 = 39.6;

/// The kind of a [`View`], as users name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PictureProjection {
    /// [`View::LatLong`].
    LatLong,
    /// [`View::Perspective`].
    Perspective,
    /// [`View::Fisheye`].
    Fisheye,
}

words!(PictureProjection, "projection", { LatLong => "latlong", Perspective => "perspective", Fisheye => "fisheye" });

impl PictureProjection {
    /// The view of this kind, of which each takes what it needs: `rows`, or the field of view [degrees].
    pub const fn view(self, rows: Rows, field_of_view_deg: f64) -> View {
        match self {
            Self::LatLong => View::LatLong { rows },
            Self::Perspective => View::Perspective { horizontal_field_of_view_deg: field_of_view_deg },
            Self::Fisheye => View::Fisheye { field_of_view_deg },
        }
    }

    /// The fields of view that such pictures can have [degrees]; a latitude-longitude picture has no choice.
    pub const fn fields_of_view_deg(self) -> RangeInclusive<f64> {
        match self {
            Self::LatLong | Self::Perspective => 1e-3..=179.0,
            Self::Fisheye => 1e-3..=360.0,
        }
    }

    /// The field of view of a picture of which nobody says it [degrees].
    pub const fn default_field_of_view_deg(self) -> f64 {
        match self {
            Self::LatLong | Self::Perspective => DEFAULT_FIELD_OF_VIEW_DEG,
            Self::Fisheye => 180.0,
        }
    }
}

impl View {
    /// Its kind.
    pub const fn projection(self) -> PictureProjection {
        match self {
            Self::LatLong { .. } => PictureProjection::LatLong,
            Self::Perspective { .. } => PictureProjection::Perspective,
            Self::Fisheye { .. } => PictureProjection::Fisheye,
        }
    }

    /// The field of view [degrees]; `None` if there is no choice.
    pub const fn field_of_view_deg(self) -> Option<f64> {
        match self {
            Self::LatLong { .. } => None,
            Self::Perspective { horizontal_field_of_view_deg: angle } | Self::Fisheye { field_of_view_deg: angle } => Some(angle),
        }
    }

    /// Where the rows lie; `None` if there is no choice.
    pub const fn rows(self) -> Option<Rows> {
        match self {
            Self::LatLong { rows } => Some(rows),
            Self::Perspective { .. } | Self::Fisheye { .. } => None,
        }
    }

    /// The geometry of a picture of `width` x `height` pixels (at least 1 each) in which the sky is turned clockwise by `turn_deg` [degrees]. A latitude-longitude picture at least four times as
    /// wide as high is the upper half of one.
    pub fn grid(self, (width, height): (usize, usize), turn_deg: f64) -> Grid {
        match self {
            Self::LatLong { rows } => Grid::of(LatLong::of_size(width, height, rows).turned(turn_deg)),
            Self::Perspective { horizontal_field_of_view_deg: angle } => Grid::of(Perspective::new(width, height, angle)),
            Self::Fisheye { field_of_view_deg: angle } => Grid::of(Fisheye::of_size(width, height, angle).turned(turn_deg)),
        }
    }
}

impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.field_of_view_deg() {
            None => write!(f, "{}", self.projection()),
            Some(angle) => write!(f, "{}, {angle} degrees", self.projection()),
        }
    }
}
