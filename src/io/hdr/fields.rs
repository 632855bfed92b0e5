//! The header of a Radiance picture ("Radiance File Formats", picture files; `header.c` and `color.h` of Radiance).
//!
//! | line | what it says |
//! |---|---|
//! | `FORMAT=` | 32-bit_rle_rgbe (also without such a line) or 32-bit_rle_xyze; any other is no picture of this kind, the one refusal here |
//! | `EXPOSURE=` | all pixels were multiplied by it; of several lines by their product |
//! | `COLORCORR=` | the same for each channel by its own number |
//! | `PRIMARIES=` | x and y of red, green, blue and white |
//! | `PIXASPECT=` | height over width of a pixel. Pixels are taken as square: neither a projection nor another program that we write for has others |
//! | `skyprobe.name=` | our own |
//!
//! A name stands at the very beginning of its line: what is indented is the history of the pictures that this one was made of, whose exposures
//! are not its own. What cannot be understood of these is left aside with a note, and what is not in the table without one; `#?` is not asked for.

use crate::spectrum::{Chromaticities, ColorSpace};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{BufRead, Read};

/// Longest header [bytes]: nothing that is a header comes near it.
const LONGEST_HEADER: usize = 32 << 20;

/// What is kept of a line [bytes].
const LONGEST_LINE: usize = 1 << 16;

/// How many of our own fields are kept.
const MOST_FIELDS: usize = 1 << 10;

/// Reason why it cannot be read.
pub type Parsed<T> = Result<T, String>;

/// What a header says.
#[derive(Debug)]
pub struct Header {
    pub is_xyz: bool,
    /// What each channel is to be divided by.
    pub divisors: [f64; 3],
    pub chromaticities: Option<Chromaticities>,
    /// Our own fields by name.
    pub fields: BTreeMap<String, String>,
    /// What was left aside, by the name of the field.
    pub notes: BTreeMap<&'static str, String>,
}

impl Header {
    /// Reads up to the empty line that ends it.
    pub fn read(reader: &mut impl BufRead) -> Parsed<Self> {
        let mut header =
            Self { is_xyz: false, divisors: [1.0; 3], chromaticities: None, fields: BTreeMap::new(), notes: BTreeMap::new() };
        let (mut left, mut bytes) = (LONGEST_HEADER, Vec::new());
        let mut is_radiance = false;
        loop {
            let is_first = left == LONGEST_HEADER;
            let Some(line) = line(reader, &mut left, &mut bytes)? else {
                return Err(if is_radiance { "its header does not end" } else { "neither #? nor the end of a header is there" }
                    .to_owned());
            };
            if line.is_empty() {
                break;
            }
            is_radiance |= is_first && line.starts_with("#?");
            if let Some((name, value)) = line.split_once('=') {
                header.understand(name, value)?;
            }
        }
        header.fields = joined(header.fields);
        Ok(header)
    }

    fn understand(&mut self, name: &str, value: &str) -> Parsed<()> {
        let mut note = |name: &'static str, consequence: &str| {
            self.notes.entry(name).or_insert_with(|| format!("{name}={}: {consequence}", shortened(value.trim())));
        };
        match name {
            "FORMAT" => match value.trim() {
                "" => {}
                value if value.eq_ignore_ascii_case("32-bit_rle_rgbe") => self.is_xyz = false,
                value if value.eq_ignore_ascii_case("32-bit_rle_xyze") => self.is_xyz = true,
                value => return Err(format!("its format is {}, not 32-bit_rle_rgbe or 32-bit_rle_xyze", shortened(value))),
            },
            "EXPOSURE" => {
                let exposure = leading_numbers::<1>(value).and_then(|[exposure]| multiplied(self.divisors, [exposure; 3]));
                match exposure {
                    Some(divisors) => self.divisors = divisors,
                    None => note("EXPOSURE", "no factor of light, taken as 1"),
                }
            }
            "COLORCORR" => match leading_numbers(value).and_then(|factors| multiplied(self.divisors, factors)) {
                Some(divisors) => self.divisors = divisors,
                None => note("COLORCORR", "no three factors of light, taken as 1 1 1"),
            },
            "PRIMARIES" => {
                self.chromaticities = primaries(value);
                if self.chromaticities.is_none() {
                    note("PRIMARIES", "no primaries of a colour space, left aside");
                }
            }
            "PIXASPECT" if leading_numbers::<1>(value).is_none_or(|[aspect]| (aspect - 1.0).abs() > 1e-3) => {
                note("PIXASPECT", "pixels are taken as square");
            }
            name if name.starts_with("skyprobe.") && (self.fields.len() < MOST_FIELDS || self.fields.contains_key(name)) => {
                self.fields.insert(name.to_owned(), value.to_owned());
            }
            _ => {}
        }
        Ok(())
    }

    /// Primaries and white of the pixels, if they are said.
    pub fn space(&self) -> Option<Chromaticities> {
        if self.is_xyz { Some(ColorSpace::Xyz.chromaticities()) } else { self.chromaticities }
    }
}

