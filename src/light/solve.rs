//! The multiple scattering of one block of wavelengths: the light field that is consistent with itself.
//!
//! One application of the scattering operator K takes a field to the field of the light that it scatters once more (and that the ground
//! reflects once more): at every node the radiance in every direction is a sum along the ray, and its moments make the new field. With b the field of
//! light scattered once, the solution is x = b + K x. It is found at low orders of the spherical harmonics by Anderson's accelerated
//! iteration (what is iterated is smooth in angle), then K is applied with all orders.

use super::air::Air;
use super::contracted::Contracted;
use super::grid::{Azimuth, Grid, azimuth_interpolation, azimuths};
use super::harmonics::{self, Orders};
use super::iterate::iterate;
use super::lanes::{LANES, Lanes, add_product, add_scaled, processor_fuses, splat};
use super::ray::{Ray, StepLimits};
use super::single::{add_strengths, direct_ground_irradiance};
use super::source::{Field, MAX_ORDER, Relative, Shape};
use super::stokes::{add_tensor, single_dipole};
use super::sunlight::Sunlight;
use super::suns::{SunOnRay, Suns};
use crate::error::Result;
use crate::quality::Numbers;
use multiversion::multiversion;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Orders at which the field is iterated to convergence: those that carry energy from place to place.
const LOW_ORDER: usize = 2;

/// Fewest azimuths at which strengths of single scattering are computed, and how many more for each degree that a ray runs around the planet.
const FEWEST_AZIMUTHS: usize = 4;
const AZIMUTHS_PER_DEGREE: f64 = 1.5;

/// One block of wavelengths, solved.
pub struct Block {
    /// The air.
    pub air: Air<LANES>,
    /// Transmittance to the Sun, forward peaks taken for transmitted.
    pub sunlight: Sunlight<LANES>,
    /// Transmittance to the Sun as it is, if there are forward peaks.
    pub direct: Option<Sunlight<LANES>>,
    /// Light scattered at least once.
    pub field: Relative<LANES>,
}

impl Block {
    /// Irradiance of the ground by Sun and sky together, per unit solar irradiance, where the Sun's zenith angle has this cosine.
    #[inline(always)]
    pub fn ground_irradiance(&self, grid: &Grid, zenith_cosine: f64) -> Lanes<LANES> {
        let mut sum = direct_ground_irradiance(&self.air, &self.sunlight, zenith_cosine);
        add_scaled(&mut sum, 1.0, &self.field.ground_irradiance(grid, zenith_cosine));
        sum
    }
}

/// What an application of the operator needs.
struct Operator<'a> {
    air: &'a Air<LANES>,
    sunlight: &'a Sunlight<LANES>,
}

/// Where an application of the operator looks: the directions at each altitude level of a grid with their weights, and the rays that follow them.
struct Target<'a> {
    grid: &'a Grid,
    directions: Vec<Vec<(f64, f64)>>,
    rays: Vec<Vec<Ray<LANES>>>,
}

impl<'a> Target<'a> {
    fn new(grid: &'a Grid, air: &Air<LANES>, nodes: [usize; 3], limits: StepLimits) -> Self {
        let directions = grid.directions(nodes);
        let rays = grid
            .altitudes
            .nodes()
            .par_iter()
            .zip(&directions)
            .map(|(&z, directions)| directions.iter().map(|&(mu, _)| Ray::trace(air, &grid.shells, z, mu, limits)).collect())
            .collect();
        Self { grid, directions, rays }
    }
}

