//! OpenEXR: float32 (or half) with ZIP compression, and a header that says what the picture is.
//!
//! Standard attributes: `chromaticities`, `whiteLuminance`, `latitude`, `longitude`, `altitude`, `capDate`, `utcOffset`, `wrapmodes`,
//! `comments`, `software`, `colorInteropID`; our own begin with `skyprobe.`. Pixels in XYZ are in the channels R, G, B with the chromaticities of XYZ, as the
//! OpenEXR documentation proposes.
//!
//! `envmap` is never written: its `latlong` puts the first and last columns both on the seam and the poles on the first and
//! last rows, with other axes; none of our layouts has columns there, and a reader that believed it would turn the sky.
//!
//! Files are written by this module itself (`header`, `blocks`), because attributes in a fixed order make equal probes equal files, and blocks
//! that stand alone can be packed while the next rows are still being rendered.
//!
//! Files are read by this module too (`part`, `chunks`, `channels`): it takes no more memory than what is there and the limits allow, and reads one layer of many, sub-sampled channels, and what others
//! write in their headers. Blocks are unpacked by the crate `exr` (`codec`).

mod attributes;
mod blocks;
mod channels;
mod chroma;
mod chunks;
mod codec;
pub(super) mod envmap;
mod header;
mod part;
mod picture;
mod source;

pub(super) use blocks::Packing;
pub(super) use header::{header, picture_header};

use super::read::Raw;
use super::{Half, PictureLimits};
use crate::error::{Error, Result};
use crate::probe::Probe;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;

/// Greatest finite half float.
pub const HALF_MAX: f32 = 65504.0;

/// The power of two that brings all pixels of `probe` within half floats: 1 if they are.
pub fn half_scale(probe: &Probe) -> f32 {
    scale_of(Largest::of(0, &probe.pixels).value)
}

fn scale_of(largest: f32) -> f32 {
    let mut scale = 1.0;
    while largest * scale > HALF_MAX {
        scale *= 0.5;
    }
    scale
}

/// The value of greatest magnitude in a picture, and where it is; of equal ones the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Largest {
    value: f32,
    index: usize,
}

impl Largest {
    /// Of `values`, the first of which has the index `first` in the picture.
    pub fn of(first: usize, values: &[f32]) -> Self {
        const BLOCK: usize = 1 << 14;
        let in_block = |(block, values): (usize, &[f32])| {
            let value = values.iter().fold(0.0, |largest: f32, value| largest.max(value.abs()));
            let index = values.iter().position(|found| found.abs() == value).unwrap_or(0);
            Self { value, index: first + block * BLOCK + index }
        };
        values.par_chunks(BLOCK).enumerate().map(in_block).reduce(Self::default, Self::or)
    }

    /// The larger of two.
    pub fn or(self, other: Self) -> Self {
        let better = other.value > self.value || (other.value == self.value && other.index < self.index);
        if better { other } else { self }
    }
}

/// The factor on the pixels of a picture of `width` whose largest value is `largest`.
///
/// # Errors
/// [`Error::Input`] if half floats were asked for that cannot hold it.
pub(super) fn pixel_scale(half: Half, largest: Largest, width: usize) -> Result<f32> {
    match half {
        Half::Scale => Ok(scale_of(largest.value)),
        Half::Refuse if largest.value > HALF_MAX => {
            let pixel = largest.index / 3;
            Err(Error::input(
                "half",
                format!("{} in the pixel at column {}, row {}", largest.value, pixel % width, pixel / width),
                "at most 65504: write float32, leave the Sun's disc out, or choose half = scale",
            ))
        }
        Half::Off | Half::Refuse => Ok(1.0),
    }
}

/// The texts and numbers of the header that `bytes` begin with, by name; of several parts the first. An error is a reason.
pub(crate) fn header_fields(bytes: &[u8]) -> std::result::Result<BTreeMap<String, String>, String> {
    let header =
        source::Source::new(Path::new("header"), Cursor::new(bytes)).and_then(|mut source| part::Header::read(&mut source));
    let header = header.map_err(|error| match error {
        Error::File { reason, .. } => reason,
        other => other.to_string(),
    })?;
    header.parts.into_iter().next().map(|first| first.texts).ok_or_else(|| "no header".to_owned())
}

/// What [`read`] found.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width [pixels].
    pub width: usize,
    /// Height [pixels].
    pub height: usize,
    /// Values of red, green and blue as stored, row-major (height, width, 3).
    pub pixels: Vec<f32>,
    /// The header's texts and numbers by name, as text.
    pub attributes: BTreeMap<String, String>,
}

/// Reads the colours and the header of an EXR file: all data, of the channels that [`read_picture`](super::read_picture) would take.
///
/// # Errors
/// As [`read_within`], with the default limits.
pub fn read(path: impl AsRef<Path>) -> Result<Picture> {
    read_within(path, &PictureLimits::default())
}

/// Does what [`read`] does, within `limits`.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Data`] if it has no such channels, [`Error::Input`] if it is over the limits.
pub fn read_within(path: impl AsRef<Path>, limits: &PictureLimits) -> Result<Picture> {
    let raw = picture::read_rgb(path.as_ref(), limits, picture::Pixels::Stored)?;
    Ok(Picture { width: raw.width, height: raw.height, pixels: raw.pixels, attributes: raw.fields })
}

