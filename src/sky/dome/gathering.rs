//! Directions of a dome gathered from the light field, circle by circle.

use super::half::Half;
use super::lanes::Lanes;
use crate::error::Result;
use crate::light::{AngularFunctions, Gathered, LightField, Observer, Once};
use crate::progress::Parts;
use crate::quality::Numbers;
use crate::sky::PolarisingFilter;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// What a direction's radiance is a sum of.
pub(super) struct Terms {
    /// The functions of each component; then follows the rest (I, and Q and U behind a filter).
    pub functions: Arc<Vec<AngularFunctions>>,
    pub lanes: Lanes,
}

/// What a dome is gathered from.
pub(in crate::sky) struct Gathering<'a> {
    pub field: &'a LightField,
    pub numbers: &'a Numbers,
    pub filter: Option<PolarisingFilter>,
    /// Relative error that interpolation may have, instead of the quality's numbers of circles and azimuths.
    pub tolerance: Option<f64>,
    /// Whether what is below the horizon is gathered, too; a tolerance gathers it always.
    pub ground: bool,
    /// Weights that turn radiance per unit solar irradiance into XYZ.
    pub weights: Vec<[f64; 3]>,
    pub observer: Observer,
    pub horizon: f64,
    /// Altitude and azimuth of the Sun's centre, geometric [radians].
    pub sun: (f64, f64),
}

/// The sky or the ground of a dome that is being gathered.
pub(super) struct Side<'a> {
    pub what: &'a Gathering<'a>,
    pub terms: &'a Terms,
    pub above: bool,
}

impl Side<'_> {
    /// Altitude of the circle at `position`, the square root of the share of the way from the horizon.
    pub fn altitude(&self, position: f64) -> f64 {
        // A hair inside each side, so that the ray along the horizon is on the side it belongs to.
        const HAIR: f64 = 1e-7;
        let (horizon, share) = (self.what.horizon, position * position);
        if self.above {
            horizon + HAIR + (FRAC_PI_2 - horizon - HAIR) * share
        } else {
            horizon - HAIR - (FRAC_PI_2 + horizon - HAIR) * share
        }
    }

    /// XYZ of each field, (azimuth, field), on the circle at `position` in `azimuths` from the Sun.
    pub fn gather(&self, position: f64, azimuths: &[f64]) -> Vec<[f32; 3]> {
        let gathered = self.what.field.gather(&self.what.observer, self.altitude(position).sin(), azimuths);
        let mut row = Vec::with_capacity(azimuths.len() * self.terms.lanes.count());
        for a in 0..azimuths.len() {
            self.terms.push_fields(&gathered, a, &self.what.weights, &mut row);
        }
        row
    }

    /// The half with `circles` circles at even positions.
    pub fn even(&self, circles: usize, parts: &Parts) -> Result<Half> {
        let last = self.what.numbers.dome_azimuths - 1;
        let azimuths: Vec<f64> = (0..=last).map(|a| PI * a as f64 / last as f64).collect();
        let positions: Vec<f64> = (0..circles).map(|c| c as f64 / (circles - 1) as f64).collect();
        let gather = |position: &f64| {
            let row = self.gather(*position, &azimuths);
            parts.finish_one().map(|()| row)
        };
        let rows = positions.par_iter().map(gather).collect::<Result<Vec<_>>>()?;
        Ok(Half::new(positions, &rows, &self.terms.lanes))
    }
}

impl Terms {
    /// Adds the fields, as XYZ, of one gathered direction to `out`.
    fn push_fields(&self, gathered: &Gathered, azimuth: usize, weights: &[[f64; 3]], out: &mut Vec<[f32; 3]>) {
        for (c, functions) in self.functions.iter().enumerate() {
            let (strength, direct) = (gathered.strength(azimuth, c), gathered.direct_strength(azimuth, c));
            let path = gathered.path(azimuth, c);
            let mut sums = vec![[0.0; 3]; functions.len()];
            let mut shares = vec![0.0; functions.len()];
            for (w, weight) in weights.iter().enumerate() {
                let [strength, direct_strength, path] = [strength, direct, path].map(|values| f64::from(values[w]));
                functions.weights(w, &Once { strength, direct_strength, path }, &mut shares);
                for (sum, share) in sums.iter_mut().zip(&shares) {
                    for k in 0..3 {
                        sum[k] += share * weight[k];
                    }
                }
            }
            out.extend(sums.into_iter().map(|xyz| xyz.map(|v| v as f32)));
        }
        for parameter in 0..if self.lanes.filter().is_some() { 3 } else { 1 } {
            let mut xyz = [0.0; 3];
            for (&value, weight) in gathered.rest(azimuth, parameter).iter().zip(weights) {
                for k in 0..3 {
                    xyz[k] += f64::from(value) * weight[k];
                }
            }
            out.push(xyz.map(|v| v as f32));
        }
    }
}
