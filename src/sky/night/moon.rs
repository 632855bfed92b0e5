//! The Moon's disc behind the air.

use super::super::disc::{Disc, Surface, SurfaceMap};
use super::super::place_and_time::Sky;
use crate::celestial::MoonDisc;
use crate::ephemeris::{Bodies, MoonState};
use crate::error::Result;
use crate::light::LightField;
use crate::spectrum::{Sensor, solar};
use glam::DVec3;

/// Points across the disc at which the part above the horizon is measured.
const CUT: usize = 48;

/// The Moon's surface with its colours behind the air.
#[derive(Debug)]
struct MoonMap {
    moon: MoonDisc,
    right: DVec3,
    up: DVec3,
    radius: f64,
    /// The three responses to each component: radiance for the factor 1.
    colours: [Vec<f64>; 3],
}

impl SurfaceMap for MoonMap {
    fn brightness(&self, right: f64, up: f64) -> [f64; 3] {
        // The rim of the drawn disc is a hair outside the sphere's.
        let [right, up] = [right, up].map(|offset| offset * self.radius * (1.0 - 1e-9));
        let across = right * self.right + up * self.up;
        let direction = (self.moon.view().direction * (1.0 - across.length_squared()).max(0.0).sqrt() + across).normalize();
        let Some(point) = self.moon.at(direction) else { return [0.0; 3] };
        [0, 1, 2].map(|k| point.mix(&self.colours[k]))
    }
}

/// The Moon's disc in the responses of `sensor`, if any of it is above the horizon.
pub(in crate::sky) fn moon_disc(sky: &Sky, field: &LightField, bodies: &Bodies, sensor: &Sensor) -> Result<Option<Disc>> {
    let MoonState { body, .. } = &bodies.moon;
    let radius = (0.5 * body.angular_diameter_deg).to_radians();
    let vertical_radius = radius * sky.refraction().flattening(body.altitude_deg, body.angular_diameter_deg);
    let (altitude, horizon) = (body.apparent_altitude_deg.to_radians(), sky.horizon());
    if altitude + vertical_radius <= horizon {
        return Ok(None);
    }
    let moon = sky.moon(bodies)?;
    let transmittance = sky.transmittance_towards(field, altitude.max(horizon));
    let mut colours: [Vec<f64>; 3] = Default::default();
    for component in 0..moon.components() {
        let source = |wavelength| solar::irradiance(wavelength, 1.0) * moon.spectrum(component, wavelength);
        let weights = sensor.of(source);
        for (k, colours) in colours.iter_mut().enumerate() {
            colours.push(transmittance.iter().zip(&weights).map(|(transmittance, weight)| transmittance * weight[k]).sum());
        }
    }
    let direction = moon.view().direction;
    let right = direction.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
    let map = MoonMap { right, up: right.cross(direction), radius: moon.view().angular_radius(), colours, moon: moon.clone() };
    let integrals = map.moon.component_integrals();
    let whole = [0, 1, 2].map(|k| integrals.iter().zip(&map.colours[k]).map(|(integral, colour)| integral * colour).sum::<f64>());
    let share = visible_share(&map, (horizon - altitude) / vertical_radius);
    let irradiance: [f64; 3] = std::array::from_fn(|k| whole[k] * share[k]);
    if irradiance.iter().all(|&value| value <= 0.0) {
        return Ok(None);
    }
    Ok(Some(Disc {
        is_sun: false,
        direction: body.apparent_direction(),
        horizontal_radius: radius,
        vertical_radius,
        irradiance,
        surface: Surface::Mapped(std::sync::Arc::new(map)),
    }))
}

/// Share of each response's light that comes from above `from` (in radii, upwards from the centre).
fn visible_share(map: &MoonMap, from: f64) -> [f64; 3] {
    if from <= -1.0 {
        return [1.0; 3];
    }
    let (mut seen, mut all) = ([0.0; 3], [0.0; 3]);
    let offset = |i: usize| 2.0 * (i as f64 + 0.5) / CUT as f64 - 1.0;
    for up in (0..CUT).map(offset) {
        for right in (0..CUT).map(offset).filter(|right| right * right + up * up < 1.0) {
            let brightness = map.brightness(right, up);
            for k in 0..3 {
                all[k] += brightness[k];
                seen[k] += if up > from { brightness[k] } else { 0.0 };
            }
        }
    }
    std::array::from_fn(|k| if all[k] > 0.0 { seen[k] / all[k] } else { 0.0 })
}
