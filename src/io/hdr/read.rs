//! Reading Radiance pictures: flat, old and new run lengths, RGBE and XYZE, any orientation (Radiance, `color.c` and `resolu.c`; Ward 1991).

use super::decode;
use crate::error::{Error, Result};
use crate::io::read::Raw;
use crate::post::picture::MAX_SIDE;
use crate::spectrum::{Chromaticities, ColorSpace};
use std::collections::BTreeMap;
use std::path::Path;

/// Rows of the new run lengths are between these wide [pixels].
const NEW_WIDTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// Reads a Radiance file. The pixels are divided by the product of its EXPOSURE lines: what the camera or the renderer saw.
///
/// # Errors
/// [`Error::File`] for a file that is none, is damaged or cut short.
pub fn read_rgb(path: &Path) -> Result<Raw> {
    let bytes = std::fs::read(path).map_err(|error| Error::file(path, error))?;
    parse(&bytes).map_err(|reason| Error::file(path, format!("not a sound Radiance picture ({reason})")))
}

type Parsed<T> = std::result::Result<T, String>;

fn parse(bytes: &[u8]) -> Parsed<Raw> {
    let mut rest = bytes;
    if !line(&mut rest).is_some_and(|first| first.starts_with("#?")) {
        return Err("it does not begin with #?".to_owned());
    }
    let mut fields = BTreeMap::new();
    let (mut exposure, mut chromaticities, mut is_xyz) = (1.0_f64, None, false);
    loop {
        let line = line(&mut rest).ok_or("the header does not end")?;
        if line.is_empty() {
            break;
        }
        let Some((name, value)) = line.split_once('=') else { continue };
        let value = value.trim();
        match name.trim() {
            "FORMAT" => match value {
                "32-bit_rle_rgbe" => is_xyz = false,
                "32-bit_rle_xyze" => is_xyz = true,
                _ => return Err(format!("format {value}")),
            },
            "EXPOSURE" => {
                exposure *= value.parse::<f64>().map_err(|_| format!("EXPOSURE={value}"))?;
                if !(exposure.is_finite() && exposure > 0.0) {
                    return Err(format!("EXPOSURE={value}"));
                }
            }
            "PRIMARIES" => chromaticities = Some(primaries(value).ok_or_else(|| format!("PRIMARIES={value}"))?),
            name => {
                fields.insert(name.to_owned(), value.to_owned());
            }
        }
    }
    let resolution = line(&mut rest).ok_or("no line of its size")?;
    let layout = Layout::of(&resolution).ok_or_else(|| format!("size {resolution}"))?;
    layout.check_length(rest.len())?;
    let mut pixels = vec![0.0; 3 * layout.width * layout.height];
    let mut row = vec![[0; 4]; layout.length];
    for number in 0..layout.count {
        read_row(&mut rest, &mut row).map_err(|reason| format!("{reason} in line {} of {}", number + 1, layout.count))?;
        for (k, &pixel) in row.iter().enumerate() {
            let (x, y) = layout.place(k, number);
            let at = 3 * (y * layout.width + x);
            for (value, found) in pixels[at..at + 3].iter_mut().zip(decode(pixel)) {
                *value = (f64::from(found) / exposure) as f32;
            }
        }
    }
    let chromaticities = if is_xyz { Some(ColorSpace::Xyz.chromaticities()) } else { chromaticities };
    Ok(Raw { width: layout.width, height: layout.height, pixels, chromaticities, fields })
}

/// The next line, without its end; `None` if there is no end.
fn line(rest: &mut &[u8]) -> Option<String> {
    let end = rest.iter().position(|&byte| byte == b'\n')?;
    let text = String::from_utf8_lossy(&rest[..end]).trim_end_matches('\r').to_owned();
    *rest = &rest[end + 1..];
    Some(text)
}

