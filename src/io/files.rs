//! The files of one command: none that it reads is written, and none is written twice.

use super::leftovers;
use crate::error::{Error, Result};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
#[cfg(unix)]
use std::fs::File;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;
use unicode_normalization::UnicodeNormalization;

/// Stands for the standard input among what is read, and for the standard output among what is written.
pub const STANDARD: &str = "-";

/// Which file a name stands for, however it is spelt: through links, of either kind, or in another case where the system does not tell cases apart.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Identity {
    /// A file that is there, by the numbers of its volume and of itself.
    File([u64; 2]),
    /// A file that is not there yet.
    Name(Name),
    /// Neither file nor folder is there.
    Path(PathBuf),
}

/// The name of a file that is not there yet, and its folder, with the numbers of that.
#[derive(Clone, Debug)]
struct Name {
    folder: PathBuf,
    numbers: [u64; 2],
    name: String,
}

impl Name {
    fn folded(&self) -> String {
        self.name.nfc().collect::<String>().to_lowercase()
    }
}

impl PartialEq for Name {
    // The folder is asked only where its answer counts: that takes a file.
    fn eq(&self, other: &Self) -> bool {
        self.numbers == other.numbers
            && (self.name == other.name || self.folded() == other.folded() && ignores_case(&self.folder))
    }
}

impl Eq for Name {}

impl Hash for Name {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.numbers, self.folded()).hash(state);
    }
}

impl Identity {
    fn of(path: &Path) -> Self {
        if let Some(numbers) = numbers(path) {
            return Self::File(numbers);
        }
        let folder = folder_of(path);
        match (numbers(folder), path.file_name()) {
            (Some(numbers), Some(name)) => {
                Self::Name(Name { folder: folder.to_path_buf(), numbers, name: name.to_string_lossy().into_owned() })
            }
            _ => Self::Path(path.to_path_buf()),
        }
    }

    /// Of the file that the standard input is read from; `None` for a terminal or a pipe.
    #[cfg(unix)]
    fn of_standard_input() -> Option<Self> {
        Self::of_stream(&std::io::stdin())
    }

    #[cfg(unix)]
    fn of_standard_output() -> Option<Self> {
        Self::of_stream(&std::io::stdout())
    }

    #[cfg(unix)]
    fn of_stream(stream: &impl std::os::fd::AsFd) -> Option<Self> {
        let file = File::from(stream.as_fd().try_clone_to_owned().ok()?);
        let data = file.metadata().ok()?;
        data.is_file().then(|| Self::File(numbers_of(&data)))
    }

    #[cfg(windows)]
    fn of_standard_input() -> Option<Self> {
        numbers_of(&winapi_util::HandleRef::stdin()).map(Self::File)
    }

    #[cfg(windows)]
    fn of_standard_output() -> Option<Self> {
        numbers_of(&winapi_util::HandleRef::stdout()).map(Self::File)
    }

    #[cfg(not(any(unix, windows)))]
    fn of_standard_input() -> Option<Self> {
        None
    }

    #[cfg(not(any(unix, windows)))]
    fn of_standard_output() -> Option<Self> {
        None
    }
}

/// The numbers of a file or folder that is there.
#[cfg(unix)]
fn numbers(path: &Path) -> Option<[u64; 2]> {
    std::fs::metadata(path).ok().map(|data| numbers_of(&data))
}

#[cfg(unix)]
fn numbers_of(data: &std::fs::Metadata) -> [u64; 2] {
    use std::os::unix::fs::MetadataExt;
    [data.dev(), data.ino()]
}

#[cfg(windows)]
fn numbers(path: &Path) -> Option<[u64; 2]> {
    numbers_of(&winapi_util::Handle::from_path_any(path).ok()?)
}

#[cfg(windows)]
fn numbers_of(handle: &impl winapi_util::AsHandleRef) -> Option<[u64; 2]> {
    // Pipes and consoles have no numbers of their own.
    if !winapi_util::file::typ(handle).ok()?.is_disk() {
        return None;
    }
    let found = winapi_util::file::information(handle).ok()?;
    Some([found.volume_serial_number(), found.file_index()])
}

#[cfg(not(any(unix, windows)))]
fn numbers(path: &Path) -> Option<[u64; 2]> {
    let whole = path.canonicalize().ok()?;
    let sum = blake3::hash(whole.as_os_str().as_encoded_bytes());
    let half = |k: usize| sum.as_bytes()[8 * k..].first_chunk().map_or(0, |bytes| u64::from_le_bytes(*bytes));
    Some([half(0), half(1)])
}

/// The folder that `path` lies in.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Whether names that differ by case alone stand for one file there: a file is found under its name in capitals.
fn ignores_case(folder: &Path) -> bool {
    let Some(file) = trial(folder) else { return false };
    let capitals = file.path().file_name().map(|name| name.to_string_lossy().to_uppercase());
    capitals.is_some_and(|name| folder.join(name).symlink_metadata().is_ok())
}

/// A file to try names with, locked so that no other process takes it for abandoned.
fn trial(folder: &Path) -> Option<NamedTempFile> {
    let mut made = (0..leftovers::ATTEMPTS).map_while(|_| leftovers::builder().tempfile_in(folder).ok());
    made.find(|file| leftovers::lock(file.as_file(), file.path()))
}

