//! The light field of one air, for any Sun, observer and direction.

use super::air::Air;
use super::grid::Grid;
use super::lanes::{Lanes, add_scaled, splat};
use super::ray::{Ray, StepLimits};
use super::single::{add_strengths, direct_ground_irradiance};
use super::solve::{Block, LANES, solve};
use super::source::{Contracted, Interpolated, MAX_ORDER, SunOnRay, Suns};
use crate::atmosphere::OpticalProfile;
use crate::error::Result;
use crate::progress::Progress;
use crate::quality::Numbers;
use multiversion::multiversion;
use std::f64::consts::PI;

/// The solved light of one air: independent of place, time and observer. All values are per unit solar irradiance at the top of the air.
pub struct LightField {
    grid: Grid,
    blocks: Vec<Block>,
    wavelengths: usize,
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
/// Radiance = sum over components of phase function(angle to the Sun) x strength + rest.
#[derive(Clone, Debug, Default)]
pub struct Gathered {
    /// Number of wavelengths.
    pub wavelengths: usize,
    /// Number of scattering components.
    pub components: usize,
    /// Per unit solar irradiance [sr-1], row-major, shape (azimuths, components + 1, wavelengths): for each azimuth the strengths of
    /// single scattering, component after component, then the rest. [`Self::part`] picks one.
    pub values: Vec<f32>,
}

impl Gathered {
    /// Strength of single scattering by component `component` (or, for `component` = the number of components, all other light) at azimuth index `azimuth`.
    pub fn part(&self, azimuth: usize, component: usize) -> &[f32] {
        let start = (azimuth * (self.components + 1) + component) * self.wavelengths;
        &self.values[start..start + self.wavelengths]
    }
}

impl LightField {
    /// Solves the multiple scattering of `profile`, which must be valid.
    ///
    /// # Errors
    /// [`crate::Error::Cancelled`].
    pub fn solve(profile: &OpticalProfile, numbers: &Numbers, progress: &Progress) -> Result<Self> {
        debug_assert!(numbers.order <= MAX_ORDER);
        let wavelengths = profile.wavelengths_nm.len();
        let top = *profile.altitudes_km.last().expect("validated profile");
        let limits = StepLimits::new(numbers, profile.planet_radius_km);
        let grid = Grid::new(numbers, profile.planet_radius_km, top);
        let count = wavelengths.div_ceil(LANES);
        let mut blocks = Vec::with_capacity(count);
        for block in 0..count {
            let air = Air::new(profile, block * LANES, numbers.order);
            let report = |fraction: f64| progress.report("solve", (block as f64 + fraction) / count as f64);
            blocks.push(solve(air, &grid, numbers, limits, &report)?);
        }
        Ok(Self { grid, blocks, wavelengths, limits })
    }

    /// Number of components that scatter.
    pub fn components(&self) -> usize {
        self.blocks[0].air.scatterers().len()
    }

    /// Gathers the light that `observer` sees at zenith cosine `mu` and `azimuths` from the Sun [radians], the Sun's disc excluded.
    pub fn gather(&self, observer: &Observer, mu: f64, azimuths: &[f64]) -> Gathered {
        let components = self.components();
        let mut out = Gathered {
            wavelengths: self.wavelengths,
            components,
            values: vec![0.0; azimuths.len() * (components + 1) * self.wavelengths],
        };
        let mut parts = vec![splat::<LANES>(0.0); azimuths.len() * (components + 1)];
        for (b, block) in self.blocks.iter().enumerate() {
            parts.fill(splat(0.0));
            let ray = Ray::trace(&block.air, &self.grid.shells, observer.altitude_km, mu, self.limits);
            let source = Interpolated { grid: &self.grid, field: &block.field, magnitudes: &block.magnitudes };
            gather_block(block, &source, &ray, observer.sun_zenith, azimuths, &mut parts);
            let first = b * LANES;
            let count = LANES.min(self.wavelengths - first);
            for (k, part) in parts.iter().enumerate() {
                let start = k * self.wavelengths + first;
                out.values[start..start + count].copy_from_slice(&part[..count]);
            }
        }
        out
    }

    /// Transmittance to the Sun's disc by wavelength, as a mean over the whole disc (parts behind the horizon count as 0).
    pub fn sun_transmittance(&self, observer: &Observer) -> Vec<f64> {
        let light = self
            .blocks
            .iter()
            .flat_map(|block| block.sunlight.over_disc(observer.altitude_km, observer.sun_zenith.cos()).unwrap_or(splat(0.0)));
        light.take(self.wavelengths).map(f64::from).collect()
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn gather_block(
    block: &Block,
    source: &Interpolated<LANES>,
    ray: &Ray<LANES>,
    sun_zenith: f64,
    azimuths: &[f64],
    parts: &mut [Lanes<LANES>],
) {
    let (air, sunlight, grid) = (&block.air, &block.sunlight, source.grid);
    let stride = air.scatterers().len() + 1;
    let sun = sun_zenith.sin_cos();
    let r0 = air.radius + ray.start_altitude;
    let on_rays: Vec<SunOnRay> = azimuths.iter().map(|a| SunOnRay::new(r0, ray.zenith_cosine, (a.cos(), a.sin()), sun)).collect();
    for (on_ray, part) in on_rays.iter().zip(parts.chunks_exact_mut(stride)) {
        add_strengths(air, sunlight, ray, on_ray, &mut part[..stride - 1]);
    }
    let mut suns = Suns::new(&on_rays);
    let mut contracted = Contracted::new(grid, source.field.order);
    let mut scattered = vec![splat(0.0); azimuths.len()];
    for point in &ray.points {
        suns.place(grid, r0, point.distance, point.radius);
        contracted.fill(source, air, point, suns.range());
        contracted.add(&suns, &mut scattered);
    }
    for (part, sum) in parts.chunks_exact_mut(stride).zip(&scattered) {
        add_scaled(&mut part[stride - 1], 1.0, sum);
    }
    if let Some((distance, transmittance)) = &ray.ground {
        for (on_ray, part) in on_rays.iter().zip(parts.chunks_exact_mut(stride)) {
            let cosine = on_ray.zenith_cosine(*distance, air.radius);
            let mut irradiance = direct_ground_irradiance(air, sunlight, cosine);
            add_scaled(&mut irradiance, 1.0, &source.ground_irradiance(cosine));
            for n in 0..LANES {
                part[stride - 1][n] += transmittance[n] * irradiance[n] * air.albedo[n] * (1.0 / PI) as f32;
            }
        }
    }
}
