//! A linear picture with what its numbers and its pixels mean: all that glare and tone mapping need to know.

use crate::error::{Error, Result, check_range};
use crate::probe::Probe;
use crate::projection::Grid;
pub use crate::projection::{DEFAULT_FIELD_OF_VIEW_DEG, PictureProjection, View};
use crate::spectrum::color_space::ColorSpace;
use crate::units::Scale;
use rayon::prelude::*;

/// Greatest width and height [pixels].
pub const MAX_SIDE: usize = 32768;

/// Largest value that is kept: what is brighter, infinity above all, becomes this. Sums of a whole picture of it stay finite.
pub const LARGEST: f32 = 1e30;

/// How many values of a picture were not those of light ([`Picture::repair`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repairs {
    /// Not a number: made 0.
    pub not_a_number: usize,
    /// Infinite, or over [`LARGEST`]: made [`LARGEST`] with its sign, negative ones 0.
    pub infinite: usize,
    /// Smaller than any normal number: made 0, as they would slow down all arithmetic.
    pub denormal: usize,
}

impl Repairs {
    /// Whether nothing had to be changed.
    pub fn is_empty(self) -> bool {
        self == Self::default()
    }

    fn and(self, other: Self) -> Self {
        Self {
            not_a_number: self.not_a_number + other.not_a_number,
            infinite: self.infinite + other.infinite,
            denormal: self.denormal + other.denormal,
        }
    }
}

/// A linear picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width [pixels].
    pub width: usize,
    /// Height [pixels].
    pub height: usize,
    /// Values, row-major from the upper left, (height, width, 3). Negative ones are colours outside the space.
    pub pixels: Vec<f32>,
    /// Primaries and white of the pixels.
    pub color_space: ColorSpace,
    /// Luminance of a pixel whose Y is 1 [cd m-2]; see [`Scale::white_luminance`].
    pub white_luminance: f64,
    /// Whether `white_luminance` was assumed, because nothing said it: then no file says it either.
    pub white_luminance_assumed: bool,
    /// Where the pixels look.
    pub view: View,
    /// What the header that it came with says and nobody understands, so that it was left aside, a sentence each.
    pub notes: Vec<String>,
    /// How far a sky in it is turned clockwise, as [`ProbeSettings::turn_deg`](crate::probe::ProbeSettings::turn_deg) [degrees]: nothing here depends on it, but what is made of the picture is turned as well.
    pub turn_deg: f64,
}

/// What is assumed of a picture that does not say it: the default of [`Scale`].
pub(crate) const ASSUMPTION: &str = "white luminance unknown: 683 cd/m2 assumed (scale blender)";

/// The range of `white_luminance` [cd m-2].
pub(crate) const WHITE_LUMINANCES: std::ops::RangeInclusive<f64> = 1e-9..=1e9;

impl Picture {
    /// A picture of given `pixels`, row-major (height, width, 3), not turned.
    ///
    /// # Errors
    /// [`Error::Input`] for a size, `white_luminance` or field of view that no picture has; [`Error::Data`] if the number of values is not that of the size.
    pub fn new(
        width: usize,
        height: usize,
        pixels: Vec<f32>,
        color_space: ColorSpace,
        white_luminance: f64,
        view: View,
    ) -> Result<Self> {
        for (name, side) in [("width", width), ("height", height)] {
            if !(1..=MAX_SIDE).contains(&side) {
                return Err(Error::input(name, side, format!("from 1 to {MAX_SIDE} pixels")));
            }
        }
        check_range("white_luminance", white_luminance, *WHITE_LUMINANCES.start(), *WHITE_LUMINANCES.end(), "cd m-2")?;
        if let Some(angle) = view.field_of_view_deg() {
            let allowed = view.projection().fields_of_view_deg();
            check_range("field_of_view_deg", angle, *allowed.start(), *allowed.end(), "degrees")?;
        }
        if pixels.len() != 3 * width * height {
            return Err(Error::data(format!(
                "a picture of {width} x {height} pixels has {} values, not {}",
                pixels.len(),
                3 * width * height
            )));
        }
        Ok(Self {
            width,
            height,
            pixels,
            color_space,
            white_luminance,
            white_luminance_assumed: false,
            view,
            notes: Vec::new(),
            turn_deg: 0.0,
        })
    }

    /// The geometry of its pixels.
    pub fn grid(&self) -> Grid {
        self.view.grid((self.width, self.height), self.turn_deg)
    }

    /// What is to be told of a luminance that had to be assumed; `None` if it was said.
    pub fn assumption(&self) -> Option<&'static str> {
        self.white_luminance_assumed.then_some(ASSUMPTION)
    }

    /// Makes every value one that light can have, so that none spreads over the picture, and says how many were not.
    pub fn repair(&mut self) -> Repairs {
        self.pixels
            .par_chunks_mut(1 << 14)
            .map(|block| {
                let mut found = Repairs::default();
                for value in block.iter_mut().filter(|value| !(value.is_normal() && value.abs() <= LARGEST || **value == 0.0)) {
                    if value.is_nan() {
                        found.not_a_number += 1;
                        *value = 0.0;
                    } else if value.is_subnormal() {
                        found.denormal += 1;
                        *value = 0.0;
                    } else {
                        found.infinite += 1;
                        *value = if *value > 0.0 { LARGEST } else { 0.0 };
                    }
                }
                found
            })
            .reduce(Repairs::default, Repairs::and)
    }
}

impl From<Probe> for Picture {
    /// The picture of a probe.
    fn from(probe: Probe) -> Self {
        let settings = &probe.settings;
        let view = settings.view();
        let (color_space, white_luminance) = (settings.color_space, Scale::white_luminance(settings.scale));
        let turn_deg = settings.turn_deg;
        Self {
            width: probe.width,
            height: probe.height,
            pixels: probe.pixels,
            color_space,
            white_luminance,
            white_luminance_assumed: false,
            view,
            notes: Vec::new(),
            turn_deg,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: Vec<f32>) -> Result<Picture> {
        let view = View::Perspective { horizontal_field_of_view_deg: 50.0 };
        Picture::new(2, 1, pixels, ColorSpace::LinRec709, 683.0, view)
    }

    #[test]
    fn what_no_light_can_be_is_repaired_and_counted() {
        let mut found = picture(vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e-40, -0.25, 1e9]).unwrap();
        let repairs = found.repair();
        assert_eq!(repairs, Repairs { not_a_number: 1, infinite: 2, denormal: 1 });
        assert_eq!(found.pixels, [0.0, LARGEST, 0.0, 0.0, -0.25, 1e9]);
        assert!(found.repair().is_empty());
    }

    #[test]
    fn impossible_pictures_are_refused() {
        assert!(picture(vec![0.0; 5]).is_err());
        let tilted = View::Perspective { horizontal_field_of_view_deg: 180.0 };
        let error = Picture::new(2, 1, vec![0.0; 6], ColorSpace::LinRec709, 683.0, tilted).unwrap_err();
        assert!(error.to_string().starts_with("field_of_view_deg = 180"), "{error}");
        assert!(Picture::new(0, 1, vec![], ColorSpace::LinRec709, 683.0, tilted).is_err());
    }
}
