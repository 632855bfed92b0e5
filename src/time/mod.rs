//! Civil time, zones and time scales: from what a person writes to TT and UT1.
//!
//! # Conventions
//! - The calendar is Gregorian, also before 1582. Years 1000 to 3000.
//! - Civil time is UTC from 1972 on and UT1 before; a local time differs from it by the offset of its zone.
//! - Inside, physics asks for TT (positions of bodies) and UT1 (rotation of the Earth). TT - UT1 = delta T ([`delta_t_s`]).
//! - From 1972 to the end of the delta T table (January 2027) TT - UTC = 32.184 s + leap seconds, and UT1 = TT - delta T.
//!   After it UT1 - UTC is taken as 0: leap seconds to come, or whatever replaces them, are unknown.
//! - A second 60 reads as the second 59 before it, which is told.
//! - Zones have the whole history that the IANA database knows of them, also before 1970.
//! - Whatever had to be assumed about a text (a local time that clocks show never or twice, a date without time of day) goes with the time as [`Time::notice`].

mod civil_time;
mod delta_t;
mod julian_date;
mod leap_seconds;
mod notice;
mod parse;
mod scales;
mod table;
mod text;
mod zone_lookup;
mod zones;

pub use civil_time::CivilTime;
pub use delta_t::delta_t_s;
pub use julian_date::JulianDate;
pub use parse::{Occurrence, ZoneChoice};
pub use text::TimeFields;
pub use zone_lookup::zone_of_place;

use crate::error::{Error, Result, check_range};
use jiff::civil::DateTime;
use jiff::tz::TimeZone;
use jiff::{SignedDuration, Timestamp, Zoned};
use std::fmt;

/// First and last year of a [`Time`].
pub const YEARS: std::ops::RangeInclusive<i16> = 1000..=3000;

/// An instant, in the scales that physics needs and as the clock on the wall shows it.
#[derive(Clone, Debug)]
pub struct Time {
    civil: Zoned,
    utc: JulianDate,
    tt: JulianDate,
    ut1: JulianDate,
    notice: Option<Box<str>>,
}

/// Whether instant and zone are the same, however they were written.
impl PartialEq for Time {
    fn eq(&self, other: &Self) -> bool {
        self.civil == other.civil
            && self.civil.offset() == other.civil.offset()
            && self.zone_name() == other.zone_name()
            && (self.utc, self.tt, self.ut1) == (other.utc, other.tt, other.ut1)
    }
}

/// What calendar and clock on the wall show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Civil {
    /// Gregorian year.
    pub year: i16,
    /// Month, 1 to 12.
    pub month: i8,
    /// Day of the month, 1 to 31.
    pub day: i8,
    /// Hour, 0 to 23.
    pub hour: i8,
    /// Minute, 0 to 59.
    pub minute: i8,
    /// Second with its fraction, 0 to below 60.
    pub second: f64,
}

impl Civil {
    fn of(local: DateTime) -> Self {
        Self {
            year: local.year(),
            month: local.month(),
            day: local.day(),
            hour: local.hour(),
            minute: local.minute(),
            second: f64::from(local.second()) + f64::from(local.subsec_nanosecond()) * 1e-9,
        }
    }
}

impl Time {
    /// Reads a date with a time of day: `2005-06-21T13:00:00+02:00`, `2005-06-21T11:00:00Z`, `2005-06-21T13:00:00[Europe/Stockholm]`
    /// (ISO 8601, RFC 9557), or without offset and zone where `zone` says which one to use. Seconds and minutes may be left out (`T13`, `+02`), and
    /// a space may stand for the T. A date alone is its noon; `now` is the instant at which it is read, to the second.
    ///
    /// A local time that occurs twice (clocks set back) is the first of the two; one that does not occur (clocks set forward)
    /// is taken as far after the gap as it lies in it: 02:30 is 03:30. [`Time::notice`] tells so. An offset in the text picks the other one, and
    /// where text has both offset and zone they must agree; after Z the rest is UTC, and a zone in brackets only says which clock to show.
    ///
    /// # Errors
    /// [`Error::Input`] for `time` if the text cannot be read, has more than 100 bytes, names no known zone, or lies outside the years 1000 to 3000;
    /// for `zone` if [`ZoneChoice::Named`] is not in the IANA time zone database.
    pub fn parse(text: &str, zone: ZoneChoice) -> Result<Self> {
        parse::parse(text, zone).map(Self::from_reading)
    }

    fn from_reading(reading: parse::Reading) -> Self {
        Self { notice: reading.notice.map(String::into_boxed_str), ..Self::from_zoned(reading.zoned) }
    }

    /// What had to be assumed to read this time, in a sentence: that a local time does not exist or exists twice in its zone, and which instant is
    /// taken; that a date alone is its noon; that a second 60 is the one before. `None` for a time that says all, and for one computed from others.
    pub fn notice(&self) -> Option<&str> {
        self.notice.as_deref()
    }

    /// The instant with these Julian dates in TT and in UT1, civil time in UTC: for comparisons with tables that state both.
    ///
    /// # Errors
    /// [`Error::Input`] if a date lies outside the years 1000 to 3000, or if the two differ by more than a day.
    pub fn from_tt_ut1(jd_tt: f64, jd_ut1: f64) -> Result<Self> {
        let (low, high) = (2_086_302.5, 2_817_152.5);
        check_range("jd_tt", jd_tt, low, high, "days")?;
        check_range("jd_ut1", jd_ut1, jd_tt - 1.0, jd_tt + 1.0, "days")?;
        let (tt, ut1) = (JulianDate::from_days(jd_tt), JulianDate::from_days(jd_ut1));
        let utc = scales::utc_from(tt, ut1);
        let timestamp = Timestamp::from_nanosecond(utc.unix_nanoseconds())
            .map_err(|_| Error::input("jd_tt", jd_tt, "a Julian date of the years 1000 to 3000"))?;
        Ok(Self { civil: timestamp.to_zoned(TimeZone::UTC), utc, tt, ut1, notice: None })
    }

