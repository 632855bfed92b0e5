//! The command line tool: one file a command, but for the two that describe it to a shell.
//!
//! Exit codes: 0 done, 1 failed while working (such as a full disk), 2 wrong input (one line says which), 130 cancelled.

mod files;
mod glare;
mod info;
mod options;
mod picture_options;
mod places;
mod render;
mod scene_options;
mod schema;
mod seconds;
mod shell;
mod terminal;
mod tonemap;

use crate::error::{Error, OneLine, Result};
use clap::error::ErrorKind;
use clap::{Parser, Subcommand};
use std::ffi::OsString;
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

/// The light of the sky for a place, a time and a state of the air, as a high dynamic range light probe.
#[derive(Parser)]
#[command(name = "skyprobe", version, max_term_width = 100, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Compute with this many threads, 1 to 1024. Default: one for each processor.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), help_heading = GENERAL)]
    threads: Option<u16>,
    /// Say nothing of what is done, and show no progress: only what was asked for, what had to be assumed, and errors.
    #[arg(short, long, global = true, help_heading = GENERAL)]
    quiet: bool,
}

const GENERAL: &str = "General";

#[derive(Subcommand)]
enum Command {
    /// Compute a light probe and write it as EXR, HDR or PNG.
    Render(Box<render::Options>),
    /// Say where Sun, Moon and planets are, when they rise and set, and how much light arrives.
    Info(Box<info::Options>),
    /// List the places that a name may mean, or say what is known of coordinates.
    Places(places::Options),
    /// Add the glare of the eye to a picture: a probe, or a scene that it lit.
    Glare(Box<glare::Options>),
    /// Bring a picture to a screen: a probe, or a scene that it lit, by one of nine operators; or a whole sequence without flicker.
    Tonemap(Box<tonemap::Options>),
    /// Print what a configuration may say: as a JSON Schema, or as a table of all parameters.
    Schema(schema::Options),
    /// Print a script that completes commands and options in a shell.
    Completions(shell::CompletionOptions),
    /// Print a manual page, or write all of them into a folder.
    Man(shell::ManOptions),
}

impl Command {
    fn run(&self) -> Result<()> {
        match self {
            Self::Render(options) => render::run(options),
            Self::Info(options) => info::run(options),
            Self::Places(options) => places::run(options),
            Self::Glare(options) => glare::run(options),
            Self::Tonemap(options) => tonemap::run(options),
            Self::Schema(options) => schema::run(options),
            Self::Completions(options) => shell::completions(options),
            Self::Man(options) => shell::man(options),
        }
    }
}

const EXIT_CODES: &str = "\
Exit codes: 0 done, 1 failed while working, 2 wrong input, 130 cancelled.
`skyprobe render --help` explains every option with its unit and default, and has examples.";

/// Runs the tool with `arguments`, the first being the program's name, and returns the exit code.
///
/// Results go to the standard output; an error is one line on the standard error.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    terminal::handle_signals();
    let outcome = match Cli::try_parse_from(arguments) {
        Ok(cli) => {
            QUIET.store(cli.quiet, Ordering::Relaxed);
            with_threads(cli.threads, || cli.command.run())
        }
        Err(error) if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) => {
            // A closed pipe (`skyprobe --help | head`) is not worth a complaint.
            let _ = error.print();
            return 0;
        }
        Err(error) => {
            complain(&one_line(&error));
            return 2;
        }
    };
    match outcome {
        Ok(()) => 0,
        Err(error) => {
            complain(&format!("error: {error}"));
            match error {
                Error::Input { .. } => 2,
                Error::Data { .. } | Error::Unsolved { .. } | Error::File { .. } => 1,
                Error::Cancelled => terminal::EXIT_CODE,
            }
        }
    }
}

/// Does `work` with `threads` threads, or as many as there are processors.
fn with_threads(threads: Option<u16>, work: impl FnOnce() -> Result<()> + Send) -> Result<()> {
    let Some(threads) = threads else { return work() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build();
    pool.map_err(|error| Error::data(format!("{threads} threads cannot be started: {error}")))?.install(work)
}

/// Whether only what was asked for is said.
static QUIET: AtomicBool = AtomicBool::new(false);

/// Says what was done, on the standard output, unless that is not wanted.
fn say(text: &str) -> Result<()> {
    if QUIET.load(Ordering::Relaxed) { Ok(()) } else { answer(text) }
}

/// Writes what was asked for, `text` and a line break, to the standard output.
fn answer(text: &str) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{}", printable(text)).and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Error::file("standard output", error)),
        _ => Ok(()),
    }
}

fn complain(message: &str) {
    let message = message.split(['\n', '\r']).map(str::trim).collect::<Vec<_>>().join(" ");
    let _ = writeln!(std::io::stderr(), "{}", OneLine(&message, usize::MAX));
}

/// The text without what a terminal takes for a command: names of files and texts in them are others'.
fn printable(text: &str) -> String {
    let shown = |letter: char| if letter.is_control() && !"\n\t".contains(letter) { '\u{fffd}' } else { letter };
    text.chars().map(shown).collect()
}

/// What clap says over several lines, without the usage.
fn one_line(error: &clap::Error) -> String {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return "error: a command is missing: render, info, places, glare or tonemap (see skyprobe --help)".to_string();
    }
    let text = error.render().to_string();
    let lines = text.lines().map(str::trim).take_while(|line| !line.starts_with("Usage:"));
    lines
        .filter(|line| !line.is_empty() && !line.starts_with("For more information"))
        .collect::<Vec<_>>()
        .join(" ")
        .replace(" tip:", "; tip:")
}
