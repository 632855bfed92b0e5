//! What a surface receives, computed from the light field directly and not by way of a picture.

use crate::error::Result;
use crate::light::{LightField, Observer, gauss};
use crate::progress::Progress;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Spectral irradiance [W m-2 nm-1] by wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Irradiance {
    /// By the Sun's disc on a surface that faces it.
    pub direct_normal: Vec<f64>,
    /// By the Sun's disc on the horizontal plane.
    pub direct_horizontal: Vec<f64>,
    /// By the sky on the horizontal plane.
    pub diffuse_horizontal: Vec<f64>,
}

/// Illuminance [lx].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illuminance {
    /// By the Sun's disc on a surface that faces it.
    pub direct_normal_lx: f64,
    /// By the Sun's disc on the horizontal plane.
    pub direct_horizontal_lx: f64,
    /// By the sky on the horizontal plane.
    pub diffuse_horizontal_lx: f64,
    /// By both.
    pub global_horizontal_lx: f64,
}

/// View zenith angles of the quadrature: cosine = t^2, so that they crowd at the horizon.
const CIRCLES: usize = 32;
/// Azimuths on half the circle.
const AZIMUTHS: usize = 60;

/// Irradiance of the horizontal plane by the sky, per unit solar irradiance, by wavelength.
pub(super) fn diffuse_horizontal(field: &LightField, observer: &Observer, progress: &Progress) -> Result<Vec<f64>> {
    let azimuths: Vec<f64> = (0..AZIMUTHS).map(|a| (a as f64 + 0.5) * PI / AZIMUTHS as f64).collect();
    let parts = progress.parts("gather", CIRCLES);
    let circles = gauss::legendre(CIRCLES)
        .into_par_iter()
        .map(|(t, weight)| {
            let mu = t * t;
            let gathered = field.gather(observer, mu, &azimuths);
            let mut sum = vec![0.0; gathered.wavelengths];
            for (a, azimuth) in azimuths.iter().enumerate() {
                let cosine = mu * observer.sun_zenith.cos() + (1.0 - mu * mu).sqrt() * observer.sun_zenith.sin() * azimuth.cos();
                let share = 2.0 * t * weight * mu * TAU / AZIMUTHS as f64;
                for (w, total) in sum.iter_mut().enumerate() {
                    *total += share * field.radiance(&gathered, a, w, cosine);
                }
            }
            parts.finish_one()?;
            Ok(sum)
        })
        .collect::<Result<Vec<_>>>()?;
    Ok((0..circles[0].len()).map(|w| circles.iter().map(|circle| circle[w]).sum()).collect())
}
