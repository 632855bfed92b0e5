//! Gaussian blur of one value a pixel, as local operators need it.

use crate::error::Result;
use rayon::prelude::*;

/// What lies beyond the borders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edges {
    /// The border pixel again.
    Clamped,
    /// A latitude-longitude picture: the left border joins the right one; beyond the zenith lies the row itself, half a turn further. `nadir` if the last row is one at the nadir.
    Sphere {
        /// Whether the picture reaches down to the nadir.
        nadir: bool,
    },
}

/// Weights from the middle outwards, to three standard deviations, that add up to 1 over both sides.
fn kernel(sigma: f64) -> Vec<f32> {
    let reach = (3.0 * sigma).ceil().max(1.0) as usize;
    let value = |k: usize| (-0.5 * (k as f64 / sigma).powi(2)).exp();
    let sum = value(0) + 2.0 * (1..=reach).map(value).sum::<f64>();
    (0..=reach).map(|k| (value(k) / sum) as f32).collect()
}

/// `plane` (row-major, `width` wide) blurred by a Gaussian with the standard deviation `sigma` along the columns and `sigma` times `stretch(row)` along the rows [pixels].
/// `go_on` is asked once a row.
///
/// # Errors
/// That of `go_on`.
pub fn blurred(
    plane: &[f32],
    (width, edges): (usize, Edges),
    sigma: f64,
    stretch: impl Fn(usize) -> f64 + Sync,
    go_on: impl Fn() -> Result<()> + Sync,
) -> Result<Vec<f32>> {
    if sigma < 0.1 {
        return Ok(plane.to_vec());
    }
    let height = plane.len() / width;
    let mut across = vec![0.0; plane.len()];
    let even = kernel(sigma);
    across.par_chunks_mut(width).zip(plane.par_chunks(width)).enumerate().try_for_each(|(row, (out, input))| {
        go_on()?;
        let stretched = stretch(row);
        if stretched == 1.0 {
            blur_row(input, out, &even, edges);
        } else {
            // Wider than the row the mean of the row is all that is left.
            blur_row(input, out, &kernel((sigma * stretched).min(width as f64 / 3.0)), edges);
        }
        Ok(())
    })?;
    let mut out = vec![0.0; plane.len()];
    let reach = even.len() as isize - 1;
    out.par_chunks_mut(width).enumerate().try_for_each(|(row, out)| {
        go_on()?;
        for offset in -reach..=reach {
            let weight = even[offset.unsigned_abs()];
            let (row, turned) = beyond(row as isize + offset, height as isize, edges);
            let input = &across[row * width..(row + 1) * width];
            if turned {
                let half = width / 2;
                add(&mut out[..width - half], &input[half..], weight);
                add(&mut out[width - half..], &input[..half], weight);
            } else {
                add(out, input, weight);
            }
        }
        Ok(())
    })?;
    Ok(out)
}

/// The row that stands for `row`, and whether it is half a turn further.
fn beyond(row: isize, height: isize, edges: Edges) -> (usize, bool) {
    let clamped = row.clamp(0, height - 1) as usize;
    let Edges::Sphere { nadir } = edges else { return (clamped, false) };
    if row < 0 {
        ((-1 - row).min(height - 1) as usize, true)
    } else if row >= height && nadir {
        ((2 * height - 1 - row).max(0) as usize, true)
    } else {
        (clamped, false)
    }
}

fn blur_row(input: &[f32], out: &mut [f32], kernel: &[f32], edges: Edges) {
    let (width, reach) = (input.len(), kernel.len() - 1);
    let at = |k: isize| match edges {
        Edges::Clamped => input[k.clamp(0, width as isize - 1) as usize],
        Edges::Sphere { .. } => input[k.rem_euclid(width as isize) as usize],
    };
    let padded: Vec<f32> = (0..width + 2 * reach).map(|k| at(k as isize - reach as isize)).collect();
    out.fill(0.0);
    add(out, &padded[reach..reach + width], kernel[0]);
    for (k, &weight) in kernel.iter().enumerate().skip(1) {
        add(out, &padded[reach - k..reach - k + width], weight);
        add(out, &padded[reach + k..reach + k + width], weight);
    }
}

#[inline]
fn add(out: &mut [f32], input: &[f32], weight: f32) {
    out.iter_mut().zip(input).for_each(|(out, input)| *out += weight * input);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_plane_stays_and_a_point_becomes_a_gaussian() {
        for edges in [Edges::Clamped, Edges::Sphere { nadir: true }, Edges::Sphere { nadir: false }] {
            for value in blurred(&[2.5; 40 * 30], (40, edges), 4.0, |_| 1.0, || Ok(())).unwrap() {
                assert!((value - 2.5).abs() < 1e-5);
            }
        }
        let mut plane = vec![0.0; 41 * 41];
        plane[20 * 41 + 20] = 1.0;
        let found = blurred(&plane, (41, Edges::Clamped), 3.0, |_| 1.0, || Ok(())).unwrap();
        for (x, y) in [(20, 20), (22, 20), (20, 25), (24, 17)] {
            let r2 = f64::from((x - 20) * (x - 20) + (y - 20) * (y - 20));
            let expected = (-r2 / 18.0).exp() / (std::f64::consts::TAU * 9.0);
            let got = f64::from(found[(y * 41 + x) as usize]);
            // Cut at three standard deviations: 0.3 % of each direction's weight is missing.
            assert!((got / expected - 1.0).abs() < 0.007, "{x} {y}: {got} {expected}");
        }
    }

    #[test]
    fn a_sphere_has_no_seam_and_goes_on_beyond_the_zenith() {
        let mut plane = vec![0.0; 32 * 16];
        plane[3] = 1.0;
        let found = blurred(&plane, (32, Edges::Sphere { nadir: true }), 1.5, |_| 1.0, || Ok(())).unwrap();
        // Symmetric about column 3 over the seam; the point's image beyond the pole lies in column 19.
        assert!((found[0] - found[6]).abs() < 1e-7 && (found[31] - found[7]).abs() < 1e-7 && found[31] > 0.0);
        assert!(found[19] > 0.01 && found[11] < 1e-3);
        assert!((found.iter().sum::<f32>() - 1.0).abs() < 1e-5);
    }
}
