//! Random scattering angles for any phase function, known by its values alone.
//!
//! The angle is cut into bins, densest at 0, where particles throw a peak a tenth of a degree wide. Angles are drawn from
//! a density that is constant in each bin, about the mean of the phase function there; who uses them divides the phase function by that very density, so the
//! table's coarseness costs variance and never truth.

use super::sampling::Random;
use crate::atmosphere::Phase;
use std::f64::consts::PI;

/// Bins of the angle; their edges are pi (i / BINS)^3.
const BINS: usize = 1024;

/// Share of angles drawn uniformly over the sphere, so that no angle is left out.
const UNIFORM_SHARE: f64 = 1e-3;

/// A random scattering angle of one phase function at one wavelength.
pub(super) struct Angles {
    /// Probability of the bins up to and including each.
    cumulative: Vec<f64>,
    /// Density in each bin, times 4 pi.
    density: Vec<f64>,
}

/// 1 - cos of the angle at bin edge `i`, without cancellation.
fn edge(i: f64) -> f64 {
    2.0 * (0.5 * PI * (i / BINS as f64).powi(3)).sin().powi(2)
}

/// Bin of the angle with cosine `cosine`, the same in all tables.
pub(super) fn bin(cosine: f64) -> usize {
    let angle = cosine.clamp(-1.0, 1.0).acos();
    (((angle / PI).cbrt() * BINS as f64) as usize).min(BINS - 1)
}

impl Angles {
    pub fn new(phase: &Phase, wavelength: usize) -> Self {
        let widths: Vec<f64> = (0..BINS).map(|i| edge((i + 1) as f64) - edge(i as f64)).collect();
        let values: Vec<f64> = (0..BINS)
            .map(|i| {
                let parts = [0.1, 0.5, 0.9].map(|part| phase.value(wavelength, 1.0 - edge(i as f64 + part)).max(0.0));
                parts.iter().sum::<f64>() / 3.0
            })
            .collect();
        let sum: f64 = values.iter().zip(&widths).map(|(value, width)| 0.5 * value * width).sum();
        let scale = if sum > 0.0 { (1.0 - UNIFORM_SHARE) / sum } else { 0.0 };
        let uniform = if sum > 0.0 { UNIFORM_SHARE } else { 1.0 };
        let density: Vec<f64> = values.iter().map(|value| scale * value + uniform).collect();
        let mut total = 0.0;
        let cumulative = density
            .iter()
            .zip(&widths)
            .map(|(density, width)| {
                total += 0.5 * density * width;
                total
            })
            .collect();
        Self { cumulative, density }
    }

    /// Cosine of a random angle.
    pub fn sample(&self, random: &mut Random) -> f64 {
        let target = random.uniform() * self.cumulative[BINS - 1];
        let i = self.cumulative.partition_point(|&sum| sum <= target).min(BINS - 1);
        let (low, high) = (edge(i as f64), edge((i + 1) as f64));
        1.0 - (low + (high - low) * random.uniform())
    }

    /// Density of directions at angles of bin `bin`, times 4 pi: what the phase function would be.
    pub fn density(&self, bin: usize) -> f64 {
        self.density[bin]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The weighted moments of drawn cosines are the Legendre moments of the phase function.
    #[test]
    fn weighted_cosines_have_the_moments_of_the_phase_function() {
        let phases = [
            Phase::Rayleigh { depolarisation: vec![0.03] },
            Phase::Rayleigh { depolarisation: vec![1.0] },
            Phase::HenyeyGreenstein { asymmetry: 0.7 },
            Phase::HenyeyGreenstein { asymmetry: 0.98 },
            Phase::HenyeyGreenstein { asymmetry: -0.9 },
            Phase::CornetteShanks { asymmetry: 0.76 },
        ];
        for (stream, phase) in phases.iter().enumerate() {
            let angles = Angles::new(phase, 0);
            let mut random = Random::new(1, stream as u64);
            let n = 200_000;
            let (mut sums, mut largest) = ([0.0; 5], 0.0_f64);
            for _ in 0..n {
                let x = angles.sample(&mut random);
                let weight = phase.value(0, x) / angles.density(bin(x));
                largest = largest.max(weight);
                let legendre =
                    [1.0, x, 1.5 * x * x - 0.5, 2.5 * x.powi(3) - 1.5 * x, (35.0 * x.powi(4) - 30.0 * x * x + 3.0) / 8.0];
                for (sum, p) in sums.iter_mut().zip(legendre) {
                    *sum += weight * p;
                }
            }
            assert!(largest < 1.1, "{phase:?}: {largest}");
            for (l, sum) in sums.iter().enumerate() {
                // A Legendre polynomial has a standard deviation of at most 1; weights are 1 within a per cent.
                let limit = if l == 0 { 1e-3 } else { 4.0 / (n as f64).sqrt() };
                assert!((sum / n as f64 - phase.legendre_moment(l, 0)).abs() < limit, "{phase:?}, order {l}");
            }
        }
    }

    #[test]
    fn a_drawn_angle_lies_in_the_bin_it_was_drawn_from() {
        let angles = Angles::new(&Phase::HenyeyGreenstein { asymmetry: 0.9 }, 0);
        let mut random = Random::new(2, 0);
        let mut sum = 0.0;
        let n = 100_000;
        for _ in 0..n {
            // The mean of 1 / density is the whole sphere, 1, whatever the density.
            sum += 1.0 / angles.density(bin(angles.sample(&mut random)));
        }
        assert!((sum / f64::from(n) - 1.0).abs() < 0.05, "{sum}");
    }
}
