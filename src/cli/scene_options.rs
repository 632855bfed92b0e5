//! The options that describe a scene, made from the table of parameters: what is given is laid over the configuration and read like it.

use super::complain;
use crate::error::{Error, Result};
use crate::parameter::{Checked, CommandOption, Kind, Parameter};
use crate::scene::{AIR, FILE, IMAGE, NIGHT, PLACE_AND_TIME, Scene, Section};
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches, value_parser};
use serde_json::{Map, Value};
use std::marker::PhantomData;

/// Which sections of the table a command has.
pub trait Sections {
    /// The sections.
    const SECTIONS: &'static [Section];
}

/// All that a picture is made from.
pub struct Picture;

impl Sections for Picture {
    const SECTIONS: &'static [Section] = &[PLACE_AND_TIME, AIR, NIGHT, IMAGE, FILE];
}

/// A sky without a picture of it.
pub struct SkyAlone;

impl Sections for SkyAlone {
    const SECTIONS: &'static [Section] = &[PLACE_AND_TIME, AIR, NIGHT];
}

/// What was given for the parameters of some sections.
pub struct SceneOptions<S> {
    given: Vec<Given>,
    sections: PhantomData<S>,
}

/// A parameter and its value as JSON.
struct Given {
    row: &'static Parameter,
    option: &'static CommandOption,
    value: Value,
}

impl Given {
    /// Whether it says what is found at `path`, or a key of the table there.
    fn says(&self, path: &str) -> bool {
        let own = self.row.path();
        match (&self.value, path.strip_prefix(&own).map(|rest| rest.strip_prefix('.').unwrap_or(rest))) {
            (Value::Object(table), Some(key)) => table.contains_key(key),
            (_, rest) => rest == Some(""),
        }
    }
}

impl<S: Sections> SceneOptions<S> {
    /// `scene` with what was given in place of what it says, and without what that puts out of force; `now` becomes the instant, and is told.
    ///
    /// # Errors
    /// As [`Scene::from_value`], with the options' names for what was given; options that would be ignored are errors.
    pub fn over(&self, scene: Scene) -> Result<Scene> {
        let mut scene = scene.replace(&self.changes(&scene)?).map_err(|error| self.as_typed(error))?;
        if scene.settle_now()? {
            complain(&format!("note: time: now is {}", scene.time.as_deref().unwrap_or_default()));
        }
        Ok(scene)
    }

    /// The same error with the names of options where the parameter was given by one.
    pub fn as_typed(&self, error: Error) -> Error {
        let Error::Input { parameter, value, allowed } = error else { return error };
        let Some(named) = self.given.iter().find(|given| given.row.name == parameter || given.says(&parameter)) else {
            return Error::Input { parameter, value, allowed };
        };
        let key = parameter.strip_prefix(&format!("{}.", named.row.path())).map_or_else(String::new, |key| format!(" {key}"));
        let rows = S::SECTIONS.iter().flat_map(Section::parameters).filter(|row| !row.table.is_empty());
        let mut names: Vec<_> = rows.filter_map(|row| Some((row.path(), row.option?.name))).collect();
        // The way to one may begin with the way to another.
        names.sort_by_key(|(path, _)| std::cmp::Reverse(path.len()));
        let allowed = names.iter().fold(allowed, |text, (path, name)| text.replace(path, &format!("--{name}")));
        Error::Input { parameter: format!("--{}{key}", named.option.name), value, allowed }
    }

    fn has(&self, name: &str) -> bool {
        self.given.iter().any(|given| given.row.name == name)
    }

    /// What was given, as JSON has it.
    fn changes(&self, scene: &Scene) -> Result<Map<String, Value>> {
        if (self.has("angle_deg") || self.has("held_towards_deg"))
            && !self.has("strength")
            && scene.light.polarising_filter.is_none()
        {
            return Err(Error::input("polarising_filter", "nothing", "given, to turn it or to hold it towards a direction"));
        }
        let mut changes = Map::new();
        for Given { row, value, .. } in &self.given {
            table_of(&mut changes, row).insert(row.name.to_owned(), value.clone());
        }
        Ok(changes)
    }
}

