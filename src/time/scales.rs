//! From the civil scale to TT and UT1 and back.
//!
//! | civil date | civil scale | TT | UT1 |
//! |---|---|---|---|
//! | before 1972 | UT1 | UT1 + delta T | as given |
//! | 1972 to the end of the delta T table | UTC | UTC + leap seconds + 32.184 s | TT - delta T |
//! | after it | UTC = UT1 | UT1 + delta T | as given |

use super::delta_t::{delta_t_s, table_end};
use super::julian_date::JulianDate;
use super::leap_seconds::{UTC_BEGINS, tai_minus_utc_s};

/// TT - TAI [s] (IAU 1991, by definition).
const TT_MINUS_TAI_S: f64 = 32.184;

fn has_leap_seconds(jd: f64) -> bool {
    (UTC_BEGINS..=table_end()).contains(&jd)
}

/// TT and UT1 of the civil date `utc`.
pub(super) fn tt_ut1_from(utc: JulianDate) -> (JulianDate, JulianDate) {
    let delta_t = delta_t_s(utc.days());
    if has_leap_seconds(utc.days()) {
        let tt = utc.plus_seconds(tai_minus_utc_s(utc.days()) + TT_MINUS_TAI_S);
        return (tt, tt.plus_seconds(-delta_t));
    }
    (utc.plus_seconds(delta_t), utc)
}

/// Civil date of an instant that is given in both scales.
pub(super) fn utc_from(tt: JulianDate, ut1: JulianDate) -> JulianDate {
    if !has_leap_seconds(ut1.days()) {
        return ut1;
    }
    // UT1 is within a second of UTC, so it tells the leap seconds but for the second in which one is introduced.
    tt.plus_seconds(-tai_minus_utc_s(ut1.days()) - TT_MINUS_TAI_S)
}
