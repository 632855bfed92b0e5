//! The light around the observer of a sky, gathered and put into layers, ready to be made into a picture.

use super::super::SkyLight;
use super::super::disc::{Disc, SOLAR_LIMB_DARKENING, Surface};
use super::super::dome::{Gathering, SkyDome};
use super::super::eclipse::{self, EclipsedDome, Gain};
use super::super::filter::PolarisingFilter;
use super::super::irradiance::{Nodes, diffuse_horizontal};
use super::super::layers::{Layer, LayerScales, Layers, Part};
use super::super::model::{LightOptions, check_tolerance};
use super::super::night::moonlight_weights;
use super::Sky;
use crate::ephemeris::Body;
use crate::error::{Error, Result};
use crate::light::LightField;
use crate::progress::Progress;

/// Altitude of the Moon below which its light in the air is left out [degrees].
const DARK_DEG: f64 = -18.0;

/// What of the light of a dome is wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub filter: Option<&'a PolarisingFilter>,
    pub tolerance: Option<f64>,
    /// Whether what is below the horizon is wanted, too.
    pub ground: bool,
}

impl Wanted<'_> {
    /// What shines on a plane from above.
    pub const FROM_ABOVE: Self = Self { filter: None, tolerance: None, ground: false };
}

impl Sky {
    /// All light around the observer, ready to be made into a probe.
    ///
    /// # Errors
    /// As [`Self::illuminance`].
    pub fn light(&self, progress: &Progress) -> Result<SkyDome> {
        self.filtered_light(None, None, progress)
    }

    /// The same, seen through a polarising filter, or with directions gathered until interpolation between them is within `tolerance` (relative, as
    /// [`LightOptions::tolerance`](super::LightOptions)) rather than at the directions of the quality.
    ///
    /// # Errors
    /// As [`Self::light`]; [`Error::Input`] for a filter or a tolerance out of range, and if there is a filter and the atmosphere was made without polarisation.
    pub fn filtered_light(
        &self,
        filter: Option<&PolarisingFilter>,
        tolerance: Option<f64>,
        progress: &Progress,
    ) -> Result<SkyDome> {
        if let Some(filter) = filter {
            filter.validate()?;
            if !self.atmosphere.is_polarised() {
                return Err(Error::input("polarisation", "false", "true, to see the sky through a polarising filter"));
            }
        }
        tolerance.map(check_tolerance).transpose()?;
        let field = self.field(progress)?;
        let discs = self.sun_discs(field, self.horizon())?;
        self.dome(field, &self.sun, self.sky_weights()?, Wanted { filter, tolerance, ground: true }, discs, progress)
    }

    /// The dome lit by `body` whose irradiance outside the air makes `weights`.
    pub(super) fn dome(
        &self,
        field: &LightField,
        body: &Body,
        weights: Vec<[f64; 3]>,
        wanted: Wanted,
        discs: Vec<Disc>,
        progress: &Progress,
    ) -> Result<SkyDome> {
        let what = Gathering {
            field,
            numbers: &self.atmosphere.quality().numbers(),
            filter: wanted.filter.copied(),
            tolerance: wanted.tolerance,
            ground: wanted.ground,
            weights,
            observer: self.observer_under(body),
            horizon: self.horizon(),
            sun: (body.altitude_deg.to_radians(), body.azimuth_deg.to_radians()),
        };
        SkyDome::gather(&what, discs, progress)
    }

    /// All light around the observer, in layers, by the solved light transport.
    pub(in crate::sky) fn scattered_light(&self, options: &LightOptions, progress: &Progress) -> Result<Layers> {
        let field = self.field(progress)?;
        let wanted = Wanted { filter: options.polarising_filter.as_ref(), tolerance: options.tolerance, ground: true };
        let mut layers = self.night_light(field, &options.layers, wanted, progress)?;
        let scale = |layer: Layer| options.layers.of(layer);
        let dome = self.filtered_light(options.polarising_filter.as_ref(), options.tolerance, progress)?;
        layers.add(Layer::Sun, scale(Layer::Sun), Part { discs: dome.discs(), ..Default::default() });
        let smooth: Box<dyn SkyLight + Send> = match self.eclipse_gain(field, progress)? {
            Some(gain) => Box::new(EclipsedDome { dome, gain }),
            None => Box::new(dome),
        };
        layers.add(Layer::Sky, scale(Layer::Sky), Part { smooth: vec![smooth], ..Default::default() });
        Ok(layers)
    }

