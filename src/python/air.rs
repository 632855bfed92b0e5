//! `Atmosphere`.

use super::arrays;
use super::components::Component;
use super::docstrings::docstring;
use super::keywords::{self, Keywords};
use super::pickle::{self, Reduced};
use super::{fork, work};
use crate::atmosphere::{AirParameters, OpticalProfile};
use crate::quality::Quality;
use crate::scene::{SceneAtmosphere, calls};
use crate::sky;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use std::sync::Arc;

#[doc = docstring!(Atmosphere)]
#[pyclass(frozen, module = "skyprobe")]
pub struct Atmosphere {
    pub inner: Arc<sky::Atmosphere>,
}

#[pymethods]
impl Atmosphere {
    #[new]
    #[pyo3(signature = (*, cache = true, **parameters), text_signature = None)]
    fn new(cache: bool, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        fork::check()?;
        let air = Keywords::read(&calls::ATMOSPHERE, parameters)?.value("atmosphere");
        Ok(Self::with(SceneAtmosphere::from_value("", &air)?.to_solve()?, cache))
    }

    /// An air given in full: another code's, or another planet's. Coefficients are linear between the altitudes.
    ///
    /// Parameters
    /// ----------
    /// altitudes_km
    ///     Ascending from 0, shape (Z,); the last is the top of the air. [km]
    /// wavelengths_nm
    ///     Ascending, shape (W,). [nm]
    /// components
    ///     What the air is made of.
    /// solar_irradiance
    ///     At the top of the air at 1 au, shape (W,) or a number. [W m-2 nm-1]
    /// ground_albedo
    ///     Lambertian, 0 to 1, shape (W,) or a number. Default 0.
    /// planet_radius_km
    ///     Radius of the ground. [km]
    /// sun_angular_radius_deg
    ///     Angular radius of the Sun's disc. [degrees]
    /// quality
    ///     "draft", "standard", "high" or "reference".
    /// polarisation
    ///     Whether light is solved with its polarisation. As a scalar it is wrong by several per cent: only to compare with scalar codes.
    /// cache
    ///     As for ``Atmosphere``.
    #[staticmethod]
    #[pyo3(signature = (altitudes_km, wavelengths_nm, components, *, solar_irradiance, ground_albedo = None,
        planet_radius_km = 6371.0, sun_angular_radius_deg = 0.2664, quality = "standard", polarisation = true, cache = true))]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments")]
    fn from_profile(
        altitudes_km: &Bound<'_, PyAny>,
        wavelengths_nm: &Bound<'_, PyAny>,
        components: Vec<PyRef<'_, Component>>,
        solar_irradiance: &Bound<'_, PyAny>,
        ground_albedo: Option<&Bound<'_, PyAny>>,
        planet_radius_km: f64,
        sun_angular_radius_deg: f64,
        quality: &str,
        polarisation: bool,
        cache: bool,
    ) -> PyResult<Self> {
        fork::check()?;
        let altitudes_km = arrays::vector("altitudes_km", altitudes_km)?;
        let wavelengths_nm = arrays::vector("wavelengths_nm", wavelengths_nm)?;
        let (rows, columns) = (altitudes_km.len(), wavelengths_nm.len());
        let components = components
            .iter()
            .enumerate()
            .map(|(index, component)| component.with_shape(index, rows, columns))
            .collect::<PyResult<Vec<_>>>()?;
        let profile = OpticalProfile {
            altitudes_km,
            wavelengths_nm,
            components,
            ground_albedo: match ground_albedo {
                Some(albedo) => arrays::vector_or_number("ground_albedo", albedo, columns)?,
                None => vec![0.0; columns],
            },
            solar_irradiance: arrays::vector_or_number("solar_irradiance", solar_irradiance, columns)?,
            planet_radius_km,
            sun_angular_radius_deg,
        };
        let inner = sky::Atmosphere::from_profile(profile, quality.parse::<Quality>()?, polarisation)?;
        Ok(Self::with(inner, cache))
    }

    /// Solve the light now instead of on first use. Solving twice costs nothing.
    #[pyo3(signature = (progress = None))]
    fn solve(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        work::run(py, progress, |progress| self.inner.solve(progress))
    }

    /// Name of the quality level.
    #[getter]
    fn quality(&self) -> &'static str {
        self.inner.quality().name()
    }

    /// Altitudes of the optical profile, shape (Z,). [km]
    #[getter]
    fn altitudes_km<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.inner.profile().altitudes_km)
    }

    /// Wavelengths of the optical profile, shape (W,). [nm]
    #[getter]
    fn wavelengths_nm<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.inner.profile().wavelengths_nm)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, inner) = (slf.py(), &slf.get().inner);
        let keys = PyDict::new(py);
        keys.set_item("quality", inner.quality().name())?;
        keys.set_item("polarisation", inner.is_polarised())?;
        keys.set_item("cache", inner.is_cached())?;
        let profile = inner.profile();
        let Some(parameters) = inner.parameters() else {
            let (rows, columns) = (profile.altitudes_km.len(), profile.wavelengths_nm.len());
            let components = profile.components.iter().map(|part| Bound::new(py, Component::of(part, rows, columns)));
            keys.set_item("solar_irradiance", PyArray1::from_slice(py, &profile.solar_irradiance))?;
            keys.set_item("ground_albedo", PyArray1::from_slice(py, &profile.ground_albedo))?;
            keys.set_item("planet_radius_km", profile.planet_radius_km)?;
            keys.set_item("sun_angular_radius_deg", profile.sun_angular_radius_deg)?;
            let given = (
                PyArray1::from_slice(py, &profile.altitudes_km),
                PyArray1::from_slice(py, &profile.wavelengths_nm),
                components.collect::<PyResult<Vec<_>>>()?,
            );
            return pickle::call(&slf.get_type().getattr("from_profile")?, given, &keys);
        };
        let given = keywords::written(parameters);
        for (key, value) in given.as_object().into_iter().flatten() {
            keys.set_item(key, super::values::object(py, value)?)?;
        }
        if let Some(wavelengths_nm) = inner.chosen_wavelengths() {
            keys.set_item("wavelengths_nm", PyArray1::from_slice(py, wavelengths_nm))?;
        }
        pickle::call(slf.get_type().as_any(), (), &keys)
    }

    /// The air itself, which cannot be changed, with its solved light.
    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    /// The air itself, which cannot be changed, with its solved light.
    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self) -> String {
        let quality = self.inner.quality().name();
        let scalar = if self.inner.is_polarised() { "" } else { ", polarisation=False" };
        let Some(parameters) = self.inner.parameters() else {
            let profile = self.inner.profile();
            let (altitudes, wavelengths) = (profile.altitudes_km.len(), profile.wavelengths_nm.len());
            let components = profile.components.len();
            return format!(
                "<Atmosphere: a profile of {altitudes} altitudes, {wavelengths} wavelengths and {components} components; quality {quality}{scalar}>"
            );
        };
        let given = keywords::written(parameters);
        let words = given.as_object().into_iter().flatten().map(|(key, value)| match value.as_str() {
            Some(word) => format!("{key}='{word}'"),
            None => format!("{key}={value}"),
        });
        let chosen = self.inner.chosen_wavelengths();
        let chosen = chosen.map_or_else(String::new, |chosen| format!(", wavelengths_nm=<{} wavelengths>", chosen.len()));
        format!("Atmosphere({}, quality='{quality}'{scalar}{chosen})", words.collect::<Vec<_>>().join(", "))
    }
}

impl Atmosphere {
    /// An air of the library; with `cache` its light is kept on this machine.
    pub fn with(inner: sky::Atmosphere, cache: bool) -> Self {
        Self { inner: Arc::new(inner.with_cache(if cache { sky::Cache::of_user() } else { None })) }
    }

    /// The air of skies that are given none.
    pub fn usual(py: Python<'_>) -> PyResult<Bound<'_, Self>> {
        static USUAL: PyOnceLock<Py<Atmosphere>> = PyOnceLock::new();
        let air = USUAL.get_or_try_init(py, || {
            let air = sky::Atmosphere::new(&AirParameters::default(), Quality::default(), true)?;
            Py::new(py, Self::with(air, true))
        });
        air.map(|air| air.bind(py).clone())
    }
}
