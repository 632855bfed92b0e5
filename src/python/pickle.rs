//! How objects pickle: as a call that makes them again, so that whatever comes out of a pickle has passed the same checks as what a user gives.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// What `__reduce__` returns: something to call, and its arguments.
pub type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

/// A call of `callable` with arguments by place and by name.
pub fn call<'py, T>(callable: &Bound<'py, PyAny>, by_place: T, by_name: &Bound<'py, PyDict>) -> PyResult<Reduced<'py>>
where
    T: IntoPyObject<'py, Target = PyTuple, Output = Bound<'py, PyTuple>>,
    PyErr: From<T::Error>,
{
    let py = callable.py();
    let by_place = by_place.into_pyobject(py)?;
    // Only by way of `partial` does a pickle hold arguments by name.
    let partial = py.import("functools")?.getattr("partial")?.call((callable,), Some(by_name))?;
    Ok((partial, by_place))
}
