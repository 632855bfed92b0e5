//! Light of one body scattered by the air, gathered into a dome.

use super::disc::Disc;
use super::dome::{Gathering, SkyDome};
use super::eclipse::Gain;
use super::options::PolarisingFilter;
use super::place_and_time::Sky;
use super::sky_light::SkyLight;
use crate::ephemeris::Body;
use crate::error::Result;
use crate::light::LightField;
use crate::progress::Progress;

/// What of the light of a dome is wanted.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub filter: Option<&'a PolarisingFilter>,
    pub tolerance: Option<f64>,
    /// Whether what is below the horizon is wanted, too.
    pub ground: bool,
}

impl Wanted<'_> {
    /// What shines on a plane from above.
    pub const FROM_ABOVE: Self = Self { filter: None, tolerance: None, ground: false };
}

/// The dome lit by `body` whose irradiance outside the air makes `weights`.
pub(super) fn dome_under(
    sky: &Sky,
    field: &LightField,
    body: &Body,
    weights: Vec<[f64; 3]>,
    wanted: Wanted,
    discs: Vec<Disc>,
    progress: &Progress,
) -> Result<SkyDome> {
    let what = Gathering {
        field,
        numbers: &sky.atmosphere().quality().numbers(),
        filter: wanted.filter.copied(),
        tolerance: wanted.tolerance,
        ground: wanted.ground,
        weights,
        observer: sky.observer_under(body),
        horizon: sky.horizon(),
        sun: (body.altitude_deg.to_radians(), body.azimuth_deg.to_radians()),
    };
    SkyDome::gather(&what, discs, progress)
}

/// A dome under the Moon's shadow.
pub(super) struct EclipsedDome {
    pub dome: SkyDome,
    pub gain: Gain,
}

impl SkyLight for EclipsedDome {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        self.dome.radiance_circle(altitude, azimuths, out);
        let gain = self.gain.at(altitude) as f32;
        out.as_flattened_mut().iter_mut().for_each(|value| *value *= gain);
    }

    fn horizon_altitude(&self) -> f64 {
        self.dome.horizon_altitude()
    }

    fn discs(&self) -> Vec<Disc> {
        self.dome.discs()
    }
}
