//! Probes of skies whose light is known in closed form.

use super::*;
use crate::progress::Progress;
use crate::projection::direction;
use crate::sky::{Disc, SkyLight, Surface};
use crate::spectrum::{ColorSpace, Gamut};
use crate::units::Scale;
use glam::DVec3;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

mod trial;

/// A sky whose radiance is a function of altitude and azimuth.
struct Analytic<F> {
    radiance: F,
    horizon: f64,
    discs: Vec<Disc>,
}

impl<F: Fn(f64, f64) -> f64 + Sync> SkyLight for Analytic<F> {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        for (out, &azimuth) in out.iter_mut().zip(azimuths) {
            *out = [(self.radiance)(altitude, azimuth) as f32; 3];
        }
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        self.discs.clone()
    }
}

fn sky<F: Fn(f64, f64) -> f64 + Sync>(radiance: F) -> Analytic<F> {
    Analytic { radiance, horizon: 0.0, discs: Vec::new() }
}

fn sun(theta: f64, azimuth: f64) -> Disc {
    Disc {
        is_sun: true,
        direction: direction(theta, azimuth),
        horizontal_radius: 0.00465,
        vertical_radius: 0.00465,
        irradiance: [1.1, 1.0, 0.9],
        surface: Surface::LimbDarkened([[0.45, 0.2], [0.5, 0.2], [0.6, 0.25]]),
    }
}

fn settings(width: usize, rows: Rows) -> ProbeSettings {
    ProbeSettings { width, rows, color_space: ColorSpace::Xyz, gamut: Gamut::Keep, ..Default::default() }
}

fn made(sky: &dyn SkyLight, settings: &ProbeSettings) -> Probe {
    render(sky, settings, &Progress::silent()).unwrap()
}

fn upward(sky: &dyn SkyLight, settings: &ProbeSettings) -> f64 {
    made(sky, settings).irradiance(DVec3::Z)[1]
}

