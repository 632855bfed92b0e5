//! The pixels of an image as carriers of light, whatever the projection.

use super::geometry::Geometry;
use std::ops::Deref;
use std::sync::Arc;

/// The [`Geometry`] of an image, whatever its projection. A copy is cheap.
#[derive(Clone, Debug)]
pub struct Grid(Arc<dyn Geometry>);

impl Grid {
    /// The grid of a `geometry`.
    pub fn of(geometry: impl Geometry + 'static) -> Self {
        Self(Arc::new(geometry))
    }
}

impl Deref for Grid {
    type Target = dyn Geometry;

    fn deref(&self) -> &Self::Target {
        &*self.0
    }
}
