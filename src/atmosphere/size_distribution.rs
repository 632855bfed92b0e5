//! Many spheres: the optical properties of a size distribution, by integration of Mie theory over the radius.

use super::mie::{AngularFunctions, Sphere, terms};
use std::f64::consts::{PI, TAU};

/// How many particles there are of each radius, for one particle in all [um-1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SizeDistribution {
    /// dN / d ln r is a normal distribution of ln r; the part outside the limits is cut off and not made up for (OPAC, eq. 1).
    LogNormal {
        /// Median radius [um].
        radius_um: f64,
        /// Geometric standard deviation.
        sigma: f64,
        /// Smallest radius [um].
        smallest_um: f64,
        /// Largest radius [um].
        largest_um: f64,
    },
    /// dN / dr proportional to r^alpha exp(-b r^gamma) (Deirmendjian; OPAC, eq. 2).
    ModifiedGamma {
        /// Exponent of the small droplets.
        alpha: f64,
        /// Rate of the fall-off [um^-gamma].
        b: f64,
        /// Exponent of the fall-off.
        gamma: f64,
        /// Largest radius [um]; the smallest is 0.02 um.
        largest_um: f64,
    },
}

/// Optical properties per particle.
#[derive(Clone, Debug, PartialEq)]
pub struct Ensemble {
    /// Extinction cross-section [um2].
    pub extinction_um2: f64,
    /// Scattering cross-section [um2].
    pub scattering_um2: f64,
    /// Asymmetry parameter.
    pub asymmetry: f64,
    /// Phase function at the angles asked for, normalised to 4 pi.
    pub phase: Vec<f64>,
}

/// Step of the integral over the radius for large spheres, as a change of size parameter: Mie theory's results ripple from sphere to sphere.
const SIZE_STEP: f64 = 0.07;

/// The same for small spheres, as a relative change of radius.
const RELATIVE_STEP: f64 = 0.01;

/// Radii whose share of the forward intensity, r^4 times their number, is below this fraction of the largest share are left out.
const NEGLIGIBLE: f64 = 1e-8;

impl SizeDistribution {
    /// Smallest and largest radius [um].
    pub fn limits_um(&self) -> (f64, f64) {
        match *self {
            Self::LogNormal { smallest_um, largest_um, .. } => (smallest_um, largest_um),
            Self::ModifiedGamma { largest_um, .. } => (0.02, largest_um),
        }
    }

    /// dN / dr at `radius_um`, but for the constant factor of a modified gamma distribution.
    fn shape(&self, radius_um: f64) -> f64 {
        match *self {
            Self::LogNormal { radius_um: median, sigma, .. } => {
                let deviation = (radius_um / median).ln() / sigma.ln();
                (-0.5 * deviation * deviation).exp() / (TAU.sqrt() * sigma.ln() * radius_um)
            }
            Self::ModifiedGamma { alpha, b, gamma, .. } => radius_um.powf(alpha) * (-b * radius_um.powf(gamma)).exp(),
        }
    }

    /// Radii [um] and the number of particles that each stands for, for light of `wavelength_um`. `refinement` divides the steps.
    pub fn nodes(&self, wavelength_um: f64, refinement: f64) -> Vec<(f64, f64)> {
        let (smallest, largest) = self.limits_um();
        // The trapezoidal rule in t(r), whose unit is a step: smooth, so that the rule converges fast.
        let (relative, absolute) = (RELATIVE_STEP / refinement, SIZE_STEP * wavelength_um / TAU / refinement);
        let coordinate = |r: f64| r.ln() / relative + r / absolute;
        let slope = |r: f64| 1.0 / (relative * r) + 1.0 / absolute;
        let (first, last) = (coordinate(smallest), coordinate(largest));
        let count = (last - first).ceil() as usize;
        let step = (last - first) / count as f64;
        let mut radius = smallest;
        let mut nodes: Vec<(f64, f64)> = (0..=count)
            .map(|i| {
                let wanted = first + step * i as f64;
                for _ in 0..4 {
                    radius += (wanted - coordinate(radius)) / slope(radius);
                }
                let end = if i == 0 || i == count { 0.5 } else { 1.0 };
                (radius, end * step / slope(radius) * self.shape(radius))
            })
            .collect();
        if let Self::ModifiedGamma { .. } = self {
            let total: f64 = nodes.iter().map(|node| node.1).sum();
            nodes.iter_mut().for_each(|node| node.1 /= total);
        }
        let share = |&(radius, number): &(f64, f64)| number * radius.powi(4);
        let limit = NEGLIGIBLE * nodes.iter().map(share).fold(0.0, f64::max);
        nodes.retain(|node| share(node) > limit);
        nodes
    }

