//! The Earth's shadow: how much sunlight, of which colour, reaches a point behind the Earth.
//!
//! Seen from that point, the Earth is a dark disc within a thin bright ring of air, which acts as a lens. A ray that leaves at the
//! angle phi from the Earth's centre and is bent by omega comes from the point of the sky at
//! ```text
//! epsilon(phi) = phi - omega(phi) D_sun / (D_sun + D),
//! ```
//! negative for the far side of the Sun's sky (D: distance from the Earth, D_sun: of the Earth from the Sun). Radiance is conserved along
//! rays, so the transmission is an integral over the sky *as seen*, in which the weakening by spreading is contained:
//! ```text
//! T(sigma, lambda) = integral I(rho, lambda) e^(-tau(phi, lambda)) c(phi) phi d phi d psi / integral over the free Sun of I,
//! rho^2 = epsilon^2 + sigma^2 - 2 epsilon sigma cos psi,
//! ```
//! I: limb-darkened Sun; sigma: angle between the centres of Sun and Earth; tau: optical depth along the ray (molecules,
//! ozone, aerosol); c: share of the limb that is free of clouds and mountains. One integral covers full light, penumbra and umbra.
//! Source: Garcia Munoz & Palle 2011 (see `limb_rays.rs`), their refracted component; Vollmer & Gedzelman, Applied Optics 47, H52 (2008).
//!
//! Left out: sunlight scattered, not refracted, by the limb (faint; it matters in an umbra darkened by a volcano: Garcia Munoz & Palle), and the Earth's flattening (0.3 %), for which eclipse almanacs make the shadow larger by 1 to 2 %:
//! here the air's own opacity does it.

use super::limb_darkening::{self, DISC_MEAN_OF_POWERS};
use super::limb_rays::{LimbRay, TOP_KM, limb_rays};
use crate::atmosphere::{molecules, ozone};
use crate::error::{Result, check_range};
use crate::numerics::gauss::legendre;
use crate::numerics::locate;
use crate::units::{EARTH_RADIUS_KM, SOLAR_RADIUS_KM};
use std::f64::consts::PI;

/// Wavelengths of the table [nm]: from, to, step.
const WAVELENGTHS_NM: (f64, f64, f64) = (360.0, 780.0, 10.0);

const WAVELENGTHS: usize = 43;

/// The air at the Earth's limb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarthLimb {
    /// Ozone column, 0 to 1000 [Dobson units].
    pub ozone_du: f64,
    /// Vertical optical depth of the haze near the ground at 550 nm, 0 to 5.
    pub aod550: f64,
    /// Vertical optical depth of the stratospheric aerosol at 550 nm, 0 to 1: 0.003 to 0.006 in quiet years, 0.15 after Pinatubo
    /// (1991), which makes a Moon that is nearly invisible.
    pub stratospheric_aod550: f64,
    /// Height up to which clouds matter, 0 to 20 [km]: the share of the limb that is clear at height h is 1 - exp(-(h / this)^2).
    pub cloud_height_km: f64,
}

impl Default for EarthLimb {
    /// A bright eclipse, without a recent great eruption. The cloud height is chosen between what two measured
    /// eclipses ask for (test in `moon_disc.rs`).
    fn default() -> Self {
        Self { ozone_du: 300.0, aod550: 0.1, stratospheric_aod550: 0.004, cloud_height_km: 10.0 }
    }
}

impl EarthLimb {
    /// Checks the ranges.
    pub fn validate(&self) -> Result<()> {
        check_range("ozone_du", self.ozone_du, 0.0, 1000.0, "Dobson units")?;
        check_range("aod550", self.aod550, 0.0, 5.0, "")?;
        check_range("stratospheric_aod550", self.stratospheric_aod550, 0.0, 1.0, "")?;
        check_range("cloud_height_km", self.cloud_height_km, 0.0, 20.0, "km")?;
        Ok(())
    }

    /// Transmission of a ray at each wavelength of the table.
    fn transmission(&self, ray: &LimbRay) -> [f64; WAVELENGTHS] {
        let clear = if self.cloud_height_km > 0.0 { -(-(ray.height_km / self.cloud_height_km).powi(2)).exp_m1() } else { 1.0 };
        let column = self.ozone_du * ozone::MOLECULES_PER_CM2_IN_DOBSON_UNIT * ray.ozone_path;
        std::array::from_fn(|i| {
            let wavelength = WAVELENGTHS_NM.0 + i as f64 * WAVELENGTHS_NM.2;
            let molecules = molecules::cross_section_m2(wavelength) * ray.air_per_m2;
            let ozone = ozone::cross_section_cm2(wavelength, WAVELENGTHS_NM.2) * column;
            // Angstrom exponents of continental haze and of sulphate droplets in quiet years.
            let haze = self.aod550 * (550.0 / wavelength).powf(1.3) * ray.haze_path;
            let layer = self.stratospheric_aod550 * (550.0 / wavelength).powf(1.5) * ray.stratospheric_path;
            clear * (-(molecules + ozone + haze + layer)).exp()
        })
    }
}

