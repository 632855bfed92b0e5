//! The scattered part of a point spread function, ready to be asked millions of times: by angle, position angle and channel.
//!
//! The angle gamma comes as the square of the chord between two unit vectors, 4 sin^2(gamma / 2): without cancellation at small angles, without an arc cosine.

use super::halo::{END_DEG, Halo};
use super::psf::{self, AdaptationState};
use super::streaks::{FADED_CHORD_SQUARED, LAST_CHORD_SQUARED, Ring};
use crate::spectrum::ColorSpace;

/// Smallest chord squared in the table: 1e-5 degrees, where f1 is flat.
const SMALLEST: f32 = 1.0 / (1u64 << 45) as f32;
/// Entries of the table per octave of the chord squared, as bits; linear between them: 4e-6 relative error of a power law;
/// 1.5 % beyond 175 degrees, where the chord hardly grows.
const OCTAVE_BITS: u32 = 8;

/// What an eye scatters.
pub struct Scatter {
    /// Of white light and of the channels of the halo, weighted [sr-1]; what is left of streaks.
    table: Vec<[f32; 5]>,
    has_halo: bool,
    streaks: Option<[Ring; 2]>,
    /// Luminance of the channels; none in a space without a gamut.
    luminance: Option<[f32; 3]>,
}

impl Scatter {
    /// Of an eye in `state`, in the channels of `space`, with streaks of a `contrast` from 0 to 1 that `seed` draws.
    pub fn new(state: AdaptationState, space: ColorSpace, seed: u64, contrast: f64) -> Self {
        let [_, w1, w2, w3] = state.weights();
        let halo = Halo::new(space);
        let first = SMALLEST.to_bits() >> (23 - OCTAVE_BITS);
        let last = 4f32.to_bits() >> (23 - OCTAVE_BITS);
        let entry = |key: u32| {
            let chord = f64::from(f32::from_bits(key << (23 - OCTAVE_BITS))).sqrt();
            let angle = (2.0 * (0.5 * chord).min(1.0).asin()).to_degrees();
            let [red, green, blue] = halo.at(angle).map(|value| (w3 * value) as f32);
            let white = (w1 * psf::corona(angle) + w2 * psf::veil(angle)) as f32;
            [white, red, green, blue, (-chord * chord / FADED_CHORD_SQUARED).exp() as f32]
        };
        let table = (first..=last + 1).map(entry).collect();
        let streaks = (contrast > 0.0).then(|| [Ring::new(seed, contrast), Ring::new(!seed, contrast)]);
        let weights = space.matrix_to_xyz()[1].map(|weight| weight as f32);
        Self { table, has_halo: w3 > 0.0, streaks, luminance: (space != ColorSpace::Xyz).then_some(weights) }
    }

    /// Whether position angles matter.
    pub fn has_streaks(&self) -> bool {
        self.streaks.is_some()
    }

    /// Whether channels differ anywhere.
    pub fn has_halo(&self) -> bool {
        self.has_halo
    }

    /// Whether channels may differ at this chord squared.
    #[inline]
    pub fn is_coloured(&self, chord_squared: f32) -> bool {
        self.has_halo && chord_squared < ((0.5 * END_DEG.to_radians()).sin() as f32 * 2.0).powi(2) * 1.001
    }

    /// Share of the light of each channel per solid angle [sr-1] at a chord squared and a `position` (right, up of the source, any length), over a
    /// range of position angles of `width` [radians].
    #[inline]
    pub fn at(&self, chord_squared: f32, position: (f32, f32), width: f32) -> [f32; 3] {
        let Some([corona, halo]) = self.streaks.as_ref().filter(|_| chord_squared < LAST_CHORD_SQUARED) else {
            return self.smooth(chord_squared);
        };
        let [white, red, green, blue, left] = self.look_up(chord_squared);
        let angle = atan2(position.0, position.1);
        let white = white * (1.0 + left * (corona.mean(angle, width) - 1.0));
        if !self.is_coloured(chord_squared) {
            return [white; 3];
        }
        let ring = halo.mean(angle, width);
        self.in_gamut([white + ring * red, white + ring * green, white + ring * blue])
    }

