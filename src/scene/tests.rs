use super::*;
use proptest::prelude::*;
use proptest::sample::select;
use serde_json::json as object;

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

/// A value that the row of a parameter allows.
fn any_value(row: &'static Parameter) -> BoxedStrategy<Value> {
    let number = |low: f64, high: f64| prop_oneof![Just(low), Just(high), low..=high].prop_map(Value::from);
    let word = |words: &'static [&'static str]| select(words.to_vec()).prop_map(Value::from);
    match row.kind {
        Kind::Number { low, high } => number(low, high).boxed(),
        // Pictures divide into whole rows.
        Kind::Whole { low, high } if row.name == "width" => {
            (low / 4..=high / 4).prop_map(|quarter| Value::from(4 * quarter)).boxed()
        }
        Kind::Whole { low, high } => (low..=high).prop_map(Value::from).boxed(),
        Kind::Flag => any::<bool>().prop_map(Value::from).boxed(),
        Kind::Words(words) => word(words).boxed(),
        Kind::WordsOrNumber { words, low, high } => prop_oneof![word(words), number(low, high)].boxed(),
        Kind::Ascending { low, high } => proptest::collection::btree_set(low as u32..=high as u32, 1..6)
            .prop_map(|set| Value::from_iter(set.into_iter().map(f64::from)))
            .boxed(),
        Kind::Direction => {
            (-90.0..=90.0_f64, -360.0..=360.0_f64).prop_map(|(altitude, azimuth)| Value::from(vec![altitude, azimuth])).boxed()
        }
        Kind::Factors { words, low, high } => proptest::collection::btree_map(select(words.to_vec()), low..=high, 1..4)
            .prop_map(|factors| {
                Value::from_iter(factors.into_iter().map(|(word, factor)| (word.to_owned(), Value::from(factor))))
            })
            .boxed(),
        Kind::Files => proptest::collection::vec("[a-z \u{e5}]{1,8}\\.exr", 1..3).prop_map(Value::from).boxed(),
        Kind::Text => match row.name {
            "time" => select(vec!["2005-06-21T13:00:00+02:00", "1987-01-02T03:04", "2030-12-31"]).prop_map(Value::from).boxed(),
            "zone" => select(vec!["Europe/Stockholm", "UTC", "Asia/Kathmandu"]).prop_map(Value::from).boxed(),
            "place" => select(vec!["Lund, Sweden", "-33.87, 151.21"]).prop_map(Value::from).boxed(),
            other => panic!("what may the text {other} be?"),
        },
    }
}

/// JSON in which each parameter of the table is given as often as not; what excludes each other is not given twice.
fn any_document() -> impl Strategy<Value = Value> {
    let rows: Vec<BoxedStrategy<Option<Value>>> = parameters().map(|row| proptest::option::of(any_value(row)).boxed()).collect();
    (rows, any::<[bool; 2]>()).prop_map(|(values, [is_put, is_named])| {
        let mut document = serde_json::Map::new();
        let mut groups = Vec::new();
        for (row, value) in parameters().zip(values) {
            let of_place = ["latitude", "longitude", "time", "zone", "place"].contains(&row.name);
            let is_left_out = (is_put && of_place)
                || (!is_put && row.table == "sun")
                || (is_named == ["latitude", "longitude"].contains(&row.name)
                    && (of_place && row.name != "time" && row.name != "zone"));
            let needed = is_put && row.table == "sun";
            let Some(value) = value.or(needed.then_some(Value::from(1.5))) else { continue };
            if is_left_out || (!row.group.is_empty() && groups.contains(&row.group)) {
                continue;
            }
            if !row.group.is_empty() {
                groups.push(row.group);
            }
            let table = match row.table {
                "" => &mut document,
                name => document.entry(name).or_insert_with(|| Value::Object(serde_json::Map::new())).as_object_mut().unwrap(),
            };
            table.insert(row.name.to_owned(), value);
        }
        Value::Object(document)
    })
}

/// Whether two parameters do not fit together, which their rows cannot say.
fn is_of_several(error: &Error) -> bool {
    let text = error.to_string();
    ["left out", "henyey_greenstein or cornette_shanks", "km or more in haze", "of pure air", "one of continental_clean"]
        .iter()
        .any(|part| text.contains(part))
}

proptest! {
    #[test]
    fn what_the_table_allows_is_read_and_comes_back_to_the_last_digit(document in any_document()) {
        match Scene::from_value(&document) {
            Ok(scene) => {
                let again = Scene::from_json(&scene.to_json()).unwrap();
                prop_assert_eq!(again.to_value(), scene.to_value());
                // What was given stands in what is written, but for a place, which is written as the numbers that it stands for.
                let written = scene.to_value();
                for row in parameters().filter(|row| !["place", "elevation_m"].contains(&row.name)) {
                    let at = format!("/{}", row.path().replace('.', "/"));
                    if let Some(given) = document.pointer(&at).filter(|given| *given != &Value::from(0.0)) {
                        prop_assert_eq!(written.pointer(&at), Some(given), "{}", row.path());
                    }
                }
            }
            Err(error) => prop_assert!(is_of_several(&error), "{}: {}", document, error),
        }
    }

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
