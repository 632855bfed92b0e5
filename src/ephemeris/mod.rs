//! Directions, distances and sizes of the bodies: knows place and time, nothing of air or images.
//!
//! # Conventions
//! - Altitudes are airless unless a name says `apparent`; azimuth from north through east; local frame x = east, y = north, z = up,
//!   where up is the normal of the WGS84 ellipsoid.
//! - Positions are topocentric (seen from the place, not from the Earth's centre) and apparent (light time, aberration).
//! - Celestial vectors are in the BCRS/GCRS [au], terrestrial ones in the ITRS; polar motion is taken as 0 (below 0.6 arcseconds).
//!
//! ```
//! use skyprobe::ephemeris::{Place, Refraction, SunModel, sun};
//! use skyprobe::time::{Time, ZoneChoice};
//!
//! let lund = Place::new(55.7047, 13.191, 50.0)?;
//! let time = Time::parse("1999-08-11T12:45:00+02:00", ZoneChoice::InText)?;
//! let sun = sun(&lund, &time, SunModel::Iau, &Refraction::none());
//! assert!((sun.altitude_deg - 49.281).abs() < 0.001);
//! # Ok::<(), skyprobe::Error>(())
//! ```

mod body;
mod earth;
mod horizon;
mod observer;
mod place;
mod refraction;
mod refraction_path;
mod root;
mod sun;
mod sun_events;
mod sun_thesis;

pub use body::Body;
pub use earth::EarthState;
pub use horizon::{direction_from_horizontal, horizontal_from_direction};
pub use observer::{Apparent, Observer};
pub use place::Place;
pub use refraction::Refraction;
pub use sun::{SunModel, sun, sun_at};
pub use sun_events::{SunCrossings, SunEvents, sun_crossings, sun_events};
