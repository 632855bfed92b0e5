//! The configuration: all that a probe is made from, as JSON. The keys are the names of the Python arguments.
//!
//! ```json
//! {
//!   "latitude": 55.71, "longitude": 13.19, "elevation_m": 20, "time": "2005-06-21T13:00:00+02:00",
//!   "atmosphere": {"preset": "clear", "turbidity": 3, "quality": "standard"},
//!   "probe": {"width": 2048, "scale": "blender"},
//!   "output": ["sky.exr", "sky.png"]
//! }
//! ```
//! Instead of latitude and longitude (and elevation), `"place": "Lund, Sweden"` names the place, or has its coordinates in any spelling
//! ([`crate::places::locate`]); it is written out as the numbers that it stands for.
//! Instead of place and time, `"sun": {"altitude_deg": 30, "azimuth_deg": 180}` puts the Sun. Every key may be left out where there
//! is a default; an unknown key is an error, and so is what would be ignored, such as `night.bortle` where `night.when` is never.

pub mod calls;
mod describe;
pub mod face;
mod ignored;
pub mod json;
mod parameters;
mod replace;
pub mod schema;
mod source;

pub use describe::describe;
pub use ignored::Ignored;
pub use parameters::{AIR, FILE, IMAGE, NIGHT, PLACE_AND_TIME, SECTIONS, Section, parameters};

use crate::atmosphere::AirParameters;
use crate::ephemeris::{PUT_SUN, Place, SunModel};
use crate::error::{Error, Result};
use crate::io::{FileOptions, STANDARD};
use crate::parameter::{Checked, Kind, Parameter, row};
use crate::places::{Location, locate};
use crate::probe::ProbeSettings;
use crate::quality::Quality;
use crate::sky::{Atmosphere, LightOptions, Model, NightOptions, PolarisingFilter, Sky, check_chosen_wavelengths};
use crate::time::{Time, ZoneChoice};
use crate::words::Words;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Everything that a probe is made from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Geodetic latitude, -90 to 90 [degrees].
    pub latitude: Option<f64>,
    /// Longitude, positive east, -180 to 180 [degrees].
    pub longitude: Option<f64>,
    /// Height of the observer above the sea [m].
    pub elevation_m: f64,
    /// What the key `place`, where it gave latitude, longitude and elevation, was taken to be; not written.
    pub place_label: Option<String>,
    /// Date and time, ISO 8601; see [`Time::parse`]. Without offset it is local time in `zone`.
    pub time: Option<String>,
    /// IANA time zone; without it the zone of the place.
    pub zone: Option<String>,
    /// A Sun that is put in the sky, instead of place and time.
    pub sun: Option<SunPosition>,
    /// By which theory the Sun's position is computed.
    pub sun_model: SunModel,
    /// By which model, through which filter, how exactly and with which layers the sky is rendered: the keys `model`, `polarising_filter`, `tolerance` and `layers`.
    pub light: LightOptions,
    /// The night.
    pub night: NightOptions,
    /// The state of the air.
    pub atmosphere: SceneAtmosphere,
    /// The image.
    pub probe: ProbeSettings,
    /// What belongs to the files rather than to the light.
    pub file: FileOptions,
    /// Files to write: .exr, .hdr or .png.
    pub output: Vec<PathBuf>,
}

/// Where the Sun is put.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SunPosition {
    /// Airless altitude, -90 to 90 [degrees].
    pub altitude_deg: f64,
    /// Azimuth from north through east [degrees].
    pub azimuth_deg: f64,
}

/// The state of the air and how finely its light is solved: one table in JSON.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneAtmosphere {
    /// What the air is made of.
    pub air: AirParameters,
    /// How finely the light is solved.
    pub quality: Quality,
    /// Whether light is solved with its polarisation; as a scalar it is wrong by several per cent, only to compare with scalar codes.
    pub polarisation: bool,
    /// Wavelengths at which light is solved instead of those of the quality: ascending, 300 to 1000 [nm].
    pub wavelengths_nm: Option<Vec<f64>>,
}