/// Transmission of sunlight into the shadow, tabulated against sigma, the angle between the centres of Sun and Earth seen from a point
/// behind the Earth. Magnitudes of a lunar eclipse are geometry: [`crate::ephemeris::EarthShadow`].
#[derive(Clone, Debug)]
pub struct ShadowedSunlight {
    /// [radians], ascending.
    angles: Vec<f64>,
    transmission: Vec<[f64; WAVELENGTHS]>,
    umbra: f64,
}

impl ShadowedSunlight {
    /// The shadow at `distance_km` from the Earth's centre (20 000 to 1 000 000), the Sun at `sun_distance_km` (0.5 to 2 au) from it.
    pub fn new(limb: &EarthLimb, distance_km: f64, sun_distance_km: f64) -> Result<Self> {
        limb.validate()?;
        check_range("distance_km", distance_km, 20_000.0, 1e6, "km")?;
        check_range("sun_distance_km", sun_distance_km, 0.7e8, 3e8, "km")?;
        let sky = Sky::new(distance_km, sun_distance_km);
        let angles = sky.nodes();
        let coefficients: Vec<[f64; 6]> =
            (0..WAVELENGTHS).map(|i| limb_darkening::coefficients(WAVELENGTHS_NM.0 + i as f64 * WAVELENGTHS_NM.2)).collect();
        let free: Vec<f64> = coefficients
            .iter()
            .map(|a| PI * sky.sun * sky.sun * a.iter().zip(DISC_MEAN_OF_POWERS).map(|(a, m)| a * m).sum::<f64>())
            .collect();
        let rays = limb_rays();
        let transmissions: Vec<[f64; WAVELENGTHS]> = rays.iter().map(|ray| limb.transmission(ray)).collect();
        let mut transmission: Vec<[f64; WAVELENGTHS]> = angles
            .iter()
            .map(|&sigma| {
                let mut sums = [0.0; WAVELENGTHS];
                let mut add = |moments: [f64; 6], transmission: Option<&[f64; WAVELENGTHS]>| {
                    for i in 0..WAVELENGTHS {
                        let light: f64 = coefficients[i].iter().zip(moments).map(|(a, moment)| a * moment).sum();
                        sums[i] += light * transmission.map_or(1.0, |transmission| transmission[i]);
                    }
                };
                add(sky.beside_the_air(sigma), None);
                for (ray, transmission) in rays.iter().zip(&transmissions) {
                    if let Some(moments) = sky.through_the_air(ray, sigma) {
                        add(moments, Some(transmission));
                    }
                }
                std::array::from_fn(|i| (sums[i] / free[i]).min(1.0))
            })
            .collect();
        // By construction; the quadrature says it to 1e-9.
        transmission[angles.len() - 1] = [1.0; WAVELENGTHS];
        Ok(Self { angles, transmission, umbra: sky.earth - sky.sun })
    }

    /// Transmission at `angle` from the axis (sigma) [radians], at `wavelength_nm` (360 to 780 nm, that of the ends outside).
    pub fn transmission(&self, angle: f64, wavelength_nm: f64) -> f64 {
        let (node, share) = self.position(angle);
        let (low, high) = (self.node_transmission(node, wavelength_nm), self.node_transmission(node + 1, wavelength_nm));
        low + (high - low) * share
    }

    /// Angle at which the table ends: full sunlight beyond [radians].
    pub fn reach(&self) -> f64 {
        self.angles[self.angles.len() - 1]
    }

    /// Angle of the edge of the umbra of an airless Earth [radians].
    pub fn umbra(&self) -> f64 {
        self.umbra
    }

    /// Node below `angle` and the share of the next one; between nodes the transmission is linear.
    pub fn position(&self, angle: f64) -> (usize, f64) {
        locate(&self.angles, angle)
    }

    /// Index of the last node, where the transmission is 1.
    pub fn last_node(&self) -> usize {
        self.angles.len() - 1
    }

    /// Transmission at a node, at `wavelength_nm`; between its wavelengths the logarithm is linear.
    pub fn node_transmission(&self, node: usize, wavelength_nm: f64) -> f64 {
        let position = ((wavelength_nm - WAVELENGTHS_NM.0) / WAVELENGTHS_NM.2).clamp(0.0, (WAVELENGTHS - 1) as f64);
        let left = (position as usize).min(WAVELENGTHS - 2);
        let row = &self.transmission[node];
        let share = position - left as f64;
        if row[left] <= 0.0 || row[left + 1] <= 0.0 {
            return row[left] * (1.0 - share) + row[left + 1] * share;
        }
        (row[left].ln() * (1.0 - share) + row[left + 1].ln() * share).exp()
    }

