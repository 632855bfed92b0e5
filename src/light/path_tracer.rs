//! The judge of the solver: an unbiased backward Monte Carlo path tracer of the same air. Slow, simple, one wavelength at a time.
//!
//! It estimates the Stokes vector L = (I, Q, U) of the sky for a solar irradiance of 1 at the top of the atmosphere \[sr-1\]; without
//! polarisation I alone:
//!
//! L(x, w) = integral along the ray of exp(-tau(t)) J(x + t w, w) dt + exp(-tau(end)) G(end),
//! J(x, w) = sum over components c of sigma_c (1 / 4 pi) [ P_c(w, s) V(x, s) averaged over the disc + integral of P_c(w, w') L(x,
//! w') dw' ], G(x) = (albedo / pi) [ (n.s) V(x, s) averaged over the disc + integral of (n.w') L(x, w') dw' ],
//!
//! where w = direction away from the observer, sigma_c = scattering coefficient \[km-1\], P_c = phase function or matrix, tau = optical
//! depth of extinction, s = a direction of the Sun's disc, V = exp(-tau) to space or 0 behind the planet, n = local vertical
//! (Chandrasekhar 1950, I.7 and I.16; Marchuk et al. 1980, ch. 2).
//!
//! With polarisation molecules scatter by the exact Rayleigh matrix with depolarisation; aerosol keeps its scalar phase function
//! and sends out unpolarised light, and so does the ground. That is the solver's approximation, made here too so that the two can be compared.
//!
//! Light scattered once is a plain integral and is computed by quadrature (`single`); all else is drawn (`walk`), in twilight with
//! a map of where the light is (`guide`). Random choices enter by their densities alone, so the estimate is unbiased whatever the map says. Rays are
//! straight (no refraction); the Sun is a uniform disc, partly hidden by the planet at the terminator.

mod angles;
mod disc;
mod guide;
mod medium;
pub(super) mod sampling;
mod shells;
mod single;
mod stokes;
mod walk;

use crate::atmosphere::OpticalProfile;
use crate::error::{Error, Result, check_range};
use crate::progress::Progress;
use disc::Disc;
use glam::DVec3;
use guide::Guide;
use medium::Medium;
use rayon::prelude::*;
use sampling::Random;
#[cfg(test)]
use std::f64::consts::PI;
use std::sync::OnceLock;
use stokes::Stokes;
use walk::{Scene, Walker};

/// Paths that share a stream of random numbers and a thread; the result does not depend on the number of threads.
const PATHS_PER_CHUNK: usize = 256;

/// Sun zenith angle above which paths are guided unless said otherwise [degrees].
const GUIDED_SUN_ZENITH_DEG: f64 = 85.0;

/// A Monte Carlo result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Mean over the paths.
    pub mean: f64,
    /// Standard error of the mean.
    pub standard_error: f64,
    /// The largest path's share of the variance, 0 to 1. Near 1 / paths all is well; above a few per cent the standard error
    /// hangs on few paths and is not to be believed.
    pub largest_share: f64,
}

impl Estimate {
    /// What is known exactly.
    const ZERO: Self = Self { mean: 0.0, standard_error: 0.0, largest_share: 0.0 };
}

/// When paths seek the light by a map of it made beforehand (about a second for each tracer).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Guiding {
    /// Where the Sun is low or down: zenith angle above 85 degrees.
    #[default]
    Automatic,
    /// Always.
    Always,
    /// Never: the plainest paths.
    Never,
}

/// A path tracer of one air at one wavelength.
pub struct PathTracer<'a> {
    medium: Medium<'a>,
    sun_angular_radius_deg: f64,
    guiding: Guiding,
    length_km: Option<f64>,
    guide: OnceLock<Guide>,
    progress: Progress<'a>,
}

