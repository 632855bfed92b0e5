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
//! that stand alone can be packed while the next rows are still being rendered. They are read by the crate `exr`.

mod blocks;
mod header;
mod picture;

pub(super) use blocks::Packing;
pub(super) use header::{header, picture_header};
pub(super) use picture::read_rgb;

use super::Half;
use crate::error::{Error, Result};
use crate::probe::Probe;
use ::exr::meta::attribute::{AttributeValue, Text};
use ::exr::meta::header::{ImageAttributes, LayerAttributes};
use ::exr::prelude::{ReadChannels, ReadLayers, Vec2};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::BufReader;
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

fn string(value: &Text) -> String {
    let bytes: Vec<u8> = value.to_string().chars().map(|character| character as u8).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Texts and numbers of a header by name, as text.
fn texts(shared: &ImageAttributes, own: &LayerAttributes) -> BTreeMap<String, String> {
    let mut attributes = BTreeMap::new();
    let mut put = |name: &str, value: Option<String>| {
        if let Some(value) = value {
            attributes.insert(name.to_owned(), value);
        }
    };
    let number = |value: Option<f32>| value.map(|value| value.to_string());
    put("whiteLuminance", number(own.white_luminance));
    put("latitude", number(own.latitude));
    put("longitude", number(own.longitude));
    put("altitude", number(own.altitude));
    put("utcOffset", number(own.utc_offset));
    put("capDate", own.capture_date.as_ref().map(string));
    put("wrapmodes", own.wrap_mode_name.as_ref().map(string));
    put("comments", own.comments.as_ref().map(string));
    put("software", own.software_name.as_ref().map(string));
    put("envmap", own.environment_map.as_ref().map(|map| format!("{map:?}")));
    put("chromaticities", shared.chromaticities.map(|found| format!("{found:?}")));
    for (name, value) in own.other.iter().chain(&shared.other) {
        match value {
            AttributeValue::Text(value) => put(&string(name), Some(string(value))),
            AttributeValue::F32(value) => put(&string(name), Some(value.to_string())),
            AttributeValue::F64(value) => put(&string(name), Some(value.to_string())),
            AttributeValue::I32(value) => put(&string(name), Some(value.to_string())),
            _ => {}
        }
    }
    attributes
}

/// The texts and numbers of the header that `source` begins with, by name; of several parts the first. An error is a reason.
pub(super) fn header_fields(source: impl std::io::Read) -> std::result::Result<BTreeMap<String, String>, String> {
    let meta = ::exr::meta::MetaData::read_from_buffered(BufReader::new(source), false).map_err(|error| error.to_string())?;
    let first = meta.headers.first().ok_or("no header")?;
    Ok(texts(&first.shared_attributes, &first.own_attributes))
}

/// What [`read`] found.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width [pixels].
    pub width: usize,
    /// Height [pixels].
    pub height: usize,
    /// Values of R, G and B as stored, row-major (height, width, 3).
    pub pixels: Vec<f32>,
    /// The header's texts and numbers by name, as text.
    pub attributes: BTreeMap<String, String>,
}

/// Reads the RGB channels and the header of an EXR file.
///
/// # Errors
/// [`Error::File`] if it cannot be read or has no such channels.
pub fn read(path: impl AsRef<Path>) -> Result<Picture> {
    let path = path.as_ref();
    let file = std::fs::File::open(path).map_err(|error| Error::file(path, error))?;
    let image = ::exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size: Vec2<usize>, _| (size.width(), vec![0.0_f32; 3 * size.area()]),
            |(width, pixels): &mut (usize, Vec<f32>), at: Vec2<usize>, (red, green, blue): (f32, f32, f32)| {
                let k = 3 * (at.y() * *width + at.x());
                pixels[k..k + 3].copy_from_slice(&[red, green, blue]);
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(BufReader::new(file))
        .map_err(|error| Error::file(path, error))?;
    let layer = image.layer_data;
    let attributes = texts(&image.attributes, &layer.attributes);
    Ok(Picture { width: layer.size.width(), height: layer.size.height(), pixels: layer.channel_data.pixels.1, attributes })
}

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
