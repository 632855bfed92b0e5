//! `Night`.

use super::pickle::{self, Reduced};
use crate::celestial::Airglow;
use crate::error::{Error, check_range};
use crate::sky::{NightOptions, When};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What of the night is in a sky with place and time, and how bright what varies is.
///
/// Parameters
/// ----------
/// when
///     "auto": Moon and planets always, and while the Sun's centre is below the horizon or the Sun totally eclipsed moonlight in the air, stars and diffuse light too, which by
///     day are less than a thousandth of the light. "always": all of them by day, too. "never": none.
/// star_limit
///     Stars to this magnitude V are drawn one by one, -2 to 8.5; the light of fainter ones is part of the Milky Way.
/// solar_flux_sfu
///     Solar radio flux at 10.7 cm, with which the airglow grows, 60 to 300: 70 at the Sun's minimum, 130 on average, 200 at maximum.
///     [solar flux units]
/// zenith_brightness
///     Brightness of the moonless zenith over a lit country, natural light (22.0) included, 15 to 22. None: no artificial light, unless ``bortle`` is
///     given. [mag arcsec-2]
/// bortle
///     The same as a class of Bortle's scale, 1 (as dark as it gets) to 9 (inner city). At most one of the two is given.
/// led_share
///     Share of the artificial light that comes from white LEDs, 0 to 1; the rest comes from high-pressure sodium lamps.
#[pyclass(frozen, module = "skyprobe")]
pub struct Night {
    pub inner: NightOptions,
}

// Python shows the defaults of signatures only if they are plain numbers.
const _: () = assert!(Airglow::MEAN_SOLAR_FLUX_SFU == 130.0);

#[pymethods]
impl Night {
    #[new]
    #[pyo3(signature = (*, when = "auto", star_limit = 8.5, solar_flux_sfu = 130.0, zenith_brightness = None, bortle = None,
        led_share = 0.5))]
    fn new(
        when: &str,
        star_limit: f64,
        solar_flux_sfu: f64,
        zenith_brightness: Option<f64>,
        bortle: Option<i64>,
        led_share: f64,
    ) -> PyResult<Self> {
        let inner = NightOptions {
            when: when.parse()?,
            star_limit,
            solar_flux_sfu,
            zenith_brightness,
            bortle: bortle.map(class).transpose()?,
            led_share,
        };
        inner.validate()?;
        Ok(Self { inner })
    }

    /// When the lights of the night are in the sky: "auto", "always" or "never".
    #[getter]
    fn when(&self) -> &'static str {
        match self.inner.when {
            When::Auto => "auto",
            When::Always => "always",
            When::Never => "never",
        }
    }

    /// Stars to this magnitude V are drawn one by one.
    #[getter]
    fn star_limit(&self) -> f64 {
        self.inner.star_limit
    }

    /// Solar radio flux at 10.7 cm. [solar flux units]
    #[getter]
    fn solar_flux_sfu(&self) -> f64 {
        self.inner.solar_flux_sfu
    }

    /// Brightness of the zenith with artificial light; None if it was not given. [mag arcsec-2]
    #[getter]
    fn zenith_brightness(&self) -> Option<f64> {
        self.inner.zenith_brightness
    }

    /// Class of Bortle's scale; None if it was not given.
    #[getter]
    fn bortle(&self) -> Option<u8> {
        self.inner.bortle
    }

    /// Share of the artificial light that comes from white LEDs.
    #[getter]
    fn led_share(&self) -> f64 {
        self.inner.led_share
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, night) = (slf.py(), slf.get());
        let keys = PyDict::new(py);
        let given = serde_json::to_value(night.inner).unwrap_or_default();
        for (key, value) in given.as_object().into_iter().flatten() {
            keys.set_item(key, super::values::object(py, value)?)?;
        }
        pickle::call(slf.get_type().as_any(), (), &keys)
    }

    fn __repr__(&self) -> String {
        let NightOptions { star_limit, solar_flux_sfu, zenith_brightness, bortle, led_share, .. } = self.inner;
        let zenith = zenith_brightness.map_or("None".to_string(), |value| format!("{value:?}"));
        let bortle = bortle.map_or("None".to_string(), |value| value.to_string());
        format!(
            "Night(when='{}', star_limit={star_limit:?}, solar_flux_sfu={solar_flux_sfu:?}, zenith_brightness={zenith}, bortle={bortle}, \
             led_share={led_share:?})",
            self.when()
        )
    }
}

/// A class as the library takes it, out of any whole number.
fn class(bortle: i64) -> crate::Result<u8> {
    check_range("night.bortle", bortle as f64, 1.0, 9.0, "")
        .map(|class| class as u8)
        .map_err(|_| Error::input("night.bortle", bortle, "a whole number from 1 to 9"))
}
