//! The judge of the solver: an unbiased backward Monte Carlo path tracer of the same air. Slow, simple, scalar, one wavelength at
//! a time.
//!
//! It estimates the radiance L of the sky for a solar irradiance of 1 at the top of the atmosphere \[sr-1\]:
//!
//! L(x, w) = integral along the ray of exp(-tau(t)) J(x + t w, w) dt + exp(-tau(end)) G(end),
//! J(x, w) = sum over components c of sigma_c (1 / 4 pi) [ P_c(w.s) V(x, s) averaged over the disc + integral of P_c(w.w') L(x,
//! w') dw' ], G(x) = (albedo / pi) [ (n.s) V(x, s) averaged over the disc + integral of (n.w') L(x, w') dw' ],
//!
//! where w = direction away from the observer, sigma_c = scattering coefficient \[km-1\], P_c = phase function, tau = optical
//! depth of extinction, s = a direction of the Sun's disc, V = exp(-tau) to space or 0 behind the planet, n = local vertical
//! (Chandrasekhar 1950, I.7; Marchuk et al. 1980, ch. 2).
//!
//! Light scattered once is a plain integral and is computed by quadrature; all else is drawn: each path looks at the Sun at every
//! vertex (next event estimation), is kept inside the air where its ray would leave it (forced collision), weighs absorption
//! instead of dying of it and ends by Russian roulette. Distances and twilight directions are drawn from mixtures of the physical
//! density and one that seeks the light; dividing by the mixture keeps the estimate unbiased whatever is sought. Rays are
//! straight (no refraction); the Sun is a uniform disc, partly hidden by the planet at the terminator.

mod disc;
pub(super) mod sampling;
mod shells;

use crate::atmosphere::{OpticalProfile, Phase};
use crate::error::{Error, Result, check_range};
use disc::{Disc, gauss_legendre};
use glam::DVec3;
use rayon::prelude::*;
use sampling::{Random, around, lambertian, scattering_cosine};
use shells::{Chord, End, Shells};
use std::f64::consts::PI;

/// Paths that share a stream of random numbers and a thread; the result does not depend on the number of threads.
const PATHS_PER_CHUNK: usize = 256;

/// Paths play Russian roulette once their weight has fallen below this part of what it was after the first event,
const ROULETTE_SHARE: f64 = 0.2;

/// and not before this number of events.
const ROULETTE_EVENTS: usize = 3;

/// Longest step of the single scattering quadrature [km].
const SINGLE_SCATTERING_STEP_KM: f64 = 2.5;

/// Sun zenith angle above which a part of the directions is drawn towards the glow above the Sun [degrees].
const TWILIGHT_SUN_ZENITH_DEG: f64 = 85.0;

/// That part of the directions.
const GLOW_SHARE: f64 = 0.5;

/// Density of these directions about the glow, times 4 pi.
const GLOW: Phase = Phase::HenyeyGreenstein { asymmetry: 0.6 };

/// A Monte Carlo result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean over the paths.
    pub mean: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
}

/// A component that scatters.
struct Scatterer<'a> {
    phase: &'a Phase,
    /// Scattering coefficient at the altitudes of the profile [km-1].
    scattering: Vec<f64>,
}

/// A path tracer of one air at one wavelength.
pub struct PathTracer<'a> {
    shells: Shells,
    scatterers: Vec<Scatterer<'a>>,
    /// Extinction coefficient at the altitudes of the profile [km-1].
    extinction: Vec<f64>,
    ground_albedo: f64,
    sun_angular_radius_deg: f64,
    wavelength: usize,
}

/// The observer and the Sun, about the planet's centre: z through the observer, x towards the Sun's azimuth, lengths in km.
struct Scene {
    start: DVec3,
    view: DVec3,
    sun: Disc,
    is_twilight: bool,
}

