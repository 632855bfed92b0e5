//! `skyprobe render`: from a place, a time and an air to files.

use super::air_options::AirOptions;
use super::night_options::NightCommandOptions;
use super::options::{ConfigOptions, PlaceOptions, tell_time};
use super::{answer, files, say, terminal};
use crate::error::{Error, Result, check_range};
use crate::io::{Format, SampleMap, each_once, render_with};
use crate::probe::{MAX_WIDTH, MIN_WIDTH, ProbeSettings};
use crate::scene::{Scene, describe};
use crate::sky::{Layer, Model, PolarisingFilter, Sky};
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
    place: PlaceOptions,
    #[command(flatten)]
    air: AirOptions,
    #[command(flatten)]
    night: NightCommandOptions,
    #[command(flatten)]
    image: ImageOptions,
    /// By which model the sky is rendered: scattering (solved light: day, twilight, night) preetham (the analytic sky of 1999, by day at
    /// turbidities from 2 to 10), thesis or thesis_single (ray marching with random steps, light scattered at most twice or once: noisy, for small
    /// images). Only scattering knows the night. Default: scattering.
    #[arg(long, value_name = "NAME", help_heading = IMAGE)]
    model: Option<String>,
    /// See the sky through a polarising filter of this strength, 0 to 1 (ideal), exposed so that unpolarised light stays as it is.
    #[arg(long, value_name = "STRENGTH", help_heading = IMAGE)]
    polarising_filter: Option<f64>,
    /// Angle of the filter's axis from the vertical, clockwise as one sees it, -180 to 180 [degrees]. Default: 0.
    #[arg(long, value_name = "DEG", help_heading = IMAGE)]
    filter_angle: Option<f64>,
    /// Hold the filter towards this altitude and azimuth [degrees], one piece of glass for the whole picture; otherwise it turns with the view.
    #[arg(long, value_name = "ALT,AZ", value_delimiter = ',', num_args = 1, help_heading = IMAGE)]
    filter_towards: Option<Vec<f64>>,
    /// Relative error that interpolated directions may have, 0.0001 to 0.5. Default: as many directions as the quality says.
    #[arg(long, value_name = "SHARE", help_heading = IMAGE)]
    tolerance: Option<f64>,
    /// Multiply the light of a layer by a factor, 0 (left out) to 1e9, as in stars=2. May be given several times.
    ///
    /// Layers: sky (light scattered by the air, and the ground), sun, moon, stars, planets, milky_way, zodiacal, airglow, light_pollution.
    #[arg(long, value_name = "NAME=FACTOR", help_heading = IMAGE)]
    layer: Vec<String>,
    /// Write each layer into EXR files beside their sum, in channels such as stars.R.
    #[arg(long, help_heading = OUTPUT)]
    separate_layers: bool,
    /// Write a picture (.png) of the directions in which light was gathered.
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    sample_map: Option<PathBuf>,
    /// File to write: .exr (float, ZIP), .hdr (Radiance RGBE) or .png (tone mapped, to look at). May be given several times.
    #[arg(short, long, value_name = "FILE", help_heading = OUTPUT)]
    output: Vec<PathBuf>,
    /// Another file, a tone-mapped picture (.png).
    #[arg(long, value_name = "FILE", help_heading = OUTPUT)]
    preview: Option<PathBuf>,
    /// Write EXR files with half floats, which end at 65504, below the Sun's disc in most scales.
    ///
    /// refuse (the default of this option): a brighter pixel is an error. scale: all pixels are multiplied by a power of two, which the
    /// header states. off: float32, which is the default without this option.
    #[arg(long, value_name = "NAME", num_args = 0..=1, require_equals = true, default_missing_value = "refuse", help_heading = OUTPUT)]
    half: Option<String>,
    /// Exposure of PNG files relative to the automatic one, -20 to 20 [stops]. Default: 0.
    #[arg(long, value_name = "STOPS", help_heading = OUTPUT)]
    exposure: Option<f64>,
    /// Tone mapping operator of PNG files: sky, filmic, aces, exposure, reinhard, reinhard_local, ashikhmin, logarithmic or linear. Default: sky.
    /// More choices: skyprobe tonemap, on an EXR or HDR file.
    #[arg(long, value_name = "NAME", help_heading = OUTPUT)]
    operator: Option<String>,
    #[command(flatten)]
    config: ConfigOptions,
}

