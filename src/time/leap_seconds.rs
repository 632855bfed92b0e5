//! TAI - UTC since 1972: the leap seconds announced by the IERS (Bulletin C), from `data/leap_seconds.csv`.

use std::sync::LazyLock;

static TABLE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| super::table::read_table(include_str!("../../data/leap_seconds.csv")));

/// Julian date of 1972-01-01, from which UTC is a whole number of seconds behind TAI.
pub(super) const UTC_BEGINS: f64 = 2_441_317.5;

/// TAI - UTC [s] at the Julian date `jd_utc` of 1972 or later; the last known value holds for all later dates.
pub(super) fn tai_minus_utc_s(jd_utc: f64) -> f64 {
    let above = TABLE.partition_point(|row| row.0 <= jd_utc).max(1);
    TABLE[above - 1].1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_announced_seconds() {
        // checked against: IERS Bulletin C 1 and 52, and the table of UTC - TAI of the BIPM.
        assert_eq!(tai_minus_utc_s(UTC_BEGINS), 10.0);
        assert_eq!(tai_minus_utc_s(2_441_499.5 - 1e-6), 10.0);
        assert_eq!(tai_minus_utc_s(2_441_499.5), 11.0);
        assert_eq!(tai_minus_utc_s(2_451_544.5), 32.0);
        assert_eq!(tai_minus_utc_s(2_457_754.5), 37.0);
        assert_eq!(tai_minus_utc_s(2_500_000.5), 37.0);
        assert_eq!(TABLE.len(), 28);
    }
}
