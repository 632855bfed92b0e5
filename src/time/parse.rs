//! Reading civil time: ISO 8601 with offset, RFC 9557 with a zone, or a local time whose zone is told apart.

use crate::error::{Error, Result};
use jiff::Zoned;
use jiff::civil::DateTime;
use jiff::fmt::temporal::{DateTimeParser, Pieces};
use jiff::tz::{AmbiguousOffset, TimeZone};

const FORM: &str =
    "a date and time such as 2005-06-21T13:00:00+02:00, 2005-06-21T11:00:00Z or 2005-06-21T13:00:00[Europe/Stockholm]";

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

pub(super) fn parse(text: &str, zone: ZoneChoice) -> Result<(Zoned, Occurrence)> {
    let unreadable = || Error::input("time", format!("{text:?}"), FORM);
    let pieces = Pieces::parse(text.trim()).map_err(|_| unreadable())?;
    let local = DateTime::from_parts(pieces.date(), pieces.time().ok_or_else(unreadable)?);
    let in_text = if pieces.time_zone_annotation().is_some() {
        let zoned = parse_annotated(text, &pieces)?;
        let occurrence = match pieces.to_numeric_offset() {
            Some(_) => Occurrence::Once,
            None => occurrence(local, zoned.time_zone()),
        };
        Some((zoned, occurrence))
    } else if let Some(offset) = pieces.to_numeric_offset() {
        let zone = if offset.is_zero() { TimeZone::UTC } else { TimeZone::fixed(offset) };
        Some((offset.to_timestamp(local).map_err(|_| unreadable())?.to_zoned(zone), Occurrence::Once))
    } else {
        None
    };
    match (in_text, zone) {
        (Some((zoned, occurrence)), ZoneChoice::Named(name)) => Ok((zoned.with_time_zone(zone_named(name)?), occurrence)),
        (Some(found), _) => Ok(found),
        (None, ZoneChoice::InText) => Err(Error::input(
            "time",
            format!("{text:?}"),
            "given with an offset (+02:00, Z) or a zone ([Europe/Stockholm]), or with the parameter zone",
        )),
        (None, ZoneChoice::Named(name)) => at_wall_clock(local, zone_named(name)?).ok_or_else(unreadable),
        (None, ZoneChoice::OfPlace { latitude_deg, longitude_deg }) => {
            at_wall_clock(local, zone_of_place(text, latitude_deg, longitude_deg)?).ok_or_else(unreadable)
        }
    }
}

fn parse_annotated(text: &str, pieces: &Pieces) -> Result<Zoned> {
    let fail = |allowed: &str| Error::input("time", format!("{text:?}"), allowed);
    if pieces.to_time_zone().is_err() {
        return Err(fail("given with a zone of the IANA time zone database, such as [Europe/Stockholm]"));
    }
    DateTimeParser::new()
        .parse_zoned(text.trim())
        .map_err(|_| fail("given with an offset that its zone has at that time, or without one"))
}

fn zone_named(name: &str) -> Result<TimeZone> {
    TimeZone::get(name).map_err(|_| {
        Error::input("zone", format!("{name:?}"), "a name of the IANA time zone database, such as Europe/Stockholm or UTC")
    })
}

/// The first of two, or as far after a gap as in it: the rule of RFC 5545.
fn at_wall_clock(local: DateTime, zone: TimeZone) -> Option<(Zoned, Occurrence)> {
    let occurrence = occurrence(local, &zone);
    Some((zone.into_ambiguous_zoned(local).compatible().ok()?, occurrence))
}

fn occurrence(local: DateTime, zone: &TimeZone) -> Occurrence {
    match zone.to_ambiguous_timestamp(local).offset() {
        AmbiguousOffset::Unambiguous { .. } => Occurrence::Once,
        AmbiguousOffset::Fold { .. } => Occurrence::Repeated,
        AmbiguousOffset::Gap { .. } => Occurrence::Skipped,
    }
}

fn zone_of_place(text: &str, latitude_deg: f64, longitude_deg: f64) -> Result<TimeZone> {
    if cfg!(feature = "zone-lookup") {
        zone_named(super::zone_of_place(latitude_deg, longitude_deg)?)
    } else {
        Err(Error::input(
            "time",
            format!("{text:?}"),
            "given with an offset, a zone in brackets or the parameter zone: this build does not know the zones of places",
        ))
    }
}
