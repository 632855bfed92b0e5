//! What the tool does to files: no input and no output is ever destroyed, modes stay, configurations come from everywhere.
#![cfg(feature = "cli")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const SUN: [&str; 4] = ["--sun-altitude", "30", "--sun-azimuth", "340"];
const SMALL: [&str; 6] = ["--quality", "draft", "--width", "64", "--no-cache", "--no-sun-disc"];

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_skyprobe"));
    command.args(arguments).current_dir(folder).env("SKYPROBE_CACHE", "off");
    command
}

fn tool(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().expect("the tool starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// A folder with small pictures `a.exr`, `a.hdr` and `a.png`, their configuration `a.json`, and links to them.
fn pictures() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let render = [&["render"], &SUN[..], &SMALL, &["-o", "a.exr", "-o", "a.hdr", "-o", "a.png"]].concat();
    let output = tool(folder.path(), &render);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let dumped = tool(folder.path(), &[&["render"], &SUN[..], &SMALL, &["--dump-config"]].concat());
    fs::write(folder.path().join("a.json"), dumped.stdout).unwrap();
    fs::create_dir(folder.path().join("inner")).unwrap();
    for suffix in ["exr", "hdr", "png"] {
        fs::hard_link(folder.path().join(format!("a.{suffix}")), folder.path().join(format!("hard.{suffix}"))).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(format!("a.{suffix}"), folder.path().join(format!("soft.{suffix}"))).unwrap();
    }
    folder
}

/// All files of a folder with their content.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let read = |name: String| folder.join(&name).is_file().then(|| (name.clone(), fs::read(folder.join(&name)).unwrap()));
    files(folder).into_iter().filter_map(read).collect()
}

#[test]
fn no_command_writes_over_what_it_reads_or_writes() {
    let folder = pictures();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    // Configurations under the suffixes of pictures.
    for name in ["c.png", "c.exr", "c.hdr"] {
        fs::copy(folder.path().join("a.json"), folder.path().join(name)).unwrap();
    }
    let absolute = [at("a.hdr"), at("c.png")];
    let before = contents(folder.path());
    let mut cases: Vec<Vec<&str>> = vec![
        vec!["tonemap", "a.hdr", "a.hdr"],
        vec!["tonemap", "a.exr", "./inner/../a.exr"],
        vec!["tonemap", "a.hdr", &absolute[0]],
        vec!["tonemap", "a.hdr", "hard.hdr"],
        vec!["tonemap", "hard.exr", "a.exr"],
        vec!["tonemap", "a.exr", "a.hdr", ".", "--format", "hdr"],
        vec!["tonemap", "a.exr", "a.hdr", "."],
        vec!["tonemap", "a.exr", ".", "--format", "exr"],
        vec!["glare", "a.exr", "a.exr"],
        vec!["glare", "a.hdr", "hard.hdr"],
        vec!["render", "--config", "c.png", "-o", "c.png"],
        vec!["render", "--config", "c.png", "-o", "b.exr", "-o", &absolute[1]],
        vec!["render", "--config", "c.png", "--preview", "./c.png"],
        vec!["render", "--config", "c.png", "--sample-map", "c.png"],
        vec!["render", "--config", "c.exr", "-o", "c.exr"],
        vec!["render", "--config", "a.exr", "-o", "a.exr"],
        vec!["render", "--config", "a.hdr", "-o", "hard.hdr"],
        vec!["render", "--config", "a.json", "-o", "s.png", "--sample-map", "s.png"],
        vec!["render", "--config", "a.json", "-o", "s.png", "--sample-map", "./inner/../s.png"],
        vec!["render", "--config", "a.json", "--preview", "s.png", "--sample-map", "s.png"],
    ];
    if cfg!(unix) {
        cases.push(vec!["tonemap", "a.hdr", "soft.hdr"]);
        cases.push(vec!["tonemap", "soft.exr", "hard.exr"]);
        cases.push(vec!["glare", "soft.exr", "a.exr"]);
    }
    for arguments in cases {
        let output = tool(folder.path(), &arguments);
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {complaint}");
        assert!(complaint.contains("another file than") || complaint.contains("another name"), "{arguments:?}: {complaint}");
        assert_eq!(complaint.lines().count(), 1);
        assert!(contents(folder.path()) == before, "{arguments:?}");
    }
}

