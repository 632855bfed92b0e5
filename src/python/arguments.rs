//! Arguments of `Sky` as the library takes them.

use super::arrays;
use super::errors::InputError;
use glam::DVec3;
use pyo3::prelude::*;
use pyo3::types::PyString;

/// Largest departure of a direction's length from 1: what single precision leaves, with room.
const UNIT_TOLERANCE: f64 = 1e-4;

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
