//! Means of many paths, on all threads, and how far they are to be believed.

use super::guide::{Guide, Steering};
use super::medium::Medium;
use super::sampling::Random;
use super::scene::Scene;
use super::stokes::Stokes;
use super::walk::Walker;
use crate::error::{Error, Result};
use crate::progress::Progress;
use rayon::prelude::*;

/// Paths that share a stream of random numbers and a thread; the result does not depend on the number of threads.
const PATHS_PER_CHUNK: usize = 256;

/// A Monte Carlo result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean over the paths.
    pub mean: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
    /// The largest path's share of the variance, 0 to 1. Near 1 / paths all is well; above a few per cent the standard error
    /// hangs on few paths and is not to be believed.
    pub largest_share: f64,
}

impl Estimate {
    /// What is known exactly.
    pub(super) const ZERO: Self = Self { mean: 0.0, standard_error: 0.0, largest_share: 0.0 };
}

/// The mean of `samples` paths through `medium`; with a guide, which its air must have been asked for, they are guided.
pub(super) fn trace<M: Medium>(
    medium: &M,
    scene: &Scene,
    guide: Option<&Guide>,
    (samples, seed): (usize, u64),
    progress: &Progress,
) -> Result<[Estimate; 3]> {
    let chunks = samples.div_ceil(PATHS_PER_CHUNK);
    let parts = progress.parts("trace", chunks);
    let sums: Vec<Sums> = (0..chunks)
        .into_par_iter()
        .map(|chunk| {
            let mut random = Random::new(seed, chunk as u64);
            let steering = guide.and_then(|guide| Some(Steering::new(guide, medium.as_air()?)));
            let mut walker = Walker::new(medium, scene, steering);
            let mut sums = Sums::default();
            for _ in 0..PATHS_PER_CHUNK.min(samples - chunk * PATHS_PER_CHUNK) {
                sums.add(walker.path(&mut random));
            }
            parts.finish_one()?;
            Ok(sums)
        })
        .collect::<Result<_>>()?;
    let all = sums.into_iter().fold(Sums::default(), Sums::plus);
    Ok(std::array::from_fn(|i| all.estimate(i, samples as f64)))
}

/// A standard error needs two paths.
pub(super) fn check_samples(samples: usize) -> Result<()> {
    if samples < 2 { Err(Error::input("samples", samples, "at least 2")) } else { Ok(()) }
}

/// Moments of the values of paths.
#[derive(Clone, Copy, Default)]
struct Sums {
    first: Stokes,
    second: Stokes,
    largest: Stokes,
}

impl Sums {
    fn add(&mut self, value: Stokes) {
        for i in 0..3 {
            self.first[i] += value[i];
            self.second[i] += value[i] * value[i];
            self.largest[i] = self.largest[i].max(value[i].abs());
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            first: std::array::from_fn(|i| self.first[i] + other.first[i]),
            second: std::array::from_fn(|i| self.second[i] + other.second[i]),
            largest: std::array::from_fn(|i| self.largest[i].max(other.largest[i])),
        }
    }

    fn estimate(&self, i: usize, n: f64) -> Estimate {
        let mean = self.first[i] / n;
        let variance = ((self.second[i] / n - mean * mean) * n / (n - 1.0)).max(0.0);
        let largest_share = if variance > 0.0 { ((self.largest[i] - mean.abs()).powi(2) / (variance * n)).min(1.0) } else { 0.0 };
        Estimate { mean, standard_error: (variance / n).sqrt(), largest_share }
    }
}
