//! One block of wavelengths of an optical profile, laid out for the light transport.
//!
//! A phase function's peak in the forward direction is too narrow for the orders that the field holds. Light scattered into it goes on nearly as it came, so for the field it counts as not
//! scattered (delta-M: Wiscombe 1977, J. Atmos. Sci. 34, 1408): with f the first Legendre moment that is left out, scattering and extinction shrink by f times the scattering, and the moments
//! become (chi - f) / (1 - f). What f stands for comes back when light is gathered ([`super::angular`]).

use super::bends::sharp_bends;
use super::lanes::{Lanes, add_scaled, lerp, splat};
use super::stokes::dipole_share;
use crate::atmosphere::{OpticalProfile, Phase};
use crate::numerics::Axis;
use rayon::prelude::*;

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
    /// Scattering coefficient at the altitudes of the profile, without the forward peak [km-1].
    coefficient: Vec<Lanes<N>>,
    /// Scattering optical depth, with the forward peak, of the air above these altitudes.
    above: Vec<Lanes<N>>,
    /// Share of the forward peak in the scattering.
    pub forward: Lanes<N>,
    /// Legendre moments by order of what multiplies the moments of the light: the phase function without its forward peak, or the part of it that is not a dipole's.
    pub moments: Vec<Lanes<N>>,
    /// Legendre moments by order of the phase function without its forward peak.
    all_moments: Vec<Lanes<N>>,
    /// Share of scattering by polarising dipoles: molecules in polarised light.
    pub dipole_share: Option<Lanes<N>>,
}

/// Share of the forward peak of a phase function with these Legendre moments beside a field of orders up to `order`.
pub fn forward_share(moments: &[f64], order: usize) -> f64 {
    moments.get(order + 1).map_or(0.0, |moment| moment.clamp(0.0, 0.999))
}

impl<const N: usize> Air<N> {
    /// The wavelengths from index `first` on, with phase function moments up to `max_order`; molecules are dipoles if light is `polarised`.
    pub fn new(profile: &OpticalProfile, first: usize, max_order: usize, polarised: bool) -> Self {
        Self::build(profile, first, Some(max_order), polarised)
    }

    /// The same air as it is, forward peaks and all, for what is not scattered at all.
    pub fn unscaled(profile: &OpticalProfile, first: usize) -> Self {
        Self::build(profile, first, None, false)
    }

    fn build(profile: &OpticalProfile, first: usize, max_order: Option<usize>, polarised: bool) -> Self {
        let count = profile.wavelengths_nm.len();
        let index = |lane: usize| (first + lane).min(count - 1);
        let row = |values: &[f64], z: usize| -> Lanes<N> { Lanes::from_fn(|lane| values[z * count + index(lane)] as f32) };
        let levels = profile.altitudes_km.len();
        let mut extinction = vec![splat(0.0); levels];
        let mut scatterers = Vec::new();
        for component in &profile.components {
            let mut scattering: Vec<Lanes<N>> = (0..levels).map(|z| row(&component.scattering_per_km, z)).collect();
            for (z, total) in extinction.iter_mut().enumerate() {
                add_scaled(total, 1.0, &scattering[z]);
                add_scaled(total, 1.0, &row(&component.absorption_per_km, z));
            }
            let (Some(phase), Some(order)) = (&component.phase, max_order) else { continue };
            let by_lane: Vec<Vec<f64>> =
                (0..N).into_par_iter().map(|lane| phase.legendre_moments(order + 2, index(lane))).collect();
            let forward: Lanes<N> = Lanes::from_fn(|lane| forward_share(&by_lane[lane], order) as f32);
            let mut above = vec![splat(0.0); levels];
            for z in (0..levels - 1).rev() {
                above[z] = above[z + 1];
                let half = 0.5 * (profile.altitudes_km[z + 1] - profile.altitudes_km[z]) as f32;
                add_scaled(&mut above[z], half, &scattering[z]);
                add_scaled(&mut above[z], half, &scattering[z + 1]);
            }
            for (total, scattering) in extinction.iter_mut().zip(&mut scattering) {
                for n in 0..N {
                    total[n] -= forward[n] * scattering[n];
                    scattering[n] *= 1.0 - forward[n];
                }
            }
            let all_moments: Vec<Lanes<N>> = (0..=order)
                .map(|l| Lanes::from_fn(|lane| ((by_lane[lane][l] as f32) - forward[lane]) / (1.0 - forward[lane])))
                .collect();
            let dipole_share: Option<Lanes<N>> = match phase {
                Phase::Rayleigh { depolarisation } if polarised => {
                    Some(Lanes::from_fn(|lane| dipole_share(depolarisation[index(lane).min(depolarisation.len() - 1)]) as f32))
                }
                _ => None,
            };
            let moments = match &dipole_share {
                Some(share) => {
                    let mut rest = vec![splat(0.0); order + 1];
                    rest[0] = share.map(|share| 1.0 - share);
                    rest
                }
                None => all_moments.clone(),
            };
            scatterers.push(Scatterer { coefficient: scattering, above, forward, moments, all_moments, dipole_share });
        }
        Self {
            radius: profile.planet_radius_km,
            top: *profile.altitudes_km.last().expect("validated profile"),
            sun_radius: profile.sun_angular_radius_deg.to_radians(),
            albedo: Lanes::from_fn(|lane| profile.ground_albedo[index(lane)] as f32),
            altitudes: Axis::new(profile.altitudes_km.clone()),
            extinction,
            scatterers,
        }
    }

