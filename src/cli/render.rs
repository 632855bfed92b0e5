//! `skyprobe render`: from a place, a time and an air to files.

use super::options::{ConfigOptions, tell_time};
use super::scene_options::{Picture, SceneOptions};
use super::{answer, files, say, terminal};
use crate::error::{Error, Result};
use crate::io::{SampleMap, each_once, render_with};
use crate::probe::ProbeSettings;
use crate::scene::{Scene, describe};
use crate::sky::{Model, Sky};
use clap::Args;
use std::path::PathBuf;
use std::sync::Arc;

const IMAGE: &str = "Image";
const OUTPUT: &str = "Output";

const EXAMPLES: &str = "\
Examples:
  A summer noon in Lund, for Blender (world environment texture; no rotation needed):
    skyprobe render --place \"Lund, Sweden\" --time 2005-06-21T13:00 -o lund.exr
  The same without the Sun's disc, to be used with a Sun lamp, and a picture to look at:
    skyprobe render --lat 55.71 --lon 13.19 --time 2005-06-21T13:00 --no-sun-disc -o lund.exr -o lund.png
  Hazy air over a city, 8k:
    skyprobe render --lat -33.87 --lon 151.21 --time 2024-01-10T18:30 --aerosol urban --visibility 12 \\
      --ground city --width 8192 -o sydney.exr
  A Sun put at 30 degrees in the south, for Mitsuba (envmap; rotate x by 90, then z by 90 degrees):
    skyprobe render --sun-altitude 30 --sun-azimuth 180 --rows corner --scale mitsuba -o sky.exr
  The same sky through a polarising filter that is held towards the east, 90 degrees from the Sun:
    skyprobe render --sun-altitude 30 --sun-azimuth 180 --polarising-filter 1 --filter-towards 20,90 -o dark.png
  A low Sun in the west, which would stand on the seam of the picture, in the middle of it:
    skyprobe render --sun-altitude 5 --sun-azimuth 270 --centre sun -o evening.exr
  A landscape under the full Moon; only the stars, the Moon and the Milky Way of the same night, each in channels of its own:
    skyprobe render --lat 55.71 --lon 13.19 --time 2005-01-25T00:30 --no-sun-disc -o moonlight.exr
    skyprobe render --lat 55.71 --lon 13.19 --time 2005-01-25T00:30 --layer sky=0 --layer zodiacal=0 --layer airglow=0 \\
      --separate-layers -o layers.exr
  The Milky Way over Chile without the Moon, at 8k, stars twice as bright as they are:
    skyprobe render --lat -24.63 --lon -70.40 --elevation 2635 --time 2005-07-06T00:00 --layer stars=2 --width 8192 -o paranal.exr
  The same night over the lit edge of a town:
    skyprobe render --lat -24.63 --lon -70.40 --time 2005-07-06T00:00 --bortle 6 --led-share 0.2 -o town.exr
  Write a configuration, change it by hand, render it:
    skyprobe render --lat 55.71 --lon 13.19 --time 2005-06-21T13:00 -o lund.exr --dump-config > lund.json
    skyprobe render --config lund.json --width 512

The image: linear; a latitude-longitude map has the zenith in row 0, north at 1/4 of the width, east in the centre,
south at 3/4, unless --turn or --centre turn it. Files appear whole or not at all. The EXR header holds the whole configuration.
";

/// Options of `skyprobe render`.
#[derive(Args)]
#[command(allow_negative_numbers = true, after_long_help = EXAMPLES, after_help = "Examples and longer explanations: skyprobe render --help")]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions<Picture>,
    /// Turn the sky so that the sun, the moon or an azimuth [degrees] stands in the middle column of a latlong picture, away from its seam.
    #[arg(long, value_name = "sun|moon|DEG", conflicts_with = "turn", help_heading = IMAGE)]
    centre: Option<String>,
    /// Write a picture (.png) of the directions in which light was gathered.
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    sample_map: Option<PathBuf>,
    /// File to write: .exr (float, ZIP), .hdr (Radiance RGBE) or .png (tone mapped, to look at). May be given several times.
    #[arg(short, long, value_name = "FILE", help_heading = OUTPUT)]
    output: Vec<PathBuf>,
    /// Another file, a tone-mapped picture (.png).
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    preview: Option<PathBuf>,
    #[command(flatten)]
    config: ConfigOptions,
}

