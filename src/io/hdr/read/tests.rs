//! Pictures as other programs write them, made here byte by byte, damaged ones, and hostile ones.

use super::*;
use crate::io::limits::ALL_MEGAPIXELS;
use crate::spectrum::ColorSpace;
use proptest::prelude::*;

const RED: [u8; 4] = [128, 0, 0, 129];
const GREEN: [u8; 4] = [0, 128, 0, 129];

fn file(header: &str, pixels: &[u8]) -> Vec<u8> {
    [header.as_bytes(), pixels].concat()
}

fn read(header: &str, pixels: &[u8]) -> Result<Raw> {
    parse_rgb(Path::new("a.hdr"), &file(header, pixels), &PictureLimits::default())
}

#[test]
fn old_run_lengths_exposure_primaries_and_orientation_are_understood() {
    let header = "#?RGBE\n# by hand\nEXPOSURE=4\nEXPOSURE= 0.5\n\
                  PRIMARIES=.708 .292 .170 .797 .131 .046 .3127 .3290\nFORMAT=32-bit_rle_rgbe\n\n+Y 2 -X 3\n";
    let pixels = [&RED[..], &[1, 1, 1, 2], &GREEN, &RED, &[1, 1, 1, 1]].concat();
    let raw = read(header, &pixels).unwrap();
    assert_eq!((raw.width, raw.height), (3, 2));
    // The first line is the lowest, from the right. The product of the exposures is 2.
    assert_eq!(raw.pixels[9..], [0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, 0.0]);
    assert_eq!(raw.pixels[..9], [0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5, 0.0]);
    assert_eq!(raw.chromaticities.unwrap().space(), Some(ColorSpace::LinRec2020));
    let columns = read("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n+X 2 -Y 1\n", &[RED, GREEN].concat()).unwrap();
    assert_eq!((columns.width, columns.height, &columns.pixels[..]), (2, 1, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0][..]));
    assert_eq!(columns.chromaticities.unwrap().space(), Some(ColorSpace::Xyz));
}

#[test]
fn every_orientation_puts_the_pixels_where_it_says() {
    // Red levels 1 to 6 in the picture 1 2 3 / 4 5 6, in the order of each orientation.
    for (size, order) in [
        ("-Y 2 +X 3", [1, 2, 3, 4, 5, 6]),
        ("-Y 2 -X 3", [3, 2, 1, 6, 5, 4]),
        ("+Y 2 -X 3", [6, 5, 4, 3, 2, 1]),
        ("+Y 2 +X 3", [4, 5, 6, 1, 2, 3]),
        ("+X 3 +Y 2", [4, 1, 5, 2, 6, 3]),
        ("-X 3 +Y 2", [6, 3, 5, 2, 4, 1]),
        ("-X 3 -Y 2", [3, 6, 2, 5, 1, 4]),
        ("+X 3 -Y 2", [1, 4, 2, 5, 3, 6]),
        // As Radiance reads them, too.
        ("  -Y2 +X3\r", [1, 2, 3, 4, 5, 6]),
        ("-Y   2   X 3 ", [1, 2, 3, 4, 5, 6]),
    ] {
        let pixels: Vec<u8> = order.iter().flat_map(|&level| [level * 32, 0, 0, 131]).collect();
        let raw = read(&format!("#?RADIANCE\n\n{size}\n"), &pixels).unwrap();
        assert_eq!((raw.width, raw.height), (3, 2), "{size}");
        let found: Vec<f32> = raw.pixels.iter().step_by(3).copied().collect();
        assert_eq!(found, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "{size}");
    }
}

