//! The frames in which maps of the sky are kept: galactic and ecliptic, from the ICRS.
//!
//! Every matrix here acts on vectors with ICRS components; an observer's x = east, y = north, z = up components come from there by
//! [`super::Observer::to_horizon`] and go back by its transpose. Aberration (20 arcseconds) is not in a matrix: nothing for a diffuse map, for stars
//! see [`super::StarFrame`].

use crate::time::JulianDate;
use glam::{DMat3, DVec3};

/// Matrix from the ICRS to galactic axes (x to the centre, z to the north galactic pole; l, b of the IAU 1958 system) (ESA 1997, The Hipparcos
/// and Tycho Catalogues, vol. 1, eq. 1.5.11).
pub fn icrs_to_galactic() -> DMat3 {
    DMat3::from_cols(
        DVec3::new(-0.054_875_560_416_215_4, 0.494_109_427_875_583_7, -0.867_666_149_019_004_7),
        DVec3::new(-0.873_437_090_234_885, -0.444_829_629_960_011_2, -0.198_076_373_431_201_5),
        DVec3::new(-0.483_835_015_548_713_2, 0.746_982_244_497_219, 0.455_983_776_175_066_9),
    )
}

/// Matrix from the ICRS to the mean ecliptic and equinox of J2000 (IAU 2006).
pub fn icrs_to_ecliptic_j2000() -> DMat3 {
    icrs_to_ecliptic_of_date(JulianDate::from_days(2_451_545.0))
}

/// Matrix from the ICRS to the mean ecliptic and equinox of the date `tt` (IAU 2006; SOFA `ecm06`).
pub fn icrs_to_ecliptic_of_date(tt: JulianDate) -> DMat3 {
    DMat3::from_cols_array_2d(&sofars::coords::ecm06(tt.day, tt.fraction)).transpose()
}

/// Longitude (0 to below 360) and latitude (-90 to 90) [degrees] of a vector of any length but zero about the z axis of its frame.
pub fn longitude_latitude_deg(vector: DVec3) -> (f64, f64) {
    let longitude = vector.y.atan2(vector.x).to_degrees().rem_euclid(360.0);
    let latitude = vector.z.atan2(vector.x.hypot(vector.y)).to_degrees();
    (if longitude < 360.0 { longitude } else { 0.0 }, latitude)
}

/// Unit vector at a longitude and a latitude [degrees] about the z axis of its frame: right ascension and declination give ICRS components.
pub fn direction_from_longitude_latitude(longitude_deg: f64, latitude_deg: f64) -> DVec3 {
    let (sin_longitude, cos_longitude) = longitude_deg.to_radians().sin_cos();
    let (sin_latitude, cos_latitude) = latitude_deg.to_radians().sin_cos();
    DVec3::new(cos_latitude * cos_longitude, cos_latitude * sin_longitude, sin_latitude)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn galactic_centre_and_pole() {
        // checked against: ESA 1997: pole at 192.85948, 27.12825 degrees, centre at 266.40499, -28.93617 degrees.
        let matrix = icrs_to_galactic();
        assert!((matrix * direction_from_longitude_latitude(192.859_48, 27.128_25) - DVec3::Z).length() < 1e-9);
        assert!((matrix * direction_from_longitude_latitude(266.404_99, -28.936_17) - DVec3::X).length() < 2e-7);
        assert!((matrix * matrix.transpose() - DMat3::IDENTITY).to_cols_array().iter().all(|v| v.abs() < 1e-13));
    }

    #[test]
    fn the_ecliptic_of_2000() {
        // checked against: IAU 2006 obliquity at J2000, 84381.406 arcseconds; the frame bias is 0.02 arcseconds.
        let pole = icrs_to_ecliptic_j2000().transpose() * DVec3::Z;
        let obliquity = pole.z.acos().to_degrees() * 3600.0;
        assert!((obliquity - 84_381.406).abs() < 0.03, "{obliquity}");
        let (longitude, _) = longitude_latitude_deg(icrs_to_ecliptic_j2000() * DVec3::X);
        assert!(!(1e-4..359.9999).contains(&longitude));
    }

    #[test]
    fn the_equinox_moves() {
        // checked against: general precession in longitude, 5028.796 arcseconds a century (IAU 2006).
        let later = icrs_to_ecliptic_of_date(JulianDate::from_days(2_451_545.0 + 36_525.0));
        let star = direction_from_longitude_latitude(100.0, 20.0);
        let (before, _) = longitude_latitude_deg(icrs_to_ecliptic_j2000() * star);
        let (after, _) = longitude_latitude_deg(later * star);
        assert!(((after - before) * 3600.0 - 5_029.9).abs() < 15.0, "{}", (after - before) * 3600.0);
    }

    #[test]
    fn there_and_back() {
        for (longitude, latitude) in [(0.0, -90.0), (10.0, 45.0), (359.999, -1e-5)] {
            let (l, b) = longitude_latitude_deg(direction_from_longitude_latitude(longitude, latitude));
            assert!((b - latitude).abs() < 1e-12 && (latitude == -90.0 || (l - longitude).abs() < 1e-9));
        }
    }
}
