//! `Sky`.

use super::air::Atmosphere;
use super::arguments::{time_text, unit_vectors};
use super::arrays;
use super::bodies::{Body, LunarEclipse, Moon, RiseAndSet, SolarEclipse};
use super::docstrings::docstring;
use super::errors::{InputError, SunlightOnlyWarning, TimeWarning};
use super::filter::PolarisingFilter;
use super::night::Night;
use super::pickle::{self, Reduced};
use super::probe::Probe;
use super::results::{Illuminance, Irradiance, SunEvents, datetime};
use super::scene::Scene;
use super::{fork, pictures, work};
use crate::ephemeris::{self, Place, SunModel, next_moon_phases};
use crate::probe::ProbeSettings;
use crate::scene::{self, time_at};
use crate::sky::{self, Layer, LightOptions, Model};
use crate::time::Time;
use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ffi::CString;
use std::path::PathBuf;
use std::sync::Arc;

/// An atmosphere seen from a place at a time.
///
/// Parameters
/// ----------
/// latitude
///     Geodetic, north positive, -90 to 90. [degrees]
/// longitude
///     East positive, -180 to 180. [degrees]
/// time
///     ISO 8601 text, an aware ``datetime``, or a ``date``, which is its noon. A text without offset is local time in ``zone``; it may be a date alone
///     or "now". What has to be assumed (clocks show it never or twice, noon) is a :class:`TimeWarning`, and ``time_notice``.
/// atmosphere
///     The air; None for ``Atmosphere()``, the clear one, which is solved once in a process.
/// elevation_m
///     Height of the observer above the sea, -500 to 60000. [m]
/// zone
///     IANA time zone, such as "Europe/Stockholm"; by default the zone of the place, found offline.
/// sun_model
///     By which theory Sun and Moon stand where they do: "iau" (IAU, ELP/MPP02), or "thesis" (low precision, the Moon without parallax: eclipses are a
///     degree off).
/// model
///     By which model the sky is rendered: "scattering" (solved light: day, twilight, night) "preetham" (the analytic sky of 1999, by day at
///     turbidities from 2 to 10), "thesis" or "thesis_single" (ray marching with random steps, light scattered at most twice or once:
///     noisy, for small images). Spectra, irradiance and illuminance are those of "scattering", and the others know no night.
/// night
///     What of the night is in the sky; None for ``Night()``.
#[pyclass(frozen, module = "skyprobe")]
pub struct Sky {
    pub inner: Arc<sky::Sky>,
    air: Py<Atmosphere>,
    pub sun_model: SunModel,
    pub model: Model,
}

