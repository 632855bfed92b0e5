//! Exposure, as of a film: 1 - exp(-c), c the exposed channel (the thesis's choice, 7.2 and figure 8). Per channel.
//!
//! "Constructed to resemble the process involved in photographing, where the amount of chemicals on the film decrease exponentially when its exposed to light."

/// The operator; its exposure is that of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exponential;

impl Exponential {
    /// What an exposed channel becomes.
    pub fn curve(&self) -> impl Fn(f32) -> f32 + Sync + use<> {
        |value: f32| -(-value).exp_m1()
    }
}
