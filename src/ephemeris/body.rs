//! A body as it stands in the sky.

use super::horizon::direction_from_horizontal;
use glam::DVec3;

/// Where a body is seen, how large and how bright.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// English name, such as "Sun".
    pub name: String,
    /// Airless altitude of the centre, -90 to 90 [degrees].
    pub altitude_deg: f64,
    /// Azimuth from north through east, 0 to below 360 [degrees].
    pub azimuth_deg: f64,
    /// Altitude of the centre as refraction shows it [degrees].
    pub apparent_altitude_deg: f64,
    /// Distance from the observer [au].
    pub distance_au: f64,
    /// Angular diameter of the disc without refraction [degrees].
    pub angular_diameter_deg: f64,
    /// Visual magnitude V outside the air, where it is known.
    pub magnitude: Option<f64>,
    /// Angle at the body between Sun and observer, 0 (full) to 180 (new), of bodies that shine by sunlight [degrees].
    pub phase_angle_deg: Option<f64>,
    /// Fraction of the disc's area that is lit, 0 to 1, of bodies that shine by sunlight.
    pub illuminated_fraction: Option<f64>,
}

impl Body {
    /// Unit vector to the airless position, x = east, y = north, z = up.
    pub fn direction(&self) -> DVec3 {
        direction_from_horizontal(self.altitude_deg, self.azimuth_deg)
    }

    /// Unit vector to the refracted position, x = east, y = north, z = up.
    pub fn apparent_direction(&self) -> DVec3 {
        direction_from_horizontal(self.apparent_altitude_deg, self.azimuth_deg)
    }
}
