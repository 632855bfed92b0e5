//! Bodies as they are drawn: discs, and points of light.

use glam::DVec3;
use std::sync::Arc;

/// A disc, possibly flattened by refraction.
#[derive(Clone, Debug)]
pub struct Disc {
    /// Whether it is the Sun, whose light a lamp may take over.
    pub is_sun: bool,
    /// Unit vector (east, north, up) to the centre of the disc as seen (refracted).
    pub direction: DVec3,
    /// Angular radius along the horizon [radians].
    pub horizontal_radius: f64,
    /// Angular radius along the vertical [radians].
    pub vertical_radius: f64,
    /// Irradiance on a surface that faces the disc: XYZ [W m-2], for the part of the disc above the horizon.
    pub irradiance: [f64; 3],
    /// How the light is spread over the disc.
    pub surface: Surface,
}

/// How light is spread over a disc; its amount is the disc's irradiance.
#[derive(Clone, Debug)]
pub enum Surface {
    /// Brightness relative to the centre is 1 - u (1 - m) - v (1 - m)^2 with m the cosine of the angle between the surface's
    /// normal and the line of sight: (u, v) for X, Y and Z.
    LimbDarkened([[f64; 2]; 3]),
    /// Whatever a map says.
    Mapped(Arc<dyn SurfaceMap>),
}

/// Brightness over a disc.
pub trait SurfaceMap: Send + Sync + std::fmt::Debug {
    /// X, Y and Z, each relative to whatever is handy, at a point of the disc: `right` along the horizon towards growing azimuth and `up`, in units of the radii.
    fn brightness(&self, right: f64, up: f64) -> [f64; 3];
}

impl Surface {
    /// X, Y and Z, each relative to whatever is handy, at a point of the disc.
    #[inline]
    pub fn brightness(&self, right: f64, up: f64) -> [f64; 3] {
        match self {
            Self::LimbDarkened(laws) => {
                let shade = 1.0 - (1.0 - right * right - up * up).max(0.0).sqrt();
                laws.map(|[u, v]| 1.0 - shade * (u + v * shade))
            }
            Self::Mapped(map) => map.brightness(right, up),
        }
    }
}

/// A body too small to have a disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Unit vector (east, north, up) to where it is seen (refracted).
    pub direction: DVec3,
    /// Irradiance on a surface that faces it: XYZ [W m-2].
    pub irradiance: [f64; 3],
}

/// Limb darkening of the Sun for X, Y and Z. Coefficients of the quadratic law u2, v2 in Cox (ed.), Allen's Astrophysical Quantities, 4th edition (2000),
/// table 14.17: 0.99, -0.17 at 450 nm; 0.93, -0.23 at 550 nm; 0.88, -0.23 at 600 nm, in the present form u = u2 + 2 v2, v = -v2; X is
/// four parts of 600 nm and one of 450 nm, Y is 550 nm, Z is 450 nm.
pub const SOLAR_LIMB_DARKENING: [[f64; 2]; 3] = [[0.466, 0.218], [0.47, 0.23], [0.65, 0.17]];
