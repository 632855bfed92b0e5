//! Which channels of a file are its picture (OpenEXR documentation, "Technical Introduction", channel names; "Scene-linear image representation").
//!
//! A name such as `ViewLayer.Combined.R` is layer and colour. Colours are `R`, `G`, `B` or `red`, `green`, `blue`; luminance `Y` with chroma `RY`, `BY`; `X`, `Y`, `Z` of
//! CIE; in either case. Of several layers the first of the best kind is taken:
//!
//! 1. colours: R G B, or Y RY BY; then X Y Z; then Y alone; then the only channel of a file, whatever its name, but for alpha;
//! 2. of the same kind the channels without a layer, then a layer of the name of a finished picture ([`FINISHED`]), then others;
//! 3. layers of the name of something that is no light ([`NO_LIGHT`]) are taken for colours only if there are no others, and never for X Y Z or Y. X Y Z of a layer without
//!    one of these names, nor of a finished picture, may be any vector and are not taken either.

use super::part::{Channel, Part};
use std::collections::BTreeMap;

/// Layers that hold the finished picture.
const FINISHED: [&str; 10] = ["combined", "beauty", "rgba", "rgb", "composite", "c", "color", "colour", "main", "master"];

/// Layers that hold no light.
const NO_LIGHT: [&str; 34] = [
    "normal",
    "normals",
    "n",
    "ng",
    "position",
    "positions",
    "p",
    "pos",
    "pworld",
    "vector",
    "vectors",
    "motion",
    "motionvector",
    "velocity",
    "uv",
    "st",
    "depth",
    "z",
    "id",
    "indexob",
    "indexma",
    "mist",
    "denoising normal",
    "denoising depth",
    "denoising albedo",
    "albedo",
    "ao",
    "ambientocclusion",
    "shadow",
    "mask",
    "matte",
    "objectid",
    "materialid",
    "zdepth",
];

/// Views of a stereo picture, which may stand last in the name of a layer.
const VIEWS: [&str; 3] = ["left", "right", "center"];

/// What the channels of a picture are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Colours {
    /// Red, green, blue.
    Rgb,
    /// Luminance, and red and blue less luminance, over luminance.
    LuminanceChroma,
    /// CIE X, Y, Z.
    Xyz,
    /// One value.
    Grey,
}

/// Where the picture stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Number of the part.
    pub part: usize,
    /// What its channels are.
    pub colours: Colours,
    /// Numbers of its channels in the part: one, or three in the order of [`Colours`]; luminance can have one chroma only.
    pub channels: Vec<Option<usize>>,
}

/// Channels of one layer by what they are; of equal ones the one in capitals.
#[derive(Default)]
struct Layer<'a> {
    by_colour: BTreeMap<&'static str, (bool, usize, &'a Channel)>,
}

/// The colour that the last part of a name means.
fn colour(name: &str) -> Option<&'static str> {
    Some(match name.to_ascii_lowercase().as_str() {
        "r" | "red" => "R",
        "g" | "green" => "G",
        "b" | "blue" => "B",
        "y" => "Y",
        "ry" => "RY",
        "by" => "BY",
        "x" => "X",
        "z" => "Z",
        "a" | "alpha" => "A",
        _ => return None,
    })
}

impl Layer<'_> {
    fn get(&self, colour: &str) -> Option<usize> {
        self.by_colour.get(colour).map(|(_, number, _)| *number)
    }

    fn whole(&self, colours: [&str; 3]) -> Option<Vec<Option<usize>>> {
        let whole = |colour: &&str| self.by_colour.get(*colour).is_some_and(|(_, _, channel)| channel.sampling == (1, 1));
        colours.iter().all(whole).then(|| colours.map(|colour| self.get(colour)).to_vec())
    }

    /// The best picture in it; Z is the depth of a finished picture, in other layers it may be a coordinate.
    fn picture(&self, is_finished: bool) -> Option<(Colours, Vec<Option<usize>>)> {
        if let Some(channels) = self.whole(["R", "G", "B"]) {
            return Some((Colours::Rgb, channels));
        }
        let luminance =
            self.by_colour.get("Y").filter(|(_, _, channel)| channel.sampling == (1, 1)).map(|(_, number, _)| *number);
        let (red, blue) = (self.get("RY"), self.get("BY"));
        if luminance.is_some() && (red.is_some() || blue.is_some()) {
            return Some((Colours::LuminanceChroma, vec![luminance, red, blue]));
        }
        if let Some(channels) = self.whole(["X", "Y", "Z"]) {
            return Some((Colours::Xyz, channels));
        }
        let alone = self.get("X").is_none() && (is_finished || self.get("Z").is_none());
        luminance.filter(|_| alone).map(|number| (Colours::Grey, vec![Some(number)]))
    }
}

/// The place of a layer among those of the same kind; greater is worse.
fn place(prefix: &str) -> u32 {
    let parts: Vec<String> = prefix.split('.').map(str::to_ascii_lowercase).collect();
    let is_view = |name: &String| VIEWS.contains(&name.as_str());
    let last = parts.iter().rev().find(|name| !is_view(name)).map_or("", String::as_str);
    match last {
        "" => 0,
        name if FINISHED.contains(&name) => 1,
        name if NO_LIGHT.contains(&name) || name.starts_with("crypto") => 3,
        _ => 2,
    }
}

