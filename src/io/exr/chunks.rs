//! Where the blocks of a part are, and what they hold: rows or tiles of its largest level.

use super::codec::{self, Codec};
use super::part::{Channel, Header, Kind, Part};
use super::source::Source;
use crate::error::Result;
use rayon::prelude::*;
use std::io::{Read, Seek};

/// Bytes of pixels that are unpacked at a time: enough for all processors, few beside the picture.
const BATCH: usize = 32 << 20;

/// Most bytes of pixels in a block. The format counts them in 32 bits with a sign, and codecs as many values.
const MOST_IN_BLOCK: u64 = 1 << 30;

/// Samples of one channel in one row of a block.
pub struct Line<'a> {
    /// Place in the list of channels that were asked for.
    pub slot: usize,
    /// First column and row, counted in samples of this channel from the left upper corner of the data.
    pub first: (usize, usize),
    kind: Kind,
    bytes: &'a [u8],
}

impl Line<'_> {
    /// How many samples it has.
    pub fn count(&self) -> usize {
        self.bytes.len() / self.kind.bytes()
    }

    /// The samples from the left to the right.
    pub fn values(&self) -> impl Iterator<Item = f32> {
        let step = self.kind.bytes();
        self.bytes.chunks_exact(step).map(|bytes| match (self.kind, bytes) {
            (Kind::Half, &[a, b]) => half::f16::from_le_bytes([a, b]).to_f32(),
            (Kind::Float, &[a, b, c, d]) => f32::from_le_bytes([a, b, c, d]),
            (Kind::Uint, &[a, b, c, d]) => u32::from_le_bytes([a, b, c, d]) as f32,
            _ => 0.0,
        })
    }
}

/// The blocks of the largest level of a part.
struct Grid {
    /// Size of the data [pixels].
    size: (usize, usize),
    /// Size of a block [pixels].
    block: (usize, usize),
    /// Blocks beside and below each other.
    count: (usize, usize),
    tiled: bool,
}

/// A block as the file holds it.
struct Packed {
    area: codec::Area,
    raw: usize,
    bytes: Vec<u8>,
}

impl Grid {
    fn of<R: Read + Seek>(source: &Source<'_, R>, part: &Part, codec: Codec) -> Result<Self> {
        let (width, height) = part.data.size();
        let (block, tiled) = match part.tiles {
            Some(tiles) => ((tiles.size.0.min(width), tiles.size.1.min(height)), true),
            None => ((width, codec.rows() as u64), false),
        };
        if tiled && part.channels.iter().any(|channel| channel.sampling != (1, 1)) {
            return Err(source.damaged("tiles of sub-sampled channels"));
        }
        if !codec.holds(&part.channels) {
            return Err(source.unread(
                "OpenEXR with channels that are sub-sampled as they are not read in this compression: convert it to ZIP",
            ));
        }
        // Blocks of rows count from the first row of the data, samples from 0.
        let fits = |channel: &Channel| {
            let (x, y) = (channel.sampling.0 as i64, channel.sampling.1 as i64);
            let (left, top) = (i64::from(part.data.least.0), i64::from(part.data.least.1));
            left % x == 0 && top % y == 0 && width as i64 % x == 0 && height as i64 % y == 0
        };
        if !part.channels.iter().all(fits) {
            return Err(source.damaged("a data window that sub-sampled channels do not fit"));
        }
        let count = (width.div_ceil(block.0) as usize, height.div_ceil(block.1) as usize);
        let grid = Self { size: (width as usize, height as usize), block: (block.0 as usize, block.1 as usize), count, tiled };
        let most = codec::raw_size(&part.channels, &grid.area(0));
        if most.is_none_or(|bytes| bytes as u64 > MOST_IN_BLOCK) {
            return Err(source.unread(format!("OpenEXR with blocks of more than the {MOST_IN_BLOCK} bytes that are read")));
        }
        Ok(grid)
    }

    fn blocks(&self) -> usize {
        self.count.0 * self.count.1
    }

    /// Where the block `index` is.
    fn area(&self, index: usize) -> codec::Area {
        let (x, y) = ((index % self.count.0) * self.block.0, (index / self.count.0) * self.block.1);
        codec::Area { x, y, width: self.block.0.min(self.size.0 - x), height: self.block.1.min(self.size.1 - y) }
    }
}

