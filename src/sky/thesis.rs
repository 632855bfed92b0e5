//! The sky by the estimator of the thesis ([`Thesis`]), to compare the solved light with: noisy, slow, for small probes by day. As in the thesis there is no ground: black lies below the horizon.

use super::disc::{Disc, SOLAR_LIMB_DARKENING, Surface};
use super::place_and_time::Sky;
use super::sky_light::SkyLight;
use crate::error::{Error, Result};
use crate::light::{Thesis, ThesisOptions};
use crate::spectrum::{solar, wavelengths, xyz_weights};
use glam::DVec3;
use rayon::prelude::*;

/// Wavelengths of the estimator: a colour within 3 %, half the time of 16.
const THESIS_WAVELENGTHS: usize = 8;

/// The light of one Sun by the estimator.
pub struct ThesisSky {
    estimator: Thesis,
    /// Weights by wavelength that turn radiance per unit solar irradiance into XYZ.
    weights: Vec<[f64; 3]>,
    altitude_km: f64,
    horizon: f64,
    /// Unit vector (east, north, up).
    sun: DVec3,
    discs: Vec<Disc>,
}

/// This sky by the estimator of the thesis.
///
/// # Errors
/// [`Error::Input`] for air given as a profile, whose wavelengths may be too few to make a colour, and as [`Thesis::new`].
pub(super) fn thesis(sky: &Sky, options: ThesisOptions) -> Result<ThesisSky> {
    let Some(parameters) = sky.atmosphere().parameters() else {
        return Err(Error::input("model", "thesis", "scattering for air given as a profile"));
    };
    let profile = parameters.optical_profile(&wavelengths(THESIS_WAVELENGTHS))?;
    let nearness = sky.sun().distance_au.powi(-2);
    let weights = xyz_weights(&profile.wavelengths_nm, |wavelength| solar::irradiance(wavelength, 1.0));
    let weights: Vec<[f64; 3]> = weights.into_iter().map(|xyz| xyz.map(|weight| weight * nearness)).collect();
    let altitude_km = (sky.elevation_m() / 1000.0).max(0.0);
    let horizon = -(profile.planet_radius_km / (profile.planet_radius_km + altitude_km)).acos();
    let radius = (profile.sun_angular_radius_deg / sky.sun().distance_au).to_radians();
    let estimator = Thesis::new(profile, options)?;
    let (sun, seen) = (sky.sun().direction(), sky.sun().apparent_direction());
    let mut irradiance = [0.0; 3];
    for (w, weight) in weights.iter().enumerate() {
        let transmittance = estimator.transmittance(w, altitude_km, seen);
        (0..3).for_each(|k| irradiance[k] += transmittance * weight[k]);
    }
    let disc = Disc {
        is_sun: true,
        direction: seen,
        horizontal_radius: radius,
        vertical_radius: radius,
        irradiance,
        surface: Surface::LimbDarkened(SOLAR_LIMB_DARKENING),
    };
    let discs = if irradiance[1] > 0.0 { vec![disc] } else { Vec::new() };
    Ok(ThesisSky { estimator, weights, altitude_km, horizon, sun, discs })
}

impl SkyLight for ThesisSky {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        if altitude < self.horizon {
            out.fill([0.0; 3]);
            return;
        }
        let (sine, cosine) = altitude.sin_cos();
        out.par_iter_mut().zip(azimuths).for_each(|(out, azimuth)| {
            let view = DVec3::new(cosine * azimuth.sin(), cosine * azimuth.cos(), sine);
            // Each direction has its own random numbers, the same whoever asks and in whatever order.
            let seed = altitude.to_bits() ^ azimuth.to_bits().rotate_left(32);
            let mut xyz = [0.0; 3];
            for (w, weight) in self.weights.iter().enumerate() {
                let radiance = self.estimator.radiance(w, self.altitude_km, self.sun, view, seed);
                (0..3).for_each(|k| xyz[k] += radiance * weight[k]);
            }
            *out = xyz.map(|value| value.max(0.0) as f32);
        });
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        self.discs.clone()
    }
}
