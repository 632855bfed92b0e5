//! Stars and planets as points of light behind the air.

use super::super::disc::Point;
use super::super::place_and_time::Sky;
use crate::celestial::{StarSpectra, planet_irradiance, stars_to};
use crate::ephemeris::{Bodies, StarFrame, direction_from_horizontal, horizontal_from_direction};
use crate::error::Result;
use crate::light::LightField;
use crate::spectrum::Sensor;
use crate::time::JulianDate;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// Altitudes at which the air's transmittance is known, evenly in the square root of the share of the way from the horizon to the zenith.
const ALTITUDES: usize = 48;

/// Transmittance of the air to points at any altitude, by wavelength.
struct Extinction {
    horizon: f64,
    /// (altitude, wavelength).
    rows: Vec<Vec<f64>>,
}

impl Extinction {
    fn new(sky: &Sky, field: &LightField) -> Self {
        let horizon = sky.horizon();
        let at = |i: usize| {
            let share = (i as f64 / (ALTITUDES - 1) as f64).powi(2);
            sky.transmittance_towards(field, horizon + (FRAC_PI_2 - horizon) * share)
        };
        Self { horizon, rows: (0..ALTITUDES).map(at).collect() }
    }

    /// Node below an apparent altitude [radians], and the share of the next one.
    fn locate(&self, altitude: f64) -> (usize, f64) {
        let share = ((altitude - self.horizon) / (FRAC_PI_2 - self.horizon)).clamp(0.0, 1.0);
        let position = share.sqrt() * (ALTITUDES - 1) as f64;
        let node = (position as usize).min(ALTITUDES - 2);
        (node, position - node as f64)
    }

    /// Responses at each altitude to light of irradiance `spectrum`; `weights` make them of spectral values.
    fn colours(&self, spectrum: &[f64], weights: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let colour = |row: &Vec<f64>| {
            let mut xyz = [0.0; 3];
            for ((transmittance, value), weight) in row.iter().zip(spectrum).zip(weights) {
                (0..3).for_each(|k| xyz[k] += transmittance * value * weight[k]);
            }
            xyz
        };
        self.rows.iter().map(colour).collect()
    }

    fn mix(&self, colours: &[[f64; 3]], altitude: f64) -> [f64; 3] {
        let (node, share) = self.locate(altitude);
        std::array::from_fn(|k| colours[node][k] + share * (colours[node + 1][k] - colours[node][k]))
    }
}

/// The planets above the horizon, in the responses of `sensor`.
pub(super) fn planet_points(sky: &Sky, field: &LightField, bodies: &Bodies, sensor: &Sensor) -> Result<Vec<Point>> {
    let nodes = &sky.atmosphere().profile().wavelengths_nm;
    let weights = sensor.of(|_| 1.0);
    let horizon = sky.horizon();
    let points = bodies.planets.iter().filter_map(|state| {
        let altitude = state.body.apparent_altitude_deg.to_radians();
        let magnitude = state.body.magnitude.filter(|_| altitude > horizon)?;
        let extinction = sky.transmittance_towards(field, altitude);
        let mut irradiance = [0.0; 3];
        let spectrum = planet_irradiance(state.planet, magnitude, nodes);
        for ((transmittance, value), weight) in extinction.iter().zip(&spectrum).zip(&weights) {
            (0..3).for_each(|k| irradiance[k] += transmittance * value * weight[k]);
        }
        Some(Point { direction: state.body.apparent_direction(), irradiance })
    });
    Ok(points.collect())
}

/// The stars above the horizon, before anything looks at their light.
pub(super) struct SeenStars {
    stars: Vec<SeenStar>,
    spectra: StarSpectra,
    extinction: Extinction,
}

struct SeenStar {
    /// Refracted.
    direction: DVec3,
    /// Apparent [radians].
    altitude: f64,
    /// Of the spectra.
    row: usize,
    /// Light over that of a star of V = 0.
    level: f64,
}

impl SeenStars {
    /// Those of magnitude V <= `limit`.
    pub fn new(sky: &Sky, field: &LightField, bodies: &Bodies, limit: f64) -> Self {
        let spectra = StarSpectra::new(&sky.atmosphere().profile().wavelengths_nm);
        let extinction = Extinction::new(sky, field);
        let frame = StarFrame::new(&bodies.observer);
        let years = (bodies.observer.tt() - JulianDate::from_days(2_451_545.0)) / 365.25;
        let lowest = sky.refraction().horizon_true_altitude_deg().to_radians().sin() - 1e-6;
        let seen = |star: &crate::celestial::Star| {
            let airless = frame.direction_of(star.direction(years));
            if airless.z < lowest {
                return None;
            }
            let (direction, altitude) = refracted(sky, airless);
            if altitude < extinction.horizon {
                return None;
            }
            let level = 10_f64.powf(-0.4 * star.v_magnitude);
            Some(SeenStar { direction, altitude, row: spectra.row_of(star.b_minus_v), level })
        };
        Self { stars: stars_to(limit).par_iter().filter_map(seen).collect(), spectra, extinction }
    }

    /// As points in the responses of `sensor`.
    pub fn points(&self, sensor: &Sensor) -> Vec<Point> {
        let weights = sensor.of(|_| 1.0);
        let rows = (0..self.spectra.row_count()).into_par_iter();
        let colours: Vec<Vec<[f64; 3]>> = rows.map(|row| self.extinction.colours(self.spectra.row(row), &weights)).collect();
        let point = |star: &SeenStar| {
            let irradiance = self.extinction.mix(&colours[star.row], star.altitude).map(|value| value * star.level);
            Point { direction: star.direction, irradiance }
        };
        self.stars.par_iter().map(point).collect()
    }
}

/// Where a point is seen, and its apparent altitude [radians].
fn refracted(sky: &Sky, airless: DVec3) -> (DVec3, f64) {
    let (altitude_deg, azimuth_deg) = horizontal_from_direction(airless);
    let apparent_deg = sky.refraction().apparent_altitude_deg(altitude_deg);
    (direction_from_horizontal(apparent_deg, azimuth_deg), apparent_deg.to_radians())
}
