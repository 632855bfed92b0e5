//! Radiance RGBE pictures (`.hdr`): the format in which light probes were first exchanged (Ward 1991, "Real Pixels", Graphics Gems II).
//!
//! Four bytes a pixel: with e such that the largest component lies in [2^(e-1), 2^e), bytes round(256 c / 2^e) and e + 128. Rounding to nearest
//! fits readers that decode a byte b as b 2^e / 256, as Blender, Mitsuba and OpenImageIO do (error at most 0.5 / 256 of 2^e);
//! Radiance itself adds half a step and so reads pixels brighter by that. Negative components cannot be written and become 0.
//! Rows are run-length encoded one component after the other, if they have the widths for which the format knows that.

mod fields;
mod read;
mod rows;
mod write;

pub use read::header_fields;
pub(super) use read::{parse_rgb, read_rgb};
pub(super) use write::{header, picture_header};

use rayon::prelude::*;

/// Widths of the rows that readers take for run-length encoded; others are written pixel by pixel.
const PACKED_WIDTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// The bytes of a linear colour.
///
/// Components must be finite; those below 2^-128 or so become 0.
pub fn encode(rgb: [f32; 3]) -> [u8; 4] {
    let largest = rgb[0].max(rgb[1]).max(rgb[2]);
    if largest < 1e-38 {
        return [0; 4];
    }
    // Exponent of the largest: bits of the f32, which is normal here.
    let mut exponent = (largest.to_bits() >> 23) as i32 - 126;
    if (f64::from(largest) * 2f64.powi(8 - exponent)).round() > 255.0 {
        exponent += 1;
    }
    if exponent > 127 {
        return [255; 4];
    }
    let scale = 2f64.powi(8 - exponent);
    let byte = |component: f32| (f64::from(component) * scale).round().clamp(0.0, 255.0) as u8;
    [byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), (exponent + 128) as u8]
}

/// The linear colour of four bytes.
pub fn decode([red, green, blue, exponent]: [u8; 4]) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let scale = 2f64.powi(i32::from(exponent) - 136);
    [red, green, blue].map(|byte| (f64::from(byte) * scale) as f32)
}

/// Rows as the file holds them, of `pixels` (RGB, whole rows of `width`).
pub(super) fn encode_rows(width: usize, pixels: &[f32]) -> Vec<Vec<u8>> {
    let encode_row = |pixels: &[f32]| {
        let row: Vec<[u8; 4]> = pixels.as_chunks::<3>().0.iter().map(|&pixel| encode(pixel)).collect();
        if !PACKED_WIDTHS.contains(&width) {
            return row.into_iter().flatten().collect();
        }
        let mut packed = vec![2, 2, (width >> 8) as u8, (width & 255) as u8];
        (0..4).for_each(|component| pack(&row, component, &mut packed));
        packed
    };
    pixels.par_chunks(3 * width).map(encode_row).collect()
}

/// Appends one component of a row: runs of 4 to 127 equal bytes as (128 + count, byte), others as (count, bytes...).
fn pack(row: &[[u8; 4]], component: usize, out: &mut Vec<u8>) {
    let at = |k: usize| row[k][component];
    let run_length = |from: usize| (from..row.len().min(from + 127)).take_while(|&k| at(k) == at(from)).count();
    let mut position = 0;
    while position < row.len() {
        let run = run_length(position);
        if run >= 4 {
            out.extend([128 + run as u8, at(position)]);
            position += run;
            continue;
        }
        let start = position;
        while position < row.len() && position - start < 128 {
            let run = run_length(position);
            if run >= 4 {
                break;
            }
            position = (position + run).min(start + 128);
        }
        out.push((position - start) as u8);
        out.extend((start..position).map(at));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Reverses [`pack`].
    fn unpack(mut bytes: &[u8], width: usize) -> Vec<u8> {
        let mut out = Vec::new();
        while out.len() < width {
            let count = bytes[0] as usize;
            if count > 128 {
                out.extend(std::iter::repeat_n(bytes[1], count - 128));
                bytes = &bytes[2..];
            } else {
                assert!(count > 0);
                out.extend(&bytes[1..=count]);
                bytes = &bytes[1 + count..];
            }
        }
        assert!(bytes.is_empty());
        out
    }

    #[test]
    fn numbers_have_the_bytes_of_the_format() {
        // checked against: Ward 1991, 1.0 = 128/256 2^1
        assert_eq!(encode([1.0, 0.5, 0.25]), [128, 64, 32, 129]);
        assert_eq!(encode([0.0; 3]), [0; 4]);
        assert_eq!(encode([-1.0, 0.999_999, 0.0]), [0, 128, 0, 129]);
        assert_eq!(encode([f32::MAX, 1.0, 0.0]), [255; 4]);
    }

    #[test]
    fn rows_of_every_width_come_back() {
        for width in [1, 7, 8, 0x7fff, 0x8000] {
            // 2, 2 in the first bytes, as packed rows begin.
            let pixels: Vec<f32> = (0..6 * width).map(|k| if k < 3 { 2.0 } else { 1.0 + (k / 3 % 5) as f32 }).collect();
            let rows = encode_rows(width, &pixels).concat();
            let bytes = [format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X {width}\n").as_bytes(), &rows].concat();
            let back = parse_rgb(std::path::Path::new("a.hdr"), &bytes, &crate::io::PictureLimits::default()).unwrap();
            assert_eq!((back.width, back.height), (width, 2));
            assert!(back.pixels == pixels, "{width}");
            assert_eq!(rows.len() == 8 * width, !PACKED_WIDTHS.contains(&width));
        }
    }

    proptest! {
        #[test]
        fn colours_come_back_within_half_a_step(a in -37i32..37, r in 0.0f32..1.0, g in 0.0f32..1.0, b in 0.0f32..1.0) {
            let colour = [r, g, b].map(|value| value * 10f32.powi(a));
            let back = decode(encode(colour));
            let largest = colour.into_iter().fold(0.0, f32::max);
            prop_assume!(largest > 2e-38);
            let top = 2f64.powi(f64::from(largest).log2().floor() as i32 + 1);
            // The largest may round up to the next power of two, whose step is twice as large.
            let step = if encode(colour)[..3].contains(&128) { 2.0 } else { 1.0 } * top / 256.0;
            for (value, back) in colour.into_iter().zip(back) {
                prop_assert!((f64::from(value) - f64::from(back)).abs() <= 0.5001 * step, "{colour:?} {back}");
            }
        }

        #[test]
        fn rows_unpack(runs in prop::collection::vec((0u8..4, 1usize..300), 1..12)) {
            let row: Vec<[u8; 4]> = runs.iter().flat_map(|&(byte, count)| std::iter::repeat_n([byte; 4], count)).collect();
            let mut packed = Vec::new();
            pack(&row, 2, &mut packed);
            prop_assert_eq!(unpack(&packed, row.len()), row.iter().map(|pixel| pixel[2]).collect::<Vec<_>>());
        }
    }
}
