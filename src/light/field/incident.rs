//! The light that falls on a point inside the air: what clouds and surfaces there are lit by.

use super::super::harmonics::{self, Orders};
use super::super::lanes::LANES;
use super::super::source::{MAX_ORDER, log_magnitude};
use super::super::zenith_axis::Stencil;
use super::{LightField, Observer};
use std::f64::consts::PI;

/// Points of the quadrature of an irradiance over zenith cosines.
const NODES: usize = 16;

/// Light that falls on a point, per unit solar irradiance outside the air. Used for one point after the other it keeps its memory.
///
/// Direct sunlight is apart from what was scattered at least once. Both take light that was scattered into a forward peak for unscattered, so that the sum of the two is the light that is
/// there, and the direct light is a little more than what comes in straight lines ([`LightField::sun_transmittance`]).
#[derive(Clone, Debug)]
pub struct Incident {
    orders: Orders,
    wavelengths: usize,
    /// Shape (moment, wavelength).
    moments: Vec<f64>,
    /// By wavelength.
    direct: Vec<f64>,
}

impl Default for Incident {
    fn default() -> Self {
        Self { orders: Orders::new(0, 0), wavelengths: 0, moments: Vec::new(), direct: Vec::new() }
    }
}

impl Incident {
    /// Moments of the scattered radiance, shape (moments, wavelengths): I_lm = integral of I(w) y_lm(zenith cosine) cos(m azimuth) over all directions w that one looks along, azimuths from
    /// the Sun; pairs (l, m) in the order of [`Self::orders`] [1].
    pub fn moments(&self) -> &[f64] {
        &self.moments
    }

    /// Which moments there are: the highest l and the highest m.
    pub fn orders(&self) -> (usize, usize) {
        (self.orders.order, self.orders.azimuthal)
    }

    /// Direct sunlight on a surface that faces the Sun, by wavelength [1].
    pub fn direct(&self) -> &[f64] {
        &self.direct
    }

    /// Scattered radiance at wavelength index `wavelength` towards zenith cosine `mu` and `azimuth` from the Sun [radians], as smooth as its moments make it, and 0 where they
    /// swing below it [sr-1].
    pub fn radiance(&self, wavelength: usize, mu: f64, azimuth: f64) -> f64 {
        let waves = self.waves(wavelength, mu);
        waves
            .iter()
            .enumerate()
            .take(self.orders.azimuthal + 1)
            .map(|(m, wave)| wave * (m as f64 * azimuth).cos())
            .sum::<f64>()
            .max(0.0)
    }

    /// Scattered light from all directions on a small sphere, per area of its cross-section (scalar irradiance, actinic flux), at wavelength index `wavelength` [1].
    pub fn scalar_irradiance(&self, wavelength: usize) -> f64 {
        (4.0 * PI).sqrt() * self.moments[wavelength]
    }

    /// Scattered light on a horizontal surface that looks up, and on one that looks down, at wavelength index `wavelength` [1].
    pub fn irradiance(&self, wavelength: usize) -> [f64; 2] {
        let half = |side: f64| -> f64 {
            let nodes = crate::numerics::gauss::legendre(NODES).into_iter();
            nodes.map(|(mu, weight)| 2.0 * PI * weight * mu * self.waves(wavelength, side * mu)[0]).sum()
        };
        [half(1.0), half(-1.0)]
    }

    /// Radiance as a series of cos(m azimuth), by m.
    fn waves(&self, wavelength: usize, mu: f64) -> [f64; MAX_ORDER + 1] {
        let mut harmonic = [0.0; Orders::new(MAX_ORDER, MAX_ORDER).count()];
        harmonics::evaluate(self.orders, mu, &mut harmonic);
        let mut waves = [0.0; MAX_ORDER + 1];
        for l in 0..=self.orders.order {
            for m in 0..=self.orders.last(l) {
                let lm = self.orders.start(l) + m;
                waves[m] += f64::from(harmonic[lm]) * self.moments[lm * self.wavelengths + wavelength];
            }
        }
        waves
    }
}

