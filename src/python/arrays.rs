//! Array arguments: anything that numpy takes, checked for shape, as plain vectors.

use super::errors::InputError;
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

/// Values in row-major order and their shape.
pub struct Values {
    pub values: Vec<f64>,
    pub shape: Vec<usize>,
}

/// Reads `argument` as an array of floats; `parameter` names it in errors.
pub fn floats(parameter: &str, argument: &Bound<'_, PyAny>) -> PyResult<Values> {
    let py = argument.py();
    let wrong = |reason: String| InputError::new_err(format!("{parameter} = {reason}: must be an array of numbers"));
    let keywords = [("dtype", "float64")].into_py_dict(py)?;
    let array = py
        .import("numpy")?
        .call_method("ascontiguousarray", (argument,), Some(&keywords))
        .map_err(|error| wrong(error.value(py).to_string()))?;
    let array = array.cast_into::<PyArrayDyn<f64>>().map_err(|error| wrong(error.to_string()))?;
    // `ascontiguousarray` makes at least one dimension; a plain number stays recognisable by its original one.
    // Older numpy takes an array of one element for a number, so its dimensions are asked for.
    let scalar = array.len() == 1 && py.import("numpy")?.call_method1("ndim", (argument,))?.extract::<usize>()? == 0;
    let shape = if scalar { Vec::new() } else { array.shape().to_vec() };
    Ok(Values { values: array.try_readonly().map_err(|error| wrong(error.to_string()))?.to_vec()?, shape })
}

/// A vector of any length; a number is one of length 1.
pub fn vector(parameter: &str, argument: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = floats(parameter, argument)?;
    match array.shape.len() {
        0 | 1 => Ok(array.values),
        _ => Err(wrong_shape(parameter, &array.shape, "one dimension, or a number")),
    }
}

/// A vector of `length` values, where a single number stands for all of them.
pub fn vector_or_number(parameter: &str, argument: &Bound<'_, PyAny>, length: usize) -> PyResult<Vec<f64>> {
    let array = floats(parameter, argument)?;
    match array.shape[..] {
        [] => Ok(vec![array.values[0]; length]),
        [n] if n == length => Ok(array.values),
        _ => Err(wrong_shape(parameter, &array.shape, &format!("shape ({length},), or a number"))),
    }
}

/// Checks that `array` is a matrix of the given shape.
pub fn expect_matrix(parameter: &str, array: &Values, rows: usize, columns: usize) -> PyResult<()> {
    if array.shape == [rows, columns] {
        return Ok(());
    }
    Err(wrong_shape(parameter, &array.shape, &format!("shape ({rows}, {columns}): altitudes, wavelengths")))
}

/// Checks that `array` is a row of `columns` values, or at least one such row.
pub fn expect_rows(parameter: &str, array: &Values, columns: usize) -> PyResult<()> {
    match array.shape[..] {
        [n] if n == columns => Ok(()),
        [rows, n] if n == columns && rows > 0 => Ok(()),
        _ => Err(wrong_shape(parameter, &array.shape, &format!("shape ({columns},) or (W, {columns})"))),
    }
}

/// Vectors of three components, shape (N, 3); a single one may come without the first dimension.
pub fn triples(parameter: &str, argument: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; 3]>> {
    triples_or_one(parameter, argument).map(|(triples, _)| triples)
}

/// The same, and whether it was a single one without the first dimension.
pub fn triples_or_one(parameter: &str, argument: &Bound<'_, PyAny>) -> PyResult<(Vec<[f64; 3]>, bool)> {
    let array = floats(parameter, argument)?;
    match array.shape[..] {
        [3] | [_, 3] => {
            let triples = array.values.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect();
            Ok((triples, array.shape.len() == 1))
        }
        _ => Err(wrong_shape(parameter, &array.shape, "shape (N, 3)")),
    }
}

fn wrong_shape(parameter: &str, shape: &[usize], allowed: &str) -> PyErr {
    let shape = shape.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    InputError::new_err(format!("{parameter} = array of shape ({shape}): must be an array of {allowed}"))
}
