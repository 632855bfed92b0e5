//! Quality levels: rows of plain numbers that say how finely the light is solved and gathered.

use crate::words::words;
use serde::{Deserialize, Serialize};

/// A named level of accuracy and cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Quality {
    /// For live previews.
    Draft,
    /// For pictures.
    #[default]
    Standard,
    /// For pictures that are measured.
    High,
    /// For checking the others.
    Reference,
}

words!(Quality, "quality", { Draft => "draft", Standard => "standard", High => "high", Reference => "reference" });

/// What a quality level means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Wavelengths at which light is solved.
    pub wavelengths: usize,
    /// Altitude levels of the solved light field.
    pub altitudes: usize,
    /// Solar zenith angles of the solved light field.
    pub solar_zenith_angles: usize,
    /// Altitude levels of the coarser field while the low orders are iterated.
    pub iteration_altitudes: usize,
    /// Solar zenith angles of the same.
    pub iteration_solar_zenith_angles: usize,
    /// Shells of the air, at whose borders steps of rays end.
    pub shells: usize,
    /// View zenith angles per altitude level (rising, between the horizontal and the horizon, down to the ground) while the low orders are iterated.
    pub iteration_zenith_nodes: [usize; 3],
    /// The same in the last applications, with all orders.
    pub zenith_nodes: [usize; 3],
    /// View azimuths on half the circle in the first iterations of the solve, and in the last.
    pub azimuth_nodes: [usize; 2],
    /// Highest order of the spherical harmonics of the light field.
    pub order: usize,
    /// Highest order around the vertical.
    pub azimuthal_order: usize,
    /// Applications of the scattering operator with all orders after the low orders have converged.
    pub full_applications: usize,
    /// Relative change at which the successive orders of scattering count as converged.
    pub convergence: f32,
    /// Longest step of a ray, which holds two points [km].
    pub step_km: f64,
    /// Circles of equal altitude above the horizon at which a dome of the sky is gathered.
    pub dome_circles: usize,
    /// Azimuths from the Sun's side to the opposite side on each circle.
    pub dome_azimuths: usize,
}

impl Quality {
    /// The row of numbers of this level.
    pub const fn numbers(self) -> Numbers {
        match self {
            Self::Draft => Numbers {
                wavelengths: 32,
                altitudes: 16,
                solar_zenith_angles: 38,
                iteration_altitudes: 10,
                iteration_solar_zenith_angles: 28,
                shells: 10,
                iteration_zenith_nodes: [4, 4, 3],
                zenith_nodes: [6, 5, 3],
                azimuth_nodes: [3, 5],
                order: 4,
                azimuthal_order: 4,
                full_applications: 1,
                convergence: 5e-3,
                step_km: 80.0,
                dome_circles: 20,
                dome_azimuths: 16,
            },
            Self::Standard => Numbers {
                wavelengths: 32,
                altitudes: 22,
                solar_zenith_angles: 52,
                iteration_altitudes: 14,
                iteration_solar_zenith_angles: 34,
                shells: 14,
                iteration_zenith_nodes: [6, 5, 3],
                zenith_nodes: [8, 6, 4],
                azimuth_nodes: [4, 6],
                order: 6,
                azimuthal_order: 5,
                full_applications: 2,
                convergence: 1e-3,
                step_km: 60.0,
                dome_circles: 24,
                dome_azimuths: 20,
            },
            Self::High => Numbers {
                wavelengths: 32,
                altitudes: 28,
                solar_zenith_angles: 54,
                iteration_altitudes: 18,
                iteration_solar_zenith_angles: 44,
                shells: 19,
                iteration_zenith_nodes: [7, 6, 4],
                zenith_nodes: [10, 7, 5],
                azimuth_nodes: [4, 9],
                order: 8,
                azimuthal_order: 8,
                full_applications: 2,
                convergence: 2e-4,
                step_km: 30.0,
                dome_circles: 36,
                dome_azimuths: 28,
            },
            Self::Reference => Numbers {
                wavelengths: 96,
                altitudes: 48,
                solar_zenith_angles: 120,
                iteration_altitudes: 40,
                iteration_solar_zenith_angles: 80,
                shells: 33,
                iteration_zenith_nodes: [10, 8, 5],
                zenith_nodes: [16, 12, 8],
                azimuth_nodes: [6, 13],
                order: 12,
                azimuthal_order: 12,
                full_applications: 3,
                convergence: 3e-5,
                step_km: 25.0,
                dome_circles: 96,
                dome_azimuths: 72,
            },
        }
    }
}
