//! How the eye spreads the light of a point: Spencer, Shirley, Zimmerman & Greenberg, "Physically-based glare effects for digital images", SIGGRAPH 1995; the
//! thesis's equations 11 to 17.
//!
//! With the angle theta from the source [degrees] and the wavelength lambda [nm], in sr-1:
//! ```text
//! f0 = 2.61e6 exp(-(theta / 0.02)^2)                                     light that is not scattered              (11)
//! f1 = 20.91 / (theta + 0.02)^3                                          corona, below one degree                 (12)
//! f2 = 72.37 / (theta + 0.02)^2                                          corona and veil, above one degree        (13)
//! f3 = 436.9 (568 / lambda) exp(-19.75 (theta - 3 lambda / 568)^2)       lenticular halo                          (15)
//!
//! photopic    0.384 f0 + 0.478 f1 + 0.138 f2                                                                      (14)
//! mesopic     0.368 f0 + 0.478 f1 + 0.138 f2 + 0.016 f3                                                           (16)
//! scotopic    0.282 f0 + 0.478 f1 + 0.207 f2 + 0.033 f3                                                           (17)
//! ```
//! **The factor 19.75 is missing in the thesis's equation 15.** It is in the paper, and the normalisation shows that it belongs there: each of the four functions
//! is meant to have the integral 1 over the hemisphere. Measured (tests below): f0 0.9991, f1 0.9999, f2 0.9999, f3 1.0001 at 568 nm with the factor and 4.44 without it, so that
//! the sums are 0.9996 (photopic, mesopic) and 0.9997 (scotopic). What is missing to 1 is given to the unscattered part when a picture is made.
//!
//! The states stand for pupils as well: only a pupil wider than about 3 mm lets light through the outer fibres of the lens, whose regular spacing makes the halo.
//! That is why there is no f3 by day.

use crate::error::{Error, Result};
use std::str::FromStr;

/// To which light the eye is adapted, and so how wide its pupil is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AdaptationState {
    /// By day: cones see, the pupil is small.
    Photopic,
    /// In twilight and under lamps: cones still see, the pupil is wide.
    Mesopic,
    /// By night: rods see, the pupil is wide.
    Scotopic,
}

/// Below this luminance the state is scotopic [cd m-2]: lower limit of mesopic vision, CIE 191:2010.
pub const SCOTOPIC_LIMIT: f64 = 0.005;
/// Above this luminance the state is photopic [cd m-2]: upper limit of mesopic vision, CIE 191:2010.
pub const PHOTOPIC_LIMIT: f64 = 5.0;

impl AdaptationState {
    /// All states, from day to night.
    pub const ALL: [Self; 3] = [Self::Photopic, Self::Mesopic, Self::Scotopic];

    /// The state of an eye adapted to `luminance` [cd m-2].
    pub fn of_luminance(luminance: f64) -> Self {
        match luminance {
            bright if bright > PHOTOPIC_LIMIT => Self::Photopic,
            dark if dark < SCOTOPIC_LIMIT => Self::Scotopic,
            _ => Self::Mesopic,
        }
    }

    /// The name that users write.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Photopic => "photopic",
            Self::Mesopic => "mesopic",
            Self::Scotopic => "scotopic",
        }
    }

    /// Weights of f0, f1, f2 and f3: equations 14, 16, 17.
    pub const fn weights(self) -> [f64; 4] {
        match self {
            Self::Photopic => [0.384, 0.478, 0.138, 0.0],
            Self::Mesopic => [0.368, 0.478, 0.138, 0.016],
            Self::Scotopic => [0.282, 0.478, 0.207, 0.033],
        }
    }
}

impl FromStr for AdaptationState {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let found = Self::ALL.into_iter().find(|state| state.name() == text);
        found.ok_or_else(|| Error::input("state", format!("{text:?}"), "auto, photopic, mesopic or scotopic"))
    }
}

/// Equation 11 [sr-1]: what is not scattered.
pub fn unscattered(angle_deg: f64) -> f64 {
    2.61e6 * (-(angle_deg / 0.02).powi(2)).exp()
}

/// Equation 12 [sr-1]: the corona close to the source.
pub fn corona(angle_deg: f64) -> f64 {
    20.91 / (angle_deg + 0.02).powi(3)
}

/// Equation 13 [sr-1]: corona and veil further away.
pub fn veil(angle_deg: f64) -> f64 {
    72.37 / (angle_deg + 0.02).powi(2)
}

/// Equation 15 with the paper's factor [sr-1]: the halo of the lens's fibres in light of one wavelength.
pub fn lenticular_halo(angle_deg: f64, wavelength_nm: f64) -> f64 {
    let ratio = wavelength_nm / 568.0;
    436.9 / ratio * (-19.75 * (angle_deg - 3.0 * ratio).powi(2)).exp()
}

