//! What a surface receives, computed from the light field directly and not by way of a picture.

use super::sky_light::SkyLight;
use crate::error::{Result, check_finite};
use crate::light::{LightField, Observer};
use crate::numerics::gauss;
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
    /// By the Moon's disc on a surface that faces it.
    pub moon_normal: Vec<f64>,
    /// By the Moon's disc on the horizontal plane.
    pub moon_horizontal: Vec<f64>,
    /// By the sky, at night with stars and planets, on the horizontal plane.
    pub diffuse_horizontal: Vec<f64>,
    /// By all of them on the horizontal plane.
    pub global_horizontal: Vec<f64>,
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

/// How many circles of equal zenith angle, cosine = t^2 so that they crowd at the horizon, and azimuths on half the circle an integral has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nodes {
    pub circles: usize,
    pub azimuths: usize,
}

impl Nodes {
    /// Where each direction is gathered, or shows many layers.
    pub const FEW: Self = Self { circles: 32, azimuths: 60 };
    /// Where a direction costs nanoseconds: they resolve the aureole.
    pub const MANY: Self = Self { circles: 64, azimuths: 360 };

    /// Azimuths from the middle to the other side [radians].
    fn half_circle(self) -> impl Iterator<Item = f64> {
        (0..self.azimuths).map(move |a| (a as f64 + 0.5) * PI / self.azimuths as f64)
    }
}

/// Irradiance of the horizontal plane by the sky, per unit solar irradiance, by wavelength; `gain`: factor on the sky's light by the altitude [radians].
pub(super) fn diffuse_horizontal(
    field: &LightField,
    observer: &Observer,
    nodes: Nodes,
    gain: impl Fn(f64) -> f64 + Sync,
    progress: &Progress,
) -> Result<Vec<f64>> {
    let azimuths: Vec<f64> = nodes.half_circle().collect();
    let parts = progress.parts("gather", nodes.circles);
    let circles = gauss::legendre(nodes.circles)
        .into_par_iter()
        .map(|(t, weight)| {
            let mu = t * t;
            let gathered = field.gather(observer, mu, &azimuths);
            let mut sum = vec![0.0; gathered.wavelengths];
            let gain = gain(mu.asin());
            for (a, azimuth) in azimuths.iter().enumerate() {
                let cosine = mu * observer.sun_zenith.cos() + (1.0 - mu * mu).sqrt() * observer.sun_zenith.sin() * azimuth.cos();
                let share = gain * 2.0 * t * weight * mu * TAU / azimuths.len() as f64;
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

/// XYZ irradiance of the horizontal plane by `light` without its discs [W m-2], by azimuths on both sides of `azimuth` [radians]; `gain`: factor on what is smooth in it by the altitude
/// [radians].
pub(super) fn horizontal_irradiance(
    light: &dyn SkyLight,
    nodes: Nodes,
    azimuth: f64,
    gain: impl Fn(f64) -> f64 + Sync,
) -> [f64; 3] {
    let sides = [1.0, -1.0].into_iter();
    let azimuths: Vec<f64> = sides.flat_map(|side| nodes.half_circle().map(move |from| azimuth + side * from)).collect();
    let circle = |(t, weight): (f64, f64)| {
        let mu = t * t;
        let mut row = vec![[0.0_f32; 3]; azimuths.len()];
        light.radiance_circle(mu.asin(), &azimuths, &mut row);
        let share = gain(mu.asin()) * 2.0 * t * weight * mu * TAU / azimuths.len() as f64;
        row.iter().fold([0.0; 3], |sum, xyz| std::array::from_fn(|k| sum[k] + share * f64::from(xyz[k])))
    };
    let add = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| a[k] + b[k]);
    // In one order, so that the sum does not depend on the threads.
    let circles: Vec<[f64; 3]> = gauss::legendre(nodes.circles).into_par_iter().map(circle).collect();
    let smooth = circles.into_iter().fold([0.0; 3], add);
    light.points().iter().fold(smooth, |sum, point| add(sum, point.irradiance.map(|value| value * point.direction.z.max(0.0))))
}
