//! The grid of the solve: altitude levels, solar zenith angles, and directions at each level.

use super::air::forward_share;
use super::bends::sharp_bends;
use super::zenith_axis::ZenithAxis;
use crate::atmosphere::OpticalProfile;
use crate::numerics::{Axis, gauss, locate};
use crate::quality::Numbers;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Where the light field is known.
pub struct Grid {
    /// Altitude levels [km], dense near the ground.
    pub altitudes: Axis,
    /// Steps of rays end at these altitudes [km], and hold two points each.
    pub shells: Axis,
    /// The same for light scattered once while the Sun is low, see [`FINER`].
    pub fine_shells: Axis,
    /// Solar zenith angles, dense around the terminator.
    pub zeniths: ZenithAxis,
    /// Sine and cosine of the solar zenith angles.
    pub sun: Vec<(f64, f64)>,
    /// How many levels there are beyond those of the quality, because the air is thick.
    pub more_levels: usize,
    radius: f64,
}

/// How many times more shells, and shorter steps, a ray takes while the Sun is low: the edge of the planet's shadow lies across it then.
pub const FINER: usize = 3;

/// Part of the levels that follow the optical depth of the air rather than altitude: shallow layers, as of fog, get levels of their own.
const BY_OPTICAL_DEPTH: f64 = 0.3;

/// Optical depth of scattering, without forward peaks, up to which the levels of a quality do, how many more there are for each beyond it, and how many more at most. Those follow the
/// optical depth.
const THIN: f64 = 1.0;
const MORE_PER_OPTICAL_DEPTH: f64 = 2.0;
const MOST_MORE: usize = 16;

/// Vertical optical depths of scattering in `profile` by wavelength, forward peaks beside a field of orders up to `order` not counted.
pub fn scattering_depths(profile: &OpticalProfile, order: usize) -> Vec<f64> {
    let (z, count) = (&profile.altitudes_km, profile.wavelengths_nm.len());
    let of = |w: usize| -> f64 {
        let columns = profile.components.iter().filter_map(|component| Some((component.phase.as_ref()?, component)));
        columns
            .map(|(phase, component)| {
                let at = |i: usize| component.scattering_per_km[i * count + w];
                let column: f64 = (1..z.len()).map(|i| 0.5 * (z[i] - z[i - 1]) * (at(i - 1) + at(i))).sum();
                // What is thin anyway need not be known better.
                let share = if column > 0.5 * THIN { forward_share(&phase.legendre_moments(order + 2, w), order) } else { 0.0 };
                column * (1.0 - share)
            })
            .sum()
    };
    (0..count).into_par_iter().map(of).collect()
}

/// How many levels more than usual air of these optical depths of scattering needs.
fn more_levels(depths: &[f64]) -> usize {
    let mean = depths.iter().sum::<f64>() / depths.len() as f64;
    ((MORE_PER_OPTICAL_DEPTH * (mean - THIN)).ceil().max(0.0) as usize).min(MOST_MORE)
}

/// Where levels stand: equidistant in a mixture of (altitude / top)^(1 / 2.2) and the share of the vertical optical depth that is below.
struct Measure {
    altitudes: Vec<f64>,
    /// The first of the two at these altitudes.
    by_altitude: Vec<f64>,
    /// The second.
    by_optical_depth: Vec<f64>,
    /// Altitudes at which steps of rays end besides.
    bends: Vec<f64>,
}

