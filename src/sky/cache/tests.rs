use super::*;
use std::collections::HashMap;

fn key(text: &str) -> Key {
    let mut builder = KeyBuilder::of_this_solver();
    builder.text(text);
    builder.finish()
}

fn sections() -> Vec<Vec<f32>> {
    vec![vec![1.0, -2.5e-30, f32::MIN_POSITIVE], vec![], (0..1000).map(|k| k as f32).collect()]
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    found
}

#[test]
fn what_is_stored_comes_back_for_its_key_only() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::new(folder.path().join("made/when/needed"), 1 << 20);
    assert!(cache.load(&key("a")).is_none());
    cache.store(&key("a"), &sections());
    assert_eq!(cache.load(&key("a")), Some(sections()));
    assert!(cache.load(&key("b")).is_none());
    cache.store(&key("a"), &[vec![7.0]]);
    assert_eq!(cache.load(&key("a")), Some(vec![vec![7.0]]));
    assert_eq!(files(&cache.folder).len(), 1);
}

#[test]
fn keys_differ_by_every_bit_and_by_what_belongs_together() {
    let of = |texts: &[&str], numbers: &[&[f64]]| {
        let mut builder = KeyBuilder::of_this_solver();
        texts.iter().for_each(|text| builder.text(text));
        numbers.iter().for_each(|values| builder.numbers(values));
        builder.finish()
    };
    let different = [
        of(&["ab"], &[]),
        of(&["a", "b"], &[]),
        of(&["ab"], &[&[]]),
        of(&["ab"], &[&[1.0, 2.0]]),
        of(&["ab"], &[&[1.0], &[2.0]]),
        of(&["ab"], &[&[1.0], &[2.0 + 4.0 * f64::EPSILON]]),
        of(&["ab"], &[&[0.0]]),
        of(&["ab"], &[&[-0.0]]),
    ];
    for (k, one) in different.iter().enumerate() {
        assert!(different[k + 1..].iter().all(|other| one != other), "{k}");
    }
    assert_eq!(of(&["ab"], &[&[1.0]]), of(&["ab"], &[&[1.0]]));
}

#[test]
fn damaged_cut_and_foreign_files_are_not_believed() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::new(folder.path(), 1 << 20);
    cache.store(&key("a"), &sections());
    let path = files(folder.path()).remove(0);
    let sound = fs::read(&path).unwrap();
    let loads = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        cache.load(&key("a")).is_some()
    };
    for at in [0, 7, 8, 39, 40, 48, 60, 72, 200, sound.len() - 33, sound.len() - 1] {
        let mut bytes = sound.clone();
        bytes[at] ^= 1;
        assert!(!loads(&bytes), "byte {at}");
    }
    for length in [0, 5, 31, 32, 40, 48, 71, 80, sound.len() / 2, sound.len() - 1] {
        assert!(!loads(&sound[..length]), "{length} bytes");
    }
    assert!(!loads(&[&sound[..], &[0]].concat()));
    assert!(!loads(b"something else"));
    // A sound file under another key's name.
    let mut other = sound.clone();
    other[8..40].copy_from_slice(&key("b").0);
    assert!(!loads(&other));
    // A sound checksum over lengths that lie.
    for lie in [u64::MAX, 1 << 40, 2, 0] {
        let mut bytes = sound[..sound.len() - 32].to_vec();
        bytes[40..48].copy_from_slice(&lie.to_le_bytes());
        let sum = blake3::hash(&bytes);
        bytes.extend(sum.as_bytes());
        assert!(!loads(&bytes), "{lie} sections");
    }
    assert!(loads(&sound));
}

#[test]
fn the_files_not_used_for_longest_make_room() {
    let folder = tempfile::tempdir().unwrap();
    let section = vec![vec![1.0_f32; 1000]];
    // Room for three files of some 4100 bytes.
    let cache = Cache::new(folder.path(), 13_000);
    fs::write(folder.path().join("notes.light"), [0; 20_000]).unwrap();
    let past = |name: &str, seconds: u64| {
        let file = File::options().write(true).open(folder.path().join(key(name).file_name())).unwrap();
        file.set_modified(SystemTime::now() - Duration::from_secs(seconds)).unwrap();
    };
    for (name, age) in [("a", 300), ("b", 200), ("c", 100)] {
        cache.store(&key(name), &section);
        past(name, age);
    }
    // Using it makes it young.
    assert!(cache.load(&key("a")).is_some());
    cache.store(&key("d"), &section);
    let left = ["a", "b", "c", "d"].map(|name| cache.load(&key(name)).is_some());
    assert_eq!(left, [true, false, true, true]);
    assert!(folder.path().join("notes.light").exists(), "another's file");
    // What is larger than all the room is not stored and costs nobody his place.
    cache.store(&key("e"), &[vec![0.0; 10_000]]);
    assert!(cache.load(&key("e")).is_none() && cache.load(&key("a")).is_some());
}

