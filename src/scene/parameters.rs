//! All parameters of a scene, in the order in which they are listed to users.

use super::SceneAtmosphere;
use crate::ephemeris::{PUT_SUN, Place};
use crate::io::FileOptions;
use crate::parameter::{Parameter, row};
use crate::probe::ProbeSettings;
use crate::sky::{LightOptions, NightOptions, PolarisingFilter};
use crate::words::Words;

/// Parameters that belong together.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    /// Its heading.
    pub title: &'static str,
    /// Its rows.
    pub rows: &'static [&'static [Parameter]],
}

impl Section {
    /// The rows, one after the other.
    pub fn parameters(&self) -> impl Iterator<Item = &'static Parameter> + use<> {
        self.rows.iter().flat_map(|rows| rows.iter())
    }
}

/// When.
const TIME: &[Parameter] = &[
    row::text()
        .named("", "time", "Date and time (ISO 8601), such as 2005-06-21T13:00:00+02:00, 2005-06-21T11:00Z, \"2005-06-21 13:00\"; a date alone is its noon; now")
        .option("time", "TIME")
        .more("Without an offset it is local time in the zone of the place, daylight saving included (or in the zone that is named). What has to be assumed (clocks show it never or twice, noon) is told."),
    row::text().named("", "zone", "IANA time zone, such as Europe/Stockholm").option("zone", "NAME").by("that of the place, found offline"),
    row::words(crate::ephemeris::SunModel::WORDS)
        .named("", "sun_model", "By which theory the Sun stands where it does; thesis is of low precision")
        .default("\"iau\"")
        .option("sun-model", "MODEL"),
];

/// Where the name of a place is said.
const PLACE_NAME: &[Parameter] = &[row::text()
    .named("", "place", "A town, a country, an island, a landmark or an observatory by its name, or coordinates in any spelling")
    .option("place", "NAME")
    .more("With region or country where there are several (\"Lund, Sweden\", \"portland, maine\", \"Santorini\"); coordinates such as \"55.71, 13.19\", \"55 42 36 N 13 11 24 E\", or a link to a map. Of several places the one with the most inhabitants is taken, and told; `skyprobe places NAME` lists them. A country stands where its capital is. It gives the elevation, too: that of the town, or roughly that of the land at coordinates.")];

/// Files to write.
const OUTPUT: &[Parameter] = &[Parameter::new(crate::parameter::Kind::Files, "").named(
    "",
    "output",
    "Files to write: .exr (float, ZIP), .hdr (Radiance RGBE) or .png (tone mapped, to look at)",
)];

/// Where and when, or under which Sun.
pub const PLACE_AND_TIME: Section = Section { title: "Place and time", rows: &[PLACE_NAME, Place::PARAMETERS, TIME, PUT_SUN] };
/// The state of the air.
pub const AIR: Section = Section { title: "Air", rows: &[crate::atmosphere::AirParameters::PARAMETERS, SceneAtmosphere::SOLVE] };
/// The night.
pub const NIGHT: Section = Section { title: "Night", rows: &[NightOptions::PARAMETERS] };
/// The picture.
pub const IMAGE: Section = Section {
    title: "Image",
    rows: &[ProbeSettings::PARAMETERS, LightOptions::MODEL, LightOptions::PARAMETERS, PolarisingFilter::PARAMETERS],
};
/// The files.
pub const FILE: Section = Section { title: "Output", rows: &[FileOptions::PARAMETERS, OUTPUT] };

/// All sections.
pub const SECTIONS: [Section; 5] = [PLACE_AND_TIME, AIR, NIGHT, IMAGE, FILE];

/// All parameters of a scene.
pub fn parameters() -> impl Iterator<Item = &'static Parameter> {
    SECTIONS.into_iter().flat_map(|section| section.parameters())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameter::DefaultValue;
    use std::collections::BTreeSet;

    #[test]
    fn each_parameter_stands_once_with_help_and_a_default_that_can_be_read() {
        let mut paths = BTreeSet::new();
        let mut options = BTreeSet::new();
        for parameter in parameters() {
            assert!(paths.insert(parameter.path()), "{}", parameter.path());
            assert!(!parameter.help.is_empty() && !parameter.help.ends_with('.'), "{}", parameter.path());
            if let Some(option) = parameter.option {
                assert!(options.insert(option.name), "{}", option.name);
                // A flag that is on could not be taken back.
                let is_on = parameter.kind == crate::parameter::Kind::Flag && parameter.default == DefaultValue::Value("true");
                assert_eq!(option.off, is_on.then(|| format!("no-{}", option.name)).as_deref(), "{}", option.name);
            }
            if let DefaultValue::Value(json) = parameter.default {
                serde_json::from_str::<serde_json::Value>(json).unwrap_or_else(|error| panic!("{}: {error}", parameter.path()));
            }
        }
    }

    #[test]
    fn what_is_written_are_the_parameters_and_their_defaults() {
        let written = super::super::Scene::default().to_value();
        for parameter in parameters() {
            let value = written.pointer(&format!("/{}", parameter.path().replace('.', "/")));
            match (parameter.default, value) {
                (DefaultValue::Value(json), Some(value)) => {
                    assert_eq!(*value, serde_json::from_str::<serde_json::Value>(json).unwrap(), "{}", parameter.path());
                }
                (DefaultValue::Value(_), None) => {
                    assert!(["turn_deg", "strength", "angle_deg"].contains(&parameter.name), "{}", parameter.path())
                }
                (_, value) => assert_eq!(value, None, "{}", parameter.path()),
            }
        }
        let known: BTreeSet<String> = parameters().map(Parameter::path).collect();
        for (key, value) in written.as_object().unwrap() {
            match value.as_object() {
                Some(table) => assert!(table.keys().all(|inner| known.contains(&format!("{key}.{inner}"))), "{key}"),
                None => assert!(known.contains(key), "{key}"),
            }
        }
    }
}
