//! The state of the air as optical properties: scattering, absorption and phase functions against altitude and wavelength.
//!
//! [`AirParameters`] is what a user says; [`AirParameters::resolve`] fills in the preset and turns every way to say how much haze there
//! is into an optical depth; [`AirParameters::optical_profile`] is all that the light transport knows.

pub mod aerosol;
pub mod air;
mod complex;
pub mod ground;
pub mod mie;
pub mod molecules;
pub mod optical_profile;
pub mod ozone;
pub mod parameters;
pub mod particle_tables;
pub mod particles;
pub mod phase;
pub mod phase_function;
pub mod phase_table;
pub mod preset;
mod presets;
pub mod profile;
mod resolve;
pub mod size_distribution;
pub mod standard_atmosphere;

pub use aerosol::AerosolType;
pub use air::Air;
pub use ground::{Ground, Surface};
pub use optical_profile::{Component, OpticalProfile};
pub use parameters::AirParameters;
pub use phase::Phase;
pub use phase_function::PhaseFunction;
pub use phase_table::PhaseTable;
pub use preset::Preset;
pub use standard_atmosphere::StandardAtmosphere;
