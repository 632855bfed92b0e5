//! What shines above the air: the Moon, by sunlight, earthshine and in the Earth's shadow, and the eclipsed Sun.
//!
//! Inputs are plain geometry (unit vectors, distances, a rotation), results are spectral irradiance and radiance outside the air of
//! the observer. The extinction and scattering of that air, images and hosts come later and are not known here.
//!
//! Pixels are drawn with scalars: a disc is a sum of a few components, each a fixed spectrum times a number at each point. The caller takes
//! each spectrum through the air once.
//!
//! One piece of air does belong here: the Earth's limb, whose refracted light fills the Earth's shadow. For it [`earth_shadow`] and
//! [`limb_rays`] use optical functions of the standard atmosphere from [`crate::atmosphere`].

pub mod corona;
pub mod earth_shadow;
pub mod earthshine;
pub mod limb_darkening;
pub mod limb_rays;
pub mod moon_disc;
pub mod moon_irradiance;
pub mod moon_map;
pub mod moon_reflectance;
pub mod moon_view;
pub mod solar_eclipse;

pub use corona::Corona;
pub use earth_shadow::{EarthLimb, EarthShadow};
pub use moon_disc::{MoonDisc, MoonPoint};
pub use moon_irradiance::MoonPhase;
pub use moon_view::MoonView;
pub use solar_eclipse::SolarEclipse;

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
