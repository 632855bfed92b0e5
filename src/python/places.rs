//! Functions of `skyprobe.places`: names, coordinates, elevation, zones, times.

use super::place_results::{CivilTime, Location, NearestPlace, Place, TimeFields};
use super::{fork, work};
use crate::places::{self, CoordinateStyle, Coordinates};
use crate::time::{self, ZoneChoice};
use pyo3::prelude::*;

/// Date, time of day, offset and zone that a text says, without knowing the place.
///
/// ISO 8601 and RFC 9557 as ``Sky`` reads them: "2005-06-21T13:00:00+02:00", "2005-06-21 13:00", "2005-06-21T13+02",
/// "2005-06-21T13:00[Europe/Stockholm]", "2005-06-21T11:00Z[Europe/Stockholm]" (13:00 there), "2005-06-21" (its noon), "now". Raises
/// :class:`InputError` for what cannot be read.
///
/// Parameters
/// ----------
/// text
///     The time, at most 100 bytes.
#[pyfunction]
pub fn parse_time(text: &str) -> PyResult<TimeFields> {
    fork::check()?;
    Ok(TimeFields { inner: time::TimeFields::parse(text)? })
}

/// Places whose name, or another name, matches `text`: the best first. Up to 3 ms, 5 ms for a single letter; the first time some 0.1 s.
///
/// Case, accents and hyphens do not count, words may be begun only, and region or country may follow, after a comma or not: "lund", "goteborg",
/// "los ang", "portland, maine", "lund se". Ordered by how exactly the name is met, then by inhabitants. An empty text finds nothing.
///
/// Parameters
/// ----------
/// text
///     What a person has typed so far.
/// limit
///     How many places at most.
///
/// More than 200 bytes, 16 words or 6 commas find nothing.
#[pyfunction]
#[pyo3(signature = (text, limit = 10))]
pub fn search_places(py: Python<'_>, text: &str, limit: usize) -> PyResult<Vec<Place>> {
    // The first question unpacks the gazetteer: a host may ask it in a thread of its own.
    let found = work::apart(py, || Ok(places::search(text, limit)))?;
    Ok(found.into_iter().map(|inner| Place { inner }).collect())
}

/// Places whose names are spelled nearly as `text`: what may have been meant where the search finds nothing. "Stockhlom" suggests Stockholm.
///
/// Up to two letters may be missing, wrong, too many or swapped, one in words of four letters or fewer. The nearest come first, then the largest; up to 3 ms, the first time some 15 ms more.
///
/// Parameters
/// ----------
/// text
///     As for ``search``; more than 40 letters suggest nothing.
/// limit
///     How many places at most.
#[pyfunction]
#[pyo3(signature = (text, limit = 5))]
pub fn suggest_places(py: Python<'_>, text: &str, limit: usize) -> PyResult<Vec<Place>> {
    let found = work::apart(py, || Ok(places::suggest(text, limit)))?;
    Ok(found.into_iter().map(|inner| Place { inner }).collect())
}

/// The town or observatory nearest to coordinates.
///
/// Parameters
/// ----------
/// latitude
///     Geodetic latitude, -90 to 90. [degrees]
/// longitude
///     Longitude, -180 to 180. [degrees]
#[pyfunction]
pub fn nearest_place(latitude: f64, longitude: f64) -> PyResult<NearestPlace> {
    fork::check()?;
    Ok(NearestPlace { inner: places::nearest(latitude, longitude)? })
}

/// The place that `text` means: coordinates in any spelling, or the best match of a name, which the label of the result tells.
///
/// Raises :class:`InputError` if it is neither; the message has the nearest spellings.
///
/// Parameters
/// ----------
/// text
///     Such as "Lund, Sweden", "55.71, 13.19" or a link to a map.
#[pyfunction]
pub fn locate_place(text: &str) -> PyResult<Location> {
    fork::check()?;
    Ok(Location { inner: places::locate(text)? })
}

/// Latitude and longitude [degrees] that `text` says in any of the usual spellings.
///
/// "55.71, 13.19", "55,71 13,19", "55 42 36 N 13 11 24 E", "55°42'36"N 13°11'24"E", "N55 42.6 E13 11.4", "lat: 55.71, lon: 13.19",
/// "geo:55.71,13.19", links to Google Maps, OpenStreetMap and others. Raises :class:`InputError` for what cannot be read, or in two ways.
///
/// Parameters
/// ----------
/// text
///     The coordinates; latitude first unless letters say otherwise.
#[pyfunction]
pub fn parse_coordinates(text: &str) -> PyResult<(f64, f64)> {
    let Coordinates { latitude_deg, longitude_deg } = Coordinates::parse(text)?;
    Ok((latitude_deg, longitude_deg))
}

/// Coordinates as text, which :func:`parse_coordinates` reads.
///
/// Parameters
/// ----------
/// latitude
///     Geodetic latitude, -90 to 90. [degrees]
/// longitude
///     Longitude, -180 to 180. [degrees]
/// style
///     "decimal" (55.71, 13.19), "minutes" (55°42.600'N 13°11.400'E) or "seconds" (55°42'36"N 13°11'24"E).
#[pyfunction]
#[pyo3(signature = (latitude, longitude, style = "decimal"))]
pub fn format_coordinates(latitude: f64, longitude: f64, style: &str) -> PyResult<String> {
    Ok(Coordinates::new(latitude, longitude)?.format(style.parse::<CoordinateStyle>()?))
}

/// Rough height of the land above the sea [m], 0 at sea: means over 18 km, which know neither valleys nor peaks.
///
/// Parameters
/// ----------
/// latitude
///     Geodetic latitude, -90 to 90. [degrees]
/// longitude
///     Longitude, -180 to 180. [degrees]
#[pyfunction]
pub fn elevation_m(latitude: f64, longitude: f64) -> PyResult<f64> {
    fork::check()?;
    Ok(places::elevation_m(latitude, longitude)?)
}

/// IANA name of the time zone that is kept today at coordinates; at sea the nautical one.
///
/// Parameters
/// ----------
/// latitude
///     Geodetic latitude, -90 to 90. [degrees]
/// longitude
///     Longitude, -180 to 180. [degrees]
#[pyfunction]
pub fn zone_of_place(latitude: f64, longitude: f64) -> PyResult<&'static str> {
    fork::check()?;
    Ok(time::zone_of_place(latitude, longitude)?)
}

/// A time as the clocks of a place show it.
///
/// Parameters
/// ----------
/// time
///     Date and time, ISO 8601: without offset it is local time; a date alone is its noon; "now".
/// latitude
///     Geodetic latitude, -90 to 90. [degrees]
/// longitude
///     Longitude, -180 to 180. [degrees]
/// zone
///     IANA time zone instead of that of the place.
#[pyfunction]
#[pyo3(signature = (time, latitude, longitude, zone = None))]
pub fn civil_time(time: &str, latitude: f64, longitude: f64, zone: Option<&str>) -> PyResult<CivilTime> {
    fork::check()?;
    Coordinates::new(latitude, longitude)?;
    let choice = zone.map_or(ZoneChoice::OfPlace { latitude_deg: latitude, longitude_deg: longitude }, ZoneChoice::Named);
    Ok(CivilTime { inner: time::CivilTime::parse(time, choice)? })
}
