//! What `skyprobe.places` answers with: `Place`, `NearestPlace`, `Location`, `CivilTime`, `TimeFields`.

use super::results::datetime;
use crate::places::{self, NamedPlace};
use crate::time::{self, Occurrence};
use pyo3::prelude::*;

/// A place of the gazetteer: a town, a village, an observatory, a country, a region, an island or a landmark.
#[pyclass(frozen, module = "skyprobe.places")]
pub struct Place {
    pub inner: NamedPlace,
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
    pub inner: places::Nearest,
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
    pub inner: places::Location,
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
    pub inner: time::CivilTime,
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
    pub inner: time::TimeFields,
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
