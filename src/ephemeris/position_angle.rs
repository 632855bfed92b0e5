//! Angles on the sky around a body: position angle = the angle from celestial north through east, that is counterclockwise as seen from inside the sphere.

use glam::DVec3;

/// Position angle at `centre` of the great circle towards `target`, counted from the great circle towards `reference`,
/// counterclockwise as seen by the observer, 0 to below 360 [degrees]. The vectors may have any length but zero; 0 where `centre`
/// is `reference` or `target`.
pub fn position_angle_deg(centre: DVec3, target: DVec3, reference: DVec3) -> f64 {
    let east = reference.cross(centre);
    let north = centre.cross(east);
    let centre_length = centre.length();
    let angle = (target.dot(east) * centre_length).atan2(target.dot(north)).to_degrees().rem_euclid(360.0);
    if angle < 360.0 { angle } else { 0.0 }
}

/// Angle between two vectors of any length but zero, precise for small angles too, where acos loses half of the digits [radians].
pub(super) fn separation(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::direction_from_horizontal;

    #[test]
    fn east_is_left_of_north_in_the_south() {
        // On the northern hemisphere, looking south: north is up, east is left.
        let pole = direction_from_horizontal(50.0, 0.0);
        let south = 3.0 * direction_from_horizontal(30.0, 180.0);
        let at = |altitude, azimuth| position_angle_deg(south, direction_from_horizontal(altitude, azimuth), pole);
        assert!((at(31.0, 180.0) - 0.0).abs() < 1e-9 && (at(29.0, 180.0) - 180.0).abs() < 1e-9);
        assert!((at(30.0, 179.0) - 90.0).abs() < 0.5 && (at(30.0, 181.0) - 270.0).abs() < 0.5);
    }

    #[test]
    fn it_depends_on_no_length_and_is_zero_where_it_means_nothing() {
        let (a, b, c) = (DVec3::new(0.3, 0.4, 0.5), DVec3::new(-0.2, 0.9, 0.1), DVec3::new(0.0, 0.6, 0.8));
        assert!((position_angle_deg(a, b, c) - position_angle_deg(7.0 * a, 0.1 * b, 3.0 * c)).abs() < 1e-12);
        assert_eq!(position_angle_deg(DVec3::Z, DVec3::X, DVec3::Z), 0.0);
    }
}