    /// The instant so many seconds after 1970-01-01T00:00:00 UTC by the civil clock, which counts no leap seconds; civil time in UTC.
    ///
    /// # Errors
    /// [`Error::Input`] if `seconds` is not finite or the instant lies outside the years 1000 to 3000.
    pub fn from_unix_seconds(seconds: f64) -> Result<Self> {
        let (low, high) = (-30_610_224_000.0, 32_535_215_999.0);
        check_range("times", seconds, low, high, "s since 1970, which is the years 1000 to 3000")?;
        let timestamp = Timestamp::UNIX_EPOCH
            .checked_add(SignedDuration::from_secs_f64(seconds))
            .map_err(|_| Error::input("times", seconds, "within the years 1000 to 3000"))?;
        Self::from_civil(timestamp.to_zoned(TimeZone::UTC), "a number of seconds")
    }

    fn from_civil(civil: Zoned, given: &str) -> Result<Self> {
        if !YEARS.contains(&civil.year()) {
            return Err(Error::input("time", format!("{given:?}"), "within the years 1000 to 3000"));
        }
        Ok(Self::from_zoned(civil))
    }

    fn from_zoned(civil: Zoned) -> Self {
        let utc = JulianDate::from_unix_nanoseconds(civil.timestamp().as_nanosecond());
        let (tt, ut1) = scales::tt_ut1_from(utc);
        Self { civil, utc, tt, ut1, notice: None }
    }

    /// The instant `seconds` later (earlier if negative) by the civil clock, which counts no leap seconds; same zone.
    ///
    /// # Errors
    /// [`Error::Input`] if `seconds` is not finite or the result lies outside the years 1000 to 3000.
    pub fn plus_seconds(&self, seconds: f64) -> Result<Self> {
        check_range("seconds", seconds, -1e11, 1e11, "s")?;
        let what = || format!("{self} {seconds:+} s");
        let civil = self
            .civil
            .checked_add(SignedDuration::from_secs_f64(seconds))
            .map_err(|_| Error::input("time", what(), "within the years 1000 to 3000"))?;
        Self::from_civil(civil, &what())
    }

    /// The instant `hours` later (earlier if negative); see [`Time::plus_seconds`].
    ///
    /// # Errors
    /// As [`Time::plus_seconds`].
    pub fn plus_hours(&self, hours: f64) -> Result<Self> {
        check_range("hours", hours, -1e7, 1e7, "h")?;
        self.plus_seconds(hours * 3600.0)
    }

    /// Civil seconds from this instant to `other`; negative if `other` is earlier.
    pub fn seconds_until(&self, other: &Self) -> f64 {
        (other.civil.timestamp().as_nanosecond() - self.civil.timestamp().as_nanosecond()) as f64 * 1e-9
    }

    /// Noon (12:00) by the wall clock on the same local date, same zone.
    ///
    /// # Errors
    /// [`Error::Input`] if the zone has no such time within the years 1000 to 3000.
    pub fn local_noon(&self) -> Result<Self> {
        let failed = || Error::input("time", format!("noon of {self}"), "within the years 1000 to 3000");
        let noon = self.civil.date().at(12, 0, 0, 0).to_zoned(self.civil.time_zone().clone()).map_err(|_| failed())?;
        Self::from_civil(noon, "noon")
    }

    /// The nearest whole second.
    pub fn rounded_to_second(&self) -> Self {
        let nanoseconds = self.civil.timestamp().subsec_nanosecond();
        let up = nanoseconds * 2 >= 1_000_000_000;
        let shift = if up { 1.0 } else { 0.0 } - f64::from(nanoseconds) * 1e-9;
        self.plus_seconds(shift).unwrap_or_else(|_| self.clone())
    }

    /// Julian date of the civil time scale: UTC from 1972 on, UT1 before.
    pub fn utc(&self) -> JulianDate {
        self.utc
    }

    /// Julian date in Terrestrial Time.
    pub fn tt(&self) -> JulianDate {
        self.tt
    }

    /// Julian date in UT1, the angle of the Earth's rotation.
    pub fn ut1(&self) -> JulianDate {
        self.ut1
    }

    /// What calendar and clock show in the zone of this time.
    pub fn civil(&self) -> Civil {
        Civil::of(self.civil.datetime())
    }

    /// Local civil time minus UTC [s], positive east of Greenwich.
    pub fn utc_offset_s(&self) -> i32 {
        self.civil.offset().seconds()
    }

    /// IANA name of the zone, such as "Europe/Stockholm"; `None` for a fixed offset.
    pub fn zone_name(&self) -> Option<&str> {
        self.civil.time_zone().iana_name()
    }

    /// Whole seconds since 1970-01-01T00:00:00 UTC by the civil clock.
    pub fn unix_seconds(&self) -> i64 {
        self.civil.timestamp().as_second()
    }
}

impl fmt::Display for Time {
    /// ISO 8601 with offset, such as `2005-06-21T13:00:00+02:00`; [`Time::parse`] reads it back to the same instant.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.civil.datetime(), notice::offset(self.civil.offset()))
    }
}

#[cfg(test)]
mod tests;
