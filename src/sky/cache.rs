//! Solved light kept on disk, so that the same air need not be solved again by the next process. It knows bytes and a key, nothing of light.
//!
//! A file is named by its key and holds, little-endian: magic number, key, number of sections (u64), length of each (u64), the sections (f32), BLAKE3 of all before.
//! A file that is cut off, damaged, of another version or of another key is not believed: the caller solves again. Nothing here
//! can fail a render: what cannot be read or written is as if it were not there.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// Switches the cache off with the value "off".
const SWITCH: &str = "SKYPROBE_CACHE";
/// Names the folder.
const FOLDER: &str = "SKYPROBE_CACHE_DIR";
/// What all files may take together [bytes].
const LIMIT: u64 = 1 << 30;

const MAGIC: [u8; 8] = *b"SKYLGT\x00\x01";
const SUFFIX: &str = "light";
const PREFIX_OF_UNFINISHED: &str = ".skyprobe-";
/// Age from which an unfinished file is what a killed process left behind.
const ABANDONED: Duration = Duration::from_secs(24 * 3600);

/// What a solution depends on, as one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key([u8; 32]);

/// Collects what a solution depends on.
pub struct KeyBuilder(blake3::Hasher);

impl KeyBuilder {
    /// A key for solutions by this version of the crate's solver.
    pub fn of_this_solver() -> Self {
        let mut builder = Self(blake3::Hasher::new());
        builder.text(env!("CARGO_PKG_VERSION"));
        builder.text(env!("SKYPROBE_SOLVER_FINGERPRINT"));
        builder
    }

    /// Adds a text.
    pub fn text(&mut self, text: &str) {
        self.0.update(&(text.len() as u64).to_le_bytes());
        self.0.update(text.as_bytes());
    }

    /// Adds numbers, bit by bit.
    pub fn numbers(&mut self, values: &[f64]) {
        self.0.update(&(values.len() as u64).to_le_bytes());
        for value in values {
            self.0.update(&value.to_le_bytes());
        }
    }

    /// The key.
    pub fn finish(self) -> Key {
        Key(*self.0.finalize().as_bytes())
    }
}

impl Key {
    fn file_name(&self) -> String {
        let digits: String = self.0.iter().map(|byte| format!("{byte:02x}")).collect();
        format!("{digits}.{SUFFIX}")
    }
}

/// A folder of solutions.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
    limit: u64,
}

