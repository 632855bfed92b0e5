//! The Moon in the shadow of the Earth.
//!
//! The shadow's axis runs from the Earth's centre away from the Sun. Seen from the Earth's centre at the distance of the Moon, with the horizontal parallaxes
//! p of Moon and q of the Sun and the Sun's angular radius s:
//!
//! umbra = 1.01 p + q - s, penumbra = 1.01 p + q + s
//!
//! 1.01 = 1 + 1/85 - 1/594: the air makes the Earth larger by 75 km, its flattening smaller at the mean latitude of the rim (Danjon 1951; Meeus & Mucke 1983, Canon of
//! Lunar Eclipses; Espenak & Meeus 2009, NASA/TP-2009-214172). Older almanacs enlarge the whole shadow by 2 %, which makes magnitudes larger by 0.005 to 0.026.

use super::bodies::Bodies;
use super::moon::MOON_RADIUS_KM;
use super::position_angle::{position_angle_deg, separation};
use crate::units::{ASTRONOMICAL_UNIT_KM, SOLAR_RADIUS_KM};
use glam::DVec3;

/// The Earth's shadow at the Moon. Angles are seen from the Earth's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarthShadow {
    /// Angle between the Moon's centre and the axis of the shadow [degrees].
    pub moon_axis_angle_deg: f64,
    /// Angular radius of the Moon [degrees].
    pub moon_radius_deg: f64,
    /// Angular radius of the umbra at the Moon's distance [degrees].
    pub umbra_radius_deg: f64,
    /// Angular radius of the penumbra at the Moon's distance [degrees].
    pub penumbra_radius_deg: f64,
    /// Immersed part of the Moon's diameter in the umbra; below 0 outside, 1 and more in totality.
    pub umbral_magnitude: f64,
    /// Immersed part of the Moon's diameter in the penumbra; below 0 outside.
    pub penumbral_magnitude: f64,
    /// Position angle of the shadow's axis seen from the Moon's centre, from the zenith counterclockwise as the observer sees it [degrees].
    pub axis_from_zenith_deg: f64,
}

impl EarthShadow {
    /// Whether any part of the Moon is in the penumbra.
    pub fn is_eclipse(&self) -> bool {
        self.penumbral_magnitude > 0.0
    }

    /// What kind of eclipse it is: "total", "partial" or "penumbral"; of the latter kind is also a Moon that is not eclipsed.
    pub fn kind(&self) -> &'static str {
        match self.umbral_magnitude {
            magnitude if magnitude >= 1.0 => "total",
            magnitude if magnitude > 0.0 => "partial",
            _ => "penumbral",
        }
    }
}

impl Bodies {
    /// The eclipse of the Moon, if any part of it is in the penumbra; see [`Self::earth_shadow`].
    pub fn lunar_eclipse(&self) -> Option<EarthShadow> {
        Some(self.earth_shadow()).filter(EarthShadow::is_eclipse)
    }