impl Default for SceneAtmosphere {
    fn default() -> Self {
        Self { air: AirParameters::default(), quality: Quality::default(), polarisation: true, wavelengths_nm: None }
    }
}

/// The top level as it is written, its tables still unread.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Document {
    latitude: Option<f64>,
    longitude: Option<f64>,
    elevation_m: Option<f64>,
    place: Option<String>,
    time: Option<String>,
    zone: Option<String>,
    sun: Option<Value>,
    sun_model: SunModel,
    model: Model,
    polarising_filter: Option<Value>,
    tolerance: Option<f64>,
    layers: Option<Value>,
    night: Option<Value>,
    atmosphere: Option<Value>,
    probe: Option<Value>,
    file: Option<Value>,
    output: Option<Value>,
}

/// The keys of the table `atmosphere` that are not the air's.
#[derive(Deserialize)]
struct SolveKeys {
    #[serde(default)]
    quality: Quality,
    #[serde(default = "yes")]
    polarisation: bool,
    wavelengths_nm: Option<Vec<f64>>,
}

fn yes() -> bool {
    true
}

impl Scene {
    /// Reads and checks a configuration file: JSON, or a picture of skyprobe (EXR, HDR), whose header holds the configuration that it was made from; what had no
    /// say in the picture is left out then. `-` is the standard input.
    ///
    /// # Errors
    /// [`Error::Input`] if the file cannot be read or holds no configuration, for `config`, or as [`Scene::from_json`], with the name of the file.
    pub fn read(path: &Path) -> Result<Self> {
        let name = if path.as_os_str() == STANDARD { "the standard input".to_owned() } else { path.display().to_string() };
        let in_file = |error| match error {
            Error::Input { parameter, value, allowed } if parameter == "config" && value == "text" => {
                Error::input("config", &name, allowed)
            }
            Error::Input { parameter, value, allowed } => {
                Error::Input { parameter, value, allowed: format!("{allowed} (in {name})") }
            }
            other => other,
        };
        let source = source::text_of(path, &name)?;
        if !source.is_header {
            return Self::from_json(&source.text).map_err(in_file);
        }
        // Headers of former versions tell of settings that were out of force.
        let scene = json::parse("config", &source.text).and_then(|value| Self::read_value(&value)).map_err(in_file)?;
        Ok(scene.without_ignored())
    }

    /// Reads and checks a configuration. What is missing has its default; place and time may be missing, too.
    ///
    /// # Errors
    /// [`Error::Input`] for text that is not JSON, an unknown key, a key that stands twice, a value of the wrong type or out of range, or one that would be
    /// ignored ([`Scene::ignored`]); it names the key with its table, such as `atmosphere.turbidity`.
    pub fn from_json(text: &str) -> Result<Self> {
        Self::from_value(&json::parse("config", text)?)
    }

    /// As [`Scene::from_json`], of JSON that was parsed.
    ///
    /// # Errors
    /// As [`Scene::from_json`].
    pub fn from_value(value: &Value) -> Result<Self> {
        let scene = Self::read_value(value)?;
        scene.refuse_ignored()?;
        Ok(scene)
    }

    /// As [`Scene::from_value`], without what would be ignored: for hosts that keep settings which are out of force.
    ///
    /// # Errors
    /// As [`Scene::from_value`], but for what would be ignored.
    pub fn from_value_in_force(value: &Value) -> Result<Self> {
        Ok(Self::read_value(value)?.without_ignored())
    }

