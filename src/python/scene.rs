//! `Scene`.

use super::air::Atmosphere;
use super::errors::InputError;
use super::probe::Probe;
use super::sky::Sky;
use super::values;
use super::{fork, work};
use crate::io::{check_output, write_atomically};
use crate::probe;
use crate::progress::Progress;
use crate::scene;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};
use serde_json::{Map, Value};
use std::io::Write;
use std::path::PathBuf;

/// All that a probe is made from: place and time or a Sun that is put, air, night, picture and files. It reads and writes the configurations of the command line, and what
/// the headers of pictures hold.
///
/// Keys are those of a configuration (``skyprobe schema``); tables such as ``atmosphere`` are dictionaries. What is left out has its default; unknown keys, values
/// out of range, what contradicts itself and what would be ignored, such as ``bortle`` under a Sun that is put, are an :class:`InputError`.
///
/// >>> scene = sp.Scene(place="Lund, Sweden", time="2005-06-21T13:00", atmosphere={"turbidity": 3}, probe={"width": 512})
/// >>> probe = scene.render()
///
/// Scenes are equal if all of their values are; they pickle and copy.
#[pyclass(frozen, eq, module = "skyprobe")]
pub struct Scene {
    pub inner: scene::Scene,
}

impl PartialEq for Scene {
    fn eq(&self, other: &Self) -> bool {
        // What a name of a place was taken for is no part of it.
        self.inner.to_value() == other.inner.to_value()
    }
}

