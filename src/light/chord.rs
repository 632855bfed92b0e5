//! Straight rays through spherical shells: where a ray crosses them, and the optical depth of what is linear in altitude between them.
//!
//! The depth is the integral from 0 to t of beta(z(t')) dt', with z(t) = h + (t^2 + 2 r mu t) / (r(t) + r), where
//! t = distance along the ray \[km\], h = altitude of its start \[km\], r = h + planet radius \[km\], mu = cosine of the angle
//! between the ray and the local vertical at its start, r(t) = sqrt(r^2 + 2 r mu t + t^2), beta = extinction \[km-1\].
//!
//! The ray is cut where it crosses an altitude of the profile and at its lowest point. Within such a piece beta is linear in z,
//! and z is all but a parabola in t, for which Simpson's rule is exact (relative error below 1e-6 on the Earth).

use crate::numerics::locate;
use std::ops::ControlFlow;

/// The start of a ray relative to the planet: all that its passage through the shells depends on.
#[derive(Clone, Copy, Debug)]
pub struct Chord {
    /// Altitude of the start [km].
    pub altitude: f64,
    /// Distance of the start from the planet's centre [km].
    pub radius: f64,
    /// Cosine of the angle between the ray and the local vertical at the start.
    pub cosine: f64,
}

impl Chord {
    /// Altitude at distance `t` [km] along the ray, without cancellation of the planet's radius.
    pub fn altitude_at(&self, t: f64) -> f64 {
        let difference = t * (t + 2.0 * self.radius * self.cosine);
        let radius = (self.radius * self.radius + difference).max(0.0).sqrt();
        self.altitude + difference / (radius + self.radius)
    }

    /// Distances [km] at which the line crosses `altitude`: the way in and the way out. `None` if it stays above.
    pub fn crossings(&self, altitude: f64) -> Option<(f64, f64)> {
        let half = self.radius * self.cosine;
        // r(altitude)^2 - radius^2; the two distances have the product -power and the sum -2 half.
        let power = (altitude - self.altitude) * (2.0 * self.radius + altitude - self.altitude);
        let discriminant = half * half + power;
        if discriminant < 0.0 {
            return None;
        }
        let larger = half.abs() + discriminant.sqrt();
        let smaller = if larger > 0.0 { power / larger } else { 0.0 };
        Some(if half > 0.0 { (-larger, smaller) } else { (-smaller, larger) })
    }
}

/// A piece of a ray within one layer: distances and altitudes [km] of its ends.
pub struct Piece {
    /// Index of the layer.
    pub layer: usize,
    pub from: f64,
    pub to: f64,
    pub altitude_from: f64,
    pub altitude_to: f64,
}

impl Piece {
    /// Mean altitude [km] from the start of the piece to distance `t` [km], where the altitude is `altitude_t`.
    pub fn mean_altitude(&self, chord: &Chord, t: f64, altitude_t: f64) -> f64 {
        let middle = chord.altitude_at(0.5 * (self.from + t));
        (self.altitude_from + 4.0 * middle + altitude_t) / 6.0
    }
}

/// Visits the pieces of the ray between `altitudes` [km] (ascending from the ground, the start among them) in order, up to the distance `limit` [km] or the end of the ray.
pub fn walk<B>(altitudes: &[f64], chord: &Chord, limit: f64, mut visit: impl FnMut(Piece) -> ControlFlow<B>) -> ControlFlow<B> {
    let (mut layer, fraction) = locate(altitudes, chord.altitude);
    let (mut t, mut altitude) = (0.0, chord.altitude);
    let mut step = |layer: usize, t: &mut f64, altitude: &mut f64, to: f64, altitude_to: f64| {
        let (to, altitude_to) = if to > limit { (limit, chord.altitude_at(limit)) } else { (to, altitude_to) };
        if to <= *t {
            return ControlFlow::Continue(());
        }
        let piece = Piece { layer, from: *t, to, altitude_from: *altitude, altitude_to };
        (*t, *altitude) = (to, altitude_to);
        visit(piece)
    };
    if chord.cosine < 0.0 {
        if fraction == 0.0 && layer > 0 {
            layer -= 1;
        }
        while let Some((way_in, _)) = chord.crossings(altitudes[layer]) {
            step(layer, &mut t, &mut altitude, way_in, altitudes[layer])?;
            if layer == 0 || t >= limit {
                return ControlFlow::Continue(());
            }
            layer -= 1;
        }
        let lowest = -chord.radius * chord.cosine;
        step(layer, &mut t, &mut altitude, lowest, chord.altitude_at(lowest))?;
    }
    while layer + 1 < altitudes.len() && t < limit {
        let bound = altitudes[layer + 1];
        let Some((_, way_out)) = chord.crossings(bound) else { break };
        step(layer, &mut t, &mut altitude, way_out, bound)?;
        layer += 1;
    }
    ControlFlow::Continue(())
}