impl<'a> PathTracer<'a> {
    /// Takes the optical properties of `profile` at one of its wavelengths.
    ///
    /// # Errors
    /// [`Error::Input`] if the profile is not valid or has no wavelength with that index.
    pub fn new(profile: &'a OpticalProfile, wavelength_index: usize) -> Result<Self> {
        Ok(Self {
            medium: Medium::new(profile, wavelength_index)?,
            sun_angular_radius_deg: profile.sun_angular_radius_deg,
            guiding: Guiding::Automatic,
            length_km: None,
            guide: OnceLock::new(),
            progress: Progress::silent(),
        })
    }

    /// Follows polarisation, or (the default) treats light as a scalar.
    pub fn with_polarisation(mut self, polarised: bool) -> Self {
        self.medium.polarised = polarised;
        self
    }

    /// Chooses when paths are guided. The expectation is the same, the noise is not.
    pub fn with_guiding(mut self, guiding: Guiding) -> Self {
        self.guiding = guiding;
        self
    }

    /// Only light that the air on the first `length_km` of the line of sight sends to the observer, whose last scattering is there; the ground is not seen, but lights the air.
    pub fn with_length_km(mut self, length_km: f64) -> Self {
        self.length_km = Some(length_km);
        self
    }

    /// Reports the stage "trace" to `progress` and stops when it says so.
    pub fn with_progress(mut self, progress: Progress<'a>) -> Self {
        self.progress = progress;
        self
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
        Ok(self.stokes(observer_altitude_km, sun_zenith_deg, view, samples, seed)?[0])
    }

    /// I, Q and U of the same light \[sr-1\]. Q > 0 is light that swings in the vertical plane of the view, U > 0 at 45 degrees to it: with e_th =
    /// (mu cos p, mu sin p, -s), e_ph = (-sin p, cos p, 0) for zenith cosine mu = sqrt(1 - s^2) and azimuth p of `view`, Q = C_tt - C_pp and U = 2
    /// C_tp of the coherency matrix C; at the zenith as for p = 0. Q and U are 0 without polarisation.
    ///
    /// # Errors
    /// Those of [`Self::multiple_scattering`].
    pub fn stokes(
        &self,
        observer_altitude_km: f64,
        sun_zenith_deg: f64,
        view: DVec3,
        samples: usize,
        seed: u64,
    ) -> Result<[Estimate; 3]> {
        let multiple = self.multiple_scattering_stokes(observer_altitude_km, sun_zenith_deg, view, samples, seed)?;
        let single = self.single_scattering_stokes(observer_altitude_km, sun_zenith_deg, view)?;
        Ok(std::array::from_fn(|i| Estimate { mean: single[i] + multiple[i].mean, ..multiple[i] }))
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
        Ok(self.single_scattering_stokes(observer_altitude_km, sun_zenith_deg, view)?[0])
    }

    /// I, Q and U of [`Self::single_scattering`].
    ///
    /// # Errors
    /// Those of [`Self::single_scattering`].
    pub fn single_scattering_stokes(&self, observer_altitude_km: f64, sun_zenith_deg: f64, view: DVec3) -> Result<[f64; 3]> {
        let scene = self.scene(observer_altitude_km, sun_zenith_deg, view)?;
        Ok(scene.map_or([0.0; 3], |scene| single::single_scattering(&self.medium, &scene)))
    }

    /// All light that [`Self::single_scattering`] leaves out: two or more scatterings in the air, and every reflection by the
    /// ground, also the one seen directly. The mean of `samples` paths (at least 2); equal arguments give equal results.
    ///
    /// # Errors
    /// Those of [`Self::single_scattering`], [`Error::Input`] for fewer than 2 samples, and [`Error::Cancelled`].
    pub fn multiple_scattering(
        &self,
        observer_altitude_km: f64,
        sun_zenith_deg: f64,
        view: DVec3,
        samples: usize,
        seed: u64,
    ) -> Result<Estimate> {
        Ok(self.multiple_scattering_stokes(observer_altitude_km, sun_zenith_deg, view, samples, seed)?[0])
    }

