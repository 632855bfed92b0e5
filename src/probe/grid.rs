//! The pixels of an image as carriers of light: neighbours, solid angles and mean directions, whatever the projection.

use super::fisheye::Fisheye;
use super::latlong::LatLong;
use super::settings::{ProbeSettings, Projection};
use glam::DVec3;

/// The geometry of either kind of image.
#[derive(Clone, Debug)]
pub enum Grid {
    /// Latitude-longitude.
    LatLong(LatLong),
    /// Equidistant fisheye.
    Fisheye(Fisheye),
}

/// What a pixel stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Solid angle [sr].
    pub solid_angle: f64,
    /// Mean direction (east, north, up), shorter than 1.
    pub mean_direction: DVec3,
    /// Mean of max(z, 0): what the pixel adds to the irradiance of a horizontal plane, per energy.
    pub mean_upward: f64,
}

impl Grid {
    /// The geometry of an image with valid `settings`.
    pub fn new(settings: &ProbeSettings) -> Self {
        match settings.projection {
            Projection::LatLong => {
                Self::LatLong(LatLong::new(settings.width, settings.rows, settings.extent).turned(settings.turn_deg))
            }
            Projection::Fisheye => Self::Fisheye(Fisheye::new(settings.width, settings.extent).turned(settings.turn_deg)),
        }
    }

    /// Width and height [pixels].
    pub fn size(&self) -> (usize, usize) {
        match self {
            Self::LatLong(image) => (image.width(), image.height()),
            Self::Fisheye(image) => (image.width(), image.width()),
        }
    }

    /// Zenith angle of the lowest direction in the image [radians].
    pub fn reach(&self) -> f64 {
        match self {
            Self::LatLong(image) => image.span(),
            Self::Fisheye(image) => image.reach(),
        }
    }

    /// Direction (east, north, up) of continuous image coordinates; `None` outside a fisheye's circle.
    pub fn direction(&self, x: f64, y: f64) -> Option<DVec3> {
        match self {
            Self::LatLong(image) => Some(image.direction(x, y)),
            Self::Fisheye(image) => image.direction(x, y),
        }
    }

    /// Continuous image coordinates (x, y) of a `direction`: the middle of pixel (i, j) is (i + 0.5, j + 0.5). Directions that the image
    /// does not hold give coordinates outside it (or outside a fisheye's circle).
    pub fn coordinates(&self, direction: DVec3) -> (f64, f64) {
        match self {
            Self::LatLong(image) => image.coordinates(direction),
            Self::Fisheye(image) => image.coordinates(direction),
        }
    }

    /// The footprint of pixel (`column`, `row`); zeros outside a fisheye's circle.
    pub fn footprint(&self, column: usize, row: usize) -> Footprint {
        match self {
            Self::LatLong(image) => {
                let found = &image.table()[row];
                Footprint {
                    solid_angle: found.solid_angle,
                    mean_direction: image.mean_direction(column, row),
                    mean_upward: found.mean_upward,
                }
            }
            Self::Fisheye(image) => {
                let (mut solid_angle, mut sum, mut upward) = (0.0, DVec3::ZERO, 0.0);
                image.visit_parts(column, row, image.parts(column, row), |direction, weight| {
                    solid_angle += weight;
                    sum += weight * direction;
                    upward += weight * direction.z.max(0.0);
                });
                let scale = if solid_angle > 0.0 { 1.0 / solid_angle } else { 0.0 };
                Footprint { solid_angle, mean_direction: sum * scale, mean_upward: upward * scale }
            }
        }
    }

    /// The pixel `right` columns and `down` rows (each -1, 0 or 1) from (`column`, `row`), over the poles and the seam of a latitude-longitude image;
    /// the pixel itself where the image ends.
    pub(crate) fn neighbour(&self, column: usize, row: usize, right: isize, down: isize) -> (usize, usize) {
        match self {
            Self::LatLong(image) => {
                let width = image.width() as isize;
                let (mut column, mut row) = (column as isize + right, row as isize + down);
                let last = image.height() as isize - 1;
                // In an image with rows on the poles, the row beyond the pole is row 1, not the pole itself once more.
                let corner = isize::from(image.rows() == super::settings::Rows::Corner);
                if row < 0 {
                    (column, row) = (column + width / 2, corner);
                } else if row > last {
                    let full = image.span() > 3.0;
                    (column, row) = if full { (column + width / 2, last - corner) } else { (column, last) };
                }
                (column.rem_euclid(width) as usize, row as usize)
            }
            Self::Fisheye(image) => {
                let last = image.width() as isize - 1;
                let moved = (column as isize + right, row as isize + down);
                let inside = (0..=last).contains(&moved.0) && (0..=last).contains(&moved.1);
                let moved = (moved.0.clamp(0, last) as usize, moved.1.clamp(0, last) as usize);
                if inside && image.footprint(moved.0, moved.1).0 > 0.0 { moved } else { (column, row) }
            }
        }
    }
}
