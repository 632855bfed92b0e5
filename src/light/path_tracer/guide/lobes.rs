//! Where a path turns: a random direction, drawn from the guide's bins of direction times the phase function.

use super::bins::{AZIMUTHS, BINS, ZENITHS, azimuth_bin, azimuth_range, solid_angle, zenith_bin, zenith_range};
use super::tables::{horizon_cosine, split};
use super::{Guide, LEVELS, SUNS, sun_position};
use crate::light::path_tracer::sampling::{Random, frame};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The distribution of directions at one vertex.
pub(in crate::light::path_tracer) struct Lobes {
    /// Cumulative weights of the bins, both sides of the Sun in turn.
    cumulative: [f64; 2 * BINS],
    horizon: f64,
    /// Local vertical, the horizontal direction of the Sun, and the third axis.
    up: DVec3,
    ahead: DVec3,
    aside: DVec3,
    /// Cosine and sine of the middle azimuths.
    middles: [(f64, f64); AZIMUTHS],
}

impl Default for Lobes {
    fn default() -> Self {
        let middles = std::array::from_fn(|j| {
            let (near, far) = azimuth_range(j);
            let (sine, cosine) = (0.5 * (near + far)).sin_cos();
            (cosine, sine)
        });
        Self { cumulative: [0.0; 2 * BINS], horizon: 0.0, up: DVec3::Z, ahead: DVec3::X, aside: DVec3::Y, middles }
    }
}

impl Lobes {
    /// Prepares for the point at `altitude` [km] over `up` with the Sun's centre in direction `sun`. `factor(direction)` weighs the middle of each bin: the phase
    /// function, or the cosine at the ground.
    pub fn aim(&mut self, guide: &Guide, altitude: f64, up: DVec3, sun: DVec3, factor: impl Fn(DVec3) -> f64) {
        self.up = up;
        self.ahead = sun.reject_from_normalized(up).try_normalize().unwrap_or_else(|| frame(up).0);
        self.aside = up.cross(self.ahead);
        self.horizon = horizon_cosine(guide.tables.radius, altitude);
        let (level, above) = split(guide.tables.level(altitude), LEVELS - 1);
        let (node, across) = split(sun_position(up.dot(sun)), SUNS - 1);
        let row = |level: usize, node: usize| &guide.bins[(level * SUNS + node) * BINS..][..BINS];
        let corners = [
            (row(level, node), (1.0 - above) * (1.0 - across)),
            (row(level, node + 1), (1.0 - above) * across),
            (row(level + 1, node), above * (1.0 - across)),
            (row(level + 1, node + 1), above * across),
        ];
        let mut sum = 0.0;
        for zenith in 0..ZENITHS {
            let (low, high) = zenith_range(zenith, self.horizon);
            let cosine = 0.5 * (low + high);
            let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
            for azimuth in 0..AZIMUTHS {
                let bin = zenith * AZIMUTHS + azimuth;
                let light: f64 =
                    if high > low { corners.iter().map(|(row, weight)| weight * f64::from(row[bin])).sum() } else { 0.0 };
                let (forward, aside) = self.middles[azimuth];
                let flat = self.up * cosine + self.ahead * (sine * forward);
                let side = self.aside * (sine * aside);
                for (half, direction) in [flat + side, flat - side].into_iter().enumerate() {
                    if light > 0.0 {
                        sum += light * factor(direction);
                    }
                    self.cumulative[2 * bin + half] = sum;
                }
            }
        }
    }

    /// Whether there is anything to draw from.
    pub fn is_empty(&self) -> bool {
        self.cumulative[2 * BINS - 1] <= 0.0
    }

    /// A random direction.
    pub fn draw(&self, random: &mut Random) -> DVec3 {
        let target = random.uniform() * self.cumulative[2 * BINS - 1];
        let chosen = self.cumulative.partition_point(|&sum| sum <= target).min(2 * BINS - 1);
        let (zenith, azimuth) = (chosen / 2 / AZIMUTHS, chosen / 2 % AZIMUTHS);
        let ((low, high), (near, far)) = (zenith_range(zenith, self.horizon), azimuth_range(azimuth));
        let cosine = low + (high - low) * random.uniform();
        let azimuth = near + (far - near) * random.uniform();
        let azimuth = if chosen.is_multiple_of(2) { azimuth } else { TAU - azimuth };
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        (self.up * cosine + self.ahead * (sine * azimuth.cos()) + self.aside * (sine * azimuth.sin())).normalize()
    }

    /// Density with which `direction` is drawn, times 4 pi.
    pub fn density(&self, direction: DVec3) -> f64 {
        let (forward, across) = (direction.dot(self.ahead), direction.dot(self.aside));
        let zenith = zenith_bin(direction.dot(self.up), self.horizon);
        let azimuth = azimuth_bin(across.abs().atan2(forward));
        let chosen = 2 * (zenith * AZIMUTHS + azimuth) + usize::from(across < 0.0);
        let before = if chosen > 0 { self.cumulative[chosen - 1] } else { 0.0 };
        let probability = (self.cumulative[chosen] - before) / self.cumulative[2 * BINS - 1];
        let angle = solid_angle(zenith, azimuth, self.horizon);
        if angle > 0.0 { 4.0 * PI * probability / angle } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::AirParameters;
    use crate::light::path_tracer::air::Air;
    use crate::light::path_tracer::tests::clear_air;

    /// The mean of x_i^2 / density over drawn directions is 1 / 3 for each axis, whatever the density.
    #[test]
    fn directions_have_the_density_they_are_said_to_have() {
        let profile = clear_air(&AirParameters::default(), 550.0);
        let guide = Guide::new(&Air::new(&profile, 0).unwrap());
        let mut lobes = Lobes::default();
        let mut random = Random::new(4, 0);
        for (altitude, sun_deg) in [(0.0, 60.0), (30.0, 97.0), (80.0, 101.0_f64)] {
            let (sine, cosine) = sun_deg.to_radians().sin_cos();
            lobes.aim(&guide, altitude, DVec3::Z, DVec3::new(sine, 0.0, cosine), |w| 1.0 + 0.5 * w.x);
            let n = 100_000;
            let (mut sum, mut squares) = (DVec3::ZERO, DVec3::ZERO);
            for _ in 0..n {
                // Half of them uniform, so that the weights are bounded.
                let w = if random.uniform() < 0.5 {
                    lobes.draw(&mut random)
                } else {
                    crate::light::path_tracer::sampling::around(DVec3::Z, 2.0 * random.uniform() - 1.0, &mut random)
                };
                let value = w * w / (0.5 + 0.5 * lobes.density(w));
                sum += value;
                squares += value * value;
            }
            let mean = sum / f64::from(n);
            let error = ((squares / f64::from(n) - mean * mean) / f64::from(n)).map(f64::sqrt);
            let deviation = (mean - DVec3::splat(1.0 / 3.0)).abs() / error;
            assert!(deviation.max_element() < 4.0, "{altitude} {sun_deg}: {mean} {error}");
        }
    }
}
