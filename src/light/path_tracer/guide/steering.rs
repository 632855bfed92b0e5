//! The guide at work on one path: distances, directions and the number of paths that go on.

use super::build::LARGEST_PHASE;
use super::{Ending, Flight, Guide, Lobes, Sunshine};
use crate::light::path_tracer::air::Air;
use crate::light::path_tracer::medium::Ray;
use crate::light::path_tracer::sampling::Random;
use crate::light::path_tracer::shells::End;
use glam::DVec3;

/// A path goes on with its weight if that is within this factor of what the guide wants; else it is split, or ended by chance.
const WINDOW: f64 = 2.0;

/// Limits of the expected number of paths that go on.
const FEWEST: f64 = 0.02;
const MOST: f64 = 16.0;

/// A guide, its air, and the memory that it needs.
pub(in crate::light::path_tracer) struct Steering<'a> {
    pub guide: &'a Guide,
    air: &'a Air<'a>,
    flight: Flight,
    lobes: Box<Lobes>,
    phases: Vec<f64>,
    /// Radiance that the guide expects at the observer.
    expected: f64,
}

impl<'a> Steering<'a> {
    pub fn new(guide: &'a Guide, air: &'a Air<'a>) -> Self {
        Self { guide, air, flight: Flight::default(), lobes: Box::default(), phases: Vec::new(), expected: 0.0 }
    }

    /// A random end of a ray of a `length` [km]; `None` for a ray without length. On the line of sight (`first`) the Sun's light that the air
    /// scatters once is not looked for.
    pub fn fly(&mut self, ray: &Ray, (end, length): (End, f64), sun: DVec3, first: bool, random: &mut Random) -> Option<Ending> {
        let cosine = ray.direction.dot(sun);
        self.phases.clear();
        self.phases.extend(self.air.scatterers.iter().map(|s| s.pattern.value(cosine)));
        let zenith_cosine = ray.start.dot(sun) / ray.chord.radius;
        let sunshine = Sunshine { zenith_cosine, cosine, phases: if first { None } else { Some(&self.phases) } };
        self.flight.trace(self.guide, &ray.chord, length, end == End::Ground);
        let expected = self.flight.aim(self.guide, &sunshine);
        if first {
            self.expected = expected;
        }
        self.flight.draw(random)
    }

    /// How many paths go on from a vertex, and the factor of their weight; `None` where the guide expects no light at the observer. `strength` is what
    /// they are worth, `light(guide)` the mean radiance around the vertex that the guide expects.
    pub fn population(&self, strength: f64, light: impl Fn(&Guide) -> f64, random: &mut Random) -> Option<(usize, f64)> {
        if self.expected <= 0.0 {
            return None;
        }
        let wanted = strength * light(self.guide) / self.expected;
        if (1.0 / WINDOW..=WINDOW).contains(&wanted) {
            return Some((1, 1.0));
        }
        let mean = wanted.clamp(FEWEST, MOST);
        Some(((mean + random.uniform()) as usize, 1.0 / mean))
    }

    /// Directions from which light comes to the point at `altitude` [km] over `up` and turns into `direction`; `None` if there are none.
    pub fn lobes(&mut self, altitude: f64, up: DVec3, sun: DVec3, direction: DVec3) -> Option<&Lobes> {
        let (scatterers, place) = (&self.air.scatterers, self.air.shells.locate(altitude));
        self.phases.clear();
        self.phases.extend(scatterers.iter().map(|s| s.scattering(place)));
        let coefficients = &self.phases;
        self.lobes.aim(self.guide, altitude, up, sun, |next| {
            let cosine = next.dot(direction);
            let each = scatterers.iter().zip(coefficients);
            each.map(|(scatterer, coefficient)| coefficient * scatterer.pattern.value(cosine).min(LARGEST_PHASE)).sum()
        });
        self.aimed()
    }

    /// Directions from which light comes to the ground under `up`; `None` if there are none.
    pub fn ground_lobes(&mut self, up: DVec3, sun: DVec3) -> Option<&Lobes> {
        self.lobes.aim(self.guide, 0.0, up, sun, |next| next.dot(up).max(0.0));
        self.aimed()
    }

    fn aimed(&self) -> Option<&Lobes> {
        (!self.lobes.is_empty()).then_some(&*self.lobes)
    }
}
