//! How much of the Sun's light arrives at a place in the air: transmittance averaged over the part of the disc that is above the horizon.
//!
//! The optical depth to space of rays that rise, tau(z, mu >= 0), is tabulated. A ray that first sinks passes its lowest point z_t
//! and follows from the same table: tau = 2 tau(z_t, 0) - tau(z, |mu|). Near the horizon, where transmittance changes over the width of the disc
//! and the ground hides a part of it, the disc (uniform) is integrated in horizontal strips.

use super::air::Air;
use super::axis::Axis;
use super::gauss;
use super::lanes::{Lanes, add_scaled, exp, exp_minus, splat};
use super::ray::{Ray, StepLimits};
use crate::units::EARTH_RADIUS_KM;

/// Altitude levels of the table.
const LEVELS: usize = 112;
/// Zenith cosines of the table; cosine = (i / (n - 1))^2.
const COSINES: usize = 80;

/// Table of the optical depth towards space for one block of wavelengths.
pub struct Sunlight<const N: usize> {
    altitudes: Axis,
    /// ln of the optical depth, (altitude, cosine).
    log_depth: Vec<Lanes<N>>,
    radius: f64,
    top: f64,
    sun_radius: f64,
    /// Quadrature over the strips of the disc, on 0..1.
    strips: Vec<(f64, f64)>,
}

impl<const N: usize> Sunlight<N> {
    /// Tabulates the optical depths of `air`.
    pub fn new(air: &Air<N>) -> Self {
        let top = air.top;
        let altitudes = Axis::new((0..LEVELS).map(|i| top * (i as f64 / (LEVELS - 1) as f64).powf(2.4)).collect());
        let shells = Axis::new((0..=40).map(|i| top * (f64::from(i) / 40.0).powf(2.2)).collect());
        let limits = StepLimits { length_km: 25.0 * air.radius / EARTH_RADIUS_KM, optical_depth: f32::INFINITY };
        let mut log_depth = Vec::with_capacity(LEVELS * COSINES);
        for &z in altitudes.nodes() {
            for c in 0..COSINES {
                let mu = (c as f64 / (COSINES - 1) as f64).powi(2);
                let depth = Ray::optical_depth(air, &shells, z, mu, limits);
                log_depth.push(depth.map(|d| d.max(1e-12).ln()));
            }
        }
        Self { altitudes, log_depth, radius: air.radius, top, sun_radius: air.sun_radius, strips: gauss::legendre(5) }
    }

    /// Optical depth from altitude `z` [km] to space along a ray that rises with zenith cosine `mu >= 0`.
    #[inline(always)]
    fn rising_depth(&self, z: f64, mu: f64) -> Lanes<N> {
        let (level, up) = self.altitudes.locate(z);
        let position = (mu.max(0.0).sqrt() * (COSINES - 1) as f64).min((COSINES - 1) as f64);
        let column = (position as usize).min(COSINES - 2);
        let across = (position - column as f64) as f32;
        let base = level * COSINES + column;
        let corners = [
            (&self.log_depth[base], (1.0 - up) * (1.0 - across)),
            (&self.log_depth[base + 1], (1.0 - up) * across),
            (&self.log_depth[base + COSINES], up * (1.0 - across)),
            (&self.log_depth[base + COSINES + 1], up * across),
        ];
        let mut log = splat(0.0);
        for (value, weight) in corners {
            add_scaled(&mut log, weight, value);
        }
        exp(&log)
    }

    /// Transmittance from altitude `z` [km] to space towards zenith cosine `mu`; `None` if the ground is in the way.
    #[inline(always)]
    pub fn transmittance(&self, z: f64, mu: f64) -> Option<Lanes<N>> {
        if z >= self.top && mu >= 0.0 {
            return Some(splat(1.0));
        }
        if mu >= 0.0 {
            return Some(exp_minus(&self.rising_depth(z, mu)));
        }
        // r (1 - sin) without cancellation.
        let lowest = z - (self.radius + z) * mu * mu / (1.0 + (1.0 - mu * mu).max(0.0).sqrt());
        if lowest < 0.0 {
            return None;
        }
        if lowest >= self.top {
            return Some(splat(1.0));
        }
        let whole = self.rising_depth(lowest, 0.0);
        let behind = if z >= self.top { splat(0.0) } else { self.rising_depth(z, -mu) };
        let mut depth = whole;
        for n in 0..N {
            depth[n] = 2.0 * whole[n] - behind[n];
        }
        Some(exp_minus(&depth))
    }

