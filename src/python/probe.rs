//! `Probe`.

use super::arguments::vectors;
use super::docstrings::docstring;
use super::errors::InputError;
use super::keywords::Keywords;
use super::pickle::Reduced;
use super::pictures::file_options;
use super::scene::Scene;
use super::work;
use crate::error::Result;
use crate::io::{self, Half, Metadata};
use crate::probe::{self, ProbeSettings};
use crate::scene::{self, calls};
use glam::DVec3;
use numpy::{PyArray1, PyArray3, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// A rendered image of the light from all directions.
#[pyclass(frozen, module = "skyprobe")]
pub struct Probe {
    pub settings: ProbeSettings,
    metadata: Metadata,
    pixels: Mutex<Pixels>,
}

/// The pixels stay with Rust until Python asks for them and then move into the array, without a copy in either case.
enum Pixels {
    Rendered(Arc<probe::Probe>),
    Array(Py<PyArray3<f32>>),
}

impl Probe {
    pub fn new(rendered: probe::Probe, metadata: Metadata) -> Self {
        let settings = rendered.settings.clone();
        Self { settings, metadata, pixels: Mutex::new(Pixels::Rendered(Arc::new(rendered))) }
    }

    /// The probe as Rust has it. Once Python holds the pixels it may write to them, so then it is a copy of them as they are.
    fn snapshot(&self, py: Python<'_>) -> Result<Arc<probe::Probe>> {
        // Never held while the interpreter is released, so that no thread can wait for the other.
        match &*self.pixels.lock().unwrap_or_else(PoisonError::into_inner) {
            Pixels::Rendered(probe) => Ok(probe.clone()),
            Pixels::Array(array) => {
                let values = array.bind(py).to_vec().map_err(|error| crate::Error::data(error.to_string()))?;
                Ok(Arc::new(probe::Probe::new(values, self.settings.clone())?))
            }
        }
    }
}

#[pymethods]
impl Probe {
    /// The pixels, linear, shape (H, W, 3): always the same array, not a copy. What is written to it is what ``save`` saves.
    #[getter]
    fn pixels(&self, py: Python<'_>) -> PyResult<Py<PyArray3<f32>>> {
        let mut pixels = self.pixels.lock().unwrap_or_else(PoisonError::into_inner);
        let array = match &mut *pixels {
            Pixels::Array(array) => return Ok(array.clone_ref(py)),
            Pixels::Rendered(probe) => {
                let shape = [probe.height, probe.width, 3];
                // Another thread may be saving it: only then it is copied.
                let values = match Arc::get_mut(probe) {
                    Some(probe) => std::mem::take(&mut probe.pixels),
                    None => probe.pixels.clone(),
                };
                PyArray1::from_vec(py, values).reshape(shape)?.unbind()
            }
        };
        *pixels = Pixels::Array(array.clone_ref(py));
        Ok(array)
    }

    /// The scene that makes this probe again; None if its air was given as a profile.
    #[getter]
    fn scene(&self) -> PyResult<Option<Scene>> {
        let scene = self.metadata.config_json.as_deref().map(scene::Scene::from_json).transpose()?;
        Ok(scene.map(|inner| Scene { inner }))
    }

    /// Height. [pixels]
    #[getter]
    fn height(&self) -> usize {
        self.settings.height()
    }

    #[doc = docstring!(Probe.save)]
    #[pyo3(signature = (path, *, half = None, progress = None, **parameters), text_signature = None)]
    fn save(
        &self,
        py: Python<'_>,
        path: PathBuf,
        half: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        let options = file_options(&mut Keywords::read(&calls::SAVE, parameters)?, half)?;
        let probe = self.snapshot(py)?;
        work::run(py, progress, |progress| io::save_with_progress(&path, &probe, (&options, &self.metadata), progress))
    }

    /// Irradiance of planes: the integral of pixels times cosine, in the probe's units times sr. One plane gives a tuple of three, planes of shape (N, 3) an
    /// array of that shape. A thousand cost some 40 times what one costs (latlong), or 4 times (fisheye).
    ///
    /// Parameters
    /// ----------
    /// normal
    ///     Vector (east, north, up) that the plane faces, of any length but 0, or several of them, shape (N, 3); up by default.
    #[pyo3(signature = (normal = None))]
    fn irradiance(&self, py: Python<'_>, normal: Option<&Bound<'_, PyAny>>) -> PyResult<Py<PyAny>> {
        let (normals, alone) = normal.map_or(Ok((vec![DVec3::Z], true)), |given| vectors("normal", given))?;
        let probe = self.snapshot(py)?;
        let found = work::run(py, None, |_| Ok(probe.irradiances(&normals)))?;
        if let ([rgb], true) = (&found[..], alone) {
            return Ok((rgb[0], rgb[1], rgb[2]).into_pyobject(py)?.into_any().unbind());
        }
        let shape = [found.len(), 3];
        Ok(PyArray1::from_vec(py, found.into_flattened()).reshape(shape)?.into_any().unbind())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, probe) = (slf.py(), slf.get());
        let pixels = probe.pixels(py)?;
        let settings = serde_json::to_string(&probe.settings).unwrap_or_default();
        let metadata = serde_json::to_string(&probe.metadata).unwrap_or_default();
        Ok((slf.get_type().getattr("_restore")?, (settings, metadata, pixels).into_pyobject(py)?))
    }

    /// What a pickle holds, as a probe.
    #[staticmethod]
    fn _restore(settings: &str, metadata: &str, pixels: Bound<'_, PyArray3<f32>>) -> PyResult<Self> {
        let wrong = |error: serde_json::Error| InputError::new_err(format!("pickle = probe: must be whole ({error})"));
        let settings: ProbeSettings = serde_json::from_str(settings).map_err(wrong)?;
        settings.validate()?;
        let metadata: Metadata = serde_json::from_str(metadata).map_err(wrong)?;
        let shape = [settings.height(), settings.width, 3];
        if pixels.shape() != shape || !pixels.is_c_contiguous() {
            return Err(InputError::new_err(format!("pickle = array of shape {:?}: must be {shape:?}", pixels.shape())));
        }
        Ok(Self { settings, metadata, pixels: Mutex::new(Pixels::Array(pixels.unbind())) })
    }

    fn __repr__(&self) -> String {
        let ProbeSettings { width, projection, scale, color_space, .. } = &self.settings;
        format!("<Probe: {width} x {}, {projection}, {scale}, {color_space}>", self.height())
    }
}

/// `True` and `False`, or the name of what happens to pixels that half floats cannot hold.
pub fn read_half(half: &Bound<'_, PyAny>) -> PyResult<Half> {
    if let Ok(name) = half.extract::<String>() {
        return Ok(name.parse()?);
    }
    let on: bool = half
        .extract()
        .map_err(|_| InputError::new_err(format!("half = {half}: must be True, False, \"refuse\" or \"scale\"")))?;
    Ok(if on { Half::Refuse } else { Half::Off })
}
