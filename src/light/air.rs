//! One block of wavelengths of an optical profile, laid out for the light transport.

use super::axis::Axis;
use super::lanes::{Lanes, add_scaled, lerp, splat};
use crate::atmosphere::{OpticalProfile, Phase};

/// Coefficients of the air for a block of at most `N` wavelengths; unused lanes repeat the last wavelength.
pub struct Air<const N: usize> {
    /// Radius of the ground [km].
    pub radius: f64,
    /// Top of the atmosphere above the ground [km].
    pub top: f64,
    /// Angular radius of the Sun [radians].
    pub sun_radius: f64,
    /// Albedo of the ground.
    pub albedo: Lanes<N>,
    altitudes: Axis,
    extinction: Vec<Lanes<N>>,
    scatterers: Vec<Scatterer<N>>,
}

/// A component that scatters.
pub struct Scatterer<const N: usize> {
    /// Scattering coefficient at the altitudes of the profile [km-1].
    coefficient: Vec<Lanes<N>>,
    /// Phase function.
    pub phase: Phase,
    /// Weights of the phase function's basis, one block for each basis function.
    pub basis_weights: Vec<Lanes<N>>,
    /// Legendre moments of the phase function by order.
    pub moments: Vec<Lanes<N>>,
}

impl<const N: usize> Air<N> {
    /// The wavelengths from index `first` on, with phase function moments up to `max_order`.
    pub fn new(profile: &OpticalProfile, first: usize, max_order: usize) -> Self {
        let count = profile.wavelengths_nm.len();
        let index = |lane: usize| (first + lane).min(count - 1);
        let row = |values: &[f64], z: usize| -> Lanes<N> { std::array::from_fn(|lane| values[z * count + index(lane)] as f32) };
        let levels = profile.altitudes_km.len();
        let mut extinction = vec![splat(0.0); levels];
        let mut scatterers = Vec::new();
        for component in &profile.components {
            let scattering: Vec<Lanes<N>> = (0..levels).map(|z| row(&component.scattering_per_km, z)).collect();
            for (z, total) in extinction.iter_mut().enumerate() {
                add_scaled(total, 1.0, &scattering[z]);
                add_scaled(total, 1.0, &row(&component.absorption_per_km, z));
            }
            if let Some(phase) = &component.phase {
                scatterers.push(Scatterer {
                    coefficient: scattering,
                    phase: phase.clone(),
                    basis_weights: (0..phase.basis_len())
                        .map(|b| std::array::from_fn(|lane| phase.basis_weight(b, index(lane)) as f32))
                        .collect(),
                    moments: (0..=max_order)
                        .map(|l| std::array::from_fn(|lane| phase.legendre_moment(l, index(lane)) as f32))
                        .collect(),
                });
            }
        }
        Self {
            radius: profile.planet_radius_km,
            top: *profile.altitudes_km.last().expect("validated profile"),
            sun_radius: profile.sun_angular_radius_deg.to_radians(),
            albedo: std::array::from_fn(|lane| profile.ground_albedo[index(lane)] as f32),
            altitudes: Axis::new(profile.altitudes_km.clone()),
            extinction,
            scatterers,
        }
    }

    /// The components that scatter.
    pub fn scatterers(&self) -> &[Scatterer<N>] {
        &self.scatterers
    }

    /// Interval of the profile and the position in it for `altitude` [km].
    #[inline(always)]
    pub fn locate(&self, altitude: f64) -> (usize, f32) {
        self.altitudes.locate(altitude)
    }

    /// Extinction coefficient [km-1] at a place found by [`Self::locate`].
    #[inline(always)]
    pub fn extinction(&self, (interval, fraction): (usize, f32)) -> Lanes<N> {
        lerp(&self.extinction[interval], &self.extinction[interval + 1], fraction)
    }
}

impl<const N: usize> Scatterer<N> {
    /// Scattering coefficient [km-1] at a place found by [`Air::locate`].
    #[inline(always)]
    pub fn coefficient(&self, (interval, fraction): (usize, f32)) -> Lanes<N> {
        lerp(&self.coefficient[interval], &self.coefficient[interval + 1], fraction)
    }

    /// Phase function at the scattering angle with cosine `cosine`.
    #[inline(always)]
    pub fn phase(&self, cosine: f64) -> Lanes<N> {
        let mut value = splat(0.0);
        for (b, weights) in self.basis_weights.iter().enumerate() {
            add_scaled(&mut value, self.phase.basis(b, cosine) as f32, weights);
        }
        value
    }
}
