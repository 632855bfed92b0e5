//! `skyprobe.places`: names, coordinates, elevation, zones.

use super::results::datetime;
use super::{fork, work};
use crate::places::{self, CoordinateStyle, Coordinates, NamedPlace};
use crate::time::{self, Occurrence, ZoneChoice};
use pyo3::prelude::*;

/// A place of the gazetteer: a town, a village, an observatory, a country, a region, an island or a landmark.
#[pyclass(frozen, module = "skyprobe.places")]
pub struct Place {
    inner: NamedPlace,
}

#[pymethods]
impl Place {
    /// Its name, as GeoNames writes it: mostly that of its country's language, in Latin letters.
    #[getter]
    fn name(&self) -> &'static str {
        self.inner.name
    }

    /// The state, province or county that it lies in; empty where none is known.
    #[getter]
    fn region(&self) -> &'static str {
        self.inner.region
    }

    /// English name of the country.
    #[getter]
    fn country(&self) -> &'static str {
        self.inner.country
    }

    /// Code of the country, two letters (ISO 3166-1).
    #[getter]
    fn country_code(&self) -> &'static str {
        self.inner.country_code
    }

    /// "town" (or a village, or a part of one), "observatory", "country", "region", "island" or "landmark".
    #[getter]
    fn kind(&self) -> &'static str {
        self.inner.kind.name()
    }

    /// The town whose coordinates, elevation and zone stand for a country (its capital), a region (its seat) or an island (its chief town); empty for
    /// others.
    #[getter]
    fn seat(&self) -> &'static str {
        self.inner.seat
    }

    /// Geodetic latitude, positive north, to 0.001. [degrees]
    #[getter]
    fn latitude(&self) -> f64 {
        self.inner.latitude_deg
    }

    /// Longitude, positive east, to 0.001. [degrees]
    #[getter]
    fn longitude(&self) -> f64 {
        self.inner.longitude_deg
    }

    /// Height above the sea. [m]
    #[getter]
    fn elevation_m(&self) -> f64 {
        self.inner.elevation_m
    }

    /// Inhabitants, to two digits; None if unknown.
    #[getter]
    fn population(&self) -> Option<u32> {
        self.inner.population
    }

    /// IANA time zone that GeoNames states; near borders that of :func:`zone_of_place` may differ.
    #[getter]
    fn time_zone(&self) -> &'static str {
        self.inner.time_zone
    }

    /// Name, region and country, such as "Lund, Skåne, Sweden", and the town that stands for it: "Iceland (Reykjavík)".
    #[getter]
    fn label(&self) -> String {
        self.inner.label()
    }

    fn __repr__(&self) -> String {
        let NamedPlace { latitude_deg, longitude_deg, elevation_m, .. } = self.inner;
        format!("<Place {}: {latitude_deg:.3}, {longitude_deg:.3}, {elevation_m:.0} m>", self.inner.label())
    }
}

/// The town or observatory nearest to coordinates, and where they are seen from it.
#[pyclass(frozen, module = "skyprobe.places")]
pub struct NearestPlace {
    inner: places::Nearest,
}

#[pymethods]
impl NearestPlace {
    /// The place.
    #[getter]
    fn place(&self) -> Place {
        Place { inner: self.inner.place }
    }

    /// From the place to the coordinates, along the ground. [km]
    #[getter]
    fn distance_km(&self) -> f64 {
        self.inner.distance_km
    }

    /// Direction from the place to the coordinates, from north through east. [degrees]
    #[getter]
    fn azimuth_deg(&self) -> f64 {
        self.inner.azimuth_deg
    }

    /// Such as "12 km N of Lund, Skåne, Sweden"; the place alone within 2 km of it.
    #[getter]
    fn label(&self) -> String {
        self.inner.label()
    }

    fn __repr__(&self) -> String {
        format!("<NearestPlace {}>", self.inner.label())
    }
}

/// Where a text says to be: a name that was found, or coordinates that were read.
#[pyclass(frozen, module = "skyprobe.places")]
pub struct Location {
    inner: places::Location,
}

#[pymethods]
impl Location {
    /// Geodetic latitude, positive north. [degrees]
    #[getter]
    fn latitude(&self) -> f64 {
        self.inner.latitude_deg
    }

    /// Longitude, positive east. [degrees]
    #[getter]
    fn longitude(&self) -> f64 {
        self.inner.longitude_deg
    }

    /// Height above the sea: of the place that was named, or roughly of the land at coordinates. [m]
    #[getter]
    fn elevation_m(&self) -> f64 {
        self.inner.elevation_m
    }

    /// The place that was named; None for coordinates.
    #[getter]
    fn place(&self) -> Option<Place> {
        self.inner.place.map(|inner| Place { inner })
    }

