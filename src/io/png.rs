//! A tone-mapped picture to look at: 8 bits, sRGB.
//!
//! Exposure: with the luminances of the upper half by solid angle, without the brightest 2 % (the Sun and its aureole) and without what is nearly black,
//! g their log-average and q their 95th percentile \[cd m-2\],
//! ```text
//! exposure = sqrt(0.36 / g  1.5 / q) min(1, g / 3000)^0.05
//! ```
//! A sky of even brightness would be exposed by g alone and a contrasty one by q alone; the mean of both keeps the middle of the sky near mid-grey and
//! its bright part below white. The last factor lets a dusk look darker than a noon: by one stop for each six decades of light.
//!
//! Curve, on the largest of the three channels: straight up to 0.4, then a hyperbolic shoulder towards 1. The other channels keep their ratio to
//! the largest, raised to 1.4: a picture on a screen, much dimmer than the sky, looks as colourful as the sky only with more contrast than it has.
//! So hue stays, no colour leaves the gamut, and what is far above white fades to white.
//! Values are dithered by interleaved gradient noise (Jimenez 2014), because a sky is smooth enough to show the steps of 8 bits.

use crate::error::{Error, Result};
use crate::probe::Probe;
use crate::spectrum::color_space::{ColorSpace, Matrix, transform};
use image::ImageEncoder;
use image::codecs::png::PngEncoder;
use rayon::prelude::*;
use std::io::Write;
use std::path::Path;

/// What the log-average of luminance becomes in a sky of even brightness.
const MIDDLE: f64 = 0.36;

/// What the 95th percentile of luminance becomes, before the curve, in a sky of great contrast.
const BRIGHT: f64 = 1.5;

/// Log-average of luminance from which on a sky is shown as a bright one [cd m-2].
const DAYLIGHT: f64 = 3000.0;

/// How much darker a dark sky is shown, as a power of its luminance.
const DARKENING: f64 = 0.05;

/// End of the straight part of the curve.
const SHOULDER: f64 = 0.4;

/// Contrast of the channels among each other.
const COLOUR_CONTRAST: f64 = 1.4;

/// How fast colours above the shoulder fade to white.
const FADING: f64 = 0.15;

/// 8-bit sRGB pixels, row-major (height, width, 3), of a tone-mapped `probe`, brighter by `exposure_stops`.
pub fn tone_map(probe: &Probe, exposure_stops: f64) -> Vec<u8> {
    let to_xyz = probe.settings.color_space.matrix_to_xyz();
    let from_xyz = ColorSpace::LinRec709.matrix_from_xyz();
    let exposure = exposure(probe, &to_xyz) * exposure_stops.exp2();
    let mut out = vec![0; probe.pixels.len()];
    out.par_chunks_mut(3 * probe.width).zip(probe.pixels.par_chunks(3 * probe.width)).enumerate().for_each(
        |(row, (out, pixels))| {
            for (column, (out, pixel)) in out.chunks_exact_mut(3).zip(pixels.chunks_exact(3)).enumerate() {
                let xyz = transform(&to_xyz, [0, 1, 2].map(|k| f64::from(pixel[k]) * exposure));
                let shown = display(transform(&from_xyz, xyz));
                for (k, (out, value)) in out.iter_mut().zip(shown).enumerate() {
                    *out = (255.0 * srgb(value) + noise(column, row + 37 * k)).floor().clamp(0.0, 255.0) as u8;
                }
            }
        },
    );
    out
}

/// Factor on the pixels (module documentation).
fn exposure(probe: &Probe, to_xyz: &Matrix) -> f64 {
    let grid = probe.grid();
    let step = (probe.width * probe.height / 100_000).max(1);
    let mut found: Vec<(f64, f64)> = (0..probe.width * probe.height)
        .step_by(step)
        .filter_map(|k| {
            let footprint = grid.footprint(k % probe.width, k / probe.width);
            let rgb = [0, 1, 2].map(|channel| f64::from(probe.pixels[3 * k + channel]));
            let luminance = transform(to_xyz, rgb)[1];
            let counts = luminance > 0.0 && footprint.solid_angle > 0.0 && footprint.mean_direction.z > 0.0;
            counts.then_some((luminance, footprint.solid_angle))
        })
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f64 = found.iter().map(|&(_, weight)| weight).sum();
    let mut passed = 0.0;
    let mut quantile = found.iter().map(|&(luminance, weight)| {
        passed += weight;
        (luminance, passed / total)
    });
    let mut at = |share: f64| quantile.find(|&(_, passed)| passed >= share).map(|(luminance, _)| luminance);
    let (Some(median), Some(bright), Some(brightest)) = (at(0.5), at(0.95), at(0.98)) else { return 1.0 };
    let (sum, counted) = found
        .iter()
        .filter(|&&(luminance, _)| luminance > 1e-3 * median && luminance <= brightest)
        .fold((0.0, 0.0), |(sum, counted), &(luminance, weight)| (sum + weight * luminance.ln(), counted + weight));
    let middle = (sum / counted).exp();
    let candelas = middle * probe.settings.scale.white_luminance();
    (MIDDLE / middle * BRIGHT / bright).sqrt() * (candelas / DAYLIGHT).min(1.0).powf(DARKENING)
}

/// A linear colour between 0 and 1 for a screen.
fn display(rgb: [f64; 3]) -> [f64; 3] {
    let largest = rgb[0].max(rgb[1]).max(rgb[2]);
    if largest <= 0.0 {
        return [0.0; 3];
    }
    let over = (largest - SHOULDER).max(0.0);
    let room = 1.0 - SHOULDER;
    let shown = if over > 0.0 { 1.0 - room * room / (over + room) } else { largest };
    let kept = 1.0 / (1.0 + FADING * over);
    rgb.map(|value| {
        let colour = shown * (value.max(0.0) / largest).powf(COLOUR_CONTRAST);
        shown + (colour - shown) * kept
    })
}

