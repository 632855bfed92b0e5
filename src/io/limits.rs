//! How large a picture may be that is read: a header is a promise, and a file of a few bytes can promise more than any machine holds.

use crate::error::{Error, Result, check_range};
use crate::post::picture::MAX_SIDE;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Most pixels of any picture [millions]: [`MAX_SIDE`] squared.
pub(super) const ALL_MEGAPIXELS: f64 = (MAX_SIDE * MAX_SIDE) as f64 / 1e6;

/// More pixels than these come of a byte of a file only where one colour fills most of the picture.
const PIXELS_OF_A_BYTE: u64 = 64;

/// Pictures with no more than this part of the most pixels may be of one colour: 8 million by default, as a probe of 4096 x 2048 has.
const PART_OF_ONE_COLOUR: u64 = 30;

/// Bounds of what the readers of pictures take from a file before they refuse it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureLimits {
    /// Most pixels of a picture [millions], above 0 to 1073.741824, which is all that a picture can have. A million pixels take 12 MB in memory, and about as much again (luminance with chroma up to 32 MB more)
    /// while they are read. Default: 256, so that probes of 16384 x 8192 (134) are within.
    pub max_megapixels: f64,
}

impl Default for PictureLimits {
    fn default() -> Self {
        Self { max_megapixels: 256.0 }
    }
}

impl PictureLimits {
    /// Checks the limits themselves.
    ///
    /// # Errors
    /// [`Error::Input`] for one that is out of its range.
    pub fn validate(&self) -> Result<()> {
        check_range("max_megapixels", self.max_megapixels, 1e-6, ALL_MEGAPIXELS, "million pixels").map(|_| ())
    }

    /// The number of pixels of a picture of `width` x `height`, as the header of `path` says it, if it is within the limits.
    ///
    /// # Errors
    /// [`Error::File`] for a side of 0 or over [`MAX_SIDE`]; [`Error::Input`] for `max_megapixels` if the picture has more.
    pub fn check(&self, path: &Path, width: u64, height: u64) -> Result<usize> {
        self.validate()?;
        let possible = 1..=MAX_SIDE as u64;
        if !possible.contains(&width) || !possible.contains(&height) {
            return Err(Error::file(
                path,
                format!("the header says {width} x {height} pixels, where 1 to {MAX_SIDE} a side can be"),
            ));
        }
        let pixels = width * height;
        if pixels as f64 > self.max_megapixels * 1e6 {
            let least = (pixels as f64 / 1e3).ceil() / 1e3;
            let allowed = format!("at least {least} to read {}, whose header says {width} x {height} pixels", path.display());
            return Err(Error::input("max_megapixels", self.max_megapixels, allowed));
        }
        Ok(pixels as usize)
    }

    /// As [`Self::check`], for a picture that the `bytes` of a file make: a large one that so few bytes make is hardly a picture, and has to be asked for.
    ///
    /// # Errors
    /// As [`Self::check`].
    pub fn check_made_of(&self, path: &Path, (width, height): (u64, u64), bytes: u64) -> Result<usize> {
        let pixels = self.check(path, width, height)?;
        let least = ((PART_OF_ONE_COLOUR * pixels as u64) as f64 / 1e6).min(ALL_MEGAPIXELS);
        if pixels as u64 / PIXELS_OF_A_BYTE > bytes && self.max_megapixels < least {
            let allowed =
                format!("at least {least} to read {}, which makes {width} x {height} pixels of {bytes} bytes", path.display());
            return Err(Error::input("max_megapixels", self.max_megapixels, allowed));
        }
        Ok(pixels)
    }
}

/// The plain file `path`, to read from: a pipe could keep the reader waiting for ever.
///
/// # Errors
/// [`Error::File`].
pub(super) fn open_plain(path: &Path) -> Result<BufReader<File>> {
    let failed = |error: std::io::Error| Error::file(path, error);
    if !std::fs::metadata(path).map_err(failed)?.is_file() {
        return Err(Error::file(path, "no plain file"));
    }
    Ok(BufReader::with_capacity(1 << 18, File::open(path).map_err(failed)?))
}

/// `count` zeros, or an error where the memory for them is not to be had. They take room only as they are written to.
///
/// # Errors
/// [`Error::File`] for `path`, whose content they were to hold.
pub(super) fn zeros<T: Copy + Default>(path: &Path, count: usize) -> Result<Vec<T>> {
    // Asked for first where a refusal is an answer; the allocation of zeros itself knows none.
    let mut asked: Vec<T> = Vec::new();
    asked.try_reserve_exact(count).map_err(|_| no_memory::<T>(path, count))?;
    drop(asked);
    Ok(vec![T::default(); count])
}

fn no_memory<T>(path: &Path, count: usize) -> Error {
    let megabytes = count as f64 * size_of::<T>() as f64 / 1e6;
    Error::file(path, format!("there is no memory for the {megabytes:.0} MB that its content takes"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_probes_are_within_and_what_is_over_tells_how_to_have_it() {
        let limits = PictureLimits::default();
        let path = Path::new("a.exr");
        assert_eq!(limits.check(path, 16384, 8192).unwrap(), 1 << 27);
        let message = limits.check(path, 32768, 32768).unwrap_err().to_string();
        assert_eq!(
            message,
            "max_megapixels = 256: must be at least 1073.742 to read a.exr, whose header says 32768 x 32768 pixels"
        );
        let all = PictureLimits { max_megapixels: 1073.741824 };
        assert_eq!(all.check(path, 32768, 32768).unwrap(), 1 << 30);
        for (width, height) in [(0, 1), (1, 0), (32769, 1), (1, u64::MAX)] {
            assert!(matches!(all.check(path, width, height), Err(Error::File { .. })), "{width} x {height}");
        }
        for max_megapixels in [0.0, -1.0, 1e9, f64::NAN] {
            let message = PictureLimits { max_megapixels }.check(path, 1, 1).unwrap_err().to_string();
            assert!(message.starts_with("max_megapixels = ") && message.contains("1073.741824"), "{message}");
        }
    }

    #[test]
    fn memory_that_is_not_there_is_an_error() {
        let path = Path::new("a.exr");
        assert_eq!(zeros::<f32>(path, 3).unwrap(), [0.0; 3]);
        let message = zeros::<f32>(path, usize::MAX / 8).unwrap_err().to_string();
        assert!(message.starts_with("a.exr: there is no memory for the"), "{message}");
    }
}
