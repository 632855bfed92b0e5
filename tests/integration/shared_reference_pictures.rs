//! Pictures of other programs, where the shared reference folder stands beside the checkout: each is named after its trait.

use crate::common::shared_reference;
use skyprobe::io::read_picture;
use skyprobe::post::{Picture, View};
use skyprobe::probe::Rows;
use skyprobe::spectrum::ColorSpace;

fn read(name: &str) -> Picture {
    read_picture(shared_reference("cases").join(name), &Default::default()).unwrap()
}

/// Whether all pixels but one, a lamp of 5000, are `expected`.
fn is_all(picture: &Picture, expected: [f32; 3]) -> bool {
    let others: Vec<&[f32; 3]> = picture.pixels.as_chunks::<3>().0.iter().filter(|pixel| **pixel != expected).collect();
    others == [&[5000.0; 3]]
}

#[test]
#[ignore = "needs ../shared/reference"]
fn names_in_lower_case() {
    let picture = read("e1_lowercase_rgb.exr");
    assert!(is_all(&picture, [1.0, 0.5, 0.25]));
}

#[test]
#[ignore = "needs ../shared/reference"]
fn chromaticities_of_zeros() {
    let picture = read("e4_chromaticities_all_zero.exr");
    assert!(picture.color_space == ColorSpace::LinRec709 && is_all(&picture, [1.0, 0.5, 0.25]));
}

#[test]
#[ignore = "needs ../shared/reference"]
fn luminance_and_chroma() {
    let picture = read("e2_luminance_chroma_Rec709_YC.exr");
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

#[test]
#[ignore = "needs ../shared/reference"]
fn a_map_of_directions() {
    let picture = read("e7_envmap_latlong.exr");
    assert_eq!((picture.width, picture.height, picture.view), (1024, 512, View::LatLong { rows: Rows::Corner }));
}

#[test]
#[ignore = "needs ../shared/reference"]
fn hostile_pictures_are_refused() {
    for (name, told) in [("dwa_abort.exr", "impossible counters"), ("display_bomb.exr", "max_megapixels = 256")] {
        let error = read_picture(shared_reference("cases").join(name), &Default::default()).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
    }
}
