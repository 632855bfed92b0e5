//! Single scattering along a ray, and the ground lit by the Sun's direct light: exact but for the quadrature of the ray.
//!
//! The angle between a ray and parallel sunlight is the same all along the ray. So what a component scatters once is its phase function times
//! a strength: integral of T(view) sigma T(Sun) dt / 4 pi. Strengths are smooth in direction even where the phase function is sharp.

use super::air::Air;
use super::lanes::{Lanes, add_product, splat};
use super::ray::Ray;
use super::source::SunOnRay;
use super::sunlight::Sunlight;
use std::f64::consts::PI;

/// Adds the strength of each scattering component along `ray` to `strengths`.
#[inline(always)]
pub fn add_strengths<const N: usize>(
    air: &Air<N>,
    sunlight: &Sunlight<N>,
    ray: &Ray<N>,
    sun: &SunOnRay,
    strengths: &mut [Lanes<N>],
) {
    for point in &ray.points {
        let Some(sunlit) = sunlight.over_disc(point.altitude, sun.zenith_cosine(point.distance, point.radius)) else {
            continue;
        };
        let mut light = sunlit;
        for n in 0..N {
            light[n] *= point.weight[n] * (0.25 / PI) as f32;
        }
        for (strength, scatterer) in strengths.iter_mut().zip(air.scatterers()) {
            add_product(strength, &light, &scatterer.coefficient(point.place));
        }
    }
}

/// Irradiance of the ground by direct sunlight, per unit solar irradiance, for the cosine of the solar zenith angle there.
#[inline(always)]
pub fn direct_ground_irradiance<const N: usize>(air: &Air<N>, sunlight: &Sunlight<N>, zenith_cosine: f64) -> Lanes<N> {
    // The part of a rising disc that is above the horizon is higher than the disc's centre.
    let cosine = if zenith_cosine >= air.sun_radius { zenith_cosine } else { 0.5 * (zenith_cosine + air.sun_radius).max(0.0) };
    match sunlight.over_disc(0.0, zenith_cosine) {
        Some(light) => light.map(|l| l * cosine as f32),
        None => splat(0.0),
    }
}