    /// The lights of the night and moonlight in the air, in layers.
    pub(super) fn night_light(
        &self,
        field: &LightField,
        scales: &LayerScales,
        wanted: Wanted,
        progress: &Progress,
    ) -> Result<Layers> {
        let mut layers = Layers::new(self.horizon());
        self.add_night(field, &self.night, scales, &mut layers, progress)?;
        if let Some(bodies) = &self.bodies
            && self.is_night(&self.night)
            && bodies.moon.body.altitude_deg > DARK_DEG
            && scales.of(Layer::Sky) > 0.0
        {
            let weights = moonlight_weights(self.moon(bodies)?, self.atmosphere.weights());
            let dome = self.dome(field, &bodies.moon.body, weights, wanted, Vec::new(), progress)?;
            layers.add(Layer::Sky, scales.of(Layer::Sky), Part { smooth: vec![Box::new(dome)], ..Default::default() });
        }
        Ok(layers)
    }

    /// What an eclipse of the Sun, if there is one, does to sky and ground beside dimming them alike.
    pub(super) fn eclipse_gain(&self, field: &LightField, progress: &Progress) -> Result<Option<Gain>> {
        let Some(eclipse) = &self.eclipse else { return Ok(None) };
        let off_middle = |wavelength: f64| (wavelength - eclipse::MIDDLE_NM).abs();
        let nodes = self.atmosphere.profile().wavelengths_nm.iter().enumerate();
        let middle = nodes.min_by(|a, b| off_middle(*a.1).total_cmp(&off_middle(*b.1))).map_or(0, |(node, _)| node);
        let uncovered = eclipse.visible_fraction(eclipse::MIDDLE_NM);
        let sky = diffuse_horizontal(field, &self.observer(), Nodes::FEW, |_| 1.0, progress)?[middle];
        let sky_left = self.diffuse_horizontal(field, Nodes::FEW, progress)?[middle] * eclipse::sky_share(uncovered);
        let sun = self.transmittance_towards(field, self.sun.apparent_altitude_deg.to_radians())[middle] * self.disc_cosine();
        let sun_left = sun * (uncovered + self.corona_share());
        let to_ground = |altitude: f64| field.ray_transmittance(self.altitude_km(), altitude.sin())[middle];
        Ok(Some(Gain::new(eclipse, self.horizon(), [(sun, sun_left), (sky, sky_left)], to_ground)))
    }

    fn sun_discs(&self, field: &LightField, horizon: f64) -> Result<Vec<Disc>> {
        let horizontal_radius = (self.atmosphere.profile().sun_angular_radius_deg / self.sun.distance_au).to_radians();
        let flattening = self.refraction.flattening(self.sun.altitude_deg, 2.0 * horizontal_radius.to_degrees());
        let vertical_radius = horizontal_radius * flattening;
        let irradiance = self.sun_irradiance_xyz(field)?;
        let whole = self.whole_sun_irradiance_xyz(field)?;
        let hidden = self.sun.apparent_altitude_deg.to_radians() + vertical_radius <= horizon;
        if hidden || whole[1] <= 0.0 || horizontal_radius <= 0.0 {
            return Ok(Vec::new());
        }
        let direction = self.sun.apparent_direction();
        let surface = Surface::LimbDarkened(SOLAR_LIMB_DARKENING);
        let disc = Disc { is_sun: true, direction, horizontal_radius, vertical_radius, irradiance, surface };
        Ok(match self.eclipse {
            None => vec![disc],
            Some(eclipse) => eclipse::discs(eclipse, &Disc { irradiance: whole, ..disc }, irradiance),
        })
    }
}
