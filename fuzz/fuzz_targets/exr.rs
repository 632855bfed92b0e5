//! The reader of OpenEXR pictures: whatever the bytes, a picture of finite pixels or an error, within the limits.
#![no_main]

use libfuzzer_sys::fuzz_target;
use skyprobe::io::{PictureHints, PictureLimits, read_exr_bytes};

fuzz_target!(|bytes: &[u8]| {
    let hints = PictureHints { limits: PictureLimits { max_megapixels: 1.0 }, ..PictureHints::default() };
    if let Ok(mut picture) = read_exr_bytes(bytes, &hints) {
        assert_eq!(picture.pixels.len(), 3 * picture.width * picture.height);
        // Files may hold what is no light: that is repaired and told.
        picture.repair();
        assert!(picture.pixels.iter().all(|value| value.is_finite()));
    }
});