impl<'a> PathTracer<'a> {
    /// Takes the optical properties of `profile` at one of its wavelengths.
    ///
    /// # Errors
    /// [`Error::Input`] if the profile is not valid or has no wavelength with that index.
    pub fn new(profile: &'a OpticalProfile, wavelength_index: usize) -> Result<Self> {
        profile.validate()?;
        let wavelengths = profile.wavelengths_nm.len();
        if wavelength_index >= wavelengths {
            return Err(Error::input("wavelength_index", wavelength_index, format!("less than {wavelengths}")));
        }
        let column =
            |values: &[f64]| -> Vec<f64> { values.iter().skip(wavelength_index).step_by(wavelengths).copied().collect() };
        let mut extinction = vec![0.0; profile.altitudes_km.len()];
        let mut scatterers = Vec::new();
        for component in &profile.components {
            let scattering = column(&component.scattering_per_km);
            for (i, absorption) in column(&component.absorption_per_km).into_iter().enumerate() {
                extinction[i] += absorption + scattering[i];
            }
            if let Some(phase) = &component.phase {
                scatterers.push(Scatterer { phase, scattering });
            }
        }
        Ok(Self {
            shells: Shells::new(profile.planet_radius_km, profile.altitudes_km.clone(), extinction.clone()),
            scatterers,
            extinction,
            ground_albedo: profile.ground_albedo[wavelength_index],
            sun_angular_radius_deg: profile.sun_angular_radius_deg,
            wavelength: wavelength_index,
        })
    }

    /// Radiance that arrives at the observer from direction `view` for a solar irradiance of 1 at the top of the atmosphere
    /// \[sr-1\], without the Sun's disc itself: [`Self::single_scattering`] plus [`Self::multiple_scattering`].
    ///
    /// # Errors
    /// Those of [`Self::multiple_scattering`].
    pub fn radiance(
        &self,
        observer_altitude_km: f64,
        sun_zenith_deg: f64,
        view: DVec3,
        samples: usize,
        seed: u64,
    ) -> Result<Estimate> {
        let multiple = self.multiple_scattering(observer_altitude_km, sun_zenith_deg, view, samples, seed)?;
        let single = self.single_scattering(observer_altitude_km, sun_zenith_deg, view)?;
        Ok(Estimate { mean: single + multiple.mean, ..multiple })
    }

    /// The part of the radiance that was scattered exactly once by the air and never by the ground, by quadrature (relative error
    /// about 1e-5).
    ///
    /// `observer_altitude_km` (0 to 1e6) counts from the ground, `sun_zenith_deg` (0 to 180) is the airless zenith angle of the
    /// Sun's centre at the observer, `view` is the direction of sight (unit vector; z up, x towards the Sun's azimuth).
    ///
    /// # Errors
    /// [`Error::Input`] for an altitude or angle out of range or a view that is not a unit vector.
    pub fn single_scattering(&self, observer_altitude_km: f64, sun_zenith_deg: f64, view: DVec3) -> Result<f64> {
        let Some(scene) = self.scene(observer_altitude_km, sun_zenith_deg, view)? else { return Ok(0.0) };
        let chord = self.chord(scene.start, scene.view);
        let (_, end) = self.shells.end(&chord);
        let mut cuts: Vec<f64> =
            self.shells.altitudes().iter().filter_map(|&z| chord.crossings(z)).flat_map(|(a, b)| [a, b]).collect();
        cuts.extend([0.0, -chord.radius * chord.cosine, end]);
        cuts.extend((1..).map(|i| i as f64 * SINGLE_SCATTERING_STEP_KM).take_while(|&t| t < end).take(100_000));
        cuts.retain(|t| (0.0..=end).contains(t));
        cuts.sort_by(f64::total_cmp);
        let (line, rows, columns) = (gauss_legendre(3), gauss_legendre(8), gauss_legendre(3));
        let pieces: Vec<f64> = cuts
            .par_windows(2)
            .map(|cut| {
                let half = 0.5 * (cut[1] - cut[0]);
                let source = |node: f64| {
                    let t = cut[0] + half * (1.0 + node);
                    let point = scene.start + scene.view * t;
                    let (layer, fraction) = self.shells.locate(chord.altitude_at(t));
                    let mut sum = 0.0;
                    let radius = point.length();
                    scene.sun.integrate(point / radius, radius, self.shells.planet_radius, (&rows, &columns), |sun, weight| {
                        sum += weight * self.phase_sum(layer, fraction, sun.dot(scene.view)) * self.sunlight(point, sun);
                    });
                    if sum > 0.0 { sum * (-self.shells.optical_depth(&chord, t)).exp() } else { 0.0 }
                };
                line.iter().map(|&(node, weight)| weight * half * source(node)).sum()
            })
            .collect();
        Ok(pieces.iter().sum::<f64>() / (4.0 * PI))
    }