    /// As [`Scene::from_value`], also with what would be ignored.
    fn read_value(value: &Value) -> Result<Self> {
        let document: Document = json::read("", value)?;
        let mut config = Self {
            latitude: document.latitude,
            longitude: document.longitude,
            elevation_m: 0.0,
            place_label: None,
            time: document.time,
            zone: document.zone,
            sun: document.sun.map(|sun| json::read("sun", &sun)).transpose()?,
            sun_model: document.sun_model,
            light: LightOptions {
                model: document.model,
                polarising_filter: document
                    .polarising_filter
                    .map(|filter| json::read::<PolarisingFilter>("polarising_filter", &filter))
                    .transpose()?,
                tolerance: document.tolerance,
                layers: document.layers.map(|layers| json::read("layers", &layers)).transpose()?.unwrap_or_default(),
            },
            night: document.night.map(|night| json::read("night", &night)).transpose()?.unwrap_or_default(),
            atmosphere: document
                .atmosphere
                .map(|air| SceneAtmosphere::from_value("atmosphere", &air))
                .transpose()?
                .unwrap_or_default(),
            probe: document.probe.map(|probe| json::read("probe", &probe)).transpose()?.unwrap_or_default(),
            file: document.file.map(|file| json::read("file", &file)).transpose()?.unwrap_or_default(),
            output: document.output.map_or(Ok(Vec::new()), |output| read_output(&output))?,
        };
        if let Some(text) = &document.place {
            if config.latitude.is_some() || config.longitude.is_some() || config.sun.is_some() {
                let allowed = "left out where latitude and longitude, or a Sun, are given, or given alone";
                return Err(Error::input("place", format!("{text:?}"), allowed));
            }
            config.set_place(text)?;
        }
        config.elevation_m = document.elevation_m.unwrap_or(config.elevation_m);
        config.validate_sections(["sun", "atmosphere", "probe", "file"])?;
        Ok(config)
    }

    /// Takes latitude, longitude and elevation of the place that `text` names, or whose coordinates it is.
    ///
    /// # Errors
    /// As [`crate::places::locate`].
    pub fn set_place(&mut self, text: &str) -> Result<()> {
        let Location { latitude_deg, longitude_deg, elevation_m, label, .. } = locate(text)?;
        (self.latitude, self.longitude, self.elevation_m) = (Some(latitude_deg), Some(longitude_deg), elevation_m);
        self.place_label = Some(label);
        Ok(())
    }

    /// Writes the present instant where the time is `now`, in the zone that is named, else that of the place: so that it stays the same from here on.
    /// Returns whether it did.
    ///
    /// # Errors
    /// As [`Time::parse`].
    pub fn settle_now(&mut self) -> Result<bool> {
        let Some(text) = self.time.as_deref().filter(|text| text.trim().eq_ignore_ascii_case("now")) else { return Ok(false) };
        let now = Time::parse(text, self.zone_choice())?;
        let zone = now.zone_name().map_or_else(String::new, |zone| format!("[{zone}]"));
        self.time = Some(format!("{now}{zone}"));
        Ok(true)
    }

    /// What had to be assumed about the time, as [`Time::notice`]; `None` too where the time cannot be read.
    pub fn time_notice(&self) -> Option<String> {
        let time = Time::parse(self.time.as_deref()?, self.zone_choice()).ok()?;
        time.notice().map(str::to_string)
    }

