//! A picture of where the light of a sky was gathered, as in the thesis's figures 11 to 13: white points on the darkened sky.

use super::atomic::{Pending, commit};
use super::{Format, png};
use crate::error::{Error, Result};
use crate::post::tone::{Display, Frame, ToneMapper, ToneMapping};
use crate::probe::{self, ProbeSettings};
use crate::progress::Progress;
use crate::sky::SkyDome;
use std::f64::consts::{PI, TAU};
use std::path::Path;

/// Pixels of width for which the points are one pixel larger.
const PIXELS_PER_POINT: usize = 512;

/// A latitude-longitude picture, sRGB, laid out like a probe.
pub struct SampleMap {
    /// Width [pixels].
    pub width: usize,
    /// Height [pixels].
    pub height: usize,
    /// 8-bit sRGB, row-major, (height, width, 3).
    pub pixels: Vec<u8>,
}

impl SampleMap {
    /// The picture for `dome`, `width` pixels wide: its tone-mapped light at a third of its brightness, without the Sun's disc, and a white point in each direction that was gathered. These lie on one
    /// side of the Sun, as the other follows by symmetry.
    ///
    /// # Errors
    /// As [`probe::render`].
    pub fn new(dome: &SkyDome, width: usize, progress: &Progress) -> Result<Self> {
        let probe = probe::render(dome, &ProbeSettings { width, sun_disc: false, ..Default::default() }, progress)?;
        let mapper = ToneMapper::new(Frame::from(&probe), &ToneMapping::default(), progress)?;
        let mut pixels: Vec<u8> = mapper.to_8_bits(progress)?.into_iter().map(|value| value / 3).collect();
        let (width, height, size) = (probe.width, probe.height, 1 + width / PIXELS_PER_POINT);
        for [altitude, azimuth] in dome.sample_directions() {
            let across = ((0.25 + azimuth / TAU).rem_euclid(1.0) * width as f64) as usize;
            let down = ((0.5 - altitude / PI) * height as f64) as usize;
            // The last circle is a point, the zenith or the nadir, drawn as a line as everything there is.
            for row in down..(down + size).min(height) {
                for column in across..across + size {
                    let first = 3 * (row * width + column % width);
                    pixels[first..first + 3].fill(255);
                }
            }
        }
        Ok(Self { width, height, pixels })
    }

    /// Writes it as PNG, whole or not at all. Progress is the stage "write".
    ///
    /// # Errors
    /// [`Error::Input`] for a name that does not end in .png, [`Error::File`], [`Error::Cancelled`].
    pub fn save(&self, path: &Path, progress: &Progress) -> Result<()> {
        commit(vec![self.written(path, progress)?], progress)
    }

    /// The file, which waits for its name.
    pub(crate) fn written(&self, path: &Path, progress: &Progress) -> Result<Pending> {
        Self::check_name(path)?;
        let content = (Display::Srgb, &self.pixels[..]);
        Pending::written(path, |out| png::write_8(out, path, (self.width, self.height), content, progress))
    }

    /// Checks that `path` names a PNG.
    ///
    /// # Errors
    /// [`Error::Input`] for the parameter `sample_map`.
    pub fn check_name(path: &Path) -> Result<()> {
        match Format::of(path) {
            Ok(Format::Png) => Ok(()),
            _ => Err(Error::input("sample_map", path.display(), "a file name that ends in .png")),
        }
    }
}
