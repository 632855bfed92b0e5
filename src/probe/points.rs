//! Draws points of light: stars, planets.
//!
//! A point's energy goes to the four pixels around it, by the distances to their middles (bilinear), so that all of it is in the picture at every resolution and its mean position is where the
//! point stands. A point thus has the size of a pixel, which is what a picture can hold of it.

use crate::projection::Geometry;
use crate::sky::Point;

/// Calls `visit` with column, row and energy (irradiance of X, Y and Z) [W m-2] of the pixels that draw `points`. Points that the image does not hold are left out.
pub(crate) fn draw(points: &[Point], grid: &dyn Geometry, mut visit: impl FnMut(usize, usize, [f64; 3])) {
    let (width, height) = grid.size();
    for point in points {
        let Some((x, y)) = grid.coordinates(point.direction) else { continue };
        if !(0.0..=width as f64).contains(&x) || !(0.0..=height as f64).contains(&y) || grid.direction(x, y).is_none() {
            continue;
        }
        let (column, right, along_columns) = nearest(x, width);
        let (row, down, along_rows) = nearest(y, height);
        for (down, along_rows) in [(0, 1.0 - along_rows), (down, along_rows)] {
            for (right, along_columns) in [(0, 1.0 - along_columns), (right, along_columns)] {
                let weight = along_rows * along_columns;
                if weight > 0.0 {
                    let (column, row) = grid.neighbour(column, row, right, down);
                    visit(column, row, point.irradiance.map(|value| weight * value));
                }
            }
        }
    }
}

/// The pixel that holds coordinate `x`, the side on which the next nearest lies, and that one's share.
fn nearest(x: f64, count: usize) -> (usize, isize, f64) {
    let pixel = (x.max(0.0) as usize).min(count - 1);
    let offset = x - (pixel as f64 + 0.5);
    (pixel, if offset < 0.0 { -1 } else { 1 }, offset.abs().min(0.5))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::probe::{Extent, ProbeSettings, Projection, Rows};
    use crate::projection::direction;
    use glam::DVec3;
    use proptest::prelude::*;

    fn settings() -> impl Strategy<Value = ProbeSettings> {
        let layouts = prop_oneof![
            Just((Projection::LatLong, Rows::Centre)),
            Just((Projection::LatLong, Rows::Corner)),
            Just((Projection::Fisheye, Rows::Centre))
        ];
        (layouts, prop_oneof![Just(64_usize), Just(512), Just(4096)]).prop_map(|((projection, rows), width)| ProbeSettings {
            projection,
            rows,
            width,
            ..Default::default()
        })
    }

    proptest! {
        /// All energy is there, and its mean direction is the point's within half a pixel.
        #[test]
        fn points_keep_their_energy_and_place(settings in settings(), theta in 0.0..std::f64::consts::PI, azimuth in 0.0..7.0_f64) {
            let grid = settings.grid();
            let towards = direction(theta, azimuth);
            let point = Point { direction: towards, irradiance: [1.0, 2.0, 0.5] };
            let (mut sum, mut mean) = (0.0, DVec3::ZERO);
            draw(&[point], &*grid, |column, row, energy| {
                sum += energy[1];
                let footprint = grid.footprint(column, row);
                assert!(footprint.solid_angle > 0.0, "{column} {row}");
                mean += energy[1] * footprint.mean_direction;
            });
            prop_assert!((sum - 2.0).abs() < 1e-12, "{sum}");
            // Around the nadir of a fisheye a pixel is a ring's piece that is stretched without bound.
            if settings.projection == Projection::LatLong || theta < 2.5 {
                let pixel = 2.0 * std::f64::consts::PI / settings.width as f64;
                prop_assert!(mean.normalize().angle_between(towards) < pixel, "{}", mean.normalize().angle_between(towards) / pixel);
            }
        }
    }

    #[test]
    fn what_an_image_does_not_hold_is_left_out() {
        let settings = ProbeSettings { extent: Extent::Upper, ..Default::default() };
        let point = Point { direction: direction(2.0, 0.3), irradiance: [1.0; 3] };
        draw(&[point], &*settings.grid(), |_, _, _| panic!("nothing to draw"));
    }
}
