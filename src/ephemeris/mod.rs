//! Directions, distances and sizes of the bodies: knows place and time, nothing of air or images.
//!
//! # Conventions
//! - Altitudes are airless unless a name says `apparent`; azimuth from north through east; local frame x = east, y = north, z = up,
//!   where up is the normal of the WGS84 ellipsoid.
//! - Positions are topocentric (seen from the place, not from the Earth's centre) and apparent (light time, aberration).
//! - Position angles count from celestial north (or from the zenith, if the name says so) counterclockwise as seen from the ground.
//! - Celestial vectors are in the BCRS/GCRS [au], terrestrial ones in the ITRS; polar motion is taken as 0 (below 0.6 arcseconds).
//!
//! From a place and a time, [`bodies()`] gives Sun, Moon and planets at once, with phases, magnitudes and the orientation of the Moon's disc; it
//! carries the [`Observer`], from which [`StarFrame`] turns star catalogues and [`Observer::to_horizon`] diffuse maps to the local frame. Eclipses are
//! asked of [`Bodies`]; events of [`sun_events()`], [`rise_and_set()`], [`next_moon_phases()`].
//!
//! ```
//! use skyprobe::ephemeris::{Place, Refraction, SunModel, sun};
//! use skyprobe::time::{Time, ZoneChoice};
//!
//! let lund = Place::new(55.7047, 13.191, 50.0)?;
//! let time = Time::parse("1999-08-11T12:45:00+02:00", ZoneChoice::InText)?;
//! let sun = sun(&lund, &time, SunModel::Iau, &Refraction::none());
//! assert!((sun.altitude_deg - 49.281).abs() < 0.001);
//!
//! use skyprobe::ephemeris::{MoonModel, bodies};
//! let sky = bodies(&lund, &time, SunModel::Iau, MoonModel::Elp, &Refraction::none());
//! let eclipse = sky.solar_eclipse().expect("the Moon stands before the Sun");
//! assert!((eclipse.obscuration - 0.75).abs() < 0.01);
//! assert!(sky.planets.iter().any(|venus| venus.body.name == "Venus" && venus.body.magnitude.is_some_and(|v| v < -4.0)));
//! # Ok::<(), skyprobe::Error>(())
//! ```

#[cfg(test)]
mod almanac;
mod bodies;
mod body;
mod celestial_frames;
mod earth;
mod horizon;
mod illumination;
mod lunar_eclipse;
mod moon;
mod moon_elp;
mod moon_magnitude;
mod moon_orientation;
mod moon_phases;
mod moon_thesis;
mod observer;
mod place;
mod planet;
mod planet_magnitude;
mod planet_vsop;
mod planets;
mod position_angle;
mod positions;
mod refraction;
mod refraction_path;
mod rise_and_set;
mod root;
mod solar_eclipse;
mod stars;
mod sun;
mod sun_events;
mod sun_thesis;
mod table_bytes;
mod target;

pub use bodies::{Bodies, bodies};
pub use body::Body;
pub use celestial_frames::{
    direction_from_longitude_latitude, icrs_to_ecliptic_j2000, icrs_to_ecliptic_of_date, icrs_to_galactic, longitude_latitude_deg,
};
pub use earth::EarthState;
pub use horizon::{direction_from_horizontal, horizontal_from_direction};
pub use illumination::Illumination;
pub use lunar_eclipse::EarthShadow;
pub use moon::{MOON_RADIUS_KM, MoonModel, MoonState};
pub use moon_orientation::SurfacePoint;
pub use moon_phases::{MoonPhase, next_moon_phase, next_moon_phases};
pub use observer::{Apparent, Observer};
pub use place::Place;
pub use planet::Planet;
pub use planets::PlanetState;
pub use position_angle::position_angle_deg;
pub use positions::{Position, positions};
pub use refraction::Refraction;
pub use rise_and_set::{RiseAndSet, rise_and_set};
pub use solar_eclipse::SolarEclipse;
pub use stars::{StarFrame, StarPosition};
pub use sun::{PUT_SUN, SunModel, sun, sun_at};
pub use sun_events::{SunCrossings, SunEvents, sun_crossings, sun_events};
pub use target::Target;
