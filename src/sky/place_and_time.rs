//! The sky over a place at a time: what it is made from, what stands in it and what was asked for beside. What arrives of its light as spectra is in `spectra`, of what pictures are composed in
//! `composition`; both, and all that they use, ask this file and are not known to it.

use super::airless::{eclipsed_sunlight, moon};
use super::atmosphere::Atmosphere;
use super::kept_refraction::refraction;
use super::options::{NightOptions, When};
use crate::celestial::{EclipsedSunlight, MoonDisc};
use crate::ephemeris::{Bodies, Body, MoonModel, Place, Refraction, SolarEclipse, SunModel, bodies, sun_at};
use crate::error::{Result, check_range};
use crate::light::{LightField, Observer};
use crate::progress::Progress;
use crate::time::Time;
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, OnceLock};

/// Altitude of the Sun below which `When::Auto` shows the night, as it does while the Sun is totally eclipsed [degrees].
const SUNSET_DEG: f64 = 0.0;

/// Altitude of the Sun at the end of astronomical twilight [degrees].
const NIGHT_DEG: f64 = -18.0;

/// The sky over an observer with the Sun at one position. Cheap to make: the light is solved by its [`Atmosphere`], once.
///
/// Light travels straight in the air; refraction moves and flattens the disc of the Sun where it is drawn, and with it its air mass.
pub struct Sky {
    place: Option<Place>,
    time: Option<Time>,
    elevation_m: f64,
    sun: Body,
    /// Everything in the sky of a place and a time.
    bodies: Option<Bodies>,
    eclipse: Option<EclipsedSunlight>,
    /// Made when it is first needed.
    moon: OnceLock<MoonDisc>,
    night: NightOptions,
    refraction: Arc<Refraction>,
    atmosphere: Arc<Atmosphere>,
}

impl Sky {
    /// The sky over `place` at `time`, with Sun, Moon, planets and stars.
    ///
    /// # Errors
    /// [`Error::Data`] if the geometry of an eclipse is out of its range, which no place on the Earth can see.
    pub fn new(place: Place, time: Time, sun_model: SunModel, atmosphere: Arc<Atmosphere>) -> Result<Self> {
        let refraction = refraction(&atmosphere, place.elevation_m);
        // The thesis's Moon has no parallax: it goes with the thesis's Sun only.
        let moon_model = if sun_model == SunModel::Thesis { MoonModel::Thesis } else { MoonModel::Elp };
        let bodies = bodies(&place, &time, sun_model, moon_model, &refraction);
        let eclipse = eclipsed_sunlight(&bodies)?;
        Ok(Self {
            elevation_m: place.elevation_m,
            place: Some(place),
            time: Some(time),
            sun: bodies.sun.clone(),
            bodies: Some(bodies),
            eclipse,
            moon: OnceLock::new(),
            night: NightOptions::default(),
            refraction,
            atmosphere,
        })
    }

    /// A sky with the Sun put at an airless altitude and an azimuth [degrees], at 1 au, for an observer at `elevation_m` [m].
    ///
    /// # Errors
    /// [`Error::Input`] for an altitude outside -90 to 90, an azimuth outside -360 to 360, an elevation outside -500 to 60000 m.
    pub fn with_sun(altitude_deg: f64, azimuth_deg: f64, elevation_m: f64, atmosphere: Arc<Atmosphere>) -> Result<Self> {
        check_range("elevation_m", elevation_m, -500.0, 60_000.0, "m")?;
        let refraction = refraction(&atmosphere, elevation_m);
        let sun = sun_at(altitude_deg, azimuth_deg, &refraction)?;
        Ok(Self {
            place: None,
            time: None,
            elevation_m,
            sun,
            bodies: None,
            eclipse: None,
            moon: OnceLock::new(),
            night: NightOptions::default(),
            refraction,
            atmosphere,
        })
    }

    /// The same sky with another night.
    ///
    /// # Errors
    /// [`Error::Input`] as [`NightOptions::validate`].
    pub fn with_night(self, night: NightOptions) -> Result<Self> {
        night.validate()?;
        Ok(Self { night, ..self })
    }

    /// The same sky with the Sun at any distance, possible or not [au].
    #[cfg(test)]
    pub(super) fn with_sun_distance_au(mut self, distance_au: f64) -> Self {
        self.sun.distance_au = distance_au;
        self
    }

