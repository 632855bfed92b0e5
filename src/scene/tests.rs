use super::*;
use crate::atmosphere::{AerosolType, Ground, Preset, Surface};
use crate::io::Half;
use crate::post::tone::OperatorName;
use crate::probe::{Extent, GroundView, Projection, Rows};
use crate::sky::LayerScales;
use crate::spectrum::{ColorSpace, Gamut};
use crate::units::Scale;
use proptest::prelude::*;
use proptest::sample::select;

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
        (r#"{"probe": {"scale": "nits"}}"#, r#"probe.scale = "nits": must be one of blender"#),
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

fn optional<T: Clone + std::fmt::Debug + 'static>(inner: impl Strategy<Value = T> + 'static) -> BoxedStrategy<Option<T>> {
    proptest::option::of(inner).boxed()
}

fn any_air() -> impl Strategy<Value = SceneAtmosphere> {
    let grounds = prop_oneof![
        select(vec![Surface::Grass, Surface::Snow, Surface::City]).prop_map(Ground::Surface),
        (0.0..=1.0).prop_map(Ground::Albedo)
    ];
    let presets = select(vec![Preset::Clear, Preset::Hazy, Preset::Antarctic]);
    let aerosols = optional(select(vec![AerosolType::Urban, AerosolType::Desert]));
    let qualities = select(vec![Quality::Draft, Quality::Standard, Quality::High, Quality::Reference]);
    let solve = (qualities, any::<bool>(), optional(select(vec![vec![350.0, 550.5], vec![1000.0]])));
    (presets, aerosols, optional(1.0..=64.0), optional(0.0..=1000.0), optional(grounds), solve).prop_map(
        |(preset, aerosol, turbidity, ozone_du, ground, (quality, polarisation, wavelengths_nm))| SceneAtmosphere {
            air: AirParameters { preset, aerosol, turbidity, ozone_du, ground, ..AirParameters::default() },
            quality,
            polarisation,
            wavelengths_nm,
        },
    )
}

fn any_probe() -> impl Strategy<Value = ProbeSettings> {
    let image = (
        (16_usize..=4096).prop_map(|quarter| quarter * 4),
        select(vec![Projection::LatLong, Projection::Fisheye]),
        select(vec![Rows::Centre, Rows::Corner]),
        select(vec![Extent::Full, Extent::Upper]),
        select(vec![GroundView::On, GroundView::Off, GroundView::Mirrored]),
    );
    let colour = (
        prop_oneof![Just(0.0), -360.0..=360.0_f64],
        any::<[bool; 2]>(),
        select(vec![Scale::Blender, Scale::Mitsuba, Scale::Luminance]),
        select(vec![ColorSpace::LinRec709, ColorSpace::AcesCg, ColorSpace::LinRec2020, ColorSpace::Xyz]),
        select(vec![Gamut::Desaturate, Gamut::Clip, Gamut::Keep]),
    );
    (image, colour).prop_map(
        |((width, projection, rows, extent, ground), (turn_deg, [sun_disc, moon_disc], scale, color_space, gamut))| {
            ProbeSettings { width, projection, rows, extent, turn_deg, ground, sun_disc, moon_disc, scale, color_space, gamut }
        },
    )
}

fn any_light() -> impl Strategy<Value = LightOptions> {
    let filter = (0.0..=1.0_f64, -180.0..=180.0_f64, optional([-90.0..=90.0_f64, -360.0..=360.0_f64]));
    let filter =
        filter.prop_map(|(strength, angle_deg, held_towards_deg)| PolarisingFilter { strength, angle_deg, held_towards_deg });
    (optional(filter), optional(1e-4..=0.5)).prop_map(|(polarising_filter, tolerance)| LightOptions {
        model: Model::Scattering,
        polarising_filter,
        tolerance,
        layers: LayerScales::default(),
    })
}

fn any_config() -> impl Strategy<Value = Scene> {
    let place = (-90.0..=90.0_f64, -180.0..=180.0_f64, select(vec!["2005-06-21T13:00:00+02:00", "1987-01-02T03:04"]));
    let sun = (-90.0..=90.0_f64, -360.0..=360.0_f64);
    let sky = prop_oneof![place.prop_map(Ok), sun.prop_map(Err)];
    let zone = optional(select(vec!["Europe/Stockholm".to_string(), "UTC".to_string()]));
    let files =
        (select(vec![Half::Off, Half::Refuse, Half::Scale]), -20.0..=20.0_f64, select(OperatorName::ALL.to_vec()), any::<bool>());
    let output = proptest::collection::vec("[a-z ]{1,8}\\.exr".prop_map(PathBuf::from), 0..3);
    (
        sky,
        zone,
        -500.0..=60_000.0_f64,
        select(vec![SunModel::Iau, SunModel::Thesis]),
        any_air(),
        any_probe(),
        any_light(),
        files,
        output,
    )
        .prop_map(
            |(sky, zone, elevation_m, sun_model, atmosphere, probe, light, (half, exposure_stops, operator, layers), output)| {
                let file = FileOptions { half, exposure_stops, operator, layers };
                let common = Scene { elevation_m, zone, sun_model, light, atmosphere, probe, file, output, ..Scene::default() };
                match sky {
                    Ok((latitude, longitude, time)) => {
                        Scene { latitude: Some(latitude), longitude: Some(longitude), time: Some(time.to_string()), ..common }
                    }
                    Err((altitude_deg, azimuth_deg)) => Scene { sun: Some(SunPosition { altitude_deg, azimuth_deg }), ..common },
                }
            },
        )
}

proptest! {
    #[test]
    fn what_is_written_reads_back_to_the_last_digit(config in any_config()) {
        prop_assert_eq!(Scene::from_json(&config.to_json()).unwrap(), config);
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in "[\\[\\]{}:,\"a-z0-9.-]{0,40}") {
        let _ = Scene::from_json(&text);
    }
}
