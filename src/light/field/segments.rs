//! The light of parts of a ray: what the air between the observer and a distance scatters to the observer, and how much of the light from behind it comes through.
//!
//! With a surface of radiance L_s at distance s, L = L_s T(s) + L_in(0..s): T and L_in are what is found here, the surface is the caller's, and the ground is one. Two parts
//! make a whole, L_in(0..b) = L_in(0..a) + T(a) L_in(a..b), but near the Sun: light scattered into a forward peak counts as transmitted in T, and the air before a point blurs the
//! aureole of the air behind it, which no factor says.

use super::super::angular::Once;
use super::super::contracted::Contracted;
use super::super::cut::cuts;
use super::super::grid::Grid;
use super::super::lanes::{LANES, Lanes, processor_fuses, splat};
use super::super::ray::{Ray, RayPoint};
use super::super::single::{PARTS, Passed, add_once};
use super::super::solve::Block;
use super::super::suns::{SunOnRay, Suns};
use super::{LightField, Observer};
use multiversion::multiversion;

/// In-scattered light and transmittance along rays of equal zenith angle and several azimuths, up to several distances. Used for one ray after the other it keeps its memory.
#[derive(Clone, Default)]
pub struct Segments {
    distances: usize,
    wavelengths: usize,
    /// Shape (azimuths, distances, wavelengths).
    radiance: Vec<f64>,
    /// Shape (distances, wavelengths).
    transmittance: Vec<f64>,
    /// Work space, shape (blocks, azimuths, distances, parts): the parts of light scattered once, as [`super::Gathered`] has them, then all other light.
    parts: Vec<Lanes<LANES>>,
    /// Work space: transmittance, shape (blocks, distances).
    passing: Vec<Lanes<LANES>>,
    /// Work space: functions of the angle to the Sun and their weights.
    values: Vec<[f32; 1]>,
    weights: Vec<f64>,
}

impl Segments {
    /// Radiance per unit solar irradiance that the air up to distance index `distance` scatters to the observer at azimuth index `azimuth`, by wavelength [sr-1].
    pub fn radiance(&self, azimuth: usize, distance: usize) -> &[f64] {
        let start = (azimuth * self.distances + distance) * self.wavelengths;
        &self.radiance[start..start + self.wavelengths]
    }

    /// Transmittance to distance index `distance`, by wavelength, forward peaks counted as transmitted.
    pub fn transmittance(&self, distance: usize) -> &[f64] {
        &self.transmittance[distance * self.wavelengths..(distance + 1) * self.wavelengths]
    }
}

impl LightField {
    /// Finds the light along the rays that `observer` sees at zenith cosine `mu` and `azimuths` from the Sun [radians], up to ascending `distances_km` (0 to infinity), into `out`.
    ///
    /// A ray ends on the ground or in space: distances beyond find what its end has, and with the light of the ground times the transmittance that is what [`Self::gather`] finds. Where less than 1e-6 comes
    /// through at all wavelengths of a block, a ray is not followed further.
    pub fn segments(&self, observer: &Observer, mu: f64, azimuths: &[f64], distances_km: &[f64], out: &mut Segments) {
        debug_assert!(distances_km.is_sorted() && distances_km.iter().all(|&distance| distance >= 0.0));
        let stride = PARTS * self.functions.len() + 1;
        (out.distances, out.wavelengths) = (distances_km.len(), self.wavelengths);
        let per_block = azimuths.len() * out.distances * stride;
        out.parts.clear();
        out.parts.resize(self.blocks.len() * per_block, splat(0.0));
        out.passing.clear();
        out.passing.resize(self.blocks.len() * out.distances, splat(0.0));
        for (b, block) in self.blocks.iter().enumerate() {
            let (ray, fine) = self.rays(block, observer, mu);
            let parts = &mut out.parts[b * per_block..(b + 1) * per_block];
            let passing = &mut out.passing[b * distances_km.len()..(b + 1) * distances_km.len()];
            let rays = [&ray, fine.as_ref().unwrap_or(&ray)];
            march_block(&self.grid, block, rays, observer.sun_zenith, (azimuths, distances_km), parts, passing);
        }
        self.radiance_of_parts(observer, mu, azimuths, out);
        let passing = &out.passing;
        out.transmittance.clear();
        let distances = 0..out.distances;
        out.transmittance.extend(distances.flat_map(|distance| {
            (0..self.wavelengths).map(move |w| f64::from(passing[w / LANES * distances_km.len() + distance][w % LANES]))
        }));
    }

