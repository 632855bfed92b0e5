//! The extension module `skyprobe._core`: arguments in, results out, no physics.
//!
//! The docstrings that a Python user reads are those of `python/skyprobe/_core.pyi` and of the classes' members here; names, units
//! and defaults are the same on both sides, which the tests check. Calls that take parameters by name have theirs, and their signatures,
//! from the table of parameters: `docstrings` is made from it.

mod air;
mod arguments;
mod arrays;
mod bodies;
mod components;
mod docstrings;
mod errors;
mod filter;
mod fork;
mod keywords;
mod night;
mod pickle;
mod pictures;
mod place_results;
mod places;
mod post;
mod probe;
mod results;
mod scene;
mod sky;
mod tone;
mod values;
mod work;

use crate::probe::ProbeSettings;
use crate::sky::{NightOptions, PolarisingFilter};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};

/// The compiled part of skyprobe.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("InputError", py.get_type::<errors::InputError>())?;
    module.add("DataError", py.get_type::<errors::DataError>())?;
    module.add("UnsolvedError", py.get_type::<errors::UnsolvedError>())?;
    module.add("Cancelled", py.get_type::<errors::Cancelled>())?;
    module.add("ScaleWarning", py.get_type::<errors::ScaleWarning>())?;
    module.add("SunlightOnlyWarning", py.get_type::<errors::SunlightOnlyWarning>())?;
    module.add("TimeWarning", py.get_type::<errors::TimeWarning>())?;
    module.add_class::<air::Atmosphere>()?;
    module.add_class::<components::Component>()?;
    module.add_class::<components::Phase>()?;
    module.add_class::<filter::PolarisingFilter>()?;
    module.add_class::<night::Night>()?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<sky::Sky>()?;
    module.add_class::<probe::Probe>()?;
    keywords::show(&py.get_type::<night::Night>(), NightOptions::PARAMETERS, |night: &night::Night| &night.inner)?;
    keywords::show(
        &py.get_type::<filter::PolarisingFilter>(),
        PolarisingFilter::PARAMETERS,
        |filter: &filter::PolarisingFilter| &filter.inner,
    )?;
    keywords::show(&py.get_type::<probe::Probe>(), ProbeSettings::PARAMETERS, |probe: &probe::Probe| &probe.settings)?;
    module.add_class::<bodies::Body>()?;
    module.add_class::<bodies::Moon>()?;
    module.add_class::<bodies::RiseAndSet>()?;
    module.add_class::<bodies::SolarEclipse>()?;
    module.add_class::<bodies::LunarEclipse>()?;
    module.add_class::<results::SunEvents>()?;
    module.add_class::<results::Irradiance>()?;
    module.add_class::<results::Illuminance>()?;
    module.add_class::<place_results::Place>()?;
    module.add_class::<place_results::NearestPlace>()?;
    module.add_class::<place_results::Location>()?;
    module.add_class::<place_results::CivilTime>()?;
    module.add_class::<place_results::TimeFields>()?;
    module.add_function(wrap_pyfunction!(places::search_places, module)?)?;
    module.add_function(wrap_pyfunction!(places::suggest_places, module)?)?;
    module.add_function(wrap_pyfunction!(places::nearest_place, module)?)?;
    module.add_function(wrap_pyfunction!(places::locate_place, module)?)?;
    module.add_function(wrap_pyfunction!(places::parse_coordinates, module)?)?;
    module.add_function(wrap_pyfunction!(places::format_coordinates, module)?)?;
    module.add_function(wrap_pyfunction!(places::elevation_m, module)?)?;
    module.add_function(wrap_pyfunction!(places::zone_of_place, module)?)?;
    module.add_function(wrap_pyfunction!(places::civil_time, module)?)?;
    module.add_function(wrap_pyfunction!(places::parse_time, module)?)?;
    module.add_class::<post::Report>()?;
    module.add_function(wrap_pyfunction!(post::glare, module)?)?;
    module.add_function(wrap_pyfunction!(post::point_spread_function, module)?)?;
    module.add_class::<tone::Metering>()?;
    module.add_class::<tone::ToneReport>()?;
    module.add_class::<tone::Adaptation>()?;
    module.add_function(wrap_pyfunction!(tone::tone_map, module)?)?;
    module.add_function(wrap_pyfunction!(tone::auto_exposure, module)?)?;
    module.add_function(wrap_pyfunction!(check_files, module)?)?;
    #[cfg(feature = "cli")]
    module.add_function(wrap_pyfunction!(run_command_line, module)?)?;
    Ok(())
}

/// Check, before any work, that files can be written, and that none is written over what is read or written already.
///
/// Parameters
/// ----------
/// inputs
///     Files that will be read.
/// outputs
///     Files that will be written: each must be in a folder that is there, must not be read-only, and must be neither an input nor another output,
///     however they are spelt (relative, through links, in another case where the system does not tell cases apart).
#[pyfunction]
fn check_files(inputs: Vec<PathBuf>, outputs: Vec<PathBuf>) -> PyResult<()> {
    fork::check()?;
    let inputs: Vec<(&str, &Path)> = inputs.iter().map(|path| ("input", path.as_path())).collect();
    let outputs: Vec<(&str, &Path)> = outputs.iter().map(|path| ("output", path.as_path())).collect();
    crate::io::check_files(&inputs, &outputs)?;
    outputs.iter().try_for_each(|(_, path)| crate::io::check_writable(path))?;
    Ok(())
}

/// Run the command line tool with `arguments`, the first being the program's name, and return its exit code.
#[cfg(feature = "cli")]
#[pyfunction]
fn run_command_line(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> PyResult<u8> {
    work::apart(py, || Ok(crate::cli::run(arguments)))
}
