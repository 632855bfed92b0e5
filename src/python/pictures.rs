//! Pictures of a sky: from keywords to what is rendered.

use super::filter::PolarisingFilter;
use super::keywords::{self, Keywords};
use super::probe::{Probe, read_half};
use super::sky::Sky;
use super::{errors::InputError, fork, work};
use crate::io::{FileOptions, Format, Half, SampleMap, check_output, render_to_files};
use crate::probe::{self, ProbeSettings};
use crate::scene::{calls, describe};
use crate::sky::{LightOptions, Model};
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::Path;

type Filter<'a, 'py> = Option<&'a PyRef<'py, PolarisingFilter>>;

/// `Sky.render`.
pub fn render(
    py: Python<'_>,
    sky: &Sky,
    filter: Filter<'_, '_>,
    parameters: Option<&Bound<'_, PyDict>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Probe> {
    let mut given = Keywords::read(&calls::RENDER, parameters)?;
    let light = light_options(sky, filter, given.table("")?)?;
    let settings = settings(&mut given)?;
    let rendered =
        work::run(py, progress, |progress| probe::render(&sky.inner.light_by(&light, progress)?, &settings, progress))?;
    Ok(Probe::new(rendered, describe(&sky.inner, sky.sun_model, &light, &settings)))
}

/// `Sky.render_to_file`; `half` and whether layers are written apart are `of_file`.
pub fn render_to_file(
    py: Python<'_>,
    sky: &Sky,
    path: &Path,
    (half, separate_layers): (Option<&Bound<'_, PyAny>>, bool),
    filter: Filter<'_, '_>,
    parameters: Option<&Bound<'_, PyDict>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    fork::check()?;
    let mut given = Keywords::read(&calls::RENDER_TO_FILE, parameters)?;
    let light = light_options(sky, filter, given.table("")?)?;
    let settings = settings(&mut given)?;
    let options = FileOptions { layers: separate_layers, ..file_options(&mut given, half)? };
    if separate_layers && Format::of(path)? != Format::Exr {
        return Err(InputError::new_err("separate_layers = True: must be False for a file that is not .exr"));
    }
    check_output(path)?;
    let metadata = describe(&sky.inner, sky.sun_model, &light, &settings);
    work::run(py, progress, |progress| {
        render_to_files(&sky.inner.light_by(&light, progress)?, &settings, &[path], &options, &metadata, progress)
    })
}

/// `Sky.sample_map`.
pub fn sample_map<'py>(
    py: Python<'py>,
    sky: &Sky,
    (width, turn_deg): (i64, f64),
    filter: Filter<'_, '_>,
    tolerance: Option<f64>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Bound<'py, PyArray3<u8>>> {
    let light = light_options(sky, filter, LightOptions { tolerance, ..LightOptions::default() })?;
    if light.model != Model::Scattering {
        return Err(InputError::new_err(format!("model = {:?}: must be \"scattering\" for a sample map", light.model.name())));
    }
    keywords::check(ProbeSettings::PARAMETERS, "width", &width)?;
    let width = width as usize;
    ProbeSettings { width, turn_deg, ..ProbeSettings::default() }.validate()?;
    let map = work::run(py, progress, |progress| {
        let dome = sky.inner.filtered_light(light.polarising_filter.as_ref(), light.tolerance, progress)?;
        SampleMap::new(&dome, width, turn_deg, progress)
    })?;
    PyArray1::from_vec(py, map.pixels).reshape([map.height, map.width, 3])
}

/// What belongs to a file, from keywords and `half`, which Python knows as a flag, too.
pub fn file_options(given: &mut Keywords, half: Option<&Bound<'_, PyAny>>) -> PyResult<FileOptions> {
    Ok(FileOptions { half: half.map_or(Ok(Half::Off), read_half)?, ..given.table("file")? })
}

fn settings(given: &mut Keywords) -> crate::Result<ProbeSettings> {
    let settings: ProbeSettings = given.table("probe")?;
    settings.validate()?;
    Ok(settings)
}

fn light_options(sky: &Sky, filter: Filter<'_, '_>, given: LightOptions) -> crate::Result<LightOptions> {
    let options = LightOptions { model: sky.model, polarising_filter: filter.map(|filter| filter.inner), ..given };
    options.validate()?;
    Ok(options)
}
