//! Coordinates as people write them, read and written.
//!
//! Read are decimal degrees ("55.71, 13.19", "-33.87 151.21", "55,71 13,19"), degrees, minutes and seconds with signs, letters or blanks between
//! them ("55°42'36\"N 13°11'24\"E", "55 42 36 N 13 11 24 E", "N55 42.6 E13 11.4"), with names in front ("lat: 55.71, lon: 13.19"), `geo:`
//! addresses (RFC 5870) and links to maps (Google Maps, OpenStreetMap and those that write alike).
//!
//! Latitude comes first unless letters or names say otherwise. A comma between digits is a decimal one where no other reading is possible; a
//! text that can be read in two ways is refused.

mod link;
mod plain;
mod tokens;

use crate::error::{Error, Result, check_range, quoted};
use std::fmt;

/// Longest link that is read [bytes]; those of maps have some hundred.
const LONGEST_LINK: usize = 4096;

/// Longest text of anything else [bytes].
const LONGEST_TEXT: usize = 200;

/// A point of the globe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates {
    /// Geodetic latitude, positive north, -90 to 90 [degrees].
    pub latitude_deg: f64,
    /// Longitude, positive east, -180 to 180 [degrees].
    pub longitude_deg: f64,
}

/// How coordinates are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum CoordinateStyle {
    /// `55.71, 13.19`: degrees, to 0.00001 (1 m).
    #[default]
    Decimal,
    /// `55°42.600'N 13°11.400'E`: degrees and minutes, to 0.001' (2 m).
    DegreesMinutes,
    /// `55°42'36"N 13°11'24"E`: degrees, minutes and whole seconds (31 m).
    DegreesMinutesSeconds,
}

impl std::str::FromStr for CoordinateStyle {
    type Err = Error;

    /// Reads `decimal`, `minutes` or `seconds`.
    fn from_str(name: &str) -> Result<Self> {
        match name {
            "decimal" => Ok(Self::Decimal),
            "minutes" => Ok(Self::DegreesMinutes),
            "seconds" => Ok(Self::DegreesMinutesSeconds),
            _ => Err(Error::input("style", format!("{name:?}"), "one of decimal, minutes, seconds")),
        }
    }
}

impl Coordinates {
    /// The point at these coordinates.
    ///
    /// # Errors
    /// [`Error::Input`] for `latitude` outside -90 to 90 or `longitude` outside -180 to 180 degrees.
    pub fn new(latitude_deg: f64, longitude_deg: f64) -> Result<Self> {
        Ok(Self {
            latitude_deg: check_range("latitude", latitude_deg, -90.0, 90.0, "degrees")?,
            longitude_deg: check_range("longitude", longitude_deg, -180.0, 180.0, "degrees")?,
        })
    }

    /// Reads coordinates in any of the usual spellings; see the [module](self).
    ///
    /// # Errors
    /// [`Error::Input`] for `latitude` or `longitude` out of range, and for `coordinates` if the text cannot be read, or in two ways, or has more than
    /// 200 bytes, a link more than 4096.
    pub fn parse(text: &str) -> Result<Self> {
        if text.len() > LONGEST_LINK {
            return Err(too_long(text));
        }
        match link::find(text) {
            Some(found) => found,
            None if text.len() > LONGEST_TEXT => Err(too_long(text)),
            None => plain::read(text),
        }
    }

    /// The coordinates in a style; [`Coordinates::parse`] reads all of them.
    pub fn format(&self, style: CoordinateStyle) -> String {
        let Self { latitude_deg, longitude_deg } = *self;
        match style {
            CoordinateStyle::Decimal => format!("{}, {}", decimal(latitude_deg), decimal(longitude_deg)),
            CoordinateStyle::DegreesMinutes => {
                let half = |value: f64, letters: [char; 2]| {
                    let thousandths = (value.abs() * 60_000.0).round() as u64;
                    let minutes = thousandths % 60_000;
                    format!("{}°{:02}.{:03}'{}", thousandths / 60_000, minutes / 1000, minutes % 1000, letter(value, letters))
                };
                format!("{} {}", half(latitude_deg, ['N', 'S']), half(longitude_deg, ['E', 'W']))
            }
            CoordinateStyle::DegreesMinutesSeconds => {
                let half = |value: f64, letters: [char; 2]| {
                    let seconds = (value.abs() * 3600.0).round() as u64;
                    format!("{}°{:02}'{:02}\"{}", seconds / 3600, seconds / 60 % 60, seconds % 60, letter(value, letters))
                };
                format!("{} {}", half(latitude_deg, ['N', 'S']), half(longitude_deg, ['E', 'W']))
            }
        }
    }
}

impl fmt::Display for Coordinates {
    /// As [`CoordinateStyle::Decimal`].
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.format(CoordinateStyle::Decimal))
    }
}

/// Five decimals without the zeros at the end, but for one.
fn decimal(value: f64) -> String {
    // Rounded first, so that no zero has a sign.
    let text = format!("{:.5}", (value * 1e5).round() / 1e5 + 0.0);
    let digits = text.trim_end_matches('0');
    if digits.ends_with('.') { format!("{digits}0") } else { digits.to_string() }
}

fn letter(value: f64, [positive, negative]: [char; 2]) -> char {
    if value < 0.0 { negative } else { positive }
}

fn too_long(text: &str) -> Error {
    Error::input(
        "coordinates",
        quoted(text),
        format!("a text of at most {LONGEST_TEXT} bytes, or a link of at most {LONGEST_LINK}"),
    )
}

/// That `text` is not coordinates, for a reason.
fn refuse(text: &str, reason: &str) -> Error {
    Error::input(
        "coordinates",
        quoted(text.trim()),
        format!("latitude and longitude such as 55.71, 13.19 or 55 42 36 N 13 11 24 E ({reason})"),
    )
}

#[cfg(test)]
mod tests;
