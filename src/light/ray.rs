//! Straight rays through the spherical shells of the air, cut into steps with a two-point Gauss rule in each.
//!
//! A ray starts at altitude z0 with zenith cosine mu. At distance t: r^2 = r0^2 + 2 r0 mu t + t^2. Its steps end where it crosses
//! a shell, are no longer than a limit in length and in optical depth, and each holds two points with weight
//! transmittance x length, so that a sum over the points of weight x (source per length) is the radiance at the start.

use super::air::Air;
use super::lanes::{Lanes, add_scaled, exp_minus, splat};
use crate::numerics::Axis;
use crate::quality::Numbers;
use crate::units::EARTH_RADIUS_KM;
use multiversion::multiversion;

/// How finely rays are cut.
#[derive(Clone, Copy, Debug)]
pub struct StepLimits {
    /// Longest step [km].
    pub length_km: f64,
    /// Largest optical depth of a step.
    pub optical_depth: f32,
}

impl StepLimits {
    /// For a quality level on a planet of `radius` [km]. The longest step is stated for the Earth: what it limits is how far
    /// the vertical turns in a step, so that it grows with the planet.
    pub fn new(numbers: &Numbers, radius: f64) -> Self {
        Self { length_km: numbers.step_km * radius / EARTH_RADIUS_KM, optical_depth: 1.0 }
    }
}

/// A quadrature point of a ray.
#[derive(Clone, Debug)]
pub struct RayPoint<const N: usize> {
    /// Distance from the start [km].
    pub distance: f64,
    /// Distance from the centre of the planet [km].
    pub radius: f64,
    /// Altitude [km].
    pub altitude: f64,
    /// Cosine of the angle between the ray and the local vertical.
    pub zenith_cosine: f64,
    /// Place in the profile, see [`Air::locate`].
    pub place: (usize, f32),
    /// Length this point stands for [km].
    pub length: f32,
    /// Transmittance from the start times that length [km].
    pub weight: Lanes<N>,
}

/// A ray with its quadrature points, and where it ends.
#[derive(Clone, Debug)]
pub struct Ray<const N: usize> {
    /// Altitude of the start [km].
    pub start_altitude: f64,
    /// Cosine of the zenith angle at the start.
    pub zenith_cosine: f64,
    /// Quadrature points in the order of distance.
    pub points: Vec<RayPoint<N>>,
    /// Distance to the ground [km] and transmittance to it, if the ray meets it.
    pub ground: Option<(f64, Lanes<N>)>,
}

/// Two-point Gauss-Legendre abscissas on 0..1; the weights are equal.
pub const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// Below this transmittance in every lane a ray is not followed further.
const DARK: f32 = 1e-6;

impl<const N: usize> Ray<N> {
    /// Follows the ray from `start_altitude` [km] with zenith cosine `mu` to the ground or the top. `shells` are altitudes at which steps end.
    pub fn trace(air: &Air<N>, shells: &Axis, start_altitude: f64, mu: f64, limits: StepLimits) -> Self {
        trace(air, shells, start_altitude, mu, limits)
    }

    /// Optical depth of the whole ray, to the ground or to space.
    #[inline(always)]
    pub fn optical_depth(air: &Air<N>, shells: &Axis, start_altitude: f64, mu: f64, limits: StepLimits) -> Lanes<N> {
        let r0 = air.radius + start_altitude;
        let (ends, _) = step_ends(air, shells, start_altitude, mu);
        let mut tau = splat::<N>(0.0);
        for step in ends.windows(2) {
            let parts = ((step[1] - step[0]) / limits.length_km).ceil().max(1.0);
            let h = (step[1] - step[0]) / parts;
            for part in 0..parts as usize {
                for g in GAUSS {
                    let t = step[0] + (part as f64 + g) * h;
                    let radius = (r0 * r0 + 2.0 * r0 * mu * t + t * t).sqrt();
                    let altitude = start_altitude + (2.0 * r0 * mu * t + t * t) / (radius + r0);
                    add_scaled(&mut tau, 0.5 * h as f32, &air.extinction(air.locate(altitude)));
                }
            }
        }
        tau
    }

    /// Angle around the centre of the planet of `radius` [km] that the ray passes over [degrees].
    pub fn reach_deg(&self, radius: f64) -> f64 {
        let Some(last) = self.points.last() else { return 0.0 };
        let s = (1.0 - self.zenith_cosine * self.zenith_cosine).max(0.0).sqrt();
        (last.distance * s).atan2(radius + self.start_altitude + last.distance * self.zenith_cosine).to_degrees()
    }

