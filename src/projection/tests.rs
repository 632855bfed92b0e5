//! Properties that every projection has.

use super::octahedral::Octahedral;
use super::*;
use glam::DVec3;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// All kinds of geometries in a small size, turned and not, by name.
fn all() -> Vec<(String, Grid)> {
    let mut found = Vec::new();
    for extent in [Extent::Full, Extent::Upper] {
        for turn_deg in [0.0, 33.3] {
            for rows in [Rows::Centre, Rows::Corner] {
                let grid = Grid::of(LatLong::new(64, rows, extent).turned(turn_deg));
                found.push((format!("latlong {rows} {extent} {turn_deg}"), grid));
            }
            found.push((format!("fisheye {extent} {turn_deg}"), Grid::of(Fisheye::new(64, extent).turned(turn_deg))));
        }
        found.push((format!("octahedral {extent}"), Grid::of(Octahedral::new(64, extent))));
    }
    for (width, height, angle) in [(64, 48, 40.0), (33, 50, 120.0), (64, 1, 170.0)] {
        found.push((format!("perspective {angle}"), Grid::of(Perspective::new(width, height, angle))));
        found.push((format!("fisheye {angle} {width} x {height}"), Grid::of(Fisheye::of_size(width, height, 1.5 * angle))));
    }
    found
}

fn middle(grid: &Grid, column: usize, row: usize) -> Option<DVec3> {
    grid.direction(column as f64 + 0.5, row as f64 + 0.5)
}

fn pixels(grid: &Grid) -> impl Iterator<Item = (usize, usize)> {
    let (width, height) = grid.size();
    (0..width * height).map(move |k| (k % width, k / width))
}

/// Whether the image holds `direction` at its coordinates.
fn place(grid: &Grid, direction: DVec3) -> Option<(f64, f64)> {
    let (width, height) = grid.size();
    let (x, y) = grid.coordinates(direction)?;
    let inside = (0.0..=width as f64).contains(&x) && (0.0..=height as f64).contains(&y);
    (inside && grid.direction(x, y).is_some()).then_some((x, y))
}

proptest! {
    #[test]
    fn directions_come_back(cosine in -1.0..1.0f64, azimuth in -PI..PI) {
        let there = direction(cosine.acos(), azimuth);
        for (name, grid) in all() {
            if let Some((x, y)) = place(&grid, there) {
                let distance = grid.direction(x, y).unwrap().distance(there);
                // Half a row beyond the last one of an upper half the direction is the last row's.
                let beyond = cosine.acos() - grid.reach();
                prop_assert!(distance < 1e-12 + beyond.max(0.0), "{name}: {distance:e}");
            }
        }
    }

    #[test]
    fn places_come_back(x in 0.0..1.0f64, y in 0.0..1.0f64) {
        for (name, grid) in all() {
            let (width, height) = grid.size();
            let (x, y) = (x * width as f64, y * height as f64);
            let Some((there, density)) = grid.direction_and_density(x, y) else { continue };
            prop_assert!((there.length() - 1.0).abs() < 1e-12 && density >= 0.0, "{name}");
            prop_assert!(there.truncate().length().atan2(there.z) <= grid.reach() + 1e-12, "{name}");
            let back = grid.coordinates(there).unwrap();
            // Where pixels shrink to nothing, places close to each other are one direction.
            let distance = grid.direction(back.0, back.1).map(|back| back.distance(there));
            prop_assert!(distance.is_some_and(|distance| distance < 1e-12), "{name} {x} {y}: {distance:?}");
        }
    }

    /// The solid angle of a small parallelogram around a place is its density times its area.
    #[test]
    fn densities_are_those_of_the_directions(x in 0.02..0.98f64, y in 0.02..0.98f64) {
        for (name, grid) in all() {
            let (width, height) = grid.size();
            let (x, y, h) = (x * width as f64, y * height as f64, 1e-4);
            let at = |x, y| grid.direction(x, y);
            let (Some((_, density)), Some(left), Some(right), Some(up), Some(down)) =
                (grid.direction_and_density(x, y), at(x - h, y), at(x + h, y), at(x, y - h), at(x, y + h))
            else {
                continue;
            };
            // Nor at a fold, nor beyond the row of a pole.
            let (along, across) = ((right - left) / (2.0 * h), (down - up) / (2.0 * h));
            let fold = (right + left - down - up).length() > 1e-7 || (y < 0.6 || y > height as f64 - 0.6);
            let found = along.cross(across).length();
            prop_assert!(fold || (found - density).abs() < 1e-5 * grid.pixel_angle().powi(2), "{name} {x} {y}: {found} {density}");
        }
    }
}

#[test]
fn the_poles_and_the_compass_come_back() {
    for (name, grid) in all().into_iter().filter(|(name, _)| !name.contains(" x ") && !name.starts_with("perspective")) {
        for there in [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y] {
            let holds = there.truncate().length().atan2(there.z) < grid.reach() - 1e-9;
            let found = grid.coordinates(there).and_then(|(x, y)| grid.direction(x.max(0.0), y.max(0.0)));
            assert!(!holds || found.is_some_and(|found| found.distance(there) < 1e-12), "{name} {there}: {found:?}");
        }
    }
}