    /// The Earth's shadow at the distance of the Moon, whether the Moon is in it or not. Asks for the precise models: the thesis's Moon has no parallax,
    /// and with it the shadow is a degree off.
    pub fn earth_shadow(&self) -> EarthShadow {
        const EARTH_RADIUS_KM: f64 = 6_378.137;
        const ENLARGEMENT: f64 = 1.01;
        let from_earth = -self.observer.earth_centre();
        let moon_km = (self.moon.body.distance_au * self.moon.body.direction() + from_earth) * ASTRONOMICAL_UNIT_KM;
        let sun_km = (self.sun.distance_au * self.sun.direction() + from_earth) * ASTRONOMICAL_UNIT_KM;
        let axis = -sun_km.normalize();
        let radius_deg = |radius_km: f64, distance_km: f64| (radius_km / distance_km).asin().to_degrees();
        let moon_radius_deg = radius_deg(MOON_RADIUS_KM, moon_km.length());
        let sun_radius_deg = radius_deg(SOLAR_RADIUS_KM, sun_km.length());
        let parallaxes_deg =
            ENLARGEMENT * radius_deg(EARTH_RADIUS_KM, moon_km.length()) + radius_deg(EARTH_RADIUS_KM, sun_km.length());
        let apart = separation(moon_km, axis).to_degrees();
        let magnitude = |shadow_deg: f64| (shadow_deg + moon_radius_deg - apart) / (2.0 * moon_radius_deg);
        // The point of the axis next to the Moon, as the observer sees it.
        let axis_point = axis * moon_km.dot(axis) - from_earth * ASTRONOMICAL_UNIT_KM;
        EarthShadow {
            moon_axis_angle_deg: apart,
            moon_radius_deg,
            umbra_radius_deg: parallaxes_deg - sun_radius_deg,
            penumbra_radius_deg: parallaxes_deg + sun_radius_deg,
            umbral_magnitude: magnitude(parallaxes_deg - sun_radius_deg),
            penumbral_magnitude: magnitude(parallaxes_deg + sun_radius_deg),
            axis_from_zenith_deg: position_angle_deg(self.moon.body.direction(), axis_point, DVec3::Z),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::{MoonModel, Place, Refraction, SunModel, bodies};
    use crate::time::{Time, ZoneChoice};

    fn shadow(latitude: f64, longitude: f64, text: &str) -> EarthShadow {
        let time = Time::parse(text, ZoneChoice::InText).unwrap();
        let place = Place::new(latitude, longitude, 0.0).unwrap();
        bodies(&place, &time, SunModel::Iau, MoonModel::Elp, &Refraction::none()).earth_shadow()
    }

    #[test]
    fn greatest_eclipse_of_three() {
        // checked against: NASA's Five Millennium Catalog (Espenak & Meeus 2009): greatest eclipse, gamma, penumbral and umbral magnitude.
        for (text, gamma, penumbral, umbral) in [
            ("2000-07-16T13:55:35Z", 0.0302, 2.8375, 1.7684),
            ("2010-12-21T08:16:57Z", 0.3214, 2.2807, 1.2561),
            ("2018-01-31T13:29:50Z", 0.3014, 2.2941, 1.3155),
        ] {
            let shadow = shadow(19.8, -155.5, text);
            let parallax = (6_378.137 / MOON_RADIUS_KM * shadow.moon_radius_deg.to_radians().sin()).asin().to_degrees();
            let ours = (shadow.moon_axis_angle_deg / parallax, shadow.penumbral_magnitude, shadow.umbral_magnitude);
            println!("{text}: {ours:.4?}");
            assert!((ours.0 - gamma).abs() < 0.001, "{text}: {ours:?}");
            assert!((ours.1 - penumbral).abs() < 0.003 && (ours.2 - umbral).abs() < 0.003, "{text}: {ours:?}");
        }
    }

    #[test]
    fn it_is_the_same_for_all_observers() {
        let [hawaii, tokyo] = [(19.8, -155.5), (35.7, 139.7)].map(|(a, b)| shadow(a, b, "2018-01-31T12:30:00Z"));
        // The rotation of the Earth carries observers with up to 465 m/s, which is 0.3 arcseconds of aberration.
        assert!((hawaii.moon_axis_angle_deg - tokyo.moon_axis_angle_deg).abs() < 2e-4);
        assert!((hawaii.umbral_magnitude - tokyo.umbral_magnitude).abs() < 4e-4);
    }

    #[test]
    fn no_shadow_at_half_moon() {
        let shadow = shadow(0.0, 0.0, "2018-02-07T16:00:00Z");
        assert!(!shadow.is_eclipse() && shadow.moon_axis_angle_deg > 80.0);
    }

    #[test]
    fn the_kinds_follow_each_other() {
        // checked against: NASA eclipse page of 2018-01-31: penumbral from 10:51, partial from 11:48, total from 12:52 UT.
        for (text, kind) in [("11:30", "penumbral"), ("12:00", "partial"), ("12:55", "total"), ("15:00", "partial")] {
            assert_eq!(shadow(19.8, -155.5, &format!("2018-01-31T{text}:00Z")).kind(), kind, "{text}");
        }
    }
}
