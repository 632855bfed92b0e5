//! Tone mapping: from light to a screen.
//!
//! ```text
//! picture ──> metering ──> exposure ──> operator ──> light of a screen, 0 to 1 ──> transfer function ──> 8 bits (dithered), 16 bits
//!                 └──> adaptation (sequences)
//! ```
//! | operator | acts on | from |
//! |---|---|---|
//! | [`Sky`] | largest channel, hue kept | this project: skies by day and night |
//! | [`Filmic`] | channels, in inset primaries | in the manner of AgX (Sobotka 2022) |
//! | [`Aces`] | channels, in its own primaries | ACES 1.0 as fitted by Hill |
//! | [`Exponential`] | channels | the thesis, figure 8 |
//! | [`Reinhard`] | luminance, hue kept | Reinhard et al. 2002, the thesis's figure 7 |
//! | [`ReinhardLocal`] | luminance, hue kept | the same, dodging and burning |
//! | [`Ashikhmin`] | luminance, hue kept | Ashikhmin 2002, the thesis's figure 6 |
//! | [`Logarithmic`] | channels | the thesis, figure 5 |
//! | [`Linear`] | channels | the thesis |
//!
//! Colours outside the screen's gamut move towards the grey of their luminance first. Values that no light can have are taken for what
//! [`Picture::repair`](super::Picture::repair) makes of them: nothing that comes in makes anything but numbers from 0 to 1.

mod aces;
mod adaptation;
mod ashikhmin;
mod display;
mod exponential;
pub mod exposure;
mod filmic;
mod frame;
mod gaussian;
mod lettering;
mod linear;
mod logarithmic;
mod metering;
mod operator;
mod reinhard;
mod reinhard_local;
mod sheet;
pub mod sky;
#[cfg(test)]
mod tests;

pub use aces::Aces;
pub use adaptation::Adaptation;
pub use ashikhmin::{Ashikhmin, capacity};
pub use display::Display;
pub use exponential::Exponential;
pub use exposure::Exposure;
pub use filmic::Filmic;
pub use frame::Frame;
pub use linear::Linear;
pub use logarithmic::Logarithmic;
pub use metering::{DARKNESS, Metering};
pub use operator::{Field, Operator, OperatorName};
pub use reinhard::Reinhard;
pub use reinhard_local::ReinhardLocal;
pub use sheet::Sheet;
pub use sky::Sky;

use super::picture::{Picture, View};
use crate::error::{Error, Result, check_range};
use crate::progress::Progress;
use crate::spectrum::ColorSpace;
use crate::spectrum::color_space::Matrix;
use frame::{dot, exposed, without_excess, without_negative};
use gaussian::Edges;
use rayon::prelude::*;
use sky::{Curve, Rods, blurred_for_rods};
use std::f64::consts::FRAC_PI_2;

/// Least and greatest luminance that an eye or a meter can be told to be adapted to [cd m-2].
pub const ADAPTATION_RANGE: (f64, f64) = (1e-8, 1e9);

/// How a picture is brought to a screen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToneMapping {
    /// The operator.
    pub operator: Operator,
    /// How much light the picture is given.
    pub exposure: Exposure,
    /// Luminance that the eye (of the sky operator) or the meter (of the others) is adapted to [cd m-2], within [`ADAPTATION_RANGE`]; by default that of the picture itself.
    pub adaptation: Option<f64>,
    /// What shows the picture.
    pub display: Display,
}

impl ToneMapping {
    /// An operator with its default numbers, exposed automatically, for sRGB.
    pub fn with(operator: OperatorName) -> Self {
        Self { operator: operator.into(), ..Self::default() }
    }

    /// Checks all ranges.
    ///
    /// # Errors
    /// [`Error::Input`](crate::Error::Input) that names the number.
    pub fn validate(&self) -> Result<()> {
        self.operator.validate()?;
        self.exposure.validate()?;
        if let Some(luminance) = self.adaptation {
            check_range("adaptation", luminance, ADAPTATION_RANGE.0, ADAPTATION_RANGE.1, "cd m-2")?;
        }
        Ok(())
    }

    /// Luminance that this operator takes from a metered picture [cd m-2]: what a time-lapse follows ([`Adaptation::step`]).
    pub fn adaptation_of(&self, metering: &Metering) -> f64 {
        match self.operator {
            Operator::Sky(_) => metering.adaptation(),
            _ => metering.log_average.max(DARKNESS),
        }
    }
}

/// Luminance of white on the reference display of sRGB [cd m-2] (IEC 61966-2-1).
pub const DISPLAY_WHITE: f64 = 80.0;

type Row<'a> = Box<dyn Fn(usize, &mut [f32]) + Send + Sync + 'a>;

/// A picture ready to be shown, row by row.
pub struct ToneMapper<'a> {
    width: usize,
    height: usize,
    display: Display,
    view: View,
    turn_deg: f64,
    metering: Metering,
    adaptation: f64,
    exposure: f64,
    row: Row<'a>,
}

