//! A body as it stands in the sky.

use super::horizon::{direction_from_horizontal, horizontal_from_direction};
use super::observer::Apparent;
use super::refraction::Refraction;
use crate::units::ASTRONOMICAL_UNIT_KM;
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
    /// A body of `radius_km` seen at `place`, its apparent altitude by `refraction`; without magnitude and phase.
    pub(super) fn seen(name: &str, place: &Apparent, radius_km: f64, refraction: &Refraction) -> Self {
        let (altitude_deg, azimuth_deg) = horizontal_from_direction(place.direction);
        Self {
            name: name.to_owned(),
            altitude_deg,
            azimuth_deg,
            apparent_altitude_deg: refraction.apparent_altitude_deg(altitude_deg),
            distance_au: place.distance_au,
            angular_diameter_deg: 2.0 * (radius_km / (place.distance_au * ASTRONOMICAL_UNIT_KM)).asin().to_degrees(),
            magnitude: None,
            phase_angle_deg: None,
            illuminated_fraction: None,
        }
    }

    /// Unit vector to the airless position, x = east, y = north, z = up.
    pub fn direction(&self) -> DVec3 {
        direction_from_horizontal(self.altitude_deg, self.azimuth_deg)
    }

    /// Unit vector to the refracted position, x = east, y = north, z = up.
    pub fn apparent_direction(&self) -> DVec3 {
        direction_from_horizontal(self.apparent_altitude_deg, self.azimuth_deg)
    }
}
