//! The tool is stopped at any moment: nothing half-written is left, nothing that is done is called cancelled, and what a killed process left is cleaned.
//!
//! Alone in its file, because it interrupts at moments that it measured in an undisturbed run: other tests beside it would shift them.
#![cfg(all(feature = "cli", unix))]

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const SUN: [&str; 4] = ["--sun-altitude", "30", "--sun-azimuth", "-20"];

fn start(folder: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_skyprobe"));
    command.args(arguments).current_dir(folder).env("SKYPROBE_CACHE_DIR", cache());
    command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("the tool starts")
}

/// So that work is soon past the solve.
fn cache() -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("cache_of_signals")
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn unfinished(folder: &Path) -> Vec<String> {
    files(folder).into_iter().filter(|name| name.ends_with(".part")).collect()
}

fn signal(child: &Child, name: &str) {
    // It may have ended by itself.
    let _ = Command::new("kill").args([name, &child.id().to_string()]).stderr(Stdio::null()).status().unwrap();
}

/// A Radiance picture with a bright spot on an uneven ground, that cannot be worked on in a moment.
fn picture(path: &Path, width: usize) {
    let mut file = std::io::BufWriter::new(fs::File::create(path).unwrap());
    let header = "#?RADIANCE\nskyprobe.projection=latlong\nskyprobe.scale=blender\nFORMAT=32-bit_rle_rgbe\n\n";
    writeln!(file, "{header}-Y {} +X {width}", width / 2).unwrap();
    let mut seed = 1u32;
    for y in 0..width / 2 {
        for x in 0..width {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let [red, green, blue, _] = seed.to_be_bytes();
            let exponent = if (x, y) == (width / 3, width / 5) { 145 } else { 120 };
            // Not the beginning of a run.
            file.write_all(&[red | 128, green | 4, blue, exponent]).unwrap();
        }
    }
}

/// At moments all over the run of a command: exit code 130 and nothing but what was there, or 0 and all outputs; soon.
fn interrupted_anywhere(inputs: impl Fn(&Path), arguments: &[&str], outputs: &[&str], moments: u32) {
    let folder = tempfile::tempdir().unwrap();
    inputs(folder.path());
    let before = files(folder.path());
    let begun = Instant::now();
    assert!(start(folder.path(), arguments).wait().unwrap().success(), "{arguments:?}");
    let whole = begun.elapsed();
    let mut all = before.clone();
    all.extend(outputs.iter().map(|&name| name.to_owned()));
    all.sort();
    assert_eq!(files(folder.path()), all, "{arguments:?}");
    let mut cancelled = 0;
    for moment in 0..moments {
        outputs.iter().for_each(|name| fs::remove_file(folder.path().join(name)).unwrap_or(()));
        let mut child = start(folder.path(), arguments);
        // From the first milliseconds, in which no handler is there yet, to nearly the end.
        std::thread::sleep(Duration::from_millis(30) + whole.mul_f64(0.97 * f64::from(moment) / f64::from(moments)));
        signal(&child, ["-INT", "-TERM"][moment as usize % 2]);
        let code = child.wait().unwrap().code();
        match code {
            Some(130) => {
                cancelled += 1;
                assert_eq!(files(folder.path()), before, "{arguments:?} {moment}");
            }
            Some(0) => assert_eq!(files(folder.path()), all, "{arguments:?} {moment}"),
            _ => panic!("{arguments:?} {moment}: {code:?}"),
        }
    }
    assert!(cancelled > moments / 2, "{arguments:?}: {cancelled}");
}

#[test]
fn a_render_is_interrupted_in_every_stage() {
    let outputs = ["a.exr", "a.hdr", "a.png", "map.png"];
    let render = ["render", "--quality", "draft", "--width", "3072", "-o", "a.exr", "-o", "a.hdr", "-o", "a.png"];
    interrupted_anywhere(|_| {}, &[&render[..], &SUN, &["--sample-map", "map.png"]].concat(), &outputs, 8);
    let half = ["render", "--quality", "draft", "--width", "3072", "--half=scale", "-o", "a.exr"];
    interrupted_anywhere(|_| {}, &[&half[..], &SUN].concat(), &["a.exr"], 4);
}

#[test]
fn a_solve_is_interrupted() {
    interrupted_anywhere(|_| {}, &[&["info", "--quality", "standard", "--no-cache"], &SUN[..]].concat(), &[], 4);
}

#[test]
fn tone_mapping_is_interrupted_in_every_stage() {
    let input = |folder: &Path| picture(&folder.join("in.hdr"), 3072);
    for (operator, output) in [("sky", "a.png"), ("ashikhmin", "a.exr"), ("reinhard_local", "a.hdr")] {
        interrupted_anywhere(input, &["tonemap", "in.hdr", output, "--operator", operator], &[output], 4);
    }
    interrupted_anywhere(input, &["tonemap", "in.hdr", "a.png", "--compare"], &["a.png"], 4);
}

#[test]
fn glare_is_interrupted_in_every_stage() {
    let input = |folder: &Path| picture(&folder.join("in.hdr"), 1024);
    let scotopic = ["glare", "in.hdr", "a.exr", "--state", "scotopic", "--projection", "perspective"];
    interrupted_anywhere(input, &scotopic, &["a.exr"], 5);
    // Quicker: of a small picture it would be done before the handler is there.
    let large = |folder: &Path| picture(&folder.join("in.hdr"), 3072);
    interrupted_anywhere(large, &["glare", "in.hdr", "a.hdr", "--threshold", "1000"], &["a.hdr"], 4);
}

