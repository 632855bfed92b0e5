//! Optical depths of the first parts of a ray, exact in a profile that is linear between its altitudes: depths of neighbouring parts add up whatever steps light is marched in.

use super::air::Air;
use super::chord::{Chord, Piece, walk};
use std::ops::ControlFlow;

/// Optical depths from the start of a ray to a distance, by wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depths<const N: usize> {
    /// Of all extinction.
    pub extinction: [f64; N],
    /// Of scattering into forward peaks alone.
    pub forward: [f64; N],
}

impl<const N: usize> Depths<N> {
    const NONE: Self = Self { extinction: [0.0; N], forward: [0.0; N] };

    /// With the part of `piece` up to distance `t` on its ray.
    fn plus(mut self, air: &Air<N>, chord: &Chord, piece: &Piece, t: f64) -> Self {
        let [low, high] = [0, 1].map(|bound| air.altitudes()[piece.layer + bound]);
        let mean = piece.mean_altitude(chord, t, chord.altitude_at(t));
        let place = (piece.layer, ((mean - low) / (high - low)).clamp(0.0, 1.0) as f32);
        let (rest, forward) = (air.extinction(place), air.forward_scattering(place));
        let length = t - piece.from;
        for n in 0..N {
            self.extinction[n] += length * (f64::from(rest[n]) + f64::from(forward[n]));
            self.forward[n] += length * f64::from(forward[n]);
        }
        self
    }
}

/// Depths at ascending `distances` [km] from `altitude` [km] along the ray of zenith cosine `mu`; beyond the end of the ray those of its end.
pub fn depths<const N: usize>(air: &Air<N>, altitude: f64, mu: f64, distances: &[f64]) -> Vec<Depths<N>> {
    let mut found = Vec::with_capacity(distances.len());
    let mut sum = Depths::NONE;
    let seen = Chord { altitude, radius: air.radius + altitude, cosine: mu };
    let entered = if altitude > air.top {
        seen.crossings(air.top).filter(|_| mu < 0.0).map(|(way_in, _)| {
            let radius = air.radius + air.top;
            (way_in, Chord { altitude: air.top, radius, cosine: (seen.radius * mu + way_in) / radius })
        })
    } else {
        Some((0.0, seen))
    };
    if let (Some((way_in, chord)), Some(&last)) = (entered, distances.last()) {
        let _ = walk(air.altitudes(), &chord, last - way_in, |piece| {
            for distance in &distances[found.len()..] {
                let t = distance - way_in;
                if t > piece.to {
                    break;
                }
                found.push(if t > piece.from { sum.plus(air, &chord, &piece, t) } else { sum });
            }
            sum = sum.plus(air, &chord, &piece, piece.to);
            ControlFlow::<()>::Continue(())
        });
    }
    found.resize(distances.len(), sum);
    found
}
