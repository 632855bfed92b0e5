//! delta T = TT - UT1: how far the rotation of the Earth lags behind uniform time.
//!
//! From the year 1000 to January 2027 from `data/delta_t.csv` (eclipse timings, occultations, then IERS: data/README.md),
//! linear between its rows, which are 5 years apart before 1900, 1 year before 1972 and 1 month from 1973 on.
//!
//! Beyond the table: a cubic that leaves it with its value and the slope of its last three years, and joins in 2800, with the same
//! slope, the long-term parabola delta T = -320 s + 32.5 s ((year - 1825) / 100)^2 of Stephenson, Morrison & Hohenkerk 2016
//! (Proc. R. Soc. A 472: 20160404). Nobody knows the future: for 2050 this gives 71 s, Espenak & Meeus 2006 (NASA/TP-2006-214141)
//! 93 s; for 2100 96 s and 203 s. The difference of 22 s in 2050 is 0.9 arcseconds of the Sun and 12 of the Moon.

use std::sync::LazyLock;

static TABLE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| super::table::read_table(include_str!("../../data/delta_t.csv")));

/// Julian date at which the table ends.
pub(super) fn table_end() -> f64 {
    TABLE[TABLE.len() - 1].0
}

/// TT - UT1 [s] at the Julian date `jd` (any time scale: it changes by at most a millisecond in delta T itself).
pub fn delta_t_s(jd: f64) -> f64 {
    if jd > table_end() {
        return beyond_table(jd);
    }
    let above = TABLE.partition_point(|row| row.0 < jd).clamp(1, TABLE.len() - 1);
    let ((jd0, value0), (jd1, value1)) = (TABLE[above - 1], TABLE[above]);
    value0 + (value1 - value0) * (jd - jd0) / (jd1 - jd0)
}

fn beyond_table(jd: f64) -> f64 {
    const JOIN_YEAR: f64 = 2800.0;
    let year = |jd: f64| 2000.0 + (jd - 2_451_544.5) / 365.25;
    let parabola = |year: f64| -320.0 + 32.5 * ((year - 1825.0) / 100.0).powi(2);
    let parabola_slope = |year: f64| 65.0 * (year - 1825.0) / 1e4;
    let (now, start) = (year(jd), year(table_end()));
    if now >= JOIN_YEAR {
        return parabola(now);
    }
    let (value, earlier) = (TABLE[TABLE.len() - 1].1, delta_t_s(table_end() - 3.0 * 365.25));
    let width = JOIN_YEAR - start;
    let (slope0, slope1) = ((value - earlier) / 3.0 * width, parabola_slope(JOIN_YEAR) * width);
    let x = (now - start) / width;
    let y = 1.0 - x;
    // Cubic Hermite interpolation.
    value * y * y * (1.0 + 2.0 * x) + parabola(JOIN_YEAR) * x * x * (1.0 + 2.0 * y) + slope0 * x * y * y - slope1 * x * x * y
}

#[cfg(test)]
mod tests {
    use super::*;

    fn jd(year: f64) -> f64 {
        2_451_544.5 + (year - 2000.0) * 365.25
    }

    #[test]
    fn published_values() {
        // checked against: IERS C04, UT1-UTC at 2000-01-01 +0.35550 s and at 1972-01-01 -0.0454859 s.
        assert!((delta_t_s(2_451_544.5) - (32.184 + 32.0 - 0.355_50)).abs() < 0.005);
        assert!((delta_t_s(2_441_317.5) - (32.184 + 10.0 + 0.045_485_9)).abs() < 0.005);
        // checked against: Espenak & Meeus 2006, table of observed values: 1950 29.07 s, 1900 -2.79 s, 1800 13.7 s, 1700 9 s.
        // Morrison et al. 2021, which the table holds, revised them by this much.
        assert!((delta_t_s(jd(1950.0)) - 29.07).abs() < 0.3);
        assert!((delta_t_s(jd(1900.0)) + 2.79).abs() < 1.0);
        assert!((delta_t_s(jd(1800.0)) - 13.7).abs() < 6.0);
        assert!((delta_t_s(jd(1700.0)) - 9.0).abs() < 7.0);
    }

    #[test]
    fn the_formula_continues_the_table() {
        let end = table_end();
        assert!((delta_t_s(end + 0.01) - delta_t_s(end)).abs() < 1e-3);
        let join = jd(2800.0);
        assert!((delta_t_s(join + 0.1) - delta_t_s(join - 0.1)).abs() < 1e-2);
        // checked against: Skyfield 1.55, which joins the same parabola: 71.443 s in 2050, 95.927 s in 2100, 4166.87 s in 3000.
        for (year, expected, tolerance) in [(2050.0, 71.443, 1.5), (2100.0, 95.927, 3.0), (3000.0, 4166.87, 0.3)] {
            assert!((delta_t_s(jd(year)) - expected).abs() < tolerance, "{year}: {}", delta_t_s(jd(year)));
        }
    }

    #[test]
    fn the_table_is_ascending_and_smooth() {
        assert!(TABLE.len() > 800);
        for pair in TABLE.windows(2) {
            let days = pair[1].0 - pair[0].0;
            assert!(days > 0.0);
            // The length of the day has never differed from 86400 s by more than 15 ms since the year 1000.
            assert!(((pair[1].1 - pair[0].1) / days).abs() < 0.015, "{pair:?}");
        }
    }
}
