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
use super::eclipse;
use super::layers::{Layer, LayerScales, Layers, Part};
use super::model::Model;
use crate::celestial::{Airglow, MilkyWay, ZodiacalLight};
use crate::ephemeris::Bodies;
use crate::error::Result;
use crate::light::LightField;
use crate::progress::Progress;
use diffuse::{DiffuseAir, DiffuseSky};

/// Altitude of the Sun below which `When::Auto` shows the night, as it does while the Sun is totally eclipsed [degrees].
const SUNSET_DEG: f64 = 0.0;

/// Altitude of the Sun at the end of astronomical twilight [degrees].
const NIGHT_DEG: f64 = -18.0;

impl Sky {
    /// Whether `options` ask for moonlight, stars and diffuse light in this sky.
    pub(super) fn is_night(&self, options: &NightOptions) -> bool {
        match options.when {
            When::Auto => self.sun().altitude_deg < SUNSET_DEG || self.solar_eclipse().is_some_and(|eclipse| eclipse.is_total()),
            When::Always => true,
            When::Never => false,
        }
    }

    /// Whether there is light in this sky that its spectra ([`Self::spectral_radiance`], [`Self::stokes`], [`Self::irradiance`]) lack, because they are of sunlight alone: if moonlight, stars
    /// and diffuse light are in its pictures by [`Self::night`], and, in a sky without place and time, with the Sun so low that they would outshine it, below -18 degrees.
    pub fn has_more_than_sunlight(&self) -> bool {
        match self.bodies_of_place() {
            Some(_) => self.is_night(self.night()),
            None => self.night().when != When::Never && self.sun().altitude_deg < NIGHT_DEG,
        }
    }

    /// The layers that this sky has by `model`, in the order of [`Layer::ALL`]; also those that shine below the horizon now.
    pub fn layers_by(&self, model: Model) -> Vec<Layer> {
        let seen = model == Model::Scattering && self.bodies_of_place().is_some() && self.night().when != When::Never;
        let dark = seen && self.is_night(self.night());
        let has_towns = self.night().light_pollution().is_ok_and(|light| light.is_some());
        let has = |layer: &Layer| match layer {
            Layer::Sky | Layer::Sun => true,
            Layer::Moon | Layer::Planets => seen,
            Layer::Stars | Layer::MilkyWay | Layer::Zodiacal | Layer::Airglow => dark,
            Layer::LightPollution => dark && has_towns,
        };
        Layer::ALL.into_iter().filter(has).collect()
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
            // The corona has the light of the dust near the Sun.
            let inner = self.eclipsed_sunlight().copied().and_then(eclipse::corona).map_or(0.0, |corona| corona.angular_radius());
            let light = DiffuseSky::above(ZodiacalLight::new(sun).beyond(inner), to_icrs, &air);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::AirParameters;
    use crate::ephemeris::{Place, SunModel};
    use crate::quality::Quality;
    use crate::sky::Atmosphere;
    use crate::time::{Time, ZoneChoice};
    use std::sync::Arc;

    #[test]
    fn the_layers_that_are_named_are_those_that_are_made() {
        let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
        let place = Place::new(55.7, 13.2, 0.0).unwrap();
        let night = NightOptions { star_limit: 3.0, ..Default::default() };
        for (text, night, model, count) in [
            ("2005-06-21T13:00:00+02:00", night, Model::Scattering, 4),
            ("2005-01-10T23:00:00+01:00", night, Model::Scattering, 8),
            ("2005-01-10T23:00:00+01:00", NightOptions { bortle: Some(5), ..night }, Model::Scattering, 9),
            ("2005-01-10T23:00:00+01:00", NightOptions { when: When::Never, ..night }, Model::Scattering, 2),
            ("2005-06-21T13:00:00+02:00", NightOptions { when: When::Always, ..night }, Model::Scattering, 8),
            ("2005-06-21T13:00:00+02:00", NightOptions { when: When::Always, ..night }, Model::Preetham, 2),
        ] {
            let time = Time::parse(text, ZoneChoice::InText).unwrap();
            let sky = Sky::new(place, time, SunModel::Iau, air.clone()).unwrap().with_night(night).unwrap();
            let named = sky.layers_by(model);
            assert_eq!(named, sky.light_by(&model.into(), &Progress::silent()).unwrap().names(), "{text} {night:?}");
            assert_eq!(named.len(), count, "{text} {night:?}");
        }
        let put = Sky::with_sun(-20.0, 0.0, 0.0, air).unwrap();
        assert_eq!(put.layers_by(Model::Scattering), [Layer::Sky, Layer::Sun]);
    }

    #[test]
    fn a_sky_says_whether_its_spectra_lack_light_that_is_in_its_pictures() {
        let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
        let lund = Place::new(55.7, 13.2, 0.0).unwrap();
        let at = |text: &str, place: Place, when: When| {
            let time = Time::parse(text, ZoneChoice::InText).unwrap();
            let sky = Sky::new(place, time, SunModel::Iau, air.clone()).unwrap();
            sky.with_night(NightOptions { when, ..Default::default() }).unwrap().has_more_than_sunlight()
        };
        let (noon, midnight) = ("2005-06-21T13:00:00+02:00", "2005-01-10T00:30:00+01:00");
        assert!(!at(noon, lund, When::Auto) && at(noon, lund, When::Always));
        assert!(at(midnight, lund, When::Auto) && at(midnight, lund, When::Always) && !at(midnight, lund, When::Never));
        // The Sun totally eclipsed over Reims.
        assert!(at("1999-08-11T10:26:30Z", Place::new(49.254, 4.03, 100.0).unwrap(), When::Auto));
        let put = |altitude: f64| Sky::with_sun(altitude, 0.0, 0.0, air.clone()).unwrap().has_more_than_sunlight();
        assert!(!put(30.0) && !put(-6.0) && put(-20.0) && put(-90.0));
    }
}
