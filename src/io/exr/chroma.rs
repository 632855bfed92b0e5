//! Luminance and chroma (OpenEXR documentation, "Technical Introduction", Luminance/Chroma Images): RY = (R - Y) / Y and BY = (B - Y) / Y, with a sample for each
//! pixel or fewer.
//!
//! Chroma of every second column and row comes back by OpenEXR's own filter of 27 points (`ImfRgbaYca`), so that files look as they do in other programs; then colours that the filter
//! has made more saturated than all around are brought back, with the luminance that they have.

use crate::spectrum::color_space::{inverse, transform};
use crate::spectrum::{Chromaticities, ColorSpace};
use rayon::prelude::*;

/// A value between samples from the seven on either side, the nearest first.
const BETWEEN: [f32; 7] = [0.627_123, -0.186_077, 0.087_929, -0.043_159, 0.019_597, -0.007_540, 0.002_128];

/// Samples of one channel.
#[derive(Clone, Debug, Default)]
pub struct Plane {
    /// Samples in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// A sample for so many columns and rows.
    pub sampling: (usize, usize),
    /// Row by row.
    pub values: Vec<f32>,
}

/// Luminance of red, green and blue of 1.
pub fn luminance_weights(primaries: Option<&Chromaticities>) -> [f32; 3] {
    let weights = |primaries: &Chromaticities| {
        let Chromaticities { red, green, blue, white } = *primaries;
        let column = |[x, y]: [f64; 2]| [x, y, 1.0 - x - y];
        let (r, g, b) = (column(red), column(green), column(blue));
        let amounts = transform(&inverse(&[0, 1, 2].map(|k| [r[k], g[k], b[k]])), column(white));
        [0, 1, 2].map(|k| (amounts[k] * [r, g, b][k][1] / white[1]) as f32)
    };
    let usable = |weights: &[f32; 3]| weights.iter().all(|weight| weight.is_finite()) && weights[1].abs() > 1e-6;
    primaries.map(weights).filter(usable).unwrap_or_else(|| weights(&ColorSpace::LinRec709.chromaticities()))
}

/// The `count` values of a row or a column of which `samples` has every `step`-th, the first included; `get` reads one.
fn spread(samples: usize, step: usize, count: usize, get: impl Fn(usize) -> f32, mut put: impl FnMut(usize, f32)) {
    let at = |k: isize| get(k.clamp(0, samples as isize - 1) as usize);
    for k in 0..count {
        let (whole, part) = ((k / step) as isize, k % step);
        let value = if part == 0 {
            at(whole)
        } else if step == 2 {
            BETWEEN.iter().zip(0..).map(|(weight, d)| weight * (at(whole - d) + at(whole + 1 + d))).sum()
        } else {
            let share = part as f32 / step as f32;
            at(whole) * (1.0 - share) + at(whole + 1) * share
        };
        put(k, value);
    }
}

impl Plane {
    /// With a sample for each column of a picture of `width`.
    fn widen(&self, width: usize) -> Self {
        let mut values = vec![0.0; width * self.height];
        values.par_chunks_mut(width).zip(self.values.par_chunks(self.width.max(1))).for_each(|(row, samples)| {
            spread(self.width, self.sampling.0, width, |k| samples[k], |k, value| row[k] = value);
        });
        Self { width, height: self.height, sampling: (1, self.sampling.1), values }
    }

    /// The row `y` of the picture, of a plane with a sample for each column.
    fn row(&self, y: usize) -> Vec<f32> {
        let own = |k: isize| {
            let k = k.clamp(0, self.height as isize - 1) as usize;
            &self.values[k * self.width..(k + 1) * self.width]
        };
        let step = self.sampling.1;
        let (whole, part) = ((y / step) as isize, y % step);
        if part == 0 {
            return own(whole).to_vec();
        }
        let weights: Vec<(isize, f32)> = if step == 2 {
            BETWEEN.iter().zip(0..).flat_map(|(&weight, d)| [(whole - d, weight), (whole + 1 + d, weight)]).collect()
        } else {
            let share = part as f32 / step as f32;
            vec![(whole, 1.0 - share), (whole + 1, share)]
        };
        let mut row = vec![0.0; self.width];
        for (k, weight) in weights {
            row.iter_mut().zip(own(k)).for_each(|(sum, value)| *sum += weight * value);
        }
        row
    }
}

fn colour([r, g, b]: [f32; 3], luminance: f32, red: f32, blue: f32) -> [f32; 3] {
    if red == 0.0 && blue == 0.0 {
        return [luminance; 3];
    }
    let (red, blue) = ((red + 1.0) * luminance, (blue + 1.0) * luminance);
    [red, (luminance - red * r - blue * b) / g, blue]
}

