//! One block of wavelengths of an optical profile, laid out for the light transport.

use super::axis::Axis;
use super::lanes::{Lanes, add_scaled, lerp, splat};
use super::stokes::dipole_share;
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
    /// Scattering optical depth of the air above these altitudes.
    above: Vec<Lanes<N>>,
    /// Legendre moments by order of what multiplies the moments of the light: the whole phase function, or the part of it that is not a dipole's.
    pub moments: Vec<Lanes<N>>,
    /// Legendre moments by order of the whole phase function, up to the order that [`Self::band_limited`] needs.
    all_moments: Vec<Lanes<N>>,
    /// Share of scattering by polarising dipoles: molecules in polarised light.
    pub dipole_share: Option<Lanes<N>>,
}

/// Orders beyond those of the field that sunlight is scattered with: the sharper rest of a phase function passes its energy to the field's orders only through the slow change of the
/// light with direction.
const MORE_ORDERS: usize = 6;

impl<const N: usize> Air<N> {
    /// The wavelengths from index `first` on, with phase function moments up to `max_order`; molecules are dipoles if light is `polarised`.
    pub fn new(profile: &OpticalProfile, first: usize, max_order: usize, polarised: bool) -> Self {
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
                let all_moments: Vec<Lanes<N>> = (0..=max_order + MORE_ORDERS)
                    .map(|l| std::array::from_fn(|lane| phase.legendre_moment(l, index(lane)) as f32))
                    .collect();
                let dipole_share: Option<Lanes<N>> = match phase {
                    Phase::Rayleigh { depolarisation } if polarised => Some(std::array::from_fn(|lane| {
                        dipole_share(depolarisation[index(lane).min(depolarisation.len() - 1)]) as f32
                    })),
                    _ => None,
                };
                let moments = match &dipole_share {
                    Some(share) => {
                        let mut rest = vec![splat(0.0); max_order + 1];
                        rest[0] = share.map(|share| 1.0 - share);
                        rest
                    }
                    None => all_moments[..=max_order].to_vec(),
                };
                let mut above = vec![splat(0.0); levels];
                for z in (0..levels - 1).rev() {
                    above[z] = above[z + 1];
                    let half = 0.5 * (profile.altitudes_km[z + 1] - profile.altitudes_km[z]) as f32;
                    add_scaled(&mut above[z], half, &scattering[z]);
                    add_scaled(&mut above[z], half, &scattering[z + 1]);
                }
                scatterers.push(Scatterer { coefficient: scattering, above, moments, all_moments, dipole_share });
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

    /// Scattering optical depth of this component above a place found by [`Air::locate`].
    #[inline(always)]
    pub fn above(&self, (interval, fraction): (usize, f32)) -> Lanes<N> {
        lerp(&self.above[interval], &self.above[interval + 1], fraction)
    }

    /// The phase function without the orders that the field has no use for, at the scattering angle with cosine `cosine`.
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
