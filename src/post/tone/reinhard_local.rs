//! Photographic tone reproduction, local: dodging and burning (Reinhard, Stark, Shirley & Ferwerda 2002, eqs. 5 to 9). On luminance: hue and ratios of the channels are kept.
//!
//! ```text
//! V_i(s) = L * R_i(s),  R_i(x, y, s) = exp(-(x^2 + y^2) / (alpha_i s)^2) / (pi (alpha_i s)^2)
//! V(s) = (V_1(s) - V_2(s)) / (2^phi a / s^2 + V_1(s))
//! Ld = L / (1 + V_1(s_m)),  s_m the largest scale with |V| < threshold at it and at all smaller ones
//! ```
//! L is the exposed luminance, a = 0.18 the key, alpha_1 = 1 / (2 sqrt 2), alpha_2 = 1.6 alpha_1, scales s = 1.6^k pixels, k from 0 to 7: the paper's numbers, so V_2 of a scale is V_1 of
//! the next. Distances are in pixels of the picture as it is, also in a probe, whose borders join.

use super::frame::Frame;
use super::gaussian::blurred;
use super::metering::luminance_plane;
use super::operator::Field;
use crate::error::Result;
use crate::progress::Progress;
use rayon::prelude::*;

/// Ratio of one scale to the next, and of surround to centre.
const RATIO: f64 = 1.6;

/// The paper's key a.
const KEY: f64 = super::exposure::MIDDLE_GREY;

/// The operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReinhardLocal {
    /// Sharpening phi, 1 to 15.
    pub sharpening: f64,
    /// Difference of centre and surround that ends the growth of the scale, 0.001 to 1.
    pub threshold: f64,
    /// Number of scales, 1 to 12.
    pub scales: f64,
}

impl Default for ReinhardLocal {
    fn default() -> Self {
        Self { sharpening: 8.0, threshold: 0.05, scales: 8.0 }
    }
}

impl ReinhardLocal {
    pub(super) fn fields(&mut self) -> Vec<Field<'_>> {
        vec![
            Field::new("sharpening", &mut self.sharpening, 1.0, 15.0),
            Field::new("threshold", &mut self.threshold, 1e-3, 1.0),
            Field::new("scales", &mut self.scales, 1.0, 12.0),
        ]
    }

    /// The local average V_1(s_m) of every pixel.
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn surround(&self, frame: &Frame<'_>, exposure: f64, progress: &Progress) -> Result<Vec<f32>> {
        let luminance = luminance_plane(frame, exposure);
        let scales = self.scales.round() as usize;
        let parts = progress.parts("tone map", scales + 1);
        // exp(-r^2 / (alpha s)^2) has a standard deviation of alpha s / sqrt 2 along an axis.
        let shape = (frame.width, super::edges(frame));
        let at_scale = |s: f64| blurred(&luminance, shape, s / (2.0 * 2f64.sqrt()) / 2f64.sqrt(), |_| 1.0, || parts.check());
        let mut centre = at_scale(1.0)?;
        parts.finish_one()?;
        let mut chosen = centre.clone();
        // Whether the scale still grows.
        let mut growing = vec![true; luminance.len()];
        for k in 0..scales {
            let s = RATIO.powi(k as i32);
            let surround = at_scale(s * RATIO)?;
            let offset = (self.sharpening.exp2() * KEY / (s * s)) as f32;
            let threshold = self.threshold as f32;
            let grow = |(((chosen, growing), centre), surround): (((&mut f32, &mut bool), &f32), &f32)| {
                *growing &= ((centre - surround) / (offset + centre)).abs() < threshold;
                if *growing {
                    *chosen = *centre;
                }
            };
            chosen.par_iter_mut().zip(&mut growing).zip(&centre).zip(&surround).with_min_len(1 << 14).for_each(grow);
            centre = surround;
            parts.finish_one()?;
        }
        Ok(chosen)
    }
}
