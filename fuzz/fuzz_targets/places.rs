//! The search for places by name: never more answers than asked for. Run it with `-timeout=1`: no text may take long.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::places::{locate, search};

fuzz_target!(|text: &str| {
    assert!(search(text, 5).len() <= 5);
    let _ = locate(text);
});
