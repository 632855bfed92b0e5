//! `skyprobe schema`: what a scene may say, for programs and for people.

use super::answer;
use crate::error::{Error, Result};
use crate::scene::{face, schema};
use clap::Args;

/// Options of `skyprobe schema`.
#[derive(Args)]
pub struct Options {
    /// json (JSON Schema, draft 2020-12), markdown (a table of all parameters), python (ranges, units and help as a module), or what the Python module shows of
    /// them: python-docs (signatures and docstrings) and python-stub (parts of its stub).
    #[arg(long, value_name = "NAME", default_value = "json")]
    format: String,
}

/// Prints it.
pub fn run(options: &Options) -> Result<()> {
    match options.format.as_str() {
        "json" => answer(&format!("{:#}", schema::json_schema())),
        "markdown" => answer(schema::markdown().trim_end()),
        "python" => answer(schema::python().trim_end()),
        "python-docs" => answer(face::docstrings().trim_end()),
        "python-stub" => answer(face::stub().trim_end()),
        other => Err(Error::input("--format", format!("{other:?}"), "json, markdown, python, python-docs or python-stub")),
    }
}
