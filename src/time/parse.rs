//! From a text to an instant in its zone, and how often the clocks of that zone show it.

use super::text::{Dated, Text, WrittenOffset, read, unreadable};
use super::zones::zone_named;
use super::{YEARS, notice};
use crate::error::{Error, Result, quoted};
use jiff::civil::DateTime;
use jiff::tz::{AmbiguousOffset, Offset, OffsetConflict, TimeZone};
use jiff::{Unit, Zoned};

/// Which zone a time without offset is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ZoneChoice<'a> {
    /// The text itself must say it.
    InText,
    /// This zone of the IANA database, such as "Europe/Stockholm". It also decides which civil time is shown of a text with offset.
    Named(&'a str),
    /// The zone that is kept today at this place, found offline in embedded boundaries (feature `zone-lookup`). A text with
    /// offset keeps its own.
    OfPlace {
        /// Geodetic latitude, positive north, -90 to 90 [degrees].
        latitude_deg: f64,
        /// Longitude, positive east, -180 to 180 [degrees].
        longitude_deg: f64,
    },
}

/// How often a clock on the wall shows a local time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occurrence {
    /// Once, as most times; so does a time that is given with its offset.
    Once,
    /// Twice, because clocks are set back; the first is taken.
    Repeated,
    /// Never, because clocks are set forward; the time as far after the gap is taken.
    Skipped,
}

/// A text that was read.
pub(super) struct Reading {
    pub zoned: Zoned,
    pub occurrence: Occurrence,
    /// What had to be assumed, in words.
    pub notice: Option<String>,
}

pub(super) fn parse(text: &str, zone: ZoneChoice) -> Result<Reading> {
    let reading = match read(text)? {
        Text::Now => Reading::now(match zone {
            ZoneChoice::InText => TimeZone::UTC,
            ZoneChoice::Named(name) => zone_named(name)?,
            ZoneChoice::OfPlace { latitude_deg, longitude_deg } => zone_of_place(text, latitude_deg, longitude_deg)?,
        }),
        Text::Dated(dated) => at(text, dated, zone)?,
    };
    if YEARS.contains(&reading.zoned.year()) {
        return Ok(reading);
    }
    Err(Error::input("time", quoted(text), "within the years 1000 to 3000"))
}

fn at(text: &str, dated: Dated, zone: ZoneChoice) -> Result<Reading> {
    let Dated { local, offset, zone: written_zone, notice } = dated;
    let once = |zoned: Zoned| Reading { zoned, occurrence: Occurrence::Once, notice: notice.clone() };
    let in_text = match (offset, written_zone) {
        (WrittenOffset::Nothing, None) => None,
        (WrittenOffset::Nothing, Some(zone)) => Some(at_wall_clock(text, local, zone, notice.clone())?),
        (WrittenOffset::Zulu, zone) => {
            let utc = Offset::UTC.to_timestamp(local).map_err(|_| unreadable(text))?;
            Some(once(utc.to_zoned(zone.unwrap_or(TimeZone::UTC))))
        }
        (WrittenOffset::Hours(offset), None) => {
            let zone = if offset.is_zero() { TimeZone::UTC } else { TimeZone::fixed(offset) };
            Some(once(offset.to_timestamp(local).map_err(|_| unreadable(text))?.to_zoned(zone)))
        }
        (WrittenOffset::Hours(offset), Some(zone)) => Some(once(agreed(text, local, offset, zone)?)),
    };
    match (in_text, zone) {
        (Some(reading), ZoneChoice::Named(name)) => {
            let zoned = reading.zoned.with_time_zone(zone_named(name)?);
            Ok(Reading { zoned, ..reading })
        }
        (Some(reading), _) => Ok(reading),
        (None, ZoneChoice::InText) => Err(Error::input(
            "time",
            quoted(text),
            "given with an offset (+02:00, Z) or a zone ([Europe/Stockholm]), or with the parameter zone",
        )),
        (None, ZoneChoice::Named(name)) => at_wall_clock(text, local, zone_named(name)?, notice),
        (None, ZoneChoice::OfPlace { latitude_deg, longitude_deg }) => {
            at_wall_clock(text, local, zone_of_place(text, latitude_deg, longitude_deg)?, notice)
        }
    }
}

/// The instant at which both `offset` and `zone` show `local`.
fn agreed(text: &str, local: DateTime, offset: Offset, zone: TimeZone) -> Result<Zoned> {
    // Texts that know no seconds in offsets round those of local mean time to minutes.
    let is_same = |written: Offset, kept: Offset| {
        let is_rounded = written.seconds() % 60 == 0 && kept.seconds() % 60 != 0;
        written == kept || is_rounded && kept.round(Unit::Minute).is_ok_and(|kept| kept == written)
    };
    let resolved = OffsetConflict::Reject.resolve_with(local, offset, zone, is_same).and_then(|found| found.unambiguous());
    resolved
        .map_err(|_| Error::input("time", quoted(text), "given with an offset that its zone has at that time, or without one"))
}

/// The first of two, or as far after a gap as in it: the rule of RFC 5545.
fn at_wall_clock(text: &str, local: DateTime, zone: TimeZone, assumed: Option<String>) -> Result<Reading> {
    let occurrence = match zone.to_ambiguous_timestamp(local).offset() {
        AmbiguousOffset::Unambiguous { .. } => Occurrence::Once,
        AmbiguousOffset::Fold { .. } => Occurrence::Repeated,
        AmbiguousOffset::Gap { .. } => Occurrence::Skipped,
    };
    let zoned = zone.into_ambiguous_zoned(local).compatible().map_err(|_| unreadable(text))?;
    let parts = [assumed, notice::of(local, &zoned, occurrence)];
    let notice = parts.into_iter().flatten().reduce(|one, other| format!("{one}; {other}"));
    Ok(Reading { zoned, occurrence, notice })
}

fn zone_of_place(text: &str, latitude_deg: f64, longitude_deg: f64) -> Result<TimeZone> {
    if cfg!(feature = "zone-lookup") {
        zone_named(super::zone_of_place(latitude_deg, longitude_deg)?)
    } else {
        Err(Error::input(
            "time",
            quoted(text),
            "given with an offset, a zone in brackets or the parameter zone: this build does not know the zones of places",
        ))
    }
}
