//! The path tracer of air with a field of density in it.

use super::estimate::{Estimate, check_samples, trace};
use super::field::{AirWithField, Field};
use super::scene::{Scene, Sight};
use crate::error::Result;
use crate::progress::Progress;
use glam::DVec3;

/// A path tracer of one air with a [`Field`] in it, at one wavelength; made by [`super::PathTracer::with_field`].
///
/// All light is drawn, that scattered once too, and paths are never guided. Where the Sun is low or down, or where a field sharply peaked in its scattering hides the
/// Sun, that takes many paths: [`Estimate::standard_error`] and [`Estimate::largest_share`] tell.
pub struct FieldTracer<'a, F: Field + ?Sized> {
    medium: AirWithField<'a, F>,
    sight: Sight,
    progress: Progress<'a>,
}

impl<'a, F: Field + ?Sized> FieldTracer<'a, F> {
    pub(super) fn new(medium: AirWithField<'a, F>, sight: Sight, progress: Progress<'a>) -> Self {
        Self { medium, sight, progress }
    }

    /// Radiance that arrives at the observer from direction `view` for a solar irradiance of 1 at the top of the atmosphere \[sr-1\], without the Sun's disc
    /// itself: the mean of `samples` paths (at least 2); equal arguments give equal results on any number of threads.
    ///
    /// `observer_altitude_km` (0 to 1e6) counts from the ground, `sun_zenith_deg` (0 to 180) is the airless zenith angle of the
    /// Sun's centre at the observer, `view` is the direction of sight (unit vector; z up, x towards the Sun's azimuth).
    ///
    /// # Errors
    /// [`crate::Error::Input`] for an altitude or angle out of range, a view that is not a unit vector, fewer than 2 samples, or an extinction of the field that is
    /// negative, not a number or above its majorant; [`crate::Error::Cancelled`].
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

    /// I, Q and U of the same light \[sr-1\], as [`super::PathTracer::stokes`].
    ///
    /// # Errors
    /// Those of [`Self::radiance`].
    pub fn stokes(
        &self,
        observer_altitude_km: f64,
        sun_zenith_deg: f64,
        view: DVec3,
        samples: usize,
        seed: u64,
    ) -> Result<[Estimate; 3]> {
        check_samples(samples)?;
        let Some(scene) = Scene::new(&self.medium, self.sight, observer_altitude_km, sun_zenith_deg, view)? else {
            return Ok([Estimate::ZERO; 3]);
        };
        let found = trace(&self.medium, &scene, None, (samples, seed), &self.progress)?;
        self.medium.check()?;
        Ok(found)
    }
}
