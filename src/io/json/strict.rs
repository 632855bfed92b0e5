//! JSON text in which every key stands once.

use super::join;
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
    let value = At { path: String::new(), twice: &twice }.deserialize(&mut reader);
    value.and_then(|value| reader.end().map(|()| value)).map_err(|error| match twice.take() {
        Some((key, first, second)) => {
            Error::input(key, format!("{first} and {second}"), format!("given once (line {})", error.line()))
        }
        None => Error::input(parameter, "text", format!("JSON ({error})")),
    })
}

/// A key that stands twice, and its values.
type Twice = RefCell<Option<(String, Value, Value)>>;

/// Reads the value of the key `path`.
struct At<'a> {
    path: String,
    twice: &'a Twice,
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
        while let Some(value) = items.next_element_seed(self.within(&list.len().to_string()))? {
            list.push(value);
        }
        Ok(list.into())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> std::result::Result<Value, A::Error> {
        let mut table = Map::new();
        while let Some(key) = entries.next_key_seed(Key)? {
            let value = entries.next_value_seed(self.within(&key))?;
            if let Some(first) = table.get(&key) {
                self.twice.replace(Some((join(&self.path, &key), first.clone(), value)));
                return Err(A::Error::custom("a key that stands twice"));
            }
            table.insert(key, value);
        }
        Ok(table.into())
    }
}

impl At<'_> {
    fn within(&self, key: &str) -> Self {
        Self { path: join(&self.path, key), twice: self.twice }
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
