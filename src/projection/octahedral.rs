//! A trial of the trait, for tests: the sphere on an octahedron, unfolded to a square, every pixel with the same solid angle.
//!
//! Source: Clarberg 2008, Fast equal-area mapping of the (hemi)sphere using SIMD, eqs. 1 to 5. With u and v from -1 to 1 across the square and r = |u| + |v|, the diamond r <= 1 is the upper half:
//! ```text
//! cos(theta) = 1 - r^2,   azimuth = pi / 4 ((|v| - |u|) / r + 1) in its quadrant;   the lower half is the corners, folded under
//! ```
//! Of the whole square, every border joins itself, turned about its middle; of the upper half the image ends at the diamond.

use super::choices::Extent;
use super::geometry::Geometry;
use glam::DVec3;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// The geometry of an equal-area octahedral image.
#[derive(Clone, Debug)]
pub(crate) struct Octahedral {
    width: usize,
    extent: Extent,
}

impl Octahedral {
    /// The geometry of an image `width` pixels wide and high.
    pub fn new(width: usize, extent: Extent) -> Self {
        Self { width, extent }
    }
}

impl Geometry for Octahedral {
    fn size(&self) -> (usize, usize) {
        (self.width, self.width)
    }

    fn reach(&self) -> f64 {
        if self.extent == Extent::Full { PI } else { FRAC_PI_2 }
    }

    fn pixel_angle(&self) -> f64 {
        // Where the horizon meets an axis, half a diagonal is hypot(4, pi / 2) / width; three quarters of this.
        5.75 / self.width as f64
    }

    fn direction_and_density(&self, x: f64, y: f64) -> Option<(DVec3, f64)> {
        let place = |value: f64| 2.0 * value / self.width as f64 - 1.0;
        let (u, v) = (place(x), place(y));
        let signed = 1.0 - (u.abs() + v.abs());
        if self.extent == Extent::Upper && signed < 0.0 {
            return None;
        }
        let r = 1.0 - signed.abs();
        // The corners are folded under: there the distance from the nadir is measured from the other side.
        let ratio = if r > 0.0 { (v.abs() - u.abs()) / r } else { 0.0 };
        let (sine, cosine) = (FRAC_PI_4 * (ratio + 1.0)).sin_cos();
        let across = r * (2.0 - r * r).sqrt();
        let direction = DVec3::new((across * cosine).copysign(u), (across * sine).copysign(v), (1.0 - r * r).copysign(signed));
        Some((direction, 4.0 * PI / (self.width * self.width) as f64))
    }

    fn coordinates(&self, direction: DVec3) -> Option<(f64, f64)> {
        if self.extent == Extent::Upper && direction.z < 0.0 {
            return None;
        }
        let (x, y) = (direction.x.abs(), direction.y.abs());
        // sqrt(1 - |z|) without cancellation near the poles.
        let r = ((x * x + y * y) / (1.0 + direction.z.abs())).sqrt();
        let v = FRAC_2_PI * y.atan2(x) * r;
        let (u, v) = if direction.z < 0.0 { (1.0 - v, 1.0 - (r - v)) } else { (r - v, v) };
        let half = 0.5 * self.width as f64;
        Some((half * (1.0 + u.copysign(direction.x)), half * (1.0 + v.copysign(direction.y))))
    }

    fn neighbour(&self, column: usize, row: usize, right: isize, down: isize) -> (usize, usize) {
        let last = self.width as isize - 1;
        let (mut x, mut y) = (column as isize + right, row as isize + down);
        if !(0..=last).contains(&x) {
            (x, y) = (x.clamp(0, last), last - y);
        }
        if !(0..=last).contains(&y) {
            (x, y) = (last - x, y.clamp(0, last));
        }
        let moved = (x as usize, y as usize);
        if self.footprint(moved.0, moved.1).solid_angle > 0.0 { moved } else { (column, row) }
    }
}
