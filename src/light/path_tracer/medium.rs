//! What a path needs to know of what it goes through. Whoever wants the path tracer to judge something new implements [`Medium`]; the walk is compiled for each medium.

use super::super::chord::Chord;
use super::air::Air;
use super::sampling::Random;
use super::shells::End;
use super::stokes::{Basis, Mueller, Stokes};
use glam::DVec3;

/// A straight ray, in km from the planet's centre.
pub(super) struct Ray {
    pub start: DVec3,
    /// Unit vector.
    pub direction: DVec3,
    /// The ray relative to the planet.
    pub chord: Chord,
}

impl Ray {
    pub fn at(&self, distance: f64) -> DVec3 {
        self.start + self.direction * distance
    }
}

/// The end of a flight: the distance of its collision [km], `None` on the ground; and what the weight of a path is multiplied by:
/// the transmittance over the density of the distance [km-1], or over the probability of the ground.
pub(super) type Flown = (Option<f64>, f64);

/// One wavelength's extinction and scattering over a spherical, Lambertian ground, up to an altitude above which there is nothing.
///
/// Whatever is random here has the right expectation whatever else a path does: estimates stay unbiased.
pub(super) trait Medium: Sync {
    /// A point, as far as coefficients depend on it.
    type Place: Copy;

    /// The medium as air of spherical shells if it is that and nothing else. Then light scattered once is a quadrature (`single`) and there can be
    /// a guide; else light scattered once is drawn too, and paths are plain.
    fn as_air(&self) -> Option<&Air<'_>>;

    /// Radius of the ground [km].
    fn planet_radius(&self) -> f64;

    /// Altitude above which there is nothing [km].
    fn top(&self) -> f64;

    /// Lambertian albedo of the ground.
    fn ground_albedo(&self) -> f64;

    /// How a ray ends that starts below the top, and at which distance [km].
    fn end(&self, ray: &Ray) -> (End, f64);

    /// The place at `distance` [km] on a ray.
    fn place(&self, ray: &Ray, distance: f64) -> Self::Place;

    /// Extinction coefficient [km-1].
    fn extinction(&self, place: Self::Place) -> f64;

    /// Scattering coefficient [km-1]; over the extinction it is the single-scattering albedo.
    fn scattering(&self, place: Self::Place) -> f64;

    /// What unpolarised light from direction `source` scatters into direction `into`: scattering coefficient times phase function \[km-1\], for an irradiance of 4 pi.
    fn scattered_natural_light(&self, place: Self::Place, into: DVec3, into_basis: &Basis, source: DVec3) -> Stokes;

    /// How light that is seen in direction `source` scatters into direction `into`: scattering coefficient times scattering matrix \[km-1\].
    fn scattering_matrix(&self, place: Self::Place, into: (DVec3, &Basis), source: (DVec3, &Basis)) -> Mueller;

    /// Cosine of a random scattering angle, about as frequent as the phase function is large; directions about an axis have the density
    /// [`Self::angle_density`] / 4 pi. `None` where nothing scatters.
    fn sample_angle(&self, place: Self::Place, random: &mut Random) -> Option<f64>;

    /// Density times 4 pi of directions at an angle with cosine `cosine` from the axis of [`Self::sample_angle`].
    fn angle_density(&self, place: Self::Place, cosine: f64) -> f64;

    /// Transmittance from the start of a ray to `distance` [km]: exact, or random with the exact one as its expectation.
    fn transmittance(&self, ray: &Ray, distance: f64, random: &mut Random) -> f64;

    /// A random end of a ray of a `length` [km] that ends in `end`; `None` if it leaves the air.
    fn fly(&self, ray: &Ray, end: End, length: f64, random: &mut Random) -> Option<Flown>;

    /// The ray from `start` in `direction`.
    fn ray(&self, start: DVec3, direction: DVec3) -> Ray {
        Ray { start, direction, chord: chord(self.planet_radius(), start, direction) }
    }

    /// Fraction of the sunlight from direction `sun` that arrives at `point`, as [`Self::transmittance`]: 0 behind the planet.
    fn sunlight(&self, point: DVec3, sun: DVec3, random: &mut Random) -> f64 {
        let ray = self.ray(point, sun);
        match self.end(&ray) {
            (End::Ground, _) => 0.0,
            (End::Space, length) => self.transmittance(&ray, length, random),
        }
    }
}

/// The ray from `point` in `direction` relative to a planet; a point under the ground counts as on it.
pub(super) fn chord(planet_radius: f64, point: DVec3, direction: DVec3) -> Chord {
    let radius = point.length().max(planet_radius);
    Chord { altitude: radius - planet_radius, radius, cosine: point.dot(direction) / radius }
}