/// A shell that appends what is told to an input, or puts it where an output goes.
#[cfg(unix)]
#[test]
fn what_is_told_is_not_written_over_a_file_of_the_command() {
    let folder = pictures();
    fs::write(folder.path().join("b.exr"), "").unwrap();
    let before = contents(folder.path());
    for (arguments, to) in [
        (vec!["info", "--config", "a.json", "--no-light"], "a.json"),
        (vec!["render", "--config", "a.json", "--dump-config"], "a.json"),
        (vec!["info", "--config", "a.json", "--dump-config"], "a.json"),
        (vec!["render", "--config", "a.exr", "--dump-config"], "a.exr"),
        (vec!["render", "--config", "a.json", "-o", "b.exr"], "b.exr"),
        (vec!["render", "--config", "a.json", "-o", "b.exr"], "a.json"),
        (vec!["glare", "a.exr", "b.exr"], "a.exr"),
        (vec!["tonemap", "a.exr", "new.png"], "hard.exr"),
        (vec!["tonemap", "a.exr", "b.exr"], "b.exr"),
    ] {
        let out = fs::OpenOptions::new().append(true).open(folder.path().join(to)).unwrap();
        let output = command(folder.path(), &arguments).stdout(out).stderr(std::process::Stdio::piped()).output().unwrap();
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {complaint}");
        assert!(complaint.contains("standard output = -: must be another file"), "{complaint}");
        assert!(contents(folder.path()) == before, "{arguments:?}");
    }
    // The standard input, too.
    let input = fs::File::open(folder.path().join("a.exr")).unwrap();
    let output = command(folder.path(), &["render", "--config", "-", "-o", "a.exr"]).stdin(input).output().unwrap();
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert!(contents(folder.path()) == before);
}

#[test]
fn a_file_that_is_named_twice_is_written_once() {
    let folder = tempfile::tempdir().unwrap();
    let twice = ["-o", "a.hdr", "-o", "./a.hdr", "-o", "b.hdr"];
    let output = tool(folder.path(), &[&["render"], &SUN[..], &SMALL, &twice].concat());
    assert_eq!((output.status.code(), text(&output.stderr).as_str()), (Some(0), ""));
    assert_eq!(files(folder.path()), ["a.hdr", "b.hdr"]);
}

#[cfg(unix)]
#[test]
fn what_is_replaced_keeps_its_mode_and_what_is_read_only_stays() {
    use std::os::unix::fs::PermissionsExt;
    let folder = pictures();
    let set = |name: &str, mode: u32| {
        fs::set_permissions(folder.path().join(name), fs::Permissions::from_mode(mode)).unwrap();
    };
    let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().permissions().mode() & 0o777;
    for name in ["x.exr", "x.hdr", "x.png", "y.png"] {
        fs::write(folder.path().join(name), "old").unwrap();
    }
    let commands: [(&[&str], &[&str]); 5] = [
        (&["render", "--config", "a.json", "-o", "x.exr", "-o", "x.hdr", "--preview", "x.png"], &["x.exr", "x.hdr", "x.png"]),
        (&["render", "--config", "a.json", "-o", "x.exr", "--sample-map", "y.png"], &["x.exr", "y.png"]),
        (&["glare", "a.exr", "x.hdr"], &["x.hdr"]),
        (&["tonemap", "a.exr", "x.png"], &["x.png"]),
        (&["tonemap", "a.exr", "y.png", "--compare"], &["y.png"]),
    ];
    for (arguments, outputs) in commands {
        for wanted in [0o600, 0o664] {
            outputs.iter().for_each(|name| set(name, wanted));
            let output = tool(folder.path(), arguments);
            assert!(output.status.success(), "{arguments:?}: {}", text(&output.stderr));
            outputs.iter().for_each(|name| assert_eq!(mode(name), wanted, "{arguments:?}"));
        }
        let before = contents(folder.path());
        // The last of them, so that nothing of the others is written either.
        let last = outputs[outputs.len() - 1];
        set(last, 0o444);
        let output = tool(folder.path(), arguments);
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {complaint}");
        assert!(complaint.contains(&format!("= {last}: must be a file that can be written (is read-only)")), "{complaint}");
        assert!(contents(folder.path()) == before && mode(last) == 0o444, "{arguments:?}");
    }
}

#[test]
fn manual_pages_are_written_all_or_none() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for (name, blocked) in
        [("skyprobe.1", "is read-only"), ("skyprobe-tonemap.1", "is read-only"), ("skyprobe-info.1", "directory")]
    {
        if blocked == "directory" {
            fs::create_dir(at(name)).unwrap();
        } else {
            fs::write(at(name), "old").unwrap();
            let mut permissions = fs::metadata(at(name)).unwrap().permissions();
            permissions.set_readonly(true);
            fs::set_permissions(at(name), permissions).unwrap();
        }
        let output = tool(folder.path(), &["man", "--folder", "."]);
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {complaint}");
        assert!(complaint.contains(name) && complaint.contains(blocked), "{name}: {complaint}");
        assert_eq!(files(folder.path()), [name]);
        if blocked == "directory" {
            fs::remove_dir(at(name)).unwrap();
        } else {
            assert_eq!(fs::read_to_string(at(name)).unwrap(), "old");
            fs::remove_file(at(name)).unwrap();
        }
    }
    fs::write(at("skyprobe.1"), "old").unwrap();
    assert!(tool(folder.path(), &["man", "--folder", "."]).status.success());
    let pages = ["completions", "glare", "info", "man", "places", "render", "schema", "tonemap"];
    let mut names: Vec<String> = pages.iter().map(|name| format!("skyprobe-{name}.1")).collect();
    names.push("skyprobe.1".to_owned());
    assert_eq!(files(folder.path()), names);
    assert!(names.iter().all(|name| fs::read_to_string(at(name)).unwrap().contains(".SH OPTIONS")));
}

