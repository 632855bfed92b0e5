//! Whether a solved field keeps the energy of the light, and how far off that makes the light on the ground.
//!
//! In a shell of the air as much light is lost as is absorbed. Over the whole sphere what flows along the horizontal cancels, so that with means over all positions of the Sun
//! ```text
//! d(r^2 F) / dr = r^2 (sum over components c of sigma_c T - kappa 4 pi J)
//! ```
//! holds exactly: F the net upward flux, J the mean radiance, T the transmittance to the Sun, kappa the absorption. F and J are moments of the field; where its levels are too far
//! apart for a thick layer, or its iteration has not come to its end, the two sides differ, and light comes from nowhere or vanishes.
//!
//! What a unit of light that is lost or won at some altitude means for the ground is the mean adjoint radiance of the ground's irradiance there, by reciprocity the radiance
//! of air that an isotropic lamp below lights: in Eddington's approximation a tridiagonal system. The sum of losses times this importance, over the irradiance of the ground, is
//! to first order the relative error of the latter. It is asked for no more than whether it is small.

use super::air::Air;
use super::grid::{Grid, scattering_depths};
use super::lanes::LANES;
use super::single::direct_ground_irradiance;
use super::solve::Block;
use super::source::Relative;
use super::sunlight::Sunlight;
use crate::atmosphere::{Component, OpticalProfile};
use crate::error::{Error, Result};
use std::f64::consts::PI;

/// Largest error of the light on the ground, in the worst wavelength, with which a field is still a solution.
const LARGEST_ERROR: f64 = 0.05;

/// Part of the sunlight that meets the planet below which light on the ground counts as darkness: errors are relative to no less. Rounding of what the air above turns over is far less
/// than [`LARGEST_ERROR`] of it.
const DARK: f64 = 1e-4;

/// Optical depth of scattering, without forward peaks, beyond which no quality resolves the air: not worth a try.
const HOPELESS_DEPTH: f64 = 16.0;

/// Vertical optical depth beyond which a component may be to blame.
const THICK: f64 = 1.0;

/// Points for each unit of vertical optical depth between two levels, where sunlight is summed; at least and at most so many.
const PER_OPTICAL_DEPTH: f64 = 3.0;
const FEWEST_POINTS: usize = 4;
const MOST_POINTS: usize = 96;

/// Refuses at once the air of `profile` that is far too thick for a field of orders up to `order`.
///
/// # Errors
/// [`Error::Unsolved`].
pub fn check_depth(profile: &OpticalProfile, order: usize) -> Result<()> {
    let thickest = scattering_depths(profile, order).into_iter().fold(0.0, f64::max);
    if thickest <= HOPELESS_DEPTH {
        return Ok(());
    }
    Err(unsolved(
        profile,
        &format!(
            "forward peaks aside it scatters with an optical depth of {thickest:.3}, and beyond {HOPELESS_DEPTH} no try is made"
        ),
    ))
}

/// Checks that the field of `block`, whose first wavelength is `first` in `profile`, is one of finite numbers that keep the energy of the light.
///
/// # Errors
/// [`Error::Unsolved`].
pub fn check(profile: &OpticalProfile, first: usize, block: &Block, grid: &Grid) -> Result<()> {
    let field = &block.field;
    let lanes = field.values.iter().chain(&field.ground).flatten();
    if !lanes.chain(&field.log_magnitudes).chain(&field.ground_log_magnitudes).all(|value| value.is_finite()) {
        return Err(unsolved(profile, "it is not finite"));
    }
    for (&error, &wavelength) in error_on_the_ground(block, grid).iter().zip(&profile.wavelengths_nm[first..]) {
        if !error.is_finite() {
            return Err(unsolved(profile, &format!("at {wavelength} nm the balance of its light is not finite")));
        }
        if error.abs() > LARGEST_ERROR {
            let (size, word) = (100.0 * error.abs(), if error < 0.0 { "vanishes" } else { "comes from nowhere" });
            let limit = 100.0 * LARGEST_ERROR;
            return Err(unsolved(
                profile,
                &format!("at {wavelength} nm light {word}, {size:.1} % of that on the ground, more than {limit} %"),
            ));
        }
    }
    Ok(())
}

/// Says why the light of the air of `profile` is not found, what in it is to blame, if anything, and what helps.
pub fn unsolved(profile: &OpticalProfile, reason: &str) -> Error {
    let blame = |kind: &str, of: fn(&Component) -> &[f64], less_aerosol: &str| {
        let (depth, name, wavelength) = thickest(profile, of);
        let less = if name == "aerosol" { less_aerosol } else { "less of it" };
        (depth > THICK).then(|| {
            format!(
                ". It is too thick, with a vertical optical depth of {depth:.3} of {kind} by {name} at {wavelength} nm. \
                 What helps is {less}, and within limits a higher quality"
            )
        })
    };
    let by_scattering = || {
        blame(
            "scattering",
            |component| &component.scattering_per_km,
            "less aerosol (a smaller aod550 or turbidity, a longer visibility_km)",
        )
    };
    let by_absorption =
        || blame("absorption", |component| &component.absorption_per_km, "less aerosol, or one that absorbs less");
    let why = by_scattering().or_else(by_absorption).unwrap_or_default();
    Error::unsolved(format!("the light of this air cannot be found well enough: {reason}{why}"))
}

