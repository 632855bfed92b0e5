//! The light of parts of a ray: what the air between the observer and a distance scatters to the observer, and how much of the light from behind it comes through.
//!
//! With a surface of radiance L_s at distance s, L = L_s T(s) + L_in(0..s): T and L_in are what is found here, the surface is the caller's, and the ground is one.
//!
//! The field takes light that is scattered into a forward peak for transmitted, so that the march along a ray finds an L*_in and a T* in air of less extinction, and T = q T* with
//! q(s) = exp(-depth of forward scattering from 0 to s). What the peaks turn into the ray between t and t + dt has the radiance that is seen from t on, (L_0 - L*_in(0..t)) / T*(t), where L_0 is all
//! light of the ray. Its integral, attenuated by T, is closed by parts:
//! ```text
//! L_in(0..s) = (1 - q) L_0 + q L*_in(0..s)
//! ```
//! so that L_in + T (L_0 - L*_in) / T* = L_0 at every distance. Light that came straight from the Sun into a peak (the aureole) is known as it is, with T and not T*, and is added by itself: it is no part of
//! L_0 and L*_in above. Of several turns in a row it has the share that its place in the row gives, so that near the Sun in haze parts of rays make a whole less exactly than elsewhere.
//!
//! T is exact in a linear profile ([`super::super::depths`]). Rays are marched in finer steps than for pictures, whose quality allows for errors that average out along a whole ray but not in its parts. At the end of
//! the ray the light is nevertheless that of pictures: what they have more, less than their own error, comes in the last tenth of the ray, most of which lies above the air that scatters.

use super::super::angular::{AngularFunctions, Once};
use super::super::chord::Chord;
use super::super::contracted::Contracted;
use super::super::cut::cuts;
use super::super::depths::{Depths, depths};
use super::super::grid::{FINER, Grid};
use super::super::lanes::{LANES, Lanes, processor_fuses, splat};
use super::super::ray::{Ray, RayPoint, StepLimits};
use super::super::single::{PARTS, Passed, add_once};
use super::super::solve::Block;
use super::super::suns::{SunOnRay, Suns};
use super::{LightField, Observer};
use multiversion::multiversion;
use std::f64::consts::PI;

/// In-scattered light and transmittance along rays of equal zenith angle and several azimuths, up to several distances. Used for one ray after the other it keeps its memory.
#[derive(Clone, Default)]
pub struct Segments {
    distances: usize,
    wavelengths: usize,
    /// Shape (azimuths, distances, wavelengths).
    radiance: Vec<f64>,
    /// Shape (distances, wavelengths).
    transmittance: Vec<f64>,
    work: Work,
}

/// What is found in blocks of wavelengths. The last of the distances is the end of the ray.
#[derive(Clone, Default)]
struct Work {
    distances: Vec<f64>,
    /// Shape (blocks, azimuths, distances, parts): the parts of light scattered once, as [`super::Gathered`] has them, then all other light.
    parts: Vec<Lanes<LANES>>,
    /// Radiance of the ground at the end, shape (blocks, azimuths).
    ground: Vec<Lanes<LANES>>,
    /// Shape (blocks, distances).
    passing: Vec<Passing>,
    /// Functions of the angle to the Sun.
    values: Vec<[f32; 1]>,
    weights: Vec<f64>,
}

/// What comes through to a distance.
#[derive(Clone, Copy)]
struct Passing {
    /// Transmittance of the march, forward peaks counted as transmitted.
    marched: Lanes<LANES>,
    depths: Depths<LANES>,
}

/// Where [`march_block`] writes, of one block.
struct Marched<'a> {
    parts: &'a mut [Lanes<LANES>],
    ground: &'a mut [Lanes<LANES>],
    passing: &'a mut Vec<Passing>,
}