impl<'a> ToneMapper<'a> {
    /// Meters `picture` and gets `settings` ready for it; the local operators do most of their work here.
    ///
    /// # Errors
    /// [`Error::Input`](crate::Error::Input) for settings out of range, [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn new(picture: impl Into<Frame<'a>>, settings: &ToneMapping, progress: &Progress) -> Result<Self> {
        settings.validate()?;
        let frame = picture.into();
        let metering = Metering::of(&frame);
        let adaptation = settings.adaptation.unwrap_or_else(|| settings.adaptation_of(&metering));
        let automatic = match settings.operator {
            Operator::Sky(sky) => sky.exposure(adaptation),
            _ => exposure::MIDDLE_GREY / adaptation,
        };
        let exposure = settings.exposure.factor(automatic);
        let mapped = Mapped { frame, display: settings.display, exposure };
        let row: Row<'a> = match settings.operator {
            Operator::Linear(linear) => mapped.channels(linear.curve()),
            Operator::Logarithmic(logarithmic) => mapped.channels(logarithmic.curve()),
            Operator::Exposure(exponential) => mapped.channels(exponential.curve()),
            Operator::Filmic(filmic) => mapped.colours(filmic.colour()),
            Operator::Aces(aces) => mapped.colours(aces.colour(settings.display)),
            Operator::Reinhard(reinhard) => {
                let curve = reinhard.curve(&metering, exposure);
                mapped.luminance(move |_, luminance| curve(luminance))
            }
            Operator::ReinhardLocal(reinhard) => {
                let surround = reinhard.surround(&frame, exposure, progress)?;
                mapped.luminance(move |pixel, luminance| luminance / (1.0 + surround[pixel]))
            }
            Operator::Ashikhmin(ashikhmin) => {
                let factors = ashikhmin.factors(&frame, &metering, progress)?;
                // From an exposed luminance back to that of the scene, on whose limits the operator works.
                let scale = (1.0 / automatic) as f32;
                mapped.luminance(move |pixel, luminance| luminance * scale * factors[pixel])
            }
            Operator::Sky(sky) => mapped.sky(&sky, adaptation, progress)?,
        };
        Ok(Self {
            width: frame.width,
            height: frame.height,
            display: settings.display,
            view: frame.view,
            turn_deg: frame.turn_deg,
            metering,
            adaptation,
            exposure,
            row,
        })
    }

    /// Width [pixels].
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height [pixels].
    pub fn height(&self) -> usize {
        self.height
    }

    /// What shows the picture.
    pub fn display(&self) -> Display {
        self.display
    }

    /// What the picture's luminances are.
    pub fn metering(&self) -> &Metering {
        &self.metering
    }

    /// Luminance that the picture was exposed for [cd m-2].
    pub fn adaptation(&self) -> f64 {
        self.adaptation
    }

    /// Exposure as an exposure value at ISO 100 ([`exposure`]).
    pub fn ev100(&self) -> f64 {
        exposure::ev100_of_factor(self.exposure)
    }

    /// Row `row` as linear light of the screen, 0 to 1, in its primaries, (width, 3), into `out`.
    ///
    /// # Panics
    /// If there is no such row, or `out` has another length.
    pub fn row(&self, row: usize, out: &mut [f32]) {
        assert!(row < self.height && out.len() == 3 * self.width, "no row {row} of {} values", out.len());
        (self.row)(row, out);
    }

    /// Linear light of the screen, 0 to 1, in its primaries, row-major (height, width, 3).
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn to_linear(&self, progress: &Progress) -> Result<Vec<f32>> {
        self.all_rows(progress, |row, out: &mut [f32]| self.row(row, out))
    }

    /// The light of the screen as a picture, whose white is that of the reference display of sRGB, [`DISPLAY_WHITE`]: for programs that bring pictures to a screen themselves.
    ///
    /// # Errors
    /// [`Error::Input`](crate::Error::Input) for [`Display::DisplayP3`], whose primaries a picture cannot have; [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn to_picture(&self, progress: &Progress) -> Result<Picture> {
        if self.display == Display::DisplayP3 {
            return Err(Error::input(
                "display",
                self.display.name(),
                "srgb, rec709 or linear for values in proportion to light (EXR, HDR)",
            ));
        }
        let light = self.to_linear(progress)?;
        let picture = Picture::new(self.width, self.height, light, ColorSpace::LinRec709, DISPLAY_WHITE, self.view)?;
        Ok(Picture { turn_deg: self.turn_deg, ..picture })
    }

    /// 8-bit codes, dithered, row-major (height, width, 3).
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn to_8_bits(&self, progress: &Progress) -> Result<Vec<u8>> {
        self.all_rows(progress, |row, out: &mut [u8]| {
            let mut light = vec![0.0; out.len()];
            self.row(row, &mut light);
            self.display.quantise_8(row, &light, out);
        })
    }

    /// 16-bit codes, row-major (height, width, 3).
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn to_16_bits(&self, progress: &Progress) -> Result<Vec<u16>> {
        self.all_rows(progress, |row, out: &mut [u16]| {
            let mut light = vec![0.0; out.len()];
            self.row(row, &mut light);
            self.display.quantise_16(&light, out);
        })
    }

    fn all_rows<T: Copy + Default + Send>(&self, progress: &Progress, fill: impl Fn(usize, &mut [T]) + Sync) -> Result<Vec<T>> {
        let mut out = vec![T::default(); 3 * self.width * self.height];
        let bands = self.height.div_ceil(ROWS_PER_BAND);
        let parts = progress.parts("tone map", bands);
        out.par_chunks_mut(3 * self.width * ROWS_PER_BAND).enumerate().try_for_each(|(band, out)| {
            for (k, out) in out.chunks_mut(3 * self.width).enumerate() {
                fill(band * ROWS_PER_BAND + k, out);
            }
            parts.finish_one()
        })?;
        Ok(out)
    }
}

