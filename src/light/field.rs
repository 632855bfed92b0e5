//! The light field of one air, for any Sun, observer and direction.

mod incident;
mod segments;

pub use incident::Incident;
pub use segments::Segments;

use super::air::Air;
use super::angular::{AngularFunctions, Once};
use super::balance;
use super::contracted::Contracted;
use super::grid::{FINER, Grid};
use super::harmonics::Orders;
use super::lanes::{LANES, Lanes, processor_fuses, splat};
use super::ray::{Ray, StepLimits};
use super::single::{PARTS, add_strengths_and_paths};
use super::solve::{Block, solve};
use super::source::{MAX_ORDER, Relative, Shape};
use super::sunlight::Sunlight;
use super::suns::{SunOnRay, Suns};
use crate::atmosphere::{OpticalProfile, Phase};
use crate::error::{Error, Result};
use crate::progress::Progress;
use crate::quality::Numbers;
use multiversion::multiversion;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Cosine of the solar zenith angle below which light scattered once is summed in finer steps: with the Sun at 3 degrees coarse ones are 0.1 % wrong at most, at -6 degrees 1 %.
const LOW_SUN: f64 = -0.03;

/// The solved light of one air: independent of place, time and observer. All values are per unit solar irradiance at the top of the air.
pub struct LightField {
    grid: Grid,
    blocks: Vec<Block>,
    wavelengths: usize,
    polarised: bool,
    functions: Arc<Vec<AngularFunctions>>,
    limits: StepLimits,
}

/// Where the observer is, and where the Sun is for the observer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer {
    /// Altitude over the ground of the profile [km].
    pub altitude_km: f64,
    /// Zenith angle of the Sun's centre, geometric [radians].
    pub sun_zenith: f64,
}

/// Light gathered along rays of equal zenith angle and several azimuths, in parts that are smooth in direction.
///
/// Radiance = sum over components of [`AngularFunctions`] (angle to the Sun) with weights that follow from wavelength, strengths and path, + rest.
#[derive(Clone, Debug, Default)]
pub struct Gathered {
    /// Number of wavelengths.
    pub wavelengths: usize,
    /// Number of scattering components.
    pub components: usize,
    /// Number of Stokes parameters of the rest: 1 (I) or 3 (I, Q, U).
    pub stokes: usize,
    /// Per unit solar irradiance, row-major, shape (azimuths, parts, wavelengths); the parts are strength [sr-1], direct strength [sr-1] and path of each component, then the rest [sr-1].
    values: Vec<f32>,
}

impl Gathered {
    /// Strength of single scattering by component `component` without its forward peak at azimuth index `azimuth` [sr-1].
    pub fn strength(&self, azimuth: usize, component: usize) -> &[f32] {
        self.part(azimuth, PARTS * component)
    }

    /// Strength of single scattering by component `component`, forward peak and all, of light that was not scattered otherwise [sr-1].
    pub fn direct_strength(&self, azimuth: usize, component: usize) -> &[f32] {
        self.part(azimuth, PARTS * component + 1)
    }

    /// Scattering optical depth by component `component` that this light has passed.
    pub fn path(&self, azimuth: usize, component: usize) -> &[f32] {
        self.part(azimuth, PARTS * component + 2)
    }

    /// All other light [sr-1]: Stokes parameter `parameter` (0 I, 1 Q, 2 U; those that there are) in the frame of the ray, Q > 0 vertical.
    pub fn rest(&self, azimuth: usize, parameter: usize) -> &[f32] {
        self.part(azimuth, PARTS * self.components + parameter)
    }

    fn part(&self, azimuth: usize, part: usize) -> &[f32] {
        let start = (azimuth * (PARTS * self.components + self.stokes) + part) * self.wavelengths;
        &self.values[start..start + self.wavelengths]
    }
}

