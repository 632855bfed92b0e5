//! Where the Sun stands along a ray: many positions of the Sun and azimuths at once.

use super::grid::Grid;

/// The ray's constants for one position of the Sun, from which the Sun's place at any point of the ray follows.
///
/// With r0 the distance of the ray's start from the centre and t that along the ray: cos theta = (r0 cos theta0 + t (view . sun)) / r, and the local azimuth follows
/// from components of the Sun along and across the ray's vertical plane, without cancellation and exact at the zenith.
#[derive(Clone, Copy, Debug)]
pub struct SunOnRay {
    /// Cosine of the angle between ray and Sun: the same all along the ray.
    pub scattering_cosine: f64,
    /// Components of the unit vector to the Sun along e_theta and e_phi of the ray's frame (see [`super::stokes`]): also the same all along the ray.
    pub transverse: [f64; 2],
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
        let along_slope = sun_sine * azimuth_cosine * mu - sun_cosine * s;
        Self {
            scattering_cosine: mu * sun_cosine + s * sun_sine * azimuth_cosine,
            transverse: [along_slope, -sun_sine * azimuth_sine],
            radius,
            zenith_cosine: sun_cosine,
            along: sun_sine * azimuth_cosine * radius,
            along_slope,
            across: sun_sine * azimuth_sine,
        }
    }

    /// Cosine of the solar zenith angle at `distance` [km] where the ray's distance from the centre is `radius` [km].
    #[inline(always)]
    pub fn zenith_cosine(&self, distance: f64, radius: f64) -> f64 {
        ((self.radius * self.zenith_cosine + distance * self.scattering_cosine) / radius).clamp(-1.0, 1.0)
    }
}

/// Work space: several positions of the Sun and azimuths of one ray, placed at one of its points after the other.
pub struct Suns {
    zenith: Vec<f32>,
    scattering: Vec<f32>,
    along: Vec<f32>,
    along_slope: Vec<f32>,
    across: Vec<f32>,
    /// Cosine of the local solar zenith angle.
    cosines: Vec<f32>,
    /// Cosine and sine of the local azimuth of the ray from the Sun.
    pub azimuth_cosines: Vec<f32>,
    /// Sine of the same; positive where the ray's own azimuth is.
    pub azimuth_sines: Vec<f32>,
    /// Positions among the nodes of the solar zenith angle; negative beyond the last one.
    pub positions: Vec<f32>,
}

impl Suns {
    /// For the given constants of a ray.
    pub fn new(on_rays: &[SunOnRay]) -> Self {
        let n = on_rays.len();
        let column = |value: &dyn Fn(&SunOnRay) -> f64| on_rays.iter().map(|s| value(s) as f32).collect::<Vec<f32>>();
        Self {
            zenith: column(&|s| s.zenith_cosine),
            scattering: column(&|s| s.scattering_cosine),
            along: column(&|s| s.along / s.radius),
            along_slope: column(&|s| s.along_slope),
            across: column(&|s| s.across),
            cosines: vec![0.0; n],
            azimuth_cosines: vec![0.0; n],
            azimuth_sines: vec![0.0; n],
            positions: vec![0.0; n],
        }
    }

    /// Finds where all Suns stand at `distance` [km] along the ray that started at `start_radius` and is now at `radius` [km].
    #[inline(always)]
    pub fn place(&mut self, grid: &Grid, start_radius: f64, distance: f64, radius: f64) {
        let (turn, advance) = ((start_radius / radius) as f32, (distance / radius) as f32);
        let n = self.positions.len();
        let (zenith, scattering, cosines) = (&self.zenith[..n], &self.scattering[..n], &mut self.cosines[..n]);
        for k in 0..n {
            cosines[k] = (turn * zenith[k] + advance * scattering[k]).clamp(-1.0, 1.0);
        }
        let (along, slope, across) = (&self.along[..n], &self.along_slope[..n], &self.across[..n]);
        let (azimuth_cosines, azimuth_sines) = (&mut self.azimuth_cosines[..n], &mut self.azimuth_sines[..n]);
        for k in 0..n {
            let along = turn * along[k] + advance * slope[k];
            // A Sun at the local zenith has no azimuth, and nothing depends on it there.
            let inverse = 1.0 / (along * along + across[k] * across[k]).sqrt().max(1e-12);
            azimuth_cosines[k] = (along * inverse).clamp(-1.0, 1.0);
            azimuth_sines[k] = (across[k] * inverse).clamp(-1.0, 1.0);
        }
        for (position, &cosine) in self.positions.iter_mut().zip(cosines.iter()) {
            *position = grid.zeniths.position(cosine).unwrap_or(-1.0);
        }
    }

    /// The nodes that are needed for the placed Suns.
    pub fn range(&self, grid: &Grid) -> std::ops::Range<usize> {
        let firsts = self.positions.iter().filter(|&&p| p >= 0.0).map(|&p| grid.zeniths.stencil(p).first);
        let low = firsts.clone().min().unwrap_or(0);
        low..firsts.max().map_or(low, |high| high + 4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quality::Quality;
    use glam::DVec3;

    #[test]
    fn the_sun_on_a_ray_is_where_vectors_say() {
        let [grid, _] =
            Grid::new(&Quality::Draft.numbers(), &crate::atmosphere::AirParameters::default().optical_profile(&[550.0]).unwrap());
        for (mu, azimuth, zenith) in [(0.3, 0.7, 0.9), (1.0, 0.4, 1.5), (-0.2, 3.0, 1.7), (0.05, 0.0, 0.2)] {
            let (r0, t): (f64, f64) = (6371.0, 250.0);
            let s = f64::sqrt(1.0 - mu * mu);
            let sun = DVec3::new(f64::sin(zenith), 0.0, f64::cos(zenith));
            let view = DVec3::new(s * f64::cos(azimuth), s * f64::sin(azimuth), mu);
            let place = DVec3::new(0.0, 0.0, r0) + t * view;
            let up = place.normalize();
            let on_ray = SunOnRay::new(r0, mu, (azimuth.cos(), azimuth.sin()), (zenith.sin(), zenith.cos()));
            assert!((on_ray.zenith_cosine(t, place.length()) - up.dot(sun)).abs() < 1e-12);
            let frame = [
                DVec3::new(mu * f64::cos(azimuth), mu * f64::sin(azimuth), -s),
                DVec3::new(-f64::sin(azimuth), f64::cos(azimuth), 0.0),
            ];
            for (component, axis) in on_ray.transverse.into_iter().zip(frame) {
                assert!((component - sun.dot(axis)).abs() < 1e-12);
            }
            let mut suns = Suns::new(&[on_ray]);
            suns.place(&grid, r0, t, place.length());
            assert!((f64::from(suns.cosines[0]) - up.dot(sun)).abs() < 1e-6);
            let flat = |v: DVec3| (v - up * up.dot(v)).normalize();
            let (sine, cosine) = if mu < 1.0 {
                let (view, sun) = (flat(view), flat(sun));
                (up.dot(sun.cross(view)), view.dot(sun))
            } else {
                azimuth.sin_cos()
            };
            assert!((f64::from(suns.azimuth_cosines[0]) - cosine).abs() < 1e-6, "{mu} {azimuth} {zenith}");
            assert!((f64::from(suns.azimuth_sines[0]) - sine).abs() < 1e-6, "{mu} {azimuth} {zenith}");
        }
    }
}