/// Solves the block of `air`: the low orders on the coarser `iteration_grid` until they agree with themselves, then all on `grid`.
///
/// # Errors
/// [`Error::Unsolved`](crate::error::Error::Unsolved) if they come nowhere near that; [`Error::Cancelled`](crate::error::Error::Cancelled).
pub fn solve(
    (air, direct): (Air<LANES>, Option<Sunlight<LANES>>),
    grid: &Grid,
    iteration_grid: &Grid,
    numbers: &Numbers,
    polarised: bool,
    limits: StepLimits,
    progress: &(dyn Fn(f64) -> Result<()> + Sync),
) -> Result<Block> {
    let sunlight = Sunlight::new(&air);
    progress(0.05)?;
    let operator = Operator { air: &air, sunlight: &sunlight };
    let [few, many] = numbers.azimuth_nodes.map(azimuths);
    let shape = Shape { orders: Orders::new(numbers.order, numbers.azimuthal_order), polarised };
    let stage = |from: f64, to: f64| Stage { progress, from, to };

    let coarse = Target::new(iteration_grid, &air, numbers.iteration_zenith_nodes, limits);
    let once = operator.scatter_sunlight(&coarse, shape.truncated(LOW_ORDER), many.len(), &many, &stage(0.05, 0.15))?;
    let scatter_once_more = |low: &Field<LANES>, iteration: usize| {
        // How many iterations there will be is not known: each takes an eighth of what is left of this part.
        let part = |iteration: usize| 0.4 - 0.25 * 0.875_f64.powi(iteration as i32);
        let stage = stage(part(iteration), part(iteration + 1));
        let mut next = operator.scatter(&coarse, (iteration_grid, low), low.shape, &few, &stage)?;
        next.add(&once);
        Ok(next)
    };
    // In thick air small changes add up to more.
    let convergence = numbers.convergence / (1 + iteration_grid.more_levels) as f32;
    let low = iterate(&once, convergence, scatter_once_more)?;

    let fine = Target::new(grid, &air, numbers.zenith_nodes, limits);
    // Light scattered once is less smooth in azimuth than the rest.
    let azimuths = azimuths(2 * numbers.azimuth_nodes[1]);
    let once = operator.scatter_sunlight(&fine, shape, many.len(), &azimuths, &stage(0.4, 0.55))?;
    let (mut source_grid, mut field) = (iteration_grid, low);
    for application in 0..numbers.full_applications {
        let part = |application: usize| 0.55 + 0.45 * application as f64 / numbers.full_applications as f64;
        field = operator.scatter(&fine, (source_grid, &field), shape, &many, &stage(part(application), part(application + 1)))?;
        field.add(&once);
        source_grid = grid;
    }
    let field = Relative::new(&field);
    Ok(Block { air, sunlight, direct, field })
}

/// The part of the progress that one application of the operator makes.
struct Stage<'a> {
    progress: &'a (dyn Fn(f64) -> Result<()> + Sync),
    from: f64,
    to: f64,
}

/// Stokes parameters that light has.
fn stokes(shape: Shape) -> usize {
    if shape.polarised { 3 } else { 1 }
}

impl Operator<'_> {
    /// The field of sunlight scattered once and of sunlight reflected by the ground.
    fn scatter_sunlight(
        &self,
        target: &Target,
        shape: Shape,
        most: usize,
        many: &[Azimuth],
        stage: &Stage,
    ) -> Result<Field<LANES>> {
        let sets: Vec<Azimuths> = (FEWEST_AZIMUTHS.min(most)..=most).map(|few| Azimuths::new(few, many)).collect();
        collect(target, shape, many, stage, |ray, radiance| {
            // The farther a ray runs over the ground, the more the Sun along it depends on azimuth.
            let wanted = FEWEST_AZIMUTHS + (AZIMUTHS_PER_DEGREE * ray.reach_deg(self.air.radius)) as usize;
            let azimuths = &sets[wanted.min(most).saturating_sub(FEWEST_AZIMUTHS)];
            sunlit_radiance(target.grid, self.air, self.sunlight, azimuths, stokes(shape), ray, radiance);
        })
    }

    /// The field, as `shape` says, of the light of `field`, known on a grid, scattered or reflected once more.
    fn scatter(
        &self,
        target: &Target,
        (grid, field): (&Grid, &Field<LANES>),
        shape: Shape,
        azimuths: &[Azimuth],
        stage: &Stage,
    ) -> Result<Field<LANES>> {
        let source = Relative::new(field);
        collect(target, shape, azimuths, stage, |ray, radiance| {
            scattered_radiance(target.grid, (grid, &source), self.air, azimuths, ray, radiance);
        })
    }
}

