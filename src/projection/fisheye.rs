//! Equidistant fisheye images: the distance from the centre is proportional to the zenith angle.
//!
//! The image is the sky as a camera sees it that lies on its back with its top towards north: zenith in the centre, **north up,
//! east to the left**. With r = theta / reach, 0 in the centre and 1 on the largest circle that fits:
//! ```text
//! x = W / 2 (1 - r sin(azimuth + turn)),   y = W / 2 (1 - r cos(azimuth + turn))
//! ```
//! (of a picture that is not square, y counts from H / 2). `reach` is pi / 2 for the upper half, so that the horizon is the unit circle, and pi for the whole sphere, so that the nadir is.
//! Pixels outside the circle are black and stand for nothing. The element of solid angle is
//! d omega = sin(theta) / r reach dA, with dA in units of the circle's radius squared.

use super::choices::Extent;
use super::geometry::{Azimuthal, Geometry};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// The geometry of a fisheye image.
#[derive(Clone, Debug)]
pub struct Fisheye {
    width: usize,
    height: usize,
    reach: f64,
    /// Cosine and sine of the angle by which the sky is turned clockwise, seen from above.
    turn: (f64, f64),
}

impl Fisheye {
    /// The geometry of an image `width` pixels wide and high.
    pub fn new(width: usize, extent: Extent) -> Self {
        let reach = match extent {
            Extent::Full => PI,
            Extent::Upper => FRAC_PI_2,
        };
        Self { width, height: width, reach, turn: (1.0, 0.0) }
    }

    /// The geometry of a picture of any size with an angle between the left and the right border [degrees, above 0 to 360]; the middle of the circle is that of the picture.
    pub fn of_size(width: usize, height: usize, field_of_view_deg: f64) -> Self {
        Self { width, height, reach: 0.5 * field_of_view_deg.to_radians(), turn: (1.0, 0.0) }
    }

    /// The same with the sky turned clockwise by `turn_deg` [degrees] as seen from above: counterclockwise in the image, which looks up.
    pub fn turned(self, turn_deg: f64) -> Self {
        let (sine, cosine) = turn_deg.to_radians().sin_cos();
        Self { turn: (cosine, sine), ..self }
    }

    /// Height over width.
    fn aspect(&self) -> f64 {
        self.height as f64 / self.width as f64
    }
}

impl Geometry for Fisheye {
    fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Zenith angle of the rim.
    fn reach(&self) -> f64 {
        self.reach
    }

    fn pixel_angle(&self) -> f64 {
        2.0 * self.reach / self.width as f64
    }

    fn direction_and_density(&self, x: f64, y: f64) -> Option<(DVec3, f64)> {
        let half = 0.5 * self.width as f64;
        let (east, north) = (1.0 - x / half, self.aspect() - y / half);
        let radius = east.hypot(north);
        if radius > 1.0 {
            return None;
        }
        let theta = radius * self.reach;
        // sin(theta) / r, which is `reach` in the centre.
        let ratio = if theta < 1e-9 { self.reach } else { theta.sin() / radius };
        let (cosine, sine) = self.turn;
        let (east, north) = (east * cosine - north * sine, north * cosine + east * sine);
        Some((DVec3::new(ratio * east, ratio * north, theta.cos()), ratio * self.reach / (half * half)))
    }

    /// Outside the circle for a direction below the rim. The nadir is the whole rim of a full sphere, of which this is the point towards north.
    fn coordinates(&self, direction: DVec3) -> Option<(f64, f64)> {
        let half = 0.5 * self.width as f64;
        let sine = direction.truncate().length();
        let radius = sine.atan2(direction.z) / self.reach;
        if sine < 1e-12 {
            let radius = if direction.z < 0.0 { radius } else { 0.0 };
            return Some((half, half * (self.aspect() - radius)));
        }
        let ratio = radius / sine;
        let (cosine, sine) = self.turn;
        let (east, north) = (direction.x * cosine + direction.y * sine, direction.y * cosine - direction.x * sine);
        Some((half * (1.0 - ratio * east), half * (self.aspect() - ratio * north)))
    }

    /// Within the circle.
    fn zenith_range(&self, column: usize, row: usize) -> (f64, f64) {
        let half = 0.5 * self.width as f64;
        // The half width of the square in the direction of the radius is at most half of its diagonal.
        let radius = (column as f64 + 0.5 - half).hypot(row as f64 + 0.5 - 0.5 * self.height as f64) / half;
        let margin = std::f64::consts::FRAC_1_SQRT_2 / half;
        (((radius - margin).max(0.0)) * self.reach, (radius + margin).min(1.0) * self.reach)
    }

    fn azimuthal(&self) -> Option<&dyn Azimuthal> {
        Some(self)
    }
}

impl Azimuthal for Fisheye {
    fn step(&self) -> f32 {
        self.pixel_angle() as f32
    }

    fn distance(&self, angle: f64) -> f64 {
        angle / f64::from(self.step())
    }

    fn chord_squared_and_solid_angle(&self, distance_squared: f32) -> Option<(f32, f32)> {
        let step = self.step();
        let angle = step * distance_squared.sqrt();
        if angle >= std::f32::consts::PI {
            return None;
        }
        let half = (0.5 * angle).sin();
        let ratio = if angle < 1e-6 { 1.0 } else { angle.sin() / angle };
        Some((4.0 * half * half, step * step * ratio))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    #[test]
    fn solid_angles_add_up() {
        for (extent, expected) in [(Extent::Full, 2.0 * TAU), (Extent::Upper, TAU)] {
            let image = Fisheye::new(64, extent);
            let sum: f64 = (0..64 * 64).map(|k| image.footprint(k % 64, k / 64).solid_angle).sum();
            assert!((sum / expected - 1.0).abs() < 1e-3, "{extent:?}: {}", sum / expected);
        }
    }

    #[test]
    fn north_is_up_and_east_is_left() {
        let image = Fisheye::new(100, Extent::Upper);
        for (direction, expected) in
            [(DVec3::Z, (50.0, 50.0)), (DVec3::Y, (50.0, 0.0)), (DVec3::X, (0.0, 50.0)), (-DVec3::Y, (50.0, 100.0))]
        {
            let found = image.coordinates(direction).unwrap();
            assert!((found.0 - expected.0).hypot(found.1 - expected.1) < 1e-9, "{direction}: {found:?}");
        }
        assert!(image.direction(1.0, 1.0).is_none());
    }

    proptest! {
        #[test]
        fn directions_come_back(full: bool, azimuth in -PI..PI, theta in 0.001..1.57f64) {
            let image = Fisheye::new(256, if full { Extent::Full } else { Extent::Upper });
            let there = super::super::latlong::direction(theta, azimuth);
            let (x, y) = image.coordinates(there).unwrap();
            prop_assert!(image.direction(x, y).unwrap().distance(there) < 1e-9);
        }
    }
}
