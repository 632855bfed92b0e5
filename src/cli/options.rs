//! Options that several commands share: where, when, under which air. Each overrides the value of the configuration.

use super::complain;
use crate::error::Result;
use crate::scene::Scene;
use crate::sky::{Atmosphere, Cache};
use clap::Args;
use std::path::{Path, PathBuf};

const PLACE: &str = "Place and time";
const CONFIGURATION: &str = "Configuration";

/// A configuration file, and whether to print the result of reading everything.
#[derive(Args)]
pub struct ConfigOptions {
    /// JSON file to start from, or an .exr or .hdr of skyprobe, whose header holds what it was made from; - is the standard input. Options override its values.
    ///
    /// The keys are those that --dump-config prints, and the names of the Python arguments. An unknown key is an error.
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

/// Where and when, or a Sun that is put.
#[derive(Args)]
pub struct PlaceOptions {
    /// A town, a country, an island, a landmark or an observatory by its name, with region or country where there are several ("Lund, Sweden",
    /// "portland, maine", "Santorini"), or coordinates in any spelling ("55.71, 13.19", "55 42 36 N 13 11 24 E", a link to a map).
    ///
    /// Of several places the one with the most inhabitants is taken, and told; `skyprobe places NAME` lists them. A country stands where its capital is. It
    /// gives the elevation, too: that of the town, or roughly that of the land at coordinates.
    #[arg(long, value_name = "NAME", allow_hyphen_values = true, conflicts_with_all = ["latitude", "longitude"], help_heading = PLACE)]
    place: Option<String>,
    /// Latitude, north positive, -90 to 90 [degrees].
    #[arg(long, visible_alias = "lat", value_name = "DEG", value_parser = decimal, help_heading = PLACE)]
    latitude: Option<f64>,
    /// Longitude, east positive, -180 to 180 [degrees].
    #[arg(long, visible_alias = "lon", value_name = "DEG", value_parser = decimal, help_heading = PLACE)]
    longitude: Option<f64>,
    /// Height of the observer above the sea, -500 to 60000 [m]. Default: that of --place, else 0.
    #[arg(long, value_name = "M", value_parser = decimal, help_heading = PLACE)]
    elevation: Option<f64>,
    /// Date and time (ISO 8601): 2005-06-21T13:00:00+02:00, 2005-06-21T11:00Z, 2005-06-21T13:00, "2005-06-21 13:00"; a date alone is its noon; now.
    ///
    /// Without an offset it is local time in the zone of the place, daylight saving included (or in --zone). What has to be assumed (clocks show it
    /// never or twice, noon) is told.
    #[arg(long, value_name = "TIME", help_heading = PLACE)]
    time: Option<String>,
    /// IANA time zone, such as Europe/Stockholm. Default: found from the place, offline.
    #[arg(long, value_name = "NAME", help_heading = PLACE)]
    zone: Option<String>,
    /// By which theory the Sun stands where it does: iau, or thesis (low precision). Default: iau.
    #[arg(long, value_name = "MODEL", help_heading = PLACE)]
    sun_model: Option<String>,
    /// Instead of place and time: altitude of the Sun, -90 to 90 [degrees, without refraction].
    #[arg(long, value_name = "DEG", requires = "sun_azimuth", conflicts_with_all = ["place", "latitude", "longitude", "time", "zone"],
          help_heading = PLACE)]
    sun_altitude: Option<f64>,
    /// Instead of place and time: azimuth of the Sun, from north through east [degrees].
    #[arg(long, value_name = "DEG", requires = "sun_altitude", help_heading = PLACE)]
    sun_azimuth: Option<f64>,
}

impl PlaceOptions {
    /// Writes what was given over `config`.
    pub fn apply(&self, config: &mut Scene) -> Result<()> {
        if self.place.is_some() || self.latitude.is_some() || self.longitude.is_some() || self.time.is_some() {
            config.sun = None;
        }
        if self.latitude.is_some() || self.longitude.is_some() || self.sun_altitude.is_some() {
            config.place_label = None;
        }
        if let Some(text) = &self.place {
            config.set_place(text)?;
        }
        if let (Some(altitude_deg), Some(azimuth_deg)) = (self.sun_altitude, self.sun_azimuth) {
            (config.latitude, config.longitude, config.time, config.zone) = (None, None, None, None);
            config.sun = Some(crate::scene::SunPosition { altitude_deg, azimuth_deg });
        }
        config.latitude = self.latitude.or(config.latitude);
        config.longitude = self.longitude.or(config.longitude);
        config.elevation_m = self.elevation.unwrap_or(config.elevation_m);
        config.time = self.time.clone().or(config.time.take());
        config.zone = self.zone.clone().or(config.zone.take());
        if let Some(model) = &self.sun_model {
            config.sun_model = model.parse()?;
        }
        if config.settle_now()? {
            complain(&format!("note: time: now is {}", config.time.as_deref().unwrap_or_default()));
        }
        Ok(())
    }
}

/// A number, with a decimal point or a decimal comma.
fn decimal(text: &str) -> std::result::Result<f64, String> {
    let commas = text.matches(',').count();
    let has_one_comma = commas == 1 && !text.contains('.') && !text.starts_with(',') && !text.ends_with(',');
    let pointed = if has_one_comma { text.replace(',', ".") } else { text.to_string() };
    let hint = if commas > 0 { ": one number, with a decimal point; --place takes both coordinates" } else { "" };
    pointed.trim().parse().map_err(|_| format!("it must be a number{hint}"))
}

/// Says what had to be assumed about the time.
pub fn tell_time(config: &Scene) {
    if let Some(notice) = config.time_notice() {
        complain(&format!("note: time: {notice}"));
    }
}
