//! Diffuse light of the night through the air.
//!
//! A component is a sum of scalars s times fixed spectra F ([`crate::celestial::DiffuseLight`]). Light from above the air arrives as
//! ```text
//! L = s F T + (1 - T) w F (S + A E) / 2,       S, H = means of s over the sky by solid angle and weighted with the cosine,
//! E = H (T_d + R) / (1 - A R),                 R = w (1 - T_d) / 2,
//! ```
//! with T the transmittance of the ray (forward peaks count as transmitted), w the vertical single scattering albedo of the air, A the albedo of the ground, T_d the transmittance to
//! diffuse light and pi E F the irradiance of the ground: what is scattered into the ray comes from a sky of mean brightness above and a lit ground below, and is scattered once and alike into
//! all directions; R is what the air sends back.
//! That keeps most of the light that extinction alone would lose, as Leinert et al. (1998) have it: diffuse light is dimmed by less than a star, here by about three quarters of the optical depth.
//! Of even light conservative air of optical depth 0.1, 0.2, 0.5 lets through 0.916, 0.852, 0.722, where the exact values are 0.916, 0.849, 0.704.

use super::super::disc::Disc;
use super::super::sky_light::SkyLight;
use crate::atmosphere::OpticalProfile;
use crate::celestial::DiffuseLight;
use crate::light::LightField;
use crate::spectrum::Sensor;
use glam::{DMat3, DVec3};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// Altitudes of the tables on each side of the horizon, evenly in the square root of the share of the way from it.
const ALTITUDES: usize = 48;

/// Air mass at which light from the whole sky is dimmed (Elsasser's diffusivity factor).
const DIFFUSE_AIR_MASS: f64 = 1.66;

/// Circles and azimuths of the means over the sky.
const MEANS: (usize, usize) = (24, 48);

/// What the air does to diffuse light, by wavelength.
pub(super) struct DiffuseAir {
    horizon: f64,
    /// Transmittance to space above, to the ground below the horizon: (side, altitude, wavelength).
    transmittance: [Vec<Vec<f64>>; 2],
    scattering_share: Vec<f64>,
    diffuse_transmittance: Vec<f64>,
    albedo: Vec<f64>,
}

impl DiffuseAir {
    /// The air of `profile`, whose light is `field`, over an observer at `altitude_km` with the horizon at `horizon` [radians].
    pub fn new(field: &LightField, profile: &OpticalProfile, altitude_km: f64, horizon: f64) -> Self {
        let sides = [FRAC_PI_2 - horizon, -FRAC_PI_2 - horizon];
        let transmittance = sides.map(|way| {
            let at = |i: usize| {
                let position = i as f64 / (ALTITUDES - 1) as f64;
                // A hair inside each side, so that the ray along the horizon is on the side it belongs to.
                let altitude = horizon + way * (position * position).max(1e-7);
                field.ray_transmittance(altitude_km, altitude.sin())
            };
            (0..ALTITUDES).map(at).collect()
        });
        let (scattering, extinction) = vertical_optical_depths(profile, altitude_km);
        Self {
            horizon,
            transmittance,
            scattering_share: scattering.iter().zip(&extinction).map(|(s, e)| if *e > 0.0 { s / e } else { 0.0 }).collect(),
            diffuse_transmittance: extinction.iter().map(|depth| (-DIFFUSE_AIR_MASS * 0.75 * depth).exp()).collect(),
            albedo: profile.ground_albedo.clone(),
        }
    }
}

/// Scattering and extinction optical depth above `altitude_km`, by wavelength.
fn vertical_optical_depths(profile: &OpticalProfile, altitude_km: f64) -> (Vec<f64>, Vec<f64>) {
    let count = profile.wavelengths_nm.len();
    let (mut scattering, mut extinction) = (vec![0.0; count], vec![0.0; count]);
    for (level, ends) in profile.altitudes_km.windows(2).enumerate() {
        let thickness = (ends[1] - ends[0].max(altitude_km)).max(0.0);
        for component in &profile.components {
            for w in 0..count {
                let mean = |values: &[f64]| 0.5 * (values[level * count + w] + values[(level + 1) * count + w]) * thickness;
                let scattered = mean(&component.scattering_per_km);
                scattering[w] += scattered;
                extinction[w] += scattered + mean(&component.absorption_per_km);
            }
        }
    }
    (scattering, extinction)
}

/// Responses of the sensor per unit of each scalar, and what comes whatever the direction.
#[derive(Clone, Copy)]
struct AtAltitude<const N: usize> {
    seen: [[f32; 3]; N],
    scattered: [f32; 3],
}

/// One component of diffuse light as the observer sees it.
pub(super) struct DiffuseSky<D, const N: usize> {
    light: D,
    /// From east, north, up to the frame of the component.
    to_frame: DMat3,
    horizon: f64,
    /// Whether the light depends on the altitude alone.
    round: bool,
    /// By side and altitude.
    tables: Arc<[Vec<AtAltitude<N>>; 2]>,
}

impl<D: DiffuseLight<N> + Sync, const N: usize> DiffuseSky<D, N> {
    /// Light that comes from above the air, in the responses of `sensor`.
    pub fn above(light: D, to_frame: DMat3, air: &DiffuseAir, sensor: &Sensor) -> Self {
        Self::new(light, to_frame, air, sensor, true)
    }

