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
    assert!(twice.notice().unwrap().contains("twice"));
    assert_eq!(twice.plus_hours(1.0).unwrap().notice(), None);
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
        "13:00",
        "T13",
        "2005-06-21 1 3:00",
        "2005-06-21 13:00 summer",
        "2005-06-21T",
        "now!",
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

#[test]
fn people_write_times_in_other_ways_too() {
    let stockholm = ZoneChoice::Named("Europe/Stockholm");
    for text in [
        "2005-06-21 13:00",
        "2005-06-21T13",
        "2005-06-21 13",
        "20050621T1300",
        "2005-06-21t13:00",
        "2005-06-21T13:00+02",
        "2005-06-21 13:00 +02:00",
        "2005-06-21T12:00+0100",
        "2005-06-21 07:00 \u{2212}04:00",
        "2005-06-21T11:00Z",
        "2005-06-21 11:00 Z",
        "2005-06-21T11Z[Europe/Stockholm]",
        "2005-06-21T13:00:00+02:00 [Europe/Stockholm]",
        "  2005-06-21  13:00 [europe/stockholm] ",
        "2005-06-21",
    ] {
        let time = Time::parse(text, stockholm).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(
            time.to_string(),
            "2005-06-21T13:00:00+02:00".replace("13:00", if text.len() == 10 { "12:00" } else { "13:00" })
        );
        assert_eq!(time.notice().is_some(), text.len() == 10, "{text}");
    }
    // After Z the zone in brackets only shows another clock.
    assert_eq!(at("2005-06-21T13:00Z[Europe/Stockholm]").to_string(), "2005-06-21T15:00:00+02:00");
    // An offset in brackets is a zone, too.
    assert_eq!(at("2005-06-21T13:00[+02:00]").to_string(), "2005-06-21T13:00:00+02:00");
}

#[test]
fn now_is_the_present_instant_in_the_zone_that_is_asked_for() {
    let seconds = || std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap().as_secs() as i64;
    let before = seconds();
    let now = Time::parse(" Now ", ZoneChoice::Named("Asia/Tokyo")).unwrap();
    assert!((before..=seconds()).contains(&now.unix_seconds()));
    assert_eq!((now.utc_offset_s(), now.zone_name(), now.civil().second.fract()), (9 * 3600, Some("Asia/Tokyo"), 0.0));
    assert_eq!(at("now").utc_offset_s(), 0);
}

#[test]
fn what_had_to_be_assumed_is_told() {
    for (text, zone, instant, told) in [
        (
            "2005-03-27T02:30",
            "Europe/Stockholm",
            "2005-03-27T03:30:00+02:00",
            "2005-03-27T02:30:00 does not exist in Europe/Stockholm, where clocks went from 02:00 to 03:00: \
             2005-03-27T03:30:00+02:00 is taken",
        ),
        (
            "2005-10-30T02:30",
            "Europe/Stockholm",
            "2005-10-30T02:30:00+02:00",
            "2005-10-30T02:30:00 exists twice in Europe/Stockholm, at +02:00 and at +01:00: the first is taken, \
             2005-10-30T02:30:00+02:00; 2005-10-30T02:30:00+01:00 is the other",
        ),
        // A day that Samoa left out, a quarter of an hour of Nepal, the end of local mean time, a day that Manila left out.
        (
            "2011-12-30T12:00",
            "Pacific/Apia",
            "2011-12-31T12:00:00+14:00",
            "clocks went from 2011-12-30T00:00 to 2011-12-31T00:00",
        ),
        ("1986-01-01T00:10", "Asia/Kathmandu", "1986-01-01T00:25:00+05:45", "clocks went from 00:00 to 00:15"),
        ("1878-12-31T23:55", "Europe/Stockholm", "1878-12-31T23:55:00+01:12:12", "at +01:12:12 and at +01:00:14"),
        ("1844-12-31T12:00", "Asia/Manila", "1845-01-01T12:00:00+08:03:52", "does not exist in Asia/Manila"),
        ("2005-06-21", "Europe/Stockholm", "2005-06-21T12:00:00+02:00", "2005-06-21 is given without a time of day: its noon"),
        (
            "2011-12-30",
            "Pacific/Apia",
            "2011-12-31T12:00:00+14:00",
            "its noon, 12:00, is taken; 2011-12-30T12:00:00 does not exist",
        ),
        ("2016-12-31T23:59:60Z", "UTC", "2016-12-31T23:59:59+00:00", "second 60"),
        ("20161231T235960Z", "UTC", "2016-12-31T23:59:59+00:00", "second 60"),
    ] {
        let time = Time::parse(text, ZoneChoice::Named(zone)).unwrap();
        let notice = time.notice().unwrap_or_else(|| panic!("{text}: nothing is told"));
        assert_eq!(time.to_string(), instant, "{text}: {notice}");
        assert!(notice.contains(told) && !notice.contains('\n'), "{text}: {notice}");
    }
    for text in
        ["2005-03-27T03:30", "2005-10-30T02:30+01:00[Europe/Stockholm]", "2005-10-30T02:30+01:00", "2016-12-31T23:59:59Z", "now"]
    {
        assert_eq!(Time::parse(text, ZoneChoice::Named("Europe/Stockholm")).unwrap().notice(), None, "{text}");
    }
}