impl Segments {
    /// Radiance per unit solar irradiance that the air up to distance index `distance` scatters to the observer at azimuth index `azimuth`, by wavelength [sr-1].
    pub fn radiance(&self, azimuth: usize, distance: usize) -> &[f64] {
        let start = (azimuth * self.distances + distance) * self.wavelengths;
        &self.radiance[start..start + self.wavelengths]
    }

    /// Transmittance to distance index `distance`, by wavelength.
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
        (out.distances, out.wavelengths) = (distances_km.len(), self.wavelengths);
        let work = &mut out.work;
        work.distances.clear();
        work.distances.extend(distances_km.iter().chain([&f64::INFINITY]));
        let per_block = azimuths.len() * work.distances.len() * (PARTS * self.functions.len() + 1);
        work.parts.clear();
        work.parts.resize(self.blocks.len() * per_block, splat(0.0));
        work.ground.clear();
        work.ground.resize(self.blocks.len() * azimuths.len(), splat(0.0));
        work.passing.clear();
        let limits = StepLimits { length_km: self.limits.length_km / FINER as f64, ..self.limits };
        for (b, block) in self.blocks.iter().enumerate() {
            let ray = Ray::trace(&block.air, block.air.levels(), observer.altitude_km, mu, limits);
            let marched = Marched {
                parts: &mut work.parts[b * per_block..(b + 1) * per_block],
                ground: &mut work.ground[b * azimuths.len()..(b + 1) * azimuths.len()],
                passing: &mut work.passing,
            };
            march_block(&self.grid, block, &ray, observer.sun_zenith, (azimuths, &work.distances), marched);
        }
        out.transmittance.clear();
        let of =
            |d: usize, w: usize| (-work.passing[w / LANES * (distances_km.len() + 1) + d].depths.extinction[w % LANES]).exp();
        out.transmittance.extend((0..out.distances).flat_map(|d| (0..self.wavelengths).map(move |w| of(d, w))));
        self.radiance_of_parts(observer, mu, azimuths, out);
    }

    /// Applies the phase functions to the parts, and gives the light in forward peaks back.
    fn radiance_of_parts(&self, observer: &Observer, mu: f64, azimuths: &[f64], out: &mut Segments) {
        let Segments { radiance, work, .. } = out;
        let gathered = self.gather(observer, mu, azimuths);
        let air = &self.blocks[0].air;
        let chord = Chord { altitude: observer.altitude_km, radius: air.radius + observer.altitude_km, cosine: mu };
        let ground_km = if mu < 0.0 { chord.crossings(0.0).map(|(way_in, _)| way_in.max(0.0)) } else { None };
        let length_km = ground_km.or(chord.crossings(air.top).map(|(_, way_out)| way_out)).unwrap_or(0.0);
        let marked = work.distances.len();
        let stride = PARTS * self.functions.len() + 1;
        radiance.clear();
        radiance.resize(azimuths.len() * out.distances * self.wavelengths, 0.0);
        let most = self.functions.iter().map(AngularFunctions::len).max().unwrap_or(0);
        work.weights.resize(most, 0.0);
        work.values.resize(self.functions.len() * most, [0.0]);
        for (a, azimuth) in azimuths.iter().enumerate() {
            let on_ray = SunOnRay::new(1.0, mu, (azimuth.cos(), azimuth.sin()), observer.sun_zenith.sin_cos());
            let haversine = (0.5 * (1.0 - on_ray.scattering_cosine)) as f32;
            for (functions, values) in self.functions.iter().zip(work.values.chunks_exact_mut(most)) {
                functions.values(&[haversine], values);
            }
            for w in 0..self.wavelengths {
                let (block, lane) = (w / LANES, w % LANES);
                // Light in forward peaks that came straight from the Sun, and the rest.
                let mut light = |d: usize| -> [f64; 2] {
                    let start = ((block * azimuths.len() + a) * marked + d) * stride;
                    let part = |index: usize| f64::from(work.parts[start + index][lane]);
                    let mut sums = [0.0, part(stride - 1)];
                    for (c, (functions, values)) in self.functions.iter().zip(work.values.chunks_exact(most)).enumerate() {
                        let [strength, direct_strength, path] = std::array::from_fn(|index| part(PARTS * c + index));
                        let weights = &mut work.weights[..functions.len()];
                        functions.weights(w, &Once { strength, direct_strength, path }, weights);
                        let peak = functions.peak_len();
                        let sum = |range: std::ops::Range<usize>| -> f64 {
                            values[range.clone()].iter().zip(&weights[range]).map(|(v, weight)| f64::from(v[0]) * weight).sum()
                        };
                        sums[0] += sum(0..peak);
                        sums[1] += sum(peak..weights.len());
                    }
                    sums
                };
                let ground = f64::from(work.ground[block * azimuths.len() + a][lane]);
                let passing = &work.passing[block * marked..(block + 1) * marked];
                let last = &passing[marked - 1];
                let [whole_aureole, whole] = light(marked - 1);
                let all = whole + ground * f64::from(last.marched[lane]);
                let up_to = |passing: &Passing, [aureole, marched]: [f64; 2]| {
                    let forward = passing.depths.forward[lane];
                    aureole - (-forward).exp_m1() * all + (-forward).exp() * marched
                };
                let gathered = self.radiance(&gathered, a, w, on_ray.scattering_cosine);
                let end = gathered - ground * (-last.depths.extinction[lane]).exp();
                let missing = end - up_to(last, [whole_aureole, whole]);
                for d in 0..out.distances {
                    let here = up_to(&passing[d], light(d)) + missing * end_of(work.distances[d] / length_km);
                    radiance[(a * out.distances + d) * self.wavelengths + w] = here.max(0.0);
                }
            }
        }
    }
}

