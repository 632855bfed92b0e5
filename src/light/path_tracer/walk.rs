//! The random paths of light scattered more than once, drawn backwards from the observer.
//!
//! At every vertex a path looks at the Sun (next event estimation). The next direction comes from a mixture of the phase functions, of the phase functions
//! turned about the Sun (so that two small turns into the aureole leave no rare, heavy path), and of the guide; the next distance
//! from the guide, or else from the collisions. Weights are the physical density over that of the mixture.

use super::guide::{Ending, Guide, Steering};
use super::medium::{Flown, Medium, Ray};
use super::sampling::{Random, around, lambertian};
use super::scene::Scene;
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

/// Sine of the depth below the horizon to which the Sun counts as up.
const SUN_DEPTH: f64 = 0.03;

/// Share of the other directions that the guide draws.
const GUIDED_SHARE: f64 = 0.7;

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
pub(super) struct Walker<'a, M: Medium> {
    medium: &'a M,
    scene: &'a Scene,
    steering: Option<Steering<'a>>,
    /// Whether light scattered once counts, because no quadrature finds it.
    once: bool,
    tips: Vec<Tip>,
}

impl<'a, M: Medium> Walker<'a, M> {
    pub fn new(medium: &'a M, scene: &'a Scene, steering: Option<Steering<'a>>) -> Self {
        Self { medium, scene, steering, once: medium.as_air().is_none(), tips: Vec::new() }
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
        let ray = medium.ray(tip.position, tip.direction);
        let mut end = medium.end(&ray);
        if tip.events == 0 {
            end = self.scene.end(end);
        }
        let (end, length) = end;
        let Some((collision, ratio)) = self.fly(&tip, &ray, end, length, random) else { return };
        tip.weight = tip.weight.scaled(ratio);
        tip.position += tip.direction * collision.unwrap_or(length);
        let up = tip.position.normalize();
        let sun = self.scene.sun.sample(random);
        let sun_zenith_cosine = up.dot(self.scene.sun.centre());
        let (copies, share);
        if let Some(distance) = collision {
            let altitude = ray.chord.altitude_at(distance).max(0.0);
            let place = medium.place(&ray, distance);
            if tip.events > 0 || self.once {
                let light = medium.sunlight(tip.position, sun, random) / (4.0 * PI);
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
            let position = up * medium.planet_radius();
            tip.weight = tip.weight.times(&Mueller::depolarising(medium.ground_albedo()));
            let light = sun.dot(up).max(0.0) / PI;
            if light > 0.0 && tip.weight.intensity() > 0.0 {
                add(value, light * medium.sunlight(position, sun, random), &tip.weight.applied_to(&[1.0, 0.0, 0.0]));
            }
            let strength = tip.weight.intensity();
            let light = |guide: &Guide| guide.ground_radiance_by_sky(sun_zenith_cosine) / medium.ground_albedo();
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
    fn fly(&mut self, tip: &Tip, ray: &Ray, end: End, length: f64, random: &mut Random) -> Option<Flown> {
        let medium = self.medium;
        let Some(steering) = &mut self.steering else { return medium.fly(ray, end, length, random) };
        match steering.fly(ray, (end, length), self.scene.sun.centre(), tip.events == 0, random)? {
            Ending::Ground(probability) => Some((None, medium.transmittance(ray, length, random) / probability)),
            Ending::Air { distance, density } => Some((Some(distance), medium.transmittance(ray, distance, random) / density)),
        }
    }

    /// How many paths go on from a vertex, and the factor of their weight. `strength` is what they are worth: weight times scattering coefficient, or times albedo;
    /// `light` is the mean radiance around the vertex that the guide expects.
    fn population(&self, tip: &mut Tip, strength: f64, light: impl Fn(&Guide) -> f64, random: &mut Random) -> (usize, f64) {
        if strength <= 0.0 {
            return (0, 0.0);
        }
        if let Some(steered) = self.steering.as_ref().and_then(|steering| steering.population(strength, light, random)) {
            return steered;
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
    fn turn(&mut self, place: M::Place, altitude: f64, up: DVec3, tip: &Tip, random: &mut Random) -> Option<(DVec3, f64)> {
        let medium = self.medium;
        let sun = self.scene.sun.centre();
        let lobes = self.steering.as_mut().and_then(|steering| steering.lobes(altitude, up, sun, tip.direction));
        let radius = medium.planet_radius();
        let horizon = -(altitude * (2.0 * radius + altitude)).sqrt() / (radius + altitude);
        let sun_share = if up.dot(sun) > horizon - SUN_DEPTH { SUN_SHARE * 0.5_f64.powi(tip.events as i32) } else { 0.0 };
        let guided = if lobes.is_some() { (1.0 - sun_share) * GUIDED_SHARE } else { 0.0 };
        let kind = random.uniform();
        let next = match lobes {
            Some(lobes) if kind < guided => lobes.draw(random),
            _ => {
                let axis = if kind < guided + sun_share { sun } else { tip.direction };
                around(axis, medium.sample_angle(place, random)?, random)
            }
        };
        let mut density = (1.0 - guided - sun_share) * medium.angle_density(place, next.dot(tip.direction));
        if sun_share > 0.0 {
            density += sun_share * medium.angle_density(place, next.dot(sun));
        }
        if let Some(lobes) = lobes {
            density += guided * lobes.density(next);
        }
        Some((next, density))
    }

    /// A random direction from the ground, and its Lambertian density cosine / pi over the one it was drawn with.
    fn leave_ground(&mut self, up: DVec3, random: &mut Random) -> (DVec3, f64) {
        let sun = self.scene.sun.centre();
        let lobes = self.steering.as_mut().and_then(|steering| steering.ground_lobes(up, sun));
        let guided = if lobes.is_some() { GUIDED_SHARE } else { 0.0 };
        let kind = random.uniform();
        let next = match lobes {
            Some(lobes) if kind < guided => lobes.draw(random),
            _ => lambertian(up, random),
        };
        let wanted = 4.0 * next.dot(up).max(0.0);
        let density = (1.0 - guided) * wanted + lobes.map_or(0.0, |lobes| guided * lobes.density(next));
        (next, if density > 0.0 { wanted / density } else { 0.0 })
    }
}

fn add(value: &mut Stokes, factor: f64, term: &Stokes) {
    for i in 0..3 {
        value[i] += factor * term[i];
    }
}
