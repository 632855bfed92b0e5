//! The fingerprint under which solved light is kept covers all code that a solve runs through.

#[allow(dead_code)]
#[path = "../../build.rs"]
mod build;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn crate_folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn what_a_solve_runs_through_is_covered_and_what_comes_after_it_is_not() {
    let files = build::files_of_a_solve(crate_folder());
    let names: BTreeSet<&str> = files.keys().map(String::as_str).collect();
    for name in [
        "src/light/solve.rs",
        "src/light/angular/rows.rs",
        "src/atmosphere/phase.rs",
        "src/atmosphere/phase_table.rs",
        "src/atmosphere/optical_profile.rs",
        "src/numerics/gauss.rs",
        "src/numerics/spline.rs",
        "src/units.rs",
        "src/quality.rs",
        "data/aerosol_particles.bin",
    ] {
        assert!(names.contains(name), "{name} is missing in {names:?}");
    }
    for folder in ["src/sky/", "src/probe/", "src/io/", "src/cli/", "src/python/", "src/places/"] {
        assert!(!names.iter().any(|name| name.starts_with(folder)), "{folder} comes after the solve");
    }
}

#[test]
fn any_change_of_any_of_them_changes_it() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let write = |name: &str, text: &str| {
        std::fs::create_dir_all(at(name).parent().unwrap()).unwrap();
        std::fs::write(at(name), text).unwrap();
    };
    write("src/light/mod.rs", "use crate::{air::{Gas, Dust}, numbers::*};\n// crate::word\n");
    write("src/light/deep/er.rs", "fn f() -> f64 { crate::plain::VALUE }");
    write("src/air/mod.rs", "const TABLE: &[u8] = include_bytes!(\"../../data/table.bin\");");
    write("src/numbers.rs", "use crate::error::Result;");
    write("src/plain.rs", "");
    write("src/error.rs", "");
    write("data/table.bin", "1 2 3");
    let of = || build::fingerprint(&build::files_of_a_solve(folder.path()));
    let before = of();
    write("src/word.rs", "not used");
    write("src/cli.rs", "use crate::light;");
    assert_eq!(of(), before);
    let covered: Vec<PathBuf> = build::files_of_a_solve(folder.path()).into_keys().map(|name| at(&name)).collect();
    assert_eq!(covered.len(), 7, "{covered:?}");
    for path in covered {
        let kept = std::fs::read(&path).unwrap();
        std::fs::write(&path, [&kept[..], b" "].concat()).unwrap();
        assert_ne!(of(), before, "{}", path.display());
        std::fs::write(&path, kept).unwrap();
    }
    assert_eq!(of(), before);
}
