//! The crate's errors as Python exceptions.

use crate::error::Error;
use pyo3::exceptions::{PyException, PyOSError, PyRuntimeError, PyUserWarning, PyValueError};
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
create_exception!(
    skyprobe,
    ScaleWarning,
    PyUserWarning,
    "The luminance that a picture's numbers stand for was not said, and had to be assumed: glare and tone mapping depend on it."
);
create_exception!(
    skyprobe,
    SunlightOnlyWarning,
    PyUserWarning,
    "A result lacks the light of a night that may outshine it: a spectrum of a sky without place and time whose Sun is below -18 degrees; at night what the air along a line of sight scatters."
);
create_exception!(
    skyprobe,
    TimeWarning,
    PyUserWarning,
    "Something had to be assumed about a time: its clocks show it never or twice, it is a date alone, or it has a second 60. The message says which instant is taken."
);

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
