//! The whole dome of the sky and the ground below, gathered at some hundreds of directions and smooth between them.
//!
//! What is interpolated is not radiance but fields that are smooth even around the Sun: radiance = sum over the functions f of the scattering angle
//! ([`crate::light::AngularFunctions`]) of f F_f + rest, all as XYZ. The functions, sharp around the Sun, are applied in each direction exactly; through a polarising filter, so
//! is the polarisation of light scattered once.
//! Interpolation is cubic in the square root of the angular distance from the horizon, where light changes fastest, and in azimuth from the Sun, in which the fields are even (U odd).
//! The circles of equal altitude that are gathered are those of the quality, or as many as a tolerance needs (`refine`).

mod compact;
mod gathering;
mod half;
mod lanes;
mod refine;
mod shade;

use super::disc::Disc;
use super::sky_light::SkyLight;
use crate::error::Result;
use crate::progress::Progress;
pub(super) use gathering::Gathering;
use gathering::{Side, Terms};
use half::{Circle, Half};
use lanes::Lanes;
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
