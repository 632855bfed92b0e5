//! Discs and points behind something that lets through part of their light.

use super::part::Transmittance;
use crate::sky::{Disc, Point, Surface, SurfaceMap};
use glam::DVec3;
use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

/// Rings of equal area and directions around each at which the mean transmittance over a disc is taken.
const RINGS: usize = 16;
const AROUND: usize = 48;

/// All that stands before a disc or a point, in any order: transmittances multiply.
pub(super) type Before = Arc<[Arc<dyn Transmittance>]>;

/// Factors on X, Y and Z of light from the unit vector `direction`.
fn towards(before: &Before, direction: DVec3) -> [f64; 3] {
    let (altitude, azimuth) = (direction.z.clamp(-1.0, 1.0).asin(), direction.x.atan2(direction.y));
    before.iter().fold([1.0; 3], |product, one| {
        let mut factors = [[0.0; 3]];
        one.transmittance_circle(altitude, &[azimuth], &mut factors);
        std::array::from_fn(|k| product[k] * f64::from(factors[0][k]))
    })
}

/// A point as it is seen.
pub(super) fn point(point: &Point, before: &Before) -> Point {
    let factors = towards(before, point.direction);
    Point { irradiance: std::array::from_fn(|k| point.irradiance[k] * factors[k]), ..*point }
}

/// A disc as it is seen, of which only the part above `horizon` [radians] is: darker where more stands before it, its irradiance that of what comes through. `None` if nothing does.
pub(super) fn disc(disc: &Disc, horizon: f64, before: &Before) -> Option<Disc> {
    let map = DimmedSurface::new(disc, before);
    let (mut seen, mut whole) = ([0.0; 3], [0.0; 3]);
    for ring in 0..RINGS {
        let radius = ((ring as f64 + 0.5) / RINGS as f64).sqrt();
        for step in 0..AROUND {
            let (up, right) = (2.0 * PI * (step as f64 + 0.5) / AROUND as f64).sin_cos();
            let (right, up) = (radius * right, radius * up);
            let direction = map.direction(right, up);
            if direction.z < horizon.sin() {
                continue;
            }
            let (brightness, factors) = (disc.surface.brightness(right, up), towards(before, direction));
            for k in 0..3 {
                whole[k] += brightness[k];
                seen[k] += factors[k] * brightness[k];
            }
        }
    }
    let middle = towards(before, disc.direction);
    // Of a thin crescent, or a rim above the horizon, no point may be among these.
    let share = |k: usize| if whole[k] > 0.0 { seen[k] / whole[k] } else { middle[k] };
    let irradiance: [f64; 3] = std::array::from_fn(|k| disc.irradiance[k] * share(k));
    // What is not a number is left for the picture to find.
    let hidden = irradiance.iter().all(|&value| value <= 0.0);
    (!hidden).then(|| Disc { irradiance, surface: Surface::Mapped(Arc::new(map)), ..disc.clone() })
}

/// A disc's surface with what stands before it.
struct DimmedSurface {
    surface: Surface,
    before: Before,
    centre: DVec3,
    /// Tangents along the horizon towards growing azimuth and upwards, as long as the sines of the radii.
    right: DVec3,
    up: DVec3,
}

impl DimmedSurface {
    fn new(disc: &Disc, before: &Before) -> Self {
        let right = disc.direction.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        Self {
            surface: disc.surface.clone(),
            before: before.clone(),
            centre: disc.direction,
            right: disc.horizontal_radius.sin() * right,
            up: disc.vertical_radius.sin() * right.cross(disc.direction),
        }
    }

    fn direction(&self, right: f64, up: f64) -> DVec3 {
        let across = right * self.right + up * self.up;
        across + (1.0 - across.length_squared()).max(0.0).sqrt() * self.centre
    }
}

impl SurfaceMap for DimmedSurface {
    fn brightness(&self, right: f64, up: f64) -> [f64; 3] {
        let (brightness, factors) = (self.surface.brightness(right, up), towards(&self.before, self.direction(right, up)));
        std::array::from_fn(|k| brightness[k] * factors[k])
    }
}

impl fmt::Debug for DimmedSurface {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("DimmedSurface").field("surface", &self.surface).field("before", &self.before.len()).finish()
    }
}
