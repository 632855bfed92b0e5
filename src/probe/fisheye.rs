//! Equidistant fisheye images: the distance from the centre is proportional to the zenith angle.
//!
//! The image is the sky as a camera sees it that lies on its back with its top towards north: zenith in the centre, **north up,
//! east to the left**. With r = theta / reach, 0 in the centre and 1 on the largest circle that fits:
//! ```text
//! x = W / 2 (1 - r sin(azimuth + turn)),   y = W / 2 (1 - r cos(azimuth + turn))
//! ```
//! `reach` is pi / 2 for the upper half, so that the horizon is the unit circle, and pi for the whole sphere, so that the nadir is.
//! Pixels outside the circle are black and stand for nothing. The element of solid angle is
//! d omega = sin(theta) / r reach dA, with dA in units of the circle's radius squared.

use super::settings::Extent;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// The geometry of a fisheye image.
#[derive(Clone, Debug)]
pub struct Fisheye {
    width: usize,
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
        Self { width, reach, turn: (1.0, 0.0) }
    }

    /// The same with the sky turned clockwise by `turn_deg` [degrees] as seen from above: counterclockwise in the image, which looks up.
    pub fn turned(self, turn_deg: f64) -> Self {
        let (sine, cosine) = turn_deg.to_radians().sin_cos();
        Self { turn: (cosine, sine), ..self }
    }

    /// Width and height [pixels].
    pub fn width(&self) -> usize {
        self.width
    }

    /// Zenith angle of the rim [radians].
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Direction (east, north, up) of the continuous image coordinates, or `None` outside the circle.
    pub fn direction(&self, x: f64, y: f64) -> Option<DVec3> {
        self.direction_and_density(x, y).map(|(direction, _)| direction)
    }

    /// The direction with the solid angle per pixel area [sr] there.
    fn direction_and_density(&self, x: f64, y: f64) -> Option<(DVec3, f64)> {
        let half = 0.5 * self.width as f64;
        let (east, north) = (1.0 - x / half, 1.0 - y / half);
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

    /// Continuous image coordinates of a `direction`; outside the circle if it is below the rim.
    pub fn coordinates(&self, direction: DVec3) -> (f64, f64) {
        let sine = direction.truncate().length();
        let radius = sine.atan2(direction.z) / self.reach;
        let ratio = if sine < 1e-12 { 0.0 } else { radius / sine };
        let half = 0.5 * self.width as f64;
        let (cosine, sine) = self.turn;
        let (east, north) = (direction.x * cosine + direction.y * sine, direction.y * cosine - direction.x * sine);
        (half * (1.0 - ratio * east), half * (1.0 - ratio * north))
    }

    /// Range of zenith angles [radians] that pixel (`column`, `row`) covers, within the circle.
    pub fn zenith_range(&self, column: usize, row: usize) -> (f64, f64) {
        let half = 0.5 * self.width as f64;
        // The half width of the square in the direction of the radius is at most half of its diagonal.
        let radius = (column as f64 + 0.5 - half).hypot(row as f64 + 0.5 - half) / half;
        let margin = std::f64::consts::FRAC_1_SQRT_2 / half;
        (((radius - margin).max(0.0)) * self.reach, (radius + margin).min(1.0) * self.reach)
    }

    /// Calls `visit` with direction and solid angle [sr] of `count` x `count` equal parts of pixel (`column`, `row`), leaving out the parts outside
    /// the circle.
    pub fn visit_parts(&self, column: usize, row: usize, count: usize, mut visit: impl FnMut(DVec3, f64)) {
        let part = 1.0 / count as f64;
        for b in 0..count {
            for a in 0..count {
                let x = column as f64 + (a as f64 + 0.5) * part;
                let y = row as f64 + (b as f64 + 0.5) * part;
                if let Some((direction, density)) = self.direction_and_density(x, y) {
                    visit(direction, density * part * part);
                }
            }
        }
    }

    /// Parts per side that resolve the footprint of a pixel: many on the rim, which cuts it.
    pub fn parts(&self, column: usize, row: usize) -> usize {
        let (_, far) = self.zenith_range(column, row);
        if far >= self.reach { 16 } else { 4 }
    }

    /// Solid angle [sr] and mean direction of the footprint of pixel (`column`, `row`): its square within the circle. Zeros outside.
    pub fn footprint(&self, column: usize, row: usize) -> (f64, DVec3) {
        let (mut solid_angle, mut sum) = (0.0, DVec3::ZERO);
        self.visit_parts(column, row, self.parts(column, row), |direction, weight| {
            solid_angle += weight;
            sum += weight * direction;
        });
        (solid_angle, if solid_angle > 0.0 { sum / solid_angle } else { sum })
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
            let sum: f64 = (0..64 * 64).map(|k| image.footprint(k % 64, k / 64).0).sum();
            assert!((sum / expected - 1.0).abs() < 1e-3, "{extent:?}: {}", sum / expected);
        }
    }

    #[test]
    fn north_is_up_and_east_is_left() {
        let image = Fisheye::new(100, Extent::Upper);
        for (direction, expected) in
            [(DVec3::Z, (50.0, 50.0)), (DVec3::Y, (50.0, 0.0)), (DVec3::X, (0.0, 50.0)), (-DVec3::Y, (50.0, 100.0))]
        {
            let found = image.coordinates(direction);
            assert!((found.0 - expected.0).hypot(found.1 - expected.1) < 1e-9, "{direction}: {found:?}");
        }
        assert!(image.direction(1.0, 1.0).is_none());
    }

    proptest! {
        #[test]
        fn directions_come_back(full: bool, azimuth in -PI..PI, theta in 0.001..1.57f64) {
            let image = Fisheye::new(256, if full { Extent::Full } else { Extent::Upper });
            let there = super::super::latlong::direction(theta, azimuth);
            let (x, y) = image.coordinates(there);
            prop_assert!(image.direction(x, y).unwrap().distance(there) < 1e-9);
        }
    }
}
