//! Named models of the sky's light: the solved light transport, and what others made before, to compare with.

use super::SkyLight;
use super::place_and_time::Sky;
use super::preetham::Preetham;
use crate::error::{Error, Result};
use crate::progress::Progress;
use crate::spectrum::{solar, xyz_weights};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// By which model a sky is rendered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Model {
    /// Multiple scattering of light in the air, solved: day, twilight and night.
    #[default]
    Scattering,
    /// The analytic sky of [`Preetham`], Shirley & Smits 1999: by day, at turbidities from 2 to 10.
    Preetham,
}

impl Model {
    /// The name that users write.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Scattering => "scattering",
            Self::Preetham => "preetham",
        }
    }
}

impl FromStr for Model {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let found = [Self::Scattering, Self::Preetham].into_iter().find(|model| model.name() == text);
        found.ok_or_else(|| Error::input("model", format!("{text:?}"), "scattering or preetham"))
    }
}

impl Sky {
    /// All light around the observer by `model`, ready to be made into a probe.
    ///
    /// # Errors
    /// As [`Sky::light`]; [`Error::Input`] for a sky that the model cannot make.
    pub fn light_by(&self, model: Model, progress: &Progress) -> Result<Box<dyn SkyLight + Send>> {
        match model {
            Model::Scattering => Ok(Box::new(self.light(progress)?)),
            Model::Preetham => Ok(Box::new(self.preetham()?)),
        }
    }

    /// The analytic sky of Preetham et al. for this Sun, turbidity and ground.
    ///
    /// # Errors
    /// [`Error::Input`] for air given as a profile, which has no turbidity, and as [`Preetham::new`].
    pub fn preetham(&self) -> Result<Preetham> {
        let atmosphere = self.atmosphere();
        let Some(parameters) = atmosphere.parameters() else {
            return Err(Error::input("model", "preetham", "scattering for air given as a profile: it has no turbidity"));
        };
        let profile = atmosphere.profile();
        let radius = (profile.sun_angular_radius_deg / self.sun().distance_au).to_radians();
        let weights = xyz_weights(&profile.wavelengths_nm, |wavelength| solar::irradiance(wavelength, 1.0));
        let mean = |k: usize| {
            let (sum, total) = weights
                .iter()
                .zip(&profile.ground_albedo)
                .fold((0.0, 0.0), |(sum, total), (weight, albedo)| (sum + weight[k] * albedo, total + weight[k]));
            sum / total
        };
        Preetham::new(parameters.resolve()?.turbidity, self.sun(), radius, [mean(0), mean(1), mean(2)])
    }
}
