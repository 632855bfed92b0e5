//! `skyprobe completions` and `skyprobe man`: what a shell and `man` want to know of this tool, made from its own options.

use super::{Cli, answer};
use crate::error::{Error, Result};
use clap::{Args, CommandFactory};
use clap_complete::Shell;
use std::path::PathBuf;

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
        return clap_mangen::generate_to(Cli::command(), folder).map_err(|error| Error::file(folder, error));
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
