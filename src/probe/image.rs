//! A rendered probe: pixels, and what they mean.

use super::settings::ProbeSettings;
use crate::error::{Error, Result};
use crate::projection::Grid;
use glam::DVec3;
use rayon::prelude::*;

/// An image of the light from all directions: linear, in the colour space and scale of its settings.
#[derive(Clone, Debug)]
pub struct Probe {
    /// Width [pixels].
    pub width: usize,
    /// Height [pixels].
    pub height: usize,
    /// Values, row-major from the upper left, (height, width, 3).
    pub pixels: Vec<f32>,
    /// What was asked for.
    pub settings: ProbeSettings,
}

impl Probe {
    /// A probe of given `pixels`, row-major (height, width, 3).
    ///
    /// # Errors
    /// [`Error::Input`] for settings that no image can have, [`Error::Data`] if the number of values is not that of the settings or a value is not finite.
    pub fn new(pixels: Vec<f32>, settings: ProbeSettings) -> Result<Self> {
        settings.validate()?;
        let probe = Self { width: settings.width, height: settings.height(), pixels, settings };
        probe.validate()?;
        Ok(probe)
    }

    /// Checks that the pixels are as many as the settings say, and finite.
    ///
    /// # Errors
    /// [`Error::Data`] that says what is wrong, with the first pixel that is.
    pub fn validate(&self) -> Result<()> {
        let expected = 3 * self.width * self.height;
        if self.pixels.len() != expected {
            return Err(Error::data(format!(
                "a probe of {} x {} pixels has {} values, not {expected}",
                self.width,
                self.height,
                self.pixels.len()
            )));
        }
        // A block of values without a branch is checked as fast as memory can be read.
        let sound = |block: &[f32]| block.iter().fold(true, |sound, value| sound & value.is_finite());
        if self.pixels.par_chunks(1 << 14).all(sound) {
            return Ok(());
        }
        match self.pixels.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(k) => Err(Error::data(format!(
                "the probe's pixel (column {}, row {}) is not finite",
                k / 3 % self.width,
                k / 3 / self.width
            ))),
        }
    }

    /// The geometry of the pixels.
    pub fn grid(&self) -> Grid {
        self.settings.grid()
    }

    /// The three values of pixel (`column`, `row`).
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn pixel(&self, column: usize, row: usize) -> [f32; 3] {
        assert!(column < self.width && row < self.height, "no pixel ({column}, {row})");
        let k = 3 * (row * self.width + column);
        [self.pixels[k], self.pixels[k + 1], self.pixels[k + 2]]
    }

    /// Irradiance of a plane that faces `normal` (east, north, up; any length but 0): the integral of the pixels over their
    /// footprints times the cosine, in the probe's colour space and scale times sr.
    pub fn irradiance(&self, normal: DVec3) -> [f64; 3] {
        self.irradiances(&[normal])[0]
    }

    /// Irradiance of planes that face `normals`, in their order, each as [`Self::irradiance`] gives it: the pixels are gone through once for thousands of them.
    pub fn irradiances(&self, normals: &[DVec3]) -> Vec<[f64; 3]> {
        super::received::irradiances(self, normals)
    }
}
