use super::*;
use proptest::prelude::*;

fn parsed(text: &str) -> (f64, f64) {
    let found = Coordinates::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    (found.latitude_deg, found.longitude_deg)
}

fn message(text: &str) -> String {
    match Coordinates::parse(text) {
        Ok(found) => panic!("{text}: read as {found}"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn the_usual_spellings_mean_the_same() {
    for text in [
        "55.71, 13.19",
        "55.71 13.19",
        "55.71,13.19",
        "  55.71;13.19 ",
        "55.71/13.19",
        "+55.71 +13.19",
        "(55.71, 13.19)",
        "55,71 13,19",
        "55,71, 13,19",
        "55,71; 13,19",
        "55,71° N, 13,19° E",
        "55.71N 13.19E",
        "N55.71 E13.19",
        "13.19 E, 55.71 N",
        "E 13.19 N 55.71",
        "55.71 north 13.19 east",
        "lat: 55.71, lon: 13.19",
        "longitude=13.19 latitude=55.71",
        "55°42'36\"N 13°11'24\"E",
        "55°42′36″N, 13°11′24″E",
        "55º42’36”N13º11’24”E",
        "55°42'36''N 13°11'24''E",
        "55 42 36 N 13 11 24 E",
        "55 42 36 13 11 24",
        "55 42 36, 13 11 24",
        "55 42 36,13 11 24",
        "55:42:36 13:11:24",
        "N 55 42 36 E 13 11 24",
        "N55 42.6 E13 11.4",
        "55° 42.6' N, 13° 11.4' E",
        "55 42,6 13 11,4",
        "55°42,6'N 13°11,4'E",
        "55d42m36s N 13d11m24s E",
        "55 deg 42 min 36 sec N 13 deg 11 min 24 sec E",
        "55°42.6' 13°11'24\"",
        "geo:55.71,13.19",
        "geo:55.71,13.19,51;crs=wgs84;u=10",
        "GEO:0,0?q=55.71,13.19(Lund)",
        "https://www.google.com/maps/@55.71,13.19,12z",
        "@55.71,13.19,12z",
        "https://www.google.com/maps/place/Lund/@55.7,13.2,12z/data=!3m1!4b1!4m6!3m5!1s0x46!8m2!3d55.71!4d13.19!16s",
        "https://www.google.com/maps/search/?api=1&query=55.71%2C13.19",
        "https://maps.google.com/?q=loc:55.71,13.19",
        "https://www.openstreetmap.org/#map=12/55.71/13.19",
        "https://www.openstreetmap.org/?mlat=55.71&mlon=13.19#map=12/55.6/13.1",
        "mlat=55.71&mlon=13.19",
        "#map=12/55.71/13.19",
        "https://www.bing.com/maps?cp=55.71~13.19&lvl=12",
        "https://example.com/map?lat=55.71&lng=13.19",
        "https://maps.apple.com/?ll=55.71,13.19",
    ] {
        let (latitude, longitude) = parsed(text);
        assert!((latitude - 55.71).abs() < 1e-9 && (longitude - 13.19).abs() < 1e-9, "{text}: {latitude}, {longitude}");
    }
}

#[test]
fn south_and_west_are_negative_in_every_spelling() {
    for text in [
        "-33.87 -70.40",
        "-33.87, -70.40",
        "−33.87 −70.40",
        "33.87 S 70.40 W",
        "33°52'12\"S 70°24'00\"W",
        "-33 52 12 -70 24 0",
        "S33 52.2 W70 24",
        "@-33.87,-70.4,5z",
    ] {
        let (latitude, longitude) = parsed(text);
        assert!((latitude + 33.87).abs() < 1e-9 && (longitude + 70.4).abs() < 1e-9, "{text}: {latitude}, {longitude}");
    }
    // The sign of degrees that are zero counts too.
    assert_eq!(parsed("-0 30 0, 0 30 0 W"), (-0.5, -0.5));
    assert_eq!(parsed("51 28 40 N 0 0 5 W").1, -5.0 / 3600.0);
}

#[test]
fn whole_numbers_with_a_comma_are_two_numbers() {
    assert_eq!(parsed("55,13"), (55.0, 13.0));
    assert_eq!(parsed("-33,151"), (-33.0, 151.0));
    assert_eq!(parsed("55 42,13 11"), (55.7, 13.0 + 11.0 / 60.0));
}

#[test]
fn what_is_wrong_is_named() {
    for (text, part) in [
        ("95, 13", "latitude = 95: must be a number from -90 to 90 degrees, which comes first"),
        ("95 N 13 E", "latitude = 95: must be a number from -90 to 90 degrees"),
        ("geo:95,13", "latitude = 95: must be a number from -90 to 90 degrees"),
        ("13, 195", "longitude = 195: must be a number from -180 to 180 degrees"),
        ("55 61 0 N 13 0 0 E", "minutes = 61: must be at least 0 and less than 60"),
        ("55 10 60 N 13 0 0 E", "seconds = 60: must be at least 0 and less than 60"),
        ("", "nothing is given"),
        ("55.71", "two numbers are needed"),
        ("55,71,13,19", "write decimal points"),
        ("55.71 N 13.19", "both or neither must have a letter"),
        ("55.71 N 13.19 N", "one must be a latitude"),
        ("-55.71 N 13.19 E", "a sign and a letter"),
        ("55.71, 13.19, 20", "only one comma"),
        ("55 42 36 13 11", "where latitude ends is not clear"),
        ("55.5 30 N 13 E", "only the last number may have a fraction"),
        ("55-42-36 N 13-11-24 E", "a sign '-'"),
        ("55.71, 13.19 Lund", "\"Lund\" has no meaning here"),
        ("Lund", "\"Lund\" has no meaning here"),
        ("55.71 # 13.19", "'#' has no meaning here"),
        ("geo:here", "after geo:"),
        ("https://maps.app.goo.gl/abc", "this link has none in it"),
        ("55' 42° N 13 E", "in this order"),
    ] {
        let message = message(text);
        assert!(message.contains(part) && !message.contains('\n'), "{text}: {message}");
    }
}

#[test]
fn texts_that_nobody_writes_are_refused_by_their_length() {
    for text in [
        "9".repeat(80_000),
        "9 ".repeat(40_000),
        "55,".repeat(30_000),
        "@1".repeat(40_000),
        "https://example.com/?q=".to_string() + &"1,".repeat(40_000),
        "e\u{301}".repeat(30_000),
        "1".repeat(201),
    ] {
        let message = message(&text);
        assert!(message.contains("at most 200 bytes, or a link of at most 4096") && message.len() < 700, "{message}");
    }
    let long = "https://example.com/map?".to_string() + &"x=1&".repeat(500) + "lat=55.71&lon=13.19";
    assert_eq!(parsed(&long), (55.71, 13.19));
}

#[test]
fn styles_are_written_as_they_are_read() {
    let lund = Coordinates::new(55.71, 13.19).unwrap();
    assert_eq!(lund.to_string(), "55.71, 13.19");
    assert_eq!(lund.format(CoordinateStyle::DegreesMinutes), "55°42.600'N 13°11.400'E");
    assert_eq!(lund.format(CoordinateStyle::DegreesMinutesSeconds), "55°42'36\"N 13°11'24\"E");
    let corner = Coordinates::new(-0.000_001, -179.999_99).unwrap();
    assert_eq!(corner.to_string(), "0.0, -179.99999");
    // Sixty seconds carry over.
    assert_eq!(corner.format(CoordinateStyle::DegreesMinutesSeconds), "0°00'00\"S 180°00'00\"W");
    assert_eq!("minutes".parse::<CoordinateStyle>().unwrap(), CoordinateStyle::DegreesMinutes);
    assert!("gons".parse::<CoordinateStyle>().unwrap_err().to_string().starts_with("style = \"gons\""));
}

proptest! {
    #[test]
    fn every_style_reads_back_to_half_its_last_digit(latitude in -90.0..=90.0, longitude in -180.0..=180.0) {
        let point = Coordinates::new(latitude, longitude).unwrap();
        for (style, step) in [
            (CoordinateStyle::Decimal, 1e-5),
            (CoordinateStyle::DegreesMinutes, 1e-3 / 60.0),
            (CoordinateStyle::DegreesMinutesSeconds, 1.0 / 3600.0),
        ] {
            let read = Coordinates::parse(&point.format(style)).unwrap();
            prop_assert!((read.latitude_deg - latitude).abs() <= 0.5 * step + 1e-12);
            prop_assert!((read.longitude_deg - longitude).abs() <= 0.5 * step + 1e-12);
        }
        let comma = point.to_string().replace(", ", " ").replace('.', ",");
        let read = Coordinates::parse(&comma).unwrap();
        prop_assert!((read.latitude_deg - latitude).abs() <= 0.5e-5 + 1e-12);
    }

    #[test]
    fn no_text_brings_the_reader_down(text in ".{0,60}") {
        if let Ok(found) = Coordinates::parse(&text) {
            prop_assert!(found.latitude_deg.abs() <= 90.0 && found.longitude_deg.abs() <= 180.0);
        }
    }

    #[test]
    fn nor_does_one_of_its_own_letters(text in "[-+0-9.,;/ °'\"NSEWdms@!?&=:%geolatnqmp#]{0,40}") {
        if let Ok(found) = Coordinates::parse(&text) {
            prop_assert!(found.latitude_deg.abs() <= 90.0 && found.longitude_deg.abs() <= 180.0);
        }
    }
}
