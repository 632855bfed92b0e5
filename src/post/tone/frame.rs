//! A picture as tone mapping sees it: borrowed pixels, with what they mean and where they look.

use crate::post::picture::{LARGEST, Picture, View};
use crate::probe::Probe;
use crate::projection::{Geometry, Grid};
use crate::spectrum::color_space::{ColorSpace, Matrix, product};
use crate::units::Scale;

/// Exposed values over this are white in every operator; so their squares stay finite.
const BRIGHTEST: f32 = 1e15;

/// The pixels of a [`Picture`] or of a [`Probe`], without a copy.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// Width [pixels].
    pub width: usize,
    /// Height [pixels].
    pub height: usize,
    /// Linear values, row-major (height, width, 3). Those that no light can have are taken for what [`Picture::repair`] makes of them.
    pub pixels: &'a [f32],
    /// Primaries and white of the pixels.
    pub color_space: ColorSpace,
    /// Luminance of a pixel whose Y is 1 [cd m-2].
    pub white_luminance: f64,
    /// Where the pixels look.
    pub view: View,
    /// How far a sky in it is turned, as [`Picture::turn_deg`] [degrees].
    pub turn_deg: f64,
}

impl<'a> From<&'a Picture> for Frame<'a> {
    fn from(picture: &'a Picture) -> Self {
        let &Picture { width, height, ref pixels, color_space, white_luminance, view, turn_deg, .. } = picture;
        Self { width, height, pixels, color_space, white_luminance, view, turn_deg }
    }
}

impl<'a> From<&'a Probe> for Frame<'a> {
    fn from(probe: &'a Probe) -> Self {
        let settings = &probe.settings;
        Self {
            width: probe.width,
            height: probe.height,
            pixels: &probe.pixels,
            color_space: settings.color_space,
            white_luminance: Scale::white_luminance(settings.scale),
            view: settings.view(),
            turn_deg: settings.turn_deg,
        }
    }
}

impl Frame<'_> {
    /// The matrix from pixels to CIE XYZ in cd m-2.
    pub fn to_xyz(&self) -> Matrix {
        self.color_space.matrix_to_xyz().map(|row| row.map(|value| value * self.white_luminance))
    }

    /// The matrix from pixels to what `from_xyz` makes of CIE XYZ in cd m-2, in single precision.
    pub(super) fn through(&self, from_xyz: &Matrix) -> [[f32; 3]; 3] {
        product(from_xyz, &self.to_xyz()).map(|row| row.map(|value| value as f32))
    }

    /// Row `row` as triples.
    pub(super) fn row(&self, row: usize) -> &[[f32; 3]] {
        self.pixels[3 * self.width * row..3 * self.width * (row + 1)].as_chunks::<3>().0
    }

    /// The geometry of the pixels.
    pub fn grid(&self) -> Grid {
        self.view.grid((self.width, self.height), self.turn_deg)
    }
}

/// Solid angle of a pixel [sr] by that of its middle, and 0 where a probe shows no sky: on and below the horizontal plane, outside a fisheye's circle.
pub(super) fn weight(grid: &dyn Geometry, column: usize, row: usize) -> f64 {
    match grid.direction_and_density(column as f64 + 0.5, row as f64 + 0.5) {
        Some((direction, density)) if direction.z > 1e-12 => density,
        _ => 0.0,
    }
}

/// `pixel` times `matrix`, with what no light can have repaired, at most [`BRIGHTEST`].
#[inline]
pub(super) fn exposed(matrix: &[[f32; 3]; 3], pixel: [f32; 3]) -> [f32; 3] {
    let pixel = pixel.map(sound);
    matrix.map(|row| {
        let value = row[0] * pixel[0] + row[1] * pixel[1] + row[2] * pixel[2];
        // Denormals would slow down all that follows.
        if value.abs() < f32::MIN_POSITIVE { 0.0 } else { value.clamp(-BRIGHTEST, BRIGHTEST) }
    })
}

/// `value`, or what [`Picture::repair`] makes of it if no light can have it.
#[inline]
fn sound(value: f32) -> f32 {
    if value.abs() <= LARGEST {
        value
    } else if value > 0.0 {
        LARGEST
    } else {
        0.0
    }
}

/// `rgb` without negative components: moved towards the grey of its own luminance, the dot product with `weights`.
#[inline]
pub(super) fn without_negative(rgb: [f32; 3], weights: [f32; 3]) -> [f32; 3] {
    let lowest = rgb[0].min(rgb[1]).min(rgb[2]);
    if lowest >= 0.0 {
        return rgb;
    }
    let luminance = dot(rgb, weights);
    if luminance <= 0.0 {
        return [0.0; 3];
    }
    let kept = luminance / (luminance - lowest);
    rgb.map(|value| (luminance + (value - luminance) * kept).max(0.0))
}

/// `rgb` with no component over 1: moved towards the grey of its own luminance, which is at most 1.
#[inline]
pub(super) fn without_excess(rgb: [f32; 3], luminance: f32) -> [f32; 3] {
    let largest = rgb[0].max(rgb[1]).max(rgb[2]);
    if largest <= 1.0 {
        return rgb;
    }
    let kept = (1.0 - luminance).max(0.0) / (largest - luminance);
    rgb.map(|value| (luminance + (value - luminance) * kept).clamp(0.0, 1.0))
}

/// The scalar product.
#[inline]
pub(super) fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
