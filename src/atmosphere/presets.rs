//! What each preset fills in: rows of plain numbers.

use super::aerosol::AerosolType;
use super::ground::{Ground, Surface};
use super::parameters::AirParameters;
use super::preset::Preset;
use super::standard_atmosphere::StandardAtmosphere;

impl Preset {
    /// What this preset says, where it is not as usual.
    pub fn parameters(self) -> AirParameters {
        let row = |aerosol, aod550, ground| AirParameters {
            preset: self,
            aerosol: Some(aerosol),
            aod550: Some(aod550),
            ground: Some(Ground::Surface(ground)),
            ..AirParameters::default()
        };
        match self {
            Self::Clear => row(AerosolType::ContinentalClean, 0.1, Surface::Grass),
            Self::Pure => row(AerosolType::None, 0.0, Surface::Grass),
            Self::Hazy => row(AerosolType::ContinentalAverage, 0.35, Surface::Grass),
            Self::Polluted => row(AerosolType::ContinentalPolluted, 0.5, Surface::Grass),
            Self::Urban => row(AerosolType::Urban, 0.4, Surface::City),
            Self::Maritime => row(AerosolType::MaritimeClean, 0.1, Surface::Sea),
            Self::Desert => row(AerosolType::Desert, 0.3, Surface::Desert),
            Self::Antarctic => AirParameters {
                standard_atmosphere: Some(StandardAtmosphere::SubarcticWinter),
                ..row(AerosolType::Antarctic, 0.03, Surface::Snow)
            },
            Self::Fog => row(AerosolType::Fog, 5.0, Surface::Grass),
            Self::Volcanic => {
                AirParameters { stratospheric_aod550: Some(0.1), ..row(AerosolType::ContinentalClean, 0.1, Surface::Grass) }
            }
            Self::Thesis => AirParameters {
                aod550: None,
                turbidity: Some(2.0),
                ozone_du: Some(0.0),
                ..row(AerosolType::Thesis, 0.0, Surface::Grass)
            },
        }
    }
}
