//! The command line tool as a user runs it: exit codes, one line of complaint, files whole or not at all.
#![cfg(feature = "cli")]

use std::path::Path;
use std::process::{Command, Output};

const SUN: [&str; 4] = ["--sun-altitude", "30", "--sun-azimuth", "-20"];

fn tool(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_skyprobe"));
    command.args(arguments).current_dir(folder).env("SKYPROBE_CACHE", "off").output().expect("the tool starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn wrong_input_is_one_line_and_exit_code_2_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("folder.exr")).unwrap();
    std::fs::write(folder.path().join("unknown.json"), r#"{"atmosphere": {"turbidty": 3}}"#).unwrap();
    std::fs::write(folder.path().join("town.json"), r#"{"night": {"when": "never", "bortle": 3}}"#).unwrap();
    std::fs::write(folder.path().join("broken.json"), "{\n \"latitude\": }").unwrap();
    let before = files(folder.path());
    let place = ["--lat", "55.71", "--lon", "-76.5", "--time", "2005-06-21T13:00Z"];
    let with = |base: &[&'static str], more: &[&'static str]| [&["render"], base, more].concat();
    for (arguments, part) in [
        (vec!["render", "--lat", "91", "--lon", "0", "--time", "2005-06-21T13:00Z", "-o", "a.exr"], "--latitude = 91: must be"),
        (vec!["render", "--lat", "NaN", "--lon", "0", "--time", "2005-06-21T13:00Z", "-o", "a.exr"], "latitude = NaN: must be"),
        (vec!["render", "--lat", "1", "--lon", "0", "--time", "yesterday", "-o", "a.exr"], "time = \"yesterday\": must be"),
        (vec!["render", "--lat", "1", "-o", "a.exr"], "longitude = nothing: must be given"),
        (vec!["render", "--lat", "north"], "--latitude"),
        (vec!["render", "--place", "Qqqxx", "-o", "a.exr"], "place = \"Qqqxx\": must be the name of a town"),
        (vec!["render", "--place", "95, 13", "-o", "a.exr"], "latitude = 95: must be a number from -90 to 90 degrees"),
        (vec!["render", "--place", "Lund", "--lat", "1", "-o", "a.exr"], "cannot be used with"),
        (vec!["render", "--place", "Lund", "--sun-altitude", "3", "--sun-azimuth", "3", "-o", "a.exr"], "cannot be used with"),
        (vec!["places", "Qqqxx"], "place = \"Qqqxx\""),
        (vec!["places", "Stockhlom"], "nearest spellings: Stockholm, Sweden"),
        (vec!["info", "--lat", "55,71,13,19"], "one number, with a decimal point; --place takes both"),
        (vec!["places", "lund", "--limit", "0"], "--limit"),
        (vec!["render", "--lat", "1", "--sun-altitude", "3", "--sun-azimuth", "3", "-o", "a.exr"], "cannot be used with"),
        (with(&SUN, &["--turbidity", "-1", "-o", "a.exr"]), "--turbidity = -1: must be a number from 1 to 64"),
        (with(&SUN, &["--turbidity", "inf", "-o", "a.exr"]), "turbidity = inf: must be"),
        (with(&SUN, &["--turbidity", "2", "--aod550", "0.1", "-o", "a.exr"]), "cannot be used with"),
        (with(&SUN, &["--width", "0", "-o", "a.exr"]), "--width = 0: must be a whole number from 64 to 16384 pixels"),
        (with(&SUN, &["--width", "-4", "-o", "a.exr"]), "width = -4: must be"),
        (with(&SUN, &["--scale", "nits", "-o", "a.exr"]), "scale = \"nits\": must be"),
        (with(&SUN, &["--exposure", "nan", "-o", "a.png"]), "--exposure = NaN: must be"),
        (with(&SUN, &["--polarising-filter", "2", "-o", "a.exr"]), "--polarising-filter = 2: must be a number from 0 to 1"),
        (with(&SUN, &["--filter-angle", "20", "-o", "a.exr"]), "polarising_filter = nothing: must be given"),
        (
            with(&SUN, &["--polarising-filter", "1", "--filter-towards", "20", "-o", "a.exr"]),
            "--filter-towards = \"20\": must be altitude and azimuth",
        ),
        (with(&SUN, &["--no-polarisation", "--polarising-filter", "1", "-o", "a.exr"]), "--polarisation = false: must be true"),
        (with(&SUN, &["--night", "dusk", "-o", "a.exr"]), "--night = \"dusk\": must be auto, always or never"),
        (with(&SUN, &["--star-limit", "9", "-o", "a.exr"]), "--star-limit = 9: must be a number from -2 to 8.5"),
        (with(&SUN, &["--solar-flux", "nan", "-o", "a.exr"]), "--solar-flux = NaN: must be a number from 60 to 300"),
        (with(&SUN, &["--zenith-brightness", "25", "-o", "a.exr"]), "--zenith-brightness = 25: must be a number from 15 to 22"),
        (with(&SUN, &["--bortle", "10", "-o", "a.exr"]), "--bortle = 10: must be a whole number from 1 to 9"),
        (with(&SUN, &["--bortle", "-300", "-o", "a.exr"]), "--bortle = -300: must be a whole number from 1 to 9"),
        (with(&SUN, &["--bortle", "3", "--zenith-brightness", "20", "-o", "a.exr"]), "cannot be used with"),
        (with(&SUN, &["--led-share", "2", "-o", "a.exr"]), "--led-share = 2: must be a number from 0 to 1"),
        (with(&SUN, &["--layer", "comets=1", "-o", "a.exr"]), "must be one of sky, sun, moon, stars"),
        (with(&SUN, &["--layer", "stars", "-o", "a.exr"]), "--layer = \"stars\": must be NAME=FACTOR, such as stars=2"),
        (with(&SUN, &["--layer", "stars=-1", "-o", "a.exr"]), "--layer stars = -1: must be a number from 0 to"),
        (with(&SUN, &["--separate-layers", "-o", "a.hdr"]), "--separate-layers = true: must be left out without an output"),
        (
            with(&SUN, &["--separate-layers", "--sample-map", "a.png"]),
            "--separate-layers = true: must be left out without an output that ends in .exr",
        ),
        (with(&SUN, &["--exposure", "1", "-o", "a.exr"]), "--exposure = 1: must be left out without an output that ends in .png"),
        (with(&SUN, &["--bortle", "3", "-o", "a.exr"]), "--bortle = 3: must be left out where the Sun is put"),
        (with(&SUN, &["--layer", "moon=2", "-o", "a.exr"]), "--layer moon = 2: must be left out where the Sun is put"),
        (with(&SUN, &["--config", "town.json", "-o", "a.exr"]), "night.bortle = 3: must be left out where night.when is never"),
        (
            with(&place, &["--night", "never", "--star-limit", "6", "-o", "a.exr"]),
            "--star-limit = 6: must be left out where --night is never",
        ),
        (
            with(&place, &["--led-share", "1", "-o", "a.exr"]),
            "--led-share = 1: must be left out where neither --bortle nor --zenith-brightness says",
        ),
        (
            with(&place, &["--model", "preetham", "--ozone", "200", "-o", "a.exr"]),
            "--ozone = 200: must be left out for the model preetham",
        ),
        (
            with(&place, &["--aerosol", "none", "--asymmetry", "0.5", "-o", "a.exr"]),
            "--asymmetry = 0.5: must be left out where the aerosol is none",
        ),
        (with(&SUN, &["--tolerance", "0", "-o", "a.exr"]), "tolerance = 0: must be a number from 0.0001 to 0.5"),
        (with(&SUN, &["--sample-map", "a.exr"]), "sample_map = a.exr: must be a file name that ends in .png"),
        (with(&SUN, &["--sample-map", "nowhere/a.png"]), "nowhere/a.png: must be"),
        (with(&SUN, &["-o", "folder.exr"]), "output = folder.exr: must be a file, not a directory"),
        (with(&SUN, &["-o", "."]), "output = .: must be a file, not a directory"),
        (with(&SUN, &["-o", "nowhere/a.exr"]), "output = nowhere/a.exr: must be"),
        (with(&SUN, &["-o", "a.exr", "-o", "/proc/a.exr"]), "output = /proc/a.exr: must be"),
        (with(&SUN, &["-o", "a.jpg"]), "output = a.jpg: must be"),
        (with(&SUN, &["-o", "a.exr", "--preview", "b.exr"]), "preview = b.exr: must be"),
        (with(&SUN, &[]), "output = nothing: must be given"),
        (with(&place, &["--config", "missing.json", "-o", "a.exr"]), "config = missing.json: must be"),
        (with(&place, &["--config", "broken.json", "-o", "a.exr"]), "must be JSON"),
        (with(&place, &["--config", "unknown.json", "-o", "a.exr"]), "unknown key atmosphere.turbidty = 3: must be left out"),
        (vec!["render", "--widht", "64"], "tip: a similar argument exists: '--width'"),
        (vec!["paint"], "unrecognized subcommand"),
        (vec![], "a command is missing"),
    ] {
        let output = tool(folder.path(), &arguments);
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {complaint}");
        assert!(complaint.starts_with("error: ") && complaint.contains(part), "{arguments:?}: {complaint}");
        assert_eq!(complaint.trim_end_matches('\n').lines().count(), 1, "{arguments:?}: {complaint}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
        assert_eq!(files(folder.path()), before, "{arguments:?}");
    }
}

#[test]
fn several_files_are_written_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let more = ["--quality", "draft", "--width", "64", "-o", "sky.exr", "-o", "sky.hdr", "--preview", "sky.png"];
    let output = tool(folder.path(), &[&["render"], &SUN[..], &more].concat());
    assert_eq!((output.status.code(), text(&output.stderr).as_str()), (Some(0), ""));
    assert_eq!(files(folder.path()), ["sky.exr", "sky.hdr", "sky.png"]);
    let said = text(&output.stdout);
    assert_eq!(said.lines().next(), Some("sky.exr: 64 x 32, Sun at altitude 30.000 deg, azimuth 340.000 deg"));
    assert_eq!(said.lines().count(), 3);
}

#[test]
fn a_dumped_configuration_makes_the_same_picture_and_options_override_it() {
    let folder = tempfile::tempdir().unwrap();
    let options =
        ["--lat", "-33.87", "--lon", "151.21", "--time", "2024-01-10T18:30", "--aerosol", "urban", "--visibility", "12"];
    let more = ["--quality", "draft", "--width", "64", "--no-sun-disc", "-o", "a.hdr"];
    let arguments = [&["render"], &options[..], &more].concat();
    let dump = tool(folder.path(), &[&arguments[..], &["--dump-config"]].concat());
    assert_eq!(dump.status.code(), Some(0), "{}", text(&dump.stderr));
    assert!(files(folder.path()).is_empty(), "--dump-config renders nothing");
    let config: serde_json::Value = serde_json::from_slice(&dump.stdout).unwrap();
    assert_eq!(config["atmosphere"]["visibility_km"], 12.0);
    assert_eq!((&config["probe"]["sun_disc"], &config["probe"]["width"]), (&false.into(), &64.into()));
    std::fs::write(folder.path().join("sky.json"), &dump.stdout).unwrap();
    assert_eq!(tool(folder.path(), &arguments).status.code(), Some(0));
    assert_eq!(tool(folder.path(), &["render", "--config", "sky.json", "-o", "b.hdr"]).status.code(), Some(0));
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("a.hdr") == bytes("b.hdr"), "the two pictures differ");
    let overridden = tool(
        folder.path(),
        &["render", "--config", "sky.json", "--turbidity", "3", "--sun-altitude", "-5", "--sun-azimuth", "9", "--dump-config"],
    );
    let config: serde_json::Value = serde_json::from_slice(&overridden.stdout).unwrap();
    assert_eq!(config["atmosphere"]["turbidity"], 3.0);
    assert_eq!(config["sun"]["altitude_deg"], -5.0);
    for gone in [&config["atmosphere"]["visibility_km"], &config["latitude"], &config["time"]] {
        assert!(gone.is_null(), "{gone}");
    }
}

/// What is asked for by options counts; what it puts out of force is no longer part of the configuration.
#[test]
fn options_put_values_of_a_configuration_out_of_force() {
    let folder = tempfile::tempdir().unwrap();
    let night = r#"{"place": "Lund", "time": "2005-01-10T23:00", "zone": "UTC", "night": {"bortle": 3, "star_limit": 6},
        "layers": {"stars": 2, "sky": 3}, "atmosphere": {"ozone_du": 200}, "file": {"half": "refuse"}, "output": "a.exr"}"#;
    std::fs::write(folder.path().join("night.json"), night).unwrap();
    let dumped = |options: &[&str]| {
        let output = tool(folder.path(), &[&["render", "--config", "night.json", "--dump-config"], options].concat());
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()), "{options:?}");
        // As any other, it can be read again.
        std::fs::write(folder.path().join("again.json"), &output.stdout).unwrap();
        let again = tool(folder.path(), &["render", "--config", "again.json", "--dump-config"]);
        assert_eq!(text(&again.stdout), text(&output.stdout), "{options:?}");
        serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap()
    };
    let whole = dumped(&[]);
    assert_eq!(
        (&whole["night"]["bortle"], &whole["layers"]["stars"], &whole["file"]["half"]),
        (&3.into(), &2.0.into(), &"refuse".into())
    );
    let never = dumped(&["--night", "never"]);
    assert_eq!(
        never["night"],
        serde_json::json!({"when": "never", "star_limit": 8.5, "solar_flux_sfu": 130.0, "led_share": 0.5})
    );
    assert_eq!(never["layers"], serde_json::json!({"sky": 3.0}));
    let put = dumped(&["--sun-altitude", "3", "--sun-azimuth", "3", "--model", "preetham"]);
    assert_eq!((put.get("zone"), put["night"].get("bortle"), put["atmosphere"].get("ozone_du")), (None, None, None));
    assert_eq!(dumped(&["-o", "a.png", "--exposure", "1"])["file"]["half"], "off");
    // Without a say from the start is another matter.
    let output = tool(folder.path(), &["render", "--config", "night.json", "--night", "never", "--bortle", "4", "--dump-config"]);
    assert!(text(&output.stderr).starts_with("error: --bortle = 4: must be left out where --night is never"));
}

