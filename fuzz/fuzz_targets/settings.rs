//! Tables of settings in JSON, each read apart: an error that is one line, or what can be checked.
#![no_main]

use libfuzzer_sys::fuzz_target;
use serde::de::DeserializeOwned;
use skyprobe::{Result, atmosphere, post, probe, scene::json, sky};

fn read<T: DeserializeOwned>(value: &serde_json::Value, validate: impl Fn(&T) -> Result<()>) {
    match json::read::<T>("settings", value).and_then(|settings| validate(&settings)) {
        Ok(()) => {}
        Err(error) => assert_eq!(error.to_string().lines().count(), 1, "{error}"),
    }
}

fuzz_target!(|text: &str| {
    let Ok(value) = serde_json::from_str(text) else { return };
    read::<atmosphere::AirParameters>(&value, |settings| settings.validate());
    read::<probe::ProbeSettings>(&value, |settings| settings.validate());
    read::<sky::NightOptions>(&value, |settings| settings.validate());
    read::<sky::PolarisingFilter>(&value, |settings| settings.validate());
    // Tone mapping: an operator by name, its numbers by theirs.
    let (Some(operator), Some(table)) = (value.get("operator").and_then(|name| name.as_str()), value.as_object()) else { return };
    let Ok(name) = operator.parse::<post::tone::OperatorName>() else { return };
    let mut operator = post::tone::Operator::from(name);
    for (name, number) in table {
        let _ = operator.set(name, number.as_f64().unwrap_or(f64::NAN));
    }
    operator.validate().expect("what was set is within its range");
});
