//! The whole dome of the sky and the ground below, gathered at some hundreds of directions and smooth between them.
//!
//! What is interpolated is not radiance but fields that are smooth even around the Sun: radiance = sum over the functions f of the scattering angle
//! ([`crate::light::AngularFunctions`]) of f F_f + rest, all as XYZ. The functions, sharp around the Sun, are applied in each direction exactly; through a polarising filter, so
//! is the polarisation of light scattered once.
//! Interpolation is cubic in the square root of the angular distance from the horizon, where light changes fastest, and in azimuth from the Sun, in which the fields are even (U odd).
//! The circles of equal altitude that are gathered are those of the quality, or as many as a tolerance needs (`refine`).

mod compact;
mod half;
mod lanes;
mod refine;
mod shade;

use super::SkyLight;
use super::disc::Disc;
use super::filter::PolarisingFilter;
use crate::error::Result;
use crate::light::{AngularFunctions, Gathered, LightField, Observer, Once};
use crate::progress::{Parts, Progress};
use crate::quality::Numbers;
use half::{Circle, Half};
use lanes::Lanes;
use rayon::prelude::*;
use shade::{CHUNK, Places, shade};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// Directions from which on a circle is interpolated whole rather than where it is asked for.
const WHOLE_CIRCLE: usize = 48;

/// Light in all directions around one observer at one moment.
pub struct SkyDome {
    above: Half,
    /// Left out where only the light from above is asked for.
    below: Option<Half>,
    horizon: f64,
    /// Unit vector to the Sun's centre, geometric: altitude and azimuth [radians].
    sun_altitude: f64,
    sun_azimuth: f64,
    discs: Vec<Disc>,
}

/// What a direction's radiance is a sum of.
struct Terms {
    /// The functions of each component; then follows the rest (I, and Q and U behind a filter).
    functions: Arc<Vec<AngularFunctions>>,
    lanes: Lanes,
}

/// What a dome is gathered from.
pub(super) struct Gathering<'a> {
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

impl SkyDome {
    /// Gathers the light.
    pub(super) fn gather(what: &Gathering, discs: Vec<Disc>, progress: &Progress) -> Result<Self> {
        let functions = what.field.functions();
        let terms = Terms { functions: Arc::clone(functions), lanes: Lanes::new(functions, what.filter) };
        let sides = [Side { what, terms: &terms, above: true }, Side { what, terms: &terms, above: false }];
        let (above, below) = match what.tolerance {
            None => {
                let circles = [what.numbers.dome_circles, if what.ground { what.numbers.dome_circles / 2 } else { 0 }];
                let parts = progress.parts("gather", circles[0] + circles[1]);
                let below = || what.ground.then(|| sides[1].even(circles[1], &parts)).transpose();
                (sides[0].even(circles[0], &parts)?, below()?)
            }
            Some(tolerance) => {
                let [above, below] = refine::refine(&sides, tolerance, progress)?;
                (above, Some(below))
            }
        };
        let (sun_altitude, sun_azimuth) = what.sun;
        Ok(Self { above, below, horizon: what.horizon, sun_altitude, sun_azimuth, discs })
    }

    /// The directions that were gathered, altitude and azimuth [radians, from north through east]: all on the counterclockwise side of the Sun, whose other side follows by symmetry.
    pub fn sample_directions(&self) -> Vec<[f64; 2]> {
        let of_half = |half: &Half, way: f64| -> Vec<[f64; 2]> {
            let step = PI / (half.azimuths - 1) as f64;
            let circles = half.circles.nodes().iter().map(|position| self.horizon + way * position * position);
            circles.flat_map(|altitude| (0..half.azimuths).map(move |a| [altitude, self.sun_azimuth - step * a as f64])).collect()
        };
        let below = self.below.as_ref().map(|below| of_half(below, -FRAC_PI_2 - self.horizon));
        [of_half(&self.above, FRAC_PI_2 - self.horizon), below.unwrap_or_default()].concat()
    }
}

/// The sky or the ground of a dome that is being gathered.
struct Side<'a> {
    what: &'a Gathering<'a>,
    terms: &'a Terms,
    above: bool,
}

impl Side<'_> {
    /// Altitude of the circle at `position`, the square root of the share of the way from the horizon.
    fn altitude(&self, position: f64) -> f64 {
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
    fn gather(&self, position: f64, azimuths: &[f64]) -> Vec<[f32; 3]> {
        let gathered = self.what.field.gather(&self.what.observer, self.altitude(position).sin(), azimuths);
        let mut row = Vec::with_capacity(azimuths.len() * self.terms.lanes.count());
        for a in 0..azimuths.len() {
            self.terms.push_fields(&gathered, a, &self.what.weights, &mut row);
        }
        row
    }

    /// The half with `circles` circles at even positions.
    fn even(&self, circles: usize, parts: &Parts) -> Result<Half> {
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

impl SkyLight for SkyDome {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        let (half, share) = match &self.below {
            _ if altitude >= self.horizon => (&self.above, (altitude - self.horizon) / (FRAC_PI_2 - self.horizon)),
            Some(below) => (below, (self.horizon - altitude) / (FRAC_PI_2 + self.horizon)),
            None => return out.fill([0.0; 3]),
        };
        let circle = Circle::new(half, share.clamp(0.0, 1.0).sqrt(), azimuths.len() > WHOLE_CIRCLE);
        for (azimuths, out) in azimuths.chunks(CHUNK).zip(out.chunks_mut(CHUNK)) {
            let places = Places { altitude, sun_altitude: self.sun_altitude, sun_azimuth: self.sun_azimuth, azimuths };
            shade(&circle, &places, out);
        }
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        self.discs.clone()
    }
}
