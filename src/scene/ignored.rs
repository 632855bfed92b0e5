//! What in a scene would have no say in its picture: an error where it was asked for, left out where it is merely there.
//!
//! A value that asks for what comes anyway is none of it: defaults, and words or numbers that leave out what is not there (`night.when` never where the Sun is put,
//! a layer's factor of 0, `probe.ground` off for the upper half).

use super::Scene;
use crate::atmosphere::AerosolType;
use crate::error::{Error, Result};
use crate::io::Format;
use crate::probe::{Extent, GroundView, Projection, Rows};
use crate::sky::{Layer, Model, NightOptions, When};
use crate::spectrum::{ColorSpace, Gamut};
use serde_json::Value;

/// A value that is given and would be ignored.
#[derive(Clone, Debug, PartialEq)]
pub struct Ignored {
    /// The way to it, such as `night.bortle`.
    pub path: String,
    /// What is given.
    pub value: Value,
    /// Why it has no say, to be read after "left out".
    pub why: String,
}

impl Ignored {
    /// That it has to be left out.
    pub fn error(&self) -> Error {
        // A number as it is typed.
        let value = self.value.as_f64().map_or_else(|| self.value.to_string(), |number| number.to_string());
        Error::input(self.path.as_str(), value, format!("left out {}", self.why))
    }
}

impl Scene {
    /// All values that are given and would be ignored, as [`Scene::from_value`] and [`Scene::validate`] refuse them.
    pub fn ignored(&self) -> Vec<Ignored> {
        let (given, default) = (self.to_value(), Self::default().to_value());
        let mut found: Vec<Ignored> = Vec::new();
        for (path, why) in self.without_say() {
            let at = format!("/{}", path.replace('.', "/"));
            let Some(value) = given.pointer(&at).filter(|&value| default.pointer(&at) != Some(value)) else { continue };
            if found.iter().all(|other| other.path != path) {
                found.push(Ignored { path, value: value.clone(), why });
            }
        }
        found
    }

    /// The same scene without what would be ignored: what hosts write that keep settings which are out of force.
    pub fn without_ignored(&self) -> Self {
        self.without(&self.ignored())
    }

    /// The same scene without some values.
    pub(super) fn without(&self, ignored: &[Ignored]) -> Self {
        if ignored.is_empty() {
            return self.clone();
        }
        let mut value = self.to_value();
        for Ignored { path, .. } in ignored {
            let (table, name) = path.rsplit_once('.').unwrap_or(("", path));
            let at = if table.is_empty() { String::new() } else { format!("/{table}") };
            if let Some(table) = value.pointer_mut(&at).and_then(Value::as_object_mut) {
                table.shift_remove(name);
            }
        }
        // What was read or made before is read with less in it; a scene with numbers that JSON cannot hold is left for the checks.
        let rest = Self::read_value(&value).unwrap_or_else(|_| self.clone());
        Self { place_label: self.place_label.clone(), ..rest }
    }

    /// # Errors
    /// [`Error::Input`] for the first value that would be ignored.
    pub(super) fn refuse_ignored(&self) -> Result<()> {
        self.ignored().first().map_or(Ok(()), |ignored| Err(ignored.error()))
    }

    /// The ways to what has no say here, given or not, and why.
    fn without_say(&self) -> Vec<(String, String)> {
        let mut list = List::default();
        if self.sun.is_some() {
            list.add(["zone", "sun_model"], "where the Sun is put");
        }
        self.add_night(&mut list);
        self.add_air(&mut list);
        self.add_picture(&mut list);
        list.0
    }

