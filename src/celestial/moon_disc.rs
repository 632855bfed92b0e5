//! The Moon's disc as it is drawn: a few spectra, and at each point of the disc a number for each of them.
//!
//! ```text
//! L(w, lambda) = E_sun(lambda, 1 au) [sum over c of S_c(lambda) x_c(w)]
//! sunlit:    S = A(lambda) / (pi d_sun^2),                 x = a^p D / mean of a^p D over the disc
//! in shadow: S = T_k(lambda) A(lambda) / (pi d_sun^2),     x = the same x hat function of node k of the shadow's table
//! earthshine S = e(lambda) A_1(lambda) / (pi d_sun^2),     x = a^p / mean of a^p over the disc
//! ```
//! A: disc-equivalent reflectance (ROLO); a: relative albedo; D, p: disc function and contrast; T_k: transmission into the Earth's
//! shadow at node k; e: irradiance of the Earth over that of the Sun at the Moon; A_1: reflectance at the phase angle of earthshine,
//! about 1 degree; d_sun: distance Moon-Sun [au]. Outside the shadow the disc's integral is the ROLO irradiance exactly, by the means.
//!
//! The night side has no relief, so that the terminator is smooth; the Sun's size (0.5 degrees on the Moon) is not resolved there.

use super::moon_irradiance::{DiscReflectance, MoonPhase};
use super::moon_reflectance::{contrast, disc_function};
use super::moon_view::MoonView;
use super::shadowed_sunlight::{EarthLimb, ShadowedSunlight};
use super::{earthshine, moon_map};
use crate::ephemeris::MOON_RADIUS_KM;
use crate::error::Result;
use crate::numerics::gauss::legendre;
use crate::units::ASTRONOMICAL_UNIT_KM;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::{Arc, LazyLock};

/// Root mean square angle between the Earth's centre and its surface elements, seen from the Moon [degrees]: the least phase angle of
/// earthshine.
const EARTH_SPREAD_DEG: f64 = 0.67;

/// Nodes of the quadrature over the sunlit disc, in photometric longitude and latitude: within 0.2 %, where 64 are 0.3 % off.
static SUNLIT: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| legendre(128));

/// The same for earthshine, whose amount is known to 10 %.
static EARTHLIT: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| legendre(64));

/// The Moon, ready to be drawn.
#[derive(Clone, Debug)]
pub struct MoonDisc {
    view: MoonView,
    frame: PhotometricFrame,
    phase: f64,
    contrast: f64,
    sunlit: DiscReflectance,
    earthlit: DiscReflectance,
    /// Means over the disc.
    sunlit_mean: f64,
    earthlit_mean: f64,
    shadow: Option<Shadow>,
    integrals: Vec<f64>,
}

/// The part of the shadow's table that the disc needs.
#[derive(Clone, Debug)]
struct Shadow {
    table: Arc<ShadowedSunlight>,
    first: usize,
    count: usize,
}

/// One point of the disc: `weights[i].1` times the spectrum of component `weights[i].0`, summed. Unused entries are (0, 0).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MoonPoint {
    /// Component and its dimensionless factor x.
    pub weights: [(usize, f64); 3],
}

impl MoonPoint {
    /// The sum over the components of `values` (such as X of each component's spectrum behind the air) times the factors.
    #[inline]
    pub fn mix(&self, values: &[f64]) -> f64 {
        self.weights.iter().map(|&(component, weight)| weight * values[component]).sum()
    }
}

impl MoonDisc {
    /// The disc in `view`; the Earth's shadow, where it matters, through the default limb of the Earth. 4 ms; an eclipse about 20 ms.
    pub fn new(view: MoonView) -> Result<Self> {
        view.validate()?;
        let sun_distance_km = view.sun_distance_au * ASTRONOMICAL_UNIT_KM;
        let shadow = match view.shadow_angle(view.earth_direction) {
            Some(angle)
                if angle
                    < ShadowedSunlight::greatest_reach(view.earth_distance_km, sun_distance_km) + view.angular_radius() * 1.1 =>
            {
                let to_earth = sun_distance_km - view.earth_distance_km;
                Some(Arc::new(ShadowedSunlight::new(&EarthLimb::default(), view.earth_distance_km, to_earth)?))
            }
            _ => None,
        };
        Self::with_shadow(view, shadow)
    }

