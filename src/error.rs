//! What can go wrong, and what the caller can do about it.
//!
//! There are few kinds on purpose: mend the input, mend the data, look at the
//! disk, ask for other air, or accept that the work was cancelled.

use std::fmt::{self, Write as _};
use std::path::{Path, PathBuf};

/// Result of every fallible operation of the crate.
pub type Result<T> = std::result::Result<T, Error>;

/// The five ways in which work ends without a result.
///
/// As text each is one line, whatever the files and names say that it speaks of: signs of control are escaped, and long texts cut.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The caller gave a value that cannot be used; nothing was computed.
    #[error("{} = {}: must be {}", OneLine(parameter, LONGEST), OneLine(value, LONGEST), OneLine(allowed, usize::MAX))]
    Input {
        /// Name of the parameter as the caller knows it, the same in Rust, Python, configuration and command line.
        parameter: String,
        /// The value given, as text.
        value: String,
        /// The allowed range or spelling, with unit.
        allowed: String,
    },
    /// A table or file has content that cannot be used.
    #[error("{}", OneLine(what, usize::MAX))]
    Data {
        /// What is wrong with which data.
        what: String,
    },
    /// The light of this air cannot be found, or not well enough; what was found is not returned.
    #[error("{}", OneLine(what, usize::MAX))]
    Unsolved {
        /// What is wrong with the solution, what of the air is to blame, and what would help.
        what: String,
    },
    /// Reading or writing failed; a target file is untouched.
    #[error("{}: {}", OneLine(&path.display().to_string(), usize::MAX), OneLine(reason, usize::MAX))]
    File {
        /// The file that was to be read or written.
        path: PathBuf,
        /// Why it could not be.
        reason: String,
    },
    /// The progress callback asked to stop; nothing was left behind.
    #[error("cancelled")]
    Cancelled,
}

impl Error {
    /// An [`Error::Input`] for `parameter`, whose `value` is not `allowed`.
    pub fn input(parameter: impl Into<String>, value: impl ToString, allowed: impl Into<String>) -> Self {
        Self::Input { parameter: parameter.into(), value: value.to_string(), allowed: allowed.into() }
    }

    /// An [`Error::Data`].
    pub fn data(what: impl Into<String>) -> Self {
        Self::Data { what: what.into() }
    }

    /// An [`Error::Unsolved`].
    pub fn unsolved(what: impl Into<String>) -> Self {
        Self::Unsolved { what: what.into() }
    }

    /// An [`Error::File`] for `path`.
    pub fn file(path: impl AsRef<Path>, reason: impl ToString) -> Self {
        Self::File { path: path.as_ref().to_path_buf(), reason: reason.to_string() }
    }
}

/// Letters of a parameter and of a value that a message shows at most: either may come from a file.
const LONGEST: usize = 500;

/// A text on one line, without what terminals obey, and not longer than so many letters.
pub(crate) struct OneLine<'a>(pub &'a str, pub usize);

impl fmt::Display for OneLine<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (shown, more) = match self.0.char_indices().nth(self.1) {
            Some((end, _)) => (&self.0[..end], "..."),
            None => (self.0, ""),
        };
        for letter in shown.chars() {
            match letter {
                '\u{2028}' | '\u{2029}' => write!(f, "{}", letter.escape_unicode())?,
                _ if letter.is_control() => write!(f, "{}", letter.escape_default())?,
                _ => f.write_char(letter)?,
            }
        }
        f.write_str(more)
    }
}

/// Letters of a text that a message shows at most.
const SHOWN_LETTERS: usize = 80;

/// `text` as messages show it: in quotes, its first 80 letters at most.
pub(crate) fn quoted(text: &str) -> String {
    match text.char_indices().nth(SHOWN_LETTERS) {
        Some((end, _)) => format!("{:?}...", &text[..end]),
        None => format!("{text:?}"),
    }
}

/// Returns `value` if it is finite and within `[low, high]`, else an [`Error::Input`] that names
/// `parameter`, the value and the range with its `unit` (empty for none).
pub fn check_range(parameter: &str, value: f64, low: f64, high: f64, unit: &str) -> Result<f64> {
    if value.is_finite() && (low..=high).contains(&value) {
        return Ok(value);
    }
    let space = if unit.is_empty() { "" } else { " " };
    Err(Error::input(parameter, value, format!("a number from {low} to {high}{space}{unit}")))
}

/// Checks that all `values` are finite: if not, an [`Error::Data`] that says `what` is not: the last guard before numbers leave the library.
pub(crate) fn check_finite(what: &str, values: &[f64]) -> Result<()> {
    if values.iter().all(|value| value.is_finite()) {
        return Ok(());
    }
    Err(Error::data(format!("{what} is not finite")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_names_parameter_value_and_range() {
        let message = check_range("latitude", 91.0, -90.0, 90.0, "degrees").unwrap_err().to_string();
        assert_eq!(message, "latitude = 91: must be a number from -90 to 90 degrees");
    }

    #[test]
    fn not_a_number_is_never_in_range() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(check_range("turbidity", value, f64::MIN, f64::MAX, "").is_err());
        }
    }

    #[test]
    fn a_message_is_one_line_whatever_the_text_that_it_speaks_of() {
        let (ended, shown) = ("a\nb\r\t\u{1b}[2J\u{85}\u{2028}ö\\", "a\\nb\\r\\t\\u{1b}[2J\\u{85}\\u{2028}ö\\");
        for (error, expected) in [
            (Error::input(ended, ended, ended), format!("{shown} = {shown}: must be {shown}")),
            (Error::data(ended), shown.to_owned()),
            (Error::unsolved(ended), shown.to_owned()),
            (Error::file(ended, ended), format!("{shown}: {shown}")),
        ] {
            assert_eq!(error.to_string(), expected);
        }
        let long = Error::input("ö".repeat(100_000), "v".repeat(100_000), "short").to_string();
        assert!(long.ends_with("v...: must be short") && long.chars().count() < 1100, "{}", long.len());
    }
}
