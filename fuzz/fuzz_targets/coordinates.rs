//! The reader of coordinates: what it accepts is on the Earth.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::places::Coordinates;

fuzz_target!(|text: &str| {
    if let Ok(place) = Coordinates::parse(text) {
        assert!((-90.0..=90.0).contains(&place.latitude_deg) && (-180.0..=180.0).contains(&place.longitude_deg));
    }
});
