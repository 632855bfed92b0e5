//! The Sun as a uniform disc: random points for the path tracer, and a quadrature over the part that the planet does not hide.
//!
//! Points of the unit disc (x, y) map to directions by Lambert's equal-area projection about the centre,
//! 1 - cos(angle) = (x^2 + y^2) (1 - cos(angular radius)), so uniform in the disc is uniform in solid angle.

use super::sampling::{Random, frame};
use crate::numerics::GaussLegendre;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A uniform disc in the sky.
pub(super) struct Disc {
    /// Unit vector towards the centre.
    centre: DVec3,
    /// Angular radius [radians].
    angular_radius: f64,
    /// 1 - cos(angular radius), without cancellation.
    versine: f64,
}

impl Disc {
    pub fn new(centre: DVec3, angular_radius_deg: f64) -> Self {
        let angular_radius = angular_radius_deg.to_radians();
        Self { centre, angular_radius, versine: 2.0 * (0.5 * angular_radius).sin().powi(2) }
    }

    /// Unit vector towards the centre.
    pub fn centre(&self) -> DVec3 {
        self.centre
    }

    /// A direction drawn uniformly in solid angle.
    pub fn sample(&self, random: &mut Random) -> DVec3 {
        let radius = random.uniform().sqrt();
        let (sine, cosine) = (TAU * random.uniform()).sin_cos();
        let (first, second) = frame(self.centre);
        self.direction(first, second, radius * cosine, radius * sine)
    }

    fn direction(&self, first: DVec3, second: DVec3, x: f64, y: f64) -> DVec3 {
        let squared = x * x + y * y;
        let scale = (self.versine * (2.0 - self.versine * squared)).sqrt();
        self.centre * (1.0 - self.versine * squared) + (first * x + second * y) * scale
    }

    /// Calls `visit(direction, weight)` for the nodes of a quadrature over the part of the disc above the planet's edge, seen
    /// from a point with local vertical `up` at `radius` >= `planet_radius` from the centre; the weights of the whole disc sum to
    /// 1. The edge counts as straight within the disc.
    pub fn integrate(
        &self,
        up: DVec3,
        radius: f64,
        planet_radius: f64,
        (rows, columns): (&GaussLegendre, &GaussLegendre),
        mut visit: impl FnMut(DVec3, f64),
    ) {
        let above_edge = self.centre.dot(up).clamp(-1.0, 1.0).asin() + (planet_radius / radius).min(1.0).acos();
        if above_edge <= -self.angular_radius {
            return;
        }
        if self.angular_radius == 0.0 {
            return visit(self.centre, 1.0);
        }
        let across = self.centre.cross(up).try_normalize().unwrap_or_else(|| frame(self.centre).0);
        let upward = across.cross(self.centre);
        let cut = (-(0.5 * above_edge).sin() / (0.5 * self.angular_radius).sin()).clamp(-1.0, 1.0);
        // y = sin(phi) makes the width of a row smooth at the ends of the disc.
        let lowest = cut.asin();
        for (angle, weight) in rows.on(lowest, FRAC_PI_2) {
            let (y, half_width) = angle.sin_cos();
            let row = weight * half_width * half_width / PI;
            for (x, column) in columns.on(-1.0, 1.0) {
                visit(self.direction(across, upward, x * half_width, y), row * column);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn visible_fraction(elevation_deg: f64) -> f64 {
        let (sine, cosine) = elevation_deg.to_radians().sin_cos();
        let disc = Disc::new(DVec3::new(cosine, 0.0, sine), 0.25);
        let (rows, columns) = (GaussLegendre::new(12), GaussLegendre::new(3));
        let mut sum = 0.0;
        disc.integrate(DVec3::Z, 1.0, 1.0, (&rows, &columns), |direction, weight| {
            assert!(direction.z > -1e-9);
            assert!((direction.length() - 1.0).abs() < 1e-12);
            sum += weight;
        });
        sum
    }

    #[test]
    fn the_weights_are_the_area_of_the_visible_segment() {
        assert!((visible_fraction(30.0) - 1.0).abs() < 1e-9);
        assert!((visible_fraction(90.0) - 1.0).abs() < 1e-9);
        assert!((visible_fraction(0.0) - 0.5).abs() < 1e-6);
        assert_eq!(visible_fraction(-0.26), 0.0);
        // A circular segment whose chord is half a radius from the centre: 1/3 - sqrt(3) / (4 pi).
        let segment = 1.0 / 3.0 - 3.0_f64.sqrt() / (4.0 * PI);
        assert!((visible_fraction(-0.125) - segment).abs() < 1e-5);
        assert!((visible_fraction(0.125) - (1.0 - segment)).abs() < 1e-5);
    }

    #[test]
    fn samples_lie_in_the_disc_and_average_to_its_centre() {
        let centre = DVec3::new(0.6, 0.0, -0.8);
        let disc = Disc::new(centre, 5.0);
        let mut random = Random::new(1, 1);
        let n = 50_000;
        let mut sum = DVec3::ZERO;
        for _ in 0..n {
            let direction = disc.sample(&mut random);
            assert!(direction.dot(centre) >= 5.0_f64.to_radians().cos() - 1e-12);
            sum += direction;
        }
        // The mean cosine over a cap is (1 + cos(radius)) / 2.
        let mean = sum / n as f64;
        assert!((mean.dot(centre) - 0.5 * (1.0 + 5.0_f64.to_radians().cos())).abs() < 3e-5);
        assert!(mean.reject_from(centre).length() < 1e-3);
    }
}