/// The table that holds a parameter.
fn table_of<'a>(scene: &'a mut Map<String, Value>, row: &Parameter) -> &'a mut Map<String, Value> {
    if row.table.is_empty() {
        return scene;
    }
    let table = scene.entry(row.table).or_insert_with(|| Value::Object(Map::new()));
    if !table.is_object() {
        *table = Value::Object(Map::new());
    }
    table.as_object_mut().expect("just made one")
}

impl<S: Sections> Args for SceneOptions<S> {
    fn augment_args(mut command: Command) -> Command {
        for section in S::SECTIONS {
            for row in section.parameters() {
                let Some(option) = &row.option else { continue };
                let heading: &'static str = match option.is_detail {
                    true => detail_of(section.title),
                    false => section.title,
                };
                for arg in args(row, option) {
                    command = command.arg(arg.help_heading(heading).hide_short_help(option.is_detail));
                }
            }
        }
        command
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// The heading of what only the long help shows.
fn detail_of(title: &str) -> &'static str {
    match title {
        "Air" => "Air, in detail",
        _ => "More",
    }
}

/// The options for a row: one, or two for a flag that is on unless it is said otherwise.
fn args(row: &'static Parameter, option: &'static CommandOption) -> Vec<Arg> {
    let (short, long) = help(row);
    let arg = Arg::new(option.name).long(option.name).help(short.clone()).long_help(long.clone());
    let arg = option.alias.into_iter().fold(arg, |arg, alias| arg.visible_alias(alias));
    let arg = if row.group.is_empty() { arg } else { arg.group(row.group) };
    let arg = match row.kind {
        Kind::Flag => {
            let arg = arg.action(ArgAction::SetTrue);
            let Some(off) = option.off else { return vec![arg] };
            let opposite = format!("The opposite of --{}, which is the default. {}", option.name, row.more);
            let not = Arg::new(off).long(off).help(opposite.trim_end().to_owned());
            return vec![arg.overrides_with(off), not.action(ArgAction::SetTrue).overrides_with(option.name)];
        }
        Kind::Number { .. } if ["latitude", "longitude"].contains(&row.name) => arg.value_parser(coordinate),
        Kind::Number { .. } => arg.value_parser(decimal),
        Kind::Whole { .. } => arg.value_parser(value_parser!(i64)),
        Kind::Factors { .. } => arg.action(ArgAction::Append),
        _ => arg,
    };
    vec![special(arg.value_name(option.value), option.name)]
}

/// What some options have beyond their row.
fn special(arg: Arg, name: &str) -> Arg {
    match name {
        "place" => arg.allow_hyphen_values(true).conflicts_with_all(["latitude", "longitude"]),
        "sun-altitude" => arg.requires("sun-azimuth").conflicts_with_all(["place", "latitude", "longitude", "time", "zone"]),
        "sun-azimuth" => arg.requires("sun-altitude"),
        "half" => arg.num_args(0..=1).require_equals(true).default_missing_value("refuse"),
        _ => arg,
    }
}

/// Short and long help.
fn help(row: &Parameter) -> (String, String) {
    let mut short = row.help.to_owned();
    match row.kind {
        Kind::Words(_) | Kind::WordsOrNumber { .. } => short += &format!(": {}", row.allowed()),
        Kind::Number { .. } | Kind::Whole { .. } => short += &format!(", {}", row.allowed()),
        Kind::Factors { words, low, high } => {
            short += &format!(", {low} to {high}; may be given several times. Layers: {}", words.join(", "))
        }
        _ => {}
    }
    if !row.unit.is_empty() {
        short += &format!(" [{}]", row.unit);
    }
    if let Some(default) = row.default_in_words().filter(|_| row.kind != Kind::Flag) {
        short += &format!(". Default: {default}");
    }
    let long = if row.more.is_empty() { short.clone() } else { format!("{short}.\n\n{}", row.more) };
    (short, long)
}

