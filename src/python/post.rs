//! What is done to finished pictures: arrays in, arrays out.

use super::arrays;
use super::errors::{InputError, ScaleWarning};
use super::work;
use crate::post::glare::{AdaptationState, GlareOptions, GlareReport, Glaring, glare as add_glare, point_spread};
use crate::post::picture::ASSUMPTION;
use crate::post::{Picture, PictureProjection};
use crate::units::Scale;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;
use std::ffi::CString;

/// What ``glare`` did to a picture.
#[pyclass(frozen, name = "GlareReport", module = "skyprobe.post")]
pub struct Report {
    inner: GlareReport,
}

#[pymethods]
impl Report {
    /// State of the eye: photopic, mesopic or scotopic.
    #[getter]
    fn state(&self) -> &'static str {
        self.inner.state.name()
    }

    /// Geometric mean of the luminance of all pixels that have any. [cd m-2]
    #[getter]
    fn mean_luminance(&self) -> f64 {
        self.inner.mean_luminance
    }

    /// Luminance above which light glared; None if all light did. [cd m-2]
    #[getter]
    fn threshold(&self) -> Option<f64> {
        self.inner.threshold
    }

    /// How many pixels had light that glared.
    #[getter]
    fn glaring_pixels(&self) -> usize {
        self.inner.glaring_pixels
    }

    /// How many pixels were too bright to be light (above 1e12) and kept what they had.
    #[getter]
    fn too_bright(&self) -> usize {
        self.inner.too_bright
    }

    /// Share of the glaring light of each channel that was not scattered.
    #[getter]
    fn unscattered(&self) -> (f64, f64, f64) {
        self.inner.unscattered.into()
    }

    /// How many values were no light and were repaired: not a number, infinite, denormal.
    #[getter]
    fn repairs(&self) -> (usize, usize, usize) {
        let found = self.inner.repairs;
        (found.not_a_number, found.infinite, found.denormal)
    }

    fn __repr__(&self) -> String {
        let found = &self.inner;
        let threshold = found.threshold.map_or("None".to_owned(), |threshold| format!("{threshold:?}"));
        format!(
            "<GlareReport: {}, mean luminance {:?} cd/m2, threshold {threshold}, {} pixels>",
            found.state.name(),
            found.mean_luminance,
            found.glaring_pixels
        )
    }
}

/// A picture of an array of shape (H, W, 3).
pub fn picture(
    pixels: &Bound<'_, PyAny>,
    projection: &str,
    (rows, field_of_view_deg): (&str, Option<f64>),
    (white_luminance, scale): (Option<f64>, Option<&str>),
    color_space: &str,
) -> PyResult<Picture> {
    let py = pixels.py();
    let white_luminance = match (white_luminance, scale.map(str::parse::<Scale>).transpose()?) {
        (Some(_), Some(scale)) => return Err(InputError::new_err(format!("scale = {scale}: must be None with white_luminance"))),
        (Some(luminance), None) => luminance,
        (None, Some(scale)) => scale.white_luminance(),
        (None, None) => {
            let message = CString::new(format!("{ASSUMPTION}; scale= or white_luminance= says otherwise"))?;
            PyErr::warn(py, &py.get_type::<ScaleWarning>(), &message, 1)?;
            Scale::default().white_luminance()
        }
    };
    let keywords = [("dtype", "float32")].into_py_dict(py)?;
    let wrong = |reason: String| InputError::new_err(format!("pixels = {reason}: must be an array of shape (H, W, 3)"));
    let array = py
        .import("numpy")?
        .call_method("ascontiguousarray", (pixels,), Some(&keywords))
        .map_err(|error| wrong(error.value(py).to_string()))?;
    let array = array.cast_into::<PyArrayDyn<f32>>().map_err(|error| wrong(error.to_string()))?;
    let &[height, width, 3] = array.shape() else {
        return Err(wrong(format!("array of shape {:?}", array.shape())));
    };
    let values = array.try_readonly().map_err(|error| wrong(error.to_string()))?.to_vec()?;
    let projection: PictureProjection = projection.parse()?;
    let angle = field_of_view_deg.unwrap_or(projection.default_field_of_view_deg());
    let view = projection.view(rows.parse()?, angle);
    Ok(Picture::new(width, height, values, color_space.parse()?, white_luminance, view)?)
}