impl LightField {
    /// Solves the multiple scattering of `profile`, which must be valid, with its polarisation or as a scalar.
    ///
    /// # Errors
    /// [`Error::Unsolved`] for air so thick that no solution is found or that it does not keep the energy of the light; [`Error::Cancelled`].
    pub fn solve(profile: &OpticalProfile, numbers: &Numbers, polarised: bool, progress: &Progress) -> Result<Self> {
        let count = profile.wavelengths_nm.len().div_ceil(LANES);
        balance::check_depth(profile, numbers.order)?;
        Self::assemble(profile, numbers, polarised, |block, air, [grid, iteration_grid], limits| {
            let report = |fraction: f64| progress.report("solve", (block as f64 + fraction) / count as f64);
            let solved = solve(air, grid, iteration_grid, numbers, polarised, limits, &report);
            solved.map_err(|error| match error {
                Error::Unsolved { what } => balance::unsolved(profile, &what),
                other => other,
            })
        })
    }

    /// The field of `profile` with blocks that `make` makes of their number, their air, the grid and the limits of the rays.
    fn assemble(
        profile: &OpticalProfile,
        numbers: &Numbers,
        polarised: bool,
        make: impl Fn(usize, (Air<LANES>, Option<Sunlight<LANES>>), [&Grid; 2], StepLimits) -> Result<Block> + Sync,
    ) -> Result<Self> {
        debug_assert!(numbers.order <= MAX_ORDER);
        let wavelengths = profile.wavelengths_nm.len();
        let limits = StepLimits::new(numbers, profile.planet_radius_km);
        let [grid, iteration_grid] = Grid::new(numbers, profile);
        let blocks = || {
            (0..wavelengths.div_ceil(LANES))
                .map(|block| {
                    let air = Air::<LANES>::new(profile, block * LANES, numbers.order, polarised);
                    // What molecules scatter is held by the lowest orders; every other component has something beyond its orders.
                    let peaks =
                        profile.components.iter().any(|c| c.phase.as_ref().is_some_and(|p| !matches!(p, Phase::Rayleigh { .. })));
                    let direct = peaks.then(|| Sunlight::new(&Air::unscaled(profile, block * LANES)));
                    let made = make(block, (air, direct), [&grid, &iteration_grid], limits)?;
                    balance::check(profile, block * LANES, &made, &grid)?;
                    Ok(made)
                })
                .collect::<Result<Vec<_>>>()
        };
        let given_up = AtomicBool::new(false);
        let phases: Vec<&Phase> = profile.components.iter().filter_map(|component| component.phase.as_ref()).collect();
        let functions = || {
            let of = |phase: &&Phase| {
                let sun_radius = profile.sun_angular_radius_deg.to_radians();
                AngularFunctions::unless(&given_up, phase, wavelengths, numbers.order, sun_radius)
            };
            phases.par_iter().map(of).collect::<Vec<_>>()
        };
        let solve = || {
            let blocks = blocks();
            given_up.store(blocks.is_err(), Ordering::Relaxed);
            blocks
        };
        let (blocks, functions) = rayon::join(solve, functions);
        let blocks = blocks?;
        Ok(Self { grid, blocks, wavelengths, polarised, functions: Arc::new(functions), limits })
    }

    /// What solving found, as plain numbers: [`Self::from_sections`] makes the same field of them without solving. Everything else follows quickly from the profile.
    pub fn to_sections(&self) -> Vec<Vec<f32>> {
        self.blocks.iter().flat_map(|block| block.field.to_sections()).collect()
    }

    /// The field that [`Self::to_sections`] was asked of, for the same `profile`, `numbers` and `polarised`.
    ///
    /// # Errors
    /// [`Error::Data`] for sections of another field, [`Error::Unsolved`] for those of none.
    pub fn from_sections(profile: &OpticalProfile, numbers: &Numbers, polarised: bool, sections: &[Vec<f32>]) -> Result<Self> {
        let parts = Relative::<LANES>::SECTIONS;
        Self::assemble(profile, numbers, polarised, |block, (air, direct), [grid, _], _| {
            let shape = Shape { orders: Orders::new(numbers.order, numbers.azimuthal_order), polarised };
            let own = sections.get(block * parts..(block + 1) * parts);
            let field = own.and_then(|own| Relative::from_sections(grid, shape, own));
            let field = field.ok_or_else(|| Error::data("stored light of another field"))?;
            Ok(Block { sunlight: Sunlight::new(&air), air, direct, field })
        })
    }

