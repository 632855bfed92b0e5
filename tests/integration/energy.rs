//! The energy of a probe: what a plane receives from its pixels is what the physics says it receives, at every resolution.

use glam::DVec3;
use skyprobe::atmosphere::AirParameters;
use skyprobe::ephemeris::{Place, SunModel, direction_from_horizontal};
use skyprobe::numerics::gauss;
use skyprobe::probe::{Probe, ProbeSettings, Rows, render};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, Sky, SkyLight};
use skyprobe::spectrum::{solar, xyz_weights};
use skyprobe::time::{Time, ZoneChoice};
use skyprobe::units::{LUMINOUS_EFFICACY, Scale, Y_INTEGRAL_NM};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::{Arc, LazyLock, Mutex};

/// Largest relative difference between the probe's integral and the direct one.
const TOLERANCE: f64 = 0.003;

const SUN_AZIMUTH_DEG: f64 = 217.0;

/// Azimuth that the upright plane faces: neither towards the Sun nor along a column of pixels.
const FACADE_AZIMUTH_DEG: f64 = 170.0;

/// One solve serves all tests.
static AIR: LazyLock<Arc<Atmosphere>> = LazyLock::new(|| {
    let air = Atmosphere::new(&AirParameters::default(), Quality::Standard, false).unwrap();
    air.solve(&Progress::silent()).unwrap();
    Arc::new(air)
});

fn sky(sun_altitude_deg: f64) -> Sky {
    Sky::with_sun(sun_altitude_deg, SUN_AZIMUTH_DEG, 0.0, AIR.clone()).unwrap()
}

fn probe(light: &dyn SkyLight, settings: ProbeSettings) -> Probe {
    render(light, &settings, &Progress::silent()).unwrap()
}

/// Illuminance [lx] of a plane by the pixels of a probe.
fn illuminance(probe: &Probe, normal: DVec3) -> f64 {
    let to_y = probe.settings.color_space.matrix_to_xyz()[1];
    let rgb = probe.irradiance(normal);
    probe.settings.scale.white_luminance() * (0..3).map(|k| to_y[k] * rgb[k]).sum::<f64>()
}

/// Illuminance [lx] of the horizontal plane as anybody would add it up who knows of row-centred pixels only that they sit in the middle of their rows.
fn plain_sum(probe: &Probe) -> f64 {
    let to_y = probe.settings.color_space.matrix_to_xyz()[1];
    let (width, height) = (probe.width, probe.height);
    let mut sum = 0.0;
    for row in 0..height / 2 {
        let theta = |j: f64| PI * j / height as f64;
        let solid_angle = (theta(row as f64).cos() - theta(row as f64 + 1.0).cos()) * TAU / width as f64;
        for column in 0..width {
            let y: f64 = probe.pixel(column, row).iter().zip(to_y).map(|(&value, weight)| f64::from(value) * weight).sum();
            sum += y * solid_angle * theta(row as f64 + 0.5).cos();
        }
    }
    probe.settings.scale.white_luminance() * sum
}

/// Illuminance [lx] of an upright plane by the sky and the ground, from spectral radiances and not by way of a picture: Gauss quadrature in the square root of
/// the height over and the depth under the horizon, where light changes fastest, and in azimuth.
fn diffuse_facade_illuminance(sky: &Sky, facade_azimuth_deg: f64) -> f64 {
    let nodes = &AIR.profile().wavelengths_nm;
    let weights = xyz_weights(nodes, |wavelength| solar::irradiance(wavelength, 1.0));
    // Per unit solar irradiance, which the weights carry.
    let sun = solar::band_means(nodes);
    let (heights, azimuths) = (gauss::legendre(40), gauss::legendre(48));
    let (mut directions, mut shares) = (Vec::new(), Vec::new());
    for side in [1.0, -1.0] {
        for &(t, height_weight) in &heights {
            let altitude = side * FRAC_PI_2 * t * t;
            for &(u, azimuth_weight) in &azimuths {
                let from_normal = FRAC_PI_2 * (2.0 * u - 1.0);
                let azimuth_deg = facade_azimuth_deg + from_normal.to_degrees();
                directions.push(direction_from_horizontal(altitude.to_degrees(), azimuth_deg));
                // d omega = cos(altitude) d altitude d azimuth; cosine of incidence = cos(altitude) cos(from_normal).
                let solid_angle = altitude.cos() * (FRAC_PI_2 * 2.0 * t * height_weight) * (2.0 * FRAC_PI_2 * azimuth_weight);
                shares.push(solid_angle * altitude.cos() * from_normal.cos());
            }
        }
    }
    let radiance = sky.spectral_radiance(&directions, nodes, &Progress::silent()).unwrap();
    let luminance = |row: &[f64]| (0..row.len()).map(|w| row[w] / sun[w] * weights[w][1]).sum::<f64>();
    LUMINOUS_EFFICACY * radiance.chunks_exact(nodes.len()).zip(&shares).map(|(row, share)| share * luminance(row)).sum::<f64>()
}

#[test]
fn gauss_nodes_are_those_of_the_unit_interval() {
    // The quadrature above takes nodes in 0..1 with weights that add up to 1.
    let rule = gauss::legendre(40);
    assert!(rule.iter().all(|(t, _)| (0.0..1.0).contains(t)));
    assert!((rule.iter().map(|(_, weight)| weight).sum::<f64>() - 1.0).abs() < 1e-12);
}

