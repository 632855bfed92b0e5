//! How far a path flies: a random end of a ray, drawn where the guide expects the light to come from.
//!
//! The ray is cut into steps; at each cut the guide says how much light is scattered into the ray and arrives at its start,
//! f = transmittance x source per length. Distances have a density linear between the cuts: mostly f, to a small share the
//! density of collisions, and to a smaller one uniform, so that no place is left out and no weight grows without bound.

use super::Guide;
use crate::light::path_tracer::sampling::Random;
use crate::light::path_tracer::shells::Chord;

/// Share of flights that follow the collisions.
const COLLISION_SHARE: f64 = 0.1;

/// Share of flights with uniform distances.
const UNIFORM_SHARE: f64 = 0.003;

/// A ray seen from its start: what the guide has to know of it.
pub(in crate::light::path_tracer) struct Ray<'a> {
    pub chord: Chord,
    /// Length [km].
    pub length: f64,
    /// Whether it ends on the ground.
    pub ends_on_ground: bool,
    /// Cosine of the Sun's zenith angle at the start.
    pub sun_zenith_cosine: f64,
    /// Cosine of the angle between the ray and the Sun.
    pub sun_cosine: f64,
    /// Phase functions of the components at that angle; without them the Sun's light that the air scatters once is left out.
    pub phases: Option<&'a [f64]>,
}

/// A cut of a ray.
#[derive(Clone, Copy, Default)]
struct Cut {
    distance: f64,
    /// Light from here, per length [km-1].
    light: f64,
    /// Extinction coefficient times transmittance [km-1].
    collisions: f64,
    /// Density of distances [km-1].
    density: f64,
    /// Probability of an end before here.
    cumulative: f64,
}

/// Where a ray ends, and the probability (on the ground) or the density [km-1] (in the air) with which it was drawn.
pub(in crate::light::path_tracer) enum Ending {
    Ground(f64),
    Air { distance: f64, density: f64 },
}

/// The distribution of the ends of a ray.
#[derive(Default)]
pub(in crate::light::path_tracer) struct Flight {
    cuts: Vec<Cut>,
    distances: Vec<f64>,
    ground_probability: f64,
}

impl Flight {
    /// Prepares for `ray`; returns the radiance [sr-1] that the guide expects at its start.
    pub fn aim(&mut self, guide: &Guide, ray: &Ray) -> f64 {
        let (air, ground, transmittance) = self.look(guide, ray);
        let expected = air + ground;
        let collided: f64 = self.sum(|cut| cut.collisions);
        let collided = collided + if ray.ends_on_ground { transmittance } else { 0.0 };
        let wanted = if expected > 0.0 { 1.0 / expected } else { 0.0 };
        let blind = if collided > 0.0 { COLLISION_SHARE / collided } else { 0.0 };
        let uniform = if ray.length > 0.0 { UNIFORM_SHARE / ray.length } else { 0.0 };
        for cut in &mut self.cuts {
            cut.density = wanted * cut.light + blind * cut.collisions + uniform;
        }
        let mut sum = 0.0;
        for i in 1..self.cuts.len() {
            let (a, b) = (self.cuts[i - 1], self.cuts[i]);
            sum += 0.5 * (a.density + b.density) * (b.distance - a.distance);
            self.cuts[i].cumulative = sum;
        }
        let ground = if ray.ends_on_ground { wanted * ground + blind * transmittance + UNIFORM_SHARE } else { 0.0 };
        let scale = 1.0 / (sum + ground);
        for cut in &mut self.cuts {
            cut.density *= scale;
            cut.cumulative *= scale;
        }
        self.ground_probability = ground * scale;
        expected
    }

    /// Draws an end; `None` for a ray without length.
    pub fn draw(&self, random: &mut Random) -> Option<Ending> {
        let target = random.uniform();
        let air = self.cuts.last()?.cumulative;
        if target >= air && self.ground_probability > 0.0 {
            return Some(Ending::Ground(self.ground_probability));
        }
        if air <= 0.0 {
            return None;
        }
        let i = self.cuts.partition_point(|cut| cut.cumulative <= target).clamp(1, self.cuts.len() - 1);
        let (a, b) = (self.cuts[i - 1], self.cuts[i]);
        // The part x of the step below which a share u of its linear density lies.
        let u = ((target - a.cumulative) / (b.cumulative - a.cumulative)).clamp(0.0, 1.0);
        let root = (a.density * a.density + u * (b.density * b.density - a.density * a.density)).max(0.0).sqrt();
        let x = (u * (a.density + b.density) / (a.density + root)).clamp(0.0, 1.0);
        let distance = a.distance + x * (b.distance - a.distance);
        Some(Ending::Air { distance, density: a.density + x * (b.density - a.density) })
    }

