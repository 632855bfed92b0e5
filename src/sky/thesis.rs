//! The sky by the estimator of the thesis ([`Thesis`]), to compare the solved light with: noisy, slow, for small probes by day. As in the thesis there is no ground: black lies below the horizon.

use super::SkyLight;
use super::disc::Disc;
use crate::light::Thesis;
use glam::DVec3;
use rayon::prelude::*;

/// The light of one Sun by the estimator.
pub struct ThesisSky {
    pub(super) estimator: Thesis,
    /// Weights by wavelength that turn radiance per unit solar irradiance into XYZ.
    pub(super) weights: Vec<[f64; 3]>,
    pub(super) altitude_km: f64,
    pub(super) horizon: f64,
    /// Unit vector (east, north, up).
    pub(super) sun: DVec3,
    pub(super) discs: Vec<Disc>,
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
