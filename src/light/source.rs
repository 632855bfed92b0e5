//! The light field on the grid, and the light it scatters into a ray.
//!
//! At each node (altitude, solar zenith angle) the field is the moments I_lm of the radiance in the local frame (z up, x towards the Sun's side).
//! Along a ray the source is S = sum_m cos(m phi) sum_l [sum over components sigma chi_l] y_lm(mu) I_lm. For a fixed point of a ray
//! the sum over l and the interpolation in altitude do not depend on the Sun: they are done once for all solar zenith angles
//! ([`Contracted`]); then each position of the Sun and each azimuth costs only order + 1 terms.
//!
//! Between solar zenith angles the field is interpolated by a cubic in the logarithm of its magnitude: in twilight it falls by orders
//! of magnitude from node to node.

use super::air::Air;
use super::grid::Grid;
use super::harmonics;
use super::lanes::{Lanes, add_product, add_scaled, exp_one, splat};
use super::ray::RayPoint;
use super::zenith_axis::Stencil;
use std::ops::Range;

/// Highest supported order of the spherical harmonics.
pub const MAX_ORDER: usize = 16;

/// Magnitudes below this are as good as dark.
const FLOOR: f32 = 1e-22;

/// Moments of the radiance on the grid, and the diffuse irradiance of the ground.
#[derive(Clone)]
pub struct Field<const N: usize> {
    /// Highest order of the moments.
    pub order: usize,
    /// Moments [sr-1 per unit solar irradiance], (altitude, solar zenith angle, (l, m)).
    pub moments: Vec<Lanes<N>>,
    /// Diffuse irradiance on the ground per unit solar irradiance, by solar zenith angle.
    pub ground: Vec<Lanes<N>>,
}

impl<const N: usize> Field<N> {
    /// A dark field.
    pub fn dark(grid: &Grid, order: usize) -> Self {
        let nodes = grid.altitudes.len() * grid.zeniths.len();
        Self { order, moments: vec![splat(0.0); nodes * harmonics::count(order)], ground: vec![splat(0.0); grid.zeniths.len()] }
    }

    /// The same field with only the moments up to `order`.
    pub fn truncated(&self, order: usize) -> Self {
        let (all, kept) = (harmonics::count(self.order), harmonics::count(order));
        let moments = self.moments.chunks_exact(all).flat_map(|node| node[..kept].iter().copied()).collect();
        Self { order, moments, ground: self.ground.clone() }
    }

    /// Mean over wavelengths of I_00 at each node: the magnitude that scales interpolation.
    pub fn magnitudes(&self) -> Vec<f32> {
        self.moments.chunks_exact(harmonics::count(self.order)).map(|node| mean(&node[0])).collect()
    }
}

/// Mean of the lanes, at least the floor of darkness.
pub fn mean<const N: usize>(lanes: &Lanes<N>) -> f32 {
    (lanes.iter().sum::<f32>() / N as f32).max(FLOOR)
}

/// How bright a field is at its nodes: what scales the interpolation of the field.
pub struct Magnitudes {
    nodes: Vec<f32>,
    ground_log: Vec<f32>,
    ground_inverse: Vec<f32>,
}

impl Magnitudes {
    /// Of `field`.
    pub fn new<const N: usize>(field: &Field<N>) -> Self {
        let ground: Vec<f32> = field.ground.iter().map(mean).collect();
        Self {
            nodes: field.magnitudes(),
            ground_log: ground.iter().map(|m| m.ln()).collect(),
            ground_inverse: ground.iter().map(|m| 1.0 / m).collect(),
        }
    }
}

/// A field prepared for interpolation.
#[derive(Clone, Copy)]
pub struct Interpolated<'a, const N: usize> {
    /// The grid of the field.
    pub grid: &'a Grid,
    /// The field.
    pub field: &'a Field<N>,
    /// Its magnitudes.
    pub magnitudes: &'a Magnitudes,
}