/// What the image is.
#[derive(Args)]
struct ImageOptions {
    /// Width, 64 to 16384 [pixels]. Default: 2048. The height follows: half of it for a full latitude-longitude map.
    #[arg(long, value_name = "PX", help_heading = IMAGE)]
    width: Option<i64>,
    /// latlong, or fisheye (zenith in the centre). Default: latlong.
    #[arg(long, value_name = "NAME", help_heading = IMAGE)]
    projection: Option<String>,
    /// centre (Blender and most viewers) or corner (Mitsuba: first and last row on the poles). Default: centre.
    #[arg(long, value_name = "NAME", help_heading = IMAGE)]
    rows: Option<String>,
    /// full sphere, or the upper half. Default: full.
    #[arg(long, value_name = "NAME", help_heading = IMAGE)]
    extent: Option<String>,
    /// Turn the sky in the picture clockwise as seen from above, to the right, by this angle, -360 to 360 [degrees]. Default: 0.
    #[arg(long, value_name = "DEG", help_heading = IMAGE)]
    turn: Option<f64>,
    /// Turn the sky so that the sun, the moon or an azimuth [degrees] stands in the middle column of a latlong picture, away from its seam.
    #[arg(long, value_name = "sun|moon|DEG", conflicts_with = "turn", help_heading = IMAGE)]
    centre: Option<String>,
    /// What is seen below the horizon: on (the lit ground), off (black) or mirrored (the sky again). Default: on.
    #[arg(long, value_name = "NAME", help_heading = IMAGE)]
    ground_view: Option<String>,
    /// Leave the Sun's disc out, to light the scene with a Sun lamp.
    #[arg(long, help_heading = IMAGE, overrides_with = "sun_disc")]
    no_sun_disc: bool,
    /// Draw the Sun's disc, which is the default, over a configuration without it.
    #[arg(long, help_heading = IMAGE, overrides_with = "no_sun_disc")]
    sun_disc: bool,
    /// Leave the Moon's disc out, to light the scene with a lamp for it.
    #[arg(long, help_heading = IMAGE, overrides_with = "moon_disc")]
    no_moon_disc: bool,
    /// Draw the Moon's disc, which is the default, over a configuration without it.
    #[arg(long, help_heading = IMAGE, overrides_with = "no_moon_disc")]
    moon_disc: bool,
    /// What 1.0 means: blender (luminance / 683), mitsuba (mean W m-2 sr-1 nm-1) or luminance (cd m-2). Default: blender.
    #[arg(long, value_name = "NAME", help_heading = IMAGE)]
    scale: Option<String>,
    /// lin_rec709, acescg, lin_rec2020 or xyz; always linear. Default: lin_rec709.
    #[arg(long, value_name = "NAME", help_heading = IMAGE)]
    color_space: Option<String>,
    /// Colours outside that space: desaturate, clip or keep (as negative numbers). Default: desaturate.
    #[arg(long, value_name = "NAME", help_heading = IMAGE)]
    gamut: Option<String>,
}

impl ImageOptions {
    fn apply(&self, config: &mut Scene) -> Result<()> {
        let probe = &mut config.probe;
        if let Some(width) = self.width {
            probe.width = check_range("width", width as f64, MIN_WIDTH as f64, MAX_WIDTH as f64, "pixels")? as usize;
        }
        if let Some(name) = &self.projection {
            probe.projection = name.parse()?;
        }
        if let Some(name) = &self.rows {
            probe.rows = name.parse()?;
        }
        if let Some(name) = &self.extent {
            probe.extent = name.parse()?;
        }
        probe.turn_deg = self.turn.unwrap_or(probe.turn_deg);
        if let Some(name) = &self.ground_view {
            probe.ground = name.parse()?;
        }
        if self.no_sun_disc || self.sun_disc {
            probe.sun_disc = self.sun_disc;
        }
        if self.no_moon_disc || self.moon_disc {
            probe.moon_disc = self.moon_disc;
        }
        if let Some(name) = &self.scale {
            probe.scale = name.parse()?;
        }
        if let Some(name) = &self.color_space {
            probe.color_space = name.parse()?;
        }
        if let Some(name) = &self.gamut {
            probe.gamut = name.parse()?;
        }
        Ok(())
    }

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
}

