//! One state of the air together with its solved light.

use crate::atmosphere::{AirParameters, OpticalProfile};
use crate::error::{Error, Result};
use crate::light::LightField;
use crate::progress::Progress;
use crate::quality::Quality;
use crate::spectrum::{CubicSpline, solar, wavelengths, xyz_weights};
use std::sync::{Mutex, OnceLock, PoisonError};

/// The air and the light in it. The light is solved once, when it is first needed, and serves every place, time and height.
pub struct Atmosphere {
    parameters: Option<AirParameters>,
    profile: OpticalProfile,
    quality: Quality,
    polarised: bool,
    field: OnceLock<LightField>,
    /// Held while solving, so that two threads that need the light at once solve it once.
    solving: Mutex<()>,
}

impl Atmosphere {
    /// The air of `parameters`. With `polarisation` off light is solved as a scalar, which is wrong by several per cent in clean air: only to compare with scalar codes.
    ///
    /// # Errors
    /// [`Error::Input`] that names the first parameter that cannot be used.
    pub fn new(parameters: &AirParameters, quality: Quality, polarisation: bool) -> Result<Self> {
        let profile = parameters.optical_profile(&wavelengths(quality.numbers().wavelengths))?;
        Ok(Self::unsolved(Some(parameters.clone()), profile, quality, polarisation))
    }

    /// Air given in full; its light is solved at the wavelengths of the profile.
    ///
    /// # Errors
    /// [`Error::Input`] that names the first array that cannot be used.
    pub fn from_profile(profile: OpticalProfile, quality: Quality, polarisation: bool) -> Result<Self> {
        profile.validate()?;
        Ok(Self::unsolved(None, profile, quality, polarisation))
    }

    fn unsolved(parameters: Option<AirParameters>, profile: OpticalProfile, quality: Quality, polarised: bool) -> Self {
        Self { parameters, profile, quality, polarised, field: OnceLock::new(), solving: Mutex::new(()) }
    }

    /// Solves the multiple scattering, unless that is done.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub fn solve(&self, progress: &Progress) -> Result<()> {
        self.field(progress).map(|_| ())
    }

    /// The solved light.
    pub(super) fn field(&self, progress: &Progress) -> Result<&LightField> {
        if let Some(field) = self.field.get() {
            return Ok(field);
        }
        // A thread that panicked while solving left nothing half-done behind.
        let _solving = self.solving.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(field) = self.field.get() {
            return Ok(field);
        }
        let field = LightField::solve(&self.profile, &self.quality.numbers(), self.polarised, progress)?;
        Ok(self.field.get_or_init(|| field))
    }

    /// Whether the light has been solved.
    pub fn is_solved(&self) -> bool {
        self.field.get().is_some()
    }

    /// The quality level.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// Whether light is solved with its polarisation.
    pub fn is_polarised(&self) -> bool {
        self.polarised
    }

    /// Optical properties.
    pub fn profile(&self) -> &OpticalProfile {
        &self.profile
    }

    /// What the air was made from; `None` for air given as a profile.
    pub fn parameters(&self) -> Option<&AirParameters> {
        self.parameters.as_ref()
    }

    /// Weights by wavelength that turn radiance per unit solar irradiance at 1 au into XYZ [W m-2].
    ///
    /// # Errors
    /// [`Error::Input`] if the wavelengths are too few or cover too little of the visible spectrum to make a colour.
    pub(super) fn xyz_weights(&self) -> Result<Vec<[f64; 3]>> {
        let nodes = &self.profile.wavelengths_nm;
        let (first, last) = (nodes[0], nodes[nodes.len() - 1]);
        if nodes.len() < 4 || first > 450.0 || last < 650.0 {
            return Err(Error::input(
                "wavelengths_nm",
                format!("{} values from {first} to {last} nm", nodes.len()),
                "at least 4 values that reach from 450 nm or less to 650 nm or more, to make a colour",
            ));
        }
        if self.parameters.is_some() {
            return Ok(xyz_weights(nodes, |wavelength| solar::irradiance(wavelength, 1.0)));
        }
        let plain = xyz_weights(nodes, |_| 1.0);
        Ok(plain.into_iter().zip(&self.profile.solar_irradiance).map(|(xyz, &sun)| xyz.map(|w| w * sun)).collect())
    }

    /// Solar irradiance at 1 au at any of the wavelengths that the profile covers [W m-2 nm-1].
    pub(super) fn solar_irradiance(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        if self.parameters.is_some() {
            return solar::band_means(wavelengths_nm);
        }
        let spline = CubicSpline::new(&self.profile.wavelengths_nm, &self.profile.solar_irradiance);
        wavelengths_nm.iter().map(|&wavelength| spline.value(wavelength)).collect()
    }

    /// Checks that `wavelengths_nm` lie within those of the profile.
    pub(super) fn check_wavelengths(&self, wavelengths_nm: &[f64]) -> Result<()> {
        let nodes = &self.profile.wavelengths_nm;
        for &wavelength in wavelengths_nm {
            crate::error::check_range("wavelengths_nm", wavelength, nodes[0], nodes[nodes.len() - 1], "nm")?;
        }
        Ok(())
    }
}