/// The point spread function of `state` at an angle of 0 to 180 degrees from the source [degrees], in light of one wavelength [nm]: share of the light per solid angle [sr-1].
pub fn point_spread(state: AdaptationState, angle_deg: f64, wavelength_nm: f64) -> f64 {
    let [w0, w1, w2, w3] = state.weights();
    let halo = if w3 == 0.0 { 0.0 } else { w3 * lenticular_halo(angle_deg, wavelength_nm) };
    w0 * unscattered(angle_deg) + w1 * corona(angle_deg) + w2 * veil(angle_deg) + halo
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Integral of a function of the angle over the hemisphere.
    fn hemisphere(function: impl Fn(f64) -> f64) -> f64 {
        let mut edges = vec![0.0];
        edges.extend((0..=600).map(|k| 90.0 * 1e-6f64.powf(1.0 - f64::from(k) / 600.0)));
        let at = |angle: f64| angle.to_radians().sin() * function(angle);
        // Simpson's rule on 16 parts of each piece.
        let piece = |from: f64, to: f64| -> f64 {
            let step = (to - from) / 16.0;
            let weight = |k: usize| if k == 0 || k == 16 { 1.0 } else { [2.0, 4.0][k % 2] };
            (0..=16).map(|k| weight(k) * at(from + step * k as f64)).sum::<f64>() * step.to_radians() / 3.0
        };
        TAU * edges.windows(2).map(|pair| piece(pair[0], pair[1])).sum::<f64>()
    }

    #[test]
    fn each_function_has_the_integral_one_over_the_hemisphere() {
        // checked against: mpmath 1.3, 30 digits, quad of 2 pi sin(theta) f(theta) from 0 to pi / 2
        let parts: [(f64, f64); 4] = [
            (hemisphere(unscattered), 0.999_091_117_187),
            (hemisphere(corona), 0.999_907_394_291),
            (hemisphere(veil), 0.999_936_216_434),
            (hemisphere(|angle| lenticular_halo(angle, 568.0)), 1.000_067_136_648),
        ];
        for (found, expected) in parts {
            assert!((found / expected - 1.0).abs() < 1e-7, "{found} {expected}");
            assert!((found - 1.0).abs() < 2e-3, "{found}");
        }
        // Without the paper's factor the halo alone would be more than the source.
        let printed = hemisphere(|angle| 436.9 * (-(angle - 3.0f64).powi(2)).exp());
        assert!((printed / 4.444_076_745_518 - 1.0).abs() < 1e-7, "{printed}");
        for state in AdaptationState::ALL {
            let sum = hemisphere(|angle| point_spread(state, angle, 568.0));
            assert!((sum - 1.0).abs() < 1e-3, "{state:?} {sum}");
            assert!((state.weights().iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn point_spread_functions_are_the_equations() {
        // checked against: equations 11 to 17 (15 with the factor of the paper) in mpmath 1.3 with 30 digits
        const EXPECTED: [(&str, f64, f64, f64); 30] = [
            ("photopic", 0.0, 550.0, 2276580.15),
            ("photopic", 0.01, 450.0, 1161826.474603),
            ("photopic", 0.03, 568.0, 189589.9828249),
            ("photopic", 0.2, 600.0, 1145.016265965),
            ("photopic", 1.0, 550.0, 19.0177431757),
            ("photopic", 2.3, 450.0, 2.655923200521),
            ("photopic", 3.0, 568.0, 1.457902726469),
            ("photopic", 3.5, 650.0, 1.035200070583),
            ("photopic", 12.0, 500.0, 0.07487928548188),
            ("photopic", 90.0, 700.0, 0.001246123964831),
            ("mesopic", 0.0, 550.0, 2234820.15),
            ("mesopic", 0.01, 450.0, 1129303.753902),
            ("mesopic", 0.03, 568.0, 185188.5112072),
            ("mesopic", 0.2, 600.0, 1145.016265965),
            ("mesopic", 1.0, 550.0, 19.0177431757),
            ("mesopic", 2.3, 450.0, 10.51006475624),
            ("mesopic", 3.0, 568.0, 8.448302726469),
            ("mesopic", 3.5, 650.0, 6.6269361941),
            ("mesopic", 12.0, 500.0, 0.07487928548188),
            ("mesopic", 90.0, 700.0, 0.001246123964831),
            ("scotopic", 0.0, 550.0, 2022843.975),
            ("scotopic", 0.01, 450.0, 960042.4968007),
            ("scotopic", 0.03, 568.0, 163528.013262),
            ("scotopic", 0.2, 600.0, 1248.188373403),
            ("scotopic", 1.0, 550.0, 23.81736831988),
            ("scotopic", 2.3, 450.0, 19.78284171983),
            ("scotopic", 3.0, 568.0, 16.42311489699),
            ("scotopic", 3.5, 650.0, 12.97117187002),
            ("scotopic", 12.0, 500.0, 0.1094412745129),
            ("scotopic", 90.0, 700.0, 0.001862335247905),
        ];
        for (state, angle, wavelength, expected) in EXPECTED {
            let found = point_spread(state.parse().unwrap(), angle, wavelength);
            assert!((found / expected - 1.0).abs() < 1e-11, "{state} {angle} {wavelength}: {found}");
        }
    }

    #[test]
    fn luminance_chooses_the_state() {
        for (luminance, state) in
            [(3000.0, "photopic"), (5.0, "mesopic"), (0.005, "mesopic"), (0.001, "scotopic"), (0.0, "scotopic")]
        {
            assert_eq!(AdaptationState::of_luminance(luminance).name(), state);
            assert_eq!(state.parse::<AdaptationState>().unwrap().name(), state);
        }
        assert!("day".parse::<AdaptationState>().unwrap_err().to_string().starts_with("state = \"day\""));
    }
}
