//! What every projection can say of its pixels.

use super::latlong::LatLong;
use glam::DVec3;
use std::f64::consts::PI;
use std::fmt::Debug;

/// What a pixel stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Solid angle [sr].
    pub solid_angle: f64,
    /// Mean direction (east, north, up), shorter than 1.
    pub mean_direction: DVec3,
    /// Mean of max(z, 0): what the pixel adds to the irradiance of a horizontal plane, per energy.
    pub mean_upward: f64,
}

/// The geometry of an image: which pixel is which direction, and what a pixel stands for.
pub trait Geometry: Debug + Send + Sync {
    /// Width and height [pixels].
    fn size(&self) -> (usize, usize);

    /// Zenith angle of the lowest direction in the image [radians].
    fn reach(&self) -> f64;

    /// Angle that a pixel spans where pixels are largest [radians]: no part of any pixel is further from its middle than three quarters of it.
    fn pixel_angle(&self) -> f64;

    /// Direction (east, north, up) of continuous image coordinates, with the solid angle per pixel area [sr] there; `None` where the image holds none, such as outside a fisheye's circle.
    fn direction_and_density(&self, x: f64, y: f64) -> Option<(DVec3, f64)>;

    /// Continuous image coordinates (x, y) of a `direction`; `None`, or coordinates outside the image, for a direction that it does not hold.
    fn coordinates(&self, direction: DVec3) -> Option<(f64, f64)>;

    /// Direction (east, north, up) of continuous image coordinates; `None` where the image holds none.
    fn direction(&self, x: f64, y: f64) -> Option<DVec3> {
        self.direction_and_density(x, y).map(|(direction, _)| direction)
    }

    /// The pixel `right` columns and `down` rows (each -1, 0 or 1) from (`column`, `row`), across the borders that join; the pixel itself where the image ends.
    fn neighbour(&self, column: usize, row: usize, right: isize, down: isize) -> (usize, usize) {
        let (width, height) = self.size();
        match (column.checked_add_signed(right), row.checked_add_signed(down)) {
            (Some(x), Some(y)) if x < width && y < height && self.footprint(x, y).solid_angle > 0.0 => (x, y),
            _ => (column, row),
        }
    }

    /// Range of zenith angles [radians] that holds those of pixel (`column`, `row`); it begins beyond [`reach`](Self::reach) if the image holds nothing there.
    fn zenith_range(&self, column: usize, row: usize) -> (f64, f64) {
        let Some(direction) = self.direction(column as f64 + 0.5, row as f64 + 0.5) else { return (0.0, self.reach()) };
        let theta = direction.truncate().length().atan2(direction.z);
        let margin = 0.75 * self.pixel_angle();
        ((theta - margin).max(0.0), (theta + margin).min(PI).min(self.reach()))
    }

    /// Parts per side that resolve the footprint of a pixel: many on the rim, which cuts it.
    fn parts_per_side(&self, column: usize, row: usize) -> usize {
        let (_, far) = self.zenith_range(column, row);
        if far >= self.reach() { 16 } else { 4 }
    }

    /// Puts direction and solid angle [sr] of `count` x `count` equal parts of pixel (`column`, `row`) into `parts`, leaving out the parts that the image does not hold.
    fn parts(&self, column: usize, row: usize, count: usize, parts: &mut Vec<(DVec3, f64)>) {
        parts.clear();
        visit_parts(self, (column, row), count, |direction, weight| parts.push((direction, weight)));
    }

    /// The footprint of pixel (`column`, `row`); zeros where the image holds nothing.
    fn footprint(&self, column: usize, row: usize) -> Footprint {
        let (mut solid_angle, mut sum, mut upward) = (0.0, DVec3::ZERO, 0.0);
        visit_parts(self, (column, row), self.parts_per_side(column, row), |direction, weight| {
            solid_angle += weight;
            sum += weight * direction;
            upward += weight * direction.z.max(0.0);
        });
        let scale = if solid_angle > 0.0 { 1.0 / solid_angle } else { 0.0 };
        Footprint { solid_angle, mean_direction: sum * scale, mean_upward: upward * scale }
    }

    /// The image, if its rows are circles of equal altitude: they are painted as wholes.
    fn latlong(&self) -> Option<&LatLong> {
        None
    }

    /// The image, if the distance from its middle alone gives the angle from the direction there.
    fn azimuthal(&self) -> Option<&dyn Azimuthal> {
        None
    }
}

/// An image in which the distance from the middle alone gives the angle from the direction there. Single precision, for what is asked of every pixel of a filter.
pub trait Azimuthal: Sync {
    /// Angle between neighbouring pixels in the middle [radians].
    fn step(&self) -> f32;

    /// Distance from the middle [pixels] of a direction at `angle` from it [radians, below a right angle].
    fn distance(&self, angle: f64) -> f64;

    /// The square of the chord between the direction of a pixel and that of the middle, and the pixel's solid angle [sr], by the square of its distance from the middle
    /// [pixels^2]; `None` beyond all directions.
    fn chord_squared_and_solid_angle(&self, distance_squared: f32) -> Option<(f32, f32)>;
}

fn visit_parts<G: Geometry + ?Sized>(image: &G, (column, row): (usize, usize), count: usize, mut visit: impl FnMut(DVec3, f64)) {
    let part = 1.0 / count as f64;
    for b in 0..count {
        for a in 0..count {
            let x = column as f64 + (a as f64 + 0.5) * part;
            let y = row as f64 + (b as f64 + 0.5) * part;
            if let Some((direction, density)) = image.direction_and_density(x, y) {
                visit(direction, density * part * part);
            }
        }
    }
}
