//! How much of the Sun's light arrives at a place in the air: transmittance averaged over the part of the disc that is above the horizon.
//!
//! The optical depth to space of rays that rise, tau(z, mu >= 0), is tabulated. A ray that first sinks passes its lowest point z_t
//! and follows from the same table: tau = 2 tau(z_t, 0) - tau(z, |mu|). Near the horizon, where transmittance changes over the width of the disc
//! and the ground hides a part of it, the mean over the disc (uniform), integrated in horizontal strips, is tabulated.

use super::air::Air;
use super::lanes::{Lanes, add_scaled, exp_minus, exp_one, splat};
use super::ray::{Ray, StepLimits};
use crate::numerics::Axis;
use crate::numerics::gauss;
use crate::units::EARTH_RADIUS_KM;
use multiversion::multiversion;
use rayon::prelude::*;

/// Altitude levels of the table.
const LEVELS: usize = 112;
/// Zenith cosines of the table; cosine = (i / (n - 1))^2.
const COSINES: usize = 80;
/// Height of the disc's centre over its lowest visible position, in radii of the disc, up to which the mean over the disc is tabulated: above, the transmittance
/// of the centre is that of the disc within 0.3 %.
const DISC_REACH: f64 = 17.0;
/// Entries of that table; height = reach (i / (n - 1))^2.
const DISC_HEIGHTS: usize = 64;

/// Table of the optical depth towards space for one block of wavelengths.
pub struct Sunlight<const N: usize> {
    altitudes: Axis,
    /// Sixteenth root of the optical depth, (altitude, cosine): nearly as linear between the entries as its logarithm, and powers are cheaper than an exponential.
    root_depth: Vec<Lanes<N>>,
    /// ln of the mean transmittance over the disc, divided by the cube of the place in the table with which it vanishes, (altitude, height).
    log_disc: Vec<Lanes<N>>,
    radius: f64,
    top: f64,
    sun_radius: f64,
}

impl<const N: usize> Sunlight<N> {
    /// Tabulates the optical depths of `air`.
    pub fn new(air: &Air<N>) -> Self {
        let mut sunlight = Self::without_disc(air);
        if sunlight.sun_radius > 0.0 {
            sunlight.tabulate_disc();
        }
        sunlight
    }

    fn without_disc(air: &Air<N>) -> Self {
        let top = air.top;
        let altitudes = Axis::new((0..LEVELS).map(|i| top * (i as f64 / (LEVELS - 1) as f64).powf(2.4)).collect());
        let mut shells: Vec<f64> = (0..=40).map(|i| top * (f64::from(i) / 40.0).powf(2.2)).collect();
        shells.extend(air.sharp_bends());
        shells.sort_by(f64::total_cmp);
        shells.dedup_by(|b, a| *b - *a < 1e-6);
        let shells = Axis::new(shells);
        let limits = StepLimits { length_km: 25.0 * air.radius / EARTH_RADIUS_KM, optical_depth: f32::INFINITY };
        let root_depth = altitudes.nodes().par_iter().flat_map_iter(|&z| root_depths(air, &shells, z, limits)).collect();
        Self { altitudes, root_depth, log_disc: Vec::new(), radius: air.radius, top, sun_radius: air.sun_radius }
    }

    fn tabulate_disc(&mut self) {
        let strips = gauss::legendre(8);
        self.log_disc = self.altitudes.nodes().par_iter().flat_map_iter(|&z| log_discs(self, z, &strips)).collect();
    }

    /// Cosine of the zenith angle of the horizon seen from altitude `z` [km].
    #[inline(always)]
    fn horizon(&self, z: f64) -> f64 {
        let ratio = self.radius / (self.radius + z);
        -(1.0 - ratio * ratio).max(0.0).sqrt()
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
            (&self.root_depth[base], (1.0 - up) * (1.0 - across)),
            (&self.root_depth[base + 1], (1.0 - up) * across),
            (&self.root_depth[base + COSINES], up * (1.0 - across)),
            (&self.root_depth[base + COSINES + 1], up * across),
        ];
        let mut root = splat(0.0);
        for (value, weight) in corners {
            add_scaled(&mut root, weight, value);
        }
        root.map(sixteenth_power)
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
        self.at(z).over_disc(mu)
    }

    /// Prepares for many positions of the Sun at altitude `z` [km].
    #[inline(always)]
    pub fn at(&self, z: f64) -> AtAltitude<'_, N> {
        let (level, up) = self.altitudes.locate(z);
        AtAltitude { sunlight: self, altitude: z, horizon: self.horizon(z), level, up }
    }

    /// The mean over the disc whose centre stands at `zenith` [radians], `above` the horizon [radians].
    #[inline(always)]
    fn over_strips(&self, z: f64, zenith: f64, above: f64, strips: &[(f64, f64)]) -> Lanes<N> {
        // Height over the centre = radius sin t; a strip's share of the disc is cos^2 t dt / (pi / 2).
        let lowest = if above < self.sun_radius { (-above / self.sun_radius).asin() } else { -std::f64::consts::FRAC_PI_2 };
        let height = std::f64::consts::FRAC_PI_2 - lowest;
        let (sine, mu) = zenith.sin_cos();
        let mut mean = splat(0.0);
        for &(node, weight) in strips {
            let t = lowest + height * node;
            let (y, share) = (self.sun_radius * t.sin(), weight * height * t.cos().powi(2) / std::f64::consts::FRAC_PI_2);
            if let Some(transmittance) = self.transmittance(z, mu * y.cos() + sine * y.sin()) {
                add_scaled(&mut mean, share as f32, &transmittance);
            }
        }
        mean
    }
}