    /// All light that [`Self::single_scattering`] leaves out: two or more scatterings in the air, and every reflection by the
    /// ground, also the one seen directly. The mean of `samples` paths (at least 2); equal arguments give equal results.
    ///
    /// # Errors
    /// Those of [`Self::single_scattering`], and [`Error::Input`] for fewer than 2 samples.
    pub fn multiple_scattering(
        &self,
        observer_altitude_km: f64,
        sun_zenith_deg: f64,
        view: DVec3,
        samples: usize,
        seed: u64,
    ) -> Result<Estimate> {
        if samples < 2 {
            return Err(Error::input("samples", samples, "at least 2"));
        }
        let Some(scene) = self.scene(observer_altitude_km, sun_zenith_deg, view)? else {
            return Ok(Estimate { mean: 0.0, standard_error: 0.0 });
        };
        let chunks: Vec<(f64, f64)> = (0..samples.div_ceil(PATHS_PER_CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let mut random = Random::new(seed, chunk as u64);
                let paths = PATHS_PER_CHUNK.min(samples - chunk * PATHS_PER_CHUNK);
                (0..paths).fold((0.0, 0.0), |(sum, squares), _| {
                    let value = self.path(&scene, &mut random);
                    (sum + value, squares + value * value)
                })
            })
            .collect();
        let (sum, squares) = chunks.iter().fold((0.0, 0.0), |(a, b), (c, d)| (a + c, b + d));
        let n = samples as f64;
        let mean = sum / n;
        let variance = ((squares / n - mean * mean) * n / (n - 1.0)).max(0.0);
        Ok(Estimate { mean, standard_error: (variance / n).sqrt() })
    }

    /// The value of one random path.
    fn path(&self, scene: &Scene, random: &mut Random) -> f64 {
        let (mut position, mut direction) = (scene.start, scene.view);
        let (mut weight, mut value) = (1.0, 0.0);
        let (mut events, mut roulette_weight) = (0, 0.0);
        loop {
            let chord = self.chord(position, direction);
            let (end, length) = self.shells.end(&chord);
            let collision = match end {
                End::Ground => {
                    let depth = -(1.0 - random.uniform()).ln();
                    self.shells.distance_at(&chord, depth, length)
                }
                End::Space => {
                    let Some((distance, ratio)) = self.collide(&chord, length, random) else { return value };
                    weight *= ratio;
                    Some(distance)
                }
            };
            let sun = scene.sun.sample(random);
            position += direction * collision.unwrap_or(length);
            if let Some(distance) = collision {
                let (layer, fraction) = self.shells.locate(chord.altitude_at(distance));
                weight /= interpolate(&self.extinction, layer, fraction);
                if events > 0 {
                    value +=
                        weight * self.phase_sum(layer, fraction, sun.dot(direction)) / (4.0 * PI) * self.sunlight(position, sun);
                }
                let Some((next, ratio)) = self.scatter(layer, fraction, position, direction, scene, random) else { return value };
                weight *= ratio;
                direction = next;
            } else {
                let up = position.normalize();
                position = up * self.shells.planet_radius;
                weight *= self.ground_albedo;
                value += weight / PI * sun.dot(up).max(0.0) * self.sunlight(position, sun);
                direction = lambertian(up, random);
            }
            events += 1;
            if weight <= 0.0 {
                return value;
            }
            if events == 1 {
                roulette_weight = ROULETTE_SHARE * weight;
            } else if events >= ROULETTE_EVENTS && weight < roulette_weight {
                if random.uniform() * roulette_weight >= weight {
                    return value;
                }
                weight = roulette_weight;
            }
        }
    }

    /// A random distance [km] at which a ray of `length` [km] that ends in space collides, and the density of collisions there,
    /// extinction times transmittance, over the density with which the distance was drawn. Half of the distances follow the
    /// collisions, half are uniform: in twilight the light comes from thin, high air. `None` without air.
    fn collide(&self, chord: &Chord, length: f64, random: &mut Random) -> Option<(f64, f64)> {
        let collided = -(-self.shells.optical_depth(chord, length)).exp_m1();
        if collided <= 0.0 {
            return None;
        }
        let distance = if random.uniform() < 0.5 {
            self.shells.distance_at(chord, -(-random.uniform() * collided).ln_1p(), length).unwrap_or(length)
        } else {
            length * random.uniform()
        };
        let (layer, fraction) = self.shells.locate(chord.altitude_at(distance));
        let extinction = interpolate(&self.extinction, layer, fraction);
        if extinction <= 0.0 {
            return None;
        }
        let density = extinction * (-self.shells.optical_depth(chord, distance)).exp();
        Some((distance, density / (0.5 * density / collided + 0.5 / length)))
    }