impl Measure {
    fn new(profile: &OpticalProfile) -> Self {
        const PARTS: usize = 8;
        let (z, count) = (&profile.altitudes_km, profile.wavelengths_nm.len());
        let top = z[z.len() - 1];
        let mut below = vec![vec![0.0; z.len()]; count];
        for component in &profile.components {
            for i in 1..z.len() {
                for (w, below) in below.iter_mut().enumerate() {
                    let extinction =
                        |i: usize| component.scattering_per_km[i * count + w] + component.absorption_per_km[i * count + w];
                    below[i] += 0.5 * (z[i] - z[i - 1]) * (extinction(i - 1) + extinction(i));
                }
            }
        }
        let mut share = vec![0.0; z.len()];
        let mut density = vec![0.0; z.len()];
        for (w, below) in below.iter_mut().enumerate() {
            for i in 1..z.len() {
                below[i] += below[i - 1];
            }
            let all = below[z.len() - 1].max(1e-12);
            share.iter_mut().zip(below.iter()).for_each(|(share, below)| *share += below / all / count as f64);
            for (i, density) in density.iter_mut().enumerate() {
                let extinction =
                    profile.components.iter().map(|c| c.scattering_per_km[i * count + w] + c.absorption_per_km[i * count + w]);
                *density += extinction.sum::<f64>() / all;
            }
        }
        // Finer than the profile's own altitudes, between which the shares are linear.
        let (mut altitudes, mut by_altitude, mut by_optical_depth) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..z.len() - 1 {
            for part in 0..PARTS {
                let t = part as f64 / PARTS as f64;
                let altitude = z[i] + t * (z[i + 1] - z[i]);
                altitudes.push(altitude);
                by_altitude.push(((altitude - z[0]) / (top - z[0])).powf(1.0 / 2.2));
                by_optical_depth.push(share[i] + t * (share[i + 1] - share[i]));
            }
        }
        altitudes.push(top);
        by_altitude.push(1.0);
        by_optical_depth.push(share[z.len() - 1]);
        Self { altitudes, by_altitude, by_optical_depth, bends: sharp_bends(z, &density) }
    }

    /// `count` levels from the ground to the top, and `more` that follow the optical depth.
    fn spread(&self, count: usize, more: usize) -> Axis {
        let (usual, all) = (count as f64, (count + more) as f64);
        let share = if more == 0 { BY_OPTICAL_DEPTH } else { (BY_OPTICAL_DEPTH * usual + more as f64) / all };
        let values: Vec<f64> = self
            .by_altitude
            .iter()
            .zip(&self.by_optical_depth)
            .map(|(by_altitude, by_optical_depth)| (1.0 - share) * by_altitude + share * by_optical_depth)
            .collect();
        let (first, last) = (values[0], values[values.len() - 1]);
        let at = |i: usize| {
            let wanted = first + (last - first) * i as f64 / (count + more - 1) as f64;
            let (k, t) = locate(&values, wanted);
            self.altitudes[k] + t * (self.altitudes[k + 1] - self.altitudes[k])
        };
        Axis::new((0..count + more).map(at).collect())
    }

    /// `count` levels, and those at which the air changes sharply.
    fn shells(&self, count: usize, more: usize) -> Axis {
        let mut levels = self.spread(count, more).nodes().to_vec();
        levels.extend(&self.bends);
        levels.sort_by(f64::total_cmp);
        levels.dedup_by(|b, a| *b - *a < 1e-6);
        Axis::new(levels)
    }
}

/// An azimuth on half the circle.
#[derive(Clone, Copy, Debug)]
pub struct Azimuth {
    /// Azimuth from the Sun [radians].
    pub angle: f64,
    /// Cosine of the azimuth from the Sun.
    pub cosine: f64,
    /// Sine of the azimuth from the Sun.
    pub sine: f64,
    /// What it counts in an integral over the whole circle [radians].
    pub weight: f64,
}

/// `count` azimuths that integrate over the circle a function even in azimuth.
pub fn azimuths(count: usize) -> Vec<Azimuth> {
    (0..count)
        .map(|q| {
            let angle = (q as f64 + 0.5) * PI / count as f64;
            let (sine, cosine) = angle.sin_cos();
            Azimuth { angle, cosine, sine, weight: TAU / count as f64 }
        })
        .collect()
}

/// Matrix (to, from) that takes a function even in azimuth from its values at `from` to values at `to`: the cosine series through them.
pub fn azimuth_interpolation(from: &[Azimuth], to: &[Azimuth]) -> Vec<f32> {
    let n = from.len();
    let series = |a: f64, b: f64| (1..n).map(|m| 2.0 * (m as f64 * a).cos() * (m as f64 * b).cos()).sum::<f64>() + 1.0;
    to.iter().flat_map(|t| from.iter().map(move |f| (series(t.angle, f.angle) / n as f64) as f32)).collect()
}

