//! The command line tool as a user runs it: exit codes, one line of complaint, files whole or not at all.
#![cfg(feature = "cli")]

use std::path::Path;
use std::process::{Command, Output, Stdio};

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
    std::fs::write(folder.path().join("broken.json"), "{\n \"latitude\": }").unwrap();
    let before = files(folder.path());
    let place = ["--lat", "55.71", "--lon", "-76.5", "--time", "2005-06-21T13:00Z"];
    let with = |base: &[&'static str], more: &[&'static str]| [&["render"], base, more].concat();
    for (arguments, part) in [
        (vec!["render", "--lat", "91", "--lon", "0", "--time", "2005-06-21T13:00Z", "-o", "a.exr"], "latitude = 91: must be"),
        (vec!["render", "--lat", "NaN", "--lon", "0", "--time", "2005-06-21T13:00Z", "-o", "a.exr"], "latitude = NaN: must be"),
        (vec!["render", "--lat", "1", "--lon", "0", "--time", "yesterday", "-o", "a.exr"], "time = \"yesterday\": must be"),
        (vec!["render", "--lat", "1", "-o", "a.exr"], "longitude = nothing: must be given"),
        (vec!["render", "--lat", "north"], "--latitude"),
        (vec!["render", "--lat", "1", "--sun-altitude", "3", "--sun-azimuth", "3", "-o", "a.exr"], "cannot be used with"),
        (with(&SUN, &["--turbidity", "-1", "-o", "a.exr"]), "turbidity = -1: must be a number from 1 to 64"),
        (with(&SUN, &["--turbidity", "inf", "-o", "a.exr"]), "turbidity = inf: must be"),
        (with(&SUN, &["--turbidity", "2", "--aod550", "0.1", "-o", "a.exr"]), "cannot be used with"),
        (with(&SUN, &["--width", "0", "-o", "a.exr"]), "width = 0: must be a number from 64 to 16384 pixels"),
        (with(&SUN, &["--width", "-4", "-o", "a.exr"]), "width = -4: must be"),
        (with(&SUN, &["--scale", "nits", "-o", "a.exr"]), "scale = \"nits\": must be"),
        (with(&SUN, &["--exposure", "nan", "-o", "a.png"]), "exposure_stops = NaN: must be"),
        (
            with(&SUN, &["--polarising-filter", "2", "-o", "a.exr"]),
            "polarising_filter.strength = 2: must be a number from 0 to 1",
        ),
        (with(&SUN, &["--filter-angle", "20", "-o", "a.exr"]), "polarising_filter = nothing: must be given"),
        (with(&SUN, &["--polarising-filter", "1", "--filter-towards", "20", "-o", "a.exr"]), "filter_towards = 1 numbers"),
        (with(&SUN, &["--no-polarisation", "--polarising-filter", "1", "-o", "a.exr"]), "polarisation = false: must be true"),
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
            .stderr(Stdio::piped())
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
