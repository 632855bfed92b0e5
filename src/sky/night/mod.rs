//! The lights of the night: the Moon and its light in the air, stars, planets, zodiacal light, Milky Way, airglow and the light of towns.
//!
//! All of them go through the same air. Points and the Moon's disc are dimmed by the transmittance along their rays. Moonlight is gathered from the solved field as sunlight is, with the
//! Moon's spectrum and place. Diffuse light is dimmed, and scattered in simple form (`diffuse`).

mod diffuse;
mod moon;
mod points;

pub(super) use moon::moon_disc;

use super::airless::moonlight_weights;
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
use diffuse::{DiffuseAir, DiffuseSky};
use points::{planet_points, star_points};

/// Altitude of the Moon below which its light in the air is left out [degrees].
const DARK_DEG: f64 = -18.0;

/// The lights of the night and moonlight in the air, in layers.
pub(super) fn night_light(
    sky: &Sky,
    field: &LightField,
    scales: &LayerScales,
    wanted: Wanted,
    progress: &Progress,
) -> Result<Layers> {
    let mut layers = Layers::new(sky.horizon());
    add_night(sky, field, scales, &mut layers, progress)?;
    if let Some(bodies) = sky.bodies_of_place()
        && sky.is_night()
        && bodies.moon.body.altitude_deg > DARK_DEG
        && scales.of(Layer::Sky) > 0.0
    {
        let weights = moonlight_weights(sky.moon(bodies)?, sky.atmosphere().weights());
        let dome = dome_under(sky, field, &bodies.moon.body, weights, wanted, Vec::new(), progress)?;
        layers.add(Layer::Sky, scales.of(Layer::Sky), Part::smooth(Box::new(dome)));
    }
    Ok(layers)
}

/// Adds the lights of the night to `layers`, as far as `options` ask for them and `scales` leave them.
fn add_night(sky: &Sky, field: &LightField, scales: &LayerScales, layers: &mut Layers, progress: &Progress) -> Result<()> {
    let options = sky.night();
    let Some(bodies) = sky.bodies_of_place() else { return Ok(()) };
    if options.when == When::Never {
        return Ok(());
    }
    let wanted = |layer: Layer| scales.of(layer) > 0.0;
    if wanted(Layer::Moon) {
        let discs = moon_disc(sky, field, bodies)?.into_iter().collect();
        layers.add(Layer::Moon, scales.of(Layer::Moon), Part::discs(discs));
    }
    if wanted(Layer::Planets) {
        let points = planet_points(sky, field, bodies)?;
        layers.add(Layer::Planets, scales.of(Layer::Planets), Part::points(points));
    }
    if !sky.is_night() {
        return Ok(());
    }
    if wanted(Layer::Stars) {
        let points = star_points(sky, field, bodies, options.star_limit)?;
        layers.add(Layer::Stars, scales.of(Layer::Stars), Part::points(points));
    }
    add_diffuse(sky, field, bodies, scales, layers)?;
    progress.report("gather", 1.0)
}

fn add_diffuse(sky: &Sky, field: &LightField, bodies: &Bodies, scales: &LayerScales, layers: &mut Layers) -> Result<()> {
    let options = sky.night();
    let air = {
        let air = sky.atmosphere();
        DiffuseAir::new((field, air.profile(), air.weights()), sky.altitude_km(), sky.horizon())?
    };
    let to_icrs = bodies.observer.to_horizon().transpose();
    let wanted = |layer: Layer| scales.of(layer) > 0.0;
    if wanted(Layer::MilkyWay) {
        let light = DiffuseSky::above(MilkyWay::new(options.star_limit)?, to_icrs, &air);
        layers.add(Layer::MilkyWay, scales.of(Layer::MilkyWay), Part::smooth(Box::new(light)));
    }
    if wanted(Layer::Zodiacal) {
        let sun = (to_icrs * bodies.sun.direction()).normalize();
        // The corona has the light of the dust near the Sun.
        let inner = sky.eclipsed_sunlight().copied().and_then(eclipse::corona).map_or(0.0, |corona| corona.angular_radius());
        let light = DiffuseSky::above(ZodiacalLight::new(sun).beyond(inner), to_icrs, &air);
        layers.add(Layer::Zodiacal, scales.of(Layer::Zodiacal), Part::smooth(Box::new(light)));
    }
    if wanted(Layer::Airglow) {
        let airglow = Airglow::new(options.solar_flux_sfu, 1.0, sky.elevation_m())?;
        let light = DiffuseSky::round_above(airglow, &air);
        layers.add(Layer::Airglow, scales.of(Layer::Airglow), Part::smooth(Box::new(light)));
    }
    if let Some(towns) = options.light_pollution()?
        && wanted(Layer::LightPollution)
    {
        let light = DiffuseSky::round_within(towns, &air);
        layers.add(Layer::LightPollution, scales.of(Layer::LightPollution), Part::smooth(Box::new(light)));
    }
    Ok(())
}