    /// Largest number of terms of the Mie series at `wavelength_um`.
    pub fn terms(&self, wavelength_um: f64) -> usize {
        terms(TAU * self.limits_um().1 / wavelength_um) + 1
    }

    /// The optical properties for light of `wavelength_um` and spheres of refractive index `index` (real, imaginary >= 0), at the
    /// scattering angles of `angular`. `refinement` divides the steps of the integral: 1 is enough for particles that absorb or are of very
    /// different sizes, 3 for the others, whose backscattering has narrow resonances (see the tests).
    pub fn ensemble(&self, wavelength_um: f64, index: (f64, f64), angular: &AngularFunctions, refinement: f64) -> Ensemble {
        let mut phase = vec![0.0; angular.len()];
        let (mut extinction, mut scattering, mut forward) = (0.0, 0.0, 0.0);
        for (radius, number) in self.nodes(wavelength_um, refinement) {
            let x = TAU * radius / wavelength_um;
            let sphere = Sphere::new(x, index.0, index.1);
            let efficiencies = sphere.efficiencies();
            let area = number * PI * radius * radius;
            extinction += area * efficiencies.extinction;
            scattering += area * efficiencies.scattering;
            forward += area * efficiencies.scattering * efficiencies.asymmetry;
            sphere.add_intensity(angular, number, &mut phase);
        }
        // Differential cross-section = intensity / k^2 = P C_sca / (4 pi), with k = 2 pi / wavelength.
        let factor = wavelength_um * wavelength_um / (PI * scattering);
        phase.iter_mut().for_each(|value| *value *= factor);
        Ensemble { extinction_um2: extinction, scattering_um2: scattering, asymmetry: forward / scattering, phase }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_the_distributions_are_the_published_ones() {
        let fog = SizeDistribution::ModifiedGamma { alpha: 4.0, b: 0.0562, gamma: 1.77, largest_um: 50.0 };
        let moment = |k: i32| fog.nodes(0.55, 1.0).iter().map(|(r, n)| n * r.powi(k)).sum::<f64>();
        // checked against: OPAC, table 1b: effective radius of fog 10.70 um
        assert!((moment(3) / moment(2) - 10.70).abs() < 0.03, "{}", moment(3) / moment(2));
        let mode = SizeDistribution::LogNormal { radius_um: 0.2, sigma: 1.5, smallest_um: 0.005, largest_um: 20.0 };
        let number: f64 = mode.nodes(0.55, 1.0).iter().map(|(_, n)| n).sum();
        let volume: f64 = mode.nodes(0.55, 1.0).iter().map(|(r, n)| n * r.powi(3)).sum();
        assert!((number - 1.0).abs() < 1e-4, "{number}");
        let expected = 0.2_f64.powi(3) * (4.5 * 1.5_f64.ln().powi(2)).exp();
        assert!((volume / expected - 1.0).abs() < 1e-5, "{volume} {expected}");
    }

    #[test]
    fn finer_steps_hardly_change_the_phase_function() {
        let cosines: Vec<f64> = [0.0, 0.5, 2.0, 10.0, 60.0, 120.0, 138.0, 142.0, 175.0, 179.0, 180.0]
            .iter()
            .map(|degrees: &f64| degrees.to_radians().cos())
            .collect();
        let mode =
            |radius_um, sigma, largest_um| SizeDistribution::LogNormal { radius_um, sigma, smallest_um: 0.005, largest_um };
        let fog = SizeDistribution::ModifiedGamma { alpha: 4.0, b: 0.0562, gamma: 1.77, largest_um: 50.0 };
        for (mode, index, refinement) in [
            (fog, (1.333, 0.0), 3.0),
            (mode(0.416, 2.03, 20.0), (1.354, 3e-9), 3.0),
            (mode(3.49, 2.03, 60.0), (1.354, 3e-9), 1.0),
            (mode(1.90, 2.15, 60.0), (1.53, 5.5e-3), 1.0),
        ] {
            let angular = AngularFunctions::new(&cosines, mode.terms(0.55));
            let coarse = mode.ensemble(0.55, index, &angular, refinement);
            let fine = mode.ensemble(0.55, index, &angular, 2.1 * refinement);
            assert!((coarse.extinction_um2 / fine.extinction_um2 - 1.0).abs() < 2e-4);
            for (k, (a, b)) in coarse.phase.iter().zip(&fine.phase).enumerate() {
                // Towards 180 degrees, transparent spheres have resonances that are narrower than any step.
                let limit = match cosines[k] {
                    cosine if cosine > -0.996 => 2e-3,
                    cosine if cosine > -1.0 => 6e-3,
                    _ => 1.5e-2,
                };
                assert!((a / b - 1.0).abs() < limit, "{mode:?}, angle {k}: {a} {b}");
            }
        }
    }
}
