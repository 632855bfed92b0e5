//! JSON text in which every key stands once.

use super::{found, join, shown};
use crate::error::{Error, Result};
use serde::de::{DeserializeSeed, Error as _, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};
use std::cell::RefCell;
use std::fmt;

/// Reads JSON text that was given for `parameter`.
///
/// # Errors
/// [`Error::Input`] for text that is not JSON, and for a key that a table has twice, of which one value would be lost; it names the key with its table, such as
/// `atmosphere.turbidity`.
pub fn parse(parameter: &str, text: &str) -> Result<Value> {
    let twice = RefCell::new(None);
    let mut reader = serde_json::Deserializer::from_str(text);
    let value = At { step: Step::Whole, twice: &twice }.deserialize(&mut reader);
    value.and_then(|value| reader.end().map(|()| value)).map_err(|error| match twice.take() {
        Some((path, first, second)) => {
            let values = format!("{} and {}", found(&first), found(&second));
            Error::input(shown(&path), values, format!("given once (line {})", error.line()))
        }
        None => Error::input(parameter, "text", format!("JSON ({error})")),
    })
}

/// A key that stands twice, and its values.
type Twice = RefCell<Option<(String, Value, Value)>>;

/// Reads the value at `step`.
struct At<'a> {
    step: Step<'a>,
    twice: &'a Twice,
}

/// The way to a value; text only once that is asked for, since a long key has many values.
#[derive(Clone, Copy)]
enum Step<'a> {
    /// The whole text.
    Whole,
    /// Under a key of the table there.
    Key(&'a Step<'a>, &'a str),
    /// In this place of the list there.
    Index(&'a Step<'a>, usize),
}

impl Step<'_> {
    /// Such as `atmosphere.components.0.kind`.
    fn path(&self) -> String {
        match self {
            Self::Whole => String::new(),
            Self::Key(outer, key) => join(&outer.path(), key),
            Self::Index(outer, index) => join(&outer.path(), &index.to_string()),
        }
    }
}

impl<'de> DeserializeSeed<'de> for At<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, reader: D) -> std::result::Result<Value, D::Error> {
        reader.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for At<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value of JSON")
    }

    fn visit_bool<E>(self, value: bool) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E>(self, value: &str) -> std::result::Result<Value, E> {
        Ok(value.into())
    }

    fn visit_unit<E>(self) -> std::result::Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> std::result::Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(value) = items.next_element_seed(self.within(Step::Index(&self.step, list.len())))? {
            list.push(value);
        }
        Ok(list.into())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> std::result::Result<Value, A::Error> {
        let mut table = Map::new();
        while let Some(key) = entries.next_key_seed(Key)? {
            let value = entries.next_value_seed(self.within(Step::Key(&self.step, &key)))?;
            if let Some(first) = table.get(&key) {
                self.twice.replace(Some((Step::Key(&self.step, &key).path(), first.clone(), value)));
                return Err(A::Error::custom("a key that stands twice"));
            }
            table.insert(key, value);
        }
        Ok(table.into())
    }
}

impl At<'_> {
    fn within<'a>(&'a self, step: Step<'a>) -> At<'a> {
        At { step, twice: self.twice }
    }
}

/// Reads a key.
struct Key;

impl<'de> DeserializeSeed<'de> for Key {
    type Value = String;

    fn deserialize<D: Deserializer<'de>>(self, reader: D) -> std::result::Result<String, D::Error> {
        String::deserialize(reader)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_read_as_it_stands() {
        let text = r#"{"b": [1, -2, 0.1, 1e300, 18446744073709551615, null, true, {"x": {}}], "a": "\u00e5\n", "": {}}"#;
        let value = parse("config", text).unwrap();
        assert_eq!(value, serde_json::from_str::<Value>(text).unwrap());
        assert_eq!(value.to_string(), serde_json::from_str::<Value>(text).unwrap().to_string());
    }

    #[test]
    fn a_key_that_stands_twice_is_named() {
        let message = |text: &str| parse("config", text).unwrap_err().to_string();
        assert_eq!(message("{\"elevation_m\": 1,\n \"elevation_m\": 1}"), "elevation_m = 1 and 1: must be given once (line 2)");
        assert!(message(r#"{"night": {"bortle": 3, "x": {}, "bortle": 4}}"#).starts_with("night.bortle = 3 and 4: must be"));
        assert!(message(r#"{"a": [0, {"b": {"c": 1, "c": 2}}]}"#).starts_with("a.1.b.c = 1 and 2: must be"));
        assert!(message(r#"{"a": {}, "a": {}}"#).starts_with("a = {} and {}: must be"));
    }

    #[test]
    fn a_key_that_stands_twice_is_shown_on_one_short_line() {
        let long = "k".repeat(160_000);
        let value = format!("\"{}\"", "v".repeat(160_000));
        for text in [
            format!(r#"{{"{long}": 1, "{long}": 2}}"#),
            format!(r#"{{"{long}": {{"a": 1, "a": 2}}}}"#),
            format!(r#"{{"a": {value}, "a": {value}}}"#),
            format!("{}{}{}", r#"{"k": ["#.repeat(40), r#"{"a": 1, "a": 2}"#, "]}".repeat(40)),
        ] {
            let message = parse("config", &text).unwrap_err().to_string();
            assert!(message.len() < 300 && message.contains(" must be given once"), "{} letters", message.len());
        }
        let message = parse("config", "{\"\\u001b[31m\": 1, \"\\u001b[31m\": 2}").unwrap_err().to_string();
        assert_eq!(message, "\"\\u{1b}[31m\" = 1 and 2: must be given once (line 1)");
    }

    /// Or a long key over many values would be copied as often.
    #[test]
    fn the_way_to_a_value_is_not_copied_for_each() {
        let (key, item) = ("k".repeat(1000), "k");
        let outer = Step::Key(&Step::Whole, &key);
        let inner = Step::Index(&outer, 7);
        assert_eq!(Step::Key(&inner, item).path(), format!("{key}.7.k"));
        assert!(!std::mem::needs_drop::<Step<'_>>() && !std::mem::needs_drop::<At<'_>>());
    }

    #[test]
    fn what_is_no_json_is_told_with_its_place() {
        for (text, part) in
            [("", "EOF"), ("{\n \"a\": }", "line 2"), ("{} {}", "trailing"), ("\u{feff}{}", "line 1"), ("NaN", "line 1")]
        {
            let message = parse("config", text).unwrap_err().to_string();
            assert!(message.starts_with("config = text: must be JSON (") && message.contains(part), "{message}");
        }
        // Nested deeper than any configuration: an error, and no overflow.
        assert!(parse("config", &"[".repeat(100_000)).unwrap_err().to_string().contains("recursion"));
    }
}