impl Cache {
    /// The cache of this user: in the folder that the environment variable `SKYPROBE_CACHE_DIR` names, else in `skyprobe` in the system's place
    /// for caches (`XDG_CACHE_HOME` or `~/.cache`, `~/Library/Caches`, `%LOCALAPPDATA%`); at most 1 GB. `None` if `SKYPROBE_CACHE` is `off`, or there is no such place.
    pub fn of_user() -> Option<Self> {
        Self::from_environment(|name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from))
    }

    fn from_environment(variable: impl Fn(&str) -> Option<PathBuf>) -> Option<Self> {
        if variable(SWITCH).is_some_and(|value| value.as_os_str() == "off") {
            return None;
        }
        let of_system = || {
            let caches = if cfg!(windows) {
                variable("LOCALAPPDATA")?
            } else if cfg!(target_os = "macos") {
                variable("HOME")?.join("Library/Caches")
            } else {
                // A relative path there is to be ignored (XDG Base Directory Specification).
                let given = variable("XDG_CACHE_HOME").filter(|path| path.is_absolute());
                given.or_else(|| Some(variable("HOME")?.join(".cache")))?
            };
            Some(caches.join("skyprobe"))
        };
        variable(FOLDER).or_else(of_system).map(|folder| Self::new(folder, LIMIT))
    }

    /// A cache in `folder`, made when it is needed, whose files take at most `limit` bytes together.
    pub fn new(folder: impl Into<PathBuf>, limit: u64) -> Self {
        Self { folder: folder.into(), limit }
    }

    /// The sections that were stored under `key`.
    pub fn load(&self, key: &Key) -> Option<Vec<Vec<f32>>> {
        let path = self.folder.join(key.file_name());
        // A pipe would wait to be opened until somebody writes to it.
        if !fs::metadata(&path).ok()?.is_file() {
            return None;
        }
        let mut file = File::open(path).ok()?;
        let length = file.metadata().ok()?.len();
        if length > self.limit {
            return None;
        }
        let mut bytes = Vec::with_capacity(length as usize);
        (&mut file).take(self.limit).read_to_end(&mut bytes).ok()?;
        let sections = decode(key, &bytes)?;
        // What is used stays: the oldest go first.
        let _ = file.set_modified(SystemTime::now());
        Some(sections)
    }

    /// Stores `sections` under `key`, if that is possible, and removes the files not used for longest that are too much.
    pub fn store(&self, key: &Key, sections: &[Vec<f32>]) {
        let _ = self.try_store(key, sections);
    }

    fn try_store(&self, key: &Key, sections: &[Vec<f32>]) -> std::io::Result<()> {
        let bytes = encode(key, sections);
        if bytes.len() as u64 > self.limit {
            return Ok(());
        }
        fs::create_dir_all(&self.folder)?;
        let path = self.folder.join(key.file_name());
        let stored = self.write(&path, &bytes);
        // Also if nothing was stored: a full disk is what cleaning helps against.
        self.prune(&path);
        stored
    }

    fn write(&self, path: &Path, bytes: &[u8]) -> std::io::Result<()> {
        let mut file = tempfile::Builder::new().prefix(PREFIX_OF_UNFINISHED).tempfile_in(&self.folder)?;
        file.write_all(bytes)?;
        file.persist(path)?;
        Ok(())
    }

    /// Removes the oldest files beyond the limit, but for `newest`, and what killed processes left. Only regular files are touched, and what cannot be read or removed
    /// keeps nothing else from being removed.
    fn prune(&self, newest: &Path) {
        let mut found = Vec::new();
        let mut total = 0;
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let Ok(data) = entry.metadata() else { continue };
            let Ok(modified) = data.modified() else { continue };
            if !data.is_file() {
                continue;
            }
            if entry.file_name().to_string_lossy().starts_with(PREFIX_OF_UNFINISHED) {
                if modified.elapsed().is_ok_and(|age| age > ABANDONED) {
                    let _ = fs::remove_file(path);
                }
            } else if is_ours(&path) {
                total += data.len();
                found.push((modified, data.len(), path));
            }
        }
        found.sort();
        for (_, length, path) in found {
            if total > self.limit && path != newest && fs::remove_file(path).is_ok() {
                total -= length;
            }
        }
    }
}

/// Whether the cache gives such names.
fn is_ours(path: &Path) -> bool {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy()).unwrap_or_default();
    path.extension().is_some_and(|suffix| suffix == SUFFIX)
        && stem.len() == 64
        && stem.bytes().all(|byte| byte.is_ascii_hexdigit())
}

fn encode(key: &Key, sections: &[Vec<f32>]) -> Vec<u8> {
    let numbers: usize = sections.iter().map(Vec::len).sum();
    let mut bytes = Vec::with_capacity(80 + 8 * sections.len() + 4 * numbers);
    bytes.extend(MAGIC);
    bytes.extend(key.0);
    bytes.extend((sections.len() as u64).to_le_bytes());
    sections.iter().for_each(|section| bytes.extend((section.len() as u64).to_le_bytes()));
    sections.iter().flatten().for_each(|value| bytes.extend(value.to_le_bytes()));
    let sum = blake3::hash(&bytes);
    bytes.extend(sum.as_bytes());
    bytes
}

fn decode(key: &Key, bytes: &[u8]) -> Option<Vec<Vec<f32>>> {
    let (body, sum) = bytes.split_last_chunk::<32>()?;
    let rest = body.strip_prefix(&MAGIC)?.strip_prefix(&key.0)?;
    if blake3::hash(body).as_bytes() != sum {
        return None;
    }
    let (count, rest) = rest.split_first_chunk::<8>()?;
    let count = usize::try_from(u64::from_le_bytes(*count)).ok()?;
    let (lengths, rest) = rest.split_at_checked(count.checked_mul(8)?)?;
    let mut values = rest.as_chunks::<4>().0;
    let mut sections = Vec::with_capacity(count);
    for length in lengths.as_chunks::<8>().0 {
        let (section, after) = values.split_at_checked(usize::try_from(u64::from_le_bytes(*length)).ok()?)?;
        sections.push(section.iter().map(|value| f32::from_le_bytes(*value)).collect());
        values = after;
    }
    (values.is_empty() && rest.len().is_multiple_of(4)).then_some(sections)
}

#[cfg(test)]
mod tests;
