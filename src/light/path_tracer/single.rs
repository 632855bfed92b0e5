//! Light scattered once, by quadrature: along the ray three Gauss points in every piece between the bends of the profile, and over
//! the part of the Sun's disc that each point sees.

use super::air::Air;
use super::medium::{Medium, chord};
use super::scene::Scene;
use super::stokes::{Stokes, basis};
use crate::numerics::GaussLegendre;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Longest step [km].
const STEP_KM: f64 = 2.5;

/// The Stokes vector [sr-1] of light scattered exactly once by the air and never by the ground.
pub(super) fn single_scattering(air: &Air, scene: &Scene) -> Stokes {
    let (shells, into) = (&air.shells, basis(scene.view));
    let chord = chord(shells.planet_radius, scene.start, scene.view);
    let (_, end) = scene.end(shells.end(&chord));
    let mut cuts: Vec<f64> = shells.altitudes().iter().filter_map(|&z| chord.crossings(z)).flat_map(|(a, b)| [a, b]).collect();
    cuts.extend([0.0, -chord.radius * chord.cosine, end]);
    cuts.extend((1..).map(|i| f64::from(i) * STEP_KM).take_while(|&t| t < end).take(100_000));
    cuts.retain(|t| (0.0..=end).contains(t));
    cuts.sort_by(f64::total_cmp);
    let [line, rows, columns] = [3, 8, 3].map(GaussLegendre::new);
    let source = |t: f64| {
        let point = scene.start + scene.view * t;
        let place = shells.locate(chord.altitude_at(t));
        let radius = point.length();
        let mut sum = [0.0; 3];
        scene.sun.integrate(point / radius, radius, shells.planet_radius, (&rows, &columns), |sun, weight| {
            let light = weight * air.exact_sunlight(point, sun);
            let scattered = air.scattered_natural_light(place, scene.view, &into, sun);
            (0..3).for_each(|i| sum[i] += light * scattered[i]);
        });
        if sum[0] > 0.0 { sum.map(|x| x * (-shells.optical_depth(&chord, t)).exp()) } else { sum }
    };
    let pieces: Vec<Stokes> = cuts
        .par_windows(2)
        .map(|cut| {
            let points = line.on(cut[0], cut[1]).map(|(t, weight)| source(t).map(|x| weight * x));
            points.fold([0.0; 3], plus)
        })
        .collect();
    pieces.into_iter().fold([0.0; 3], plus).map(|x| x / (4.0 * PI))
}

fn plus(a: Stokes, b: Stokes) -> Stokes {
    std::array::from_fn(|i| a[i] + b[i])
}