impl Options {
    fn config(&self) -> Result<Scene> {
        let mut config = self.config.read()?;
        self.place.apply(&mut config)?;
        self.air.apply(&mut config)?;
        self.night.apply(&mut config.night)?;
        self.image.apply(&mut config)?;
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
        if let Some(name) = &self.model {
            config.light.model = name.parse()?;
        }
        self.apply_filter(&mut config.light.polarising_filter)?;
        config.light.tolerance = self.tolerance.or(config.light.tolerance);
        for text in &self.layer {
            let (layer, factor) = layer_and_factor(text)?;
            config.light.layers.0.insert(layer, factor);
        }
        config.file.layers |= self.separate_layers;
        if let Some(name) = &self.half {
            config.file.half = name.parse()?;
        }
        config.file.exposure_stops = self.exposure.unwrap_or(config.file.exposure_stops);
        if let Some(name) = &self.operator {
            config.file.operator = name.parse()?;
        }
        config.validate()?;
        if let Some(path) = &self.sample_map {
            SampleMap::check_name(path)?;
            if config.light.model != Model::Scattering {
                return Err(Error::input("sample_map", path.display(), "left out for a model other than scattering"));
            }
        }
        Ok(config)
    }

    fn apply_filter(&self, filter: &mut Option<PolarisingFilter>) -> Result<()> {
        if let Some(strength) = self.polarising_filter {
            filter.get_or_insert_default().strength = strength;
        }
        let Some(filter) = filter else {
            return match (self.filter_angle, &self.filter_towards) {
                (None, None) => Ok(()),
                _ => Err(Error::input("polarising_filter", "nothing", "given, to turn it or to hold it towards a direction")),
            };
        };
        filter.angle_deg = self.filter_angle.unwrap_or(filter.angle_deg);
        match self.filter_towards.as_deref() {
            None => {}
            Some(&[altitude, azimuth]) => filter.held_towards_deg = Some([altitude, azimuth]),
            Some(other) => {
                return Err(Error::input(
                    "filter_towards",
                    format!("{} numbers", other.len()),
                    "altitude and azimuth, such as 30,180",
                ));
            }
        }
        Ok(())
    }
}

/// Width of the picture of samples [pixels].
const SAMPLE_MAP_WIDTH: usize = 1024;

/// Renders, and writes the files.
pub fn run(options: &Options) -> Result<()> {
    let mut config = options.config()?;
    let inputs = options.config.input();
    tell_time(&config);
    if options.config.dump_config {
        files::check(inputs.as_slice(), &[])?;
    }
    if options.config.dump_config && options.image.centre.is_none() {
        return answer(&config.to_json());
    }
    let sky = config.sky(Arc::new(options.config.atmosphere(&config)?))?;
    config.probe.turn_deg = options.image.turn_to_centre(&sky)?.unwrap_or(config.probe.turn_deg);
    if options.config.dump_config {
        return answer(&config.to_json());
    }
    if config.output.is_empty() && options.sample_map.is_none() {
        return Err(Error::input("output", "nothing", "given, such as -o sky.exr"));
    }
    let outputs = config.output.iter().map(|path| ("output", path.as_path()));
    let sample_map = options.sample_map.iter().map(|path| ("sample_map", path.as_path()));
    files::check(inputs.as_slice(), &outputs.chain(sample_map).collect::<Vec<_>>())?;
    let is_exr = |path: &PathBuf| Format::of(path).is_ok_and(|format| format == Format::Exr);
    if options.separate_layers && !config.output.iter().any(is_exr) {
        return Err(Error::input("separate_layers", "true", "left out without an output that ends in .exr"));
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

/// Reads a text such as `stars=2`.
fn layer_and_factor(text: &str) -> Result<(Layer, f64)> {
    let (name, factor) = text.split_once('=').unwrap_or((text, ""));
    let layer: Layer = name.trim().parse()?;
    let factor = factor.trim().parse();
    Ok((layer, factor.map_err(|_| Error::input("layer", format!("{text:?}"), "NAME=FACTOR, such as stars=2"))?))
}
