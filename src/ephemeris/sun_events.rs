//! Sunrise, sunset, twilight and noon of a local civil date.
//!
//! Solar noon is the upper transit nearest to 12:00 of the wall clock on the date. Dawn and sunrise are the last before
//! it, within 12 hours, sunset and dusk the first after it, so that one day's events are in order; in high summer the later dusks
//! can fall on the next date. The Sun's centre is then at these airless altitudes [degrees]:
//!
//! | event | altitude | |
//! |---|---|---|
//! | sunrise, sunset | -0.8333 | 34' of refraction and 16' of semidiameter, the convention of almanacs and weather services |
//! | civil dawn, dusk | -6 | |
//! | nautical | -12 | |
//! | astronomical | -18 | |
//!
//! The convention holds for an unobstructed horizon at the height of the observer: the elevation of a town is rarely its height above
//! the land around it. From a peak or an aircraft the Sun rises earlier by the dip of the horizon: ask [`sun_crossings`] for the altitude
//! [`super::Refraction::horizon_true_altitude_deg`] less the Sun's semidiameter.

use super::place::Place;
use super::root::bracketed_root;
use super::target::Target;
use crate::error::{Result, check_range};
use crate::time::Time;

/// Airless altitude of the Sun's centre at sunrise and sunset [degrees].
const RISE_ALTITUDE_DEG: f64 = -50.0 / 60.0;

/// When the Sun crosses one altitude.
#[derive(Clone, Debug, PartialEq)]
pub struct SunCrossings {
    /// The Sun rises through the altitude; `None` if it does not before this noon.
    pub rising: Option<Time>,
    /// The Sun sinks through the altitude; `None` if it does not after this noon.
    pub setting: Option<Time>,
}

/// The Sun's day at a place, to the second, in the zone of the time that was asked for. `None` where the Sun stays above or below.
#[derive(Clone, Debug, PartialEq)]
pub struct SunEvents {
    /// The Sun's centre rises through -18 degrees.
    pub astronomical_dawn: Option<Time>,
    /// The Sun's centre rises through -12 degrees.
    pub nautical_dawn: Option<Time>,
    /// The Sun's centre rises through -6 degrees.
    pub civil_dawn: Option<Time>,
    /// The Sun's upper limb appears.
    pub sunrise: Option<Time>,
    /// The Sun is in the meridian (upper transit).
    pub solar_noon: Time,
    /// Airless altitude at solar noon [degrees]: without sunrise and sunset, above -0.8333 is polar day, below polar night.
    pub noon_altitude_deg: f64,
    /// The Sun's upper limb disappears.
    pub sunset: Option<Time>,
    /// The Sun's centre sinks through -6 degrees.
    pub civil_dusk: Option<Time>,
    /// The Sun's centre sinks through -12 degrees.
    pub nautical_dusk: Option<Time>,
    /// The Sun's centre sinks through -18 degrees.
    pub astronomical_dusk: Option<Time>,
}

/// The Sun's day at `place` on the local civil date of `time`.
///
/// # Errors
/// [`crate::Error::Input`] for `time` if the day touches the end of the years 1000 to 3000.
pub fn sun_events(place: &Place, time: &Time) -> Result<SunEvents> {
    let day = Day::around_noon(place, time)?;
    let at = |altitude_deg| day.crossings(altitude_deg);
    let (limb, civil, nautical, astronomical) = (at(RISE_ALTITUDE_DEG)?, at(-6.0)?, at(-12.0)?, at(-18.0)?);
    Ok(SunEvents {
        astronomical_dawn: astronomical.rising,
        nautical_dawn: nautical.rising,
        civil_dawn: civil.rising,
        sunrise: limb.rising,
        solar_noon: day.noon.rounded_to_second(),
        noon_altitude_deg: day.altitudes_deg[1],
        sunset: limb.setting,
        civil_dusk: civil.setting,
        nautical_dusk: nautical.setting,
        astronomical_dusk: astronomical.setting,
    })
}

/// When the Sun's centre crosses the airless altitude `altitude_deg` on the local civil date of `time`, to the second.
///
/// # Errors
/// [`crate::Error::Input`] for `altitude_deg` outside -90 to 90 degrees, for `time` as [`sun_events`].
pub fn sun_crossings(place: &Place, time: &Time, altitude_deg: f64) -> Result<SunCrossings> {
    check_range("altitude_deg", altitude_deg, -90.0, 90.0, "degrees")?;
    Day::around_noon(place, time)?.crossings(altitude_deg)
}

const HALF_DAY_S: f64 = 43_200.0;

/// Noon and the altitude of the Sun half a day before it, at it and half a day after it.
struct Day<'a> {
    place: &'a Place,
    noon: Time,
    altitudes_deg: [f64; 3],
}

