//! Where the text of a configuration comes from: a file of JSON, the standard input, or the header of a picture.

use crate::error::{Error, Result};
use crate::io::{STANDARD, exr, hdr};
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

/// The field of our headers that holds it.
const FIELD: &str = "skyprobe.config";

/// What is read of a text at most [bytes]. A table of the night or of an aerosol has some kilobytes.
const LONGEST: u64 = 16 << 20;

/// What is read of a picture, in search of the end of its header [bytes].
const LONGEST_HEADER: u64 = 1 << 20;

/// The first bytes of OpenEXR, Radiance and PNG files.
const EXR: &[u8] = &[0x76, 0x2f, 0x31, 0x01];
const HDR: &[u8] = b"#?";
const PNG: &[u8] = &[0x89, b'P', b'N', b'G'];

/// The text of a configuration.
#[derive(Debug, PartialEq)]
pub struct Source {
    /// The text.
    pub text: String,
    /// Whether a picture's header holds it: then it was written with the picture, and not by hand.
    pub is_header: bool,
}

/// The text of the configuration in `path`, which is called `name` in messages.
///
/// # Errors
/// [`Error::Input`] for `config`.
pub fn text_of(path: &Path, name: &str) -> Result<Source> {
    if path.as_os_str() == STANDARD {
        return read(BufReader::new(std::io::stdin().lock()), name);
    }
    let file = File::open(path).map_err(|error| unreadable(name, &error))?;
    read(BufReader::new(file), name)
}

fn read(mut source: impl BufRead, name: &str) -> Result<Source> {
    let wrong = |allowed: &str| Error::input("config", name, allowed);
    // A pipe may hand over less than is asked for.
    let mut bytes = Vec::new();
    (&mut source).take(EXR.len() as u64).read_to_end(&mut bytes).map_err(|error| unreadable(name, &error))?;
    let fields = if bytes == EXR {
        source.take(LONGEST_HEADER).read_to_end(&mut bytes).map_err(|error| unreadable(name, &error))?;
        exr::header_fields(&bytes)
    } else if bytes.starts_with(HDR) {
        source.take(LONGEST_HEADER).read_to_end(&mut bytes).map_err(|error| unreadable(name, &error))?;
        hdr::header_fields(&bytes)
    } else if bytes.starts_with(PNG) {
        return Err(wrong("JSON text, or an .exr or .hdr of skyprobe: a PNG does not hold its configuration"));
    } else {
        source.take(LONGEST).read_to_end(&mut bytes).map_err(|error| unreadable(name, &error))?;
        if bytes.len() as u64 > LONGEST {
            return Err(wrong("JSON text of at most 16 MB"));
        }
        let text = decoded(bytes).ok_or_else(|| wrong("JSON text in UTF-8, or in UTF-16 with a byte-order mark"))?;
        return Ok(Source { text, is_header: false });
    };
    let mut fields = fields.map_err(|reason| wrong(&format!("a picture whose header can be read ({reason})")))?;
    let none = "JSON text, or a picture whose header holds the configuration that skyprobe made it from; this one has none";
    fields.remove(FIELD).map(|text| Source { text, is_header: true }).ok_or_else(|| wrong(none))
}

fn unreadable(name: &str, error: &std::io::Error) -> Error {
    Error::input("config", name, format!("a readable file of JSON text, or a picture of skyprobe ({error})"))
}

/// Text without its byte-order mark: UTF-8, or UTF-16 as some shells redirect it.
fn decoded(bytes: Vec<u8>) -> Option<String> {
    let wide = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let (units, rest) = bytes.as_chunks::<2>();
        let text = String::from_utf16(&units.iter().map(|&pair| unit(pair)).collect::<Vec<_>>()).ok()?;
        rest.is_empty().then_some(text)
    };
    match bytes.as_slice() {
        [0xff, 0xfe, rest @ ..] => wide(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => wide(rest, u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => String::from_utf8(rest.to_vec()).ok(),
        _ => String::from_utf8(bytes).ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::{FileOptions, Metadata, save, tests::gradient};
    use crate::probe::ProbeSettings;

    #[test]
    fn byte_order_marks_are_no_part_of_the_text() {
        let text = "{\"place\": \"\u{c5}rhus\"}";
        let units: Vec<u16> = text.encode_utf16().collect();
        let wide = |mark: u16, bytes: fn(u16) -> [u8; 2]| [mark].iter().chain(&units).flat_map(|&unit| bytes(unit)).collect();
        let cases: [Vec<u8>; 4] = [
            text.into(),
            [b"\xef\xbb\xbf", text.as_bytes()].concat(),
            wide(0xfeff, u16::to_le_bytes),
            wide(0xfeff, u16::to_be_bytes),
        ];
        for bytes in cases {
            assert_eq!(read(&bytes[..], "a.json").unwrap(), Source { text: text.to_owned(), is_header: false });
        }
        for bytes in
            [&b"{\xff}"[..], b"\xff\xfe{", b"\x89PNG\r\n\x1a\n", b"#?RADIANCE\n", EXR, b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"]
        {
            let message = read(bytes, "a.json").unwrap_err().to_string();
            assert!(message.starts_with("config = a.json: must be "), "{message}");
        }
        assert_eq!(read(&b"{}"[..], "a").unwrap().text + &read(&b""[..], "a").unwrap().text, "{}");
        assert!(read(std::io::BufReader::new(std::io::repeat(b' ')), "a").unwrap_err().to_string().contains("16 MB"));
    }

    #[test]
    fn pictures_hold_their_configuration() {
        let folder = tempfile::tempdir().unwrap();
        let probe = gradient(ProbeSettings { width: 64, ..Default::default() });
        // Longer than a line of a header should be.
        let config = format!("{{\"place\": \"{}\"}}", "Llanfair  pwll ".repeat(40));
        let metadata = Metadata { config_json: Some(config.clone()), ..Default::default() };
        for name in ["a.exr", "a.hdr"] {
            let path = folder.path().join(name);
            save(&path, &probe, &FileOptions::default(), &metadata).unwrap();
            assert_eq!(text_of(&path, name).unwrap(), Source { text: config.clone(), is_header: true }, "{name}");
            save(&path, &probe, &FileOptions::default(), &Metadata::default()).unwrap();
            assert!(text_of(&path, name).unwrap_err().to_string().contains("this one has none"));
        }
    }
}
