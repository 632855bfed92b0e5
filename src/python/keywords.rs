//! Keyword arguments that the table of parameters has: read and judged by their rows, so that a new row needs nothing here.

use super::{arrays, values};
use crate::error::{Error, Result, quoted};
use crate::parameter::{Checked, DefaultValue, Kind, Parameter};
use crate::scene::calls::{Argument, Call};
use crate::scene::{face, json};
use crate::words;
use pyo3::PyClass;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyDict, PyMapping, PyTuple, PyType};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// What was given for a call, by tables of the scene, as JSON.
pub struct Keywords(BTreeMap<&'static str, Map<String, Value>>);

impl Keywords {
    /// Reads what was given for the rows of `call`.
    ///
    /// A name that the call does not have is a `TypeError` as of any call in Python, a value out of range an `InputError`.
    pub fn read(call: &'static Call, given: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut tables = BTreeMap::<_, Map<String, Value>>::new();
        let arguments = call.arguments();
        for (key, value) in given.into_iter().flatten() {
            let key: String = key.extract()?;
            let row = arguments.iter().find_map(|argument| match argument {
                Argument::Row(row) if row.name == key => Some(row),
                _ => None,
            });
            let Some(row) = row else { return Err(unexpected(call, &arguments, &key, value.py())) };
            // None is what is left out.
            let value = read(row, &value)?;
            if !value.is_null() {
                tables.entry(row.table).or_default().insert(key, value);
            }
        }
        Ok(Self(tables))
    }

    /// What was given for a table of the scene.
    pub fn value(&mut self, table: &str) -> Value {
        Value::Object(self.0.remove(table).unwrap_or_default())
    }

    /// The same as a struct, by the reader of scenes.
    pub fn table<T: DeserializeOwned>(&mut self, table: &str) -> Result<T> {
        json::read(in_messages(table), &self.value(table))
    }
}

/// A single keyword, given for a row.
pub fn read(row: &Parameter, given: &Bound<'_, PyAny>) -> PyResult<Value> {
    let name = json::join(in_messages(row.table), row.name);
    let wrong = || {
        let shown: String = given.repr().map_or_else(|_| "value".to_owned(), |text| text.to_string()).chars().take(60).collect();
        PyErr::from(Error::input(&name, shown, wanted(row)))
    };
    if given.is_none() {
        let is_optional = !matches!(row.default, DefaultValue::Value(_));
        return if is_optional { Ok(Value::Null) } else { Err(wrong()) };
    }
    let number = |value: f64, name: &str| value.check(row, name).map(|()| Value::from(value));
    Ok(match row.kind {
        Kind::Number { .. } => number(given.extract().map_err(|_| wrong())?, &name)?,
        Kind::Whole { .. } => {
            let whole: i64 = given.extract().map_err(|_| wrong())?;
            whole.check(row, &name)?;
            Value::from(whole)
        }
        Kind::Flag => Value::Bool(given.extract().map_err(|_| wrong())?),
        Kind::Words(_) | Kind::Text => Value::String(given.extract().map_err(|_| wrong())?),
        Kind::WordsOrNumber { .. } => match given.extract() {
            // A number is a number only without quotes.
            Ok(word) => Value::String(word),
            Err(_) => number(given.extract().map_err(|_| wrong())?, &name)?,
        },
        Kind::Ascending { low, high } => {
            let numbers = arrays::vector(&name, given)?;
            for &value in &numbers {
                crate::error::check_range(&name, value, low, high, row.unit)?;
            }
            Value::from(numbers)
        }
        Kind::Direction => {
            let direction: [f64; 2] = given.extract().map_err(|_| wrong())?;
            direction.check(row, &name)?;
            Value::from(direction.to_vec())
        }
        Kind::Factors { words, .. } => {
            let mut factors = Map::new();
            for item in given.cast::<PyMapping>().map_err(|_| wrong())?.items()?.iter() {
                let (word, factor): (String, f64) = item.extract().map_err(|_| wrong())?;
                if !words.contains(&word.as_str()) {
                    return Err(Error::input(&name, quoted(&word), words::listed(words)).into());
                }
                let factor = number(factor, &format!("{name}.{word}"))?;
                factors.insert(word, factor);
            }
            Value::Object(factors)
        }
        Kind::Files => values::json(&name, given, 0)?,
    })
}

/// How messages of the room of a table begin the names of its parameters.
fn in_messages(table: &str) -> &str {
    match table {
        "night" | "polarising_filter" => table,
        _ => "",
    }
}

/// What can be given, for messages.
fn wanted(row: &Parameter) -> String {
    let unit = if row.unit.is_empty() { String::new() } else { format!(" {}", row.unit) };
    match row.kind {
        Kind::Number { .. } => format!("a number from {}{unit}", row.allowed()),
        Kind::Whole { .. } => format!("a whole number from {}{unit}", row.allowed()),
        Kind::Flag => "True or False".to_owned(),
        Kind::Words(words) => words::listed(words),
        Kind::Text => "a text".to_owned(),
        _ => row.allowed(),
    }
}

fn unexpected(call: &Call, arguments: &[Argument], key: &str, py: Python<'_>) -> PyErr {
    let names: Vec<&str> = arguments.iter().map(|argument| argument.name()).collect();
    let nearest =
        || -> PyResult<Vec<String>> { py.import("difflib")?.call_method1("get_close_matches", (key, names, 1))?.extract() };
    let hint = match nearest().unwrap_or_default().first() {
        Some(name) => format!(". Did you mean '{name}'?"),
        None => String::new(),
    };
    PyTypeError::new_err(format!("{}() got an unexpected keyword argument '{key}'{hint}", call.name))
}

/// Gives `class` an attribute for each row that its objects show; `table_of` has them.
pub fn show<T, S>(class: &Bound<'_, PyType>, rows: &'static [Parameter], table_of: fn(&T) -> &S) -> PyResult<()>
where
    T: PyClass<Frozen = pyo3::pyclass::boolean_struct::True> + Sync,
    S: Serialize + 'static,
{
    let py = class.py();
    let property = py.import("builtins")?.getattr("property")?;
    for row in rows {
        let get = move |given: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| -> PyResult<Py<PyAny>> {
            let object = given.get_item(0)?;
            Ok(value(given.py(), row, &written(table_of(object.cast::<T>()?.get())))?.unbind())
        };
        let get = PyCFunction::new_closure(py, None, None, get)?;
        class.setattr(row.name, property.call1((get, py.None(), py.None(), face::attribute_text(row)))?)?;
    }
    Ok(())
}

/// The value of a row in a table that was written.
fn value<'py>(py: Python<'py>, row: &Parameter, table: &Value) -> PyResult<Bound<'py, PyAny>> {
    let default = || match row.default {
        DefaultValue::Value(json) => serde_json::from_str(json).unwrap_or_default(),
        _ => Value::Null,
    };
    let value = values::object(py, &table.get(row.name).cloned().unwrap_or_else(default))?;
    match row.kind {
        Kind::Direction if !value.is_none() => Ok(py.get_type::<PyTuple>().call1((value,))?),
        _ => Ok(value),
    }
}

/// A struct of parameters as JSON.
pub fn written<S: Serialize>(table: &S) -> Value {
    serde_json::to_value(table).unwrap_or_default()
}

/// The keywords that make `table` again.
pub fn keywords<'py, S: Serialize>(py: Python<'py>, rows: &[Parameter], table: &S) -> PyResult<Bound<'py, PyDict>> {
    let (keys, written) = (PyDict::new(py), written(table));
    rows.iter().try_for_each(|row| keys.set_item(row.name, value(py, row, &written)?))?;
    Ok(keys)
}

/// `class(name=value, ...)` of all rows.
pub fn repr<S: Serialize>(py: Python<'_>, class: &str, rows: &[Parameter], table: &S) -> PyResult<String> {
    let written = written(table);
    let parts = rows.iter().map(|row| Ok(format!("{}={}", row.name, value(py, row, &written)?.repr()?)));
    Ok(format!("{class}({})", parts.collect::<PyResult<Vec<_>>>()?.join(", ")))
}

/// Judges a value by the row `name` of a table.
pub fn check<T: Checked>(rows: &[Parameter], name: &str, value: &T) -> Result<()> {
    rows.iter().filter(|row| row.name == name).try_for_each(|row| value.check(row, name))
}