/// The greatest vertical optical depth of the coefficients `of` a component, whose it is, and its wavelength [nm].
fn thickest(profile: &OpticalProfile, of: fn(&Component) -> &[f64]) -> (f64, &str, f64) {
    let (z, count) = (&profile.altitudes_km, profile.wavelengths_nm.len());
    let mut thickest = (0.0, "", profile.wavelengths_nm[0]);
    for component in &profile.components {
        for (w, &wavelength) in profile.wavelengths_nm.iter().enumerate() {
            let at = |i: usize| of(component)[i * count + w];
            let column: f64 = (1..z.len()).map(|i| 0.5 * (z[i] - z[i - 1]) * (at(i - 1) + at(i))).sum();
            if column > thickest.0 {
                thickest = (column, &component.name, wavelength);
            }
        }
    }
    thickest
}

/// A field's light as means over all positions of the Sun, by wavelength.
type Means = [f64; LANES];

/// Error of the light on the ground, relative to it or to [`DARK`], as a mean over all positions of the Sun, that follows from the light which the field of `block` loses and wins, by wavelength: below 0 if
/// light is missing.
pub fn error_on_the_ground(block: &Block, grid: &Grid) -> Means {
    let (air, sunlight, field) = (&block.air, &block.sunlight, &block.field);
    let shares = shares_of_the_sphere(grid);
    let levels = grid.altitudes.nodes();
    let importance = Importance::new(air);
    let (flux, mean_radiance) =
        (means(field, grid, &shares, 1, -(4.0 * PI / 3.0).sqrt()), means(field, grid, &shares, 0, (4.0 * PI).sqrt()));
    let mut on_the_ground = [0.0; LANES];
    let mut error = [0.0; LANES];
    for (zenith, &share) in shares.iter().enumerate() {
        let direct = direct_ground_irradiance(air, sunlight, grid.sun[zenith].1);
        let magnitude = f64::from(field.ground_log_magnitudes[zenith]).exp();
        for n in 0..LANES {
            let (direct, diffuse) = (f64::from(direct[n]), f64::from(field.ground[zenith][n]) * magnitude);
            on_the_ground[n] += share * (direct + diffuse);
            // What flows up at the ground is what it reflects less what it receives.
            error[n] -= share * (f64::from(air.albedo[n]) * (direct + diffuse) - diffuse);
        }
    }
    for n in 0..LANES {
        error[n] = (error[n] + flux[0][n]) * importance.at(air.locate(0.0))[n];
    }
    for (k, ends) in levels.windows(2).enumerate() {
        let won = won_between(air, sunlight, grid, &shares, [ends[0], ends[1]], [&mean_radiance[k], &mean_radiance[k + 1]]);
        let [low, high] = [ends[0], ends[1]].map(|z| (1.0 + z / air.radius).powi(2));
        let weight = importance.at(air.locate(0.5 * (ends[0] + ends[1])));
        for n in 0..LANES {
            error[n] += (high * flux[k + 1][n] - low * flux[k][n] - won[n]) * weight[n];
        }
    }
    std::array::from_fn(|n| error[n] / on_the_ground[n].max(DARK))
}

/// What each solar zenith angle counts in a mean over the sphere, which is 1 where the integral of cosine x sine is: linear in the cosine between the angles.
fn shares_of_the_sphere(grid: &Grid) -> Vec<f64> {
    let cosines: Vec<f64> = grid.sun.iter().map(|&(_, cosine)| cosine).collect();
    let last = cosines.len() - 1;
    (0..=last).map(|i| 0.5 * (cosines[i.saturating_sub(1)] - cosines[(i + 1).min(last)])).collect()
}

/// Mean over the sphere of the moment with index `moment` times `factor`, by altitude level.
fn means(field: &Relative<LANES>, grid: &Grid, shares: &[f64], moment: usize, factor: f64) -> Vec<Means> {
    let (zeniths, count) = (grid.zeniths.len(), field.shape.count());
    (0..grid.altitudes.len())
        .map(|level| {
            let mut sum = [0.0; LANES];
            for (zenith, share) in shares.iter().enumerate() {
                let node = level * zeniths + zenith;
                let scale = share * factor * f64::from(field.log_magnitudes[node]).exp();
                for (sum, &value) in sum.iter_mut().zip(&field.values[node * count + moment]) {
                    *sum += scale * f64::from(value);
                }
            }
            sum
        })
        .collect()
}

