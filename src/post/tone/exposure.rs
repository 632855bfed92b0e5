//! How much light a picture is given: automatically, by an exposure value, or as a camera is set.
//!
//! An exposure value at ISO 100 is EV100 = log2(N^2 / t 100 / S): aperture N, shutter time t \[s\], sensitivity S. A sensor of saturation-based sensitivity S = 78 / H (ISO 12232:2019,
//! H the exposure in lx s at which it saturates) behind a lens with H = q L t / N^2, q = 0.65 (the same standard), saturates at the luminance
//! ```text
//! L = 78 / (S q) N^2 / t = 1.2 * 2^EV100   [cd m-2]
//! ```
//! (Lagarde & de Rousiers 2014, section 5.1.1). That luminance becomes 1 before the operator's curve: exposure = 1 / (1.2 * 2^EV100).
//! A reflected-light meter sets EV100 = log2(100 L / K) for a mean luminance L, K = 12.5 cd m-2 s (ISO 2720:1974 allows 10.6 to 13.4), which puts L at 12.5 / 120 = 0.104.
//! The automatic exposure puts it at 0.18, the middle grey that the operators here expect: 0.79 stops more than the meter, whose grey leaves room below a saturation that they do not have.

use crate::error::{Result, check_range};

/// Luminance at which the sensor saturates at EV100 = 0: 78 / (100 q), q = 0.65 [cd m-2] (ISO 12232).
pub const SATURATION_AT_EV_0: f64 = 1.2;

/// Calibration constant of reflected-light meters [cd m-2 s] (ISO 2720).
pub const METER_CONSTANT: f64 = 12.5;

/// What the metered luminance becomes by automatic exposure, before the curve.
pub const MIDDLE_GREY: f64 = 0.18;

/// Least and greatest exposure value at ISO 100: from deeper than starlight to the Sun's disc.
pub const EV_RANGE: (f64, f64) = (-24.0, 36.0);

/// How much light the picture is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// From the picture's own luminances.
    Automatic {
        /// Stops over it, -20 to 20.
        stops: f64,
    },
    /// By an exposure value at ISO 100 [`EV_RANGE`]. A greater one gives a darker picture.
    Value {
        /// EV100.
        ev100: f64,
    },
    /// As a camera is set.
    Camera {
        /// Aperture: the f-number N, 0.5 to 128.
        aperture: f64,
        /// Shutter time [s], 1e-6 to 1e5.
        shutter_s: f64,
        /// Sensitivity, ISO 1 to 1e7.
        iso: f64,
    },
}

impl Default for Exposure {
    fn default() -> Self {
        Self::Automatic { stops: 0.0 }
    }
}

impl Exposure {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`Error::Input`](crate::Error::Input) that names the number.
    pub fn validate(&self) -> Result<()> {
        match *self {
            Self::Automatic { stops } => check_range("exposure_stops", stops, -20.0, 20.0, "stops")?,
            Self::Value { ev100 } => check_range("ev100", ev100, EV_RANGE.0, EV_RANGE.1, "")?,
            Self::Camera { aperture, shutter_s, iso } => {
                check_range("aperture", aperture, 0.5, 128.0, "")?;
                check_range("shutter_s", shutter_s, 1e-6, 1e5, "s")?;
                check_range("iso", iso, 1.0, 1e7, "")?
            }
        };
        Ok(())
    }

    /// EV100 set by hand; `None` for automatic exposure.
    pub fn ev100(&self) -> Option<f64> {
        match *self {
            Self::Automatic { .. } => None,
            Self::Value { ev100 } => Some(ev100),
            Self::Camera { aperture, shutter_s, iso } => Some((aperture * aperture / shutter_s * 100.0 / iso).log2()),
        }
    }

    /// Factor on luminances in cd m-2, where automatic exposure without stops would be `automatic`.
    pub fn factor(&self, automatic: f64) -> f64 {
        match (*self, self.ev100()) {
            (Self::Automatic { stops }, _) => automatic * stops.exp2(),
            (_, Some(ev100)) => factor_of_ev100(ev100),
            (_, None) => automatic,
        }
    }
}

/// Factor on luminances in cd m-2 of an exposure value at ISO 100.
pub fn factor_of_ev100(ev100: f64) -> f64 {
    1.0 / (SATURATION_AT_EV_0 * ev100.exp2())
}

/// Exposure value at ISO 100 of a factor on luminances in cd m-2.
pub fn ev100_of_factor(factor: f64) -> f64 {
    -(SATURATION_AT_EV_0 * factor).log2()
}

/// Exposure value at ISO 100 that a reflected-light meter shows for a mean `luminance` [cd m-2].
pub fn metered_ev100(luminance: f64) -> f64 {
    (100.0 * luminance / METER_CONSTANT).log2()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cameras_and_meters_agree_with_the_standards() {
        let sunny_16 = Exposure::Camera { aperture: 16.0, shutter_s: 1.0 / 100.0, iso: 100.0 };
        // checked against: the rule "sunny 16", EV100 14.6 for f/16 and 1/100 s
        assert!((sunny_16.ev100().unwrap() - 14.64).abs() < 0.01);
        // checked against: Lagarde & de Rousiers 2014, maximum luminance 1.2 x 2^EV100: 4096 x 1.2 at EV 12
        assert!((1.0 / Exposure::Value { ev100: 12.0 }.factor(1.0) - 4915.2).abs() < 1e-9);
        // checked against: ISO 2720 with K = 12.5, EV100 15 for 4096 cd m-2
        assert!((metered_ev100(4096.0) - 15.0).abs() < 1e-12);
        assert!((ev100_of_factor(factor_of_ev100(3.25)) - 3.25).abs() < 1e-12);
        let automatic = MIDDLE_GREY / 4096.0;
        assert!((metered_ev100(4096.0) - ev100_of_factor(automatic) - 0.79).abs() < 0.005);
    }

    #[test]
    fn a_stop_is_a_factor_of_two() {
        let factor = |stops| Exposure::Automatic { stops }.factor(0.3);
        assert_eq!((factor(0.0), factor(1.0), factor(-2.0)), (0.3, 0.6, 0.075));
        let at = |ev100| Exposure::Value { ev100 }.factor(0.3);
        assert!((at(3.0) / at(4.0) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn impossible_cameras_are_refused_by_name() {
        let message = |exposure: Exposure| exposure.validate().unwrap_err().to_string();
        assert!(message(Exposure::Automatic { stops: f64::NAN }).starts_with("exposure_stops = NaN"));
        assert!(message(Exposure::Value { ev100: 99.0 }).starts_with("ev100 = 99: must be a number from -24 to 36"));
        let camera = Exposure::Camera { aperture: 8.0, shutter_s: 0.0, iso: 100.0 };
        assert!(message(camera).starts_with("shutter_s = 0: must be"));
        assert!(Exposure::Camera { aperture: 8.0, shutter_s: 0.01, iso: 100.0 }.validate().is_ok());
    }
}
