use super::super::{Half, exr, save};
use super::*;
use crate::error::Error;
use crate::probe::{GroundView, Projection, Rows, render};
use crate::sky::{Disc, Surface};
use glam::DVec3;

/// A sky with a gradient, a ground and a Sun.
struct Painted;

impl SkyLight for Painted {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        for (out, azimuth) in out.iter_mut().zip(azimuths) {
            let value = if altitude < 0.0 { 0.3 } else { 2.0 + altitude.sin() + azimuth.cos() } as f32;
            *out = [0.9 * value, value, 1.3 * value];
        }
    }

    fn horizon_altitude(&self) -> f64 {
        0.0
    }

    fn discs(&self) -> Vec<Disc> {
        vec![Disc {
            is_sun: true,
            direction: DVec3::new(0.6, 0.0, 0.8),
            horizontal_radius: 0.0047,
            vertical_radius: 0.0046,
            irradiance: [150.0, 160.0, 120.0],
            surface: Surface::LimbDarkened([[0.5, 0.2]; 3]),
        }]
    }
}

fn both_ways(settings: &ProbeSettings, options: &FileOptions, name: &str) -> [Vec<u8>; 2] {
    let folder = tempfile::tempdir().unwrap();
    let (streamed, saved) = (folder.path().join(name), folder.path().join(format!("saved-{name}")));
    let metadata = Metadata { latitude_deg: Some(55.7), comments: Some("both ways".to_owned()), ..Default::default() };
    render_to_files(&Painted, settings, &[&streamed], options, &metadata, &Progress::silent()).unwrap();
    let probe = render(&Painted, settings, &Progress::silent()).unwrap();
    save(&saved, &probe, options, &metadata).unwrap();
    if name.ends_with("exr") && options.half == Half::Off {
        assert!(exr::read(&streamed).unwrap().pixels == probe.pixels);
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    [streamed, saved].map(|path| std::fs::read(path).unwrap())
}

#[test]
fn a_streamed_file_is_the_saved_file_byte_for_byte() {
    // 1100 pixels: rows that stand alone, and a last block that is not full; 256: rows that lend each other energy.
    let base = ProbeSettings { width: 1100, ..Default::default() };
    let cases = [
        base.clone(),
        ProbeSettings { ground: GroundView::Mirrored, rows: Rows::Corner, ..base.clone() },
        ProbeSettings { width: 256, ground: GroundView::Mirrored, ..base.clone() },
        ProbeSettings { width: 200, projection: Projection::Fisheye, ..base },
    ];
    for settings in &cases {
        for name in ["sky.exr", "sky.hdr", "sky.png"] {
            let [streamed, saved] = both_ways(settings, &FileOptions::default(), name);
            assert!(streamed == saved && !streamed.is_empty(), "{name} {settings:?}");
        }
    }
    let half = FileOptions { half: Half::Scale, ..Default::default() };
    let [streamed, saved] = both_ways(&cases[0], &half, "half.exr");
    assert!(streamed == saved);
}

#[test]
fn several_files_are_written_at_once_and_are_those_written_alone() {
    let folder = tempfile::tempdir().unwrap();
    let settings = ProbeSettings { width: 1024, ..Default::default() };
    let paths = ["a.exr", "b.hdr", "c.png"].map(|name| folder.path().join(name));
    render_to_files(&Painted, &settings, &paths, &FileOptions::default(), &Metadata::default(), &Progress::silent()).unwrap();
    for path in &paths {
        let alone = folder.path().join(format!("alone-{}", path.file_name().unwrap().to_string_lossy()));
        render_to_files(&Painted, &settings, &[&alone], &FileOptions::default(), &Metadata::default(), &Progress::silent())
            .unwrap();
        assert!(std::fs::read(path).unwrap() == std::fs::read(alone).unwrap());
    }
}

#[test]
fn a_cancelled_or_impossible_stream_leaves_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky.exr");
    std::fs::write(&path, "before").unwrap();
    let settings = ProbeSettings { width: 2048, ..Default::default() };
    let write = |options: &FileOptions, progress: &Progress| {
        render_to_files(&Painted, &settings, &[&path], options, &Metadata::default(), progress)
    };
    let stop = |_: &str, fraction: f64| fraction < 0.6;
    assert!(matches!(write(&FileOptions::default(), &Progress::new(&stop)), Err(Error::Cancelled)));
    let refuse = FileOptions { half: Half::Refuse, ..Default::default() };
    let message = write(&refuse, &Progress::silent()).unwrap_err().to_string();
    let brightest = render(&Painted, &settings, &Progress::silent()).unwrap();
    let expected = save(folder.path().join("other.exr"), &brightest, &refuse, &Metadata::default()).unwrap_err().to_string();
    assert!(message.starts_with("half = ") && message == expected, "{message} | {expected}");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "before");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn bands_are_whole_blocks_that_cover_the_picture() {
    for (width, height) in [(64, 32), (1100, 550), (4096, 2048), (16384, 8192)] {
        let found: Vec<_> = bands(width, height, 1).collect();
        assert_eq!((found[0].start, found[found.len() - 1].end), (0, height));
        assert!(found.windows(2).all(|pair| pair[0].end == pair[1].start && pair[1].start.is_multiple_of(BLOCK_ROWS)));
        assert!(found.iter().all(|rows| 12 * width * rows.len() <= 96 << 20));
    }
}

