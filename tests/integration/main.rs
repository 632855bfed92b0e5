//! The integration tests, linked as one program: each file here is a module of it.
//!
//! A test that needs a process of its own has a file of its own in `tests/` instead: it measures the memory of the process, or moments that other work
//! beside it would shift.

mod common;

mod cli;
mod cli_files;
mod cli_scenes;
mod colour;
mod energy;
mod examples;
mod hazes_and_twilight;
mod made;
mod night;
mod night_eclipses;
mod night_photometry;
mod night_spectra;
mod own_reference;
mod own_reference_bodies;
mod path_tracer;
mod path_tracer_polarisation;
mod path_tracer_twilight;
mod polarisation;
mod radiance;
mod segments;
mod shared_reference_bodies;
mod shared_reference_ephemeris;
mod shared_reference_pictures;
mod solver_and_path_tracer;
mod solver_fingerprint;
mod thick_air;
mod windows;

/// A file that is no module of this program would never be run.
#[test]
fn each_file_of_tests_is_a_module() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/integration");
    let this = include_str!("main.rs");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let is_source = path.is_dir() || path.extension().is_some_and(|suffix| suffix == "rs");
        let is_module = this.lines().any(|line| line == format!("mod {name};"));
        assert!(!is_source || is_module || name == "main", "tests/integration/main.rs does not say `mod {name};`");
    }
}