#[test]
fn planes_receive_from_the_pixels_what_the_physics_gives_them() {
    let facade = direction_from_horizontal(0.0, FACADE_AZIMUTH_DEG);
    let mut worst = 0.0_f64;
    for sun_altitude_deg in [60.0, 30.0, 10.0, 2.0] {
        let sky = sky(sun_altitude_deg);
        let light = sky.light(&Progress::silent()).unwrap();
        let direct = sky.illuminance(&Progress::silent()).unwrap();
        let diffuse_facade = diffuse_facade_illuminance(&sky, FACADE_AZIMUTH_DEG);
        let direct_facade = direct.direct_normal_lx * sky.sun().apparent_direction().dot(facade).max(0.0);
        println!(
            "Sun at {sun_altitude_deg}: horizontal {:.0} + {:.0} lx, facade {direct_facade:.0} + {diffuse_facade:.0} lx",
            direct.direct_horizontal_lx, direct.diffuse_horizontal_lx
        );
        for width in [64, 512, 4096] {
            for rows in [Rows::Centre, Rows::Corner] {
                let probe = probe(&light, ProbeSettings { width, rows, ..Default::default() });
                for (name, normal, expected) in
                    [("horizontal", DVec3::Z, direct.global_horizontal_lx), ("facade", facade, direct_facade + diffuse_facade)]
                {
                    let error = illuminance(&probe, normal) / expected - 1.0;
                    println!("  width {width:4}, rows {:6}, {name:10}: {:+.3} %", rows.name(), 100.0 * error);
                    worst = worst.max(error.abs());
                }
                if width == 4096 && rows == Rows::Centre {
                    let error = plain_sum(&probe) / direct.global_horizontal_lx - 1.0;
                    println!("  width {width:4}, plain sum, horizontal: {:+.3} %", 100.0 * error);
                    worst = worst.max(error.abs());
                }
            }
        }
    }
    println!("worst {:.3} %", 100.0 * worst);
    assert!(worst <= TOLERANCE);
}

#[test]
fn without_the_disc_only_the_sky_lights_the_plane() {
    let sky = sky(30.0);
    let light = sky.light(&Progress::silent()).unwrap();
    let expected = sky.illuminance(&Progress::silent()).unwrap().diffuse_horizontal_lx;
    for width in [64, 512] {
        let probe = probe(&light, ProbeSettings { width, sun_disc: false, ..Default::default() });
        let error = illuminance(&probe, DVec3::Z) / expected - 1.0;
        println!("width {width}: {:+.3} %", 100.0 * error);
        assert!(error.abs() <= TOLERANCE);
    }
}

#[test]
fn illuminance_is_the_spectral_irradiance_weighted_by_the_observer() {
    let sky = sky(30.0);
    let found = sky.illuminance(&Progress::silent()).unwrap();
    let wavelengths: Vec<f64> = (0..=340).map(|i| 385.0 + i as f64).collect();
    let irradiance = sky.irradiance(&wavelengths, &Progress::silent()).unwrap();
    // Each weight is the integral of a cardinal function times ybar; band means of 1 nm take the place of a spectrum.
    let weights = xyz_weights(&wavelengths, |_| 1.0);
    let luminous =
        |values: &[f64]| LUMINOUS_EFFICACY * values.iter().zip(&weights).map(|(value, weight)| value * weight[1]).sum::<f64>();
    for (name, spectral, expected) in [
        ("direct", luminous(&irradiance.direct_normal), found.direct_normal_lx),
        ("diffuse", luminous(&irradiance.diffuse_horizontal), found.diffuse_horizontal_lx),
    ] {
        println!("{name}: {:+.3} %", 100.0 * (spectral / expected - 1.0));
        assert!((spectral / expected - 1.0).abs() < 0.005, "{name}: {spectral} lx, {expected} lx");
    }
}

#[test]
fn scales_differ_by_their_units() {
    let light = sky(30.0).light(&Progress::silent()).unwrap();
    let with = |scale| probe(&light, ProbeSettings { width: 64, scale, ..Default::default() });
    let blender = with(Scale::Blender);
    for (scale, ratio) in [(Scale::Mitsuba, 1.0 / Y_INTEGRAL_NM), (Scale::Luminance, LUMINOUS_EFFICACY)] {
        let other = with(scale);
        for (value, unit) in other.pixels.iter().zip(&blender.pixels) {
            let expected = ratio * f64::from(*unit);
            assert!((f64::from(*value) - expected).abs() <= 1e-6 * expected.abs(), "{scale}: {value}, {expected}");
        }
        let error = illuminance(&other, DVec3::Z) / illuminance(&blender, DVec3::Z) - 1.0;
        assert!(error.abs() < 1e-6, "{scale}: {error}");
    }
}

#[test]
fn another_time_needs_no_second_solve() {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap());
    assert!(!air.is_solved());
    let place = Place::new(55.71, 13.19, 20.0).unwrap();
    let stages_at = |time: &str| {
        let stages = Mutex::new(Vec::new());
        let note = |stage: &str, _: f64| {
            stages.lock().unwrap().push(stage.to_string());
            true
        };
        let time = Time::parse(time, ZoneChoice::InText).unwrap();
        let sky = Sky::new(place, time, SunModel::Iau, air.clone()).unwrap();
        sky.light(&Progress::new(&note)).unwrap();
        assert!(air.is_solved());
        let mut stages = stages.into_inner().unwrap();
        stages.dedup();
        stages
    };
    assert_eq!(stages_at("2005-06-21T13:00:00+02:00"), ["solve", "gather"]);
    assert_eq!(stages_at("2005-06-21T21:00:00+02:00"), ["gather"]);
}
