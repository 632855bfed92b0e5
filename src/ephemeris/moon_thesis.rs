//! The Moon by the thesis's own formulas (appendix B.2, eq. 37): short series for ecliptic longitude, latitude and parallax, geocentric,
//! then the two rotations of appendix A.
//!
//! Seen from the surface the Moon stands up to a degree lower than from the centre of the Earth: that parallax, which the thesis leaves out, is the
//! gap to [`super::MoonModel::Elp`]; the series itself is good to 0.1 degrees.
//!
//! What had to be read differently from how it is printed: the rates of m' and d have no misprint, but the text gives the distance as 1 / pi' in
//! "Earth radii", which means equatorial radii (6378.14 km), for pi' is the equatorial horizontal parallax.

use super::place::Place;
use super::sun_thesis::{days_since_2000, horizontal};
use crate::time::Time;
use crate::units::ASTRONOMICAL_UNIT_KM;
use glam::DVec3;

/// Geocentric direction (x = east, y = north, z = up) and distance [au].
pub(super) fn direction_and_distance(place: &Place, time: &Time) -> (DVec3, f64) {
    const EQUATORIAL_RADIUS_KM: f64 = 6_378.14;
    let days = days_since_2000(time);
    let (longitude, latitude, parallax) = ecliptic(days);
    (horizontal(place, days, longitude, latitude), EQUATORIAL_RADIUS_KM / parallax / ASTRONOMICAL_UNIT_KM)
}

/// Eq. 37: ecliptic longitude and latitude of date, equatorial horizontal parallax [radians].
fn ecliptic(days: f64) -> (f64, f64, f64) {
    let mean_longitude = 3.8104 + 0.229_971_501_7 * days;
    let sun = 6.2300 + 0.017_201_968_5 * days;
    let node = 1.6280 + 0.230_895_723_5 * days;
    let moon = 2.3554 + 0.228_027_134_8 * days;
    let d = 5.1985 + 0.212_768_711_8 * days;
    let longitude = mean_longitude
        + 0.1098 * moon.sin()
        + 0.0222 * (2.0 * d - moon).sin()
        + 0.0115 * (2.0 * d).sin()
        + 0.0037 * (2.0 * moon).sin()
        - 0.0032 * sun.sin()
        - 0.0020 * (2.0 * node).sin()
        + 0.0010 * (2.0 * d - 2.0 * moon).sin()
        + 0.0010 * (2.0 * d - sun - moon).sin()
        + 0.0009 * (2.0 * d + moon).sin()
        + 0.0008 * (2.0 * d - sun).sin()
        + 0.0007 * (moon - sun).sin()
        - 0.0006 * d.sin()
        - 0.0005 * (sun + moon).sin();
    let latitude = 0.0895 * node.sin()
        + 0.0049 * (moon + node).sin()
        + 0.0048 * (moon - node).sin()
        + 0.0030 * (2.0 * d - node).sin()
        + 0.0010 * (2.0 * d + node - moon).sin()
        + 0.0008 * (2.0 * d - node - moon).sin()
        + 0.0006 * (2.0 * d + node).sin();
    let parallax = 0.016_593
        + 0.000_904 * moon.cos()
        + 0.000_166 * (2.0 * d - moon).cos()
        + 0.000_137 * (2.0 * d).cos()
        + 0.000_049 * (2.0 * moon).cos()
        + 0.000_015 * (2.0 * d + moon).cos()
        + 0.000_009 * (2.0 * d - sun).cos();
    (longitude, latitude, parallax)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_textbook_example() {
        // checked against: Meeus 1998, example 47.a: 1992-04-12 0 h TD, longitude 133.162655, latitude -3.229126, parallax 0.991990 degrees.
        let (longitude, latitude, parallax) = ecliptic(2_448_724.5 - 2_451_545.0);
        let longitude = longitude.to_degrees().rem_euclid(360.0);
        println!("{longitude} {} {}", latitude.to_degrees(), parallax.to_degrees());
        assert!((longitude - 133.162_655).abs() < 0.1 && (latitude.to_degrees() + 3.229_126).abs() < 0.05);
        assert!((parallax.to_degrees() / 0.991_990 - 1.0).abs() < 0.003);
    }
}