impl Grid {
    /// The grid of a quality level for the air of `profile`, and the coarser one on which low orders are iterated.
    pub fn new(numbers: &Numbers, profile: &OpticalProfile) -> [Self; 2] {
        let radius = profile.planet_radius_km;
        let measure = Measure::new(profile);
        let more = more_levels(&scattering_depths(profile, numbers.order));
        let make = |altitudes: usize, solar_zenith_angles: usize| {
            let zeniths = ZenithAxis::new(solar_zenith_angles);
            let sun = zeniths.angles().iter().map(|theta| theta.sin_cos()).collect();
            let [shells, fine_shells] = [1, FINER].map(|finer| measure.shells(finer * numbers.shells, finer * more));
            Self { altitudes: measure.spread(altitudes, more), shells, fine_shells, zeniths, sun, more_levels: more, radius }
        };
        [
            make(numbers.altitudes, numbers.solar_zenith_angles),
            make(numbers.iteration_altitudes, numbers.iteration_solar_zenith_angles),
        ]
    }

    /// View zenith cosines with their weights for each level; `nodes` rising, between the horizontal and the horizon, and to the ground.
    pub fn directions(&self, nodes: [usize; 3]) -> Vec<Vec<(f64, f64)>> {
        self.altitudes.nodes().iter().map(|&z| directions(nodes, self.radius, z)).collect()
    }
}

/// Zenith cosines and weights over -1..1 in three bands that each hold a smooth radiance: rising rays, rays
/// between the horizontal and the local horizon, and rays to the ground. Nodes crowd where the radiance changes fastest.
fn directions([rising, limb, ground]: [usize; 3], radius: f64, altitude: f64) -> Vec<(f64, f64)> {
    let ratio = radius / (radius + altitude);
    let horizon = -(1.0 - ratio * ratio).max(0.0).sqrt();
    let mut nodes = Vec::new();
    let on_the_ground = altitude <= 0.0;
    let rising = if on_the_ground { rising + limb / 2 } else { rising };
    nodes.extend(gauss::legendre(rising).into_iter().map(|(t, w)| (t * t, 2.0 * t * w)));
    if !on_the_ground {
        nodes.extend(
            gauss::legendre(limb).into_iter().map(|(t, w)| (horizon * (1.0 - t * t.sqrt()), -horizon * 1.5 * t.sqrt() * w)),
        );
    }
    nodes.extend(
        gauss::legendre(ground).into_iter().map(|(t, w)| (horizon - (1.0 + horizon) * t * t, (1.0 + horizon) * 2.0 * t * w)),
    );
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_cover_the_sphere() {
        for altitude in [0.0, 0.01, 3.0, 100.0] {
            let nodes = directions([8, 6, 4], 6371.0, altitude);
            let solid: f64 = nodes.iter().map(|(_, w)| w).sum();
            let first: f64 = nodes.iter().map(|(mu, w)| mu * w).sum();
            let second: f64 = nodes.iter().map(|(mu, w)| mu * mu * w).sum();
            assert!(
                (solid - 2.0).abs() < 2e-3 && first.abs() < 2e-3 && (second - 2.0 / 3.0).abs() < 2e-3,
                "{altitude}: {solid} {first} {second}"
            );
        }
    }

    #[test]
    fn azimuth_interpolation_is_exact_for_low_frequencies() {
        let (from, to) = (azimuths(5), azimuths(9));
        let matrix = azimuth_interpolation(&from, &to);
        let f = |a: &Azimuth| 1.0 + 0.3 * a.cosine - 0.2 * (4.0 * a.angle).cos();
        for (t, row) in to.iter().zip(matrix.chunks(5)) {
            let value: f64 = row.iter().zip(&from).map(|(&w, a)| f64::from(w) * f(a)).sum();
            assert!((value - f(t)).abs() < 1e-6);
        }
    }
}
