//! Files that appear whole or not at all: written beside the target under another name, then renamed.
//!
//! Several files of one command get their names together, at the very end. That is the one moment from which on the work cannot be cancelled any more: before it no file
//! is left, after it nothing says cancelled. If one of them cannot get its name, those before it are taken back and what they replaced is put back, as far as
//! the file system allows.

use super::files::folder_of;
use super::leftovers;
use super::names::refused_by_windows;
use crate::error::{Error, Result};
use crate::progress::Progress;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::NamedTempFile;

/// Unfinished files of this process.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Whether files have got their names since [`begin`].
static COMMITTED: AtomicBool = AtomicBool::new(false);

/// Checks, before any work, that a file can be written at `path`.
///
/// # Errors
/// [`Error::File`] if the folder is missing or cannot be written to, or `path` is there and not a regular file, or read-only.
pub fn check_writable(path: &Path) -> Result<()> {
    Pending::new(path).map(|_| ())
}

/// Writes the file `path` through `write`: if that fails or `progress` says no at the end, nothing is left and a file that was there stays as it was. A file
/// that is replaced passes on its mode and, as far as the system allows, its owner.
///
/// # Errors
/// [`Error::File`] if the file cannot be written, [`Error::Cancelled`], and whatever `write` returns.
pub fn write_atomically(
    path: &Path,
    progress: &Progress<'_>,
    write: impl FnOnce(&mut BufWriter<File>) -> Result<()>,
) -> Result<()> {
    commit(vec![Pending::written(path, write)?], progress)
}

/// A file that is being written under another name beside its target; it vanishes unless it is committed.
pub(crate) struct Pending {
    path: PathBuf,
    target: PathBuf,
    temporary: NamedTempFile,
    /// After the file, which it outlives.
    _entry: Registered,
}

/// An entry of [`UNFINISHED`].
struct Registered(PathBuf);

impl Drop for Registered {
    fn drop(&mut self) {
        unfinished().retain(|path| *path != self.0);
    }
}

impl Pending {
    /// An empty file that may become `path`. What killed processes left in its folder is removed.
    ///
    /// # Errors
    /// [`Error::File`] if nothing can be written there.
    pub fn new(path: &Path) -> Result<Self> {
        let target = target(path)?;
        let folder = folder_of(&target);
        if !folder.is_dir() {
            return Err(Error::file(path, format!("there is no folder {}", folder.display())));
        }
        let replaced = replaceable(path, &target)?;
        leftovers::clean(folder);
        let (temporary, entry) = temporary(path, folder, replaced.as_ref())?;
        Ok(Self { path: path.to_path_buf(), target, temporary, _entry: entry })
    }

    /// A file that may become `path`, and that `write` has written.
    ///
    /// # Errors
    /// As [`write_atomically`].
    pub fn written(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<()>) -> Result<Self> {
        let pending = Self::new(path)?;
        let mut buffer = BufWriter::with_capacity(1 << 20, pending.open()?);
        write(&mut buffer)?;
        buffer.flush().map_err(|error| Error::file(path, error))?;
        Ok(pending)
    }

    /// The file, to write to. There is one place in it that is written to next, however often it is opened.
    ///
    /// # Errors
    /// [`Error::File`].
    pub fn open(&self) -> Result<File> {
        // Not opened anew: some systems let only this handle write to what it has locked.
        self.temporary.as_file().try_clone().map_err(|error| Error::file(&self.path, error))
    }
}

/// Asks `progress` a last time, then gives all files their names, in place of what had them.
///
/// # Errors
/// [`Error::Cancelled`]; [`Error::File`] if one cannot get its name: then none has, as far as the file system allows.
pub(crate) fn commit(files: Vec<Pending>, progress: &Progress<'_>) -> Result<()> {
    progress.confirm()?;
    let several = files.len() > 1;
    let apart = |Pending { path, target, temporary, _entry }| (_entry, (path, target, temporary));
    let (_entries, files): (Vec<Registered>, Vec<_>) = files.into_iter().map(apart).unzip();
    let mut done: Vec<(PathBuf, Option<NamedTempFile<()>>)> = Vec::new();
    // Dropped before the entries, which need it.
    let _held = unfinished();
    for (path, target, temporary) in files {
        let kept = if several { kept(&target) } else { None };
        let is_new = !target.exists();
        if let Err(failed) = temporary.persist(&target) {
            take_back(done);
            return Err(Error::file(path, failed.error));
        }
        if kept.is_some() || is_new {
            done.push((target, kept));
        }
    }
    COMMITTED.store(true, Ordering::SeqCst);
    Ok(())
}

