//! `skyprobe completions` and `skyprobe man`: what a shell and `man` want to know of this tool, made from its own options.

use super::{Cli, answer, files};
use crate::error::{Error, Result};
use crate::io::atomic::{Pending, commit};
use crate::progress::Progress;
use clap::{Args, CommandFactory};
use clap_complete::Shell;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Options of `skyprobe completions`.
#[derive(Args)]
pub struct CompletionOptions {
    /// The shell.
    #[arg(value_enum, value_name = "SHELL")]
    shell: Shell,
}

/// Options of `skyprobe man`.
#[derive(Args)]
pub struct ManOptions {
    /// Command whose page is wanted, such as render. Default: the page of the tool itself.
    #[arg(value_name = "COMMAND")]
    command: Option<String>,
    /// Write the pages of the tool and of all its commands into this existing folder instead, as skyprobe.1, skyprobe-render.1 and so on.
    #[arg(long, value_name = "FOLDER", conflicts_with = "command")]
    folder: Option<PathBuf>,
}

/// Prints the script that completes commands and options in a shell.
pub fn completions(options: &CompletionOptions) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut Cli::command(), "skyprobe", &mut script);
    answer(String::from_utf8_lossy(&script).trim_end())
}

/// Prints a manual page, or writes all of them.
pub fn man(options: &ManOptions) -> Result<()> {
    if let Some(folder) = &options.folder {
        if !folder.is_dir() {
            return Err(Error::input("folder", folder.display(), "an existing folder"));
        }
        return write_pages(folder);
    }
    let mut tool = Cli::command();
    tool.build();
    let page = match &options.command {
        None => tool,
        Some(name) => match tool.find_subcommand(name).filter(|command| command.get_name() != "help") {
            Some(command) => command.clone(),
            None => {
                let names: Vec<_> = tool.get_subcommands().map(clap::Command::get_name).filter(|name| *name != "help").collect();
                return Err(Error::input("command", format!("{name:?}"), format!("one of {}", names.join(", "))));
            }
        },
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(page).render(&mut text).map_err(|error| Error::file("standard output", error))?;
    answer(String::from_utf8_lossy(&text).trim_end())
}

/// Writes the pages of the tool and of all its commands into `folder`: all or none.
fn write_pages(folder: &Path) -> Result<()> {
    let mut tool = Cli::command().disable_help_subcommand(true);
    tool.build();
    let commands = std::iter::once(&tool).chain(tool.get_subcommands().filter(|command| !command.is_hide_set()));
    let pages: Vec<_> = commands.map(|command| clap_mangen::Man::new(command.clone())).collect();
    let paths: Vec<PathBuf> = pages.iter().map(|page| folder.join(page.get_filename())).collect();
    files::check_texts(&paths.iter().map(|path| ("page", path.as_path())).collect::<Vec<_>>())?;
    let written = pages.iter().zip(&paths).map(|(page, path)| {
        Pending::written(path, |file| page.render(file as &mut dyn Write).map_err(|error| Error::file(path, error)))
    });
    commit(written.collect::<Result<Vec<_>>>()?, &Progress::silent())
}
