//! Single scattering along a ray, and the ground lit by the Sun's direct light: exact but for the quadrature of the ray.
//!
//! The angle between a ray and parallel sunlight is the same all along the ray. So what a component scatters once is its phase function times
//! a strength: integral of T(view) sigma T(Sun) dt / 4 pi. Strengths are smooth in direction even where the phase function is sharp.

use super::air::Air;
use super::lanes::{Lanes, add_product, add_scaled, splat};
use super::ray::Ray;
use super::sunlight::Sunlight;
use super::suns::SunOnRay;
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

/// The same, and after each strength the path: the mean over what is scattered of the scattering optical depth, by the same component, that the light passes on its
/// way to the point and from there, times the strength.
#[inline(always)]
pub fn add_strengths_and_paths<const N: usize>(
    air: &Air<N>,
    sunlight: &Sunlight<N>,
    ray: &Ray<N>,
    sun: &SunOnRay,
    parts: &mut [Lanes<N>],
) {
    let mut passed = vec![splat::<N>(0.0); air.scatterers().len()];
    for point in &ray.points {
        let cosine = sun.zenith_cosine(point.distance, point.radius);
        let sunlit = sunlight.over_disc(point.altitude, cosine);
        let mass = slant(cosine) as f32;
        for ((scatterer, passed), part) in air.scatterers().iter().zip(&mut passed).zip(parts.chunks_exact_mut(2)) {
            let coefficient = scatterer.coefficient(point.place);
            if let Some(light) = &sunlit {
                let above = scatterer.above(point.place);
                for n in 0..N {
                    let strength = light[n] * point.weight[n] * coefficient[n] * (0.25 / PI) as f32;
                    part[0][n] += strength;
                    part[1][n] += strength * (passed[n] + 0.5 * coefficient[n] * point.length + mass * above[n]);
                }
            }
            add_scaled(passed, point.length, &coefficient);
        }
    }
}

/// Length of an oblique path through a low layer relative to the vertical one, for the cosine of its zenith angle (Rozenberg 1966, Twilight, p. 160).
fn slant(cosine: f64) -> f64 {
    let cosine = cosine.max(0.0);
    1.0 / (cosine + 0.025 * (-11.0 * cosine).exp())
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
