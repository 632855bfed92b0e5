//! What tone mapping costs: 4096 x 2048 pixels of a probe with a low Sun to 8-bit codes by every operator, at night by the sky operator, and to 16 bits.
//! `cargo bench --bench tone`.

use criterion::{Criterion, criterion_group, criterion_main};
use skyprobe::atmosphere::AirParameters;
use skyprobe::post::tone::{OperatorName, ToneMapper, ToneMapping};
use skyprobe::probe::{Probe, ProbeSettings, render};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, Sky};
use std::sync::Arc;

fn probe() -> Probe {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    let light = Sky::with_sun(8.0, 200.0, 0.0, air).unwrap().light(&Progress::silent()).unwrap();
    render(&light, &ProbeSettings { width: 4096, ..Default::default() }, &Progress::silent()).unwrap()
}

fn operators(criterion: &mut Criterion) {
    let day = probe();
    let mut night = day.clone();
    night.pixels.iter_mut().for_each(|value| *value *= 1e-7);
    let codes = |probe: &Probe, name: OperatorName| {
        let mapper = ToneMapper::new(probe, &ToneMapping::with(name), &Progress::silent()).unwrap();
        mapper.to_8_bits(&Progress::silent()).unwrap()
    };
    let mut group = criterion.benchmark_group("tone map 4096 x 2048");
    group.sample_size(10);
    for name in OperatorName::ALL {
        group.bench_function(name.name(), |bencher| bencher.iter(|| codes(&day, name)));
    }
    group.bench_function("sky, night", |bencher| bencher.iter(|| codes(&night, OperatorName::Sky)));
    group.bench_function("sky, 16 bits", |bencher| {
        bencher.iter(|| {
            let mapper = ToneMapper::new(&day, &ToneMapping::default(), &Progress::silent()).unwrap();
            mapper.to_16_bits(&Progress::silent()).unwrap()
        });
    });
    group.finish();
}

criterion_group!(benches, operators);
criterion_main!(benches);