/// The next line, without its end and what is over [`LONGEST_LINE`]; `None` if there is none. It takes its length from the bytes that are `left`, and room in `bytes`.
pub fn line<'a>(reader: &mut impl BufRead, left: &mut usize, bytes: &'a mut Vec<u8>) -> Parsed<Option<Cow<'a, str>>> {
    let failed = |error: std::io::Error| error.to_string();
    bytes.clear();
    reader.by_ref().take(LONGEST_LINE as u64).read_until(b'\n', bytes).map_err(failed)?;
    let mut taken = bytes.len();
    let mut ended = bytes.last() == Some(&b'\n');
    while !ended {
        let buffer = reader.fill_buf().map_err(failed)?;
        if buffer.is_empty() {
            return Ok(None);
        }
        let end = buffer.iter().position(|&byte| byte == b'\n');
        let skipped = end.map_or(buffer.len(), |end| end + 1);
        reader.consume(skipped);
        taken += skipped;
        ended = end.is_some();
        if taken > *left {
            break;
        }
    }
    *left = left.checked_sub(taken).ok_or_else(|| format!("its header does not end within {} MB", LONGEST_HEADER >> 20))?;
    let text = bytes.strip_suffix(b"\n").unwrap_or(bytes);
    Ok(Some(String::from_utf8_lossy(text.strip_suffix(b"\r").unwrap_or(text))))
}

/// `factors` times `others`, if each product is one that values can be divided by.
fn multiplied(factors: [f64; 3], others: [f64; 3]) -> Option<[f64; 3]> {
    let products = std::array::from_fn(|k| factors[k] * others[k]);
    let is_factor = |factor: &f64| factor.is_normal() && *factor > 0.0;
    (others.iter().all(is_factor) && products.iter().all(is_factor)).then_some(products)
}

/// The first `N` numbers of `text`, which white space divides; what comes after them does not count, as for `atof` and `sscanf`.
fn leading_numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let mut rest = text;
    let mut numbers = [0.0; N];
    for number in &mut numbers {
        rest = rest.trim_start();
        let (own, behind) = rest.split_at(number_length(rest.as_bytes()));
        *number = own.parse().ok().filter(|value: &f64| value.is_finite())?;
        rest = behind;
    }
    Some(numbers)
}

/// How many bytes at the beginning are a decimal number.
fn number_length(bytes: &[u8]) -> usize {
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let digits = |at: usize| bytes.iter().skip(at).take_while(|byte| byte.is_ascii_digit()).count();
    let start = sign(0);
    let whole = digits(start);
    let fraction = if bytes.get(start + whole) == Some(&b'.') { 1 + digits(start + whole + 1) } else { 0 };
    if whole + fraction.saturating_sub(1) == 0 {
        return 0;
    }
    let end = start + whole + fraction;
    if !matches!(bytes.get(end), Some(b'e' | b'E')) {
        return end;
    }
    let exponent = sign(end + 1);
    match digits(end + 1 + exponent) {
        0 => end,
        count => end + 1 + exponent + count,
    }
}

/// x and y of red, green, blue and white, if a colour space can have them.
fn primaries(text: &str) -> Option<Chromaticities> {
    let [a, b, c, d, e, f, g, h] = leading_numbers(text)?;
    let found = Chromaticities { red: [a, b], green: [c, d], blue: [e, f], white: [g, h] };
    found.is_usable().then_some(found)
}

/// Fields `name.1`, `name.2`, ... as one field `name`, as [`put_field`](super::put_field) has divided it, and all others without white space around them.
fn joined(fields: BTreeMap<String, String>) -> BTreeMap<String, String> {
    let mut whole = BTreeMap::new();
    for (name, value) in &fields {
        match name.strip_suffix(".1").filter(|name| !fields.contains_key(*name)) {
            Some(stem) => {
                let pieces = (1..).map_while(|number| fields.get(&format!("{stem}.{number}")));
                whole.insert(stem.to_owned(), pieces.map(String::as_str).collect());
            }
            None => {
                whole.insert(name.clone(), value.trim().to_owned());
            }
        }
    }
    whole
}

