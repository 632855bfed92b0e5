//! A field of density in the air, such as clouds: extinction that differs from point to point, met by null collisions.
//!
//! Collisions are drawn as though the extinction were everywhere its majorant, and each is kept with the probability extinction / majorant (delta tracking:
//! Woodcock et al. 1965); a transmittance is the product of 1 - extinction / majorant over all of them (ratio tracking: Novak, Selle & Jarosz 2014). Both are
//! right on the average whatever the field is, if it nowhere exceeds its majorant. The air around it stays exact: the first of the collisions with air and field counts.

use super::air::{self, Air};
use super::angles::bin;
use super::medium::{Flown, Medium, Ray};
use super::pattern::Pattern;
use super::sampling::Random;
use super::shells::End;
use super::stokes::{Basis, Mueller, Stokes};
use crate::atmosphere::Phase;
use crate::error::{Error, Result, check_range};
use glam::DVec3;
use std::sync::OnceLock;

/// Largest majorant [km-1]: a ray along the horizon may take as many steps as it has optical depth.
const LARGEST_MAJORANT_PER_KM: f64 = 1e4;

/// Below this a transmittance is kept by chance alone, so that no ray is followed through what hides all.
const ROULETTE_TRANSMITTANCE: f64 = 0.1;

/// A field of extinction in space, on top of that of the air, at one wavelength: clouds, plumes, layers that are no shells.
///
/// Points are in km from the planet's centre, in the frame of the tracer: z through the observer, x towards the Sun's azimuth, y so that the frame is
/// right-handed. A point over which the observer stands at sea level is (0, 0, planet radius).
pub trait Field: Sync {
    /// Extinction coefficient \[km-1\] at a point \[km\], 0 to [`Self::majorant_per_km`]: equal points give equal values. It is asked for within
    /// [`Self::altitudes_km`] only (but for rounding). A value outside of its range makes the estimate an error.
    fn extinction_per_km(&self, point_km: DVec3) -> f64;

    /// What the extinction coefficient nowhere exceeds \[km-1\], 0 to 1e4. The nearer to the largest value, the fewer steps and the less noise.
    fn majorant_per_km(&self) -> f64;

    /// Altitudes above the ground \[km\] below and above which there is nothing of the field: the lower at least 0, the upper above it and at most the top of the air.
    fn altitudes_km(&self) -> (f64, f64);

    /// Part of the extinction that is scattering, 0 to 1.
    fn single_scattering_albedo(&self) -> f64;

    /// Phase function, of one wavelength or of all those of the air.
    fn phase(&self) -> &Phase;
}

/// Spherical shells of air, and a field in it.
pub(super) struct AirWithField<'a, F: ?Sized> {
    air: Air<'a>,
    field: &'a F,
    majorant: f64,
    lower: f64,
    upper: f64,
    albedo: f64,
    pattern: Pattern<'a>,
    /// An extinction that the field must not have, if one was met.
    refused: OnceLock<f64>,
}

/// A place in the air, and the extinction coefficient of the field there [km-1].
#[derive(Clone, Copy)]
pub(super) struct Place {
    air: air::Place,
    field: f64,
}

impl<'a, F: Field + ?Sized> AirWithField<'a, F> {
    pub fn new(air: Air<'a>, field: &'a F) -> Result<Self> {
        let (majorant, albedo, (lower, upper)) =
            (field.majorant_per_km(), field.single_scattering_albedo(), field.altitudes_km());
        check_range("majorant_per_km", majorant, 0.0, LARGEST_MAJORANT_PER_KM, "km-1")?;
        check_range("single_scattering_albedo", albedo, 0.0, 1.0, "")?;
        check_range("altitudes_km", lower, 0.0, air.shells.top(), "km")?;
        check_range("altitudes_km", upper, 0.0, air.shells.top(), "km")?;
        if lower >= upper {
            return Err(Error::input("altitudes_km", format!("{lower} to {upper} km"), "a lower and a greater upper altitude"));
        }
        let (wavelength, wavelengths) = air.wavelength;
        field.phase().validate("field", wavelengths)?;
        let pattern = Pattern::new(field.phase(), wavelength);
        Ok(Self { air, field, majorant, lower, upper, albedo, pattern, refused: OnceLock::new() })
    }

    /// Whether the field has kept to its range wherever it was met.
    pub fn check(&self) -> Result<()> {
        match self.refused.get() {
            Some(value) => {
                let allowed = format!("0 to majorant_per_km = {} km-1 at every point", self.majorant);
                Err(Error::input("extinction_per_km", value, allowed))
            }
            None => Ok(()),
        }
    }

    /// The field's extinction coefficient at a point [km-1].
    fn field_extinction(&self, point: DVec3) -> f64 {
        let value = self.field.extinction_per_km(point);
        if (0.0..=self.majorant).contains(&value) {
            return value;
        }
        let _ = self.refused.set(value);
        0.0
    }

    /// The first `length` [km] of a ray as far as they lie between the altitudes of the field: ends of two pieces, which may be empty.
    fn pieces(&self, ray: &Ray, length: f64) -> [(f64, f64); 2] {
        const NONE: (f64, f64) = (0.0, 0.0);
        let Some((way_in, way_out)) = ray.chord.crossings(self.upper).filter(|_| self.majorant > 0.0) else { return [NONE; 2] };
        let (from, to) = (way_in.max(0.0), way_out.min(length));
        match ray.chord.crossings(self.lower) {
            Some((below, above)) => [(from, to.min(below)), (from.max(above), to)],
            None => [(from, to), NONE],
        }
    }