#[test]
fn headers_of_other_programs_do_not_refuse_their_pictures() {
    let pixel = [128, 64, 26, 129];
    for (header, expected) in [
        ("#?RADIANCE\nGAMMA=1\nPRIMARIES=0 0 0 0 0 0 0 0\nFORMAT=32-bit_rle_rgbe\n\n", [1.0, 0.5, 0.203_125]),
        ("#?RADIANCE\nGAMMA=            1\nEXPOSURE=           0\n\n", [1.0, 0.5, 0.203_125]),
        ("FORMAT=32-bit_rle_rgbe\n\n", [1.0, 0.5, 0.203_125]),
        ("\n", [1.0, 0.5, 0.203_125]),
        ("#?RADIANCE\r\nEXPOSURE=2\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n", [0.5, 0.25, 0.101_562_5]),
        ("#?RADIANCE\na.hdr:\n\trpict\n\tEXPOSURE=16\n\tFORMAT=32-bit_rle_xyze\npcomb a.hdr\n\n", [1.0, 0.5, 0.203_125]),
        ("#?RADIANCE\nCOLORCORR= 0.5 1 2\nEXPOSURE=2\nCOLORCORR= 1 0.25 1\n\n", [1.0, 1.0, 0.050_781_25]),
        ("#?RADIANCE\nCOLORCORR= 2 2\nVIEW=-vtv x=\nPIXASPECT=0.5\n\n", [1.0, 0.5, 0.203_125]),
    ] {
        let size = if header.contains('\r') { "-Y 1 +X 2\r\n" } else { "-Y 1 +X 2\n" };
        let raw = read(&format!("{header}{size}"), &pixel.repeat(2)).unwrap();
        assert_eq!(raw.pixels, [expected, expected].concat(), "{header:?}");
        assert!(raw.chromaticities.is_none());
    }
}

#[test]
fn damage_is_told() {
    let good = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n";
    for (header, pixels, told) in [
        ("P6\n", &[][..], "neither #?"),
        ("", &[], "neither #?"),
        ("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", &[], "does not end"),
        ("#?RADIANCE\nFORMAT=ascii\n\n-Y 1 +X 1\n", &[], "format is ascii"),
        ("#?RADIANCE\n\n", &[], "size is missing"),
        ("#?RADIANCE\n\n-Y 1 +X", &[], "size is missing"),
        ("#?RADIANCE\n\nsize\n", &[], "\"size\" is not its size"),
        ("#?RADIANCE\n\n-Y 1 +X -1\n", &[], "is not its size"),
        ("#?RADIANCE\n\n-Y 1 +X 99999999999999999999\n", &[], "is not its size"),
        ("#?RADIANCE\n\n-Y 1 +X 999999\n", &[], "999999 x 1 pixels"),
        ("#?RADIANCE\n\n-Y 0 +X 9\n", &[], "9 x 0 pixels"),
        ("#?RADIANCE\n\n-Y 9000 +X 9000\n", &[0; 99], "9000 x 9000 pixels in 99 bytes"),
        (good, &[2, 2, 0, 9], "pixels in 4 bytes"),
        (good, &[2, 2, 0, 9, 0, 0, 0, 0], "another width in line 1 of 1"),
        (good, &[9, 9, 9, 128, 1, 1, 1, 3], "ends early in line 1 of 1"),
    ] {
        let reason = read(header, pixels).unwrap_err().to_string();
        assert!(reason.contains(told), "{reason}");
    }
}

/// A row of one colour in the old run lengths.
fn one_colour(width: u16) -> Vec<u8> {
    let [low, high] = (width - 1).to_le_bytes();
    [[128, 64, 32, 129], [1, 1, 1, low], [1, 1, 1, high]].concat()
}

#[test]
fn a_small_file_does_not_ask_for_much_memory() {
    // Rows of one colour: 12 bytes for 32768 pixels.
    let crowded = |height: usize| file(&format!("#?RADIANCE\n\n-Y {height} +X 32768\n"), &one_colour(32768).repeat(height));
    let limits = PictureLimits::default();
    let message = parse_rgb(Path::new("a.hdr"), &crowded(16384), &limits).unwrap_err().to_string();
    assert!(message.starts_with("max_megapixels = 256: must be at least 536.8"), "{message}");
    let message = parse_rgb(Path::new("a.hdr"), &crowded(4096), &limits).unwrap_err().to_string();
    assert!(
        message.contains("max_megapixels = 256: must be at least 1073.741824") && message.contains("of 49152 bytes"),
        "{message}"
    );
    let raw = parse_rgb(Path::new("a.hdr"), &crowded(16), &limits).unwrap();
    assert!(raw.pixels.as_chunks::<3>().0.iter().all(|pixel| *pixel == [1.0, 0.5, 0.25]));
    // What the limit allows can be raised.
    let few = PictureLimits { max_megapixels: 1.0 };
    assert!(parse_rgb(Path::new("a.hdr"), &crowded(16), &few).unwrap_err().to_string().contains("must be at least 15.72864"));
    assert!(parse_rgb(Path::new("a.hdr"), &crowded(16), &PictureLimits { max_megapixels: 15.728_64 }).is_ok());

    // Rows that are not there.
    let zeros = file("#?RADIANCE\n\n-Y 15000 +X 15000\n", &[0; 180_000]);
    let message = parse_rgb(Path::new("a.hdr"), &zeros, &PictureLimits { max_megapixels: 1073.0 }).unwrap_err().to_string();
    assert!(message.contains("must be at least 1073.741824"), "{message}");
    let all = PictureLimits { max_megapixels: ALL_MEGAPIXELS };
    let message = parse_rgb(Path::new("a.hdr"), &zeros, &all).unwrap_err().to_string();
    assert!(message.contains("ends early in line 4 of 15000"), "{message}");
}

