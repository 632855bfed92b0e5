//! Unpacking of blocks by the crate `exr`, behind a guard: what a block asks for is checked against what it can need before its codec sees it, and a codec
//! that panics is a damaged block.

mod checks;
mod guard;

use super::part::{Channel, Kind};
use ::exr::compression::Compression;
use ::exr::math::RoundingMode;
use ::exr::meta::BlockDescription;
use ::exr::meta::attribute::{ChannelDescription, IntegerBounds, LevelMode, SampleType, Text, TileDescription};
use ::exr::meta::header::Header;
use ::exr::prelude::Vec2;

/// Pixels of a block, from the left upper corner of the data.
#[derive(Clone, Copy, Debug)]
pub struct Area {
    /// First column.
    pub x: usize,
    /// First row.
    pub y: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
}

/// Bytes of a channel in row `y` of a block; none where it has no samples.
pub fn row_size(channel: &Channel, area: &Area, y: usize) -> Option<usize> {
    y.is_multiple_of(channel.sampling.1).then_some(area.width / channel.sampling.0 * channel.kind.bytes())
}

/// Bytes of all pixels of a block; none if there are more than can be counted.
pub fn raw_size(channels: &[Channel], area: &Area) -> Option<usize> {
    let mut bytes = 0_usize;
    for channel in channels {
        let rows = (area.y + area.height).div_ceil(channel.sampling.1) - area.y.div_ceil(channel.sampling.1);
        let row = (area.width / channel.sampling.0).checked_mul(channel.kind.bytes())?;
        bytes = bytes.checked_add(row.checked_mul(rows)?)?;
    }
    Some(bytes)
}

/// Rows of a block by the number of its compression.
pub const fn rows_of(compression: u8) -> u64 {
    match compression {
        3 | 5 => 16,
        4 | 6 | 7 | 8 | 11 => 32,
        9 | 10 => 256,
        _ => 1,
    }
}

/// What a file of a compression that is not read is.
fn unread(compression: &str) -> String {
    format!("OpenEXR with the compression {compression}, which is not read: convert it to ZIP or PIZ")
}

/// A compression that is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Codec {
    /// None.
    Raw,
    /// Run lengths.
    Rle,
    /// zlib, of one row or of 16.
    Zip(u8),
    /// Wavelets.
    Piz,
    /// zlib of 24 bits.
    Pxr24,
    /// Blocks of 4 x 4, all of the same size or not.
    B44(u8),
    /// Cosine transforms, of 32 rows or of 256.
    Dwa(u8),
}

impl Codec {
    /// The compression of this number in a header.
    ///
    /// # Errors
    /// What it is, if it is not read.
    pub fn of(number: u8) -> Result<Self, String> {
        Ok(match number {
            0 => Self::Raw,
            1 => Self::Rle,
            2 | 3 => Self::Zip(number),
            4 => Self::Piz,
            5 => Self::Pxr24,
            6 | 7 => Self::B44(number),
            8 | 9 => Self::Dwa(number),
            10 | 11 => return Err(unread("HTJ2K (High-Throughput JPEG 2000)")),
            12 => return Err(unread("LJ2K (JPEG 2000)")),
            13 => return Err(unread("ZSTD")),
            other => return Err(unread(&other.to_string())),
        })
    }

    const fn number(self) -> u8 {
        match self {
            Self::Raw => 0,
            Self::Rle => 1,
            Self::Piz => 4,
            Self::Pxr24 => 5,
            Self::Zip(number) | Self::B44(number) | Self::Dwa(number) => number,
        }
    }

    const fn foreign(self) -> Compression {
        match self {
            Self::Raw => Compression::Uncompressed,
            Self::Rle => Compression::RLE,
            Self::Zip(2) => Compression::ZIP1,
            Self::Zip(_) => Compression::ZIP16,
            Self::Piz => Compression::PIZ,
            Self::Pxr24 => Compression::PXR24,
            Self::B44(6) => Compression::B44,
            Self::B44(_) => Compression::B44A,
            Self::Dwa(8) => Compression::DWAA(None),
            Self::Dwa(_) => Compression::DWAB(None),
        }
    }

    /// Rows of a block.
    pub const fn rows(self) -> usize {
        rows_of(self.number()) as usize
    }

    /// Bytes that come out of one at most. zlib: 258 bytes of two bits, 1032; Huffman codes of PIZ: 255 values of 9 bits; cosine transforms: a value for
    /// 64, packed by zlib, and an end for each 64, packed by either.
    const fn greatest_ratio(self) -> u64 {
        match self {
            Self::Raw => 1,
            Self::Rle => 64,
            Self::Zip(_) => 1032,
            Self::Piz => 454,
            Self::Pxr24 => 1376,
            Self::B44(_) => 11,
            Self::Dwa(_) => 66048,
        }
    }

    /// Fewest bytes that all blocks of a picture of this size can have.
    pub fn least_size(self, channels: &[Channel], (width, height): (usize, usize)) -> u64 {
        let row: u64 = channels
            .iter()
            .map(|channel| (width / channel.sampling.0 * channel.kind.bytes()) as u64 / channel.sampling.1 as u64)
            .sum();
        row.saturating_mul(height as u64) / self.greatest_ratio()
    }

