//! Named states of the air: rows of plain numbers that a user starts from.

use super::aerosol::AerosolType;
use super::ground::Surface;
use super::standard_atmosphere::StandardAtmosphere;
use crate::words::words;
use serde::{Deserialize, Serialize};

/// A named state of the air.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Preset {
    /// A clear day in the country: continental clean aerosol, optical depth 0.1, grass.
    #[default]
    Clear,
    /// Molecules and ozone only, grass.
    Pure,
    /// A hazy summer day: continental average aerosol, optical depth 0.35.
    Hazy,
    /// A polluted day: continental polluted aerosol, optical depth 0.5.
    Polluted,
    /// A city: urban aerosol, optical depth 0.4, city ground.
    Urban,
    /// The open sea: maritime aerosol, optical depth 0.1.
    Maritime,
    /// A dusty desert: mineral aerosol, optical depth 0.3, sand.
    Desert,
    /// The Antarctic: optical depth 0.03, subarctic winter air, snow.
    Antarctic,
    /// Fog: optical depth 5 in a layer of 300 m (visibility 230 m) over grass.
    Fog,
    /// A clear day some months after a great volcanic eruption: as `clear`, with an optical depth of 0.1 in the stratosphere.
    Volcanic,
    /// The air of the original thesis: haze proportional to wavelength^-0.84 at turbidity 2, no ozone.
    Thesis,
}

words!(Preset, "preset", {
    Clear => "clear",
    Pure => "pure",
    Hazy => "hazy",
    Polluted => "polluted",
    Urban => "urban",
    Maritime => "maritime",
    Desert => "desert",
    Antarctic => "antarctic",
    Fog => "fog",
    Volcanic => "volcanic",
    Thesis => "thesis",
});

/// How much aerosol a preset has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Amount {
    /// Vertical optical depth of the aerosol at 550 nm.
    OpticalDepth(f64),
    /// Vertical optical depth of aerosol and molecules divided by that of the molecules, at 550 nm.
    Turbidity(f64),
    /// Horizontal visibility at the ground [km].
    VisibilityKm(f64),
}

/// What a preset fills in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defaults {
    /// Kind of aerosol.
    pub aerosol: AerosolType,
    /// Amount of aerosol.
    pub amount: Amount,
    /// Vertical optical depth of the stratospheric aerosol at 550 nm.
    pub stratospheric_aod550: f64,
    /// Ozone column [Dobson units].
    pub ozone_du: f64,
    /// Temperature and density.
    pub standard_atmosphere: StandardAtmosphere,
    /// Ground.
    pub ground: Surface,
}

impl Preset {
    /// The numbers of this preset.
    pub fn defaults(self) -> Defaults {
        let row = |aerosol, optical_depth, ground| Defaults {
            aerosol,
            amount: Amount::OpticalDepth(optical_depth),
            stratospheric_aod550: 0.0,
            ozone_du: 300.0,
            standard_atmosphere: StandardAtmosphere::UsStandard1976,
            ground,
        };
        match self {
            Self::Clear => row(AerosolType::ContinentalClean, 0.1, Surface::Grass),
            Self::Pure => row(AerosolType::None, 0.0, Surface::Grass),
            Self::Hazy => row(AerosolType::ContinentalAverage, 0.35, Surface::Grass),
            Self::Polluted => row(AerosolType::ContinentalPolluted, 0.5, Surface::Grass),
            Self::Urban => row(AerosolType::Urban, 0.4, Surface::City),
            Self::Maritime => row(AerosolType::MaritimeClean, 0.1, Surface::Sea),
            Self::Desert => row(AerosolType::Desert, 0.3, Surface::Desert),
            Self::Antarctic => Defaults {
                standard_atmosphere: StandardAtmosphere::SubarcticWinter,
                ..row(AerosolType::Antarctic, 0.03, Surface::Snow)
            },
            Self::Fog => row(AerosolType::Fog, 5.0, Surface::Grass),
            Self::Volcanic => Defaults { stratospheric_aod550: 0.1, ..row(AerosolType::ContinentalClean, 0.1, Surface::Grass) },
            Self::Thesis => {
                Defaults { amount: Amount::Turbidity(2.0), ozone_du: 0.0, ..row(AerosolType::Thesis, 0.0, Surface::Grass) }
            }
        }
    }
}
