//! Files made byte by byte (OpenEXR documentation, "OpenEXR File Layout").

use ::exr::meta::BlockDescription;
use ::exr::meta::attribute::{ChannelDescription, Compression, IntegerBounds, LineOrder, SampleType, Text};
use ::exr::meta::header::Header;
use ::exr::prelude::Vec2;

/// Sample types of the format.
pub const UINT: i32 = 0;
pub const HALF: i32 = 1;
pub const FLOAT: i32 = 2;

/// A channel: name, sample type, sampling, samples from the left upper corner on.
pub type Made<'a> = (&'a str, i32, (usize, usize), Vec<f32>);

/// An attribute: name, type, bytes.
pub type Attribute<'a> = (&'a str, &'a str, Vec<u8>);

pub fn ints(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

pub fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

pub fn channel_list<'a>(channels: impl IntoIterator<Item = (&'a str, i32, (usize, usize))>) -> Vec<u8> {
    let one = |(name, kind, (x, y)): (&str, i32, (usize, usize))| {
        [name.as_bytes(), &[0], &kind.to_le_bytes(), &[0; 4], &ints(&[x as i32, y as i32])].concat()
    };
    [channels.into_iter().flat_map(one).collect(), vec![0]].concat()
}

/// A header with the attributes that every file has, unless `more` has others of the same name.
pub fn header(flags: u32, channels: &[u8], data: [i32; 4], more: &[Attribute<'_>]) -> Vec<u8> {
    let mut bytes = [&[0x76, 0x2f, 0x31, 0x01][..], &(2 | flags).to_le_bytes()].concat();
    let plain: [Attribute<'_>; 5] = [
        ("channels", "chlist", channels.to_vec()),
        ("compression", "compression", vec![0]),
        ("dataWindow", "box2i", ints(&data)),
        ("displayWindow", "box2i", ints(&data)),
        ("lineOrder", "lineOrder", vec![0]),
    ];
    let kept = plain.iter().filter(|(name, ..)| !more.iter().any(|(other, ..)| other == name));
    for (name, kind, value) in kept.chain(more) {
        bytes.extend([name.as_bytes(), &[0], kind.as_bytes(), &[0], &ints(&[value.len() as i32]), value].concat());
    }
    bytes.push(0);
    bytes
}

/// Header, table and blocks; each block is what stands before its size, and its content.
pub fn assemble(mut bytes: Vec<u8>, blocks: &[(Vec<i32>, Vec<u8>)]) -> Vec<u8> {
    let mut at = bytes.len() + 8 * blocks.len();
    let mut body = Vec::new();
    for (place, content) in blocks {
        bytes.extend((at as u64).to_le_bytes());
        let block = [ints(place), ints(&[content.len() as i32]), content.clone()].concat();
        at += block.len();
        body.extend(block);
    }
    bytes.extend(body);
    bytes
}

/// The samples of the rows from `y` to `end` of all channels, as blocks hold them.
pub fn rows(channels: &[Made<'_>], width: usize, (y, end): (usize, usize)) -> Vec<u8> {
    let mut out = Vec::new();
    for y in y..end {
        for (_, kind, (sx, sy), samples) in channels {
            if y % sy != 0 {
                continue;
            }
            let count = width / sx;
            for &value in &samples[y / sy * count..(y / sy + 1) * count] {
                match *kind {
                    UINT => out.extend((value as u32).to_le_bytes()),
                    HALF => out.extend(half::f16::from_f32(value).to_le_bytes()),
                    _ => out.extend(value.to_le_bytes()),
                }
            }
        }
    }
    out
}

/// A file of rows that are not packed.
pub fn file(channels: &[Made<'_>], data: [i32; 4], more: &[Attribute<'_>]) -> Vec<u8> {
    let list = channel_list(channels.iter().map(|(name, kind, sampling, _)| (*name, *kind, *sampling)));
    let (width, height) = ((data[2] - data[0] + 1) as usize, (data[3] - data[1] + 1) as usize);
    let block = |y: usize| (vec![data[1] + y as i32], rows(channels, width, (y, y + 1)));
    assemble(header(0, &list, data, more), &(0..height).map(block).collect::<Vec<_>>())
}

/// Channels of 4 x 2 floats, of which the first sample of each is given.
pub fn small<'a>(channels: &[(&'a str, f32)]) -> Vec<Made<'a>> {
    channels.iter().map(|&(name, start)| (name, FLOAT, (1, 1), (0..8).map(|k| start + k as f32).collect())).collect()
}

