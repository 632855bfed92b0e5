//! Random scenes, made from the table of parameters: each row is varied as its kind allows.

use super::super::{Ignored, Scene, parameters};
use super::documents::{any_document, remove};
use crate::error::Error;
use crate::io::tests::gradient;
use crate::io::{FileOptions, Metadata, save};
use crate::probe::ProbeSettings;
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;

/// `document` without the keys that contradict others, and its scene: each error names one that is there.
fn scene_of(mut document: Map<String, Value>) -> (Map<String, Value>, Scene) {
    loop {
        match Scene::read_value(&Value::Object(document.clone())) {
            Ok(scene) => return (document, scene),
            Err(Error::Input { parameter, value, allowed }) => {
                let is_found = remove(&mut document, &parameter);
                assert!(is_found, "{parameter} = {value}: must be {allowed}");
            }
            Err(other) => panic!("{other}"),
        }
    }
}

fn any_scene() -> impl Strategy<Value = Scene> {
    any_document().prop_map(|document| scene_of(document).1)
}

/// A number as a number, whether it was written as a whole one or not; a factor of 1 for every layer that has none.
fn plain(value: &Value) -> Value {
    match value {
        Value::Number(number) => json!(number.as_f64()),
        Value::Array(values) => values.iter().map(plain).collect(),
        Value::Object(table) => table
            .iter()
            .filter(|(_, value)| value.as_f64() != Some(1.0))
            .map(|(key, value)| (key.clone(), plain(value)))
            .collect(),
        other => other.clone(),
    }
}

/// What `scene` says, by the ways to it.
fn said(scene: &Scene) -> BTreeMap<String, Value> {
    let mut said = BTreeMap::new();
    for (key, value) in scene.to_value().as_object().unwrap() {
        match value.as_object() {
            Some(table) => said.extend(table.iter().map(|(name, value)| (format!("{key}.{name}"), value.clone()))),
            None => drop(said.insert(key.clone(), value.clone())),
        }
    }
    said
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn what_is_given_stands_in_what_is_written((document, scene) in any_document().prop_map(scene_of)) {
        let (written, default) = (scene.to_value(), Scene::default().to_value());
        // A place is written as the numbers that it stands for.
        for row in parameters().filter(|row| row.name != "place") {
            let at = format!("/{}", row.path().replace('.', "/"));
            let Some(given) = Value::Object(document.clone()).pointer(&at).map(plain) else { continue };
            let is_left_out = written.pointer(&at).is_none() && (given == json!(0.0) || given == json!({}) || given == json!([]));
            prop_assert!(is_left_out || written.pointer(&at).map(plain) == Some(given), "{}: {} in {}", row.path(), at, written);
            prop_assert!(default.pointer(&at).is_none() || written.pointer(&at).is_some() || is_left_out);
        }
    }

    #[test]
    fn what_is_written_reads_back_to_the_last_digit(scene in any_scene()) {
        let kept = Scene { place_label: None, ..scene.without_ignored() };
        prop_assert_eq!(&Scene::from_json(&kept.to_json()).unwrap(), &kept);
        kept.validate().unwrap();
        // What is refused is what is left out, and nothing else is.
        let ignored = scene.ignored();
        match ignored.first() {
            None => prop_assert_eq!(said(&scene), said(&kept)),
            Some(first) => {
                let told = Scene::from_json(&scene.to_json()).unwrap_err().to_string();
                prop_assert_eq!(told, first.error().to_string());
                let default = said(&Scene::default());
                let mut rest = said(&scene);
                for Ignored { path, .. } in &ignored {
                    rest.remove(path);
                    rest.extend(default.get(path).map(|value| (path.clone(), value.clone())));
                }
                prop_assert_eq!(rest, said(&kept));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn headers_of_pictures_hold_every_scene(scene in any_scene()) {
        let folder = tempfile::tempdir().unwrap();
        let probe = gradient(ProbeSettings { width: 64, ..Default::default() });
        let kept = Scene { place_label: None, ..scene.without_ignored() };
        // Also one with settings that were out of force.
        for (written, name) in [(&kept, "a.exr"), (&kept, "a.hdr"), (&scene, "b.exr")] {
            let metadata = Metadata { config_json: Some(written.to_value().to_string()), ..Default::default() };
            let path = folder.path().join(name);
            save(&path, &probe, &FileOptions::default(), &metadata).unwrap();
            prop_assert_eq!(&Scene::read(&path).unwrap(), &kept);
        }
    }

    #[test]
    fn a_sky_knows_its_scene(scene in any_scene()) {
        let scene = scene.without_ignored();
        let is_whole = scene.sun.is_some() || scene.place().is_ok() && scene.time.is_some();
        prop_assume!(is_whole);
        let Ok(air) = scene.atmosphere() else { return Ok(()) };
        let sky = scene.sky(Arc::new(air)).unwrap();
        let known = Scene::of(&sky, scene.sun_model, &scene.light, &scene.probe).unwrap();
        let wanted = Scene { time: known.time.clone(), zone: known.zone.clone(), ..scene };
        let wanted = Scene { place_label: None, file: FileOptions::default(), output: Vec::new(), ..wanted };
        let turned = |scene: &Scene| scene.sun.map(|sun| sun.azimuth_deg.rem_euclid(360.0));
        prop_assert_eq!(turned(&known), turned(&wanted));
        prop_assert_eq!(Scene { sun: wanted.sun, ..known }, wanted);
    }
}

#[test]
fn every_parameter_is_varied() {
    let mut runner = TestRunner::deterministic();
    let mut counts: BTreeMap<String, u32> = parameters().map(|row| (row.path(), 0)).collect();
    let default = said(&Scene::default());
    for _ in 0..300 {
        let scene = any_scene().new_tree(&mut runner).unwrap().current().without_ignored();
        for (path, value) in said(&scene) {
            if default.get(&path) != Some(&value) {
                let row = if path.starts_with("layers.") { "layers".to_owned() } else { path };
                *counts.get_mut(&row).unwrap_or_else(|| panic!("{row} is no parameter")) += 1;
            }
        }
        // It is written as the numbers that it stands for.
        *counts.get_mut("place").unwrap() += u32::from(scene.place_label.is_some());
    }
    assert!(counts.values().all(|&count| count >= 5), "{counts:?}");
}
