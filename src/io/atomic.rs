//! Files that appear whole or not at all: written beside the target under another name, then renamed.

use crate::error::{Error, Result};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Checks, before any work, that a file can be written at `path`.
///
/// # Errors
/// [`Error::File`] if the folder is missing or cannot be written to, or `path` is there and not a regular file.
pub fn check_writable(path: &Path) -> Result<()> {
    temporary(path).map(|_| ())
}

/// Writes the file `path` through `write`: if that fails, nothing is left and a file that was there stays as it was.
///
/// # Errors
/// [`Error::File`] if the file cannot be written, and whatever `write` returns.
pub fn write_atomically(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<()>) -> Result<()> {
    let pending = Pending::new(path)?;
    let mut buffer = BufWriter::with_capacity(1 << 20, pending.open()?);
    write(&mut buffer)?;
    buffer.flush().map_err(|error| Error::file(path, error))?;
    pending.commit()
}

/// A file that is being written under another name beside its target; it vanishes unless it is committed.
pub(crate) struct Pending {
    path: PathBuf,
    target: PathBuf,
    temporary: tempfile::NamedTempFile,
}

impl Pending {
    /// An empty file that may become `path`.
    ///
    /// # Errors
    /// [`Error::File`] if nothing can be written there.
    pub fn new(path: &Path) -> Result<Self> {
        let (target, temporary) = temporary(path)?;
        Ok(Self { path: path.to_path_buf(), target, temporary })
    }

    /// The file, to write to.
    ///
    /// # Errors
    /// [`Error::File`].
    pub fn open(&self) -> Result<File> {
        self.temporary.reopen().map_err(|error| Error::file(&self.path, error))
    }

    /// Gives the file its name, in place of what had it.
    ///
    /// # Errors
    /// [`Error::File`].
    pub fn commit(self) -> Result<()> {
        self.temporary.persist(self.target).map_err(|error| Error::file(&self.path, error.error))?;
        Ok(())
    }
}

/// The file that a name stands for (behind a symbolic link), and an empty file beside it that vanishes unless it is kept.
fn temporary(path: &Path) -> Result<(PathBuf, tempfile::NamedTempFile)> {
    let target = if path.is_symlink() {
        path.canonicalize().map_err(|error| Error::file(path, format!("the link leads nowhere: {error}")))?
    } else {
        path.to_path_buf()
    };
    if target.file_name().is_none() {
        return Err(Error::file(path, "not the name of a file"));
    }
    if target.is_dir() {
        return Err(Error::file(path, "is a directory"));
    }
    if target.exists() && !target.is_file() {
        return Err(Error::file(path, "is not a regular file"));
    }
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        return Err(Error::file(path, format!("there is no folder {}", folder.display())));
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".skyprobe-").suffix(".part");
    // What a new file usually gets (less the umask): temporary files are private by default.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder).map_err(|error| Error::file(path, format!("cannot write there: {error}")))?;
    Ok((target, file))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failing_writer_leaves_the_folder_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.exr");
        let fail = |path: &Path| {
            write_atomically(path, |file| {
                file.write_all(&[0; 4096]).unwrap();
                file.flush().unwrap();
                Err(Error::Cancelled)
            })
        };
        assert!(matches!(fail(&path), Err(Error::Cancelled)));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        std::fs::write(&path, "before").unwrap();
        assert!(fail(&path).is_err());
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "before");
        write_atomically(&path, |file| file.write_all(b"after").map_err(|error| Error::file("", error))).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "after");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn targets_that_cannot_be_are_refused_before_any_work() {
        let folder = tempfile::tempdir().unwrap();
        let inside = |name: &str| check_writable(&folder.path().join(name));
        assert!(inside("sky.exr").is_ok());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        assert!(check_writable(folder.path()).unwrap_err().to_string().ends_with("is a directory"));
        assert!(inside("missing/sky.exr").unwrap_err().to_string().contains("there is no folder"));
        assert!(check_writable(Path::new("")).is_err());
        #[cfg(unix)]
        assert!(check_writable(Path::new("/dev/null")).unwrap_err().to_string().ends_with("is not a regular file"));
        std::fs::write(folder.path().join("file"), "").unwrap();
        assert!(inside("file/sky.exr").is_err());
    }

    #[cfg(unix)]
    #[test]
    fn new_files_can_be_read_by_others_and_links_stay_links() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (real, link) = (folder.path().join("real"), folder.path().join("link"));
        std::fs::write(&real, "").unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        write_atomically(&link, |file| file.write_all(b"new").map_err(|error| Error::file("", error))).unwrap();
        assert!(link.is_symlink());
        assert_eq!(std::fs::read_to_string(&real).unwrap(), "new");
        assert_ne!(std::fs::metadata(&real).unwrap().permissions().mode() & 0o077, 0);
    }
}
