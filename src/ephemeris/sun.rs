//! Where the Sun stands, how far and how large it is.
//!
//! [`SunModel::Iau`] follows the light from the Sun's centre to the observer (see [`Observer`]): within 0.01 arcseconds of JPL's DE421
//! from 1900 to 2050. [`SunModel::Thesis`] is the thesis's own short series: within 0.02 degrees.

use super::body::Body;
use super::horizon::horizontal_from_direction;
use super::observer::{Apparent, Observer};
use super::place::Place;
use super::refraction::Refraction;
use super::sun_thesis;
use crate::error::Result;
use crate::parameter::{Checked, Parameter, row};
use crate::time::Time;
use crate::units::{ASTRONOMICAL_UNIT_KM, SOLAR_RADIUS_KM};
use crate::words::words;
use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Visual magnitude of the Sun at 1 au (Willmer 2018, ApJS 236, 47: Johnson V in the Vega system).
const MAGNITUDE_AT_1_AU: f64 = -26.76;

/// By which theory the Sun's position is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum SunModel {
    /// IAU 2006/2000A, apparent and topocentric.
    #[default]
    Iau,
    /// Formulas of appendix A and B.1 of the thesis, as they were meant (misprints mended; `sun_thesis.rs` lists them).
    Thesis,
}

words!(SunModel, "sun_model", { Iau => "iau", Thesis => "thesis" });

/// The Sun seen from `place` at `time`, its apparent altitude by `refraction`.
pub fn sun(place: &Place, time: &Time, model: SunModel, refraction: &Refraction) -> Body {
    let (direction, distance_au) = direction_and_distance(place, time, model);
    let (altitude_deg, azimuth_deg) = horizontal_from_direction(direction);
    body(altitude_deg, azimuth_deg, distance_au, refraction)
}

/// The rows of the table of parameters for a Sun that is put in the sky, instead of place and time.
pub const PUT_SUN: &[Parameter] = &[
    row::number(-90.0, 90.0, "degrees")
        .named("sun", "altitude_deg", "Instead of place and time: altitude of the Sun, without refraction")
        .option("sun-altitude", "DEG"),
    row::number(-360.0, 360.0, "degrees")
        .named("sun", "azimuth_deg", "Instead of place and time: azimuth of the Sun, from north through east")
        .option("sun-azimuth", "DEG"),
];

/// A Sun that is put at an airless altitude and an azimuth [degrees], at 1 au: for skies without place and time.
///
/// # Errors
/// [`Error::Input`] for `altitude_deg` outside -90 to 90, `azimuth_deg` outside -360 to 360 degrees.
pub fn sun_at(altitude_deg: f64, azimuth_deg: f64, refraction: &Refraction) -> Result<Body> {
    for (row, value) in PUT_SUN.iter().zip([altitude_deg, azimuth_deg]) {
        value.check(row, row.name)?;
    }
    Ok(body(altitude_deg, azimuth_deg.rem_euclid(360.0), 1.0, refraction))
}

/// Airless direction (x = east, y = north, z = up) and distance [au].
pub(super) fn direction_and_distance(place: &Place, time: &Time, model: SunModel) -> (DVec3, f64) {
    match model {
        SunModel::Iau => {
            let seen = observe(&Observer::new(place, time));
            (seen.direction, seen.distance_au)
        }
        SunModel::Thesis => sun_thesis::direction_and_distance(place, time),
    }
}

/// Where the Sun is seen by `observer`.
pub(super) fn observe(observer: &Observer) -> Apparent {
    let earth = *observer.earth();
    // The Sun's own motion about the barycentre is 15 m/s: straight for the 8 minutes of the light's way.
    observer.apparent(|days| earth.sun - days * earth.sun_velocity)
}

/// Where the Sun is seen by `observer`, who stands at `place` and `time`, by either model.
pub(super) fn sun_seen(observer: &Observer, place: &Place, time: &Time, model: SunModel) -> Apparent {
    let seen = observe(observer);
    match model {
        SunModel::Iau => seen,
        SunModel::Thesis => {
            let (direction, distance_au) = sun_thesis::direction_and_distance(place, time);
            Apparent { direction, distance_au, ..seen }
        }
    }
}

/// The body of the Sun where it is `seen`.
pub(super) fn sun_body(seen: &Apparent, refraction: &Refraction) -> Body {
    let (altitude_deg, azimuth_deg) = horizontal_from_direction(seen.direction);
    body(altitude_deg, azimuth_deg, seen.distance_au, refraction)
}

