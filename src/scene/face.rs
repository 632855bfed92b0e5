//! What Python shows of the table of parameters: signatures and docstrings of the compiled module, and the same in its stub.

use super::calls::{Argument, CALLS, Call, Keyword, Own, SHOWN};
use super::parameters;
use crate::parameter::{DefaultValue, Kind, Parameter};
use serde_json::Value;
use std::fmt::Write;

/// Longest line of a docstring.
const LINE: usize = 116;

/// What stands before each part of the stub that is made from the table, and after it.
const BEGIN: &str = "# Made by `skyprobe schema --format python-stub`:";
const END: &str = "# Until here.";

/// Signatures and docstrings, as a macro of Rust: pyo3 takes them at compile time.
pub fn docstrings() -> String {
    let mut text = String::from(
        "//! Signatures and docstrings of what takes parameters by name, which `skyprobe schema --format python-docs` prints.\n\n\
         macro_rules! docstring {\n",
    );
    for call in CALLS {
        let name = call.name.rsplit('.').next().unwrap_or_default();
        let this = if name == call.name { "" } else { "$self, " };
        let places = call.places.iter().map(|own| format!("{}, ", own.name)).collect::<String>();
        let keywords: Vec<String> =
            call.arguments().into_iter().map(|argument| format!("{}={}", argument.name(), default_of(argument))).collect();
        let _ = write!(
            text,
            "    ({}) => {{\n        r#\"{name}({this}{places}*, {})\n--\n\n{}\"#\n    }};\n",
            call.name,
            keywords.join(", "),
            docstring(call)
        );
    }
    text + "}\n\npub(super) use docstring;\n"
}

/// The parts of the stub that are made from the table, each between two comments.
pub fn stub() -> String {
    let mut text = format!("{BEGIN} words\n{}{END}\n", words());
    for call in CALLS {
        let (pad, is_class) = ("    ", !call.name.contains('.'));
        let _ = writeln!(text, "{pad}{BEGIN} {}", call.name);
        if is_class {
            text += &quoted(&docstring(call), pad);
            let _ = write!(text, "\n{}", definition(call, "__new__", "cls", " ...\n"));
            text += &attributes(call.name);
        } else {
            let name = call.name.rsplit('.').next().unwrap_or_default();
            text += &definition(call, name, "self", "\n");
            text += &quoted(&docstring(call), "        ");
        }
        let _ = writeln!(text, "{pad}{END}");
    }
    let of_results = SHOWN.iter().filter(|(class, _)| CALLS.iter().all(|call| call.name != *class));
    for (class, _) in of_results {
        let _ = writeln!(text, "    {BEGIN} {class}{}    {END}", attributes(class));
    }
    text
}

/// What an attribute of a row says: one line.
pub fn attribute_text(row: &Parameter) -> String {
    let nothing = match row.default {
        DefaultValue::Told(told) => format!("; None: {told}"),
        _ => String::new(),
    };
    format!("{}{nothing}.{}", row.help, unit(row))
}

fn attributes(class: &str) -> String {
    let mut text = String::new();
    for row in SHOWN.iter().filter(|(name, _)| *name == class).flat_map(|(_, rows)| rows.iter()) {
        let (name, annotation) = (row.name, annotation(row));
        let _ =
            write!(text, "\n    @property\n    def {name}(self) -> {annotation}:\n        \"\"\"{}\"\"\"\n", attribute_text(row));
    }
    text
}

fn definition(call: &'static Call, name: &str, this: &str, body: &str) -> String {
    let mut text = format!("    def {name}(\n        {this},\n");
    for Own { name, annotation, .. } in call.places {
        let _ = writeln!(text, "        {name}: {annotation},");
    }
    text += "        *,\n";
    for argument in call.arguments() {
        let annotation = match argument {
            Argument::Row(row) => annotation(row),
            Argument::Own(own) => own.annotation.to_owned(),
        };
        let _ = writeln!(text, "        {}: {annotation} = {},", argument.name(), default_of(argument).replace('\'', "\""));
    }
    text + &format!("    ) -> {}:{body}", call.returns)
}

