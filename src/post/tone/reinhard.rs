//! Photographic tone reproduction, global (Reinhard, Stark, Shirley & Ferwerda 2002, eq. 4). On luminance: hue and ratios of the channels are kept.
//!
//! ```text
//! Ld = L (1 + L / white^2) / (1 + L)
//! ```
//! L is the exposed luminance: with automatic exposure 0.18 times luminance over its log-average, which is the paper's eq. 2, but for the log-average, that leaves out the brightest 2 % and the
//! nearly black ([`Metering`](super::Metering)). `white` is the least exposed luminance that is shown as 1; by default the brightest of the picture, as the paper proposes.

use super::metering::Metering;
use super::operator::Field;

/// The operator.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reinhard {
    /// Exposed luminance that is shown as 1, up to 1e9; 0 for the brightest of the picture.
    pub white: f64,
}

impl Reinhard {
    pub(super) fn fields(&mut self) -> Vec<Field<'_>> {
        vec![Field::new("white", &mut self.white, 0.0, 1e9)]
    }

    /// What an exposed luminance becomes in a picture of given luminances and `exposure` of cd m-2.
    pub fn curve(&self, metering: &Metering, exposure: f64) -> impl Fn(f32) -> f32 + Sync + use<> {
        let white = if self.white > 0.0 { self.white } else { (metering.highest * exposure).max(1e-6) };
        let per_white_squared = (1.0 / (white * white)) as f32;
        move |value| (value / (1.0 + value) * (1.0 + value * per_white_squared)).min(1.0)
    }
}
