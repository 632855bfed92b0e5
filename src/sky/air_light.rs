//! The bodies whose light the air scatters, by wavelength: the Sun, and at night the Moon.

use super::airless::moonlight;
use super::eclipse::Gain;
use super::night::moonlit;
use super::place_and_time::Sky;
use super::sunlight::Sunlight;
use crate::ephemeris::Body;
use crate::error::Result;
use crate::light::LightField;
use crate::progress::Progress;

/// A body that lights the air.
pub(super) struct AirLight<'a> {
    pub body: &'a Body,
    /// Irradiance outside the air that lights it, at the wavelengths that are asked for [W m-2 nm-1].
    pub irradiance: Vec<f64>,
    /// What an eclipse of the Sun does beside dimming all alike.
    pub gain: Option<Gain>,
}

/// The Sun, then the Moon if it lights this sky, with their light at `wavelengths_nm`.
pub(super) fn air_lights<'a>(
    sky: &'a Sky,
    field: &LightField,
    wavelengths_nm: &[f64],
    progress: &Progress,
) -> Result<Vec<AirLight<'a>>> {
    let sunlight = Sunlight::of(sky);
    let sun = AirLight {
        body: sky.sun(),
        irradiance: sunlight.sunlight_in_the_air(wavelengths_nm),
        gain: sunlight.gain_under_eclipse(field, progress)?,
    };
    Ok([Some(sun), moon_in_the_air(sky, wavelengths_nm)?].into_iter().flatten().collect())
}

/// The Moon with its light at `wavelengths_nm`, if it lights the air of this sky.
pub(super) fn moon_in_the_air<'a>(sky: &'a Sky, wavelengths_nm: &[f64]) -> Result<Option<AirLight<'a>>> {
    let Some(bodies) = moonlit(sky) else { return Ok(None) };
    let moonlight = moonlight(sky.moon(bodies)?);
    let sensors = sky.atmosphere().bands(wavelengths_nm);
    let mut irradiance: Vec<f64> = sensors.iter().flat_map(|sensor| sensor.response(&moonlight)).collect();
    irradiance.truncate(wavelengths_nm.len());
    Ok(Some(AirLight { body: &bodies.moon.body, irradiance, gain: None }))
}
