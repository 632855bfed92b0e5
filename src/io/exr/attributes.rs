//! Values of attributes (OpenEXR documentation, "OpenEXR File Layout", predefined attribute types).

use super::part::{Channel, Envmap, Kind, MOST_CHANNELS, Part, Tiles, Window};
use super::source::Source;
use crate::error::Result;
use std::io::{Read, Seek};

/// Longest text that is kept [bytes].
const LONGEST_TEXT: i32 = 1 << 20;

/// A list of channels, which stands before `end`.
pub fn channels<R: Read + Seek>(source: &mut Source<'_, R>, end: u64) -> Result<Vec<Channel>> {
    let mut channels = Vec::new();
    while source.at() < end {
        let name = source.name()?;
        if name.is_empty() {
            break;
        }
        if channels.len() == MOST_CHANNELS {
            return Err(source.unread(format!("OpenEXR with more channels than the {MOST_CHANNELS} that are read")));
        }
        let kind = match source.int()? {
            0 => Kind::Uint,
            1 => Kind::Half,
            2 => Kind::Float,
            other => return Err(source.damaged(format!("a channel of the type {other}"))),
        };
        let [linear, ..] = source.array::<4>()?;
        let sampling = [source.int()?, source.int()?].map(|step| usize::try_from(step).unwrap_or(0));
        if sampling.contains(&0) {
            return Err(source.damaged("a channel without samples"));
        }
        channels.push(Channel { name, kind, linear: linear != 0, sampling: (sampling[0], sampling[1]) });
    }
    if channels.is_empty() { Err(source.damaged("it has no channels")) } else { Ok(channels) }
}

/// A rectangle.
pub fn window<R: Read + Seek>(source: &mut Source<'_, R>) -> Result<Window> {
    Ok(Window { least: (source.int()?, source.int()?), most: (source.int()?, source.int()?) })
}

/// Sizes of tiles and levels.
pub fn tiles<R: Read + Seek>(source: &mut Source<'_, R>) -> Result<Tiles> {
    let (width, height) = (source.array().map(u32::from_le_bytes)?, source.array().map(u32::from_le_bytes)?);
    let [mode] = source.array()?;
    let (levels, rounding) = (mode & 15, mode >> 4);
    if width == 0 || height == 0 || levels > 2 || rounding > 1 {
        return Err(source.damaged("impossible tiles"));
    }
    Ok(Tiles { size: (width.into(), height.into()), levels, round_up: rounding == 1 })
}

/// `N` numbers.
pub fn floats<R: Read + Seek, const N: usize>(source: &mut Source<'_, R>) -> Result<[f32; N]> {
    let mut values = [0.0; N];
    for value in &mut values {
        *value = f32::from_le_bytes(source.array()?);
    }
    Ok(values)
}

/// A map of directions; none for a number that means nothing.
pub fn envmap<R: Read + Seek>(source: &mut Source<'_, R>) -> Result<Option<Envmap>> {
    Ok(match source.array()? {
        [0] => Some(Envmap::LatLong),
        [1] => Some(Envmap::Cube),
        _ => None,
    })
}

/// The value of an attribute of `size` bytes as text, if it is a text or a number.
pub fn text<R: Read + Seek>(source: &mut Source<'_, R>, kind: &[u8], size: i32) -> Result<Option<String>> {
    Ok(match (kind, size) {
        (b"string", 0..=LONGEST_TEXT) => Some(String::from_utf8_lossy(&source.bytes(size as u64)?).into_owned()),
        (b"float", 4) => Some(f32::from_le_bytes(source.array()?).to_string()),
        (b"double", 8) => Some(f64::from_le_bytes(source.array()?).to_string()),
        (b"int", 4) => Some(source.int()?.to_string()),
        _ => None,
    })
}

/// Gives the attributes that are more than text a text too.
pub fn put_known(part: &mut Part) {
    if let Some(numbers) = part.chromaticities {
        part.texts.insert("chromaticities".to_owned(), numbers.map(|number| number.to_string()).join(" "));
    }
    if let Some(map) = part.envmap {
        let name = if map == Envmap::LatLong { "latlong" } else { "cube" };
        part.texts.insert("envmap".to_owned(), name.to_owned());
    }
}