    /// The disc in `view` with a given shadow of the Earth, or none.
    pub fn with_shadow(view: MoonView, shadow: Option<Arc<ShadowedSunlight>>) -> Result<Self> {
        view.validate()?;
        let phase = view.phase_angle();
        let parallax = view.parallax_angle().to_degrees();
        let rolo = view.phase();
        let at_earth = MoonPhase { phase_angle_deg: parallax.hypot(EARTH_SPREAD_DEG), sun_longitude_deg: 0.0, ..rolo };
        let mut disc = Self {
            view,
            frame: PhotometricFrame::new(&view),
            phase,
            contrast: contrast(phase),
            sunlit: rolo.reflectance(),
            earthlit: at_earth.reflectance(),
            sunlit_mean: 1.0,
            earthlit_mean: 1.0,
            shadow: None,
            integrals: Vec::new(),
        };
        disc.sunlit_mean = disc.mean(&SUNLIT, phase, |normal, brightness| disc.albedo(normal, disc.contrast) * brightness);
        disc.earthlit_mean = disc.mean(&EARTHLIT, 0.0, |normal, _| disc.albedo(normal, contrast(0.0)));
        disc.shadow = shadow.and_then(|table| disc.cut(table));
        disc.integrals = disc.integrate();
        Ok(disc)
    }

    /// The geometry.
    pub fn view(&self) -> &MoonView {
        &self.view
    }

    /// Number of components: 0 is the sunlit Moon outside the shadow, 1 earthshine, the others the shadow's nodes.
    pub fn components(&self) -> usize {
        2 + self.shadow.as_ref().map_or(0, |shadow| shadow.count)
    }

    /// S of `component` at `wavelength_nm`: spectral radiance for x = 1 over the Sun's irradiance at 1 au [sr-1].
    ///
    /// # Panics
    /// If there is no such component.
    pub fn spectrum(&self, component: usize, wavelength_nm: f64) -> f64 {
        let sun = 1.0 / (PI * self.view.sun_distance_au * self.view.sun_distance_au);
        match component {
            0 => self.sunlit.at(wavelength_nm) * sun,
            1 => {
                let earth_phase = PI - self.view.earth_sun_angle();
                let earth = earthshine::irradiance_ratio(wavelength_nm, earth_phase, self.view.earth_distance_km);
                earth * self.earthlit.at(wavelength_nm) * sun
            }
            _ => {
                let shadow = self.shadow.as_ref().expect("only an eclipsed Moon has more than two components");
                assert!(component - 2 < shadow.count, "component {component} of {}", self.components());
                shadow.table.node_transmission(shadow.first + component - 2, wavelength_nm) * self.sunlit.at(wavelength_nm) * sun
            }
        }
    }

    /// What is seen in `direction` (unit vector), or `None` beside the disc.
    pub fn at(&self, direction: DVec3) -> Option<MoonPoint> {
        let normal = self.view.surface_normal(direction)?;
        Some(self.at_surface(normal))
    }

    /// What the surface point in the direction `normal` from the Moon's centre shows to the observer.
    pub fn at_surface(&self, normal: DVec3) -> MoonPoint {
        let (longitude, latitude) = self.frame.coordinates(normal);
        self.point(normal, disc_function(self.phase, longitude, latitude))
    }

    /// Irradiance of the whole disc over that of the Sun at 1 au, at `wavelength_nm`, outside the air.
    pub fn irradiance_ratio(&self, wavelength_nm: f64) -> f64 {
        self.integrals.iter().enumerate().map(|(c, integral)| integral * self.spectrum(c, wavelength_nm)).sum()
    }

    /// Integral of each component's x over the disc [sr]: with the spectra, the irradiance.
    pub fn component_integrals(&self) -> &[f64] {
        &self.integrals
    }

    fn integrate(&self) -> Vec<f64> {
        let solid_angle = self.view.solid_angle();
        if self.shadow.is_none() {
            // By the means.
            return vec![solid_angle; 2];
        }
        let mut integrals = vec![0.0; self.components()];
        // In shadow the lit side is the whole disc: the earthlit grid sees all of it.
        self.visit(&SUNLIT, self.phase, |normal, brightness, share| {
            for (component, weight) in self.point(normal, brightness).weights {
                if component != 1 {
                    integrals[component] += weight * share * solid_angle;
                }
            }
        });
        integrals[1] = solid_angle;
        integrals
    }

