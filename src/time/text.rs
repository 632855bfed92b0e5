//! A text of date, time of day, offset and zone, taken apart: ISO 8601, RFC 9557 and what people write for them.

use super::notice;
use super::parse::{self, ZoneChoice};
use super::{Civil, Time, YEARS, zones};
use crate::error::{Error, Result, quoted};
use jiff::civil::{DateTime, Time as TimeOfDay};
use jiff::fmt::temporal::{Pieces, PiecesOffset, TimeZoneAnnotationKind};
use jiff::tz::{Offset, TimeZone};

const FORM: &str = "a date and time such as 2005-06-21T13:00:00+02:00, 2005-06-21T11:00:00Z, 2005-06-21T13:00:00[Europe/Stockholm] or \
                    2005-06-21 13:00; a date alone, which is its noon; or now";

/// Longest text that is read [bytes].
const LONGEST_TEXT: usize = 100;

/// A text, taken apart.
pub(super) enum Text {
    /// The instant at which it is read.
    Now,
    Dated(Dated),
}

/// A date with what was written beside it.
pub(super) struct Dated {
    pub local: DateTime,
    pub offset: WrittenOffset,
    /// The zone in brackets.
    pub zone: Option<TimeZone>,
    /// What had to be assumed for want of a time of day that clocks show.
    pub notice: Option<String>,
}

/// What a text says of the offset.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum WrittenOffset {
    Nothing,
    /// Z: the rest is in UTC, whatever offset the clocks of the zone have.
    Zulu,
    Hours(Offset),
}

pub(super) fn unreadable(text: &str) -> Error {
    Error::input("time", quoted(text), FORM)
}

/// Takes `text` apart.
pub(super) fn read(text: &str) -> Result<Text> {
    if text.len() > LONGEST_TEXT {
        return Err(Error::input("time", quoted(text), format!("a text of at most {LONGEST_TEXT} bytes")));
    }
    if text.trim().eq_ignore_ascii_case("now") {
        return Ok(Text::Now);
    }
    let joined = join(text).ok_or_else(|| unreadable(text))?;
    let pieces = Pieces::parse(&joined).map_err(|_| unreadable(text))?;
    let zone = match pieces.time_zone_annotation().map(|annotation| annotation.kind()) {
        None => None,
        Some(TimeZoneAnnotationKind::Offset(offset)) => Some(TimeZone::fixed(*offset)),
        Some(TimeZoneAnnotationKind::Named(name)) => Some(zones::find(name.as_str()).ok_or_else(|| {
            Error::input("time", quoted(text), "given with a zone of the IANA time zone database, such as [Europe/Stockholm]")
        })?),
        Some(_) => return Err(unreadable(text)),
    };
    let offset = match pieces.offset() {
        None => WrittenOffset::Nothing,
        Some(PiecesOffset::Zulu) => WrittenOffset::Zulu,
        Some(PiecesOffset::Numeric(offset)) => WrittenOffset::Hours(offset.offset()),
        Some(_) => return Err(unreadable(text)),
    };
    let notice = match pieces.time() {
        None => Some(notice::noon(pieces.date())),
        Some(_) if has_second_60(&joined) => Some(notice::SECOND_60.to_string()),
        Some(_) => None,
    };
    let time_of_day = pieces.time().unwrap_or(TimeOfDay::constant(12, 0, 0, 0));
    Ok(Text::Dated(Dated { local: DateTime::from_parts(pieces.date(), time_of_day), offset, zone, notice }))
}

/// `text` as the standards have it: no blanks, but for one that stands for the T, and a hyphen for every minus.
fn join(text: &str) -> Option<String> {
    let text = text.replace(['\u{2212}', '\u{2010}', '\u{2011}'], "-");
    let mut words = text.split_whitespace();
    let mut joined = words.next()?.to_string();
    let mut has_time = joined.contains(['T', 't']);
    for word in words {
        match word.chars().next()? {
            '0'..='9' if !has_time => joined.push('T'),
            'T' | 't' if !has_time => {}
            '+' | '-' | 'Z' | 'z' | '[' => {}
            _ => return None,
        }
        has_time = true;
        joined.push_str(word);
    }
    Some(joined)
}

/// Whether the time of day in `joined` has a second 60, which is read as 59.
fn has_second_60(joined: &str) -> bool {
    let Some((_, time_of_day)) = joined.split_once(['T', 't', ' ']) else { return false };
    let digits = time_of_day.bytes().take_while(|byte| byte.is_ascii_digit() || *byte == b':').filter(u8::is_ascii_digit);
    digits.skip(4).take(2).eq(*b"60")
}

/// What a text says of a time, for programs that keep date, time of day, offset and zone apart.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TimeFields {
    /// Calendar and clock: in the zone that the text names, at its offset, or local where it says neither. `now` is in UTC.
    pub civil: Civil,
    /// Local time minus UTC [s], where the text says offset or zone. In an hour that clocks show twice it tells which is meant.
    pub utc_offset_s: Option<i32>,
    /// IANA name of the zone that the text names.
    pub zone: Option<String>,
    /// What had to be assumed, in a sentence, as [`Time::notice`]; whether a local time exists in its zone is not known without that zone.
    pub notice: Option<String>,
}

impl TimeFields {
    /// Reads `text` as [`Time::parse`] does, but for its zone, which may be missing.
    ///
    /// # Errors
    /// [`Error::Input`] for `time` if the text cannot be read, names no known zone, or lies outside the years 1000 to 3000.
    pub fn parse(text: &str) -> Result<Self> {
        if let Text::Dated(Dated { local, offset: WrittenOffset::Nothing, zone: None, notice }) = read(text)? {
            if !YEARS.contains(&local.year()) {
                return Err(Error::input("time", quoted(text), "within the years 1000 to 3000"));
            }
            return Ok(Self { civil: Civil::of(local), utc_offset_s: None, zone: None, notice });
        }
        let time = Time::parse(text, ZoneChoice::InText)?;
        let names_zone = matches!(read(text)?, Text::Dated(Dated { zone: Some(_), .. }));
        Ok(Self {
            civil: time.civil(),
            utc_offset_s: Some(time.utc_offset_s()),
            zone: time.zone_name().filter(|_| names_zone).map(str::to_string),
            notice: time.notice().map(str::to_string),
        })
    }
}

impl parse::Reading {
    /// The present instant, to the second, in `zone`.
    pub(super) fn now(zone: TimeZone) -> Self {
        let now = jiff::Timestamp::now();
        let whole = jiff::Timestamp::from_second(now.as_second()).unwrap_or(now);
        Self { zoned: whole.to_zoned(zone), occurrence: super::Occurrence::Once, notice: None }
    }
}
