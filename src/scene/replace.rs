//! Other values laid over a scene: options over a configuration, keywords over a scene in Python.

use super::{Scene, parameters};
use crate::error::Result;
use serde_json::{Map, Value};

impl Scene {
    /// The same scene with other values, as JSON has them: tables change the keys that they have, null takes a value away. What the others put out of force is
    /// left out: the place of a Sun that is put, one of three amounts of haze, the rest of a night that is never shown.
    ///
    /// # Errors
    /// As [`Scene::from_value`]; values of `changes` that would be ignored are errors.
    pub fn replace(&self, changes: &Map<String, Value>) -> Result<Self> {
        let Value::Object(mut map) = self.to_value() else { return Ok(self.clone()) };
        make_way(&mut map, changes);
        for (key, value) in changes {
            match (map.get_mut(key), value) {
                (_, Value::Null) => drop(map.shift_remove(key)),
                (Some(Value::Object(table)), Value::Object(changes)) => lay(table, changes),
                (_, value) => drop(map.insert(key.clone(), value.clone())),
            }
        }
        let scene = Self::read_value(&Value::Object(map))?;
        let ignored = scene.ignored();
        if let Some(given) = ignored.iter().find(|ignored| is_given(changes, &ignored.path)) {
            return Err(given.error());
        }
        let scene = scene.without(&ignored);
        let is_elsewhere = ["place", "latitude", "longitude", "sun"].iter().any(|key| changes.contains_key(*key));
        let place_label = if is_elsewhere { scene.place_label.clone() } else { self.place_label.clone() };
        Ok(Self { place_label, ..scene })
    }
}

fn lay(table: &mut Map<String, Value>, changes: &Map<String, Value>) {
    for (name, value) in changes {
        match value {
            Value::Null => drop(table.shift_remove(name)),
            value => drop(table.insert(name.clone(), value.clone())),
        }
    }
}

/// Whether `changes` have a value at `path`.
fn is_given(changes: &Map<String, Value>, path: &str) -> bool {
    let value = match path.split_once('.') {
        None => changes.get(path),
        Some((table, name)) => changes.get(table).and_then(|table| table.get(name)),
    };
    value.is_some_and(|value| !value.is_null())
}

/// Takes what excludes a value of `changes` out of `scene`.
fn make_way(scene: &mut Map<String, Value>, changes: &Map<String, Value>) {
    let given = |path: &str| is_given(changes, path);
    if ["place", "latitude", "longitude", "time"].into_iter().any(given) {
        scene.shift_remove("sun");
    }
    if given("sun") {
        ["latitude", "longitude", "time", "zone"].iter().for_each(|name| drop(scene.shift_remove(*name)));
    }
    if given("place") {
        // It has its own.
        ["latitude", "longitude", "elevation_m"].iter().for_each(|name| drop(scene.shift_remove(*name)));
    }
    for row in parameters().filter(|row| !row.group.is_empty() && given(&row.path())) {
        for other in parameters().filter(|other| other.group == row.group) {
            if let Some(table) = scene.get_mut(other.table).and_then(Value::as_object_mut) {
                table.shift_remove(other.name);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn replaced(scene: &str, changes: &Value) -> std::result::Result<Value, String> {
        let scene = Scene::from_json(scene).unwrap().replace(changes.as_object().unwrap());
        scene.map(|scene| scene.to_value()).map_err(|error| error.to_string())
    }

    #[test]
    fn what_others_put_out_of_force_goes() {
        let lund = r#"{"place": "Lund, Sweden", "time": "2005-01-10T23:00", "zone": "UTC", "night": {"bortle": 3},
            "atmosphere": {"aod550": 0.2}, "layers": {"stars": 2, "sky": 3}}"#;
        for (changes, wanted) in [
            (json!({}), lund.to_owned()),
            (json!({"night": {"bortle": 4}}), lund.replace("\"bortle\": 3", "\"bortle\": 4")),
            (json!({"night": {"zenith_brightness": 20}}), lund.replace("\"bortle\": 3", "\"zenith_brightness\": 20")),
            (json!({"atmosphere": {"turbidity": 3}}), lund.replace("\"aod550\": 0.2", "\"turbidity\": 3")),
            (json!({"night": {"when": "never"}, "layers": {"sky": null}}),
                r#"{"place": "Lund, Sweden", "time": "2005-01-10T23:00", "zone": "UTC", "night": {"when": "never"}, "atmosphere": {"aod550": 0.2}}"#.to_owned()),
            (json!({"place": "Santorini"}), lund.replace("Lund, Sweden", "Santorini")),
            (json!({"sun": {"altitude_deg": 5, "azimuth_deg": 6}}),
                r#"{"sun": {"altitude_deg": 5, "azimuth_deg": 6}, "elevation_m": 51, "atmosphere": {"aod550": 0.2}, "layers": {"sky": 3}}"#.to_owned()),
        ] {
            assert_eq!(replaced(lund, &changes), Ok(Scene::from_json(&wanted).unwrap().to_value()), "{changes}");
        }
        let sun = r#"{"sun": {"altitude_deg": 5, "azimuth_deg": 6}}"#;
        let noon = json!({"latitude": 3, "longitude": 4, "time": "2005-06-21T13:00"});
        assert_eq!(replaced(sun, &noon), Ok(Scene::from_value(&noon).unwrap().to_value()));
        let named = Scene::from_json(lund).unwrap();
        let label = |changes: Value| named.replace(changes.as_object().unwrap()).unwrap().place_label;
        assert_eq!(label(json!({"time": "2005-06-21T13:00"})), named.place_label);
        assert_eq!((label(json!({"latitude": 3})), label(json!({"place": "Santorini"})).is_some()), (None, true));
    }

    #[test]
    fn what_is_laid_over_it_counts_or_is_refused() {
        for (scene, changes, start) in [
            (
                "{}",
                json!({"night": {"when": "never", "bortle": 4}}),
                "night.bortle = 4: must be left out where night.when is never",
            ),
            (r#"{"night": {"when": "never"}}"#, json!({"layers": {"moon": 2}}), "layers.moon = 2: must be left out"),
            ("{}", json!({"atmosphere": {"aod550": 0.1, "turbidity": 3}}), "atmosphere.turbidity = 3: must be left out"),
            ("{}", json!({"place": "Lund", "latitude": 3}), "place = \"Lund\": must be left out"),
            ("{}", json!({"sun": {"altitude_deg": 5, "azimuth_deg": 6}, "latitude": 3}), "sun = altitude 5, azimuth 6: must be"),
            (r#"{"sun": {"altitude_deg": 5, "azimuth_deg": 6}}"#, json!({"zone": "UTC"}), "zone = \"UTC\": must be left out"),
            ("{}", json!({"nigth": {}}), "unknown key nigth"),
        ] {
            let message = replaced(scene, &changes).unwrap_err();
            assert!(message.starts_with(start), "{message}");
        }
    }
}
