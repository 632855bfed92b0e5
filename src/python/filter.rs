//! `PolarisingFilter`.

use super::docstrings::docstring;
use super::keywords::{self, Keywords};
use super::pickle::{self, Reduced};
use crate::scene::calls;
use crate::sky;
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[doc = docstring!(PolarisingFilter)]
#[pyclass(frozen, module = "skyprobe")]
pub struct PolarisingFilter {
    pub inner: sky::PolarisingFilter,
}

#[pymethods]
impl PolarisingFilter {
    #[new]
    #[pyo3(signature = (**parameters), text_signature = None)]
    fn new(parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let inner: sky::PolarisingFilter = Keywords::read(&calls::POLARISING_FILTER, parameters)?.table("polarising_filter")?;
        inner.validate()?;
        Ok(Self { inner })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let keys = keywords::keywords(slf.py(), sky::PolarisingFilter::PARAMETERS, &slf.get().inner)?;
        pickle::call(slf.get_type().as_any(), (), &keys)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        keywords::repr(py, "PolarisingFilter", sky::PolarisingFilter::PARAMETERS, &self.inner)
    }
}
