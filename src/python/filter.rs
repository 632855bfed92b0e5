//! `PolarisingFilter`.

use super::pickle::{self, Reduced};
use crate::sky;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A polarising filter between the sky and the picture: what is seen is I + strength (Q cos 2c + U sin 2c), where c is the angle of its
/// axis from the vertical. The half of the light that any filter takes is made up for by the exposure.
///
/// Parameters
/// ----------
/// strength
///     0 (no filter) to 1 (ideal).
/// angle_deg
///     Angle of the axis from the vertical, clockwise as one sees it, -180 to 180. [degrees]
/// held_towards_deg
///     Altitude and azimuth towards which the filter is held, one piece of glass for the whole picture; the closer one looks along its axis, the less
///     it does. None: it turns with the view, its axis at the same angle from the vertical in every direction. [degrees]
#[pyclass(frozen, module = "skyprobe")]
pub struct PolarisingFilter {
    pub inner: sky::PolarisingFilter,
}

#[pymethods]
impl PolarisingFilter {
    #[new]
    #[pyo3(signature = (*, strength = 1.0, angle_deg = 0.0, held_towards_deg = None))]
    fn new(strength: f64, angle_deg: f64, held_towards_deg: Option<(f64, f64)>) -> PyResult<Self> {
        let inner = sky::PolarisingFilter { strength, angle_deg, held_towards_deg: held_towards_deg.map(Into::into) };
        inner.validate()?;
        Ok(Self { inner })
    }

    /// 0 (no filter) to 1 (ideal).
    #[getter]
    fn strength(&self) -> f64 {
        self.inner.strength
    }

    /// Angle of the axis from the vertical, clockwise as one sees it. [degrees]
    #[getter]
    fn angle_deg(&self) -> f64 {
        self.inner.angle_deg
    }

    /// Altitude and azimuth towards which the filter is held; None if it turns with the view. [degrees]
    #[getter]
    fn held_towards_deg(&self) -> Option<(f64, f64)> {
        self.inner.held_towards_deg.map(Into::into)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (keys, filter) = (PyDict::new(slf.py()), slf.get());
        keys.set_item("strength", filter.strength())?;
        keys.set_item("angle_deg", filter.angle_deg())?;
        keys.set_item("held_towards_deg", filter.held_towards_deg())?;
        pickle::call(slf.get_type().as_any(), (), &keys)
    }

    fn __repr__(&self) -> String {
        let held =
            self.held_towards_deg().map_or("None".to_string(), |(altitude, azimuth)| format!("({altitude:?}, {azimuth:?})"));
        let (strength, angle) = (self.inner.strength, self.inner.angle_deg);
        format!("PolarisingFilter(strength={strength:?}, angle_deg={angle:?}, held_towards_deg={held})")
    }
}
