//! A large probe streams to its file: the process never holds the picture. Alone in its file, because it measures the whole process.
#![cfg(target_os = "linux")]

use skyprobe::io::{FileOptions, Metadata, exr, render_to_files};
use skyprobe::probe::ProbeSettings;
use skyprobe::progress::Progress;
use skyprobe::sky::{Disc, SkyLight};

struct Gradient;

impl SkyLight for Gradient {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        for (out, azimuth) in out.iter_mut().zip(azimuths) {
            *out = [3.0, 3.1 + altitude as f32, 3.4 + 0.1 * *azimuth as f32];
        }
    }

    fn horizon_altitude(&self) -> f64 {
        0.0
    }

    fn discs(&self) -> Vec<Disc> {
        Vec::new()
    }
}

/// Greatest memory that this process has held so far [bytes].
fn peak_memory() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap();
    1024 * line.split_whitespace().nth(1).unwrap().parse::<usize>().unwrap()
}

#[test]
fn a_picture_of_400_megabytes_needs_much_less_memory_to_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.exr");
    let settings = ProbeSettings { width: 8192, ..Default::default() };
    let raw = 12 * settings.width * settings.height();
    let before = peak_memory();
    render_to_files(&Gradient, &settings, &[&path], &FileOptions::default(), &Metadata::default(), &Progress::silent()).unwrap();
    let grown = peak_memory() - before;
    // A band takes at most 96 MB, for machines with many threads; two are at work, and their packed forms.
    assert!(grown < raw - raw / 8, "{} MB", grown >> 20);
    if std::thread::available_parallelism().is_ok_and(|threads| threads.get() <= 8) {
        assert!(grown < raw / 3, "{} MB", grown >> 20);
    }
    let found = exr::read(&path).unwrap();
    assert_eq!((found.width, found.height), (8192, 4096));
    // The reader shows that the measure works: it does hold the picture.
    assert!(peak_memory() - before > raw);
}
