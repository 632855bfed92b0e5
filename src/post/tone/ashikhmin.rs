//! Ashikhmin 2002, "A tone mapping algorithm for high contrast images": local contrast is kept, its surroundings are mapped by what an eye can tell apart (the thesis's figure 6). On luminance.
//!
//! The just noticeable difference TVI(L) (Ferwerda et al. 1996, simplified) makes a scale of perceived steps, the capacity
//! ```text
//! C(L) = integral of dL / TVI(L) = L / 0.0014                            L < 0.0034 cd m-2
//!                                  2.4483 + ln(L / 0.0034) / 0.4027      below 1
//!                                  16.5630 + (L - 1) / 0.4027            below 7.2444
//!                                  32.0693 + ln(L / 7.2444) / 0.0556     above
//! ```
//! (the first piece with 0.0034 / 2.4483 in place of the rounded 0.0014, so that C has no step), and steps of the scene become as many of the screen:
//! ```text
//! TM(A) = D (C(A) - C(Lmin)) / (C(Lmax) - C(Lmin)),      Ld = TM(A) L / A
//! ```
//! D is the luminance of the screen's white, Lmin and Lmax the limits of the picture, A a pixel's surroundings: the mean over a Gaussian of s pixels with the largest s up to 10 for which the
//! local contrast |G_s - G_2s| / G_s stays under 0.5. The paper's second form of the detail, by TVI, differs from the ratio L / A where TVI is not in proportion to L.
//!
//! The operator works with absolute luminances: exposure does not change what a step is, so exposure by hand moves the limits' result as a factor and no more.

use super::frame::Frame;
use super::gaussian::blurred;
use super::metering::{Metering, luminance_plane};
use super::operator::Field;
use crate::error::Result;
use crate::progress::Progress;
use rayon::prelude::*;

/// Ends of the pieces of C [cd m-2] and its values there.
const PIECES: [(f64, f64); 3] = [(0.0034, 2.4483), (1.0, 16.5630), (7.2444, 32.0693)];

/// The operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ashikhmin {
    /// Local contrast that ends the growth of the surroundings, 0.01 to 10.
    pub threshold: f64,
    /// Largest surroundings, 1 to 20 [pixels].
    pub largest_scale: f64,
    /// What is black: 1 the darkest of the picture, as in the paper; 0 no light at all, which leaves the grey tone that the thesis speaks of. 0 to 1, in steps of the eye.
    pub stretch: f64,
}

impl Default for Ashikhmin {
    fn default() -> Self {
        Self { threshold: 0.5, largest_scale: 10.0, stretch: 1.0 }
    }
}

/// Steps that an eye can tell apart from darkness to `luminance` [cd m-2].
pub fn capacity(luminance: f64) -> f64 {
    let [(dark, at_dark), (one, at_one), (bright, at_bright)] = PIECES;
    if luminance < dark {
        luminance * at_dark / dark
    } else if luminance < one {
        at_dark + (luminance / dark).ln() / 0.4027
    } else if luminance < bright {
        at_one + (luminance - one) / 0.4027
    } else {
        at_bright + (luminance / bright).ln() / 0.0556
    }
}

impl Ashikhmin {
    pub(super) fn fields(&mut self) -> Vec<Field<'_>> {
        vec![
            Field::new("threshold", &mut self.threshold, 0.01, 10.0),
            Field::new("largest_scale", &mut self.largest_scale, 1.0, 20.0),
            Field::new("stretch", &mut self.stretch, 0.0, 1.0),
        ]
    }

    /// What a luminance becomes in even surroundings of the same [cd m-2, 0 to 1].
    pub fn curve(&self, metering: &Metering) -> impl Fn(f32) -> f32 + Sync + use<> {
        let (lowest, greatest) = (capacity(metering.lowest), capacity(metering.highest));
        // An even picture, for which the paper has no answer, is white.
        let least = if greatest > lowest { self.stretch * lowest } else { 0.0 };
        let whole = if greatest > least { 1.0 / (greatest - least) } else { 0.0 };
        move |luminance| ((capacity(f64::from(luminance)) - least) * whole).clamp(0.0, 1.0) as f32
    }

    /// Factor on the luminance in cd m-2 of every pixel: TM(A) / A.
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn factors(&self, frame: &Frame<'_>, metering: &Metering, progress: &Progress) -> Result<Vec<f32>> {
        let luminance = luminance_plane(frame, 1.0);
        let scales = self.largest_scale.round() as usize;
        let parts = progress.parts("tone map", scales);
        let shape = (frame.width, super::edges(frame));
        let gaussian = |s: usize| blurred(&luminance, shape, 0.5 * s as f64, |_| 1.0, || parts.check());
        // G_2s is the centre of a later scale.
        let mut kept = std::collections::BTreeMap::new();
        let mut chosen = luminance.clone();
        let mut growing = vec![true; luminance.len()];
        let threshold = self.threshold as f32;
        for s in 1..=scales {
            let centre = kept.remove(&s).map_or_else(|| gaussian(s), Ok)?;
            let surround = gaussian(2 * s)?;
            let grow = |(((chosen, growing), centre), surround): (((&mut f32, &mut bool), &f32), &f32)| {
                *growing &= (centre - surround).abs() < threshold * centre;
                if *growing {
                    *chosen = *centre;
                }
            };
            chosen.par_iter_mut().zip(&mut growing).zip(&centre).zip(&surround).with_min_len(1 << 14).for_each(grow);
            if 2 * s <= scales {
                kept.insert(2 * s, surround);
            }
            parts.finish_one()?;
        }
        let curve = self.curve(metering);
        chosen.par_iter_mut().with_min_len(1 << 14).for_each(|value| {
            *value = if *value > 0.0 { curve(*value) / *value } else { 0.0 };
        });
        Ok(chosen)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capacity_is_the_published_function_and_has_no_step() {
        // checked against: Ashikhmin 2002, eq. for C(L): 16.5630 at 1, 32.0693 at 7.2444 cd m-2
        assert!((capacity(1.0 - 1e-9) - 16.5630).abs() < 1e-3 && (capacity(7.2444 - 1e-9) - 32.0693).abs() < 1e-3);
        // checked against: the same, by hand for 1000 cd m-2: 32.0693 + ln(138.037) / 0.0556 = 120.69
        assert!((capacity(1000.0) - 120.69).abs() < 0.01, "{}", capacity(1000.0));
        for (end, value) in PIECES {
            assert!((capacity(end * (1.0 - 1e-9)) - value).abs() < 1e-3, "{end}");
        }
        assert_eq!(capacity(0.0), 0.0);
        // A step is TVI: 0.0556 L by day, 0.4027 cd m-2 at 3, 0.4027 L at 0.1.
        for (luminance, step) in [(1000.0, 55.6), (3.0, 0.4027), (0.1, 0.04027)] {
            let slope = (capacity(luminance * 1.0001) - capacity(luminance * 0.9999)) / (2e-4 * luminance);
            assert!((slope * step - 1.0).abs() < 1e-3, "{luminance}");
        }
    }
}