#[pymethods]
impl Sky {
    #[new]
    #[pyo3(signature = (*, latitude, longitude, time, atmosphere = None, elevation_m = 0.0, zone = None, sun_model = "iau",
        model = "scattering", night = None))]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        py: Python<'_>,
        latitude: f64,
        longitude: f64,
        time: &Bound<'_, PyAny>,
        atmosphere: Option<Bound<'_, Atmosphere>>,
        elevation_m: f64,
        zone: Option<&str>,
        sun_model: &str,
        model: &str,
        night: Option<PyRef<'_, Night>>,
    ) -> PyResult<Self> {
        fork::check()?;
        let atmosphere = atmosphere.map_or_else(|| Atmosphere::usual(py), Ok)?;
        let place = Place::new(latitude, longitude, elevation_m)?;
        let time = time_at(&place, &time_text(time)?, zone)?;
        let (sun_model, model) = (sun_model.parse()?, model.parse()?);
        let night = night.map(|night| night.inner).unwrap_or_default();
        let inner = sky::Sky::new(place, time, sun_model, atmosphere.get().inner.clone())?.with_night(night)?;
        Self::of(py, inner, atmosphere.unbind(), sun_model, model)
    }

    /// The sky under a Sun that is put, without place and time, and so without Moon, stars and the other lights of the night.
    ///
    /// Parameters
    /// ----------
    /// altitude_deg
    ///     Airless, -90 to 90. [degrees]
    /// azimuth_deg
    ///     From north through east. [degrees]
    /// atmosphere
    ///     The air; None for ``Atmosphere()``, the clear one, which is solved once in a process.
    /// elevation_m
    ///     Height of the observer above the sea, -500 to 60000. [m]
    /// model
    ///     As for ``Sky``.
    #[staticmethod]
    #[pyo3(signature = (*, altitude_deg, azimuth_deg, atmosphere = None, elevation_m = 0.0, model = "scattering"))]
    fn with_sun(
        py: Python<'_>,
        altitude_deg: f64,
        azimuth_deg: f64,
        atmosphere: Option<Bound<'_, Atmosphere>>,
        elevation_m: f64,
        model: &str,
    ) -> PyResult<Self> {
        fork::check()?;
        let model = model.parse()?;
        let atmosphere = atmosphere.map_or_else(|| Atmosphere::usual(py), Ok)?;
        let inner = sky::Sky::with_sun(altitude_deg, azimuth_deg, elevation_m, atmosphere.get().inner.clone())?;
        Ok(Self { inner: Arc::new(inner), air: atmosphere.unbind(), sun_model: SunModel::default(), model })
    }

    /// The scene that makes this sky again, with the picture that ``render`` makes by default; None if its air was given as a profile.
    #[getter]
    fn scene(&self) -> Option<Scene> {
        let light = LightOptions { model: self.model, ..LightOptions::default() };
        let inner = scene::Scene::of(&self.inner, self.sun_model, &light, &ProbeSettings::default())?;
        Some(Scene { inner })
    }

    /// Latitude of the place. [degrees]
    #[getter]
    fn latitude(&self) -> Option<f64> {
        self.inner.place().map(|place| place.latitude_deg)
    }

    /// Longitude of the place. [degrees]
    #[getter]
    fn longitude(&self) -> Option<f64> {
        self.inner.place().map(|place| place.longitude_deg)
    }

    /// By which model the sky is rendered.
    #[getter]
    fn model(&self) -> &'static str {
        self.model.name()
    }

    /// Height of the observer above the sea. [m]
    #[getter]
    fn elevation_m(&self) -> f64 {
        self.inner.elevation_m()
    }

    /// The time, with its offset.
    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        self.inner.time().map(|time| datetime(py, time)).transpose()
    }

    /// What had to be assumed about the time, in a sentence: that clocks show it never or twice and which instant is taken, that a date alone is its
    /// noon, that a second 60 is the one before; None for a time that says all.
    #[getter]
    fn time_notice(&self) -> Option<&str> {
        self.inner.time().and_then(Time::notice)
    }

    /// IANA zone of the time; None for a fixed offset.
    #[getter]
    fn zone(&self) -> Option<String> {
        self.inner.time().and_then(|time| time.zone_name().map(str::to_string))
    }

    /// The air.
    #[getter]
    fn atmosphere(&self, py: Python<'_>) -> Py<Atmosphere> {
        self.air.clone_ref(py)
    }

    /// The Sun.
    #[getter]
    fn sun(&self) -> Body {
        Body { inner: self.inner.sun().clone() }
    }

    /// The Moon; None for a sky without place and time.
    #[getter]
    fn moon(&self, py: Python<'_>) -> PyResult<Option<Py<Moon>>> {
        self.inner.bodies_of_place().map(|bodies| Moon::new(py, &bodies.moon)).transpose()
    }

    /// What of the night is in this sky; None for a sky without place and time.
    #[getter]
    fn night(&self) -> Option<Night> {
        self.inner.place().map(|_| Night { inner: *self.inner.night() })
    }

    /// Names of the layers that the light of this sky is made of, of "sky" (light scattered by the air, and the ground), "sun", "moon", "stars",
    /// "planets", "milky_way", "zodiacal", "airglow" and "light_pollution". They are the keys of ``layers`` in ``render``.
    #[getter]
    fn layer_names(&self) -> Vec<&'static str> {
        self.inner.layers_by(self.model).into_iter().map(Layer::name).collect()
    }

    /// Sun, Moon and planets from Mercury to Neptune, above and below the horizon, the Moon as a ``Moon``; of a Sun that is put, that Sun alone.
    fn bodies(&self, py: Python<'_>) -> PyResult<Vec<Py<Body>>> {
        let body = |inner: &ephemeris::Body| Py::new(py, Body { inner: inner.clone() });
        let Some(bodies) = self.inner.bodies_of_place() else { return Ok(vec![body(self.inner.sun())?]) };
        let moon = Moon::new(py, &bodies.moon)?.into_bound(py).into_super().unbind();
        let mut all = vec![body(&bodies.sun)?, moon];
        for planet in &bodies.planets {
            all.push(body(&planet.body)?);
        }
        Ok(all)
    }

    /// Sunrise, sunset, twilights and noon on the local date of this sky's time.
    fn sun_events(&self, py: Python<'_>) -> PyResult<SunEvents> {
        let (place, time) = self.place_and_time()?;
        let inner = work::apart(py, || ephemeris::sun_events(place, time))?;
        Ok(SunEvents { inner })
    }

    /// Where a body stands at other times, from the same place through the same air, shape (N, 3): airless altitude, azimuth from north through
    /// east, apparent altitude. [degrees]
    ///
    /// Parameters
    /// ----------
    /// name
    ///     Name of one of ``bodies()``, such as "Sun" or "Moon", in any case.
    /// times
    ///     Seconds since 1970 as ``datetime.timestamp()`` gives them, within the years 1000 to 3000, shape (N,). [s]
    ///
    /// Each time costs some 0.2 ms on one core; the Sun of a sky with ``sun_model="thesis"`` (within 0.02 degrees) under a microsecond.
    fn positions<'py>(&self, py: Python<'py>, name: &str, times: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (place, _) = self.place_and_time()?;
        let target = name.parse()?;
        let seconds = arrays::vector("times", times)?;
        let positions = work::apart(py, || {
            let times = seconds.into_iter().map(Time::from_unix_seconds).collect::<crate::Result<Vec<_>>>()?;
            Ok::<_, crate::Error>(ephemeris::positions(target, place, &times, self.sun_model, self.inner.refraction()))
        })?;
        let rows = positions.iter().flat_map(|p| [p.altitude_deg, p.azimuth_deg, p.apparent_altitude_deg]);
        PyArray1::from_iter(py, rows).reshape([positions.len(), 3])
    }

    /// When a body rises, stands highest and sets on the local date of this sky's time.
    ///
    /// Parameters
    /// ----------
    /// name
    ///     Name of one of ``bodies()``, such as "Moon" or "Venus", in any case.
    fn rise_and_set(&self, py: Python<'_>, name: &str) -> PyResult<RiseAndSet> {
        let (place, time) = self.place_and_time()?;
        let target = name.parse()?;
        let inner = work::apart(py, || ephemeris::rise_and_set(target, place, time))?;
        Ok(RiseAndSet { inner })
    }

    /// The next four phases of the Moon after this sky's time, in the order of their dates: name ("new", "first quarter", "full", "last quarter") and
    /// when, the same for all places.
    fn moon_phases<'py>(&self, py: Python<'py>) -> PyResult<Vec<(&'static str, Bound<'py, PyAny>)>> {
        let (_, time) = self.place_and_time()?;
        let phases = work::apart(py, || next_moon_phases(time))?;
        phases.iter().map(|(phase, time)| Ok((phase.name(), datetime(py, time)?))).collect()
    }

    /// How the Moon stands before the Sun; None if it does not.
    #[getter]
    fn solar_eclipse(&self) -> Option<SolarEclipse> {
        Some(SolarEclipse { geometry: self.inner.solar_eclipse()?, light: *self.inner.eclipsed_sunlight()? })
    }

    /// How the Moon stands in the Earth's shadow; None if no part of it does.
    #[getter]
    fn lunar_eclipse(&self) -> Option<LunarEclipse> {
        Some(LunarEclipse { inner: self.inner.bodies_of_place()?.lunar_eclipse()? })
    }

    /// Spectral radiance of sky and ground, shape (N, W). [W m-2 sr-1 nm-1]
    ///
    /// It is that of the pictures of this sky, night and all: light of the Sun and of the Moon in the air, zodiacal light, Milky Way, airglow, light of towns.
    /// Discs (Sun, Moon) and points (stars, planets) have no radiance in a direction and are left out; ``irradiance`` has them. Lights are means over 10 nm.
    ///
    /// A sky without place and time has the light of its Sun alone; with the Sun below -18 degrees a ``SunlightOnlyWarning`` says so, unless the sky's night is
    /// ``Night(when="never")``.
    ///
    /// Parameters
    /// ----------
    /// directions
    ///     Unit vectors (east, north, up) that one looks along, shape (N, 3).
    /// wavelengths_nm
    ///     Shape (W,), within the atmosphere's wavelengths. [nm]
    /// progress
    ///     Called with stage and fraction; returning False raises Cancelled.
    #[pyo3(signature = (directions, wavelengths_nm, *, progress = None))]
    fn spectral_radiance<'py>(
        &self,
        py: Python<'py>,
        directions: &Bound<'py, PyAny>,
        wavelengths_nm: &Bound<'py, PyAny>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let directions = unit_vectors(directions)?;
        let wavelengths_nm = arrays::vector("wavelengths_nm", wavelengths_nm)?;
        let shape = [directions.len(), wavelengths_nm.len()];
        self.warn_of_a_low_sun(py, "spectral_radiance")?;
        let radiance = work::run(py, progress, |progress| self.inner.spectral_radiance(&directions, &wavelengths_nm, progress))?;
        PyArray1::from_vec(py, radiance).reshape(shape)
    }

    /// Stokes parameters I, Q, U of sky and ground, shape (N, W, 3). [W m-2 sr-1 nm-1]
    ///
    /// Q > 0 is polarised vertically, in the plane of the direction and the zenith; U > 0 along the line 45 degrees clockwise from the vertical
    /// as one sees it. The degree of linear polarisation is hypot(Q, U) / I, and the angle of the vibration from the vertical, clockwise,
    /// arctan2(U, Q) / 2. Circular polarisation is neglected.
    ///
    /// The light is that of ``spectral_radiance``, which is I. The air polarises moonlight as it does sunlight; zodiacal light, Milky Way, airglow and light of towns are
    /// taken as unpolarised.
    ///
    /// A sky without place and time has the light of its Sun alone; with the Sun below -18 degrees a ``SunlightOnlyWarning`` says so, unless the sky's night is
    /// ``Night(when="never")``.
    ///
    /// Parameters
    /// ----------
    /// directions
    ///     Unit vectors (east, north, up) that one looks along, shape (N, 3).
    /// wavelengths_nm
    ///     Shape (W,), within the atmosphere's wavelengths. [nm]
    /// progress
    ///     Called with stage and fraction; returning False raises Cancelled.
    #[pyo3(signature = (directions, wavelengths_nm, *, progress = None))]
    fn stokes<'py>(
        &self,
        py: Python<'py>,
        directions: &Bound<'py, PyAny>,
        wavelengths_nm: &Bound<'py, PyAny>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let directions = unit_vectors(directions)?;
        let wavelengths_nm = arrays::vector("wavelengths_nm", wavelengths_nm)?;
        let shape = [directions.len(), wavelengths_nm.len(), 3];
        self.warn_of_a_low_sun(py, "stokes")?;
        let stokes = work::run(py, progress, |progress| self.inner.stokes(&directions, &wavelengths_nm, progress))?;
        PyArray1::from_vec(py, stokes).reshape(shape)
    }

    /// Light of parts of the lines of sight: the transmittance from the observer to distances, and the radiance that the air before them scatters to the
    /// observer, two arrays of shape (N, D, W). [1, W m-2 sr-1 nm-1]
    ///
    /// A surface of radiance L at a distance is seen as L times the transmittance plus the radiance: this is aerial perspective. A line of sight ends on the ground or in space, and
    /// distances beyond find what its end has; the light of the ground is not in it. The transmittance is that of light that is neither scattered nor absorbed: what haze turns into the line of sight from beside it is in the radiance, with the clear sky's light around the line.
    ///
    /// The radiance is light of the Sun and, at night, of the Moon. Where the air scatters other light, at night and in a total eclipse, a ``SunlightOnlyWarning`` says so, unless the sky's night is
    /// ``Night(when="never")``; in a sky without place and time, if the Sun is below -18 degrees.
    ///
    /// Parameters
    /// ----------
    /// directions
    ///     Unit vectors (east, north, up) that one looks along, shape (N, 3).
    /// distances_m
    ///     From the observer along the line of sight, 0 to infinity, in any order, shape (D,) or a number. [m]
    /// wavelengths_nm
    ///     Shape (W,), within the atmosphere's wavelengths. [nm]
    /// progress
    ///     Called with stage and fraction; returning False raises Cancelled.
    #[pyo3(signature = (directions, distances_m, wavelengths_nm, *, progress = None))]
    #[allow(clippy::type_complexity, reason = "two arrays")]
    fn segment<'py>(
        &self,
        py: Python<'py>,
        directions: &Bound<'py, PyAny>,
        distances_m: &Bound<'py, PyAny>,
        wavelengths_nm: &Bound<'py, PyAny>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyArray3<f64>>, Bound<'py, PyArray3<f64>>)> {
        let directions = unit_vectors(directions)?;
        let distances_m = arrays::vector("distances_m", distances_m)?;
        let wavelengths_nm = arrays::vector("wavelengths_nm", wavelengths_nm)?;
        let shape = [directions.len(), distances_m.len(), wavelengths_nm.len()];
        self.warn_of_the_night(py, "segment")?;
        let light = work::run(py, progress, |progress| self.inner.segment(&directions, &distances_m, &wavelengths_nm, progress))?;
        let array = |values| PyArray1::from_vec(py, values).reshape(shape);
        Ok((array(light.transmittance)?, array(light.in_scattered_radiance)?))
    }

    /// Spectral irradiance of Sun, Moon and sky, with all that shines in it. [W m-2 nm-1]
    ///
    /// Stars and planets are part of the sky at night; by day planets, a billionth of the light, are left out.
    ///
    /// A sky without place and time has the light of its Sun alone; with the Sun below -18 degrees a ``SunlightOnlyWarning`` says so, unless the sky's night is
    /// ``Night(when="never")``.
    ///
    /// Parameters
    /// ----------
    /// wavelengths_nm
    ///     Shape (W,), within the atmosphere's wavelengths. [nm]
    /// progress
    ///     Called with stage and fraction; returning False raises Cancelled.
    #[pyo3(signature = (wavelengths_nm, *, progress = None))]
    fn irradiance(
        &self,
        py: Python<'_>,
        wavelengths_nm: &Bound<'_, PyAny>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Irradiance> {
        let wavelengths_nm = arrays::vector("wavelengths_nm", wavelengths_nm)?;
        self.warn_of_a_low_sun(py, "irradiance")?;
        let irradiance = work::run(py, progress, |progress| self.inner.irradiance(&wavelengths_nm, progress))?;
        Ok(Irradiance::new(py, irradiance))
    }

    /// Illuminance of Sun, Moon and sky, with all that shines in it. [lx]
    #[pyo3(signature = (*, progress = None))]
    fn illuminance(&self, py: Python<'_>, progress: Option<&Bound<'_, PyAny>>) -> PyResult<Illuminance> {
        let inner = work::run(py, progress, |progress| self.inner.illuminance(progress))?;
        Ok(Illuminance { inner })
    }

    /// Irradiance of the Sun's disc, at a total eclipse of its corona, on a plane that faces it, in the units of a probe with this scale and colour space times sr.
    ///
    /// ``gamut`` says what happens to a colour outside the space, as in ``render``: a Sun below some 2.5 degrees (clear air; higher in haze) is redder than Rec. 709. A lamp with this colour belongs where the disc is
    /// seen, at ``sun.apparent_altitude_deg``.
    #[pyo3(signature = (*, scale = "blender", color_space = "lin_rec709", gamut = "desaturate", progress = None))]
    fn sun_irradiance_rgb(
        &self,
        py: Python<'_>,
        scale: &str,
        color_space: &str,
        gamut: &str,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(f64, f64, f64)> {
        let (scale, color_space, gamut) = (scale.parse()?, color_space.parse()?, gamut.parse()?);
        let rgb = work::run(py, progress, |progress| self.inner.sun_irradiance_rgb(scale, color_space, gamut, progress))?;
        Ok(rgb.into())
    }

    /// Irradiance of the Moon's disc on a plane that faces it, as ``sun_irradiance_rgb``; zeros if the Moon is below the horizon or the night is never
    /// shown.
    #[pyo3(signature = (*, scale = "blender", color_space = "lin_rec709", gamut = "desaturate", progress = None))]
    fn moon_irradiance_rgb(
        &self,
        py: Python<'_>,
        scale: &str,
        color_space: &str,
        gamut: &str,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<(f64, f64, f64)> {
        let (scale, color_space, gamut) = (scale.parse()?, color_space.parse()?, gamut.parse()?);
        let rgb = work::run(py, progress, |progress| self.inner.moon_irradiance_rgb(scale, color_space, gamut, progress))?;
        Ok(rgb.into())
    }

    #[doc = docstring!(Sky.render)]
    #[pyo3(signature = (*, polarising_filter = None, progress = None, **parameters), text_signature = None)]
    fn render(
        &self,
        py: Python<'_>,
        polarising_filter: Option<PyRef<'_, PolarisingFilter>>,
        progress: Option<&Bound<'_, PyAny>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Probe> {
        pictures::render(py, self, polarising_filter.as_ref(), parameters, progress)
    }

    #[doc = docstring!(Sky.render_to_file)]
    #[pyo3(signature = (path, *, polarising_filter = None, separate_layers = false, half = None, progress = None, **parameters),
        text_signature = None)]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments")]
    fn render_to_file(
        &self,
        py: Python<'_>,
        path: PathBuf,
        polarising_filter: Option<PyRef<'_, PolarisingFilter>>,
        separate_layers: bool,
        half: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<()> {
        let of_file = (half, separate_layers);
        pictures::render_to_file(py, self, &path, of_file, polarising_filter.as_ref(), parameters, progress)
    }

    /// A picture of the directions in which the light of a probe is gathered, to look at: latitude-longitude, 8-bit sRGB, shape (H, W, 3), white points
    /// on the darkened sky. They lie on one side of the Sun, as the other follows by symmetry.
    ///
    /// Parameters
    /// ----------
    /// width
    ///     Even, 64 to 16384. [pixels]
    /// turn_deg, polarising_filter, tolerance
    ///     As for ``render``.
    /// progress
    ///     Called with stage and fraction; returning False raises Cancelled.
    #[pyo3(signature = (*, width = 1024, turn_deg = 0.0, polarising_filter = None, tolerance = None, progress = None))]
    fn sample_map<'py>(
        &self,
        py: Python<'py>,
        width: i64,
        turn_deg: f64,
        polarising_filter: Option<PyRef<'py, PolarisingFilter>>,
        tolerance: Option<f64>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        pictures::sample_map(py, self, (width, turn_deg), polarising_filter.as_ref(), tolerance, progress)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, class, sky) = (slf.py(), slf.get_type(), slf.get());
        let keys = PyDict::new(py);
        keys.set_item("atmosphere", &sky.air)?;
        keys.set_item("elevation_m", sky.inner.elevation_m())?;
        keys.set_item("model", sky.model.name())?;
        let (Some(place), Some(time)) = (sky.inner.place(), sky.inner.time()) else {
            keys.set_item("altitude_deg", sky.inner.sun().altitude_deg)?;
            keys.set_item("azimuth_deg", sky.inner.sun().azimuth_deg)?;
            return pickle::call(&class.getattr("with_sun")?, (), &keys);
        };
        keys.set_item("latitude", place.latitude_deg)?;
        keys.set_item("longitude", place.longitude_deg)?;
        keys.set_item("time", time.to_string())?;
        keys.set_item("zone", time.zone_name())?;
        keys.set_item("sun_model", sky.sun_model.name())?;
        keys.set_item("night", Night { inner: *sky.inner.night() })?;
        pickle::call(class.as_any(), (), &keys)
    }

    fn __repr__(&self) -> String {
        let sun = self.inner.sun();
        let sun = format!("Sun at altitude {:.3} deg, azimuth {:.3} deg", sun.altitude_deg, sun.azimuth_deg);
        match (self.inner.place(), self.inner.time()) {
            (Some(place), Some(time)) => {
                format!("<Sky: latitude {}, longitude {}, {time}, {sun}>", place.latitude_deg, place.longitude_deg)
            }
            _ => format!("<Sky: {sun}>"),
        }
    }
}