/// The field of a radiance that `radiance_of(ray, out)` gives for all solar zenith angles, azimuths and Stokes parameters.
fn collect(
    target: &Target,
    shape: Shape,
    azimuths: &[Azimuth],
    stage: &Stage,
    radiance_of: impl Fn(&Ray<LANES>, &mut [Lanes<LANES>]) + Sync,
) -> Result<Field<LANES>> {
    let zeniths = target.grid.zeniths.len();
    let stokes = stokes(shape);
    let width = azimuths.len() * stokes;
    let mut field = Field::dark(target.grid, shape);
    let (done, told, levels) = (AtomicUsize::new(0), AtomicUsize::new(0), target.grid.altitudes.len());
    let report = |done: usize| {
        // Another thread may have told more by now: progress never goes back.
        let done = told.fetch_max(done, Ordering::Relaxed).max(done);
        (stage.progress)(stage.from + (stage.to - stage.from) * done as f64 / levels as f64)
    };
    let at_ground = field
        .values
        .par_chunks_exact_mut(zeniths * shape.count())
        .enumerate()
        .map(|(level, values)| {
            let mut radiance = vec![splat(0.0); zeniths * width];
            let mut irradiance = vec![splat(0.0); zeniths];
            for (&(mu, weight), ray) in target.directions[level].iter().zip(&target.rays[level]) {
                // A level of the finest grids takes long.
                report(done.load(Ordering::Relaxed))?;
                radiance.fill(splat(0.0));
                radiance_of(ray, &mut radiance);
                project(shape, mu, weight, azimuths, &radiance, values);
                if level == 0 && mu > 0.0 {
                    for (total, row) in irradiance.iter_mut().zip(radiance.chunks_exact(width)) {
                        for (azimuth, value) in azimuths.iter().zip(row.chunks_exact(stokes)) {
                            add_scaled(total, (mu * weight * azimuth.weight) as f32, &value[0]);
                        }
                    }
                }
            }
            report(done.fetch_add(1, Ordering::Relaxed) + 1)?;
            Ok(irradiance)
        })
        .collect::<Result<Vec<_>>>()?;
    field.ground.copy_from_slice(&at_ground[0]);
    Ok(field)
}

/// Azimuths at which strengths of single scattering are computed, and those at which the radiance is wanted.
struct Azimuths<'a> {
    few: Vec<Azimuth>,
    many: &'a [Azimuth],
    interpolation: Vec<f32>,
}

impl<'a> Azimuths<'a> {
    fn new(few: usize, many: &'a [Azimuth]) -> Self {
        let few = azimuths(few);
        Self { interpolation: azimuth_interpolation(&few, many), few, many }
    }
}

/// Stokes parameters along `ray` of sunlight scattered once, or reflected once where it ends, for all solar zenith angles and azimuths. The strengths
/// and the ground's irradiance are smooth in azimuth, the phase functions are not: only these are evaluated at every azimuth.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn sunlit_radiance(
    grid: &Grid,
    air: &Air<LANES>,
    sunlight: &Sunlight<LANES>,
    azimuths: &Azimuths,
    stokes: usize,
    ray: &Ray<LANES>,
    radiance: &mut [Lanes<LANES>],
) {
    let r0 = air.radius + ray.start_altitude;
    let (few, many) = (azimuths.few.len(), azimuths.many.len());
    let parts = air.scatterers().len() + 1;
    let on_rays: Vec<SunOnRay> = grid
        .sun
        .iter()
        .flat_map(|&sun| azimuths.few.iter().map(move |a| SunOnRay::new(r0, ray.zenith_cosine, (a.cosine, a.sine), sun)))
        .collect();
    let mut sampled = vec![splat::<LANES>(0.0); on_rays.len() * parts];
    add_strengths(air, sunlight, ray, &on_rays, parts, &mut sampled);
    if let Some((distance, transmittance)) = &ray.ground {
        for (on_ray, sample) in on_rays.iter().zip(sampled.chunks_exact_mut(parts)) {
            let irradiance = direct_ground_irradiance(air, sunlight, on_ray.zenith_cosine(*distance, air.radius));
            for n in 0..LANES {
                sample[parts - 1][n] = transmittance[n] * irradiance[n] * air.albedo[n] * (1.0 / PI) as f32;
            }
        }
    }
    for ((&sun, row), sampled) in
        grid.sun.iter().zip(radiance.chunks_exact_mut(many * stokes)).zip(sampled.chunks_exact(few * parts))
    {
        if sampled.iter().flatten().all(|&value| value == 0.0) {
            continue;
        }
        for ((azimuth, out), weights) in
            azimuths.many.iter().zip(row.chunks_exact_mut(stokes)).zip(azimuths.interpolation.chunks_exact(few))
        {
            let on_ray = SunOnRay::new(r0, ray.zenith_cosine, (azimuth.cosine, azimuth.sine), sun);
            for part in 0..parts {
                let mut value = splat(0.0);
                for (&weight, sample) in weights.iter().zip(sampled.chunks_exact(parts)) {
                    add_scaled(&mut value, weight, &sample[part]);
                }
                let Some(scatterer) = air.scatterers().get(part) else {
                    add_scaled(&mut out[0], 1.0, &value);
                    continue;
                };
                add_product(&mut out[0], &value, &scatterer.band_limited(on_ray.scattering_cosine));
                if let ([_, q, u], Some(share)) = (&mut *out, &scatterer.dipole_share) {
                    let [_, by_q, by_u] = single_dipole(on_ray.transverse).map(|v| v as f32);
                    for n in 0..LANES {
                        q[n] += by_q * share[n] * value[n];
                        u[n] += by_u * share[n] * value[n];
                    }
                }
            }
        }
    }
}

