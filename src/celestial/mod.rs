//! What shines above the air at night, and the eclipsed Sun: spectral irradiance of stars and planets, the Moon by sunlight, by earthshine and in the Earth's shadow, the Sun behind the Moon
//! and its corona; spectral radiance of the zodiacal light, the Milky Way, the airglow and of scattered artificial light.
//!
//! Inputs are plain geometry (unit vectors, distances, a rotation); extinction and scattering by the observer's air, images and hosts come later and are not known here. One piece of air does
//! belong here: the Earth's limb, whose refracted light fills the Earth's shadow. For it [`shadowed_sunlight`] and [`limb_rays`] use optical functions of the standard atmosphere from [`crate::atmosphere`].
//!
//! Discs, too, are drawn with scalars: [`MoonDisc`] is a sum of a few components, each a fixed spectrum times a number at each point, so that the caller takes each spectrum through the air once.
//!
//! # The form of diffuse light
//! Every diffuse component is a short sum of *scalar map times fixed spectrum*,
//!
//! L(direction, lambda) = sum over parts i of s_i(direction) F_i(lambda)   [W m-2 sr-1 nm-1],
//!
//! so that whoever renders it treats each spectrum once (extinction, colour) and evaluates only scalars per direction. The trait
//! [`DiffuseLight`] is this form: [`DiffuseLight::spectra`] gives the F_i, [`DiffuseLight::scalars`] the s_i.
//!
//! | component | scalars | frame of the direction | where it shines |
//! |---|---|---|---|
//! | [`ZodiacalLight`] | 2: radiance at 500 nm of the redder and of the bluer light [W m-2 sr-1 nm-1] | ICRS | above the air |
//! | [`MilkyWay`] | 1: brightness [S10(V)] | ICRS | above the air |
//! | [`Airglow`] | 2: path length through the layers at 90 and 250 km, vertical = 1 | horizon, z up | above (nearly all of) the air |
//! | [`LightPollution`] | 1: luminance [cd m-2] | horizon, z up | **in** the air: what arrives at the ground, not to be extinguished |
//!
//! # Conventions
//! - Celestial directions are ICRS unit vectors; wavelengths in nm, ascending; spectra are means over about 10 nm, lines are
//!   shared between the neighbouring wavelengths so that their energy is kept ([`photometry::add_line`]).
//! - V and B - V are those of Johnson's system (Bessell 1990). 1 S10(V) is one star of V = 10 per square degree: see
//!   [`photometry`].
//!
//! ```
//! use skyprobe::celestial::{self, DiffuseLight, StarSpectra, ZodiacalLight};
//! use glam::DVec3;
//!
//! let sirius = &celestial::stars_to(6.5)[0];
//! let wavelengths = [450.0, 550.0, 650.0];
//! let spectra = StarSpectra::new(&wavelengths);
//! let irradiance = spectra.irradiance(sirius);
//! assert!((irradiance[1] / 1.4e-10 - 1.0).abs() < 0.05);
//!
//! let zodiacal = ZodiacalLight::new(DVec3::X);
//! let gegenschein = zodiacal.radiance(-DVec3::X, &[500.0])[0];
//! assert!((gegenschein / 230e-11 - 1.0).abs() < 1e-6);
//! ```

mod airglow;
pub mod corona;
mod diffuse;
pub mod earthshine;
pub mod eclipsed_sunlight;
mod lamps;
mod light_pollution;
pub mod limb_darkening;
pub mod limb_rays;
mod milky_way;
pub mod moon_disc;
pub mod moon_irradiance;
pub mod moon_map;
pub mod moon_reflectance;
pub mod moon_view;
pub mod photometry;
mod planet_light;
pub mod shadowed_sunlight;
mod star_spectra;
mod stars;
#[cfg(test)]
mod tests;
mod zodiacal;

pub use airglow::{Airglow, van_rhijn};
pub use corona::Corona;
pub use diffuse::DiffuseLight;
pub use eclipsed_sunlight::EclipsedSunlight;
pub use lamps::Lamps;
pub use light_pollution::{LightPollution, bortle_zenith_brightness};
pub use milky_way::{MilkyWay, starlight_to};
pub use moon_disc::{MoonDisc, MoonPoint};
pub use moon_irradiance::MoonPhase;
pub use moon_view::MoonView;
pub use planet_light::{geometric_albedo, planet_irradiance};
pub use shadowed_sunlight::{EarthLimb, ShadowedSunlight};
pub use star_spectra::StarSpectra;
pub use stars::{Star, star_named, stars_to};
pub use zodiacal::ZodiacalLight;

use crate::error::{Error, Result};
use glam::DVec3;

/// An [`Error::Input`] that names `parameter`, unless `vector` has the length 1 within 1e-6.
fn check_unit_vector(parameter: &str, vector: DVec3) -> Result<()> {
    if vector.is_finite() && (vector.length() - 1.0).abs() <= 1e-6 {
        return Ok(());
    }
    Err(Error::input(parameter, vector, "a unit vector"))
}

/// Angle between two vectors, precise for small ones [radians].
fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}
