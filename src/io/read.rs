//! Pictures from files, ours and others': EXR and Radiance HDR, with what their headers say of values and directions.
//!
//! | what | where it comes from, first that is there |
//! |---|---|
//! | colour space | the caller; channels X Y Z or chromaticities (EXR), PRIMARIES or FORMAT (HDR), if they make a space; Rec. 709. Primaries of none of our spaces are converted to Rec. 709 |
//! | luminance of 1.0 | the caller; `skyprobe.white_luminance`, `whiteLuminance`, `skyprobe.scale`, the first that can be one; 683 cd m-2, as Blender's physical sky, which [`Picture::assumption`] tells |
//! | projection | the caller; `envmap` (EXR); `skyprobe.projection`; perspective, also for 2:1 |
//! | turn | `skyprobe.turn_deg`; none |
//! | rows, field of view | the caller; `skyprobe.rows`, `skyprobe.field_of_view_deg`; centre, and 39.6 degrees, Blender's first camera |

use super::{PictureLimits, exr, hdr};
use crate::error::{Error, Result, quoted};
use crate::post::picture::{PictureProjection, WHITE_LUMINANCES};
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
    /// What of the header could not be understood and was left aside, a sentence each.
    pub notes: Vec<String>,
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
    /// How large a picture may be.
    pub limits: PictureLimits,
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
        Some("exr") => exr::read_rgb(path, &hints.limits)?,
        Some("hdr" | "pic" | "rgbe") => hdr::read_rgb(path, &hints.limits)?,
        _ => return Err(Error::input("input", path.display(), "the name of a file that ends in .exr or .hdr")),
    };
    picture(path, raw, hints)
}

/// Reads the content of an EXR file, as [`read_picture`] does.
///
/// # Errors
/// As [`read_picture`]; messages call the file `exr`.
pub fn read_exr_bytes(bytes: &[u8], hints: &PictureHints) -> Result<Picture> {
    let path = Path::new("exr");
    picture(path, exr::parse_rgb(path, bytes, &hints.limits)?, hints)
}

/// Does what [`read_picture`] does with the bytes of a Radiance file.
///
/// # Errors
/// As [`read_picture`]; messages call the file `hdr`.
pub fn read_hdr_bytes(bytes: &[u8], hints: &PictureHints) -> Result<Picture> {
    let path = Path::new("hdr");
    picture(path, hdr::parse_rgb(path, bytes, &hints.limits)?, hints)
}

/// What a file holds, with its meaning.
fn picture(path: &Path, raw: Raw, hints: &PictureHints) -> Result<Picture> {
    let raw = map_of_directions(path, raw, hints)?;
    let mut notes = raw.notes;
    let view = view(&raw.fields, hints, &mut notes);
    let known = hints.white_luminance.or_else(|| white_luminance(&raw.fields, &mut notes));
    let mut pixels = raw.pixels;
    let color_space = match (hints.color_space, raw.chromaticities) {
        (Some(space), _) => space,
        (None, None) => ColorSpace::LinRec709,
        (None, Some(primaries)) => primaries.space().unwrap_or_else(|| {
            convert(&mut pixels, &primaries);
            ColorSpace::LinRec709
        }),
    };
    let luminance = known.unwrap_or(Scale::default().white_luminance());
    let turn_deg = said(&raw.fields, "turn_deg", &mut notes, finite).unwrap_or(0.0);
    let picture = Picture::new(raw.width, raw.height, pixels, color_space, luminance, view)?;
    Ok(Picture { white_luminance_assumed: known.is_none(), notes, turn_deg, ..picture })
}

/// A picture with the standard attribute `envmap` as a latitude-longitude picture of ours, unless the caller knows it for another.
fn map_of_directions(path: &Path, mut raw: Raw, hints: &PictureHints) -> Result<Raw> {
    let rows = match raw.fields.get("envmap").map(String::as_str) {
        _ if hints.projection.is_some_and(|projection| projection != PictureProjection::LatLong) => return Ok(raw),
        Some("latlong") => {
            exr::envmap::shift_columns(raw.width, &mut raw.pixels);
            Rows::Corner
        }
        Some("cube") => {
            let size = (raw.width, raw.height);
            (raw.width, raw.height, raw.pixels) = exr::envmap::from_cube(path, &hints.limits, size, &raw.pixels)?;
            Rows::Centre
        }
        _ => return Ok(raw),
    };
    // The attribute is never ours: whoever put it there came later.
    raw.fields.insert("skyprobe.projection".to_owned(), PictureProjection::LatLong.name().to_owned());
    raw.fields.insert("skyprobe.rows".to_owned(), rows.name().to_owned());
    Ok(raw)
}

/// What the header says in our own field `name`, as `read` understands it; what it does not understand is left aside with a note.
fn said<T>(
    fields: &BTreeMap<String, String>,
    name: &str,
    notes: &mut Vec<String>,
    read: impl Fn(&str) -> Option<T>,
) -> Option<T> {
    let name = format!("skyprobe.{name}");
    let text = fields.get(&name)?;
    let found = read(text);
    if found.is_none() {
        notes.push(format!("{name}={}: not understood, left aside", quoted(text)));
    }
    found
}

fn finite(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|value: &f64| value.is_finite())
}

fn view(fields: &BTreeMap<String, String>, hints: &PictureHints, notes: &mut Vec<String>) -> View {
    let of_file = said(fields, "projection", notes, |name| name.parse().ok());
    let projection = hints.projection.or(of_file).unwrap_or(PictureProjection::Perspective);
    let of_file = said(fields, "rows", notes, |name| name.parse().ok());
    let rows = hints.rows.or(of_file).unwrap_or(Rows::Centre);
    let is_fisheye = projection == PictureProjection::Fisheye;
    let extent = said(fields, "extent", notes, |name| name.parse::<Extent>().ok()).filter(|_| is_fisheye);
    // Of which fields of view there are pictures, the picture says.
    let of_file = said(fields, "field_of_view_deg", notes, |text| {
        finite(text).filter(|angle| projection.fields_of_view_deg().contains(angle))
    });
    let of_file = of_file.or(extent.map(|extent| if extent == Extent::Full { 360.0 } else { 180.0 }));
    let angle = hints.field_of_view_deg.or(of_file).unwrap_or(projection.default_field_of_view_deg());
    projection.view(rows, angle)
}

/// The luminance of 1.0 that the header says [cd m-2]; what cannot be one counts as not said, with a note.
fn white_luminance(fields: &BTreeMap<String, String>, notes: &mut Vec<String>) -> Option<f64> {
    let said = |name: &str| match name {
        "skyprobe.scale" => fields.get(name)?.parse::<Scale>().ok().map(Scale::white_luminance),
        _ => fields.get(name)?.trim().parse().ok().filter(|luminance| WHITE_LUMINANCES.contains(luminance)),
    };
    for name in ["skyprobe.white_luminance", "whiteLuminance", "skyprobe.scale"] {
        match (said(name), fields.get(name)) {
            (Some(luminance), _) => return Some(luminance),
            (None, Some(text)) => notes.push(format!("{name}={}: says no luminance, left aside", quoted(text))),
            (None, None) => {}
        }
    }
    None
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
