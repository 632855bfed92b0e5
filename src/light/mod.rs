//! Light transport: solve once for an air, gather for any Sun, observer and direction.
//!
//! The air is spherically symmetric and sunlight is parallel, so light is symmetric about the axis from the planet's centre to the Sun: where a point is
//! needs two numbers, its altitude and its solar zenith angle. [`LightField::solve`] finds the light scattered any number of times on
//! a grid of these two, as moments of the radiance over direction (`solve`, `source`). [`LightField::gather`] marches a view ray, adds what the Sun's direct
//! light scatters once (`single`, `sunlight`: exact) and what the solved light scatters into the ray, and the lit ground at its end;
//! [`LightField::segments`] does so up to given distances (`cut`, `depths`). [`LightField::incident`] is the light that falls on a point of the air.
//! A change of time, place or height needs gathers only.
//!
//! Bottom up: `lanes` (blocks of wavelengths), `zenith_axis`, `harmonics` (mathematics, with [`crate::numerics`]), `air` (one block of a profile), `bends`, `chord`, `ray`
//! (steps through the shells), `cut`, `depths`, `stokes`, `suns`, `sunlight`, `single`, `grid`, `source`, `contracted`, `anderson`, `iterate`, `solve`, `angular`, `field`.
//! [`PathTracer`] judges them all: slow, simple, unbiased. [`Thesis`] is the estimator of the original thesis.
//!
//! Light is polarised, or a scalar on request. Molecules scatter by the exact matrix; particles and the ground take I alone and send out unpolarised light.

// Loops over lanes index several blocks at once: the plain form is what the compiler vectorises and what a reader follows.
#![allow(clippy::needless_range_loop)]

mod air;
mod anderson;
mod angular;
mod balance;
mod bends;
mod chord;
mod contracted;
mod cut;
mod depths;
mod field;
mod grid;
mod harmonics;
mod iterate;
mod lanes;
pub mod path_tracer;
mod ray;
mod single;
mod solve;
mod source;
mod stokes;
mod sunlight;
mod suns;
pub mod thesis;
mod zenith_axis;

pub use angular::{AngularFunctions, BLOCK, FunctionRows, Located, Once};
pub use field::{Gathered, Incident, LightField, Observer, Segments};
pub use path_tracer::{Estimate, Field, FieldTracer, Guiding, PathTracer};
pub use stokes::transverse;
pub use thesis::{Thesis, ThesisOptions};
