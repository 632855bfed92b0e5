//! The rows of a Radiance picture: flat, in the old or in the new run lengths, each as it likes.
//!
//! Read as Radiance itself does (`color.c`, freadcolrs and oldreadcolrs). The first four bytes are 2, 2 and the width for the new run lengths, else a pixel, whatever
//! they are. In the old ones 1, 1, 1, n repeats the pixel before n times, the next such n counts 256 times as much, a zero among them counts as one, and what goes beyond the end of
//! the row is left out. In the new ones it is damage.

use super::fields::Parsed;
use std::io::{ErrorKind, Read};

/// Rows so wide can have no other beginning of 2, 2 than the new run lengths [pixels].
const NEW_WIDTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// More than this count of a repetition does not fit the integer that Radiance counts it with [bits].
const COUNT_BITS: u32 = 32;

/// Least number of bytes that hold a row of `length` pixels.
pub fn least_bytes(length: usize) -> u64 {
    // One pixel, and repetitions of 8 bits of the count each.
    let old = 4 + 4 * u64::from(usize::BITS - length.saturating_sub(1).leading_zeros()).div_ceil(8);
    let new = 4 + 8 * (length as u64).div_ceil(127);
    old.min(new)
}

/// Fills `row` with its pixels.
pub fn read_row(reader: &mut impl Read, row: &mut [[u8; 4]]) -> Parsed<()> {
    let head = bytes(reader)?;
    if let [2, 2, high @ 0..=127, low] = head {
        if usize::from(high) << 8 | usize::from(low) == row.len() {
            return read_new_row(reader, row);
        }
        if NEW_WIDTHS.contains(&row.len()) {
            return Err("it says another width".to_owned());
        }
    }
    row[0] = head;
    read_old_row(reader, row)
}

/// One component after the other: n over 128 repeats the byte behind it n - 128 times, other n bytes follow.
fn read_new_row(reader: &mut impl Read, row: &mut [[u8; 4]]) -> Parsed<()> {
    let mut values = [0; 128];
    for component in 0..4 {
        let mut at = 0;
        while at < row.len() {
            let count = usize::from(bytes::<1>(reader)?[0]);
            let (count, is_run) = if count > 128 { (count - 128, true) } else { (count, false) };
            let target = row.get_mut(at..at + count).ok_or("a run goes beyond its end")?;
            if is_run {
                let [value] = bytes(reader)?;
                target.iter_mut().for_each(|pixel| pixel[component] = value);
            } else {
                let values = &mut values[..count];
                reader.read_exact(values).map_err(failed)?;
                target.iter_mut().zip(values).for_each(|(pixel, value)| pixel[component] = *value);
            }
            at += count;
        }
    }
    Ok(())
}

/// The pixels after the first.
fn read_old_row(reader: &mut impl Read, row: &mut [[u8; 4]]) -> Parsed<()> {
    let (mut at, mut shift) = (1, 0_u32);
    while at < row.len() {
        match bytes(reader)? {
            [1, 1, 1, count] => {
                let left = row.len() - at;
                let count =
                    if count > 0 && shift >= COUNT_BITS { left } else { left.min(usize::from(count) << shift.min(COUNT_BITS)) };
                let before = row[at - 1];
                row[at..at + count].fill(before);
                at += count;
                shift = shift.saturating_add(8);
            }
            pixel => {
                row[at] = pixel;
                at += 1;
                shift = 0;
            }
        }
    }
    Ok(())
}

fn bytes<const N: usize>(reader: &mut impl Read) -> Parsed<[u8; N]> {
    let mut bytes = [0; N];
    reader.read_exact(&mut bytes).map_err(failed)?;
    Ok(bytes)
}

