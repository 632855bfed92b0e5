//! `Body`, `Moon`, `RiseAndSet`, `SolarEclipse`, `LunarEclipse`.

use super::results::datetime;
use crate::celestial;
use crate::ephemeris::{self, EarthShadow, MoonState, SurfacePoint};
use crate::time::Time;
use pyo3::prelude::*;

/// A body as it stands in the sky.
#[pyclass(frozen, subclass, module = "skyprobe")]
pub struct Body {
    pub inner: ephemeris::Body,
}

#[pymethods]
impl Body {
    /// English name, such as "Sun".
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// Airless altitude of the centre. [degrees]
    #[getter]
    fn altitude_deg(&self) -> f64 {
        self.inner.altitude_deg
    }

    /// Azimuth from north through east. [degrees]
    #[getter]
    fn azimuth_deg(&self) -> f64 {
        self.inner.azimuth_deg
    }

    /// Altitude of the centre as refraction shows it. [degrees]
    #[getter]
    fn apparent_altitude_deg(&self) -> f64 {
        self.inner.apparent_altitude_deg
    }

    /// Distance from the observer. [au]
    #[getter]
    fn distance_au(&self) -> f64 {
        self.inner.distance_au
    }

    /// Angular diameter without refraction. [degrees]
    #[getter]
    fn angular_diameter_deg(&self) -> f64 {
        self.inner.angular_diameter_deg
    }

    /// Visual magnitude outside the air, where it is known.
    #[getter]
    fn magnitude(&self) -> Option<f64> {
        self.inner.magnitude
    }

    /// Angle at the body between Sun and observer, 0 (full) to 180 (new), of bodies that shine by sunlight. [degrees]
    #[getter]
    fn phase_angle_deg(&self) -> Option<f64> {
        self.inner.phase_angle_deg
    }

    /// Fraction of the disc that is lit, 0 to 1, of bodies that shine by sunlight.
    #[getter]
    fn illuminated_fraction(&self) -> Option<f64> {
        self.inner.illuminated_fraction
    }

    /// Unit vector (east, north, up) to the airless position.
    #[getter]
    fn direction(&self) -> (f64, f64, f64) {
        self.inner.direction().into()
    }

    /// Unit vector (east, north, up) to the refracted position.
    #[getter]
    fn apparent_direction(&self) -> (f64, f64, f64) {
        self.inner.apparent_direction().into()
    }

    fn __repr__(&self) -> String {
        let Self { inner } = self;
        format!("<Body {}: altitude {:.4} deg, azimuth {:.4} deg>", inner.name, inner.altitude_deg, inner.azimuth_deg)
    }
}

/// The Moon as it stands in the sky: a body of which more is known. Its magnitude is that outside the Earth's shadow.
#[pyclass(frozen, extends = Body, module = "skyprobe")]
pub struct Moon {
    state: MoonState,
}

impl Moon {
    pub fn new(py: Python<'_>, state: &MoonState) -> PyResult<Py<Self>> {
        let body = PyClassInitializer::from(Body { inner: state.body.clone() });
        Py::new(py, body.add_subclass(Self { state: state.clone() }))
    }
}

fn longitude_and_latitude(point: SurfacePoint) -> (f64, f64) {
    (point.longitude_deg, point.latitude_deg)
}

#[pymethods]
impl Moon {
    /// Distance from the observer to the Moon's centre. [km]
    #[getter]
    fn distance_km(&self) -> f64 {
        self.state.distance_km()
    }

    /// Angle between Moon and Sun in the sky. [degrees]
    #[getter]
    fn elongation_deg(&self) -> f64 {
        self.state.illumination.elongation_deg
    }

    /// Longitude (positive towards Mare Crisium) and latitude of the point of the Moon that has the observer in its zenith: the topocentric libration.
    /// [degrees]
    #[getter]
    fn sub_observer_deg(&self) -> (f64, f64) {
        longitude_and_latitude(self.state.sub_observer)
    }

    /// Longitude and latitude of the point of the Moon that has the Sun in its zenith. [degrees]
    #[getter]
    fn sub_solar_deg(&self) -> (f64, f64) {
        longitude_and_latitude(self.state.sub_solar)
    }

    /// Position angle of the middle of the bright limb, from celestial north through east. [degrees]
    #[getter]
    fn bright_limb_position_angle_deg(&self) -> f64 {
        self.state.illumination.bright_limb_position_angle_deg
    }

    /// The same from the zenith, counterclockwise as one sees it: 0 is lit from above, 90 from the left. [degrees]
    #[getter]
    fn bright_limb_from_zenith_deg(&self) -> f64 {
        self.state.illumination.bright_limb_from_zenith_deg
    }

    /// Position angle of the Moon's north pole, from celestial north through east. [degrees]
    #[getter]
    fn axis_position_angle_deg(&self) -> f64 {
        self.state.axis_position_angle_deg
    }

    /// The same from the zenith, counterclockwise as one sees it. [degrees]
    #[getter]
    fn axis_from_zenith_deg(&self) -> f64 {
        self.state.axis_from_zenith_deg
    }

    fn __repr__(&self) -> String {
        let MoonState { body, illumination, .. } = &self.state;
        let lit = 100.0 * illumination.illuminated_fraction;
        format!("<Moon: altitude {:.4} deg, azimuth {:.4} deg, {lit:.1} % lit>", body.altitude_deg, body.azimuth_deg)
    }
}