    /// Light that comes from above the air and depends on the altitude alone; x east, y north, z up.
    pub fn round_above(light: D, air: &DiffuseAir, sensor: &Sensor) -> Self {
        Self { round: true, ..Self::new(light, DMat3::IDENTITY, air, sensor, true) }
    }

    /// Light that is made in the air, as it arrives, and depends on the altitude alone; x east, y north, z up.
    pub fn round_within(light: D, air: &DiffuseAir, sensor: &Sensor) -> Self {
        Self { round: true, ..Self::new(light, DMat3::IDENTITY, air, sensor, false) }
    }

    fn new(light: D, to_frame: DMat3, air: &DiffuseAir, sensor: &Sensor, above: bool) -> Self {
        let weights = light.spectra(sensor.nanometres()).each_ref().map(|spectrum| sensor.of_means(spectrum));
        let (means, upward_means) = hemisphere_means(&light, to_frame);
        let table = |side: usize| -> Vec<AtAltitude<N>> {
            air.transmittance[side]
                .iter()
                .map(|transmittance| at_altitude(air, side == 0, above, transmittance, &weights, (&means, &upward_means)))
                .collect()
        };
        Self { tables: Arc::new([table(0), table(1)]), light, to_frame, horizon: air.horizon, round: false }
    }
}

fn at_altitude<const N: usize>(
    air: &DiffuseAir,
    sky: bool,
    above: bool,
    transmittance: &[f64],
    weights: &[Vec<[f64; 3]>; N],
    (means, upward_means): (&[f64; N], &[f64; N]),
) -> AtAltitude<N> {
    let (mut seen, mut scattered) = ([[0.0; 3]; N], [0.0; 3]);
    for part in 0..N {
        for (w, weight) in weights[part].iter().enumerate() {
            let (t, share, diffuse, albedo) =
                (transmittance[w], air.scattering_share[w], air.diffuse_transmittance[w], air.albedo[w]);
            let sent_back = 0.5 * share * (1.0 - diffuse);
            let lit = upward_means[part] * (diffuse + sent_back) / (1.0 - albedo * sent_back);
            let source = 0.5 * share * (means[part] + albedo * lit);
            let (direct, added) = match (sky, above) {
                (true, true) => (t, (1.0 - t) * source),
                (true, false) => (1.0, 0.0),
                (false, true) => (0.0, albedo * lit * t + (1.0 - t) * source),
                (false, false) => (0.0, albedo * upward_means[part] * t + (1.0 - t) * means[part]),
            };
            for k in 0..3 {
                seen[part][k] += direct * weight[k];
                scattered[k] += added * weight[k];
            }
        }
    }
    AtAltitude { seen: seen.map(|xyz| xyz.map(|v| v as f32)), scattered: scattered.map(|v| v as f32) }
}

/// Means of each scalar over the sky above the horizontal plane, by solid angle and weighted with the cosine of the zenith angle.
fn hemisphere_means<D: DiffuseLight<N>, const N: usize>(light: &D, to_frame: DMat3) -> ([f64; N], [f64; N]) {
    let (circles, azimuths) = MEANS;
    let (mut means, mut upward) = ([0.0; N], [0.0; N]);
    for i in 0..circles {
        let z = (i as f64 + 0.5) / circles as f64;
        for j in 0..azimuths {
            let azimuth = TAU * j as f64 / azimuths as f64;
            let scalars = light.scalars(to_frame * direction(z, azimuth));
            for part in 0..N {
                means[part] += scalars[part] / (circles * azimuths) as f64;
                upward[part] += 2.0 * z * scalars[part] / (circles * azimuths) as f64;
            }
        }
    }
    (means, upward)
}

fn direction(z: f64, azimuth: f64) -> DVec3 {
    let s = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = azimuth.sin_cos();
    DVec3::new(s * sin, s * cos, z)
}

impl<D: DiffuseLight<N> + Sync, const N: usize> SkyLight for DiffuseSky<D, N> {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        let sky = altitude >= self.horizon;
        let way = if sky { FRAC_PI_2 - self.horizon } else { -FRAC_PI_2 - self.horizon };
        let position = ((altitude - self.horizon) / way).clamp(0.0, 1.0).sqrt() * (ALTITUDES - 1) as f64;
        let node = (position as usize).min(ALTITUDES - 2);
        let fraction = (position - node as f64) as f32;
        let table = &self.tables[usize::from(!sky)];
        let mix = |a: [f32; 3], b: [f32; 3]| -> [f32; 3] { std::array::from_fn(|k| a[k] + fraction * (b[k] - a[k])) };
        let scattered = mix(table[node].scattered, table[node + 1].scattered);
        if !sky {
            return out.fill(scattered);
        }
        let seen: [[f32; 3]; N] = std::array::from_fn(|part| mix(table[node].seen[part], table[node + 1].seen[part]));
        let z = altitude.sin();
        let light = |azimuth: f64| {
            let mut sum = scattered;
            for (scalar, seen) in self.light.scalars(self.to_frame * direction(z, azimuth)).iter().zip(&seen) {
                for k in 0..3 {
                    sum[k] += *scalar as f32 * seen[k];
                }
            }
            sum
        };
        if self.round {
            return out.fill(light(0.0));
        }
        out.iter_mut().zip(azimuths).for_each(|(out, &azimuth)| *out = light(azimuth));
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        Vec::new()
    }
}

#[cfg(test)]
mod tests;
