//! The planets by name, their size and how they are turned.
//!
//! Radii (equatorial) and poles: Archinal et al. 2011 (IAU WGCCRE), Celest. Mech. Dyn. Astr. 109, 101.

use super::moon_orientation::rotation;
use crate::error::{Error, Result};
use crate::time::JulianDate;
use glam::DMat3;
use std::fmt;
use std::str::FromStr;

/// A planet other than the Earth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Planet {
    /// The innermost.
    Mercury,
    /// Morning and evening star.
    Venus,
    /// The red one.
    Mars,
    /// The largest.
    Jupiter,
    /// With its rings, whose light is part of the magnitude.
    Saturn,
    /// At the limit of the naked eye.
    Uranus,
    /// Never seen by the naked eye.
    Neptune,
}

impl Planet {
    /// All seven, from the Sun outwards.
    pub const ALL: [Self; 7] = [Self::Mercury, Self::Venus, Self::Mars, Self::Jupiter, Self::Saturn, Self::Uranus, Self::Neptune];

    /// English name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mercury => "Mercury",
            Self::Venus => "Venus",
            Self::Mars => "Mars",
            Self::Jupiter => "Jupiter",
            Self::Saturn => "Saturn",
            Self::Uranus => "Uranus",
            Self::Neptune => "Neptune",
        }
    }

    /// Equatorial radius (Saturn's without rings) [km].
    pub const fn radius_km(self) -> f64 {
        match self {
            Self::Mercury => 2_439.7,
            Self::Venus => 6_051.8,
            Self::Mars => 3_396.19,
            Self::Jupiter => 71_492.0,
            Self::Saturn => 60_268.0,
            Self::Uranus => 25_559.0,
            Self::Neptune => 24_764.0,
        }
    }

    /// Matrix from body-fixed axes to the ICRS, of those planets whose brightness depends on how they are turned.
    pub(super) fn body_fixed_to_icrs(self, tt: JulianDate) -> Option<DMat3> {
        let days = tt - JulianDate::from_days(2_451_545.0);
        let t = days / 36_525.0;
        match self {
            Self::Mars => Some(rotation(317.681_43 - 0.1061 * t, 52.886_50 - 0.0609 * t, 176.630 + 350.891_982_26 * days)),
            Self::Saturn => Some(rotation(40.589 - 0.036 * t, 83.537 - 0.004 * t, 38.90 + 810.793_902_4 * days)),
            Self::Uranus => Some(rotation(257.311, -15.175, 203.81 - 501.160_092_8 * days)),
            _ => None,
        }
    }
}

impl fmt::Display for Planet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Planet {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let found = Self::ALL.into_iter().find(|planet| planet.name().eq_ignore_ascii_case(text));
        found.ok_or_else(|| {
            Error::input("planet", format!("{text:?}"), "mercury, venus, mars, jupiter, saturn, uranus or neptune")
        })
    }
}