    /// Adds the points between two distances; false when nothing is left to see.
    #[inline(always)]
    fn march(&mut self, air: &Air<N>, r0: f64, begin: f64, end: f64, tau: &mut Lanes<N>, limits: StepLimits) -> bool {
        let mu = self.zenith_cosine;
        let radius_at = |t: f64| (r0 * r0 + 2.0 * r0 * mu * t + t * t).sqrt();
        let altitude_at = |t: f64| (self.start_altitude + (2.0 * r0 * mu * t + t * t) / (radius_at(t) + r0)).clamp(0.0, air.top);
        let length = end - begin;
        let ends = [begin, end].map(|t| air.extinction(air.locate(altitude_at(t))));
        let mut thickest = 0.0_f32;
        for n in 0..N {
            // A wavelength that is already dark does not ask for finer steps.
            if tau[n] < 12.0 {
                thickest = thickest.max(ends[0][n].max(ends[1][n]) * length as f32);
            }
        }
        let parts =
            (length / limits.length_km).max(f64::from(thickest / limits.optical_depth)).ceil().clamp(1.0, 4096.0) as usize;
        let step = length / parts as f64;
        for part in 0..parts {
            let t0 = begin + part as f64 * step;
            let places = GAUSS.map(|g| air.locate(altitude_at(t0 + g * step)));
            let extinction = places.map(|place| air.extinction(place));
            for (a, &place) in places.iter().enumerate() {
                let x = GAUSS[a] as f32;
                let h = step as f32;
                // Extinction linear through the two points: its integral from the start of the step to this point.
                let mut depth = *tau;
                for n in 0..N {
                    let slope = (extinction[1][n] - extinction[0][n]) / (GAUSS[1] - GAUSS[0]) as f32;
                    let at_start = extinction[0][n] - slope * GAUSS[0] as f32;
                    depth[n] += h * x * (at_start + 0.5 * slope * x);
                }
                let mut weight = exp_minus(&depth);
                for w in weight.iter_mut() {
                    *w *= 0.5 * h;
                }
                let t = t0 + GAUSS[a] * step;
                let radius = radius_at(t);
                self.points.push(RayPoint {
                    distance: t,
                    radius,
                    altitude: altitude_at(t),
                    zenith_cosine: ((r0 * mu + t) / radius).clamp(-1.0, 1.0),
                    place,
                    length: 0.5 * step as f32,
                    weight,
                });
            }
            for n in 0..N {
                tau[n] += 0.5 * step as f32 * (extinction[0][n] + extinction[1][n]);
            }
            if tau.iter().all(|&t| t > -DARK.ln()) {
                return false;
            }
        }
        true
    }
}

/// [`Ray::trace`]: a method cannot be compiled for several processors.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn trace<const N: usize>(air: &Air<N>, shells: &Axis, start_altitude: f64, mu: f64, limits: StepLimits) -> Ray<N> {
    let mut ray = Ray { start_altitude, zenith_cosine: mu, points: Vec::new(), ground: None };
    let r0 = air.radius + start_altitude;
    let (ends, meets_ground) = step_ends(air, shells, start_altitude, mu);
    let mut tau = splat::<N>(0.0);
    let mut begin = ends[0];
    for &end in &ends[1..] {
        if !ray.march(air, r0, begin, end, &mut tau, limits) {
            return ray;
        }
        begin = end;
    }
    if meets_ground {
        ray.ground = Some((begin, exp_minus(&tau)));
    }
    ray
}

/// Distances at which the ray enters the air, crosses shells, and leaves, and whether it ends on the ground.
fn step_ends<const N: usize>(air: &Air<N>, shells: &Axis, altitude: f64, mu: f64) -> (Vec<f64>, bool) {
    let r0 = air.radius + altitude;
    let impact2 = r0 * r0 * (1.0 - mu * mu);
    // Half of the chord inside the sphere of a shell, if the ray's line meets it.
    let half_chord = |z: f64| {
        let r = air.radius + z;
        let h2 = r * r - impact2;
        (h2 > 0.0).then(|| h2.sqrt())
    };
    let nearest = -r0 * mu;
    let enter = if altitude > air.top {
        match half_chord(air.top) {
            Some(h) if mu < 0.0 => nearest - h,
            _ => return (vec![0.0], false),
        }
    } else {
        0.0
    };
    let mut ends = vec![enter];
    let levels = shells.nodes();
    let meets_ground = mu < 0.0 && half_chord(0.0).is_some();
    if mu < 0.0 {
        for &z in levels.iter().rev().filter(|&&z| z < altitude.min(air.top)) {
            if let Some(h) = half_chord(z) {
                ends.push(nearest - h);
            }
        }
        if meets_ground {
            let ground = nearest - half_chord(0.0).unwrap_or(0.0);
            ends.retain(|&t| t < ground);
            ends.push(ground.max(enter));
            tidy(&mut ends);
            return (ends, true);
        }
        ends.push(nearest);
    }
    for &z in levels {
        if let Some(h) = half_chord(z) {
            ends.push(nearest + h);
        }
    }
    if let Some(h) = half_chord(air.top) {
        ends.push(nearest + h);
    }
    ends.retain(|&t| t >= enter);
    tidy(&mut ends);
    (ends, false)
}