/// Names of files, and what they say, are others': none of it is a command to the terminal.
#[cfg(unix)]
#[test]
fn a_terminal_gets_no_commands_of_files() {
    let folder = pictures();
    let name = "\u{1b}]0;title\u{7}\u{9b}2J.hdr";
    fs::copy(folder.path().join("a.hdr"), folder.path().join(name)).unwrap();
    fs::write(folder.path().join("key.json"), "{\"\\u001b[31m\\u009b\": {\"a\": 1, \"a\": 2}}").unwrap();
    fs::write(folder.path().join("unknown.json"), "{\"\\u001b[31m\\u009b\": 3}").unwrap();
    fs::write(folder.path().join("word.json"), "{\"atmosphere\": {\"aerosol\": \"\\u001b[31m\\u009b\"}}").unwrap();
    for (arguments, code) in [
        (vec!["tonemap", name, name], 2),
        (vec!["tonemap", "a.exr", name], 0),
        (vec!["render", "--config", "\u{1b}[2J.json"], 2),
        (vec!["info", "--config", "key.json"], 2),
        (vec!["info", "--config", "unknown.json"], 2),
        (vec!["info", "--config", "word.json"], 2),
    ] {
        let output = tool(folder.path(), &arguments);
        let told = text(&output.stdout) + &text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{told:?}");
        assert!(!told.is_empty() && !told.chars().any(|letter| letter.is_control() && letter != '\n'), "{told:?}");
    }
}

#[test]
fn configurations_come_from_text_of_any_mark_from_pipes_and_from_pictures() {
    let folder = pictures();
    let config = fs::read_to_string(folder.path().join("a.json")).unwrap();
    let wide: Vec<u8> = config.encode_utf16().flat_map(u16::to_le_bytes).collect();
    fs::write(folder.path().join("mark.json"), [b"\xef\xbb\xbf", config.as_bytes()].concat()).unwrap();
    fs::write(folder.path().join("wide.json"), [&b"\xff\xfe"[..], &wide].concat()).unwrap();
    let dump = ["render", "--dump-config", "--config"];
    for name in ["mark.json", "wide.json", "a.exr", "a.hdr"] {
        let output = tool(folder.path(), &[&dump[..], &[name]].concat());
        assert!(output.status.success(), "{name}: {}", text(&output.stderr));
        let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let mut expected: serde_json::Value = serde_json::from_str(&config).unwrap();
        // The header holds what the picture was made from, not the names of files.
        expected.as_object_mut().unwrap().remove("file");
        let mut found = found.as_object().unwrap().clone();
        found.remove("file");
        assert_eq!(serde_json::Value::Object(found), expected, "{name}");
    }
    // A picture of the same light, from its own header alone.
    for name in ["a.exr", "a.hdr"] {
        let output = tool(folder.path(), &["render", "--config", name, "--no-cache", "-o", "again.exr"]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(fs::read(folder.path().join("again.exr")).unwrap() == fs::read(folder.path().join("a.exr")).unwrap(), "{name}");
    }
    for name in ["a.json", "a.exr", "a.hdr"] {
        let input = fs::File::open(folder.path().join(name)).unwrap();
        let output = command(folder.path(), &[&dump[..], &["-"]].concat()).stdin(input).output().unwrap();
        assert!(output.status.success(), "{name}: {}", text(&output.stderr));
    }
}

#[test]
fn errors_of_configurations_name_file_and_key() {
    let folder = pictures();
    for (name, content, parts) in [
        (
            "twice.json",
            &br#"{"elevation_m": 1, "elevation_m": 2}"#[..],
            &["elevation_m = 1 and 2", "given once", "twice.json"][..],
        ),
        ("inner.json", br#"{"night": {"bortle": 3, "bortle": 3}}"#, &["night.bortle = 3 and 3", "inner.json"]),
        (
            "deep.json",
            br#"{"atmosphere": {"components": [{"kind": "urban", "kind": "urban"}]}}"#,
            &["atmosphere.components.0.kind", "deep.json"],
        ),
        ("unknown.json", br#"{"atmosphere": {"turbidty": 3}}"#, &["unknown key atmosphere.turbidty = 3", "unknown.json"]),
        ("range.json", br#"{"probe": {"width": 3}}"#, &["probe.width = 3", "range.json"]),
        ("broken.json", b"{\n \"latitude\": }", &["config = broken.json: must be JSON (", "line 2"]),
        ("empty.json", b"", &["config = empty.json: must be JSON (EOF"]),
        ("latin.json", b"{\"place\": \"Malm\xf6\"}", &["config = latin.json", "UTF-8"]),
        ("other.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n1234", &["config = other.hdr", "this one has none"]),
    ] {
        fs::write(folder.path().join(name), content).unwrap();
        let output = tool(folder.path(), &["info", "--config", name]);
        let complaint = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {complaint}");
        assert!(parts.iter().all(|part| complaint.contains(part)), "{name}: {complaint}");
        assert_eq!(complaint.lines().count(), 1, "{complaint}");
    }
    let output = tool(folder.path(), &["info", "--config", "a.png"]);
    assert!(text(&output.stderr).contains("a PNG does not hold its configuration"), "{}", text(&output.stderr));
}