/// Light that the air between two altitudes sends out once less what it absorbs of the field, relative to the area of the ground.
fn won_between(
    air: &Air<LANES>,
    sunlight: &Sunlight<LANES>,
    grid: &Grid,
    shares: &[f64],
    [low, high]: [f64; 2],
    mean_radiance: [&Means; 2],
) -> Means {
    let thickest = [low, 0.5 * (low + high), high].iter().flat_map(|&z| air.extinction(air.locate(z))).fold(0.0, f32::max);
    let points = (f64::from(thickest) * (high - low) * PER_OPTICAL_DEPTH).ceil();
    let points = (points as usize).clamp(FEWEST_POINTS, MOST_POINTS);
    let mut won = [0.0; LANES];
    for point in 0..points {
        let up = (point as f64 + 0.5) / points as f64;
        let z = low + up * (high - low);
        let weight = (high - low) / points as f64 * (1.0 + z / air.radius).powi(2);
        let (scattering, absorption) = coefficients(air, air.locate(z));
        let from_the_sun = sunlight.at(z);
        let mut lit = [0.0; LANES];
        for (&share, &(_, cosine)) in shares.iter().zip(&grid.sun) {
            if let Some(light) = from_the_sun.over_disc(cosine) {
                for n in 0..LANES {
                    lit[n] += share * f64::from(light[n]);
                }
            }
        }
        for n in 0..LANES {
            let absorbed = absorption[n] * ((1.0 - up) * mean_radiance[0][n] + up * mean_radiance[1][n]);
            won[n] += weight * (scattering[n] * lit[n] - absorbed);
        }
    }
    won
}

/// Scattering and absorption coefficient at a place [km-1].
fn coefficients(air: &Air<LANES>, place: (usize, f32)) -> (Means, Means) {
    let extinction = air.extinction(place);
    let mut scattering = [0.0; LANES];
    for scatterer in air.scatterers() {
        let coefficient = scatterer.coefficient(place);
        for n in 0..LANES {
            scattering[n] += f64::from(coefficient[n]);
        }
    }
    (scattering, std::array::from_fn(|n| (f64::from(extinction[n]) - scattering[n]).max(0.0)))
}

/// How much of a unit of light that is sent out to all sides at an altitude arrives at the ground, reflections by it counted each time.
struct Importance {
    /// By altitude of the profile.
    values: Vec<Means>,
}

impl Importance {
    fn new(air: &Air<LANES>) -> Self {
        let altitudes = air.altitudes();
        let count = altitudes.len();
        let mut absorbed = vec![[0.0; LANES]; count];
        let mut depth = vec![[0.0; LANES]; count - 1];
        let at = |i: usize| {
            let place = (i.min(count - 2), if i == count - 1 { 1.0 } else { 0.0 });
            let (_, absorption) = coefficients(air, place);
            let mut transport = absorption;
            for scatterer in air.scatterers() {
                let (coefficient, asymmetry) = (scatterer.coefficient(place), scatterer.asymmetry());
                for n in 0..LANES {
                    transport[n] += f64::from(coefficient[n] * (1.0 - asymmetry[n]));
                }
            }
            (absorption, transport)
        };
        let mut before = at(0);
        for i in 0..count - 1 {
            let next = at(i + 1);
            let half = 0.5 * (altitudes[i + 1] - altitudes[i]);
            for n in 0..LANES {
                depth[i][n] = (half * (before.1[n] + next.1[n])).max(1e-9);
                absorbed[i][n] += half * before.0[n];
                absorbed[i + 1][n] += half * next.0[n];
            }
            before = next;
        }
        let mut values = vec![[0.0; LANES]; count];
        for n in 0..LANES {
            let albedo = f64::from(air.albedo[n]);
            // Flux in units of pi: 4/3 of the difference over the optical depth between altitudes, 2 (1 - (1 - A) p) / (1 + A) from the lamp, 2 p out of the top; 4 times the absorption is lost.
            let coupling = |i: usize| 4.0 / 3.0 / depth[i][n];
            let mut diagonal: Vec<f64> = (0..count).map(|i| 4.0 * absorbed[i][n]).collect();
            for i in 0..count - 1 {
                diagonal[i] += coupling(i);
                diagonal[i + 1] += coupling(i);
            }
            diagonal[0] += 2.0 * (1.0 - albedo) / (1.0 + albedo);
            diagonal[count - 1] += 2.0;
            let mut right = vec![0.0; count];
            right[0] = 2.0 / (1.0 + albedo);
            for i in 1..count {
                let factor = coupling(i - 1) / diagonal[i - 1];
                diagonal[i] -= factor * coupling(i - 1);
                right[i] += factor * right[i - 1];
            }
            values[count - 1][n] = right[count - 1] / diagonal[count - 1];
            for i in (0..count - 1).rev() {
                values[i][n] = (right[i] + coupling(i) * values[i + 1][n]) / diagonal[i];
            }
        }
        Self { values }
    }

    fn at(&self, (interval, fraction): (usize, f32)) -> Means {
        let up = f64::from(fraction);
        std::array::from_fn(|n| (1.0 - up) * self.values[interval][n] + up * self.values[interval + 1][n])
    }
}
