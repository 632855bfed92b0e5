//! What the header of a file says about the sky in it.

use super::{Scene, SceneAtmosphere, SunPosition};
use crate::ephemeris::SunModel;
use crate::io::{FileOptions, Metadata};
use crate::probe::ProbeSettings;
use crate::sky::{LightOptions, Sky};
use crate::time::Time;

/// The facts about a probe of `sky` by the model of the Sun's place, made with `light` and `settings`, with the configuration that makes it again unless its air was given as a profile.
pub fn describe(sky: &Sky, sun_model: SunModel, light: &LightOptions, settings: &ProbeSettings) -> Metadata {
    let (place, time, sun) = (sky.place(), sky.time(), sky.sun());
    Metadata {
        latitude_deg: place.map(|place| place.latitude_deg),
        longitude_deg: place.map(|place| place.longitude_deg),
        elevation_m: Some(sky.elevation_m()),
        capture_date: time.map(capture_date),
        utc_offset_s: time.map(|time| -f64::from(time.utc_offset_s())),
        sun_altitude_deg: Some(sun.altitude_deg),
        sun_azimuth_deg: Some(sun.azimuth_deg),
        config_json: Scene::of(sky, sun_model, light, settings).map(|config| config.to_value().to_string()),
        comments: None,
    }
}

impl Scene {
    /// The scene that makes a probe of `sky` again, without what has no say in it ([`Scene::ignored`]); `None` if its air was given as a profile.
    pub fn of(sky: &Sky, sun_model: SunModel, light: &LightOptions, settings: &ProbeSettings) -> Option<Scene> {
        let (place, time, atmosphere, sun) = (sky.place(), sky.time(), sky.atmosphere(), sky.sun());
        let put = SunPosition { altitude_deg: sun.altitude_deg, azimuth_deg: sun.azimuth_deg };
        let scene = Scene {
            latitude: place.map(|place| place.latitude_deg),
            longitude: place.map(|place| place.longitude_deg),
            elevation_m: sky.elevation_m(),
            place_label: None,
            time: time.map(Time::to_string),
            zone: time.and_then(Time::zone_name).map(str::to_string),
            sun: place.is_none().then_some(put),
            sun_model,
            light: light.clone(),
            night: *sky.night(),
            atmosphere: SceneAtmosphere {
                air: atmosphere.parameters()?.clone(),
                quality: atmosphere.quality(),
                polarisation: atmosphere.is_polarised(),
                wavelengths_nm: atmosphere.chosen_wavelengths().map(<[f64]>::to_vec),
            },
            probe: settings.clone(),
            file: FileOptions::default(),
            output: Vec::new(),
        };
        Some(scene.without_ignored())
    }
}

/// Date and time as OpenEXR's `capDate` wants them.
fn capture_date(time: &Time) -> String {
    let civil = time.rounded_to_second().civil();
    let (year, month, day) = (civil.year, civil.month, civil.day);
    format!("{year:04}:{month:02}:{day:02} {:02}:{:02}:{:02.0}", civil.hour, civil.minute, civil.second)
}
