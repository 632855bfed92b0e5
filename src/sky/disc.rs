//! The disc of a luminous body as it is drawn.

use glam::DVec3;

/// A limb-darkened disc, possibly flattened by refraction.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// Unit vector (east, north, up) to the centre of the disc as seen (refracted).
    pub direction: DVec3,
    /// Angular radius along the horizon [radians].
    pub horizontal_radius: f64,
    /// Angular radius along the vertical [radians].
    pub vertical_radius: f64,
    /// Irradiance on a surface that faces the disc: XYZ [W m-2], for the part of the disc above the horizon.
    pub irradiance: [f64; 3],
    /// Brightness relative to the centre is 1 - u (1 - m) - v (1 - m)^2 with m the cosine of the angle between the surface's
    /// normal and the line of sight: (u, v) for X, Y and Z.
    pub limb_darkening: [[f64; 2]; 3],
}

/// Limb darkening of the Sun for X, Y and Z. Coefficients of the quadratic law u2, v2 in Cox (ed.), Allen's Astrophysical Quantities, 4th edition (2000),
/// table 14.17: 0.99, -0.17 at 450 nm; 0.93, -0.23 at 550 nm; 0.88, -0.23 at 600 nm, in the present form u = u2 + 2 v2, v = -v2; X is
/// four parts of 600 nm and one of 450 nm, Y is 550 nm, Z is 450 nm.
pub const SOLAR_LIMB_DARKENING: [[f64; 2]; 3] = [[0.466, 0.218], [0.47, 0.23], [0.65, 0.17]];
