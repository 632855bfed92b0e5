//! Numerical methods that several rooms share and that know nothing of skies: quadrature, tables along an axis, splines.
//!
//! | what | where |
//! | --- | --- |
//! | Gauss-Legendre quadrature on any interval | [`gauss`] |
//! | the interval of a short table that holds a value | [`mod@locate`] |
//! | the same in constant time, and cubic interpolation, for loops over rays | [`axis`] |
//! | cubic splines, and the weights with which their nodes count | [`spline`] |

pub mod axis;
pub mod gauss;
pub mod locate;
pub mod spline;

pub use axis::{Axis, Cubic};
pub use gauss::GaussLegendre;
pub use locate::{locate, locate_by};
pub use spline::CubicSpline;
