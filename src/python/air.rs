//! `Atmosphere`, `Component`, `Phase`.

use super::arrays;
use super::errors::InputError;
use super::pickle::{self, Reduced};
use super::{fork, work};
use crate::atmosphere::{self, AirParameters, Ground, OpticalProfile, PhaseTable};
use crate::quality::Quality;
use crate::sky;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyDict;
use std::sync::Arc;

/// The state of the air. It is solved on first use, once, and can be shared by any number of skies and threads.
///
/// What is left out comes from the preset. At most one of ``aod550``, ``turbidity`` and ``visibility_km`` is given.
///
/// Parameters
/// ----------
/// preset
///     Where to start from: "clear", "pure", "hazy", "polluted", "urban", "maritime", "desert", "antarctic", "fog", "volcanic" or
///     "thesis".
/// aerosol
///     Kind of haze: "none", "continental_clean", "continental_average", "continental_polluted", "urban", "maritime_clean",
///     "maritime_polluted", "maritime_tropical", "desert", "arctic", "antarctic", "fog" or "thesis".
/// relative_humidity
///     With which the particles grow, 0 to 99; 80 by default. [%]
/// aod550
///     Vertical optical depth of the haze at 550 nm, 0 to 50.
/// turbidity
///     Optical depth of haze and molecules over that of the molecules at 550 nm, 1 (pure air) to 64.
/// visibility_km
///     Horizontal visibility at the ground, from 0.05. [km]
/// ozone_du
///     Ozone column, 0 to 1000. [Dobson units]
/// ground
///     "grass", "forest", "soil", "desert", "snow", "sea", "city", "asphalt", or one albedo from 0 to 1.
/// angstrom_exponent
///     Replaces the spectral slope of the haze's extinction, -1 to 4.
/// single_scattering_albedo
///     Replaces the haze's single scattering albedo, 0 to 1.
/// asymmetry
///     Replaces the haze's asymmetry parameter, -0.99 to 0.99, and so its phase function.
/// phase_function
///     How the haze scatters: "mie", "henyey_greenstein" or "cornette_shanks"; "mie" by default, "henyey_greenstein" if ``asymmetry`` is
///     given.
/// aerosol_scale_height_km
///     Replaces the haze's scale height, or the depth of a layer of fog, 0.1 to 20. [km]
/// stratospheric_aod550
///     Vertical optical depth at 550 nm of volcanic sulphuric acid in the stratosphere, 0 to 1; it comes on top of ``aod550``.
/// stratospheric_altitude_km
///     Altitude of its middle, 12 to 40; 20 by default. [km]
/// standard_atmosphere
///     Profile of temperature and density, such as "us_standard_1976" or "tropical".
/// surface_pressure_hpa
///     Pressure at the ground, 100 to 1100. [hPa]
/// quality
///     "draft", "standard", "high" or "reference".
/// polarisation
///     Whether light is solved with its polarisation. As a scalar it is wrong by several per cent: only to compare with scalar codes.
/// wavelengths_nm
///     Wavelengths at which light is solved instead of those of the quality: ascending, 300 to 1000, shape (W,). A probe and an illuminance
///     need at least four, from 450 or less to 650 or more. [nm]
/// cache
///     Whether light that was solved earlier is used again, and what is solved is kept, on this machine (see ``SKYPROBE_CACHE_DIR``; drafts
///     are not kept).
#[pyclass(frozen, module = "skyprobe")]
pub struct Atmosphere {
    pub inner: Arc<sky::Atmosphere>,
}

