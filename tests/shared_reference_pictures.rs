//! Pictures of other programs, where the shared reference folder stands beside the checkout: each is named after its trait.

use skyprobe::io::read_picture;
use skyprobe::post::{Picture, View};
use skyprobe::probe::Rows;
use skyprobe::spectrum::ColorSpace;
use std::io::Write;
use std::path::{Path, PathBuf};

fn folder() -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference/cases");
    if path.is_dir() {
        return Some(path);
    }
    // Not println: the test harness hides that of tests that pass.
    let mut told = std::io::stderr();
    writeln!(told, "skipped: ../shared/reference/cases is not there").unwrap();
    None
}

fn read(name: &str) -> Option<Picture> {
    folder().map(|folder| read_picture(folder.join(name), &Default::default()).unwrap())
}

/// Whether all pixels but one, a lamp of 5000, are `expected`.
fn is_all(picture: &Picture, expected: [f32; 3]) -> bool {
    let others: Vec<&[f32; 3]> = picture.pixels.as_chunks::<3>().0.iter().filter(|pixel| **pixel != expected).collect();
    others == [&[5000.0; 3]]
}

#[test]
fn names_in_lower_case() {
    if let Some(picture) = read("e1_lowercase_rgb.exr") {
        assert!(is_all(&picture, [1.0, 0.5, 0.25]));
    }
}

#[test]
fn chromaticities_of_zeros() {
    if let Some(picture) = read("e4_chromaticities_all_zero.exr") {
        assert!(picture.color_space == ColorSpace::LinRec709 && is_all(&picture, [1.0, 0.5, 0.25]));
    }
}

#[test]
fn luminance_and_chroma() {
    if let Some(picture) = read("e2_luminance_chroma_Rec709_YC.exr") {
        assert_eq!((picture.width, picture.height), (610, 406));
        // Luminance is that of the file, whatever the chroma: 0.3438 and 0.3203 in its first pixels.
        for (pixel, expected) in picture.pixels.as_chunks::<3>().0.iter().zip([0.3438, 0.3203, 0.295, 0.2773]) {
            let luminance = 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
            assert!((luminance - expected).abs() < 1e-3, "{pixel:?}");
        }
        // Its first pixel has a sample of either chroma: -0.1836 and -0.672.
        let first = picture.pixels[..3].to_vec();
        assert!((first[0] / 0.3438 - 1.0 + 0.1836).abs() < 1e-3 && (first[2] / 0.3438 - 1.0 + 0.672).abs() < 1e-3, "{first:?}");
    }
}

#[test]
fn a_map_of_directions() {
    if let Some(picture) = read("e7_envmap_latlong.exr") {
        assert_eq!((picture.width, picture.height, picture.view), (1024, 512, View::LatLong { rows: Rows::Corner }));
    }
}

#[test]
fn hostile_pictures_are_refused() {
    if let Some(folder) = folder() {
        for (name, told) in [("dwa_abort.exr", "impossible counters"), ("display_bomb.exr", "max_megapixels = 256")] {
            let error = read_picture(folder.join(name), &Default::default()).unwrap_err().to_string();
            assert!(error.contains(told), "{error}");
        }
    }
}
