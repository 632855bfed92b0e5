//! What is known of an air once its preset and the amount of its aerosol are resolved.

use super::aerosol::AerosolType;
use super::ground::Ground;
use super::parameters::AirParameters;
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
    /// Asymmetry parameter, by default that of the aerosol at 550 nm.
    pub asymmetry: f64,
    /// How the aerosol scatters.
    pub phase_function: PhaseFunction,
    /// Scale height of the aerosol, depth of a layer of fog [km].
    pub aerosol_scale_height_km: f64,
    /// Temperature and density profile.
    pub standard_atmosphere: StandardAtmosphere,
    /// Pressure at the ground [hPa].
    pub surface_pressure_hpa: f64,
    /// The ground.
    pub ground: Ground,
    /// What was given and what the preset fills in, without the amount of aerosol. A parameter that follows from no other is read here, by the physics that it
    /// belongs to, which knows what is usual.
    pub filled: AirParameters,
}
