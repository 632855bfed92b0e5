//! Single scattering along a ray, and the ground lit by the Sun's direct light: exact but for the quadrature of the ray.
//!
//! The angle between a ray and parallel sunlight is the same all along the ray. So what a component scatters once is its phase function times
//! a strength: integral of T(view) sigma T(Sun) dt / 4 pi. Strengths are smooth in direction even where the phase function is sharp.

use super::air::Air;
use super::lanes::{Lanes, add_product, add_scaled, exp_one, splat};
use super::ray::{Ray, RayPoint};
use super::sunlight::Sunlight;
use super::suns::SunOnRay;
use std::f64::consts::PI;

/// Adds the strength of each scattering component along `ray` to `strengths`, (Sun, component), for many positions of the Sun; `stride` is the distance between Suns in `strengths`.
#[inline(always)]
pub fn add_strengths<const N: usize>(
    air: &Air<N>,
    sunlight: &Sunlight<N>,
    ray: &Ray<N>,
    suns: &[SunOnRay],
    stride: usize,
    strengths: &mut [Lanes<N>],
) {
    let mut scattered = vec![splat::<N>(0.0); air.scatterers().len()];
    for point in &ray.points {
        for (value, scatterer) in scattered.iter_mut().zip(air.scatterers()) {
            *value = scatterer.coefficient(point.place);
            for n in 0..N {
                value[n] *= point.weight[n] * (0.25 / PI) as f32;
            }
        }
        let here = sunlight.at(point.altitude);
        for (sun, strengths) in suns.iter().zip(strengths.chunks_exact_mut(stride)) {
            let Some(light) = here.over_disc(sun.zenith_cosine(point.distance, point.radius)) else { continue };
            for (strength, scattered) in strengths.iter_mut().zip(&scattered) {
                add_product(strength, &light, scattered);
            }
        }
    }
}

/// Parts of the light that a component scatters once.
pub const PARTS: usize = 3;

/// What a view ray has passed on its way to a point: its part in [`add_once`].
pub struct Passed<const N: usize> {
    /// Scattering optical depth by component, with the forward peak.
    depths: Vec<Lanes<N>>,
    /// Optical depth of scattering into forward peaks.
    forward: Lanes<N>,
}

impl<const N: usize> Passed<N> {
    /// At the start of a ray through `air`.
    pub fn nothing(air: &Air<N>) -> Self {
        Self { depths: vec![splat(0.0); air.scatterers().len()], forward: splat(0.0) }
    }

    /// Becomes what `other` is, which is of the same air.
    pub fn copy_from(&mut self, other: &Self) {
        self.depths.copy_from_slice(&other.depths);
        self.forward = other.forward;
    }
}

/// For one position of the Sun and each component adds three parts: the strength of scattering without the forward peak; the strength of all scattering in the light that comes straight
/// from the Sun (`direct`: its transmittance) and straight to the observer; and the latter times the path, the scattering optical depth, by the same component, that the light passes on
/// its way to the point and from there.
#[inline(always)]
pub fn add_strengths_and_paths<const N: usize>(
    air: &Air<N>,
    lights: (&Sunlight<N>, Option<&Sunlight<N>>),
    ray: &Ray<N>,
    sun: &SunOnRay,
    parts: &mut [Lanes<N>],
) {
    let mut passed = Passed::nothing(air);
    for point in &ray.points {
        add_once(air, lights, point, sun, &mut passed, parts);
    }
}

/// Adds what one point of a ray has of these parts, and the point to what was passed.
#[inline(always)]
pub fn add_once<const N: usize>(
    air: &Air<N>,
    (sunlight, direct): (&Sunlight<N>, Option<&Sunlight<N>>),
    point: &RayPoint<N>,
    sun: &SunOnRay,
    passed: &mut Passed<N>,
    parts: &mut [Lanes<N>],
) {
    let cosine = sun.zenith_cosine(point.distance, point.radius);
    let sunlit = sunlight.over_disc(point.altitude, cosine);
    let straight = direct.and_then(|direct| direct.over_disc(point.altitude, cosine));
    let mass = slant(cosine) as f32;
    let mut passing = splat::<N>(0.0);
    for ((scatterer, depth), part) in air.scatterers().iter().zip(&mut passed.depths).zip(parts.chunks_exact_mut(PARTS)) {
        let coefficient = scatterer.coefficient(point.place);
        if let Some(light) = &sunlit {
            for n in 0..N {
                part[0][n] += light[n] * point.weight[n] * coefficient[n] * (0.25 / PI) as f32;
            }
        }
        let mut whole = coefficient;
        for n in 0..N {
            whole[n] /= 1.0 - scatterer.forward[n];
        }
        if let Some(light) = &straight {
            let above = scatterer.above(point.place);
            for n in 0..N {
                let forward = passed.forward[n] + 0.5 * point.length * scatterer.forward[n] * whole[n];
                let strength = light[n] * point.weight[n] * exp_one(-forward) * whole[n] * (0.25 / PI) as f32;
                part[1][n] += strength;
                part[2][n] += strength * (depth[n] + 0.5 * whole[n] * point.length + mass * above[n]);
            }
        }
        add_scaled(depth, point.length, &whole);
        for n in 0..N {
            passing[n] += point.length * scatterer.forward[n] * whole[n];
        }
    }
    add_scaled(&mut passed.forward, 1.0, &passing);
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
