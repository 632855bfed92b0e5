//! What a place costs: searching names at every key stroke, the nearest place, the height of the land, a zone. `cargo bench --bench places`.
//! The first search of a process unpacks the gazetteer: see the example `time_to_first_place`.

use criterion::{Criterion, criterion_group, criterion_main};
use skyprobe::places::{Coordinates, elevation_m, nearest, search};
use skyprobe::time::zone_of_place;
use std::hint::black_box;

fn names(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("search");
    for text in ["l", "lu", "lund", "lund, sweden", "portland me", "st petersburg", "san", "qqqq", "東京"] {
        search(text, 10);
        group.bench_function(text, |bencher| bencher.iter(|| search(black_box(text), 10)));
    }
    group.finish();
}

fn coordinates(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("coordinates");
    group.bench_function("read", |bencher| bencher.iter(|| Coordinates::parse(black_box("55°42'36\"N 13°11'24\"E"))));
    group.bench_function("nearest", |bencher| bencher.iter(|| nearest(black_box(55.9), 13.19)));
    group.bench_function("nearest, at sea", |bencher| bencher.iter(|| nearest(black_box(-45.0), -130.0)));
    group.bench_function("height", |bencher| bencher.iter(|| elevation_m(black_box(55.9), 13.19)));
    group.bench_function("zone", |bencher| bencher.iter(|| zone_of_place(black_box(55.9), 13.19)));
    group.finish();
}

criterion_group!(benches, names, coordinates);
criterion_main!(benches);
