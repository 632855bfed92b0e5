//! Options that several commands share: the configuration that they start from.

use super::complain;
use crate::error::Result;
use crate::scene::Scene;
use crate::sky::{Atmosphere, Cache};
use clap::Args;
use std::path::{Path, PathBuf};

const CONFIGURATION: &str = "Configuration";

/// A configuration file, and whether to print the result of reading everything.
#[derive(Args)]
pub struct ConfigOptions {
    /// JSON file to start from, or an .exr or .hdr of skyprobe, whose header holds what it was made from; - is the standard input. Options override its values.
    ///
    /// The keys are those that --dump-config prints, and the names of the Python arguments. An unknown key is an error, and so is what would be ignored.
    #[arg(long, value_name = "FILE", help_heading = CONFIGURATION)]
    config: Option<PathBuf>,
    /// Print the whole configuration as JSON, with every default written out, and stop.
    #[arg(long, help_heading = CONFIGURATION)]
    pub dump_config: bool,
    /// Neither use light that was solved earlier nor keep what is solved now.
    ///
    /// It is kept in the folder SKYPROBE_CACHE_DIR, or skyprobe in the system's place for caches (1 GB at most); the environment SKYPROBE_CACHE=off switches that off, too.
    #[arg(long, help_heading = CONFIGURATION)]
    no_cache: bool,
}

impl ConfigOptions {
    /// The air of `config`.
    pub fn atmosphere(&self, config: &Scene) -> Result<Atmosphere> {
        Ok(config.atmosphere()?.with_cache(if self.no_cache { None } else { Cache::of_user() }))
    }

    /// The file that is read, if there is one, with the name of its parameter.
    pub fn input(&self) -> Option<(&str, &Path)> {
        self.config.as_deref().map(|path| ("config", path))
    }

    /// The configuration of the file, or the defaults.
    pub fn read(&self) -> Result<Scene> {
        self.config.as_deref().map_or_else(|| Ok(Scene::default()), Scene::read)
    }
}

/// Says what had to be assumed about the time.
pub fn tell_time(scene: &Scene) {
    if let Some(notice) = scene.time_notice() {
        complain(&format!("note: time: {notice}"));
    }
}
