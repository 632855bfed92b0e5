//! PNG: a tone-mapped picture to look at, with 8 or 16 bits a channel.
//!
//! What it looks like is the matter of [`post::tone`](crate::post::tone); the file says for which display: sRGB by the chunk `sRGB`, others by `cICP` (PNG, third edition, 11.3.2.6), which
//! browsers and viewers of today know.

use crate::error::{Error, Result};
use crate::post::tone::{Display, ToneMapper};
use crate::progress::Progress;
use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent};
use std::io::Write;
use std::path::Path;

/// What is compressed between two reports of progress [bytes].
const PIECE: usize = 1 << 18;

/// Chunks of the file [bytes].
const CHUNK: usize = 1 << 20;

/// Bits a channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Depth {
    /// 8, dithered.
    #[default]
    Eight,
    /// 16.
    Sixteen,
}

/// Writes what `mapper` shows; `path` is only for messages.
///
/// # Errors
/// [`Error::File`], [`Error::Cancelled`].
pub(super) fn write_mapped(
    out: &mut impl Write,
    path: &Path,
    mapper: &ToneMapper<'_>,
    depth: Depth,
    progress: &Progress,
) -> Result<()> {
    let display = mapper.display();
    match depth {
        Depth::Eight => write_8(out, path, (mapper.width(), mapper.height()), (display, &mapper.to_8_bits(progress)?), progress),
        Depth::Sixteen => {
            let codes = mapper.to_16_bits(progress)?;
            let bytes = |codes: &[u16]| codes.iter().flat_map(|code| code.to_be_bytes()).collect::<Vec<u8>>();
            let pieces = codes.chunks(PIECE / 2).map(bytes);
            write(out, path, (mapper.width(), mapper.height()), (display, BitDepth::Sixteen), pieces, progress)
        }
    }
}

/// Writes a picture of 8 bits a channel, row-major (height, width, 3); `path` is only for messages. Progress is the stage "write".
///
/// # Errors
/// [`Error::File`], [`Error::Cancelled`].
pub(super) fn write_8(
    out: &mut impl Write,
    path: &Path,
    size: (usize, usize),
    (display, pixels): (Display, &[u8]),
    progress: &Progress,
) -> Result<()> {
    write(out, path, size, (display, BitDepth::Eight), pixels.chunks(PIECE), progress)
}

fn write(
    out: &mut impl Write,
    path: &Path,
    (width, height): (usize, usize),
    (display, depth): (Display, BitDepth),
    pieces: impl ExactSizeIterator<Item = impl AsRef<[u8]>>,
    progress: &Progress,
) -> Result<()> {
    let failed = |error: png::EncodingError| Error::file(path, error);
    let mut encoder = Encoder::new(out, width as u32, height as u32);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(depth);
    if display == Display::Srgb {
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    }
    let mut writer = encoder.write_header().map_err(failed)?;
    if display != Display::Srgb {
        let [primaries, transfer] = display.code_points();
        // RGB, full range.
        writer.write_chunk(png::chunk::ChunkType(*b"cICP"), &[primaries, transfer, 0, 1]).map_err(failed)?;
    }
    // By pieces: all at once cannot be stopped, and takes seconds.
    let mut stream = writer.stream_writer_with_size(CHUNK).map_err(failed)?;
    let count = pieces.len() as f64;
    for (k, piece) in pieces.enumerate() {
        progress.report("write", k as f64 / count)?;
        stream.write_all(piece.as_ref()).map_err(|error| Error::file(path, error))?;
    }
    stream.finish().map_err(failed)?;
    writer.finish().map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post::tone::{Frame, ToneMapping};
    use crate::probe::{Probe, ProbeSettings};

    fn probe() -> Probe {
        let settings = ProbeSettings { width: 64, ..Default::default() };
        Probe::new((0..3 * 64 * 32).map(|k| 0.3 + (k % 101) as f32).collect(), settings).unwrap()
    }

    #[test]
    fn sixteen_bits_come_back_exactly() {
        let probe = probe();
        let mapper = ToneMapper::new(Frame::from(&probe), &ToneMapping::default(), &Progress::silent()).unwrap();
        let mut file = Vec::new();
        write_mapped(&mut file, Path::new("a"), &mapper, Depth::Sixteen, &Progress::silent()).unwrap();
        let back = image::load_from_memory(&file).unwrap();
        assert_eq!(back.color(), image::ColorType::Rgb16);
        let light = mapper.to_linear(&Progress::silent()).unwrap();
        for (code, light) in back.to_rgb16().into_raw().into_iter().zip(light) {
            let exact = 65_535.0 * Display::Srgb.encode(f64::from(light));
            assert!((f64::from(code) - exact).abs() <= 0.500_001, "{code} {exact}");
        }
    }

    #[test]
    fn the_file_says_what_it_is_for() {
        let probe = probe();
        for display in Display::ALL {
            let settings = ToneMapping { display, ..Default::default() };
            let mapper = ToneMapper::new(Frame::from(&probe), &settings, &Progress::silent()).unwrap();
            let mut file = Vec::new();
            write_mapped(&mut file, Path::new("a"), &mapper, Depth::Eight, &Progress::silent()).unwrap();
            let found = png::Decoder::new(std::io::Cursor::new(&file)).read_info().unwrap().info().clone();
            let points = found.coding_independent_code_points.map(|points| [points.color_primaries, points.transfer_function]);
            match display {
                Display::Srgb => assert!(found.srgb.is_some() && points.is_none()),
                _ => assert_eq!(points, Some(display.code_points())),
            }
        }
    }
}
