//! What layers are put together from: light with a place in the order from far to near, and what it lets through of the light behind it.

use crate::sky::{Disc, Point, SkyLight};
use std::sync::Arc;

/// How far away light is made: what is nearer stands before what is farther.
///
/// ```text
/// Space | FarAir | Clouds | NearAir | observer
/// ```
/// Discs and points of `Space` come with the irradiance that the air leaves of them, and diffuse light from space is given as the air shows it, in `FarAir`: of a clear sky nothing hides anything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Distance {
    /// Outside the air: discs of Sun and Moon, stars, planets.
    Space,
    /// All air if the sky is clear, else the air behind the clouds; the ground.
    #[default]
    FarAir,
    /// Clouds.
    Clouds,
    /// Air before the clouds.
    NearAir,
}

impl Distance {
    /// From far to near.
    pub const ALL: [Self; 4] = [Self::Space, Self::FarAir, Self::Clouds, Self::NearAir];
}

/// What something lets through of the light behind it.
pub trait Transmittance: Send + Sync {
    /// Writes the transmittance along a circle of equal altitude: factors (0 to 1) on X, Y and Z of what is behind, for each of `azimuths` [radians, from north through east] at `altitude`
    /// [radians above the horizontal], into `out`, which has the same length.
    ///
    /// Light behind with another spectrum than that for which the factors were found is dimmed as if it had that one; grey things are exact for all.
    fn transmittance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]);
}

/// Light of one layer at one distance.
#[derive(Default)]
pub struct Part {
    /// Where it stands.
    pub distance: Distance,
    /// Light that can be asked for in any direction, as it leaves the part towards the observer: premultiplied, in the words of compositing.
    pub smooth: Vec<Box<dyn SkyLight + Send>>,
    /// Discs above the horizon.
    pub discs: Vec<Disc>,
    /// Points above the horizon.
    pub points: Vec<Point>,
    /// What all light of greater distance comes through; nothing is hidden without it.
    pub transmittance: Option<Arc<dyn Transmittance>>,
}

impl Part {
    /// Discs outside the air.
    pub fn discs(discs: Vec<Disc>) -> Self {
        Self { distance: Distance::Space, discs, ..Self::default() }
    }

    /// Points of light outside the air.
    pub fn points(points: Vec<Point>) -> Self {
        Self { distance: Distance::Space, points, ..Self::default() }
    }

    /// Light from any direction that arrives through [`Distance::FarAir`] or is made there.
    pub fn smooth(light: Box<dyn SkyLight + Send>) -> Self {
        Self { smooth: vec![light], ..Self::default() }
    }

    /// The same part at `distance`.
    pub fn at(self, distance: Distance) -> Self {
        Self { distance, ..self }
    }

    /// The same part, through which the light behind it comes as `transmittance` says.
    pub fn with_transmittance(self, transmittance: Arc<dyn Transmittance>) -> Self {
        Self { transmittance: Some(transmittance), ..self }
    }
}
