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
//! The walk (`walk`) knows its medium by a trait alone (`medium::Medium`): where a ray ends, extinction and scattering at a place, transmittances, random distances and
//! angles. It is compiled for each medium. Today there are two: air of spherical shells (`air`), in which all but directions is exact, and such air with a
//! [`Field`] of density in it (`field`), such as clouds, by null collisions. To judge a new medium, implement the trait.
//!
//! In air of shells light scattered once is a plain integral and is computed by quadrature (`single`); all else is drawn, in twilight with
//! a map of where the light is (`guide`). With a field all is drawn, without a map. Random choices enter by their densities alone, so the estimate is unbiased whatever the map says. Rays are
//! straight (no refraction); the Sun is a uniform disc, partly hidden by the planet at the terminator.

mod air;
mod angles;
mod disc;
mod estimate;
mod field;
mod field_tracer;
mod guide;
mod medium;
mod pattern;
pub(super) mod sampling;
mod scene;
mod shells;
mod single;
mod stokes;
mod walk;

pub use estimate::Estimate;
pub use field::Field;
pub use field_tracer::FieldTracer;

use crate::atmosphere::OpticalProfile;
use crate::error::{Error, Result};
use crate::progress::Progress;
use air::Air;
use estimate::{check_samples, trace};
use field::AirWithField;
use glam::DVec3;
use guide::Guide;
use scene::{Scene, Sight};
#[cfg(test)]
use std::f64::consts::PI;
use std::sync::OnceLock;

/// Sun zenith angle above which paths are guided unless said otherwise [degrees].
const GUIDED_SUN_ZENITH_DEG: f64 = 85.0;

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
    air: Air<'a>,
    sight: Sight,
    guiding: Guiding,
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
            air: Air::new(profile, wavelength_index)?,
            sight: Sight { sun_angular_radius_deg: profile.sun_angular_radius_deg, length_km: None },
            guiding: Guiding::Automatic,
            guide: OnceLock::new(),
            progress: Progress::silent(),
        })
    }

    /// Follows polarisation, or (the default) treats light as a scalar.
    pub fn with_polarisation(mut self, polarised: bool) -> Self {
        self.air.polarised = polarised;
        self
    }

    /// Chooses when paths are guided. The expectation is the same, the noise is not.
    pub fn with_guiding(mut self, guiding: Guiding) -> Self {
        self.guiding = guiding;
        self
    }

    /// Only light that the air on the first `length_km` of the line of sight sends to the observer, whose last scattering is there; the ground is not seen, but lights the air.
    pub fn with_length_km(mut self, length_km: f64) -> Self {
        self.sight.length_km = Some(length_km);
        self
    }

    /// Adds a field of density to the air, such as clouds; `field` says what it is. All that was asked for stays; call this last.
    ///
    /// # Errors
    /// [`Error::Input`] for bounds, a majorant, an albedo or a phase function that [`Field`] does not allow, and for [`Guiding::Always`]: there is no map of the light
    /// in such air.
    pub fn with_field<F: Field + ?Sized>(self, field: &'a F) -> Result<FieldTracer<'a, F>> {
        if self.guiding == Guiding::Always {
            return Err(Error::input("guiding", "always", "automatic or never with a field"));
        }
        Ok(FieldTracer::new(AirWithField::new(self.air, field)?, self.sight, self.progress))
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
        let scene = Scene::new(&self.air, self.sight, observer_altitude_km, sun_zenith_deg, view)?;
        Ok(scene.map_or([0.0; 3], |scene| single::single_scattering(&self.air, &scene)))
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
        check_samples(samples)?;
        let Some(scene) = Scene::new(&self.air, self.sight, observer_altitude_km, sun_zenith_deg, view)? else {
            return Ok([Estimate::ZERO; 3]);
        };
        let guided = match self.guiding {
            Guiding::Automatic => sun_zenith_deg > GUIDED_SUN_ZENITH_DEG,
            Guiding::Always => true,
            Guiding::Never => false,
        };
        let guide = guided.then(|| self.guide.get_or_init(|| Guide::new(&self.air)));
        trace(&self.air, &scene, guide, (samples, seed), &self.progress)
    }
}

#[cfg(test)]
mod tests;
