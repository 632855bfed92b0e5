//! Reading JSON so that every error is one line that names the key.

mod strict;

pub use strict::parse;

use crate::error::{Error, Result, quoted};
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Reads the table `value`, found under the key `path` (empty for the whole document), as a `T`.
///
/// # Errors
/// [`Error::Input`] that names the path of the key, such as `probe.width`, its value and what is allowed.
pub fn read<T: DeserializeOwned>(path: &str, value: &Value) -> Result<T> {
    if !value.is_object() {
        return Err(explain(path, value, "", "expected a table of keys and values in braces"));
    }
    serde_path_to_error::deserialize(value).map_err(|error| {
        let inner = error.path().to_string();
        // "." stands for the value itself.
        let inner = if inner == "." { "" } else { inner.as_str() };
        explain(&join(path, inner), value, inner, &error.inner().to_string())
    })
}

/// Reads `text`, given for `parameter`, as one of the words of `T`.
///
/// # Errors
/// [`Error::Input`] that names the parameter and lists the words.
pub fn word<T: DeserializeOwned>(parameter: &str, text: &str) -> Result<T> {
    let value = Value::from(text);
    T::deserialize(&value).map_err(|error| explain(parameter, &value, "", &error.to_string()))
}

/// `outer.inner`, where either may be empty.
pub fn join(outer: &str, inner: &str) -> String {
    match (outer, inner) {
        ("", name) | (name, "") => name.to_string(),
        _ => format!("{outer}.{inner}"),
    }
}

/// The way to a key as messages show it: as it is if it is one of words, in quotes and not longer than a line if not.
fn shown(path: &str) -> String {
    let is_word = |letter: char| letter.is_ascii_alphanumeric() || "_-.[]".contains(letter);
    if path.len() <= 80 && path.chars().all(is_word) { path.to_string() } else { quoted(path) }
}

/// The same error for a parameter of the section `path`.
pub fn within(path: &str, error: Error) -> Error {
    match error {
        Error::Input { parameter, value, allowed } => Error::Input { parameter: join(path, &parameter), value, allowed },
        other => other,
    }
}

/// Turns what serde says into the crate's form.
fn explain(path: &str, value: &Value, inner: &str, message: &str) -> Error {
    // What the value itself contains comes before.
    let allowed = message.rsplit_once("expected ").map_or(message, |(_, allowed)| allowed).replace('`', "");
    if let Some(rest) = message.strip_prefix("unknown field `") {
        let end = ["`, expected ", "`, there "].iter().find_map(|end| rest.rsplit_once(end));
        let key = end.map_or(rest, |(key, _)| key);
        // The path ends with the unknown key or, depending on the reader, with the table that holds it.
        let path = if path == key || path.ends_with(&format!(".{key}")) { path.to_string() } else { join(path, key) };
        return Error::input(format!("unknown key {}", shown(&path)), found_in(value, inner), format!("left out, or {allowed}"));
    }
    // A reader of this crate that refuses a word says so itself.
    let allowed = message.rsplit_once(": must be ").map_or(allowed, |(_, allowed)| allowed.to_string());
    let allowed = match allowed.as_str() {
        "f64" | "f32" => "a number".to_string(),
        "usize" | "u64" | "u32" => "a whole number, 0 or larger".to_string(),
        "a boolean" => "true or false".to_string(),
        "a string" => "a text in quotes".to_string(),
        _ => allowed,
    };
    let parameter = if path.is_empty() { "configuration".to_string() } else { shown(path) };
    Error::input(parameter, found_in(value, inner), allowed)
}

/// The value under the key `inner`, as JSON, not longer than a line.
fn found_in(value: &Value, inner: &str) -> String {
    let pointer = inner.split('.').filter(|part| !part.is_empty()).try_fold(value, |at, key| at.get(key));
    found(pointer.unwrap_or(value))
}

/// The value as JSON, not longer than a line.
fn found(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() > 60 { format!("{}...", text.chars().take(57).collect::<String>()) } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;
    use serde_json::json;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "only read by the derived reader")]
    struct Table {
        #[serde(default)]
        width: usize,
        #[serde(default)]
        share: f64,
        #[serde(default)]
        inner: Inner,
    }

    #[derive(Debug, Default, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[allow(dead_code, reason = "only read by the derived reader")]
    struct Inner {
        quality: crate::quality::Quality,
    }

    fn message(value: Value) -> String {
        read::<Table>("probe", &value).unwrap_err().to_string()
    }

    #[test]
    fn words_are_read_by_name() {
        assert_eq!(word::<crate::quality::Quality>("quality", "high").unwrap(), crate::quality::Quality::High);
        let message = word::<crate::quality::Quality>("quality", "best").unwrap_err().to_string();
        assert_eq!(message, "quality = \"best\": must be one of draft, standard, high, reference");
        assert_eq!(
            read::<crate::atmosphere::AirParameters>("atmosphere", &json!({"aerosol": "smoke"})).unwrap_err().to_string(),
            "atmosphere.aerosol = \"smoke\": must be one of none, continental_clean, continental_average, continental_polluted, urban, \
             maritime_clean, maritime_polluted, maritime_tropical, desert, arctic, antarctic, fog, thesis"
        );
    }

    #[test]
    fn errors_name_the_key_the_value_and_what_is_allowed() {
        assert_eq!(message(json!({"width": -1})), "probe.width = -1: must be a whole number, 0 or larger");
        assert_eq!(message(json!({"share": "x"})), "probe.share = \"x\": must be a number");
        assert_eq!(
            message(json!({"inner": {"quality": "best"}})),
            "probe.inner.quality = \"best\": must be one of draft, standard, high, reference"
        );
        assert_eq!(
            message(json!({"heigth": 3})),
            "unknown key probe.heigth = 3: must be left out, or one of width, share, inner"
        );
        assert_eq!(message(json!({"inner": {"q": 3}})), "unknown key probe.inner.q = 3: must be left out, or quality");
        let long = message(json!({"k".repeat(160_000): 3}));
        assert!(long.starts_with("unknown key \"probe.kkk") && long.len() < 250, "{} letters", long.len());
        let colour = message(json!({"\u{1b}[31m`, x": 3}));
        assert!(colour.starts_with(r#"unknown key "probe.\u{1b}[31m`, x" = 3: must be left out"#), "{colour}");
        let wrong = message(json!({"inner": {"quality": format!("expected {}", "k".repeat(160_000))}}));
        assert!(wrong.len() < 250 && wrong.ends_with("draft, standard, high, reference"), "{} letters", wrong.len());
        assert_eq!(message(json!([1])), "probe = [1]: must be a table of keys and values in braces");
    }
}