fn saturation(pixel: [f32; 3]) -> f32 {
    let (most, least) = (pixel.into_iter().fold(f32::MIN, f32::max), pixel.into_iter().fold(f32::MAX, f32::min));
    if most > 0.0 { 1.0 - least / most } else { 0.0 }
}

/// A pixel whose diagonal neighbours have the mean saturation `around`.
fn tame(pixel: [f32; 3], around: f32, weights: [f32; 3]) -> [f32; 3] {
    let (own, around) = (saturation(pixel), around.min(1.0));
    let most = 1.0 - (1.0 - around) * 0.25;
    if own <= around || own <= most {
        return pixel;
    }
    let luminance = |pixel: [f32; 3]| pixel.iter().zip(weights).map(|(value, weight)| value * weight).sum::<f32>();
    let brightest = pixel.into_iter().fold(f32::MIN, f32::max);
    let paler = pixel.map(|value| (brightest - (brightest - value) * most / own).max(0.0));
    let gain = luminance(pixel) / luminance(paler);
    if luminance(paler) > 0.0 { paler.map(|value| value * gain) } else { paler }
}

/// Colours of luminance and chroma into `out`, row-major (height, width, 3).
pub fn colours(luminance: &Plane, chroma: [&Plane; 2], weights: [f32; 3], out: &mut [f32]) {
    let (width, height) = (luminance.width, luminance.height);
    let is_filtered = chroma.iter().any(|plane| plane.sampling != (1, 1)) && height > 1;
    let [red, blue] = chroma.map(|plane| plane.widen(width));
    let raw = |y: usize| -> Vec<[f32; 3]> {
        let values = luminance.values[y * width..(y + 1) * width].iter().zip(red.row(y).into_iter().zip(blue.row(y)));
        values.map(|(&luminance, (red, blue))| colour(weights, luminance, red, blue)).collect()
    };
    out.par_chunks_mut(3 * width).enumerate().for_each(|(y, out)| {
        let row = raw(y);
        let neighbours = is_filtered.then(|| (raw(y.saturating_sub(1)), raw(if y + 1 < height { y + 1 } else { y - 1 })));
        for (x, pixel) in out.as_chunks_mut::<3>().0.iter_mut().enumerate() {
            *pixel = match &neighbours {
                None => row[x],
                Some((above, below)) => {
                    let (left, right) = (x.saturating_sub(1), (x + 1).min(width - 1));
                    let around = [above[left], above[right], below[left], below[right]].map(saturation).iter().sum::<f32>() / 4.0;
                    tame(row[x], around, weights)
                }
            };
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_those_of_the_primaries() {
        // checked against: ITU-R BT.709 and BT.2020, luma coefficients
        for (space, expected) in
            [(ColorSpace::LinRec709, [0.2126, 0.7152, 0.0722]), (ColorSpace::LinRec2020, [0.2627, 0.6780, 0.0593])]
        {
            let weights = luminance_weights(Some(&space.chromaticities()));
            assert!(weights.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4), "{weights:?}");
        }
        assert_eq!(luminance_weights(Some(&ColorSpace::Xyz.chromaticities())), [0.0, 1.0, 0.0]);
        assert_eq!(luminance_weights(None), luminance_weights(Some(&ColorSpace::LinRec709.chromaticities())));
    }

    #[test]
    fn a_smooth_chroma_comes_back_between_its_samples() {
        // The filter has ripples of 0.12 %.
        let wave = |k: usize| (k as f32 * 0.3).sin();
        for (step, tolerance) in [(2, 1.5e-3), (4, 0.2)] {
            spread(
                200 / step,
                step,
                200,
                |k| wave(k * step),
                |k, value| {
                    if (20..180).contains(&k) {
                        assert!((value - wave(k)).abs() < tolerance, "{step} {k}");
                    }
                },
            );
        }
        // Constants are kept, to the borders.
        spread(5, 2, 10, |_| 3.0, |_, value| assert!((value - 3.0).abs() < 1e-5));
    }

    #[test]
    fn what_is_more_saturated_than_all_around_is_brought_back_with_its_luminance() {
        let weights = luminance_weights(None);
        let tamed = tame([1.0, 0.5, -0.2], 0.0, weights);
        let luminance = |pixel: [f32; 3]| pixel.iter().zip(weights).map(|(a, b)| a * b).sum::<f32>();
        assert!((luminance(tamed) - luminance([1.0, 0.5, -0.2])).abs() < 1e-6);
        assert!((saturation(tamed) - 0.75).abs() < 1e-5);
        assert_eq!(tame([1.0, 0.5, 0.4], 0.5, weights), [1.0, 0.5, 0.4]);
    }
}