#[test]
fn zones_have_their_history_before_1970() {
    // checked against: Python's zoneinfo with Debian's tzdata 2026f, which is built with the file backzone.
    for (zone, text, offset_s) in [
        ("Europe/Stockholm", "1943-07-01T12:00", 3600),
        ("Europe/Oslo", "1964-07-01T12:00", 7200),
        ("Europe/Oslo", "1943-07-01T12:00", 7200),
        ("Europe/Copenhagen", "1947-07-01T12:00", 7200),
        ("Europe/Amsterdam", "1930-07-01T12:00", 4772),
        ("Atlantic/Reykjavik", "1950-07-01T12:00", 0),
        ("Africa/Accra", "1920-10-01T12:00", 1200),
        ("America/Nassau", "1950-01-01T12:00", -18_000),
        ("Asia/Kuala_Lumpur", "1935-01-01T12:00", 26_400),
        ("Europe/Luxembourg", "1910-01-01T12:00", 3600),
        ("Europe/Berlin", "1943-07-01T12:00", 7200),
    ] {
        let time = Time::parse(text, ZoneChoice::Named(zone)).unwrap();
        assert_eq!((time.utc_offset_s(), time.zone_name()), (offset_s, Some(zone)), "{zone} {text}");
        // In brackets as well.
        assert_eq!(at(&format!("{text}[{zone}]")), time);
    }
}

#[test]
fn a_text_is_taken_apart_without_knowing_the_place() {
    let fields = |text: &str| TimeFields::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    let civil = |hour, minute| Civil { year: 2005, month: 6, day: 21, hour, minute, second: 0.0 };
    for (text, clock, offset_s, zone) in [
        ("2005-06-21 13:00", (13, 0), None, None),
        ("2005-06-21T13", (13, 0), None, None),
        ("2005-06-21T13:00+02", (13, 0), Some(7200), None),
        ("2005-06-21T13:00-03:30", (13, 0), Some(-12_600), None),
        ("2005-06-21T13:00Z", (13, 0), Some(0), None),
        ("2005-06-21T13:00[Europe/Stockholm]", (13, 0), Some(7200), Some("Europe/Stockholm")),
        ("2005-06-21T13:00Z[Europe/Stockholm]", (15, 0), Some(7200), Some("Europe/Stockholm")),
    ] {
        let found = fields(text);
        assert_eq!((found.civil, found.utc_offset_s, found.zone.as_deref()), (civil(clock.0, clock.1), offset_s, zone), "{text}");
        assert_eq!(found.notice, None);
    }
    assert_eq!(fields("2005-06-21").civil, civil(12, 0));
    assert!(fields("2005-06-21").notice.unwrap().contains("noon"));
    assert!(fields("2005-03-27T02:30[Europe/Stockholm]").notice.unwrap().contains("does not exist"));
    assert_eq!(fields("now").utc_offset_s, Some(0));
    for text in ["0999-06-21T13:00", "2005-06-21T13:00[Mars/Olympus]", "13:00", ""] {
        assert!(TimeFields::parse(text).unwrap_err().to_string().starts_with("time = "), "{text}");
    }
}

#[test]
fn long_texts_are_refused_at_once_and_not_repeated() {
    for text in ["9".repeat(1_000_000), "2005-06-21T13:00[".to_string() + &"a/".repeat(500_000), " \u{301}".repeat(300_000)] {
        let message = message(&text, ZoneChoice::InText);
        assert!(message.ends_with("must be a text of at most 100 bytes") && message.len() < 700, "{message}");
    }
}
