//! How a body that shines by sunlight is lit, seen from the observer.
//!
//! With d the vector from observer to body and s from observer to Sun: the light falls on the body along s - d.
//!
//! phase angle = angle at the body between Sun and observer; lit fraction of a sphere's disc = (1 + cos phase angle) / 2;
//! elongation = angle at the observer; the middle of the bright limb lies in the direction of the Sun.
//!
//! All vectors are as the observer sees them, after aberration: the observer's frame is also that of the Moon, which moves with the
//! Earth, and sunlight is aberrated there too. For the planets the difference is 20 arcseconds of the phase angle.

use super::position_angle::{position_angle_deg, separation};
use glam::DVec3;

/// How a body is lit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illumination {
    /// Angle at the body between Sun and observer, 0 (full) to 180 (new) [degrees].
    pub phase_angle_deg: f64,
    /// Fraction of the disc's area that is lit, 0 to 1.
    pub illuminated_fraction: f64,
    /// Angle at the observer between body and Sun, 0 to 180 [degrees].
    pub elongation_deg: f64,
    /// Position angle of the middle of the bright limb from celestial north through east, 0 to below 360 [degrees].
    pub bright_limb_position_angle_deg: f64,
    /// The same counted from the zenith, counterclockwise as seen: 0 lit from above, 90 from the left [degrees].
    pub bright_limb_from_zenith_deg: f64,
    /// Distance from the body to the Sun [au].
    pub sun_distance_au: f64,
    /// Unit vector from the body to the Sun, x = east, y = north, z = up of the observer.
    pub sun_direction: DVec3,
}

impl Illumination {
    /// Of a body at `body` and the Sun at `sun` [au, x = east, y = north, z = up], with the celestial pole at `north`.
    pub(super) fn of(body: DVec3, sun: DVec3, north: DVec3) -> Self {
        let to_sun = sun - body;
        let phase = separation(to_sun, -body);
        Self {
            phase_angle_deg: phase.to_degrees(),
            illuminated_fraction: 0.5 * (1.0 + phase.cos()),
            elongation_deg: separation(body, sun).to_degrees(),
            bright_limb_position_angle_deg: position_angle_deg(body, to_sun, north),
            bright_limb_from_zenith_deg: position_angle_deg(body, to_sun, DVec3::Z),
            sun_distance_au: to_sun.length(),
            sun_direction: to_sun.normalize(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::direction_from_horizontal;

    #[test]
    fn full_half_and_new() {
        let (moon, north) = (0.0026 * direction_from_horizontal(40.0, 120.0), DVec3::Y);
        let full = Illumination::of(moon, -moon / 0.0026, north);
        assert!(
            full.phase_angle_deg < 1e-5 && full.elongation_deg > 179.999_99 && (full.illuminated_fraction - 1.0).abs() < 1e-12
        );
        let new = Illumination::of(moon, moon / 0.0026, north);
        assert!(new.phase_angle_deg > 179.999 && new.illuminated_fraction < 1e-9 && new.elongation_deg < 1e-5);
        let across = moon.cross(DVec3::Z).normalize();
        let half = Illumination::of(moon, moon + 0.9 * across, north);
        assert!((half.phase_angle_deg - 90.0).abs() < 1e-9 && (half.illuminated_fraction - 0.5).abs() < 1e-12);
        assert!((half.sun_distance_au - 0.9).abs() < 1e-12 && (half.sun_direction - across).length() < 1e-12);
    }

    #[test]
    fn the_evening_crescent_is_lit_from_the_setting_sun() {
        // Sun below the western horizon, the Moon higher above the same point: lit from below.
        let (moon, sun) = (direction_from_horizontal(20.0, 260.0) * 0.0026, direction_from_horizontal(-8.0, 260.0));
        let lit = Illumination::of(moon, sun, direction_from_horizontal(50.0, 0.0));
        assert!((lit.bright_limb_from_zenith_deg - 180.0).abs() < 1e-9);
        // To the right of the Sun (farther north in the west): lit from the left, where the Sun is.
        let moon = direction_from_horizontal(-8.0, 285.0) * 0.0026;
        let lit = Illumination::of(moon, sun, direction_from_horizontal(50.0, 0.0));
        assert!((lit.bright_limb_from_zenith_deg - 90.0).abs() < 10.0, "{lit:?}");
    }
}