#[test]
fn what_is_no_plain_file_is_not_waited_for() {
    let folder = tempfile::tempdir().unwrap();
    let message = read_rgb(folder.path(), &PictureLimits::default()).unwrap_err().to_string();
    assert!(message.contains("no plain file"), "{message}");
}

/// Sound pictures of every kind.
fn sound(kind: usize) -> Vec<u8> {
    let colours = || (0..96).flat_map(|k: u8| [k.wrapping_mul(41), 255 - k, k / 7, 120 + k % 16]);
    match kind {
        0 => file("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 12\n", &colours().collect::<Vec<u8>>()),
        1 => {
            let rows = super::super::encode_rows(12, &(0..12 * 3 * 8).map(|k| (k / 9) as f32).collect::<Vec<f32>>()).concat();
            file("#?RADIANCE\nEXPOSURE=2\nCOLORCORR=1 2 3\nskyprobe.rows=corner\nFORMAT=32-bit_rle_xyze\n\n-Y 8 +X 12\n", &rows)
        }
        2 => file("PRIMARIES=.64 .33 .3 .6 .15 .06 .3127 .329\n\n+X 4 -Y 300\n", &one_colour(300).repeat(4)),
        _ => file(
            "#?RGBE\r\n\tEXPOSURE=3\r\nskyprobe.config.1={\r\nskyprobe.config.2=}\r\n\r\n+Y 24 -X 4\r\n",
            &colours().collect::<Vec<u8>>(),
        ),
    }
}

#[test]
fn pictures_of_every_kind_are_sound() {
    for kind in 0..4 {
        parse_rgb(Path::new("a.hdr"), &sound(kind), &PictureLimits::default()).unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]
    #[test]
    fn whatever_is_damaged_is_a_picture_or_an_error(
        kind in 0_usize..4,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0_u8..4), 1..12),
        length in any::<Option<prop::sample::Index>>(),
    ) {
        let mut bytes = sound(kind);
        for (at, value, what) in changes {
            let at = at.index(bytes.len());
            match what {
                0 => bytes[at] = value,
                1 => bytes[at] ^= 1 << (value % 8),
                2 => bytes.insert(at, value),
                _ => {
                    let copied: Vec<u8> = bytes[at..].iter().take(usize::from(value)).copied().collect();
                    bytes.splice(at..at, copied);
                }
            }
        }
        if let Some(length) = length {
            bytes.truncate(length.index(bytes.len() + 1));
        }
        let limits = PictureLimits { max_megapixels: 1.0 };
        if let Ok(raw) = parse_rgb(Path::new("a.hdr"), &bytes, &limits) {
            prop_assert_eq!(raw.pixels.len(), 3 * raw.width * raw.height);
            prop_assert!(raw.pixels.len() <= 3_000_000);
        }
    }

    #[test]
    fn anything_is_a_picture_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..300), head in 0_usize..3) {
        let head = ["", "#?RADIANCE\n\n-Y 2 +X 20\n", "\n+X 5 +Y 5\n"][head];
        let _ = parse_rgb(Path::new("a.hdr"), &file(head, &bytes), &PictureLimits { max_megapixels: 1.0 });
    }
}