fn primaries(text: &str) -> Option<Chromaticities> {
    let numbers: Vec<f64> = text.split_whitespace().map(str::parse).collect::<std::result::Result<_, _>>().ok()?;
    let [a, b, c, d, e, f, g, h] = numbers[..] else { return None };
    let sound = numbers.iter().all(|value| value.is_finite()) && [b, d, f, h].iter().all(|y| *y != 0.0);
    // Without extent on the chart there is no space.
    let area = (c - a) * (f - b) - (e - a) * (d - b);
    (sound && area.abs() > 1e-6).then_some(Chromaticities { red: [a, b], green: [c, d], blue: [e, f], white: [g, h] })
}

/// How lines of the file are placed in the picture.
struct Layout {
    width: usize,
    height: usize,
    /// Pixels in a line of the file, and lines.
    length: usize,
    count: usize,
    lines_are_rows: bool,
    from_right: bool,
    from_bottom: bool,
}

impl Layout {
    fn of(text: &str) -> Option<Self> {
        let words: Vec<&str> = text.split_whitespace().collect();
        let [first, count, second, length] = words[..] else { return None };
        let (count, length): (usize, usize) = (count.parse().ok()?, length.parse().ok()?);
        if ![count, length].iter().all(|side| (1..=MAX_SIDE).contains(side)) {
            return None;
        }
        let lines_are_rows = first.ends_with('Y');
        let (y, x) = if lines_are_rows { (first, second) } else { (second, first) };
        if !["+Y", "-Y"].contains(&y) || !["+X", "-X"].contains(&x) {
            return None;
        }
        let (width, height) = if lines_are_rows { (length, count) } else { (count, length) };
        Some(Self { width, height, length, count, lines_are_rows, from_right: x == "-X", from_bottom: y == "+Y" })
    }

    /// Before memory is taken: two bytes make at most 127 of a row's bytes in the new run lengths; in the old ones a picture can be one repetition a row.
    fn check_length(&self, bytes: usize) -> Parsed<()> {
        let least = self.count * if NEW_WIDTHS.contains(&self.length) { (4 * self.length / 127).min(8) } else { 4 };
        if bytes < least { Err(format!("it ends early: {} lines in {bytes} bytes", self.count)) } else { Ok(()) }
    }

    /// Column and row of the pixel `k` of a line.
    fn place(&self, k: usize, line: usize) -> (usize, usize) {
        let (x, y) = if self.lines_are_rows { (k, line) } else { (line, k) };
        (if self.from_right { self.width - 1 - x } else { x }, if self.from_bottom { self.height - 1 - y } else { y })
    }
}

fn take<'a>(rest: &mut &'a [u8], count: usize) -> Parsed<&'a [u8]> {
    let (taken, left) = rest.split_at_checked(count).ok_or("it ends early")?;
    *rest = left;
    Ok(taken)
}

