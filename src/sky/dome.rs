//! The whole dome of the sky and the ground below, gathered at some hundreds of directions and smooth between them.
//!
//! What is interpolated is not radiance but fields that are smooth even around the Sun: radiance = sum over basis functions b of the
//! components' phase functions of P_b(angle to the Sun) F_b + rest, all as XYZ. The phase functions, sharp around the Sun, are applied in each direction exactly.
//! Interpolation is cubic in the square root of the angular distance from the horizon, where light changes fastest, and in azimuth from the Sun, in which the fields are even.

use super::SkyLight;
use super::disc::Disc;
use crate::atmosphere::Phase;
use crate::error::Result;
use crate::light::{Axis, LightField, Observer};
use crate::progress::Progress;
use crate::quality::Numbers;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Light in all directions around one observer at one moment.
pub struct SkyDome {
    above: Half,
    below: Half,
    horizon: f64,
    /// Unit vector to the Sun's centre, geometric: altitude and azimuth [radians].
    sun_altitude: f64,
    sun_azimuth: f64,
    /// Phase functions of the components, in the order of their fields.
    phases: Vec<Phase>,
    discs: Vec<Disc>,
}

/// The fields on one side of the horizon.
struct Half {
    /// Square root of the share of the way from the horizon to the zenith or nadir.
    circles: Axis,
    azimuths: Axis,
    /// Number of fields: basis functions and the rest.
    fields: usize,
    /// XYZ of each field, (circle, azimuth, field).
    values: Vec<[f32; 3]>,
}

/// What a dome is gathered from.
pub(super) struct Gathering<'a> {
    pub field: &'a LightField,
    pub numbers: &'a Numbers,
    pub phases: Vec<Phase>,
    /// Weights that turn radiance per unit solar irradiance into XYZ.
    pub weights: Vec<[f64; 3]>,
    pub observer: Observer,
    pub horizon: f64,
}

impl SkyDome {
    /// Gathers the light for a Sun at `sun_altitude`, `sun_azimuth` [radians].
    pub(super) fn gather(
        what: &Gathering,
        (sun_altitude, sun_azimuth): (f64, f64),
        discs: Vec<Disc>,
        progress: &Progress,
    ) -> Result<Self> {
        let circles = what.numbers.dome_circles;
        let below_circles = circles / 2;
        let parts = progress.parts("gather", circles + below_circles);
        // A hair inside each side, so that the ray along the horizon is on the side it belongs to.
        const HAIR: f64 = 1e-7;
        let above = Half::gather(what, circles, |share| what.horizon + HAIR + (FRAC_PI_2 - what.horizon - HAIR) * share, &parts)?;
        let below =
            Half::gather(what, below_circles, |share| what.horizon - HAIR - (FRAC_PI_2 + what.horizon - HAIR) * share, &parts)?;
        Ok(Self { above, below, horizon: what.horizon, sun_altitude, sun_azimuth, phases: what.phases.clone(), discs })
    }
}

impl Half {
    fn gather(
        what: &Gathering,
        count: usize,
        altitude: impl Fn(f64) -> f64 + Sync,
        parts: &crate::progress::Parts,
    ) -> Result<Self> {
        let azimuths: Vec<f64> =
            (0..what.numbers.dome_azimuths).map(|a| PI * a as f64 / (what.numbers.dome_azimuths - 1) as f64).collect();
        let positions: Vec<f64> = (0..count).map(|c| c as f64 / (count - 1) as f64).collect();
        let fields = what.phases.iter().map(Phase::basis_len).sum::<usize>() + 1;
        let rows = positions
            .par_iter()
            .map(|position| {
                let gathered = what.field.gather(&what.observer, altitude(position * position).sin(), &azimuths);
                let mut row = Vec::with_capacity(azimuths.len() * fields);
                for a in 0..azimuths.len() {
                    for (c, phase) in what.phases.iter().enumerate() {
                        for b in 0..phase.basis_len() {
                            row.push(to_xyz(gathered.part(a, c), &what.weights, |w| phase.basis_weight(b, w)));
                        }
                    }
                    row.push(to_xyz(gathered.part(a, what.phases.len()), &what.weights, |_| 1.0));
                }
                parts.finish_one()?;
                Ok(row)
            })
            .collect::<Result<Vec<_>>>()?;
        Ok(Self { circles: Axis::new(positions), azimuths: Axis::new(azimuths), fields, values: rows.concat() })
    }
}

