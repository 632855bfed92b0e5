//! What glare costs: a picture of 3840 x 2160 with a filter of full size, probes, and the thesis's way, pixel by pixel. Prints the peak memory of the large picture.
//! `cargo bench --bench glare`.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use skyprobe::post::glare::planar::PlanarKernel;
use skyprobe::post::glare::scatter::Scatter;
use skyprobe::post::glare::{AdaptationState, GlareOptions, Glaring, glare};
use skyprobe::post::{Picture, View};
use skyprobe::probe::Rows;
use skyprobe::progress::Progress;
use skyprobe::spectrum::ColorSpace;

const CAMERA: View = View::Perspective { horizontal_field_of_view_deg: 40.0 };
const PROBE: View = View::LatLong { rows: Rows::Centre };

/// A dim picture with a bright disc of 5 pixels.
fn picture(width: usize, height: usize, view: View) -> Picture {
    let mut pixels: Vec<f32> = (0..3 * width * height).map(|k| 1.0 + (k * 7919 % 1000) as f32 * 1e-3).collect();
    for (x, y) in [(0, 0), (1, 0), (2, 0), (1, 1), (1, 2)] {
        let k = 3 * ((height / 3 + y) * width + width / 3 + x);
        pixels[k..k + 3].fill(1e6);
    }
    Picture::new(width, height, pixels, ColorSpace::LinRec709, 683.0, view).unwrap()
}

fn options(state: AdaptationState, glaring: Glaring) -> GlareOptions {
    GlareOptions { state: Some(state), glaring, ..Default::default() }
}

/// The thesis: the filter is put over each glaring pixel. Only scattered light, for the time it takes.
fn pixel_by_pixel(source: &Picture, threshold: f32, reach: isize) -> Vec<f32> {
    let scatter = Scatter::new(AdaptationState::Photopic, source.color_space, 0, 1.0);
    let grid = source.grid();
    let kernel = PlanarKernel::new(grid.azimuthal().unwrap(), &scatter);
    let side = 2 * reach + 1;
    let filter: Vec<[f32; 3]> = (0..side * side).map(|k| kernel.at(k % side - reach, reach - k / side)).collect();
    let (width, height) = (source.width as isize, source.height as isize);
    let mut out = source.pixels.clone();
    for (k, pixel) in source.pixels.as_chunks::<3>().0.iter().enumerate().filter(|(_, pixel)| pixel[1] > threshold) {
        let (x, y) = (k as isize % width, k as isize / width);
        for j in (y - reach).max(0)..(y + reach + 1).min(height) {
            for i in (x - reach).max(0)..(x + reach + 1).min(width) {
                let share = filter[((j - y + reach) * side + i - x + reach) as usize];
                let at = 3 * (j * width + i) as usize;
                (0..3).for_each(|c| out[at + c] += share[c] * pixel[c]);
            }
        }
    }
    out
}

/// Greatest memory that this process has held so far [MB]; 0 where the system does not tell.
fn peak_memory_mb() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap_or("");
    line.split_whitespace().nth(1).and_then(|kilobytes| kilobytes.parse::<usize>().ok()).unwrap_or(0) / 1024
}

fn flat(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("glare");
    group.sample_size(10);
    let large = picture(3840, 2160, CAMERA);
    for state in [AdaptationState::Photopic, AdaptationState::Scotopic] {
        let options = options(state, Glaring::AllLight);
        group.bench_function(format!("3840 x 2160, full filter, {}", state.name()), |bencher| {
            let run = |mut picture: Picture| glare(&mut picture, &options, &Progress::silent()).unwrap();
            bencher.iter_batched(|| large.clone(), run, BatchSize::PerIteration);
        });
        println!("peak memory with two pictures of 100 MB: {} MB", peak_memory_mb());
    }
    drop(large);
    let small = picture(480, 270, CAMERA);
    group.bench_function("480 x 270, full filter, FFT", |bencher| {
        let options = options(AdaptationState::Photopic, Glaring::AllLight);
        let run = |mut picture: Picture| glare(&mut picture, &options, &Progress::silent()).unwrap();
        bencher.iter_batched(|| small.clone(), run, BatchSize::PerIteration);
    });
    group.bench_function("480 x 270, 5 pixels over the threshold, full filter, pixel by pixel", |bencher| {
        bencher.iter(|| pixel_by_pixel(&small, 100.0, 479));
    });
    group.bench_function("480 x 270, all light, filter of 65 x 65, pixel by pixel", |bencher| {
        bencher.iter(|| pixel_by_pixel(&small, 0.0, 32));
    });
    group.finish();
}

fn probes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("glare on a probe");
    group.sample_size(10);
    for (width, glaring, name) in
        [(2048, Glaring::Automatic, "Sun"), (4096, Glaring::Automatic, "Sun"), (2048, Glaring::AllLight, "all light")]
    {
        let source = picture(width, width / 2, PROBE);
        let options = options(AdaptationState::Photopic, glaring);
        group.bench_function(format!("{width} x {}, {name}", width / 2), |bencher| {
            let run = |mut picture: Picture| glare(&mut picture, &options, &Progress::silent()).unwrap();
            bencher.iter_batched(|| source.clone(), run, BatchSize::PerIteration);
        });
    }
    group.finish();
}

criterion_group!(benches, flat, probes);
criterion_main!(benches);