/// When a body rises, stands highest and sets on the local date of a sky, in its zone. What does not happen on that date is None.
///
/// The horizon is level, with 34 arcminutes of refraction; Sun and Moon count with their upper limb.
#[pyclass(frozen, module = "skyprobe")]
pub struct RiseAndSet {
    pub inner: ephemeris::RiseAndSet,
}

impl RiseAndSet {
    fn optional<'py>(py: Python<'py>, time: Option<&Time>) -> PyResult<Option<Bound<'py, PyAny>>> {
        time.map(|time| datetime(py, time)).transpose()
    }
}

#[pymethods]
impl RiseAndSet {
    /// It appears above the horizon.
    #[getter]
    fn rise<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.rise.as_ref())
    }

    /// It passes the meridian above the pole.
    #[getter]
    fn transit<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.transit.as_ref())
    }

    /// Its airless altitude then. [degrees]
    #[getter]
    fn transit_altitude_deg(&self) -> Option<f64> {
        self.inner.transit_altitude_deg
    }

    /// It disappears below the horizon.
    #[getter]
    fn set<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        Self::optional(py, self.inner.set.as_ref())
    }

    /// It is above the horizon when the date begins: with neither rise nor set, all day.
    #[getter]
    fn up_at_midnight(&self) -> bool {
        self.inner.up_at_midnight
    }

    fn __repr__(&self) -> String {
        let text = |time: &Option<Time>| time.as_ref().map_or("None".to_string(), Time::to_string);
        let ephemeris::RiseAndSet { rise, transit, set, .. } = &self.inner;
        format!("<RiseAndSet: rise {}, transit {}, set {}>", text(rise), text(transit), text(set))
    }
}

/// The Moon before the Sun, as seen from the place of a sky at its time, airless, whether the Sun is above the horizon or not.
#[pyclass(frozen, module = "skyprobe")]
pub struct SolarEclipse {
    pub geometry: ephemeris::SolarEclipse,
    pub light: celestial::EclipsedSunlight,
}

#[pymethods]
impl SolarEclipse {
    /// "partial", "annular" or "total", here and now.
    #[getter]
    fn kind(&self) -> &'static str {
        self.geometry.kind()
    }

    /// Covered part of the Sun's diameter; while it is total or annular, the Moon's diameter over the Sun's.
    #[getter]
    fn magnitude(&self) -> f64 {
        self.geometry.magnitude
    }

    /// Covered part of the Sun's area, 0 to 1.
    #[getter]
    fn obscuration(&self) -> f64 {
        self.geometry.obscuration
    }

    /// Part of the Sun's light at 550 nm that is left, 0 to 1: other than 1 - obscuration, because the limb is darker than the middle.
    #[getter]
    fn visible_fraction(&self) -> f64 {
        self.light.visible_fraction(550.0)
    }

    /// Angle between the centres of Sun and Moon. [degrees]
    #[getter]
    fn separation_deg(&self) -> f64 {
        self.geometry.separation_deg
    }

    /// Position angle of the Moon's centre seen from the Sun's, from celestial north through east. [degrees]
    #[getter]
    fn moon_position_angle_deg(&self) -> f64 {
        self.geometry.moon_position_angle_deg
    }

    /// The same from the zenith, counterclockwise as one sees it. [degrees]
    #[getter]
    fn moon_from_zenith_deg(&self) -> f64 {
        self.geometry.moon_from_zenith_deg
    }

    fn __repr__(&self) -> String {
        let Self { geometry, .. } = self;
        format!(
            "<SolarEclipse: {}, magnitude {:.4}, obscuration {:.4}>",
            geometry.kind(),
            geometry.magnitude,
            geometry.obscuration
        )
    }
}

/// The Moon in the Earth's shadow, the same for all places, whether the Moon is above the horizon or not. Angles are seen from the Earth's centre.
#[pyclass(frozen, module = "skyprobe")]
pub struct LunarEclipse {
    pub inner: EarthShadow,
}

#[pymethods]
impl LunarEclipse {
    /// "penumbral", "partial" or "total", now.
    #[getter]
    fn kind(&self) -> &'static str {
        self.inner.kind()
    }

    /// Part of the Moon's diameter that is in the umbra: below 0 outside, 1 and more in totality.
    #[getter]
    fn umbral_magnitude(&self) -> f64 {
        self.inner.umbral_magnitude
    }

    /// Part of the Moon's diameter that is in the penumbra.
    #[getter]
    fn penumbral_magnitude(&self) -> f64 {
        self.inner.penumbral_magnitude
    }

    /// Angular radius of the umbra at the Moon's distance. [degrees]
    #[getter]
    fn umbra_radius_deg(&self) -> f64 {
        self.inner.umbra_radius_deg
    }

    /// Angular radius of the penumbra at the Moon's distance. [degrees]
    #[getter]
    fn penumbra_radius_deg(&self) -> f64 {
        self.inner.penumbra_radius_deg
    }

    /// Angle between the Moon's centre and the axis of the shadow. [degrees]
    #[getter]
    fn moon_axis_angle_deg(&self) -> f64 {
        self.inner.moon_axis_angle_deg
    }

    /// Direction of the shadow's axis from the Moon's centre, from the zenith of the place counterclockwise as one sees it. [degrees]
    #[getter]
    fn axis_from_zenith_deg(&self) -> f64 {
        self.inner.axis_from_zenith_deg
    }

    fn __repr__(&self) -> String {
        let EarthShadow { umbral_magnitude, penumbral_magnitude, .. } = &self.inner;
        format!("<LunarEclipse: {}, umbral {umbral_magnitude:.4}, penumbral {penumbral_magnitude:.4}>", self.inner.kind())
    }
}
