//! Pictures to files: EXR (float32, ZIP) or Radiance HDR, with headers that [`read_picture`](super::read_picture) understands.

use super::exr::{self, Packing};
use super::png::{self, Depth};
use super::{Format, hdr, write_atomically};
use crate::error::{Error, Result};
use crate::post::tone::{Display, Sheet, ToneMapper};
use crate::post::{Picture, View};
use crate::progress::Progress;
use std::io::Write;
use std::path::Path;

/// Rows that are packed at a time: blocks of OpenEXR have 16.
const BAND_ROWS: usize = 256;

/// Writes `picture` to `path` in the format that its suffix names, `.exr` or `.hdr`, whole or not at all. Progress is the stage "write".
///
/// # Errors
/// [`Error::Input`] for another suffix; [`Error::File`]; [`Error::Cancelled`].
pub fn write_picture(path: impl AsRef<Path>, picture: &Picture, progress: &Progress<'_>) -> Result<()> {
    let path = path.as_ref();
    match Format::of(path)? {
        Format::Exr => write_exr(path, picture, progress),
        Format::Hdr => write_hdr(path, picture, progress),
        Format::Png => Err(Error::input("output", path.display(), "the name of a file that ends in .exr or .hdr")),
    }
}

/// Writes what `mapper` shows to `path`, whole or not at all: `.png` with `depth`, or light of the screen as `.exr` or `.hdr`.
///
/// # Errors
/// [`Error::Input`] for another suffix, and for light of a display whose primaries a picture cannot have; [`Error::File`]; [`Error::Cancelled`].
pub fn write_toned(path: impl AsRef<Path>, mapper: &ToneMapper<'_>, depth: Depth, progress: &Progress<'_>) -> Result<()> {
    let path = path.as_ref();
    match Format::of(path)? {
        Format::Png => write_atomically(path, |file| png::write_mapped(file, path, mapper, depth, progress)),
        Format::Exr | Format::Hdr => write_picture(path, &mapper.to_picture(progress)?, progress),
    }
}

/// Writes a contact sheet for `display` to the PNG `path`, whole or not at all.
///
/// # Errors
/// [`Error::Input`] for another suffix; [`Error::File`].
pub fn write_sheet(path: impl AsRef<Path>, sheet: &Sheet, display: Display) -> Result<()> {
    let path = path.as_ref();
    match Format::of(path)? {
        Format::Png => {
            write_atomically(path, |file| png::write_8(file, path, (sheet.width, sheet.height), display, &sheet.pixels))
        }
        Format::Exr | Format::Hdr => {
            Err(Error::input("output", path.display(), "the name of a file that ends in .png for a contact sheet"))
        }
    }
}

fn write_exr(path: &Path, picture: &Picture, progress: &Progress<'_>) -> Result<()> {
    let packing = Packing::new((picture.width, picture.height), false, 1.0, Vec::new());
    let header = exr::picture_header(picture, fields(picture), &packing);
    let table = header.len() + 8 * packing.blocks();
    let mut blocks = Vec::with_capacity(packing.blocks());
    for (band, rows) in picture.pixels.chunks(3 * picture.width * BAND_ROWS).enumerate() {
        progress.report("write", (band * BAND_ROWS) as f64 / picture.height as f64)?;
        blocks.extend(packing.pack(band * BAND_ROWS, &[rows]));
    }
    write_atomically(path, |file| {
        let mut write = |bytes: &[u8]| file.write_all(bytes).map_err(|error| Error::file(path, error));
        write(&header)?;
        let mut position = table as u64;
        for block in &blocks {
            write(&position.to_le_bytes())?;
            position += block.len() as u64;
        }
        blocks.iter().try_for_each(|block| write(block))
    })
}

fn write_hdr(path: &Path, picture: &Picture, progress: &Progress<'_>) -> Result<()> {
    write_atomically(path, |file| {
        let mut write = |bytes: &[u8]| file.write_all(bytes).map_err(|error| Error::file(path, error));
        let size = (picture.width, picture.height);
        write(hdr::picture_header(picture.color_space, size, &fields(picture)).as_bytes())?;
        for (band, rows) in picture.pixels.chunks(3 * picture.width * BAND_ROWS).enumerate() {
            progress.report("write", (band * BAND_ROWS) as f64 / picture.height as f64)?;
            hdr::encode_rows(picture.width, rows).iter().try_for_each(|row| write(row))?;
        }
        Ok(())
    })
}

/// What our own header fields say of a picture.
fn fields(picture: &Picture) -> Vec<(String, String)> {
    let mut fields = vec![
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("color_space", picture.color_space.name().to_owned()),
        ("projection", picture.view.projection().name().to_owned()),
        ("white_luminance", picture.white_luminance.to_string()),
    ];
    match picture.view {
        View::LatLong { rows } => fields.push(("rows", rows.name().to_owned())),
        View::Perspective { horizontal_field_of_view_deg: angle } | View::Fisheye { field_of_view_deg: angle } => {
            fields.push(("field_of_view_deg", angle.to_string()));
        }
    }
    if picture.turn_deg != 0.0 {
        fields.push(("turn_deg", picture.turn_deg.to_string()));
    }
    fields.into_iter().map(|(name, value)| (format!("skyprobe.{name}"), value)).collect()
}
