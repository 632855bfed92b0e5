//! Making the guide: successive orders of scattering on a coarse grid.

use super::bins::{AZIMUTHS, BINS, ZENITHS, azimuth_range, solid_angle, zenith_range};
use super::flight::{Flight, Sunshine};
use super::tables::horizon_cosine;
use super::{Guide, LEVELS, SUNS, sun_cosine};
use crate::light::chord::Chord;
use crate::light::path_tracer::air::Air;
use crate::light::path_tracer::shells::End;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Orders of scattering that are summed.
const ORDERS: usize = 7;

/// A phase function counts as at most this: paths seek its peak by themselves.
pub(super) const LARGEST_PHASE: f64 = 6.0;

/// What stands for no light.
pub(super) const NONE: f64 = 1e-40;

impl Guide {
    /// Maps the light of `air`.
    pub fn new(air: &Air) -> Self {
        let mut guide = Self::new_empty(air);
        let mut radiance = Vec::new();
        for order in 1..=ORDERS {
            radiance = guide.radiance_in_bins(air, if order < ORDERS { 1 } else { 2 });
            guide.take_means(air, &radiance);
        }
        guide.take_bins(&radiance);
        guide
    }

    /// Mean radiance in all bins, (level, zenith, Sun, azimuth), from `parts` zenith angles and as many azimuths in each.
    fn radiance_in_bins(&self, air: &Air, parts: usize) -> Vec<f64> {
        let rows: Vec<Vec<f64>> = (0..LEVELS * ZENITHS)
            .into_par_iter()
            .map(|row| {
                let altitude = self.altitude(row / ZENITHS);
                let (low, high) = zenith_range(row % ZENITHS, horizon_cosine(self.tables.radius, altitude));
                let mut out = vec![0.0; SUNS * AZIMUTHS];
                if high > low {
                    for part in 0..parts {
                        let cosine = low + (high - low) * (part as f64 + 0.5) / parts as f64;
                        self.add_radiance(air, altitude, cosine, parts, &mut out);
                    }
                }
                out
            })
            .collect();
        rows.concat()
    }

    /// Adds the radiance at zenith cosine `cosine`, (Sun, azimuth), over the number of parts. All share the geometry of the ray.
    fn add_radiance(&self, air: &Air, altitude: f64, cosine: f64, parts: usize, out: &mut [f64]) {
        let chord = Chord { altitude, radius: self.tables.radius + altitude, cosine };
        let (end, length) = air.shells.end(&chord);
        let mut flight = Flight::default();
        flight.trace(self, &chord, length, end == End::Ground);
        let mut phases = vec![0.0; air.scatterers.len()];
        for (k, value) in out.iter_mut().enumerate() {
            let zenith_cosine = sun_cosine(k / AZIMUTHS);
            let sines = ((1.0 - zenith_cosine * zenith_cosine) * (1.0 - cosine * cosine)).max(0.0).sqrt();
            let (near, far) = azimuth_range(k % AZIMUTHS);
            for part in 0..parts {
                let azimuth = near + (far - near) * (part as f64 + 0.5) / parts as f64;
                let sun_cosine = cosine * zenith_cosine + sines * azimuth.cos();
                for (phase, scatterer) in phases.iter_mut().zip(&air.scatterers) {
                    *phase = scatterer.pattern.value(sun_cosine).min(LARGEST_PHASE);
                }
                let (air, ground) = flight.light(self, &Sunshine { zenith_cosine, cosine: sun_cosine, phases: Some(&phases) });
                *value += (air + ground) / (parts * parts) as f64;
            }
        }
    }

    fn altitude(&self, level: usize) -> f64 {
        self.tables.top * (level as f64 / (LEVELS - 1) as f64).powi(2)
    }

    /// Mean intensities and the irradiance of the ground from the radiance in the bins.
    fn take_means(&mut self, air: &Air, radiance: &[f64]) {
        for level in 0..LEVELS {
            let horizon = horizon_cosine(self.tables.radius, self.altitude(level));
            for sun in 0..SUNS {
                let (mut mean, mut irradiance) = (0.0, 0.0);
                for bin in 0..BINS {
                    let (i, j) = (bin / AZIMUTHS, bin % AZIMUTHS);
                    let light = 2.0 * solid_angle(i, j, horizon) * radiance[index(level, sun, i, j)];
                    let (low, high) = zenith_range(i, horizon);
                    mean += light / (4.0 * PI);
                    irradiance += light * (0.5 * (low + high)).max(0.0);
                }
                self.ln_mean[level * SUNS + sun] = mean.max(NONE).ln();
                if level == 0 {
                    self.ground_by_sky[sun] = air.ground_albedo / PI * irradiance;
                }
            }
        }
    }

    /// Probabilities of the bins from the radiance in them.
    fn take_bins(&mut self, radiance: &[f64]) {
        self.bins = vec![0.0; LEVELS * SUNS * BINS];
        for level in 0..LEVELS {
            let horizon = horizon_cosine(self.tables.radius, self.altitude(level));
            for sun in 0..SUNS {
                let light = |bin: usize| {
                    let (i, j) = (bin / AZIMUTHS, bin % AZIMUTHS);
                    solid_angle(i, j, horizon) * radiance[index(level, sun, i, j)]
                };
                let sum: f64 = (0..BINS).map(light).sum();
                let start = (level * SUNS + sun) * BINS;
                for bin in 0..BINS {
                    self.bins[start + bin] = if sum > 0.0 { (light(bin) / sum) as f32 } else { 1.0 / BINS as f32 };
                }
            }
        }
    }
}

fn index(level: usize, sun: usize, zenith: usize, azimuth: usize) -> usize {
    ((level * ZENITHS + zenith) * SUNS + sun) * AZIMUTHS + azimuth
}
