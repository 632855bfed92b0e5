//! Tests of all operators together, and of the sky operator on rendered skies.

use super::*;
use crate::atmosphere::AirParameters;
use crate::post::Picture;
use crate::probe::{Probe, ProbeSettings, Rows, render};
use crate::quality::Quality;
use crate::sky::{Atmosphere, Sky as SkyOfPlace};
use crate::spectrum::ColorSpace;
use crate::units::Scale;
use std::sync::Arc;

const CAMERA: View = View::Perspective { horizontal_field_of_view_deg: 50.0 };

fn picture(width: usize, height: usize, pixels: Vec<f32>) -> Picture {
    Picture::new(width, height, pixels, ColorSpace::LinRec709, 683.0, CAMERA).unwrap()
}

/// A picture whose row `k` has the grey `greys[k]`.
fn rows_of(greys: &[f32]) -> Picture {
    picture(8, greys.len(), greys.iter().flat_map(|&grey| [grey; 24]).collect())
}

fn shown(picture: &Picture, settings: &ToneMapping) -> Vec<f32> {
    ToneMapper::new(picture, settings, &Progress::silent()).unwrap().to_linear(&Progress::silent()).unwrap()
}

fn all() -> impl Iterator<Item = ToneMapping> {
    let spaces = OperatorName::ALL.into_iter().flat_map(|name| Display::ALL.map(|display| (name, display)));
    spaces.map(|(name, display)| ToneMapping { display, ..ToneMapping::with(name) })
}

#[test]
fn brighter_pictures_of_one_light_are_shown_brighter() {
    for settings in all() {
        let mut last = -1.0;
        for decades in -30..=60 {
            let light = 10f32.powf(0.1 * decades as f32);
            let exposed = ToneMapping { exposure: Exposure::Value { ev100: 9.0 }, adaptation: Some(600.0), ..settings };
            // An even picture, with a black and a white pixel to set the limits that Ashikhmin's operator needs.
            let mut even = rows_of(&[light; 200]);
            even.pixels[..3].fill(0.0);
            even.pixels[3..6].fill(1e7);
            let found = shown(&even, &exposed)[3 * (150 * 8 + 4)];
            assert!(found >= last - 1e-6, "{settings:?} at {light}: {found} after {last}");
            last = found;
        }
        assert!(last > 0.3, "{settings:?}: {last}");
    }
}

#[test]
fn ramps_stay_ramps() {
    // Seven decades over 1400 rows: gentle, so that local operators may not turn it over either.
    let ramp: Vec<f32> = (0..1400).map(|k| 10f32.powf(-3.0 + k as f32 / 200.0)).collect();
    let picture = rows_of(&ramp);
    for name in OperatorName::ALL {
        let found = shown(&picture, &ToneMapping::with(name));
        for (k, pair) in found.chunks(24).map(|row| row[12]).collect::<Vec<_>>().windows(2).enumerate() {
            // Where a local operator's surroundings change their size, the paper's own method steps back by up to 2 %.
            let slack = if name == OperatorName::ReinhardLocal { 0.02 } else { 1e-6 };
            assert!(pair[1] >= pair[0] * (1.0 - slack) - 1e-6, "{name:?} at row {k}: {pair:?}");
        }
    }
}

#[test]
fn whatever_comes_in_light_of_a_screen_comes_out() {
    let nonsense =
        [0.0, -0.0, 1e-40, f32::MIN_POSITIVE, 1e9, f32::MAX, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -5.0, 1e-6, 0.2];
    let count = nonsense.len();
    let mut pixels = Vec::new();
    for a in nonsense {
        for b in nonsense {
            pixels.extend([a, b, nonsense[(pixels.len() / 3) % count]]);
        }
    }
    let rough = picture(count, count, pixels);
    let mut mended = rough.clone();
    assert!(!mended.repair().is_empty());
    for view in [CAMERA, View::LatLong { rows: Rows::Corner }, View::Fisheye { field_of_view_deg: 180.0 }] {
        for settings in all() {
            let found = shown(&Picture { view, ..rough.clone() }, &settings);
            assert!(found.iter().all(|value| (0.0..=1.0).contains(value)), "{settings:?}");
            // Repaired first it is the same picture.
            let repaired = shown(&Picture { view, ..mended.clone() }, &settings);
            let difference = found.iter().zip(&repaired).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(difference < 1e-5, "{settings:?} {difference}");
        }
    }
}

#[test]
fn black_stays_black() {
    for settings in all() {
        assert!(shown(&rows_of(&[0.0; 8]), &settings).iter().all(|&value| value == 0.0), "{settings:?}");
        let mut half: Vec<f32> = vec![0.0; 40];
        half.extend([5.0; 80]);
        let found = shown(&rows_of(&half), &settings);
        assert!(
            found[3 * 8 * 2] == 0.0 && found[3 * 8 * 100] > 0.05,
            "{settings:?}: {} {}",
            found[3 * 8 * 2],
            found[3 * 8 * 100]
        );
    }
}