    /// Mean transmittance over the Sun's whole disc (hidden parts count as 0) at altitude `z` [km] for the cosine of
    /// the solar zenith angle `mu`; `None` when the disc is hidden entirely.
    #[inline(always)]
    pub fn over_disc(&self, z: f64, mu: f64) -> Option<Lanes<N>> {
        let ratio = self.radius / (self.radius + z);
        let horizon = -(1.0 - ratio * ratio).max(0.0).sqrt();
        // Cosines differ by nearly the angle near the horizon. Sixteen radii above it the transmittance of the centre is that of the disc within 0.3 %.
        if mu > horizon + 16.0 * self.sun_radius {
            return self.transmittance(z, mu);
        }
        if mu < horizon - 1.5 * self.sun_radius {
            return None;
        }
        self.over_strips(z, mu, horizon)
    }

    #[cold]
    fn over_strips(&self, z: f64, mu: f64, horizon: f64) -> Option<Lanes<N>> {
        let above = horizon.acos() - mu.acos();
        if above <= -self.sun_radius {
            return None;
        }
        // Height over the centre = radius sin t; a strip's share of the disc is cos^2 t dt / (pi / 2).
        let lowest = if above < self.sun_radius { (-above / self.sun_radius).asin() } else { -std::f64::consts::FRAC_PI_2 };
        let height = std::f64::consts::FRAC_PI_2 - lowest;
        let sine = (1.0 - mu * mu).max(0.0).sqrt();
        let mut mean = splat(0.0);
        for &(node, weight) in &self.strips {
            let t = lowest + height * node;
            let (y, share) = (self.sun_radius * t.sin(), weight * height * t.cos().powi(2) / std::f64::consts::FRAC_PI_2);
            if let Some(transmittance) = self.transmittance(z, mu * y.cos() + sine * y.sin()) {
                add_scaled(&mut mean, share as f32, &transmittance);
            }
        }
        Some(mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::{Component, OpticalProfile, Phase};

    fn sunlight() -> Sunlight<16> {
        let altitudes: Vec<f64> = (0..=200).map(|i| f64::from(i) * 0.5).collect();
        let profile = OpticalProfile {
            components: vec![Component {
                name: "molecules".into(),
                scattering_per_km: altitudes.iter().map(|z| 0.0375 * (-z / 8.0).exp()).collect(),
                absorption_per_km: vec![0.0; altitudes.len()],
                phase: Some(Phase::Rayleigh { depolarisation: vec![0.0] }),
            }],
            altitudes_km: altitudes,
            wavelengths_nm: vec![450.0],
            ground_albedo: vec![0.0],
            solar_irradiance: vec![1.0],
            planet_radius_km: 6371.0,
            sun_angular_radius_deg: 0.2664,
        };
        Sunlight::new(&Air::new(&profile, 0, 0, false))
    }

    /// A disc in a thousand strips, from the transmittance of each.
    fn in_fine_strips(sunlight: &Sunlight<16>, z: f64, zenith: f64) -> f64 {
        let n = 1000;
        let strips = (0..n).map(|i| {
            let t = std::f64::consts::PI * ((f64::from(i) + 0.5) / f64::from(n) - 0.5);
            let share = 2.0 * t.cos().powi(2) / f64::from(n);
            let seen = sunlight.transmittance(z, (zenith - sunlight.sun_radius * t.sin()).cos());
            share * seen.map_or(0.0, |lanes| f64::from(lanes[0]))
        });
        strips.sum()
    }

    #[test]
    fn the_disc_is_the_mean_of_its_strips() {
        let sunlight = sunlight();
        for z in [0.0, 5.0, 30.0] {
            let horizon = std::f64::consts::FRAC_PI_2 + (6371.0_f64 / (6371.0 + z)).acos();
            for above_deg in [-0.2, -0.1, 0.0, 0.2, 0.5, 2.0, 4.0, 6.0, 20.0_f64] {
                let zenith = horizon - above_deg.to_radians();
                let disc = sunlight.over_disc(z, zenith.cos()).map_or(0.0, |lanes| f64::from(lanes[0]));
                let expected = in_fine_strips(&sunlight, z, zenith);
                assert!((disc / expected - 1.0).abs() < 0.02, "{z} km, {above_deg} deg: {disc} {expected}");
            }
            assert!(sunlight.over_disc(z, (horizon + 0.3_f64.to_radians()).cos()).is_none());
        }
    }

    #[test]
    fn overhead_sunlight_passes_the_vertical_optical_depth() {
        let sunlight = sunlight();
        let vertical = f64::from(sunlight.transmittance(0.0, 1.0).unwrap()[0]);
        assert!((vertical / (-0.3_f64 * (1.0 - (-12.5_f64).exp())).exp() - 1.0).abs() < 1e-3, "{vertical}");
    }
}
