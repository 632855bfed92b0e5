//! Words on a picture, in the letters of `data/lettering.txt`.

use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Width of a letter with the space after it [pixels at size 1].
pub const ADVANCE: usize = 6;

/// Height of a letter [pixels at size 1].
pub const HEIGHT: usize = 8;

type Glyph = [[bool; 5]; HEIGHT];

static GLYPHS: LazyLock<BTreeMap<char, Glyph>> = LazyLock::new(|| {
    let glyph = |line: &str| {
        let (letter, rows) = line.split_once(' ')?;
        let mut glyph = Glyph::default();
        for (out, row) in glyph.iter_mut().zip(rows.split(' ')) {
            out.iter_mut().zip(row.bytes()).for_each(|(out, byte)| *out = byte == b'#');
        }
        Some((letter.chars().next()?, glyph))
    };
    include_str!("../../../data/lettering.txt").lines().filter(|line| !line.starts_with('#')).filter_map(glyph).collect()
});

/// Writes `text` into `pixels` (8 bits, row-major (height, `width`, 3)) with its upper left corner at (`x`, `y`), `size` pixels for one of a letter, in `grey`. Letters that there are not become a question
/// mark; what does not fit is cut.
pub fn write(pixels: &mut [u8], width: usize, (x, y): (usize, usize), size: usize, grey: u8, text: &str) {
    let height = pixels.len() / (3 * width);
    for (k, letter) in text.chars().enumerate().filter(|&(_, letter)| letter != ' ') {
        let Some(glyph) = GLYPHS.get(&letter).or_else(|| GLYPHS.get(&'?')) else { return };
        for (row, column) in (0..HEIGHT * size).flat_map(|row| (0..5 * size).map(move |column| (row, column))) {
            let (at_x, at_y) = (x + k * ADVANCE * size + column, y + row);
            if glyph[row / size][column / size] && at_x < width && at_y < height {
                pixels[3 * (at_y * width + at_x)..][..3].fill(grey);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_a_label_needs_is_there_and_no_two_letters_are_alike() {
        let needed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.,:-+=_/()%?";
        for letter in needed.chars() {
            assert!(GLYPHS.contains_key(&letter), "{letter}");
        }
        let shapes: std::collections::BTreeSet<&Glyph> = GLYPHS.values().collect();
        assert_eq!(shapes.len(), GLYPHS.len());
    }

    #[test]
    fn letters_stand_where_they_should_and_end_at_the_border() {
        let mut pixels = vec![0; 3 * 40 * 20];
        write(&mut pixels, 40, (1, 2), 1, 200, "l");
        // The stem of an l is in its third column.
        assert_eq!(pixels[3 * (4 * 40 + 3)], 200);
        assert_eq!(pixels[3 * (4 * 40 + 2)], 0);
        write(&mut pixels, 40, (30, 15), 3, 255, "far too long, ä and more");
    }
}