impl<const N: usize> Interpolated<'_, N> {
    /// Diffuse irradiance of the ground per unit solar irradiance for the cosine of the solar zenith angle.
    #[inline(always)]
    pub fn ground_irradiance(&self, zenith_cosine: f64) -> Lanes<N> {
        let mut sum = splat(0.0);
        if let Some(position) = self.grid.zeniths.position(zenith_cosine as f32) {
            let stencil = self.grid.zeniths.stencil(position);
            let weights = log_weights(&stencil, &self.magnitudes.ground_log, &self.magnitudes.ground_inverse);
            for a in 0..4 {
                add_scaled(&mut sum, weights[a], &self.field.ground[stencil.first + a]);
            }
        }
        sum
    }
}

/// Work space: for one point of a ray, what remains when altitude and l are summed.
pub struct Contracted<const N: usize> {
    order: usize,
    /// (solar zenith angle, m).
    terms: Vec<Lanes<N>>,
    log_magnitude: Vec<f32>,
    inverse_magnitude: Vec<f32>,
}

impl<const N: usize> Contracted<N> {
    pub fn new(grid: &Grid, order: usize) -> Self {
        let n = grid.zeniths.len();
        Self { order, terms: vec![splat(0.0); n * (order + 1)], log_magnitude: vec![0.0; n], inverse_magnitude: vec![0.0; n] }
    }

    /// Sums over altitude and l at `point` for the solar zenith angles in `range`.
    #[inline(always)]
    pub fn fill(&mut self, source: &Interpolated<N>, air: &Air<N>, point: &RayPoint<N>, range: Range<usize>) {
        let order = self.order;
        let mut harmonic = [0.0; harmonics::count(MAX_ORDER)];
        harmonics::evaluate(order, point.zenith_cosine, &mut harmonic);
        // Strength of each order: weight of the point times the sum over components of scattering times Legendre moment.
        let mut strength = [splat::<N>(0.0); MAX_ORDER + 1];
        for scatterer in air.scatterers() {
            let coefficient = scatterer.coefficient(point.place);
            let mut weighted = coefficient;
            for n in 0..N {
                weighted[n] *= point.weight[n];
            }
            for l in 0..=order {
                add_product(&mut strength[l], &weighted, &scatterer.moments[l]);
            }
        }
        let zeniths = source.grid.zeniths.len();
        let (level, up) = source.grid.altitudes.locate(point.altitude);
        let pairs = harmonics::count(order);
        for j in range {
            let at = |level: usize| (level * zeniths + j) * pairs;
            let low = &source.field.moments[at(level)..at(level) + pairs];
            let high = &source.field.moments[at(level + 1)..at(level + 1) + pairs];
            let terms = &mut self.terms[j * (order + 1)..(j + 1) * (order + 1)];
            terms.fill(splat(0.0));
            for l in 0..=order {
                for m in 0..=l {
                    let lm = harmonics::index(l, m);
                    let y = harmonic[lm];
                    let (y_low, y_high) = (y * (1.0 - up), y * up);
                    for n in 0..N {
                        terms[m][n] += strength[l][n] * (y_low * low[lm][n] + y_high * high[lm][n]);
                    }
                }
            }
            let magnitude = (1.0 - up) * source.magnitudes.nodes[level * zeniths + j]
                + up * source.magnitudes.nodes[(level + 1) * zeniths + j];
            self.log_magnitude[j] = magnitude.ln();
            self.inverse_magnitude[j] = 1.0 / magnitude;
        }
    }

