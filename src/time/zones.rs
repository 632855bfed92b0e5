//! Rules of time zones by name: the IANA database with all that is known of the time before 1970.
//!
//! The usual form of the database, which jiff carries, gives zones that agree since 1970 one history: Stockholm has Berlin's. `data/time_zones.bin`
//! has those zones with their own (the file `backzone`); `data/scripts/time_zones.py` makes it and states its layout. All others are jiff's.

use crate::error::{Error, Result, quoted};
use jiff::tz::TimeZone;
use miniz_oxide::inflate::decompress_to_vec_zlib;
use std::sync::{LazyLock, OnceLock};

const MAGIC: &[u8; 8] = b"SKYZONE1";

/// Longest name that is looked up [letters]; the longest of the database has 32.
const LONGEST_NAME: usize = 100;

/// A zone with its own history.
struct Own {
    name: String,
    tzif: Vec<u8>,
    zone: OnceLock<Option<TimeZone>>,
}

/// Sorted by name in small letters.
static OWN: LazyLock<Vec<Own>> =
    LazyLock::new(|| read(include_bytes!("../../data/time_zones.bin")).expect("the embedded time zones are whole"));

/// The zone that `name` is the name of, in any case.
///
/// # Errors
/// [`Error::Input`] for `zone` if the database has none.
pub(super) fn zone_named(name: &str) -> Result<TimeZone> {
    find(name).ok_or_else(|| {
        Error::input("zone", quoted(name), "a name of the IANA time zone database, such as Europe/Stockholm or UTC")
    })
}

/// The zone that `name` is the name of, in any case; `None` if the database has none.
pub(super) fn find(name: &str) -> Option<TimeZone> {
    if name.len() > LONGEST_NAME {
        return None;
    }
    let small = name.to_ascii_lowercase();
    let own = OWN.binary_search_by(|own| own.name.to_ascii_lowercase().cmp(&small)).ok().map(|index| &OWN[index]);
    match own {
        Some(own) => own.zone.get_or_init(|| TimeZone::tzif(&own.name, &own.tzif).ok()).clone(),
        None => TimeZone::get(name).ok(),
    }
}

fn read(bytes: &[u8]) -> Option<Vec<Own>> {
    let content = decompress_to_vec_zlib(bytes.strip_prefix(MAGIC)?).ok()?;
    let (mut rest, mut zones) = (content.as_slice(), Vec::new());
    while !rest.is_empty() {
        let name = take(&mut rest)?;
        let tzif = take(&mut rest)?.to_vec();
        zones.push(Own { name: std::str::from_utf8(name).ok()?.to_string(), tzif, zone: OnceLock::new() });
    }
    Some(zones)
}

/// The bytes after their number, two bytes.
fn take<'a>(rest: &mut &'a [u8]) -> Option<&'a [u8]> {
    let (length, after) = rest.split_first_chunk::<2>()?;
    let (taken, after) = after.split_at_checked(usize::from(u16::from_le_bytes(*length)))?;
    *rest = after;
    Some(taken)
}

#[cfg(test)]
mod tests {
    use super::*;
    use jiff::civil::date;

    #[test]
    fn every_zone_is_whole_and_found_in_any_case() {
        assert!(OWN.len() > 80);
        assert!(OWN.is_sorted_by_key(|own| own.name.to_ascii_lowercase()));
        for own in OWN.iter() {
            let zone = find(&own.name.to_uppercase()).unwrap();
            assert_eq!(zone.iana_name(), Some(own.name.as_str()));
        }
        assert_eq!(find("asia/TOKYO").unwrap().iana_name(), Some("Asia/Tokyo"));
        assert!(read(b"SKYZONE0").is_none());
    }

    /// The rules since 1970 are those of the usual form, as of the same version of the database.
    #[test]
    fn since_1970_nothing_differs_from_the_usual_form() {
        // Names without a place, such as EET, have rules of their own there, and are those of a town in the usual form.
        for own in OWN.iter().filter(|own| own.name.contains('/')) {
            let (full, usual) = (find(&own.name).unwrap(), TimeZone::get(&own.name).unwrap());
            let mut moment = date(1970, 2, 1).at(0, 0, 0, 0);
            while moment.year() < 2060 {
                let offset = |zone: &TimeZone| zone.to_ambiguous_timestamp(moment).compatible().unwrap();
                assert_eq!(offset(&full), offset(&usual), "{} {moment}", own.name);
                moment = moment.checked_add(jiff::Span::new().days(5)).unwrap();
            }
        }
    }

    #[test]
    fn no_name_is_too_long_to_be_refused() {
        let message = zone_named(&"x/".repeat(100_000)).unwrap_err().to_string();
        assert!(message.starts_with("zone = ") && message.len() < 300, "{message}");
    }
}
