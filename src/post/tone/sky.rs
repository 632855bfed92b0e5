//! The operator made for skies: from the Sun's disc to the zenith, and from noon to starlight, at one setting.
//!
//! What it does, in order:
//! 1. **Adaptation.** The eye looks about and adapts to A, the geometric mean of the middle of the picture (log-average) and of its bright parts (95th percentile)
//!    ([`Metering::adaptation`](super::Metering::adaptation)), or to what is given: by hand, or by the eye of a time-lapse ([`Adaptation`](super::Adaptation)).
//! 2. **Brightness** ([`brightness`]). A is shown the darker the less light there is: dusk is darker than noon, and night is dark.
//! 3. **Rods** ([`Rods`]). Where there is too little light for the cones, colours fade into the bluish grey of moonlit nights, reds darken and blues brighten (Purkinje).
//! 4. **Acuity** ([`acuity`]). What only rods see is blurred to what they resolve, if the picture is finer than that.
//! 5. **Curve** ([`Curve`]). Straight up to the middle of the screen's range, then a shoulder that never reaches white, so that the aureole has gradation up to the Sun's disc. It acts on
//!    the largest channel; the others keep their ratio to it and fade to white along the shoulder so that the hue that is seen stays. Black stays black and nothing is added to the darks: there is no veil.
//!
//! Steps 3 and 4 look at the luminance L of each pixel together with what the eye is adapted to, L + A / 30: a black shadow at noon does not turn blue.

mod acuity;
mod brightness;
mod curve;
mod rods;

pub use acuity::{blurred_for_rods, resolvable_cycles_per_degree};
pub use brightness::brightness;
pub use curve::Curve;
pub use rods::Rods;

use super::operator::Field;

/// The operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// What the adaptation luminance becomes by daylight, before the curve, 0.05 to 5.
    pub key: f64,
    /// How much darker a darker world is shown: power of luminance, 0 (a night as bright as a day) to 0.5.
    pub darkening: f64,
    /// How much of the rods' vision is shown, 0 (colours of the night as a camera has them) to 1.
    pub rods: f64,
    /// How blue the rods' grey is: 0 is white, 1 the blue (x = y = 0.25) of Jensen et al. 2000.
    pub blue_shift: f64,
    /// How much of the loss of acuity is shown: factor on the width of the blur, 0 to 4.
    pub acuity_loss: f64,
    /// Contrast of the channels among each other, 0.5 to 2: a picture on a screen, much dimmer than the sky, looks as colourful as the sky only with more contrast than it has.
    pub colour_contrast: f64,
    /// Power of the shoulder, 0.2 to 2: with a smaller one more is left of the gradation about the Sun, and less of the contrast of bright clouds.
    pub shoulder: f64,
}

impl Default for Sky {
    fn default() -> Self {
        Self { key: 0.75, darkening: 0.2, rods: 1.0, blue_shift: 0.65, acuity_loss: 1.0, colour_contrast: 1.4, shoulder: 0.6 }
    }
}

impl Sky {
    pub(super) fn fields(&mut self) -> Vec<Field<'_>> {
        vec![
            Field::new("key", &mut self.key, 0.05, 5.0),
            Field::new("darkening", &mut self.darkening, 0.0, 0.5),
            Field::new("rods", &mut self.rods, 0.0, 1.0),
            Field::new("blue_shift", &mut self.blue_shift, 0.0, 1.0),
            Field::new("acuity_loss", &mut self.acuity_loss, 0.0, 4.0),
            Field::new("colour_contrast", &mut self.colour_contrast, 0.5, 2.0),
            Field::new("shoulder", &mut self.shoulder, 0.2, 2.0),
        ]
    }

    /// Factor on luminances in cd m-2 of an eye that is adapted to `adaptation` [cd m-2].
    pub fn exposure(&self, adaptation: f64) -> f64 {
        self.key * brightness(adaptation, self.darkening) / adaptation
    }
}