#[test]
fn what_killed_processes_left_goes() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::new(folder.path(), 1 << 20);
    let names = [".skyprobe-old", ".skyprobe-new", "old"];
    for name in names {
        let file = File::create(folder.path().join(name)).unwrap();
        let age = if name.ends_with("old") { 2 * ABANDONED } else { Duration::ZERO };
        file.set_modified(SystemTime::now() - age).unwrap();
    }
    cache.store(&key("a"), &sections());
    assert_eq!(names.map(|name| folder.path().join(name).exists()), [false, true, true]);
}

#[test]
fn what_is_no_file_neither_stops_the_cleaning_nor_is_touched() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let old = |path: &Path| File::open(path).unwrap().set_modified(SystemTime::now() - 2 * ABANDONED);
    // Whichever of them is met first, the others go.
    let entries: Vec<String> = (0..8).map(|k| format!(".skyprobe-{k}")).collect();
    for (k, name) in entries.iter().enumerate() {
        if k % 2 == 0 {
            fs::create_dir(at(name)).unwrap();
            fs::write(at(name).join("kept"), "something").unwrap();
        } else {
            fs::write(at(name), "").unwrap();
        }
        let _ = old(&at(name));
    }
    let as_directory = key("directory").file_name();
    fs::create_dir(at(&as_directory)).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(at("nowhere"), at(".skyprobe-link")).unwrap();
    let cache = Cache::new(folder.path(), 1 << 20);
    cache.store(&key("a"), &sections());
    let there: Vec<bool> = entries.iter().map(|name| at(name).exists()).collect();
    assert_eq!(there, [true, false, true, false, true, false, true, false]);
    assert!(cache.load(&key("a")).is_some());
    // A folder in the place of an entry: nothing is loaded or stored, and the cleaning goes on.
    fs::write(at(".skyprobe-late"), "").unwrap();
    old(&at(".skyprobe-late")).unwrap();
    assert!(cache.load(&key("directory")).is_none());
    cache.store(&key("directory"), &sections());
    assert!(at(&as_directory).is_dir() && !at(".skyprobe-late").exists());
}

#[cfg(unix)]
#[test]
fn a_pipe_in_the_place_of_an_entry_is_not_waited_for_and_gives_way() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::new(folder.path(), 1 << 20);
    let path = folder.path().join(key("a").file_name());
    let make_pipe = || std::process::Command::new("mkfifo").arg(&path).status().unwrap().success();
    assert!(make_pipe());
    let (send, receive) = std::sync::mpsc::channel();
    let reader = cache.clone();
    std::thread::spawn(move || send.send(reader.load(&key("a")).is_none()));
    assert_eq!(receive.recv_timeout(Duration::from_secs(20)), Ok(true), "waits for ever");
    cache.store(&key("a"), &sections());
    assert_eq!(cache.load(&key("a")), Some(sections()));
}

#[test]
fn a_folder_that_cannot_be_is_as_if_it_were_empty() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let cache = Cache::new(file.join("below"), 1 << 20);
    cache.store(&key("a"), &sections());
    assert!(cache.load(&key("a")).is_none());
}

#[test]
fn the_environment_says_where_and_whether() {
    let folder = |variables: &[(&str, &str)]| {
        let known: HashMap<_, _> = variables.iter().copied().collect();
        Cache::from_environment(|name| known.get(name).map(PathBuf::from)).map(|cache| cache.folder)
    };
    assert_eq!(folder(&[(FOLDER, "/x"), ("HOME", "/h")]), Some(PathBuf::from("/x")));
    assert_eq!(folder(&[(SWITCH, "off"), (FOLDER, "/x")]), None);
    assert_eq!(folder(&[]), None);
    #[cfg(target_os = "linux")]
    {
        assert_eq!(folder(&[("HOME", "/h")]), Some(PathBuf::from("/h/.cache/skyprobe")));
        assert_eq!(folder(&[("HOME", "/h"), ("XDG_CACHE_HOME", "/c")]), Some(PathBuf::from("/c/skyprobe")));
        assert_eq!(folder(&[("HOME", "/h"), ("XDG_CACHE_HOME", "relative")]), Some(PathBuf::from("/h/.cache/skyprobe")));
    }
}
