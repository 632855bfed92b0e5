//! The time zone kept at a place: boundaries of timezone-boundary-builder (OpenStreetMap, ODbL 1.0) as packed by tzf-dist.

use std::sync::LazyLock;
use tzf_rs::EmbeddedFinder;

// Searches the embedded bytes in place: checked once at the first question (some 15 ms), then microseconds each.
static FINDER: LazyLock<EmbeddedFinder> = LazyLock::new(EmbeddedFinder::new);

/// IANA name of the zone at a place [degrees]. At sea the nautical zone ("Etc/GMT+3"), and UTC where no zone is mapped.
pub(super) fn zone_name(latitude_deg: f64, longitude_deg: f64) -> &'static str {
    match FINDER.get_tz_name(longitude_deg, latitude_deg) {
        "" => "UTC",
        name => name,
    }
}
