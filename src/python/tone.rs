//! Tone mapping: arrays of light in, pictures for a screen out.

use super::errors::InputError;
use super::{post, work};
use crate::post::Repairs;
use crate::post::tone::{self, Exposure, Frame, Operator, OperatorName, ToneMapper, ToneMapping, exposure};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Mutex, PoisonError};

/// Luminances of a picture as a meter and an eye see them: of a probe the upper half, by solid angle. Averages leave out the brightest 2 % and what is nearly black.
#[pyclass(frozen, module = "skyprobe.post")]
#[derive(Clone)]
pub struct Metering {
    inner: tone::Metering,
}

#[pymethods]
impl Metering {
    /// Mean of the logarithm: the middle of the picture. [cd m-2]
    #[getter]
    fn log_average(&self) -> f64 {
        self.inner.log_average
    }

    /// 95th percentile. [cd m-2]
    #[getter]
    fn bright(&self) -> f64 {
        self.inner.bright
    }

    /// Smallest luminance of all pixels. [cd m-2]
    #[getter]
    fn lowest(&self) -> f64 {
        self.inner.lowest
    }

    /// Largest luminance of all pixels. [cd m-2]
    #[getter]
    fn highest(&self) -> f64 {
        self.inner.highest
    }

    /// Luminance that the eye of the operator "sky" adapts to: the geometric mean of ``log_average`` and ``bright``. [cd m-2]
    #[getter]
    fn adaptation(&self) -> f64 {
        self.inner.adaptation()
    }

    /// Exposure value at ISO 100 of automatic exposure, which makes ``log_average`` 0.18.
    #[getter]
    fn ev100(&self) -> f64 {
        exposure::ev100_of_factor(exposure::MIDDLE_GREY / self.inner.log_average.max(tone::DARKNESS))
    }

    /// Exposure value at ISO 100 that a reflected-light meter shows for ``log_average`` (ISO 2720, K = 12.5): 0.79 more than ``ev100``.
    #[getter]
    fn meter_ev100(&self) -> f64 {
        exposure::metered_ev100(self.inner.log_average.max(tone::DARKNESS))
    }

    fn __repr__(&self) -> String {
        format!("<Metering: middle {:.4e} cd/m2, bright {:.4e} cd/m2>", self.inner.log_average, self.inner.bright)
    }
}

/// What ``tone_map`` did to a picture.
#[pyclass(frozen, module = "skyprobe.post")]
pub struct ToneReport {
    metering: Metering,
    adaptation: f64,
    ev100: f64,
    repairs: Repairs,
}

#[pymethods]
impl ToneReport {
    /// Luminances of the picture.
    #[getter]
    fn metering(&self) -> Metering {
        self.metering.clone()
    }

    /// Luminance that the picture was exposed for. [cd m-2]
    #[getter]
    fn adaptation(&self) -> f64 {
        self.adaptation
    }

    /// Exposure value at ISO 100.
    #[getter]
    fn ev100(&self) -> f64 {
        self.ev100
    }

    /// How many values were no light and were repaired: not a number, infinite, denormal.
    #[getter]
    fn repairs(&self) -> (usize, usize, usize) {
        (self.repairs.not_a_number, self.repairs.infinite, self.repairs.denormal)
    }

    fn __repr__(&self) -> String {
        format!("<ToneReport: adapted to {:.4e} cd/m2, EV100 {:.2}>", self.adaptation, self.ev100)
    }
}

/// An eye that takes time, for sequences of pictures without flicker. It follows the logarithm of luminance through two equal stages.
///
/// Parameters
/// ----------
/// light_s, dark_s
///     Time constants of adaptation to light and to darkness, 0.001 to 1e5. [s]
#[pyclass(frozen, module = "skyprobe.post")]
pub struct Adaptation {
    inner: Mutex<tone::Adaptation>,
}