/// The name of a part, which is that of a layer where there are several.
fn own_name<'a>(parts: &[Part], part: &'a Part) -> &'a str {
    part.name.as_deref().filter(|_| parts.len() > 1).unwrap_or("")
}

/// Layer and colour of a channel, with the name of its part, `own`, before it if it does not have it.
fn split<'a>(own: &str, name: &'a str) -> (String, &'a str) {
    let (prefix, last) = name.rsplit_once('.').unwrap_or(("", name));
    let within = prefix == own || prefix.strip_prefix(own).is_some_and(|rest| rest.starts_with('.'));
    let whole = if own.is_empty() || within {
        prefix.to_owned()
    } else if prefix.is_empty() {
        own.to_owned()
    } else {
        format!("{own}.{prefix}")
    };
    (whole, last)
}

/// The picture among the channels of all parts.
pub fn choose(parts: &[Part]) -> Option<Found> {
    let mut best: Option<((Colours, u32), Found)> = None;
    for (number, part) in parts.iter().enumerate().filter(|(_, part)| !part.deep) {
        let own = own_name(parts, part);
        let names: Vec<String> = part.channels.iter().map(Channel::text).collect();
        let mut layers: BTreeMap<String, Layer<'_>> = BTreeMap::new();
        for (k, (channel, name)) in part.channels.iter().zip(&names).enumerate() {
            let (prefix, last) = split(own, name);
            let Some(colour) = colour(last) else { continue };
            let small = last != colour;
            let entry = layers.entry(prefix).or_default().by_colour.entry(colour).or_insert((small, k, channel));
            if entry.0 && !small {
                *entry = (small, k, channel);
            }
        }
        for (prefix, layer) in layers {
            let place = place(&prefix);
            let Some((colours, channels)) = layer.picture(place <= 1) else { continue };
            let may_be_other = match colours {
                Colours::Rgb | Colours::LuminanceChroma => false,
                Colours::Xyz => place > 1,
                Colours::Grey => place > 2,
            };
            if may_be_other {
                continue;
            }
            // Both hold all colours.
            let kind = if place == 3 { Colours::Grey } else { colours.max(Colours::LuminanceChroma) };
            if best.as_ref().is_none_or(|(other, _)| (kind, place) < *other) {
                best = Some(((kind, place), Found { part: number, colours, channels }));
            }
        }
    }
    best.map(|(_, found)| found).or_else(|| only(parts))
}

/// The only channel of a file that is not alpha; or the only one beside alpha and depth, if it may be light.
fn only(parts: &[Part]) -> Option<Found> {
    only_beside(parts, &["A"]).or_else(|| only_beside(parts, &["A", "Z"]).filter(|found| may_be_light(parts, found)))
}

/// Whether neither the name nor the layer of the first channel says that it is something else.
fn may_be_light(parts: &[Part], found: &Found) -> bool {
    let Some(Some(number)) = found.channels.first() else { return false };
    let part = &parts[found.part];
    let name = part.channels[*number].text();
    let (prefix, last) = split(own_name(parts, part), &name);
    place(&prefix) < 3 && place(last) < 3 && colour(last) != Some("X")
}

/// The only channel of a file beside those of the colours `left_out`.
fn only_beside(parts: &[Part], left_out: &[&str]) -> Option<Found> {
    let all = parts.iter().enumerate().flat_map(|(part, found)| (0..found.channels.len()).map(move |channel| (part, channel)));
    let is_light = |&(part, channel): &(usize, usize)| {
        let name = parts[part].channels[channel].text();
        !colour(split("", &name).1).is_some_and(|colour| left_out.contains(&colour))
    };
    let mut lights = all.filter(is_light);
    match (lights.next(), lights.next()) {
        (Some((part, channel)), None) if !parts[part].deep && parts[part].channels[channel].sampling == (1, 1) => {
            Some(Found { part, colours: Colours::Grey, channels: vec![Some(channel)] })
        }
        _ => None,
    }
}

/// Why there is no picture, in words.
pub fn why_none(parts: &[Part]) -> String {
    if parts.iter().all(|part| part.deep) {
        return "OpenEXR with deep data, which have many samples a pixel and no single picture: flatten it".to_owned();
    }
    const SHOWN: usize = 16;
    let names: Vec<String> = parts
        .iter()
        .flat_map(|part| part.channels.iter().map(move |channel| (part, channel)))
        .take(SHOWN)
        .map(|(part, channel)| {
            let name = channel.text();
            let (prefix, last) = split(own_name(parts, part), &name);
            if prefix.is_empty() { name } else { format!("{prefix}.{last}") }
        })
        .collect();
    let count: usize = parts.iter().map(|part| part.channels.len()).sum();
    let more = if count > SHOWN { format!(" and {} more", count - SHOWN) } else { String::new() };
    format!("no channels R, G, B or Y, RY, BY or X, Y, Z or Y among {}{more}", names.join(", "))
}

