//! Where people say they are: names of places, coordinates in the usual spellings, the height of the land.
//!
//! # Conventions
//! - Latitude and longitude are geodetic (WGS84), north and east positive [degrees]; elevation above the sea [m].
//! - The gazetteer and the map of heights are embedded; nothing is looked up elsewhere. They are unpacked at the first question.
//! - Names are compared without regard to case, accents and hyphens.

pub mod coordinates;
mod fold;
mod gazetteer;
mod locate;
mod nearest;
mod search;
mod suggest;
mod terrain;

pub use coordinates::{CoordinateStyle, Coordinates};
pub use gazetteer::{NamedPlace, PlaceKind, count};
pub use locate::{Location, locate};
pub use nearest::{Nearest, nearest};
pub use search::search;
pub use suggest::suggest;
pub use terrain::elevation_m;
