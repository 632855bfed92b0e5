//! Light by wavelength and colour: grids of wavelengths, the Sun's spectrum, the standard observer, RGB spaces.

pub mod binned;
pub mod color_space;
pub mod grid;
pub mod observer;
pub mod solar;
pub mod weights;

pub use binned::BinnedSpectrum;
pub use color_space::{Chromaticities, ColorSpace, Gamut};
pub use grid::wavelengths;
pub use weights::{Sensor, xyz_weights};
