//! How fine a detail an eye resolves, and pictures without what is finer.
//!
//! Ward Larson, Rushmeier & Piatko 1997, eq. 14, a fit of Shaler's measurements (1937): the finest grating that is resolved has
//! ```text
//! R(A) = 17.25 arctan(1.4 log10 A + 0.35) + 25.72   [cycles per degree],   A the adaptation luminance [cd m-2]
//! ```
//! 50 by day, 7 in full moonlight, 2 in starlight. A picture of what is seen has pixels of 1 / (2 R); here it is blurred by the Gaussian with their variance, a standard deviation of
//! 1 / (2 R sqrt 12) degrees. The paper blurs each place by its own luminance; here the blur is that of the picture's adaptation, and places that are bright enough for the cones stay sharp.

use super::rods::Rods;
use crate::error::Result;
use crate::post::tone::frame::{Frame, exposed};
use crate::post::tone::gaussian::blurred;
use crate::progress::Progress;
use rayon::prelude::*;

/// Standard deviation under which a blur is not seen [pixels].
const NOT_SEEN: f64 = 0.3;

/// The finest resolved grating [cycles per degree] for an eye that is adapted to `adaptation` [cd m-2].
pub fn resolvable_cycles_per_degree(adaptation: f64) -> f64 {
    17.25 * (1.4 * adaptation.max(1e-12).log10() + 0.35).atan() + 25.72
}

/// XYZ [cd m-2] of all pixels of `frame` as rods resolve them that are adapted to `adaptation` [cd m-2], row-major (height, width, 3), with `loss` times the blur; nothing if
/// the picture is too coarse to show it, or too bright for rods. Progress is the stage "tone map".
///
/// # Errors
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn blurred_for_rods(frame: &Frame<'_>, adaptation: f64, loss: f64, progress: &Progress) -> Result<Option<Vec<f32>>> {
    let sigma_deg = loss / (2.0 * resolvable_cycles_per_degree(adaptation) * 12f64.sqrt());
    let grid = frame.grid();
    let sigma = sigma_deg / grid.pixel_angle().to_degrees();
    if sigma < NOT_SEEN || Rods::share_of(0.0, adaptation) == 0.0 {
        return Ok(None);
    }
    // A latitude-longitude picture is stretched along its rows towards the poles.
    let stretch = |row: usize| grid.latlong().map_or(1.0, |image| 1.0 / image.table()[row].theta.sin().max(1e-6));
    let matrix = frame.to_xyz().map(|row| row.map(|value| value as f32));
    let mut out = vec![0.0; frame.pixels.len()];
    for channel in 0..3 {
        let mut plane = vec![0.0; frame.width * frame.height];
        plane.par_chunks_mut(frame.width).enumerate().for_each(|(row, plane)| {
            plane.iter_mut().zip(frame.row(row)).for_each(|(value, &pixel)| *value = exposed(&matrix, pixel)[channel]);
        });
        let plane =
            blurred(&plane, (frame.width, crate::post::tone::edges(frame)), sigma, stretch, || progress.report("tone map", 0.0))?;
        out.par_chunks_mut(3).zip(&plane).with_min_len(1 << 12).for_each(|(out, &value)| out[channel] = value);
    }
    Ok(Some(out))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acuity_is_that_of_the_paper() {
        // checked against: Ward Larson et al. 1997, figure 10: about 50 cycles per degree at 1000 cd m-2, 2 at 1e-4; by hand 17.25 x arctan(4.55) + 25.72 = 49.1
        assert!((resolvable_cycles_per_degree(1000.0) - 49.1).abs() < 0.1, "{}", resolvable_cycles_per_degree(1000.0));
        assert!((resolvable_cycles_per_degree(1e-4) - 1.87).abs() < 0.03);
        assert!((resolvable_cycles_per_degree(0.02) - 6.52).abs() < 0.01, "{}", resolvable_cycles_per_degree(0.02));
        assert!(resolvable_cycles_per_degree(1e-8) > 0.2);
    }
}
