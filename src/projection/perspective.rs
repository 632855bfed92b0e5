//! Pictures of a pinhole camera.
//!
//! Nobody says where such a camera looks, so directions are those of one that lies on its back with its top towards north, as a [`Fisheye`](super::Fisheye) does: (east, north, up) is (left,
//! up, forwards) in the picture. With f the focal length in pixels and r the distance from the middle:
//! ```text
//! tan(gamma) = r / f,   f = (W / 2) / tan(field of view / 2),   d omega = cos^3(gamma) / f^2 dA
//! ```

use super::geometry::{Azimuthal, Geometry};
use glam::DVec3;

/// The geometry of a picture of a pinhole camera.
#[derive(Clone, Debug)]
pub struct Perspective {
    width: usize,
    height: usize,
    /// Focal length [pixels].
    focal_length: f64,
}

impl Perspective {
    /// The geometry of a picture of `width` x `height` pixels with a horizontal field of view [degrees, above 0 to 179].
    pub fn new(width: usize, height: usize, horizontal_field_of_view_deg: f64) -> Self {
        let focal_length = 0.5 * width as f64 / (0.5 * horizontal_field_of_view_deg.to_radians()).tan();
        Self { width, height, focal_length }
    }
}

impl Geometry for Perspective {
    fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    fn reach(&self) -> f64 {
        (0.5 * (self.width as f64).hypot(self.height as f64)).atan2(self.focal_length)
    }

    fn pixel_angle(&self) -> f64 {
        self.focal_length.recip().atan()
    }

    fn direction_and_density(&self, x: f64, y: f64) -> Option<(DVec3, f64)> {
        let left = (0.5 * self.width as f64 - x) / self.focal_length;
        let up = (0.5 * self.height as f64 - y) / self.focal_length;
        let cosine = (1.0 + left * left + up * up).sqrt().recip();
        let density = cosine.powi(3) / (self.focal_length * self.focal_length);
        Some((cosine * DVec3::new(left, up, 1.0), density))
    }

    fn coordinates(&self, direction: DVec3) -> Option<(f64, f64)> {
        let scale = self.focal_length / direction.z;
        let at = (0.5 * self.width as f64 - scale * direction.x, 0.5 * self.height as f64 - scale * direction.y);
        (direction.z > 0.0).then_some(at)
    }

    fn azimuthal(&self) -> Option<&dyn Azimuthal> {
        Some(self)
    }
}

impl Azimuthal for Perspective {
    fn step(&self) -> f32 {
        1.0 / self.focal_length as f32
    }

    fn distance(&self, angle: f64) -> f64 {
        f64::from(self.focal_length as f32) * angle.tan()
    }

    fn chord_squared_and_solid_angle(&self, distance_squared: f32) -> Option<(f32, f32)> {
        let focal_length = self.focal_length as f32;
        let q = distance_squared / (focal_length * focal_length);
        let secant = (1.0 + q).sqrt();
        Some((2.0 * q / (secant * (1.0 + secant)), 1.0 / (focal_length * focal_length * secant * secant * secant)))
    }
}