/// zlib of differences, as the format has it.
pub fn zip(raw: &[u8]) -> Vec<u8> {
    let split: Vec<u8> = raw.iter().step_by(2).chain(raw.iter().skip(1).step_by(2)).copied().collect();
    let mut differences = vec![split[0]];
    differences.extend(split.windows(2).map(|pair| pair[1].wrapping_sub(pair[0]).wrapping_add(128)));
    miniz_oxide::deflate::compress_to_vec_zlib(&differences, 6)
}

/// zlib of differences of numbers, their bytes apart, floats without their last.
pub fn pxr24(channels: &[Made<'_>]) -> Vec<u8> {
    let mut out = Vec::new();
    for y in 0..16 {
        for (_, kind, (sx, sy), samples) in channels.iter().filter(|made| y % made.2.1 == 0) {
            let count = 32 / sx;
            let row = &samples[y / sy * count..(y / sy + 1) * count];
            let (bytes, number): (usize, fn(f32) -> u32) = match *kind {
                HALF => (2, |value| u32::from(half::f16::from_f32(value).to_bits())),
                _ => (3, |value| value.to_bits() >> 8),
            };
            let mut before = 0;
            let differences: Vec<u32> = row
                .iter()
                .map(|&value| {
                    let difference = number(value).wrapping_sub(before);
                    before = number(value);
                    difference
                })
                .collect();
            for byte in (0..bytes).rev() {
                out.extend(differences.iter().map(|value| (value >> (8 * byte)) as u8));
            }
        }
    }
    miniz_oxide::deflate::compress_to_vec_zlib(&out, 6)
}

/// Blocks of 4 x 4 halves, each of its mean (3 bytes); other samples as they are.
pub fn b44(channels: &[Made<'_>]) -> Vec<u8> {
    let mut out = Vec::new();
    for (_, kind, (sx, sy), samples) in channels {
        let (width, height) = (32 / sx, 16 / sy);
        if *kind != HALF {
            out.extend(samples.iter().flat_map(|value| value.to_le_bytes()));
            continue;
        }
        for y in (0..height).step_by(4) {
            for x in (0..width).step_by(4) {
                let sum: f32 = (0..16).map(|k| samples[(y + k / 4) * width + x + k % 4]).sum();
                let bits = half::f16::from_f32(sum / 16.0).to_bits();
                let ordered = if bits & 0x8000 != 0 { !bits } else { bits | 0x8000 };
                out.extend(ordered.to_be_bytes());
                out.push(0xfc);
            }
        }
    }
    out
}

/// A block of 32 x 16 pixels, packed by the crate, which reckons with sub-sampling only if it is told how many bytes a pixel has.
pub fn dwaa(channels: &[Made<'_>], raw: Vec<u8>) -> Vec<u8> {
    let compression = Compression::DWAA(None);
    let describe = |(name, kind, sampling, _): &Made<'_>| ChannelDescription {
        name: Text::from(*name),
        sample_type: if *kind == HALF { SampleType::F16 } else { SampleType::F32 },
        quantize_linearly: false,
        sampling: Vec2(sampling.0, sampling.1),
    };
    let size = Vec2(32, 16);
    let list = channels.iter().map(describe).collect();
    let mut header =
        Header::new(Text::from(""), size, list).with_encoding(compression, BlockDescription::ScanLines, LineOrder::Increasing);
    header.channels.bytes_per_pixel = raw.len() / size.area();
    compression.compress_image_section_to_le(&header, raw, IntegerBounds { position: Vec2(0, 0), size }).unwrap()
}