    /// Radiance [sr-1] that the guide expects at the start of `ray`.
    pub fn radiance(&mut self, guide: &Guide, ray: &Ray) -> f64 {
        let (air, ground, _) = self.look(guide, ray);
        air + ground
    }

    /// Fills in the light at the cuts; returns that of the air, that of the ground and the transmittance of the whole ray.
    fn look(&mut self, guide: &Guide, ray: &Ray) -> (f64, f64, f64) {
        guide.cut(&ray.chord, ray.length, ray.ends_on_ground, &mut self.distances);
        self.cuts.clear();
        let (mut depth, mut before) = (0.0, (0.0, 0.0));
        let mut sun_zenith_cosine = ray.sun_zenith_cosine;
        for &distance in &self.distances {
            let altitude = ray.chord.altitude_at(distance).max(0.0);
            let level = guide.tables.level(altitude);
            sun_zenith_cosine =
                (ray.chord.radius * ray.sun_zenith_cosine + distance * ray.sun_cosine) / (guide.tables.radius + altitude);
            let coefficients = guide.tables.coefficients(level);
            let extinction = coefficients.extinction();
            depth += 0.5 * (before.0 + extinction) * (distance - before.1);
            before = (extinction, distance);
            let transmittance = (-depth).exp();
            let mut source = coefficients.scattering() * guide.mean_intensity(level, sun_zenith_cosine);
            if let Some(phases) = ray.phases {
                let once: f64 = phases.iter().enumerate().map(|(c, phase)| phase * coefficients.scatterer(c)).sum();
                source += once * guide.tables.sunlight(level, altitude, sun_zenith_cosine) / (4.0 * std::f64::consts::PI);
            }
            let light = transmittance * source;
            self.cuts.push(Cut { distance, light, collisions: transmittance * extinction, ..Cut::default() });
        }
        let transmittance = (-depth).exp();
        let ground = if ray.ends_on_ground { transmittance * guide.ground_radiance(sun_zenith_cosine) } else { 0.0 };
        (self.sum(|cut| cut.light), ground, transmittance)
    }

    fn sum(&self, value: impl Fn(&Cut) -> f64) -> f64 {
        self.cuts.windows(2).map(|pair| 0.5 * (value(&pair[0]) + value(&pair[1])) * (pair[1].distance - pair[0].distance)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::AirParameters;
    use crate::light::path_tracer::medium::Medium;
    use crate::light::path_tracer::shells::End;
    use crate::light::path_tracer::tests::clear_air;

    /// The mean of 1 / density over drawn distances is the length of the ray, and the ground gets its share.
    #[test]
    fn distances_have_the_density_they_are_said_to_have() {
        let profile = clear_air(&AirParameters::default(), 550.0);
        let medium = Medium::new(&profile, 0).unwrap();
        let guide = Guide::new(&medium);
        let mut flight = Flight::default();
        let mut random = Random::new(3, 0);
        for (altitude, cosine, sun) in [(0.0, 0.2, -0.1), (40.0, -0.05, -0.15), (10.0, -0.5, 0.1), (100.0, -0.16, -0.2)] {
            let chord = Chord { altitude, radius: medium.shells.planet_radius + altitude, cosine };
            let (end, length) = medium.shells.end(&chord);
            let phases = vec![1.0; medium.scatterers.len()];
            let ends_on_ground = end == End::Ground;
            let ray = Ray { chord, length, ends_on_ground, sun_zenith_cosine: sun, sun_cosine: 0.9, phases: Some(&phases) };
            assert!(flight.aim(&guide, &ray) > 0.0);
            let n = 40_000;
            let (mut sum, mut squares, mut grounded) = (0.0, 0.0, 0.0);
            for _ in 0..n {
                match flight.draw(&mut random).unwrap() {
                    Ending::Ground(_) => grounded += 1.0,
                    Ending::Air { distance, density } => {
                        // Weighted by the distance, so that the test sees where the density lies.
                        let value = 2.0 * distance / length / length / density;
                        assert!((0.0..=length * (1.0 + 1e-12)).contains(&distance));
                        sum += value;
                        squares += value * value;
                    }
                }
            }
            let n = f64::from(n);
            let (mean, error) = (sum / n, (squares / n - (sum / n).powi(2)).max(0.0).sqrt() / n.sqrt());
            assert!((mean - 1.0).abs() < 4.0 * error + 1e-9, "{mean} {error}");
            assert!((grounded / n - flight.ground_probability).abs() < 4.0 * (0.25 / n).sqrt());
        }
    }
}
