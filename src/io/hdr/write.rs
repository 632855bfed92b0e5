//! The header of a Radiance picture that we write.
//!
//! Its lines are short: other readers take them piece by piece, and stumble over some lengths (OpenCV over 635 bytes, OpenImageIO over 640). A longer field of
//! our own is divided over several, `skyprobe.config.1`, `skyprobe.config.2`, ..., which [`header_fields`](super::header_fields) joins again; a longer standard one is repeated.

use super::super::{metadata::Metadata, own_fields};
use crate::probe::ProbeSettings;
use crate::spectrum::ColorSpace;
use std::fmt::Write as _;

/// Longest line without its end [bytes].
const LONGEST_LINE: usize = 118;

/// What the number of a piece takes at most: a dot and four digits [bytes].
const NUMBER: usize = 5;

/// All that comes before the rows.
pub fn header(settings: &ProbeSettings, metadata: &Metadata) -> String {
    let mut fields = Vec::new();
    let mut field = |name: &str, value: &str| fields.push((name.to_owned(), value.to_owned()));
    if let Some(date) = &metadata.capture_date {
        field("CAPDATE", date);
    }
    if let (Some(latitude), Some(longitude)) = (metadata.latitude_deg, metadata.longitude_deg) {
        field("LATLONG", &format!("{latitude:.6} {longitude:.6}"));
    }
    fields.extend(own_fields(settings, metadata));
    if let Some(comments) = &metadata.comments {
        fields.push(("COMMENT".to_owned(), comments.clone()));
    }
    picture_header(settings.color_space, (settings.width, settings.height()), &fields)
}

/// The same for a picture of `size` with `fields` of its own.
pub fn picture_header(color_space: ColorSpace, size: (usize, usize), fields: &[(String, String)]) -> String {
    let mut text = format!("#?RADIANCE\nSOFTWARE=skyprobe {}\n", env!("CARGO_PKG_VERSION"));
    for (name, value) in fields {
        put_field(&mut text, name, value);
    }
    text + &values(color_space, size)
}

/// Writes a field in as many lines as it takes.
fn put_field(text: &mut String, name: &str, value: &str) {
    let value = value.replace(char::is_control, " ");
    let mut put = |name: &str, value: &str| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{name}={value}");
    };
    if name.len() + 1 + value.len() <= LONGEST_LINE {
        return put(name, &value);
    }
    let is_own = name.starts_with("skyprobe.");
    for (k, piece) in pieces(&value, (LONGEST_LINE - NUMBER - 1).saturating_sub(name.len()).max(4)).into_iter().enumerate() {
        if is_own { put(&format!("{name}.{}", k + 1), piece) } else { put(name, piece) }
    }
}

/// `text` in pieces of at most `length` bytes.
fn pieces(text: &str, length: usize) -> Vec<&str> {
    let mut rest = text;
    let mut pieces = Vec::new();
    while !rest.is_empty() {
        let end = (0..=length.min(rest.len())).rev().find(|&end| rest.is_char_boundary(end)).unwrap_or(rest.len());
        let (piece, behind) = rest.split_at(end);
        pieces.push(piece);
        rest = behind;
    }
    pieces
}

/// The end of every header: what values are, and how many.
fn values(color_space: ColorSpace, (width, height): (usize, usize)) -> String {
    let (primaries, format) = if color_space == ColorSpace::Xyz {
        (String::new(), "32-bit_rle_xyze")
    } else {
        let c = color_space.chromaticities();
        let numbers = [c.red, c.green, c.blue, c.white].map(|[x, y]| format!("{x:.5} {y:.5}")).join(" ");
        (format!("PRIMARIES={numbers}\n"), "32-bit_rle_rgbe")
    };
    format!("{primaries}EXPOSURE=1\nFORMAT={format}\n\n-Y {height} +X {width}\n")
}

#[cfg(test)]
mod tests {
    use super::super::header_fields;
    use super::*;
    use proptest::prelude::*;

    fn written(config: &str, comments: &str) -> String {
        let metadata = Metadata {
            latitude_deg: Some(-33.123_456),
            longitude_deg: Some(-118.123_456),
            capture_date: Some("2005:06:21 13:00:00".to_owned()),
            sun_altitude_deg: Some(-12.123_456),
            sun_azimuth_deg: Some(300.123_456),
            config_json: Some(config.to_owned()),
            comments: Some(comments.to_owned()),
            ..Default::default()
        };
        header(&ProbeSettings::default(), &metadata)
    }

    fn config_in(header: &str) -> String {
        header_fields(header.as_bytes()).unwrap().remove("skyprobe.config").unwrap()
    }

    #[test]
    fn a_config_in_one_line_is_still_read() {
        let config = format!("{{\"place\": \"{}\"}}", "a".repeat(600));
        assert_eq!(config_in(&format!("#?RADIANCE\nskyprobe.config={config}\n\n")), config);
    }

    #[test]
    fn lengths_that_other_readers_stumble_over_are_no_lengths_of_lines() {
        for length in 1..2000 {
            let config = format!("{{{}}}", "é ".repeat(length / 3));
            let header = written(&config, &"b".repeat(length));
            assert!(header.lines().all(|line| line.len() < 120), "{length}: {header}");
            assert_eq!(config_in(&header), config);
        }
    }

    proptest! {
        #[test]
        fn no_line_is_long_and_the_config_comes_back(config in "\\PC{0,900}", comments in any::<String>()) {
            prop_assume!(config.len() > 200 || config.trim() == config);
            let header = written(&config, &comments);
            for line in header.lines() {
                prop_assert!(line.len() < 120, "{line}");
            }
            prop_assert_eq!(config_in(&header), config);
        }
    }
}
