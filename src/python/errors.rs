//! The crate's errors as Python exceptions.

use crate::error::Error;
use pyo3::exceptions::{PyException, PyOSError, PyRuntimeError, PyValueError};
use pyo3::{PyErr, create_exception};

create_exception!(
    skyprobe,
    InputError,
    PyValueError,
    "A value that cannot be used. The message names the parameter, the value given and the allowed range; nothing was computed."
);
create_exception!(skyprobe, DataError, PyRuntimeError, "A table or file whose content cannot be used.");
create_exception!(
    skyprobe,
    UnsolvedError,
    PyRuntimeError,
    "The light of this air cannot be found, or not well enough. The message says what is too thick and what would help; nothing was returned."
);
create_exception!(skyprobe, Cancelled, PyException, "The progress callback returned False; nothing was left behind.");

impl From<Error> for PyErr {
    fn from(error: Error) -> Self {
        let message = error.to_string();
        match error {
            Error::Input { .. } => InputError::new_err(message),
            Error::Data { .. } => DataError::new_err(message),
            Error::Unsolved { .. } => UnsolvedError::new_err(message),
            Error::File { .. } => PyOSError::new_err(message),
            Error::Cancelled => Cancelled::new_err(message),
        }
    }
}