#[cfg(test)]
mod tests {
    use super::super::part::Kind;
    use super::*;

    fn part(name: Option<&str>, channels: &[&str]) -> Part {
        let channel = |name: &&str| {
            let sampling = if ["RY", "BY"].contains(name) { (2, 2) } else { (1, 1) };
            Channel { name: name.as_bytes().to_vec(), kind: Kind::Half, linear: false, sampling }
        };
        Part { name: name.map(str::to_owned), channels: channels.iter().map(channel).collect(), ..Default::default() }
    }

    /// Colours, and the names of the channels that were chosen.
    fn found(parts: &[Part]) -> Option<(Colours, Vec<String>)> {
        let found = choose(parts)?;
        let names = found.channels.iter().flatten().map(|&k| parts[found.part].channels[k].text()).collect();
        Some((found.colours, names))
    }

    #[test]
    fn the_picture_is_told_from_what_is_beside_it() {
        type Case<'a> = (&'a [&'a str], Option<(Colours, &'a [&'a str])>);
        let cases: [Case<'_>; 29] = [
            (&["b", "g", "r"], Some((Colours::Rgb, &["r", "g", "b"]))),
            (&["blue", "green", "red"], Some((Colours::Rgb, &["red", "green", "blue"]))),
            (&["B", "g", "r", "R", "b", "G"], Some((Colours::Rgb, &["R", "G", "B"]))),
            (&["C.b", "C.g", "C.r", "Z"], Some((Colours::Rgb, &["C.r", "C.g", "C.b"]))),
            (
                &["a.B", "a.G", "a.R", "beauty.b", "beauty.g", "beauty.r"],
                Some((Colours::Rgb, &["beauty.r", "beauty.g", "beauty.b"])),
            ),
            (&["N.B", "N.G", "N.R", "x.B", "x.G", "x.R"], Some((Colours::Rgb, &["x.R", "x.G", "x.B"]))),
            (&["left.B", "left.G", "left.R", "B", "G", "R"], Some((Colours::Rgb, &["R", "G", "B"]))),
            (&["A", "BY", "RY", "Y"], Some((Colours::LuminanceChroma, &["Y", "RY", "BY"]))),
            (&["RY", "Y"], Some((Colours::LuminanceChroma, &["Y", "RY"]))),
            (&["x", "y", "z"], Some((Colours::Xyz, &["x", "y", "z"]))),
            (&["X", "Y", "Z", "B", "G", "R"], Some((Colours::Rgb, &["R", "G", "B"]))),
            (&["A", "Y"], Some((Colours::Grey, &["Y"]))),
            (&["B", "G", "Y"], Some((Colours::Grey, &["Y"]))),
            (&["Y", "Z"], Some((Colours::Grey, &["Y"]))),
            (&["R", "Z"], Some((Colours::Grey, &["R"]))),
            (&["Z"], Some((Colours::Grey, &["Z"]))),
            (&["A", "Z"], Some((Colours::Grey, &["Z"]))),
            (&["Z", "id.X"], None),
            (&["Z", "mask"], None),
            (&["Z", "intensity"], Some((Colours::Grey, &["intensity"]))),
            (&["X", "Y"], None),
            (&["albedo.B", "albedo.G", "albedo.R", "Y"], Some((Colours::Grey, &["Y"]))),
            (
                &[
                    "v.CryptoObject00.b",
                    "v.CryptoObject00.g",
                    "v.CryptoObject00.r",
                    "v.main_light.B",
                    "v.main_light.G",
                    "v.main_light.R",
                ],
                Some((Colours::Rgb, &["v.main_light.R", "v.main_light.G", "v.main_light.B"])),
            ),
            (&["intensity"], Some((Colours::Grey, &["intensity"]))),
            (&["A", "R"], Some((Colours::Grey, &["R"]))),
            (&["A"], None),
            (&["Normal.X", "Normal.Y", "Normal.Z"], None),
            (&["dPdu.X", "dPdu.Y", "dPdu.Z"], None),
            (&["B", "G"], None),
        ];
        for (channels, expected) in cases {
            let expected = expected.map(|(colours, names)| (colours, names.iter().map(|&name| name.to_owned()).collect()));
            assert_eq!(found(&[part(None, channels)]), expected, "{channels:?}");
        }
    }

    #[test]
    fn parts_are_layers() {
        let deep = Part { deep: true, ..part(Some("deep"), &["B", "G", "R"]) };
        let parts = [
            deep,
            part(Some("depth"), &["Z"]),
            part(Some("diffuse"), &["B", "G", "R"]),
            part(Some("rgba.left"), &["B", "G", "R"]),
        ];
        assert_eq!(choose(&parts).unwrap().part, 3);
        assert_eq!(choose(&parts[..3]).unwrap().part, 2);
        assert!(choose(&parts[..1]).is_none() && why_none(&parts[..1]).contains("deep data"));
        let message = why_none(&[part(Some("a"), &["Y", "Z"]), part(Some("b"), &["b.Z"])]);
        assert!(message.ends_with("among a.Y, a.Z, b.Z"), "{message}");
        assert!(why_none(&[part(None, &["q"; 99])]).ends_with("and 83 more"));
    }
}
