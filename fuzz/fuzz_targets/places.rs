//! The search for places by name: never more answers than asked for. Run it with `-timeout=2`: no text may take long, but for the first, which loads the data.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::places::{locate, search};

fuzz_target!(
    init: {
        let _ = locate("Lund");
    },
    |text: &str| {
        assert!(search(text, 5).len() <= 5);
        let _ = locate(text);
    }
);
