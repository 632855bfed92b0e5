//! The table of parameters: each once, with its name, range, unit, default and a line of help.
//!
//! A room declares what it can be asked for by [`parameters!`], which makes the struct and its rows in one. From the rows come the checks of ranges, the options of
//! the command line, the tables of the documentation, the JSON Schema, and the ranges and tooltips in Blender. Rules between parameters (one of three says how much
//! haze there is) are code of the room.

mod check;
mod declare;

pub(crate) use check::Checked;
pub(crate) use declare::parameters;

/// What can be given for a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number.
    Number {
        /// Least value.
        low: f64,
        /// Greatest value.
        high: f64,
    },
    /// A whole number.
    Whole {
        /// Least value.
        low: u32,
        /// Greatest value.
        high: u32,
    },
    /// Yes or no.
    Flag,
    /// One of some words.
    Words(&'static [&'static str]),
    /// One of some words, or a number.
    WordsOrNumber {
        /// The words.
        words: &'static [&'static str],
        /// Least number.
        low: f64,
        /// Greatest number.
        high: f64,
    },
    /// Text of a form of its own.
    Text,
    /// Several numbers, ascending.
    Ascending {
        /// Least value.
        low: f64,
        /// Greatest value.
        high: f64,
    },
    /// Altitude and azimuth [degrees].
    Direction,
    /// A number for each of some words.
    Factors {
        /// The words.
        words: &'static [&'static str],
        /// Least number.
        low: f64,
        /// Greatest number.
        high: f64,
    },
    /// Names of files.
    Files,
}

/// What a parameter is where nothing is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DefaultValue {
    /// Nothing, and there is no need for it.
    Nothing,
    /// This value, as JSON has it.
    Value(&'static str),
    /// What this sentence says.
    Told(&'static str),
}

/// The option of the command line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandOption {
    /// Its name without the dashes.
    pub name: &'static str,
    /// What stands for its value in the help; empty for a flag.
    pub value: &'static str,
    /// Another name.
    pub alias: Option<&'static str>,
    /// The option that says no, of a flag that is on where nothing is said.
    pub off: Option<&'static str>,
    /// Whether only the long help shows it.
    pub is_detail: bool,
}

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The table of the scene that holds it, such as `atmosphere`; empty at the top.
    pub table: &'static str,
    /// Its name, the same in Rust, Python and JSON, with its unit where a name can say it.
    pub name: &'static str,
    /// What can be given.
    pub kind: Kind,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// What holds where it is left out.
    pub default: DefaultValue,
    /// What it is: one line without a full stop.
    pub help: &'static str,
    /// What else is worth knowing: sentences.
    pub more: &'static str,
    /// The option of the command line; `None` for what only files, Python and Rust say.
    pub option: Option<CommandOption>,
    /// Parameters of one group exclude each other; empty for none.
    pub group: &'static str,
}

impl Parameter {
    /// A parameter without a name: the macro gives it one.
    pub const fn new(kind: Kind, unit: &'static str) -> Self {
        Self { table: "", name: "", kind, unit, default: DefaultValue::Nothing, help: "", more: "", option: None, group: "" }
    }

    /// The same with its table, name and line of help.
    pub const fn named(mut self, table: &'static str, name: &'static str, help: &'static str) -> Self {
        (self.table, self.name, self.help) = (table, name, help);
        self
    }

    /// The same with a default as JSON has it.
    pub const fn default(mut self, json: &'static str) -> Self {
        self.default = DefaultValue::Value(json);
        self
    }

    /// The same with a default that a sentence says.
    pub const fn by(mut self, told: &'static str) -> Self {
        self.default = DefaultValue::Told(told);
        self
    }

    /// The same with more help.
    pub const fn more(mut self, sentences: &'static str) -> Self {
        self.more = sentences;
        self
    }

    /// The same in a group of which at most one can be given.
    pub const fn group(mut self, group: &'static str) -> Self {
        self.group = group;
        self
    }

