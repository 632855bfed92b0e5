//! Where the observer stands.

use crate::error::Result;
use crate::parameter::{Checked, Parameter, row};

/// A place on or above the Earth.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Place {
    /// Geodetic latitude (WGS84), positive north, -90 to 90 [degrees].
    pub latitude_deg: f64,
    /// Longitude, positive east, -180 to 180 [degrees].
    pub longitude_deg: f64,
    /// Height above the WGS84 ellipsoid, for which the height above sea level will do (they differ by at most 107 m) [m].
    pub elevation_m: f64,
}

impl Place {
    /// The rows of the table of parameters for a place.
    pub const PARAMETERS: &'static [Parameter] = &[
        row::number(-90.0, 90.0, "degrees")
            .named("", "latitude", "Latitude, north positive")
            .option("latitude", "DEG")
            .alias("lat"),
        row::number(-180.0, 180.0, "degrees")
            .named("", "longitude", "Longitude, east positive")
            .option("longitude", "DEG")
            .alias("lon"),
        row::number(-500.0, 60_000.0, "m")
            .named("", "elevation_m", "Height of the observer above the sea")
            .default("0.0")
            .option("elevation", "M")
            .more("A place that is named has its own."),
    ];

    /// The place at these coordinates.
    ///
    /// # Errors
    /// [`crate::Error::Input`] for `latitude` outside -90 to 90 degrees, `longitude` outside -180 to 180 degrees,
    /// `elevation_m` outside -500 to 60000 m.
    pub fn new(latitude_deg: f64, longitude_deg: f64, elevation_m: f64) -> Result<Self> {
        for (row, value) in Self::PARAMETERS.iter().zip([latitude_deg, longitude_deg, elevation_m]) {
            value.check(row, row.name)?;
        }
        Ok(Self { latitude_deg, longitude_deg, elevation_m })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_off_the_globe_is_refused_by_name() {
        let message = |latitude, longitude, elevation| Place::new(latitude, longitude, elevation).unwrap_err().to_string();
        assert_eq!(message(91.0, 0.0, 0.0), "latitude = 91: must be a number from -90 to 90 degrees");
        assert!(message(0.0, -180.1, 0.0).starts_with("longitude = -180.1"));
        assert!(message(0.0, 0.0, f64::NAN).starts_with("elevation_m = NaN"));
        assert!(message(0.0, 0.0, 60_001.0).contains("-500 to 60000 m"));
        assert!(Place::new(-90.0, 180.0, -430.0).is_ok());
    }
}
