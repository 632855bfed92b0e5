//! Sun, Moon and planets of one observer at one instant, in one call.

use super::body::Body;
use super::celestial_frames::{icrs_to_ecliptic_j2000, longitude_latitude_deg};
use super::moon::{MoonModel, MoonState, moon_state};
use super::observer::{Apparent, Observer};
use super::place::Place;
use super::planet::Planet;
use super::planets::{PlanetState, planet_state};
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::{StarFrame, StarPosition, direction_from_longitude_latitude};
    use crate::time::ZoneChoice;

    fn state(latitude: f64, longitude: f64, text: &str, moon: MoonModel) -> Bodies {
        let time = Time::parse(text, ZoneChoice::InText).unwrap();
        bodies(&Place::new(latitude, longitude, 0.0).unwrap(), &time, SunModel::Iau, moon, &Refraction::none())
    }

    #[test]
    fn every_place_and_time_has_its_bodies() {
        for text in ["1000-01-01T00:00:00Z", "1582-10-10T00:00:00Z", "2101-01-01T00:00:00Z", "3000-12-31T23:59:59Z"] {
            for latitude in [-90.0, 0.0, 90.0] {
                for model in [MoonModel::Elp, MoonModel::Thesis] {
                    let sky = state(latitude, 180.0, text, model);
                    assert_eq!(sky.all().count(), 9);
                    for body in sky.all() {
                        let numbers = [body.altitude_deg, body.azimuth_deg, body.distance_au, body.angular_diameter_deg];
                        assert!(numbers.iter().all(|number| number.is_finite()), "{text} {body:?}");
                        assert!((-27.0..12.0).contains(&body.magnitude.unwrap()), "{text} {body:?}");
                    }
                    assert!((0.0023..0.0028).contains(&sky.moon.body.distance_au));
                }
            }
        }
    }

    #[test]
    fn the_sun_along_the_ecliptic() {
        // checked against: equinox of 2005-03-20 at 12:33 UTC (US Naval Observatory), less 5.2 years of precession of 50.3 arcseconds.
        let longitude = state(10.0, 20.0, "2005-03-20T12:33:00Z", MoonModel::Elp).sun_ecliptic_longitude_deg;
        assert!((longitude - (360.0 - 5.214 * 50.29 / 3600.0)).abs() < 0.003, "{longitude}");
    }

    #[test]
    fn a_surface_point_is_within_the_disc() {
        let sky = state(55.7, 13.2, "2005-06-21T22:30:00+02:00", MoonModel::Elp);
        let centre = sky.moon.body.direction();
        let radius = (0.5 * sky.moon.body.angular_diameter_deg).to_radians();
        let below = direction_from_longitude_latitude(sky.moon.sub_observer.longitude_deg, sky.moon.sub_observer.latitude_deg);
        assert!(sky.moon.surface_direction(below).angle_between(centre) < 1e-7);
        // The north pole of the Moon leans as its position angle says.
        let pole = sky.moon.surface_direction(glam::DVec3::Z);
        let angle = crate::ephemeris::position_angle_deg(centre, pole, sky.observer.celestial_north());
        assert!((angle - sky.moon.axis_position_angle_deg).abs() < 1e-6, "{angle}");
        let apart = pole.angle_between(centre);
        assert!((0.98..1.0).contains(&(apart / radius)), "{apart} {radius}");
    }

    #[test]
    fn what_it_costs() {
        let begin = std::time::Instant::now();
        let sky = state(55.7, 13.2, "2026-11-24T22:30:00Z", MoonModel::Elp);
        let all = begin.elapsed();
        let frame = StarFrame::new(&sky.observer);
        let star = |i| StarPosition::moving(0.003 * f64::from(i), 20.0, [5.0, -3.0], 2.0, 1991.25);
        let stars: Vec<_> = (0..100_000).map(star).collect::<Result<_, _>>().unwrap();
        let begin = std::time::Instant::now();
        let sum: glam::DVec3 = stars.iter().map(|star| frame.direction(star)).sum();
        println!(
            "bodies: {:.2} ms; 1e5 stars: {:.2} ms ({:.3})",
            all.as_secs_f64() * 1e3,
            begin.elapsed().as_secs_f64() * 1e3,
            sum.x
        );
        // An idle core needs 1 ms, and some more once for unpacking the tables.
        assert!(all.as_secs_f64() < 0.2);
    }
}