    /// Relative error of the light on the ground that follows from the light which the field loses and wins, by wavelength, see `balance`: below 0 if light is missing.
    pub fn errors_on_the_ground(&self) -> Vec<f64> {
        self.blocks.iter().flat_map(|block| balance::error_on_the_ground(block, &self.grid)).take(self.wavelengths).collect()
    }

    /// For each component that scatters, how its light depends on the angle to the Sun.
    pub fn functions(&self) -> &Arc<Vec<AngularFunctions>> {
        &self.functions
    }

    /// Whether Q and U are known.
    pub fn is_polarised(&self) -> bool {
        self.polarised
    }

    /// Gathers the light that `observer` sees at zenith cosine `mu` and `azimuths` from the Sun [radians], the Sun's disc excluded.
    pub fn gather(&self, observer: &Observer, mu: f64, azimuths: &[f64]) -> Gathered {
        let components = self.functions.len();
        let stokes = if self.polarised { 3 } else { 1 };
        let stride = PARTS * components + stokes;
        let mut out = Gathered {
            wavelengths: self.wavelengths,
            components,
            stokes,
            values: vec![0.0; azimuths.len() * stride * self.wavelengths],
        };
        let mut parts = vec![splat::<LANES>(0.0); azimuths.len() * stride];
        for (b, block) in self.blocks.iter().enumerate() {
            parts.fill(splat(0.0));
            let ray = Ray::trace(&block.air, &self.grid.shells, observer.altitude_km, mu, self.limits);
            let fine = (observer.sun_zenith.cos() < LOW_SUN).then(|| {
                let limits = StepLimits { length_km: self.limits.length_km / FINER as f64, ..self.limits };
                Ray::trace(&block.air, &self.grid.fine_shells, observer.altitude_km, mu, limits)
            });
            gather_block(&self.grid, block, [&ray, fine.as_ref().unwrap_or(&ray)], observer.sun_zenith, azimuths, &mut parts);
            let first = b * LANES;
            let count = LANES.min(self.wavelengths - first);
            for (k, part) in parts.iter().enumerate() {
                let start = k * self.wavelengths + first;
                out.values[start..start + count].copy_from_slice(&part[..count]);
            }
        }
        out
    }

    /// Radiance per unit solar irradiance [sr-1] of gathered light at azimuth index `azimuth` and wavelength index `wavelength`;
    /// `cosine` is that of the angle to the Sun.
    pub fn radiance(&self, gathered: &Gathered, azimuth: usize, wavelength: usize, cosine: f64) -> f64 {
        let once = self.functions.iter().enumerate().map(|(c, functions)| {
            let at = |values: &[f32]| f64::from(values[wavelength]);
            let once = Once {
                strength: at(gathered.strength(azimuth, c)),
                direct_strength: at(gathered.direct_strength(azimuth, c)),
                path: at(gathered.path(azimuth, c)),
            };
            functions.value(wavelength, &once, cosine)
        });
        once.sum::<f64>() + f64::from(gathered.rest(azimuth, 0)[wavelength])
    }

    /// Stokes parameters I, Q, U per unit solar irradiance [sr-1] of gathered light at azimuth index `azimuth` and wavelength index `wavelength`; `transverse` are the components of the
    /// unit vector to the Sun along e_theta and e_phi of the ray ([`super::transverse`]). Q and U are 0 in light solved as a scalar.
    pub fn stokes(&self, gathered: &Gathered, azimuth: usize, wavelength: usize, transverse: [f64; 2], cosine: f64) -> [f64; 3] {
        let mut sum = [self.radiance(gathered, azimuth, wavelength, cosine), 0.0, 0.0];
        if self.polarised {
            for (c, functions) in self.functions.iter().enumerate() {
                if let AngularFunctions::Molecules(weights) = functions {
                    let [a, b] = transverse;
                    let strength = f64::from(gathered.strength(azimuth, c)[wavelength]) * weights[wavelength][1];
                    sum[1] += strength * (b * b - a * a);
                    sum[2] -= strength * 2.0 * a * b;
                }
            }
            for (parameter, sum) in sum.iter_mut().enumerate().skip(1) {
                *sum += f64::from(gathered.rest(azimuth, parameter)[wavelength]);
            }
        }
        sum
    }

