//! Named states of the air that a user starts from.

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
