//! Rays cut at distances: which points lie before one, what the part of a step up to it adds, how much light passes.
//!
//! A ray's own steps are left as they are, so that what is found at one distance does not depend on which others are asked for, and at the end of the ray it is what the whole ray has.

use super::air::Air;
use super::lanes::{Lanes, exp_minus, splat};
use super::ray::{GAUSS, Ray, RayPoint};

/// A ray up to a distance.
pub struct Cut<const N: usize> {
    /// Number of points in the steps that end before the distance.
    pub whole: usize,
    /// The points of what lies between the last of these steps and the distance; `None` where nothing does.
    pub rest: Option<[RayPoint<N>; 2]>,
    /// Transmittance from the start to the distance, or to the end of a ray that ends before it.
    pub transmittance: Lanes<N>,
}

/// Cuts `ray` at ascending `distances` [km].
pub fn cuts<const N: usize>(air: &Air<N>, ray: &Ray<N>, distances: &[f64]) -> Vec<Cut<N>> {
    let mut tau = splat::<N>(0.0);
    let mut whole = 0;
    let cut = |&distance: &f64| {
        let mut step = Step::at(air, ray, whole);
        while let Some(ended) = step.as_ref().filter(|step| step.begin + step.length <= distance) {
            let [a, b] = &ended.extinction;
            for n in 0..N {
                tau[n] += ended.half_length * (a[n] + b[n]);
            }
            whole += 2;
            step = Step::at(air, ray, whole);
        }
        match step.filter(|step| distance - step.begin > 1e-12 * step.length) {
            None => Cut { whole, rest: None, transmittance: exp_minus(&tau) },
            Some(step) => {
                let part = (distance - step.begin) / step.length;
                let points = GAUSS.map(|g| step.point(air, ray, &tau, part, g));
                Cut { whole, rest: Some(points), transmittance: exp_minus(&step.depth(&tau, part)) }
            }
        }
    };
    distances.iter().map(cut).collect()
}

/// A step of a ray.
struct Step<const N: usize> {
    begin: f64,
    length: f64,
    half_length: f32,
    /// Extinction coefficient at its two points.
    extinction: [Lanes<N>; 2],
}

impl<const N: usize> Step<N> {
    /// The step with the points from index `first` on.
    fn at(air: &Air<N>, ray: &Ray<N>, first: usize) -> Option<Self> {
        let [a, b] = ray.points.get(first..first + 2)? else { return None };
        let length = (b.distance - a.distance) / (GAUSS[1] - GAUSS[0]);
        let extinction = [a, b].map(|point| air.extinction(point.place));
        Some(Self { begin: a.distance - GAUSS[0] * length, length, half_length: a.length, extinction })
    }

    /// Optical depth from the start of the ray, `before` at the start of the step, to a part of the step; extinction is linear through the two points, as in the ray itself.
    fn depth(&self, before: &Lanes<N>, part: f64) -> Lanes<N> {
        let mut depth = *before;
        let (x, h) = (part as f32, 2.0 * self.half_length);
        for n in 0..N {
            let slope = (self.extinction[1][n] - self.extinction[0][n]) / (GAUSS[1] - GAUSS[0]) as f32;
            let at_start = self.extinction[0][n] - slope * GAUSS[0] as f32;
            depth[n] += h * x * (at_start + 0.5 * slope * x);
        }
        depth
    }

    /// The point at `g` of the first `part` of the step, which stands for half of it.
    fn point(&self, air: &Air<N>, ray: &Ray<N>, before: &Lanes<N>, part: f64, g: f64) -> RayPoint<N> {
        let (r0, mu) = (air.radius + ray.start_altitude, ray.zenith_cosine);
        let distance = self.begin + g * part * self.length;
        let radius = (r0 * r0 + 2.0 * r0 * mu * distance + distance * distance).sqrt();
        let rise = (2.0 * r0 * mu * distance + distance * distance) / (radius + r0);
        let altitude = (ray.start_altitude + rise).clamp(0.0, air.top);
        let length = (0.5 * part * self.length) as f32;
        RayPoint {
            distance,
            radius,
            altitude,
            zenith_cosine: ((r0 * mu + distance) / radius).clamp(-1.0, 1.0),
            place: air.locate(altitude),
            length,
            weight: exp_minus(&self.depth(before, g * part)).map(|transmittance| transmittance * length),
        }
    }
}
