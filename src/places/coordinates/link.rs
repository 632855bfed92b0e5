//! Coordinates in links to maps and in `geo:` addresses.

use super::{Coordinates, refuse};
use crate::error::Result;

/// Keys that have latitude and longitude each.
const PAIRS_OF_KEYS: [(&str, &str); 5] =
    [("mlat", "mlon"), ("lat", "lon"), ("lat", "lng"), ("latitude", "longitude"), ("marker_lat", "marker_lon")];

/// Keys that have both, in the order of how likely they are meant.
const KEYS_OF_BOTH: [&str; 8] = ["query", "q", "ll", "sll", "destination", "center", "cp", "viewpoint"];

/// What a link or an address says; `None` if `text` is neither.
pub(super) fn find(text: &str) -> Option<Result<Coordinates>> {
    let text = text.trim();
    let decoded = text.replace("%2C", ",").replace("%2c", ",").replace("%20", " ");
    if let Some(rest) = strip_scheme(&decoded, "geo:") {
        return Some(geo_address(text, rest));
    }
    match in_link(&decoded) {
        Some((latitude, longitude)) => Some(Coordinates::new(latitude, longitude)),
        None if decoded.contains("://") => Some(Err(refuse(text, "this link has none in it; the long link of a map has"))),
        None => None,
    }
}

fn strip_scheme<'a>(text: &'a str, scheme: &str) -> Option<&'a str> {
    let head = text.get(..scheme.len())?;
    head.eq_ignore_ascii_case(scheme).then(|| &text[scheme.len()..])
}

/// RFC 5870: latitude, longitude and perhaps altitude between commas, then parameters. Some put a point into q after 0,0.
fn geo_address(text: &str, rest: &str) -> Result<Coordinates> {
    let point = rest.split([';', '?']).next().unwrap_or("");
    let unreadable = || refuse(text, "after geo: latitude and longitude with a comma between them");
    let numbers: Option<Vec<f64>> = point.split(',').map(|number| number.trim().parse().ok()).collect();
    let (latitude, longitude) = match numbers.as_deref() {
        Some(&[latitude, longitude] | &[latitude, longitude, _]) => (latitude, longitude),
        _ => return Err(unreadable()),
    };
    let searched = if (latitude, longitude) == (0.0, 0.0) { value_of(rest, "q").and_then(pair) } else { None };
    let (latitude, longitude) = searched.unwrap_or((latitude, longitude));
    Coordinates::new(latitude, longitude)
}

fn in_link(text: &str) -> Option<(f64, f64)> {
    let keys_apart =
        || PAIRS_OF_KEYS.iter().find_map(|(lat, lon)| Some((number(value_of(text, lat)?)?, number(value_of(text, lon)?)?)));
    // The pin of a place, which is more exact than the middle of the map.
    let pin = || Some((number(after(text, "!3d")?)?, number(after(text, "!4d")?)?));
    let keys_of_both =
        || KEYS_OF_BOTH.iter().find_map(|key| pair(value_of(text, key)?.strip_prefix("loc:").unwrap_or(value_of(text, key)?)));
    let at_sign = || text.match_indices('@').find_map(|(at, _)| pair(&text[at + 1..]));
    let map = || {
        let mut parts = after(text, "#map=").or_else(|| after(text, "&map="))?.split('/').skip(1);
        Some((number(parts.next()?)?, number(parts.next()?)?))
    };
    keys_apart().or_else(pin).or_else(keys_of_both).or_else(at_sign).or_else(map)
}

fn after<'a>(text: &'a str, mark: &str) -> Option<&'a str> {
    text.split_once(mark).map(|(_, rest)| rest)
}

/// What follows `key=`, at the beginning or after ?, & or #.
fn value_of<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    text.match_indices(key).find_map(|(at, _)| {
        let value = text[at + key.len()..].strip_prefix('=')?;
        (at == 0 || matches!(text.as_bytes()[at - 1], b'?' | b'&' | b'#')).then_some(value)
    })
}

/// The number that `text` begins with, as links have it: a sign, digits, a point; ended by anything else than a letter.
fn number(text: &str) -> Option<f64> {
    let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
    let digits = unsigned.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(unsigned.len());
    let end = text.len() - unsigned.len() + digits;
    let is_end = !text[end..].starts_with(char::is_alphanumeric);
    text[..end].parse().ok().filter(|_| is_end)
}

/// Two numbers with a comma, a blank, a plus or a tilde between them.
fn pair(text: &str) -> Option<(f64, f64)> {
    let first = number(text)?;
    let at = text[1..].find([',', '~', ' ', '+']).map(|at| at + 1)?;
    Some((first, number(text[at + 1..].trim_start_matches([' ', '+']))?))
}
