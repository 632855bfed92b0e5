//! Arguments of `Sky` as the library takes them.

use super::arrays;
use super::errors::InputError;
use crate::error::check_range;
use crate::probe::{self, ProbeSettings};
use crate::sky::{Layer, LayerScales};
use glam::DVec3;
use pyo3::prelude::*;
use pyo3::types::{PyMapping, PyString};

/// Largest departure of a direction's length from 1: what single precision leaves, with room.
const UNIT_TOLERANCE: f64 = 1e-4;

/// Factors by the names of layers.
pub fn layer_scales(layers: &Bound<'_, PyMapping>) -> PyResult<LayerScales> {
    let factor = |item: Bound<'_, PyAny>| {
        let (name, factor): (String, f64) = item.extract()?;
        Ok((name.parse::<Layer>()?, factor))
    };
    Ok(LayerScales(layers.items()?.iter().map(factor).collect::<PyResult<_>>()?))
}

/// The settings that names and numbers ask for: (projection, rows, extent, ground), (sun_disc, moon_disc), (scale, color_space, gamut).
pub fn probe_settings(
    width: i64,
    layout: [&str; 4],
    turn_deg: f64,
    discs: [bool; 2],
    colour: [&str; 3],
) -> PyResult<ProbeSettings> {
    let ([projection, rows, extent, ground], [sun_disc, moon_disc], [scale, color_space, gamut]) = (layout, discs, colour);
    let (low, high) = (probe::MIN_WIDTH as f64, probe::MAX_WIDTH as f64);
    let settings = ProbeSettings {
        width: check_range("width", width as f64, low, high, "pixels")? as usize,
        projection: projection.parse()?,
        rows: rows.parse()?,
        extent: extent.parse()?,
        turn_deg,
        ground: ground.parse()?,
        sun_disc,
        moon_disc,
        scale: scale.parse()?,
        color_space: color_space.parse()?,
        gamut: gamut.parse()?,
    };
    settings.validate()?;
    Ok(settings)
}

/// A time as text: a `str` as it is, an aware `datetime` or a `date` in ISO 8601.
pub fn time_text(time: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(text) = time.cast::<PyString>() {
        return Ok(text.to_string());
    }
    let wrong = |allowed: &str| InputError::new_err(format!("time = {time}: must be {allowed}"));
    let datetime = time.py().import("datetime")?;
    if !time.is_instance(&datetime.getattr("datetime")?)? {
        if time.is_instance(&datetime.getattr("date")?)? {
            return time.call_method0("isoformat")?.extract();
        }
        return Err(wrong("a text or a datetime.datetime or datetime.date"));
    }
    if time.call_method0("utcoffset")?.is_none() {
        return Err(wrong("a datetime with a time zone (tzinfo); a local time of the place is given as text"));
    }
    time.call_method0("isoformat")?.extract()
}

pub fn unit_vectors(directions: &Bound<'_, PyAny>) -> PyResult<Vec<DVec3>> {
    let directions = arrays::triples("directions", directions)?;
    directions
        .into_iter()
        .enumerate()
        .map(|(index, direction)| {
            let direction = DVec3::from(direction);
            // Written so that not-a-number fails.
            if (direction.length() - 1.0).abs() <= UNIT_TOLERANCE {
                return Ok(direction.normalize());
            }
            let DVec3 { x, y, z } = direction;
            Err(InputError::new_err(format!("directions[{index}] = ({x}, {y}, {z}): must be a vector of length 1")))
        })
        .collect()
}

/// Vectors (east, north, up) of any length but 0, and whether a single one came without the first dimension.
pub fn vectors(parameter: &str, given: &Bound<'_, PyAny>) -> PyResult<(Vec<DVec3>, bool)> {
    let (triples, alone) = arrays::triples_or_one(parameter, given)?;
    let vectors: Vec<DVec3> = triples.into_iter().map(DVec3::from).collect();
    match vectors.iter().position(|vector| !vector.is_finite() || *vector == DVec3::ZERO) {
        None => Ok((vectors, alone)),
        Some(index) => {
            let DVec3 { x, y, z } = vectors[index];
            let name = if alone { parameter.to_owned() } else { format!("{parameter}[{index}]") };
            Err(InputError::new_err(format!("{name} = ({x}, {y}, {z}): must be a vector (east, north, up) longer than 0")))
        }
    }
}