    /// The same without streaks: the mean around the source.
    #[inline]
    pub fn smooth(&self, chord_squared: f32) -> [f32; 3] {
        let [white, red, green, blue, _] = self.look_up(chord_squared);
        self.in_gamut([white + red, white + green, white + blue])
    }

    #[inline]
    fn look_up(&self, chord_squared: f32) -> [f32; 5] {
        const SHIFT: u32 = 23 - OCTAVE_BITS;
        let bits = chord_squared.clamp(SMALLEST, 4.0).to_bits();
        let left = ((bits >> SHIFT) - (SMALLEST.to_bits() >> SHIFT)) as usize;
        let part = (bits & ((1 << SHIFT) - 1)) as f32 * (1.0 / (1 << SHIFT) as f32);
        let (a, b) = (&self.table[left], &self.table[left + 1]);
        std::array::from_fn(|k| a[k] + part * (b[k] - a[k]))
    }

    /// A colour outside the space moves towards the grey of its luminance, so that glare takes light from nowhere.
    #[inline]
    fn in_gamut(&self, rgb: [f32; 3]) -> [f32; 3] {
        let lowest = rgb[0].min(rgb[1]).min(rgb[2]);
        let Some(weights) = self.luminance else { return rgb };
        if lowest >= 0.0 {
            return rgb;
        }
        let luminance = (rgb[0] * weights[0] + rgb[1] * weights[1] + rgb[2] * weights[2]).max(0.0);
        let kept = luminance / (luminance - lowest);
        rgb.map(|value| (luminance + (value - luminance) * kept).max(0.0))
    }
}

/// The arc tangent of `y` / `x` in the quadrant of both, within 1e-5: a streak is a hundred times as wide.
///
/// Polynomial for |t| <= 1: Abramowitz & Stegun 1964, 4.4.49.
#[inline]
fn atan2(y: f32, x: f32) -> f32 {
    let (large, small) = (x.abs().max(y.abs()), x.abs().min(y.abs()));
    let t = if large > 0.0 { small / large } else { 0.0 };
    let s = t * t;
    let series = 1.0
        + s * (-0.333_331_45
            + s * (0.199_935_5
                + s * (-0.142_089
                    + s * (0.106_562_64
                        + s * (-0.075_289_64 + s * (0.042_909_61 + s * (-0.016_165_737 + s * 0.002_866_225_7)))))));
    let angle = t * series;
    let angle = if y.abs() > x.abs() { std::f32::consts::FRAC_PI_2 - angle } else { angle };
    let angle = if x < 0.0 { std::f32::consts::PI - angle } else { angle };
    if y < 0.0 { -angle } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_the_function() {
        let scatter = Scatter::new(AdaptationState::Photopic, ColorSpace::LinRec709, 1, 0.0);
        for angle in [1e-4f64, 0.003, 0.02, 0.7, 5.0, 33.0, 90.0, 150.0] {
            let chord = 2.0 * (0.5 * angle.to_radians()).sin();
            let expected = 0.478 * psf::corona(angle) + 0.138 * psf::veil(angle);
            let found = scatter.at((chord * chord) as f32, (0.0, 1.0), 0.1);
            assert!(found.iter().all(|&value| (f64::from(value) / expected - 1.0).abs() < 1e-5), "{angle}: {found:?} {expected}");
        }
        assert!(scatter.at(0.0, (0.0, 0.0), 1.0)[0].is_finite());
    }

    #[test]
    fn nothing_is_negative_in_a_gamut() {
        let scatter = Scatter::new(AdaptationState::Scotopic, ColorSpace::LinRec709, 3, 1.0);
        for k in 0..600 {
            for turn in 0..60 {
                let angle = 0.01 * k as f32;
                let chord = 2.0 * (0.5 * angle.to_radians()).sin();
                let found = scatter.at(chord * chord, (0.1 * turn as f32).sin_cos(), 0.01);
                assert!(found.iter().all(|value| *value >= 0.0 && value.is_finite()), "{angle}: {found:?}");
            }
        }
    }

    #[test]
    fn arc_tangents_are_right() {
        for k in -300..=300 {
            let angle = 0.01 * k as f32;
            let (y, x) = angle.sin_cos();
            assert!((atan2(3.0 * y, 3.0 * x) - angle).abs() < 1e-5, "{angle}");
        }
    }
}
