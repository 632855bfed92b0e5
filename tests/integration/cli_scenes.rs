//! Random scenes say the same by options as in a file.
#![cfg(feature = "cli")]

#[path = "../../src/scene/tests/documents.rs"]
mod documents;

use documents::{any_document, remove};
use proptest::prelude::*;
use serde_json::{Map, Value, json};
use skyprobe::Error;
use skyprobe::parameter::{DefaultValue, Kind, Parameter};
use skyprobe::scene::{Scene, parameters};
use std::path::Path;
use std::process::Command;

/// `document` without the keys that contradict others or would be ignored: each error names one that is there.
fn consistent(mut document: Map<String, Value>) -> Map<String, Value> {
    while let Err(error) = Scene::from_value(&Value::Object(document.clone())) {
        let Error::Input { parameter, value, allowed } = error else { panic!("{error}") };
        assert!(remove(&mut document, &parameter), "{parameter} = {value}: must be {allowed}");
    }
    document
}

/// The options that give `row` a value; none where there is no option.
fn options(row: &Parameter, value: &Value) -> Option<Vec<String>> {
    let plain = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
    let Some(option) = &row.option else {
        return (row.kind == Kind::Files)
            .then(|| value.as_array().unwrap().iter().flat_map(|path| ["-o".to_owned(), plain(path)]).collect());
    };
    let name = format!("--{}", option.name);
    Some(match (row.kind, value) {
        (Kind::Flag, Value::Bool(true)) => vec![name],
        (Kind::Flag, _) if row.default == DefaultValue::Value("true") => vec![format!("--no-{}", option.name)],
        (Kind::Flag, _) => Vec::new(),
        (_, Value::Object(factors)) => factors.iter().map(|(layer, factor)| format!("{name}={layer}={factor}")).collect(),
        (_, Value::Array(angles)) => vec![format!("{name}={}", angles.iter().map(plain).collect::<Vec<_>>().join(","))],
        (_, value) => vec![format!("{name}={}", plain(value))],
    })
}

fn dumped(folder: &Path, arguments: &[String]) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_skyprobe"));
    command.args(["render", "--dump-config"]).args(arguments).current_dir(folder).env("SKYPROBE_CACHE", "off");
    let output = command.output().expect("the tool starts");
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..Default::default() })]

    #[test]
    fn options_and_files_say_the_same(document in any_document().prop_map(consistent)) {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, value: &Value| std::fs::write(folder.path().join(name), value.to_string()).unwrap();
        let whole = Value::Object(document.clone());
        write("whole.json", &whole);
        let scene = Scene::from_value(&whole).unwrap();
        let by_file = dumped(folder.path(), &["--config".to_owned(), "whole.json".to_owned()]);
        prop_assert_eq!(&by_file, &scene.to_value());

        // What has no option stays in a file.
        let (mut arguments, mut rest) = (vec!["--config".to_owned(), "rest.json".to_owned()], json!({}));
        for row in parameters() {
            let Some(value) = whole.pointer(&format!("/{}", row.path().replace('.', "/"))) else { continue };
            match options(row, value) {
                Some(more) => arguments.extend(more),
                None => rest[row.table][row.name] = value.clone(),
            }
        }
        // A filter is there by its strength.
        if document.get("polarising_filter").is_some_and(|filter| filter.get("strength").is_none()) {
            arguments.push("--polarising-filter=1".to_owned());
        }
        write("rest.json", &rest);
        prop_assert_eq!(&dumped(folder.path(), &arguments), &by_file, "{:?}", arguments);
    }
}