#[test]
fn info_says_where_the_sun_is_in_local_time() {
    let folder = tempfile::tempdir().unwrap();
    let place = ["info", "--lat", "42.44", "--lon", "-76.48", "--time", "2013-05-27T12:00", "--no-light"];
    let report = text(&tool(folder.path(), &place).stdout);
    assert!(report.contains("America/New_York (found from the place)"), "{report}");
    let json = tool(folder.path(), &[&place[..], &["--json"]].concat());
    let report: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(report["zone"], "America/New_York");
    assert_eq!(report["time"], "2013-05-27T12:00:00-04:00");
    // checked against: NOAA solar calculator, Ithaca NY, 2013-05-27: sunrise 05:34, solar noon 13:03, sunset 20:32 (UTC-4)
    for (event, clock) in [("sunrise", "T05:34"), ("solar_noon", "T13:03"), ("sunset", "T20:32")] {
        let time = report["events"][event].as_str().unwrap();
        assert!(time.contains(clock), "{event} {time}");
    }
}

#[test]
fn info_says_how_much_light_arrives() {
    let folder = tempfile::tempdir().unwrap();
    let output = tool(folder.path(), &[&["info"], &SUN[..], &["--quality", "draft", "--json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    for table in ["illuminance_lx", "irradiance_w_m2"] {
        let value = |kind: &str| report[table][kind].as_f64().unwrap();
        assert!(value("direct_normal") > value("direct_horizontal") && value("diffuse_horizontal") > 0.0, "{report}");
        let sum = value("direct_horizontal") + value("diffuse_horizontal");
        assert!((value("global_horizontal") / sum - 1.0).abs() < 1e-6, "{report}");
    }
    assert!(report["place"].is_null() && report["events"].is_null());
}

#[test]
fn help_and_version_succeed() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [&["--help"][..], &["render", "--help"], &["render", "-h"], &["info", "--help"], &["--version"]] {
        let output = tool(folder.path(), arguments);
        assert_eq!((output.status.code(), output.stderr.len()), (Some(0), 0), "{arguments:?}");
        assert!(text(&output.stdout).contains("skyprobe"), "{arguments:?}");
    }
    let help = text(&tool(folder.path(), &["render", "--help"]).stdout);
    assert!(help.contains("Examples:") && help.contains("skyprobe render --lat"));
}

/// Ctrl-C, and the polite end that batch systems ask for.
#[cfg(unix)]
#[test]
fn an_interrupted_render_exits_with_130_and_leaves_nothing() {
    for signal in ["-INT", "-TERM"] {
        let folder = tempfile::tempdir().unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_skyprobe"))
            .args(["render", "--quality", "high", "--width", "4096", "-o", "sky.exr"])
            .args(SUN)
            .current_dir(folder.path())
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_millis(300));
        assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
        let code = child.wait().unwrap().code();
        assert_eq!(code, Some(130), "{signal}");
        assert!(files(folder.path()).is_empty(), "{signal}: {:?}", files(folder.path()));
    }
}