    fn point(&self, normal: DVec3, brightness: f64) -> MoonPoint {
        let albedo = moon_map::relative_albedo(self.view.body_to_frame.transpose() * normal);
        let sunlit = albedo.powf(self.contrast) * brightness / self.sunlit_mean;
        let earthlit = albedo.powf(contrast(0.0)) / self.earthlit_mean;
        let mut weights = [(0, sunlit), (1, earthlit), (0, 0.0)];
        if let Some(shadow) = self.shadow.as_ref().filter(|_| sunlit > 0.0)
            && let Some(angle) = self.view.shadow_angle(normal)
        {
            let (node, share) = shadow.table.position(angle);
            let component = |node: usize| {
                if node >= shadow.table.last_node() { 0 } else { 2 + node.saturating_sub(shadow.first).min(shadow.count - 1) }
            };
            weights[0] = (component(node), sunlit * (1.0 - share));
            weights[2] = (component(node + 1), sunlit * share);
        }
        MoonPoint { weights }
    }

    fn albedo(&self, normal: DVec3, exponent: f64) -> f64 {
        moon_map::relative_albedo(self.view.body_to_frame.transpose() * normal).powf(exponent)
    }

    /// Mean of `f` over the disc's solid angle, of the part lit at `phase`.
    fn mean(&self, rule: &[(f64, f64)], phase: f64, f: impl Fn(DVec3, f64) -> f64) -> f64 {
        let mut sum = 0.0;
        self.visit(rule, phase, |normal, brightness, share| sum += share * f(normal, brightness));
        sum
    }

    /// Calls `visit` with points of the part of the disc that is lit at `phase`, D there, and their share of the disc's solid angle.
    fn visit(&self, rule: &[(f64, f64)], phase: f64, mut visit: impl FnMut(DVec3, f64, f64)) {
        let observer = -self.view.direction * self.view.distance_km;
        let solid_angle = self.view.solid_angle();
        let lit = (PI - phase).max(0.0);
        for &(x, width) in rule {
            let longitude = FRAC_PI_2 - lit * (1.0 - x);
            for &(y, height) in rule {
                let latitude = PI * (y - 0.5);
                let normal = self.frame.normal(longitude, latitude);
                // In perspective: the element's solid angle as the observer has it.
                let to_observer = observer - normal * MOON_RADIUS_KM;
                let distance = to_observer.length();
                let facing = normal.dot(to_observer) / distance;
                if facing > 0.0 {
                    let area = width * lit * height * PI * latitude.cos() * (MOON_RADIUS_KM / distance).powi(2);
                    visit(normal, disc_function(phase, longitude, latitude), area * facing / solid_angle);
                }
            }
        }
    }

    /// The nodes of the table that the disc touches, or `None` if it is outside the shadow.
    fn cut(&self, table: Arc<ShadowedSunlight>) -> Option<Shadow> {
        let centre = self.view.shadow_angle(self.view.earth_direction)?;
        let reach = 1.02 * MOON_RADIUS_KM / self.view.earth_distance_km;
        if centre - reach >= table.reach() {
            return None;
        }
        let first = table.position((centre - reach).max(0.0)).0;
        let last = (table.position(centre + reach).0 + 1).min(table.last_node() - 1);
        Some(Shadow { table, first, count: last + 1 - first })
    }
}

/// Axes of photometric coordinates: towards the observer, towards the Sun across that, and the third.
#[derive(Clone, Copy, Debug)]
struct PhotometricFrame {
    observer: DVec3,
    sunward: DVec3,
    pole: DVec3,
}

impl PhotometricFrame {
    fn new(view: &MoonView) -> Self {
        let observer = -view.direction;
        let across = view.sun_direction - view.sun_direction.dot(observer) * observer;
        let sunward = across.try_normalize().unwrap_or_else(|| observer.any_orthonormal_vector());
        Self { observer, sunward, pole: observer.cross(sunward) }
    }

    fn coordinates(&self, normal: DVec3) -> (f64, f64) {
        let latitude = normal.dot(self.pole).clamp(-1.0, 1.0).asin();
        (normal.dot(self.sunward).atan2(normal.dot(self.observer)), latitude)
    }

    fn normal(&self, longitude: f64, latitude: f64) -> DVec3 {
        latitude.cos() * (longitude.cos() * self.observer + longitude.sin() * self.sunward) + latitude.sin() * self.pole
    }
}

#[cfg(test)]
mod tests;