#[test]
fn the_horizontal_plane_gets_the_light_of_the_sky_at_every_width() {
    // Integrals over the upper hemisphere in closed form; c is the cosine of the zenith angle.
    type Case = (fn(f64, f64) -> f64, f64, &'static str);
    let cases: [Case; 4] = [
        (|_, _| 1.0, PI, "uniform"),
        (|altitude, _| 1.0 + 2.0 * altitude.sin().powi(2), 2.0 * PI, "1 + 2 c^2"),
        (|altitude, azimuth| (1.0 + altitude.cos() * azimuth.sin()).max(0.0), PI, "1 + x"),
        (
            |altitude, _| 1.0 / (altitude.sin().abs() + 0.15),
            2.0 * PI * (1.0 - 0.15 * (1.15_f64 / 0.15).ln()),
            "brightens sevenfold to the horizon",
        ),
    ];
    for (radiance, expected, name) in cases {
        for width in [64, 66, 128, 512, 4096] {
            for rows in [Rows::Centre, Rows::Corner] {
                let found = upward(&sky(radiance), &settings(width, rows));
                assert!((found / expected - 1.0).abs() < 1e-5, "{name} {width} {rows:?}: {found} is not {expected}");
            }
        }
    }
}

#[test]
fn a_jump_at_the_horizon_stays_where_it_is() {
    for horizon_deg in [0.0_f64, -0.5, -1.8, -7.0] {
        let horizon = horizon_deg.to_radians();
        let light = Analytic {
            radiance: move |altitude: f64, _| if altitude >= horizon { 3.0 } else { 0.25 },
            horizon,
            discs: Vec::new(),
        };
        // A plane facing down sees sky between the horizontal plane and the horizon, and ground below.
        let band = PI * horizon.sin().powi(2);
        let down = 3.0 * band + 0.25 * (PI - band);
        for width in [64, 512, 4096] {
            let probe = made(&light, &settings(width, Rows::Centre));
            assert!((probe.irradiance(DVec3::Z)[1] / (3.0 * PI) - 1.0).abs() < 1e-3);
            let found = probe.irradiance(-DVec3::Z)[1];
            assert!((found / down - 1.0).abs() < 3e-2 * (64.0 / width as f64), "{horizon_deg} {width}: {found} is not {down}");
        }
        let dark = ProbeSettings { ground: GroundView::Off, ..settings(512, Rows::Centre) };
        let probe = made(&light, &dark);
        assert_eq!((probe.pixel(7, 127), probe.pixel(7, 128 + 12)), ([3.0; 3], [0.0; 3]));
        let total: f64 = LatLong::new(512, Rows::Centre, Extent::Full)
            .table()
            .iter()
            .enumerate()
            .map(|(row, found)| 512.0 * found.solid_angle * f64::from(probe.pixel(0, row)[1]))
            .sum();
        let expected = 3.0 * 2.0 * PI * (1.0 - horizon.sin());
        assert!((total / expected - 1.0).abs() < 1e-6, "{total} is not {expected}");
    }
}

#[test]
fn mirrored_ground_is_the_sky_flipped_and_the_upper_half_is_the_upper_half() {
    let light = sky(|altitude, azimuth| if altitude >= 0.0 { 2.0 + altitude + azimuth.cos() } else { 0.1 });
    for rows in [Rows::Centre, Rows::Corner] {
        for width in [64, 66, 2048] {
            let mirrored = made(&light, &ProbeSettings { ground: GroundView::Mirrored, ..settings(width, rows) });
            for row in 0..mirrored.height {
                assert_eq!(mirrored.pixel(5, row), mirrored.pixel(5, mirrored.height - 1 - row));
            }
            let (up, down) = (mirrored.irradiance(DVec3::Z)[1], mirrored.irradiance(-DVec3::Z)[1]);
            assert!((up / down - 1.0).abs() < 1e-6, "{up} {down}");
        }
    }
    let full = made(&light, &settings(2048, Rows::Centre));
    let upper = made(&light, &ProbeSettings { extent: Extent::Upper, ..settings(2048, Rows::Centre) });
    assert_eq!((upper.width, upper.height), (2048, 512));
    assert_eq!(upper.pixels[..], full.pixels[..upper.pixels.len()]);
}

/// Worst relative error over the channels of the vector sum of the drawn disc and of what the horizontal plane gets. Where rows on both sides of
/// that plane share the disc, its height in the vector sum is left out (see `disc`).
fn disc_error(theta: f64, azimuth: f64, settings: &ProbeSettings) -> f64 {
    let disc = sun(theta, azimuth);
    let grid = settings.grid();
    let (mut vector, mut upward) = ([DVec3::ZERO; 3], [0.0; 3]);
    for (column, row, energy) in super::disc::draw(&disc, -0.2, &*grid).pixels() {
        let footprint = grid.footprint(column, row);
        for channel in 0..3 {
            vector[channel] += energy[channel] * footprint.mean_direction;
            upward[channel] += energy[channel] * footprint.mean_upward;
        }
    }
    let pixel = grid.reach() / settings.height() as f64;
    let shared = if settings.projection == Projection::Fisheye {
        // Square pixels twice as wide, and the fit may reach a neighbour across the corner: one diagonal and a half.
        2.2 * 2.0 * pixel
    } else if settings.rows == Rows::Corner {
        1.5 * pixel
    } else if settings.height() % 2 == 1 {
        pixel
    } else {
        0.5 * pixel
    } + 0.02 * pixel
        + 0.005;
    (0..3)
        .map(|channel| {
            let expected = disc.irradiance[channel] * disc.direction;
            let missed = vector[channel] - expected;
            let missed = if (theta - FRAC_PI_2).abs() < shared { missed.truncate().length() } else { missed.length() };
            let plane = if theta < FRAC_PI_2 - 0.005 { (upward[channel] - expected.z).abs() } else { 0.0 };
            missed.max(plane) / disc.irradiance[channel]
        })
        .fold(0.0, f64::max)
}

#[test]
fn a_probe_holds_its_disc_once_or_not_at_all() {
    let disc = sun(0.9, 2.0);
    let light = Analytic { radiance: |_: f64, _: f64| 0.1, horizon: 0.0, discs: vec![disc.clone()] };
    for width in [64, 512] {
        for projection in [Projection::LatLong, Projection::Fisheye] {
            let with = ProbeSettings { projection, scale: Scale::Luminance, ..settings(width, Rows::Centre) };
            let without = ProbeSettings { sun_disc: false, ..with.clone() };
            let (with, without) = (made(&light, &with).irradiance(DVec3::Z)[1], made(&light, &without).irradiance(DVec3::Z)[1]);
            let expected = 683.0 * disc.direction.z;
            assert!(((with - without) / expected - 1.0).abs() < 1e-4, "{width} {projection:?}: {} {expected}", with - without);
        }
    }
}

#[test]
fn discs_light_rightly_at_awkward_places() {
    let places = [
        (0.0, 0.0),
        (0.001, 1.0),
        (0.004, 2.0),
        (0.006, 3.0),
        (0.05, 0.3),
        (0.0981747, 1.0),
        (0.4, -FRAC_PI_2),
        (0.4, -FRAC_PI_2 + 1e-4),
        (1.0, PI),
        (FRAC_PI_2 - 0.005, 1.2),
        (FRAC_PI_2 - 0.03, 0.0),
        (FRAC_PI_2 - 0.06, -2.0),
        (FRAC_PI_2 + 0.08, 0.5),
    ];
    for width in [64, 66, 512, 4096, 16384] {
        for rows in [Rows::Centre, Rows::Corner] {
            for (theta, azimuth) in places {
                let error = disc_error(theta, azimuth, &settings(width, rows));
                assert!(error < 1e-4, "{width} {rows:?} theta {theta} azimuth {azimuth}: {error:.1e}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]
    #[test]
    fn discs_light_rightly_everywhere(size in 0usize..4, corner: bool, azimuth in -PI..PI, cosine in -0.15f64..1.0) {
        let rows = if corner { Rows::Corner } else { Rows::Centre };
        let error = disc_error(cosine.acos(), azimuth, &settings([64, 512, 2048, 4096][size], rows));
        prop_assert!(error < 1e-4, "{error:.1e}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn fisheye_discs_light_rightly(size in 0usize..3, full: bool, azimuth in -PI..PI, theta in 0.0..1.45f64) {
        let extent = if full { Extent::Full } else { Extent::Upper };
        let settings = ProbeSettings { projection: Projection::Fisheye, extent, ..settings([64, 512, 2048][size], Rows::Centre) };
        let error = disc_error(theta, azimuth, &settings);
        prop_assert!(error < 1e-4, "{error:.1e}");
    }
}

#[test]
fn light_that_is_not_finite_is_an_error_in_every_gamut_projection_and_size() {
    for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let sky = sky(|altitude, azimuth| if altitude > 1.0 && azimuth > 2.0 { wrong } else { 1.0 });
        for gamut in [Gamut::Keep, Gamut::Desaturate, Gamut::Clip] {
            for projection in [Projection::LatLong, Projection::Fisheye] {
                for (width, extent) in [(64, Extent::Full), (1024, Extent::Upper)] {
                    let settings = ProbeSettings { width, gamut, projection, extent, ..ProbeSettings::default() };
                    let result = render(&sky, &settings, &Progress::silent());
                    let Err(crate::Error::Data { what }) = result else { panic!("{wrong} {gamut:?} {projection:?} {width}") };
                    assert!(what.ends_with("is not finite"), "{what}");
                }
            }
        }
    }
}

#[test]
fn a_cancelled_render_gives_nothing() {
    let stop = |_: &str, fraction: f64| fraction < 0.5;
    let result = render(&sky(|_, _| 1.0), &settings(64, Rows::Centre), &Progress::new(&stop));
    assert!(matches!(result, Err(crate::Error::Cancelled)));
}

#[test]
fn the_disc_is_round_sharp_and_darker_at_its_limb_when_pixels_are_small() {
    // 0.00465 rad are 12.1 pixels at 16384.
    let disc = sun(FRAC_PI_2 - 0.4, 0.3);
    let grid = settings(16384, Rows::Centre).grid();
    let centre = disc.direction;
    let radiance = |column: usize, row: usize, energy: f64| energy / grid.footprint(column, row).solid_angle;
    let (mut brightest, mut limb, mut outside) = (0.0_f64, f64::MAX, 0.0_f64);
    for (column, row, energy) in super::disc::draw(&disc, 0.0, &*grid).pixels() {
        let distance = grid.footprint(column, row).mean_direction.normalize().angle_between(centre) / 0.00465;
        let value = radiance(column, row, energy[1]);
        brightest = brightest.max(value);
        if (0.85..0.9).contains(&distance) {
            limb = limb.min(value);
        }
        if distance > 1.12 {
            outside = outside.max(value);
        }
    }
    // Relative brightness at 0.9 of the radius: m = 0.436; the mean over the disc is 0.8.
    let expected = 1.0 / (0.8 * PI * 0.00465_f64.powi(2));
    assert!((brightest / expected - 1.0).abs() < 0.01, "{brightest} {expected}");
    assert!((limb / brightest - 0.66).abs() < 0.06, "{}", limb / brightest);
    assert!(outside < 0.02 * brightest, "{}", outside / brightest);
}

/// A sky of patches with a Sun and stars, one of them behind the seam.
struct Patches;

impl SkyLight for Patches {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        for (out, &azimuth) in out.iter_mut().zip(azimuths) {
            let light = 2.0 + (3.0 * azimuth + 5.0 * altitude).sin() + (11.0 * azimuth).cos() * altitude.cos();
            *out = [0.9 * light as f32, light as f32, 1.2 * light as f32];
        }
    }

    fn horizon_altitude(&self) -> f64 {
        -0.01
    }

    fn discs(&self) -> Vec<Disc> {
        vec![sun(1.2, -FRAC_PI_2), sun(0.01, 0.3)]
    }

    fn points(&self) -> Vec<crate::sky::Point> {
        let at = |theta, azimuth| crate::sky::Point { direction: direction(theta, azimuth), irradiance: [1e-3, 2e-3, 3e-3] };
        vec![at(0.7, 1.0), at(1.3, -FRAC_PI_2 - 1e-3), at(1.5, -FRAC_PI_2 + 1e-3)]
    }
}

/// Largest difference of a value from that of another picture, in shares of it and of the mean.
fn difference(a: &[f32], b: &[f32]) -> f64 {
    let mean = a.iter().map(|&value| f64::from(value)).sum::<f64>() / a.len() as f64;
    a.iter().zip(b).map(|(a, b)| f64::from(a - b).abs() / (f64::from(*a) + mean)).fold(0.0, f64::max)
}

#[test]
fn a_picture_turned_by_whole_columns_is_the_picture_rolled() {
    for (width, columns) in [(64_usize, 1_i32), (64, 17), (66, 5), (512, 128), (512, -200), (2048, 1000)] {
        for rows in [Rows::Centre, Rows::Corner] {
            let plain = made(&Patches, &settings(width, rows));
            let turn_deg = 360.0 * f64::from(columns) / width as f64;
            let turned = made(&Patches, &ProbeSettings { turn_deg, ..settings(width, rows) });
            let mut rolled = plain.pixels.clone();
            for row in rolled.chunks_exact_mut(3 * width) {
                row.rotate_right(3 * columns.rem_euclid(width as i32) as usize);
            }
            let off = difference(&rolled, &turned.pixels);
            assert!(off < 1e-5, "{width} {columns} {rows:?}: {off}");
        }
    }
}

#[test]
fn the_light_of_the_world_does_not_turn_with_the_picture() {
    for projection in [Projection::LatLong, Projection::Fisheye] {
        let with = |turn_deg| ProbeSettings { projection, turn_deg, ..settings(256, Rows::Centre) };
        let plain = made(&Patches, &with(0.0));
        for turn_deg in [90.0, -33.3, 360.0, 0.7] {
            let turned = made(&Patches, &with(turn_deg));
            // Neither Sun stands at the edge of what these planes see, where a pixel more or less would count.
            for normal in [DVec3::Z, DVec3::new(0.3, -0.5, 0.4), DVec3::new(-0.6, -0.7, 0.2), DVec3::new(0.5, 0.5, -0.8)] {
                let (before, after) = (plain.irradiance(normal)[1], turned.irradiance(normal)[1]);
                assert!((after / before - 1.0).abs() < 2e-4, "{projection:?} {turn_deg} {normal}: {before} {after}");
            }
            // What stands at an azimuth is drawn where azimuth + turn would be.
            let there = direction(0.9, 0.4);
            let (a, b) = (
                turned.grid().coordinates(there).unwrap(),
                plain.grid().coordinates(direction(0.9, 0.4 + turn_deg.to_radians())).unwrap(),
            );
            assert!((a.0 - b.0).abs() < 1e-6 && (a.1 - b.1).abs() < 1e-6, "{projection:?} {turn_deg}: {a:?} {b:?}");
            assert!(turned.grid().direction(a.0, a.1).unwrap().distance(there) < 1e-9);
        }
    }
    let fail = ProbeSettings { turn_deg: 361.0, ..Default::default() }.validate().unwrap_err().to_string();
    assert!(fail.starts_with("turn_deg = 361: must be a number from -360 to 360 degrees"), "{fail}");
    for (azimuth, turn) in [(90.0, 0.0), (270.0, 180.0), (180.0, -90.0), (-10.0, 100.0), (359.0, 91.0)] {
        assert_eq!(ProbeSettings::turn_to_centre(azimuth).unwrap(), turn);
    }
}