    fn meets(&self, ray: &Ray, length: f64) -> bool {
        self.pieces(ray, length).iter().any(|(from, to)| from < to)
    }

    /// Distance [km] to the next point where the majorant has a collision.
    fn step(&self, random: &mut Random) -> f64 {
        -(1.0 - random.uniform()).ln() / self.majorant
    }

    /// Distance of the first collision with the field, if there is one before `length` [km].
    fn collide(&self, ray: &Ray, length: f64, random: &mut Random) -> Option<f64> {
        for (from, to) in self.pieces(ray, length) {
            let mut t = from;
            while t < to {
                t += self.step(random);
                if t < to && random.uniform() * self.majorant < self.field_extinction(ray.at(t)) {
                    return Some(t);
                }
            }
        }
        None
    }

    /// Transmittance of the field alone, on the average.
    fn field_transmittance(&self, ray: &Ray, length: f64, random: &mut Random) -> f64 {
        let mut left = 1.0;
        for (from, to) in self.pieces(ray, length) {
            let mut t = from;
            while t < to {
                t += self.step(random);
                if t < to {
                    left *= 1.0 - self.field_extinction(ray.at(t)) / self.majorant;
                    if left < ROULETTE_TRANSMITTANCE {
                        if left <= 0.0 || random.uniform() < 0.5 {
                            return 0.0;
                        }
                        left *= 2.0;
                    }
                }
            }
        }
        left
    }
}

impl<F: Field + ?Sized> Medium for AirWithField<'_, F> {
    type Place = Place;

    fn as_air(&self) -> Option<&Air<'_>> {
        None
    }

    fn planet_radius(&self) -> f64 {
        self.air.planet_radius()
    }

    fn top(&self) -> f64 {
        self.air.top()
    }

    fn ground_albedo(&self) -> f64 {
        self.air.ground_albedo()
    }

    fn end(&self, ray: &Ray) -> (End, f64) {
        self.air.end(ray)
    }

    fn place(&self, ray: &Ray, distance: f64) -> Place {
        let within = (self.lower..=self.upper).contains(&ray.chord.altitude_at(distance));
        Place { air: self.air.place(ray, distance), field: if within { self.field_extinction(ray.at(distance)) } else { 0.0 } }
    }

    fn extinction(&self, place: Place) -> f64 {
        self.air.extinction(place.air) + place.field
    }

    fn scattering(&self, place: Place) -> f64 {
        self.air.scattering(place.air) + self.albedo * place.field
    }

    fn scattered_natural_light(&self, place: Place, into: DVec3, into_basis: &Basis, source: DVec3) -> Stokes {
        let mut sum = self.air.scattered_natural_light(place.air, into, into_basis, source);
        let (coefficient, cosine) = (self.albedo * place.field, into.dot(source));
        self.pattern.add_natural_light(coefficient, self.air.polarised, into_basis, source, cosine, &mut sum);
        sum
    }

    fn scattering_matrix(&self, place: Place, into: (DVec3, &Basis), source: (DVec3, &Basis)) -> Mueller {
        let mut sum = self.air.scattering_matrix(place.air, into, source);
        let (coefficient, cosine) = (self.albedo * place.field, into.0.dot(source.0));
        self.pattern.add_matrix(coefficient, self.air.polarised, into.1, source.1, cosine, &mut sum);
        sum
    }

    fn sample_angle(&self, place: Place, random: &mut Random) -> Option<f64> {
        if random.uniform() * self.scattering(place) < self.albedo * place.field {
            return Some(self.pattern.sample(random));
        }
        self.air.sample_angle(place.air, random)
    }

    fn angle_density(&self, place: Place, cosine: f64) -> f64 {
        let (sum, total) = self.air.weighted_angle_density(place.air, cosine);
        let coefficient = self.albedo * place.field;
        (sum + coefficient * self.pattern.density(bin(cosine))) / (total + coefficient)
    }

    fn transmittance(&self, ray: &Ray, distance: f64, random: &mut Random) -> f64 {
        self.air.transmittance(ray, distance, random) * self.field_transmittance(ray, distance, random)
    }

    /// Distances follow the collisions, and paths may leave the air; rays that pass the field by fly as in the air alone.
    fn fly(&self, ray: &Ray, end: End, length: f64, random: &mut Random) -> Option<Flown> {
        if !self.meets(ray, length) {
            return self.air.fly(ray, end, length, random);
        }
        let in_air = self.air.shells.distance_at(&ray.chord, -(1.0 - random.uniform()).ln(), length);
        match self.collide(ray, in_air.unwrap_or(length), random).or(in_air) {
            Some(distance) => {
                let extinction = self.extinction(self.place(ray, distance));
                // Rounding can put a collision at the very edge of the field outside of it.
                Some((Some(distance), if extinction > 0.0 { 1.0 / extinction } else { 0.0 }))
            }
            None if end == End::Ground => Some((None, 1.0)),
            None => None,
        }
    }
}

#[cfg(test)]
mod tests;