/// Layers stand beside their sum, for any reader of OpenEXR.
#[test]
fn layers_are_channels_whose_sum_is_the_picture() {
    use ::exr::prelude::{FlatSamples, read_all_flat_layers_from_file};
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("layers.exr");
    let mut light = crate::sky::Layers::new(0.0);
    let part = || crate::sky::Part { smooth: vec![Box::new(Painted)], ..Default::default() };
    let point = crate::sky::Point { direction: DVec3::new(0.0, 0.6, 0.8), irradiance: [0.19, 0.2, 0.22] };
    light.add(crate::sky::Layer::Zodiacal, 0.25, part());
    light.add(crate::sky::Layer::Sky, 1.0, part());
    light.add(crate::sky::Layer::Sun, 1.0, crate::sky::Part { discs: Painted.discs(), ..Default::default() });
    light.add(crate::sky::Layer::Stars, 3.0, crate::sky::Part { points: vec![point], ..Default::default() });
    let settings = ProbeSettings { width: 1024, ..Default::default() };
    let options = FileOptions { layers: true, ..Default::default() };
    render_to_files(&light, &settings, &[&path], &options, &Metadata::default(), &Progress::silent()).unwrap();
    let whole = render(&light, &settings, &Progress::silent()).unwrap();
    let picture = exr::read(&path).unwrap();
    for (found, expected) in picture.pixels.iter().zip(&whole.pixels) {
        assert!((found - expected).abs() < 1e-5 * expected, "{found} {expected}");
    }
    let image = read_all_flat_layers_from_file(&path).unwrap();
    let channels = &image.layer_data[0].channel_data.list;
    let names: Vec<String> = channels.iter().map(|channel| channel.name.to_string()).collect();
    assert_eq!(names.len(), 15);
    assert!(names.is_sorted() && names[..4] == ["B", "G", "R", "sky.B"] && names[14] == "zodiacal.R", "{names:?}");
    let values = |name: &str| {
        let channel = channels.iter().find(|channel| channel.name.to_string() == name).unwrap();
        let FlatSamples::F32(values) = &channel.sample_data else { panic!("float32") };
        values.clone()
    };
    let sum: Vec<f32> = ["sky", "stars", "sun", "zodiacal"]
        .iter()
        .map(|name| values(&format!("{name}.G")))
        .fold(vec![0.0; 1024 * 512], |sum, layer| sum.iter().zip(&layer).map(|(a, b)| a + b).collect());
    let largest = values("G").iter().zip(&sum).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f32::max);
    assert!(largest < 1e-6, "{largest}");
    assert!(values("stars.R").iter().filter(|&&value| value > 0.0).count() <= 4);
}
