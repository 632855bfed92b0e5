//! Images of the full sphere: the only place where pixels become directions.
//!
//! [`render`] asks a [`SkyLight`](crate::sky::SkyLight) for its light and gives a [`Probe`]: every pixel the mean radiance of
//! its footprint, discs with their exact irradiance at every resolution. [`Painter`] gives the rows of an image one band after the other.

mod conversion;
mod disc;
mod disc_scan;
mod fisheye;
mod footprint;
mod grid;
mod image;
mod latlong;
mod moments;
mod painter;
mod points;
mod quadrature;
mod received;
mod render;
mod settings;
#[cfg(test)]
mod tests;

pub use fisheye::Fisheye;
pub use grid::{Footprint, Grid};
pub use image::Probe;
pub use latlong::{LatLong, Row};
pub use painter::Painter;
pub use render::render;
pub use settings::{Extent, GroundView, MAX_WIDTH, MIN_WIDTH, ProbeSettings, Projection, Rows};