fn read_row(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Parsed<()> {
    let is_new = NEW_WIDTHS.contains(&row.len()) && matches!(rest, [2, 2, high, ..] if *high < 128);
    if !is_new {
        return read_old_row(rest, row);
    }
    let head = take(rest, 4)?;
    if usize::from(head[2]) << 8 | usize::from(head[3]) != row.len() {
        return Err("another width".to_owned());
    }
    for component in 0..4 {
        let mut at = 0;
        while at < row.len() {
            let count = usize::from(take(rest, 1)?[0]);
            let is_run = count > 128;
            let count = if is_run { count - 128 } else { count };
            let target = row.get_mut(at..at + count).filter(|target| !target.is_empty()).ok_or("a run of a wrong length")?;
            let values = take(rest, if is_run { 1 } else { count })?;
            target.iter_mut().enumerate().for_each(|(k, pixel)| pixel[component] = values[if is_run { 0 } else { k }]);
            at += count;
        }
    }
    Ok(())
}

/// Pixels one after the other; 1, 1, 1, n repeats the one before n times, the next such n counts 256 times as much.
fn read_old_row(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Parsed<()> {
    let (mut at, mut shift) = (0, 0_u32);
    while at < row.len() {
        let pixel: [u8; 4] = take(rest, 4)?.try_into().map_err(|_| "it ends early")?;
        if pixel[..3] == [1, 1, 1] {
            let count = usize::from(pixel[3]).checked_shl(shift).unwrap_or(usize::MAX);
            let end = at.checked_add(count).filter(|&end| at > 0 && end <= row.len() && count > 0);
            let end = end.ok_or("a repetition of a wrong length")?;
            let before = row[at - 1];
            row[at..end].fill(before);
            at = end;
            shift += 8;
        } else {
            row[at] = pixel;
            at += 1;
            shift = 0;
        }
    }
    Ok(())
}

/// Names and values of the header that `bytes` begin with. An error is a reason.
pub fn header_fields(bytes: &[u8]) -> Parsed<BTreeMap<String, String>> {
    let blank = |end: &[u8]| bytes.windows(end.len()).position(|found| found == end).map(|at| at + end.len());
    let end = blank(b"\n\n").into_iter().chain(blank(b"\n\r\n")).min().ok_or("the header does not end")?;
    // The header as that of a picture of one pixel.
    parse(&[&bytes[..end], b"-Y 1 +X 1\n\0\0\0\0"].concat()).map(|raw| raw.fields)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(header: &str, pixels: &[u8]) -> Vec<u8> {
        [header.as_bytes(), pixels].concat()
    }

    #[test]
    fn old_run_lengths_exposure_primaries_and_orientation_are_understood() {
        let header = "#?RGBE\n# by hand\nEXPOSURE=4\nEXPOSURE= 0.5\n\
                      PRIMARIES=.708 .292 .170 .797 .131 .046 .3127 .3290\nFORMAT=32-bit_rle_rgbe\n\n+Y 2 -X 3\n";
        let red = [128, 0, 0, 129];
        let green = [0, 128, 0, 129];
        let pixels = [&red[..], &[1, 1, 1, 2], &green, &red, &[1, 1, 1, 1]].concat();
        let raw = parse(&file(header, &pixels)).unwrap();
        assert_eq!((raw.width, raw.height), (3, 2));
        // The first line is the lowest, from the right. The product of the exposures is 2.
        assert_eq!(raw.pixels[9..], [0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, 0.0]);
        assert_eq!(raw.pixels[..9], [0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5, 0.0]);
        assert_eq!(raw.chromaticities.unwrap().space(), Some(ColorSpace::LinRec2020));
        let columns = parse(&file("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n+X 2 -Y 1\n", &[red, green].concat())).unwrap();
        assert_eq!((columns.width, columns.height, &columns.pixels[..]), (2, 1, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0][..]));
        assert_eq!(columns.chromaticities.unwrap().space(), Some(ColorSpace::Xyz));
    }

    #[test]
    fn damage_is_told() {
        let good = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
        let none: &[u8] = &[];
        for (header, pixels, told) in [
            ("P6\n", none, "does not begin"),
            ("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", none, "does not end"),
            ("#?RADIANCE\nFORMAT=ascii\n\n-Y 1 +X 1\n", none, "format ascii"),
            ("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n", none, "EXPOSURE=0"),
            ("#?RADIANCE\nPRIMARIES=1 2 3\n\n-Y 1 +X 1\n", none, "PRIMARIES"),
            ("#?RADIANCE\n\n-Y 1 +X 999999\n", none, "size -Y"),
            ("#?RADIANCE\n\n-Y 30000 +X 30000\n", &[0; 99], "30000 lines in 99 bytes"),
            (good, &[2, 2, 0, 9], "another width"),
            (good, &[2, 2, 0, 8, 137, 5], "wrong length"),
            (good, &[2, 2, 0, 8, 0, 5], "wrong length"),
            (good, &[2, 2, 0, 8, 136, 5, 136], "ends early"),
            (good, &[1, 1, 1, 3], "repetition"),
            (good, &[9, 9, 9, 128, 1, 1, 1, 200], "repetition"),
            (good, &[9, 9, 9, 128], "ends early in line 1 of 1"),
        ] {
            let reason = parse(&file(header, pixels)).unwrap_err();
            assert!(reason.contains(told), "{reason}");
        }
    }
}
