//! Julian dates in two parts, because one 64-bit number holds a date of our time to 40 microseconds only.

use std::ops::Sub;

/// Days since -4712-01-01T12:00 (proleptic Julian calendar), as a midnight and a fraction of the day after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JulianDate {
    /// Julian date of the midnight at which the day begins; ends in .5 [days].
    pub day: f64,
    /// Fraction of the day since that midnight, 0 to below 1 [days].
    pub fraction: f64,
}

const UNIX_EPOCH: f64 = 2_440_587.5;
const NANOSECONDS_PER_DAY: i128 = 86_400_000_000_000;

impl JulianDate {
    /// The date `days`.
    pub fn from_days(days: f64) -> Self {
        let day = (days - 0.5).floor() + 0.5;
        Self { day, fraction: days - day }
    }

    pub(super) fn from_unix_nanoseconds(nanoseconds: i128) -> Self {
        let days = nanoseconds.div_euclid(NANOSECONDS_PER_DAY);
        let rest = nanoseconds.rem_euclid(NANOSECONDS_PER_DAY);
        Self { day: UNIX_EPOCH + days as f64, fraction: rest as f64 / NANOSECONDS_PER_DAY as f64 }
    }

    pub(super) fn unix_nanoseconds(self) -> i128 {
        let days = (self.day - UNIX_EPOCH) as i128;
        days * NANOSECONDS_PER_DAY + (self.fraction * NANOSECONDS_PER_DAY as f64).round() as i128
    }

    /// The date in one number [days].
    pub fn days(self) -> f64 {
        self.day + self.fraction
    }

    /// The date `seconds` later.
    pub fn plus_seconds(self, seconds: f64) -> Self {
        let moved = self.fraction + seconds / 86_400.0;
        let whole = moved.floor();
        Self { day: self.day + whole, fraction: moved - whole }
    }
}

impl Sub for JulianDate {
    type Output = f64;

    /// Days from `other` to `self`.
    fn sub(self, other: Self) -> f64 {
        (self.day - other.day) + (self.fraction - other.fraction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_date_is_a_midnight_and_a_fraction() {
        assert_eq!(JulianDate::from_days(2_451_545.0), JulianDate { day: 2_451_544.5, fraction: 0.5 });
        assert_eq!(JulianDate::from_unix_nanoseconds(0), JulianDate { day: 2_440_587.5, fraction: 0.0 });
        let before = JulianDate::from_unix_nanoseconds(-1_000_000_000);
        assert_eq!(before.day, 2_440_586.5);
        assert_eq!(before.unix_nanoseconds(), -1_000_000_000);
    }

    #[test]
    fn seconds_carry_over_midnight() {
        let date = JulianDate { day: 2_451_544.5, fraction: 0.9999 };
        let later = date.plus_seconds(86_400.0);
        assert!((later - date - 1.0).abs() < 1e-15);
        assert!((0.0..1.0).contains(&date.plus_seconds(60.0).fraction));
        assert!((date.plus_seconds(60.0) - date - 60.0 / 86_400.0).abs() < 1e-15);
    }
}