impl Sky {
    /// A sky of the library; what had to be assumed about its time is warned of.
    pub fn of(py: Python<'_>, inner: sky::Sky, air: Py<Atmosphere>, sun_model: SunModel, model: Model) -> PyResult<Self> {
        if let Some(notice) = inner.time().and_then(Time::notice) {
            let message = CString::new(format!("time: {notice}"))?;
            PyErr::warn(py, &py.get_type::<TimeWarning>(), &message, 1)?;
        }
        Ok(Self { inner: Arc::new(inner), air, sun_model, model })
    }

    /// Says that spectra that have the night are of sunlight alone, because the sky has no place and time, where that matters.
    fn warn_of_a_low_sun(&self, py: Python<'_>, method: &str) -> PyResult<()> {
        match self.inner.place() {
            Some(_) => Ok(()),
            None => self.warn_of_the_night(py, method),
        }
    }

    /// Says that what `method` gives lacks the light of the night, where that matters.
    fn warn_of_the_night(&self, py: Python<'_>, method: &str) -> PyResult<()> {
        if !self.inner.has_more_than_sunlight() {
            return Ok(());
        }
        let altitude = self.inner.sun().altitude_deg;
        let (light, elsewhere) = match self.inner.place() {
            Some(_) => (
                "the light of Sun and Moon",
                "stars, airglow and towns are not in it (spectral_radiance() has them, and Night(when=\"never\") leaves them out of all)",
            ),
            None => (
                "sunlight",
                "Moon, stars, airglow and the other lights of the night are not in it (a sky without place and time has none of them)",
            ),
        };
        let message = format!("{method}: of {light} alone, with the Sun at {altitude:.2} degrees; {elsewhere}");
        let message = std::ffi::CString::new(message).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<SunlightOnlyWarning>(), &message, 1)
    }

    fn place_and_time(&self) -> PyResult<(&Place, &Time)> {
        match (self.inner.place(), self.inner.time()) {
            (Some(place), Some(time)) => Ok((place, time)),
            _ => Err(InputError::new_err("sky = with_sun(...): must be a sky with place and time")),
        }
    }
}
