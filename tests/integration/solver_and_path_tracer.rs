//! The solver at quality `high` against the path tracer in the same air: two independent ways to the same light, by day and at dusk.
//!
//! They must agree within 3 standard errors of the path tracer in every direction, without any allowance for the solver. The standard errors are about 0.7 % of
//! the radiance by day and 1.25 % at dusk, so that a solver error of a few per cent anywhere fails, and one of 1 % in many directions does too.

use crate::common::airs::Airs;
use crate::common::{Row, SPHERICAL_RADIUS_KM};
use glam::DVec3;
use skyprobe::light::{Estimate, PathTracer};
use std::sync::LazyLock;

/// Molecules, aerosol and ozone over a ground that reflects 30 %.
const AIR: [(&str, f64); 4] = [("tau_rayleigh", 0.2), ("tau_aerosol", 0.15), ("tau_ozone", 0.03), ("ground_albedo", 0.3)];

/// View zenith angle and azimuth from the Sun [degrees] of 20 directions over the upper hemisphere, from the zenith to the horizon.
const FROM_THE_GROUND: [(f64, f64); 20] = [
    (0.0, 0.0),
    (20.0, 60.0),
    (20.0, 180.0),
    (35.0, 20.0),
    (35.0, 110.0),
    (45.0, 150.0),
    (55.0, 70.0),
    (60.0, 10.0),
    (60.0, 180.0),
    (67.0, 45.0),
    (67.0, 125.0),
    (73.0, 90.0),
    (77.0, 0.0),
    (77.0, 160.0),
    (81.0, 60.0),
    (84.0, 120.0),
    (86.0, 30.0),
    (87.0, 180.0),
    (88.0, 90.0),
    (89.0, 0.0),
];

/// The same from 10 km, above and below the horizon at 93.2 degrees.
const FROM_10_KM: [(f64, f64); 6] = [(45.0, 60.0), (85.0, 150.0), (92.0, 30.0), (94.5, 120.0), (110.0, 0.0), (160.0, 90.0)];

/// One solve serves both tests.
static SOLVED: LazyLock<Airs> = LazyLock::new(|| Airs::solve(&[row(0.0, 0.0, 0.0)], SPHERICAL_RADIUS_KM));

fn row(sun_zenith_deg: f64, view_zenith_deg: f64, relative_azimuth_deg: f64) -> Row {
    let geometry = [
        ("sun_zenith_deg", sun_zenith_deg),
        ("view_zenith_deg", view_zenith_deg),
        ("relative_azimuth_deg", relative_azimuth_deg),
    ];
    AIR.into_iter().chain(geometry).map(|(name, value)| (name.to_string(), value)).collect()
}

/// Paths that find out how many are needed.
const PILOT_PATHS: usize = 4_096;

const MOST_PATHS: usize = 200_000;

/// Seed of the first direction's pilot; those of the estimates count from 0. Apart, so that no estimate depends on its own luck.
const PILOT_SEED: u64 = 1_000;

/// The path tracer's radiance with a standard error of about `noise` times the radiance.
fn trace(tracer: &PathTracer, altitude_km: f64, sun_zenith_deg: f64, view: DVec3, noise: f64, seed: u64) -> Estimate {
    let with = |paths, seed| tracer.radiance(altitude_km, sun_zenith_deg, view, paths, seed).unwrap();
    let pilot = with(PILOT_PATHS, PILOT_SEED + seed);
    let needed = PILOT_PATHS as f64 * (pilot.standard_error / pilot.mean / noise).powi(2);
    with((needed as usize).clamp(PILOT_PATHS, MOST_PATHS), seed)
}

/// Compares them in every direction, with a standard error of about `noise` times the radiance.
fn compare(sun_zenith_deg: f64, noise: f64) {
    let tracer = PathTracer::new(&SOLVED.profile, 0).unwrap();
    let start = std::time::Instant::now();
    let cases = FROM_THE_GROUND.map(|view| (0.0, view)).into_iter().chain(FROM_10_KM.map(|view| (10.0, view)));
    let (mut deviations, mut relative, mut noises) = (Vec::new(), Vec::new(), Vec::new());
    println!(
        "altitude km, view zenith, azimuth, solver, path tracer, standard error %, solver - tracer in % and in standard errors"
    );
    for (seed, (altitude_km, (zenith, azimuth))) in cases.enumerate() {
        let solved = SOLVED.radiance(&row(sun_zenith_deg, zenith, azimuth), altitude_km);
        let (sine, cosine) = zenith.to_radians().sin_cos();
        let view = DVec3::new(sine * azimuth.to_radians().cos(), sine * azimuth.to_radians().sin(), cosine);
        let traced = trace(&tracer, altitude_km, sun_zenith_deg, view, noise, seed as u64);
        let (error, noise) = (solved / traced.mean - 1.0, traced.standard_error / traced.mean);
        println!(
            "{altitude_km:4} {zenith:6} {azimuth:6} {solved:.5e} {:.5e} {:5.2} {:+6.2} {:+6.2}",
            traced.mean,
            100.0 * noise,
            100.0 * error,
            error / noise
        );
        deviations.push(error / noise);
        relative.push(error);
        noises.push(noise);
    }
    let rms = |values: &[f64]| (values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64).sqrt();
    let mean = relative.iter().sum::<f64>() / relative.len() as f64;
    let worst = |values: &[f64]| values.iter().fold(0.0_f64, |worst, value| worst.max(value.abs()));
    println!(
        "Sun zenith {sun_zenith_deg}: {} directions in {:.1} s: mean {:+.2} %, rms {:.2} %, worst {:.2} %; rms {:.2}, worst {:.2} standard errors",
        deviations.len(),
        start.elapsed().as_secs_f64(),
        100.0 * mean,
        100.0 * rms(&relative),
        100.0 * worst(&relative),
        rms(&deviations),
        worst(&deviations)
    );
    assert!(worst(&noises) <= 1.5 * noise, "too noisy to judge");
    assert!(worst(&deviations) <= 3.0);
    // Were all deviations noise, this rms would be 1 within 0.14 (one standard deviation).
    assert!(rms(&deviations) <= 1.5, "the solver is off in many directions");
}

#[test]
fn agree_by_day() {
    compare(50.0, 0.007);
}

#[test]
fn agree_with_the_sun_4_degrees_below_the_horizon() {
    compare(94.0, 0.0125);
}
