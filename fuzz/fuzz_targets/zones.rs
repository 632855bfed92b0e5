//! Names of time zones, given apart and in the brackets of a time.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::time::{Time, ZoneChoice};

fuzz_target!(|name: &str| {
    let apart = Time::parse("2005-06-21T13:00:00", ZoneChoice::Named(name));
    let inside = Time::parse(&format!("2005-06-21T13:00:00[{name}]"), ZoneChoice::InText);
    if let (Ok(apart), Ok(inside)) = (apart, inside) {
        assert_eq!(apart.civil(), inside.civil());
    }
});
