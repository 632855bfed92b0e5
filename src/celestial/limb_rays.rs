//! Rays that graze the Earth: bending and columns against the height of their lowest point.
//!
//! With n r sin psi = a = n_t r_t along a ray (Bouguer), r_t the radius of its lowest point,
//! ```text
//! bending  omega = -2 a integral over r from r_t of (dn / dr) / (n sqrt(n^2 r^2 - a^2)) dr
//! column   C_q   =  2   integral over r from r_t of q(r) n r / sqrt(n^2 r^2 - a^2) dr
//! ```
//! n: refractive index, q: number density (air, ozone) or extinction (aerosol). The variable sqrt(r - r_t) removes the root at the
//! lower end. Source: Garcia Munoz & Palle, Journal of Quantitative Spectroscopy & Radiative Transfer 112, 1609 (2011); Link, in Kopal
//! (ed.), Physics and Astronomy of the Moon (1962). Air: US Standard Atmosphere 1976 with AFGL ozone, refractivity at 600 nm (it
//! changes by 1.5 % over the visible).

use crate::atmosphere::{StandardAtmosphere, molecules};
use crate::numerics::gauss::legendre;
use crate::units::EARTH_RADIUS_KM;
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// Height above which rays are neither bent nor dimmed [km]: omega is below 0.1 arcseconds.
pub const TOP_KM: f64 = 100.0;

/// Scale height of the aerosol near the ground [km].
const HAZE_SCALE_KM: f64 = 1.5;

/// Middle and standard deviation of the stratospheric aerosol layer [km]: about what satellites saw in quiet years (chosen).
const STRATOSPHERIC_LAYER_KM: (f64, f64) = (18.0, 5.0);

/// Step of the tables of the air [km].
const STEP_KM: f64 = 0.1;

/// A cell of rays between two heights, by its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbRay {
    /// Height of the lowest point [km].
    pub height_km: f64,
    /// Distance of the unbent ray from the Earth's centre, a = n_t r_t [km].
    pub impact_km: f64,
    /// Width of the cell in that distance [km].
    pub width_km: f64,
    /// Bending towards the Earth [radians].
    pub bending: f64,
    /// Molecules of air along the ray [m-2].
    pub air_per_m2: f64,
    /// Ozone along the ray over that in a vertical column.
    pub ozone_path: f64,
    /// Optical depth along the ray of haze with a vertical optical depth of 1.
    pub haze_path: f64,
    /// Optical depth along the ray of stratospheric aerosol with a vertical optical depth of 1.
    pub stratospheric_path: f64,
}

/// Rays from the ground to [`TOP_KM`], traced at first use (some milliseconds).
pub fn limb_rays() -> &'static [LimbRay] {
    static RAYS: LazyLock<Vec<LimbRay>> = LazyLock::new(trace_all);
    &RAYS
}

fn trace_all() -> Vec<LimbRay> {
    let air = AirTable::new();
    let mut rays = Vec::new();
    let (mut low, mut step) = (0.0, 0.04);
    while low < TOP_KM - 1e-9 {
        let high = if low + 1.5 * step > TOP_KM { TOP_KM } else { low + step };
        let mut ray = air.trace(0.5 * (low + high));
        ray.width_km = air.impact_km(high) - air.impact_km(low);
        rays.push(ray);
        low = high;
        // A cell stays well below the Sun's size on the bent sky.
        step = if low < 8.0 { 0.04 } else { (low * 0.005).max(0.05 * (low - 18.0)) };
    }
    rays
}

/// The air against height, in steps; logarithms of densities are linear between them.
struct AirTable {
    log_air_per_m3: Vec<f64>,
    ozone_per_m3: Vec<f64>,
    ozone_column_per_m2: f64,
    /// n - 1 over the number density [m3].
    refraction_per_molecule: f64,
}

impl AirTable {
    fn new() -> Self {
        let model = StandardAtmosphere::UsStandard1976;
        let heights: Vec<f64> = (0..=1400).map(|i| f64::from(i) * STEP_KM).collect();
        let ozone_per_m3: Vec<f64> = heights.iter().map(|&z| model.ozone_per_m3(z)).collect();
        Self {
            log_air_per_m3: heights.iter().map(|&z| model.number_density_per_m3(z).ln()).collect(),
            ozone_column_per_m2: ozone_per_m3.iter().sum::<f64>() * STEP_KM * 1000.0,
            ozone_per_m3,
            refraction_per_molecule: molecules::refractivity(0.0, 600.0) / model.number_density_per_m3(0.0),
        }
    }

    fn cell(&self, height_km: f64) -> (usize, f64) {
        let position = height_km.max(0.0) / STEP_KM;
        let cell = (position as usize).min(self.ozone_per_m3.len() - 2);
        (cell, (position - cell as f64).min(1.0))
    }