impl LightField {
    /// Finds the light that falls on the place of `observer` into `out`.
    pub fn incident(&self, observer: &Observer, out: &mut Incident) {
        let orders = self.blocks[0].field.shape.orders;
        (out.orders, out.wavelengths) = (orders, self.wavelengths);
        out.moments.clear();
        out.moments.resize(orders.count() * self.wavelengths, 0.0);
        out.direct.clear();
        let zeniths = self.grid.zeniths.len();
        let altitude = observer.altitude_km.clamp(0.0, self.blocks[0].air.top);
        let cubic = self.grid.altitudes.cubic(altitude);
        let position = self.grid.zeniths.position(observer.sun_zenith.cos() as f32);
        for (b, block) in self.blocks.iter().enumerate() {
            let lanes = LANES.min(self.wavelengths - b * LANES);
            let direct = block.sunlight.over_disc(observer.altitude_km, observer.sun_zenith.cos());
            out.direct.extend((0..lanes).map(|lane| direct.map_or(0.0, |light| f64::from(light[lane]))));
            let Some(position) = position else { continue };
            let stencil = self.grid.zeniths.stencil(position);
            let field = &block.field;
            // As rays are lit: first altitudes, then solar zenith angles.
            let level = Stencil { first: 0, inner: cubic.interval - cubic.first, weights: cubic.weights };
            let node = |altitude: usize, zenith: usize| (cubic.first + altitude) * zeniths + stencil.first + zenith;
            let logs: [f32; 4] = std::array::from_fn(|zenith| {
                log_magnitude(&level, &std::array::from_fn::<f32, 4, _>(|altitude| field.log_magnitudes[node(altitude, zenith)]))
            });
            let magnitude = log_magnitude(&Stencil { first: 0, ..stencil }, &logs).exp();
            let count = field.shape.count();
            for (moment, row) in out.moments.chunks_exact_mut(self.wavelengths).enumerate() {
                for (zenith, at_zenith) in stencil.weights.into_iter().enumerate() {
                    for (altitude, at_altitude) in cubic.weights.into_iter().enumerate() {
                        let value = &field.values[node(altitude, zenith) * count + moment];
                        let weight = f64::from(magnitude * at_zenith * at_altitude);
                        for lane in 0..lanes {
                            row[b * LANES + lane] += weight * f64::from(value[lane]);
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::AirParameters;
    use crate::light::suns::SunOnRay;
    use crate::progress::Progress;
    use crate::quality::Quality;

    fn field() -> LightField {
        let profile = AirParameters::default().optical_profile(&[420.0, 500.0, 600.0, 700.0]).unwrap();
        LightField::solve(&profile, &Quality::High.numbers(), true, &Progress::silent()).unwrap()
    }

    /// Gathered light, the disc excluded, from all directions and on a surface that looks up and one that looks down.
    fn gathered(field: &LightField, observer: &Observer, wavelength: usize) -> [f64; 3] {
        const AZIMUTHS: usize = 96;
        let azimuths: Vec<f64> = (0..AZIMUTHS).map(|a| (a as f64 + 0.5) * PI / AZIMUTHS as f64).collect();
        let mut sums = [0.0; 3];
        // The zone of the horizon and the rest apart.
        let horizon = -(1.0 - (6371.0 / (6371.0 + observer.altitude_km)).powi(2)).sqrt();
        for (low, high) in [(-1.0, horizon - 0.1), (horizon - 0.1, horizon), (horizon, horizon + 0.1), (horizon + 0.1, 1.0)] {
            for (t, weight) in crate::numerics::gauss::legendre(24) {
                let mu: f64 = low + t * (high - low);
                let circle = field.gather(observer, mu, &azimuths);
                for (a, azimuth) in azimuths.iter().enumerate() {
                    let sun = observer.sun_zenith.sin_cos();
                    let cosine = SunOnRay::new(1.0, mu, (azimuth.cos(), azimuth.sin()), sun).scattering_cosine;
                    let light =
                        field.radiance(&circle, a, wavelength, cosine) * weight * (high - low) * 2.0 * PI / AZIMUTHS as f64;
                    sums[0] += light;
                    sums[if mu > 0.0 { 1 } else { 2 }] += light * mu.abs();
                }
            }
        }
        sums
    }

    /// Scattered and direct light together are what rays find, from the ground to above the air, by day and at dusk.
    #[test]
    fn the_light_at_a_point_is_what_rays_find_there() {
        let field = field();
        let mut incident = Incident::default();
        // At dusk the lit edge of the air is thinner than the moments and the nodes of the quadrature see.
        let cases = [
            (0.5, 30.0_f64, 1e-3),
            (3.0, 60.0, 1e-3),
            (9.0, 80.0, 1e-3),
            (9.0, 89.0, 5e-3),
            (20.0, 94.0, 0.04),
            (60.0, 50.0, 1e-3),
        ];
        for (altitude_km, sun_zenith_deg, limit) in cases {
            let observer = Observer { altitude_km, sun_zenith: sun_zenith_deg.to_radians() };
            field.incident(&observer, &mut incident);
            let straight = field.sun_transmittance(&observer);
            let sun_cosine = observer.sun_zenith.cos().max(0.0);
            for wavelength in 0..4 {
                let [all, up, down] = gathered(&field, &observer, wavelength);
                let [above, below] = incident.irradiance(wavelength);
                let whole = all + straight[wavelength];
                let direct = incident.direct()[wavelength];
                let error = (incident.scalar_irradiance(wavelength) + direct) / whole - 1.0;
                let looking_up = above + direct * sun_cosine - up - straight[wavelength] * sun_cosine;
                assert!(error.abs() < limit, "{altitude_km} {sun_zenith_deg} {wavelength}: {error}");
                // Relative to all light: in the dark half the swings of the moments count most.
                assert!(looking_up.abs().max((below - down).abs()) < 0.01 * whole, "{altitude_km} {sun_zenith_deg} {wavelength}");
            }
        }
    }

    #[test]
    fn radiance_is_the_series_of_its_moments() {
        let field = field();
        let mut incident = Incident::default();
        field.incident(&Observer { altitude_km: 2.0, sun_zenith: 1.0 }, &mut incident);
        let mut sums = [0.0; 2];
        for (t, weight) in crate::numerics::gauss::legendre(24) {
            for step in 0..32 {
                let (mu, azimuth) = (2.0 * t - 1.0, (f64::from(step) + 0.5) * PI / 16.0);
                let light = incident.radiance(1, mu, azimuth) * weight * 2.0 * PI / 16.0;
                sums[0] += light;
                sums[1] += light * mu;
            }
        }
        assert!((sums[0] / incident.scalar_irradiance(1) - 1.0).abs() < 1e-5);
        let [above, below] = incident.irradiance(1);
        assert!((sums[1] - (above - below)).abs() < 1e-4 * sums[0], "{sums:?} {above} {below}");
    }
}
