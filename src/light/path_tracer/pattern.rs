//! How one component of a medium scatters, by angle and polarisation.

use super::angles::Angles;
use super::sampling::Random;
use super::stokes::{Basis, Mueller, Stokes, dipole_of_natural_light};
use crate::atmosphere::Phase;
use glam::DVec3;

/// A phase function at one wavelength.
pub(super) struct Pattern<'a> {
    phase: &'a Phase,
    wavelength: usize,
    angles: Angles,
    /// Part of the phase function that is a dipole's, the rest being isotropic; `None` for particles.
    dipole: Option<f64>,
}

impl<'a> Pattern<'a> {
    pub fn new(phase: &'a Phase, wavelength: usize) -> Self {
        // The weight of cos^2, which is 3/4 for a dipole.
        let dipole = phase.molecular_weights(wavelength).map(|[_, square]| square / 0.75);
        Self { phase, wavelength, angles: Angles::new(phase, wavelength), dipole }
    }

    /// The phase function at an angle with cosine `cosine`.
    pub fn value(&self, cosine: f64) -> f64 {
        self.phase.value(self.wavelength, cosine.clamp(-1.0, 1.0))
    }

    /// Cosine of a random angle.
    pub fn sample(&self, random: &mut Random) -> f64 {
        self.angles.sample(random)
    }

    /// Density times 4 pi of directions at angles of a bin ([`super::angles::bin`]).
    pub fn density(&self, bin: usize) -> f64 {
        self.angles.density(bin)
    }

    /// Adds what unpolarised light from direction `source` scatters into a direction with basis `into` at an angle with cosine `cosine`.
    pub fn add_natural_light(
        &self,
        coefficient: f64,
        polarised: bool,
        into: &Basis,
        source: DVec3,
        cosine: f64,
        sum: &mut Stokes,
    ) {
        match self.dipole {
            Some(dipole) if polarised => {
                let stokes = dipole_of_natural_light(into, source);
                sum[0] += coefficient * (1.0 - dipole);
                (0..3).for_each(|i| sum[i] += coefficient * dipole * stokes[i]);
            }
            _ => sum[0] += coefficient * self.value(cosine),
        }
    }

    /// Adds the scattering matrix from basis `source` into basis `into` at an angle with cosine `cosine`. Molecules scatter as dipoles with an isotropic,
    /// depolarised part; particles scatter the intensity by their phase function and depolarise it.
    pub fn add_matrix(&self, coefficient: f64, polarised: bool, into: &Basis, source: &Basis, cosine: f64, sum: &mut Mueller) {
        match self.dipole {
            Some(dipole) if polarised => {
                let matrix = Mueller::dipole(into, source);
                for i in 0..3 {
                    for j in 0..3 {
                        sum.0[i][j] += coefficient * dipole * matrix.0[i][j];
                    }
                }
                sum.0[0][0] += coefficient * (1.0 - dipole);
            }
            _ => sum.0[0][0] += coefficient * self.value(cosine),
        }
    }
}