/// What a call says of itself.
fn docstring(call: &'static Call) -> String {
    let mut text = String::new();
    for paragraph in call.about.split("\n\n") {
        text += &wrapped(paragraph, "");
        text.push('\n');
    }
    text += "Parameters\n----------\n";
    let own = |own: &Own| format!("{}\n{}", own.name, wrapped(own.text, "    "));
    text.extend(call.places.iter().map(own));
    for keyword in call.keywords {
        if let Keyword::Like(other, _) = keyword {
            let names: Vec<&str> = keyword.arguments().into_iter().map(Argument::name).collect();
            let class = call.name.split('.').next();
            let name = other.name.split_once('.').filter(|(of, _)| Some(*of) == class).map_or(other.name, |(_, name)| name);
            let _ = write!(text, "{}\n    As for ``{name}``.\n", names.join(", "));
            continue;
        }
        for argument in keyword.arguments() {
            text += &match argument {
                Argument::Row(row) => format!("{}\n{}", row.name, wrapped(&sentences(row), "    ")),
                Argument::Own(argument) => own(argument),
            };
        }
    }
    text
}

/// A row in sentences.
fn sentences(row: &Parameter) -> String {
    let word_list = |words: &[&str]| -> String {
        let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
        match &words[..] {
            [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
            _ => words.concat(),
        }
    };
    let allowed = match row.kind {
        Kind::Words(words) => word_list(words),
        Kind::WordsOrNumber { words, low, high } => format!("{}, or a number from {low} to {high}", word_list(words)),
        // These blanks are no place to break a line.
        Kind::Factors { low, high, .. } => {
            format!(
                "{low} to {high} for each, such as ``{{\"moon\":\u{a0}0.0,\u{a0}\"stars\":\u{a0}10.0}}``; see ``layer_names``"
            )
        }
        Kind::Ascending { .. } => format!("{}, shape (W,)", row.allowed()),
        Kind::Flag => String::new(),
        _ => row.allowed(),
    };
    let told = match row.default {
        DefaultValue::Told(told) => format!("by default {told}"),
        _ => String::new(),
    };
    let range: Vec<&str> = [allowed.as_str(), told.as_str()].into_iter().filter(|part| !part.is_empty()).collect();
    let mut text = format!("{}.", row.help);
    if !range.is_empty() {
        let _ = write!(text, " {}.", capitalised(&range.join("; ")));
    }
    if !row.more.is_empty() {
        let _ = write!(text, " {}.", row.more.trim_end_matches('.'));
    }
    text + &unit(row)
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}

fn unit(row: &Parameter) -> String {
    if row.unit.is_empty() { String::new() } else { format!(" [{}]", row.unit) }
}

/// The default as Python writes it.
fn default_of(argument: Argument) -> String {
    match argument {
        Argument::Own(own) => own.default.to_owned(),
        Argument::Row(row) => match row.default {
            DefaultValue::Value(json) => match serde_json::from_str(json) {
                Ok(Value::Bool(true)) => "True".to_owned(),
                Ok(Value::Bool(false)) => "False".to_owned(),
                _ => json.replace('"', "'"),
            },
            _ => "None".to_owned(),
        },
    }
}

/// The type as the stub writes it.
fn annotation(row: &Parameter) -> String {
    let kind = match row.kind {
        Kind::Number { .. } => "float".to_owned(),
        Kind::Whole { .. } => "int".to_owned(),
        Kind::Flag => "bool".to_owned(),
        Kind::Words(_) => alias(row),
        Kind::WordsOrNumber { .. } => format!("{} | float", alias(row)),
        Kind::Text => "str".to_owned(),
        Kind::Ascending { .. } => "ArrayLike".to_owned(),
        Kind::Direction => "tuple[float, float]".to_owned(),
        Kind::Factors { .. } => "Mapping[str, float]".to_owned(),
        Kind::Files => "Sequence[str | os.PathLike[str]]".to_owned(),
    };
    if matches!(row.default, DefaultValue::Value(_)) { kind } else { format!("{kind} | None") }
}

/// The name of the type of a choice: that of the row, after that of its table where there are two.
fn alias(row: &Parameter) -> String {
    let is_alone = choices().filter(|(other, _)| other.name == row.name).count() < 2;
    let path = if is_alone { row.name.to_owned() } else { row.path() };
    format!("_{}", path.split(['_', '.']).map(capitalised).collect::<String>())
}

fn choices() -> impl Iterator<Item = (&'static Parameter, &'static [&'static str])> {
    parameters().filter_map(|row| match row.kind {
        Kind::Words(words) | Kind::WordsOrNumber { words, .. } => Some((row, words)),
        _ => None,
    })
}

fn words() -> String {
    let mut text = String::new();
    for (row, words) in choices() {
        let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
        let line = format!("{}: TypeAlias = Literal[{}]\n", alias(row), words.join(", "));
        text += &match line.len() > LINE {
            true => format!("{}: TypeAlias = Literal[\n    {},\n]\n", alias(row), words.join(",\n    ")),
            false => line,
        };
    }
    text
}

/// Lines of a paragraph, each begun with `pad`.
fn wrapped(paragraph: &str, pad: &str) -> String {
    let mut lines = vec![pad.to_owned()];
    for word in paragraph.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if line.len() == pad.len() => line.push_str(word),
            Some(line) if line.len() + 1 + word.len() <= LINE => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(format!("{pad}{word}")),
        }
    }
    lines.join("\n").replace('\u{a0}', " ") + "\n"
}

