//! Maps of directions by the standard attribute `envmap` (OpenEXR, `ImfEnvmap.h`), made into latitude-longitude pictures of our layout.
//!
//! OpenEXR's axes are x, y (up) and z; seen from inside, z is in the middle of a latitude-longitude map and x at its first quarter. What is in the middle there stays in the middle: east.
//! The outer columns of a map both lie on the seam, and its outer rows on the poles: rows are `corner` as they are, columns are interpolated to where ours lie.

use super::super::PictureLimits;
use crate::error::{Error, Result};
use crate::io::limits;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

/// Moves the columns of a latitude-longitude map to where ours lie, linearly between neighbours.
pub fn shift_columns(width: usize, pixels: &mut [f32]) {
    if width < 2 {
        return;
    }
    pixels.par_chunks_mut(3 * width).for_each(|row| {
        let old = row.to_vec();
        for x in 0..width {
            let place = (x as f64 + 0.5) * (width - 1) as f64 / width as f64;
            let (left, share) = (place as usize, place.fract() as f32);
            let right = (left + 1).min(width - 1);
            for c in 0..3 {
                row[3 * x + c] = old[3 * left + c] * (1.0 - share) + old[3 * right + c] * share;
            }
        }
    });
}

/// A latitude-longitude picture, rows `centre`, of six faces one below the other: +x, -x, +y, -y, +z, -z.
///
/// # Errors
/// [`Error::Data`] for a picture that has no six square faces; [`Error::Input`] if the result is over the limits.
pub fn from_cube(
    path: &Path,
    limits: &PictureLimits,
    (width, height): (usize, usize),
    pixels: &[f32],
) -> Result<(usize, usize, Vec<f32>)> {
    if height != 6 * width {
        let reason = format!(
            "{}: envmap = cube, {width} x {height} pixels, where six faces one below the other are six times as high as wide",
            path.display()
        );
        return Err(Error::data(reason));
    }
    let (columns, rows) = (4 * width, 2 * width);
    limits.check(path, columns as u64, rows as u64)?;
    let mut out: Vec<f32> = limits::zeros(path, 3 * columns * rows)?;
    out.par_chunks_mut(3 * columns).enumerate().for_each(|(y, row)| {
        for (x, pixel) in row.as_chunks_mut::<3>().0.iter_mut().enumerate() {
            // The mean of four directions, as faces have more pixels in their corners.
            for part in 0..4 {
                let (u, v) = (x as f64 + 0.25 + 0.5 * f64::from(part % 2), y as f64 + 0.25 + 0.5 * f64::from(part / 2));
                let (longitude, latitude) = (PI - TAU * u / columns as f64, FRAC_PI_2 - PI * v / rows as f64);
                let direction = [longitude.sin() * latitude.cos(), latitude.sin(), longitude.cos() * latitude.cos()];
                let found = look_up(width, pixels, direction);
                pixel.iter_mut().zip(found).for_each(|(sum, value)| *sum += 0.25 * value);
            }
        }
    });
    Ok((columns, rows, out))
}

/// The face that a direction meets, and where: column and row of the whole picture, 0 the middle of the first pixel.
fn place(size: usize, [x, y, z]: [f64; 3]) -> (usize, f64, f64) {
    let last = (size - 1) as f64;
    let along = |value: f64, of: f64| (value / of + 1.0) / 2.0 * last;
    let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
    if ax >= ay && ax >= az {
        let (a, b) = (along(y, ax), along(z, ax));
        if x > 0.0 { (0, b, last - a) } else { (1, last - b, last - a) }
    } else if ay >= az {
        let (a, b) = (along(x, ay), along(z, ay));
        if y > 0.0 { (2, a, last - b) } else { (3, a, b) }
    } else {
        let (a, b) = (along(x, az), along(y, az));
        if z > 0.0 { (4, last - a, last - b) } else { (5, a, last - b) }
    }
}

/// The value in a direction, linearly between the pixels of its face, whose outer ones lie on its edges.
fn look_up(size: usize, pixels: &[f32], direction: [f64; 3]) -> [f32; 3] {
    let (face, x, y) = place(size, direction);
    let (left, top) = ((x as usize).min(size - 1), (y as usize).min(size - 1));
    let (right, below) = ((left + 1).min(size - 1), (top + 1).min(size - 1));
    let (across, down) = ((x - left as f64) as f32, (y - top as f64) as f32);
    let at = |x: usize, y: usize, c: usize| pixels[3 * ((face * size + y) * size + x) + c];
    std::array::from_fn(|c| {
        let upper = at(left, top, c) * (1.0 - across) + at(right, top, c) * across;
        let lower = at(left, below, c) * (1.0 - across) + at(right, below, c) * across;
        upper * (1.0 - down) + lower * down
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The direction of a pixel of a cube, by the definition of the faces.
    fn direction(size: usize, face: usize, column: usize, row: usize) -> [f64; 3] {
        let last = size - 1;
        let side = |k: usize| k as f64 / last as f64 * 2.0 - 1.0;
        match face {
            0 => [1.0, side(last - row), side(column)],
            1 => [-1.0, side(last - row), side(last - column)],
            2 => [side(column), 1.0, side(last - row)],
            3 => [side(column), -1.0, side(row)],
            4 => [side(last - column), side(last - row), 1.0],
            _ => [side(column), side(last - row), -1.0],
        }
    }

    #[test]
    fn a_cube_of_directions_becomes_a_map_of_the_same_directions() {
        let size = 33;
        let mut pixels = Vec::new();
        for face in 0..6 {
            for row in 0..size {
                for column in 0..size {
                    let found = direction(size, face, column, row);
                    let length = found.iter().map(|value| value * value).sum::<f64>().sqrt();
                    pixels.extend(found.map(|value| (value / length + 2.0) as f32));
                }
            }
        }
        let (width, height, out) = from_cube(Path::new("a.exr"), &PictureLimits::default(), (size, 6 * size), &pixels).unwrap();
        assert_eq!((width, height), (132, 66));
        let at = |u: f64, v: f64| {
            let k = (v * height as f64) as usize * width + (u * width as f64) as usize;
            [0, 1, 2].map(|c| f64::from(out[3 * k + c]) - 2.0)
        };
        for (u, v, expected) in [
            (0.5, 0.5, [0.0, 0.0, 1.0]),
            (0.25, 0.5, [1.0, 0.0, 0.0]),
            (0.75, 0.5, [-1.0, 0.0, 0.0]),
            (0.001, 0.5, [0.0, 0.0, -1.0]),
            (0.3, 0.0, [0.0, 1.0, 0.0]),
            (0.3, 0.999, [0.0, -1.0, 0.0]),
            (0.375, 0.25, [0.5, 0.5_f64.sqrt(), 0.5]),
        ] {
            let found = at(u, v);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.04), "{u} {v}: {found:?}");
        }
        assert!(from_cube(Path::new("a.exr"), &PictureLimits::default(), (size, 5 * size), &pixels).is_err());
    }

    #[test]
    fn columns_move_to_their_places() {
        let width = 64;
        // A value that grows with the place in the whole, from border to border.
        let mut pixels: Vec<f32> = (0..width).flat_map(|k| [k as f32 / 63.0; 3]).collect();
        shift_columns(width, &mut pixels);
        for (k, pixel) in pixels.as_chunks::<3>().0.iter().enumerate() {
            assert!((pixel[0] - (k as f32 + 0.5) / 64.0).abs() < 1e-6);
        }
    }
}
