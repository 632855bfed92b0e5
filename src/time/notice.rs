//! In words: what was taken for a time that clocks show never or twice, or that was not given in full.

use super::parse::Occurrence;
use jiff::civil::{Date, DateTime};
use jiff::tz::{Offset, TimeZone};
use jiff::{SignedDuration, Timestamp, Zoned};

pub(super) const SECOND_60: &str = "a second 60 is read as the second 59 before it";

/// That a date was given alone.
pub(super) fn noon(date: Date) -> String {
    format!("{date} is given without a time of day: its noon, 12:00, is taken")
}

/// What was taken for `local`, which the clocks of a zone show as `occurrence` says; `None` if they show it once.
pub(super) fn of(local: DateTime, taken: &Zoned, occurrence: Occurrence) -> Option<String> {
    let zone = taken.time_zone();
    let name = zone.iana_name().unwrap_or("its zone");
    match occurrence {
        Occurrence::Once => None,
        Occurrence::Skipped => {
            let change = last_change(zone, taken.timestamp()).map_or_else(String::new, |(from, to)| {
                let (from, to) = (clock(from, from.date() != to.date()), clock(to, from.date() != to.date()));
                format!(", where clocks went from {from} to {to}")
            });
            Some(format!("{local} does not exist in {name}{change}: {} is taken", instant(taken)))
        }
        Occurrence::Repeated => {
            let both = match zone.to_ambiguous_timestamp(local).offset() {
                jiff::tz::AmbiguousOffset::Fold { before, after } => Some((before, after)),
                _ => None,
            };
            let (at, other) = both.map_or_else(Default::default, |(before, after)| {
                let other = format!("; {local}{} is the other", offset(after));
                (format!(", at {} and at {}", offset(before), offset(after)), other)
            });
            Some(format!("{local} exists twice in {name}{at}: the first is taken, {}{other}", instant(taken)))
        }
    }
}

/// What clocks showed when they were set last before or at `instant`, and what they were set to.
fn last_change(zone: &TimeZone, instant: Timestamp) -> Option<(DateTime, DateTime)> {
    let change = zone.preceding(instant.checked_add(SignedDuration::from_nanos(1)).ok()?).next()?.timestamp();
    let before = change.checked_sub(SignedDuration::from_nanos(1)).ok()?;
    Some((zone.to_offset(before).to_datetime(change), zone.to_offset(change).to_datetime(change)))
}

/// The time of day, with its date where `dated`; seconds where there are any.
fn clock(local: DateTime, dated: bool) -> String {
    let form = if local.second() == 0 { "%H:%M" } else { "%H:%M:%S" };
    local.strftime(&if dated { format!("%Y-%m-%dT{form}") } else { form.to_string() }).to_string()
}

fn instant(time: &Zoned) -> String {
    format!("{}{}", time.datetime(), offset(time.offset()))
}

/// As ISO 8601 has it; with seconds, which offsets before the time of zones have.
pub(super) fn offset(offset: Offset) -> String {
    let (seconds, sign) = (offset.seconds().abs(), if offset.seconds() < 0 { '-' } else { '+' });
    let whole = format!("{sign}{:02}:{:02}", seconds / 3600, seconds / 60 % 60);
    if seconds % 60 == 0 { whole } else { format!("{whole}:{:02}", seconds % 60) }
}