/// Share of what the gathered light of the whole ray has more than the finer march by the part `x` of the ray: all at the end, nothing before its last tenth.
fn end_of(x: f64) -> f64 {
    let t = (10.0 * x - 9.0).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Marches the rays of one block: the parts of the light up to each distance, shape (azimuths, distances, parts), the light of the ground, and what comes through.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn march_block(
    grid: &Grid,
    block: &Block,
    ray: &Ray<LANES>,
    sun_zenith: f64,
    (azimuths, distances): (&[f64], &[f64]),
    Marched { parts, ground, passing }: Marched,
) {
    let (air, field) = (&block.air, &block.field);
    let scattered_once = PARTS * air.scatterers().len();
    let stride = scattered_once + 1;
    let sun = sun_zenith.sin_cos();
    let r0 = air.radius + ray.start_altitude;
    let on_rays: Vec<SunOnRay> = azimuths.iter().map(|a| SunOnRay::new(r0, ray.zenith_cosine, (a.cos(), a.sin()), sun)).collect();
    let ray_cuts = cuts(air, ray, distances);

    let lights = (&block.sunlight, block.direct.as_ref());
    let mut sums = vec![splat::<LANES>(0.0); scattered_once];
    let mut passed_here = Passed::nothing(air);
    for (on_ray, parts) in on_rays.iter().zip(parts.chunks_exact_mut(stride * distances.len())) {
        let mut passed = Passed::nothing(air);
        sums.fill(splat(0.0));
        let mut done = 0;
        for (cut, here) in ray_cuts.iter().zip(parts.chunks_exact_mut(stride)) {
            for point in &ray.points[done..cut.whole] {
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
    }
    let exact = depths(air, ray.start_altitude, ray.zenith_cosine, distances);
    passing.extend(ray_cuts.iter().zip(exact).map(|(cut, depths)| Passing { marched: cut.transmittance, depths }));
    if let Some((distance, _)) = &ray.ground {
        for (on_ray, ground) in on_rays.iter().zip(ground) {
            let irradiance = block.ground_irradiance(grid, on_ray.zenith_cosine(*distance, air.radius));
            *ground = Lanes::from_fn(|n| irradiance[n] * air.albedo[n] / PI as f32);
        }
    }
}

#[cfg(test)]
mod tests;
