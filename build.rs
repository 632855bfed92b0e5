//! Fingerprint of the code that solves the light: what an earlier build stored on disk is another solution.
//!
//! It covers `src/light` and, by the paths that begin with `crate::`, every module of the crate that a solve runs through, with the data they embed. A solve takes no arithmetic from other crates.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Where a solve begins.
const ROOT: &str = "light";

fn main() {
    // An enclosing program may carry this crate in any folder.
    let crate_folder = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").expect("set by cargo"));
    println!("cargo:rerun-if-changed=build.rs");
    let files = files_of_a_solve(&crate_folder);
    // With the folders, for files that are new.
    let folders: BTreeSet<&str> = files.keys().filter_map(|file| Some(file.rsplit_once('/')?.0)).collect();
    for path in folders.into_iter().chain(files.keys().map(String::as_str)) {
        println!("cargo:rerun-if-changed={path}");
    }
    println!("cargo:rustc-env=SKYPROBE_SOLVER_FINGERPRINT={:016x}", fingerprint(&files));
}

/// The files that a solve depends on, by their path below the crate's folder with `/` between names, and their content.
pub fn files_of_a_solve(crate_folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut modules = vec![ROOT.to_string()];
    let mut known: BTreeSet<String> = modules.iter().cloned().collect();
    while let Some(module) = modules.pop() {
        for file in source_files(&crate_folder.join("src"), &module) {
            let content = std::fs::read(&file).unwrap_or_default();
            let text = String::from_utf8_lossy(&content).into_owned();
            for name in modules_used(&text) {
                if known.insert(name.clone()) {
                    modules.push(name);
                }
            }
            for data in embedded(&text) {
                let path = file.parent().unwrap_or(crate_folder).join(data);
                if let Ok(path) = path.canonicalize() {
                    files.insert(name_of(crate_folder, &path), std::fs::read(path).unwrap_or_default());
                }
            }
            files.insert(name_of(crate_folder, &file), content);
        }
    }
    files
}

/// FNV-1a, 64 bits, of names, lengths and contents.
pub fn fingerprint(files: &BTreeMap<String, Vec<u8>>) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |bytes: &[u8]| {
        for byte in (bytes.len() as u64).to_le_bytes().iter().chain(bytes) {
            hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for (name, content) in files {
        add(name.as_bytes());
        add(content);
    }
    hash
}

/// The file `module.rs` and all that lies in the folder `module`, as far as they are.
fn source_files(source: &Path, module: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![source.join(module)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|suffix| suffix == "rs") {
                found.push(path);
            }
        }
    }
    found.extend(Some(source.join(format!("{module}.rs"))).filter(|file| file.is_file()));
    found
}

/// The names that follow `crate::` in code, also those in braces.
fn modules_used(text: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    for (at, start) in code.match_indices("crate::") {
        let rest = &code[at + start.len()..];
        let Some(group) = rest.strip_prefix('{') else {
            names.extend(first_name(rest));
            continue;
        };
        let mut depth = 0;
        let mut begins = true;
        for (at, character) in group.char_indices() {
            if begins && depth == 0 {
                names.extend(first_name(group[at..].trim_start()));
            }
            begins = character == ',';
            match character {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                _ => {}
            }
        }
    }
    names
}

fn first_name(text: &str) -> Option<String> {
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    (end > 0).then(|| text[..end].to_string())
}

/// The paths that `include_bytes!` and `include_str!` name, relative to the file that does.
fn embedded(text: &str) -> Vec<String> {
    let mut paths = Vec::new();
    for macro_name in ["include_bytes!(\"", "include_str!(\""] {
        for (at, start) in text.match_indices(macro_name) {
            let rest = &text[at + start.len()..];
            paths.extend(rest.find('"').map(|end| rest[..end].to_string()));
        }
    }
    paths
}

fn name_of(crate_folder: &Path, path: &Path) -> String {
    let crate_folder = crate_folder.canonicalize().unwrap_or_else(|_| crate_folder.to_path_buf());
    let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let below = path.strip_prefix(&crate_folder).unwrap_or(&path);
    below.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}
