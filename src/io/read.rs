//! Pictures from files, ours and others': EXR and Radiance HDR, with what their headers say of values and directions.
//!
//! | what | where it comes from, first that is there |
//! |---|---|
//! | colour space | the caller; chromaticities (EXR), PRIMARIES or FORMAT (HDR); Rec. 709. Primaries of none of our spaces are converted to Rec. 709 |
//! | luminance of 1.0 | the caller; `skyprobe.white_luminance`, `whiteLuminance`, `skyprobe.scale`; 683 cd m-2, as Blender's physical sky |
//! | projection | the caller; `skyprobe.projection`; perspective, also for 2:1 |
//! | turn | `skyprobe.turn_deg`; none |
//! | rows, field of view | the caller; `skyprobe.rows`, `skyprobe.field_of_view_deg`; centre, and 39.6 degrees, Blender's first camera |

use super::{exr, hdr};
use crate::error::{Error, Result};
use crate::post::picture::{DEFAULT_FIELD_OF_VIEW_DEG, PictureProjection};
use crate::post::{Picture, View};
use crate::probe::{Extent, Rows};
use crate::spectrum::color_space::transform;
use crate::spectrum::{Chromaticities, ColorSpace};
use crate::units::Scale;
use std::collections::BTreeMap;
use std::path::Path;

/// What a file holds.
#[derive(Debug)]
pub(super) struct Raw {
    pub width: usize,
    pub height: usize,
    /// Row-major, (height, width, 3).
    pub pixels: Vec<f32>,
    pub chromaticities: Option<Chromaticities>,
    /// Texts and numbers of the header by name.
    pub fields: BTreeMap<String, String>,
}

/// What the caller knows better than the file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PictureHints {
    /// How directions are laid out.
    pub projection: Option<PictureProjection>,
    /// Where the rows of a latitude-longitude picture lie.
    pub rows: Option<Rows>,
    /// Horizontal field of view of a perspective picture or field of view of a fisheye [degrees].
    pub field_of_view_deg: Option<f64>,
    /// Luminance of a pixel whose Y is 1 [cd m-2].
    pub white_luminance: Option<f64>,
    /// The space of the pixels.
    pub color_space: Option<ColorSpace>,
}

/// Reads the picture in `path`, an `.exr` or `.hdr` (also `.pic`) file.
///
/// # Errors
/// [`Error::Input`] for another suffix and hints out of range; [`Error::File`] for a file that cannot be read, is damaged or cut short; [`Error::Data`] if it holds no picture or its
/// header contradicts itself.
pub fn read_picture(path: impl AsRef<Path>, hints: &PictureHints) -> Result<Picture> {
    let path = path.as_ref();
    let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
    let raw = match suffix.as_deref() {
        Some("exr") => exr::read_rgb(path)?,
        Some("hdr" | "pic" | "rgbe") => hdr::read_rgb(path)?,
        _ => return Err(Error::input("input", path.display(), "the name of a file that ends in .exr or .hdr")),
    };
    let view = view(&raw.fields, hints)?;
    let white_luminance = match hints.white_luminance {
        Some(luminance) => luminance,
        None => white_luminance(&raw.fields)?,
    };
    let mut pixels = raw.pixels;
    let color_space = match (hints.color_space, raw.chromaticities) {
        (Some(space), _) => space,
        (None, None) => ColorSpace::LinRec709,
        (None, Some(primaries)) => primaries.space().unwrap_or_else(|| {
            convert(&mut pixels, &primaries);
            ColorSpace::LinRec709
        }),
    };
    let turn_deg = raw.fields.get("skyprobe.turn_deg").map_or(Ok(0.0), |text| number("skyprobe.turn_deg", text))?;
    let picture = Picture::new(raw.width, raw.height, pixels, color_space, white_luminance, view)?;
    Ok(Picture { turn_deg: if turn_deg.is_finite() { turn_deg } else { 0.0 }, ..picture })
}

fn view(fields: &BTreeMap<String, String>, hints: &PictureHints) -> Result<View> {
    let field = |name: &str| fields.get(&format!("skyprobe.{name}"));
    let projection = match (hints.projection, field("projection")) {
        (Some(projection), _) => projection,
        (None, Some(name)) => name.parse()?,
        (None, None) => PictureProjection::Perspective,
    };
    let rows = match (hints.rows, field("rows")) {
        (Some(rows), _) => rows,
        (None, Some(name)) => name.parse()?,
        (None, None) => Rows::Centre,
    };
    let of_file = match (field("field_of_view_deg"), field("extent").map(|name| name.parse::<Extent>()).transpose()?) {
        (Some(text), _) => Some(number("skyprobe.field_of_view_deg", text)?),
        (None, Some(extent)) if projection == PictureProjection::Fisheye => {
            Some(if extent == Extent::Full { 360.0 } else { 180.0 })
        }
        _ => None,
    };
    let default = if projection == PictureProjection::Fisheye { 180.0 } else { DEFAULT_FIELD_OF_VIEW_DEG };
    Ok(projection.view(rows, hints.field_of_view_deg.or(of_file).unwrap_or(default)))
}

fn white_luminance(fields: &BTreeMap<String, String>) -> Result<f64> {
    for name in ["skyprobe.white_luminance", "whiteLuminance"] {
        if let Some(text) = fields.get(name) {
            return number(name, text);
        }
    }
    let scale = fields.get("skyprobe.scale").map(|name| name.parse::<Scale>()).transpose()?.unwrap_or_default();
    Ok(scale.white_luminance())
}

fn number(name: &str, text: &str) -> Result<f64> {
    text.trim().parse().map_err(|_| Error::data(format!("the header says {name} = {text:?}, which is no number")))
}

/// From the space of `primaries` to Rec. 709.
fn convert(pixels: &mut [f32], primaries: &Chromaticities) {
    let (to_xyz, from_xyz) = (primaries.matrix_to_xyz(), ColorSpace::LinRec709.matrix_from_xyz());
    for pixel in pixels.as_chunks_mut::<3>().0 {
        *pixel = transform(&from_xyz, transform(&to_xyz, pixel.map(f64::from))).map(|value| value as f32);
    }
}

#[cfg(test)]
mod tests;
