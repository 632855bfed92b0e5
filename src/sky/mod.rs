//! What is seen from a place at a time: the light of the sky, the Sun's disc, the ground.

mod air_light;
mod airless;
mod atmosphere;
pub mod cache;
mod composition;
mod disc;
mod dome;
mod eclipse;
mod irradiance;
mod kept_refraction;
mod layers;
mod light_key;
mod night;
mod options;
mod place_and_time;
pub mod preetham;
mod scattered;
mod sky_light;
mod spectra;
mod sunlight;
#[cfg(test)]
mod tests;
mod thesis;
mod turn;

pub use atmosphere::Atmosphere;
pub(crate) use atmosphere::check_chosen as check_chosen_wavelengths;
pub use cache::Cache;
pub use disc::{Disc, Point, Surface, SurfaceMap};
pub use dome::SkyDome;
pub use irradiance::{Illuminance, Irradiance};
pub use layers::{Distance, Layers, OneLayer, Part, Transmittance};
pub use options::{Layer, LayerScales, LightOptions, Model, NightOptions, PolarisingFilter, When};
pub use place_and_time::Sky;
pub use preetham::Preetham;
pub use sky_light::SkyLight;
pub use spectra::SegmentLight;
pub use thesis::ThesisSky;