fn to_xyz(values: &[f32], weights: &[[f64; 3]], factor: impl Fn(usize) -> f64) -> [f32; 3] {
    let mut xyz = [0.0; 3];
    for (w, (&value, weight)) in values.iter().zip(weights).enumerate() {
        let value = f64::from(value) * factor(w);
        for k in 0..3 {
            xyz[k] += value * weight[k];
        }
    }
    xyz.map(|v| v as f32)
}

impl SkyLight for SkyDome {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        let (half, share) = if altitude >= self.horizon {
            (&self.above, (altitude - self.horizon) / (FRAC_PI_2 - self.horizon))
        } else {
            (&self.below, (self.horizon - altitude) / (FRAC_PI_2 + self.horizon))
        };
        // Along the circle only azimuth is left to interpolate.
        let across = half.circles.cubic(share.clamp(0.0, 1.0).sqrt());
        let width = half.azimuths.len() * half.fields;
        let mut row = vec![[0.0_f32; 3]; width];
        for (a, &weight) in across.weights.iter().enumerate() {
            let circle = &half.values[(across.first + a) * width..(across.first + a + 1) * width];
            for (sum, value) in row.iter_mut().zip(circle) {
                for k in 0..3 {
                    sum[k] += weight * value[k];
                }
            }
        }
        let (sine, cosine) = altitude.sin_cos();
        let (sun_sine, sun_cosine) = self.sun_altitude.sin_cos();
        let last = half.azimuths.len() - 1;
        for (&azimuth, xyz) in azimuths.iter().zip(out) {
            let from_sun = (azimuth - self.sun_azimuth).rem_euclid(TAU);
            let from_sun = if from_sun > PI { TAU - from_sun } else { from_sun };
            let scattering_cosine = sine * sun_sine + cosine * sun_cosine * from_sun.cos();
            // Four neighbours of an even function: nodes beyond either end are those before it.
            let position = from_sun / PI * last as f64;
            let interval = (position as usize).min(last - 1);
            let x = (position - interval as f64) as f32;
            let before = if interval == 0 { 1 } else { interval - 1 };
            let after = if interval + 2 > last { 2 * last - interval - 2 } else { interval + 2 };
            let nodes = [before, interval, interval + 1, after];
            let weights = even_cubic(x);
            let mut sum = [0.0_f32; 3];
            let mut field = 0;
            let mut add = |factor: f32, field: usize| {
                for (&node, &weight) in nodes.iter().zip(&weights) {
                    let value = &row[node * half.fields + field];
                    for k in 0..3 {
                        sum[k] += factor * weight * value[k];
                    }
                }
            };
            for phase in &self.phases {
                for b in 0..phase.basis_len() {
                    add(phase.basis(b, scattering_cosine) as f32, field);
                    field += 1;
                }
            }
            add(1.0, field);
            *xyz = sum.map(|v| v.max(0.0));
        }
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        self.discs.clone()
    }
}

/// Lagrange weights of four equidistant nodes at -1, 0, 1, 2 for a place `x` between 0 and 1.
fn even_cubic(x: f32) -> [f32; 4] {
    [
        -x * (x - 1.0) * (x - 2.0) / 6.0,
        (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
        -x * (x + 1.0) * (x - 2.0) / 2.0,
        x * (x + 1.0) * (x - 1.0) / 6.0,
    ]
}
