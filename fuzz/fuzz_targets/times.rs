//! The reader of times, with the zone in the text, named, and found by the place.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::time::{Time, ZoneChoice};

fuzz_target!(|text: &str| {
    let place = ZoneChoice::OfPlace { latitude_deg: 55.71, longitude_deg: 13.19 };
    for zone in [ZoneChoice::InText, ZoneChoice::Named("Europe/Stockholm"), ZoneChoice::Named("Pacific/Apia"), place] {
        let _ = Time::parse(text, zone);
    }
});
