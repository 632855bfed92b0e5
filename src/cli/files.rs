//! The files of a command, checked before any work.

use crate::error::{Error, Result};
use crate::io::{STANDARD, check_files, check_output, check_writable};
use std::path::Path;

/// The standard output, to which every command writes what it tells.
const TOLD: (&str, &str) = ("standard output", STANDARD);

/// Checks that all `outputs`, which are pictures, can be written, and that neither they nor what is told is written over an input or another output; each with the name of its parameter.
///
/// Before any work a path that cannot be written to is wrong input, not a failure of the disk.
pub fn check(inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<()> {
    check_by(|path| check_output(path), inputs, outputs)
}

/// As [`check`], for files of text under any name.
pub fn check_texts(outputs: &[(&str, &Path)]) -> Result<()> {
    check_by(check_writable, &[], outputs)
}

fn check_by(writable: impl Fn(&Path) -> Result<()>, inputs: &[(&str, &Path)], outputs: &[(&str, &Path)]) -> Result<()> {
    let told = (TOLD.0, Path::new(TOLD.1));
    check_files(inputs, &outputs.iter().copied().chain([told]).collect::<Vec<_>>())?;
    outputs.iter().try_for_each(|&(parameter, path)| {
        if path.is_dir() {
            return Err(Error::input(parameter, path.display(), "a file, not a directory"));
        }
        writable(path).map_err(|error| match error {
            Error::File { reason, .. } => {
                Error::input(parameter, path.display(), format!("a file that can be written ({reason})"))
            }
            other => other,
        })
    })
}
