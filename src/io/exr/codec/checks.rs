//! What a block may ask for: codecs take the memory that the counters of a block name.

use super::{Area, Channel};

/// Memory that unpacking takes for each byte of pixels: the most that a codec was seen to take.
const MEMORY: usize = 12;

/// Whether there is memory to unpack `raw` bytes of pixels. An allocation that fails within a codec ends the process.
pub fn memory(raw: usize) -> Result<(), String> {
    let mut asked: Vec<u8> = Vec::new();
    asked.try_reserve_exact(raw.saturating_mul(MEMORY)).map_err(|_| format!("there is no memory to unpack {raw} bytes of pixels"))
}

/// Columns and rows of the samples of a channel in a block.
pub fn samples(channel: &Channel, area: &Area) -> (usize, usize) {
    let rows = (area.y + area.height).div_ceil(channel.sampling.1) - area.y.div_ceil(channel.sampling.1);
    (area.width / channel.sampling.0, rows)
}

/// Bytes of a plane of half floats in B44: for each 4 x 4 samples 3 if they are equal, else 14.
pub fn b44_size(bytes: &[u8], width: usize, height: usize) -> Option<usize> {
    let mut at = 0;
    for _ in 0..width.div_ceil(4) * height.div_ceil(4) {
        at += if *bytes.get(at + 2)? >= 13 << 2 { 3 } else { 14 };
    }
    Some(at)
}

/// The counters of a DWA block (OpenEXR, `internal_dwa_compressor.h`): version; bytes of the channels that are only packed, before and after; packed bytes of
/// the transforms' other and first values and of run lengths; bytes of run lengths, and of what they become; numbers of other and first values.
pub fn dwa(channels: &[Channel], area: &Area, raw: usize, bytes: &[u8]) -> Result<(), String> {
    let (counters, after) = bytes.split_at_checked(11 * 8).ok_or("it ends early")?;
    let counters: Vec<u64> = counters.as_chunks::<8>().0.iter().map(|&bytes| u64::from_le_bytes(bytes)).collect();
    let &[version, plain, plain_packed, other_packed, first_packed, runs_packed, runs, from_runs, other, first, _] =
        &counters[..]
    else {
        return Err("it ends early".to_owned());
    };
    let packed = [plain_packed, other_packed, first_packed, runs_packed].into_iter().fold(0, u64::saturating_add);
    let blocks: u64 = channels
        .iter()
        .map(|channel| {
            let (width, height) = samples(channel, area);
            width.div_ceil(8) as u64 * height.div_ceil(8) as u64
        })
        .sum();
    let raw = raw as u64;
    // Of each 64 values one is the first; runs of one byte each take two.
    let possible = version <= 2
        && packed <= after.len() as u64
        && plain <= raw
        && from_runs <= raw
        && runs <= 2 * raw + 2
        && first <= blocks
        && other <= 64 * blocks;
    if possible { Ok(()) } else { Err("impossible counters".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::super::Kind;
    use super::*;

    #[test]
    fn counters_are_held_against_pixels_and_bytes() {
        let channel = Channel { name: b"Y".to_vec(), kind: Kind::Half, linear: false, sampling: (1, 1) };
        let area = Area { x: 0, y: 0, width: 20, height: 12 };
        let (raw, good) = (480, [2_u64, 480, 10, 20, 30, 40, 962, 480, 64 * 6, 6, 1]);
        let block = |counters: [u64; 11]| [counters.map(u64::to_le_bytes).concat(), vec![0; 100]].concat();
        assert_eq!(dwa(std::slice::from_ref(&channel), &area, raw, &block(good)), Ok(()));
        for at in 0..10 {
            for wrong in [good[at] + 103, 1 << 40, u64::MAX] {
                let mut counters = good;
                counters[at] = wrong;
                assert!(dwa(std::slice::from_ref(&channel), &area, raw, &block(counters)).is_err(), "{at} {wrong}");
            }
        }
        assert!(dwa(&[channel], &area, raw, &[0; 87]).is_err());
    }

    #[test]
    fn planes_of_b44_have_the_sizes_of_their_blocks() {
        let bytes = [[0; 14].to_vec(), vec![0, 0, 0xfc], vec![1, 2, 52], vec![0; 14]].concat();
        assert_eq!(b44_size(&bytes, 5, 5), Some(34));
        assert_eq!(b44_size(&bytes[..20], 8, 8), None);
        assert_eq!(b44_size(&[], 0, 9), Some(0));
    }
}