impl Scene {
    fn of_map(map: Map<String, Value>) -> PyResult<Self> {
        Ok(Self { inner: scene::Scene::from_value(&Value::Object(map))? })
    }
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (**keys))]
    fn new(keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        fork::check()?;
        Self::of_map(keys.map_or(Ok(Map::new()), values::table)?)
    }

    /// The scene of these keys without what would be ignored: for hosts that keep settings which are out of force.
    #[classmethod]
    #[pyo3(signature = (**keys))]
    fn without_ignored(_class: &Bound<'_, PyType>, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        fork::check()?;
        let map = keys.map_or(Ok(Map::new()), values::table)?;
        Ok(Self { inner: scene::Scene::from_value_in_force(&Value::Object(map))? })
    }

    /// The scene of a file: JSON, or a picture of skyprobe (.exr, .hdr), whose header holds what it was made from.
    #[classmethod]
    fn load(_class: &Bound<'_, PyType>, path: PathBuf) -> PyResult<Self> {
        fork::check()?;
        Ok(Self { inner: scene::Scene::read(&path)? })
    }

    /// The scene of a JSON text.
    #[classmethod]
    fn from_json(_class: &Bound<'_, PyType>, text: &str) -> PyResult<Self> {
        fork::check()?;
        Ok(Self { inner: scene::Scene::from_json(text)? })
    }

    /// Write the scene as JSON, every value written out; the file appears whole or not at all.
    fn save(&self, path: PathBuf) -> PyResult<()> {
        fork::check()?;
        let text = self.inner.to_json() + "\n";
        let failed = |error| crate::Error::file(&path, error);
        Ok(write_atomically(&path, &Progress::silent(), |file| file.write_all(text.as_bytes()).map_err(failed))?)
    }

    /// The scene as JSON, every value written out.
    fn to_json(&self) -> String {
        self.inner.to_json()
    }

    /// The scene as a dictionary, every value written out.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        values::object(py, &self.inner.to_value())
    }

    /// The same scene with other values. A table that is given as a dictionary changes the keys that it has; None takes a value away. What the others put out of force
    /// is left out: the place of a Sun that is put, one of three amounts of haze, the rest of a night that is never shown.
    ///
    /// >>> evening = scene.replace(time="2005-06-21T21:30", probe={"width": 1024})
    #[pyo3(signature = (**keys))]
    fn replace(&self, keys: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        fork::check()?;
        let changes = keys.map_or(Ok(Map::new()), values::table)?;
        Ok(Self { inner: self.inner.replace(&changes)? })
    }

    /// The air of the scene, not solved yet. One air serves all scenes that differ in place, time, night and picture only.
    ///
    /// Parameters
    /// ----------
    /// cache
    ///     As for ``Atmosphere``.
    #[pyo3(signature = (*, cache = true))]
    fn atmosphere(&self, cache: bool) -> PyResult<Atmosphere> {
        fork::check()?;
        Ok(Atmosphere::with(self.inner.atmosphere()?, cache))
    }

    /// The sky of the scene.
    ///
    /// Parameters
    /// ----------
    /// atmosphere
    ///     The air, if it is there already; None for that of the scene.
    #[pyo3(signature = (atmosphere = None))]
    fn sky(&self, py: Python<'_>, atmosphere: Option<Bound<'_, Atmosphere>>) -> PyResult<Sky> {
        fork::check()?;
        let air = match atmosphere {
            Some(air) => air,
            None => Bound::new(py, self.atmosphere(true)?)?,
        };
        let inner = self.inner.sky(air.get().inner.clone())?;
        Sky::of(py, inner, air.unbind(), self.inner.sun_model, self.inner.light.model)
    }

    /// Render the picture of the scene.
    ///
    /// Parameters
    /// ----------
    /// atmosphere
    ///     As for ``sky``.
    /// progress
    ///     Called with stage and fraction; returning False raises Cancelled.
    #[pyo3(signature = (atmosphere = None, *, progress = None))]
    fn render(
        &self,
        py: Python<'_>,
        atmosphere: Option<Bound<'_, Atmosphere>>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Probe> {
        let sky = self.sky(py, atmosphere)?.inner;
        let scene::Scene { light, probe: settings, sun_model, .. } = &self.inner;
        let rendered = work::run(py, progress, |progress| probe::render(&sky.light_by(light, progress)?, settings, progress))?;
        Ok(Probe::new(rendered, scene::describe(&sky, *sun_model, light, settings)))
    }

    /// Render the picture of the scene into files, which appear together or not at all.
    ///
    /// Parameters
    /// ----------
    /// paths
    ///     Names of files that end in .exr, .hdr or .png; None for those of the scene's ``output``.
    /// atmosphere
    ///     As for ``sky``.
    /// progress
    ///     Called with stage and fraction; returning False raises Cancelled.
    #[pyo3(signature = (paths = None, atmosphere = None, *, progress = None))]
    fn render_to_files(
        &self,
        py: Python<'_>,
        paths: Option<Vec<PathBuf>>,
        atmosphere: Option<Bound<'_, Atmosphere>>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        fork::check()?;
        let paths = paths.unwrap_or_else(|| self.inner.output.clone());
        if paths.is_empty() {
            return Err(InputError::new_err("paths = []: must be names of files, where the scene has no output"));
        }
        paths.iter().try_for_each(check_output)?;
        let sky = self.sky(py, atmosphere)?.inner;
        let scene::Scene { light, probe: settings, file, sun_model, .. } = &self.inner;
        let metadata = scene::describe(&sky, *sun_model, light, settings);
        let paths: Vec<&std::path::Path> = paths.iter().map(PathBuf::as_path).collect();
        work::run(py, progress, |progress| {
            crate::io::render_to_files(&sky.light_by(light, progress)?, settings, &paths, file, &metadata, progress)
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((slf.get_type().getattr("from_json")?, (slf.get().inner.to_value().to_string(),)))
    }

    /// The scene itself, which cannot be changed.
    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    /// The scene itself, which cannot be changed.
    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self) -> String {
        let scene::Scene { latitude, longitude, time, sun, atmosphere, probe, .. } = &self.inner;
        let place = match (sun, latitude, longitude) {
            (Some(sun), ..) => format!("Sun at altitude {} deg, azimuth {} deg", sun.altitude_deg, sun.azimuth_deg),
            (None, Some(latitude), Some(longitude)) => format!("latitude {latitude}, longitude {longitude}"),
            _ => "no place".to_owned(),
        };
        let time = time.as_ref().map_or_else(String::new, |time| format!(", {time}"));
        let (air, quality, width) = (atmosphere.air.preset, atmosphere.quality, probe.width);
        format!("<Scene: {place}{time}; air {air}, quality {quality}; {width} x {}>", probe.height())
    }
}