impl<S: Sections> FromArgMatches for SceneOptions<S> {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        let mut given = Vec::new();
        for row in S::SECTIONS.iter().flat_map(Section::parameters) {
            let Some(option) = &row.option else { continue };
            match value_of(matches, row, option) {
                Ok(Some(value)) => given.push(Given { row, option, value }),
                Ok(None) => {}
                Err(error) => return Err(clap::Error::raw(clap::error::ErrorKind::ValueValidation, error)),
            }
        }
        Ok(Self { given, sections: PhantomData })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> std::result::Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// What was given for a row, judged by it.
fn value_of(matches: &ArgMatches, row: &Parameter, option: &CommandOption) -> Result<Option<Value>> {
    let name = format!("--{}", option.name);
    Ok(match row.kind {
        Kind::Number { .. } => match matches.get_one::<f64>(option.name) {
            None => None,
            Some(number) => {
                number.check(row, &name)?;
                Some(Value::from(*number))
            }
        },
        Kind::Whole { .. } => match matches.get_one::<i64>(option.name) {
            None => None,
            Some(number) => {
                number.check(row, &name)?;
                Some(Value::from(*number))
            }
        },
        Kind::Flag => {
            let is_off = option.off.is_some_and(|off| matches.get_flag(off));
            (matches.get_flag(option.name) || is_off).then_some(Value::Bool(!is_off))
        }
        Kind::WordsOrNumber { .. } => match matches.get_one::<String>(option.name) {
            None => None,
            Some(text) => Some(match text.parse::<f64>() {
                Ok(number) => {
                    number.check(row, &name)?;
                    Value::from(number)
                }
                Err(_) => Value::from(text.as_str()),
            }),
        },
        Kind::Direction => match matches.get_one::<String>(option.name) {
            None => None,
            Some(text) => {
                let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
                let Some(&[altitude, azimuth]) = numbers.as_deref() else {
                    return Err(Error::input(name, format!("{text:?}"), "altitude and azimuth, such as 30,180"));
                };
                [altitude, azimuth].check(row, &name)?;
                Some(Value::from(vec![altitude, azimuth]))
            }
        },
        Kind::Factors { .. } => match matches.get_many::<String>(option.name) {
            None => None,
            Some(texts) => {
                let factors = texts.map(|text| factor(text, row, &name)).collect::<Result<Map<_, _>>>()?;
                Some(Value::Object(factors))
            }
        },
        Kind::Words(_) | Kind::Text | Kind::Ascending { .. } | Kind::Files => {
            matches.get_one::<String>(option.name).map(|text| Value::from(text.as_str()))
        }
    })
}

/// Reads a text such as `stars=2`.
fn factor(text: &str, row: &Parameter, name: &str) -> Result<(String, Value)> {
    let wrong = || Error::input(name, format!("{text:?}"), "NAME=FACTOR, such as stars=2");
    let (word, factor) = text.split_once('=').ok_or_else(wrong)?;
    let factor: f64 = factor.trim().parse().map_err(|_| wrong())?;
    factor.check(row, &format!("{name} {}", word.trim()))?;
    Ok((word.trim().to_owned(), Value::from(factor)))
}

/// A number, with a decimal point or a decimal comma.
fn decimal(text: &str) -> std::result::Result<f64, String> {
    number(text, "")
}

/// The same for one of two coordinates.
fn coordinate(text: &str) -> std::result::Result<f64, String> {
    number(text, "; --place takes both coordinates")
}

fn number(text: &str, hint: &str) -> std::result::Result<f64, String> {
    let commas = text.matches(',').count();
    let has_one_comma = commas == 1 && !text.contains('.') && !text.starts_with(',') && !text.ends_with(',');
    let pointed = if has_one_comma { text.replace(',', ".") } else { text.to_string() };
    let hint = if commas > 0 { format!(": one number, with a decimal point{hint}") } else { String::new() };
    pointed.trim().parse().map_err(|_| format!("it must be a number{hint}"))
}