/// Stokes parameters along `ray` of the light that `source` scatters into it and that the ground at its end reflects, for all solar zenith angles and azimuths.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn scattered_radiance(
    target: &Grid,
    (grid, source): (&Grid, &Relative<LANES>),
    air: &Air<LANES>,
    azimuths: &[Azimuth],
    ray: &Ray<LANES>,
    radiance: &mut [Lanes<LANES>],
) {
    let r0 = air.radius + ray.start_altitude;
    let on_rays: Vec<SunOnRay> = target
        .sun
        .iter()
        .flat_map(|&sun| azimuths.iter().map(move |a| SunOnRay::new(r0, ray.zenith_cosine, (a.cosine, a.sine), sun)))
        .collect();
    let mut suns = Suns::new(&on_rays);
    let mut contracted = Contracted::<LANES, { processor_fuses!() }>::new(grid, source.shape);
    for point in &ray.points {
        contracted.fill(grid, source, air, point, 0..grid.zeniths.len());
        suns.place(grid, r0, point.distance, point.radius);
        contracted.add(grid, &suns, radiance);
    }
    if let Some((distance, transmittance)) = &ray.ground {
        for (on_ray, sum) in on_rays.iter().zip(radiance.chunks_exact_mut(stokes(source.shape))) {
            let irradiance = source.ground_irradiance(grid, on_ray.zenith_cosine(*distance, air.radius));
            for n in 0..LANES {
                sum[0][n] += transmittance[n] * irradiance[n] * air.albedo[n] * (1.0 / PI) as f32;
            }
        }
    }
}

/// Adds the moments, and the tensor, of the light from one view zenith angle.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn project(shape: Shape, mu: f64, weight: f64, azimuths: &[Azimuth], radiance: &[Lanes<LANES>], values: &mut [Lanes<LANES>]) {
    let orders = shape.orders;
    let mut harmonic = [0.0; Orders::new(MAX_ORDER, MAX_ORDER).count()];
    harmonics::evaluate(orders, mu, &mut harmonic);
    let (stokes, count) = (stokes(shape), azimuths.len());
    // Only what the tensor needs of waves beyond the moments' own: at most m = 2.
    let last = orders.azimuthal.max(if shape.polarised { 2 } else { 0 });
    let table = |wave: &dyn Fn(f64) -> f64, m: usize| -> Vec<f32> {
        azimuths.iter().map(|a| (weight * a.weight * wave(m as f64 * a.angle)) as f32).collect()
    };
    let cosines: Vec<f32> = (0..=last).flat_map(|m| table(&f64::cos, m)).collect();
    let sines: Vec<f32> = (1..=2).flat_map(|m| table(&f64::sin, m)).collect();
    for (row, node) in radiance.chunks_exact(count * stokes).zip(values.chunks_exact_mut(shape.count())) {
        let sum = |waves: &[f32], parameter: usize| {
            let mut sum = splat::<LANES>(0.0);
            for (&wave, value) in waves.iter().zip(row.chunks_exact(stokes)) {
                add_scaled(&mut sum, wave, &value[parameter]);
            }
            sum
        };
        let mut i = [splat(0.0); 3];
        for m in 0..=last {
            let part = sum(&cosines[m * count..(m + 1) * count], 0);
            if m < 3 {
                i[m] = part;
            }
            for l in m..=orders.order {
                if m <= orders.azimuthal {
                    let lm = orders.start(l) + m;
                    add_scaled(&mut node[lm], harmonic[lm], &part);
                }
            }
        }
        if shape.polarised {
            let q = [0, 1, 2].map(|m| sum(&cosines[m * count..(m + 1) * count], 1));
            let u = [0, 1].map(|m| sum(&sines[m * count..(m + 1) * count], 2));
            add_tensor(&mut node[orders.count()..], mu, 1.0, &i, &q, &u);
        }
    }
}
