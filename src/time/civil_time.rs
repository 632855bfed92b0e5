//! A local time with all that a person wants to be told of it: offset, name of the offset, daylight saving, and whether clocks show it once.

use super::parse::{self, Occurrence};
use super::{Time, ZoneChoice};
use crate::error::Result;

/// A time and how the clocks of its zone go then.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct CivilTime {
    /// The instant in its zone: [`Time::utc_offset_s`] and [`Time::zone_name`] say which, [`Time::notice`] what had to be assumed.
    pub time: Time,
    /// What the offset is called, such as "CEST", or "+03" where it has no name.
    pub abbreviation: String,
    /// Whether clocks are set forward for the summer.
    pub daylight_saving: bool,
    /// How often clocks show the local time that was given.
    pub occurrence: Occurrence,
}

impl CivilTime {
    /// Reads a time as [`Time::parse`] does.
    ///
    /// # Errors
    /// As [`Time::parse`].
    pub fn parse(text: &str, zone: ZoneChoice) -> Result<Self> {
        let reading = parse::parse(text, zone)?;
        let info = reading.zoned.time_zone().to_offset_info(reading.zoned.timestamp());
        let (abbreviation, daylight_saving) = (info.abbreviation().to_string(), info.dst().is_dst());
        let occurrence = reading.occurrence;
        Ok(Self { time: Time::from_reading(reading), abbreviation, daylight_saving, occurrence })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn civil(text: &str, zone: &str) -> CivilTime {
        CivilTime::parse(text, ZoneChoice::Named(zone)).unwrap()
    }

    #[test]
    fn summer_and_winter_are_told_apart() {
        for (text, zone, abbreviation, offset_h, daylight_saving) in [
            ("2005-06-21T13:00", "Europe/Stockholm", "CEST", 2.0, true),
            ("2005-12-21T13:00", "Europe/Stockholm", "CET", 1.0, false),
            ("2005-12-21T13:00", "Australia/Sydney", "AEDT", 11.0, true),
            ("2005-06-21T13:00", "Australia/Sydney", "AEST", 10.0, false),
            ("2005-06-21T13:00", "Europe/Dublin", "IST", 1.0, true),
            ("2005-12-21T13:00", "Europe/Dublin", "GMT", 0.0, false),
            ("2005-06-21T13:00", "Asia/Kathmandu", "+0545", 5.75, false),
            ("2005-06-21T13:00", "UTC", "UTC", 0.0, false),
        ] {
            let found = civil(text, zone);
            assert_eq!(
                (found.abbreviation.as_str(), f64::from(found.time.utc_offset_s()) / 3600.0, found.daylight_saving),
                (abbreviation, offset_h, daylight_saving),
                "{text} {zone}"
            );
            assert_eq!(found.occurrence, Occurrence::Once);
            assert_eq!(found.time, Time::parse(text, ZoneChoice::Named(zone)).unwrap());
        }
    }

    #[test]
    fn times_that_clocks_show_twice_or_never_are_told() {
        // Clocks went from 02:00 to 03:00 on 2005-03-27 and from 03:00 to 02:00 on 2005-10-30.
        for (text, occurrence, time) in [
            ("2005-03-27T01:59:59", Occurrence::Once, "2005-03-27T01:59:59+01:00"),
            ("2005-03-27T02:30", Occurrence::Skipped, "2005-03-27T03:30:00+02:00"),
            ("2005-03-27T03:00", Occurrence::Once, "2005-03-27T03:00:00+02:00"),
            ("2005-10-30T02:30", Occurrence::Repeated, "2005-10-30T02:30:00+02:00"),
            ("2005-10-30T02:30[Europe/Stockholm]", Occurrence::Repeated, "2005-10-30T02:30:00+02:00"),
            ("2005-10-30T02:30:00+01:00[Europe/Stockholm]", Occurrence::Once, "2005-10-30T02:30:00+01:00"),
            ("2005-10-30T02:30+01:00", Occurrence::Once, "2005-10-30T02:30:00+01:00"),
            ("2005-10-30T03:00", Occurrence::Once, "2005-10-30T03:00:00+01:00"),
        ] {
            let found = civil(text, "Europe/Stockholm");
            assert_eq!((found.occurrence, found.time.to_string().as_str()), (occurrence, time), "{text}");
        }
    }

    #[cfg(feature = "zone-lookup")]
    #[test]
    fn the_zone_of_a_place_is_found_from_coordinates() {
        use super::super::zone_of_place;
        assert_eq!(zone_of_place(55.71, 13.19).unwrap(), "Europe/Stockholm");
        assert_eq!(zone_of_place(27.7, 85.3).unwrap(), "Asia/Kathmandu");
        assert_eq!(zone_of_place(0.0, -30.0).unwrap(), "Etc/GMT+2");
        assert!(zone_of_place(95.0, 0.0).unwrap_err().to_string().starts_with("latitude = 95"));
        let lund = ZoneChoice::OfPlace { latitude_deg: 55.71, longitude_deg: 13.19 };
        assert_eq!(CivilTime::parse("2005-06-21T13:00", lund).unwrap().abbreviation, "CEST");
    }
}
