//! The sky over a place at a time: what stands in it and what of sunlight reaches it. Its spectra and illuminance are asked for in `spectral`, its light is made ready for a picture in `pictured`.

use super::atmosphere::Atmosphere;
use super::eclipse::{self, eclipsed_sunlight};
use super::kept_refraction::refraction;
use super::night::{NightOptions, When, moon};
use crate::celestial::{EclipsedSunlight, MoonDisc};
use crate::ephemeris::{Bodies, Body, MoonModel, Place, Refraction, SolarEclipse, SunModel, bodies, sun_at};
use crate::error::{Result, check_finite, check_range};
use crate::light::{LightField, Observer};
use crate::progress::Progress;
use crate::spectrum::{ColorSpace, Gamut};
use crate::time::Time;
use crate::units::Scale;
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, OnceLock};

mod pictured;
mod spectral;

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

    /// What of the night is shown.
    pub fn night(&self) -> &NightOptions {
        &self.night
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

    /// Irradiance by the Sun's disc (at a total eclipse by its corona) through the air on a surface that faces it, as RGB in `color_space`, in the units of a probe's pixels times
    /// steradians: a lamp of this strength lights a scene as the disc in the probe does. A low Sun is redder than Rec. 709 can show; `gamut` says what happens to such a colour, as it
    /// does in a probe. The lamp belongs where the disc is seen, at the apparent altitude.
    ///
    /// # Errors
    /// As [`Self::illuminance`].
    pub fn sun_irradiance_rgb(
        &self,
        scale: Scale,
        color_space: ColorSpace,
        gamut: Gamut,
        progress: &Progress,
    ) -> Result<[f64; 3]> {
        let xyz = sum_of_products(&self.direct_transmittance(self.field(progress)?), &self.xyz_weights()?);
        lamp(xyz, scale, color_space, gamut)
    }

    /// Irradiance by the Moon's disc through the air on a surface that faces it, as [`Self::sun_irradiance_rgb`]; nothing if the night is never shown, the Moon is below the horizon
    /// or the sky has no place and time.
    ///
    /// # Errors
    /// As [`Self::illuminance`].
    pub fn moon_irradiance_rgb(
        &self,
        scale: Scale,
        color_space: ColorSpace,
        gamut: Gamut,
        progress: &Progress,
    ) -> Result<[f64; 3]> {
        let field = self.field(progress)?;
        let seen = self.bodies.as_ref().filter(|_| self.night.when != When::Never);
        let disc = seen.map(|bodies| self.moon_disc(field, bodies)).transpose()?.flatten();
        disc.map_or(Ok([0.0; 3]), |disc| lamp(disc.irradiance, scale, color_space, gamut))
    }

    /// The Moon outside the air.
    pub(super) fn moon(&self, bodies: &Bodies) -> Result<&MoonDisc> {
        if let Some(moon) = self.moon.get() {
            return Ok(moon);
        }
        let moon = moon(bodies)?;
        Ok(self.moon.get_or_init(|| moon))
    }

    fn field(&self, progress: &Progress) -> Result<&LightField> {
        self.atmosphere.field(progress)
    }

    fn observer(&self) -> Observer {
        self.observer_under(&self.sun)
    }

    fn observer_under(&self, body: &Body) -> Observer {
        Observer { altitude_km: self.altitude_km(), sun_zenith: (90.0 - body.altitude_deg).to_radians() }
    }

    /// Depressions below sea level lie on the ground of the model.
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

    /// Square of 1 au over the Sun's distance.
    fn nearness(&self) -> f64 {
        self.sun.distance_au.powi(-2)
    }

    fn xyz_weights(&self) -> Result<Vec<[f64; 3]>> {
        let nearness = self.nearness();
        Ok(self.atmosphere.xyz_weights()?.into_iter().map(|xyz| xyz.map(|w| w * nearness)).collect())
    }

    /// The same for what lights the sky: less during an eclipse.
    fn sky_weights(&self) -> Result<Vec<[f64; 3]>> {
        let share = |(xyz, uncovered): ([f64; 3], f64)| xyz.map(|w| w * eclipse::sky_share(uncovered));
        Ok(self.xyz_weights()?.into_iter().zip(self.uncovered()).map(share).collect())
    }

    /// Part of the Sun's light that the Moon does not cover, at the solved wavelengths.
    fn uncovered(&self) -> Vec<f64> {
        self.uncovered_at(&self.atmosphere.profile().wavelengths_nm)
    }

    fn uncovered_at(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        self.eclipse.as_ref().map_or_else(|| vec![1.0; wavelengths_nm.len()], |eclipse| eclipse.visible_fractions(wavelengths_nm))
    }

    /// Solar irradiance outside the air that lights the sky: less during an eclipse [W m-2 nm-1].
    fn sunlight_in_the_air(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        let shares = self.uncovered_at(wavelengths_nm).into_iter().map(eclipse::sky_share);
        self.sunlight(wavelengths_nm).into_iter().zip(shares).map(|(sunlight, share)| sunlight * share).collect()
    }

    /// Solar irradiance outside the air [W m-2 nm-1].
    fn sunlight(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        self.atmosphere.solar_irradiance(wavelengths_nm).into_iter().map(|e| e * self.nearness()).collect()
    }

    /// Transmittance to the disc where it is seen, times the part that the Moon does not cover.
    fn disc_transmittance(&self, field: &LightField) -> Vec<f64> {
        let transmittance = self.transmittance_towards(field, self.sun.apparent_altitude_deg.to_radians());
        transmittance.iter().zip(self.uncovered()).map(|(transmittance, uncovered)| transmittance * uncovered).collect()
    }

    /// The same with the corona, where there is one to be seen.
    fn direct_transmittance(&self, field: &LightField) -> Vec<f64> {
        let transmittance = self.transmittance_towards(field, self.sun.apparent_altitude_deg.to_radians());
        let corona = self.corona_share();
        transmittance
            .iter()
            .zip(self.uncovered())
            .map(|(transmittance, uncovered)| transmittance * (uncovered + corona))
            .collect()
    }

    /// Light of the corona over that of the whole Sun; 0 where the Sun outshines it.
    fn corona_share(&self) -> f64 {
        self.eclipse.and_then(eclipse::corona).map_or(0.0, |corona| corona.irradiance_ratio())
    }

    /// Cosine of incidence of the disc on the horizontal plane.
    fn disc_cosine(&self) -> f64 {
        self.sun.apparent_altitude_deg.to_radians().sin().max(0.0)
    }

    fn sun_irradiance_xyz(&self, field: &LightField) -> Result<[f64; 3]> {
        Ok(sum_of_products(&self.disc_transmittance(field), &self.xyz_weights()?))
    }

    /// The same without an eclipse.
    fn whole_sun_irradiance_xyz(&self, field: &LightField) -> Result<[f64; 3]> {
        let transmittance = self.transmittance_towards(field, self.sun.apparent_altitude_deg.to_radians());
        Ok(sum_of_products(&transmittance, &self.xyz_weights()?))
    }
}

/// A lamp's light of the colour `xyz` as RGB: checked first, because what the gamut does to a colour may hide that it is none.
fn lamp(xyz: [f64; 3], scale: Scale, color_space: ColorSpace, gamut: Gamut) -> Result<[f64; 3]> {
    check_finite("the irradiance by the disc", &xyz)?;
    Ok(color_space.from_xyz_within(xyz.map(|v| v * scale.factor()), gamut))
}

fn sum_of_products(values: &[f64], weights: &[[f64; 3]]) -> [f64; 3] {
    let mut xyz = [0.0; 3];
    for (value, weight) in values.iter().zip(weights) {
        for k in 0..3 {
            xyz[k] += value * weight[k];
        }
    }
    xyz
}

#[cfg(test)]
mod tests;
