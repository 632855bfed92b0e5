//! Tests of reading, showing and converting time.

use super::*;

fn at(text: &str) -> Time {
    Time::parse(text, ZoneChoice::InText).unwrap()
}

fn message(text: &str, zone: ZoneChoice) -> String {
    let message = Time::parse(text, zone).unwrap_err().to_string();
    assert!(!message.contains('\n'));
    message
}

#[test]
fn one_instant_written_in_four_ways() {
    let expected = at("2005-06-21T11:00:00Z");
    assert_eq!(expected.utc(), JulianDate { day: 2_453_542.5, fraction: 11.0 / 24.0 });
    let others = [
        at("2005-06-21T13:00:00+02:00"),
        at("2005-06-21T13:00:00[Europe/Stockholm]"),
        at("2005-06-21 13:00:00+02:00[Europe/Stockholm]"),
        Time::parse("2005-06-21T13:00", ZoneChoice::Named("Europe/Stockholm")).unwrap(),
    ];
    for other in &others {
        assert_eq!(other.utc(), expected.utc());
        assert_eq!(other.utc_offset_s(), 7200);
        assert_eq!(other.to_string(), "2005-06-21T13:00:00+02:00");
        assert_eq!(at(&other.to_string()).utc(), other.utc());
    }
    assert_eq!(others[0].zone_name(), None);
    assert_eq!(others[1].zone_name(), Some("Europe/Stockholm"));
    assert_eq!(others[1].civil(), Civil { year: 2005, month: 6, day: 21, hour: 13, minute: 0, second: 0.0 });
}

#[cfg(feature = "zone-lookup")]
#[test]
fn the_zone_is_found_from_the_place() {
    let find = |latitude_deg, longitude_deg| {
        let zone = ZoneChoice::OfPlace { latitude_deg, longitude_deg };
        Time::parse("2005-06-21T13:00:00", zone).unwrap().zone_name().map(str::to_owned)
    };
    assert_eq!(find(55.7047, 13.191).as_deref(), Some("Europe/Stockholm"));
    assert_eq!(find(19.8207, -155.4681).as_deref(), Some("Pacific/Honolulu"));
    assert_eq!(find(-36.85, 174.76).as_deref(), Some("Pacific/Auckland"));
    for corner in [(90.0, 0.0), (-90.0, 0.0), (0.0, 180.0), (0.0, -180.0), (90.0, 180.0), (-45.0, -120.0)] {
        assert!(find(corner.0, corner.1).is_some(), "{corner:?}");
    }
}

#[test]
fn a_time_that_occurs_twice_is_the_first_and_one_that_does_not_occur_moves_on() {
    let stockholm = ZoneChoice::Named("Europe/Stockholm");
    let twice = Time::parse("2005-10-30T02:30:00", stockholm).unwrap();
    assert_eq!(twice.to_string(), "2005-10-30T02:30:00+02:00");
    assert_eq!(at("2005-10-30T02:30:00+01:00[Europe/Stockholm]").utc_offset_s(), 3600);
    let never = Time::parse("2005-03-27T02:30:00", stockholm).unwrap();
    assert_eq!(never.to_string(), "2005-03-27T03:30:00+02:00");
}

#[test]
fn bad_input_names_the_parameter_in_one_line() {
    for text in [
        "yesterday",
        "",
        " ",
        "2005-06-21",
        "13:00",
        "2005-13-01T00:00:00Z",
        "2005-06-31T00:00Z",
        "2005-06-21T25:00Z",
        "1119352200",
    ] {
        let message = message(text, ZoneChoice::Named("Europe/Stockholm"));
        assert!(message.starts_with(&format!("time = {text:?}: must be a date and time such as")), "{message}");
    }
    assert!(message("2005-06-21T13:00:00", ZoneChoice::InText).contains("with an offset"));
    assert!(message("2005-06-21T13:00:00[Europe/Lund]", ZoneChoice::InText).contains("IANA"));
    assert!(message("2005-06-21T13:00:00+05:00[Europe/Stockholm]", ZoneChoice::InText).contains("offset that its zone has"));
    for zone in ["Mars/Olympus", "", "Europe/Stockholm\0"] {
        assert!(message("2005-06-21T13:00:00", ZoneChoice::Named(zone)).starts_with("zone = "));
    }
    assert!(message("0999-12-31T00:00:00Z", ZoneChoice::InText).contains("within the years 1000 to 3000"));
    assert!(message("3001-01-01T00:00:00Z", ZoneChoice::InText).contains("within the years 1000 to 3000"));
}