fn failed(error: std::io::Error) -> String {
    if error.kind() == ErrorKind::UnexpectedEof { "the file ends early".to_owned() } else { error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [u8; 4] = [128, 64, 32, 129];
    const B: [u8; 4] = [9, 200, 7, 130];

    fn repeat(count: u8) -> [u8; 4] {
        [1, 1, 1, count]
    }

    fn read(width: usize, bytes: &[u8]) -> Parsed<(Vec<[u8; 4]>, usize)> {
        let mut row = vec![[0; 4]; width];
        let mut rest = bytes;
        read_row(&mut rest, &mut row)?;
        Ok((row, rest.len()))
    }

    #[test]
    fn old_run_lengths_are_those_of_radiance() {
        // checked against: ray/src/common/color.c, oldreadcolrs, "least significant byte first", "the rest of the repetition will be silently ignored"
        // Bytes, the pixels in them and how often, and how many bytes are left.
        type Case<'a> = (&'a [[u8; 4]], &'a [([u8; 4], usize)], usize);
        let cases: [Case<'_>; 11] = [
            (&[A, repeat(2), B], &[(A, 3), (B, 1)], 0),
            (&[A, repeat(0), repeat(1)], &[(A, 257)], 0),
            (&[A, repeat(0), repeat(0), B], &[(A, 1), (B, 1)], 0),
            (&[A, repeat(3), repeat(1), B, repeat(2)], &[(A, 260), (B, 3)], 0),
            (&[A, repeat(0), B, repeat(3)], &[(A, 1), (B, 4)], 0),
            // Beyond the end of the row; the next row begins behind the repetition.
            (&[A, repeat(200), B], &[(A, 8)], 4),
            (&[A, repeat(0), repeat(200), B], &[(A, 300)], 4),
            (&[A, repeat(0), repeat(0), repeat(0), repeat(0), repeat(1), B], &[(A, 9)], 4),
            (&[A, repeat(0), repeat(0), repeat(0), repeat(128), B], &[(A, 9)], 4),
            // At the beginning of a row there is nothing to repeat: it is a pixel.
            (&[repeat(3), repeat(2), B], &[(repeat(3), 3), (B, 1)], 0),
            // A flat row of few pixels.
            (&[A, B, A], &[(A, 1), (B, 1), (A, 1)], 0),
        ];
        for (bytes, expected, left) in cases {
            let expected: Vec<[u8; 4]> = expected.iter().flat_map(|&(pixel, count)| std::iter::repeat_n(pixel, count)).collect();
            assert_eq!(read(expected.len(), &bytes.concat()).unwrap(), (expected, left), "{bytes:?}");
        }
    }

    #[test]
    fn new_run_lengths_are_those_of_radiance() {
        let row = [2, 2, 0, 9, 137, 128, 0, 128 + 4, 64, 0, 5, 1, 2, 3, 4, 5, 137, 32, 137, 129];
        let (pixels, left) = read(9, &row).unwrap();
        assert_eq!((pixels[0], pixels[4], pixels[8], left), ([128, 64, 32, 129], [128, 1, 32, 129], [128, 5, 32, 129], 0));
        let flat = [2, 1, 0, 9].repeat(9);
        assert_eq!(read(9, &flat).unwrap().0, [[2, 1, 0, 9]; 9]);
        // Radiance writes them from 17 pixels on and reads them in any width; else these are pixels.
        assert_eq!(read(3, &[2, 2, 0, 3, 131, 7, 131, 8, 131, 9, 131, 130]).unwrap().0, [[7, 8, 9, 130]; 3]);
        assert_eq!(read(3, &[2, 2, 0, 4].repeat(3)).unwrap().0, [[2, 2, 0, 4]; 3]);
        let literal: Vec<u8> =
            [2, 2, 0, 128].into_iter().chain((0..4).flat_map(|k| [vec![128], vec![k; 128]].concat())).collect();
        assert_eq!(read(128, &literal).unwrap().0, [[0, 1, 2, 3]; 128]);
    }

    #[test]
    fn damage_is_told() {
        for (bytes, told) in [
            (&[2, 2, 0, 9][..], "another width"),
            (&[2, 2, 0, 8, 137, 5], "beyond its end"),
            (&[2, 2, 0, 8, 9, 5], "beyond its end"),
            (&[2, 2, 0, 8, 0, 0], "ends early"),
            (&[2, 2, 0, 8, 136, 5, 136], "ends early"),
            (&[9, 9, 9], "ends early"),
            (&[9, 9, 9, 128, 1, 1, 1, 3], "ends early"),
            (&[], "ends early"),
        ] {
            assert!(read(8, bytes).unwrap_err().contains(told), "{bytes:?}");
        }
    }

    #[test]
    fn the_least_bytes_of_a_row_are_enough() {
        for (width, bytes) in [(1, 4), (2, 8), (256, 8), (257, 12), (32768, 12)] {
            assert_eq!(least_bytes(width), bytes, "{width}");
            let count = (width - 1).to_le_bytes();
            let used = (bytes as usize - 4) / 4;
            let row: Vec<u8> = A.into_iter().chain(count[..used].iter().flat_map(|&part| repeat(part))).collect();
            assert_eq!(read(width, &row).unwrap(), (vec![A; width], 0));
        }
    }
}
