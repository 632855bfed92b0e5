//! The multiple scattering of one block of wavelengths: the light field that is consistent with itself.
//!
//! One application of the scattering operator K takes a field to the field of the light that it scatters once more (and that the ground
//! reflects once more): at every node the radiance in every direction is a sum along the ray, and its moments make the new field. With b the field of
//! light scattered once, the solution is x = b + K x. It is found at low orders of the spherical harmonics by Anderson's accelerated
//! iteration (what is iterated is smooth in angle), then K is applied with all orders.

use super::air::Air;
use super::anderson::Anderson;
use super::grid::{Azimuth, Grid, azimuth_interpolation, azimuths};
use super::harmonics;
use super::lanes::{Lanes, add_product, add_scaled, splat};
use super::ray::{Ray, StepLimits};
use super::single::{add_strengths, direct_ground_irradiance};
use super::source::{Contracted, Field, Interpolated, Magnitudes, SunOnRay, Suns};
use super::sunlight::Sunlight;
use crate::error::Result;
use crate::quality::Numbers;
use multiversion::multiversion;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Width of the blocks of wavelengths.
pub const LANES: usize = 32;

/// Orders at which the field is iterated to convergence: those that carry energy from place to place.
const LOW_ORDER: usize = 2;

/// Iterations after which the solve goes on with what it has; never reached with air that lets light through.
const MAX_ITERATIONS: usize = 60;

/// One block of wavelengths, solved.
pub struct Block {
    /// The air.
    pub air: Air<LANES>,
    /// Transmittance to the Sun.
    pub sunlight: Sunlight<LANES>,
    /// Light scattered at least once.
    pub field: Field<LANES>,
    /// How bright the field is at its nodes.
    pub magnitudes: Magnitudes,
}

/// What an application of the operator needs.
struct Operator<'a> {
    grid: &'a Grid,
    air: &'a Air<LANES>,
    sunlight: &'a Sunlight<LANES>,
}

/// The directions at each altitude level with their weights, and the rays that follow them.
struct Rays {
    directions: Vec<Vec<(f64, f64)>>,
    rays: Vec<Vec<Ray<LANES>>>,
}

impl Rays {
    fn trace(grid: &Grid, air: &Air<LANES>, nodes: [usize; 3], limits: StepLimits) -> Self {
        let directions = grid.directions(nodes);
        let rays = grid
            .altitudes
            .nodes()
            .par_iter()
            .zip(&directions)
            .map(|(&z, directions)| directions.iter().map(|&(mu, _)| Ray::trace(air, &grid.shells, z, mu, limits)).collect())
            .collect();
        Self { directions, rays }
    }
}

/// Solves the block of `air`.
///
/// # Errors
/// [`crate::Error::Cancelled`].
pub fn solve(
    air: Air<LANES>,
    grid: &Grid,
    numbers: &Numbers,
    limits: StepLimits,
    progress: &(dyn Fn(f64) -> Result<()> + Sync),
) -> Result<Block> {
    let sunlight = Sunlight::new(&air);
    progress(0.1)?;
    let coarse = Rays::trace(grid, &air, numbers.iteration_zenith_nodes, limits);
    let fine = Rays::trace(grid, &air, numbers.zenith_nodes, limits);
    let operator = Operator { grid, air: &air, sunlight: &sunlight };
    let [few, many] = numbers.azimuth_nodes.map(azimuths);

    let stage = |from: f64, to: f64| Stage { progress, from, to };
    let once = operator.scatter_sunlight(&fine, numbers.order, &few, &many, &stage(0.1, 0.3))?;
    let once_low = once.truncated(LOW_ORDER);
    let mut field = once_low.clone();
    let mut anderson = Anderson::new();
    for iteration in 0..MAX_ITERATIONS {
        // How many iterations there will be is not known: each takes an eighth of what is left of this part.
        let part = |iteration: usize| 0.7 - 0.4 * 0.875_f64.powi(iteration as i32);
        let mut next = operator.scatter(&coarse, &field, LOW_ORDER, &few, &stage(part(iteration), part(iteration + 1)))?;
        add(&mut next, &once_low);
        let change = anderson.step(&mut field, next, iteration >= 2);
        if change < numbers.convergence {
            break;
        }
    }
    for application in 0..numbers.full_applications {
        let part = |application: usize| 0.7 + 0.3 * application as f64 / numbers.full_applications as f64;
        field = operator.scatter(&fine, &field, numbers.order, &many, &stage(part(application), part(application + 1)))?;
        add(&mut field, &once);
    }
    let magnitudes = Magnitudes::new(&field);
    Ok(Block { air, sunlight, field, magnitudes })
}