#[test]
fn curves_have_their_published_values() {
    let by = |name: OperatorName, set: &[(&str, f64)], exposed: f64| {
        let mut operator = Operator::from(name);
        set.iter().for_each(|&(name, value)| operator.set(name, value).unwrap());
        // Exposed so that a pixel of 1 is 1.
        let exposure = Exposure::Value { ev100: (683f64 / exposure::SATURATION_AT_EV_0).log2() };
        let settings = ToneMapping { operator, exposure, ..ToneMapping::default() };
        f64::from(shown(&rows_of(&[exposed as f32; 64]), &settings)[3 * (30 * 8 + 4)])
    };
    // checked against: the formulas of each file's documentation, computed by hand
    for (name, set, exposed, expected) in [
        (OperatorName::Linear, &[("white", 2.0)][..], 0.5, 0.25),
        (OperatorName::Linear, &[("white", 2.0)], 2.5, 1.0),
        (OperatorName::Exposure, &[], 1.0, 0.632_120_6),
        (OperatorName::Exposure, &[], 0.01, 0.009_950_2),
        // ln(1 + 1 / 0.18) / ln(1 + 20 / 0.18) = 1.880317 / 4.719500
        (OperatorName::Logarithmic, &[], 1.0, 0.398_414),
        (OperatorName::Logarithmic, &[], 20.0, 1.0),
        // 1 (1 + 1 / 16) / 2; the white itself 4 (1 + 4 / 16) / 5
        (OperatorName::Reinhard, &[("white", 4.0)], 1.0, 0.531_25),
        (OperatorName::Reinhard, &[("white", 4.0)], 4.0, 1.0),
        (OperatorName::Reinhard, &[("white", 4.0)], 9.0, 1.0),
        // By default the brightest is white.
        (OperatorName::Reinhard, &[], 7.0, 1.0),
        // In even surroundings L / (1 + L).
        (OperatorName::ReinhardLocal, &[], 3.0, 0.75),
        (OperatorName::Aces, &[], 1.0, 0.619_1),
        (OperatorName::Filmic, &[], 0.18, 0.18),
    ] {
        let found = by(name, set, exposed);
        assert!((found - expected).abs() < 2e-4, "{name:?} {set:?} {exposed}: {found}, not {expected}");
    }
}

#[test]
fn luminance_operators_keep_the_ratios_of_the_channels() {
    let colour = [0.3, 0.5, 0.9];
    let pixels: Vec<f32> = (0..40).flat_map(|k| colour.map(|value| value * 10f32.powf(-3.0 + 0.1 * k as f32))).collect();
    for name in [OperatorName::Reinhard, OperatorName::ReinhardLocal, OperatorName::Ashikhmin] {
        for pixel in shown(&picture(40, 1, pixels.clone()), &ToneMapping::with(name)).as_chunks::<3>().0 {
            if pixel[2] < 0.999 && pixel[2] > 1e-3 {
                assert!(
                    (pixel[0] / pixel[2] - 1.0 / 3.0).abs() < 1e-3 && (pixel[1] / pixel[2] - 5.0 / 9.0).abs() < 1e-3,
                    "{name:?} {pixel:?}"
                );
            }
        }
    }
}

#[test]
fn dodging_keeps_what_is_light_among_dark() {
    // A dark field with a bright one beside it: near their border the local operator does not darken the dark.
    let pixels: Vec<f32> = (0..64 * 64).flat_map(|k| [if k % 64 < 32 { 0.5 } else { 50.0 }; 3]).collect();
    let two = picture(64, 64, pixels);
    let local = shown(&two, &ToneMapping::with(OperatorName::ReinhardLocal));
    let at = |x: usize| local[3 * (32 * 64 + x)];
    assert!((at(30) / at(4) - 1.0).abs() < 0.1, "{} {}", at(30), at(4));
    assert!(at(60) > 0.6 && at(4) < 0.05, "{} {}", at(60), at(4));
}

fn even_probe(value: f32, sun: f32, scale: Scale) -> Probe {
    let settings = ProbeSettings { width: 64, scale, ..Default::default() };
    let mut pixels = vec![value; 3 * 64 * 32];
    pixels[3 * (10 * 64 + 20)..][..3].fill(sun);
    Probe::new(pixels, settings).unwrap()
}

