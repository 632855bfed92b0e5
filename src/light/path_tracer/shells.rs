//! Optical depth along a straight ray through spherical shells whose coefficients are linear in altitude ([`crate::light::chord`]).

use super::super::chord::{Chord, Piece, walk};
use crate::numerics::locate;
use std::ops::ControlFlow;

/// How a ray ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    /// On the ground.
    Ground,
    /// Outside the atmosphere.
    Space,
}

/// Extinction against altitude around a spherical planet.
pub(super) struct Shells {
    pub planet_radius: f64,
    altitudes: Vec<f64>,
    extinction: Vec<f64>,
}

impl Shells {
    /// `altitudes` [km] ascending from 0, `extinction` [km-1] at each.
    pub fn new(planet_radius: f64, altitudes: Vec<f64>, extinction: Vec<f64>) -> Self {
        Self { planet_radius, altitudes, extinction }
    }

    /// Altitude above which there is no air [km].
    pub fn top(&self) -> f64 {
        self.altitudes[self.altitudes.len() - 1]
    }

    /// Altitudes at which coefficients bend [km].
    pub fn altitudes(&self) -> &[f64] {
        &self.altitudes
    }

    /// The layer that holds `altitude`, and the fraction of the way from its lower to its upper bound.
    pub fn locate(&self, altitude: f64) -> (usize, f64) {
        locate(&self.altitudes, altitude)
    }

    /// Where the ray ends, and at which distance [km]; the start is within the atmosphere.
    pub fn end(&self, chord: &Chord) -> (End, f64) {
        if chord.cosine < 0.0
            && let Some((way_in, _)) = chord.crossings(0.0)
        {
            return (End::Ground, way_in.max(0.0));
        }
        (End::Space, chord.crossings(self.top()).map_or(0.0, |(_, way_out)| way_out.max(0.0)))
    }

    /// Optical depth from the start of the ray to `distance` [km].
    pub fn optical_depth(&self, chord: &Chord, distance: f64) -> f64 {
        let mut sum = 0.0;
        let _ = walk(&self.altitudes, chord, distance, |piece| {
            sum += self.piece_depth(chord, &piece, piece.to, piece.altitude_to);
            ControlFlow::<()>::Continue(())
        });
        sum
    }

    /// Distance [km] at which the optical depth from the start of the ray is `depth`; `None` if it is not reached before `limit`
    /// [km].
    pub fn distance_at(&self, chord: &Chord, depth: f64, limit: f64) -> Option<f64> {
        let mut left = depth;
        let found = walk(&self.altitudes, chord, limit, |piece| {
            let here = self.piece_depth(chord, &piece, piece.to, piece.altitude_to);
            if here < left {
                left -= here;
                return ControlFlow::Continue(());
            }
            ControlFlow::Break(self.solve_piece(chord, &piece, left, here))
        });
        found.break_value()
    }

    /// Distance within `piece` at which its own optical depth is `depth` <= `whole`: Newton's method kept inside a bracket.
    fn solve_piece(&self, chord: &Chord, piece: &Piece, depth: f64, whole: f64) -> f64 {
        let (mut low, mut high) = (piece.from, piece.to);
        let mut t = low + (high - low) * if whole > 0.0 { depth / whole } else { 0.0 };
        for _ in 0..60 {
            let altitude = chord.altitude_at(t);
            let error = self.piece_depth(chord, piece, t, altitude) - depth;
            if error.abs() <= 1e-12 * whole {
                break;
            }
            if error > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let step = t - error / self.extinction_in(piece.layer, altitude);
            t = if step > low && step < high { step } else { 0.5 * (low + high) };
        }
        t
    }

    fn extinction_in(&self, layer: usize, altitude: f64) -> f64 {
        let (low, high) = (self.altitudes[layer], self.altitudes[layer + 1]);
        let (a, b) = (self.extinction[layer], self.extinction[layer + 1]);
        (a + (b - a) * (altitude - low) / (high - low)).max(0.0)
    }