    /// A random direction from which light is scattered into `direction`, and scattering coefficient times phase function / 4 pi
    /// [km-1 sr-1] over the density with which it was drawn. Most directions follow the phase functions; the others gather about
    /// the point of the horizon below or above the Sun, from where most twilight comes. `None` where nothing scatters.
    fn scatter(
        &self,
        layer: usize,
        fraction: f64,
        position: DVec3,
        direction: DVec3,
        scene: &Scene,
        random: &mut Random,
    ) -> Option<(DVec3, f64)> {
        let total: f64 = self.scatterers.iter().map(|s| interpolate(&s.scattering, layer, fraction)).sum();
        if total <= 0.0 {
            return None;
        }
        let glow = scene.sun.centre().reject_from_normalized(position.normalize()).try_normalize().filter(|_| scene.is_twilight);
        let share = if glow.is_some() { GLOW_SHARE } else { 0.0 };
        let next = match glow {
            Some(glow) if random.uniform() < GLOW_SHARE => around(glow, scattering_cosine(&GLOW, 0, random), random),
            _ => {
                let mut left = random.uniform() * total;
                let chosen = self.scatterers.iter().find(|scatterer| {
                    left -= interpolate(&scatterer.scattering, layer, fraction);
                    left < 0.0
                });
                // Rounding can leave nothing chosen at the very end of the range.
                let phase = chosen.or(self.scatterers.first())?.phase;
                around(direction, scattering_cosine(phase, self.wavelength, random), random)
            }
        };
        let scattered = self.phase_sum(layer, fraction, next.dot(direction));
        let guided = glow.map_or(0.0, |glow| share * GLOW.value(0, next.dot(glow)));
        Some((next, scattered / ((1.0 - share) * scattered / total + guided)))
    }

    /// Sum over components of scattering coefficient times phase function [km-1] at a scattering angle with this cosine.
    fn phase_sum(&self, layer: usize, fraction: f64, cosine: f64) -> f64 {
        self.scatterers
            .iter()
            .map(|scatterer| interpolate(&scatterer.scattering, layer, fraction) * scatterer.phase.value(self.wavelength, cosine))
            .sum()
    }

    /// Fraction of the sunlight from direction `sun` that arrives at `point`: 0 behind the planet.
    fn sunlight(&self, point: DVec3, sun: DVec3) -> f64 {
        let chord = self.chord(point, sun);
        match self.shells.end(&chord) {
            (End::Ground, _) => 0.0,
            (End::Space, length) => (-self.shells.optical_depth(&chord, length)).exp(),
        }
    }

    fn chord(&self, point: DVec3, direction: DVec3) -> Chord {
        let radius = point.length().max(self.shells.planet_radius);
        Chord { altitude: radius - self.shells.planet_radius, radius, cosine: point.dot(direction) / radius }
    }

    /// Checks the input and moves an observer above the air to where the view enters it; `None` if it never does.
    fn scene(&self, observer_altitude_km: f64, sun_zenith_deg: f64, view: DVec3) -> Result<Option<Scene>> {
        check_range("observer_altitude_km", observer_altitude_km, 0.0, 1e6, "km")?;
        check_range("sun_zenith_deg", sun_zenith_deg, 0.0, 180.0, "degrees")?;
        if !view.is_normalized() {
            return Err(Error::input("view", view, "a unit vector"));
        }
        let (sine, cosine) = sun_zenith_deg.to_radians().sin_cos();
        let mut start = DVec3::Z * (self.shells.planet_radius + observer_altitude_km);
        if observer_altitude_km > self.shells.top() {
            match self.chord(start, view).crossings(self.shells.top()) {
                Some((way_in, _)) if way_in > 0.0 => start += view * way_in,
                _ => return Ok(None),
            }
        }
        let sun = Disc::new(DVec3::new(sine, 0.0, cosine), self.sun_angular_radius_deg);
        Ok(Some(Scene { start, view, sun, is_twilight: sun_zenith_deg > TWILIGHT_SUN_ZENITH_DEG }))
    }
}

fn interpolate(values: &[f64], layer: usize, fraction: f64) -> f64 {
    values[layer] * (1.0 - fraction) + values[layer + 1] * fraction
}

#[cfg(test)]
mod tests;
