//! Altitude and azimuth, and the unit vector that they stand for.

use glam::DVec3;

/// Unit vector (x = east, y = north, z = up) at an altitude above the horizon and an azimuth from north through east [degrees].
pub fn direction_from_horizontal(altitude_deg: f64, azimuth_deg: f64) -> DVec3 {
    let (sin_altitude, cos_altitude) = altitude_deg.to_radians().sin_cos();
    let (sin_azimuth, cos_azimuth) = azimuth_deg.to_radians().sin_cos();
    DVec3::new(cos_altitude * sin_azimuth, cos_altitude * cos_azimuth, sin_altitude)
}

/// Altitude (-90 to 90) and azimuth (0 to below 360) [degrees] of a vector of any length but zero (x = east, y = north, z = up).
/// The azimuth of the zenith is 0.
pub fn horizontal_from_direction(direction: DVec3) -> (f64, f64) {
    // atan2 keeps its precision near the zenith, where asin loses half of the digits.
    let altitude = direction.z.atan2(direction.x.hypot(direction.y));
    let azimuth = direction.x.atan2(direction.y).to_degrees().rem_euclid(360.0);
    // rem_euclid rounds the smallest negative angles up to 360 itself.
    (altitude.to_degrees(), if azimuth < 360.0 { azimuth } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_four_winds_and_the_zenith() {
        for (altitude, azimuth, expected) in
            [(0.0, 0.0, DVec3::Y), (0.0, 90.0, DVec3::X), (0.0, 180.0, -DVec3::Y), (0.0, 270.0, -DVec3::X), (90.0, 0.0, DVec3::Z)]
        {
            assert!((direction_from_horizontal(altitude, azimuth) - expected).length() < 1e-15);
        }
        assert_eq!(horizontal_from_direction(DVec3::new(-1e-30, 1.0, 0.0)), (0.0, 0.0));
    }

    #[test]
    fn there_and_back() {
        for altitude in [-89.999, -45.0, 0.0, 1e-6, 30.0, 89.999_999] {
            for azimuth in [0.0, 1.0, 89.0, 180.0, 359.999] {
                let (a, b) = horizontal_from_direction(2.5 * direction_from_horizontal(altitude, azimuth));
                assert!((a - altitude).abs() < 1e-12 && (b - azimuth).abs() < 1e-6, "{altitude} {azimuth}");
            }
        }
    }
}