    /// What to call it: "Lund, Skåne, Sweden", or "12 km N of Lund, Skåne, Sweden".
    #[getter]
    fn label(&self) -> String {
        self.inner.label.clone()
    }

    fn __repr__(&self) -> String {
        let places::Location { latitude_deg, longitude_deg, elevation_m, label, .. } = &self.inner;
        format!("<Location {label}: {latitude_deg:.5}, {longitude_deg:.5}, {elevation_m:.0} m>")
    }
}

/// A time as the clocks of a place show it.
#[pyclass(frozen, module = "skyprobe.places")]
pub struct CivilTime {
    inner: time::CivilTime,
}

#[pymethods]
impl CivilTime {
    /// The instant, aware of its offset.
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        datetime(py, &self.inner.time)
    }

    /// IANA name of the zone; None for a fixed offset.
    #[getter]
    fn zone(&self) -> Option<&str> {
        self.inner.time.zone_name()
    }

    /// Local time minus UTC. [h]
    #[getter]
    fn utc_offset_h(&self) -> f64 {
        f64::from(self.inner.time.utc_offset_s()) / 3600.0
    }

    /// What the offset is called, such as "CEST", or "+03" where it has no name.
    #[getter]
    fn abbreviation(&self) -> &str {
        &self.inner.abbreviation
    }

    /// Whether clocks are set forward for the summer.
    #[getter]
    fn daylight_saving(&self) -> bool {
        self.inner.daylight_saving
    }

    /// How often clocks show the local time that was given: "once"; "repeated" (clocks are set back: the first is taken); "skipped" (clocks are set
    /// forward: the time as far after the gap is taken).
    #[getter]
    fn occurrence(&self) -> &'static str {
        match self.inner.occurrence {
            Occurrence::Once => "once",
            Occurrence::Repeated => "repeated",
            Occurrence::Skipped => "skipped",
        }
    }

    /// What had to be assumed, in a sentence: that clocks show the time never or twice and which instant is taken, that a date alone is its noon, that a
    /// second 60 is the one before; None for a time that says all.
    #[getter]
    fn notice(&self) -> Option<&str> {
        self.inner.time.notice()
    }

    fn __repr__(&self) -> String {
        let time::CivilTime { time, abbreviation, .. } = &self.inner;
        format!("<CivilTime {time} {abbreviation}>")
    }
}

/// What a text says of a time, for programs that keep date, time of day, offset and zone apart.
#[pyclass(frozen, module = "skyprobe.places")]
pub struct TimeFields {
    inner: time::TimeFields,
}

#[pymethods]
impl TimeFields {
    /// Gregorian year, 1000 to 3000.
    #[getter]
    fn year(&self) -> i16 {
        self.inner.civil.year
    }

    /// Month, 1 to 12.
    #[getter]
    fn month(&self) -> i8 {
        self.inner.civil.month
    }

    /// Day of the month, 1 to 31.
    #[getter]
    fn day(&self) -> i8 {
        self.inner.civil.day
    }

    /// Hour, 0 to 23, in the zone that the text names, at its offset, or local where it says neither; "now" is in UTC.
    #[getter]
    fn hour(&self) -> i8 {
        self.inner.civil.hour
    }

    /// Minute, 0 to 59.
    #[getter]
    fn minute(&self) -> i8 {
        self.inner.civil.minute
    }

    /// Second with its fraction, 0 to below 60.
    #[getter]
    fn second(&self) -> f64 {
        self.inner.civil.second
    }

    /// Local time minus UTC, where the text says offset or zone, else None. In an hour that clocks show twice it tells which is meant. [h]
    #[getter]
    fn utc_offset_h(&self) -> Option<f64> {
        self.inner.utc_offset_s.map(|seconds| f64::from(seconds) / 3600.0)
    }

    /// IANA name of the zone that the text names, else None.
    #[getter]
    fn zone(&self) -> Option<&str> {
        self.inner.zone.as_deref()
    }

    /// What had to be assumed, in a sentence, as ``CivilTime.notice``; without a zone in the text it is not known whether its clocks show the time.
    #[getter]
    fn notice(&self) -> Option<&str> {
        self.inner.notice.as_deref()
    }

    fn __repr__(&self) -> String {
        let time::TimeFields { civil, utc_offset_s, zone, .. } = &self.inner;
        let time::Civil { year, month, day, hour, minute, second } = civil;
        let offset = utc_offset_s.map_or_else(String::new, |seconds| format!(" {:+} h", f64::from(seconds) / 3600.0));
        let zone = zone.as_ref().map_or_else(String::new, |zone| format!(" [{zone}]"));
        format!("<TimeFields {year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}{offset}{zone}>")
    }
}

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
