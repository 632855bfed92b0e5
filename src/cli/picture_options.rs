//! Options of commands that finish a picture: what the file does not say of it.

use super::files;
use crate::error::Result;
use crate::io::{PictureHints, read_picture};
use crate::post::{Picture, Repairs};
use clap::Args;
use std::path::Path;

const PICTURE: &str = "Picture";

/// What the picture is, where its header does not say it or is wrong.
#[derive(Args)]
pub struct PictureOptions {
    /// latlong (a probe), perspective or fisheye. Default: what the header says, else perspective.
    #[arg(long, value_name = "NAME", help_heading = PICTURE)]
    projection: Option<String>,
    /// Field of view: of a perspective picture the angle between left and right border, of a fisheye that of its whole width [degrees].
    /// Default: what the header says, else 39.6 (Blender's first camera) or 180 for a fisheye.
    #[arg(long, value_name = "DEG", help_heading = PICTURE)]
    fov: Option<f64>,
    /// Rows of a latlong picture: centre (Blender) or corner (Mitsuba). Default: what the header says, else centre.
    #[arg(long, value_name = "NAME", help_heading = PICTURE)]
    rows: Option<String>,
    /// Luminance of a pixel of value 1 [cd m-2]. Default: what the header says, else 683 (the scale blender).
    #[arg(long, value_name = "CD", help_heading = PICTURE)]
    white_luminance: Option<f64>,
    /// Space of the pixels: lin_rec709, acescg, lin_rec2020 or xyz. Default: what the header says, else lin_rec709.
    #[arg(long, value_name = "NAME", help_heading = PICTURE)]
    color_space: Option<String>,
}

impl PictureOptions {
    /// What was given.
    pub fn hints(&self) -> Result<PictureHints> {
        Ok(PictureHints {
            projection: self.projection.as_deref().map(str::parse).transpose()?,
            rows: self.rows.as_deref().map(str::parse).transpose()?,
            field_of_view_deg: self.fov,
            white_luminance: self.white_luminance,
            color_space: self.color_space.as_deref().map(str::parse).transpose()?,
        })
    }

    /// Reads `input`, after a check that `output` can be written to and is another file.
    pub fn read(&self, input: &Path, output: &Path) -> Result<Picture> {
        let hints = self.hints()?;
        files::check(&[("input", input)], &[("output", output)])?;
        read_picture(input, &hints)
    }
}

/// What was repaired, in words; empty if nothing was.
pub fn repairs_in_words(repairs: Repairs) -> String {
    let kinds = [
        (repairs.not_a_number, "not a number, now 0"),
        (repairs.infinite, "infinite, now very large or 0"),
        (repairs.denormal, "denormal, now 0"),
    ];
    let told: Vec<String> = kinds.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")).collect();
    told.join("; ")
}
