//! Any OpenEXR file of a picture: scan lines or tiles, half or float, any compression that the crate `exr` knows, RGB, RGBA or Y, one layer of many.

use super::texts;
use crate::error::{Error, Result};
use crate::io::PictureLimits;
use crate::io::read::Raw;
use crate::spectrum::Chromaticities;
use ::exr::image::{AnyChannels, FlatSamples, Layer};
use ::exr::meta::MetaData;
use ::exr::prelude::{ReadChannels, ReadLayers};
use std::io::BufReader;
use std::path::Path;

/// More bytes than this for each byte of a file do not come out of any of its compressions.
const GREATEST_COMPRESSION: u64 = 4096;

type AnyLayer = Layer<AnyChannels<FlatSamples>>;

/// Where the values of a picture stand: layer and numbers of its channels, one or three.
struct Found {
    layer: usize,
    channels: Vec<usize>,
}

/// Reads the picture of an EXR file: channels `R`, `G`, `B`, else those of a layer (of several the one named `Combined`, as in `ViewLayer.Combined.R`, else the first), else `Y`.
/// Pixels outside the data window are black; those outside the display window are left out.
///
/// # Errors
/// [`Error::File`] for a file that is damaged or cut short; [`Error::Data`] if it has no such channels.
pub fn read_rgb(path: &Path, limits: &PictureLimits) -> Result<Raw> {
    let failed = |error: ::exr::error::Error| Error::file(path, format!("not a sound OpenEXR file ({error})"));
    let file = std::fs::File::open(path).map_err(|error| Error::file(path, error))?;
    check_size(path, limits, &MetaData::read_from_file(path, false).map_err(failed)?)?;
    let reader = ::exr::prelude::read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let image = reader.from_buffered(BufReader::new(file)).map_err(failed)?;

    let found = choose(&image.layer_data).ok_or_else(|| {
        let names: Vec<String> = image.layer_data.iter().flat_map(names).collect();
        Error::data(format!("{}: no channels R, G, B or Y among {}", path.display(), names.join(", ")))
    })?;
    let layer = &image.layer_data[found.layer];
    let window = image.attributes.display_window;
    let (width, height) = (window.size.width(), window.size.height());
    let mut pixels = vec![0.0; 3 * width * height];
    // Where the data window begins in the picture.
    let left = i64::from(layer.attributes.layer_position.x()) - i64::from(window.position.x());
    let top = i64::from(layer.attributes.layer_position.y()) - i64::from(window.position.y());
    let columns = layer.size.width();
    for c in 0..3 {
        let samples = &layer.channel_data.list[found.channels[c.min(found.channels.len() - 1)]].sample_data;
        for (k, value) in samples.values_as_f32().enumerate() {
            let (x, y) = (left + (k % columns) as i64, top + (k / columns) as i64);
            if (0..width as i64).contains(&x) && (0..height as i64).contains(&y) {
                pixels[3 * (y as usize * width + x as usize) + c] = value;
            }
        }
    }
    let chromaticities = image.attributes.chromaticities.map(|c| {
        let pair = |v: ::exr::prelude::Vec2<f32>| [f64::from(v.x()), f64::from(v.y())];
        Chromaticities { red: pair(c.red), green: pair(c.green), blue: pair(c.blue), white: pair(c.white) }
    });
    Ok(Raw { width, height, pixels, chromaticities, fields: texts(&image.attributes, &layer.attributes), notes: Vec::new() })
}

/// A damaged header must not ask for more memory than there is.
fn check_size(path: &Path, limits: &PictureLimits, meta: &MetaData) -> Result<()> {
    let length = std::fs::metadata(path).map_err(|error| Error::file(path, error))?.len();
    let mut bytes = 0_u64;
    for header in &meta.headers {
        for size in [header.layer_size, header.shared_attributes.display_window.size] {
            limits.check(path, size.width() as u64, size.height() as u64)?;
        }
        if header.deep {
            return Err(Error::file(path, "deep data, which have no single picture"));
        }
        bytes = bytes.saturating_add(4 * header.layer_size.area() as u64 * header.channels.list.len() as u64);
    }
    if bytes / GREATEST_COMPRESSION > length.max(1 << 12) {
        return Err(Error::file(
            path,
            format!("the header promises {bytes} bytes, which {length} cannot hold: damaged or cut short"),
        ));
    }
    Ok(())
}

/// Full names of the channels of a layer, with the layer's own name before them if they do not have it.
fn names(layer: &AnyLayer) -> Vec<String> {
    let own = layer.attributes.layer_name.as_ref().map(ToString::to_string).filter(|name| !name.is_empty());
    let full = |name: String| match &own {
        Some(own) if !name.starts_with(&format!("{own}.")) => format!("{own}.{name}"),
        _ => name,
    };
    layer.channel_data.list.iter().map(|channel| full(channel.name.to_string())).collect()
}

/// The picture among layers and channels.
fn choose(layers: &[AnyLayer]) -> Option<Found> {
    let mut best: Option<(u32, Found)> = None;
    for (number, layer) in layers.iter().enumerate() {
        let names = names(layer);
        let of = |prefix: &str, channel: &str| {
            let is = |k: &usize| {
                let whole = layer.channel_data.list[*k].sampling == ::exr::prelude::Vec2(1, 1);
                whole && split(&names[*k]) == (prefix, channel)
            };
            (0..names.len()).find(is)
        };
        for name in &names {
            let (prefix, channel) = split(name);
            let channels = match channel {
                "R" => [of(prefix, "R"), of(prefix, "G"), of(prefix, "B")].into_iter().collect::<Option<Vec<_>>>(),
                // Beside RY and BY it is the luminance of a coloured picture.
                "Y" if !names.iter().any(|other| split(other) == (prefix, "RY")) => of(prefix, "Y").map(|k| vec![k]),
                _ => None,
            };
            let Some(channels) = channels else { continue };
            let last = prefix.rsplit('.').next().unwrap_or("");
            let place = if prefix.is_empty() {
                0
            } else if last.eq_ignore_ascii_case("combined") {
                1
            } else {
                2
            };
            let rank = place + if channels.len() == 3 { 0 } else { 3 };
            if best.as_ref().is_none_or(|(other, _)| rank < *other) {
                best = Some((rank, Found { layer: number, channels }));
            }
        }
    }
    best.map(|(_, found)| found)
}

/// Layer and channel of a name such as `ViewLayer.Combined.R`.
fn split(name: &str) -> (&str, &str) {
    name.rsplit_once('.').unwrap_or(("", name))
}