    /// Irradiance of the ground by Sun and sky together per unit solar irradiance, by wavelength.
    pub fn ground_irradiance(&self, sun_zenith: f64) -> Vec<f64> {
        let light = self.blocks.iter().flat_map(|block| block.ground_irradiance(&self.grid, sun_zenith.cos()));
        light.take(self.wavelengths).map(f64::from).collect()
    }

    /// Transmittance to the Sun's disc by wavelength, as a mean over the whole disc (parts behind the horizon count as 0).
    pub fn sun_transmittance(&self, observer: &Observer) -> Vec<f64> {
        let light = self.blocks.iter().flat_map(|block| {
            block
                .direct
                .as_ref()
                .unwrap_or(&block.sunlight)
                .over_disc(observer.altitude_km, observer.sun_zenith.cos())
                .unwrap_or(splat(0.0))
        });
        light.take(self.wavelengths).map(f64::from).collect()
    }
}

impl LightField {
    /// Transmittance from `altitude_km` along the ray of zenith cosine `mu` to the ground or to space, by wavelength, forward peaks counted as transmitted.
    pub fn ray_transmittance(&self, altitude_km: f64, mu: f64) -> Vec<f64> {
        let depths =
            self.blocks.iter().flat_map(|block| Ray::optical_depth(&block.air, &self.grid.shells, altitude_km, mu, self.limits));
        depths.take(self.wavelengths).map(|depth| (-f64::from(depth)).exp()).collect()
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn gather_block(
    grid: &Grid,
    block: &Block,
    [ray, once]: [&Ray<LANES>; 2],
    sun_zenith: f64,
    azimuths: &[f64],
    parts: &mut [Lanes<LANES>],
) {
    let (air, sunlight, field) = (&block.air, &block.sunlight, &block.field);
    let paths = PARTS * air.scatterers().len();
    let stokes = if field.shape.polarised { 3 } else { 1 };
    let sun = sun_zenith.sin_cos();
    let r0 = air.radius + ray.start_altitude;
    let on_rays: Vec<SunOnRay> = azimuths.iter().map(|a| SunOnRay::new(r0, ray.zenith_cosine, (a.cos(), a.sin()), sun)).collect();
    for (on_ray, part) in on_rays.iter().zip(parts.chunks_exact_mut(paths + stokes)) {
        add_strengths_and_paths(air, (sunlight, block.direct.as_ref()), once, on_ray, &mut part[..paths]);
        for component in part[..paths].chunks_exact_mut(PARTS) {
            for n in 0..LANES {
                component[2][n] = if component[1][n] > 0.0 { component[2][n] / component[1][n] } else { 0.0 };
            }
        }
    }
    let mut suns = Suns::new(&on_rays);
    let mut contracted = Contracted::<LANES, { processor_fuses!() }>::new(grid, field.shape);
    let mut scattered = vec![splat(0.0); azimuths.len() * stokes];
    for point in &ray.points {
        suns.place(grid, r0, point.distance, point.radius);
        contracted.fill(grid, field, air, point, suns.range(grid));
        contracted.add(grid, &suns, &mut scattered);
    }
    for (part, sums) in parts.chunks_exact_mut(paths + stokes).zip(scattered.chunks_exact(stokes)) {
        part[paths..].copy_from_slice(sums);
    }
    if let Some((distance, transmittance)) = &ray.ground {
        for (on_ray, part) in on_rays.iter().zip(parts.chunks_exact_mut(paths + stokes)) {
            let irradiance = block.ground_irradiance(grid, on_ray.zenith_cosine(*distance, air.radius));
            for n in 0..LANES {
                part[paths][n] += transmittance[n] * irradiance[n] * air.albedo[n] * (1.0 / PI) as f32;
            }
        }
    }
}
