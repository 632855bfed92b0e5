//! One text for a place: its name, or coordinates in any spelling.

use super::coordinates::Coordinates;
use super::gazetteer::NamedPlace;
use super::{elevation_m, nearest, search, suggest};
use crate::error::{Error, Result, quoted};

/// Longest name that is looked for [bytes].
const LONGEST_NAME: usize = 200;

/// How many places are suggested for a name that is not found.
const SUGGESTIONS: usize = 3;

/// Where a text says to be.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Location {
    /// Geodetic latitude, positive north [degrees].
    pub latitude_deg: f64,
    /// Longitude, positive east [degrees].
    pub longitude_deg: f64,
    /// Height above the sea [m]: of the place in the gazetteer, or roughly of the land at coordinates ([`elevation_m`]).
    pub elevation_m: f64,
    /// The place that was named; `None` for coordinates.
    pub place: Option<NamedPlace>,
    /// What to call it: "Lund, Skåne, Sweden", or "12 km N of Lund, Skåne, Sweden".
    pub label: String,
}

/// The place that `text` means: coordinates if it can be read as such, else the best match of [`search`], which [`Location::label`] tells.
///
/// # Errors
/// [`Error::Input`] for `place` if it is neither, with the nearest spellings that there are ([`suggest`]); for `latitude`, `longitude` or `coordinates` if it has numbers that are not right.
pub fn locate(text: &str) -> Result<Location> {
    let unreadable = match Coordinates::parse(text) {
        Ok(Coordinates { latitude_deg, longitude_deg }) => {
            return Ok(Location {
                latitude_deg,
                longitude_deg,
                elevation_m: elevation_m(latitude_deg, longitude_deg)?.round(),
                place: None,
                label: nearest(latitude_deg, longitude_deg)?.label(),
            });
        }
        Err(error) => error,
    };
    match search(text, 1).first() {
        Some(&place) => Ok(Location {
            latitude_deg: place.latitude_deg,
            longitude_deg: place.longitude_deg,
            elevation_m: place.elevation_m,
            place: Some(place),
            label: place.label(),
        }),
        None if text.contains(|letter: char| letter.is_ascii_digit()) || text.len() > LONGEST_NAME => Err(unreadable),
        None => {
            let allowed = "the name of a town, a country, an island or a landmark that the gazetteer has, such as Lund, Sweden, or coordinates, such as \
                           55.71, 13.19";
            let near: Vec<String> = suggest(text, SUGGESTIONS).iter().map(NamedPlace::label).collect();
            let meant = if near.is_empty() { String::new() } else { format!("; nearest spellings: {}", near.join("; ")) };
            Err(Error::input("place", quoted(text), format!("{allowed}{meant}")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_and_coordinates_lead_to_the_same_place() {
        let named = locate("Lund, Sweden").unwrap();
        let pointed = locate("55 42 36 N 13 11 24 E").unwrap();
        assert_eq!(named.label, "Lund, Skåne, Sweden");
        assert_eq!(pointed.label, named.label);
        assert!((named.latitude_deg - pointed.latitude_deg).abs() < 0.01 && named.place.is_some() && pointed.place.is_none());
        assert_eq!(named.elevation_m, 51.0);
        assert!((0.0..80.0).contains(&pointed.elevation_m));
    }

    #[test]
    fn what_is_neither_is_refused_by_what_it_looks_like() {
        assert!(locate("Qqqxx").unwrap_err().to_string().starts_with("place = \"Qqqxx\": must be the name of a town"));
        let message = locate("Stockhlom").unwrap_err().to_string();
        assert!(message.contains("nearest spellings: Stockholm, Sweden"), "{message}");
        assert!(locate(&"x".repeat(80_000)).unwrap_err().to_string().contains("at most 200 bytes"));
        assert!(locate("").unwrap_err().to_string().starts_with("place = \"\""));
        assert!(locate("95, 13").unwrap_err().to_string().starts_with("latitude = 95"));
        assert!(locate("55.71, 13.19, 5").unwrap_err().to_string().starts_with("coordinates = "));
    }
}