impl<'a> Day<'a> {
    fn around_noon(place: &'a Place, time: &Time) -> Result<Self> {
        let mut noon = time.local_noon()?;
        // The hour angle grows by 15 degrees an hour but for 30 s a day: three steps are exact to a microsecond.
        for _ in 0..3 {
            noon = noon.plus_seconds(-hour_angle_deg(place, &noon) * 240.0)?;
        }
        let before = altitude_deg(place, &noon.plus_seconds(-HALF_DAY_S)?);
        let after = altitude_deg(place, &noon.plus_seconds(HALF_DAY_S)?);
        let altitudes_deg = [before, altitude_deg(place, &noon), after];
        Ok(Self { place, noon, altitudes_deg })
    }

    fn crossings(&self, altitude_deg: f64) -> Result<SunCrossings> {
        let [before, noon, after] = self.altitudes_deg;
        Ok(SunCrossings {
            rising: if before < altitude_deg && altitude_deg <= noon { self.crossing(altitude_deg, -HALF_DAY_S)? } else { None },
            setting: if after < altitude_deg && altitude_deg <= noon { self.crossing(altitude_deg, HALF_DAY_S)? } else { None },
        })
    }

    /// The crossing between noon and `limit_s` seconds from it. In between the altitude is taken as monotonic, which fails only
    /// within minutes of its extremes and within a degree of the poles.
    fn crossing(&self, altitude: f64, limit_s: f64) -> Result<Option<Time>> {
        let above = |seconds: f64| match self.noon.plus_seconds(seconds) {
            Ok(time) => altitude_deg(self.place, &time) - altitude,
            Err(_) => 0.0,
        };
        let seconds = bracketed_root(above, 0.0, limit_s, 0.05);
        Ok(Some(self.noon.plus_seconds(seconds)?.rounded_to_second()))
    }
}

fn altitude_deg(place: &Place, time: &Time) -> f64 {
    Target::Sun.hour_angle_and_altitude_deg(place, time).1
}

/// Local hour angle of the Sun, -180 to 180, positive after the transit [degrees].
fn hour_angle_deg(place: &Place, time: &Time) -> f64 {
    Target::Sun.hour_angle_and_altitude_deg(place, time).0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::almanac::count_equal;
    use crate::time::ZoneChoice;

    fn events(latitude: f64, longitude: f64, text: &str) -> SunEvents {
        let time = Time::parse(text, ZoneChoice::InText).unwrap();
        sun_events(&Place::new(latitude, longitude, 0.0).unwrap(), &time).unwrap()
    }

    #[test]
    fn almanac_times() {
        // place, local time, then Skyfield's times of the same day in UTC.
        let rows = include_str!("../../tests/reference/ephemeris_sun_events.csv");
        let mut compared = 0;
        for row in rows.lines().skip(1) {
            let fields: Vec<&str> = row.split(',').collect();
            let day = events(fields[0].parse().unwrap(), fields[1].parse().unwrap(), fields[2]);
            let noon = Some(day.solar_noon.clone());
            let ours = [
                &day.astronomical_dawn,
                &day.nautical_dawn,
                &day.civil_dawn,
                &day.sunrise,
                &noon,
                &day.sunset,
                &day.civil_dusk,
                &day.nautical_dusk,
                &day.astronomical_dusk,
            ];
            // checked against: Skyfield 1.55 with DE421, almanac.dark_twilight_day and almanac.meridian_transits.
            compared += count_equal(ours, &fields[3..], row);
        }
        assert!(compared > 20, "{compared}");
    }

    #[test]
    fn polar_day_and_polar_night() {
        let summer = events(78.22, 15.65, "2005-06-21T12:00:00+02:00");
        assert!(summer.sunrise.is_none() && summer.sunset.is_none() && summer.civil_dusk.is_none());
        assert!(summer.noon_altitude_deg > 30.0);
        let winter = events(78.22, 15.65, "2005-12-21T12:00:00+01:00");
        assert!(winter.sunrise.is_none() && winter.civil_dawn.is_none() && winter.nautical_dawn.is_some());
        assert!(winter.noon_altitude_deg < -10.0);
    }

    #[test]
    fn the_zone_of_the_question_is_the_zone_of_the_answer() {
        let day = events(-36.85, 174.76, "2018-01-31T23:30:00[Pacific/Auckland]");
        let sunrise = day.sunrise.unwrap();
        assert_eq!((sunrise.civil().day, sunrise.zone_name()), (31, Some("Pacific/Auckland")));
        assert!(day.sunset.unwrap().civil().day == 31);
    }

    #[test]
    fn the_pole_and_the_end_of_time_are_answered() {
        for latitude in [-90.0, 90.0] {
            events(latitude, 0.0, "2005-06-21T12:00:00Z");
        }
        let last = Time::parse("3000-12-31T23:00:00Z", ZoneChoice::InText).unwrap();
        assert!(sun_events(&Place::new(0.0, 0.0, 0.0).unwrap(), &last).is_err());
        assert!(sun_crossings(&Place::new(0.0, 0.0, 0.0).unwrap(), &last, f64::NAN).is_err());
    }
}
