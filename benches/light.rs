//! What the light costs: solve, gather, dome, probe. `cargo bench`; the air is the preset "clear".

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use skyprobe::atmosphere::AirParameters;
use skyprobe::light::{LightField, Observer};
use skyprobe::probe::{ProbeSettings, render};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, Sky};
use skyprobe::spectrum::wavelengths;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

const SUN_ALTITUDE_DEG: f64 = 30.0;

/// The multiple scattering of one air, at each quality that people wait for.
fn solve(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("solve");
    group.sample_size(10).warm_up_time(Duration::from_millis(1));
    for (name, quality) in [("draft", Quality::Draft), ("standard", Quality::Standard), ("high", Quality::High)] {
        let numbers = quality.numbers();
        let profile = AirParameters::default().optical_profile(&wavelengths(numbers.wavelengths)).unwrap();
        group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
            bencher.iter(|| LightField::solve(&profile, &numbers, true, &Progress::silent()).unwrap());
        });
    }
    group.finish();
}

/// What a change of time costs: circles of sight, all of them, and pixels.
fn see(criterion: &mut Criterion) {
    let quality = Quality::Standard;
    let numbers = quality.numbers();
    let profile = AirParameters::default().optical_profile(&wavelengths(numbers.wavelengths)).unwrap();
    let field = LightField::solve(&profile, &numbers, true, &Progress::silent()).unwrap();
    let observer = Observer { altitude_km: 0.0, sun_zenith: (90.0 - SUN_ALTITUDE_DEG).to_radians() };
    let azimuths: Vec<f64> =
        (0..numbers.dome_azimuths).map(|a| std::f64::consts::PI * a as f64 / (numbers.dome_azimuths - 1) as f64).collect();
    criterion.bench_function("gather one circle (standard)", |bencher| {
        bencher.iter(|| field.gather(black_box(&observer), 0.2, &azimuths));
    });

    let air = Arc::new(Atmosphere::new(&AirParameters::default(), quality, true).unwrap());
    air.solve(&Progress::silent()).unwrap();
    let sky = Sky::with_sun(SUN_ALTITUDE_DEG, 180.0, 0.0, air).unwrap();
    criterion.bench_function("gather a dome (standard)", |bencher| {
        bencher.iter(|| sky.light(&Progress::silent()).unwrap());
    });

    let light = sky.light(&Progress::silent()).unwrap();
    let mut group = criterion.benchmark_group("render pixels");
    group.sample_size(10);
    for width in [512, 2048] {
        let settings = ProbeSettings { width, ..Default::default() };
        group.bench_function(format!("{width} x {}", width / 2), |bencher| {
            bencher.iter(|| render(&light, &settings, &Progress::silent()).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, solve, see);
criterion_main!(benches);
