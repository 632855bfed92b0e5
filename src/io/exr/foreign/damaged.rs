//! Files of every compression with a few bytes changed: any answer but a panic, an abort or a flood.

use super::read;
use ::exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes, LineOrder, Vec2,
    WritableImage, f16,
};

/// A file of 40 x 24 pixels, written by the crate.
fn sound(compression: Compression, blocks: Blocks, halves: bool) -> Vec<u8> {
    let size = 40 * 24;
    let value = |start: f32, k: usize| start + (k % 40) as f32 * 0.25 + if k.is_multiple_of(7) { 3.0 } else { 0.0 };
    let samples = |start: f32| -> FlatSamples {
        if halves {
            FlatSamples::F16((0..size).map(|k| f16::from_f32(value(start, k))).collect())
        } else {
            FlatSamples::F32((0..size).map(|k| value(start, k)).collect())
        }
    };
    let channels = [("R", 1.0), ("G", 10.0), ("B", 20.0), ("A", 0.5)].map(|(name, start)| AnyChannel::new(name, samples(start)));
    let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
    let layer = Layer::new((40, 24), LayerAttributes::default(), encoding, AnyChannels::sort(channels.into_iter().collect()));
    let mut bytes = std::io::Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn kinds() -> Vec<Vec<u8>> {
    let all = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
        Compression::DWAA(None),
        Compression::DWAB(None),
    ];
    let blocks = [Blocks::ScanLines, Blocks::Tiles(Vec2(16, 16))];
    let kinds = all.iter().flat_map(|&compression| blocks.iter().map(move |&blocks| (compression, blocks)));
    kinds.flat_map(|(compression, blocks)| [true, false].map(|halves| sound(compression, blocks, halves))).collect()
}

/// The numbers of a generator of Marsaglia (xorshift64).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % end as u64) as usize
    }

    /// A change of one to four places, of kinds that decoders take badly: bits, extremes, numbers, cuts, copies.
    fn damage(&mut self, bytes: &mut Vec<u8>) {
        for _ in 0..=self.below(4) {
            let at = self.below(bytes.len());
            match self.below(8) {
                0 => bytes[at] ^= 1 << self.below(8),
                1 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][self.below(5)],
                2 => bytes[at] = self.below(256) as u8,
                3 => bytes.iter_mut().skip(at).take(4).for_each(|byte| *byte = 0xff),
                4 => {
                    let number = (1_u64 << self.below(64)).to_le_bytes();
                    bytes.iter_mut().skip(at).zip(number).for_each(|(byte, new)| *byte = new);
                }
                5 => bytes.truncate(at.max(8)),
                6 => {
                    let from = self.below(bytes.len());
                    let piece = bytes[from..(from + 8).min(bytes.len())].to_vec();
                    bytes.iter_mut().skip(at).zip(piece).for_each(|(byte, new)| *byte = new);
                }
                _ => {
                    bytes.remove(at);
                    if bytes.len() < 9 {
                        return;
                    }
                }
            }
        }
    }
}

#[test]
fn a_changed_byte_is_an_error_or_a_value() {
    // More by hand: SKYPROBE_FUZZ=100000.
    let rounds: usize = std::env::var("SKYPROBE_FUZZ").ok().and_then(|text| text.parse().ok()).unwrap_or(150);
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let (mut read_all, mut refused) = (0, 0);
    for sound in kinds() {
        assert!(read(&sound).is_ok());
        // The header is short and the blocks are many: half of the changes are in either.
        for _ in 0..rounds {
            let mut bytes = sound.clone();
            numbers.damage(&mut bytes);
            match read(&bytes) {
                Ok(picture) => {
                    assert!(picture.width * picture.height <= 1 << 24);
                    read_all += 1;
                }
                Err(_) => refused += 1,
            }
        }
    }
    println!("{read_all} read, {refused} refused");
    assert!(read_all > 0 && refused > 0);
}
