//! How bright a picture is, as an exposure meter and as an eye see it.
//!
//! Of a probe only the upper half counts, by solid angle; of a camera's picture all pixels, by solid angle. The brightest 2 % (the Sun and its aureole, a lamp) and what
//! is under a thousandth of the median count for no average.

use super::frame::{Frame, dot, exposed, weight};

/// Number of pixels that are looked at, about.
const SAMPLES: usize = 100_000;

/// Share of the light's directions that is dimmer than the brightest ones left out.
const BRIGHTEST_COUNTED: f64 = 0.98;

/// Least luminance that is told apart from darkness [cd m-2]: about the absolute threshold of the eye.
pub const DARKNESS: f64 = 1e-6;

/// Luminances of a picture [cd m-2]; all zero for a black one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Metering {
    /// Mean of the logarithm, without the brightest 2 % and what is nearly black: the middle of the picture.
    pub log_average: f64,
    /// 95th percentile: the bright parts.
    pub bright: f64,
    /// Smallest luminance of all pixels.
    pub lowest: f64,
    /// Largest luminance of all pixels.
    pub highest: f64,
}

impl Metering {
    /// Meters `frame`.
    pub fn of(frame: &Frame<'_>) -> Self {
        let luminance = frame.to_xyz()[1].map(|value| value as f32);
        let matrix = [luminance, [0.0; 3], [0.0; 3]];
        let (lowest, highest) = super::rows(frame.height, |row| {
            frame.row(row).iter().fold((f32::MAX, 0.0f32), |(lowest, highest), &pixel| {
                let luminance = exposed(&matrix, pixel)[0].max(0.0);
                (lowest.min(luminance), highest.max(luminance))
            })
        })
        .into_iter()
        .fold((f64::MAX, 0.0f64), |(lowest, highest), (low, high)| (lowest.min(low.into()), highest.max(high.into())));
        let step = (frame.width * frame.height / SAMPLES).max(1);
        let grid = frame.grid();
        let mut found: Vec<(f64, f64)> = (0..frame.width * frame.height)
            .step_by(step)
            .filter_map(|k| {
                let weight = weight(&*grid, k % frame.width, k / frame.width);
                let pixel = [0, 1, 2].map(|channel| frame.pixels[3 * k + channel]);
                let value = f64::from(exposed(&matrix, pixel)[0]);
                (value > 0.0 && weight > 0.0).then_some((value, weight))
            })
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let total: f64 = found.iter().map(|&(_, weight)| weight).sum();
        let mut passed = 0.0;
        let mut quantile = found.iter().map(|&(value, weight)| {
            passed += weight;
            (value, passed / total)
        });
        let mut at = |share: f64| quantile.find(|&(_, passed)| passed >= share).map(|(value, _)| value);
        let (Some(median), Some(bright)) = (at(0.5), at(0.95)) else { return Self { lowest, highest, ..Self::default() } };
        let brightest = at(BRIGHTEST_COUNTED).unwrap_or(bright);
        let (sum, counted) = found
            .iter()
            .filter(|&&(value, _)| value > 1e-3 * median && value <= brightest)
            .fold((0.0, 0.0), |(sum, counted), &(value, weight)| (sum + weight * value.ln(), counted + weight));
        Self { log_average: (sum / counted).exp(), bright, lowest, highest }
    }

    /// Luminance that an eye adapts to which looks about in the picture [cd m-2]: the geometric mean of the middle and of the bright parts, at least [`DARKNESS`].
    pub fn adaptation(&self) -> f64 {
        (self.log_average * self.bright).sqrt().max(DARKNESS)
    }
}

/// Luminance of every pixel, row-major [cd m-2 times `exposure`].
pub(super) fn luminance_plane(frame: &Frame<'_>, exposure: f64) -> Vec<f32> {
    use rayon::prelude::*;
    let weights = frame.to_xyz()[1].map(|value| (value * exposure) as f32);
    let mut plane = vec![0.0; frame.width * frame.height];
    plane.par_chunks_mut(frame.width).enumerate().for_each(|(row, out)| {
        for (out, &pixel) in out.iter_mut().zip(frame.row(row)) {
            *out = exposed(&[weights, [0.0; 3], [0.0; 3]], pixel)[0].max(0.0);
        }
    });
    debug_assert!(dot(weights, weights).is_finite());
    plane
}
