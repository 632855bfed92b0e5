//! Any OpenEXR file of a picture: scan lines or tiles, of any samples and any compression but HTJ2K, one layer of many.

use super::channels::{self, Colours, Found};
use super::chroma::{self, Plane};
use super::chunks;
use super::part::{Header, Part, Window};
use super::source::Source;
use crate::error::{Error, Result};
use crate::io::read::Raw;
use crate::io::{PictureLimits, limits};
use crate::spectrum::{Chromaticities, ColorSpace};
use std::io::{Read, Seek};
use std::path::Path;

/// A large picture ([`LARGE`]) has at least this part of its pixels in the file.
const LEAST_PART: u64 = 4096;

/// Pixels that a picture may have whatever there is of it.
const LARGE: u64 = 1 << 24;

/// Which pixels are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pixels {
    /// Those of the picture; what is outside the data is black, data outside the picture are left out.
    Picture,
    /// Those that the file holds.
    Stored,
}

/// Reads the picture of an EXR file, of the channels that [`channels`] tells of. Maps of directions (`envmap`) are all of the data, as OpenEXR has it.
///
/// # Errors
/// [`Error::File`] for a file that is damaged, cut short, or of a kind that is not read; [`Error::Data`] if it has no such channels; [`Error::Input`] if it is over the bounds.
pub fn read_rgb(path: &Path, bounds: &PictureLimits, pixels: Pixels) -> Result<Raw> {
    parse_rgb(path, limits::open_plain(path)?, bounds, pixels)
}

/// The same of the bytes of `reader`, which messages call `path`.
///
/// # Errors
/// As [`read_rgb`].
pub fn parse_rgb(path: &Path, reader: impl Read + Seek, limits: &PictureLimits, pixels: Pixels) -> Result<Raw> {
    limits.validate()?;
    let mut source = Source::new(path, reader)?;
    let header = Header::read(&mut source)?;
    let found = channels::choose(&header.parts);
    let found = found.ok_or_else(|| Error::data(format!("{}: {}", path.display(), channels::why_none(&header.parts))))?;
    let part = &header.parts[found.part];
    let window = if pixels == Pixels::Stored || part.envmap.is_some() { part.data } else { part.display };
    check_size(&source, limits, part, window)?;

    let primaries = part.chromaticities.map(|numbers| {
        let [a, b, c, d, e, f, g, h] = numbers.map(f64::from);
        Chromaticities { red: [a, b], green: [c, d], blue: [e, f], white: [g, h] }
    });
    let mut notes = Vec::new();
    if primaries.is_some_and(|found| !found.is_usable()) {
        notes.push("chromaticities: none of a colour space, left aside".to_owned());
    }
    if let Some(ratio) = part.texts.get("pixelAspectRatio").filter(|ratio| ratio.as_str() != "1") {
        notes.push(format!("pixelAspectRatio={ratio}: pixels are taken as square"));
    }
    let primaries = primaries.filter(Chromaticities::is_usable);
    let pixels = match found.colours {
        Colours::LuminanceChroma => from_chroma(&mut source, &header, &found, window, primaries.as_ref())?,
        Colours::Rgb | Colours::Xyz | Colours::Grey => directly(&mut source, &header, &found, window)?,
    };
    let (width, height) = window.size();
    let chromaticities = if found.colours == Colours::Xyz { Some(ColorSpace::Xyz.chromaticities()) } else { primaries };
    Ok(Raw { width: width as usize, height: height as usize, pixels, chromaticities, fields: part.texts.clone(), notes })
}

/// Memory is taken for what is within the limits and, in a large picture, not for nothing.
fn check_size<R: Read + Seek>(source: &Source<'_, R>, limits: &PictureLimits, part: &Part, window: Window) -> Result<()> {
    let (data, picture) = (part.data.size(), window.size());
    let stored = limits.check(source.path(), data.0, data.1)? as u64;
    let whole = limits.check(source.path(), picture.0, picture.1)? as u64;
    if whole > LARGE && whole / LEAST_PART > stored {
        let (size, of) = (format!("{} x {}", picture.0, picture.1), format!("{} x {}", data.0, data.1));
        return Err(source.unread(format!("OpenEXR with a display window of {size} pixels, all but {of} of them empty: crop it")));
    }
    for size in [data, picture] {
        limits.check_made_of(source.path(), size, source.length())?;
    }
    Ok(())
}

