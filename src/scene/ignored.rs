//! What a scene says that has no part in its picture: told, since files hold it (every value is written out) and nobody should wonder.

use super::Scene;
use crate::io::Format;
use crate::probe::{Projection, Rows};
use crate::sky::{Layer, Model, NightOptions, When};

impl Scene {
    /// Sentences about what was given and will have no effect; none where all has.
    pub fn ignored(&self) -> Vec<String> {
        let mut told = Vec::new();
        let night = NightOptions { when: self.night.when, ..NightOptions::default() };
        let has_night = self.night != NightOptions::default();
        if self.sun.is_some() && has_night {
            told.push("night: a Sun that is put has none".to_owned());
        } else if self.light.model != Model::Scattering && has_night {
            told.push(format!("night: the model {} has none", self.light.model));
        } else if self.night.when == When::Never && self.night != night {
            told.push("night: its lights are left out by night.when = never, whatever else is said of them".to_owned());
        }
        if self.sun.is_some() && self.zone.is_some() {
            told.push("zone: a Sun that is put needs none".to_owned());
        }
        let others: Vec<&str> = self
            .light
            .layers
            .0
            .keys()
            .filter(|layer| !matches!(layer, Layer::Sky | Layer::Sun))
            .map(|layer| layer.name())
            .collect();
        if self.light.model != Model::Scattering && !others.is_empty() {
            told.push(format!("layers: the model {} has no {}", self.light.model, others.join(", ")));
        }
        if self.probe.projection == Projection::Fisheye && self.probe.rows != Rows::default() {
            told.push("probe.rows: a fisheye has no such choice".to_owned());
        }
        let has = |format: Format| self.output.iter().any(|path| Format::of(path).is_ok_and(|found| found == format));
        if !self.output.is_empty() && !has(Format::Exr) && self.file.half != crate::io::Half::default() {
            told.push("file.half: no output is an EXR".to_owned());
        }
        if !self.output.is_empty() && !has(Format::Png) && self.file.exposure_stops != 0.0 {
            told.push("file.exposure_stops: no output is a PNG".to_owned());
        }
        told
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_effect_is_told_and_what_has_is_not() {
        for (json, told) in [
            ("{}", None),
            (r#"{"sun": {"altitude_deg": 3, "azimuth_deg": 3}}"#, None),
            (r#"{"sun": {"altitude_deg": 3, "azimuth_deg": 3}, "night": {"bortle": 3}}"#, Some("night: a Sun that is put")),
            (r#"{"sun": {"altitude_deg": 3, "azimuth_deg": 3}, "zone": "UTC"}"#, Some("zone: ")),
            (r#"{"night": {"bortle": 3}}"#, None),
            (r#"{"night": {"when": "never"}}"#, None),
            (r#"{"night": {"when": "never", "bortle": 3}}"#, Some("night: its lights are left out")),
            (r#"{"model": "preetham", "night": {"bortle": 3}}"#, Some("night: the model preetham")),
            (r#"{"model": "preetham", "layers": {"sun": 0}}"#, None),
            (r#"{"model": "preetham", "layers": {"stars": 2}}"#, Some("layers: the model preetham has no stars")),
            (r#"{"probe": {"projection": "fisheye"}}"#, None),
            (r#"{"probe": {"projection": "fisheye", "rows": "corner"}}"#, Some("probe.rows: ")),
            (r#"{"output": "a.png", "file": {"exposure_stops": 1}}"#, None),
            (r#"{"output": "a.exr", "file": {"exposure_stops": 1}}"#, Some("file.exposure_stops: ")),
            (r#"{"output": ["a.hdr", "a.png"], "file": {"half": "scale"}}"#, Some("file.half: ")),
        ] {
            let found = Scene::from_json(json).unwrap().ignored();
            assert_eq!(found.len(), usize::from(told.is_some()), "{json}: {found:?}");
            assert!(found.iter().all(|sentence| sentence.starts_with(told.unwrap())), "{json}: {found:?}");
        }
    }
}
