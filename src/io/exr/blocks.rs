//! Blocks of scan lines with ZIP compression (OpenEXR documentation, "OpenEXR File Layout" and "Technical Introduction").
//!
//! Sixteen rows make a block: row by row the samples of B, G and R of the picture, then of each of its layers, little-endian. Their bytes at even places go before those at odd places, each byte becomes its difference
//! from the one before plus 128, and zlib packs the result; a block that does not shrink is stored as it is.
//! The lower half of a float32 of a smooth sky is as good as noise: zlib's fastest level leaves 56 % of it and packs 250 MB a second and core, level 4 leaves 45 %
//! at a quarter of that speed.

use half::f16;
use half::slice::HalfFloatSliceExt;
use rayon::prelude::*;

/// Rows of a block.
pub const BLOCK_ROWS: usize = 16;

/// zlib's level of effort.
const EFFORT: u8 = 1;

/// How pixels become blocks.
#[derive(Clone, Debug)]
pub struct Packing {
    width: usize,
    height: usize,
    half: bool,
    scale: f32,
    layers: Vec<&'static str>,
}

impl Packing {
    /// For a picture of `width` x `height` pixels, and its `layers` in the order of their names, as half floats or float32, after multiplication by `scale`.
    pub fn new((width, height): (usize, usize), half: bool, scale: f32, layers: Vec<&'static str>) -> Self {
        debug_assert!(layers.is_sorted());
        Self { width, height, half, scale, layers }
    }

    /// Names of the channels, in the order of the file, which is theirs.
    pub fn channels(&self) -> impl Iterator<Item = String> {
        let prefixes = std::iter::once(String::new()).chain(self.layers.iter().map(|name| format!("{name}.")));
        prefixes.flat_map(|prefix| ["B", "G", "R"].map(|channel| format!("{prefix}{channel}")))
    }

    /// Width and height [pixels].
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Whether samples are half floats.
    pub fn is_half(&self) -> bool {
        self.half
    }

    /// Factor on the pixels.
    pub fn scale(&self) -> f32 {
        self.scale
    }

    /// The number of this compression in the header.
    pub fn compression(&self) -> u8 {
        3
    }

    /// How many blocks the picture has.
    pub fn blocks(&self) -> usize {
        self.height.div_ceil(BLOCK_ROWS)
    }

    /// The blocks, each with its head, of `pictures`, the picture and its layers: whole rows (RGB) from row `first` on, which is a multiple of 16; all blocks but the last are full.
    pub fn pack(&self, first: usize, pictures: &[&[f32]]) -> Vec<Vec<u8>> {
        let rows = pictures[0].len() / (3 * self.width);
        let block = |k: usize| {
            let (from, to) = (k * BLOCK_ROWS, ((k + 1) * BLOCK_ROWS).min(rows));
            let rows: Vec<&[f32]> = (from..to).flat_map(|row| self.row(pictures, row)).collect();
            let data = if self.half { self.pack_halves(&rows) } else { self.pack_floats(&rows) };
            let row = (first + from) as i32;
            [&row.to_le_bytes()[..], &(data.len() as i32).to_le_bytes(), &data].concat()
        };
        (0..rows.div_ceil(BLOCK_ROWS)).into_par_iter().map(block).collect()
    }

    /// One row of the picture and of each layer that the file holds.
    fn row<'a>(&self, pictures: &[&'a [f32]], row: usize) -> impl Iterator<Item = &'a [f32]> {
        let stride = 3 * self.width;
        pictures[..=self.layers.len()].iter().map(move |pixels| &pixels[stride * row..stride * (row + 1)])
    }

    fn pack_floats(&self, rows: &[&[f32]]) -> Vec<u8> {
        let count = 3 * self.width * rows.len();
        let mut split = vec![0; 4 * count];
        let (even, odd) = split.split_at_mut(2 * count);
        let places = even.as_chunks_mut::<2>().0.iter_mut().zip(odd.as_chunks_mut::<2>().0);
        for ((even, odd), value) in places.zip(self.samples(rows)) {
            let [a, b, c, d] = value.to_le_bytes();
            (*even, *odd) = ([a, c], [b, d]);
        }
        deflate(&split)
    }

    fn pack_halves(&self, rows: &[&[f32]]) -> Vec<u8> {
        let samples: Vec<f32> = self.samples(rows).collect();
        let mut halves = vec![f16::ZERO; samples.len()];
        halves.convert_from_f32_slice(&samples);
        let mut split = vec![0; 2 * samples.len()];
        let (even, odd) = split.split_at_mut(samples.len());
        for ((even, odd), value) in even.iter_mut().zip(odd).zip(&halves) {
            [*even, *odd] = value.to_le_bytes();
        }
        deflate(&split)
    }

    /// Scaled samples in the order of the file.
    fn samples(&self, rows: &[&[f32]]) -> impl Iterator<Item = f32> {
        let scale = self.scale;
        rows.iter().flat_map(move |row| {
            [2, 1, 0].into_iter().flat_map(move |k| row.as_chunks::<3>().0.iter().map(move |pixel| scale * pixel[k]))
        })
    }
}

/// Packs bytes of which those at even places come first; in their own order and unpacked if that is not shorter.
fn deflate(split: &[u8]) -> Vec<u8> {
    let mut differences = Vec::with_capacity(split.len());
    differences.extend(split.first());
    differences.extend(split.windows(2).map(|pair| pair[1].wrapping_sub(pair[0]).wrapping_add(128)));
    let packed = miniz_oxide::deflate::compress_to_vec_zlib(&differences, EFFORT);
    if packed.len() < split.len() {
        return packed;
    }
    let (even, odd) = split.split_at(split.len() / 2);
    even.iter().zip(odd).flat_map(|(&even, &odd)| [even, odd]).collect()
}
