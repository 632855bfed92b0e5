//! Probes in a projection that they know nothing of.

use super::*;
use crate::projection::octahedral::Octahedral;

/// A picture in a projection of another kind lights as the latitude-longitude one does: sky, ground, discs and points.
#[test]
fn a_projection_that_probes_know_nothing_of_lights_alike() {
    for extent in [Extent::Full, Extent::Upper] {
        for width in [96, 512] {
            let settings = ProbeSettings { extent, scale: Scale::Luminance, ..settings(width, Rows::Centre) };
            let grid = Grid::of(Octahedral::new(width, extent));
            let painter = Painter::on(grid.clone(), &Patches, &settings, &Progress::silent()).unwrap();
            let mut pixels = vec![0.0_f32; 3 * width * width];
            painter.paint(0, &mut pixels).unwrap();
            let pixels = pixels.as_chunks::<3>().0;
            let reference = made(&Patches, &ProbeSettings { width: 1024, ..settings.clone() });
            // Neither Sun stands at the edge of what these planes see, where a pixel more or less would count.
            let normals = [DVec3::Z, DVec3::new(0.3, -0.5, 0.4), DVec3::new(-0.6, -0.7, 0.2), DVec3::new(0.5, 0.5, -0.8)];
            let (found, expected) = (super::super::received::of(&*grid, pixels, &normals), reference.irradiances(&normals));
            // The rim of the upper half cuts pixels from corner to corner, where parts count whole.
            let tolerance = if extent == Extent::Full { 0.1 } else { 1.0 } / width as f64;
            for ((normal, found), expected) in normals.into_iter().zip(found).zip(expected) {
                for (found, expected) in found.into_iter().zip(expected) {
                    assert!((found / expected - 1.0).abs() < tolerance, "{extent:?} {width} {normal}: {found} is not {expected}");
                }
            }
            // What is not seen is black.
            let outside = (0..width * width).filter(|&k| grid.footprint(k % width, k / width).solid_angle == 0.0);
            assert!(outside.into_iter().all(|k| pixels[k] == [0.0; 3]));
        }
    }
}

#[test]
fn discs_light_rightly_in_a_projection_that_probes_know_nothing_of() {
    for width in [64, 512, 2048] {
        let grid = Grid::of(Octahedral::new(width, Extent::Full));
        // At a corner of the octahedron, on its edges, at the seam, anywhere.
        for (theta, azimuth) in [(0.0, 0.0), (0.6, 0.0), (0.3, FRAC_PI_2), (1.1, 0.7), (2.5, 0.0), (2.2, -2.0), (PI - 0.3, 1.0)] {
            let disc = sun(theta, azimuth);
            let mut vector = DVec3::ZERO;
            for (column, row, energy) in super::super::disc::draw(&disc, -FRAC_PI_2, &*grid).pixels() {
                vector += energy[1] * grid.footprint(column, row).mean_direction;
            }
            let error = vector.distance(disc.direction);
            assert!(error < 1e-4, "{width} theta {theta} azimuth {azimuth}: {error:.1e}");
        }
    }
}
