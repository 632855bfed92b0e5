//! The air at one wavelength as a path meets it: extinction, scattering, and the Sun's light at a point.

use super::super::chord::Chord;
use super::angles::{Angles, bin};
use super::sampling::Random;
use super::shells::{End, Shells};
use super::stokes::{Basis, Mueller, Stokes, dipole_of_natural_light};
use crate::atmosphere::{OpticalProfile, Phase};
use crate::error::{Error, Result};
use glam::DVec3;

/// A component that scatters.
pub(super) struct Scatterer<'a> {
    phase: &'a Phase,
    /// Scattering coefficient at the altitudes of the profile [km-1].
    scattering: Vec<f64>,
    angles: Angles,
    /// Part of the phase function that is a dipole's, the rest being isotropic; `None` for particles.
    dipole: Option<f64>,
}

/// A layer of the profile and the fraction of the way through it.
pub(super) type Place = (usize, f64);

/// One air at one wavelength.
pub(super) struct Medium<'a> {
    pub shells: Shells,
    pub scatterers: Vec<Scatterer<'a>>,
    /// Extinction coefficient at the altitudes of the profile [km-1].
    extinction: Vec<f64>,
    pub ground_albedo: f64,
    pub wavelength: usize,
    pub polarised: bool,
}

impl<'a> Medium<'a> {
    pub fn new(profile: &'a OpticalProfile, wavelength: usize) -> Result<Self> {
        profile.validate()?;
        let wavelengths = profile.wavelengths_nm.len();
        if wavelength >= wavelengths {
            return Err(Error::input("wavelength_index", wavelength, format!("less than {wavelengths}")));
        }
        let column = |values: &[f64]| -> Vec<f64> { values.iter().skip(wavelength).step_by(wavelengths).copied().collect() };
        let mut extinction = vec![0.0; profile.altitudes_km.len()];
        let mut scatterers = Vec::new();
        for component in &profile.components {
            let scattering = column(&component.scattering_per_km);
            for (i, absorption) in column(&component.absorption_per_km).into_iter().enumerate() {
                extinction[i] += absorption + scattering[i];
            }
            if let Some(phase) = &component.phase {
                // The weight of cos^2, which is 3/4 for a dipole.
                let dipole = phase.molecular_weights(wavelength).map(|[_, square]| square / 0.75);
                scatterers.push(Scatterer { phase, scattering, angles: Angles::new(phase, wavelength), dipole });
            }
        }
        Ok(Self {
            shells: Shells::new(profile.planet_radius_km, profile.altitudes_km.clone(), extinction.clone()),
            scatterers,
            extinction,
            ground_albedo: profile.ground_albedo[wavelength],
            wavelength,
            polarised: false,
        })
    }

    pub fn chord(&self, point: DVec3, direction: DVec3) -> Chord {
        let radius = point.length().max(self.shells.planet_radius);
        Chord { altitude: radius - self.shells.planet_radius, radius, cosine: point.dot(direction) / radius }
    }

    /// Fraction of the sunlight from direction `sun` that arrives at `point`: 0 behind the planet.
    pub fn sunlight(&self, point: DVec3, sun: DVec3) -> f64 {
        let chord = self.chord(point, sun);
        match self.shells.end(&chord) {
            (End::Ground, _) => 0.0,
            (End::Space, length) => (-self.shells.optical_depth(&chord, length)).exp(),
        }
    }

    /// Extinction coefficient [km-1].
    pub fn extinction(&self, place: Place) -> f64 {
        interpolate(&self.extinction, place)
    }

    /// Scattering coefficient of all components [km-1].
    pub fn scattering(&self, place: Place) -> f64 {
        self.scatterers.iter().map(|s| s.scattering(place)).sum()
    }

    /// What unpolarised light from direction `source` scatters into direction `into`: sum over components of scattering
    /// coefficient times phase function [km-1], for an irradiance of 4 pi.
    pub fn scattered_natural_light(&self, place: Place, into: DVec3, into_basis: &Basis, source: DVec3) -> Stokes {
        let cosine = into.dot(source);
        let mut sum = [0.0; 3];
        for scatterer in &self.scatterers {
            let coefficient = scatterer.scattering(place);
            match scatterer.dipole {
                Some(dipole) if self.polarised => {
                    let stokes = dipole_of_natural_light(into_basis, source);
                    sum[0] += coefficient * (1.0 - dipole);
                    (0..3).for_each(|i| sum[i] += coefficient * dipole * stokes[i]);
                }
                _ => sum[0] += coefficient * scatterer.phase(self.wavelength, cosine),
            }
        }
        sum
    }

    /// How light that is seen in direction `source` scatters into direction `into`: sum over components of scattering
    /// coefficient times scattering matrix [km-1]. Molecules scatter as dipoles with an isotropic, depolarised part; particles
    /// scatter the intensity by their phase function and depolarise it.
    pub fn scattering_matrix(&self, place: Place, into: (DVec3, &Basis), source: (DVec3, &Basis)) -> Mueller {
        let cosine = into.0.dot(source.0);
        let mut sum = Mueller([[0.0; 3]; 3]);
        for scatterer in &self.scatterers {
            let coefficient = scatterer.scattering(place);
            match scatterer.dipole {
                Some(dipole) if self.polarised => {
                    let matrix = Mueller::dipole(into.1, source.1);
                    for i in 0..3 {
                        for j in 0..3 {
                            sum.0[i][j] += coefficient * dipole * matrix.0[i][j];
                        }
                    }
                    sum.0[0][0] += coefficient * (1.0 - dipole);
                }
                _ => sum.0[0][0] += coefficient * scatterer.phase(self.wavelength, cosine),
            }
        }
        sum
    }

    /// Cosine of a random scattering angle; directions about an axis have the density [`Self::angle_density`] / 4 pi. `None`
    /// where nothing scatters.
    pub fn sample_angle(&self, place: Place, random: &mut Random) -> Option<f64> {
        let mut left = random.uniform() * self.scattering(place);
        let chosen = self.scatterers.iter().find(|scatterer| {
            left -= scatterer.scattering(place);
            left < 0.0
        });
        // Rounding can leave nothing chosen at the very end of the range.
        Some(chosen.or(self.scatterers.iter().find(|s| s.scattering(place) > 0.0))?.angles.sample(random))
    }

    /// Density times 4 pi of directions at an angle with cosine `cosine` from the axis of [`Self::sample_angle`].
    pub fn angle_density(&self, place: Place, cosine: f64) -> f64 {
        let bin = bin(cosine);
        let (mut sum, mut total) = (0.0, 0.0);
        for scatterer in &self.scatterers {
            let coefficient = scatterer.scattering(place);
            sum += coefficient * scatterer.angles.density(bin);
            total += coefficient;
        }
        sum / total
    }
}

impl Scatterer<'_> {
    /// Scattering coefficient [km-1].
    pub fn scattering(&self, place: Place) -> f64 {
        interpolate(&self.scattering, place)
    }

    /// Phase function at an angle with cosine `cosine`.
    pub fn phase(&self, wavelength: usize, cosine: f64) -> f64 {
        self.phase.value(wavelength, cosine.clamp(-1.0, 1.0))
    }
}

fn interpolate(values: &[f64], (layer, fraction): Place) -> f64 {
    values[layer] * (1.0 - fraction) + values[layer + 1] * fraction
}
