//! Which phase function the aerosol scatters by.

use crate::words::words;
use serde::{Deserialize, Serialize};

/// How the aerosol scatters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum PhaseFunction {
    /// The phase function of its particles by Mie theory, by wavelength.
    Mie,
    /// That of Henyey and Greenstein with the asymmetry of the aerosol at 550 nm, or the one given.
    HenyeyGreenstein,
    /// That of Cornette and Shanks with this asymmetry.
    CornetteShanks,
}

words!(PhaseFunction, "phase_function", {
    Mie => "mie",
    HenyeyGreenstein => "henyey_greenstein",
    CornetteShanks => "cornette_shanks",
});
