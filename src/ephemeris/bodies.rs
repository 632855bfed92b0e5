//! Sun, Moon and planets of one observer at one instant, in one call.

use super::body::Body;
use super::celestial_frames::{icrs_to_ecliptic_j2000, longitude_latitude_deg};
use super::moon::{MoonModel, MoonState, moon_state};
use super::observer::{Apparent, Observer};
use super::place::Place;
use super::planets::{Planet, PlanetState, planet_state};
use super::refraction::Refraction;
use super::sun::{SunModel, sun_body, sun_seen};
use crate::time::Time;

/// Everything of the solar system that is seen from a place at a time, above and below the horizon.
#[derive(Clone, Debug, PartialEq)]
pub struct Bodies {
    /// The observer: for stars and diffuse maps, see [`super::StarFrame`].
    pub observer: Observer,
    /// The Sun.
    pub sun: Body,
    /// The Moon.
    pub moon: MoonState,
    /// Apparent longitude of the Sun on the mean ecliptic of J2000, 0 to below 360: what the zodiacal light is counted from [degrees].
    pub sun_ecliptic_longitude_deg: f64,
    /// Mercury to Neptune, from the Sun outwards.
    pub planets: Vec<PlanetState>,
}

impl Bodies {
    /// Sun, Moon and planets in this order.
    pub fn all(&self) -> impl Iterator<Item = &Body> {
        [&self.sun, &self.moon.body].into_iter().chain(self.planets.iter().map(|planet| &planet.body))
    }

    /// One of the planets.
    pub fn planet(&self, planet: Planet) -> Option<&PlanetState> {
        self.planets.iter().find(|state| state.planet == planet)
    }
}

/// Sun, Moon and planets seen from `place` at `time`, their apparent altitudes by `refraction`. Costs about 1 ms.
pub fn bodies(place: &Place, time: &Time, sun_model: SunModel, moon_model: MoonModel, refraction: &Refraction) -> Bodies {
    let observer = Observer::new(place, time);
    let sun = sun_seen(&observer, place, time, sun_model);
    let moon = moon_state(&observer, place, time, moon_model, &sun, refraction);
    let planets = planets(&observer, &sun, refraction);
    let sun_icrs = observer.to_horizon().transpose() * sun.direction;
    let (sun_ecliptic_longitude_deg, _) = longitude_latitude_deg(icrs_to_ecliptic_j2000() * sun_icrs);
    Bodies { sun_ecliptic_longitude_deg, sun: sun_body(&sun, refraction), moon, planets, observer }
}

fn planets(observer: &Observer, sun: &Apparent, refraction: &Refraction) -> Vec<PlanetState> {
    Planet::ALL.into_iter().map(|planet| planet_state(observer, planet, sun, refraction)).collect()
}