/// The part of the progress that one application of the operator makes.
struct Stage<'a> {
    progress: &'a (dyn Fn(f64) -> Result<()> + Sync),
    from: f64,
    to: f64,
}

fn add(field: &mut Field<LANES>, other: &Field<LANES>) {
    for (a, b) in field.moments.iter_mut().zip(&other.moments) {
        add_scaled(a, 1.0, b);
    }
    for (a, b) in field.ground.iter_mut().zip(&other.ground) {
        add_scaled(a, 1.0, b);
    }
}

impl Operator<'_> {
    /// The field of sunlight scattered once and of sunlight reflected by the ground.
    fn scatter_sunlight(
        &self,
        rays: &Rays,
        order: usize,
        few: &[Azimuth],
        many: &[Azimuth],
        stage: &Stage,
    ) -> Result<Field<LANES>> {
        let azimuths = Azimuths { few, many, interpolation: azimuth_interpolation(few, many) };
        self.collect(rays, order, many, stage, |level, direction, radiance| {
            sunlit_radiance(self.grid, self.air, self.sunlight, &azimuths, &rays.rays[level][direction], radiance);
        })
    }

    /// The field of the light of `field` scattered or reflected once more.
    fn scatter(
        &self,
        rays: &Rays,
        field: &Field<LANES>,
        order: usize,
        azimuths: &[Azimuth],
        stage: &Stage,
    ) -> Result<Field<LANES>> {
        let magnitudes = Magnitudes::new(field);
        let source = Interpolated { grid: self.grid, field, magnitudes: &magnitudes };
        self.collect(rays, order, azimuths, stage, |level, direction, radiance| {
            scattered_radiance(&source, self.air, azimuths, &rays.rays[level][direction], radiance);
        })
    }

    /// Moments up to `order` of a radiance that `radiance_of(level, direction, out)` gives for all solar zenith angles and azimuths.
    fn collect(
        &self,
        rays: &Rays,
        order: usize,
        azimuths: &[Azimuth],
        stage: &Stage,
        radiance_of: impl Fn(usize, usize, &mut [Lanes<LANES>]) + Sync,
    ) -> Result<Field<LANES>> {
        let zeniths = self.grid.zeniths.len();
        let pairs = harmonics::count(order);
        let mut field = Field::dark(self.grid, order);
        let (done, levels) = (AtomicUsize::new(0), self.grid.altitudes.len());
        let ground = &mut field.ground;
        let at_ground = field
            .moments
            .par_chunks_exact_mut(zeniths * pairs)
            .enumerate()
            .map(|(level, moments)| {
                let mut radiance = vec![splat(0.0); zeniths * azimuths.len()];
                let mut irradiance = vec![splat(0.0); zeniths];
                for (direction, &(mu, weight)) in rays.directions[level].iter().enumerate() {
                    radiance.fill(splat(0.0));
                    radiance_of(level, direction, &mut radiance);
                    project(order, mu, weight, azimuths, &radiance, moments);
                    if level == 0 && mu > 0.0 {
                        for (j, total) in irradiance.iter_mut().enumerate() {
                            for (q, azimuth) in azimuths.iter().enumerate() {
                                add_scaled(total, (mu * weight * azimuth.weight) as f32, &radiance[j * azimuths.len() + q]);
                            }
                        }
                    }
                }
                let share = (done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / levels as f64;
                (stage.progress)(stage.from + (stage.to - stage.from) * share)?;
                Ok(irradiance)
            })
            .collect::<Result<Vec<_>>>()?;
        ground.copy_from_slice(&at_ground[0]);
        Ok(field)
    }
}

/// Azimuths at which strengths of single scattering are computed, and those at which the radiance is wanted.
struct Azimuths<'a> {
    few: &'a [Azimuth],
    many: &'a [Azimuth],
    interpolation: Vec<f32>,
}