    /// Applies the phase functions to the parts.
    fn radiance_of_parts(&self, observer: &Observer, mu: f64, azimuths: &[f64], out: &mut Segments) {
        let stride = PARTS * self.functions.len() + 1;
        out.radiance.clear();
        out.radiance.resize(azimuths.len() * out.distances * self.wavelengths, 0.0);
        for (a, azimuth) in azimuths.iter().enumerate() {
            let sun = observer.sun_zenith.sin_cos();
            let on_ray = SunOnRay::new(1.0, mu, (azimuth.cos(), azimuth.sin()), sun);
            let haversine = (0.5 * (1.0 - on_ray.scattering_cosine)) as f32;
            for (c, functions) in self.functions.iter().enumerate() {
                out.values.resize(functions.len(), [0.0]);
                out.weights.resize(functions.len(), 0.0);
                functions.values(&[haversine], &mut out.values);
                for d in 0..out.distances {
                    for w in 0..self.wavelengths {
                        let start = ((w / LANES * azimuths.len() + a) * out.distances + d) * stride + PARTS * c;
                        let [strength, direct_strength, path] =
                            std::array::from_fn(|part| f64::from(out.parts[start + part][w % LANES]));
                        functions.weights(w, &Once { strength, direct_strength, path }, &mut out.weights);
                        let once: f64 = out.values.iter().zip(&out.weights).map(|(v, weight)| f64::from(v[0]) * weight).sum();
                        out.radiance[(a * out.distances + d) * self.wavelengths + w] += once;
                    }
                }
            }
            for d in 0..out.distances {
                for w in 0..self.wavelengths {
                    let rest = out.parts[((w / LANES * azimuths.len() + a) * out.distances + d) * stride + stride - 1][w % LANES];
                    out.radiance[(a * out.distances + d) * self.wavelengths + w] += f64::from(rest);
                }
            }
        }
    }
}

/// Marches the rays of one block: the parts of the light up to each distance, shape (azimuths, distances, parts), and the transmittances.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn march_block(
    grid: &Grid,
    block: &Block,
    [ray, once]: [&Ray<LANES>; 2],
    sun_zenith: f64,
    (azimuths, distances): (&[f64], &[f64]),
    parts: &mut [Lanes<LANES>],
    passing: &mut [Lanes<LANES>],
) {
    let (air, field) = (&block.air, &block.field);
    let scattered_once = PARTS * air.scatterers().len();
    let stride = scattered_once + 1;
    let sun = sun_zenith.sin_cos();
    let r0 = air.radius + ray.start_altitude;
    let on_rays: Vec<SunOnRay> = azimuths.iter().map(|a| SunOnRay::new(r0, ray.zenith_cosine, (a.cos(), a.sin()), sun)).collect();
    let ray_cuts = cuts(air, ray, distances);

    let lights = (&block.sunlight, block.direct.as_ref());
    let once_cuts = if std::ptr::eq(ray, once) { None } else { Some(cuts(air, once, distances)) };
    let once_cuts = once_cuts.as_ref().unwrap_or(&ray_cuts);
    let mut sums = vec![splat::<LANES>(0.0); scattered_once];
    let mut passed_here = Passed::nothing(air);
    for (on_ray, parts) in on_rays.iter().zip(parts.chunks_exact_mut(stride * distances.len().max(1))) {
        let mut passed = Passed::nothing(air);
        sums.fill(splat(0.0));
        let mut done = 0;
        for (cut, here) in once_cuts.iter().zip(parts.chunks_exact_mut(stride)) {
            for point in &once.points[done..cut.whole] {
                add_once(air, lights, point, on_ray, &mut passed, &mut sums);
            }
            done = cut.whole;
            here[..scattered_once].copy_from_slice(&sums);
            passed_here.copy_from(&passed);
            for point in cut.rest.iter().flatten() {
                add_once(air, lights, point, on_ray, &mut passed_here, &mut here[..scattered_once]);
            }
            for component in here[..scattered_once].chunks_exact_mut(PARTS) {
                for n in 0..LANES {
                    component[2][n] = if component[1][n] > 0.0 { component[2][n] / component[1][n] } else { 0.0 };
                }
            }
        }
    }

    let stokes = if field.shape.polarised { 3 } else { 1 };
    let mut suns = Suns::new(&on_rays);
    let mut contracted = Contracted::<LANES, { processor_fuses!() }>::new(grid, field.shape);
    let mut add = |point: &RayPoint<LANES>, sums: &mut [Lanes<LANES>]| {
        suns.place(grid, r0, point.distance, point.radius);
        contracted.fill(grid, field, air, point, suns.range(grid));
        contracted.add(grid, &suns, sums);
    };
    let mut scattered = vec![splat(0.0); azimuths.len() * stokes];
    let mut scattered_here = scattered.clone();
    let mut done = 0;
    for (d, cut) in ray_cuts.iter().enumerate() {
        for point in &ray.points[done..cut.whole] {
            add(point, &mut scattered);
        }
        done = cut.whole;
        scattered_here.copy_from_slice(&scattered);
        for point in cut.rest.iter().flatten() {
            add(point, &mut scattered_here);
        }
        for (a, sums) in scattered_here.chunks_exact(stokes).enumerate() {
            parts[(a * distances.len() + d) * stride + scattered_once] = sums[0];
        }
        passing[d] = cut.transmittance;
    }
}

#[cfg(test)]
mod tests;
