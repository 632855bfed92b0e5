//! Linear, clamped: the simplest operator of the thesis (7.2). Per channel.
//!
//! shown = min(c / white, 1), c the exposed channel. Everything over the white is lost, and clamped channels change hue.

use super::operator::Field;

/// The operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Exposed value that is shown as 1, 0.001 to 1e6.
    pub white: f64,
}

impl Default for Linear {
    fn default() -> Self {
        Self { white: 1.0 }
    }
}

impl Linear {
    pub(super) fn fields(&mut self) -> Vec<Field<'_>> {
        vec![Field::new("white", &mut self.white, 1e-3, 1e6)]
    }

    /// What an exposed channel becomes.
    pub fn curve(&self) -> impl Fn(f32) -> f32 + Sync + use<> {
        let scale = (1.0 / self.white) as f32;
        move |value| (value * scale).min(1.0)
    }
}