/// Encodes a linear value (IEC 61966-2-1).
fn srgb(value: f64) -> f64 {
    if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 }
}

/// Well-spread numbers in [0, 1).
fn noise(x: usize, y: usize) -> f64 {
    (52.982_918_9 * (0.067_110_56 * x as f64 + 0.005_837_15 * y as f64).fract()).fract()
}

/// Writes a tone-mapped `probe`; `path` is only for messages.
///
/// # Errors
/// [`Error::File`].
pub(super) fn write(out: &mut impl Write, path: &Path, probe: &Probe, exposure_stops: f64) -> Result<()> {
    let pixels = tone_map(probe, exposure_stops);
    PngEncoder::new(out)
        .write_image(&pixels, probe.width as u32, probe.height as u32, image::ExtendedColorType::Rgb8)
        .map_err(|error| Error::file(path, error))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::probe::ProbeSettings;
    use crate::units::Scale;

    /// A sky and ground of even light but for one pixel.
    fn uniform(value: f32, sun: f32, scale: Scale) -> Probe {
        let settings = ProbeSettings { width: 64, scale, ..Default::default() };
        let mut pixels = vec![value; 3 * 64 * 32];
        pixels[3 * (10 * 64 + 20)..][..3].fill(sun);
        Probe::new(pixels, settings).unwrap()
    }

    #[test]
    fn exposure_follows_the_sky_and_not_the_sun() {
        let noon = tone_map(&uniform(10.0, 10.0, Scale::Blender), 0.0);
        let with_sun = tone_map(&uniform(10.0, 2e6, Scale::Blender), 0.0);
        assert_eq!(with_sun[..3 * 64 * 10], noon[..3 * 64 * 10]);
        assert!(with_sun[3 * (10 * 64 + 20)..][..3].iter().all(|&value| value == 255));
        // An even sky: sqrt(0.36 x 1.5) is on the shoulder, 1 - 0.6^2 / (0.7348 + 0.2).
        let expected = 255.0 * srgb(1.0 - 0.36 / ((0.36f64 * 1.5).sqrt() + 0.2));
        assert!((f64::from(noon[0]) - expected).abs() <= 1.0, "{} {expected}", noon[0]);
        assert_eq!(tone_map(&uniform(0.0, 0.0, Scale::Blender), 0.0), vec![0; 3 * 64 * 32]);
    }

    #[test]
    fn exposure_does_not_see_the_unit_of_the_pixels() {
        let shown = [(10.0, Scale::Blender), (6830.0, Scale::Luminance)]
            .map(|(value, scale)| tone_map(&uniform(value, value, scale), 0.0));
        assert!(shown[0].iter().zip(&shown[1]).all(|(&a, &b)| a.abs_diff(b) <= 1));
    }

    #[test]
    fn a_million_times_less_light_is_one_stop_darker() {
        let xyz = ColorSpace::LinRec709.matrix_to_xyz();
        let middle = |value: f32| f64::from(value) * exposure(&uniform(value, value, Scale::Luminance), &xyz);
        assert!((middle(3000.0) / middle(0.003) - 2.0).abs() < 0.01, "{}", middle(3000.0) / middle(0.003));
        assert!((middle(30_000.0) / middle(3000.0) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn exposure_counts_the_upper_half_only() {
        let bright = uniform(10.0, 10.0, Scale::Blender);
        let mut dark_ground = bright.clone();
        dark_ground.pixels[3 * 64 * 16..].fill(0.1);
        assert_eq!(tone_map(&dark_ground, 0.0)[..3 * 64 * 16], tone_map(&bright, 0.0)[..3 * 64 * 16]);
    }

    #[test]
    fn a_contrasty_sky_is_not_burnt_out() {
        // A tenth of the upper half is twelve times as bright as the rest, as at a Sun of 5 degrees.
        let mut probe = uniform(1.0, 1.0, Scale::Blender);
        for row in 0..16 {
            for column in 0..6 {
                probe.pixels[3 * (row * 64 + column)..][..3].copy_from_slice(&[14.0, 12.0, 8.0]);
            }
        }
        let shown = tone_map(&probe, 0.0);
        let (glow, sky) = (&shown[..3], &shown[3 * 32..][..3]);
        assert!(glow[0] < 250 && glow[0] > glow[1] + 3 && glow[1] > glow[2] + 10, "{glow:?}");
        assert!((90..190).contains(&sky[0]), "{sky:?}");
    }

    #[test]
    fn colours_keep_their_order_and_end_white() {
        for scale in [1e-3, 0.1, 1.0, 10.0] {
            let blue = display([0.2 * scale, 0.5 * scale, scale]);
            assert!(0.0 < blue[0] && blue[0] < blue[1] && blue[1] < blue[2] && blue[2] < 1.0, "{blue:?}");
        }
        assert!(display([2e9, 1e9, 5e8]).iter().all(|&value| (value - 1.0).abs() < 1e-6));
        assert_eq!(display([-1.0, -0.1, 0.0]), [0.0; 3]);
    }

    #[test]
    fn the_curve_rises_without_a_step() {
        let shown = |value: f64| display([value; 3])[0];
        for value in [0.01, 0.2, SHOULDER - 1e-6, SHOULDER + 1e-6, 1.0, 5.0] {
            let slope = (shown(value + 1e-7) - shown(value - 1e-7)) / 2e-7;
            assert!(slope > 0.0 && slope < 1.0 + 1e-5, "{value} {slope}");
        }
        assert!((shown(SHOULDER + 1e-9) - shown(SHOULDER - 1e-9)).abs() < 1e-8);
    }
}
