//! Images of the light from all directions.
//!
//! [`render`] asks a [`SkyLight`](crate::sky::SkyLight) for its light and gives a [`Probe`]: every pixel the mean radiance of
//! its footprint, discs with their exact irradiance at every resolution. [`Painter`] gives the rows of an image one band after the other.

mod conversion;
mod disc;
mod disc_scan;
mod footprint;
mod image;
mod moments;
mod painter;
mod points;
mod received;
mod render;
mod seams;
mod settings;
#[cfg(test)]
mod tests;

pub use crate::projection::{Extent, Fisheye, Footprint, Grid, LatLong, Projection, Row, Rows};
pub use image::Probe;
pub use painter::Painter;
pub use render::render;
pub use settings::{GroundView, MAX_WIDTH, MIN_WIDTH, ProbeSettings};
