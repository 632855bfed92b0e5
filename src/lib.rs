//! The light of the sky for a place, a time and a state of the air: spectral, physically based, as a high dynamic range light probe.
//!
//! ```text
//! a name or coordinates ──> places ──> place
//! place, time ──> ephemeris ──> directions and sizes of the bodies
//! directions ──> celestial (light outside the air of all that shines at night)
//! air ──> atmosphere (optical profile) ──> light: solve ──> light field      (once for one air)
//! light field + directions + observer ──> light: gather ──> sky ──> probe ──> io: EXR, HDR, PNG
//! all that is asked for ──> scene ──> sky, probe, files
//! probe, or a scene lit by it ──> post (glare, tone mapping) ──> io
//! ```
//!
//! Data flows one way: a folder knows nothing of what comes after it.
//!
//! ```
//! use skyprobe::prelude::*;
//! use std::sync::Arc;
//!
//! // A Sun that is put 30 degrees high in the south; with Sky::new a place and a time.
//! let air = AirParameters { turbidity: Some(3.0), ..Default::default() };
//! let air = Arc::new(Atmosphere::new(&air, Quality::Draft, true)?);
//! let sky = Sky::with_sun(30.0, 180.0, 0.0, air)?;
//! let settings = ProbeSettings { width: 64, ..Default::default() };
//! let light = sky.light_by(&LightOptions::default(), &Progress::silent())?;
//! let probe = render(&light, &settings, &Progress::silent())?;
//! assert_eq!((probe.width, probe.height, probe.pixels.len()), (64, 32, 64 * 32 * 3));
//! // By day the zenith is blue.
//! assert!(probe.pixels[2] > probe.pixels[0]);
//! # Ok::<(), skyprobe::Error>(())
//! ```
//!
//! `examples/` goes on from there, from `1_probe` in five lines to an air of your own in `4_own_air`.
//!
//! # Conventions
//! - Directions are unit vectors in the local frame x = east, y = north, z = up. Azimuth in degrees from north through east,
//!   altitude in degrees above the horizon.
//! - SI units; wavelengths in nm; angles in degrees where a name ends in `_deg`, in radians elsewhere.
//! - Spectral radiance in W m-2 sr-1 nm-1. Illuminance and luminance use the CIE 1931 observer.
//! - Latitude-longitude images: row 0 at the zenith, column u = 1/4 + azimuth / 360 of the width.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod atmosphere;
pub mod celestial;
#[cfg(feature = "cli")]
pub mod cli;
pub mod ephemeris;
pub mod error;
pub mod io;
pub mod light;
pub mod numerics;
pub mod parameter;
pub mod places;
pub mod post;
pub mod prelude;
pub mod probe;
pub mod progress;
pub mod projection;
#[cfg(feature = "python")]
mod python;
pub mod quality;
pub mod scene;
pub mod sky;
pub mod spectrum;
pub mod time;
pub mod units;
pub mod words;

pub use error::{Error, Result};
pub use progress::Progress;
