//! Options of commands that finish a picture: what the file does not say of it.

use super::complain;
use crate::error::Result;
use crate::io::{PictureHints, PictureLimits, read_picture};
use crate::post::{Picture, Repairs};
use crate::units::Scale;
use clap::Args;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

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
    /// Luminance of a pixel of value 1 [cd m-2]. Default: what the header says, else 683 (the scale blender), which is told.
    #[arg(long, value_name = "CD", help_heading = PICTURE)]
    white_luminance: Option<f64>,
    /// The same by the name of a scale: blender (683), mitsuba (72983) or luminance (1).
    #[arg(long, value_name = "NAME", conflicts_with = "white_luminance", help_heading = PICTURE)]
    scale: Option<String>,
    /// Space of the pixels: lin_rec709, acescg, lin_rec2020 or xyz. Default: what the header says, else lin_rec709.
    #[arg(long, value_name = "NAME", help_heading = PICTURE)]
    color_space: Option<String>,
    /// Largest picture to read, above 0 to 1073.741824 [million pixels]; a million take some 25 MB of memory. Default: 256.
    #[arg(long, value_name = "MILLIONS", help_heading = PICTURE)]
    max_megapixels: Option<f64>,
    /// The notes that were told.
    #[arg(skip)]
    told: Mutex<BTreeSet<String>>,
}

impl PictureOptions {
    /// What was given.
    pub fn hints(&self) -> Result<PictureHints> {
        let plain = PictureLimits::default();
        let limits = PictureLimits { max_megapixels: self.max_megapixels.unwrap_or(plain.max_megapixels) };
        limits.validate()?;
        Ok(PictureHints {
            projection: self.projection.as_deref().map(str::parse).transpose()?,
            rows: self.rows.as_deref().map(str::parse).transpose()?,
            field_of_view_deg: self.fov,
            white_luminance: match &self.scale {
                Some(name) => Some(name.parse::<Scale>()?.white_luminance()),
                None => self.white_luminance,
            },
            color_space: self.color_space.as_deref().map(str::parse).transpose()?,
            limits,
        })
    }

    /// Reads `input`, and tells what was assumed.
    pub fn read(&self, input: &Path) -> Result<Picture> {
        let picture = read_picture(input, &self.hints()?)?;
        self.tell(input, &picture);
        Ok(picture)
    }

    /// Says what of the picture was assumed and what was left aside: each once, whatever the number of pictures.
    fn tell(&self, input: &Path, picture: &Picture) {
        let assumption = picture.assumption().map(|text| format!("{text}; --white-luminance or --scale says otherwise"));
        let mut told = self.told.lock().unwrap_or_else(PoisonError::into_inner);
        for note in assumption.iter().chain(&picture.notes) {
            if told.insert(note.clone()) {
                complain(&format!("note: {}: {note}", input.display()));
            }
        }
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