#[test]
fn solved_light_is_kept_where_the_environment_says_unless_it_is_switched_off() {
    let folder = tempfile::tempdir().unwrap();
    let cache = folder.path().join("cache");
    let run = |more: &[&str], switch: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_skyprobe"));
        command.args(["info", "--json"]).args(SUN).args(more).current_dir(folder.path());
        let output = command.env("SKYPROBE_CACHE", switch).env("SKYPROBE_CACHE_DIR", &cache).output().unwrap();
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let plain = run(&["--no-cache"], "");
    run(&[], "off");
    run(&["--quality", "draft"], "");
    assert!(!cache.exists());
    assert_eq!(run(&[], ""), plain);
    assert_eq!(files(&cache).len(), 1);
    assert_eq!(run(&[], ""), plain);
    let kept = files(&cache);
    // A folder that is a file is no reason to fail.
    std::fs::remove_dir_all(&cache).unwrap();
    std::fs::write(&cache, "").unwrap();
    assert_eq!(run(&[], ""), plain);
    assert_eq!(kept.len(), 1);
}

#[test]
fn the_sky_is_polarised_and_a_filter_shows_it() {
    let folder = tempfile::tempdir().unwrap();
    let high_sun =
        ["render", "--sun-altitude", "30", "--sun-azimuth", "180", "--quality", "draft", "--width", "64", "--tolerance", "0.01"];
    let picture = |name: &str, more: &[&str]| {
        let made = tool(folder.path(), &[&high_sun[..], more, &["-o", name]].concat());
        assert!(made.status.success(), "{}", text(&made.stderr));
        skyprobe::io::exr::read(folder.path().join(name)).unwrap()
    };
    let plain = picture("plain.exr", &[]);
    let upright = picture("upright.exr", &["--polarising-filter", "1"]);
    let scalar = picture("scalar.exr", &["--no-polarisation"]);
    // North, 60 degrees high: at right angles to the Sun, vibration horizontal.
    let north = 3 * (5 * 64 + 16) + 1;
    assert!(upright.pixels[north] < 0.5 * plain.pixels[north]);
    let ratio = scalar.pixels[north] / plain.pixels[north];
    assert!(ratio != 1.0 && (ratio - 1.0).abs() < 0.1, "{ratio}");
    let held = picture(
        "held.exr",
        &["--polarising-filter", "0.5", "--filter-angle", "-20", "--filter-towards", "10,350", "--sample-map", "map.png"],
    );
    for part in [
        r#""polarising_filter":{"strength":0.5,"angle_deg":-20.0,"held_towards_deg":[10.0,350.0]}"#,
        r#""tolerance":0.01"#,
        r#""polarisation":true"#,
    ] {
        assert!(held.attributes["skyprobe.config"].contains(part), "{}", held.attributes["skyprobe.config"]);
    }
    assert!(scalar.attributes["skyprobe.config"].contains(r#""polarisation":false"#));
    // The header's configuration makes the picture again.
    std::fs::write(folder.path().join("held.json"), &held.attributes["skyprobe.config"]).unwrap();
    assert!(tool(folder.path(), &["render", "--config", "held.json", "-o", "again.exr"]).status.success());
    assert!(skyprobe::io::exr::read(folder.path().join("again.exr")).unwrap().pixels == held.pixels);
    let map = std::fs::read(folder.path().join("map.png")).unwrap();
    assert!(map.starts_with(b"\x89PNG"));
    // A map alone is enough to ask for.
    assert!(tool(folder.path(), &[&high_sun[..], &["--sample-map", "alone.png"]].concat()).status.success());
    assert!(folder.path().join("alone.png").is_file());
}

#[test]
fn the_analytic_sky_is_rendered_by_day_and_refused_by_night() {
    let folder = tempfile::tempdir().unwrap();
    let render = |more: &[&str]| tool(folder.path(), &[&["render", "--model", "preetham", "--width", "64"], more].concat());
    let made = render(&[&SUN[..], &["--turbidity", "3", "-o", "sky.exr"]].concat());
    assert!(made.status.success(), "{}", text(&made.stderr));
    let found = skyprobe::io::exr::read(folder.path().join("sky.exr")).unwrap();
    assert!(found.attributes["skyprobe.config"].contains(r#""model":"preetham""#));
    for (arguments, part) in [
        (vec!["--sun-altitude", "-3", "--sun-azimuth", "0"], "model = preetham with the Sun at -3.000 degrees: must be"),
        (
            vec!["--sun-altitude", "30", "--sun-azimuth", "0", "--turbidity", "20"],
            "turbidity = 20: must be a number from 2 to 10",
        ),
    ] {
        let refused = render(&[&arguments[..], &["-o", "no.exr"]].concat());
        assert_eq!(refused.status.code(), Some(2));
        assert!(text(&refused.stderr).contains(part), "{}", text(&refused.stderr));
    }
    assert_eq!(files(folder.path()), ["sky.exr"]);
}

/// What `info --json` says of a sky over a place.
fn told(folder: &Path, more: &[&str]) -> serde_json::Value {
    let output = tool(folder, &[&["info", "--json", "--quality", "draft"], more].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn info_tells_of_the_moon_in_the_shadow_of_the_earth() {
    let folder = tempfile::tempdir().unwrap();
    let place = ["--lat", "19.8207", "--lon", "-155.4681", "--elevation", "4205", "--time", "2018-01-31T13:29:50Z"];
    let report = told(folder.path(), &[&place[..], &["--zone", "Pacific/Honolulu"]].concat());
    // checked against: NASA's Five Millennium Catalog (Espenak & Meeus 2009): umbral magnitude 1.3155, penumbral 2.2941.
    let eclipse = &report["lunar_eclipse"];
    assert_eq!(eclipse["kind"], "total");
    assert!((eclipse["umbral_magnitude"].as_f64().unwrap() - 1.3155).abs() < 0.003, "{eclipse}");
    assert!((eclipse["penumbral_magnitude"].as_f64().unwrap() - 2.2941).abs() < 0.003, "{eclipse}");
    assert!(report["solar_eclipse"].is_null());
    let up: Vec<&str> = report["bodies"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|body| body["above_horizon"].as_bool().unwrap())
        .map(|body| body["name"].as_str().unwrap())
        .collect();
    assert_eq!(up, ["Moon", "Mars", "Jupiter"]);
    assert_eq!(report["bodies"].as_array().unwrap().len(), 9);
    // The eclipsed Moon gives less light than the sky does.
    let lx = |kind: &str| report["illuminance_lx"][kind].as_f64().unwrap();
    assert!(0.0 < lx("moon_horizontal") && lx("moon_horizontal") < 0.1 * lx("diffuse_horizontal"), "{report}");
    let sum = lx("direct_horizontal") + lx("moon_horizontal") + lx("diffuse_horizontal");
    assert!((lx("global_horizontal") / sum - 1.0).abs() < 1e-12, "{report}");
    let words = text(&tool(folder.path(), &[&["info", "--no-light"], &place[..]].concat()).stdout);
    assert!(words.contains("eclipse of the Moon total, magnitude 1.316 in the umbra, 2.295 in the penumbra\n"), "{words}");
    for part in
        ["\nabove the horizon ", "\n  Jupiter ", "\nMoon's next phases  last quarter  2018-02-07 ", "\nastronomical dawn "]
    {
        assert!(words.contains(part), "{part}: {words}");
    }
    assert!(!words.contains("Saturn") && !words.contains("\n  Sun "), "{words}");
}

#[test]
fn info_tells_of_the_moon_s_day_and_phases() {
    let folder = tempfile::tempdir().unwrap();
    let lund = ["--lat", "55.7047", "--lon", "13.191", "--no-light", "--time"];
    let moon = &told(folder.path(), &[&lund[..], &["2005-06-21T12:00"]].concat())["moon"];
    // checked against: Skyfield 1.55 with DE421 (tests/reference/ephemeris_rise_and_set.csv): 20:14:43 and 00:48:11 UTC.
    assert_eq!((&moon["rise"], &moon["set"]), (&"2005-06-21T22:14:43+02:00".into(), &"2005-06-21T02:48:11+02:00".into()));
    assert!(moon["transit"].is_null());
    let report = told(folder.path(), &[&lund[..], &["2005-01-02T00:00Z"]].concat());
    // checked against: the same, ephemeris_moon_phases.csv.
    let next = |phase: &str, time: &str| serde_json::json!({"phase": phase, "time": time});
    let expected = [
        next("last quarter", "2005-01-03T17:45:41+00:00"),
        next("new", "2005-01-10T12:02:49+00:00"),
        next("first quarter", "2005-01-17T06:57:29+00:00"),
        next("full", "2005-01-25T10:32:21+00:00"),
    ];
    assert_eq!(report["moon"]["next_phases"], serde_json::Value::from(expected.to_vec()));
    assert_eq!(report["moon"]["phase"], "waning gibbous");
    // checked against: shared reference, case C05: the crescent over Lund.
    let eclipse = &told(folder.path(), &[&lund[..], &["1999-08-11T12:45"]].concat())["solar_eclipse"];
    assert_eq!(eclipse["kind"], "partial");
    assert!((eclipse["separation_deg"].as_f64().unwrap() - 0.113_993).abs() < 2e-4, "{eclipse}");
}

#[test]
fn info_counts_moonlight_and_towns() {
    let folder = tempfile::tempdir().unwrap();
    let full = ["--lat", "55.71", "--lon", "13.19", "--time", "2005-01-25T00:30"];
    let lx =
        |more: &[&str], kind: &str| told(folder.path(), &[&full[..], more].concat())["illuminance_lx"][kind].as_f64().unwrap();
    // checked against: full Moon on the ground, 0.2 to 0.32 lx near the zenith; here at 58 degrees.
    assert!((0.15..0.32).contains(&lx(&[], "global_horizontal")));
    assert!(lx(&[], "moon_normal") > lx(&[], "moon_horizontal"));
    assert_eq!(lx(&["--night", "never"], "moon_normal"), 0.0);
    assert!(lx(&["--bortle", "9"], "diffuse_horizontal") > 2.0 * lx(&[], "diffuse_horizontal"));
    let words = text(&tool(folder.path(), &[&["info", "--quality", "draft"], &full[..]].concat()).stdout);
    assert!(words.contains(" facing the Moon\n"), "{words}");
}

#[test]
fn the_layers_of_a_night_are_scaled_and_written_apart() {
    let folder = tempfile::tempdir().unwrap();
    let night = ["--lat", "-24.63", "--lon", "-70.40", "--time", "2005-07-06T00:00", "--quality", "draft", "--width", "128"];
    let more = ["--bortle", "3", "--star-limit", "6", "--layer", "airglow=0", "--layer", "stars=3", "--separate-layers"];
    let made = tool(folder.path(), &[&["render"], &night[..], &more, &["-o", "layers.exr", "-o", "layers.png"]].concat());
    assert!(made.status.success(), "{}", text(&made.stderr));
    let image = exr::prelude::read_all_flat_layers_from_file(folder.path().join("layers.exr")).unwrap();
    let names: Vec<String> = image.layer_data[0].channel_data.list.iter().map(|channel| channel.name.to_string()).collect();
    for layer in ["sky", "sun", "moon", "stars", "planets", "milky_way", "zodiacal", "light_pollution"] {
        assert!(names.contains(&format!("{layer}.G")), "{layer}: {names:?}");
    }
    assert_eq!(names.len(), 3 * 9, "{names:?}");
    let layered = skyprobe::io::exr::read(folder.path().join("layers.exr")).unwrap();
    let config = &layered.attributes["skyprobe.config"];
    for part in [r#""layers":{"stars":3.0,"airglow":0.0}"#, r#""bortle":3"#, r#""star_limit":6.0"#, r#""when":"auto""#] {
        assert!(config.contains(part), "{part}: {config}");
    }
    // The header's configuration makes the picture again, as a whole.
    std::fs::write(folder.path().join("night.json"), config).unwrap();
    assert!(tool(folder.path(), &["render", "--config", "night.json", "-o", "again.exr"]).status.success());
    let again = skyprobe::io::exr::read(folder.path().join("again.exr")).unwrap();
    let total = |picture: &skyprobe::io::exr::Picture| picture.pixels.iter().map(|&value| f64::from(value)).sum::<f64>();
    assert!((total(&again) / total(&layered) - 1.0).abs() < 1e-3);
    // One way to say the light of towns takes the place of the other.
    let dump = tool(folder.path(), &["render", "--config", "night.json", "--zenith-brightness", "20", "--dump-config"]);
    let config: serde_json::Value = serde_json::from_slice(&dump.stdout).unwrap();
    assert_eq!((&config["night"]["zenith_brightness"], &config["night"]["bortle"]), (&20.0.into(), &serde_json::Value::Null));
}

#[test]
fn a_place_is_named_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let stdout = |arguments: &[&str]| {
        let answer = tool(folder.path(), arguments);
        assert_eq!(answer.status.code(), Some(0), "{}", text(&answer.stderr));
        text(&answer.stdout)
    };
    let time = ["--time", "2005-06-21T13:00"];
    let info = stdout(&[&["info", "--no-light", "--place", "lund, sweden"], &time[..]].concat());
    assert!(info.starts_with("place               Lund, Skåne, Sweden\n"), "{info}");
    assert!(
        info.contains("55.7060 deg N, 13.1930 deg E, 51 m") && info.contains("Europe/Stockholm (found from the place)"),
        "{info}"
    );
    // A minus in front is no option.
    let south = stdout(&[&["info", "--no-light", "--json", "--place", "-33.87, 151.21", "--elevation", "7"], &time[..]].concat());
    let south: serde_json::Value = serde_json::from_str(&south).unwrap();
    assert_eq!(south["place"]["label"], "Sydney, New South Wales, Australia");
    assert_eq!((&south["zone"], south["elevation_m"].as_f64()), (&"Australia/Sydney".into(), Some(7.0)));
    let probe = ["--quality", "draft", "--width", "64", "-o", "a.exr"];
    let rendered = stdout(&[&["render", "--place", "Lund, Sweden"], &time[..], &probe].concat());
    assert!(rendered.starts_with("place: Lund, Skåne, Sweden (55.706, 13.193; 51 m)\n"), "{rendered}");
    // A place given by numbers over a named one is not called by its name.
    std::fs::write(folder.path().join("lund.json"), r#"{"place": "Lund, Sweden", "time": "2005-06-21T13:00"}"#).unwrap();
    let moved = stdout(&["info", "--no-light", "--config", "lund.json", "--lat", "-55.71"]);
    assert!(moved.starts_with("place               55.7100 deg S, 13.1930 deg E"), "{moved}");
    let dumped = stdout(&["render", "--config", "lund.json", "--dump-config"]);
    assert!(dumped.contains("\"latitude\": 55.706") && !dumped.contains("\"place\""), "{dumped}");
}

#[test]
fn what_had_to_be_assumed_about_a_time_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let lund = ["--lat", "55,71", "--lon", "13,19", "--time"];
    let said = |command: &[&str], time: &str, more: &[&str]| {
        let run = tool(folder.path(), &[command, &lund[..], &[time], more].concat());
        assert!(run.status.success(), "{}", text(&run.stderr));
        (text(&run.stdout), text(&run.stderr))
    };
    for (time, taken, words) in [
        ("2005-03-27T02:30", "2005-03-27T03:30:00+02:00", "does not exist in Europe/Stockholm"),
        ("2005-10-30T02:30", "2005-10-30T02:30:00+02:00", "exists twice in Europe/Stockholm"),
        ("2005-06-21", "2005-06-21T12:00:00+02:00", "its noon"),
        ("2005-06-21 13:00:60", "2005-06-21T13:00:59+02:00", "second 60"),
    ] {
        let (report, complaint) = said(&["info", "--no-light"], time, &[]);
        assert!(report.contains(&format!("time                {taken}\n")) && report.contains(words), "{report}");
        assert_eq!(complaint, "");
        let json: serde_json::Value = serde_json::from_str(&said(&["info", "--no-light", "--json"], time, &[]).0).unwrap();
        assert!(json["time_notice"].as_str().unwrap().contains(words), "{json}");
        let (config, note) = said(&["render", "--dump-config"], time, &[]);
        assert!(note.starts_with("note: time: ") && note.contains(words) && note.lines().count() == 1, "{note}");
        assert!(config.contains(time));
    }
    let render = said(&["render", "--quality", "draft", "--width", "64", "-o", "a.hdr"], "2005-03-27T02:30", &[]);
    assert!(render.1.contains("2005-03-27T03:30:00+02:00 is taken"), "{}", render.1);
    assert_eq!(said(&["info", "--no-light", "--json"], "2005-06-21T13", &[]).1, "");
}

#[test]
fn now_is_settled_when_a_configuration_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let run = tool(folder.path(), &["render", "--place", "Tokyo", "--time", "now", "--dump-config"]);
    let config: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let time = config["time"].as_str().unwrap();
    assert!(time.starts_with("20") && time.ends_with("+09:00[Asia/Tokyo]"), "{time}");
    assert!(text(&run.stderr).contains(&format!("note: time: now is {time}")), "{}", text(&run.stderr));
}

#[test]
fn places_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let list = |arguments: &[&str]| text(&tool(folder.path(), &[&["places"], arguments].concat()).stdout);
    let portlands = list(&["portland", "--limit", "3"]);
    assert_eq!(portlands.lines().count(), 3);
    assert!(portlands.starts_with("Portland, Oregon, United States"), "{portlands}");
    assert!(list(&["portland,", "maine"]).starts_with("Portland, Maine, United States"));
    let sydney: serde_json::Value = serde_json::from_str(&list(&["--json", "-33.87", "151.21"])).unwrap();
    assert_eq!((&sydney[0]["time_zone"], &sydney[0]["name"]), (&"Australia/Sydney".into(), &serde_json::Value::Null));
}

#[test]
fn glare_reads_a_picture_writes_another_and_tells_what_it_did() {
    let folder = tempfile::tempdir().unwrap();
    let probe = [&["render"], &SUN[..], &["--width", "64", "--quality", "draft", "-o", "sky.exr", "-o", "sky.hdr"]].concat();
    assert!(tool(folder.path(), &probe).status.success());
    for arguments in [
        vec!["sky.exr", "a.exr"],
        vec!["sky.hdr", "a.hdr", "--state", "scotopic", "--all-light", "--seed", "4", "--streaks", "1"],
    ] {
        let run = tool(folder.path(), &[&["glare"], &arguments[..]].concat());
        assert!(run.status.success(), "{}", text(&run.stderr));
        let told = text(&run.stdout);
        assert!(told.contains(&format!("{}: 64 x 32, latlong; mean luminance", arguments[1])), "{told}");
        assert!(
            told.contains(if arguments.len() > 2 { "scotopic; all light glares: 2048 pixels" } else { "photopic; light above" }),
            "{told}"
        );
    }
    let run = tool(
        folder.path(),
        &["glare", "a.exr", "b.exr", "--projection", "perspective", "--fov", "60", "--threshold", "1e4", "--whole-pixels"],
    );
    assert!(text(&run.stdout).contains("perspective, 60 degrees; mean"), "{}", text(&run.stderr));
    let before = files(folder.path());
    for (arguments, part) in [
        (vec!["a.exr", "c.png"], "output = c.png: must be the name of a file that ends in .exr or .hdr"),
        (vec!["a.exr", "none/c.exr"], "output = none/c.exr: must be a file that can be written"),
        (vec!["a.jpg", "c.exr"], "input = a.jpg: must be"),
        (vec!["a.exr", "c.exr", "--state", "day"], "state = \"day\": must be auto, photopic, mesopic or scotopic"),
        (vec!["a.exr", "c.exr", "--size", "3"], "size = 3: must be"),
        (vec!["a.exr", "c.exr", "--fov", "180", "--projection", "perspective"], "field_of_view_deg = 180: must be"),
        (vec!["a.exr", "c.exr", "--threshold", "1", "--all-light"], "cannot be used with"),
    ] {
        let run = tool(folder.path(), &[&["glare"], &arguments[..]].concat());
        assert_eq!(run.status.code(), Some(2), "{arguments:?}");
        assert!(text(&run.stderr).contains(part) && text(&run.stderr).lines().count() == 1, "{}", text(&run.stderr));
    }
    std::fs::write(folder.path().join("cut.exr"), &std::fs::read(folder.path().join("a.exr")).unwrap()[..900]).unwrap();
    let run = tool(folder.path(), &["glare", "cut.exr", "c.exr"]);
    assert_eq!(run.status.code(), Some(1));
    assert!(text(&run.stderr).contains("cut.exr: not a sound OpenEXR file"), "{}", text(&run.stderr));
    assert_eq!(files(folder.path()).len(), before.len() + 1);
}

#[test]
fn the_scale_of_a_picture_is_carried_on_or_its_assumption_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let grey = [&b"#?RADIANCE\nEXPOSURE=0\n\n-Y 32 +X 64\n"[..], &[128, 128, 128, 129].repeat(64 * 32)].concat();
    std::fs::write(folder.path().join("a.hdr"), grey).unwrap();
    let run = |arguments: &[&str]| {
        let run = tool(folder.path(), arguments);
        assert!(run.status.success(), "{}", text(&run.stderr));
        (text(&run.stdout), text(&run.stderr))
    };
    let told = "white luminance unknown: 683 cd/m2 assumed (scale blender); --white-luminance or --scale says otherwise\n";
    let left_aside = "note: a.hdr: EXPOSURE=0: no factor of light, taken as 1\n";
    for command in ["glare", "tonemap"] {
        let (_, notes) = run(&[command, "a.hdr", "b.exr"]);
        assert_eq!(notes, format!("note: a.hdr: {told}{left_aside}"));
    }
    // What was assumed is not written as if it were known, in neither format.
    for glared in ["b.hdr", "b.exr"] {
        run(&["glare", "a.hdr", glared]);
        let (_, notes) = run(&["tonemap", glared, "b.png"]);
        assert_eq!(notes, format!("note: {glared}: {told}"));
    }
    for (option, value, mean) in
        [("--scale", "mitsuba", "72983.3310"), ("--scale", "luminance", "1.0000"), ("--white-luminance", "50", "50.0000")]
    {
        for glared in ["c.hdr", "c.exr"] {
            let (report, notes) = run(&["glare", "a.hdr", glared, option, value]);
            assert!(report.contains(&format!("mean luminance {mean} cd/m2")), "{report}");
            assert_eq!(notes, left_aside);
            assert_eq!(run(&["glare", glared, "d.exr"]).1, "");
            let known = skyprobe::io::read_picture(folder.path().join("d.exr"), &Default::default()).unwrap();
            assert!(!known.white_luminance_assumed && format!("{:.4}", known.white_luminance) == mean, "{known:?}");
        }
    }
    // Once for a whole sequence.
    std::fs::create_dir(folder.path().join("film")).unwrap();
    std::fs::copy(folder.path().join("a.hdr"), folder.path().join("e.hdr")).unwrap();
    assert_eq!(run(&["tonemap", "a.hdr", "e.hdr", "film"]).1, format!("note: a.hdr: {told}{left_aside}"));
    for arguments in [&["--scale", "mitsuba", "--white-luminance", "1"][..], &["--scale", "bright"]] {
        let refused = tool(folder.path(), &[&["glare", "a.hdr", "f.exr"], arguments].concat());
        assert_eq!((refused.status.code(), text(&refused.stderr).lines().count()), (Some(2), 1));
        assert!(text(&refused.stderr).contains("scale"), "{}", text(&refused.stderr));
    }
}

#[test]
fn pictures_are_brought_to_a_screen_one_by_one_all_ways_and_in_sequence() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| tool(folder.path(), &[&["tonemap"], arguments].concat());
    let made = tool(
        folder.path(),
        &[&["render"], &SUN[..], &["--quality", "draft", "--width", "64", "-o", "a.exr", "-o", "b.hdr"]].concat(),
    );
    assert!(made.status.success(), "{}", text(&made.stderr));
    let told = run(&["a.exr", "a.png"]);
    assert!(told.status.success(), "{}", text(&told.stderr));
    assert!(text(&told.stdout).starts_with("a.png: 64 x 32, sky, adapted to "), "{}", text(&told.stdout));
    for arguments in [
        &["b.hdr", "b.png", "--operator", "filmic", "--set", "contrast=2.8", "--exposure", "1", "--depth", "16"][..],
        &["a.exr", "shown.exr", "--operator", "reinhard", "--display", "linear"],
        &["a.exr", "camera.png", "--operator", "aces", "--aperture", "8", "--shutter", "0.004", "--display", "display_p3"],
        &["a.exr", "sheet.png", "--compare"],
    ] {
        let told = run(arguments);
        assert!(told.status.success(), "{arguments:?}: {}", text(&told.stderr));
    }
    assert_eq!(image::open(folder.path().join("b.png")).unwrap().color(), image::ColorType::Rgb16);
    assert_eq!(image::open(folder.path().join("a.png")).unwrap().color(), image::ColorType::Rgb8);
    let sheet = image::open(folder.path().join("sheet.png")).unwrap().to_rgb8();
    assert!(sheet.width() > 3 * 64 && sheet.height() > 3 * 32);
    let shown = skyprobe::io::read_picture(folder.path().join("shown.exr"), &Default::default()).unwrap();
    assert!(shown.pixels.iter().all(|value| (0.0..=1.0).contains(value)) && shown.white_luminance == 80.0);

    std::fs::create_dir(folder.path().join("film")).unwrap();
    assert!(run(&["a.exr", "b.hdr", "film"]).status.success());
    assert_eq!(files(&folder.path().join("film")), ["a.png", "b.png"]);

    for (arguments, part) in [
        (&["a.exr", "x.png", "--operator", "drago"][..], "operator = \"drago\": must be one of sky"),
        (&["a.exr", "x.png", "--set", "key"], "set = \"key\": must be NAME=VALUE"),
        (&["a.exr", "x.png", "--set", "white=1"], "white = 1: must be left out: the operator sky has key"),
        (&["a.exr", "x.png", "--ev", "99"], "ev100 = 99: must be"),
        (&["a.exr", "x.png", "--depth", "12"], "depth = 12: must be 8 or 16"),
        (&["a.exr", "x.exr", "--compare"], "output = x.exr: must be"),
        (&["a.exr", "x.hdr", "--display", "display_p3"], "display = display_p3: must be"),
        (&["a.exr", "b.hdr", "x.png"], "output = x.png: must be an existing folder for 2 pictures"),
        (&["a.exr", "a.exr", "film"], "input = a.exr: must be of another name"),
        (&["a.exr", ".", "--format", "exr"], "must be another file than input"),
        (&["nowhere.exr", "x.png"], "nowhere.exr"),
        (&["a.exr", "x.png", "--aperture", "8"], "--shutter"),
    ] {
        let answer = run(arguments);
        assert!(matches!(answer.status.code(), Some(1 | 2)), "{arguments:?}");
        let complaint = text(&answer.stderr);
        assert!(complaint.contains(part) && complaint.trim_end().lines().count() == 1, "{arguments:?}: {complaint}");
        assert!(!folder.path().join("x.png").exists() && !folder.path().join("x.exr").exists());
    }
}

#[test]
fn shutter_times_may_be_fractions() {
    let folder = tempfile::tempdir().unwrap();
    let done = tool(folder.path(), &[&["render", "--quality", "draft", "--width", "64", "-o", "a.exr"], &SUN[..]].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    let map = |shutter: &str, output: &str| {
        tool(folder.path(), &["tonemap", "a.exr", output, "--operator", "exposure", "--aperture", "8", "--shutter", shutter])
    };
    for (shutter, output) in [("0.004", "a.png"), ("1/250", "b.png"), ("1/250s", "c.png")] {
        let done = map(shutter, output);
        assert!(done.status.success(), "{}", text(&done.stderr));
        assert_eq!(std::fs::read(folder.path().join(output)).unwrap(), std::fs::read(folder.path().join("a.png")).unwrap());
    }
    for shutter in ["1/0", "0,004", "fast", "1/"] {
        let failed = map(shutter, "d.png");
        let complaint = text(&failed.stderr);
        assert_eq!(failed.status.code(), Some(2), "{complaint}");
        assert!(complaint.lines().count() == 1 && complaint.contains("--shutter") && complaint.contains("1/250"), "{complaint}");
    }
    assert!(!folder.path().join("d.png").exists());
}

#[test]
fn a_file_that_is_named_twice_is_written_once() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    let named = ["-o", "a.exr", "-o", "a.exr", "-o", "./a.exr", "-o", "sub/../a.exr", "-o", "b.png", "--preview", "./b.png"];
    let done = tool(folder.path(), &[&["render", "--quality", "draft", "--width", "64"], &SUN[..], &named].concat());
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert_eq!(files(folder.path()), ["a.exr", "b.png", "sub"]);
    assert_eq!(text(&done.stdout).lines().count(), 2, "{}", text(&done.stdout));
}

#[test]
fn the_sky_can_be_turned_in_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    let render = |more: &[&str]| {
        let sun = ["--sun-altitude", "5", "--sun-azimuth", "270"];
        let done = tool(folder.path(), &[&["render", "--quality", "draft", "--width", "64"], &sun[..], more].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
        text(&done.stdout)
    };
    render(&["-o", "plain.exr"]);
    render(&["--turn", "90", "-o", "turned.exr"]);
    render(&["--centre", "sun", "-o", "sun.exr"]);
    let pixels = |name: &str| skyprobe::io::read_picture(folder.path().join(name), &Default::default()).unwrap();
    let (mut plain, turned, sun) = (pixels("plain.exr"), pixels("turned.exr"), pixels("sun.exr"));
    assert_eq!((plain.turn_deg, turned.turn_deg, sun.turn_deg.abs()), (0.0, 90.0, 180.0));
    plain.pixels.chunks_exact_mut(3 * 64).for_each(|row| row.rotate_right(3 * 16));
    let close = |a: &[f32], b: &[f32]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-3 * a.abs().max(1e-2));
    assert!(close(&plain.pixels, &turned.pixels));
    plain.pixels.chunks_exact_mut(3 * 64).for_each(|row| row.rotate_right(3 * 16));
    assert!(close(&plain.pixels, &sun.pixels));
    let brightest = (0..64 * 32).max_by(|&a, &b| sun.pixels[3 * a + 1].total_cmp(&sun.pixels[3 * b + 1])).unwrap();
    assert!([31, 32].contains(&(brightest % 64)), "{}", brightest % 64);
    // The configuration that is told makes it again; without a turn it says nothing of one.
    assert!(render(&["--centre", "sun", "--dump-config"]).contains("\"turn_deg\": 180"));
    assert!(!render(&["--dump-config"]).contains("turn_deg"));
    for (more, part) in [
        (["--turn", "400"], "--turn = 400: must be a number from -360 to 360 degrees"),
        (["--centre", "venus"], "centre = \"venus\": must be sun, moon or an azimuth"),
        (["--centre", "moon"], "centre = moon: must be sun or an azimuth"),
        (["--centre", "nan"], "centre = NaN: must be"),
    ] {
        let failed = tool(folder.path(), &[&["render", "-o", "x.exr"], &SUN[..], &more].concat());
        assert!(failed.status.code() == Some(2) && text(&failed.stderr).contains(part), "{}", text(&failed.stderr));
    }
}