    /// I, Q and U of [`Self::multiple_scattering`].
    ///
    /// # Errors
    /// Those of [`Self::multiple_scattering`].
    pub fn multiple_scattering_stokes(
        &self,
        observer_altitude_km: f64,
        sun_zenith_deg: f64,
        view: DVec3,
        samples: usize,
        seed: u64,
    ) -> Result<[Estimate; 3]> {
        if samples < 2 {
            return Err(Error::input("samples", samples, "at least 2"));
        }
        let Some(scene) = self.scene(observer_altitude_km, sun_zenith_deg, view)? else { return Ok([Estimate::ZERO; 3]) };
        let guided = match self.guiding {
            Guiding::Automatic => sun_zenith_deg > GUIDED_SUN_ZENITH_DEG,
            Guiding::Always => true,
            Guiding::Never => false,
        };
        let guide = guided.then(|| self.guide.get_or_init(|| Guide::new(&self.medium)));
        let chunks = samples.div_ceil(PATHS_PER_CHUNK);
        let parts = self.progress.parts("trace", chunks);
        let sums: Vec<Sums> = (0..chunks)
            .into_par_iter()
            .map(|chunk| {
                let mut random = Random::new(seed, chunk as u64);
                let mut walker = Walker::new(&self.medium, &scene, guide);
                let mut sums = Sums::default();
                for _ in 0..PATHS_PER_CHUNK.min(samples - chunk * PATHS_PER_CHUNK) {
                    sums.add(walker.path(&mut random));
                }
                parts.finish_one()?;
                Ok(sums)
            })
            .collect::<Result<_>>()?;
        let all = sums.into_iter().fold(Sums::default(), Sums::plus);
        Ok(std::array::from_fn(|i| all.estimate(i, samples as f64)))
    }

    /// Checks the input and moves an observer above the air to where the view enters it; `None` if it never does.
    fn scene(&self, observer_altitude_km: f64, sun_zenith_deg: f64, view: DVec3) -> Result<Option<Scene>> {
        check_range("observer_altitude_km", observer_altitude_km, 0.0, 1e6, "km")?;
        check_range("sun_zenith_deg", sun_zenith_deg, 0.0, 180.0, "degrees")?;
        if !view.is_normalized() {
            return Err(Error::input("view", view, "a unit vector"));
        }
        let shells = &self.medium.shells;
        let (sine, cosine) = sun_zenith_deg.to_radians().sin_cos();
        let mut start = DVec3::Z * (shells.planet_radius + observer_altitude_km);
        let mut length = self.length_km;
        if observer_altitude_km > shells.top() {
            match self.medium.chord(start, view).crossings(shells.top()) {
                Some((way_in, _)) if way_in > 0.0 => {
                    start += view * way_in;
                    length = length.map(|length| (length - way_in).max(0.0));
                }
                _ => return Ok(None),
            }
        }
        let sun = Disc::new(DVec3::new(sine, 0.0, cosine), self.sun_angular_radius_deg);
        Ok(Some(Scene { start, view, sun, length }))
    }
}

/// Moments of the values of paths.
#[derive(Clone, Copy, Default)]
struct Sums {
    first: Stokes,
    second: Stokes,
    largest: Stokes,
}

impl Sums {
    fn add(&mut self, value: Stokes) {
        for i in 0..3 {
            self.first[i] += value[i];
            self.second[i] += value[i] * value[i];
            self.largest[i] = self.largest[i].max(value[i].abs());
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            first: std::array::from_fn(|i| self.first[i] + other.first[i]),
            second: std::array::from_fn(|i| self.second[i] + other.second[i]),
            largest: std::array::from_fn(|i| self.largest[i].max(other.largest[i])),
        }
    }

    fn estimate(&self, i: usize, n: f64) -> Estimate {
        let mean = self.first[i] / n;
        let variance = ((self.second[i] / n - mean * mean) * n / (n - 1.0)).max(0.0);
        let largest_share = if variance > 0.0 { ((self.largest[i] - mean.abs()).powi(2) / (variance * n)).min(1.0) } else { 0.0 };
        Estimate { mean, standard_error: (variance / n).sqrt(), largest_share }
    }
}

#[cfg(test)]
mod tests;
