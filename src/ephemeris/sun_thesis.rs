//! The Sun by the thesis's own formulas (appendix A.1 to A.4 and B.1): a short series for the ecliptic longitude, mean sidereal time
//! and two rotations. Geocentric and without aberration, nutation and delta T: some 40 arcseconds from [`super::SunModel::Iau`].
//!
//! j = days since 2000-01-01 12:00; M = 6.24 + 0.0172019713 j (mean anomaly, radians)
//!
//! lambda = 4.895048 + 0.0172027913 j + (0.033417 - 2.299794661e-9 j) sin M + 0.000351 sin 2M, beta = 0 (eq. 36)
//!
//! r = 149.6e6 km (1.000140 - (0.016708 - 1.149897331e-9 j) cos M - 0.000141 cos 2M) (eq. 36)
//!
//! What had to be read differently from how it is printed:
//! - eq. 18 counts days of a date whose time scale is not said: UT1 here, for the sidereal time needs it.
//! - eq. 22 adds "compensation for the time zone", the text before it the longitude: the longitude / 15 is right, zones are not meridians.
//! - eqs. 24-26 count the azimuth from south through west: 180 degrees less than ours.
//! - eq. 34 repeats cos delta: it is cos alpha cos delta = cos lambda cos beta, as eq. 31.
//! - the obliquity has no number: 0.409093 - 6.218e-9 j radians (IAU 1976, linear part: 23.4393 degrees - 0.0130 a century).

use super::place::Place;
use crate::time::{JulianDate, Time};
use crate::units::ASTRONOMICAL_UNIT_KM;
use glam::{DMat3, DVec3};

/// Geocentric direction (x = east, y = north, z = up) and distance [au].
pub(super) fn direction_and_distance(place: &Place, time: &Time) -> (DVec3, f64) {
    let days = days_since_2000(time);
    let (longitude, distance_km) = ecliptic(days);
    (horizontal(place, days, longitude, 0.0), distance_km / ASTRONOMICAL_UNIT_KM)
}

/// j: days since 2000-01-01 12:00 UT1.
pub(super) fn days_since_2000(time: &Time) -> f64 {
    time.ut1() - JulianDate::from_days(2_451_545.0)
}

/// Appendix A: direction (x = east, y = north, z = up) of an ecliptic longitude and latitude of date [radians].
pub(super) fn horizontal(place: &Place, days: f64, longitude: f64, latitude: f64) -> DVec3 {
    let obliquity = 0.409_093 - 6.218e-9 * days;
    // Eqs. 33-35; components are (cos alpha cos delta, sin alpha cos delta, sin delta).
    let ecliptic = DVec3::new(longitude.cos() * latitude.cos(), longitude.sin() * latitude.cos(), latitude.sin());
    let equatorial = DMat3::from_rotation_x(obliquity) * ecliptic;
    let sidereal_time = local_sidereal_time(days, place.longitude_deg);
    let right_ascension = equatorial.y.atan2(equatorial.x);
    let hour_angle = sidereal_time - right_ascension;
    let cos_declination = equatorial.x.hypot(equatorial.y);
    let (sin_latitude, cos_latitude) = place.latitude_deg.to_radians().sin_cos();
    // Eqs. 24-26: west, south, up.
    let west = hour_angle.sin() * cos_declination;
    let south = hour_angle.cos() * cos_declination * sin_latitude - equatorial.z * cos_latitude;
    let up = hour_angle.cos() * cos_declination * cos_latitude + equatorial.z * sin_latitude;
    DVec3::new(-west, -south, up).normalize()
}

/// Eq. 36: ecliptic longitude [radians] and distance [km].
fn ecliptic(days: f64) -> (f64, f64) {
    let anomaly = 6.24 + 0.017_201_971_3 * days;
    let longitude = 4.895_048
        + 0.017_202_791_3 * days
        + (0.033_417 - 2.299_794_661e-9 * days) * anomaly.sin()
        + 0.000_351 * (2.0 * anomaly).sin();
    let distance = 1.000_140 - (0.016_708 - 1.149_897_331e-9 * days) * anomaly.cos() - 0.000_141 * (2.0 * anomaly).cos();
    (longitude, 149_600_000.0 * distance)
}

/// Eqs. 21 and 22 [radians].
fn local_sidereal_time(days: f64, longitude_deg: f64) -> f64 {
    let hours = 18.697_373_75 + 24.065_709_82 * days + longitude_deg / 15.0;
    (hours * 15.0).rem_euclid(360.0).to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equinox_and_perihelion() {
        // checked against: Meeus 1998, example 25.a: 1992-10-13 0 h TD, true longitude 199.90988 degrees, 0.99766 au.
        let (longitude, distance) = ecliptic(2_448_908.5 - 2_451_545.0);
        assert!((longitude.to_degrees().rem_euclid(360.0) - 199.909_88).abs() < 0.003);
        assert!((distance / ASTRONOMICAL_UNIT_KM - 0.997_66).abs() < 2e-5);
    }

    #[test]
    fn sidereal_time() {
        // checked against: Meeus 1998, example 12.a: 1987-04-10 0 h UT1, mean sidereal time 197.693195 degrees.
        let angle = local_sidereal_time(2_446_895.5 - 2_451_545.0, 0.0).to_degrees();
        assert!((angle - 197.693_195).abs() < 4e-4, "{angle}");
        assert!((local_sidereal_time(0.0, 15.0) - local_sidereal_time(0.0, 0.0) - 15.0_f64.to_radians()).abs() < 1e-12);
    }
}