#[test]
fn a_quiet_tool_says_only_what_was_asked_for_and_threads_are_as_many_as_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let render =
        |more: &[&str]| tool(folder.path(), &[&["render", "--quality", "draft", "--width", "64"], &SUN[..], more].concat());
    for (threads, name) in [("1", "a.exr"), ("3", "b.exr")] {
        let done = render(&["--quiet", "--threads", threads, "-o", name]);
        assert!(done.status.success() && done.stdout.is_empty() && done.stderr.is_empty(), "{}", text(&done.stderr));
    }
    let read = |name: &str| skyprobe::io::read_picture(folder.path().join(name), &Default::default()).unwrap().pixels;
    assert_eq!(read("a.exr"), read("b.exr"));
    assert!(text(&render(&["-q", "--dump-config"]).stdout).contains("latlong"));
    assert!(!tool(folder.path(), &["--quiet", "places", "Lund"]).stdout.is_empty());
    let failed = render(&["--threads", "0", "-o", "c.exr"]);
    assert!(failed.status.code() == Some(2) && text(&failed.stderr).contains("--threads"), "{}", text(&failed.stderr));
}

#[test]
fn shells_and_man_are_told_of_every_command() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let done = tool(folder.path(), &["completions", shell]);
        let script = text(&done.stdout);
        assert!(done.status.success() && script.contains("tonemap") && script.contains("sun-azimuth"), "{shell}");
    }
    assert_eq!(tool(folder.path(), &["completions", "tcsh"]).status.code(), Some(2));
    let page = text(&tool(folder.path(), &["man"]).stdout);
    assert!(page.contains(".TH skyprobe") && page.contains("render"), "{page}");
    let page = text(&tool(folder.path(), &["man", "render"]).stdout);
    assert!(page.contains("skyprobe\\-render") && page.contains("polarising"), "{page}");
    let failed = tool(folder.path(), &["man", "sing"]);
    assert!(failed.status.code() == Some(2) && text(&failed.stderr).contains("command = \"sing\""), "{}", text(&failed.stderr));
    assert!(tool(folder.path(), &["man", "--folder", "."]).status.success());
    let pages = files(folder.path());
    for name in ["skyprobe.1", "skyprobe-render.1", "skyprobe-tonemap.1", "skyprobe-places.1"] {
        assert!(pages.contains(&name.to_owned()), "{pages:?}");
    }
}