    fn zone_choice(&self) -> ZoneChoice<'_> {
        match (&self.zone, self.latitude, self.longitude) {
            (Some(zone), ..) => ZoneChoice::Named(zone),
            (None, Some(latitude_deg), Some(longitude_deg)) => ZoneChoice::OfPlace { latitude_deg, longitude_deg },
            _ => ZoneChoice::InText,
        }
    }

    /// The configuration with every value written out, as indented JSON.
    pub fn to_json(&self) -> String {
        format!("{:#}", self.to_value())
    }

    /// The configuration with every value written out.
    pub fn to_value(&self) -> Value {
        let mut map = Map::new();
        let mut put = |key: &str, value: Value| {
            if !value.is_null() {
                map.insert(key.to_string(), value);
            }
        };
        put("latitude", value_of(&self.latitude));
        put("longitude", value_of(&self.longitude));
        put("elevation_m", value_of(&self.elevation_m));
        put("time", value_of(&self.time));
        put("zone", value_of(&self.zone));
        put("sun", value_of(&self.sun));
        put("sun_model", value_of(&self.sun_model));
        put("model", value_of(&self.light.model));
        put("polarising_filter", value_of(&self.light.polarising_filter));
        put("tolerance", value_of(&self.light.tolerance));
        if !self.light.layers.0.is_empty() {
            put("layers", value_of(&self.light.layers));
        }
        put("night", value_of(&self.night));
        put("atmosphere", self.atmosphere.to_value());
        put("probe", value_of(&self.probe));
        put("file", value_of(&self.file));
        if !self.output.is_empty() {
            put("output", self.output.iter().map(|path| Value::from(path.to_string_lossy())).collect());
        }
        Value::Object(map)
    }

    /// Checks the range of every value that is given, that the Sun is not given twice, and that nothing is asked for that would be ignored ([`Scene::ignored`]).
    ///
    /// # Errors
    /// [`Error::Input`] that names the parameter.
    pub fn validate(&self) -> Result<()> {
        self.validate_sections([""; 4])?;
        self.refuse_ignored()
    }

    /// As [`Scene::validate`], with the names of the tables in front of the parameters in errors.
    fn validate_sections(&self, [sun_table, air_table, probe_table, file_table]: [&str; 4]) -> Result<()> {
        Place::new(self.latitude.unwrap_or(0.0), self.longitude.unwrap_or(0.0), self.elevation_m)?;
        if let Some(sun) = &self.sun {
            if self.latitude.is_some() || self.longitude.is_some() || self.time.is_some() {
                return Err(Error::input("sun", sun, "left out where place and time are given, or given alone"));
            }
            for (row, value) in PUT_SUN.iter().zip([sun.altitude_deg, sun.azimuth_deg]) {
                value.check(row, &json::join(sun_table, row.name))?;
            }
        }
        if self.time.is_some() || self.zone.is_some() {
            // Without a place its zone is not known yet; UTC serves to check the spelling, and any time that of a zone.
            let (time, zone) = (self.time.as_deref().unwrap_or("now"), self.zone.as_deref().unwrap_or("UTC"));
            Time::parse(time, ZoneChoice::Named(zone))?;
        }
        self.file.check_ranges().map_err(|error| json::within(file_table, error))?;
        let SceneAtmosphere { air, wavelengths_nm, .. } = &self.atmosphere;
        air.validate().map_err(|error| json::within(air_table, error))?;
        if let Some(wavelengths_nm) = wavelengths_nm {
            check_chosen_wavelengths(wavelengths_nm).map_err(|error| json::within(air_table, error))?;
        }
        self.light.validate()?;
        self.night.validate()?;
        self.probe.validate().map_err(|error| json::within(probe_table, error))
    }

    /// The place.
    ///
    /// # Errors
    /// [`Error::Input`] if latitude or longitude is missing or out of range.
    pub fn place(&self) -> Result<Place> {
        let given = |name: &str, value: Option<f64>| {
            value.ok_or_else(|| {
                Error::input(name, "nothing", "given, together with the time, or the Sun's altitude and azimuth instead")
            })
        };
        Place::new(given("latitude", self.latitude)?, given("longitude", self.longitude)?, self.elevation_m)
    }

    /// The air, not solved yet.
    ///
    /// # Errors
    /// [`Error::Input`] that names the parameter.
    pub fn atmosphere(&self) -> Result<Atmosphere> {
        self.atmosphere.to_solve()
    }

    /// The sky of `atmosphere` over the place at the time, or under the Sun that is put.
    ///
    /// # Errors
    /// [`Error::Input`] if place, time and Sun are missing or out of range.
    pub fn sky(&self, atmosphere: Arc<Atmosphere>) -> Result<Sky> {
        if let Some(sun) = &self.sun {
            return Sky::with_sun(sun.altitude_deg, sun.azimuth_deg, self.elevation_m, atmosphere)?.with_night(self.night);
        }
        let place = self.place()?;
        let Some(text) = &self.time else {
            return Err(Error::input("time", "nothing", "given, such as 2005-06-21T13:00:00+02:00"));
        };
        Sky::new(place, time_at(&place, text, self.zone.as_deref())?, self.sun_model, atmosphere)?.with_night(self.night)
    }
}