#[test]
fn tt_and_ut1_by_era() {
    let check = |text: &str, jd_tt: f64, jd_ut1: f64| {
        let time = at(text);
        assert!((time.tt().days() - jd_tt).abs() * 86_400.0 < 0.01, "{text}: TT {}", time.tt().days());
        assert!((time.ut1().days() - jd_ut1).abs() * 86_400.0 < 0.01, "{text}: UT1 {}", time.ut1().days());
    };
    // checked against: Skyfield 1.55 (before 1972 the text is UT1, later UTC).
    check("1900-01-01T18:00:00Z", 2_415_021.249_977_164, 2_415_021.25);
    check("1954-03-20T23:45:00Z", 2_434_822.489_933_363, 2_434_822.489_583_333);
    check("1999-08-11T10:45:00Z", 2_451_401.948_659_537, 2_451_401.947_922_508);
    check("2005-06-21T20:30:00Z", 2_453_543.354_909_537, 2_453_543.354_159_542);
    check("2018-01-31T13:30:00Z", 2_458_150.063_300_741, 2_458_150.062_502_28);
    check("2026-11-22T01:00:00Z", 2_461_366.542_467_407, 2_461_366.541_667_657);
}

#[test]
fn beyond_the_table_utc_is_ut1() {
    let time = at("2050-01-01T00:00:00Z");
    assert_eq!(time.utc(), time.ut1());
    assert!(((time.tt() - time.ut1()) * 86_400.0 - delta_t_s(time.ut1().days())).abs() < 1e-6);
}

#[test]
fn tt_and_ut1_give_the_civil_time_back() {
    for text in
        ["1001-02-03T04:05:06Z", "1950-01-01T00:00:00Z", "1972-07-01T00:00:01Z", "2016-12-31T23:59:58Z", "2040-06-01T12:00:00Z"]
    {
        let time = at(text);
        let back = Time::from_tt_ut1(time.tt().days(), time.ut1().days()).unwrap();
        assert!(back.seconds_until(&time).abs() < 1e-4, "{text}: {back}");
        assert!((back.tt() - time.tt()).abs() < 1e-9 && (back.ut1() - time.ut1()).abs() < 1e-9);
    }
    for (tt, ut1) in [(f64::NAN, 2_451_545.0), (2_451_545.0, f64::INFINITY), (0.0, 0.0), (2_451_545.0, 2_451_547.0)] {
        assert!(Time::from_tt_ut1(tt, ut1).is_err());
    }
}

#[test]
fn time_moves_by_the_clock_and_keeps_its_zone() {
    let evening = at("2005-10-29T22:00:00[Europe/Stockholm]");
    let morning = evening.plus_hours(12.0).unwrap();
    assert_eq!(morning.to_string(), "2005-10-30T09:00:00+01:00");
    assert_eq!(evening.seconds_until(&morning), 43_200.0);
    assert_eq!(morning.local_noon().unwrap().to_string(), "2005-10-30T12:00:00+01:00");
    assert_eq!(evening.plus_seconds(0.6).unwrap().rounded_to_second().to_string(), "2005-10-29T22:00:01+02:00");
    assert_eq!(evening.plus_seconds(0.4).unwrap().rounded_to_second(), evening);
    for seconds in [f64::NAN, f64::INFINITY, 1e300, 1e11, -1e11] {
        assert!(evening.plus_seconds(seconds).is_err(), "{seconds}");
    }
}

#[test]
fn local_mean_time_before_zones() {
    let stockholm = at("1870-01-01T12:00:00[Europe/Stockholm]");
    assert!(stockholm.utc_offset_s() > 3200 && stockholm.utc_offset_s() < 4400);
    assert_eq!(at(&stockholm.to_string()).utc(), stockholm.utc());
}
