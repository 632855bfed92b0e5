//! One body as the events ask for it: where it is seen from a place at a time.

use super::moon::{self, MOON_RADIUS_KM};
use super::observer::{Apparent, Observer};
use super::place::Place;
use super::planet::Planet;
use super::planets;
use super::sun;
use crate::error::{Error, Result};
use crate::time::Time;
use crate::units::{ASTRONOMICAL_UNIT_KM, SOLAR_RADIUS_KM};
use std::str::FromStr;

/// A body of the solar system that rises and sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// The Sun.
    Sun,
    /// The Moon.
    Moon,
    /// A planet.
    Planet(Planet),
}

impl Target {
    /// English name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sun => "Sun",
            Self::Moon => "Moon",
            Self::Planet(planet) => planet.name(),
        }
    }

    /// Where it is seen by `observer`, by the precise models.
    pub(super) fn observe(self, observer: &Observer) -> Apparent {
        match self {
            Self::Sun => sun::observe(observer),
            Self::Moon => moon::observe(observer),
            Self::Planet(planet) => planets::observe(observer, planet),
        }
    }

    /// Airless altitude of the centre less that at which it rises and sets [degrees].
    ///
    /// 34 arcminutes of refraction for all; Sun and Moon appear and disappear with the upper limb, the Sun with the 16 arcminutes of the almanacs'
    /// convention, the Moon with its true semidiameter; planets are points.
    pub(super) fn height_above_rise_deg(self, place: &Place, time: &Time) -> f64 {
        const REFRACTION_DEG: f64 = 34.0 / 60.0;
        const SUN_DEG: f64 = 16.0 / 60.0;
        let seen = self.observe(&Observer::new(place, time));
        let semidiameter_deg = match self {
            Self::Sun => SUN_DEG,
            Self::Moon => (MOON_RADIUS_KM / (seen.distance_au * ASTRONOMICAL_UNIT_KM)).asin().to_degrees(),
            Self::Planet(_) => 0.0,
        };
        altitude_deg(&seen) + REFRACTION_DEG + semidiameter_deg
    }

    /// Local hour angle, -180 to 180, positive after the upper transit [degrees], and airless altitude [degrees].
    pub(super) fn hour_angle_and_altitude_deg(self, place: &Place, time: &Time) -> (f64, f64) {
        let seen = self.observe(&Observer::new(place, time));
        let (sin_latitude, cos_latitude) = place.latitude_deg.to_radians().sin_cos();
        let south = seen.direction.z * cos_latitude - seen.direction.y * sin_latitude;
        ((-seen.direction.x).atan2(south).to_degrees(), altitude_deg(&seen))
    }

    /// Mean radius that eclipses and discs are drawn with [km].
    pub const fn radius_km(self) -> f64 {
        match self {
            Self::Sun => SOLAR_RADIUS_KM,
            Self::Moon => MOON_RADIUS_KM,
            Self::Planet(planet) => planet.radius_km(),
        }
    }
}

impl FromStr for Target {
    type Err = Error;

    /// The body of an English name, in any case.
    fn from_str(text: &str) -> Result<Self> {
        let mut all = [Self::Sun, Self::Moon].into_iter().chain(Planet::ALL.map(Self::Planet));
        all.find(|target| target.name().eq_ignore_ascii_case(text)).ok_or_else(|| {
            let allowed = "Sun, Moon, Mercury, Venus, Mars, Jupiter, Saturn, Uranus or Neptune";
            Error::input("name", format!("{text:?}"), allowed)
        })
    }
}

fn altitude_deg(seen: &Apparent) -> f64 {
    seen.direction.z.atan2(seen.direction.x.hypot(seen.direction.y)).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for target in [Target::Sun, Target::Moon, Target::Planet(Planet::Neptune)] {
            assert_eq!(target.name().parse::<Target>().unwrap(), target);
        }
        assert_eq!("saturn".parse::<Target>().unwrap(), Target::Planet(Planet::Saturn));
        assert!("Pluto".parse::<Target>().unwrap_err().to_string().starts_with("name = \"Pluto\": must be Sun, Moon, Mercury"));
    }
}
