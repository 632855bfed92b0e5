//! `Component`, `Phase`: what an air that is given in full is made of.

use super::arrays;
use super::pickle::{self, Reduced};
use crate::atmosphere::{self, PhaseTable};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// One kind of particle or gas of an explicit profile.
///
/// Parameters
/// ----------
/// scattering, absorption
///     Coefficients, shape (Z, W): altitudes, wavelengths. [1/km]
/// phase
///     Phase function; None for a component that only absorbs.
/// name
///     Name for messages.
#[pyclass(frozen, module = "skyprobe")]
pub struct Component {
    name: Option<String>,
    scattering: arrays::Values,
    absorption: arrays::Values,
    phase: Option<atmosphere::Phase>,
}

#[pymethods]
impl Component {
    #[new]
    #[pyo3(signature = (*, scattering, absorption, phase, name = None))]
    fn new(
        scattering: &Bound<'_, PyAny>,
        absorption: &Bound<'_, PyAny>,
        phase: Option<PyRef<'_, Phase>>,
        name: Option<String>,
    ) -> PyResult<Self> {
        Ok(Self {
            name,
            scattering: arrays::floats("scattering", scattering)?,
            absorption: arrays::floats("absorption", absorption)?,
            phase: phase.map(|phase| phase.inner.clone()),
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, Self { name, scattering, absorption, phase }) = (slf.py(), slf.get());
        let keys = PyDict::new(py);
        for (key, array) in [("scattering", scattering), ("absorption", absorption)] {
            keys.set_item(key, PyArray1::from_slice(py, &array.values).reshape(array.shape.clone())?)?;
        }
        keys.set_item("phase", phase.clone().map(|inner| Bound::new(py, Phase { inner })).transpose()?)?;
        keys.set_item("name", name)?;
        pickle::call(slf.get_type().as_any(), (), &keys)
    }

    fn __repr__(&self) -> String {
        let name = self.name.as_ref().map_or_else(|| "None".to_owned(), |name| format!("{name:?}"));
        let phase = match &self.phase {
            Some(inner) => Phase { inner: inner.clone() }.__repr__(),
            None => "None".to_owned(),
        };
        format!("<Component: name {name}, arrays of shape {:?}, phase {phase}>", self.scattering.shape)
    }
}

impl Component {
    /// A part of a profile with so many altitudes and wavelengths.
    pub fn of(part: &atmosphere::Component, rows: usize, columns: usize) -> Self {
        let values = |values: &[f64]| arrays::Values { values: values.to_vec(), shape: vec![rows, columns] };
        Self {
            name: Some(part.name.clone()),
            scattering: values(&part.scattering_per_km),
            absorption: values(&part.absorption_per_km),
            phase: part.phase.clone(),
        }
    }

    pub fn with_shape(&self, index: usize, rows: usize, columns: usize) -> PyResult<atmosphere::Component> {
        let name = self.name.clone().unwrap_or_else(|| format!("components[{index}]"));
        let check = |what: &str, array: &arrays::Values| arrays::expect_matrix(&format!("{name}.{what}"), array, rows, columns);
        check("scattering", &self.scattering)?;
        check("absorption", &self.absorption)?;
        Ok(atmosphere::Component {
            name,
            scattering_per_km: self.scattering.values.clone(),
            absorption_per_km: self.absorption.values.clone(),
            phase: self.phase.clone(),
        })
    }
}

/// Where a scatterer sends the light: a phase function, normalised to 4 pi over the sphere.
#[pyclass(frozen, module = "skyprobe")]
pub struct Phase {
    inner: atmosphere::Phase,
}

#[pymethods]
impl Phase {
    /// Molecules.
    ///
    /// Parameters
    /// ----------
    /// depolarisation
    ///     Depolarisation ratio of natural light, 0 to 1: one for each wavelength, or a number. Default 0.
    #[staticmethod]
    #[pyo3(signature = (depolarisation = None))]
    fn rayleigh(depolarisation: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let depolarisation = match depolarisation {
            None => vec![0.0],
            Some(given) => arrays::vector("depolarisation", given)?,
        };
        for &ratio in &depolarisation {
            crate::error::check_range("depolarisation", ratio, 0.0, 1.0, "")?;
        }
        Ok(Self { inner: atmosphere::Phase::Rayleigh { depolarisation } })
    }

