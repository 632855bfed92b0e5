//! `skyprobe info`: where Sun, Moon and planets are, their day, and the light that arrives.

mod json;
mod text;

use super::options::{ConfigOptions, tell_time};
use super::scene_options::{SceneOptions, SkyAlone};
use super::{answer, files, terminal};
use crate::ephemeris::{Body, MoonPhase, RiseAndSet, SunEvents, Target, next_moon_phases, rise_and_set, sun_events};
use crate::error::Result;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::sky::{Illuminance, Sky};
use crate::time::Time;
use clap::Args;
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  The Sun over Ithaca, and how much light it sends through clear air:
    skyprobe info --place \"Ithaca, New York\" --time 2013-05-27T12:00
  The night: planets above the horizon, the Moon's day and next phases, and how dark it is under a suburban sky:
    skyprobe info --lat 55.71 --lon 13.19 --time 2005-01-10T23:00 --bortle 5
  The same for a program, without the light (which takes a second or two to solve):
    skyprobe info --lat 55.71 --lon 13.19 --time 2005-01-10T23:00 --no-light --json

Times are local, in the zone that is named. Sunrise and sunset are those of almanacs: centre of the Sun at -50 arcminutes,
level horizon. Twilights: civil to -6, nautical to -12, astronomical to -18 degrees. The Moon rises and sets with its upper limb,
34 arcminutes of refraction. Magnitudes are those outside the air.
";

/// Options of `skyprobe info`.
#[derive(Args)]
#[command(allow_negative_numbers = true, after_long_help = EXAMPLES, after_help = "Examples: skyprobe info --help")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions<SkyAlone>,
    /// Print JSON instead of text.
    #[arg(long)]
    json: bool,
    /// Leave out illuminance and irradiance, which need the light to be solved.
    #[arg(long)]
    no_light: bool,
    #[command(flatten)]
    config: ConfigOptions,
}

/// Prints the report.
pub fn run(options: &Options) -> Result<()> {
    tell(options).map_err(|error| options.scene.as_typed(error))
}

fn tell(options: &Options) -> Result<()> {
    files::check(options.config.input().as_slice(), &[])?;
    let config = options.scene.over(options.config.read()?)?;
    if options.config.dump_config {
        tell_time(&config);
        return answer(&config.to_json());
    }
    let sky = config.sky(Arc::new(options.config.atmosphere(&config)?))?;
    let mut day = None;
    if let (Some(place), Some(time)) = (sky.place(), sky.time()) {
        day = Some(Day {
            sun: sun_events(place, time)?,
            moon: rise_and_set(Target::Moon, place, time)?,
            phases: next_moon_phases(time)?,
        });
    }
    let light = if options.no_light { None } else { Some(terminal::with_progress(|progress| Light::of(&sky, progress))?) };
    let report = Report { sky: &sky, config: &config, day, light };
    if options.json { answer(&format!("{:#}", report.as_json())) } else { answer(&report.as_text()) }
}

/// All that is told.
struct Report<'a> {
    sky: &'a Sky,
    config: &'a Scene,
    day: Option<Day>,
    light: Option<Light>,
}

/// What happens on the local date, and the phases that come.
struct Day {
    sun: SunEvents,
    moon: RiseAndSet,
    phases: Vec<(MoonPhase, Time)>,
}

impl Day {
    /// The Moon's phase in words, by the next one that has a date.
    fn phase(&self) -> &'static str {
        match self.phases.first() {
            Some((MoonPhase::FirstQuarter, _)) => "waxing crescent",
            Some((MoonPhase::Full, _)) => "waxing gibbous",
            Some((MoonPhase::LastQuarter, _)) => "waning gibbous",
            Some((MoonPhase::New, _)) | None => "waning crescent",
        }
    }
}

/// Whether any of the disc is above a level horizon.
fn is_up(body: &Body) -> bool {
    body.apparent_altitude_deg + 0.5 * body.angular_diameter_deg > 0.0
}

/// What arrives, in luminous and in radiant units.
struct Light {
    illuminance: Illuminance,
    /// By the Sun: in the order of [`KINDS`].
    irradiance_w_m2: [f64; 3],
    from_nm: f64,
    to_nm: f64,
}

/// The kinds of irradiance.
const KINDS: [&str; 3] = ["direct_normal", "direct_horizontal", "diffuse_horizontal"];

impl Light {
    fn of(sky: &Sky, progress: &Progress<'_>) -> Result<Self> {
        let illuminance = sky.illuminance(progress)?;
        let wavelengths_nm = &sky.atmosphere().profile().wavelengths_nm;
        let spectrum = sky.irradiance(wavelengths_nm, progress)?;
        let integral = |values: &[f64]| -> f64 {
            let steps = wavelengths_nm.windows(2).zip(values.windows(2));
            steps.map(|(nm, value)| (nm[1] - nm[0]) * 0.5 * (value[0] + value[1])).sum()
        };
        Ok(Self {
            illuminance,
            irradiance_w_m2: [&spectrum.direct_normal, &spectrum.direct_horizontal, &spectrum.diffuse_horizontal]
                .map(|values| integral(values)),
            from_nm: wavelengths_nm[0],
            to_nm: wavelengths_nm[wavelengths_nm.len() - 1],
        })
    }
}

/// The events of a day in order, with their names.
fn named(events: &SunEvents) -> [(&'static str, Option<&Time>); 9] {
    [
        ("astronomical dawn", events.astronomical_dawn.as_ref()),
        ("nautical dawn", events.nautical_dawn.as_ref()),
        ("civil dawn", events.civil_dawn.as_ref()),
        ("sunrise", events.sunrise.as_ref()),
        ("solar noon", Some(&events.solar_noon)),
        ("sunset", events.sunset.as_ref()),
        ("civil dusk", events.civil_dusk.as_ref()),
        ("nautical dusk", events.nautical_dusk.as_ref()),
        ("astronomical dusk", events.astronomical_dusk.as_ref()),
    ]
}

/// Where the zone comes from.
fn zone_source(config: &Scene, time: &Time) -> &'static str {
    match (&config.zone, time.zone_name()) {
        (Some(_), _) => "as given",
        (None, Some("UTC")) => "as the time says",
        (None, Some(_)) if config.time.as_deref().is_some_and(|text| text.contains('[')) => "as the time says",
        (None, Some(_)) => "found from the place",
        (None, None) => "offset as the time says",
    }
}
