//! The optical properties of one state of the air against altitude and wavelength: all that the light transport knows of it.
//!
//! Every preset ends up as an [`OpticalProfile`], and a user can give one in full (another code's air, another planet).

use super::phase::Phase;
use crate::error::{Error, Result, check_range};
use std::cmp::Ordering;

/// One kind of particle or gas.
#[derive(Clone, Debug, PartialEq)]
pub struct Component {
    /// Name for messages and documentation, such as "molecules".
    pub name: String,
    /// Scattering coefficient [km-1], row-major, shape (altitudes, wavelengths).
    pub scattering_per_km: Vec<f64>,
    /// Absorption coefficient [km-1], same shape.
    pub absorption_per_km: Vec<f64>,
    /// Phase function; `None` for a component that only absorbs.
    pub phase: Option<Phase>,
}

/// The air: coefficients are linear between altitudes and zero above the last.
#[derive(Clone, Debug, PartialEq)]
pub struct OpticalProfile {
    /// Altitudes above the ground [km], ascending, the first 0; the last is the top of the atmosphere.
    pub altitudes_km: Vec<f64>,
    /// Wavelengths [nm], ascending.
    pub wavelengths_nm: Vec<f64>,
    /// What the air is made of.
    pub components: Vec<Component>,
    /// Lambertian albedo of the ground by wavelength (0 to 1).
    pub ground_albedo: Vec<f64>,
    /// Solar irradiance at the top of the atmosphere at 1 au by wavelength [W m-2 nm-1].
    pub solar_irradiance: Vec<f64>,
    /// Radius of the planet's ground [km].
    pub planet_radius_km: f64,
    /// Angular radius of the Sun's disc seen from the planet [degrees].
    pub sun_angular_radius_deg: f64,
}

impl OpticalProfile {
    /// Checks shapes, order and ranges.
    ///
    /// # Errors
    /// [`Error::Input`] that names the first offending array.
    pub fn validate(&self) -> Result<()> {
        check_ascending("altitudes_km", &self.altitudes_km, 2)?;
        if self.altitudes_km[0] != 0.0 {
            return Err(Error::input("altitudes_km", self.altitudes_km[0], "ascending from 0 km (the ground)"));
        }
        check_range("altitudes_km", *self.altitudes_km.last().unwrap(), 0.001, 10_000.0, "km")?;
        check_ascending("wavelengths_nm", &self.wavelengths_nm, 1)?;
        for &wavelength in &self.wavelengths_nm {
            check_range("wavelengths_nm", wavelength, 100.0, 100_000.0, "nm")?;
        }
        let wavelengths = self.wavelengths_nm.len();
        let cells = self.altitudes_km.len() * wavelengths;
        if self.components.is_empty() {
            return Err(Error::input("components", "[]", "at least one component"));
        }
        for component in &self.components {
            let name = &component.name;
            check_coefficients(&format!("{name}.scattering"), &component.scattering_per_km, cells)?;
            check_coefficients(&format!("{name}.absorption"), &component.absorption_per_km, cells)?;
            match &component.phase {
                Some(phase) => phase.validate(name, wavelengths)?,
                None => {
                    if component.scattering_per_km.iter().any(|&s| s > 0.0) {
                        return Err(Error::input(
                            format!("{name}.phase"),
                            "None",
                            "a phase function where the component scatters",
                        ));
                    }
                }
            }
        }
        check_length("ground_albedo", &self.ground_albedo, wavelengths)?;
        for &albedo in &self.ground_albedo {
            check_range("ground_albedo", albedo, 0.0, 1.0, "")?;
        }
        check_length("solar_irradiance", &self.solar_irradiance, wavelengths)?;
        for &irradiance in &self.solar_irradiance {
            check_range("solar_irradiance", irradiance, 0.0, 1e9, "W m-2 nm-1")?;
        }
        check_range("planet_radius_km", self.planet_radius_km, 1.0, 1e8, "km")?;
        check_range("sun_angular_radius_deg", self.sun_angular_radius_deg, 0.0, 10.0, "degrees")?;
        Ok(())
    }
}

fn check_ascending(parameter: &str, values: &[f64], least: usize) -> Result<()> {
    if values.len() < least {
        return Err(Error::input(parameter, format!("{} values", values.len()), format!("at least {least} values")));
    }
    match values.windows(2).find(|pair| pair[0].partial_cmp(&pair[1]) != Some(Ordering::Less)) {
        Some(pair) => Err(Error::input(parameter, format!("[.. {}, {} ..]", pair[0], pair[1]), "finite and strictly ascending")),
        None if values.iter().all(|v| v.is_finite()) => Ok(()),
        None => Err(Error::input(parameter, "not finite", "finite and strictly ascending")),
    }
}

fn check_length(parameter: &str, values: &[f64], expected: usize) -> Result<()> {
    if values.len() == expected {
        return Ok(());
    }
    Err(Error::input(parameter, format!("{} values", values.len()), format!("{expected} values, one for each wavelength")))
}

fn check_coefficients(parameter: &str, values: &[f64], cells: usize) -> Result<()> {
    if values.len() != cells {
        return Err(Error::input(
            parameter,
            format!("{} values", values.len()),
            format!("{cells} values, altitudes x wavelengths"),
        ));
    }
    for &value in values {
        check_range(parameter, value, 0.0, 1e6, "per km")?;
    }
    Ok(())
}