/// No more of a text than a message can hold.
fn shortened(text: &str) -> String {
    if text.chars().count() > 60 { text.chars().take(57).chain("...".chars()).collect() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Parsed<Header> {
        Header::read(&mut text.as_bytes())
    }

    #[test]
    fn factors_are_cumulative_and_divide_each_channel() {
        let header = read("#?RADIANCE\nEXPOSURE=4\nCOLORCORR= 1 2 .5\nEXPOSURE= 0.5e0 of pfilt\nCOLORCORR=2 1 1\n\n").unwrap();
        // checked against: "Radiance File Formats", both are multipliers that have been applied, and are cumulative
        assert_eq!(header.divisors, [4.0, 4.0, 1.0]);
        assert!(header.notes.is_empty());
    }

    #[test]
    fn what_is_not_essential_never_refuses() {
        for (line, noted) in [
            ("EXPOSURE=0", true),
            ("EXPOSURE=-2", true),
            ("EXPOSURE=", true),
            ("EXPOSURE=auto", true),
            ("EXPOSURE=nan", true),
            ("EXPOSURE=inf", true),
            ("EXPOSURE=1e999", true),
            ("EXPOSURE=1e-320", true),
            ("COLORCORR=1 2", true),
            ("COLORCORR=1 0 1", true),
            ("COLORCORR=red", true),
            ("PRIMARIES=0 0 0 0 0 0 0 0", true),
            ("PRIMARIES=1 2 3", true),
            ("PRIMARIES=none", true),
            ("PRIMARIES=.64 .33 .64 .33 .15 .06 .3127 .329", true),
            ("PRIMARIES=.64 .33 .3 .6 .15 .06 .9 .9", true),
            ("PRIMARIES=.64 .33 .3 .6 .15 .06 .3127 0", true),
            ("PIXASPECT=2", true),
            ("PIXASPECT=wide", true),
            ("PIXASPECT=1.000000", false),
            ("GAMMA=much", false),
            ("VIEW= -vtv -vh", false),
            ("FORMAT=", false),
            ("=", false),
            ("==", false),
            ("#", false),
            ("\tEXPOSURE=16", false),
            (" EXPOSURE=16", false),
            ("\tFORMAT=ascii", false),
            ("\tPRIMARIES=1", false),
            ("pfilt -e 2 EXPOSURE=16", false),
            ("skyprobe.rows", false),
            ("\u{fffd}\u{1}", false),
        ] {
            let header = read(&format!("#?RADIANCE\n{line}\nSOFTWARE=x\n\n")).unwrap();
            assert_eq!(header.divisors, [1.0; 3], "{line}");
            assert!(header.chromaticities.is_none(), "{line}");
            assert_eq!(!header.notes.is_empty(), noted, "{line}: {:?}", header.notes);
        }
        let header = read("EXPOSURE=0\nEXPOSURE=3\nEXPOSURE=none\n\n").unwrap();
        assert_eq!((header.divisors, header.notes.len()), ([3.0; 3], 1));
        assert_eq!(header.notes["EXPOSURE"], "EXPOSURE=0: no factor of light, taken as 1");
    }

    #[test]
    fn formats_are_known_or_named() {
        for (text, is_xyz) in [
            ("\n", false),
            ("#?RGBE\r\nFORMAT=32-bit_rle_xyze\r\n\r\n", true),
            ("FORMAT= 32-bit_rle_xyze \n\n", true),
            ("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n", false),
            ("\u{feff}#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n", false),
        ] {
            assert_eq!(read(text).unwrap().is_xyz, is_xyz, "{text}");
        }
        assert!(read("#?RADIANCE\nFORMAT=Radiance_spectra\n\n").unwrap_err().contains("format is Radiance_spectra"));
        assert!(read("#?RADIANCE\nFORMAT=float").unwrap_err().contains("does not end"));
        assert!(read("P6\n1 1\n").unwrap_err().contains("neither #?"));
    }

    #[test]
    fn fields_in_pieces_are_joined_and_whole_ones_are_believed() {
        let header = read("skyprobe.a.2= c \nskyprobe.a.1= b\nskyprobe.b= d \nskyprobe.b.1=e\nskyprobe.c.2=f\n\n").unwrap();
        let expected = [("skyprobe.a", " b c "), ("skyprobe.b", "d"), ("skyprobe.b.1", "e")];
        for (name, value) in expected {
            assert_eq!(header.fields[name], value, "{name}");
        }
        assert!(!header.fields.contains_key("skyprobe.c"));
    }

    #[test]
    fn long_headers_take_little() {
        let many = "skyprobe.x=1\n\tpfilt\nEXPOSURE=0\n".repeat(300_000) + "\n";
        let header = read(&many).unwrap();
        assert_eq!((header.fields.len(), header.notes.len()), (1, 1));
        let names: String = (0..100_000).map(|number| format!("skyprobe.{number}=1\n")).collect();
        assert!(read(&(names + "\n")).unwrap().fields.len() <= MOST_FIELDS);
        let long = format!("skyprobe.x={}\nEXPOSURE=2\n\n", "1".repeat(5_000_000));
        let header = read(&long).unwrap();
        assert_eq!(header.divisors, [2.0; 3]);
        assert!(header.fields["skyprobe.x"].len() < LONGEST_LINE);
        // Neither takes memory: the bytes are made while they are read.
        for endless in [b'\n', b'7'] {
            let mut lines = std::io::BufReader::new(Read::chain(&b"#?RADIANCE\nx"[..], std::io::repeat(endless)));
            let read = Header::read(&mut lines);
            assert!(if endless == b'\n' { read.is_ok() } else { read.unwrap_err().contains("within 32 MB") });
        }
    }
}
