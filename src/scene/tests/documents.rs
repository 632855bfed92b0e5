//! Random documents, made from the table of parameters: each row is varied as its kind allows. Tests of the library and of the command line include this file.

use super::{Kind, Parameter, parameters};
use proptest::prelude::*;
use proptest::sample::{select, subsequence};
use serde_json::{Map, Value, json};

const TIMES: [&str; 5] =
    ["2005-06-21T13:00:00+02:00", "1987-01-02T03:04", "2005-01-25", "2024-02-29 00:30Z", "2011-12-30T12:00[Europe/Paris]"];
const ZONES: [&str; 3] = ["Europe/Stockholm", "UTC", "America/St_Johns"];
const PLACES: [&str; 4] = ["Lund, Sweden", "55.71, 13.19", "24 37 38 S 70 24 15 W", "Santorini"];

/// Any value that `row` allows by itself.
fn any_value(row: &Parameter) -> BoxedStrategy<Value> {
    let words = |words: &'static [&'static str]| select(words).prop_map(Value::from);
    match row.kind {
        Kind::Number { low, high } => prop_oneof![4 => low..=high, 1 => Just(low), 1 => Just(high)].prop_map(Value::from).boxed(),
        Kind::Whole { low, high } => (low..=high).prop_map(Value::from).boxed(),
        Kind::Flag => any::<bool>().prop_map(Value::from).boxed(),
        Kind::Words(list) => words(list).boxed(),
        Kind::WordsOrNumber { words: list, low, high } => prop_oneof![words(list), (low..=high).prop_map(Value::from)].boxed(),
        Kind::Direction => {
            (-90.0..=90.0_f64, -360.0..=360.0_f64).prop_map(|(altitude, azimuth)| json!([altitude, azimuth])).boxed()
        }
        Kind::Ascending { low, high } => prop::collection::vec(low..=high, 1..6)
            .prop_map(|mut numbers| {
                numbers.sort_by(f64::total_cmp);
                json!(numbers)
            })
            .boxed(),
        Kind::Factors { words: list, low, high } => (subsequence(list.to_vec(), 0..=list.len()), low..=high)
            .prop_map(|(names, factor)| {
                names.into_iter().map(|name| (name.to_owned(), json!(factor))).collect::<Map<_, _>>().into()
            })
            .boxed(),
        Kind::Files => prop::collection::btree_set("[a-z ]{1,8}\\.(exr|hdr|png)", 0..3).prop_map(|names| json!(names)).boxed(),
        Kind::Text => match row.name {
            "time" => select(&TIMES[..]).prop_map(Value::from).boxed(),
            "zone" => select(&ZONES[..]).prop_map(Value::from).boxed(),
            "place" => select(&PLACES[..]).prop_map(Value::from).boxed(),
            other => panic!("no texts for {other}"),
        },
    }
}

/// Each row is given or not; the Sun is put, or there are place and time.
pub fn any_document() -> impl Strategy<Value = Map<String, Value>> {
    let rows: Vec<_> = parameters().map(|row| prop::option::of(any_value(row))).collect();
    (rows, prop::bool::weighted(0.3)).prop_map(|(values, is_put)| {
        let mut document = Map::new();
        for (row, value) in parameters().zip(values) {
            let is_of_place = ["place", "latitude", "longitude", "time"].contains(&row.name);
            // A Sun is put with both of its angles.
            let value = if row.table == "sun" { is_put.then(|| value.unwrap_or(json!(20.0))) } else { value };
            let Some(value) = value.filter(|_| !(is_put && is_of_place)) else { continue };
            if row.table.is_empty() {
                document.insert(row.name.to_owned(), value);
            } else {
                let table = document.entry(row.table).or_insert_with(|| json!({}));
                table.as_object_mut().unwrap().insert(row.name.to_owned(), value);
            }
        }
        document
    })
}

/// Takes what stands at `path` out of `document`; whether there was something. A preset without aerosol stands for the kind that it has.
pub fn remove(document: &mut Map<String, Value>, path: &str) -> bool {
    take(document, path) || path == "atmosphere.aerosol" && take(document, "atmosphere.preset")
}

fn take(document: &mut Map<String, Value>, path: &str) -> bool {
    match path.split_once('.') {
        None => document.shift_remove(path).is_some(),
        Some((table, name)) => {
            document.get_mut(table).and_then(Value::as_object_mut).is_some_and(|table| table.shift_remove(name).is_some())
        }
    }
}