#[test]
fn meters_follow_the_sky_and_not_the_sun_the_ground_or_the_unit() {
    let meter = |probe: &Probe| Metering::of(&Frame::from(probe));
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-5;
    let even = meter(&even_probe(10.0, 10.0, Scale::Blender));
    assert!(close(even.log_average, 6830.0) && close(even.bright, 6830.0) && close(even.adaptation(), 6830.0), "{even:?}");
    let with_sun = meter(&even_probe(10.0, 2e6, Scale::Blender));
    assert!(close(with_sun.log_average, even.log_average) && close(with_sun.bright, even.bright), "{with_sun:?}");
    assert!(close(with_sun.highest, 2e6 * 683.0));
    let in_candelas = meter(&even_probe(6830.0, 6830.0, Scale::Luminance));
    assert!(close(in_candelas.adaptation(), even.adaptation()));
    let mut dark_ground = even_probe(10.0, 10.0, Scale::Blender);
    dark_ground.pixels[3 * 64 * 16..].fill(0.1);
    assert!(close(meter(&dark_ground).adaptation(), even.adaptation()));
    assert_eq!(meter(&even_probe(0.0, 0.0, Scale::Blender)).adaptation(), DARKNESS);
    // By solid angle: the bright half of the sky is that below 30 degrees, though it is a third of the rows.
    let mut halves = even_probe(1.0, 1.0, Scale::Luminance);
    halves.pixels[3 * 64 * 11..3 * 64 * 16].fill(100.0);
    let share = meter(&halves).log_average.log(100.0);
    // Rows 11 to 15 of 32: cos(61.875 degrees) = 0.4714 of the half sphere.
    assert!((share - 0.4714).abs() < 0.03, "{share}");
}

#[test]
fn automatic_exposure_puts_the_middle_at_middle_grey() {
    for name in OperatorName::ALL.into_iter().filter(|&name| name != OperatorName::Sky) {
        let probe = even_probe(10.0, 10.0, Scale::Blender);
        let mapper = ToneMapper::new(&probe, &ToneMapping::with(name), &Progress::silent()).unwrap();
        let grey = 6830.0 * exposure::factor_of_ev100(mapper.ev100());
        assert!((grey - 0.18).abs() < 1e-5, "{name:?} {grey}");
        let stops = ToneMapping { exposure: Exposure::Automatic { stops: 1.5 }, ..ToneMapping::with(name) };
        let brighter = ToneMapper::new(&probe, &stops, &Progress::silent()).unwrap();
        assert!((mapper.ev100() - brighter.ev100() - 1.5).abs() < 1e-9);
    }
}

#[test]
fn the_sky_operator_goes_from_noon_to_night_without_a_step() {
    // The same picture, scaled with what the eye is adapted to, over thirteen decades in hundredths.
    let colours = [[0.2, 0.4, 1.0], [1.0, 1.0, 1.0], [3.0, 1.5, 0.5], [300.0, 250.0, 200.0]];
    let mut last: Option<Vec<f32>> = None;
    let mut brightness = Vec::new();
    for step in 0..=1300 {
        let adaptation = 10f64.powf(-8.0 + 0.01 * f64::from(step));
        let pixels: Vec<f32> =
            colours.iter().flat_map(|colour| colour.map(|value| value * (adaptation / 683.0) as f32)).collect();
        let settings = ToneMapping { adaptation: Some(adaptation), ..ToneMapping::default() };
        let found = shown(&picture(4, 1, pixels), &settings);
        if let Some(last) = &last {
            for (a, b) in last.iter().zip(&found) {
                // A hundredth of a decade changes no channel by more than 2 %.
                assert!((a - b).abs() < 0.02 * a + 1e-4, "{adaptation}: {a} {b}");
            }
        }
        brightness.push(found[4]);
        last = Some(found);
    }
    assert!(brightness.windows(2).all(|pair| pair[1] >= pair[0] - 1e-6));
    assert!(brightness[0] < 0.01 && brightness[1300] > 0.5, "{} {}", brightness[0], brightness[1300]);
}

fn sky_probe(sun_altitude_deg: f64, width: usize) -> Probe {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    let light = SkyOfPlace::with_sun(sun_altitude_deg, 90.0, 0.0, air).unwrap().light(&Progress::silent()).unwrap();
    render(&light, &ProbeSettings { width, ..Default::default() }, &Progress::silent()).unwrap()
}