    /// Whether it holds channels with these steps between samples: the crate's codecs count a whole number of bytes for each pixel.
    pub fn holds(self, channels: &[Channel]) -> bool {
        let (Self::Piz | Self::Pxr24 | Self::Dwa(_)) = self else { return true };
        let whole = |channel: &Channel| [channel.sampling.0, channel.sampling.1].iter().all(|step| [1, 2, 4].contains(step));
        let sixteen = |channel: &Channel| 16 * channel.kind.bytes() / (channel.sampling.0 * channel.sampling.1);
        channels.iter().all(whole) && channels.iter().map(sixteen).sum::<usize>().is_multiple_of(16)
    }

    /// The pixels of a block: row by row, in each the samples of the channels. `raw` is the number of their bytes.
    ///
    /// # Errors
    /// What is wrong.
    pub fn unpack(self, channels: &[Channel], area: Area, raw: usize, bytes: Vec<u8>) -> Result<Vec<u8>, String> {
        if bytes.len() == raw {
            return Ok(bytes);
        }
        // An empty block is one of zeros to some codecs and nothing to others.
        if bytes.is_empty() {
            return Err("no bytes".to_owned());
        }
        checks::memory(raw)?;
        match self {
            Self::Raw => Err(format!("{} bytes for {raw} of pixels", bytes.len())),
            Self::Rle | Self::Zip(_) => {
                // Bytes are all that they pack.
                let halves = Channel { name: b"Y".to_vec(), kind: Kind::Half, linear: false, sampling: (1, 1) };
                let flat = Area { x: 0, y: 0, width: raw / 2, height: 1 };
                self.call(&[halves], flat, raw, bytes)
            }
            Self::Piz | Self::Pxr24 => self.call(channels, area, raw, bytes),
            Self::Dwa(_) => {
                checks::dwa(channels, &area, raw, &bytes)?;
                self.call(channels, area, raw, bytes)
            }
            Self::B44(_) => self.unpack_b44(channels, &area, raw, &bytes),
        }
    }

    /// Channels one by one, as they stand in the block: the crate takes sub-sampled ones for whole.
    fn unpack_b44(self, channels: &[Channel], area: &Area, raw: usize, bytes: &[u8]) -> Result<Vec<u8>, String> {
        let mut planes = Vec::new();
        let mut rest = bytes;
        for channel in channels {
            let (width, height) = checks::samples(channel, area);
            let size = width * height * channel.kind.bytes();
            let packed = if channel.kind == Kind::Half { checks::b44_size(rest, width, height) } else { Some(size) };
            let (own, after) = packed.and_then(|packed| rest.split_at_checked(packed)).ok_or("it ends early")?;
            rest = after;
            if channel.kind != Kind::Half || size == 0 {
                planes.push(own.to_vec());
                continue;
            }
            let whole = Channel { sampling: (1, 1), ..channel.clone() };
            // A byte more, as a plane of the size of its pixels is taken for a plane that is not packed.
            let padded = [own, &[0]].concat();
            planes.push(self.call(&[whole], Area { x: 0, y: 0, width, height }, size, padded)?);
        }
        let mut out = Vec::with_capacity(raw);
        let mut at = vec![0; channels.len()];
        for y in area.y..area.y + area.height {
            for ((channel, plane), at) in channels.iter().zip(&planes).zip(&mut at) {
                let Some(length) = row_size(channel, area, y) else { continue };
                out.extend_from_slice(plane.get(*at..*at + length).ok_or("it ends early")?);
                *at += length;
            }
        }
        Ok(out)
    }

    /// The crate's codec, which sees a picture of this block alone.
    fn call(self, channels: &[Channel], area: Area, raw: usize, bytes: Vec<u8>) -> Result<Vec<u8>, String> {
        let pixels = area.width * area.height;
        if pixels == 0 || !raw.is_multiple_of(pixels) {
            return Err("a wrong number of pixels".to_owned());
        }
        let describe = |channel: &Channel| ChannelDescription {
            name: Text::from_slice_unchecked(&channel.name),
            sample_type: match channel.kind {
                Kind::Uint => SampleType::U32,
                Kind::Half => SampleType::F16,
                Kind::Float => SampleType::F32,
            },
            quantize_linearly: channel.linear,
            sampling: Vec2(channel.sampling.0, channel.sampling.1),
        };
        let list = channels.iter().map(describe).collect();
        let size = Vec2(area.width, area.height);
        let mut header = Header::new(Text::from_slice_unchecked(b""), size, list);
        // The crate counts every channel as whole.
        header.channels.bytes_per_pixel = raw / pixels;
        header.compression = self.foreign();
        header.blocks = BlockDescription::Tiles(TileDescription {
            tile_size: size,
            level_mode: LevelMode::Singular,
            rounding_mode: RoundingMode::Down,
        });
        let section = IntegerBounds { position: Vec2(0, 0), size };
        let unpacked = guard::quietly(|| header.compression.decompress_image_section_from_le(&header, bytes, section, false));
        match unpacked {
            Some(Ok(bytes)) if bytes.len() == raw => Ok(bytes),
            Some(Ok(_)) => Err("a wrong number of pixels".to_owned()),
            Some(Err(error)) => Err(error.to_string()),
            None => Err("values that its codec cannot take".to_owned()),
        }
    }
}