    /// Adds the scattered light to the sum of each position of the Sun and azimuth in `suns`, which are placed at the point that was filled in.
    #[inline(always)]
    pub fn add(&mut self, suns: &Suns, sums: &mut [Lanes<N>]) {
        let terms = self.order + 1;
        for ((place, azimuth_cosine), sum) in suns.places.iter().zip(&suns.azimuth_cosines).zip(sums) {
            let Some(stencil) = place else { continue };
            let weights = log_weights(stencil, &self.log_magnitude, &self.inverse_magnitude);
            let nodes = &self.terms[stencil.first * terms..(stencil.first + 4) * terms];
            // cos(m phi) by Chebyshev's recurrence.
            let (mut before, mut now) = (*azimuth_cosine, 1.0_f32);
            for m in 0..terms {
                let [w0, w1, w2, w3] = weights.map(|w| w * now);
                let (a, b, c, d) = (&nodes[m], &nodes[terms + m], &nodes[2 * terms + m], &nodes[3 * terms + m]);
                for n in 0..N {
                    sum[n] += (w0 * a[n] + w1 * b[n]) + (w2 * c[n] + w3 * d[n]);
                }
                (before, now) = (now, 2.0 * azimuth_cosine * now - before);
            }
        }
    }
}

/// Weights of the four nodes of `stencil` for a quantity of the given magnitude at the nodes: the cubic in the logarithm.
#[inline(always)]
fn log_weights(stencil: &Stencil, log_magnitude: &[f32], inverse_magnitude: &[f32]) -> [f32; 4] {
    let logs = &log_magnitude[stencil.first..stencil.first + 4];
    let inverses = &inverse_magnitude[stencil.first..stencil.first + 4];
    let w = &stencil.weights;
    let log = (w[0] * logs[0] + w[1] * logs[1]) + (w[2] * logs[2] + w[3] * logs[3]);
    // Next to a node in the dark the cubic could overshoot wildly: stay near the two nodes around the place.
    let (one, other) = (logs[stencil.inner], logs[stencil.inner + 1]);
    let magnitude = exp_one(log.min(one.max(other) + 0.2).max(one.min(other) - 0.2));
    [
        w[0] * magnitude * inverses[0],
        w[1] * magnitude * inverses[1],
        w[2] * magnitude * inverses[2],
        w[3] * magnitude * inverses[3],
    ]
}

/// Work space: several positions of the Sun and azimuths of one ray, placed at one of its points after the other.
pub struct Suns {
    on_rays: Vec<[f32; 5]>,
    zenith_cosines: Vec<f32>,
    azimuth_cosines: Vec<f32>,
    places: Vec<Option<Stencil>>,
}

impl Suns {
    /// For the given constants of a ray.
    pub fn new(on_rays: &[SunOnRay]) -> Self {
        let n = on_rays.len();
        let constants =
            |s: &SunOnRay| [s.zenith_cosine, s.scattering_cosine, s.along / s.radius, s.along_slope, s.across].map(|v| v as f32);
        Self {
            on_rays: on_rays.iter().map(constants).collect(),
            zenith_cosines: vec![0.0; n],
            azimuth_cosines: vec![0.0; n],
            places: vec![None; n],
        }
    }

    /// Finds where all Suns stand at `distance` [km] along the ray that started at `start_radius` and is now at `radius` [km].
    #[inline(always)]
    pub fn place(&mut self, grid: &Grid, start_radius: f64, distance: f64, radius: f64) {
        let (turn, advance) = ((start_radius / radius) as f32, (distance / radius) as f32);
        for ((&[zenith, scattering, along, slope, across], cosine), azimuth) in
            self.on_rays.iter().zip(&mut self.zenith_cosines).zip(&mut self.azimuth_cosines)
        {
            *cosine = (turn * zenith + advance * scattering).clamp(-1.0, 1.0);
            let along = turn * along + advance * slope;
            // A Sun at the local zenith has no azimuth, and nothing depends on it there.
            *azimuth = (along / (along * along + across * across).sqrt().max(1e-12)).clamp(-1.0, 1.0);
        }
        for (&cosine, place) in self.zenith_cosines.iter().zip(&mut self.places) {
            *place = grid.zeniths.position(cosine).map(|position| grid.zeniths.stencil(position));
        }
    }