/// One row of the table of optical depths.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn root_depths<const N: usize>(air: &Air<N>, shells: &Axis, z: f64, limits: StepLimits) -> Vec<Lanes<N>> {
    let of = |c: usize| {
        let mu = (c as f64 / (COSINES - 1) as f64).powi(2);
        Ray::optical_depth(air, shells, z, mu, limits).map(|depth| depth.sqrt().sqrt().sqrt().sqrt())
    };
    (0..COSINES).map(of).collect()
}

/// One row of the table of means over the disc.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn log_discs<const N: usize>(sunlight: &Sunlight<N>, z: f64, strips: &[(f64, f64)]) -> Vec<Lanes<N>> {
    let of = |i: usize| {
        let place = (i as f64 / (DISC_HEIGHTS - 1) as f64).max(1e-3);
        let above = sunlight.sun_radius * (DISC_REACH * place * place - 1.0);
        let mean = sunlight.over_strips(z, sunlight.horizon(z).acos() - above, above, strips);
        mean.map(|m| (m.max(1e-30) / place.powi(3) as f32).ln())
    };
    (0..DISC_HEIGHTS).map(of).collect()
}

/// Sunlight at one altitude.
pub struct AtAltitude<'a, const N: usize> {
    sunlight: &'a Sunlight<N>,
    altitude: f64,
    horizon: f64,
    level: usize,
    up: f32,
}

impl<const N: usize> AtAltitude<'_, N> {
    /// As [`Sunlight::over_disc`].
    #[inline(always)]
    pub fn over_disc(&self, mu: f64) -> Option<Lanes<N>> {
        let sun_radius = self.sunlight.sun_radius;
        // Cosines differ by less than angles: what is not clearly above the horizon is looked at closely.
        if sun_radius <= 0.0 || mu > self.horizon + DISC_REACH * sun_radius {
            return self.centre(mu);
        }
        if mu < self.horizon - 1.5 * sun_radius {
            return None;
        }
        let above = angle_between(self.horizon, mu) / sun_radius + 1.0;
        if above <= 0.0 {
            return None;
        }
        if above >= DISC_REACH {
            return self.centre(mu);
        }
        let place = (above / DISC_REACH).sqrt();
        let position = place * (DISC_HEIGHTS - 1) as f64;
        let column = (position as usize).min(DISC_HEIGHTS - 2);
        let cube = (place * place * place) as f32;
        Some(self.interpolate(&self.sunlight.log_disc, DISC_HEIGHTS, column, (position - column as f64) as f32, |log| {
            cube * exp_one(log)
        }))
    }

    /// Transmittance towards the centre of the disc.
    #[inline(always)]
    fn centre(&self, mu: f64) -> Option<Lanes<N>> {
        if mu < 0.0 || self.altitude >= self.sunlight.top {
            return self.sunlight.transmittance(self.altitude, mu);
        }
        let position = mu.sqrt() * (COSINES - 1) as f64;
        let column = (position as usize).min(COSINES - 2);
        let across = (position - column as f64) as f32;
        Some(self.interpolate(&self.sunlight.root_depth, COSINES, column, across, |root| exp_one(-sixteenth_power(root))))
    }

    /// `finish` of what stands between four entries of a table.
    #[inline(always)]
    fn interpolate(
        &self,
        table: &[Lanes<N>],
        columns: usize,
        column: usize,
        across: f32,
        finish: impl Fn(f32) -> f32,
    ) -> Lanes<N> {
        let base = self.level * columns + column;
        let (a, b) = (&table[base], &table[base + 1]);
        let (c, d) = (&table[base + columns], &table[base + columns + 1]);
        let (wa, wb) = ((1.0 - self.up) * (1.0 - across), (1.0 - self.up) * across);
        let (wc, wd) = (self.up * (1.0 - across), self.up * across);
        let mut value = splat(0.0);
        for n in 0..N {
            value[n] = finish((wa * a[n] + wb * b[n]) + (wc * c[n] + wd * d[n]));
        }
        value
    }
}

/// `x`^16.
#[inline(always)]
fn sixteenth_power(x: f32) -> f32 {
    let fourth = (x * x) * (x * x);
    (fourth * fourth) * (fourth * fourth)
}

/// Angle from the direction with zenith cosine `horizon` up to that with zenith cosine `mu` [radians], for angles of at most some degrees: the series of the
/// arc sine of the sine of the difference.
#[inline(always)]
fn angle_between(horizon: f64, mu: f64) -> f64 {
    let sine = mu * (1.0 - horizon * horizon).max(0.0).sqrt() - horizon * (1.0 - mu * mu).max(0.0).sqrt();
    sine * (1.0 + sine * sine / 6.0)
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