/// The picture in the file `path`.
pub(super) fn read_rgb(path: &Path, limits: &PictureLimits) -> Result<Raw> {
    picture::read_rgb(path, limits, picture::Pixels::Picture)
}

/// The picture in the bytes of a file, which messages call `path`.
pub(super) fn parse_rgb(path: &Path, bytes: &[u8], limits: &PictureLimits) -> Result<Raw> {
    picture::parse_rgb(path, Cursor::new(bytes), limits, picture::Pixels::Picture)
}

#[cfg(test)]
mod foreign;

#[cfg(test)]
mod tests {
    use super::super::{FileOptions, Metadata, save, tests::gradient};
    use super::*;
    use crate::probe::{ProbeSettings, Rows};
    use crate::units::Scale;
    use ::exr::prelude::Compression;

    fn options(half: Half) -> FileOptions {
        FileOptions { half, ..Default::default() }
    }

    #[test]
    fn float_pixels_come_back_exactly_with_their_header() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.exr");
        let settings = ProbeSettings { width: 64, rows: Rows::Corner, scale: Scale::Mitsuba, ..Default::default() };
        let probe = gradient(settings);
        let metadata = Metadata {
            latitude_deg: Some(55.75),
            longitude_deg: Some(13.1875),
            elevation_m: Some(20.5),
            capture_date: Some("2005:06:21 13:00:00".to_owned()),
            utc_offset_s: Some(7200.0),
            sun_altitude_deg: Some(57.5),
            sun_azimuth_deg: Some(170.25),
            config_json: Some("{\"width\": 64}".to_owned()),
            comments: Some("Århus, 東京".to_owned()),
        };
        save(&path, &probe, &FileOptions::default(), &metadata).unwrap();
        let found = read(&path).unwrap();
        let meta = ::exr::meta::MetaData::read_from_file(&path, true).unwrap();
        assert_eq!(meta.headers[0].blocks, ::exr::meta::BlockDescription::ScanLines);
        assert_eq!(meta.headers[0].compression, Compression::ZIP16);
        assert_eq!((found.width, found.height), (64, 32));
        assert!(found.pixels == probe.pixels);
        let expected = [
            ("latitude", "55.75"),
            ("longitude", "13.1875"),
            ("altitude", "20.5"),
            ("capDate", "2005:06:21 13:00:00"),
            ("utcOffset", "-7200"),
            ("wrapmodes", "periodic,clamp"),
            ("comments", "Århus, 東京"),
            ("colorInteropID", "lin_rec709_scene"),
            ("skyprobe.rows", "corner"),
            ("skyprobe.scale", "mitsuba"),
            ("skyprobe.color_space", "lin_rec709"),
            ("skyprobe.projection", "latlong"),
            ("skyprobe.sun_altitude_deg", "57.500000"),
            ("skyprobe.sun_azimuth_deg", "170.250000"),
            ("skyprobe.config", "{\"width\": 64}"),
            ("skyprobe.version", env!("CARGO_PKG_VERSION")),
        ];
        for (name, value) in expected {
            assert_eq!(found.attributes.get(name).map(String::as_str), Some(value), "{name}");
        }
        let white: f64 = found.attributes["whiteLuminance"].parse().unwrap();
        assert!((white / (683.0 * 106.857) - 1.0).abs() < 1e-6);
        assert!(found.attributes["chromaticities"].contains("0.64"));
        assert!(!found.attributes.contains_key("envmap") && !found.attributes.contains_key("skyprobe.pixel_scale"));
    }

    #[test]
    fn half_floats_refuse_or_scale_what_they_cannot_hold() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.exr");
        let mut probe = gradient(ProbeSettings { width: 64, ..Default::default() });
        save(&path, &probe, &options(Half::Refuse), &Metadata::default()).unwrap();
        let found = read(&path).unwrap();
        assert!(found.pixels.iter().zip(&probe.pixels).all(|(a, b)| (a / b - 1.0).abs() < 0.001));
        std::fs::remove_file(&path).unwrap();

        probe.pixels[3 * (5 * 64 + 7) + 1] = 1_953_000.0;
        let message = save(&path, &probe, &options(Half::Refuse), &Metadata::default()).unwrap_err().to_string();
        assert!(message.starts_with("half = 1953000 in the pixel at column 7, row 5: must be at most 65504"), "{message}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);

        save(&path, &probe, &options(Half::Scale), &Metadata::default()).unwrap();
        let found = read(&path).unwrap();
        let scale: f32 = found.attributes["skyprobe.pixel_scale"].parse().unwrap();
        assert_eq!(scale, 1.0 / 32.0);
        assert!(found.attributes["comments"].contains("multiplied by 0.03125"));
        assert!((found.attributes["whiteLuminance"].parse::<f32>().unwrap() - 683.0 * 32.0).abs() < 0.01);
        assert!(found.pixels.iter().zip(&probe.pixels).all(|(a, b)| (a / scale / b - 1.0).abs() < 0.001));
    }
}
