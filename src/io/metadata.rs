//! What a file says about the light in it, apart from what the probe's own settings say.

/// Facts for the header of a file; what is not known is left out.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Metadata {
    /// Geographic latitude [degrees, north positive].
    pub latitude_deg: Option<f64>,
    /// Geographic longitude [degrees, east positive].
    pub longitude_deg: Option<f64>,
    /// Height of the observer above sea level [m].
    pub elevation_m: Option<f64>,
    /// Local civil time "YYYY:MM:DD hh:mm:ss", as OpenEXR's `capDate` wants it.
    pub capture_date: Option<String>,
    /// Local civil time minus UTC [s], positive east of Greenwich. (OpenEXR's `utcOffset` has the opposite sign; the writer sees to it.)
    pub utc_offset_s: Option<f64>,
    /// Geometric altitude of the Sun's centre [degrees].
    pub sun_altitude_deg: Option<f64>,
    /// Azimuth of the Sun's centre from north through east [degrees].
    pub sun_azimuth_deg: Option<f64>,
    /// The configuration that makes this probe again, as JSON.
    pub config_json: Option<String>,
    /// Anything else, for people.
    pub comments: Option<String>,
}