/// How many blocks all levels of a part have, by its windows.
fn count_of(part: &Part) -> u64 {
    let (width, height) = part.data.size();
    let Some(tiles) = part.tiles else { return height.div_ceil(codec::rows_of(part.compression)) };
    let last = |length: u64| if tiles.round_up { length.max(1).next_power_of_two().ilog2() } else { length.max(1).ilog2() };
    let length = |whole: u64, level: u32| {
        let rounded = if tiles.round_up { whole.div_ceil(1 << level) } else { whole >> level };
        rounded.max(1)
    };
    let blocks =
        |x: u32, y: u32| length(width, x).div_ceil(tiles.size.0).saturating_mul(length(height, y).div_ceil(tiles.size.1));
    match tiles.levels {
        0 => blocks(0, 0),
        1 => (0..=last(width.max(height))).map(|level| blocks(level, level)).fold(0, u64::saturating_add),
        _ => (0..=last(height))
            .flat_map(|y| (0..=last(width)).map(move |x| (x, y)))
            .map(|(x, y)| blocks(x, y))
            .fold(0, u64::saturating_add),
    }
}

/// Reads the channels `wanted` (numbers in the list) of the part `number` and gives each of their rows in each block to `take`.
///
/// # Errors
/// [`Error::File`](crate::Error::File) for what is damaged or of a kind that is not read.
pub fn read<R: Read + Seek>(
    source: &mut Source<'_, R>,
    header: &Header,
    number: usize,
    wanted: &[usize],
    mut take: impl FnMut(Line<'_>),
) -> Result<()> {
    let part = &header.parts[number];
    let codec = Codec::of(part.compression).map_err(|what| source.unread(what))?;
    let grid = Grid::of(source, part, codec)?;
    if codec.least_size(&part.channels, grid.size) > source.length() {
        let bytes = source.length();
        return Err(source.damaged(format!("the header promises more pixels than {bytes} bytes can hold: damaged or cut short")));
    }
    let places = find(source, header, number, &grid)?;
    let raw_of = |index: usize| codec::raw_size(&part.channels, &grid.area(index)).unwrap_or(usize::MAX / 2);
    let mut next = 0;
    while next < places.len() {
        let (mut batch, mut size) = (Vec::new(), 0);
        while next < places.len() && (batch.is_empty() || size + raw_of(next) <= BATCH) {
            let packed = read_block(source, header, number, &grid, (next, places[next]))?;
            size += packed.raw;
            batch.push(packed);
            next += 1;
        }
        let unpack = |Packed { area, raw, bytes }: Packed| (area, codec.unpack(&part.channels, area, raw, bytes));
        let unpacked: Vec<_> = batch.into_par_iter().map(unpack).collect();
        for (area, bytes) in unpacked {
            let bytes =
                bytes.map_err(|reason| source.damaged(format!("{reason} in the block at column {}, row {}", area.x, area.y)))?;
            give(&part.channels, wanted, area, &bytes, &mut take);
        }
    }
    Ok(())
}

/// Places of the blocks of the largest level of a part in the file.
fn find<R: Read + Seek>(source: &mut Source<'_, R>, header: &Header, number: usize, grid: &Grid) -> Result<Vec<u64>> {
    let counts: Vec<u64> = header
        .parts
        .iter()
        .map(|part| match part.chunk_count.map(u64::try_from) {
            Some(Ok(count)) if header.multipart => count,
            _ => count_of(part),
        })
        .collect();
    let all = counts.iter().fold(0, |sum: u64, &count| sum.saturating_add(count));
    let blocks = grid.blocks() as u64;
    if all > source.rest() / 8 || counts[number] < blocks {
        return Err(source.damaged(format!("{all} blocks in {} bytes: damaged or cut short", source.rest())));
    }
    let tables = source.at();
    let first = tables + 8 * all;
    source.seek(tables + 8 * counts[..number].iter().sum::<u64>())?;
    let table = source.bytes(8 * blocks)?;
    let places: Vec<u64> = table.as_chunks::<8>().0.iter().map(|&bytes| u64::from_le_bytes(bytes)).collect();
    if places.iter().all(|place| (first..source.length()).contains(place)) {
        return Ok(places);
    }
    // A table that was never written: the blocks themselves say which they are.
    source.seek(first)?;
    let mut places = vec![0; grid.blocks()];
    let mut missing = places.len();
    for _ in 0..all {
        if missing == 0 || source.rest() == 0 {
            break;
        }
        let at = source.at();
        let head = Head::read(source, header)?;
        source.skip(head.size)?;
        if let Some(index) = head.index(header, number, grid).filter(|&index| places[index] == 0) {
            places[index] = at;
            missing -= 1;
        }
    }
    if missing == 0 { Ok(places) } else { Err(source.damaged(format!("{missing} of {blocks} blocks are not there: cut short"))) }
}

/// What stands before the bytes of a block.
struct Head {
    part: usize,
    /// Row of the first line; or column, row, and levels of a tile.
    place: [i32; 4],
    size: u64,
}

impl Head {
    fn read<R: Read + Seek>(source: &mut Source<'_, R>, header: &Header) -> Result<Self> {
        let part = if header.multipart { usize::try_from(source.int()?).unwrap_or(usize::MAX) } else { 0 };
        let Some(found) = header.parts.get(part) else { return Err(source.damaged("a block of no part")) };
        let mut place = [0; 4];
        for number in &mut place[..if found.tiles.is_some() { 4 } else { 1 }] {
            *number = source.int()?;
        }
        let size = if found.deep {
            let [offsets, samples, _] = [source.array()?, source.array()?, source.array()?].map(u64::from_le_bytes);
            offsets.checked_add(samples)
        } else {
            u64::try_from(source.int()?).ok()
        };
        let size = size.filter(|&size| size <= source.rest());
        Ok(Self { part, place, size: size.ok_or_else(|| source.damaged("it ends early, or the size of a block is wrong"))? })
    }

    /// Which block of the largest level of the part `number` it is.
    fn index(&self, header: &Header, number: usize, grid: &Grid) -> Option<usize> {
        if self.part != number {
            return None;
        }
        let (x, y) = if grid.tiled {
            let [x, y, 0, 0] = self.place else { return None };
            (usize::try_from(x).ok()?, usize::try_from(y).ok()?)
        } else {
            let row = i64::from(self.place[0]) - i64::from(header.parts[number].data.least.1);
            let row = usize::try_from(row).ok()?;
            (0, (row % grid.block.1 == 0).then_some(row / grid.block.1)?)
        };
        (x < grid.count.0 && y < grid.count.1).then_some(y * grid.count.0 + x)
    }
}

fn read_block<R: Read + Seek>(
    source: &mut Source<'_, R>,
    header: &Header,
    number: usize,
    grid: &Grid,
    (index, place): (usize, u64),
) -> Result<Packed> {
    source.seek(place)?;
    let head = Head::read(source, header)?;
    if head.index(header, number, grid) != Some(index) {
        return Err(source.damaged(format!("block {index} says that it is another")));
    }
    let area = grid.area(index);
    let raw = codec::raw_size(&header.parts[number].channels, &area).unwrap_or(0);
    // What does not shrink is stored as it is.
    if head.size > raw as u64 {
        return Err(source.damaged(format!("block {index} has {} bytes for {raw} of pixels", head.size)));
    }
    Ok(Packed { area, raw, bytes: source.bytes(head.size)? })
}

/// The rows of the channels `wanted` in an unpacked block.
fn give(channels: &[Channel], wanted: &[usize], area: codec::Area, bytes: &[u8], take: &mut impl FnMut(Line<'_>)) {
    let mut rest = bytes;
    for y in area.y..area.y + area.height {
        for (number, channel) in channels.iter().enumerate() {
            let Some(length) = codec::row_size(channel, &area, y) else { continue };
            let (row, after) = rest.split_at(length.min(rest.len()));
            rest = after;
            let first = (area.x / channel.sampling.0, y / channel.sampling.1);
            for slot in (0..wanted.len()).filter(|&slot| wanted[slot] == number) {
                take(Line { slot, first, kind: channel.kind, bytes: row });
            }
        }
    }
}
