//! What the header of a file says of its parts (OpenEXR documentation, "OpenEXR File Layout").

use super::attributes;
use super::source::Source;
use crate::error::Result;
use std::collections::BTreeMap;
use std::io::{Read, Seek};

/// Most channels of a part, attributes of a part, and parts of a file.
const MOST: usize = 4096;

/// Flags of the version field.
const TILED: u32 = 0x200;
const LONG_NAMES: u32 = 0x400;
const DEEP: u32 = 0x800;
const MULTIPART: u32 = 0x1000;

/// What a sample is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A whole number of 32 bits.
    Uint,
    /// A half float.
    Half,
    /// A float of 32 bits.
    Float,
}

impl Kind {
    /// Size of a sample [bytes].
    pub const fn bytes(self) -> usize {
        if matches!(self, Self::Half) { 2 } else { 4 }
    }
}

/// A channel of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its bytes: names are text of no stated encoding.
    pub name: Vec<u8>,
    /// What its samples are.
    pub kind: Kind,
    /// Whether codecs with loss take it as it is.
    pub linear: bool,
    /// There is a sample for so many columns and rows.
    pub sampling: (usize, usize),
}

impl Channel {
    /// Its name as text.
    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.name).into_owned()
    }
}

/// A rectangle of pixels, both corners in it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Window {
    /// Left column and upper row.
    pub least: (i32, i32),
    /// Right column and lower row.
    pub most: (i32, i32),
}

impl Window {
    /// Width and height [pixels]; 0 for one that is inside out.
    pub fn size(&self) -> (u64, u64) {
        let length = |least: i32, most: i32| u64::try_from(i64::from(most) - i64::from(least) + 1).unwrap_or(0);
        (length(self.least.0, self.most.0), length(self.least.1, self.most.1))
    }
}

/// How a part is divided into tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiles {
    /// Width and height of a tile [pixels].
    pub size: (u64, u64),
    /// 0: one level; 1: mip map; 2: rip map.
    pub levels: u8,
    /// Whether sizes of levels are rounded up.
    pub round_up: bool,
}

/// How directions are laid out, by the standard attribute `envmap`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Envmap {
    /// Latitude and longitude; the outer columns and rows lie on the borders.
    LatLong,
    /// Six faces, one below the other.
    Cube,
}

/// A part of a file: a picture or some of its layers.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Its name, in files of several parts.
    pub name: Option<String>,
    /// Which of several views it belongs to.
    pub view: Option<String>,
    /// Whether a pixel has any number of samples.
    pub deep: bool,
    /// Its channels, in the order in which blocks hold them.
    pub channels: Vec<Channel>,
    /// The number of its compression.
    pub compression: u8,
    /// Pixels that the file holds.
    pub data: Window,
    /// Pixels of the picture.
    pub display: Window,
    /// Its tiles; none if it has rows.
    pub tiles: Option<Tiles>,
    /// How many blocks it says to have.
    pub chunk_count: Option<i32>,
    /// Red, green, blue, white: x and y.
    pub chromaticities: Option<[f32; 8]>,
    /// Which map of directions it is.
    pub envmap: Option<Envmap>,
    /// Texts and numbers of the header by name, as text.
    pub texts: BTreeMap<String, String>,
}

/// All parts of a file.
#[derive(Debug)]
pub struct Header {
    /// The parts in their order.
    pub parts: Vec<Part>,
    /// Whether blocks say which part they are of.
    pub multipart: bool,
}

