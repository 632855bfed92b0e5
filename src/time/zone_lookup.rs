//! The time zone kept at a place: boundaries of timezone-boundary-builder (OpenStreetMap, ODbL 1.0) as packed by tzf-dist.

use crate::error::{Result, check_range};

/// IANA name of the zone that is kept today at a place [degrees]. At sea the nautical zone ("Etc/GMT+3", which is behind UTC), and UTC where no zone is
/// mapped. The first question takes some 15 ms, others microseconds.
///
/// # Errors
/// [`crate::Error::Input`] for `latitude` outside -90 to 90, `longitude` outside -180 to 180 degrees, and for `zone` if the program was built
/// without the feature `zone-lookup`.
pub fn zone_of_place(latitude_deg: f64, longitude_deg: f64) -> Result<&'static str> {
    check_range("latitude", latitude_deg, -90.0, 90.0, "degrees")?;
    check_range("longitude", longitude_deg, -180.0, 180.0, "degrees")?;
    find(latitude_deg, longitude_deg)
}

#[cfg(feature = "zone-lookup")]
fn find(latitude_deg: f64, longitude_deg: f64) -> Result<&'static str> {
    use std::sync::LazyLock;
    use tzf_rs::EmbeddedFinder;

    // Searches the embedded bytes in place, checked once.
    static FINDER: LazyLock<EmbeddedFinder> = LazyLock::new(EmbeddedFinder::new);

    Ok(match FINDER.get_tz_name(longitude_deg, latitude_deg) {
        "" => "UTC",
        name => name,
    })
}

#[cfg(not(feature = "zone-lookup"))]
fn find(_latitude_deg: f64, _longitude_deg: f64) -> Result<&'static str> {
    Err(crate::Error::input("zone", "nothing", "given: this build does not know the zones of places"))
}