/// Rows between two reports of progress.
const ROWS_PER_BAND: usize = 16;

/// What all operators start from.
#[derive(Clone, Copy)]
struct Mapped<'a> {
    frame: Frame<'a>,
    display: Display,
    /// Factor on luminances in cd m-2.
    exposure: f64,
}

impl<'a> Mapped<'a> {
    /// Luminance of the screen's primaries.
    fn weights(&self) -> [f32; 3] {
        self.display.chromaticities().matrix_to_xyz()[1].map(|value| value as f32)
    }

    /// From CIE XYZ in cd m-2 to exposed light of the screen.
    fn display_matrix(&self) -> Matrix {
        self.display.chromaticities().matrix_from_xyz().map(|row| row.map(|value| value * self.exposure))
    }

    /// A function of a pixel's index and exposed colour, which has no negative components.
    fn pixels(self, map: impl Fn(usize, [f32; 3]) -> [f32; 3] + Send + Sync + 'a) -> Row<'a> {
        let (matrix, weights) = (self.frame.through(&self.display_matrix()), self.weights());
        Box::new(move |row, out| {
            let first = row * self.frame.width;
            for (column, (out, &pixel)) in out.as_chunks_mut::<3>().0.iter_mut().zip(self.frame.row(row)).enumerate() {
                *out = map(first + column, without_negative(exposed(&matrix, pixel), weights));
            }
        })
    }

    fn colours(self, colour: impl Fn([f32; 3]) -> [f32; 3] + Send + Sync + 'a) -> Row<'a> {
        self.pixels(move |_, rgb| colour(rgb))
    }

    fn channels(self, curve: impl Fn(f32) -> f32 + Send + Sync + 'a) -> Row<'a> {
        self.pixels(move |_, rgb| rgb.map(&curve))
    }

    /// The luminance as a function of the pixel's index and exposed luminance; the ratios of the channels stay, but for colours brighter than the screen's gamut.
    fn luminance(self, map: impl Fn(usize, f32) -> f32 + Send + Sync + 'a) -> Row<'a> {
        let weights = self.weights();
        self.pixels(move |pixel, rgb| {
            let luminance = dot(rgb, weights);
            if luminance <= 0.0 {
                return [0.0; 3];
            }
            let shown = map(pixel, luminance).clamp(0.0, 1.0);
            let scale = shown / luminance;
            without_excess(rgb.map(|value| value * scale), shown)
        })
    }

    fn sky(self, sky: &Sky, adaptation: f64, progress: &Progress) -> Result<Row<'a>> {
        let curve = Curve::new(sky);
        let Some(rods) = Rods::new(sky, adaptation) else { return Ok(self.colours(move |rgb| curve.colour(rgb))) };
        let blurred = blurred_for_rods(&self.frame, adaptation, sky.acuity_loss, progress)?;
        let to_xyz = self.frame.to_xyz().map(|row| row.map(|value| value as f32));
        let (from_xyz, weights) = (self.display_matrix().map(|row| row.map(|value| value as f32)), self.weights());
        Ok(Box::new(move |row, out| {
            let first = row * self.frame.width;
            for (column, (out, &pixel)) in out.as_chunks_mut::<3>().0.iter_mut().zip(self.frame.row(row)).enumerate() {
                let xyz = exposed(&to_xyz, pixel);
                let by_rods = match &blurred {
                    Some(blurred) => std::array::from_fn(|k| blurred[3 * (first + column) + k]),
                    None => xyz,
                };
                let rgb = from_xyz.map(|row| dot(row, rods.seen(xyz, by_rods)));
                *out = curve.colour(without_negative(rgb, weights));
            }
        }))
    }
}

/// What lies beyond the borders of `frame`.
fn edges(frame: &Frame<'_>) -> Edges {
    match frame.grid().latlong() {
        Some(image) => Edges::Sphere { nadir: image.span() > FRAC_PI_2 },
        None => Edges::Clamped,
    }
}

/// A value of each row.
fn rows<T: Send>(height: usize, of: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    (0..height).into_par_iter().map(of).collect()
}