    /// The nodes that are needed for the placed Suns.
    pub fn range(&self) -> Range<usize> {
        let firsts = self.places.iter().flatten().map(|stencil| stencil.first);
        let low = firsts.clone().min().unwrap_or(0);
        low..firsts.max().map_or(low, |high| high + 4)
    }
}

/// The ray's constants for one position of the Sun, from which the Sun's place at any point of the ray follows.
///
/// With a the observer's and t the distance: cos theta = (r0 cos theta0 + t (view . sun)) / r, and the local azimuth follows from components of the Sun
/// along and across the ray's vertical plane, without cancellation and exact at the zenith.
#[derive(Clone, Copy, Debug)]
pub struct SunOnRay {
    /// Cosine of the angle between ray and Sun: the same all along the ray.
    pub scattering_cosine: f64,
    radius: f64,
    zenith_cosine: f64,
    along: f64,
    along_slope: f64,
    across: f64,
}

impl SunOnRay {
    /// For a ray from `radius` [km] with zenith cosine `mu` at the azimuth with the given cosine and sine from a Sun with (sine, cosine) of its zenith angle.
    pub fn new(radius: f64, mu: f64, (azimuth_cosine, azimuth_sine): (f64, f64), (sun_sine, sun_cosine): (f64, f64)) -> Self {
        let s = (1.0 - mu * mu).max(0.0).sqrt();
        Self {
            scattering_cosine: mu * sun_cosine + s * sun_sine * azimuth_cosine,
            radius,
            zenith_cosine: sun_cosine,
            along: sun_sine * azimuth_cosine * radius,
            along_slope: sun_sine * azimuth_cosine * mu - sun_cosine * s,
            across: sun_sine * azimuth_sine,
        }
    }

    /// Cosine of the solar zenith angle at `distance` [km] where the ray's distance from the centre is `radius` [km].
    #[inline(always)]
    pub fn zenith_cosine(&self, distance: f64, radius: f64) -> f64 {
        ((self.radius * self.zenith_cosine + distance * self.scattering_cosine) / radius).clamp(-1.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::Quality;
    use glam::DVec3;

    #[test]
    fn the_sun_on_a_ray_is_where_vectors_say() {
        let grid = Grid::new(&Quality::Draft.numbers(), 6371.0, 100.0);
        for (mu, azimuth, zenith) in [(0.3, 0.7, 0.9), (1.0, 0.4, 1.5), (-0.2, 3.0, 1.7), (0.05, 0.0, 0.2)] {
            let (r0, t): (f64, f64) = (6371.0, 250.0);
            let s = f64::sqrt(1.0 - mu * mu);
            let sun = DVec3::new(f64::sin(zenith), 0.0, f64::cos(zenith));
            let view = DVec3::new(s * f64::cos(azimuth), s * f64::sin(azimuth), mu);
            let place = DVec3::new(0.0, 0.0, r0) + t * view;
            let up = place.normalize();
            let on_ray = SunOnRay::new(r0, mu, (azimuth.cos(), azimuth.sin()), (zenith.sin(), zenith.cos()));
            assert!((on_ray.zenith_cosine(t, place.length()) - up.dot(sun)).abs() < 1e-12);
            let mut suns = Suns::new(&[on_ray]);
            suns.place(&grid, r0, t, place.length());
            assert!((f64::from(suns.zenith_cosines[0]) - up.dot(sun)).abs() < 1e-6);
            let flat = |v: DVec3| (v - up * up.dot(v)).normalize();
            if mu < 1.0 {
                let expected = flat(view).dot(flat(sun));
                assert!((f64::from(suns.azimuth_cosines[0]) - expected).abs() < 1e-6, "{mu} {azimuth} {zenith}");
            } else {
                assert!((f64::from(suns.azimuth_cosines[0]) - azimuth.cos()).abs() < 1e-6);
            }
        }
    }
}
