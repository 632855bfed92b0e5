//! What tells the paths where the light is: a rough map of the light in the air, made by the path tracer for itself.
//!
//! By dusk light reaches the observer through several scatterings from sunlit air far away, where a blind path never gets. The
//! light of a spherical air is symmetric about the Sun's axis, so a place needs two numbers, altitude and the Sun's zenith angle. On a coarse grid of the two
//! `build` finds the mean intensity by successive orders, as though the air scattered isotropically, and the radiance by bins of direction. Paths draw directions
//! (`lobes`) and distances (`flight`) in proportion to it and are split or ended so that each carries about the same light (`steering`).
//!
//! None of this enters the result but through probabilities, by which the weights are divided: a wrong map costs time, not
//! truth (importance sampling: Kalos & Whitlock 2008, ch. 4; weight windows: Booth & Hendricks 1984).

mod bins;
mod build;
mod flight;
mod lobes;
mod steering;
mod tables;

pub(super) use flight::Ending;
pub(super) use steering::Steering;

use super::super::chord::Chord;
use super::air::Air;
use crate::units::EARTH_RADIUS_KM;
use flight::{Flight, Sunshine};
use lobes::Lobes;
use std::f64::consts::PI;
use tables::{Tables, bilinear, split};

/// Levels of the map, at altitudes top (i / (LEVELS - 1))^2.
const LEVELS: usize = 20;

/// Nodes in the Sun's zenith angle, densest where the Sun is just below the horizon.
const SUNS: usize = 44;

/// Cosine of the zenith angle where they are densest, 96 degrees, and how widely.
const DENSEST: f64 = -0.104_528;
const WIDTH: f64 = 0.3;

/// Cosine at the last node, 132 degrees; a lower Sun counts as this.
const LOWEST: f64 = -0.669_131;

/// Altitudes at which rays are cut, top (i / LADDER)^2.
const LADDER: usize = 32;

/// Longest step of a ray on a planet of the Earth's size [km].
const STEP_KM: f64 = 25.0;

/// The map of the light of one air at one wavelength, for a solar irradiance of 1.
pub(super) struct Guide {
    tables: Tables,
    /// Altitudes [km] at which rays are cut.
    ladder: Vec<f64>,
    step: f64,
    /// ln of the mean intensity of the light scattered at least once or reflected, (level, Sun).
    ln_mean: Vec<f64>,
    /// Radiance of the ground by its direct sunlight and by the sky [sr-1], by Sun.
    ground_by_sun: Vec<f64>,
    ground_by_sky: Vec<f64>,
    /// Probability of each bin of direction, (level, Sun, bin), that a ray from there brings light.
    bins: Vec<f32>,
}

impl Guide {
    /// The expected mean over all directions of the radiance [sr-1] of light that the air or the ground has scattered.
    pub fn mean_intensity(&self, level: f64, sun_zenith_cosine: f64) -> f64 {
        bilinear(&self.ln_mean, SUNS, split(level, LEVELS - 1), split(sun_position(sun_zenith_cosine), SUNS - 1)).exp()
    }

    /// The same at an altitude [km].
    pub fn mean_intensity_at(&self, altitude: f64, sun_zenith_cosine: f64) -> f64 {
        self.mean_intensity(self.tables.level(altitude), sun_zenith_cosine)
    }

    /// The expected radiance of the ground [sr-1] by the light of the sky alone.
    pub fn ground_radiance_by_sky(&self, sun_zenith_cosine: f64) -> f64 {
        by_sun(&self.ground_by_sky, sun_zenith_cosine)
    }

    fn ground_radiance(&self, sun_zenith_cosine: f64) -> f64 {
        by_sun(&self.ground_by_sky, sun_zenith_cosine) + by_sun(&self.ground_by_sun, sun_zenith_cosine)
    }

    /// Distances at which a ray is cut: where it crosses the ladder, at its lowest point, and between so that no step is long.
    fn cut(&self, chord: &Chord, length: f64, ends_on_ground: bool, out: &mut Vec<f64>) {
        out.clear();
        out.push(0.0);
        let mut add = |to: f64| {
            let from = out[out.len() - 1];
            let to = to.min(length);
            if to <= from + 1e-9 {
                return;
            }
            let steps = ((to - from) / self.step).ceil().clamp(1.0, 1e4) as usize;
            out.extend((1..=steps).map(|i| from + (to - from) * i as f64 / steps as f64));
        };
        let below = self.ladder.partition_point(|&z| z < chord.altitude);
        let mut next = below;
        if chord.cosine < 0.0 {
            for i in (0..below).rev() {
                let Some((way_in, _)) = chord.crossings(self.ladder[i]) else { break };
                add(way_in);
                next = i;
            }
            if !ends_on_ground {
                add(-chord.radius * chord.cosine);
            }
        }
        if !ends_on_ground {
            for &altitude in &self.ladder[next..] {
                if let Some((_, way_out)) = chord.crossings(altitude) {
                    add(way_out);
                }
            }
        }
        add(length);
    }

    fn new_empty(air: &Air) -> Self {
        let tables = Tables::new(air);
        let ladder = (0..=LADDER).map(|i| tables.top * (i as f64 / LADDER as f64).powi(2)).collect();
        let step = STEP_KM * tables.radius / EARTH_RADIUS_KM;
        let direct = (0..SUNS).map(|i| {
            let cosine = sun_cosine(i);
            air.ground_albedo / PI * cosine.max(0.0) * tables.sunlight(0.0, 0.0, cosine)
        });
        Self {
            ground_by_sun: direct.collect(),
            ground_by_sky: vec![0.0; SUNS],
            ln_mean: vec![build::NONE.ln(); LEVELS * SUNS],
            bins: Vec::new(),
            ladder,
            step,
            tables,
        }
    }
}

/// Position 0 to 1 among the nodes in the Sun's zenith angle.
fn sun_position(cosine: f64) -> f64 {
    let stretched = |cosine: f64| {
        let x = cosine - DENSEST;
        x / (WIDTH + x.abs())
    };
    let (first, last) = (stretched(1.0), stretched(LOWEST));
    ((first - stretched(cosine)) / (first - last)).clamp(0.0, 1.0)
}

/// Cosine of the Sun's zenith angle at node `i`.
fn sun_cosine(i: usize) -> f64 {
    let stretched = |cosine: f64| {
        let x = cosine - DENSEST;
        x / (WIDTH + x.abs())
    };
    let (first, last) = (stretched(1.0), stretched(LOWEST));
    let v = first + (last - first) * i as f64 / (SUNS - 1) as f64;
    DENSEST + WIDTH * v / (1.0 - v.abs())
}

fn by_sun(values: &[f64], cosine: f64) -> f64 {
    let (i, fraction) = split(sun_position(cosine), SUNS - 1);
    values[i] * (1.0 - fraction) + values[i + 1] * fraction
}