    /// The same with an option of the command line, and what stands for its value in the help.
    pub const fn option(mut self, name: &'static str, value: &'static str) -> Self {
        self.option = Some(CommandOption { name, value, alias: None, off: None, is_detail: false });
        self
    }

    /// The same with another name of its option.
    pub const fn alias(mut self, alias: &'static str) -> Self {
        if let Some(option) = &mut self.option {
            option.alias = Some(alias);
        }
        self
    }

    /// The same with the option that says no.
    pub const fn off(mut self, name: &'static str) -> Self {
        if let Some(option) = &mut self.option {
            option.off = Some(name);
        }
        self
    }

    /// The same with an option that only the long help shows.
    pub const fn detail(mut self) -> Self {
        if let Some(option) = &mut self.option {
            option.is_detail = true;
        }
        self
    }

    /// The way to it in a scene, such as `atmosphere.ozone_du`.
    pub fn path(&self) -> String {
        if self.table.is_empty() { self.name.to_owned() } else { format!("{}.{}", self.table, self.name) }
    }

    /// What can be given, in words: `0 to 1000`, `auto, always or never`.
    pub fn allowed(&self) -> String {
        let or_list = |words: &[&str]| match words {
            [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
            _ => words.concat(),
        };
        match self.kind {
            Kind::Number { low, high } => format!("{low} to {high}"),
            Kind::Whole { low, high } => format!("{low} to {high}"),
            Kind::Flag => "true or false".to_owned(),
            Kind::Words(words) => or_list(words),
            Kind::WordsOrNumber { words, low, high } => format!("{}, or a number from {low} to {high}", words.join(", ")),
            Kind::Text => String::new(),
            Kind::Ascending { low, high } => format!("ascending, {low} to {high}"),
            Kind::Direction => "altitude -90 to 90, azimuth -360 to 360".to_owned(),
            Kind::Factors { words, low, high } => format!("{low} to {high} for each of {}", or_list(words)),
            Kind::Files => "names of files".to_owned(),
        }
    }

    /// The default in words; `None` where nothing need be said.
    pub fn default_in_words(&self) -> Option<String> {
        match self.default {
            DefaultValue::Nothing => None,
            DefaultValue::Value(json) => {
                let word = json.trim_matches('"');
                Some(word.strip_suffix(".0").unwrap_or(word).to_owned())
            }
            DefaultValue::Told(told) => Some(told.to_owned()),
        }
    }
}

/// The first line of a documentation, without the blank before it and the full stop after it.
pub(crate) const fn first_line(lines: &[&'static str]) -> &'static str {
    let line = lines[0].trim_ascii();
    match line.as_bytes() {
        [text @ .., b'.'] => match std::str::from_utf8(text) {
            Ok(text) => text,
            Err(_) => line,
        },
        _ => line,
    }
}

/// Constructors of rows, short enough to stand in a declaration.
pub(crate) mod row {
    use super::{Kind, Parameter};

    pub const fn number(low: f64, high: f64, unit: &'static str) -> Parameter {
        Parameter::new(Kind::Number { low, high }, unit)
    }

    pub const fn whole(low: u32, high: u32, unit: &'static str) -> Parameter {
        Parameter::new(Kind::Whole { low, high }, unit)
    }

    pub const fn flag() -> Parameter {
        Parameter::new(Kind::Flag, "")
    }

    pub const fn words(words: &'static [&'static str]) -> Parameter {
        Parameter::new(Kind::Words(words), "")
    }

    pub const fn words_or_number(words: &'static [&'static str], low: f64, high: f64) -> Parameter {
        Parameter::new(Kind::WordsOrNumber { words, low, high }, "")
    }

    pub const fn direction() -> Parameter {
        Parameter::new(Kind::Direction, "degrees")
    }

    pub const fn text() -> Parameter {
        Parameter::new(Kind::Text, "")
    }
}