impl Adaptation {
    fn with<T>(&self, use_it: impl FnOnce(&mut tone::Adaptation) -> T) -> T {
        use_it(&mut self.inner.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

#[pymethods]
impl Adaptation {
    #[new]
    #[pyo3(signature = (light_s = 0.5, dark_s = 1.0))]
    fn new(light_s: f64, dark_s: f64) -> PyResult<Self> {
        Ok(Self { inner: Mutex::new(tone::Adaptation::new(light_s, dark_s)?) })
    }

    fn __repr__(&self) -> String {
        let [light_s, dark_s] = self.with(|eye| eye.time_constants_s());
        format!("<Adaptation: light_s {light_s}, dark_s {dark_s}>")
    }

    /// Return a real eye's: 0.4 s towards light, 110 s towards darkness.
    #[staticmethod]
    fn eye() -> Self {
        Self { inner: Mutex::new(tone::Adaptation::eye()) }
    }

    /// Go on by a time during which the picture has this metered luminance, and return what the eye is adapted to then. The first step takes the picture's own.
    ///
    /// Parameters
    /// ----------
    /// luminance
    ///     Such as ``auto_exposure(pixels).adaptation``. [cd m-2]
    /// seconds
    ///     0 to 1e9. [s]
    fn step(&self, luminance: f64, seconds: f64) -> PyResult<f64> {
        Ok(self.with(|eye| eye.step(luminance, seconds))?)
    }

    /// What the eye is adapted to; None before the first step. [cd m-2]
    #[getter]
    fn luminance(&self) -> Option<f64> {
        self.with(|eye| eye.luminance())
    }

    /// Forget all, as at a cut.
    fn reset(&self) {
        self.with(tone::Adaptation::reset);
    }
}

/// What a screen is given.
enum Shown {
    Codes8(Vec<u8>),
    Codes16(Vec<u16>),
    Light(Vec<f32>),
}

/// Bring a picture to a screen: returns the new picture, shape (H, W, 3), and what was done.
///
/// Parameters
/// ----------
/// pixels
///     Linear values, shape (H, W, 3), row 0 at the top. Values that are no light (not a number, infinite) are repaired.
/// operator
///     "sky" (made for skies by day and night), "filmic" (in the manner of AgX), "aces" (fitted), "exposure" (1 - exp(-light)), "reinhard", "reinhard_local",
///     "ashikhmin", "logarithmic" or "linear".
/// exposure_stops
///     Exposure relative to the automatic one, -20 to 20. [stops]
/// ev100
///     Exposure by hand: exposure value at ISO 100, -24 to 36; white is 1.2 * 2**ev100 cd m-2.
/// aperture, shutter_s, iso
///     Exposure as of a camera: f-number, 0.5 to 128; shutter time, 1e-6 to 1e5 [s]; sensitivity, 1 to 1e7.
/// adaptation
///     Luminance that the eye ("sky") or the meter is adapted to, 1e-8 to 1e9; that of the picture by default. [cd m-2]
/// display
///     What shows the picture.
/// bits
///     8 (uint8, dithered; the default), 16 (uint16), or None for the light of the screen, float32 from 0 to 1.
/// projection, field_of_view_deg, rows, scale, white_luminance, color_space
///     As for ``glare``.
/// progress
///     ``progress(stage, fraction)``; returning False raises ``Cancelled``.
/// **numbers
///     Numbers of the operator. sky: key, darkening, rods, blue_shift, acuity_loss, colour_contrast, shoulder; filmic: contrast, inset, power; reinhard: white; reinhard_local:
///     sharpening, threshold, scales; ashikhmin: threshold, largest_scale, stretch; logarithmic: white, middle; linear: white.
#[pyfunction]
#[pyo3(signature = (pixels, operator = "sky", *, exposure_stops = 0.0, ev100 = None, aperture = None, shutter_s = None, iso = 100.0, adaptation = None,
    display = "srgb", bits = Some(8), projection = "perspective", field_of_view_deg = None, rows = "centre", scale = None, white_luminance = None,
    color_space = "lin_rec709", progress = None, **numbers))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub fn tone_map<'py>(
    py: Python<'py>,
    pixels: &Bound<'py, PyAny>,
    operator: &str,
    exposure_stops: f64,
    ev100: Option<f64>,
    aperture: Option<f64>,
    shutter_s: Option<f64>,
    iso: f64,
    adaptation: Option<f64>,
    display: &str,
    bits: Option<u32>,
    projection: &str,
    field_of_view_deg: Option<f64>,
    rows: &str,
    scale: Option<&str>,
    white_luminance: Option<f64>,
    color_space: &str,
    progress: Option<&Bound<'py, PyAny>>,
    numbers: Option<&Bound<'py, PyDict>>,
) -> PyResult<(Bound<'py, PyAny>, ToneReport)> {
    let mut operator: Operator = operator.parse::<OperatorName>()?.into();
    for (name, value) in numbers.into_iter().flat_map(|numbers| numbers.iter()) {
        let name: String = name.extract()?;
        let wrong = |_| InputError::new_err(format!("{name} = {value}: must be a number"));
        operator.set(&name, value.extract().map_err(wrong)?)?;
    }
    let exposure = match (ev100, aperture, shutter_s) {
        (None, None, None) => Exposure::Automatic { stops: exposure_stops },
        _ if exposure_stops != 0.0 => {
            return Err(InputError::new_err(format!("exposure_stops = {exposure_stops}: must be 0 with an exposure by hand")));
        }
        (Some(ev100), None, None) => Exposure::Value { ev100 },
        (None, Some(aperture), Some(shutter_s)) => Exposure::Camera { aperture, shutter_s, iso },
        (Some(ev100), ..) => {
            return Err(InputError::new_err(format!("ev100 = {ev100}: must be None with aperture or shutter_s")));
        }
        (None, Some(_), None) => return Err(InputError::new_err("shutter_s = None: must be given with aperture")),
        (None, None, Some(_)) => return Err(InputError::new_err("aperture = None: must be given with shutter_s")),
    };
    if !matches!(bits, None | Some(8 | 16)) {
        return Err(InputError::new_err(format!("bits = {}: must be 8, 16 or None", bits.unwrap_or_default())));
    }
    let settings = ToneMapping { operator, exposure, adaptation, display: display.parse()? };
    settings.validate()?;
    let mut picture = post::picture(pixels, projection, (rows, field_of_view_deg), (white_luminance, scale), color_space)?;
    let (shown, report) = work::run(py, progress, |progress| {
        let repairs = picture.repair();
        let mapper = ToneMapper::new(&picture, &settings, progress)?;
        let metering = Metering { inner: *mapper.metering() };
        let report = ToneReport { metering, adaptation: mapper.adaptation(), ev100: mapper.ev100(), repairs };
        let shown = match bits {
            Some(8) => Shown::Codes8(mapper.to_8_bits(progress)?),
            Some(_) => Shown::Codes16(mapper.to_16_bits(progress)?),
            None => Shown::Light(mapper.to_linear(progress)?),
        };
        Ok((shown, report))
    })?;
    let shape = [picture.height, picture.width, 3];
    let array = match shown {
        Shown::Codes8(codes) => PyArray1::from_vec(py, codes).reshape(shape)?.into_any(),
        Shown::Codes16(codes) => PyArray1::from_vec(py, codes).reshape(shape)?.into_any(),
        Shown::Light(light) => PyArray1::from_vec(py, light).reshape(shape)?.into_any(),
    };
    Ok((array, report))
}

/// Meter a picture: its luminances, and the exposure that suits them. Parameters as for ``glare``.
#[pyfunction]
#[pyo3(signature = (pixels, *, projection = "perspective", field_of_view_deg = None, rows = "centre", scale = None, white_luminance = None, color_space = "lin_rec709"))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
pub fn auto_exposure(
    py: Python<'_>,
    pixels: &Bound<'_, PyAny>,
    projection: &str,
    field_of_view_deg: Option<f64>,
    rows: &str,
    scale: Option<&str>,
    white_luminance: Option<f64>,
    color_space: &str,
) -> PyResult<Metering> {
    let picture = post::picture(pixels, projection, (rows, field_of_view_deg), (white_luminance, scale), color_space)?;
    work::run(py, None, |_| Ok(Metering { inner: tone::Metering::of(&Frame::from(&picture)) }))
}
