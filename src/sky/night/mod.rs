//! The lights of the night: the Moon and its light in the air, stars, planets, zodiacal light, Milky Way, airglow and the light of towns.
//!
//! All of them go through the same air. Points and the Moon's disc are dimmed by the transmittance along their rays. Moonlight is gathered from the solved field as sunlight is, with the
//! Moon's spectrum and place. Diffuse light is dimmed, and scattered in simple form (`diffuse`).

mod diffuse;
mod moon;
mod options;
mod points;

pub(super) use moon::{moon, moonlight_weights};
pub use options::{NightOptions, When};

use super::Sky;
use super::layers::{Layer, LayerScales, Layers, Part};
use crate::celestial::{Airglow, MilkyWay, ZodiacalLight};
use crate::ephemeris::Bodies;
use crate::error::Result;
use crate::light::LightField;
use crate::progress::Progress;
use diffuse::{DiffuseAir, DiffuseSky};

/// Altitude of the Sun below which `When::Auto` shows the night [degrees].
const SUNSET_DEG: f64 = 0.0;

impl Sky {
    /// Whether `options` ask for moonlight, stars and diffuse light in this sky.
    pub(super) fn is_night(&self, options: &NightOptions) -> bool {
        match options.when {
            When::Auto => self.sun().altitude_deg < SUNSET_DEG,
            When::Always => true,
            When::Never => false,
        }
    }

    /// Adds the lights of the night to `layers`, as far as `options` ask for them and `scales` leave them.
    pub(super) fn add_night(
        &self,
        field: &LightField,
        options: &NightOptions,
        scales: &LayerScales,
        layers: &mut Layers,
        progress: &Progress,
    ) -> Result<()> {
        let Some(bodies) = self.bodies_of_place() else { return Ok(()) };
        if options.when == When::Never {
            return Ok(());
        }
        let wanted = |layer: Layer| scales.of(layer) > 0.0;
        if wanted(Layer::Moon) {
            let discs = self.moon_disc(field, bodies)?.into_iter().collect();
            layers.add(Layer::Moon, scales.of(Layer::Moon), Part { discs, ..Default::default() });
        }
        if wanted(Layer::Planets) {
            let points = self.planet_points(field, bodies)?;
            layers.add(Layer::Planets, scales.of(Layer::Planets), Part { points, ..Default::default() });
        }
        if !self.is_night(options) {
            return Ok(());
        }
        if wanted(Layer::Stars) {
            let points = self.star_points(field, bodies, options.star_limit)?;
            layers.add(Layer::Stars, scales.of(Layer::Stars), Part { points, ..Default::default() });
        }
        self.add_diffuse(field, bodies, options, scales, layers)?;
        progress.report("gather", 1.0)
    }

    fn add_diffuse(
        &self,
        field: &LightField,
        bodies: &Bodies,
        options: &NightOptions,
        scales: &LayerScales,
        layers: &mut Layers,
    ) -> Result<()> {
        let air = {
            let air = self.atmosphere();
            DiffuseAir::new((field, air.profile(), air.weights()), self.altitude_km(), self.horizon())?
        };
        let to_icrs = bodies.observer.to_horizon().transpose();
        let smooth = |light| Part { smooth: vec![light], ..Default::default() };
        let wanted = |layer: Layer| scales.of(layer) > 0.0;
        if wanted(Layer::MilkyWay) {
            let light = DiffuseSky::above(MilkyWay::new(options.star_limit)?, to_icrs, &air);
            layers.add(Layer::MilkyWay, scales.of(Layer::MilkyWay), smooth(Box::new(light)));
        }
        if wanted(Layer::Zodiacal) {
            let sun = (to_icrs * bodies.sun.direction()).normalize();
            let light = DiffuseSky::above(ZodiacalLight::new(sun), to_icrs, &air);
            layers.add(Layer::Zodiacal, scales.of(Layer::Zodiacal), smooth(Box::new(light)));
        }
        if wanted(Layer::Airglow) {
            let airglow = Airglow::new(options.solar_flux_sfu, 1.0, self.elevation_m())?;
            let light = DiffuseSky::round_above(airglow, &air);
            layers.add(Layer::Airglow, scales.of(Layer::Airglow), smooth(Box::new(light)));
        }
        if let Some(towns) = options.light_pollution()?
            && wanted(Layer::LightPollution)
        {
            let light = DiffuseSky::round_within(towns, &air);
            layers.add(Layer::LightPollution, scales.of(Layer::LightPollution), smooth(Box::new(light)));
        }
        Ok(())
    }
}
