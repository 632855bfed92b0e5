//! Glare: what scattering and diffraction in the eye make of light that is brighter than any screen (thesis 7.1; Spencer et al. 1995).
//!
//! ```text
//! picture ──> repaired ──> light that glares + the rest
//! light that glares ──> unscattered part + scattered part (corona, veil, halo, with streaks) ──> + the rest
//! ```
//! [`psf`] has the point spread functions; flat pictures ([`planar`]) are convolved by FFT ([`convolve`]), probes on the sphere ([`sphere`]).
//!
//! Energy is kept: what a kernel scatters within its reach is taken from its unscattered part. In a flat picture light that is scattered over its border leaves it; what would be scattered beyond
//! the reach of the filter stays unscattered.

pub mod adaptation;
pub mod convolve;
pub mod halo;
pub mod planar;
pub mod psf;
pub mod scatter;
pub mod sphere;
pub mod streaks;
#[cfg(test)]
mod tests;

pub use psf::{AdaptationState, point_spread};

use super::{Picture, Repairs};
use crate::error::{Result, check_range};
use crate::progress::Progress;
use convolve::{Convolution, Kernel};
use planar::PlanarKernel;
use rayon::prelude::*;
use scatter::Scatter;

/// The threshold that [`Glaring::Automatic`] takes, in mean luminances of the picture ([`adaptation::mean_luminance`]): four stops and a third above what a screen shows as middle grey, where
/// highlights have no room left. A choice of this program, not of a paper.
pub const AUTOMATIC_THRESHOLD: f64 = 20.0;

/// Values above this do not glare: no light has them in any scale, and in a sum they would drown the rest.
pub const MOST_GLARING: f32 = 1e12;

/// Which light glares.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Glaring {
    /// What exceeds [`AUTOMATIC_THRESHOLD`] times the mean luminance.
    #[default]
    Automatic,
    /// What exceeds a luminance [cd m-2]: of a brighter pixel the difference, so that a smooth picture stays smooth.
    Excess(f64),
    /// All light of pixels brighter than a luminance [cd m-2], as in the thesis. Where a smooth sky crosses the threshold, an edge shows.
    Pixels(f64),
    /// All light, as in the eye. For pictures that are not looked at in their own size and brightness: the viewer's eye does the same once more.
    AllLight,
}

/// How to apply glare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlareOptions {
    /// State of the eye; `None` for that of the picture's mean luminance ([`adaptation::mean_luminance`]).
    pub state: Option<AdaptationState>,
    /// Which light glares.
    pub glaring: Glaring,
    /// Width and height of the filter in widths and heights of the picture, 0.01 to 2: at 2 every pixel reaches every other. A probe on the sphere ignores it.
    pub size: f64,
    /// Draws the streaks.
    pub seed: u64,
    /// Contrast of the streaks, 0 (a smooth corona) to 1 (lines on black, as in the thesis).
    pub streaks: f64,
}

impl Default for GlareOptions {
    fn default() -> Self {
        Self { state: None, glaring: Glaring::default(), size: 2.0, seed: 0, streaks: 0.6 }
    }
}

