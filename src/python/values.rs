//! Values of Python as JSON, and back.

use super::errors::InputError;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString};
use serde_json::{Map, Value};

/// How deep tables may hold tables.
const DEEPEST: usize = 8;

/// A dictionary as a JSON table.
pub fn table(given: &Bound<'_, PyDict>) -> PyResult<Map<String, Value>> {
    given.iter().map(|(key, value)| entry("", &key, &value, 0)).collect()
}

fn entry(path: &str, key: &Bound<'_, PyAny>, value: &Bound<'_, PyAny>, depth: usize) -> PyResult<(String, Value)> {
    let key: String = key.extract().map_err(|_| InputError::new_err(format!("{path}: must have texts as keys")))?;
    let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
    let value = json(&path, value, depth)?;
    Ok((key, value))
}

/// A value as JSON: None, numbers, texts, paths, dates and times, dictionaries, sequences, and numbers and arrays of numpy.
pub fn json(path: &str, value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
    let wrong = |allowed: &str| {
        let shown: String = value.str().map_or_else(|_| "value".to_owned(), |text| text.to_string()).chars().take(60).collect();
        InputError::new_err(format!("{path} = {shown}: must be {allowed}"))
    };
    if depth > DEEPEST {
        return Err(wrong("a table that is less deep"));
    }
    if value.is_none() {
        return Ok(Value::Null);
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(Value::Bool(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        return value.extract::<i64>().map(Value::from).map_err(|_| wrong("a number of at most 64 bits"));
    }
    if value.is_instance_of::<PyFloat>() {
        let number: f64 = value.extract()?;
        return serde_json::Number::from_f64(number).map(Value::Number).ok_or_else(|| wrong("a finite number"));
    }
    if value.is_instance_of::<PyString>() {
        return value.extract::<String>().map(Value::from).map_err(|_| wrong("a text of valid characters"));
    }
    if let Ok(mapping) = value.cast::<PyMapping>() {
        let mut table = Map::new();
        for item in mapping.items()?.iter() {
            let (key, inner): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
            let (key, inner) = entry(path, &key, &inner, depth + 1)?;
            table.insert(key, inner);
        }
        return Ok(Value::Object(table));
    }
    for method in ["isoformat", "tolist", "__fspath__"] {
        if value.hasattr(method)? {
            return json(path, &value.call_method0(method)?, depth + 1);
        }
    }
    if let Ok(items) = value.try_iter() {
        let items = items.enumerate().map(|(index, item)| json(&format!("{path}[{index}]"), &item?, depth + 1));
        return Ok(Value::Array(items.collect::<PyResult<_>>()?));
    }
    Err(wrong("a number, a text, a list or a dictionary"))
}

/// JSON as values of Python.
pub fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    match value {
        Value::Null => Ok(py.None().into_bound(py)),
        Value::Bool(flag) => flag.into_bound_py_any(py),
        Value::Number(number) => match number.as_i64() {
            Some(whole) => whole.into_bound_py_any(py),
            None => number.as_f64().into_bound_py_any(py),
        },
        Value::String(text) => text.into_bound_py_any(py),
        Value::Array(items) => {
            let items = items.iter().map(|item| object(py, item)).collect::<PyResult<Vec<_>>>()?;
            PyList::new(py, items)?.into_bound_py_any(py)
        }
        Value::Object(table) => {
            let dictionary = PyDict::new(py);
            table.iter().try_for_each(|(key, value)| dictionary.set_item(key, object(py, value)?))?;
            dictionary.into_bound_py_any(py)
        }
    }
}
