//! `skyprobe glare`: what the eye makes of light that is brighter than any screen.

use super::picture_options::{PictureOptions, repairs_in_words};
use super::{files, say, terminal};
use crate::error::{Error, Result};
use crate::io::{Format, write_picture};
use crate::post::glare::{GlareOptions, Glaring, glare};
use clap::Args;
use std::path::PathBuf;

const GLARE: &str = "Glare";

const EXAMPLES: &str = "\
Examples:
  A probe with a low Sun, as a daylight eye sees it:
    skyprobe glare lund.exr lund_glare.exr
  A scene that Blender rendered with a field of view of 60 degrees, under the full Moon:
    skyprobe glare moonlit.exr moonlit_glare.exr --fov 60 --state scotopic
  Only what is brighter than 10000 cd/m2, with other streaks:
    skyprobe glare street.exr street_glare.exr --threshold 10000 --seed 7

The input is EXR or HDR, of any program; the output EXR or HDR. Method: Spencer et al. 1995, normalised so that the picture keeps its energy.
";

/// Options of `skyprobe glare`.
#[derive(Args)]
#[command(allow_negative_numbers = true, after_long_help = EXAMPLES, after_help = "Examples and longer explanations: skyprobe glare --help")]
pub struct Options {
    /// Picture to read (.exr, .hdr).
    #[arg(value_name = "INPUT")]
    input: PathBuf,
    /// Picture to write (.exr, .hdr).
    #[arg(value_name = "OUTPUT")]
    output: PathBuf,
    /// State of the eye: photopic (day), mesopic (twilight, lamps), scotopic (night), or auto (by the picture's mean luminance: photopic above
    /// 5 cd/m2, scotopic below 0.005). Default: auto.
    #[arg(long, value_name = "NAME", default_value = "auto", help_heading = GLARE)]
    state: String,
    /// Light above this luminance glares [cd m-2]. Default: 20 times the mean luminance of the picture.
    #[arg(long, value_name = "CD", conflicts_with = "all_light", help_heading = GLARE)]
    threshold: Option<f64>,
    /// With a threshold: all light of the brighter pixels glares, not only what exceeds it. As in the thesis; edges show where a smooth sky crosses the threshold.
    #[arg(long, requires = "threshold", help_heading = GLARE)]
    whole_pixels: bool,
    /// All light glares, as in the eye.
    #[arg(long, help_heading = GLARE)]
    all_light: bool,
    /// Width and height of the filter in widths and heights of the picture, 0.01 to 2. A latlong picture always has all of it. Default: 2.
    #[arg(long, value_name = "PICTURES", help_heading = GLARE)]
    size: Option<f64>,
    /// Number that draws the streaks. Default: 0.
    #[arg(long, value_name = "N", help_heading = GLARE)]
    seed: Option<u64>,
    /// Contrast of the streaks, 0 (none) to 1 (lines on black, as in the thesis). Default: 0.6.
    #[arg(long, value_name = "CONTRAST", help_heading = GLARE)]
    streaks: Option<f64>,
    #[command(flatten)]
    picture: PictureOptions,
}

impl Options {
    fn glare(&self) -> Result<GlareOptions> {
        let plain = GlareOptions::default();
        let glaring = match self.threshold {
            _ if self.all_light => Glaring::AllLight,
            Some(threshold) if self.whole_pixels => Glaring::Pixels(threshold),
            Some(threshold) => Glaring::Excess(threshold),
            None => Glaring::Automatic,
        };
        let options = GlareOptions {
            state: if self.state == "auto" { None } else { Some(self.state.parse()?) },
            glaring,
            size: self.size.unwrap_or(plain.size),
            seed: self.seed.unwrap_or(plain.seed),
            streaks: self.streaks.unwrap_or(plain.streaks),
        };
        options.validate()?;
        Ok(options)
    }
}

/// Reads, adds glare, writes, and says what was done.
pub fn run(options: &Options) -> Result<()> {
    let glare_options = options.glare()?;
    if Format::of(&options.output)? == Format::Png {
        return Err(Error::input("output", options.output.display(), "the name of a file that ends in .exr or .hdr"));
    }
    files::check(&[("input", &options.input)], &[("output", &options.output)])?;
    let mut picture = options.picture.read(&options.input)?;
    let report = terminal::with_progress(|progress| {
        let report = glare(&mut picture, &glare_options, progress)?;
        write_picture(&options.output, &picture, progress)?;
        Ok(report)
    })?;
    let view = picture.view;
    let threshold = report.threshold.map_or("all light".to_owned(), |threshold| format!("light above {threshold:.4} cd/m2"));
    let (state, mean, glaring) = (report.state.name(), report.mean_luminance, report.glaring_pixels);
    say(&format!(
        "{}: {} x {}, {view}; mean luminance {mean:.4} cd/m2, {state}; {threshold} glares: {glaring} pixels",
        options.output.display(),
        picture.width,
        picture.height
    ))?;
    let repaired = repairs_in_words(report.repairs);
    if !repaired.is_empty() {
        say(&format!("repaired values: {repaired}"))?;
    }
    if report.too_bright > 0 {
        say(&format!("{} pixels are too bright to be light and do not glare", report.too_bright))?;
    }
    Ok(())
}
