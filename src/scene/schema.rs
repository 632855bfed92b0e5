//! The table of parameters in the forms that others read: JSON Schema, a table for people, values for Blender.

use super::{SECTIONS, parameters};
use crate::parameter::{DefaultValue, Kind, Parameter};
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// The JSON Schema (draft 2020-12) of a scene. It knows keys, types, ranges, words and what excludes each other; that two numbers do not fit together is said by
/// [`super::Scene::validate`] alone.
pub fn json_schema() -> Value {
    let mut top = Map::new();
    let mut tables: Map<String, Value> = Map::new();
    for row in parameters() {
        let into = if row.table.is_empty() {
            &mut top
        } else {
            let table = tables
                .entry(row.table)
                .or_insert_with(|| json!({"type": "object", "additionalProperties": false, "properties": {}}));
            let Some(properties) = table["properties"].as_object_mut() else { continue };
            properties
        };
        into.insert(row.name.to_owned(), schema_of(row));
    }
    for (name, mut table) in tables {
        exclude(&name, &mut table);
        if name == "sun" {
            table["required"] = json!(["altitude_deg", "azimuth_deg"]);
        }
        top.insert(name, json!({"anyOf": [table, {"type": "null"}]}));
    }
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A scene of skyprobe",
        "description": "All that a light probe of the sky is made from. Each key may be left out where there is a default.",
        "type": "object",
        "additionalProperties": false,
        "properties": top,
        "allOf": [
            {"not": {"required": ["place"], "anyOf": [{"required": ["latitude"]}, {"required": ["longitude"]}, {"required": ["sun"]}]}},
        ],
    })
}

/// Says in a table's schema which of its keys exclude each other.
fn exclude(table: &str, schema: &mut Value) {
    let members: Vec<&Parameter> = parameters().filter(|row| row.table == table && !row.group.is_empty()).collect();
    let given = |row: &Parameter| json!({"required": [row.name], "properties": {row.name: {"not": {"type": "null"}}}});
    let mut pairs = Vec::new();
    for (i, first) in members.iter().enumerate() {
        for second in members[i + 1..].iter().filter(|second| second.group == first.group) {
            pairs.push(json!({"not": {"allOf": [given(first), given(second)]}}));
        }
    }
    if !pairs.is_empty() {
        schema["allOf"] = Value::Array(pairs);
    }
}

fn schema_of(row: &Parameter) -> Value {
    let mut schema = match row.kind {
        Kind::Number { low, high } => json!({"type": "number", "minimum": low, "maximum": high}),
        Kind::Whole { low, high } => json!({"type": "integer", "minimum": low, "maximum": high}),
        Kind::Flag => json!({"type": "boolean"}),
        Kind::Words(words) => json!({"enum": words}),
        Kind::WordsOrNumber { words, low, high } => {
            json!({"anyOf": [{"enum": words}, {"type": "number", "minimum": low, "maximum": high}]})
        }
        Kind::Text => json!({"type": "string"}),
        Kind::Ascending { low, high } => {
            json!({"type": "array", "minItems": 1, "items": {"type": "number", "minimum": low, "maximum": high}})
        }
        Kind::Direction => json!({
            "type": "array",
            "prefixItems": [{"type": "number", "minimum": -90, "maximum": 90}, {"type": "number", "minimum": -360, "maximum": 360}],
            "minItems": 2,
            "maxItems": 2,
        }),
        Kind::Factors { words, low, high } => json!({
            "type": "object",
            "propertyNames": {"enum": words},
            "additionalProperties": {"type": "number", "minimum": low, "maximum": high},
        }),
        Kind::Files => json!({"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}),
    };
    if !matches!(row.default, DefaultValue::Value(_)) {
        // What has no value of its own may be null, which is as if it were left out.
        schema = json!({"anyOf": [schema, {"type": "null"}]});
    }
    schema["description"] = Value::from(sentence(row));
    if let DefaultValue::Value(text) = row.default
        && let Ok(value) = serde_json::from_str::<Value>(text)
    {
        schema["default"] = value;
    }
    schema
}

/// Help, unit and more of a row as sentences.
fn sentence(row: &Parameter) -> String {
    let unit = if row.unit.is_empty() { String::new() } else { format!(" [{}]", row.unit) };
    let default = match row.default {
        DefaultValue::Told(told) => format!(" Default: {told}."),
        _ => String::new(),
    };
    let more = if row.more.is_empty() { String::new() } else { format!(" {}", row.more) };
    format!("{}{unit}.{more}{default}", row.help)
}

/// The table as Markdown, a heading for each section.
pub fn markdown() -> String {
    let mut text = String::new();
    for section in SECTIONS {
        let _ = write!(
            text,
            "\n## {}\n\n| key | option | allowed | unit | default | what it is |\n|---|---|---|---|---|---|\n",
            section.title
        );
        for row in section.parameters() {
            let option = row.option.map_or_else(String::new, |option| format!("`--{}`", option.name));
            let default = row.default_in_words().unwrap_or_default();
            let more = if row.more.is_empty() { String::new() } else { format!(". {}", row.more.trim_end_matches('.')) };
            let cells =
                [format!("`{}`", row.path()), option, row.allowed(), row.unit.to_owned(), default, format!("{}{more}", row.help)];
            let _ = writeln!(text, "| {} |", cells.map(|cell| cell.replace('|', "\\|")).join(" | "));
        }
    }
    text.trim_start().to_owned()
}

/// Ranges, units, defaults and help as a Python module without imports.
pub fn python() -> String {
    let mut text = String::from("PARAMETERS = {\n");
    for row in parameters() {
        let mut entry = Map::new();
        match row.kind {
            Kind::Number { low, high } | Kind::WordsOrNumber { low, high, .. } => {
                entry.insert("low".into(), json!(low));
                entry.insert("high".into(), json!(high));
            }
            Kind::Whole { low, high } => {
                entry.insert("low".into(), json!(low));
                entry.insert("high".into(), json!(high));
            }
            _ => {}
        }
        if let Kind::Words(words) | Kind::WordsOrNumber { words, .. } | Kind::Factors { words, .. } = row.kind {
            entry.insert("words".into(), json!(words));
        }
        entry.insert("unit".into(), json!(row.unit));
        entry.insert("help".into(), json!(row.help));
        // Numbers, texts and lists are written alike in both languages.
        let _ = writeln!(text, "    {}: {},", json!(row.path()), Value::Object(entry));
    }
    text + "}\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_schema_has_every_parameter_with_its_range() {
        let schema = json_schema();
        for row in parameters() {
            let path = match row.table {
                "" => format!("/properties/{}", row.name),
                table => format!("/properties/{table}/anyOf/0/properties/{}", row.name),
            };
            let found = schema.pointer(&path).unwrap_or_else(|| panic!("{path}"));
            if let Kind::Number { low, high } = row.kind {
                let range = if found.get("minimum").is_some() { found } else { &found["anyOf"][0] };
                assert_eq!((&range["minimum"], &range["maximum"]), (&json!(low), &json!(high)), "{path}");
            }
        }
    }

    #[test]
    fn every_parameter_has_a_line_in_both_tables() {
        let (markdown, python) = (markdown(), python());
        for row in parameters() {
            assert!(
                markdown.contains(&format!("\n| `{}` |", row.path())) && python.contains(&format!("\n    \"{}\": ", row.path()))
            );
        }
    }
}
