//! How far a path flies: a random end of a ray, drawn where the guide expects the light to come from.
//!
//! The ray is cut into steps; at each cut the guide says how much light is scattered into the ray and arrives at its start,
//! f = transmittance x source per length. Distances have a density linear between the cuts: mostly f, to a small share the
//! density of collisions, and to a smaller one uniform, so that no place is left out and no weight grows without bound.

use super::Guide;
use crate::light::chord::Chord;
use crate::light::path_tracer::sampling::Random;
use std::f64::consts::PI;

/// Share of flights that follow the collisions.
const COLLISION_SHARE: f64 = 0.1;

/// Share of flights with uniform distances.
const UNIFORM_SHARE: f64 = 0.003;

/// The light at a cut counts as at least this part of that at the next cuts: the Earth's shadow may end right after it.
const NEIGHBOUR_SHARE: f64 = 0.3;

/// Where the Sun is for a ray.
pub(in crate::light::path_tracer) struct Sunshine<'a> {
    /// Cosine of the Sun's zenith angle at the start of the ray.
    pub zenith_cosine: f64,
    /// Cosine of the angle between the ray and the Sun.
    pub cosine: f64,
    /// Phase functions of the components at that angle; without them the Sun's light that the air scatters once is left out.
    pub phases: Option<&'a [f64]>,
}

/// A cut of a ray.
#[derive(Clone, Copy, Default)]
struct Cut {
    distance: f64,
    altitude: f64,
    /// Coordinate of the altitude in the guide's tables.
    level: f64,
    transmittance: f64,
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
    radius: f64,
    length: f64,
    ends_on_ground: bool,
    ground_probability: f64,
}

impl Flight {
    /// Cuts the ray that starts with `chord` and has a length [km].
    pub fn trace(&mut self, guide: &Guide, chord: &Chord, length: f64, ends_on_ground: bool) {
        guide.cut(chord, length, ends_on_ground, &mut self.distances);
        (self.radius, self.length, self.ends_on_ground) = (chord.radius, length, ends_on_ground);
        self.cuts.clear();
        let (mut depth, mut before) = (0.0, (0.0, 0.0));
        for &distance in &self.distances {
            let altitude = chord.altitude_at(distance).max(0.0);
            let level = guide.tables.level(altitude);
            let extinction = guide.tables.coefficients(level).extinction();
            depth += 0.5 * (before.0 + extinction) * (distance - before.1);
            before = (extinction, distance);
            let transmittance = (-depth).exp();
            let collisions = transmittance * extinction;
            self.cuts.push(Cut { distance, altitude, level, transmittance, collisions, ..Cut::default() });
        }
    }

    /// Finds the light along the ray; returns the radiances [sr-1] that the guide expects of the air and of the ground at its start.
    pub fn light(&mut self, guide: &Guide, sunshine: &Sunshine) -> (f64, f64) {
        let mut zenith_cosine = sunshine.zenith_cosine;
        for cut in &mut self.cuts {
            let radius = guide.tables.radius + cut.altitude;
            zenith_cosine = (self.radius * sunshine.zenith_cosine + cut.distance * sunshine.cosine) / radius;
            let coefficients = guide.tables.coefficients(cut.level);
            let mut source = coefficients.scattering() * guide.mean_intensity(cut.level, zenith_cosine);
            if let Some(phases) = sunshine.phases {
                let sunlight = guide.tables.sunlight(cut.level, cut.altitude, zenith_cosine) / (4.0 * PI);
                if sunlight > 0.0 {
                    let once: f64 = phases.iter().enumerate().map(|(c, phase)| phase * coefficients.scatterer(c)).sum();
                    source += once * sunlight;
                }
            }
            cut.light = cut.transmittance * source;
        }
        let ground = if self.ends_on_ground { self.transmittance() * guide.ground_radiance(zenith_cosine) } else { 0.0 };
        (self.integral(|cut| cut.light), ground)
    }

    /// Makes the distribution after [`Self::trace`]; returns the radiance [sr-1] that the guide expects at the start.
    pub fn aim(&mut self, guide: &Guide, sunshine: &Sunshine) -> f64 {
        let (air, ground) = self.light(guide, sunshine);
        let expected = air + ground;
        let landed = if self.ends_on_ground { self.transmittance() } else { 0.0 };
        let ended = self.integral(|cut| cut.collisions) + landed;
        let wanted = if expected > 0.0 { 1.0 / expected } else { 0.0 };
        let blind = if ended > 0.0 { COLLISION_SHARE / ended } else { 0.0 };
        let uniform = if self.length > 0.0 { UNIFORM_SHARE / self.length } else { 0.0 };
        for i in 0..self.cuts.len() {
            let beside = self.cuts[i.saturating_sub(1)].light.max(self.cuts[(i + 1).min(self.cuts.len() - 1)].light);
            let cut = &mut self.cuts[i];
            cut.density = wanted * cut.light.max(NEIGHBOUR_SHARE * beside) + blind * cut.collisions + uniform;
        }
        let mut sum = 0.0;
        for i in 1..self.cuts.len() {
            let (a, b) = (self.cuts[i - 1], self.cuts[i]);
            sum += 0.5 * (a.density + b.density) * (b.distance - a.distance);
            self.cuts[i].cumulative = sum;
        }
        let ground = if self.ends_on_ground { wanted * ground + blind * landed + UNIFORM_SHARE } else { 0.0 };
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
        if self.cuts.len() < 2 || air <= 0.0 {
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

    fn transmittance(&self) -> f64 {
        self.cuts.last().map_or(1.0, |cut| cut.transmittance)
    }

    fn integral(&self, value: impl Fn(&Cut) -> f64) -> f64 {
        self.cuts.windows(2).map(|pair| 0.5 * (value(&pair[0]) + value(&pair[1])) * (pair[1].distance - pair[0].distance)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::AirParameters;
    use crate::light::path_tracer::air::Air;
    use crate::light::path_tracer::shells::End;
    use crate::light::path_tracer::tests::clear_air;

    /// The mean of 1 / density over drawn distances is the length of the ray, and the ground gets its share.
    #[test]
    fn distances_have_the_density_they_are_said_to_have() {
        let profile = clear_air(&AirParameters::default(), 550.0);
        let air = Air::new(&profile, 0).unwrap();
        let guide = Guide::new(&air);
        let mut flight = Flight::default();
        let mut random = Random::new(3, 0);
        for (altitude, cosine, sun) in [(0.0, 0.2, -0.1), (40.0, -0.05, -0.15), (10.0, -0.5, 0.1), (100.0, -0.16, -0.2)] {
            let chord = Chord { altitude, radius: air.shells.planet_radius + altitude, cosine };
            let (end, length) = air.shells.end(&chord);
            let phases = vec![1.0; air.scatterers.len()];
            flight.trace(&guide, &chord, length, end == End::Ground);
            let sunshine = Sunshine { zenith_cosine: sun, cosine: 0.9, phases: Some(&phases) };
            assert!(flight.aim(&guide, &sunshine) > 0.0);
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
