//! The command line tool: one file a command.
//!
//! Exit codes: 0 done, 1 failed while working (such as a full disk), 2 wrong input (one line says which), 130 cancelled.

mod air_options;
mod glare;
mod info;
mod night_options;
mod options;
mod picture_options;
mod places;
mod render;
mod terminal;
mod tonemap;

use crate::error::{Error, Result};
use clap::error::ErrorKind;
use clap::{Parser, Subcommand};
use std::ffi::OsString;
use std::io::Write;

/// The light of the sky for a place, a time and a state of the air, as a high dynamic range light probe.
#[derive(Parser)]
#[command(name = "skyprobe", version, max_term_width = 100, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

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
}

const EXIT_CODES: &str = "\
Exit codes: 0 done, 1 failed while working, 2 wrong input, 130 cancelled.
`skyprobe render --help` explains every option with its unit and default, and has examples.";

/// Runs the tool with `arguments`, the first being the program's name, and returns the exit code.
///
/// Results go to the standard output; an error is one line on the standard error.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let outcome = match Cli::try_parse_from(arguments) {
        Ok(cli) => match cli.command {
            Command::Render(options) => render::run(&options),
            Command::Info(options) => info::run(&options),
            Command::Places(options) => places::run(&options),
            Command::Glare(options) => glare::run(&options),
            Command::Tonemap(options) => tonemap::run(&options),
        },
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

/// Writes `text` and a line break to the standard output.
fn say(text: &str) -> Result<()> {
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => Err(Error::file("standard output", error)),
        _ => Ok(()),
    }
}

fn complain(message: &str) {
    let _ = writeln!(std::io::stderr(), "{}", message.split(['\n', '\r']).map(str::trim).collect::<Vec<_>>().join(" "));
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
