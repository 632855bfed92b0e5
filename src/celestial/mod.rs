//! What shines above the air at night, Moon and Sun excepted: spectral irradiance of stars and planets, spectral radiance of the
//! zodiacal light, the Milky Way, the airglow and of scattered artificial light. Knows nothing of extinction, images or hosts.
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
//! | [`MilkyWay`] | 1: brightness [S10(V)] | ICRS | above the air |
//! | [`Airglow`] | 2: path length through the layers at 90 and 250 km, vertical = 1 | horizon, z up | above (nearly all of) the air |
//! | [`LightPollution`] | 1: luminance [cd m-2] | horizon, z up | **in** the air: what arrives at the ground, not to be extinguished |
//!
//! Scalars cost 0.09 (Milky Way) to 0.13 microseconds (zodiacal light) a direction and the spectra a millisecond; all 61 762 stars
//! on 32 wavelengths take 2 ms.
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
mod diffuse;
mod frames;
mod lamps;
mod light_pollution;
mod milky_way;
pub mod photometry;
mod planet_light;
mod star_spectra;
mod stars;
#[cfg(test)]
mod tests;
mod zodiacal;

pub use airglow::{Airglow, van_rhijn};
pub use diffuse::DiffuseLight;
pub use frames::{ecliptic_from_icrs, galactic_from_icrs};
pub use lamps::Lamps;
pub use light_pollution::{LightPollution, bortle_zenith_brightness};
pub use milky_way::{MilkyWay, starlight_to};
pub use planet_light::{Planet, planet_irradiance};
pub use star_spectra::StarSpectra;
pub use stars::{Star, star_named, stars_to};
pub use zodiacal::ZodiacalLight;