/// Add the glare of the eye to a picture (Spencer et al. 1995): returns the new picture and what was done.
///
/// Parameters
/// ----------
/// pixels
///     Linear values, shape (H, W, 3), row 0 at the top. Values that are no light (not a number, infinite) are repaired, not spread.
/// projection
///     "perspective", "latlong" (a probe: 2:1, or 4:1 for its upper half) or "fisheye".
/// field_of_view_deg
///     Of a perspective picture the angle between left and right border (39.6 by default, as Blender's first camera), of a fisheye that of its width (180). [degrees]
/// rows
///     Of a latlong picture: "centre" or "corner".
/// scale
///     What the numbers are, "blender", "mitsuba" or "luminance", as ``Probe.scale`` says it. Without it and ``white_luminance`` it is "blender", with a ``ScaleWarning``.
/// white_luminance
///     Instead of ``scale``: luminance of a pixel of value 1, 683 in the scale "blender", 72983 in "mitsuba". [cd m-2]
/// color_space
///     "lin_rec709", "acescg", "lin_rec2020" or "xyz".
/// state
///     "photopic", "mesopic", "scotopic", or "auto" by the mean luminance: photopic above 5 cd m-2, scotopic below 0.005.
/// threshold
///     Light above this luminance glares; by default 20 times the mean luminance. [cd m-2]
/// whole_pixels
///     With a threshold: all light of the brighter pixels glares, not only what exceeds it.
/// all_light
///     All light glares.
/// size
///     Width and height of the filter in widths and heights of the picture, 0.01 to 2. A latlong picture always has all of it.
/// seed
///     Draws the streaks.
/// streaks
///     Their contrast, 0 (none) to 1 (lines on black, as in the thesis).
/// progress
///     ``progress(stage, fraction)``; returning False raises ``Cancelled``.
#[pyfunction]
#[pyo3(signature = (pixels, *, projection = "perspective", field_of_view_deg = None, rows = "centre", scale = None,
    white_luminance = None, color_space = "lin_rec709", state = "auto", threshold = None, whole_pixels = false, all_light = false, size = 2.0, seed = 0,
    streaks = 0.6, progress = None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub fn glare<'py>(
    py: Python<'py>,
    pixels: &Bound<'py, PyAny>,
    projection: &str,
    field_of_view_deg: Option<f64>,
    rows: &str,
    scale: Option<&str>,
    white_luminance: Option<f64>,
    color_space: &str,
    state: &str,
    threshold: Option<f64>,
    whole_pixels: bool,
    all_light: bool,
    size: f64,
    seed: u64,
    streaks: f64,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyArray3<f32>>, Report)> {
    let glaring = match threshold {
        Some(threshold) if all_light => {
            return Err(InputError::new_err(format!("threshold = {threshold}: must be None with all_light")));
        }
        None if whole_pixels => return Err(InputError::new_err("whole_pixels = True: must be False without a threshold")),
        None if all_light => Glaring::AllLight,
        None => Glaring::Automatic,
        Some(threshold) if whole_pixels => Glaring::Pixels(threshold),
        Some(threshold) => Glaring::Excess(threshold),
    };
    let state = if state == "auto" { None } else { Some(state.parse::<AdaptationState>()?) };
    let options = GlareOptions { state, glaring, size, seed, streaks };
    options.validate()?;
    let mut picture = picture(pixels, projection, (rows, field_of_view_deg), (white_luminance, scale), color_space)?;
    let inner = work::run(py, progress, |progress| add_glare(&mut picture, &options, progress))?;
    let shape = [picture.height, picture.width, 3];
    Ok((PyArray1::from_vec(py, picture.pixels).reshape(shape)?, Report { inner }))
}

/// Share of the light of a point per solid angle, shape (angles, wavelengths). [sr-1]
///
/// Parameters
/// ----------
/// state
///     "photopic", "mesopic" or "scotopic".
/// angles_deg
///     From the source, 0 to 180. [degrees]
/// wavelengths_nm
///     300 to 1000. Only the lenticular halo of the mesopic and the scotopic eye depends on them. [nm]
#[pyfunction]
pub fn point_spread_function<'py>(
    py: Python<'py>,
    state: &str,
    angles_deg: &Bound<'py, PyAny>,
    wavelengths_nm: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let state: AdaptationState = state.parse()?;
    let angles = arrays::vector("angles_deg", angles_deg)?;
    let wavelengths = arrays::vector("wavelengths_nm", wavelengths_nm)?;
    for &angle in &angles {
        crate::error::check_range("angles_deg", angle, 0.0, 180.0, "degrees")?;
    }
    for &wavelength in &wavelengths {
        crate::error::check_range("wavelengths_nm", wavelength, 300.0, 1000.0, "nm")?;
    }
    let values = angles.iter().flat_map(|&angle| wavelengths.iter().map(move |&nm| point_spread(state, angle, nm))).collect();
    PyArray1::from_vec(py, values).reshape([angles.len(), wavelengths.len()])
}
