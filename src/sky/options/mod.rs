//! What can be asked for beside place, time and air: the night, the model, a filter, factors on layers.

mod filter;
mod layers;
mod model;
mod night;

pub use filter::PolarisingFilter;
pub use layers::{Layer, LayerScales};
pub(super) use model::check_tolerance;
pub use model::{LightOptions, Model};
pub use night::{NightOptions, When};
