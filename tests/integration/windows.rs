//! The command line tool on Windows: its paths, its names, its locks. `.ci/windows.sh` runs this under Wine.
#![cfg(all(windows, feature = "cli"))]

use std::fs::{self, OpenOptions};
use std::os::windows::fs::OpenOptionsExt;
use std::path::Path;
use std::process::{Command, Output};

const SKY: [&str; 9] = ["render", "--sun-altitude", "30", "--sun-azimuth", "-20", "--quality", "draft", "--width", "64"];
/// What a program that has a file open lets others do with it: read it; or read, write, delete and so replace it.
const SHARE_READ: u32 = 1;
const SHARE_ALL: u32 = 7;

fn tool(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_skyprobe"));
    command.args(arguments).current_dir(folder).env("SKYPROBE_CACHE", "off").output().expect("the tool starts")
}

fn render(folder: &Path, outputs: &[&str]) -> Output {
    let named: Vec<&str> = outputs.iter().flat_map(|output| ["-o", output]).collect();
    tool(folder, &[&SKY, &named[..]].concat())
}

fn complaint(output: &Output) -> String {
    assert_ne!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stderr.clone()).expect("UTF-8");
    assert_eq!(text.lines().count(), 1, "{text}");
    assert!(!text.contains("panicked"), "{text}");
    text
}

fn succeeded(output: &Output) {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn paths_have_backslashes_drives_and_verbatim_prefixes() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("deep")).unwrap();
    let absolute = folder.path().join("deep").join("absolute.hdr");
    assert_eq!(absolute.to_str().unwrap().as_bytes()[1], b':', "a drive");
    let verbatim = fs::canonicalize(folder.path()).unwrap().join("verbatim.png");
    assert!(verbatim.to_str().unwrap().starts_with(r"\\?\"));
    let outputs =
        [r"deep\back.exr", "deep/forward.exr", r"deep\..\up.exr", absolute.to_str().unwrap(), verbatim.to_str().unwrap()];
    succeeded(&render(folder.path(), &outputs));
    assert_eq!(names(folder.path()), ["deep", "up.exr", "verbatim.png"]);
    assert_eq!(names(&folder.path().join("deep")), ["absolute.hdr", "back.exr", "forward.exr"]);
    // One file by two spellings is written once.
    succeeded(&render(folder.path(), &[r"deep\one.exr", "DEEP/ONE.exr"]));
    assert_eq!(names(&folder.path().join("deep")), ["absolute.hdr", "back.exr", "forward.exr", "one.exr"]);
    assert!(complaint(&render(folder.path(), &[r"missing\a.exr"])).contains("there is no folder missing"));
}

#[test]
fn names_may_be_in_any_script_and_texts_are_utf_8() {
    let folder = tempfile::tempdir().unwrap();
    let deep = folder.path().join("Räksmörgås 空");
    fs::create_dir(&deep).unwrap();
    succeeded(&render(&deep, &["himmel ☀.exr", "ciel d'été.png"]));
    assert_eq!(names(&deep), ["ciel d'été.png", "himmel ☀.exr"]);
    let found = tool(&deep, &["places", "Århus", "--limit", "1"]);
    succeeded(&found);
    assert!(String::from_utf8(found.stdout).expect("UTF-8").contains("Århus"));
    assert!(complaint(&render(&deep, &["ö\\a.exr"])).contains('ö'));
    succeeded(&tool(&deep, &["tonemap", "himmel ☀.exr", "fertig ☾.png"]));
    fs::write(deep.join("välj.json"), "\u{feff}{\"sun\": {\"altitude_deg\": 30, \"azimuth_deg\": 10}}").unwrap();
    succeeded(&tool(&deep, &["render", "--config", "välj.json", "--quality", "draft", "--width", "64", "-o", "aus välj.exr"]));
}

#[test]
fn names_of_devices_and_names_that_windows_changes_are_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["NUL.exr", "nul.png", "con.hdr", "AUX.exr", "com1.exr", r".\LPT9.exr", "sky.exr:stream.exr", "what?.exr"] {
        let text = complaint(&render(folder.path(), &[name, "sound.exr"]));
        assert!(text.contains(name.trim_start_matches(r".\")), "{text}");
        assert!(names(folder.path()).is_empty(), "{name}: {:?}", names(folder.path()));
    }
}

#[test]
fn a_file_that_another_program_holds_stays_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("sky.exr");
    for shared in [0, SHARE_READ] {
        fs::write(&target, "before").unwrap();
        let held = OpenOptions::new().read(true).share_mode(shared).open(&target).unwrap();
        let text = complaint(&render(folder.path(), &["sky.exr", "other.png"]));
        assert!(text.contains("sky.exr"), "{text}");
        drop(held);
        assert_eq!(fs::read_to_string(&target).unwrap(), "before");
        assert_eq!(names(folder.path()), ["sky.exr"]);
    }
    // One that would allow it to be replaced: newer systems do so, and it keeps what it has opened; others refuse, and nothing has changed.
    let mut held = OpenOptions::new().read(true).share_mode(SHARE_ALL).open(&target).unwrap();
    let outcome = render(folder.path(), &["sky.exr"]);
    let mut old = String::new();
    std::io::Read::read_to_string(&mut held, &mut old).unwrap();
    assert_eq!(old, "before");
    drop(held);
    if !outcome.status.success() {
        assert!(complaint(&outcome).contains("sky.exr"));
        assert_eq!(fs::read_to_string(&target).unwrap(), "before");
        succeeded(&render(folder.path(), &["sky.exr"]));
    }
    assert!(fs::metadata(&target).unwrap().len() > 1000);
    assert_eq!(names(folder.path()), ["sky.exr"]);
}

#[test]
fn read_only_files_are_kept_and_whole_files_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("sky.hdr");
    fs::write(&target, "before").unwrap();
    let mut permissions = fs::metadata(&target).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&target, permissions.clone()).unwrap();
    assert!(complaint(&render(folder.path(), &["sky.hdr"])).contains("read-only"));
    assert_eq!(fs::read_to_string(&target).unwrap(), "before");
    #[expect(clippy::permissions_set_readonly_false, reason = "Windows has no others to give it to")]
    permissions.set_readonly(false);
    fs::set_permissions(&target, permissions).unwrap();
    succeeded(&render(folder.path(), &["sky.hdr"]));
    succeeded(&render(folder.path(), &["SKY.HDR"]));
    assert_eq!(names(folder.path()).len(), 1);
    assert!(fs::read(&target).unwrap().starts_with(b"#?RADIANCE"));
}

#[test]
fn solved_light_lies_among_the_user_s_local_data() {
    let folder = tempfile::tempdir().unwrap();
    let run = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_skyprobe"));
        command.args(["info", "--json", "--sun-altitude", "30", "--sun-azimuth", "0"]).current_dir(folder.path());
        command.env_remove("SKYPROBE_CACHE").env_remove("SKYPROBE_CACHE_DIR").env("LOCALAPPDATA", folder.path());
        let output = command.output().unwrap();
        succeeded(&output);
        output.stdout
    };
    let first = run();
    assert_eq!(names(&folder.path().join("skyprobe")).len(), 1);
    assert_eq!(run(), first);
}
