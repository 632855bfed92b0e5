//! The air of spherical shells at one wavelength: the medium in which all but directions is exact.

use super::angles::bin;
use super::medium::{Flown, Medium, Ray, chord};
use super::pattern::Pattern;
use super::sampling::Random;
use super::shells::{End, Shells};
use super::stokes::{Basis, Mueller, Stokes};
use crate::atmosphere::OpticalProfile;
use crate::error::{Error, Result};
use glam::DVec3;

/// Share of uniform distances of paths without a guide.
const BLIND_UNIFORM_SHARE: f64 = 0.2;

/// A component that scatters.
pub(super) struct Scatterer<'a> {
    pub pattern: Pattern<'a>,
    /// Scattering coefficient at the altitudes of the profile [km-1].
    scattering: Vec<f64>,
}

/// A layer of the profile and the fraction of the way through it.
pub(super) type Place = (usize, f64);

/// One air at one wavelength.
pub(super) struct Air<'a> {
    pub shells: Shells,
    pub scatterers: Vec<Scatterer<'a>>,
    /// Extinction coefficient at the altitudes of the profile [km-1].
    extinction: Vec<f64>,
    pub ground_albedo: f64,
    /// Index of the wavelength, and their number in the profile.
    pub wavelength: (usize, usize),
    pub polarised: bool,
}

impl<'a> Air<'a> {
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
                scatterers.push(Scatterer { pattern: Pattern::new(phase, wavelength), scattering });
            }
        }
        Ok(Self {
            shells: Shells::new(profile.planet_radius_km, profile.altitudes_km.clone(), extinction.clone()),
            scatterers,
            extinction,
            ground_albedo: profile.ground_albedo[wavelength],
            wavelength: (wavelength, wavelengths),
            polarised: false,
        })
    }

    /// [`Medium::sunlight`], which is exact here.
    pub fn exact_sunlight(&self, point: DVec3, sun: DVec3) -> f64 {
        let chord = chord(self.shells.planet_radius, point, sun);
        match self.shells.end(&chord) {
            (End::Ground, _) => 0.0,
            (End::Space, length) => (-self.shells.optical_depth(&chord, length)).exp(),
        }
    }

    /// [`Medium::angle_density`] times [`Medium::scattering`], and the latter.
    pub fn weighted_angle_density(&self, place: Place, cosine: f64) -> (f64, f64) {
        let bin = bin(cosine);
        let (mut sum, mut total) = (0.0, 0.0);
        for scatterer in &self.scatterers {
            let coefficient = scatterer.scattering(place);
            sum += coefficient * scatterer.pattern.density(bin);
            total += coefficient;
        }
        (sum, total)
    }
}

impl Medium for Air<'_> {
    type Place = Place;

    fn as_air(&self) -> Option<&Air<'_>> {
        Some(self)
    }

    fn planet_radius(&self) -> f64 {
        self.shells.planet_radius
    }

    fn top(&self) -> f64 {
        self.shells.top()
    }

    fn ground_albedo(&self) -> f64 {
        self.ground_albedo
    }

    fn end(&self, ray: &Ray) -> (End, f64) {
        self.shells.end(&ray.chord)
    }

    fn place(&self, ray: &Ray, distance: f64) -> Place {
        self.shells.locate(ray.chord.altitude_at(distance))
    }

    fn extinction(&self, place: Place) -> f64 {
        interpolate(&self.extinction, place)
    }

    fn scattering(&self, place: Place) -> f64 {
        self.scatterers.iter().map(|s| s.scattering(place)).sum()
    }

    fn scattered_natural_light(&self, place: Place, into: DVec3, into_basis: &Basis, source: DVec3) -> Stokes {
        let cosine = into.dot(source);
        let mut sum = [0.0; 3];
        for scatterer in &self.scatterers {
            let coefficient = scatterer.scattering(place);
            scatterer.pattern.add_natural_light(coefficient, self.polarised, into_basis, source, cosine, &mut sum);
        }
        sum
    }

    fn scattering_matrix(&self, place: Place, into: (DVec3, &Basis), source: (DVec3, &Basis)) -> Mueller {
        let cosine = into.0.dot(source.0);
        let mut sum = Mueller([[0.0; 3]; 3]);
        for scatterer in &self.scatterers {
            scatterer.pattern.add_matrix(scatterer.scattering(place), self.polarised, into.1, source.1, cosine, &mut sum);
        }
        sum
    }

    fn sample_angle(&self, place: Place, random: &mut Random) -> Option<f64> {
        let mut left = random.uniform() * self.scattering(place);
        let chosen = self.scatterers.iter().find(|scatterer| {
            left -= scatterer.scattering(place);
            left < 0.0
        });
        // Rounding can leave nothing chosen at the very end of the range.
        Some(chosen.or(self.scatterers.iter().find(|s| s.scattering(place) > 0.0))?.pattern.sample(random))
    }

    fn angle_density(&self, place: Place, cosine: f64) -> f64 {
        let (sum, total) = self.weighted_angle_density(place, cosine);
        sum / total
    }

    fn transmittance(&self, ray: &Ray, distance: f64, _random: &mut Random) -> f64 {
        (-self.shells.optical_depth(&ray.chord, distance)).exp()
    }

    /// Distances follow the collisions; those of rays to space never leave the air, and a few of them are uniform, because high, thin air may be
    /// all that is lit.
    fn fly(&self, ray: &Ray, end: End, length: f64, random: &mut Random) -> Option<Flown> {
        let (shells, chord) = (&self.shells, &ray.chord);
        if end == End::Ground {
            let depth = -(1.0 - random.uniform()).ln();
            let Some(distance) = shells.distance_at(chord, depth, length) else { return Some((None, 1.0)) };
            return Some((Some(distance), 1.0 / self.extinction(self.place(ray, distance))));
        }
        let collided = -(-shells.optical_depth(chord, length)).exp_m1();
        if collided <= 0.0 {
            return None;
        }
        let distance = if random.uniform() >= BLIND_UNIFORM_SHARE {
            shells.distance_at(chord, -(-random.uniform() * collided).ln_1p(), length).unwrap_or(length)
        } else {
            length * random.uniform()
        };
        let transmittance = (-shells.optical_depth(chord, distance)).exp();
        let collisions = self.extinction(self.place(ray, distance)) * transmittance;
        let density = (1.0 - BLIND_UNIFORM_SHARE) * collisions / collided + BLIND_UNIFORM_SHARE / length;
        Some((Some(distance), transmittance / density))
    }
}

impl Scatterer<'_> {
    /// Scattering coefficient [km-1].
    pub fn scattering(&self, place: Place) -> f64 {
        interpolate(&self.scattering, place)
    }
}

fn interpolate(values: &[f64], (layer, fraction): Place) -> f64 {
    values[layer] * (1.0 - fraction) + values[layer + 1] * fraction
}
