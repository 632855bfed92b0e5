//! Files that are made from the table of parameters are what `skyprobe schema` prints now. With `SKYPROBE_WRITE=1` they are written again.
#![cfg(feature = "cli")]

use std::path::Path;
use std::process::{Command, Output};

const FILES: [(&str, &str); 4] = [
    ("json", "docs/scene.schema.json"),
    ("markdown", "docs/parameters.md"),
    ("python", "blender_addon/parameter_table.py"),
    ("python-docs", "src/python/docstrings.rs"),
];
const STUB: &str = "python/skyprobe/_core.pyi";
const BEGIN: &str = "# Made by `skyprobe schema --format python-stub`:";
const END: &str = "# Until here.\n";

fn schema(format: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_skyprobe")).args(["schema", "--format", format]).output().expect("the tool starts")
}

fn printed(format: &str) -> String {
    let output = schema(format);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The end of `kept` replaced by `made`, from where its first line stands.
fn with_end(kept: &str, made: &str) -> String {
    let first = made.lines().next().unwrap_or_default();
    let from = kept.match_indices(first).map(|(at, _)| at).find(|&at| at == 0 || kept[..at].ends_with('\n'));
    kept[..from.unwrap_or(kept.len())].to_owned() + made
}

/// The parts of a stub that are made, with their comments.
fn parts(stub: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let mut rest = stub;
    while let Some(at) = rest.find(BEGIN) {
        let begin = rest[..at].rfind('\n').map_or(0, |end| end + 1);
        let end = rest[at..].find(END).map_or(rest.len(), |end| at + end + END.len());
        parts.push(&rest[begin..end]);
        rest = &rest[end..];
    }
    parts
}

/// The same stub with the parts of `made`, wherever each stands.
fn with_parts(kept: &str, made: &str) -> String {
    let (old, new) = (parts(kept), parts(made));
    assert_eq!(old.len(), new.len(), "{STUB} has other parts than what is printed");
    new.iter().fold(kept.to_owned(), |text, new| {
        let title = new.lines().next();
        let old = old.iter().find(|old| old.lines().next() == title);
        text.replacen(old.unwrap_or_else(|| panic!("{title:?} is missing")), new, 1)
    })
}

#[test]
fn what_is_made_from_the_table_of_parameters_is_up_to_date() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let stub = printed("python-stub");
    let wanted = FILES.map(|(format, file)| (format, file, printed(format))).into_iter();
    for (format, file, made) in wanted.chain([("python-stub", STUB, stub.clone())]) {
        let kept = std::fs::read_to_string(root.join(file)).unwrap();
        let now = if file == STUB { with_parts(&kept, &stub) } else { with_end(&kept, &made) };
        if std::env::var_os("SKYPROBE_WRITE").is_some() {
            std::fs::write(root.join(file), &now).unwrap();
            continue;
        }
        assert!(
            kept == now,
            "{file} is stale: it has what skyprobe schema --format {format} prints; SKYPROBE_WRITE=1 and this test write it again"
        );
    }
}

#[test]
fn a_change_of_what_is_printed_is_seen() {
    assert_eq!(with_end("# Head\n\nA = {\n 1\n}\n", "A = {\n 2\n}\n"), "# Head\n\nA = {\n 2\n}\n");
    let stub = format!("x: int\n{BEGIN} a\n1\n{END}y: int\n    {BEGIN} b\n    2\n    {END}");
    assert_eq!(parts(&stub), [format!("{BEGIN} a\n1\n{END}"), format!("    {BEGIN} b\n    2\n    {END}")]);
    let new = format!("    {BEGIN} b\n    3\n    {END}{BEGIN} a\n1\n{END}");
    assert_eq!(with_parts(&stub, &new), stub.replace("    2\n", "    3\n"));
}

#[test]
fn other_formats_are_named() {
    let wrong = schema("xml");
    assert_eq!(wrong.status.code(), Some(2));
    let message = String::from_utf8_lossy(&wrong.stderr);
    assert!(message.contains("json, markdown, python, python-docs or python-stub"), "{message}");
}
