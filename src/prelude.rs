//! What most programs need: `use skyprobe::prelude::*;`.

pub use crate::atmosphere::{AerosolType, AirParameters, Component, Ground, OpticalProfile, Phase, Preset, Surface};
pub use crate::ephemeris::{Place, SunModel};
pub use crate::error::{Error, Result};
pub use crate::io::{FileOptions, Metadata, render_to_files, save};
pub use crate::places::locate;
pub use crate::probe::{Extent, GroundView, Probe, ProbeSettings, Projection, Rows, render};
pub use crate::progress::Progress;
pub use crate::quality::Quality;
pub use crate::scene::{Scene, describe};
pub use crate::sky::{Atmosphere, Cache, Layer, LightOptions, Model, NightOptions, PolarisingFilter, Sky};
pub use crate::spectrum::{ColorSpace, Gamut};
pub use crate::time::{Time, ZoneChoice};
pub use crate::units::Scale;
