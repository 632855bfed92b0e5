//! Logarithmic, clamped: the thesis's second operator (7.2, figure 5). Per channel.
//!
//! shown = min(ln(1 + c / middle) / ln(1 + white / middle), 1), c the exposed channel: in proportion to light far below `middle`, in proportion to its logarithm far above.
//! The thesis says that colours are clamped and logarithmically rescaled, without the numbers; the offset 1, which keeps black black, is that of Drago et al. 2003.

use super::operator::Field;

/// The operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Logarithmic {
    /// Exposed value that is shown as 1, 0.001 to 1e6: brighter parts are white areas.
    pub white: f64,
    /// Exposed value about which the curve bends, 1e-4 to 1e4.
    pub middle: f64,
}

impl Default for Logarithmic {
    fn default() -> Self {
        Self { white: 20.0, middle: 0.18 }
    }
}

impl Logarithmic {
    pub(super) fn fields(&mut self) -> Vec<Field<'_>> {
        vec![Field::new("white", &mut self.white, 1e-3, 1e6), Field::new("middle", &mut self.middle, 1e-4, 1e4)]
    }

    /// What an exposed channel becomes.
    pub fn curve(&self) -> impl Fn(f32) -> f32 + Sync + use<> {
        let scale = (1.0 / self.middle) as f32;
        let whole = (1.0 / (self.white / self.middle).ln_1p()) as f32;
        move |value| ((value * scale).ln_1p() * whole).min(1.0)
    }
}
