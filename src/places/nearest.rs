//! The place nearest to coordinates, to call them by: "12 km north of Lund".
//!
//! haversine: sin^2(d / 2R) = sin^2(dphi / 2) + cos phi_1 cos phi_2 sin^2(dlambda / 2), R = 6371.0088 km (IUGG mean radius); on the ellipsoid
//! distances are up to 0.5 % different.

use super::gazetteer::{GAZETTEER, NamedPlace};
use crate::error::{Result, check_range};

/// IUGG mean radius of the Earth [km].
const EARTH_RADIUS_KM: f64 = 6_371.008_8;

/// The eight winds, from north through east.
const WINDS: [&str; 8] = ["N", "NE", "E", "SE", "S", "SW", "W", "NW"];

/// Below this distance [km] coordinates are said to be in the place.
const IN_PLACE_KM: f64 = 2.0;

/// A place and where coordinates are, seen from it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Nearest {
    /// The place.
    pub place: NamedPlace,
    /// From the place to the coordinates, along the ground [km].
    pub distance_km: f64,
    /// Direction from the place to the coordinates, from north through east, 0 to 360 [degrees].
    pub azimuth_deg: f64,
}

impl Nearest {
    /// Such as "12 km N of Lund, Skåne, Sweden", or the place alone within 2 km of it.
    pub fn label(&self) -> String {
        let label = self.place.label();
        if self.distance_km < IN_PLACE_KM {
            return label;
        }
        let wind = WINDS[(self.azimuth_deg / 45.0).round() as usize % WINDS.len()];
        format!("{:.0} km {wind} of {label}", self.distance_km)
    }
}

/// The town or observatory of the gazetteer that is nearest to coordinates [degrees]. Takes about a millisecond.
///
/// # Errors
/// [`crate::Error::Input`] for `latitude` outside -90 to 90 or `longitude` outside -180 to 180 degrees.
pub fn nearest(latitude_deg: f64, longitude_deg: f64) -> Result<Nearest> {
    check_range("latitude", latitude_deg, -90.0, 90.0, "degrees")?;
    check_range("longitude", longitude_deg, -180.0, 180.0, "degrees")?;
    let gazetteer = &*GAZETTEER;
    let (latitude, longitude) = (latitude_deg.to_radians(), longitude_deg.to_radians());
    let here = (latitude, longitude);
    let (mut best, mut smallest) = (0, f64::INFINITY);
    // In units of the gazetteer: the difference in latitude alone puts most places out of question.
    let (row_latitude, mut reach) = (latitude_deg * 1000.0, f64::INFINITY);
    for (index, row) in gazetteer.rows.iter().enumerate() {
        if (f64::from(row.latitude) - row_latitude).abs() > reach || !row.kind.is_point() {
            continue;
        }
        let there = ((f64::from(row.latitude) / 1000.0).to_radians(), (f64::from(row.longitude) / 1000.0).to_radians());
        let haversine = haversine(here, there);
        if haversine < smallest {
            (best, smallest) = (index, haversine);
            reach = angle(haversine).to_degrees() * 1000.0;
        }
    }
    let place = gazetteer.place(best);
    let there = (place.latitude_deg.to_radians(), place.longitude_deg.to_radians());
    Ok(Nearest { place, distance_km: EARTH_RADIUS_KM * angle(smallest), azimuth_deg: azimuth(there, here).to_degrees() })
}

/// Half of the versed sine of the angle between two points (latitude, longitude) [rad].
fn haversine(from: (f64, f64), to: (f64, f64)) -> f64 {
    let half_sine_squared = |angle: f64| (0.5 * angle).sin().powi(2);
    half_sine_squared(to.0 - from.0) + from.0.cos() * to.0.cos() * half_sine_squared(to.1 - from.1)
}

fn angle(haversine: f64) -> f64 {
    2.0 * haversine.min(1.0).sqrt().asin()
}

