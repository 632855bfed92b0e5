//! `skyprobe tonemap`: from light to a screen.

use super::picture_options::{PictureOptions, repairs_in_words};
use super::seconds::seconds;
use super::{files, say, terminal};
use crate::error::{Error, Result};
use crate::io::{Depth, Format, each_once, write_sheet, write_toned};
use crate::post::tone::{Adaptation, Display, Exposure, Metering, Operator, OperatorName, Sheet, ToneMapper, ToneMapping};
use clap::Args;
use std::path::{Path, PathBuf};

const EXPOSURE: &str = "Exposure";
const OUTPUT: &str = "Output";
const SEQUENCE: &str = "Sequences";

const EXAMPLES: &str = "\
Examples:
  A probe to look at, by the operator made for skies:
    skyprobe tonemap lund.exr lund.png
  A scene by another operator, a stop brighter, 16 bits:
    skyprobe tonemap scene.exr scene.png --operator filmic --set contrast=2.8 --exposure 1 --depth 16
  As a camera at f/8, 1/250 s, ISO 100 would have it:
    skyprobe tonemap scene.exr scene.png --operator exposure --aperture 8 --shutter 1/250 --iso 100
  All operators on one sheet:
    skyprobe tonemap scene.exr sheet.png --compare
  A time-lapse from day to night, 24 frames a second, into an existing folder:
    skyprobe tonemap frames/*.exr film/

Operators and their numbers (--set NAME=VALUE):
  sky             made for skies by day and night: key, darkening, rods, blue_shift, acuity_loss, colour_contrast, shoulder
  filmic          in the manner of AgX: contrast, inset, power
  aces            ACES 1.0 as fitted by S. Hill
  exposure        1 - exp(-light), per channel
  reinhard        Reinhard et al. 2002, global: white (0: the brightest of the picture)
  reinhard_local  the same, dodging and burning: sharpening, threshold, scales
  ashikhmin       Ashikhmin 2002: threshold, largest_scale, stretch
  logarithmic     clamped: white, middle
  linear          clamped: white

The input is EXR or HDR, of any program; the output PNG, or EXR or HDR with the light of the screen from 0 to 1.
";

/// Options of `skyprobe tonemap`.
#[derive(Args)]
#[command(allow_negative_numbers = true, after_long_help = EXAMPLES, after_help = "Examples, operators and their numbers: skyprobe tonemap --help")]
pub struct Options {
    /// Pictures to read (.exr, .hdr), and last the picture to write (.png, .exr, .hdr) or an existing folder, which all go to under their own names.
    #[arg(value_name = "FILE", num_args = 2.., required = true)]
    files: Vec<PathBuf>,
    /// sky, filmic, aces, exposure, reinhard, reinhard_local, ashikhmin, logarithmic or linear.
    #[arg(long, value_name = "NAME", default_value = "sky")]
    operator: String,
    /// Set a number of the operator, as in key=0.5. May be given several times.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Exposure relative to the automatic one, -20 to 20 [stops].
    #[arg(long, value_name = "STOPS", help_heading = EXPOSURE)]
    exposure: Option<f64>,
    /// Exposure by hand: exposure value at ISO 100, -24 to 36; greater is darker. White is 1.2 x 2^EV cd/m2.
    #[arg(long, value_name = "EV", conflicts_with = "exposure", help_heading = EXPOSURE)]
    ev: Option<f64>,
    /// Exposure as of a camera: f-number, with --shutter.
    #[arg(long, value_name = "N", requires = "shutter", conflicts_with_all = ["exposure", "ev"], help_heading = EXPOSURE)]
    aperture: Option<f64>,
    /// Shutter time, with --aperture, such as 0.004 or 1/250 [s].
    #[arg(long, value_name = "S", value_parser = seconds, requires = "aperture", help_heading = EXPOSURE)]
    shutter: Option<f64>,
    /// Sensitivity, with --aperture. Default: 100.
    #[arg(long, value_name = "ISO", requires = "aperture", help_heading = EXPOSURE)]
    iso: Option<f64>,
    /// Luminance that the eye or the meter is adapted to [cd m-2]. Default: that of the picture.
    #[arg(long, value_name = "CD", help_heading = EXPOSURE)]
    adaptation: Option<f64>,
    /// What shows the picture: srgb, display_p3, rec709 (a television) or linear.
    #[arg(long, value_name = "NAME", default_value = "srgb", help_heading = OUTPUT)]
    display: String,
    /// Bits a channel of a PNG: 8 (dithered) or 16.
    #[arg(long, value_name = "BITS", default_value_t = 8, help_heading = OUTPUT)]
    depth: u8,
    /// Write one sheet with all operators side by side instead.
    #[arg(long, help_heading = OUTPUT)]
    compare: bool,
    /// Format of files that are written into a folder: png, exr or hdr.
    #[arg(long, value_name = "SUFFIX", default_value = "png", help_heading = SEQUENCE)]
    format: String,
    /// Time between two pictures, over which the eye adapts from one to the next [s]. Default: 1/24.
    #[arg(long, value_name = "S", value_parser = seconds, help_heading = SEQUENCE)]
    frame_seconds: Option<f64>,
    /// Time constant of adaptation to light [s]. Default: 0.5.
    #[arg(long, value_name = "S", value_parser = seconds, default_value = "0.5", help_heading = SEQUENCE)]
    light_seconds: f64,
    /// Time constant of adaptation to darkness [s]. Default: 1.
    #[arg(long, value_name = "S", value_parser = seconds, default_value = "1", help_heading = SEQUENCE)]
    dark_seconds: f64,
    #[command(flatten)]
    picture: PictureOptions,
}

impl Options {
    fn settings(&self) -> Result<ToneMapping> {
        let mut operator: Operator = self.operator.parse::<OperatorName>()?.into();
        for text in &self.set {
            let (name, value) = text.split_once('=').unwrap_or((text, ""));
            let wrong = |_| Error::input("set", format!("{text:?}"), "NAME=VALUE, such as key=0.5");
            operator.set(name.trim(), value.trim().parse().map_err(wrong)?)?;
        }
        let exposure = match (self.ev, self.aperture, self.shutter) {
            (Some(ev100), ..) => Exposure::Value { ev100 },
            (None, Some(aperture), Some(shutter_s)) => Exposure::Camera { aperture, shutter_s, iso: self.iso.unwrap_or(100.0) },
            _ => Exposure::Automatic { stops: self.exposure.unwrap_or(0.0) },
        };
        let settings = ToneMapping { operator, exposure, adaptation: self.adaptation, display: self.display.parse()? };
        settings.validate()?;
        Ok(settings)
    }

    fn depth(&self) -> Result<Depth> {
        match self.depth {
            8 => Ok(Depth::Eight),
            16 => Ok(Depth::Sixteen),
            other => Err(Error::input("depth", other, "8 or 16")),
        }
    }

    /// What is read and what is written.
    fn pairs(&self) -> Result<Vec<(&Path, PathBuf)>> {
        let Some((output, inputs)) = self.files.split_last() else { return Ok(Vec::new()) };
        if !output.is_dir() {
            return match inputs {
                [input] => Ok(vec![(input, output.clone())]),
                _ => Err(Error::input("output", output.display(), format!("an existing folder for {} pictures", inputs.len()))),
            };
        }
        if !["png", "exr", "hdr"].contains(&self.format.as_str()) {
            return Err(Error::input("format", format!("{:?}", self.format), "png, exr or hdr"));
        }
        let within = |input: &PathBuf| output.join(Path::new(input.file_name().unwrap_or_default()).with_extension(&self.format));
        let pairs: Vec<(&Path, PathBuf)> = inputs.iter().map(|input| (input.as_path(), within(input))).collect();
        let outputs: Vec<&PathBuf> = pairs.iter().map(|(_, path)| path).collect();
        let kept = each_once(&outputs);
        if let Some((_, (input, _))) =
            pairs.iter().enumerate().find(|&(k, (_, path))| kept.get(k).is_none_or(|kept| **kept != path))
        {
            return Err(Error::input(
                "input",
                input.display(),
                "of another name than the others, whose place in the folder it would take",
            ));
        }
        Ok(pairs)
    }

    /// Checks all files of all pictures: what is written first must not be what is read later.
    fn check(&self, pairs: &[(&Path, PathBuf)]) -> Result<()> {
        let inputs: Vec<_> = pairs.iter().map(|(input, _)| ("input", *input)).collect();
        let outputs: Vec<_> = pairs.iter().map(|(_, output)| ("output", output.as_path())).collect();
        files::check(&inputs, &outputs)
    }
}

/// Reads, maps, writes, and says what was done.
pub fn run(options: &Options) -> Result<()> {
    let (settings, depth, pairs) = (options.settings()?, options.depth()?, options.pairs()?);
    let count = pairs.len();
    let sequence = count > 1;
    for (_, output) in &pairs {
        let format = Format::of(output)?;
        if options.compare && format != Format::Png {
            return Err(Error::input("output", output.display(), "the name of a file that ends in .png for a contact sheet"));
        }
        if settings.display == Display::DisplayP3 && format != Format::Png {
            return Err(Error::input("display", settings.display.name(), "srgb, rec709 or linear for an .exr or .hdr"));
        }
    }
    options.check(&pairs)?;
    let frame_seconds = options.frame_seconds.unwrap_or(1.0 / 24.0);
    crate::error::check_range("frame_seconds", frame_seconds, 0.0, 1e9, "s")?;
    let mut eye = Adaptation::new(options.light_seconds, options.dark_seconds)?;
    for (number, (input, output)) in pairs.into_iter().enumerate() {
        terminal::begin_files(number + 1 < count);
        let mut picture = options.picture.read(input)?;
        let repaired = repairs_in_words(picture.repair());
        let (width, height) = (picture.width, picture.height);
        let done = terminal::with_progress(|progress| {
            let mut settings = settings;
            if sequence && settings.adaptation.is_none() {
                let metered = settings.adaptation_of(&Metering::of(&(&picture).into()));
                settings.adaptation = Some(eye.step(metered, frame_seconds)?);
            }
            if options.compare {
                write_sheet(&output, &Sheet::compare(&picture, &settings, progress)?, settings.display, progress)?;
                return Ok("all operators".to_owned());
            }
            let mapper = ToneMapper::new(&picture, &settings, progress)?;
            write_toned(&output, &mapper, depth, progress)?;
            let operator = settings.operator.name().name();
            Ok(format!("{operator}, adapted to {:.3e} cd/m2, EV100 {:.2}", mapper.adaptation(), mapper.ev100()))
        })?;
        say(&format!("{}: {width} x {height}, {done}", output.display()))?;
        if !repaired.is_empty() {
            say(&format!("repaired values: {repaired}"))?;
        }
    }
    Ok(())
}
