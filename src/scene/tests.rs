use super::*;
use proptest::prelude::*;
use serde_json::json as object;

mod documents;
mod random;

fn message(text: &str) -> String {
    Scene::from_json(text).unwrap_err().to_string()
}

#[test]
fn wrong_input_names_the_key_with_its_table() {
    for (text, start) in [
        (r#"{"latitude": 91}"#, "latitude = 91: must be a number from -90 to 90 degrees"),
        (r#"{"place": "Qqqxx"}"#, r#"place = "Qqqxx": must be the name of a town"#),
        (r#"{"place": "95, 13"}"#, "latitude = 95: must be a number from -90 to 90 degrees"),
        (r#"{"place": "Lund", "latitude": 3}"#, r#"place = "Lund": must be left out where latitude"#),
        (r#"{"place": 3}"#, "place = 3: must be a text in quotes"),
        (r#"{"latitude": "north"}"#, r#"latitude = "north": must be a number"#),
        (r#"{"time": "yesterday"}"#, r#"time = "yesterday": must be "#),
        (r#"{"zone": "Mars/Olympus", "time": "2005-06-21T13:00"}"#, r#"zone = "Mars/Olympus": must be "#),
        (r#"{"zone": "Mars/Olympus"}"#, r#"zone = "Mars/Olympus": must be "#),
        (r#"{"lattitude": 5}"#, "unknown key lattitude = 5: must be left out, or one of latitude, longitude"),
        (r#"{"atmosphere": {"turbidity": -1}}"#, "atmosphere.turbidity = -1: must be a number from 1 to 64"),
        (r#"{"atmosphere": {"turbidty": 2}}"#, "unknown key atmosphere.turbidty = 2: must be left out, or one of preset"),
        (r#"{"atmosphere": {"quality": "best"}}"#, r#"atmosphere.quality = "best": must be one of draft"#),
        (r#"{"atmosphere": {"ground": "lava"}}"#, r#"atmosphere.ground = "lava": must be "#),
        (r#"{"atmosphere": {"wavelengths_nm": [200]}}"#, "atmosphere.wavelengths_nm = 200: must be a number from 300 to 1000 nm"),
        (r#"{"polarising_filter": {"strength": 2}}"#, "polarising_filter.strength = 2: must be a number from 0 to 1"),
        (
            r#"{"polarising_filter": {"angle": 2}}"#,
            "unknown key polarising_filter.angle = 2: must be left out, or one of strength",
        ),
        (r#"{"tolerance": 2}"#, "tolerance = 2: must be a number from 0.0001 to 0.5"),
        (r#"{"tolerance": 0.1, "model": "preetham"}"#, "tolerance = 0.1: must be left out for the model preetham"),
        (r#"{"polarising_filter": {}, "model": "thesis"}"#, "polarising_filter = given: must be left out for the model thesis"),
        (r#"{"atmosphere": []}"#, "atmosphere = []: must be a table"),
        (r#"{"probe": {"width": 0}}"#, "probe.width = 0: must be a whole number from 64 to 16384 pixels"),
        (r#"{"probe": {"width": 64.5}}"#, "probe.width = 64.5: must be a whole number"),
        (r#"{"probe": {"scale": "nits"}}"#, r#"probe.scale = "nits": must be blender, mitsuba or luminance"#),
        (r#"{"sun": {"altitude_deg": 95, "azimuth_deg": 0}}"#, "sun.altitude_deg = 95: must be"),
        (r#"{"sun": {"altitude_deg": 5}}"#, "sun"),
        (r#"{"sun": {"altitude_deg": 5, "azimuth_deg": 0}, "latitude": 3}"#, "sun = altitude 5, azimuth 0: must be left out"),
        (r#"{"file": {"exposure_stops": 99}}"#, "file.exposure_stops = 99: must be"),
        (r#"{"output": 3}"#, "output = 3: must be a file name"),
        ("[]", "configuration = []: must be a table"),
        ("{", "config = text: must be JSON ("),
    ] {
        let message = message(text);
        assert!(message.starts_with(start), "{text}: {message}");
        assert!(!message.contains('\n'), "{message}");
    }
}

#[test]
fn what_would_be_ignored_is_refused_by_name_with_the_reason() {
    let sun = r#""sun": {"altitude_deg": 5, "azimuth_deg": 0}"#;
    for (keys, start) in [
        (r#""night": {"when": "never", "bortle": 4}"#, "night.bortle = 4: must be left out where night.when is never"),
        (
            r#""night": {"when": "always"}, "model": "preetham""#,
            r#"night.when = "always": must be left out for the model preetham"#,
        ),
        (r#""night": {"led_share": 1}"#, "night.led_share = 1: must be left out where neither night.bortle"),
        (r#""night": {"star_limit": 6}, SUN"#, "night.star_limit = 6: must be left out where the Sun is put, which has no night"),
        (r#""zone": "UTC", SUN"#, r#"zone = "UTC": must be left out where the Sun is put"#),
        (r#""sun_model": "thesis", SUN"#, r#"sun_model = "thesis": must be left out where the Sun is put"#),
        (r#""layers": {"sky": 2, "moon": 2}, SUN"#, "layers.moon = 2: must be left out where the Sun is put"),
        (r#""layers": {"light_pollution": 2}"#, "layers.light_pollution = 2: must be left out where neither"),
        (
            r#""atmosphere": {"asymmetry": 0.5, "preset": "pure"}"#,
            "atmosphere.asymmetry = 0.5: must be left out where the aerosol is none",
        ),
        (
            r#""atmosphere": {"relative_humidity": 5, "preset": "thesis"}"#,
            "atmosphere.relative_humidity = 5: must be left out for the aerosol thesis",
        ),
        (
            r#""atmosphere": {"stratospheric_altitude_km": 25}"#,
            "atmosphere.stratospheric_altitude_km = 25: must be left out where",
        ),
        (
            r#""atmosphere": {"ozone_du": 250}, "model": "preetham""#,
            "atmosphere.ozone_du = 250: must be left out for the model preetham",
        ),
        (
            r#""atmosphere": {"quality": "high"}, "model": "thesis""#,
            r#"atmosphere.quality = "high": must be left out for the model thesis"#,
        ),
        (r#""probe": {"projection": "fisheye", "rows": "corner"}"#, r#"probe.rows = "corner": must be left out for a fisheye"#),
        (
            r#""probe": {"extent": "upper", "ground": "mirrored"}"#,
            r#"probe.ground = "mirrored": must be left out where probe.extent is upper"#,
        ),
        (r#""probe": {"color_space": "xyz", "gamut": "clip"}"#, r#"probe.gamut = "clip": must be left out for xyz"#),
        (
            r#""file": {"layers": true}, "output": "a.hdr""#,
            "file.layers = true: must be left out without an output that ends in .exr",
        ),
        (
            r#""file": {"exposure_stops": 1}, "output": ["a.exr"]"#,
            "file.exposure_stops = 1: must be left out without an output that ends in .png",
        ),
    ] {
        let message = message(&format!("{{{}}}", keys.replace("SUN", sun)));
        assert!(message.starts_with(start), "{keys}: {message}");
    }
    // What is asked for comes anyway, or there is no picture yet that it could be missing in.
    for keys in [
        r#""night": {"when": "never", "star_limit": 8.5, "led_share": 0.5}, "layers": {"moon": 0, "stars": 1}"#,
        r#""night": {"when": "never"}, "layers": {"moon": 0}, SUN"#,
        r#""night": {"led_share": 1, "bortle": 3}, "layers": {"light_pollution": 2}"#,
        r#""atmosphere": {"stratospheric_altitude_km": 25, "preset": "volcanic"}"#,
        r#""atmosphere": {"stratospheric_altitude_km": 25, "stratospheric_aod550": 0}"#,
        r#""probe": {"color_space": "xyz", "gamut": "keep"}"#,
        r#""probe": {"extent": "upper", "ground": "off"}"#,
        r#""file": {"layers": true, "exposure_stops": 1}"#,
        r#""zone": "UTC""#,
    ] {
        Scene::from_json(&format!("{{{}}}", keys.replace("SUN", sun))).unwrap();
    }
}

#[test]
fn unknown_keys_of_the_air_are_told_about_the_keys_of_the_solver_too() {
    let message = message(r#"{"atmosphere": {"qualty": "high"}}"#);
    assert!(message.ends_with("quality, polarisation, wavelengths_nm"), "{message}");
}

#[test]
fn an_empty_configuration_is_the_default_and_says_what_is_missing() {
    let config = Scene::from_json("{}").unwrap();
    assert_eq!(config, Scene::default());
    assert!(config.place().unwrap_err().to_string().starts_with("latitude = nothing: must be given"));
}

#[test]
fn a_place_is_read_by_its_name_and_written_as_numbers() {
    let config = Scene::from_json(r#"{"place": "lund, sweden"}"#).unwrap();
    assert_eq!((config.latitude, config.longitude, config.elevation_m), (Some(55.706), Some(13.193), 51.0));
    assert_eq!(config.place_label.as_deref(), Some("Lund, Skåne, Sweden"));
    let read_back = Scene::from_json(&config.to_json()).unwrap();
    assert_eq!(read_back, Scene { place_label: None, ..config });
    let higher = Scene::from_json(r#"{"place": "55 42 36 N 13 11 24 E", "elevation_m": 80}"#).unwrap();
    assert_eq!((higher.latitude, higher.elevation_m), (Some(55.71), 80.0));
}

#[test]
fn one_name_or_several_may_be_the_output() {
    let paths = |text: &str| Scene::from_json(text).unwrap().output;
    assert_eq!(paths(r#"{"output": "sky.exr"}"#), [PathBuf::from("sky.exr")]);
    assert_eq!(paths(r#"{"output": ["a.exr", "b.png"]}"#), [PathBuf::from("a.exr"), PathBuf::from("b.png")]);
    assert!(paths(r#"{"output": null}"#).is_empty());
}

#[test]
fn not_a_number_is_refused_where_it_cannot_come_from_json() {
    let sun = Some(SunPosition { altitude_deg: f64::NAN, azimuth_deg: 0.0 });
    for config in [
        Scene { latitude: Some(f64::NAN), ..Scene::default() },
        Scene { elevation_m: f64::INFINITY, ..Scene::default() },
        Scene { sun, ..Scene::default() },
    ] {
        assert!(matches!(config.validate(), Err(Error::Input { .. })));
    }
}

proptest! {
    #[test]
    fn a_value_out_of_range_is_refused_by_name(index in 0..200_usize, above in any::<bool>(), by in 1e-3..1e6_f64) {
        let rows: Vec<&Parameter> = parameters().filter(|row| matches!(row.kind, Kind::Number { .. } | Kind::Whole { .. })).collect();
        let row = rows[index % rows.len()];
        let value = match row.kind {
            Kind::Number { low, high } => Value::from(if above { high + by } else { low - by }),
            Kind::Whole { high, .. } => Value::from(if above { u64::from(high) + 1 + by as u64 } else { 0 }),
            _ => unreachable!(),
        };
        let other = if row.name == "altitude_deg" { "azimuth_deg" } else { "altitude_deg" };
        let document = match row.table {
            "" => object!({row.name: value}),
            "sun" => object!({"sun": {row.name: value, other: 0.0}}),
            table => object!({table: {row.name: value}}),
        };
        let message = Scene::from_value(&document).unwrap_err().to_string();
        prop_assert!(message.starts_with(&format!("{} = ", row.path())), "{}", message);
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in "[\\[\\]{}:,\"a-z0-9.-]{0,40}") {
        let _ = Scene::from_json(&text);
    }
}