    /// Altitudes at which the extinction, as a mean over the wavelengths, changes sharply \[km\].
    pub fn sharp_bends(&self) -> Vec<f64> {
        let mean: Vec<f64> = self.extinction.iter().map(|lanes| f64::from(lanes.iter().sum::<f32>())).collect();
        sharp_bends(self.altitudes.nodes(), &mean)
    }

    /// Altitudes of the profile [km].
    pub fn altitudes(&self) -> &[f64] {
        self.altitudes.nodes()
    }

    /// The same, as an axis.
    pub fn levels(&self) -> &Axis {
        &self.altitudes
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

    /// Coefficient of scattering into forward peaks [km-1], which [`Self::extinction`] leaves out.
    #[inline(always)]
    pub fn forward_scattering(&self, place: (usize, f32)) -> Lanes<N> {
        let mut sum = splat(0.0);
        for scatterer in &self.scatterers {
            let coefficient = scatterer.coefficient(place);
            for n in 0..N {
                sum[n] += coefficient[n] * scatterer.forward[n] / (1.0 - scatterer.forward[n]);
            }
        }
        sum
    }
}

impl<const N: usize> Scatterer<N> {
    /// Scattering coefficient without the forward peak [km-1] at a place found by [`Air::locate`].
    #[inline(always)]
    pub fn coefficient(&self, (interval, fraction): (usize, f32)) -> Lanes<N> {
        lerp(&self.coefficient[interval], &self.coefficient[interval + 1], fraction)
    }

    /// Scattering optical depth of this component above a place found by [`Air::locate`].
    #[inline(always)]
    pub fn above(&self, (interval, fraction): (usize, f32)) -> Lanes<N> {
        lerp(&self.above[interval], &self.above[interval + 1], fraction)
    }

    /// Asymmetry of the phase function without its forward peak.
    pub fn asymmetry(&self) -> Lanes<N> {
        self.all_moments.get(1).copied().unwrap_or(splat(0.0))
    }

    /// The phase function without its forward peak at the scattering angle with cosine `cosine`.
    #[inline(always)]
    pub fn band_limited(&self, cosine: f64) -> Lanes<N> {
        let mut value = splat(0.0);
        let x = cosine as f32;
        let (mut before, mut now) = (0.0_f32, 1.0_f32);
        for (l, moment) in self.all_moments.iter().enumerate() {
            let l = l as f32;
            add_scaled(&mut value, (2.0 * l + 1.0) * now, moment);
            (before, now) = (now, ((2.0 * l + 1.0) * x * now - l * before) / (l + 1.0));
        }
        value
    }
}