#[test]
fn the_aureole_has_gradation_up_to_the_sun_and_nothing_about_it_is_clipped() {
    for altitude in [60.0, 20.0, 5.0] {
        let probe = sky_probe(altitude, 2048);
        let mapper = ToneMapper::new(&probe, &ToneMapping::default(), &Progress::silent()).unwrap();
        let codes = mapper.to_16_bits(&Progress::silent()).unwrap();
        // East is the middle column; upwards from a degree's hundredth beyond the disc's edge and the pixel that it shares.
        let row_of = |degrees: f64| ((90.0 - degrees) / 180.0 * 1024.0) as usize;
        let column: Vec<u16> = (0..1024).map(|row| *codes[3 * (row * 2048 + 1024)..][..3].iter().max().unwrap()).collect();
        let (near, far) = (row_of(altitude + 0.6), row_of(altitude + 20.0));
        for row in far..near {
            assert!(column[row] < column[row + 1], "Sun {altitude}: row {row}, {} {}", column[row], column[row + 1]);
        }
        // In 8 bits, too, the last degrees before the Sun have a grade each, and the brightest of them is not white.
        let grade = |degrees: f64| f64::from(column[row_of(altitude + degrees)]) / 257.0;
        assert!(
            grade(0.6) < 254.0 && grade(0.6) - grade(3.0) > 2.0 && grade(3.0) - grade(10.0) > 3.0,
            "Sun {altitude}: {} {} {}",
            grade(0.6),
            grade(3.0),
            grade(10.0)
        );
        let white = codes.as_chunks::<3>().0.iter().filter(|pixel| pixel.iter().all(|&code| code >= 65_280)).count();
        // The disc is 0.53 degrees, 3 pixels wide; a latitude-longitude picture stretches it by 1 / cos(altitude).
        assert!(white <= 40, "Sun {altitude}: {white} white pixels");
        // No veil: nothing is added to the dark parts, so that the darkest code is in proportion to its light.
        let darkest = codes.iter().min().unwrap();
        assert!(*darkest < 20_000, "Sun {altitude}: {darkest}");
    }
}

#[test]
fn a_night_looks_like_a_night() {
    let shown_at = |luminance: f32| {
        let probe = even_probe(luminance, luminance, Scale::Luminance);
        let mapper = ToneMapper::new(&probe, &ToneMapping::default(), &Progress::silent()).unwrap();
        mapper.to_8_bits(&Progress::silent()).unwrap()[3 * 64 * 8..3 * 64 * 8 + 3].to_vec()
    };
    let (noon, dusk, moonlight, starlight) = (shown_at(4000.0), shown_at(4.0), shown_at(0.02), shown_at(3e-4));
    for pair in [&noon, &dusk, &moonlight, &starlight].windows(2) {
        assert!(pair[0][1] > pair[1][1] + 10, "{pair:?}");
    }
    assert!(starlight[1] < 60 && starlight[1] > 15, "{starlight:?}");
    // The rods' grey is bluish, a neutral noon is not.
    assert!(moonlight[2] > moonlight[0] + 8 && noon[2].abs_diff(noon[0]) <= 1, "{moonlight:?} {noon:?}");
}

#[test]
fn acuity_blurs_the_dark_and_leaves_the_stars() {
    // A camera of 20 degrees, 100 pixels a degree, at night: fine texture, and a star.
    let (width, height) = (400, 100);
    let mut pixels: Vec<f32> =
        (0..width * height).flat_map(|k| [if (k % width) / 4 % 2 == 0 { 1e-4f32 } else { 3e-4 }; 3]).collect();
    pixels[3 * (50 * width + 200)..][..3].fill(20.0);
    let fine =
        Picture::new(width, height, pixels, ColorSpace::LinRec709, 1.0, View::Perspective { horizontal_field_of_view_deg: 4.0 })
            .unwrap();
    let found = shown(&fine, &ToneMapping::default());
    let at = |x: usize, y: usize| found[3 * (y * width + x) + 1];
    assert!((at(102, 20) / at(106, 20) - 1.0).abs() < 0.05, "{} {}", at(102, 20), at(106, 20));
    assert!(at(200, 50) > 0.9);
    let mut sharp = Operator::default();
    sharp.set("acuity_loss", 0.0).unwrap();
    let found = shown(&fine, &ToneMapping { operator: sharp, ..ToneMapping::default() });
    let at = |x: usize, y: usize| found[3 * (y * width + x) + 1];
    assert!((at(102, 20) / at(106, 20) - 3.0).abs() < 0.1, "{} {}", at(102, 20), at(106, 20));
}

#[test]
fn long_work_can_be_cancelled() {
    let stop = |_: &str, _: f64| false;
    let progress = Progress::new(&stop);
    let probe = even_probe(1.0, 1.0, Scale::Blender);
    for name in [OperatorName::ReinhardLocal, OperatorName::Ashikhmin] {
        assert!(matches!(ToneMapper::new(&probe, &ToneMapping::with(name), &progress), Err(crate::Error::Cancelled)));
    }
    let mapper = ToneMapper::new(&probe, &ToneMapping::default(), &Progress::silent()).unwrap();
    assert!(matches!(mapper.to_8_bits(&progress), Err(crate::Error::Cancelled)));
}
