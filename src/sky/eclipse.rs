//! The Sun behind the Moon: what is left of its disc and of the sky's light, and the corona.
//!
//! The light field is solved for parallel sunlight that is the same everywhere; under the Moon's shadow it is not. The honest approximation: the sky is that of the whole Sun, dimmed at each wavelength by
//! the uncovered, limb-darkened part of the disc as seen from the observer, and towards totality light that comes in from outside the umbra is left, more at the horizon
//! ([`crate::celestial::eclipsed_sunlight::remaining_sky_light`]). The ground is lit by what is left of Sun and sky:
//! ```text
//! share of the ground = (E_sun left + E_sky left) / (E_sun + E_sky),
//! ```
//! horizontal irradiances without and with the eclipse, the Sun's with the corona; the air before it has the share of the sky as far above the horizontal.

use super::disc::{Disc, Surface, SurfaceMap};
use crate::celestial::{Corona, EclipsedSunlight, eclipsed_sunlight::remaining_sky_light};
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Wavelength for the Sun's light as a whole [nm].
pub(super) const MIDDLE_NM: f64 = 550.0;

/// Wavelengths and weights of the limb darkening of X, Y and Z [nm].
const COLOURS: [[(f64, f64); 2]; 3] = [[(600.0, 0.8), (450.0, 0.2)], [(550.0, 1.0), (550.0, 0.0)], [(450.0, 1.0), (450.0, 0.0)]];

/// Uncovered part of the Sun's light below which the corona is drawn; with more, the sky outshines it.
const CORONA_BELOW: f64 = 1e-3;

/// The corona, where it is not outshone by what is left of the Sun.
pub(super) fn corona(eclipse: EclipsedSunlight) -> Option<Corona> {
    (eclipse.visible_fraction(MIDDLE_NM) < CORONA_BELOW).then(|| Corona::new(eclipse))
}

/// Share of the sky's light that is left in the zenith when the part `uncovered` of the Sun's is.
pub(super) fn sky_share(uncovered: f64) -> f64 {
    remaining_sky_light(uncovered, FRAC_PI_2)
}

/// Light of the sky at `altitude` above the horizontal [radians] over what [`sky_share`] says.
pub(super) fn gain_of_sky(uncovered: f64, altitude: f64) -> f64 {
    remaining_sky_light(uncovered, altitude) / sky_share(uncovered)
}

/// Light in all directions over what [`sky_share`] says.
pub(super) struct Gain {
    uncovered: f64,
    horizon: f64,
    ground: f64,
    /// Of the air before the ground, evenly from the horizon to the nadir in the square root of the share of the way.
    transmittance: Vec<f64>,
}

/// Altitudes of the table of transmittances.
const ALTITUDES: usize = 32;

impl Gain {
    /// For the horizon at `horizon` [radians], the horizontal irradiance by the Sun without and under an eclipse and by the sky without and under it, and the transmittance of the air
    /// to the ground at an altitude [radians].
    pub fn new(
        eclipse: &EclipsedSunlight,
        horizon: f64,
        [(sun, sun_left), (sky, sky_left)]: [(f64, f64); 2],
        transmittance: impl Fn(f64) -> f64,
    ) -> Self {
        let uncovered = eclipse.visible_fraction(MIDDLE_NM);
        let whole = sun + sky;
        let ground = if whole > 0.0 { (sun_left + sky_left) / whole / sky_share(uncovered) } else { 1.0 };
        let altitude = |i: usize| horizon - (FRAC_PI_2 + horizon) * (i as f64 / (ALTITUDES - 1) as f64).powi(2).max(1e-7);
        Self { uncovered, horizon, ground, transmittance: (0..ALTITUDES).map(|i| transmittance(altitude(i))).collect() }
    }

    /// At `altitude` [radians].
    pub fn at(&self, altitude: f64) -> f64 {
        let sky = gain_of_sky(self.uncovered, altitude.abs());
        if altitude >= self.horizon {
            return sky;
        }
        let share = ((self.horizon - altitude) / (FRAC_PI_2 + self.horizon)).clamp(0.0, 1.0);
        let position = share.sqrt() * (ALTITUDES - 1) as f64;
        let node = (position as usize).min(ALTITUDES - 2);
        let fraction = position - node as f64;
        let clear = self.transmittance[node] * (1.0 - fraction) + self.transmittance[node + 1] * fraction;
        clear * self.ground + (1.0 - clear) * sky
    }
}

/// Axes of a disc around the Sun.
#[derive(Clone, Copy, Debug)]
struct Axes {
    right: DVec3,
    up: DVec3,
    radius: f64,
}

impl Axes {
    fn new(eclipse: &EclipsedSunlight, radius: f64) -> Self {
        let right = eclipse.sun_direction().cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        Self { right, up: right.cross(eclipse.sun_direction()), radius }
    }

    fn direction(&self, eclipse: &EclipsedSunlight, right: f64, up: f64) -> DVec3 {
        let across = self.radius * (1.0 - 1e-9) * (right * self.right + up * self.up);
        (eclipse.sun_direction() * (1.0 - across.length_squared()).max(0.0).sqrt() + across).normalize()
    }
}

#[derive(Debug)]
struct Crescent {
    eclipse: EclipsedSunlight,
    axes: Axes,
}

impl SurfaceMap for Crescent {
    fn brightness(&self, right: f64, up: f64) -> [f64; 3] {
        let direction = self.axes.direction(&self.eclipse, right, up);
        let at = |parts: [(f64, f64); 2]| {
            parts.iter().map(|&(wavelength, weight)| weight * self.eclipse.relative_radiance(direction, wavelength)).sum()
        };
        COLOURS.map(at)
    }
}

#[derive(Debug)]
struct CoronaMap {
    eclipse: EclipsedSunlight,
    corona: Corona,
    axes: Axes,
}

impl SurfaceMap for CoronaMap {
    fn brightness(&self, right: f64, up: f64) -> [f64; 3] {
        [self.corona.at(self.axes.direction(&self.eclipse, right, up)); 3]
    }
}

/// What is seen of the Sun whose whole disc would be `whole`, of which `covered` has the irradiance that is left: the crescent, and towards totality the corona.
pub(super) fn discs(eclipse: EclipsedSunlight, whole: &Disc, left: [f64; 3]) -> Vec<Disc> {
    let mut discs = Vec::new();
    if left[1] > 0.0 {
        let axes = Axes::new(&eclipse, eclipse.sun_radius());
        discs.push(Disc { irradiance: left, surface: Surface::Mapped(Arc::new(Crescent { eclipse, axes })), ..whole.clone() });
    }
    if let Some(corona) = corona(eclipse) {
        let reach = corona.angular_radius();
        let axes = Axes::new(&eclipse, reach);
        let ratio = corona.irradiance_ratio();
        discs.push(Disc {
            horizontal_radius: reach,
            vertical_radius: reach * whole.vertical_radius / whole.horizontal_radius,
            irradiance: whole.irradiance.map(|value| value * ratio),
            surface: Surface::Mapped(Arc::new(CoronaMap { eclipse, corona, axes })),
            ..whole.clone()
        });
    }
    discs
}