    /// What of the night is shown.
    pub fn night(&self) -> &NightOptions {
        &self.night
    }

    /// Whether moonlight, stars and diffuse light were asked for in this sky.
    pub(super) fn is_night(&self) -> bool {
        match self.night.when {
            When::Auto => self.sun().altitude_deg < SUNSET_DEG || self.solar_eclipse().is_some_and(|eclipse| eclipse.is_total()),
            When::Always => true,
            When::Never => false,
        }
    }

    /// Whether there is other light than the Sun's in this sky: in one of a place and a time if moonlight, stars and diffuse light are in it by [`Self::night`]; in one without, which has
    /// sunlight alone in pictures and spectra, if the Sun is so low that the light of a night would outshine it, below -18 degrees.
    pub fn has_more_than_sunlight(&self) -> bool {
        match self.bodies_of_place() {
            Some(_) => self.is_night(),
            None => self.night().when != When::Never && self.sun().altitude_deg < NIGHT_DEG,
        }
    }

    /// The place, if the sky has one.
    pub fn place(&self) -> Option<&Place> {
        self.place.as_ref()
    }

    /// The time, if the sky has one.
    pub fn time(&self) -> Option<&Time> {
        self.time.as_ref()
    }

    /// Height of the observer [m].
    pub fn elevation_m(&self) -> f64 {
        self.elevation_m
    }

    /// The Sun.
    pub fn sun(&self) -> &Body {
        &self.sun
    }

    /// Everything that is placed in the sky, the Sun first, then Moon and planets from the Sun outwards, above and below the horizon; of a Sun that was put, that Sun alone.
    pub fn bodies(&self) -> Vec<Body> {
        self.bodies.as_ref().map_or_else(|| vec![self.sun.clone()], |bodies| bodies.all().cloned().collect())
    }

    /// Moon, planets and the observer among them, if the sky has a place and a time.
    pub fn bodies_of_place(&self) -> Option<&Bodies> {
        self.bodies.as_ref()
    }

    /// How the Moon stands before the Sun, if it does.
    pub fn solar_eclipse(&self) -> Option<SolarEclipse> {
        self.bodies.as_ref().and_then(Bodies::solar_eclipse)
    }

    /// What the Moon leaves of the Sun's light, if it stands before the Sun.
    pub fn eclipsed_sunlight(&self) -> Option<&EclipsedSunlight> {
        self.eclipse.as_ref()
    }

    /// The air.
    pub fn atmosphere(&self) -> &Arc<Atmosphere> {
        &self.atmosphere
    }

    /// The Moon outside the air.
    pub(super) fn moon(&self, bodies: &Bodies) -> Result<&MoonDisc> {
        if let Some(moon) = self.moon.get() {
            return Ok(moon);
        }
        let moon = moon(bodies)?;
        Ok(self.moon.get_or_init(|| moon))
    }

    /// The solved light of the air.
    ///
    /// # Errors
    /// As [`Atmosphere::solve`].
    pub(super) fn field(&self, progress: &Progress) -> Result<&LightField> {
        self.atmosphere.field(progress)
    }

    /// Where the observer is and where the Sun stands.
    pub(super) fn observer(&self) -> Observer {
        self.observer_under(&self.sun)
    }

    /// The same with `body` in place of the Sun.
    pub(super) fn observer_under(&self, body: &Body) -> Observer {
        Observer { altitude_km: self.altitude_km(), sun_zenith: (90.0 - body.altitude_deg).to_radians() }
    }

    /// Height above sea level; depressions below it lie on the ground of the model [km].
    pub(super) fn altitude_km(&self) -> f64 {
        (self.elevation_m / 1000.0).max(0.0)
    }

    /// What refraction does.
    pub fn refraction(&self) -> &Refraction {
        &self.refraction
    }

    /// Transmittance of the air towards a body at an apparent altitude [radians], by wavelength, as a mean over a disc of the Sun's size.
    pub(super) fn transmittance_towards(&self, field: &LightField, altitude: f64) -> Vec<f64> {
        field.sun_transmittance(&Observer { altitude_km: self.altitude_km(), sun_zenith: FRAC_PI_2 - altitude })
    }

    /// Geometric altitude of the horizon [radians].
    pub(super) fn horizon(&self) -> f64 {
        let radius = self.atmosphere.profile().planet_radius_km;
        -(radius / (radius + self.altitude_km())).acos()
    }
}
