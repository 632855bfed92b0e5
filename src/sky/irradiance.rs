//! What a surface receives, computed from the light field directly and not by way of a picture.

use super::SkyLight;
use crate::error::{Result, check_finite};
use crate::light::{LightField, Observer, gauss};
use crate::progress::Progress;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Spectral irradiance [W m-2 nm-1] by wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Irradiance {
    /// By the Sun's disc, at a total eclipse by its corona, on a surface that faces it.
    pub direct_normal: Vec<f64>,
    /// By the same on the horizontal plane.
    pub direct_horizontal: Vec<f64>,
    /// By the sky on the horizontal plane.
    pub diffuse_horizontal: Vec<f64>,
}

/// Illuminance [lx].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illuminance {
    /// By the Sun's disc, at a total eclipse by its corona, on a surface that faces it.
    pub direct_normal_lx: f64,
    /// By the same on the horizontal plane.
    pub direct_horizontal_lx: f64,
    /// By the Moon's disc on a surface that faces it.
    pub moon_normal_lx: f64,
    /// By the Moon's disc on the horizontal plane.
    pub moon_horizontal_lx: f64,
    /// By the sky with stars and planets on the horizontal plane.
    pub diffuse_horizontal_lx: f64,
    /// By all of them on the horizontal plane.
    pub global_horizontal_lx: f64,
}

/// View zenith angles of the quadrature: cosine = t^2, so that they crowd at the horizon.
const CIRCLES: usize = 32;
/// Azimuths on half the circle.
const AZIMUTHS: usize = 60;

/// Irradiance of the horizontal plane by the sky, per unit solar irradiance, by wavelength; `gain`: factor on the sky's light by the altitude [radians].
pub(super) fn diffuse_horizontal(
    field: &LightField,
    observer: &Observer,
    gain: impl Fn(f64) -> f64 + Sync,
    progress: &Progress,
) -> Result<Vec<f64>> {
    let azimuths: Vec<f64> = (0..AZIMUTHS).map(|a| (a as f64 + 0.5) * PI / AZIMUTHS as f64).collect();
    let parts = progress.parts("gather", CIRCLES);
    let circles = gauss::legendre(CIRCLES)
        .into_par_iter()
        .map(|(t, weight)| {
            let mu = t * t;
            let gathered = field.gather(observer, mu, &azimuths);
            let mut sum = vec![0.0; gathered.wavelengths];
            let gain = gain(mu.asin());
            for (a, azimuth) in azimuths.iter().enumerate() {
                let cosine = mu * observer.sun_zenith.cos() + (1.0 - mu * mu).sqrt() * observer.sun_zenith.sin() * azimuth.cos();
                let share = gain * 2.0 * t * weight * mu * TAU / AZIMUTHS as f64;
                for (w, total) in sum.iter_mut().enumerate() {
                    *total += share * field.radiance(&gathered, a, w, cosine);
                }
            }
            parts.finish_one()?;
            Ok(sum)
        })
        .collect::<Result<Vec<_>>>()?;
    let sums: Vec<f64> = (0..circles[0].len()).map(|w| circles.iter().map(|circle| circle[w]).sum()).collect();
    check_finite("the irradiance by the sky", &sums)?;
    Ok(sums)
}

/// XYZ irradiance of the horizontal plane by `light` without its discs [W m-2]; `gain`: factor on what is smooth in it by the altitude [radians].
pub(super) fn horizontal_irradiance(light: &dyn SkyLight, gain: impl Fn(f64) -> f64 + Sync) -> [f64; 3] {
    let azimuths: Vec<f64> = (0..2 * AZIMUTHS).map(|a| (a as f64 + 0.5) * PI / AZIMUTHS as f64).collect();
    let circle = |(t, weight): (f64, f64)| {
        let mu = t * t;
        let mut row = vec![[0.0_f32; 3]; azimuths.len()];
        light.radiance_circle(mu.asin(), &azimuths, &mut row);
        let share = gain(mu.asin()) * 2.0 * t * weight * mu * TAU / azimuths.len() as f64;
        row.iter().fold([0.0; 3], |sum, xyz| std::array::from_fn(|k| sum[k] + share * f64::from(xyz[k])))
    };
    let add = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| a[k] + b[k]);
    let smooth = gauss::legendre(CIRCLES).into_par_iter().map(circle).reduce(|| [0.0; 3], add);
    light.points().iter().fold(smooth, |sum, point| add(sum, point.irradiance.map(|value| value * point.direction.z.max(0.0))))
}