/// A docstring in its quotes, each line begun with `pad`.
fn quoted(text: &str, pad: &str) -> String {
    let mut quoted = format!("{pad}\"\"\"");
    for (index, line) in text.lines().enumerate() {
        match (index, line) {
            (0, line) => quoted += line,
            (_, "") => quoted.push('\n'),
            (_, line) => {
                let _ = write!(quoted, "\n{pad}{line}");
            }
        }
    }
    quoted + "\n" + pad + "\"\"\"\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn python_shows_every_keyword_with_its_default_and_range() {
        let (docs, stub) = (docstrings(), stub());
        for part in [
            "Night(*, when='auto', star_limit=8.5, ",
            "render($self, *, width=2048, projection='latlong', ",
            "save($self, path, *, half=None, ",
        ] {
            assert!(docs.contains(part), "{part}");
        }
        let range = "bortle\n    The same as a class of light pollution on Bortle's scale: 1 is as dark as it gets, 9 an inner city. 1 to 9;";
        assert!(docs.contains(range));
        for part in [
            "        bortle: int | None = None,\n",
            "    def bortle(self) -> int | None:\n",
            "        ground: _AtmosphereGround | float | None = None,\n",
            "        ground: _ProbeGround = \"on\",\n",
            "_SunModel: TypeAlias = Literal[\"iau\", \"thesis\"]\n",
        ] {
            assert!(stub.contains(part), "{part}");
        }
        assert_eq!(stub.matches(BEGIN).count(), stub.matches(END).count());
    }

    #[test]
    fn lines_are_wrapped_and_no_word_is_lost() {
        let words = "word ".repeat(100);
        let text = wrapped(&words, "    ");
        assert!(text.lines().all(|line| line.len() <= LINE && line.starts_with("    word")) && text.lines().count() > 3);
        assert_eq!(text.split_whitespace().count(), 100);
    }

    #[test]
    fn no_name_stands_twice_in_a_call() {
        for call in CALLS {
            let mut names: Vec<&str> = call.arguments().into_iter().map(Argument::name).collect();
            let count = names.len();
            names.sort_unstable();
            names.dedup();
            assert_eq!(names.len(), count, "{}", call.name);
        }
    }
}
