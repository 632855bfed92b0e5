//! The examples for newcomers run, and the files that they write are pictures.

#![allow(dead_code, reason = "each example has a main of its own")]

use skyprobe::io::{PictureHints, read_picture};

#[path = "../../examples/4_own_air.rs"]
mod own_air;
#[path = "../../examples/2_day.rs"]
mod own_day;
#[path = "../../examples/3_numbers.rs"]
mod own_numbers;
#[path = "../../examples/1_probe.rs"]
mod own_probe;

type Write = fn(&str) -> skyprobe::Result<()>;

#[test]
fn probes_of_the_examples_are_lit_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let write: [(&str, Write, usize); 2] = [("probe.exr", own_probe::write, 1024), ("air.exr", own_air::write, 512)];
    for (name, write, width) in write {
        let path = folder.path().join(name);
        write(path.to_str().unwrap()).unwrap();
        let picture = read_picture(&path, &PictureHints::default()).unwrap();
        assert_eq!((picture.width, picture.height), (width, width / 2), "{name}");
        // The zenith.
        assert!(picture.pixels[..3].iter().all(|value| (1e-3..1e3).contains(value)), "{name}: {:?}", &picture.pixels[..3]);
    }
}

#[test]
fn numbers_of_the_examples_are_found() {
    own_day::main().unwrap();
    own_numbers::main().unwrap();
}
