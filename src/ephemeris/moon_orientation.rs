//! How the Moon is turned: from the axes of its map (mean Earth, polar axis: x towards the mean sub-Earth point, z north) to the sky.
//!
//! Pole alpha_0, delta_0 and prime meridian W by the series of the IAU Working Group on Cartographic Coordinates and Rotational Elements
//! (Archinal et al. 2011, Celest. Mech. Dyn. Astr. 109, 101, table 2), d = days and T = Julian centuries TDB from J2000:
//!
//! body-fixed = R_z(W) R_x(90 - delta_0) R_z(90 + alpha_0) ICRS (frame rotations)
//!
//! The series contains physical libration to about 0.003 degrees. The mean Earth frame that lunar maps and DE421 define differs from it by up to
//! 0.008 degrees (14 km at the sub-Earth point; test below), much less than a pixel of any map here.

use crate::time::JulianDate;
use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

/// A place on the Moon (or on another sphere).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfacePoint {
    /// Longitude, positive to the Moon's east (Mare Crisium), -180 to 180 [degrees].
    pub longitude_deg: f64,
    /// Latitude, positive north, -90 to 90 [degrees].
    pub latitude_deg: f64,
}

impl SurfacePoint {
    /// The place below a direction in the body-fixed frame (any length but zero).
    pub fn below(direction: DVec3) -> Self {
        Self {
            longitude_deg: direction.y.atan2(direction.x).to_degrees(),
            latitude_deg: direction.z.atan2(direction.x.hypot(direction.y)).to_degrees(),
        }
    }
}

/// Constant and daily change of E1 to E13 [degrees, degrees a day].
const ANGLES: [(f64, f64); 13] = [
    (125.045, -0.052_992_1),
    (250.089, -0.105_984_2),
    (260.008, 13.012_000_9),
    (176.625, 13.340_715_4),
    (357.529, 0.985_600_3),
    (311.589, 26.405_708_4),
    (134.963, 13.064_993_0),
    (276.617, 0.328_714_6),
    (34.226, 1.748_487_7),
    (15.134, -0.158_976_3),
    (119.743, 0.003_609_6),
    (239.961, 0.164_357_3),
    (25.053, 12.959_008_8),
];

/// Amplitudes of sin E in the right ascension of the pole, of cos E in its declination, of sin E in the prime meridian [degrees].
const AMPLITUDES: [[f64; 3]; 13] = [
    [-3.8787, 1.5419, 3.5610],
    [-0.1204, 0.0239, 0.1208],
    [0.0700, -0.0278, -0.0642],
    [-0.0172, 0.0068, 0.0158],
    [0.0, 0.0, 0.0252],
    [0.0072, -0.0029, -0.0066],
    [0.0, 0.0009, -0.0047],
    [0.0, 0.0, -0.0046],
    [0.0, 0.0, 0.0028],
    [-0.0052, 0.0008, 0.0052],
    [0.0, 0.0, 0.0040],
    [0.0, 0.0, 0.0019],
    [0.0043, -0.0009, -0.0044],
];

/// Matrix from the Moon's body-fixed frame to the ICRS at the date `tt` (which stands for TDB).
pub(super) fn body_fixed_to_icrs(tt: JulianDate) -> DMat3 {
    let days = tt - JulianDate::from_days(2_451_545.0);
    let centuries = days / 36_525.0;
    let mut right_ascension = 269.9949 + 0.0031 * centuries;
    let mut declination = 66.5392 + 0.0130 * centuries;
    let mut meridian = 38.3213 + 13.176_358_15 * days - 1.4e-12 * days * days;
    for ((constant, rate), [of_ascension, of_declination, of_meridian]) in ANGLES.iter().zip(AMPLITUDES) {
        let (sin, cos) = (constant + rate * days).to_radians().sin_cos();
        right_ascension += of_ascension * sin;
        declination += of_declination * cos;
        meridian += of_meridian * sin;
    }
    rotation(right_ascension, declination, meridian)
}

/// Matrix from the body-fixed frame to the ICRS for a pole and a prime meridian [degrees].
pub(super) fn rotation(right_ascension_deg: f64, declination_deg: f64, meridian_deg: f64) -> DMat3 {
    DMat3::from_rotation_z((90.0 + right_ascension_deg).to_radians())
        * DMat3::from_rotation_x((90.0 - declination_deg).to_radians())
        * DMat3::from_rotation_z(meridian_deg.rem_euclid(360.0).to_radians())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pole_and_the_node_of_the_equator() {
        let matrix = rotation(30.0, 60.0, 0.0);
        let pole = matrix * DVec3::Z;
        assert!((pole - DVec3::new(0.75_f64.sqrt() / 2.0, 0.25, 0.75_f64.sqrt())).length() < 1e-15);
        // The zero of W is the node at right ascension 90 + alpha_0.
        assert!((matrix * DVec3::X - DVec3::new(-0.5, 0.75_f64.sqrt(), 0.0)).length() < 1e-15);
        assert!((rotation(30.0, 60.0, 90.0) * DVec3::X - matrix * DVec3::Y).length() < 1e-15);
    }

    #[test]
    fn places_on_the_moon() {
        assert_eq!(SurfacePoint::below(DVec3::new(0.0, 2.0, 0.0)), SurfacePoint { longitude_deg: 90.0, latitude_deg: 0.0 });
        assert!((SurfacePoint::below(DVec3::new(-1.0, -1.0, 2.0_f64.sqrt())).latitude_deg - 45.0).abs() < 1e-12);
    }

    #[test]
    fn the_mean_earth_frame_of_an_independent_integration() {
        // checked against: JPL DE421's principal axes, turned to its mean Earth frame (67.92, 78.56, 0.30 arcseconds; Williams, Boggs & Folkner 2008),
        // through Skyfield 1.55: date, then longitude and latitude below which the centre of the Earth stands.
        let rows = include_str!("../../tests/reference/ephemeris_moon_geocentric.csv");
        let mut worst: f64 = 0.0;
        for row in rows.lines().skip(1) {
            let n: Vec<f64> = row.split(',').map(|field| field.parse().unwrap()).collect();
            let towards_earth = -DVec3::new(n[1], n[2], n[3]);
            let ours = SurfacePoint::below(body_fixed_to_icrs(JulianDate::from_days(n[0])).transpose() * towards_earth);
            worst = worst.max((ours.longitude_deg - n[4]).abs()).max((ours.latitude_deg - n[5]).abs());
        }
        println!("orientation against DE421: {worst:.4} degrees at most");
        assert!(worst < 0.012, "{worst}");
    }
}