/// Whether two names stand for one file, however they are spelt: relative or absolute, through links of either kind, and in another case where the system
/// does not tell cases apart. The files need not be there.
pub fn is_same_file(a: impl AsRef<Path>, b: impl AsRef<Path>) -> bool {
    Identity::of(a.as_ref()) == Identity::of(b.as_ref())
}

/// The paths without those that stand for a file which one before stands for already.
pub fn each_once<P: AsRef<Path>>(paths: &[P]) -> Vec<&P> {
    let mut known = std::collections::HashSet::new();
    paths.iter().filter(|path| known.insert(Identity::of(path.as_ref()))).collect()
}

/// Checks, before any work, that a command writes over nothing that it reads, and writes no file twice: each file with the name of its parameter. `-` stands for
/// the standard input or output, which count if they are redirected from or to a file.
///
/// # Errors
/// [`Error::Input`] for the parameter of the file that would be written.
pub fn check_files(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<()> {
    let mut known = HashMap::new();
    for &(parameter, path) in inputs {
        let identity = if is_standard(path) { Identity::of_standard_input() } else { Some(Identity::of(path)) };
        if let Some(identity) = identity {
            known.entry(identity).or_insert((parameter, path, "read"));
        }
    }
    for &(parameter, path) in outputs {
        let identity = if is_standard(path) { Identity::of_standard_output() } else { Some(Identity::of(path)) };
        match identity.map(|identity| known.entry(identity)) {
            Some(Entry::Occupied(found)) => {
                let (other, file, used) = *found.get();
                let allowed = format!("another file than {other} {}, which is {used}", file.display());
                return Err(Error::input(parameter, path.display(), allowed));
            }
            Some(Entry::Vacant(place)) => {
                place.insert((parameter, path, "written, too"));
            }
            None => {}
        }
    }
    Ok(())
}

fn is_standard(path: &Path) -> bool {
    path.as_os_str() == STANDARD
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_known_by_every_spelling() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("inner")).unwrap();
        std::fs::write(at("a.hdr"), "").unwrap();
        std::fs::write(at("b.hdr"), "").unwrap();
        assert!(is_same_file(at("a.hdr"), at("./inner/../a.hdr")));
        assert!(!is_same_file(at("a.hdr"), at("b.hdr")));
        // Not there yet.
        assert!(is_same_file(at("new.hdr"), at("inner/../new.hdr")));
        assert!(!is_same_file(at("new.hdr"), at("inner/new.hdr")));
        assert!(is_same_file("new.hdr", std::env::current_dir().unwrap().join("new.hdr")));
        assert_eq!(is_same_file(at("new.hdr"), at("NEW.hdr")), ignores_case(folder.path()));
        std::fs::hard_link(at("a.hdr"), at("hard.hdr")).unwrap();
        assert!(is_same_file(at("a.hdr"), at("hard.hdr")));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink("a.hdr", at("soft.hdr")).unwrap();
            std::os::unix::fs::symlink("inner", at("other")).unwrap();
            assert!(is_same_file(at("hard.hdr"), at("soft.hdr")));
            assert!(is_same_file(at("inner/new.hdr"), at("other/new.hdr")));
        }
        let paths = [at("a.hdr"), at("b.hdr"), at("./a.hdr"), at("new.hdr"), at("inner/../new.hdr")];
        assert_eq!(each_once(&paths), [&paths[0], &paths[1], &paths[3]]);
        assert_eq!(std::fs::read_dir(at("inner")).unwrap().count(), 0);
    }

    #[test]
    fn a_trial_of_names_is_not_cleaned_by_others() {
        let folder = tempfile::tempdir().unwrap();
        let file = trial(folder.path()).unwrap();
        leftovers::remove_abandoned(folder.path());
        assert!(file.path().exists());
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_is_not_touched_to_tell_different_names_apart() {
        let folder = tempfile::tempdir().unwrap();
        let (a, b) = (folder.path().join("a.exr"), folder.path().join("b.exr"));
        let then = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
        File::open(folder.path()).unwrap().set_modified(then).unwrap();
        assert!(!is_same_file(&a, &b));
        assert_eq!(each_once(&[&a, &b, &a]), [&&a, &&b]);
        check_files(&[("config", &a)], &[("output", &b)]).unwrap();
        assert_eq!(std::fs::metadata(folder.path()).unwrap().modified().unwrap(), then);
    }

    #[test]
    fn what_is_read_or_written_already_is_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let (a, b) = (folder.path().join("a.exr"), folder.path().join("b.exr"));
        std::fs::write(&a, "").unwrap();
        check_files(&[("input", &a), ("input", &a)], &[("output", &b)]).unwrap();
        let message = |inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]| check_files(inputs, outputs).unwrap_err().to_string();
        let told = message(&[("config", &a)], &[("output", &b), ("sample_map", &a)]);
        assert!(told.starts_with("sample_map = ") && told.contains("another file than config "), "{told}");
        let told = message(&[], &[("output", &b), ("preview", &b)]);
        assert!(told.starts_with("preview = ") && told.ends_with("b.exr, which is written, too"), "{told}");
    }
}