/// Where data stand in a window.
struct Placement {
    left: i64,
    top: i64,
    width: usize,
    height: usize,
}

impl Placement {
    fn new(data: Window, window: Window) -> Self {
        let (width, height) = window.size();
        let from = |data: i32, window: i32| i64::from(data) - i64::from(window);
        let (left, top) = (from(data.least.0, window.least.0), from(data.least.1, window.least.1));
        Self { left, top, width: width as usize, height: height as usize }
    }

    /// The pixels of the row `y` of the data from the column `x` on: index of the first of them in the window, and which of `count` they are.
    fn row(&self, (x, y): (usize, usize), count: usize) -> Option<(usize, std::ops::Range<usize>)> {
        let (left, y) = (self.left + x as i64, self.top + y as i64);
        let y = usize::try_from(y).ok().filter(|y| *y < self.height)?;
        let from = usize::try_from(-left).unwrap_or(0).min(count);
        let to = usize::try_from(self.width as i64 - left).unwrap_or(0).min(count);
        (from < to).then(|| (y * self.width + (left + from as i64) as usize, from..to))
    }
}

/// Channels with a sample for each pixel.
fn directly<R: Read + Seek>(source: &mut Source<'_, R>, header: &Header, found: &Found, window: Window) -> Result<Vec<f32>> {
    let place = Placement::new(header.parts[found.part].data, window);
    let mut pixels: Vec<f32> = limits::zeros(source.path(), 3 * place.width * place.height)?;
    let wanted: Vec<usize> = found.channels.iter().flatten().copied().collect();
    let is_grey = found.colours == Colours::Grey;
    chunks::read(source, header, found.part, &wanted, |line| {
        let Some((first, part)) = place.row(line.first, line.count()) else { return };
        let targets = pixels.as_chunks_mut::<3>().0[first..].iter_mut();
        for (pixel, value) in targets.zip(line.values().skip(part.start).take(part.len())) {
            if is_grey {
                *pixel = [value; 3];
            } else {
                pixel[line.slot] = value;
            }
        }
    })?;
    Ok(pixels)
}

/// Luminance and chroma.
fn from_chroma<R: Read + Seek>(
    source: &mut Source<'_, R>,
    header: &Header,
    found: &Found,
    window: Window,
    primaries: Option<&Chromaticities>,
) -> Result<Vec<f32>> {
    let part = &header.parts[found.part];
    let (width, height) = part.data.size();
    let (width, height) = (width as usize, height as usize);
    let mut planes = Vec::new();
    for channel in &found.channels {
        // Chroma that is not there is that of white.
        let sampling = channel.map_or((width, height), |number| part.channels[number].sampling);
        let (columns, rows) = (width / sampling.0, height / sampling.1);
        let values = limits::zeros(source.path(), columns * rows)?;
        planes.push(Plane { width: columns, height: rows, sampling, values });
    }
    let slots: Vec<usize> = (0..3).filter(|&slot| found.channels[slot].is_some()).collect();
    let wanted: Vec<usize> = found.channels.iter().flatten().copied().collect();
    chunks::read(source, header, found.part, &wanted, |line| {
        let plane = &mut planes[slots[line.slot]];
        let at = line.first.1 * plane.width + line.first.0;
        plane.values[at..].iter_mut().zip(line.values()).for_each(|(target, value)| *target = value);
    })?;
    let mut colours: Vec<f32> = limits::zeros(source.path(), 3 * width * height)?;
    chroma::colours(&planes[0], [&planes[1], &planes[2]], chroma::luminance_weights(primaries), &mut colours);
    if window == part.data {
        return Ok(colours);
    }
    let place = Placement::new(part.data, window);
    let mut pixels: Vec<f32> = limits::zeros(source.path(), 3 * place.width * place.height)?;
    for (y, row) in colours.chunks(3 * width).enumerate() {
        if let Some((first, part)) = place.row((0, y), width) {
            pixels[3 * first..3 * (first + part.len())].copy_from_slice(&row[3 * part.start..3 * part.end]);
        }
    }
    Ok(pixels)
}
