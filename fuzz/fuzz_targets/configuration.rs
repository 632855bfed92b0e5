//! The reader of configurations: what it accepts it also writes, and reads back as the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::scene::Scene;

fuzz_target!(|text: &str| {
    if let Ok(config) = Scene::from_json(text) {
        let _ = config.validate();
        let written = config.to_json();
        let again = Scene::from_json(&written).expect("what was written is read");
        assert_eq!(again.to_json(), written);
    }
});
