//! The Moon before the Sun, seen from one place.
//!
//! With the angular radii s of the Sun and m of the Moon and the separation d of their centres, all topocentric:
//!
//! magnitude = (s + m - d) / (2 s), the covered part of the Sun's diameter, and m / s where one disc lies within the other;
//! obscuration = the covered part of the Sun's area, by the two circular segments.
//!
//! The Moon's radius is its mean radius of 1737.4 km (0.27240 Earth radii; the IAU's eclipse value is 0.27228: valleys of the limb, 0.02 % of the disc).

use super::bodies::Bodies;
use super::position_angle::{position_angle_deg, separation};
use std::f64::consts::PI;

/// A solar eclipse as it stands at one place and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolarEclipse {
    /// Angle between the centres of Sun and Moon, airless [degrees].
    pub separation_deg: f64,
    /// Angular radius of the Sun [degrees].
    pub sun_radius_deg: f64,
    /// Angular radius of the Moon [degrees].
    pub moon_radius_deg: f64,
    /// Covered part of the Sun's diameter; over 1 total, the ratio of the radii if total or annular.
    pub magnitude: f64,
    /// Covered part of the Sun's area, 0 to 1.
    pub obscuration: f64,
    /// Position angle of the Moon's centre seen from the Sun's, from celestial north through east [degrees].
    pub moon_position_angle_deg: f64,
    /// The same counted from the zenith, counterclockwise as seen [degrees].
    pub moon_from_zenith_deg: f64,
}

impl SolarEclipse {
    /// Whether all of the Sun is covered.
    pub fn is_total(&self) -> bool {
        self.separation_deg <= self.moon_radius_deg - self.sun_radius_deg
    }

    /// What kind of eclipse it is here and now: "total", "annular" or "partial".
    pub fn kind(&self) -> &'static str {
        match self.separation_deg <= self.sun_radius_deg - self.moon_radius_deg {
            _ if self.is_total() => "total",
            true => "annular",
            false => "partial",
        }
    }
}

impl Bodies {
    /// The eclipse of the Sun, if the Moon's disc covers a part of it. Asks for the precise models: the thesis's Moon has no parallax.
    pub fn solar_eclipse(&self) -> Option<SolarEclipse> {
        let (sun, moon) = (self.sun.direction(), self.moon.body.direction());
        let apart = separation(sun, moon).to_degrees();
        let (s, m) = (0.5 * self.sun.angular_diameter_deg, 0.5 * self.moon.body.angular_diameter_deg);
        (apart < s + m).then(|| SolarEclipse {
            separation_deg: apart,
            sun_radius_deg: s,
            moon_radius_deg: m,
            magnitude: if apart <= (s - m).abs() { m / s } else { (s + m - apart) / (2.0 * s) },
            obscuration: covered_fraction(s, m, apart),
            moon_position_angle_deg: position_angle_deg(sun, moon, self.observer.celestial_north()),
            moon_from_zenith_deg: position_angle_deg(sun, moon, glam::DVec3::Z),
        })
    }
}

/// Part of the area of a disc of radius `disc` that another of radius `cover` hides, the centres `apart`; any common unit.
pub(super) fn covered_fraction(disc: f64, cover: f64, apart: f64) -> f64 {
    if apart >= disc + cover {
        return 0.0;
    }
    if apart <= (disc - cover).abs() {
        return (cover / disc).powi(2).min(1.0);
    }
    // Half angles of the segments at the two centres.
    let at_disc = ((apart * apart + disc * disc - cover * cover) / (2.0 * apart * disc)).clamp(-1.0, 1.0).acos();
    let at_cover = ((apart * apart + cover * cover - disc * disc) / (2.0 * apart * cover)).clamp(-1.0, 1.0).acos();
    let segment = |radius: f64, angle: f64| radius * radius * (angle - angle.sin() * angle.cos());
    (segment(disc, at_disc) + segment(cover, at_cover)) / (PI * disc * disc)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::{MoonModel, Place, Refraction, SunModel, bodies};
    use crate::time::{Time, ZoneChoice};

    fn eclipse(latitude: f64, longitude: f64, text: &str) -> Option<SolarEclipse> {
        let time = Time::parse(text, ZoneChoice::InText).unwrap();
        let place = Place::new(latitude, longitude, 0.0).unwrap();
        bodies(&place, &time, SunModel::Iau, MoonModel::Elp, &Refraction::none()).solar_eclipse()
    }

    #[test]
    fn two_circles() {
        assert_eq!(covered_fraction(1.0, 1.0, 2.0), 0.0);
        assert_eq!((covered_fraction(1.0, 0.5, 0.4), covered_fraction(1.0, 1.1, 0.05)), (0.25, 1.0));
        // checked against: equal circles whose rims pass through each other's centres cover 2/3 - sqrt(3) / (2 pi) of their area.
        let lens = 2.0 / 3.0 - 3.0_f64.sqrt() / (2.0 * PI);
        assert!((covered_fraction(1.0, 1.0, 1.0) - lens).abs() < 1e-14);
        // Continuous where the disc is just swallowed and just touched.
        assert!((covered_fraction(1.0, 0.6, 0.400_001) - 0.36).abs() < 1e-5 && covered_fraction(1.0, 0.6, 1.599_999) < 1e-6);
    }

    #[test]
    fn greatest_eclipse_of_1999() {
        // checked against: NASA (Espenak & Anderson 1997, RP 1398): greatest eclipse at 11:03:07 UT, 45 04.8 N, 24 17.5 E, magnitude 1.0286.
        let total = eclipse(45.08, 24.2917, "1999-08-11T11:03:07Z").unwrap();
        println!("{total:?}");
        assert!(total.separation_deg < 0.003 && total.obscuration == 1.0);
        assert_eq!(total.kind(), "total");
        assert!((total.magnitude - 1.0286).abs() < 0.001, "{}", total.magnitude);
    }

    #[test]
    fn the_crescent_over_lund() {
        // checked against: shared reference, case C05 (Skyfield 1.55, DE421): separation 0.113993 degrees, the Moon almost straight below the Sun.
        let time = "1999-08-11T12:45:00+02:00";
        let crescent = eclipse(55.7047, 13.191, time).unwrap();
        println!("{crescent:?}");
        assert!((crescent.separation_deg - 0.114_0).abs() < 2e-4);
        assert_eq!(crescent.kind(), "partial");
        assert!((crescent.magnitude - 0.797).abs() < 0.002 && (0.72..0.78).contains(&crescent.obscuration));
        assert!((crescent.moon_from_zenith_deg - 180.33).abs() < 0.2);
        assert!(eclipse(55.7047, 13.191, "1999-08-11T17:45:00+02:00").is_none());
    }
}
