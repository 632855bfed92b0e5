//! The lights of the night: the Moon and its light in the air, stars, planets, zodiacal light, Milky Way, airglow and the light of towns.
//!
//! All of them go through the same air, into a [`Sensor`](crate::spectrum::Sensor): X, Y and Z for pictures, bands for spectra (`by_wavelength`). Points and the Moon's disc are dimmed by the transmittance along their rays. Moonlight is gathered from the solved field as sunlight is, with the
//! Moon's spectrum and place. Diffuse light is dimmed, and scattered in simple form (`diffuse`).

mod by_wavelength;
mod diffuse;
mod moon;
mod points;

pub(super) use by_wavelength::{diffuse_radiance, horizontal_without_moonlight, moon_by_wavelength};
pub(super) use moon::moon_disc;

use super::airless::moonlight;
use super::eclipse;
use super::layers::{Layers, Part};
use super::options::{Layer, LayerScales, When};
use super::place_and_time::Sky;
use super::scattered::{Wanted, dome_under};
use crate::celestial::{Airglow, MilkyWay, ZodiacalLight};
use crate::ephemeris::Bodies;
use crate::error::Result;
use crate::light::LightField;
use crate::progress::Progress;
use crate::spectrum::Sensor;
use diffuse::{DiffuseAir, DiffuseSky};
use points::{SeenStars, planet_points};

/// Altitude of the Moon below which its light in the air is left out [degrees].
const DARK_DEG: f64 = -18.0;

/// The bodies of a sky whose air moonlight lights now.
pub(super) fn moonlit(sky: &Sky) -> Option<&Bodies> {
    sky.bodies_of_place().filter(|bodies| sky.is_night() && bodies.moon.body.altitude_deg > DARK_DEG)
}

/// The lights of the night and moonlight in the air, in layers.
pub(super) fn night_light(
    sky: &Sky,
    field: &LightField,
    scales: &LayerScales,
    wanted: Wanted,
    progress: &Progress,
) -> Result<Layers> {
    let mut layers = Layers::new(sky.horizon());
    if sky.bodies_of_place().is_none() {
        return Ok(layers);
    }
    let xyz = sky.atmosphere().xyz()?;
    add_night(sky, field, scales, xyz, &mut layers, progress)?;
    if let Some(bodies) = moonlit(sky).filter(|_| scales.of(Layer::Sky) > 0.0) {
        let weights = xyz.of(moonlight(sky.moon(bodies)?));
        let dome = dome_under(sky, field, &bodies.moon.body, weights, wanted, Vec::new(), progress)?;
        layers.add(Layer::Sky, scales.of(Layer::Sky), Part::smooth(Box::new(dome)));
    }
    Ok(layers)
}

/// Adds the lights of the night to `layers`, as far as `options` ask for them and `scales` leave them.
fn add_night(
    sky: &Sky,
    field: &LightField,
    scales: &LayerScales,
    sensor: &Sensor,
    layers: &mut Layers,
    progress: &Progress,
) -> Result<()> {
    let options = sky.night();
    let Some(bodies) = sky.bodies_of_place() else { return Ok(()) };
    if options.when == When::Never {
        return Ok(());
    }
    let wanted = |layer: Layer| scales.of(layer) > 0.0;
    if wanted(Layer::Moon) {
        let discs = moon_disc(sky, field, bodies, sensor)?.into_iter().collect();
        layers.add(Layer::Moon, scales.of(Layer::Moon), Part::discs(discs));
    }
    if wanted(Layer::Planets) {
        let points = planet_points(sky, field, bodies, sensor)?;
        layers.add(Layer::Planets, scales.of(Layer::Planets), Part::points(points));
    }
    if !sky.is_night() {
        return Ok(());
    }
    if wanted(Layer::Stars) {
        let points = SeenStars::new(sky, field, bodies, options.star_limit).points(sensor);
        layers.add(Layer::Stars, scales.of(Layer::Stars), Part::points(points));
    }
    let air = diffuse_air(sky, field);
    add_diffuse(sky, bodies, scales, &air, sensor, layers)?;
    progress.report("gather", 1.0)
}

/// What the air does to diffuse light.
fn diffuse_air(sky: &Sky, field: &LightField) -> DiffuseAir {
    DiffuseAir::new(field, sky.atmosphere().profile(), sky.altitude_km(), sky.horizon())
}

fn add_diffuse(
    sky: &Sky,
    bodies: &Bodies,
    scales: &LayerScales,
    air: &DiffuseAir,
    sensor: &Sensor,
    layers: &mut Layers,
) -> Result<()> {
    let options = sky.night();
    let to_icrs = bodies.observer.to_horizon().transpose();
    let wanted = |layer: Layer| scales.of(layer) > 0.0;
    if wanted(Layer::MilkyWay) {
        let light = DiffuseSky::above(MilkyWay::new(options.star_limit)?, to_icrs, air, sensor);
        layers.add(Layer::MilkyWay, scales.of(Layer::MilkyWay), Part::smooth(Box::new(light)));
    }
    if wanted(Layer::Zodiacal) {
        let sun = (to_icrs * bodies.sun.direction()).normalize();
        // The corona has the light of the dust near the Sun.
        let inner = sky.eclipsed_sunlight().copied().and_then(eclipse::corona).map_or(0.0, |corona| corona.angular_radius());
        let light = DiffuseSky::above(ZodiacalLight::new(sun).beyond(inner), to_icrs, air, sensor);
        layers.add(Layer::Zodiacal, scales.of(Layer::Zodiacal), Part::smooth(Box::new(light)));
    }
    if wanted(Layer::Airglow) {
        let airglow = Airglow::new(options.solar_flux_sfu, 1.0, sky.elevation_m())?;
        let light = DiffuseSky::round_above(airglow, air, sensor);
        layers.add(Layer::Airglow, scales.of(Layer::Airglow), Part::smooth(Box::new(light)));
    }
    if let Some(towns) = options.light_pollution()?
        && wanted(Layer::LightPollution)
    {
        let light = DiffuseSky::round_within(towns, air, sensor);
        layers.add(Layer::LightPollution, scales.of(Layer::LightPollution), Part::smooth(Box::new(light)));
    }
    Ok(())
}