    /// The angle that [`Self::reach`] will be for these distances, without making the table [radians].
    pub fn greatest_reach(distance_km: f64, sun_distance_km: f64) -> f64 {
        let sky = Sky::new(distance_km, sun_distance_km);
        sky.air + sky.sun
    }
}

/// Angular sizes as seen from the shadow [radians].
struct Sky {
    distance_km: f64,
    /// The solid Earth, and it with its air.
    earth: f64,
    air: f64,
    sun: f64,
    /// Angle on the sky per bending.
    lever: f64,
    around: Vec<(f64, f64)>,
    outside: Vec<(f64, f64)>,
}

impl Sky {
    fn new(distance_km: f64, sun_distance_km: f64) -> Self {
        Self {
            distance_km,
            earth: (EARTH_RADIUS_KM / distance_km).asin(),
            air: ((EARTH_RADIUS_KM + TOP_KM) / distance_km).asin(),
            sun: (SOLAR_RADIUS_KM / (sun_distance_km + distance_km)).asin(),
            lever: sun_distance_km / (sun_distance_km + distance_km),
            around: legendre(8),
            outside: legendre(24),
        }
    }

    /// Dense where the light changes quickest: around the edge of the umbra.
    fn nodes(&self) -> Vec<f64> {
        let minute = (1.0 / 60.0_f64).to_radians();
        let (umbra, reach) = (self.earth - self.sun, self.air + self.sun);
        let mut nodes = vec![0.0];
        loop {
            let last = nodes[nodes.len() - 1];
            let step = if last < umbra - 5.0 * minute {
                0.5
            } else if last < umbra + 4.0 * minute {
                0.15
            } else {
                0.8
            };
            if last + 1.5 * step * minute >= reach {
                nodes.push(reach);
                return nodes;
            }
            nodes.push(last + step * minute);
        }
    }

    /// Integrals over psi of mu^k on the circle at `epsilon` from the Earth's centre, the Sun at `sigma`.
    fn circle(&self, epsilon: f64, sigma: f64) -> Option<[f64; 6]> {
        let distance = epsilon.abs();
        if (distance - sigma).abs() >= self.sun {
            return None;
        }
        let product = 2.0 * distance * sigma;
        let cosine = (distance * distance + sigma * sigma - self.sun * self.sun) / product.max(1e-300);
        let half = if cosine <= -1.0 { PI } else { cosine.min(1.0).acos() };
        let mut moments = [0.0; 6];
        for &(x, weight) in &self.around {
            // psi = half sin(t): removes the root where the circle leaves the Sun; a whole circle is smooth anyway.
            let (psi, measure) = if half < PI {
                let t = 0.5 * PI * x;
                (half * t.sin(), half * t.cos() * 0.5 * PI)
            } else {
                (PI * x, PI)
            };
            let rho = distance * distance + sigma * sigma - product * psi.cos();
            let mu = (1.0 - rho / (self.sun * self.sun)).max(0.0).sqrt();
            let mut power = 2.0 * weight * measure;
            for moment in &mut moments {
                *moment += power;
                power *= mu;
            }
        }
        Some(moments)
    }

    fn through_the_air(&self, ray: &LimbRay, sigma: f64) -> Option<[f64; 6]> {
        let phi = (ray.impact_km / self.distance_km).asin();
        let element = phi.sin() * ray.width_km / (self.distance_km * phi.cos());
        Some(self.circle(phi - ray.bending * self.lever, sigma)?.map(|moment| moment * element))
    }

    /// The same integral over what is seen of the Sun beside the air, in full light.
    fn beside_the_air(&self, sigma: f64) -> [f64; 6] {
        let mut sums = [0.0; 6];
        let end = sigma + self.sun;
        // Where circles begin to be cut by the Sun's edge the integrand has a kink.
        let mut knots = vec![self.air.max(sigma - self.sun), end];
        let kink = self.sun - sigma;
        if kink > knots[0] && kink < end {
            knots.insert(1, kink);
        }
        for piece in knots.windows(2) {
            if piece[1] <= piece[0] {
                continue;
            }
            for &(x, weight) in &self.outside {
                // Roots at both ends: epsilon = middle - half cos(pi x).
                let (middle, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
                let epsilon = middle - half * (PI * x).cos();
                let measure = weight * half * PI * (PI * x).sin() * epsilon;
                if let Some(moments) = self.circle(epsilon, sigma) {
                    for (sum, moment) in sums.iter_mut().zip(moments) {
                        *sum += moment * measure;
                    }
                }
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests;
