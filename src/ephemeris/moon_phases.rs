//! Dates of the Moon's phases: when the apparent geocentric longitudes of Moon and Sun on the ecliptic of date differ by 0, 90, 180 and
//! 270 degrees (the definition of almanacs, the same for all places).

use super::celestial_frames::{icrs_to_ecliptic_of_date, longitude_latitude_deg};
use super::observer::Observer;
use super::target::Target;
use crate::error::Result;
use crate::time::Time;

/// One of the four phases that have a date.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MoonPhase {
    /// In conjunction with the Sun.
    New,
    /// Waxing half.
    FirstQuarter,
    /// In opposition.
    Full,
    /// Waning half.
    LastQuarter,
}

impl MoonPhase {
    /// All four in the order in which they follow each other.
    pub const ALL: [Self; 4] = [Self::New, Self::FirstQuarter, Self::Full, Self::LastQuarter];

    /// English name in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::New => "new",
            Self::FirstQuarter => "first quarter",
            Self::Full => "full",
            Self::LastQuarter => "last quarter",
        }
    }

    const fn angle_deg(self) -> f64 {
        match self {
            Self::New => 0.0,
            Self::FirstQuarter => 90.0,
            Self::Full => 180.0,
            Self::LastQuarter => 270.0,
        }
    }
}

/// Mean time between new Moons [days].
const SYNODIC_MONTH_DAYS: f64 = 29.530_589;

/// When `phase` comes next after `time`, to the second, in the zone of `time`.
///
/// # Errors
/// [`crate::Error::Input`] for `time` if the date lies beyond the years 1000 to 3000.
pub fn next_moon_phase(time: &Time, phase: MoonPhase) -> Result<Time> {
    let days = (phase.angle_deg() - longitude_difference_deg(time)).rem_euclid(360.0) / 360.0 * SYNODIC_MONTH_DAYS;
    let found = refine(time.plus_hours(24.0 * days)?, phase)?;
    // A phase a moment ago can be met again from a guess that was a moment early.
    let next =
        if time.seconds_until(&found) > 0.0 { found } else { refine(found.plus_hours(24.0 * SYNODIC_MONTH_DAYS)?, phase)? };
    Ok(next.rounded_to_second())
}

/// The next four phases after `time` in the order of their dates.
///
/// # Errors
/// As [`next_moon_phase`].
pub fn next_moon_phases(time: &Time) -> Result<Vec<(MoonPhase, Time)>> {
    let mut phases = MoonPhase::ALL
        .into_iter()
        .map(|phase| next_moon_phase(time, phase).map(|date| (phase, date)))
        .collect::<Result<Vec<_>>>()?;
    phases.sort_by(|a, b| time.seconds_until(&a.1).total_cmp(&time.seconds_until(&b.1)));
    Ok(phases)
}

/// The phase nearest to `guess`, which is within days of it. The Moon's speed varies by 15 %, so every step shrinks the error sixfold.
fn refine(guess: Time, phase: MoonPhase) -> Result<Time> {
    let mut time = guess;
    for _ in 0..20 {
        let gap = (phase.angle_deg() - longitude_difference_deg(&time) + 180.0).rem_euclid(360.0) - 180.0;
        let seconds = gap / 360.0 * SYNODIC_MONTH_DAYS * 86_400.0;
        time = time.plus_seconds(seconds)?;
        if seconds.abs() < 0.05 {
            break;
        }
    }
    Ok(time)
}

/// Apparent longitude of the Moon less that of the Sun, 0 to below 360 [degrees].
fn longitude_difference_deg(time: &Time) -> f64 {
    let observer = Observer::geocentric(time);
    let to_ecliptic = icrs_to_ecliptic_of_date(time.tt()) * observer.to_horizon().transpose();
    let longitude = |target: Target| longitude_latitude_deg(to_ecliptic * target.observe(&observer).direction).0;
    (longitude(Target::Moon) - longitude(Target::Sun)).rem_euclid(360.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::ZoneChoice;

    fn at(text: &str) -> Time {
        Time::parse(text, ZoneChoice::InText).unwrap()
    }

    #[test]
    fn almanac_dates() {
        // checked against: Skyfield 1.55 with DE421, almanac.moon_phases: a time, then the next new, first quarter, full, last quarter.
        let rows = include_str!("../../tests/reference/ephemeris_moon_phases.csv");
        for row in rows.lines().skip(1) {
            let fields: Vec<&str> = row.split(',').collect();
            for (phase, expected) in MoonPhase::ALL.into_iter().zip(&fields[1..]) {
                let ours = next_moon_phase(&at(fields[0]), phase).unwrap();
                let gap = ours.seconds_until(&at(expected));
                assert!(gap.abs() <= 1.5, "{row}: {phase:?} {ours}");
            }
        }
    }

    #[test]
    fn a_phase_just_past_comes_again_in_a_month() {
        let new = next_moon_phase(&at("1999-08-10T00:00:00Z"), MoonPhase::New).unwrap();
        let again = next_moon_phase(&new.plus_seconds(1.0).unwrap(), MoonPhase::New).unwrap();
        assert!((29.2..29.9).contains(&(new.seconds_until(&again) / 86_400.0)), "{again}");
        let same = next_moon_phase(&new.plus_seconds(-2.0).unwrap(), MoonPhase::New).unwrap();
        assert_eq!(same, new);
    }

    #[test]
    fn four_phases_in_the_order_of_their_dates() {
        let phases = next_moon_phases(&at("2018-01-31T12:00:00+13:00")).unwrap();
        assert_eq!(phases.iter().map(|(phase, _)| *phase).collect::<Vec<_>>(), {
            use MoonPhase::{FirstQuarter, Full, LastQuarter, New};
            [Full, LastQuarter, New, FirstQuarter]
        });
        assert_eq!(phases[0].1.utc_offset_s(), 46_800);
        assert!(next_moon_phases(&at("3000-12-31T00:00:00Z")).is_err());
    }
}
