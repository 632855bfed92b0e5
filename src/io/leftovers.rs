//! Unfinished files: how they are called, locked while they are written, and removed when nobody writes them any more.
//!
//! A process that is killed cannot remove what it was writing, so the next one that writes to the folder does. An unfinished file is abandoned for sure if
//! its lock can be taken, since whoever writes it holds that until the end. Locks are seen by all processes of a machine, on local disks and on network
//! ones; whether those of another machine are seen depends on how the folder is mounted. So the name says which machine wrote the file, and those of
//! others (or of this one before it was started again) must also be old. Where a lock cannot be asked for, nothing is removed.

use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

const PREFIX: &str = ".skyprobe-";
const SUFFIX: &str = ".part";

/// Of a file that is about to be replaced: never removed by others, since it may be all that there is of it.
const KEPT: &str = ".kept";

/// How often a file is made anew that another process takes for abandoned: between its birth and its lock.
pub(super) const ATTEMPTS: usize = 16;

/// Age from which an unfinished file of another machine is abandoned, if its lock is free.
const OLD: Duration = Duration::from_secs(24 * 3600);

/// Makes unfinished files with names of their own.
pub(super) fn builder() -> tempfile::Builder<'static, 'static> {
    named(SUFFIX)
}

/// Makes second names for files that are about to be replaced.
pub(super) fn keeper() -> tempfile::Builder<'static, 'static> {
    named(KEPT)
}

fn named(suffix: &'static str) -> tempfile::Builder<'static, 'static> {
    static OWN: OnceLock<String> = OnceLock::new();
    let own = OWN.get_or_init(|| machine().map_or_else(|| PREFIX.to_owned(), |machine| format!("{PREFIX}{machine}-")));
    let mut builder = tempfile::Builder::new();
    builder.prefix(own).suffix(suffix);
    builder
}

/// Takes the lock of a file that was just made. `false` if another process is about to remove it, or has: then another must be made.
pub(super) fn lock(file: &File, path: &Path) -> bool {
    match file.try_lock() {
        Ok(()) => is_still(file, path),
        Err(TryLockError::WouldBlock) => false,
        // Without locks nobody removes it.
        Err(TryLockError::Error(_)) => true,
    }
}

/// Removes what killed processes left in `folder`, unless this process looked there within the last second: a sequence of pictures goes into one folder, which has many by then.
pub(super) fn clean(folder: &Path) {
    static LAST: Mutex<Option<(PathBuf, Instant)>> = Mutex::new(None);
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if !last.as_ref().is_some_and(|(known, when)| known == folder && when.elapsed() < Duration::from_secs(1)) {
        remove_abandoned(folder);
        *last = Some((folder.to_path_buf(), Instant::now()));
    }
}

/// Removes what killed processes left in `folder`. Whatever cannot be read, locked or removed stays.
pub(super) fn remove_abandoned(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if is_unfinished(&entry.file_name().to_string_lossy()) {
            let _ = remove_if_abandoned(&entry.path());
        }
    }
}

fn is_unfinished(name: &str) -> bool {
    name.starts_with(PREFIX) && name.ends_with(SUFFIX)
}

fn remove_if_abandoned(path: &Path) -> Option<()> {
    let found = path.symlink_metadata().ok()?;
    // A folder, a link or a pipe is not ours, and a pipe would wait for ever.
    if !found.is_file() {
        return None;
    }
    let name = path.file_name()?.to_string_lossy();
    let is_own = machine().is_some_and(|machine| name.starts_with(&format!("{PREFIX}{machine}-")));
    if !is_own && found.modified().ok()?.elapsed().ok()? < OLD {
        return None;
    }
    let file = OpenOptions::new().write(true).open(path).ok()?;
    file.try_lock().ok()?;
    if is_still(&file, path) { std::fs::remove_file(path).ok() } else { None }
}

/// Whether `path` still names `file`.
fn is_still(file: &File, path: &Path) -> bool {
    let (Ok(open), Ok(named)) = (file.metadata(), path.symlink_metadata()) else { return false };
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        (open.dev(), open.ino()) == (named.dev(), named.ino())
    }
    #[cfg(not(unix))]
    {
        open.is_file() && named.is_file()
    }
}

/// Eight digits for all processes that see each other's locks: of this machine since it was started. `None` if that is not known.
fn machine() -> Option<&'static str> {
    static DIGITS: OnceLock<Option<String>> = OnceLock::new();
    let digits = || {
        let text = if cfg!(windows) {
            std::env::var("COMPUTERNAME").ok()?
        } else {
            std::fs::read_to_string("/proc/sys/kernel/random/boot_id").ok()?
        };
        Some(blake3::hash(text.trim().as_bytes()).to_hex()[..8].to_owned())
    };
    DIGITS.get_or_init(digits).as_deref()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::SystemTime;

    fn aged(path: &Path, age: Duration) -> File {
        let file = File::create(path).unwrap();
        file.set_modified(SystemTime::now() - age).unwrap();
        file
    }

    #[test]
    fn only_what_nobody_writes_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let (day, now) = (OLD + Duration::from_secs(60), Duration::ZERO);
        let abandoned = builder().tempfile_in(folder.path()).unwrap().into_temp_path().keep().unwrap();
        let living = builder().tempfile_in(folder.path()).unwrap();
        assert!(lock(living.as_file(), living.path()));
        aged(&at(".skyprobe-0123456789.part"), day);
        aged(&at(".skyprobe-other-young.part"), now);
        let locked = aged(&at(".skyprobe-other-locked.part"), day);
        locked.lock().unwrap();
        aged(&at("skyprobe.part"), day);
        aged(&at(".skyprobe-notes.txt"), day);
        std::fs::create_dir(at(".skyprobe-folder.part")).unwrap();
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("skyprobe.part", at(".skyprobe-link.part")).unwrap();
            assert!(std::process::Command::new("mkfifo").arg(at(".skyprobe-pipe.part")).status().unwrap().success());
        }
        remove_abandoned(folder.path());
        assert_eq!(abandoned.exists(), machine().is_none());
        assert!(!at(".skyprobe-0123456789.part").exists());
        let stay = [".skyprobe-other-young.part", ".skyprobe-other-locked.part", "skyprobe.part", ".skyprobe-notes.txt"];
        assert!(stay.iter().all(|name| at(name).exists()) && living.path().exists());
        assert!(at(".skyprobe-folder.part").is_dir());
        #[cfg(unix)]
        assert!(at(".skyprobe-link.part").is_symlink() && at(".skyprobe-pipe.part").exists());
    }

    #[cfg(unix)]
    #[test]
    fn a_file_that_was_removed_before_its_lock_was_taken_is_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let made = builder().tempfile_in(folder.path()).unwrap();
        std::fs::remove_file(made.path()).unwrap();
        assert!(!lock(made.as_file(), made.path()));
    }
}