/// A second name of `target`, if it is there, that keeps it until all is done.
fn kept(target: &Path) -> Option<NamedTempFile<()>> {
    leftovers::keeper().make_in(folder_of(target), |to| std::fs::hard_link(target, to)).ok()
}

fn take_back(done: Vec<(PathBuf, Option<NamedTempFile<()>>)>) {
    for (target, kept) in done.into_iter().rev() {
        // Nothing more can be done if that fails, too.
        let _ = match kept {
            Some(kept) => kept.persist(target).map_err(|failed| failed.error),
            None => std::fs::remove_file(target),
        };
    }
}

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Says that work begins which will give files their names.
#[cfg(feature = "cli")]
pub(crate) fn begin() {
    COMMITTED.store(false, Ordering::SeqCst);
}

/// Whether files have got their names since [`begin`].
#[cfg(feature = "cli")]
pub(crate) fn is_committed() -> bool {
    COMMITTED.load(Ordering::SeqCst)
}

/// For a process that ends at once: waits until files that are getting their names have them, then removes all unfinished ones and keeps new ones from
/// getting theirs. Returns whether files have got their names since [`begin`].
#[cfg(feature = "cli")]
pub(crate) fn abandon() -> bool {
    let held = unfinished();
    held.iter().for_each(|path| drop(std::fs::remove_file(path)));
    std::mem::forget(held);
    is_committed()
}

/// The file that a name stands for, behind a symbolic link.
fn target(path: &Path) -> Result<PathBuf> {
    let target = if path.is_symlink() {
        path.canonicalize().map_err(|error| Error::file(path, format!("the link leads nowhere: {error}")))?
    } else {
        path.to_path_buf()
    };
    if target.file_name().is_none() {
        return Err(Error::file(path, "not the name of a file"));
    }
    if cfg!(windows)
        && let Some(reason) = refused_by_windows(&target)
    {
        return Err(Error::file(path, reason));
    }
    if target.is_dir() {
        return Err(Error::file(path, "is a directory"));
    }
    if target.exists() && !target.is_file() {
        return Err(Error::file(path, "is not a regular file"));
    }
    Ok(target)
}

/// What is known of the file that would be replaced; `None` if there is none.
fn replaceable(path: &Path, target: &Path) -> Result<Option<Metadata>> {
    let Ok(found) = target.metadata() else { return Ok(None) };
    if found.permissions().readonly() {
        return Err(Error::file(path, "is read-only"));
    }
    // Renaming asks only whether the folder may be changed, not whether the file may.
    OpenOptions::new().write(true).open(target).map_err(|error| Error::file(path, format!("must not be changed: {error}")))?;
    Ok(Some(found))
}

/// An empty, locked file in `folder`, as much like the one that it will replace as can be.
fn temporary(path: &Path, folder: &Path, replaced: Option<&Metadata>) -> Result<(NamedTempFile, Registered)> {
    let failed = |error: std::io::Error| Error::file(path, format!("cannot write there: {error}"));
    #[cfg_attr(not(unix), expect(unused_mut, reason = "permissions are of Unix"))]
    let mut builder = leftovers::builder();
    // What a new file usually gets (less the umask): temporary files are private by default, as one should be that replaces a private one.
    #[cfg(unix)]
    if replaced.is_none() {
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    }
    // Elsewhere files inherit who may do what from their folder.
    #[cfg(not(unix))]
    let _ = replaced;
    for _ in 0..leftovers::ATTEMPTS {
        let mut known = unfinished();
        let file = builder.tempfile_in(folder).map_err(failed)?;
        known.push(file.path().to_path_buf());
        drop(known);
        let entry = Registered(file.path().to_path_buf());
        if leftovers::lock(file.as_file(), file.path()) {
            #[cfg(unix)]
            if let Some(replaced) = replaced {
                pass_on(replaced, file.as_file());
            }
            return Ok((file, entry));
        }
    }
    Err(Error::file(path, "cannot write there: other processes remove what is being written"))
}

/// Gives `file` the owner and the mode of the one that it will replace. Who may not give files away keeps it; then the group, if it is another, gets no more than all others.
#[cfg(unix)]
fn pass_on(replaced: &Metadata, file: &File) {
    use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
    let mut mode = replaced.mode() & 0o777;
    let Ok(own) = file.metadata() else { return };
    if (own.uid(), own.gid()) != (replaced.uid(), replaced.gid())
        && fchown(file, Some(replaced.uid()), Some(replaced.gid())).is_err()
        && own.gid() != replaced.gid()
        && fchown(file, None, Some(replaced.gid())).is_err()
    {
        mode &= !0o070 | (mode & 0o007) << 3;
    }
    // A file system without modes has none to pass on.
    let _ = file.set_permissions(PermissionsExt::from_mode(mode));
}

#[cfg(test)]
mod tests;
