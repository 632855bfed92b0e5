//! Which calls of Python take parameters of the table by name, and what they take besides.
//!
//! From here come the keywords that Python reads, and what it shows of them: signatures, docstrings and stubs (`super::face`).

use super::SceneAtmosphere;
use crate::atmosphere::AirParameters;
use crate::io::FileOptions;
use crate::parameter::Parameter;
use crate::probe::ProbeSettings;
use crate::sky::{LightOptions, NightOptions, PolarisingFilter};

/// A call of Python.
#[derive(Debug)]
pub struct Call {
    /// The class, or class and method with a dot between them.
    pub name: &'static str,
    /// What it is or does: paragraphs.
    pub about: &'static str,
    /// What it takes by place.
    pub places: &'static [Own],
    /// What it takes by name.
    pub keywords: &'static [Keyword],
    /// The type that it returns, as the stub says it.
    pub returns: &'static str,
}

/// Something that a call takes by name.
#[derive(Debug)]
pub enum Keyword {
    /// Each row of a table but those that are named.
    Rows(&'static [Parameter], &'static [&'static str]),
    /// What is no parameter of a scene, or has another form in Python.
    Own(Own),
    /// All that another call takes by name but what is named.
    Like(&'static Call, &'static [&'static str]),
}

/// An argument that has no row.
#[derive(Clone, Copy, Debug)]
pub struct Own {
    /// Its name.
    pub name: &'static str,
    /// Its type, as the stub says it.
    pub annotation: &'static str,
    /// Its default in Python; empty where it must be given.
    pub default: &'static str,
    /// What it is: sentences.
    pub text: &'static str,
}

const PATH: Own = Own {
    name: "path",
    annotation: "str | os.PathLike[str]",
    default: "",
    text: "Its suffix says the format: .exr (float), .hdr (Radiance RGBE) or .png (tone mapped, to look at).",
};

const PROGRESS: Keyword = Keyword::Own(Own {
    name: "progress",
    annotation: "_Progress | None",
    default: "None",
    text: "Called with stage and fraction; returning False raises Cancelled, and no file is left behind.",
});

/// `skyprobe.Atmosphere`.
pub const ATMOSPHERE: Call = Call {
    name: "Atmosphere",
    about: "The state of the air. It is solved on first use, once, and can be shared by any number of skies and threads.\n\n\
            What is left out comes from the preset. At most one of ``aod550``, ``turbidity`` and ``visibility_km`` is given.",
    places: &[],
    keywords: &[
        Keyword::Rows(AirParameters::PARAMETERS, &[]),
        Keyword::Rows(SceneAtmosphere::SOLVE, &[]),
        Keyword::Own(Own {
            name: "cache",
            annotation: "bool",
            default: "True",
            text: "Whether light that was solved earlier is used again, and what is solved is kept, on this machine (see ``SKYPROBE_CACHE_DIR``; drafts \
                   are not kept).",
        }),
    ],
    returns: "Atmosphere",
};

/// `skyprobe.Night`.
pub const NIGHT: Call = Call {
    name: "Night",
    about: "What of the night is in a sky with place and time, and how bright what varies is.\n\n\
            At most one of ``zenith_brightness`` and ``bortle`` is given.",
    places: &[],
    keywords: &[Keyword::Rows(NightOptions::PARAMETERS, &[])],
    returns: "Night",
};

/// `skyprobe.PolarisingFilter`.
pub const POLARISING_FILTER: Call = Call {
    name: "PolarisingFilter",
    about: "A polarising filter between the sky and the picture: what is seen is I + strength (Q cos 2c + U sin 2c), where c is the angle of its axis from the \
            vertical. The half of the light that any filter takes is made up for by the exposure.",
    places: &[],
    keywords: &[Keyword::Rows(PolarisingFilter::PARAMETERS, &[])],
    returns: "PolarisingFilter",
};

/// `skyprobe.Sky.render`.
pub const RENDER: Call = Call {
    name: "Sky.render",
    about: "An image of the light from all directions.",
    places: &[],
    keywords: &[
        Keyword::Rows(ProbeSettings::PARAMETERS, &[]),
        Keyword::Own(Own {
            name: "polarising_filter",
            annotation: "PolarisingFilter | None",
            default: "None",
            text: "What is held before the sky.",
        }),
        Keyword::Rows(LightOptions::PARAMETERS, &[]),
        Keyword::Own(Own {
            name: "progress",
            annotation: "_Progress | None",
            default: "None",
            text: "Called with stage and fraction; returning False raises Cancelled.",
        }),
    ],
    returns: "Probe",
};

/// `skyprobe.Probe.save`.
pub const SAVE: Call = Call {
    name: "Probe.save",
    about: "Write the probe; the file appears whole or not at all.",
    places: &[PATH],
    keywords: &[
        Keyword::Own(Own {
            name: "half",
            annotation: "bool | _Half | None",
            default: "None",
            text: "EXR with half floats, which end at 65504. True or \"refuse\": a brighter pixel, such as the Sun's disc, is an InputError; \"scale\": all \
                   pixels are multiplied by a power of two, which the header states.",
        }),
        Keyword::Rows(FileOptions::PARAMETERS, &["half", "layers"]),
        PROGRESS,
    ],
    returns: "None",
};

/// `skyprobe.Sky.render_to_file`.
pub const RENDER_TO_FILE: Call = Call {
    name: "Sky.render_to_file",
    about: "Render straight into a file, which appears whole or not at all: the same picture as ``render(...).save(path)``, without ever being in memory as a \
            whole (but for a PNG).",
    places: &[PATH],
    keywords: &[
        Keyword::Like(&RENDER, &["progress"]),
        Keyword::Own(Own {
            name: "separate_layers",
            annotation: "bool",
            default: "False",
            text: "Whether an EXR file holds each layer beside their sum, in channels such as ``stars.R``.",
        }),
        Keyword::Like(&SAVE, &["progress"]),
        PROGRESS,
    ],
    returns: "None",
};

/// All of them.
pub const CALLS: [&Call; 6] = [&ATMOSPHERE, &NIGHT, &POLARISING_FILTER, &RENDER, &RENDER_TO_FILE, &SAVE];

/// Classes of Python that show the values of a table, each as an attribute.
pub const SHOWN: [(&str, &[Parameter]); 3] = [
    ("Night", NightOptions::PARAMETERS),
    ("PolarisingFilter", PolarisingFilter::PARAMETERS),
    ("Probe", ProbeSettings::PARAMETERS),
];

/// An argument by name: of a row or not.
#[derive(Clone, Copy, Debug)]
pub enum Argument {
    /// Of the table.
    Row(&'static Parameter),
    /// Of its own.
    Own(&'static Own),
}

impl Argument {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Row(row) => row.name,
            Self::Own(own) => own.name,
        }
    }
}

impl Keyword {
    /// The arguments that it stands for.
    pub fn arguments(&'static self) -> Vec<Argument> {
        match self {
            Self::Rows(rows, except) => rows.iter().filter(|row| !except.contains(&row.name)).map(Argument::Row).collect(),
            Self::Own(own) => vec![Argument::Own(own)],
            Self::Like(call, except) => {
                call.arguments().into_iter().filter(|argument| !except.contains(&argument.name())).collect()
            }
        }
    }
}

impl Call {
    /// All that it takes by name.
    pub fn arguments(&'static self) -> Vec<Argument> {
        self.keywords.iter().flat_map(Keyword::arguments).collect()
    }
}