/// Radiance of sunlight scattered once along `ray`, or reflected once where it ends, for all solar zenith angles and azimuths. The strengths
/// and the ground's irradiance are smooth in azimuth, the phase functions are not: only these are evaluated at every azimuth.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn sunlit_radiance(
    grid: &Grid,
    air: &Air<LANES>,
    sunlight: &Sunlight<LANES>,
    azimuths: &Azimuths,
    ray: &Ray<LANES>,
    radiance: &mut [Lanes<LANES>],
) {
    let r0 = air.radius + ray.start_altitude;
    let (few, many) = (azimuths.few.len(), azimuths.many.len());
    let parts = air.scatterers().len() + 1;
    let mut sampled = vec![splat::<LANES>(0.0); few * parts];
    for (&sun, row) in grid.sun.iter().zip(radiance.chunks_exact_mut(many)) {
        sampled.fill(splat(0.0));
        for (azimuth, sample) in azimuths.few.iter().zip(sampled.chunks_exact_mut(parts)) {
            let on_ray = SunOnRay::new(r0, ray.zenith_cosine, (azimuth.cosine, azimuth.sine), sun);
            add_strengths(air, sunlight, ray, &on_ray, &mut sample[..parts - 1]);
            if let Some((distance, transmittance)) = &ray.ground {
                let irradiance = direct_ground_irradiance(air, sunlight, on_ray.zenith_cosine(*distance, air.radius));
                for n in 0..LANES {
                    sample[parts - 1][n] = transmittance[n] * irradiance[n] * air.albedo[n] * (1.0 / PI) as f32;
                }
            }
        }
        for ((azimuth, sum), weights) in azimuths.many.iter().zip(row).zip(azimuths.interpolation.chunks_exact(few)) {
            let on_ray = SunOnRay::new(r0, ray.zenith_cosine, (azimuth.cosine, azimuth.sine), sun);
            for part in 0..parts {
                let mut value = splat(0.0);
                for (&weight, sample) in weights.iter().zip(sampled.chunks_exact(parts)) {
                    add_scaled(&mut value, weight, &sample[part]);
                }
                if let Some(scatterer) = air.scatterers().get(part) {
                    add_product(sum, &value, &scatterer.phase(on_ray.scattering_cosine));
                } else {
                    add_scaled(sum, 1.0, &value);
                }
            }
        }
    }
}

/// Radiance along `ray` of the light that `source` scatters into it and that the ground at its end reflects, for all solar zenith angles and azimuths.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn scattered_radiance(
    source: &Interpolated<LANES>,
    air: &Air<LANES>,
    azimuths: &[Azimuth],
    ray: &Ray<LANES>,
    radiance: &mut [Lanes<LANES>],
) {
    let grid = source.grid;
    let r0 = air.radius + ray.start_altitude;
    let on_rays: Vec<SunOnRay> = grid
        .sun
        .iter()
        .flat_map(|&sun| azimuths.iter().map(move |a| SunOnRay::new(r0, ray.zenith_cosine, (a.cosine, a.sine), sun)))
        .collect();
    let mut suns = Suns::new(&on_rays);
    let mut contracted = Contracted::new(grid, source.field.order);
    for point in &ray.points {
        contracted.fill(source, air, point, 0..grid.zeniths.len());
        suns.place(grid, r0, point.distance, point.radius);
        contracted.add(&suns, radiance);
    }
    if let Some((distance, transmittance)) = &ray.ground {
        for (on_ray, sum) in on_rays.iter().zip(radiance.iter_mut()) {
            let irradiance = source.ground_irradiance(on_ray.zenith_cosine(*distance, air.radius));
            for n in 0..LANES {
                sum[n] += transmittance[n] * irradiance[n] * air.albedo[n] * (1.0 / PI) as f32;
            }
        }
    }
}

/// Adds the moments of the radiance in one view zenith angle.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn project(order: usize, mu: f64, weight: f64, azimuths: &[Azimuth], radiance: &[Lanes<LANES>], moments: &mut [Lanes<LANES>]) {
    let mut harmonic = [0.0; harmonics::count(super::source::MAX_ORDER)];
    harmonics::evaluate(order, mu, &mut harmonic);
    let pairs = harmonics::count(order);
    let waves: Vec<f32> =
        (0..=order).flat_map(|m| azimuths.iter().map(move |a| (weight * a.weight * (m as f64 * a.angle).cos()) as f32)).collect();
    for (row, node) in radiance.chunks_exact(azimuths.len()).zip(moments.chunks_exact_mut(pairs)) {
        for m in 0..=order {
            let mut sum = splat::<LANES>(0.0);
            for (&wave, value) in waves[m * azimuths.len()..].iter().zip(row) {
                add_scaled(&mut sum, wave, value);
            }
            for l in m..=order {
                let lm = harmonics::index(l, m);
                add_scaled(&mut node[lm], harmonic[lm], &sum);
            }
        }
    }
}
