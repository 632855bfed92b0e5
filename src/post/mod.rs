//! What is done to a finished high dynamic range picture, a probe or a scene that it lit: glare in the eye, and tone mapping for a screen.
//!
//! ```text
//! picture ──> repair (what no light can be) ──> glare ──> tone mapping ──> 8 or 16 bits
//! ```

pub mod glare;
pub mod picture;
pub mod tone;

pub use picture::{Picture, PictureProjection, Repairs, View};