#[test]
fn solid_angles_add_up() {
    for (name, grid) in all().into_iter().filter(|(name, grid)| grid.size().0 == 64 && !name.contains(" x ")) {
        let expected = if name.starts_with("perspective") {
            // Source: Mazonka 2012, Solid angle of conical surfaces, polyhedral cones, and intersecting spherical caps, eq. 27 (a rectangle seen from above its middle).
            let image = |(x, y): (f64, f64)| grid.direction(x, y).map(|there| there.truncate().abs() / there.z).unwrap();
            let corner = image((0.0, 0.0));
            let square = (1.0 + corner.x * corner.x) * (1.0 + corner.y * corner.y);
            4.0 * (corner.x * corner.y / square.sqrt()).asin()
        } else {
            TAU * (1.0 - grid.reach().cos())
        };
        let sum: f64 = pixels(&grid).map(|(column, row)| grid.footprint(column, row).solid_angle).sum();
        let tolerance = match &name[..] {
            name if name.starts_with("latlong") => 1e-12,
            "octahedral full" => 1e-12,
            // The rim goes through the middles of parts.
            "octahedral upper" => 3e-3,
            _ => 1e-3,
        };
        assert!((sum / expected - 1.0).abs() < tolerance, "{name}: {sum} is not {expected}");
    }
}

#[test]
fn footprints_are_those_of_the_pixels() {
    for (name, grid) in all() {
        let unit = grid.pixel_angle().powi(2);
        for (column, row) in pixels(&grid) {
            let footprint = grid.footprint(column, row);
            let (mut parts, mut sum) = (Vec::new(), DVec3::ZERO);
            grid.parts(column, row, 40, &mut parts);
            let solid_angle: f64 = parts.iter().map(|(_, weight)| weight).sum();
            parts.iter().for_each(|(direction, weight)| sum += *weight * *direction);
            // Footprints of rows = corner are tents that reach over the pixel; their poles are other shapes.
            let tent = name.contains("corner");
            if !(tent && (row == 0 || row + 1 == grid.size().1)) {
                let off = (footprint.solid_angle - solid_angle).abs();
                assert!(off < if tent { 2e-2 } else { 1e-2 } * unit, "{name} {column} {row}: {off}");
            }
            if footprint.solid_angle > 0.0 && !tent {
                let off = footprint.mean_direction * footprint.solid_angle - sum;
                assert!(off.length() < 1e-2 * unit, "{name} {column} {row}: {off}");
            }
            assert!(
                footprint.mean_direction.length() <= 1.0 + 1e-12 && footprint.mean_upward >= footprint.mean_direction.z - 1e-12
            );
            let (near, far) = grid.zenith_range(column, row);
            for (there, _) in parts {
                let theta = there.truncate().length().atan2(there.z);
                assert!((near - 1e-9..=far + 1e-9).contains(&theta), "{name} {column} {row}: {theta} in {near} to {far}");
                // No side is longer than is said: half a diagonal reaches every part.
                let angle = middle(&grid, column, row).map_or(0.0, |middle| middle.angle_between(there));
                assert!(angle <= 0.75 * grid.pixel_angle(), "{name} {column} {row}: {}", angle / grid.pixel_angle());
            }
        }
    }
}

/// From the other side the way leads back, to the pixel or to one that looks where it does; and a neighbour is near.
#[test]
fn neighbours_are_mutual_and_near() {
    const WAYS: [(isize, isize); 4] = [(-1, 0), (1, 0), (0, -1), (0, 1)];
    for (name, grid) in all() {
        let mut seams = 0;
        for (column, row) in pixels(&grid).filter(|&(column, row)| grid.footprint(column, row).solid_angle > 0.0) {
            let here = grid.footprint(column, row).mean_direction;
            for (right, down) in WAYS {
                let (x, y) = grid.neighbour(column, row, right, down);
                if (x, y) == (column, row) {
                    continue;
                }
                let there = grid.footprint(x, y);
                assert!(there.solid_angle > 0.0, "{name}: from {column} {row} to {x} {y}");
                assert!(
                    there.mean_direction.angle_between(here) < 2.1 * grid.pixel_angle(),
                    "{name}: from {column} {row} to {x} {y}"
                );
                let looks_here = |(x, y): (usize, usize)| {
                    (x, y) == (column, row)
                        || middle(&grid, x, y).zip(middle(&grid, column, row)).is_some_and(|(a, b)| a.distance(b) < 1e-9)
                };
                assert!(
                    WAYS.iter().any(|&(right, down)| looks_here(grid.neighbour(x, y, right, down))),
                    "{name}: from {column} {row} to {x} {y} and not back"
                );
                seams += usize::from(x.abs_diff(column) > 1 || y.abs_diff(row) > 1);
            }
        }
        let joined = name.starts_with("latlong") || name == "octahedral full";
        assert_eq!(joined, seams > 0, "{name}: {seams}");
    }
}

#[test]
fn an_azimuthal_image_is_that_of_its_directions() {
    for (name, grid) in all() {
        let Some(image) = grid.azimuthal() else { continue };
        let (width, height) = grid.size();
        let at = |column: f64| grid.direction_and_density(0.5 * width as f64 + column, 0.5 * height as f64);
        for distance in [0.0, 1.0, 7.5, 16.0] {
            let (there, density) = at(distance).unwrap();
            let (chord_squared, solid_angle) = image.chord_squared_and_solid_angle((distance * distance) as f32).unwrap();
            let expected = there.distance_squared(DVec3::Z);
            assert!(
                (f64::from(chord_squared) - expected).abs() <= 1e-5 * expected,
                "{name} {distance}: {chord_squared} {expected}"
            );
            assert!((f64::from(solid_angle) / density - 1.0).abs() < 1e-5, "{name} {distance}: {solid_angle} {density}");
            let angle = there.angle_between(DVec3::Z);
            assert!(angle > FRAC_PI_2 || (image.distance(angle) - distance).abs() < 1e-4, "{name} {distance}");
        }
    }
}
