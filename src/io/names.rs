//! Names that Windows gives another meaning: a picture written to one of them would be lost, or lie under another name, without a word.

use std::path::{Component, Path};

/// Names of devices, whatever their ending: `nul.exr` is the null device on systems before Windows 11.
const DEVICES: [&str; 6] = ["CON", "PRN", "AUX", "NUL", "CONIN$", "CONOUT$"];
/// Devices with a number, of which superscripts count too.
const NUMBERED: [&str; 2] = ["COM", "LPT"];
const NUMBERS: &str = "0123456789¹²³";
const FORBIDDEN: &str = "<>:\"|?*";

/// Why Windows cannot keep a file under the last part of `path`, or `None` if it can.
pub(super) fn refused_by_windows(path: &Path) -> Option<String> {
    let Some(Component::Normal(name)) = path.components().next_back() else { return None };
    let name = name.to_string_lossy();
    let stem = name.split('.').next().unwrap_or_default().trim_end_matches(' ').to_uppercase();
    let numbered = |device: &&str| {
        let mut rest = stem.strip_prefix(*device).unwrap_or_default().chars();
        rest.next().is_some_and(|number| NUMBERS.contains(number)) && rest.next().is_none()
    };
    if DEVICES.contains(&stem.as_str()) || NUMBERED.iter().any(numbered) {
        return Some(format!("{stem} is the name of a device of Windows"));
    }
    if name.ends_with(['.', ' ']) {
        return Some("Windows drops a full stop or a blank at the end of a name".to_owned());
    }
    let wrong = name.chars().find(|&character| FORBIDDEN.contains(character) || character < ' ')?;
    Some(format!("{wrong:?} cannot be in the name of a file of Windows"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_and_names_that_change_are_known() {
        for name in [
            "nul",
            "NUL.exr",
            "con.hdr",
            "Aux.tar.exr",
            "prn .exr",
            "com1.exr",
            "LPT9.png",
            "COM¹.exr",
            "conout$",
            "sky.exr.",
            "sky.exr ",
            "sky?.exr",
            "sky.exr:stream",
            "a|b.exr",
            "tab\t.exr",
        ] {
            assert!(refused_by_windows(&Path::new("folder").join(name)).is_some(), "{name}");
        }
        for name in [
            "sky.exr",
            ".exr",
            "con1.exr",
            "com.exr",
            "com10.exr",
            "console.exr",
            "nul_.exr",
            "a b.exr",
            "ö☀空.exr",
            "null.exr",
            "lpt.exr",
        ] {
            assert_eq!(refused_by_windows(Path::new(name)), None, "{name}");
        }
        // Folders of such names are the system's own matter.
        assert_eq!(refused_by_windows(Path::new("nul/..")), None);
    }
}