    /// n - 1 and its slope [km-1], number density of air and ozone [m-3].
    fn at(&self, height_km: f64) -> (f64, f64, f64, f64) {
        let (cell, share) = self.cell(height_km);
        let slope = self.log_air_per_m3[cell + 1] - self.log_air_per_m3[cell];
        let air = (self.log_air_per_m3[cell] + slope * share).exp();
        let ozone = self.ozone_per_m3[cell] * (1.0 - share) + self.ozone_per_m3[cell + 1] * share;
        let refractivity = self.refraction_per_molecule * air;
        (refractivity, refractivity * slope / STEP_KM, air, ozone)
    }

    fn impact_km(&self, height_km: f64) -> f64 {
        (1.0 + self.at(height_km).0) * (EARTH_RADIUS_KM + height_km)
    }

    fn trace(&self, height_km: f64) -> LimbRay {
        let (lowest_refractivity, ..) = self.at(height_km);
        let impact_km = self.impact_km(height_km);
        let end = (self.ozone_per_m3.len() - 1) as f64 * STEP_KM - height_km;
        let (mut bending, mut air_km, mut ozone_km, mut haze, mut layer) = (0.0, 0.0, 0.0, 0.0, 0.0);
        let panels = 32;
        let rule = legendre(6);
        let (middle, deviation) = STRATOSPHERIC_LAYER_KM;
        for panel in 0..panels {
            for &(x, weight) in &rule {
                let root = end.sqrt() * (f64::from(panel) + x) / f64::from(panels);
                let rise = root * root;
                let (refractivity, slope, air, ozone) = self.at(height_km + rise);
                let radius = EARTH_RADIUS_KM + height_km + rise;
                let index = 1.0 + refractivity;
                // n r - a without cancellation.
                let above = (refractivity - lowest_refractivity) * radius + (1.0 + lowest_refractivity) * rise;
                let measure = weight * end.sqrt() / f64::from(panels) * 2.0 * root
                    / (above * (index * radius + impact_km)).max(1e-300).sqrt();
                bending -= 2.0 * impact_km * slope / index * measure;
                let length = 2.0 * index * radius * measure;
                air_km += air * length;
                ozone_km += ozone * length;
                haze += (-(height_km + rise) / HAZE_SCALE_KM).exp() / HAZE_SCALE_KM * length;
                layer += (-0.5 * ((height_km + rise - middle) / deviation).powi(2)).exp() / (deviation * TAU.sqrt()) * length;
            }
        }
        LimbRay {
            height_km,
            impact_km,
            width_km: 0.0,
            bending,
            air_per_m2: air_km * 1000.0,
            ozone_path: ozone_km * 1000.0 / self.ozone_column_per_m2,
            haze_path: haze,
            stratospheric_path: layer,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_that_grazes_the_ground_is_bent_twice_the_horizontal_refraction() {
        let ray = AirTable::new().trace(0.0);
        // checked against: horizontal refraction at sea level in the US Standard Atmosphere, 33.01 arcminutes at 550 nm (another ray trace)
        let dispersion = molecules::standard_refractivity(600.0) / molecules::standard_refractivity(550.0);
        let minutes = ray.bending.to_degrees() * 60.0;
        println!("{minutes:.2}'");
        assert!((minutes / (2.0 * 33.01 * dispersion) - 1.0).abs() < 4e-3, "{minutes}");
    }

    #[test]
    fn columns_are_those_of_an_exponential_air() {
        // Chapman: column along a grazing ray = n(h) sqrt(2 pi r H (1 + small)); the stratosphere around 15 km is isothermal, H = 6.34 km.
        let ray = AirTable::new().trace(14.0);
        let model = StandardAtmosphere::UsStandard1976;
        let scale = 1.0 / (model.number_density_per_m3(13.5) / model.number_density_per_m3(14.5)).ln();
        let straight = model.number_density_per_m3(14.0) * (TAU * (EARTH_RADIUS_KM + 14.0) * scale).sqrt() * 1000.0;
        // Bending lengthens it by about half of the ray's curvature over the Earth's.
        let curvature = molecules::refractivity(14_000.0, 600.0) * (EARTH_RADIUS_KM + 14.0) / scale;
        let expected = straight * (1.0 + 0.35 * curvature);
        assert!((ray.air_per_m2 / expected - 1.0).abs() < 0.02, "{}", ray.air_per_m2 / straight);
    }

    #[test]
    fn everything_fades_with_height() {
        let start = std::time::Instant::now();
        let rays = trace_all();
        println!("{} rays in {:.1} ms", rays.len(), start.elapsed().as_secs_f64() * 1e3);
        for pair in rays.windows(2) {
            assert!(pair[1].air_per_m2 < pair[0].air_per_m2 && pair[1].impact_km > pair[0].impact_km);
            // At steps of the temperature's slope bending may grow a little with height.
            assert!(pair[1].bending < 1.02 * pair[0].bending);
        }
        let total: f64 = rays.iter().map(|ray| ray.width_km).sum();
        let air = AirTable::new();
        assert!((total - (air.impact_km(TOP_KM) - air.impact_km(0.0))).abs() < 1e-6);
        assert!(rays.last().unwrap().bending.to_degrees() * 3600.0 < 0.1);
    }
}