impl Header {
    /// Reads the header; then the tables of the blocks come.
    ///
    /// # Errors
    /// [`Error::File`](crate::Error::File) for what is no such file, is damaged, or of a later version.
    pub fn read<R: Read + Seek>(source: &mut Source<'_, R>) -> Result<Self> {
        if source.length() < 8 || source.array()? != [0x76, 0x2f, 0x31, 0x01] {
            return Err(source.damaged("it does not begin as one"));
        }
        let version = source.array().map(u32::from_le_bytes)?;
        if !(1..=2).contains(&(version & 0xff)) {
            return Err(source.unread(format!("OpenEXR of version {}, of which 2 is read", version & 0xff)));
        }
        let flags = version & !0xff;
        if flags & !(TILED | LONG_NAMES | DEEP | MULTIPART) != 0 {
            return Err(source.unread(format!("OpenEXR with the flags {flags:#x}, which are of a later version than 2")));
        }
        let multipart = flags & MULTIPART != 0;
        let mut parts = Vec::new();
        while let Some(part) = read_part(source, flags)? {
            parts.push(part);
            if !multipart {
                break;
            }
            if parts.len() > MOST {
                return Err(source.unread(format!("OpenEXR with more parts than the {MOST} that are read")));
            }
        }
        if parts.is_empty() {
            return Err(source.damaged("it has no parts"));
        }
        Ok(Self { parts, multipart })
    }
}

/// The next part; none where the list of them ends.
fn read_part<R: Read + Seek>(source: &mut Source<'_, R>, flags: u32) -> Result<Option<Part>> {
    let mut part = Part { deep: flags & DEEP != 0 && flags & MULTIPART == 0, ..Default::default() };
    let mut found = Vec::new();
    let (mut tiles, mut kind) = (None, None);
    for number in 0.. {
        let name = source.name()?;
        if name.is_empty() {
            if number == 0 && flags & MULTIPART != 0 {
                return Ok(None);
            }
            break;
        }
        if number >= MOST {
            return Err(source.unread(format!("OpenEXR with more attributes than the {MOST} that are read")));
        }
        let (type_name, size) = (source.name()?, source.int()?);
        let end = u64::try_from(size).ok().map(|size| source.at() + size).filter(|end| *end <= source.length());
        let name = String::from_utf8_lossy(&name).into_owned();
        let end =
            end.ok_or_else(|| source.damaged(format!("the attribute {name} has {size} bytes, {} follow", source.rest())))?;
        match (name.as_str(), type_name.as_slice()) {
            ("channels", b"chlist") => part.channels = attributes::channels(source, end)?,
            ("compression", b"compression") => [part.compression] = source.array()?,
            ("dataWindow", b"box2i") => part.data = attributes::window(source)?,
            ("displayWindow", b"box2i") => part.display = attributes::window(source)?,
            ("tiles", b"tiledesc") => tiles = Some(attributes::tiles(source)?),
            ("chunkCount", b"int") => part.chunk_count = Some(source.int()?),
            ("chromaticities", b"chromaticities") => part.chromaticities = Some(attributes::floats(source)?),
            ("envmap", b"envmap") => part.envmap = attributes::envmap(source)?,
            ("name", b"string") => part.name = attributes::text(source, b"string", size)?,
            ("view", b"string") => part.view = attributes::text(source, b"string", size)?,
            ("type", b"string") => kind = attributes::text(source, b"string", size)?,
            (_, type_name) => {
                if let Some(text) = attributes::text(source, type_name, size)? {
                    part.texts.insert(name.clone(), text);
                }
            }
        }
        if source.at() > end {
            return Err(source.damaged(format!("the attribute {name} has a wrong size")));
        }
        source.seek(end)?;
        found.push(name);
    }
    for needed in ["channels", "compression", "dataWindow"] {
        if !found.iter().any(|name| name == needed) {
            return Err(source.damaged(format!("it has no {needed}")));
        }
    }
    if !found.iter().any(|name| name == "displayWindow") {
        part.display = part.data;
    }
    let kind = kind.unwrap_or_default();
    part.deep |= kind.starts_with("deep");
    let tiled = if flags & MULTIPART != 0 || part.deep {
        kind.ends_with("tile") || kind.ends_with("tiledimage")
    } else {
        flags & TILED != 0
    };
    if tiled {
        part.tiles = Some(tiles.ok_or_else(|| source.damaged("it has tiles of no size"))?);
    }
    attributes::put_known(&mut part);
    Ok(Some(part))
}

/// Most channels that are read.
pub const MOST_CHANNELS: usize = MOST;