    fn add_night(&self, list: &mut List) {
        let no_night = match (self.night.when, self.sun, self.light.model) {
            (When::Never, ..) => Some("where night.when is never".to_owned()),
            (_, Some(_), _) => Some("where the Sun is put, which has no night".to_owned()),
            (_, None, Model::Scattering) => None,
            (_, None, model) => Some(format!("for the model {model}, which knows no night")),
        };
        let layers = |is_there: fn(Layer) -> bool| Layer::ALL.into_iter().filter(move |&layer| !is_there(layer));
        let factors = |layers: &mut dyn Iterator<Item = Layer>, list: &mut List, why: &str| {
            for layer in layers.filter(|&layer| ![0.0, 1.0].contains(&self.light.layers.of(layer))) {
                list.add([format!("layers.{layer}")], why);
            }
        };
        if let Some(why) = no_night {
            let is_asked = |name: &str| name != "when" || self.night.when == When::Always;
            let rows = NightOptions::PARAMETERS.iter().filter(|row| is_asked(row.name));
            list.add(rows.map(|row| row.path()), &why);
            factors(&mut layers(|layer| matches!(layer, Layer::Sky | Layer::Sun)), list, &why);
        } else if self.night.bortle.is_none() && self.night.zenith_brightness.is_none() {
            let why = "where neither night.bortle nor night.zenith_brightness says that there are towns";
            list.add(["night.led_share"], why);
            factors(&mut layers(|layer| layer != Layer::LightPollution), list, why);
        }
    }

    fn add_air(&self, list: &mut List) {
        let air = &self.atmosphere.air;
        let preset = air.preset.parameters();
        let aerosol = air.aerosol.or(preset.aerosol).unwrap_or(AerosolType::None);
        let own = ["relative_humidity", "phase_function", "angstrom_exponent", "single_scattering_albedo", "asymmetry"];
        if aerosol == AerosolType::None {
            list.add(own.into_iter().chain(["aerosol_scale_height_km"]).map(of_air), "where the aerosol is none");
        } else if !aerosol.is_made_of_particles() {
            let why = format!("for the aerosol {aerosol}, whose particles are not known");
            list.add(["relative_humidity"].map(of_air), &why);
        }
        if air.stratospheric_aod550.or(preset.stratospheric_aod550).is_none() {
            let why = "where atmosphere.stratospheric_aod550 says nothing of such haze, nor the preset";
            list.add(["stratospheric_altitude_km"].map(of_air), why);
        }
        match self.light.model {
            Model::Scattering => {}
            Model::Preetham => {
                let more = ["ozone_du", "stratospheric_aod550", "stratospheric_altitude_km"];
                let why = "for the model preetham, which knows of the air how much aerosol there is";
                list.add(own.into_iter().chain(more).map(of_air), why);
            }
            Model::Thesis | Model::ThesisSingle => {
                let why = format!("for the model {}, which has wavelengths of its own", self.light.model);
                list.add(["quality", "wavelengths_nm"].map(of_air), &why);
            }
        }
    }

    fn add_picture(&self, list: &mut List) {
        if self.probe.projection == Projection::Fisheye && self.probe.rows != Rows::Centre {
            list.add(["probe.rows"], "for a fisheye");
        }
        if self.probe.extent == Extent::Upper && self.probe.ground == GroundView::Mirrored {
            list.add(["probe.ground"], "where probe.extent is upper, which shows no ground");
        }
        if self.probe.color_space == ColorSpace::Xyz && self.probe.gamut == Gamut::Clip {
            list.add(["probe.gamut"], "for xyz, which holds every colour");
        }
        let lacks = |wanted: Format| {
            let is_other = |path: &std::path::PathBuf| Format::of(path).is_ok_and(|format| format != wanted);
            !self.output.is_empty() && self.output.iter().all(is_other)
        };
        if lacks(Format::Exr) {
            list.add(["file.layers", "file.half"], "without an output that ends in .exr");
        }
        if lacks(Format::Png) {
            list.add(["file.exposure_stops", "file.operator"], "without an output that ends in .png");
        }
    }
}

/// Ways to values, and why they have no say.
#[derive(Default)]
struct List(Vec<(String, String)>);

impl List {
    fn add(&mut self, paths: impl IntoIterator<Item = impl Into<String>>, why: &str) {
        self.0.extend(paths.into_iter().map(|path| (path.into(), why.to_owned())));
    }
}

fn of_air(name: &str) -> String {
    format!("atmosphere.{name}")
}
