//! The random paths of light scattered more than once, drawn backwards from the observer.
//!
//! At every vertex a path looks at the Sun (next event estimation). The next direction comes from a mixture of the phase functions, of the phase functions
//! turned about the Sun (so that two small turns into the aureole leave no rare, heavy path), and of the guide; the next distance
//! from the guide, or else from the collisions. Weights are the physical density over that of the mixture.

use super::super::chord::Chord;
use super::disc::Disc;
use super::guide::{Ending, Flight, Guide, Lobes, Sunshine};
use super::medium::{Medium, Place};
use super::sampling::{Random, around, lambertian};
use super::shells::End;
use super::stokes::{Basis, Mueller, Stokes, basis};
use glam::DVec3;
use std::f64::consts::PI;

/// Paths without a guide play Russian roulette once their strength has fallen below this part of what it was after the first event,
const ROULETTE_SHARE: f64 = 0.2;

/// and not before this number of events.
const ROULETTE_EVENTS: usize = 3;

/// Share of the first directions drawn about the Sun, where the Sun is up; it halves at every event, because weights that vary at each of many events
/// would end in few heavy paths.
const SUN_SHARE: f64 = 0.4;

/// Share of uniform distances of paths without a guide.
const BLIND_UNIFORM_SHARE: f64 = 0.2;

/// Sine of the depth below the horizon to which the Sun counts as up.
const SUN_DEPTH: f64 = 0.03;

/// Share of the other directions that the guide draws.
const GUIDED_SHARE: f64 = 0.7;

/// A path goes on with its weight if that is within this factor of what the guide wants; else it is split, or ended by chance.
const WINDOW: f64 = 2.0;

/// Limits of the expected number of paths that go on.
const FEWEST: f64 = 0.02;
const MOST: f64 = 16.0;

/// The observer and the Sun, about the planet's centre: z through the observer, x towards the Sun's azimuth, lengths in km.
pub(super) struct Scene {
    pub start: DVec3,
    pub view: DVec3,
    pub sun: Disc,
    /// Length of the line of sight in whose air light is looked for [km], and not on the ground; `None` for all of it and the ground.
    pub length: Option<f64>,
}

impl Scene {
    /// How the line of sight ends, and at which distance, where `end` is what shells and ground say.
    pub fn end(&self, end: (End, f64)) -> (End, f64) {
        self.length.map_or(end, |length| (End::Space, length.min(end.1)))
    }
}

/// An end of a path, on its way.
struct Tip {
    position: DVec3,
    direction: DVec3,
    basis: Basis,
    /// What Stokes vectors seen here become at the observer.
    weight: Mueller,
    events: usize,
    roulette_strength: f64,
}

/// Draws paths; holds the memory that they need.
pub(super) struct Walker<'a> {
    medium: &'a Medium<'a>,
    scene: &'a Scene,
    guide: Option<&'a Guide>,
    tips: Vec<Tip>,
    flight: Flight,
    lobes: Box<Lobes>,
    phases: Vec<f64>,
    /// Radiance that the guide expects at the observer; 0 without a guide.
    expected: f64,
}

impl<'a> Walker<'a> {
    pub fn new(medium: &'a Medium<'a>, scene: &'a Scene, guide: Option<&'a Guide>) -> Self {
        let (flight, lobes) = (Flight::default(), Box::default());
        Self { medium, scene, guide, tips: Vec::new(), flight, lobes, phases: Vec::new(), expected: 0.0 }
    }

    /// The value of one random path, with all its branches.
    pub fn path(&mut self, random: &mut Random) -> Stokes {
        let (position, direction) = (self.scene.start, self.scene.view);
        let (weight, events, roulette_strength) = (Mueller::IDENTITY, 0, 0.0);
        self.tips.push(Tip { position, direction, basis: basis(direction), weight, events, roulette_strength });
        let mut value = [0.0; 3];
        while let Some(tip) = self.tips.pop() {
            self.advance(tip, &mut value, random);
        }
        value
    }

