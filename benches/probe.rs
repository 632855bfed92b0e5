//! What a probe costs once the light is there: pixels, with the dome of a clear sky, with a night and with a sky that costs nothing; getting a night and a day ready; what planes receive; files.
//! `cargo bench --bench probe`.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use glam::DVec3;
use skyprobe::atmosphere::AirParameters;
use skyprobe::ephemeris::{Place, SunModel};
use skyprobe::io::{FileOptions, Metadata, save};
use skyprobe::probe::{ProbeSettings, render};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, Disc, LightOptions, NightOptions, Sky, SkyDome, SkyLight};
use skyprobe::time::{Time, ZoneChoice};
use std::sync::Arc;

/// A sky that is the same all along a circle: what is left of the time is the probe's own.
struct Plain {
    discs: Vec<Disc>,
}

impl SkyLight for Plain {
    fn radiance_circle(&self, altitude: f64, _: &[f64], out: &mut [[f32; 3]]) {
        out.fill([3.0 + altitude as f32, 3.1, 3.4]);
    }

    fn horizon_altitude(&self) -> f64 {
        0.0
    }

    fn discs(&self) -> Vec<Disc> {
        self.discs.clone()
    }
}

fn dome() -> SkyDome {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    Sky::with_sun(30.0, 180.0, 0.0, air).unwrap().light(&Progress::silent()).unwrap()
}

fn pixels(criterion: &mut Criterion) {
    let dome = dome();
    let plain = Plain { discs: dome.discs() };
    let skies: [(&str, &dyn SkyLight); 2] = [("dome", &dome), ("plain sky", &plain)];
    let mut group = criterion.benchmark_group("pixels");
    group.sample_size(10);
    for (name, light) in skies {
        for width in [512, 2048, 4096] {
            let settings = ProbeSettings { width, ..Default::default() };
            group.bench_function(format!("{name}, {width} x {}", width / 2), |bencher| {
                bencher.iter(|| render(light, &settings, &Progress::silent()).unwrap());
            });
        }
    }
    group.finish();
}

/// A sky of clear air on the tropic at `time`, with everything that shines at night.
fn sky_at(air: &Arc<Atmosphere>, time: &str) -> Sky {
    let time = Time::parse(time, ZoneChoice::InText).unwrap();
    let night = NightOptions { bortle: Some(3), ..Default::default() };
    Sky::new(Place::new(20.0, -156.0, 0.0).unwrap(), time, SunModel::Iau, Arc::clone(air)).unwrap().with_night(night).unwrap()
}

/// The full Moon high; by day with the Moon up and below the horizon.
fn night(criterion: &mut Criterion) {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Standard, true).unwrap());
    air.solve(&Progress::silent()).unwrap();
    let ready = |sky: &Sky| sky.light_by(&LightOptions::default(), &Progress::silent()).unwrap();
    let mut group = criterion.benchmark_group("night");
    group.sample_size(10);
    for (name, time) in [
        ("ready, full Moon", "2018-01-02T00:30:00-10:00"),
        ("ready, eclipsed Moon", "2018-01-31T02:20:00-10:00"),
        ("ready, day with the Moon", "2018-01-09T11:00:00-10:00"),
        ("ready, day without", "2018-01-02T14:30:00-10:00"),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter_batched(|| sky_at(&air, time), |sky| ready(&sky), BatchSize::PerIteration);
        });
    }
    let light = ready(&sky_at(&air, "2018-01-02T00:30:00-10:00"));
    let settings = ProbeSettings { width: 2048, ..Default::default() };
    group.bench_function("pixels, full Moon, 2048 x 1024", |bencher| {
        bencher.iter(|| render(&light, &settings, &Progress::silent()).unwrap());
    });
    group.finish();
}

/// What planes receive: from a picture, one and a thousand of them, and from the sky itself, beside the picture that the sky would have to be made into.
fn received(criterion: &mut Criterion) {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Standard, true).unwrap());
    let sky = Sky::with_sun(30.0, 180.0, 0.0, air).unwrap();
    let silent = Progress::silent();
    let settings = ProbeSettings { width: 2048, ..Default::default() };
    let probe = render(&sky.light(&silent).unwrap(), &settings, &silent).unwrap();
    let turn = |k: u32| (2.4 * f64::from(k), (f64::from(k) + 0.5) / 500.0 - 1.0);
    let normals: Vec<DVec3> = (0..1000)
        .map(turn)
        .map(|(azimuth, up)| DVec3::new(azimuth.sin() * (1.0 - up * up).sqrt(), azimuth.cos() * (1.0 - up * up).sqrt(), up))
        .collect();
    let mut group = criterion.benchmark_group("received");
    group.sample_size(10);
    for count in [1, 1000] {
        group.bench_function(format!("by {count} planes, 2048 x 1024"), |bencher| {
            bencher.iter(|| probe.irradiances(&normals[..count]));
        });
    }
    group.bench_function("illuminance", |bencher| bencher.iter(|| sky.illuminance(&silent).unwrap()));
    let small = ProbeSettings { width: 256, ..Default::default() };
    group.bench_function("the same from a picture, 256 x 128", |bencher| {
        bencher.iter(|| render(&sky.light(&silent).unwrap(), &small, &silent).unwrap().irradiance(DVec3::Z));
    });
    group.finish();
}

fn files(criterion: &mut Criterion) {
    let folder = tempfile::tempdir().unwrap();
    let probe = render(&dome(), &ProbeSettings { width: 4096, ..Default::default() }, &Progress::silent()).unwrap();
    let mut group = criterion.benchmark_group("write 4096 x 2048");
    group.sample_size(10);
    for name in ["sky.exr", "sky.hdr", "sky.png"] {
        let path = folder.path().join(name);
        group.bench_function(name, |bencher| {
            bencher.iter(|| save(&path, &probe, &FileOptions::default(), &Metadata::default()).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, pixels, night, received, files);
criterion_main!(benches);