    /// Optical depth from the start of `piece` to distance `t`, where the altitude is `altitude_t`.
    fn piece_depth(&self, chord: &Chord, piece: &Piece, t: f64, altitude_t: f64) -> f64 {
        (t - piece.from) * self.extinction_in(piece.layer, piece.mean_altitude(chord, t, altitude_t))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exponential(planet_radius: f64) -> Shells {
        let altitudes: Vec<f64> = (0..=200).map(|i| 0.5 * i as f64).collect();
        let extinction = altitudes.iter().map(|z| 0.03 * (-z / 8.0).exp()).collect();
        Shells::new(planet_radius, altitudes, extinction)
    }

    fn chord(shells: &Shells, altitude: f64, cosine: f64) -> Chord {
        Chord { altitude, radius: shells.planet_radius + altitude, cosine }
    }

    /// Midpoint rule in many small steps, that knows nothing of layers.
    fn brute_force(shells: &Shells, chord: &Chord, distance: f64) -> f64 {
        let n = 400_000;
        let dt = distance / n as f64;
        (0..n)
            .map(|i| {
                let t = (i as f64 + 0.5) * dt;
                let r = (chord.radius.powi(2) + 2.0 * chord.radius * chord.cosine * t + t * t).sqrt();
                let (layer, fraction) = shells.locate(r - shells.planet_radius);
                (shells.extinction[layer] * (1.0 - fraction) + shells.extinction[layer + 1] * fraction) * dt
            })
            .sum()
    }

    #[test]
    fn every_kind_of_ray_agrees_with_small_steps() {
        let shells = exponential(6371.0);
        for (altitude, cosine) in
            [(0.0, 1.0), (0.0, 0.0), (0.0, 0.02), (10.2, -0.02), (10.0, -0.04), (60.0, -0.1), (60.0, -0.9), (99.9, 0.3)]
        {
            let chord = chord(&shells, altitude, cosine);
            let (_, distance) = shells.end(&chord);
            let (found, expected) = (shells.optical_depth(&chord, distance), brute_force(&shells, &chord, distance));
            assert!((found / expected - 1.0).abs() < 2e-6, "{altitude} {cosine}: {found} {expected}");
        }
    }

    #[test]
    fn the_vertical_depth_is_the_trapezoid_sum_and_the_flat_planet_divides_it_by_the_cosine() {
        let shells = exponential(6.371e6);
        let sum: f64 = shells.extinction.windows(2).map(|pair| 0.25 * (pair[0] + pair[1])).sum();
        let vertical = chord(&shells, 0.0, 1.0);
        assert!((shells.optical_depth(&vertical, shells.end(&vertical).1) / sum - 1.0).abs() < 1e-12);
        let slant = chord(&shells, 0.0, 0.25);
        assert!((shells.optical_depth(&slant, shells.end(&slant).1) * 0.25 / sum - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_uniform_shell_has_the_chord_times_the_extinction() {
        let shells = Shells::new(6371.0, vec![0.0, 20.0, 100.0], vec![0.01; 3]);
        let chord = chord(&shells, 50.0, -0.05);
        let (end, distance) = shells.end(&chord);
        assert_eq!(end, End::Space);
        let half = chord.radius * chord.cosine;
        let expected = -half + (half * half + 6471.0_f64.powi(2) - chord.radius.powi(2)).sqrt();
        assert!((distance / expected - 1.0).abs() < 1e-9);
        assert!((shells.optical_depth(&chord, distance) / (0.01 * expected) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_distance_undoes_the_depth() {
        let shells = exponential(6371.0);
        for (altitude, cosine) in [(0.0, 0.7), (3.3, -0.01), (40.0, -0.105), (25.0, -0.6), (80.0, 0.0)] {
            let chord = chord(&shells, altitude, cosine);
            let (_, distance) = shells.end(&chord);
            let whole = shells.optical_depth(&chord, distance);
            for fraction in [0.001, 0.2, 0.5, 0.77, 0.999] {
                let t = shells.distance_at(&chord, fraction * whole, distance).unwrap();
                assert!((shells.optical_depth(&chord, t) / (fraction * whole) - 1.0).abs() < 1e-8);
            }
            assert_eq!(shells.distance_at(&chord, 1.001 * whole, distance), None);
        }
    }

    #[test]
    fn a_ray_ends_on_the_ground_below_the_geometric_horizon_only() {
        let shells = exponential(6371.0);
        let horizon = -(1.0 - (6371.0_f64 / 6381.0).powi(2)).sqrt();
        assert_eq!(shells.end(&chord(&shells, 10.0, horizon - 1e-9)).0, End::Ground);
        assert_eq!(shells.end(&chord(&shells, 10.0, horizon + 1e-9)).0, End::Space);
        assert_eq!(shells.end(&chord(&shells, 0.0, -1e-12)), (End::Ground, 0.0));
        assert_eq!(shells.end(&chord(&shells, 0.0, 1e-12)).0, End::Space);
        let (end, distance) = shells.end(&chord(&shells, 10.0, -1.0));
        assert_eq!(end, End::Ground);
        assert!((distance - 10.0).abs() < 1e-12);
    }
}
