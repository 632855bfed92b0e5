//! What is known of an air once its preset and the amount of its aerosol are resolved.

use super::aerosol::AerosolType;
use super::ground::Ground;
use super::phase_function::PhaseFunction;
use super::standard_atmosphere::StandardAtmosphere;
use serde::Serialize;

/// The state of the air with nothing left open.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Air {
    /// Kind of aerosol.
    pub aerosol: AerosolType,
    /// Relative humidity [%].
    pub relative_humidity: f64,
    /// Vertical optical depth of the aerosol at 550 nm.
    pub aod550: f64,
    /// The same as turbidity.
    pub turbidity: f64,
    /// The same as visibility at the ground [km].
    pub visibility_km: f64,
    /// Exponent that replaces the aerosol's own spectral extinction.
    pub angstrom_exponent: Option<f64>,
    /// Albedo that replaces the aerosol's own.
    pub single_scattering_albedo: Option<f64>,
    /// Asymmetry parameter, by default that of the aerosol at 550 nm.
    pub asymmetry: f64,
    /// How the aerosol scatters.
    pub phase_function: PhaseFunction,
    /// Scale height of the aerosol, depth of a layer of fog [km].
    pub aerosol_scale_height_km: f64,
    /// Vertical optical depth of the stratospheric aerosol at 550 nm.
    pub stratospheric_aod550: f64,
    /// Altitude of its middle [km].
    pub stratospheric_altitude_km: f64,
    /// Ozone column [Dobson units].
    pub ozone_du: f64,
    /// Temperature and density profile.
    pub standard_atmosphere: StandardAtmosphere,
    /// Pressure at the ground [hPa].
    pub surface_pressure_hpa: f64,
    /// The ground.
    pub ground: Ground,
}