    /// Moves a tip to its next vertex, adds the sunlight there to `value` and lets it go on from there.
    fn advance(&mut self, mut tip: Tip, value: &mut Stokes, random: &mut Random) {
        let medium = self.medium;
        let chord = medium.chord(tip.position, tip.direction);
        let mut end = medium.shells.end(&chord);
        if tip.events == 0 {
            end = self.scene.end(end);
        }
        let (end, length) = end;
        let Some((collision, ratio)) = self.fly(&tip, &chord, end, length, random) else { return };
        tip.weight = tip.weight.scaled(ratio);
        tip.position += tip.direction * collision.unwrap_or(length);
        let up = tip.position.normalize();
        let sun = self.scene.sun.sample(random);
        let sun_zenith_cosine = up.dot(self.scene.sun.centre());
        let (copies, share);
        if let Some(distance) = collision {
            let altitude = chord.altitude_at(distance).max(0.0);
            let place = medium.shells.locate(altitude);
            if tip.events > 0 {
                let light = medium.sunlight(tip.position, sun) / (4.0 * PI);
                if light > 0.0 {
                    let once = medium.scattered_natural_light(place, tip.direction, &tip.basis, sun);
                    add(value, light, &tip.weight.applied_to(&once));
                }
            }
            let strength = tip.weight.intensity() * medium.scattering(place);
            let light = |guide: &Guide| guide.mean_intensity_at(altitude, sun_zenith_cosine);
            (copies, share) = self.population(&mut tip, strength, light, random);
            for _ in 0..copies {
                let Some((next, density)) = self.turn(place, altitude, up, &tip, random) else { return };
                let basis = basis(next);
                let matrix = medium.scattering_matrix(place, (tip.direction, &tip.basis), (next, &basis));
                let weight = tip.weight.times(&matrix).scaled(share / density);
                self.push(&tip, tip.position, next, basis, weight);
            }
        } else {
            let position = up * medium.shells.planet_radius;
            tip.weight = tip.weight.times(&Mueller::depolarising(medium.ground_albedo));
            let light = sun.dot(up).max(0.0) / PI;
            if light > 0.0 && tip.weight.intensity() > 0.0 {
                add(value, light * medium.sunlight(position, sun), &tip.weight.applied_to(&[1.0, 0.0, 0.0]));
            }
            let strength = tip.weight.intensity();
            let light = |guide: &Guide| guide.ground_radiance_by_sky(sun_zenith_cosine) / medium.ground_albedo;
            (copies, share) = self.population(&mut tip, strength, light, random);
            for _ in 0..copies {
                let (next, ratio) = self.leave_ground(up, random);
                self.push(&tip, position, next, basis(next), tip.weight.scaled(share * ratio));
            }
        }
    }

    fn push(&mut self, from: &Tip, position: DVec3, direction: DVec3, basis: Basis, weight: Mueller) {
        if weight.intensity() > 0.0 {
            let (events, roulette_strength) = (from.events + 1, from.roulette_strength);
            self.tips.push(Tip { position, direction, basis, weight, events, roulette_strength });
        }
    }

    /// The distance at which `tip` collides [km], `None` on the ground, and what its weight is multiplied by: the transmittance over
    /// the density of the distance, or over the probability of the ground. `None` in all where it leaves the air.
    fn fly(&mut self, tip: &Tip, chord: &Chord, end: End, length: f64, random: &mut Random) -> Option<(Option<f64>, f64)> {
        let medium = self.medium;
        let Some(guide) = self.guide else { return fly_blindly(medium, chord, end, length, random) };
        let sun = self.scene.sun.centre();
        let sun_cosine = tip.direction.dot(sun);
        self.phases.clear();
        self.phases.extend(medium.scatterers.iter().map(|s| s.phase(medium.wavelength, sun_cosine)));
        let sunshine = Sunshine {
            zenith_cosine: tip.position.dot(sun) / chord.radius,
            cosine: sun_cosine,
            phases: if tip.events > 0 { Some(&self.phases) } else { None },
        };
        self.flight.trace(guide, chord, length, end == End::Ground);
        let expected = self.flight.aim(guide, &sunshine);
        if tip.events == 0 {
            self.expected = expected;
        }
        match self.flight.draw(random)? {
            Ending::Ground(probability) => Some((None, (-medium.shells.optical_depth(chord, length)).exp() / probability)),
            Ending::Air { distance, density } => {
                Some((Some(distance), (-medium.shells.optical_depth(chord, distance)).exp() / density))
            }
        }
    }

    /// How many paths go on from a vertex, and the factor of their weight. `strength` is what they are worth: weight times scattering coefficient, or times albedo;
    /// `light` is the mean radiance around the vertex that the guide expects.
    fn population(&self, tip: &mut Tip, strength: f64, light: impl Fn(&Guide) -> f64, random: &mut Random) -> (usize, f64) {
        if strength <= 0.0 {
            return (0, 0.0);
        }
        if let Some(guide) = self.guide.filter(|_| self.expected > 0.0) {
            let wanted = strength * light(guide) / self.expected;
            if (1.0 / WINDOW..=WINDOW).contains(&wanted) {
                return (1, 1.0);
            }
            let mean = wanted.clamp(FEWEST, MOST);
            return ((mean + random.uniform()) as usize, 1.0 / mean);
        }
        if tip.events == 0 {
            tip.roulette_strength = ROULETTE_SHARE * strength;
        } else if tip.events + 1 >= ROULETTE_EVENTS && strength < tip.roulette_strength {
            let chance = strength / tip.roulette_strength;
            return (usize::from(random.uniform() < chance), 1.0 / chance);
        }
        (1, 1.0)
    }