impl GlareOptions {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::Input`](crate::Error::Input).
    pub fn validate(&self) -> Result<()> {
        check_range("size", self.size, 0.01, 2.0, "pictures")?;
        check_range("streaks", self.streaks, 0.0, 1.0, "")?;
        if let Glaring::Excess(threshold) | Glaring::Pixels(threshold) = self.glaring {
            check_range("threshold", threshold, 0.0, 1e12, "cd m-2")?;
        }
        Ok(())
    }
}

/// What was done to a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlareReport {
    /// The state of the eye.
    pub state: AdaptationState,
    /// Mean luminance of the picture [cd m-2]; see [`adaptation::mean_luminance`].
    pub mean_luminance: f64,
    /// The threshold [cd m-2]; `None` if all light glared.
    pub threshold: Option<f64>,
    /// How many pixels had light that glared.
    pub glaring_pixels: usize,
    /// How many were too bright to be light ([`MOST_GLARING`]) and kept what they had.
    pub too_bright: usize,
    /// Which share of the glaring light of each channel was not scattered.
    pub unscattered: [f64; 3],
    /// Values that were no light.
    pub repairs: Repairs,
}

/// Adds glare to `picture`. Progress is the stage "glare".
///
/// # Errors
/// [`Error::Input`](crate::Error::Input) for options out of range and latitude-longitude pictures that are neither 2:1 nor 4:1; [`Error::Cancelled`](crate::Error::Cancelled), with the
/// picture half done.
pub fn glare(picture: &mut Picture, options: &GlareOptions, progress: &Progress<'_>) -> Result<GlareReport> {
    options.validate()?;
    let grid = picture.grid();
    if grid.azimuthal().is_none() {
        sphere::geometry(picture)?;
    }
    let repairs = picture.repair();
    let mean_luminance = adaptation::mean_luminance(picture)?;
    let state = options.state.unwrap_or_else(|| AdaptationState::of_luminance(mean_luminance));
    let glaring = match options.glaring {
        Glaring::Automatic => Glaring::Excess(AUTOMATIC_THRESHOLD * mean_luminance),
        chosen => chosen,
    };
    let threshold = match glaring {
        Glaring::Excess(threshold) | Glaring::Pixels(threshold) => Some(threshold),
        Glaring::AllLight | Glaring::Automatic => None,
    };
    let share = shares(picture, glaring);
    let glaring_pixels = share.par_iter().filter(|&&share| share > 0.0).count();
    let too_bright = picture.pixels.as_chunks::<3>().0.par_iter().filter(|pixel| is_too_bright(pixel)).count();
    let mut report = GlareReport { state, mean_luminance, threshold, glaring_pixels, too_bright, unscattered: [1.0; 3], repairs };
    if glaring_pixels > 0 {
        let scatter = Scatter::new(state, picture.color_space, options.seed, options.streaks);
        report.unscattered = match grid.azimuthal() {
            Some(image) => {
                let kernel = PlanarKernel::new(image, &scatter);
                let reach = |side: usize| (0.5 * options.size * side as f64).ceil() as usize;
                let size = (picture.width, picture.height);
                let convolution = Convolution::new(size, (reach(size.0), reach(size.1)), &kernel);
                convolution.apply(&mut picture.pixels, &share, progress)?
            }
            None => sphere::apply(picture, &share, &scatter, progress)?,
        };
    }
    progress.report("glare", 1.0)?;
    Ok(report)
}

impl Kernel for PlanarKernel<'_> {
    fn at(&self, right: isize, up: isize) -> [f32; 3] {
        Self::at(self, right, up)
    }

    fn unscattered(&self) -> Vec<f64> {
        Self::unscattered(self)
    }

    fn coloured_within(&self) -> f64 {
        Self::coloured_within(self)
    }
}

fn is_too_bright(pixel: &[f32; 3]) -> bool {
    pixel.iter().any(|value| value.abs() > MOST_GLARING)
}

/// Which part of each pixel's light glares.
fn shares(picture: &Picture, glaring: Glaring) -> Vec<f32> {
    let weights = picture.color_space.matrix_to_xyz()[1].map(|weight| weight * picture.white_luminance);
    let share = |pixel: &[f32; 3]| {
        if is_too_bright(pixel) {
            return 0.0;
        }
        let luminance: f64 = (0..3).map(|c| weights[c] * f64::from(pixel[c])).sum();
        match glaring {
            Glaring::AllLight | Glaring::Automatic => 1.0,
            Glaring::Pixels(threshold) => f32::from(luminance > threshold),
            Glaring::Excess(threshold) if luminance > threshold => (1.0 - threshold / luminance) as f32,
            Glaring::Excess(_) => 0.0,
        }
    };
    picture.pixels.as_chunks::<3>().0.par_iter().map(share).collect()
}
