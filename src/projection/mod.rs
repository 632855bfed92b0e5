//! Which pixel of a picture is which direction, and what a pixel stands for. Nothing here knows of light.
//!
//! Continuous image coordinates (x, y) count pixels from the upper left corner; the middle of pixel (i, j) is (i + 0.5, j + 0.5). Directions are unit vectors (east, north, up).
//!
//! ```text
//! Projection, Rows, Extent (what a probe is asked for) ──> View (what a picture says of itself) ──> Grid: a Geometry ──> probe, glare, tone mapping
//! ```
//!
//! # To add a projection
//! - One file here with its [`Geometry`]: size, reach, direction and density of a place, place of a direction. All the rest has a default; a projection whose borders join has its own
//!   [`neighbour`](Geometry::neighbour).
//! - Its word in [`Projection`] (if probes can have it) and in [`PictureProjection`]; the compiler then asks for its arms in `choices.rs` and `view.rs`, and nowhere else.
//! - A line in `tests.rs`, whose properties it then has to have.
//!
//! Probes, their discs, points and what planes receive work with any geometry. Two shortcuts exist: rows that are circles of equal altitude ([`Geometry::latlong`]), and
//! pictures in which the distance from the middle alone gives the angle from it ([`Geometry::azimuthal`]). Glare needs one of the two and refuses pictures that have neither.

mod choices;
mod fisheye;
mod geometry;
mod grid;
mod latlong;
#[cfg(test)]
pub(crate) mod octahedral;
mod perspective;
#[cfg(test)]
mod tests;
mod view;

pub use choices::{Extent, Projection, Rows};
pub use fisheye::Fisheye;
pub use geometry::{Azimuthal, Footprint, Geometry};
pub use grid::Grid;
pub(crate) use latlong::direction;
pub use latlong::{LatLong, Row};
pub use perspective::Perspective;
pub use view::{DEFAULT_FIELD_OF_VIEW_DEG, PictureProjection, View};