    /// A random direction from which light is scattered into the direction of `tip`, and its density times 4 pi. `None` where nothing scatters.
    fn turn(&mut self, place: Place, altitude: f64, up: DVec3, tip: &Tip, random: &mut Random) -> Option<(DVec3, f64)> {
        let medium = self.medium;
        let sun = self.scene.sun.centre();
        if let Some(guide) = self.guide {
            let wavelength = medium.wavelength;
            self.phases.clear();
            self.phases.extend(medium.scatterers.iter().map(|s| s.scattering(place)));
            let coefficients = &self.phases;
            self.lobes.aim(guide, altitude, up, sun, |next| {
                let cosine = next.dot(tip.direction);
                let each = medium.scatterers.iter().zip(coefficients);
                each.map(|(scatterer, coefficient)| coefficient * scatterer.phase(wavelength, cosine).min(6.0)).sum()
            });
        }
        let radius = medium.shells.planet_radius;
        let horizon = -(altitude * (2.0 * radius + altitude)).sqrt() / (radius + altitude);
        let sun_share = if up.dot(sun) > horizon - SUN_DEPTH { SUN_SHARE * 0.5_f64.powi(tip.events as i32) } else { 0.0 };
        let guided = if self.guide.is_some() && !self.lobes.is_empty() { (1.0 - sun_share) * GUIDED_SHARE } else { 0.0 };
        let kind = random.uniform();
        let next = if kind < guided {
            self.lobes.draw(random)
        } else {
            let axis = if kind < guided + sun_share { sun } else { tip.direction };
            around(axis, medium.sample_angle(place, random)?, random)
        };
        let mut density = (1.0 - guided - sun_share) * medium.angle_density(place, next.dot(tip.direction));
        if sun_share > 0.0 {
            density += sun_share * medium.angle_density(place, next.dot(sun));
        }
        if guided > 0.0 {
            density += guided * self.lobes.density(next);
        }
        Some((next, density))
    }

    /// A random direction from the ground, and its Lambertian density cosine / pi over the one it was drawn with.
    fn leave_ground(&mut self, up: DVec3, random: &mut Random) -> (DVec3, f64) {
        let guided = if let Some(guide) = self.guide {
            self.lobes.aim(guide, 0.0, up, self.scene.sun.centre(), |next| next.dot(up).max(0.0));
            if self.lobes.is_empty() { 0.0 } else { GUIDED_SHARE }
        } else {
            0.0
        };
        let next = if random.uniform() < guided { self.lobes.draw(random) } else { lambertian(up, random) };
        let wanted = 4.0 * next.dot(up).max(0.0);
        let density = (1.0 - guided) * wanted + if guided > 0.0 { guided * self.lobes.density(next) } else { 0.0 };
        (next, if density > 0.0 { wanted / density } else { 0.0 })
    }
}

/// Without a guide: distances follow the collisions; those of rays to space never leave the air, and a few of them are uniform, because high,
/// thin air may be all that is lit.
fn fly_blindly(medium: &Medium, chord: &Chord, end: End, length: f64, random: &mut Random) -> Option<(Option<f64>, f64)> {
    if end == End::Ground {
        let depth = -(1.0 - random.uniform()).ln();
        let Some(distance) = medium.shells.distance_at(chord, depth, length) else { return Some((None, 1.0)) };
        let extinction = medium.extinction(medium.shells.locate(chord.altitude_at(distance)));
        return Some((Some(distance), 1.0 / extinction));
    }
    let collided = -(-medium.shells.optical_depth(chord, length)).exp_m1();
    if collided <= 0.0 {
        return None;
    }
    let distance = if random.uniform() >= BLIND_UNIFORM_SHARE {
        medium.shells.distance_at(chord, -(-random.uniform() * collided).ln_1p(), length).unwrap_or(length)
    } else {
        length * random.uniform()
    };
    let transmittance = (-medium.shells.optical_depth(chord, distance)).exp();
    let collisions = medium.extinction(medium.shells.locate(chord.altitude_at(distance))) * transmittance;
    Some((Some(distance), transmittance / ((1.0 - BLIND_UNIFORM_SHARE) * collisions / collided + BLIND_UNIFORM_SHARE / length)))
}

fn add(value: &mut Stokes, factor: f64, term: &Stokes) {
    for i in 0..3 {
        value[i] += factor * term[i];
    }
}
