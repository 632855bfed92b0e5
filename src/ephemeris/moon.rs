//! The Moon: where it stands, how it is turned, how it is lit.
//!
//! [`MoonModel::Elp`] follows the light from the Moon's centre to the observer: within 0.2 arcseconds of JPL's DE421 from 1900 to 2050.
//! [`MoonModel::Thesis`] is the thesis's own series without parallax: within 1.1 degrees.

use super::body::Body;
use super::illumination::Illumination;
use super::moon_elp;
use super::moon_magnitude::moon_magnitude;
use super::moon_orientation::{SurfacePoint, body_fixed_to_icrs};
use super::moon_thesis;
use super::observer::{Apparent, Observer};
use super::place::Place;
use super::position_angle::position_angle_deg;
use super::refraction::Refraction;
use crate::time::Time;
use crate::units::ASTRONOMICAL_UNIT_KM;
use crate::words::words;
use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

/// Mean radius of the Moon [km] (IAU WGCCRE: Archinal et al. 2011).
pub const MOON_RADIUS_KM: f64 = 1_737.4;

/// By which theory the Moon's position is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum MoonModel {
    /// ELP/MPP02, apparent and topocentric.
    #[default]
    Elp,
    /// Formulas of appendix B.2 of the thesis, geocentric.
    Thesis,
}

words!(MoonModel, "moon_model", { Elp => "elp", Thesis => "thesis" });

/// The Moon as it stands in the sky.
#[derive(Clone, Debug, PartialEq)]
pub struct MoonState {
    /// Position, size, phase, magnitude (outside the air and outside the Earth's shadow).
    pub body: Body,
    /// Phase, bright limb, direction of the light.
    pub illumination: Illumination,
    /// Matrix from the Moon's body-fixed axes (x to the middle of its near side, y to its east where Mare Crisium is, z north) to
    /// x = east, y = north, z = up of the observer: a surface point n is seen in the direction distance * direction + radius * matrix * n.
    pub orientation: DMat3,
    /// The place on the Moon above which the observer stands: its topocentric libration.
    pub sub_observer: SurfacePoint,
    /// The place on the Moon above which the Sun stands.
    pub sub_solar: SurfacePoint,
    /// Position angle of the Moon's north pole, from celestial north through east, 0 to below 360 [degrees].
    pub axis_position_angle_deg: f64,
    /// The same counted from the zenith, counterclockwise as seen [degrees].
    pub axis_from_zenith_deg: f64,
}

impl MoonState {
    /// Distance from the observer to the Moon's centre [km].
    pub fn distance_km(&self) -> f64 {
        self.body.distance_au * ASTRONOMICAL_UNIT_KM
    }

    /// Direction in which a point of the surface is seen, whether it is on the near side or not; `normal`: unit vector from the Moon's
    /// centre, body-fixed axes. Unit vector, x = east, y = north, z = up, airless.
    pub fn surface_direction(&self, normal: DVec3) -> DVec3 {
        (self.distance_km() * self.body.direction() + MOON_RADIUS_KM * (self.orientation * normal)).normalize()
    }
}

/// Where the Moon is seen by `observer`.
pub(super) fn observe(observer: &Observer) -> Apparent {
    let (earth, tt) = (*observer.earth(), observer.tt());
    observer.apparent(|days| earth.earth - days * earth.earth_velocity + moon_elp::geocentric(tt.plus_seconds(-86_400.0 * days)))
}

/// The Moon for `observer` at `place` and `time`, who sees the Sun at `sun`.
pub(super) fn moon_state(
    observer: &Observer,
    place: &Place,
    time: &Time,
    model: MoonModel,
    sun: &Apparent,
    refraction: &Refraction,
) -> MoonState {
    let seen = match model {
        MoonModel::Elp => observe(observer),
        MoonModel::Thesis => {
            let (direction, distance_au) = moon_thesis::direction_and_distance(place, time);
            let astrometric = observer.to_horizon().transpose() * direction * distance_au;
            Apparent { direction, distance_au, light_days: 0.0, astrometric }
        }
    };
    let north = observer.celestial_north();
    let moon = seen.direction * seen.distance_au;
    let illumination = Illumination::of(moon, sun.direction * sun.distance_au, north);
    let orientation = observer.to_horizon() * body_fixed_to_icrs(observer.tt().plus_seconds(-86_400.0 * seen.light_days));
    let from_horizon = orientation.transpose();
    let axis = orientation * DVec3::Z;
    let sub_observer = SurfacePoint::below(from_horizon * -seen.direction);
    let sub_solar = SurfacePoint::below(from_horizon * illumination.sun_direction);
    let distance_km = seen.distance_au * ASTRONOMICAL_UNIT_KM;
    let mut body = Body::seen("Moon", &seen, MOON_RADIUS_KM, refraction);
    body.magnitude =
        Some(moon_magnitude(illumination.phase_angle_deg, distance_km, illumination.sun_distance_au, sub_observer, sub_solar));
    body.phase_angle_deg = Some(illumination.phase_angle_deg);
    body.illuminated_fraction = Some(illumination.illuminated_fraction);
    MoonState {
        body,
        illumination,
        orientation,
        sub_observer,
        sub_solar,
        axis_position_angle_deg: position_angle_deg(seen.direction, axis, north),
        axis_from_zenith_deg: position_angle_deg(seen.direction, axis, DVec3::Z),
    }
}