#[pymethods]
impl Atmosphere {
    #[new]
    #[pyo3(signature = (*, preset = "clear", aerosol = None, relative_humidity = None, aod550 = None, turbidity = None,
        visibility_km = None, ozone_du = None, ground = None, angstrom_exponent = None, single_scattering_albedo = None,
        asymmetry = None, phase_function = None, aerosol_scale_height_km = None, stratospheric_aod550 = None,
        stratospheric_altitude_km = None, standard_atmosphere = None, surface_pressure_hpa = None,
        quality = "standard", polarisation = true, wavelengths_nm = None, cache = true))]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        preset: &str,
        aerosol: Option<&str>,
        relative_humidity: Option<f64>,
        aod550: Option<f64>,
        turbidity: Option<f64>,
        visibility_km: Option<f64>,
        ozone_du: Option<f64>,
        ground: Option<&Bound<'_, PyAny>>,
        angstrom_exponent: Option<f64>,
        single_scattering_albedo: Option<f64>,
        asymmetry: Option<f64>,
        phase_function: Option<&str>,
        aerosol_scale_height_km: Option<f64>,
        stratospheric_aod550: Option<f64>,
        stratospheric_altitude_km: Option<f64>,
        standard_atmosphere: Option<&str>,
        surface_pressure_hpa: Option<f64>,
        quality: &str,
        polarisation: bool,
        wavelengths_nm: Option<&Bound<'_, PyAny>>,
        cache: bool,
    ) -> PyResult<Self> {
        fork::check()?;
        let air = AirParameters {
            preset: preset.parse()?,
            aerosol: aerosol.map(str::parse).transpose()?,
            relative_humidity,
            aod550,
            turbidity,
            visibility_km,
            ozone_du,
            ground: ground.map(read_ground).transpose()?,
            angstrom_exponent,
            single_scattering_albedo,
            asymmetry,
            phase_function: phase_function.map(str::parse).transpose()?,
            aerosol_scale_height_km,
            stratospheric_aod550,
            stratospheric_altitude_km,
            standard_atmosphere: standard_atmosphere.map(str::parse).transpose()?,
            surface_pressure_hpa,
        };
        let quality = quality.parse::<Quality>()?;
        let inner = match wavelengths_nm {
            None => sky::Atmosphere::new(&air, quality, polarisation)?,
            Some(given) => {
                sky::Atmosphere::at_wavelengths(&air, &arrays::vector("wavelengths_nm", given)?, quality, polarisation)?
            }
        };
        Ok(Self { inner: Arc::new(inner.with_cache(if cache { sky::Cache::of_user() } else { None })) })
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
        Ok(Self { inner: Arc::new(inner.with_cache(if cache { sky::Cache::of_user() } else { None })) })
    }

    /// Solve the light now instead of on first use. Solving twice costs nothing.
    #[pyo3(signature = (progress = None))]
    fn solve(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
        work::run(py, progress, |progress| self.inner.solve(progress))
    }

    /// Name of the quality level.
    #[getter]
    fn quality(&self) -> PyResult<String> {
        Ok(name_of(&self.inner.quality()))
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
        keys.set_item("quality", name_of(&inner.quality()))?;
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
        let given = serde_json::to_value(parameters).unwrap_or_default();
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
        let quality = name_of(&self.inner.quality());
        let scalar = if self.inner.is_polarised() { "" } else { ", polarisation=False" };
        let Some(parameters) = self.inner.parameters() else {
            let profile = self.inner.profile();
            let (altitudes, wavelengths) = (profile.altitudes_km.len(), profile.wavelengths_nm.len());
            let components = profile.components.len();
            return format!(
                "<Atmosphere: a profile of {altitudes} altitudes, {wavelengths} wavelengths and {components} components; quality {quality}{scalar}>"
            );
        };
        let given = serde_json::to_value(parameters).unwrap_or_default();
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
    /// The air of skies that are given none.
    pub fn usual(py: Python<'_>) -> PyResult<Bound<'_, Self>> {
        static USUAL: PyOnceLock<Py<Atmosphere>> = PyOnceLock::new();
        let air = USUAL.get_or_try_init(py, || {
            let air = sky::Atmosphere::new(&AirParameters::default(), Quality::default(), true)?;
            Py::new(py, Self { inner: Arc::new(air.with_cache(sky::Cache::of_user())) })
        });
        air.map(|air| air.bind(py).clone())
    }
}

/// The ground by name or as an albedo.
fn read_ground(ground: &Bound<'_, PyAny>) -> PyResult<Ground> {
    if let Ok(name) = ground.extract::<String>() {
        // A number is a number only without quotes.
        return Ok(Ground::Surface(name.parse()?));
    }
    match ground.extract::<f64>() {
        Ok(albedo) => Ok(Ground::Albedo(albedo)),
        Err(_) => {
            Err(InputError::new_err(format!("ground = {ground}: must be a name such as \"grass\" or an albedo from 0 to 1")))
        }
    }
}

/// The name that users write for a value of an enumeration.
pub fn name_of<T: serde::Serialize>(value: &T) -> String {
    serde_json::to_value(value).ok().and_then(|name| name.as_str().map(str::to_string)).unwrap_or_default()
}

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
    fn of(part: &atmosphere::Component, rows: usize, columns: usize) -> Self {
        let values = |values: &[f64]| arrays::Values { values: values.to_vec(), shape: vec![rows, columns] };
        Self {
            name: Some(part.name.clone()),
            scattering: values(&part.scattering_per_km),
            absorption: values(&part.absorption_per_km),
            phase: part.phase.clone(),
        }
    }

    fn with_shape(&self, index: usize, rows: usize, columns: usize) -> PyResult<atmosphere::Component> {
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