/// Pictures that a sequence has finished stay: each is whole.
#[test]
fn an_interrupted_sequence_leaves_whole_pictures_only() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("film")).unwrap();
    let names: Vec<String> = (0..12).map(|k| format!("{k:02}.hdr")).collect();
    picture(&folder.path().join(&names[0]), 1024);
    for name in &names[1..] {
        fs::copy(folder.path().join(&names[0]), folder.path().join(name)).unwrap();
    }
    let arguments: Vec<&str> = ["tonemap"].into_iter().chain(names.iter().map(String::as_str)).chain(["film"]).collect();
    let mut child = start(folder.path(), &arguments);
    let film = folder.path().join("film");
    while files(&film).iter().filter(|name| name.ends_with(".png")).count() < 2 && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    signal(&child, "-INT");
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let left = files(&film);
    assert!((2..12).contains(&left.len()), "{left:?}");
    assert!(left.iter().all(|name| image::open(film.join(name)).is_ok()), "{left:?}");
}

/// While a picture of a sequence is read, those before it are there and the sequence is not done: one signal ends it at once, two do not make it a success.
#[test]
fn a_sequence_that_is_interrupted_while_it_reads_is_not_done() {
    let folder = tempfile::tempdir().unwrap();
    let film = folder.path().join("film");
    picture(&folder.path().join("0.hdr"), 64);
    let read = fs::read(folder.path().join("0.hdr")).unwrap();
    // Says no scale: what is assumed is told while it is read, and nobody listens.
    let at = read.windows(2).position(|pair| pair == b"\n\n").unwrap();
    let header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe";
    fs::write(folder.path().join("1.hdr"), [header, &read[at..]].concat()).unwrap();
    fs::copy(folder.path().join("0.hdr"), folder.path().join("2.hdr")).unwrap();
    for signals in [1, 2] {
        let _ = fs::remove_dir_all(&film);
        fs::create_dir(&film).unwrap();
        let (unread, full) = std::io::pipe().unwrap();
        let mut filler = full.try_clone().unwrap();
        let filling = std::thread::spawn(move || while filler.write_all(&[b' '; 4096]).is_ok() {});
        // Until it is full.
        std::thread::sleep(Duration::from_millis(100));
        let mut command = Command::new(env!("CARGO_BIN_EXE_skyprobe"));
        command.args(["tonemap", "0.hdr", "1.hdr", "2.hdr", "film"]).current_dir(folder.path());
        let mut child = command.stdout(Stdio::null()).stderr(full).spawn().expect("the tool starts");
        drop(command);
        while files(&film) != ["0.png"] && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(2));
        }
        // Until it wants to tell what it assumed.
        std::thread::sleep(Duration::from_millis(500));
        (0..signals).for_each(|_| {
            signal(&child, "-INT");
            std::thread::sleep(Duration::from_millis(50));
        });
        let begun = Instant::now();
        while child.try_wait().unwrap().is_none() {
            if begun.elapsed() > Duration::from_secs(20) {
                signal(&child, "-KILL");
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        assert_eq!(child.wait().unwrap().code(), Some(130), "{signals}");
        assert_eq!(files(&film), ["0.png"], "{signals}");
        drop(unread);
        filling.join().unwrap();
    }
}

#[test]
fn a_second_signal_ends_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["render", "--quality", "reference", "--width", "8192", "--no-cache", "-o", "a.exr"];
    for _ in 0..4 {
        let mut child = start(folder.path(), &[&arguments[..], &SUN].concat());
        std::thread::sleep(Duration::from_millis(150));
        signal(&child, "-INT");
        signal(&child, "-INT");
        assert_eq!(child.wait().unwrap().code(), Some(130));
        assert!(files(folder.path()).is_empty());
    }
}

#[test]
fn what_a_killed_process_left_is_cleaned_by_the_next_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let long = [&["render", "--quality", "draft", "--width", "8192", "-o", "long.exr"], &SUN[..]].concat();
    let started = || {
        let known = unfinished(folder.path());
        let child = start(folder.path(), &long);
        while unfinished(folder.path()).iter().all(|name| known.contains(name)) {
            std::thread::sleep(Duration::from_millis(1));
        }
        // The first is only the check before any work.
        std::thread::sleep(Duration::from_millis(30));
        while unfinished(folder.path()).iter().all(|name| known.contains(name)) {
            std::thread::sleep(Duration::from_millis(1));
        }
        child
    };
    let mut killed = started();
    signal(&killed, "-KILL");
    assert_eq!(killed.wait().unwrap().code(), None);
    let left = unfinished(folder.path());
    assert!(!left.is_empty());
    fs::create_dir(at(".skyprobe-folder.part")).unwrap();
    assert!(Command::new("mkfifo").arg(at(".skyprobe-pipe.part")).status().unwrap().success());
    let mut living = started();
    assert!(left.iter().all(|name| !at(name).exists()), "{:?}", files(folder.path()));
    // Others come and go meanwhile.
    picture(&at("in.hdr"), 64);
    assert!(start(folder.path(), &["tonemap", "in.hdr", "out.png"]).wait().unwrap().success());
    assert!(living.wait().unwrap().success());
    assert_eq!(files(folder.path()), [".skyprobe-folder.part", ".skyprobe-pipe.part", "in.hdr", "long.exr", "out.png"]);
}
