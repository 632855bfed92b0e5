//! Plain results: `SunEvents`, `Irradiance`, `Illuminance`.

use crate::ephemeris;
use crate::sky;
use crate::time::Time;
use numpy::{PyArray1, PyUntypedArrayMethods};
use pyo3::prelude::*;

/// An instant as an aware `datetime.datetime`.
pub fn datetime<'py>(py: Python<'py>, time: &Time) -> PyResult<Bound<'py, PyAny>> {
    py.import("datetime")?.getattr("datetime")?.call_method1("fromisoformat", (time.to_string(),))
}

/// The Sun's day at a place, in the zone of the sky's time. An event that does not happen is None.
///
/// Sunrise and sunset are those of almanacs: the Sun's centre at -50 arcminutes, a level horizon.
#[pyclass(frozen, module = "skyprobe")]
pub struct SunEvents {
    pub inner: ephemeris::SunEvents,
}

impl SunEvents {
    fn optional<'py>(py: Python<'py>, time: Option<&Time>) -> PyResult<Option<Bound<'py, PyAny>>> {
        time.map(|time| datetime(py, time)).transpose()
    }
}

#[pymethods]
impl SunEvents {
    /// The Sun's centre rises through -18 degrees.
    #[getter]
    fn astronomical_dawn<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.astronomical_dawn.as_ref())
    }

    /// The Sun's centre rises through -12 degrees.
    #[getter]
    fn nautical_dawn<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.nautical_dawn.as_ref())
    }

    /// The Sun's centre rises through -6 degrees.
    #[getter]
    fn civil_dawn<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.civil_dawn.as_ref())
    }

    /// The Sun's upper limb appears.
    #[getter]
    fn sunrise<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.sunrise.as_ref())
    }

    /// The Sun is in the meridian.
    #[getter]
    fn solar_noon<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        datetime(py, &self.inner.solar_noon)
    }

    /// Airless altitude at solar noon. [degrees]
    #[getter]
    fn noon_altitude_deg(&self) -> f64 {
        self.inner.noon_altitude_deg
    }

    /// The Sun's upper limb disappears.
    #[getter]
    fn sunset<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.sunset.as_ref())
    }

    /// The Sun's centre sinks through -6 degrees.
    #[getter]
    fn civil_dusk<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.civil_dusk.as_ref())
    }

    /// The Sun's centre sinks through -12 degrees.
    #[getter]
    fn nautical_dusk<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.nautical_dusk.as_ref())
    }

    /// The Sun's centre sinks through -18 degrees.
    #[getter]
    fn astronomical_dusk<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.astronomical_dusk.as_ref())
    }

    fn __repr__(&self) -> String {
        let ephemeris::SunEvents { sunrise, solar_noon, noon_altitude_deg, sunset, .. } = &self.inner;
        let or_never = |time: &Option<Time>| time.as_ref().map_or_else(|| "never".to_owned(), Time::to_string);
        let (sunrise, sunset) = (or_never(sunrise), or_never(sunset));
        format!("<SunEvents: sunrise {sunrise}, solar noon {solar_noon} at altitude {noon_altitude_deg:.3} deg, sunset {sunset}>")
    }
}

/// Spectral irradiance, each of shape (W,). [W m-2 nm-1]
#[pyclass(frozen, module = "skyprobe")]
pub struct Irradiance {
    direct_normal: Py<PyArray1<f64>>,
    direct_horizontal: Py<PyArray1<f64>>,
    moon_normal: Py<PyArray1<f64>>,
    moon_horizontal: Py<PyArray1<f64>>,
    diffuse_horizontal: Py<PyArray1<f64>>,
    global_horizontal: Py<PyArray1<f64>>,
}

impl Irradiance {
    pub fn new(py: Python<'_>, irradiance: sky::Irradiance) -> Self {
        let array = |values| PyArray1::from_vec(py, values).unbind();
        Self {
            direct_normal: array(irradiance.direct_normal),
            direct_horizontal: array(irradiance.direct_horizontal),
            moon_normal: array(irradiance.moon_normal),
            moon_horizontal: array(irradiance.moon_horizontal),
            diffuse_horizontal: array(irradiance.diffuse_horizontal),
            global_horizontal: array(irradiance.global_horizontal),
        }
    }
}

#[pymethods]
impl Irradiance {
    /// Of the Sun's disc, at a total eclipse of its corona, on a plane that faces it. [W m-2 nm-1]
    #[getter]
    fn direct_normal(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.direct_normal.clone_ref(py)
    }

    /// Of the same, on the horizontal plane. [W m-2 nm-1]
    #[getter]
    fn direct_horizontal(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.direct_horizontal.clone_ref(py)
    }

    /// Of the Moon's disc, on a plane that faces it. [W m-2 nm-1]
    #[getter]
    fn moon_normal(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.moon_normal.clone_ref(py)
    }

    /// Of the Moon's disc, on the horizontal plane. [W m-2 nm-1]
    #[getter]
    fn moon_horizontal(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.moon_horizontal.clone_ref(py)
    }

    /// Of the sky with all that shines in it but the discs of Sun and Moon, on the horizontal plane. [W m-2 nm-1]
    #[getter]
    fn diffuse_horizontal(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.diffuse_horizontal.clone_ref(py)
    }

    /// Of discs and sky, on the horizontal plane. [W m-2 nm-1]
    #[getter]
    fn global_horizontal(&self, py: Python<'_>) -> Py<PyArray1<f64>> {
        self.global_horizontal.clone_ref(py)
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        format!("<Irradiance at {} wavelengths [W m-2 nm-1]>", self.direct_normal.bind(py).len())
    }
}

/// Illuminance, CIE 1931 observer. [lx]
#[pyclass(frozen, module = "skyprobe")]
pub struct Illuminance {
    pub inner: sky::Illuminance,
}

#[pymethods]
impl Illuminance {
    /// Of the Sun's disc, at a total eclipse of its corona, on a plane that faces it. [lx]
    #[getter]
    fn direct_normal_lx(&self) -> f64 {
        self.inner.direct_normal_lx
    }

    /// Of the same, on the horizontal plane. [lx]
    #[getter]
    fn direct_horizontal_lx(&self) -> f64 {
        self.inner.direct_horizontal_lx
    }

    /// Of the Moon's disc, on a plane that faces it. [lx]
    #[getter]
    fn moon_normal_lx(&self) -> f64 {
        self.inner.moon_normal_lx
    }

    /// Of the Moon's disc, on the horizontal plane. [lx]
    #[getter]
    fn moon_horizontal_lx(&self) -> f64 {
        self.inner.moon_horizontal_lx
    }

    /// Of the sky with all that shines in it but the discs of Sun and Moon, on the horizontal plane. [lx]
    #[getter]
    fn diffuse_horizontal_lx(&self) -> f64 {
        self.inner.diffuse_horizontal_lx
    }

    /// Of discs and sky, on the horizontal plane. [lx]
    #[getter]
    fn global_horizontal_lx(&self) -> f64 {
        self.inner.global_horizontal_lx
    }

    fn __repr__(&self) -> String {
        let sky::Illuminance { direct_horizontal_lx, moon_horizontal_lx, diffuse_horizontal_lx, .. } = self.inner;
        format!(
            "<Illuminance on the horizontal: Sun {direct_horizontal_lx:.4} lx, Moon {moon_horizontal_lx:.4} lx, sky \
             {diffuse_horizontal_lx:.4} lx>"
        )
    }
}