fn body(altitude_deg: f64, azimuth_deg: f64, distance_au: f64, refraction: &Refraction) -> Body {
    Body {
        name: "Sun".to_owned(),
        altitude_deg,
        azimuth_deg,
        apparent_altitude_deg: refraction.apparent_altitude_deg(altitude_deg),
        distance_au,
        angular_diameter_deg: angular_diameter_deg(distance_au),
        magnitude: Some(MAGNITUDE_AT_1_AU + 5.0 * distance_au.log10()),
        phase_angle_deg: None,
        illuminated_fraction: None,
    }
}

fn angular_diameter_deg(distance_au: f64) -> f64 {
    2.0 * (SOLAR_RADIUS_KM / (distance_au * ASTRONOMICAL_UNIT_KM)).asin().to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::direction_from_horizontal;
    use crate::time::ZoneChoice;

    /// place, time, altitude, azimuth, distance of each row of `tests/reference/ephemeris_sun.csv`.
    fn reference() -> Vec<(Place, Time, f64, f64, f64)> {
        let rows = include_str!("../../tests/reference/ephemeris_sun.csv");
        rows.lines()
            .skip(1)
            .map(|row| {
                let fields: Vec<&str> = row.split(',').collect();
                let number = |i: usize| fields[i].parse::<f64>().unwrap();
                let time = Time::from_tt_ut1(number(4), number(5)).unwrap();
                (Place::new(number(0), number(1), number(2)).unwrap(), time, number(6), number(7), number(8))
            })
            .collect()
    }

    fn worst_separation_arcsec(model: SunModel) -> f64 {
        reference()
            .iter()
            .map(|(place, time, altitude, azimuth, _)| {
                let (direction, _) = direction_and_distance(place, time, model);
                direction.angle_between(direction_from_horizontal(*altitude, *azimuth)).to_degrees() * 3600.0
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn the_iau_chain_agrees_with_an_independent_ephemeris() {
        // checked against: Skyfield 1.55 with JPL DE421, 40 places and times 1900 to 2050.
        assert!(reference().len() >= 40);
        let worst = worst_separation_arcsec(SunModel::Iau);
        println!("Sun against DE421: {worst:.3} arcseconds at most");
        assert!(worst < 0.2, "{worst}");
        for (place, time, _, _, distance) in reference() {
            let (_, ours) = direction_and_distance(&place, &time, SunModel::Iau);
            assert!((ours - distance).abs() < 5e-7, "{ours} {distance}");
        }
    }

    #[test]
    fn the_gap_of_the_thesis_is_known() {
        // checked against: the same rows. Left out by the thesis: aberration (20.5 arcseconds), nutation (up to 17), parallax (8.8),
        // delta T, and terms of the series (up to some 30).
        let worst = worst_separation_arcsec(SunModel::Thesis);
        println!("Sun of the thesis against DE421: {worst:.1} arcseconds at most");
        assert!((20.0..75.0).contains(&worst), "{worst}");
    }

    #[test]
    fn times_as_text_give_the_same_sun() {
        for (row, (place, _, altitude, azimuth, _)) in
            include_str!("../../tests/reference/ephemeris_sun.csv").lines().skip(1).zip(reference())
        {
            let text = row.split(',').nth(3).unwrap();
            let time = Time::parse(text, ZoneChoice::InText).unwrap();
            // Beyond January 2027 UT1 - UTC is not known; 0 is within the second that it may differ by.
            let limit = if time.civil().year > 2026 { 60.0 } else { 0.5 };
            let (direction, _) = direction_and_distance(&place, &time, SunModel::Iau);
            let gap = direction.angle_between(direction_from_horizontal(altitude, azimuth)).to_degrees() * 3600.0;
            assert!(gap < limit, "{text}: {gap}");
        }
    }

    #[test]
    fn the_disc_is_as_large_as_the_distance_makes_it() {
        // checked against: Auwers' classical semidiameter of 959.63 arcseconds at 1 au, which is a radius of 695990 km.
        assert!((angular_diameter_deg(1.0) * 1800.0 - 959.63 * 695.70 / 695.99).abs() < 0.01);
        let placed = sun_at(30.0, -90.0, &Refraction::none()).unwrap();
        assert_eq!((placed.azimuth_deg, placed.apparent_altitude_deg), (270.0, 30.0));
        assert!((placed.direction() - direction_from_horizontal(30.0, 270.0)).length() < 1e-15);
        assert!(sun_at(90.1, 0.0, &Refraction::none()).is_err() && sun_at(0.0, f64::NAN, &Refraction::none()).is_err());
    }
}
