//! Where the observer stands and looks, and where the Sun is.

use super::disc::Disc;
use super::medium::Medium;
use super::shells::End;
use crate::error::{Error, Result, check_range};
use glam::DVec3;

/// The observer and the Sun, about the planet's centre: z through the observer, x towards the Sun's azimuth, lengths in km.
pub(super) struct Scene {
    pub start: DVec3,
    pub view: DVec3,
    pub sun: Disc,
    /// Length of the line of sight in whose air light is looked for [km], and not on the ground; `None` for all of it and the ground.
    pub length: Option<f64>,
}

/// What a tracer says of a scene.
#[derive(Clone, Copy)]
pub(super) struct Sight {
    pub sun_angular_radius_deg: f64,
    pub length_km: Option<f64>,
}

impl Scene {
    /// Checks the input and moves an observer above the air to where the view enters it; `None` if it never does.
    pub fn new(medium: &impl Medium, sight: Sight, altitude_km: f64, sun_zenith_deg: f64, view: DVec3) -> Result<Option<Self>> {
        check_range("observer_altitude_km", altitude_km, 0.0, 1e6, "km")?;
        check_range("sun_zenith_deg", sun_zenith_deg, 0.0, 180.0, "degrees")?;
        if !view.is_normalized() {
            return Err(Error::input("view", view, "a unit vector"));
        }
        let (sine, cosine) = sun_zenith_deg.to_radians().sin_cos();
        let mut start = DVec3::Z * (medium.planet_radius() + altitude_km);
        let mut length = sight.length_km;
        if altitude_km > medium.top() {
            match medium.ray(start, view).chord.crossings(medium.top()) {
                Some((way_in, _)) if way_in > 0.0 => {
                    start += view * way_in;
                    length = length.map(|length| (length - way_in).max(0.0));
                }
                _ => return Ok(None),
            }
        }
        let sun = Disc::new(DVec3::new(sine, 0.0, cosine), sight.sun_angular_radius_deg);
        Ok(Some(Self { start, view, sun, length }))
    }

    /// How the line of sight ends, and at which distance, where `end` is what air and ground say.
    pub fn end(&self, end: (End, f64)) -> (End, f64) {
        self.length.map_or(end, |length| (End::Space, length.min(end.1)))
    }
}
