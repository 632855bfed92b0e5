//! Which names are those of one file.

use std::path::{Path, PathBuf};

/// The paths that name files of their own: each that is the file of one before it, by whatever spelling, is left out.
pub fn distinct<P: AsRef<Path>>(paths: &[P]) -> Vec<&Path> {
    let mut seen: Vec<PathBuf> = Vec::with_capacity(paths.len());
    let mut kept = Vec::with_capacity(paths.len());
    for path in paths.iter().map(AsRef::as_ref) {
        let own = resolved(path);
        if !seen.contains(&own) {
            seen.push(own);
            kept.push(path);
        }
    }
    kept
}

/// The path without links and detours, also of a file that is not there yet.
fn resolved(path: &Path) -> PathBuf {
    let place = path.canonicalize().unwrap_or_else(|_| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or_else(|| Path::new("."));
        match (folder.canonicalize(), path.file_name()) {
            (Ok(folder), Some(name)) => folder.join(name),
            _ => path.to_path_buf(),
        }
    });
    if cfg!(windows) { PathBuf::from(place.to_string_lossy().to_lowercase()) } else { place }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_file_by_several_names_is_one() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("a")).unwrap();
        let names = ["sky.exr", "./sky.exr", "a/../sky.exr", "a//../sky.exr", "b.exr", "sky.hdr", "a/sky.exr"];
        let paths: Vec<PathBuf> = names.iter().map(|name| folder.path().join(name)).collect();
        let expected = [0, 4, 5, 6].map(|k| paths[k].as_path());
        assert_eq!(distinct(&paths), expected);
        std::fs::write(&paths[0], "there").unwrap();
        assert_eq!(distinct(&paths), expected);
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(folder.path(), folder.path().join("link")).unwrap();
            assert_eq!(
                distinct(&[
                    paths[0].clone(),
                    folder.path().join("link/sky.exr"),
                    folder.path().join("link/new.exr"),
                    folder.path().join("new.exr")
                ])
                .len(),
                2
            );
        }
    }
}