impl Options {
    /// The turn that brings what is asked for into the middle of the picture; `None` if nothing is.
    fn turn_to_centre(&self, sky: &Sky) -> Result<Option<f64>> {
        let Some(text) = &self.centre else { return Ok(None) };
        let azimuth_deg = match (text.as_str(), sky.bodies_of_place()) {
            ("sun", _) => sky.sun().azimuth_deg,
            ("moon", Some(bodies)) => bodies.moon.body.azimuth_deg,
            ("moon", None) => return Err(Error::input("centre", "moon", "sun or an azimuth for a sky without place and time")),
            _ => match text.parse() {
                Ok(azimuth_deg) => azimuth_deg,
                Err(_) => {
                    return Err(Error::input("centre", format!("{text:?}"), "sun, moon or an azimuth from -360 to 360 degrees"));
                }
            },
        };
        ProbeSettings::turn_to_centre(azimuth_deg).map(Some)
    }

    fn config(&self) -> Result<Scene> {
        let mut config = self.config.read()?;
        if !self.output.is_empty() {
            config.output.clone_from(&self.output);
        }
        if let Some(preview) = &self.preview {
            if !preview.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("png")) {
                return Err(Error::input("preview", preview.display(), "a file name that ends in .png"));
            }
            config.output.push(preview.clone());
        }
        config.output = each_once(&config.output).into_iter().cloned().collect();
        // Judged with the files that are asked for.
        let config = self.scene.over(config)?;
        if let Some(path) = &self.sample_map {
            SampleMap::check_name(path)?;
            if config.light.model != Model::Scattering {
                return Err(Error::input("sample_map", path.display(), "left out for a model other than scattering"));
            }
        }
        Ok(config)
    }
}

/// Width of the picture of samples [pixels].
const SAMPLE_MAP_WIDTH: usize = 1024;

/// Renders, and writes the files.
pub fn run(options: &Options) -> Result<()> {
    render(options).map_err(|error| options.scene.as_typed(error))
}

fn render(options: &Options) -> Result<()> {
    let mut config = options.config()?;
    let inputs = options.config.input();
    tell_time(&config);
    if options.config.dump_config {
        files::check(inputs.as_slice(), &[])?;
    }
    if options.config.dump_config && options.centre.is_none() {
        return answer(&config.to_json());
    }
    let sky = config.sky(Arc::new(options.config.atmosphere(&config)?))?;
    config.probe.turn_deg = options.turn_to_centre(&sky)?.unwrap_or(config.probe.turn_deg);
    if options.config.dump_config {
        return answer(&config.to_json());
    }
    if config.output.is_empty() && options.sample_map.is_none() {
        return Err(Error::input("output", "nothing", "given, such as -o sky.exr"));
    }
    let outputs = config.output.iter().map(|path| ("output", path.as_path()));
    let sample_map = options.sample_map.iter().map(|path| ("sample_map", path.as_path()));
    files::check(inputs.as_slice(), &outputs.chain(sample_map).collect::<Vec<_>>())?;
    if config.file.layers && config.output.is_empty() {
        return Err(Error::input("file.layers", "true", "left out without an output that ends in .exr"));
    }
    if let (Some(label), Some(place)) = (&config.place_label, sky.place()) {
        say(&format!("place: {label} ({}, {}; {} m)", place.latitude_deg, place.longitude_deg, place.elevation_m))?;
    }
    terminal::with_progress(|progress| {
        let mut others = Vec::new();
        if let Some(path) = &options.sample_map {
            let light = sky.filtered_light(config.light.polarising_filter.as_ref(), config.light.tolerance, progress)?;
            let map = SampleMap::new(&light, SAMPLE_MAP_WIDTH, config.probe.turn_deg, progress)?;
            if config.output.is_empty() {
                return map.save(path, progress);
            }
            others.push(map.written(path, progress)?);
        }
        let metadata = describe(&sky, config.sun_model, &config.light, &config.probe);
        let light = sky.light_by(&config.light, progress)?;
        render_with(others, (&light, &config.probe), &config.output, (&config.file, &metadata), progress)
    })?;
    let (width, height, sun) = (config.probe.width, config.probe.height(), sky.sun());
    let sun = format!("Sun at altitude {:.3} deg, azimuth {:.3} deg", sun.altitude_deg, sun.azimuth_deg);
    if let Some(path) = &options.sample_map {
        say(&format!("{}: samples", path.display()))?;
    }
    config.output.iter().try_for_each(|path| say(&format!("{}: {width} x {height}, {sun}", path.display())))
}