    /// The function of Henyey and Greenstein (1941) with an asymmetry from -0.99 to 0.99.
    #[staticmethod]
    fn henyey_greenstein(asymmetry: f64) -> PyResult<Self> {
        crate::error::check_range("asymmetry", asymmetry, -0.99, 0.99, "")?;
        Ok(Self { inner: atmosphere::Phase::HenyeyGreenstein { asymmetry } })
    }

    /// The function of Cornette and Shanks (1992) with the parameter g from -0.99 to 0.99.
    #[staticmethod]
    fn cornette_shanks(asymmetry: f64) -> PyResult<Self> {
        crate::error::check_range("asymmetry", asymmetry, -0.99, 0.99, "")?;
        Ok(Self { inner: atmosphere::Phase::CornetteShanks { asymmetry } })
    }

    /// A function given by numbers. Between the angles its logarithm is linear.
    ///
    /// It is scaled so that its integral over the sphere is 4 pi, and refused if it is further than 5 % from that.
    ///
    /// Parameters
    /// ----------
    /// angles_deg
    ///     Scattering angles, ascending from 0 to 180, shape (A,): close together where the function bends. [degrees]
    /// values
    ///     Shape (A,), or (W, A) with a row for each wavelength of the profile; not negative.
    #[staticmethod]
    fn tabulated(angles_deg: &Bound<'_, PyAny>, values: &Bound<'_, PyAny>) -> PyResult<Self> {
        let angles: Vec<f64> = arrays::vector("angles_deg", angles_deg)?.into_iter().map(f64::to_radians).collect();
        let values = arrays::floats("values", values)?;
        arrays::expect_rows("values", &values, angles.len())?;
        Ok(Self { inner: atmosphere::Phase::Tabulated(Arc::new(PhaseTable::new(&angles, &values.values)?)) })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, class) = (slf.py(), slf.get_type());
        let by_name = PyDict::new(py);
        match &slf.get().inner {
            atmosphere::Phase::Rayleigh { depolarisation } => {
                pickle::call(&class.getattr("rayleigh")?, (PyArray1::from_slice(py, depolarisation),), &by_name)
            }
            atmosphere::Phase::HenyeyGreenstein { asymmetry } => {
                pickle::call(&class.getattr("henyey_greenstein")?, (*asymmetry,), &by_name)
            }
            atmosphere::Phase::CornetteShanks { asymmetry } => {
                pickle::call(&class.getattr("cornette_shanks")?, (*asymmetry,), &by_name)
            }
            atmosphere::Phase::Tabulated(table) => {
                let [angles, ln_values] = table.defining_values();
                let angles_deg: Vec<f64> = angles.iter().map(|angle| angle.to_degrees()).collect();
                let values: Vec<f64> = ln_values.iter().map(|value| value.exp()).collect();
                let values = PyArray1::from_vec(py, values).reshape([table.wavelengths(), angles.len()])?;
                pickle::call(&class.getattr("tabulated")?, (PyArray1::from_vec(py, angles_deg), values), &by_name)
            }
        }
    }

    fn __repr__(&self) -> String {
        match &self.inner {
            atmosphere::Phase::Rayleigh { depolarisation } => format!("Phase.rayleigh(depolarisation={depolarisation:?})"),
            atmosphere::Phase::HenyeyGreenstein { asymmetry } => format!("Phase.henyey_greenstein({asymmetry:?})"),
            atmosphere::Phase::CornetteShanks { asymmetry } => format!("Phase.cornette_shanks({asymmetry:?})"),
            atmosphere::Phase::Tabulated(table) => {
                format!("Phase.tabulated(<{} angles>, <{} wavelengths>)", table.angles_rad().len(), table.wavelengths())
            }
        }
    }
}
