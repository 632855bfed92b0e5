//! The path tracer in twilight and in the aureole: its error estimates are believable, and small enough to judge with.

use glam::DVec3;
use skyprobe::atmosphere::{AirParameters, OpticalProfile};
use skyprobe::light::{Estimate, Guiding, PathTracer};

fn view(zenith_deg: f64, azimuth_deg: f64) -> DVec3 {
    let (sine, cosine) = zenith_deg.to_radians().sin_cos();
    let (sine_azimuth, cosine_azimuth) = azimuth_deg.to_radians().sin_cos();
    DVec3::new(sine * cosine_azimuth, sine * sine_azimuth, cosine)
}

fn air(parameters: &AirParameters) -> OpticalProfile {
    parameters.optical_profile(&[550.0]).unwrap()
}

fn deviation(a: &Estimate, b: &Estimate) -> f64 {
    (a.mean - b.mean) / a.standard_error.hypot(b.standard_error)
}

#[test]
fn guided_and_plain_paths_agree_by_day_and_at_dusk() {
    let profile = air(&AirParameters::default());
    let tracer = |guiding| PathTracer::new(&profile, 0).unwrap().with_polarisation(true).with_guiding(guiding);
    let (guided, plain) = (tracer(Guiding::Always), tracer(Guiding::Never));
    for (sun_zenith, paths, most) in [(40.0, 40_000, 0.025), (88.0, 40_000, 0.04), (94.0, 150_000, 0.08)] {
        for (zenith, azimuth) in [(0.0, 0.0), (60.0, 30.0), (85.0, 160.0), (110.0, 60.0)] {
            let trace = |tracer: &PathTracer, paths, seed| {
                tracer.multiple_scattering_stokes(5.0, sun_zenith, view(zenith, azimuth), paths, seed).unwrap()
            };
            let (a, b) = (trace(&guided, 15_000, 1), trace(&plain, paths, 2));
            println!("Sun zenith {sun_zenith}, view {zenith} {azimuth}: {:?} {:?}", a[0], b[0]);
            assert!(b[0].standard_error < most * b[0].mean, "too noisy to judge: {:?}", b[0]);
            for i in 0..3 {
                assert!(deviation(&a[i], &b[i]).abs() < 4.0, "Stokes parameter {i}: {:?} {:?}", a[i], b[i]);
            }
        }
    }
}

#[test]
fn the_standard_error_tells_the_scatter_of_repeated_runs_in_deep_twilight() {
    let profile = air(&AirParameters::default());
    let tracer = PathTracer::new(&profile, 0).unwrap();
    let (mut squares, mut freedom) = (0.0, 0.0);
    for (sun_altitude, zenith, azimuth, most) in
        [(-8.0, 60.0, 0.0, 0.01), (-12.0, 0.0, 0.0, 0.01), (-12.0, 85.0, 180.0, 0.01), (-15.0, 60.0, 180.0, 0.01)]
    {
        let runs: Vec<Estimate> = (0..8)
            .map(|seed| tracer.multiple_scattering(0.0, 90.0 - sun_altitude, view(zenith, azimuth), 4000, seed).unwrap())
            .collect();
        let n = runs.len() as f64;
        let mean = runs.iter().map(|run| run.mean).sum::<f64>() / n;
        let error = runs.iter().map(|run| run.standard_error.powi(2)).sum::<f64>().sqrt() / n;
        println!("Sun {sun_altitude}, view {zenith} {azimuth}: {mean:.4e} +- {:.2} %", 100.0 * error / mean);
        assert!(error < most * mean, "{error} {mean}");
        assert!(runs.iter().all(|run| run.largest_share < 0.5), "{runs:?}");
        squares += runs.iter().map(|run| ((run.mean - mean) / run.standard_error).powi(2)).sum::<f64>();
        freedom += n - 1.0;
    }
    let scatter = squares / freedom;
    println!("chi squared per degree of freedom: {scatter:.2}");
    // Chi squared per degree of freedom is 1 within sqrt(2 / freedom).
    assert!((scatter - 1.0).abs() < 3.5 * (2.0 / freedom).sqrt(), "{scatter}");
}

#[test]
fn the_aureole_converges() {
    let profile = air(&AirParameters { aod550: Some(0.5), asymmetry: Some(0.9), ..AirParameters::default() });
    let (plain, guided) = (PathTracer::new(&profile, 0).unwrap(), PathTracer::new(&profile, 0).unwrap());
    let (plain, guided) = (plain.with_guiding(Guiding::Never), guided.with_guiding(Guiding::Always));
    for from_sun in [1.5, 5.0, 10.0, 20.0] {
        let trace = |tracer: &PathTracer, paths| tracer.radiance(0.0, 60.0, view(60.0 - from_sun, 0.0), paths, 5).unwrap();
        let (a, b) = (trace(&guided, 20_000), trace(&plain, 40_000));
        println!("{from_sun} degrees from the Sun: {a:?} {b:?}");
        assert!(deviation(&a, &b).abs() < 4.0, "{a:?} {b:?}");
        assert!(a.standard_error < 0.007 * a.mean, "{a:?}");
        assert!(b.standard_error < 0.02 * b.mean, "{b:?}");
    }
}