/// The instant that `text` means at `place`: a text without offset is local time in `zone`, or in the zone of the place.
///
/// # Errors
/// [`Error::Input`] as [`Time::parse`].
pub fn time_at(place: &Place, text: &str, zone: Option<&str>) -> Result<Time> {
    let Place { latitude_deg, longitude_deg, .. } = *place;
    Time::parse(text, zone.map_or(ZoneChoice::OfPlace { latitude_deg, longitude_deg }, ZoneChoice::Named))
}

impl SceneAtmosphere {
    /// The rows of the table of parameters that say how the light is solved.
    pub(crate) const SOLVE: &'static [Parameter] = &[
        row::words(Quality::WORDS)
            .named("atmosphere", "quality", "How finely the light is solved")
            .default("\"standard\"")
            .option("quality", "NAME"),
        row::flag()
            .named("atmosphere", "polarisation", "Solve light with its polarisation")
            .default("true")
            .option("polarisation", "")
            .off("no-polarisation")
            .detail()
            .more("As a scalar it is wrong by several per cent: only to compare with scalar codes."),
        Parameter::new(Kind::Ascending { low: 300.0, high: 1000.0 }, "nm")
            .named("atmosphere", "wavelengths_nm", "Wavelengths at which light is solved instead of those of the quality")
            .more("A probe and an illuminance need at least four, from 450 or less to 650 or more."),
    ];

    /// Reads the table found under the key `path`.
    ///
    /// # Errors
    /// [`Error::Input`] that names the key.
    pub fn from_value(path: &str, value: &Value) -> Result<Self> {
        let SolveKeys { quality, polarisation, wavelengths_nm } = json::read(path, value)?;
        let mut air = value.clone();
        if let Some(map) = air.as_object_mut() {
            for key in ["quality", "polarisation", "wavelengths_nm"] {
                map.shift_remove(key);
            }
        }
        // The reader of the air does not know the keys that are not its own.
        let air = json::read(path, &air).map_err(|error| match error {
            Error::Input { parameter, value, allowed } if parameter.starts_with("unknown key ") => {
                Error::Input { parameter, value, allowed: allowed + ", quality, polarisation, wavelengths_nm" }
            }
            other => other,
        })?;
        Ok(Self { air, quality, polarisation, wavelengths_nm })
    }

    /// This air, not solved yet.
    ///
    /// # Errors
    /// [`Error::Input`] that names the parameter.
    pub fn to_solve(&self) -> Result<Atmosphere> {
        let Self { air, quality, polarisation, wavelengths_nm } = self;
        match wavelengths_nm {
            None => Atmosphere::new(air, *quality, *polarisation),
            Some(wavelengths_nm) => Atmosphere::at_wavelengths(air, wavelengths_nm, *quality, *polarisation),
        }
    }

    fn to_value(&self) -> Value {
        let mut value = value_of(&self.air);
        if let Some(map) = value.as_object_mut() {
            map.insert("quality".to_string(), value_of(&self.quality));
            map.insert("polarisation".to_string(), Value::Bool(self.polarisation));
            if let Some(wavelengths_nm) = &self.wavelengths_nm {
                map.insert("wavelengths_nm".to_string(), value_of(wavelengths_nm));
            }
        }
        value
    }
}

impl std::fmt::Display for SunPosition {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "altitude {}, azimuth {}", self.altitude_deg, self.azimuth_deg)
    }
}

/// A value as JSON; numbers that JSON cannot hold, which no checked configuration has, become null.
fn value_of<T: Serialize>(value: &T) -> Value {
    serde_json::to_value(value).unwrap_or(Value::Null)
}

fn read_output(value: &Value) -> Result<Vec<PathBuf>> {
    let wrong = || Error::input("output", value, "a file name or a list of file names");
    let path = |value: &Value| value.as_str().map(PathBuf::from).ok_or_else(wrong);
    match value {
        Value::Null => Ok(Vec::new()),
        Value::Array(names) => names.iter().map(path).collect(),
        _ => Ok(vec![path(value)?]),
    }
}

#[cfg(test)]
mod tests;
