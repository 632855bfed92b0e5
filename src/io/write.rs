//! Pictures to files: EXR (float32, ZIP) or Radiance HDR, with headers that [`read_picture`](super::read_picture) understands.

use super::exr::{self, Packing};
use super::png::{self, Depth};
use super::{Format, hdr, write_atomically};
use crate::error::{Error, Result};
use crate::post::Picture;
use crate::post::tone::{Display, Sheet, ToneMapper};
use crate::progress::Progress;
use std::io::{Seek, SeekFrom, Write};
use std::path::Path;

/// Rows of a block of OpenEXR.
const BLOCK_ROWS: usize = 16;

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
        Format::Png => write_atomically(path, progress, |file| png::write_mapped(file, path, mapper, depth, progress)),
        Format::Exr | Format::Hdr => write_picture(path, &mapper.to_picture(progress)?, progress),
    }
}

/// Writes a contact sheet for `display` to the PNG `path`, whole or not at all. Progress is the stage "write".
///
/// # Errors
/// [`Error::Input`] for another suffix; [`Error::File`]; [`Error::Cancelled`].
pub fn write_sheet(path: impl AsRef<Path>, sheet: &Sheet, display: Display, progress: &Progress<'_>) -> Result<()> {
    let path = path.as_ref();
    match Format::of(path)? {
        Format::Png => {
            let size = (sheet.width, sheet.height);
            write_atomically(path, progress, |file| png::write_8(file, path, size, (display, &sheet.pixels), progress))
        }
        Format::Exr | Format::Hdr => {
            Err(Error::input("output", path.display(), "the name of a file that ends in .png for a contact sheet"))
        }
    }
}

fn write_exr(path: &Path, picture: &Picture, progress: &Progress<'_>) -> Result<()> {
    let packing = Packing::new((picture.width, picture.height), false, 1.0, Vec::new());
    let header = exr::picture_header(picture, fields(picture), &packing);
    let failed = |error| Error::file(path, error);
    write_atomically(path, progress, |file| {
        file.write_all(&header).map_err(failed)?;
        file.write_all(&vec![0; 8 * packing.blocks()]).map_err(failed)?;
        let mut position = (header.len() + 8 * packing.blocks()) as u64;
        let mut table = Vec::with_capacity(8 * packing.blocks());
        for (first, rows) in bands(picture, progress) {
            for block in packing.pack(first?, &[rows]) {
                table.extend(position.to_le_bytes());
                position += block.len() as u64;
                file.write_all(&block).map_err(failed)?;
            }
        }
        file.seek(SeekFrom::Start(header.len() as u64)).map_err(failed)?;
        file.write_all(&table).map_err(failed)
    })
}

fn write_hdr(path: &Path, picture: &Picture, progress: &Progress<'_>) -> Result<()> {
    write_atomically(path, progress, |file| {
        let mut write = |bytes: &[u8]| file.write_all(bytes).map_err(|error| Error::file(path, error));
        let size = (picture.width, picture.height);
        write(hdr::picture_header(picture.color_space, size, &fields(picture)).as_bytes())?;
        for (first, rows) in bands(picture, progress) {
            first?;
            hdr::encode_rows(picture.width, rows).iter().try_for_each(|row| write(row))?;
        }
        Ok(())
    })
}

/// Bands of rows that are packed at a time, with the first row of each, unless the work was cancelled before it.
fn bands<'a>(picture: &'a Picture, progress: &Progress<'a>) -> impl Iterator<Item = (Result<usize>, &'a [f32])> {
    let count = BLOCK_ROWS * 2 * rayon::current_num_threads();
    let progress = *progress;
    picture.pixels.chunks(3 * picture.width * count).enumerate().map(move |(band, rows)| {
        let first = band * count;
        (progress.report("write", first as f64 / picture.height as f64).map(|()| first), rows)
    })
}

/// What our own header fields say of a picture.
fn fields(picture: &Picture) -> Vec<(String, String)> {
    let mut fields = vec![
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("color_space", picture.color_space.name().to_owned()),
        ("projection", picture.view.projection().name().to_owned()),
    ];
    // An assumption is no fact.
    if !picture.white_luminance_assumed {
        fields.push(("white_luminance", picture.white_luminance.to_string()));
    }
    let rows = picture.view.rows().map(|rows| ("rows", rows.name().to_owned()));
    let angle = picture.view.field_of_view_deg().map(|angle| ("field_of_view_deg", angle.to_string()));
    fields.extend(rows.into_iter().chain(angle));
    if picture.turn_deg != 0.0 {
        fields.push(("turn_deg", picture.turn_deg.to_string()));
    }
    fields.into_iter().map(|(name, value)| (format!("skyprobe.{name}"), value)).collect()
}
