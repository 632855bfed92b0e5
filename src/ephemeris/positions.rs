//! Where one body stands at many times: paths over a day, analemmas over a year.
//!
//! Each time of the precise models costs what an [`Observer`] does, some 0.2 ms on one core; the thesis's Sun some 0.3 microseconds.

use super::horizon::horizontal_from_direction;
use super::observer::Observer;
use super::place::Place;
use super::refraction::Refraction;
use super::sun::{self, SunModel};
use super::target::Target;
use crate::time::Time;
use rayon::prelude::*;

/// Where a body stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Position {
    /// Airless altitude of the centre [degrees].
    pub altitude_deg: f64,
    /// Azimuth from north through east [degrees].
    pub azimuth_deg: f64,
    /// Altitude of the centre as refraction shows it [degrees].
    pub apparent_altitude_deg: f64,
}

/// Where `target` stands at each of `times`, seen from `place`. `sun_model` is that of the Sun; other bodies follow the precise models.
pub fn positions(target: Target, place: &Place, times: &[Time], sun_model: SunModel, refraction: &Refraction) -> Vec<Position> {
    let direction = |time: &Time| match target {
        Target::Sun => sun::direction_and_distance(place, time, sun_model).0,
        body => body.observe(&Observer::new(place, time)).direction,
    };
    times
        .par_iter()
        .with_min_len(8)
        .map(|time| {
            let (altitude_deg, azimuth_deg) = horizontal_from_direction(direction(time));
            Position { altitude_deg, azimuth_deg, apparent_altitude_deg: refraction.apparent_altitude_deg(altitude_deg) }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::{MoonModel, bodies};
    use crate::time::ZoneChoice;

    fn times() -> Vec<Time> {
        let start = Time::parse("2025-01-01T00:30:00Z", ZoneChoice::InText).unwrap();
        (0..40).map(|step| start.plus_hours(219.0 * f64::from(step)).unwrap()).collect()
    }

    #[test]
    fn they_are_those_of_single_times() {
        let place = Place::new(55.7, 13.2, 40.0).unwrap();
        let air = Refraction::none();
        for (target, model) in [(Target::Sun, SunModel::Iau), (Target::Sun, SunModel::Thesis), (Target::Moon, SunModel::Iau)] {
            let all = positions(target, &place, &times(), model, &air);
            assert_eq!(all.len(), 40);
            for (time, position) in times().iter().zip(all) {
                let sky = bodies(&place, time, model, MoonModel::Elp, &air);
                let single = if target == Target::Sun { sky.sun } else { sky.moon.body };
                assert!((single.altitude_deg - position.altitude_deg).abs() < 1e-9, "{target:?} {time}");
                assert!((single.azimuth_deg - position.azimuth_deg).abs() < 1e-9, "{target:?} {time}");
                assert_eq!(position.apparent_altitude_deg, position.altitude_deg);
            }
        }
    }

    #[test]
    fn at_greenwich_mean_noon_the_analemma_is_the_equation_of_time() {
        // checked against: Meeus 1998, example 28.b: 1992-10-13 0 h TD, equation of time 13 min 42.7 s (sundial ahead), so at that instant the
        // Sun's hour angle is 180 degrees + 3.427 degrees at the meridian of Greenwich (delta T of 59 s turns the Earth by 0.247 degrees).
        let midnight = Time::parse("1992-10-12T23:59:01Z", ZoneChoice::InText).unwrap();
        let pole = Place::new(90.0, 0.0, 0.0).unwrap();
        let sun = positions(Target::Sun, &pole, std::slice::from_ref(&midnight), SunModel::Iau, &Refraction::none())[0];
        // At the pole of longitude 0 "south" is the meridian of Greenwich, so the azimuth is the hour angle + 180 degrees.
        let ahead_deg = (sun.azimuth_deg + 180.0).rem_euclid(360.0) - 180.0 + 59.0 * 360.985_647 / 86_400.0;
        assert!((ahead_deg * 240.0 - 822.7).abs() < 1.5, "{} s", ahead_deg * 240.0);
    }
}
