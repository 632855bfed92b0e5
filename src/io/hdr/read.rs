//! Reading Radiance pictures: any run lengths, RGBE and XYZE, any orientation (Radiance, `color.c` and `resolu.c`; Ward 1991).

use super::decode;
use super::fields::{Header, Parsed, line};
use super::rows::{least_bytes, read_row};
use crate::error::{Error, Result};
use crate::io::PictureLimits;
use crate::io::limits::{open_plain, zeros};
use crate::io::read::Raw;
use std::collections::BTreeMap;
use std::io::{BufRead, Cursor, Seek, SeekFrom};
use std::path::Path;

/// Longest line of the size [bytes].
const LONGEST_SIZE: usize = 1 << 10;

/// Reads a Radiance file. The pixels are divided by the product of its EXPOSURE lines and those of COLORCORR: what the camera or the renderer saw.
///
/// # Errors
/// [`Error::Input`] for `limits` that it exceeds; [`Error::File`] for a file that is none, is damaged or cut short.
pub fn read_rgb(path: &Path, limits: &PictureLimits) -> Result<Raw> {
    parse(&mut open_plain(path)?, path, limits)
}

/// The same of `bytes`, which messages call `path`.
///
/// # Errors
/// As [`read_rgb`].
pub fn parse_rgb(path: &Path, bytes: &[u8], limits: &PictureLimits) -> Result<Raw> {
    parse(&mut Cursor::new(bytes), path, limits)
}

/// Our own fields in the header of a Radiance file that begins with `bytes`, by their full names such as `skyprobe.config`; those that were divided over several
/// lines are whole again.
///
/// # Errors
/// The reason, for a header that is none.
pub fn header_fields(mut bytes: &[u8]) -> Parsed<BTreeMap<String, String>> {
    Header::read(&mut bytes).map(|header| header.fields)
}

/// Files that have an end: the rows are read twice.
fn refusal(path: &Path, reason: &str) -> Error {
    Error::file(path, format!("no Radiance picture that can be read: {reason}"))
}

fn parse<R: BufRead + Seek>(reader: &mut R, path: &Path, limits: &PictureLimits) -> Result<Raw> {
    limits.validate()?;
    let told = |reason: String| refusal(path, &reason);
    let failed = |error: std::io::Error| Error::file(path, error);
    let header = Header::read(reader).map_err(told)?;
    let (mut left, mut bytes) = (LONGEST_SIZE, Vec::new());
    let size =
        line(reader, &mut left, &mut bytes).ok().flatten().ok_or_else(|| told("the line of its size is missing".to_owned()))?;
    let layout = Layout::of(&size).ok_or_else(|| told(format!("{:?} is not its size", size.trim())))?;
    let start = reader.stream_position().map_err(failed)?;
    let bytes = reader.seek(SeekFrom::End(0)).map_err(failed)?.saturating_sub(start);
    let count = layout.check(path, limits, bytes)?;
    // First without the picture: rows that are not there shall not take its memory.
    layout.each_row(reader, start, |_, _| ()).map_err(told)?;
    let mut pixels = zeros::<f32>(path, 3 * count)?;
    layout.each_row(reader, start, |number, row| layout.put(number, row, &header.divisors, &mut pixels)).map_err(told)?;
    let (width, height, chromaticities) = (layout.width, layout.height, header.space());
    Ok(Raw { width, height, pixels, chromaticities, fields: header.fields, notes: header.notes.into_values().collect() })
}

/// How lines of the file are placed in the picture.
struct Layout {
    width: usize,
    height: usize,
    /// Pixels in a line of the file, and lines.
    length: usize,
    count: usize,
    lines_are_rows: bool,
    from_right: bool,
    from_bottom: bool,
}

impl Layout {
    /// Of a line such as `-Y 512 +X 1024`: what comes first counts the lines, and a minus says that it decreases from one to the next.
    fn of(text: &str) -> Option<Self> {
        let axis = |letter: char| {
            let at = text.rfind(letter)?;
            let digits = text[at + 1..].trim_start();
            let end = digits.find(|character: char| !character.is_ascii_digit()).unwrap_or(digits.len());
            Some((at, digits[..end].parse().ok()?, text[..at].ends_with('-')))
        };
        let ((at_x, width, from_right), (at_y, height, from_top)) = (axis('X')?, axis('Y')?);
        let lines_are_rows = at_y < at_x;
        let (length, count) = if lines_are_rows { (width, height) } else { (height, width) };
        Some(Self { width, height, length, count, lines_are_rows, from_right, from_bottom: !from_top })
    }

    /// The number of pixels, if `bytes` can be so many and they are within `limits`.
    fn check(&self, path: &Path, limits: &PictureLimits, bytes: u64) -> Result<usize> {
        let (width, height) = (self.width, self.height);
        limits.check(path, width as u64, height as u64)?;
        if bytes < self.count as u64 * least_bytes(self.length) {
            return Err(refusal(path, &format!("the file ends early: {width} x {height} pixels in {bytes} bytes")));
        }
        limits.check_made_of(path, (width as u64, height as u64), bytes)
    }

    /// Reads all lines from `start` on, and hands each over with its number.
    fn each_row<R: BufRead + Seek>(&self, reader: &mut R, start: u64, mut take: impl FnMut(usize, &[[u8; 4]])) -> Parsed<()> {
        reader.seek(SeekFrom::Start(start)).map_err(|error| error.to_string())?;
        let mut row = vec![[0; 4]; self.length];
        for number in 0..self.count {
            read_row(reader, &mut row).map_err(|reason| format!("{reason} in line {} of {}", number + 1, self.count))?;
            take(number, &row);
        }
        Ok(())
    }

    /// Puts a line of the file into the picture.
    fn put(&self, line: usize, row: &[[u8; 4]], divisors: &[f64; 3], pixels: &mut [f32]) {
        for (k, &pixel) in row.iter().enumerate() {
            let (x, y) = self.place(k, line);
            let at = 3 * (y * self.width + x);
            for ((value, found), divisor) in pixels[at..at + 3].iter_mut().zip(decode(pixel)).zip(divisors) {
                *value = (f64::from(found) / divisor) as f32;
            }
        }
    }

    /// Column and row of the pixel `k` of a line.
    fn place(&self, k: usize, line: usize) -> (usize, usize) {
        let (x, y) = if self.lines_are_rows { (k, line) } else { (line, k) };
        (if self.from_right { self.width - 1 - x } else { x }, if self.from_bottom { self.height - 1 - y } else { y })
    }
}

#[cfg(test)]
mod tests;