/// Sorts, and drops steps too short to matter.
fn tidy(ends: &mut Vec<f64>) {
    ends.sort_by(f64::total_cmp);
    let last = ends[ends.len() - 1];
    ends.dedup_by(|b, a| *b - *a < 1e-6);
    let n = ends.len() - 1;
    ends[n] = if n == 0 { ends[0] } else { last };
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::{Component, OpticalProfile, Phase};

    fn exponential_air() -> OpticalProfile {
        let altitudes: Vec<f64> = (0..=1000).map(|i| f64::from(i) * 0.1).collect();
        let scattering = altitudes.iter().map(|z| 0.0125 * (-z / 8.0).exp()).collect::<Vec<_>>();
        OpticalProfile {
            components: vec![Component {
                name: "molecules".into(),
                absorption_per_km: vec![0.0; altitudes.len()],
                scattering_per_km: scattering,
                phase: Some(Phase::Rayleigh { depolarisation: vec![0.0] }),
            }],
            altitudes_km: altitudes,
            wavelengths_nm: vec![550.0],
            ground_albedo: vec![0.0],
            solar_irradiance: vec![1.0],
            planet_radius_km: 6371.0,
            sun_angular_radius_deg: 0.2664,
        }
    }

    /// A source equal to the extinction is a medium of radiance 1: what is seen is 1 - transmittance, on any ray.
    #[test]
    fn a_glowing_medium_shows_what_it_hides() {
        let profile = exponential_air();
        let air = Air::<16>::new(&profile, 0, 0, false);
        let shells = Axis::new((0..=20).map(|i| 100.0 * (f64::from(i) / 20.0).powf(2.2)).collect());
        let limits = StepLimits { length_km: 25.0, optical_depth: 1.0 };
        for (z, mu, tau) in [(0.0, 1.0, 0.1), (100.0, -1.0, 0.1)] {
            let ray = Ray::trace(&air, &shells, z, mu, limits);
            let seen: f32 = ray.points.iter().map(|p| p.weight[0] * air.extinction(p.place)[0]).sum();
            let expected = 1.0 - (-tau * (1.0 - (-12.5_f64).exp())).exp();
            assert!((f64::from(seen) / expected - 1.0).abs() < 2e-4, "{z} {mu}: {seen} {expected}");
        }
        // Horizontal from the ground: Chapman's optical depth tau * sqrt(pi r / 2 H) (1 + 3 / (8 r / H)) for r >> H.
        let x = 6371.0_f64 / 8.0;
        let chapman = 0.1 * (std::f64::consts::PI * x / 2.0).sqrt() * (1.0 + 3.0 / (8.0 * x));
        let ray = Ray::trace(&air, &shells, 0.0, 0.0, limits);
        let seen: f32 = ray.points.iter().map(|p| p.weight[0] * air.extinction(p.place)[0]).sum();
        assert!((f64::from(seen) / (1.0 - (-chapman).exp()) - 1.0).abs() < 1e-3, "{seen}");
    }

    #[test]
    fn rays_end_on_the_ground_or_in_space() {
        let profile = exponential_air();
        let air = Air::<16>::new(&profile, 0, 0, false);
        let shells = Axis::new(vec![0.0, 1.0, 10.0, 100.0]);
        let limits = StepLimits { length_km: 25.0, optical_depth: 1.0 };
        let trace = |z, mu| Ray::trace(&air, &shells, z, mu, limits);
        assert!((trace(10.0, -1.0).ground.unwrap().0 - 10.0).abs() < 1e-9);
        assert_eq!(trace(0.0, -0.5).ground.unwrap().0, 0.0);
        assert!(trace(10.0, -0.01).ground.is_none());
        assert!(trace(0.0, 0.0).ground.is_none());
        assert!(trace(200.0, 0.5).points.is_empty());
        let through_the_limb = trace(200.0, -0.2);
        assert!(!through_the_limb.points.is_empty() && through_the_limb.ground.is_none());
        assert!(through_the_limb.points[0].distance > 100.0);
    }
}