/// Initial direction from north through east, 0 to 2 pi [rad].
fn azimuth(from: (f64, f64), to: (f64, f64)) -> f64 {
    let (sin, cos) = (to.1 - from.1).sin_cos();
    let east = to.0.cos() * sin;
    let north = from.0.cos() * to.0.sin() - from.0.sin() * to.0.cos() * cos;
    east.atan2(north).rem_euclid(std::f64::consts::TAU)
}

#[cfg(test)]
mod tests {
    use super::super::search;
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn coordinates_are_called_by_the_place_they_are_near() {
        assert_eq!(nearest(55.71, 13.19).unwrap().label(), "Lund, Skåne, Sweden");
        let sea = nearest(48.0, -40.0).unwrap();
        assert!(sea.distance_km > 900.0 && sea.label().contains(" km "), "{}", sea.label());
        assert!(nearest(91.0, 0.0).unwrap_err().to_string().starts_with("latitude = 91"));
        assert!(nearest(0.0, f64::NAN).is_err());
    }

    #[test]
    fn distances_and_directions_are_those_of_the_sphere() {
        // A quarter of the equator, and a degree of the meridian: pi R / 180 = 111.195 km.
        assert!((angle(haversine((0.0, 0.0), (0.0, 90_f64.to_radians()))) - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        let degree = EARTH_RADIUS_KM * angle(haversine((0.5, 1.0), (0.5 + 1_f64.to_radians(), 1.0)));
        assert!((degree - 111.195).abs() < 1e-3);
        assert!((azimuth((0.0, 0.0), (0.0, 0.1)).to_degrees() - 90.0).abs() < 1e-9);
        assert!((azimuth((0.5, 0.0), (0.4, 0.0)).to_degrees() - 180.0).abs() < 1e-9);
        // checked against: great circle from Paris (48.8566, 2.3522) to London (51.5074, -0.1278): 343.6 km by the haversine formula
        let (paris, london) = ((48.8566_f64, 2.3522_f64), (51.5074_f64, -0.1278_f64));
        let radians = |(latitude, longitude): (f64, f64)| (latitude.to_radians(), longitude.to_radians());
        assert!((EARTH_RADIUS_KM * angle(haversine(radians(paris), radians(london))) - 343.6).abs() < 0.1);
    }

    #[test]
    fn the_date_line_is_no_border() {
        // Taveuni (Fiji) lies on it.
        let east = nearest(-16.85, 179.999).unwrap();
        let west = nearest(-16.85, -179.999).unwrap();
        assert_eq!(east.place, west.place);
    }

    #[test]
    fn the_label_has_the_wind() {
        let lund = search("Lund, Sweden", 1)[0];
        let north = Nearest { place: lund, distance_km: 12.3, azimuth_deg: 350.0 };
        assert_eq!(north.label(), "12 km N of Lund, Skåne, Sweden");
        assert_eq!(Nearest { azimuth_deg: 200.0, ..north }.label(), "12 km S of Lund, Skåne, Sweden");
        assert_eq!(Nearest { azimuth_deg: 203.0, ..north }.label(), "12 km SW of Lund, Skåne, Sweden");
        assert_eq!(Nearest { distance_km: 1.0, ..north }.label(), "Lund, Skåne, Sweden");
    }

    proptest! {
        /// Leaving out by latitude never loses the nearest.
        #[test]
        fn nothing_is_nearer(latitude in -90.0..=90.0, longitude in -180.0..=180.0) {
            let found = nearest(latitude, longitude).unwrap();
            let here = (latitude.to_radians(), longitude.to_radians());
            let smallest = GAZETTEER.rows.iter().filter(|row| row.kind.is_point()).map(|row| {
                let there = ((f64::from(row.latitude) / 1000.0).to_radians(), (f64::from(row.longitude) / 1000.0).to_radians());
                haversine(here, there)
            }).fold(f64::INFINITY, f64::min);
            prop_assert!((found.distance_km - EARTH_RADIUS_KM * angle(smallest)).abs() < 1e-6);
        }
    }
}
