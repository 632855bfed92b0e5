//! The fine rays of the ciliary corona, drawn from random lines.
//!
//! The thesis multiplies f1 + f2 by one picture of lines of random intensity through the centre, and f3 by another. Here a picture is what it is along a circle:
//! [`LINES`] lines at position angles uniform in a turn, intensities uniform in [0, 1], profile a Gaussian whose standard deviation is uniform in [`WIDTHS_DEG`] of position angle.
//! The sum is divided by its mean, so that streaks move light around the source and neither add nor take any. A pixel gets the mean over the range of position angles that it
//! covers: near the source, where all lines lie in one pixel, that is 1.
//!
//! Further out lines fade into their mean, by exp(-(chord / 0.245)^2): to 0.6 at 10 degrees, 0.13 at 20, 0.01 at 30. A picture of the thesis ends before that matters, on a whole sphere rays would
//! run to the other side, which no eye shows.

use std::f32::consts::TAU;

/// Lines of a picture.
pub const LINES: usize = 400;

/// Least and greatest standard deviation of a line's profile in position angle [degrees].
pub const WIDTHS_DEG: (f64, f64) = (0.1, 0.4);

/// Square of the chord at which lines have faded to 1 / e.
pub const FADED_CHORD_SQUARED: f64 = 0.06;

/// Square of the chord (46 degrees) beyond which there are none: below 1e-4.
pub const LAST_CHORD_SQUARED: f32 = 0.6;

const STEPS: usize = 8192;

/// Brightness along a circle, with the mean 1.
#[derive(Clone, Debug)]
pub struct Ring {
    /// Integral from 0 to each step, in turns; a turn and one step more.
    integral: Vec<f32>,
}

impl Ring {
    /// The ring that `seed` draws; `contrast` 0 (none) to 1 (lines on black).
    pub fn new(seed: u64, contrast: f64) -> Self {
        let mut random = SplitMix64(seed);
        let mut values = vec![0.0; STEPS];
        for _ in 0..LINES {
            let centre = random.next() * STEPS as f64;
            let intensity = random.next();
            let width = (WIDTHS_DEG.0 + (WIDTHS_DEG.1 - WIDTHS_DEG.0) * random.next()) / 360.0 * STEPS as f64;
            let reach = (5.0 * width).ceil() as isize;
            for step in centre as isize - reach..=centre as isize + reach {
                let distance = (step as f64 + 0.5 - centre) / width;
                values[step.rem_euclid(STEPS as isize) as usize] += intensity * (-0.5 * distance * distance).exp();
            }
        }
        let mean = values.iter().sum::<f64>() / STEPS as f64;
        let mut integral = Vec::with_capacity(STEPS + 2);
        let mut sum = 0.0;
        integral.push(0.0);
        for k in 0..=STEPS {
            sum += (1.0 + contrast * (values[k % STEPS] / mean - 1.0)) / STEPS as f64;
            integral.push(sum as f32);
        }
        Self { integral }
    }

    /// Mean over `width` [radians] around a position `angle` [radians, -pi to pi].
    #[inline]
    pub fn mean(&self, angle: f32, width: f32) -> f32 {
        let width = width / TAU;
        if width >= 1.0 {
            return 1.0;
        }
        let from = angle / TAU - 0.5 * width;
        let from = from - from.floor();
        let width = width.max(1.0 / STEPS as f32);
        let to = from + width;
        let whole = if to >= 1.0 { 1.0 } else { 0.0 };
        (whole + self.at(to - whole) - self.at(from)) / width
    }

    #[inline]
    fn at(&self, turns: f32) -> f32 {
        let position = turns * STEPS as f32;
        let left = (position as usize).min(STEPS);
        let part = position - left as f32;
        self.integral[left] + part * (self.integral[left + 1] - self.integral[left])
    }
}

/// Steele, Lea & Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014.
struct SplitMix64(u64);

impl SplitMix64 {
    /// Uniform in [0, 1).
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_are_repeatable_of_mean_one_and_not_negative() {
        let ring = Ring::new(7, 1.0);
        assert_eq!(ring.integral, Ring::new(7, 1.0).integral);
        assert_ne!(ring.integral, Ring::new(8, 1.0).integral);
        let steps = 720;
        let width = TAU / steps as f32;
        let values: Vec<f32> = (0..steps).map(|k| ring.mean((k as f32 + 0.5) * width - 0.5 * TAU, width)).collect();
        assert!((values.iter().sum::<f32>() / steps as f32 - 1.0).abs() < 1e-4);
        assert!(
            values.iter().all(|&value| value >= 0.0)
                && values.iter().any(|&value| value > 2.0)
                && values.iter().any(|&value| value < 0.3)
        );
        assert_eq!(ring.mean(1.0, 7.0), 1.0);
        let plain = Ring::new(7, 0.0);
        assert!((plain.mean(-3.1, 0.01) - 1.0).abs() < 1e-3 && (plain.mean(3.1, 0.2) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn the_generator_is_the_published_one() {
        // checked against: the reference implementation's first output for the seed 1234567, 6457827717110365317
        assert_eq!(SplitMix64(1_234_567).next(), (6_457_827_717_110_365_317_u64 >> 11) as f64 / (1u64 << 53) as f64);
    }
}
