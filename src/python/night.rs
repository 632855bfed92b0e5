//! `Night`.

use super::docstrings::docstring;
use super::keywords::{self, Keywords};
use super::pickle::{self, Reduced};
use crate::scene::calls;
use crate::sky::NightOptions;
use pyo3::prelude::*;
use pyo3::types::PyDict;

#[doc = docstring!(Night)]
#[pyclass(frozen, module = "skyprobe")]
pub struct Night {
    pub inner: NightOptions,
}

#[pymethods]
impl Night {
    #[new]
    #[pyo3(signature = (**parameters), text_signature = None)]
    fn new(parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let inner: NightOptions = Keywords::read(&calls::NIGHT, parameters)?.table("night")?;
        inner.validate()?;
        Ok(Self { inner })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let keys = keywords::keywords(slf.py(), NightOptions::PARAMETERS, &slf.get().inner)?;
        pickle::call(slf.get_type().as_any(), (), &keys)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        keywords::repr(py, "Night", NightOptions::PARAMETERS, &self.inner)
    }
}
