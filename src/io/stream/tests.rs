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

/// Lets through less of what is low and in the east.
struct Veil;

impl crate::sky::Transmittance for Veil {
    fn transmittance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        let share = |azimuth: &f64| (0.5 + 0.3 * altitude.sin() - 0.1 * azimuth.sin()) as f32;
        out.iter_mut()
            .zip(azimuths)
            .for_each(|(out, azimuth)| *out = [share(azimuth), 0.9 * share(azimuth), 0.8 * share(azimuth)]);
    }
}

/// Layers stand beside their sum, for any reader of OpenEXR.
#[test]
fn layers_are_channels_whose_sum_is_the_picture() {
    use ::exr::prelude::{FlatSamples, read_all_flat_layers_from_file};
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("layers.exr");
    let mut light = crate::sky::Layers::new(0.0);
    let part = || crate::sky::Part::smooth(Box::new(Painted));
    let point = crate::sky::Point { direction: DVec3::new(0.0, 0.6, 0.8), irradiance: [0.19, 0.2, 0.22] };
    light.add(crate::sky::Layer::Zodiacal, 0.25, part());
    let veil = part().at(crate::sky::Distance::Clouds).with_transmittance(std::sync::Arc::new(Veil));
    light.add(crate::sky::Layer::Airglow, 0.5, veil);
    light.add(crate::sky::Layer::Sky, 1.0, part());
    light.add(crate::sky::Layer::Sun, 1.0, crate::sky::Part::discs(Painted.discs()));
    light.add(crate::sky::Layer::Stars, 3.0, crate::sky::Part::points(vec![point]));
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
    assert_eq!(names.len(), 18);
    assert!(names.is_sorted() && names[..4] == ["B", "G", "R", "airglow.B"] && names[17] == "zodiacal.R", "{names:?}");
    let values = |name: &str| {
        let channel = channels.iter().find(|channel| channel.name.to_string() == name).unwrap();
        let FlatSamples::F32(values) = &channel.sample_data else { panic!("float32") };
        values.clone()
    };
    let sum: Vec<f32> = ["airglow", "sky", "stars", "sun", "zodiacal"]
        .iter()
        .map(|name| values(&format!("{name}.G")))
        .fold(vec![0.0; 1024 * 512], |sum, layer| sum.iter().zip(&layer).map(|(a, b)| a + b).collect());
    let largest = values("G").iter().zip(&sum).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f32::max);
    assert!(largest < 1e-6, "{largest}");
    assert!(values("stars.R").iter().filter(|&&value| value > 0.0).count() <= 4);
}

/// Hides what is more than 40 degrees above the horizontal.
struct Blind;

impl crate::sky::Transmittance for Blind {
    fn transmittance_circle(&self, altitude: f64, _: &[f64], out: &mut [[f32; 3]]) {
        out.fill([if altitude > 40_f64.to_radians() { 0.0 } else { 1.0 }; 3]);
    }
}

#[test]
fn what_hides_half_the_sun_hides_it_in_the_picture_and_takes_half_of_its_light() {
    use crate::sky::{Disc, Distance, Layer, Layers, Part, Surface};
    let (up, north) = 40_f64.to_radians().sin_cos();
    let disc = Disc {
        is_sun: true,
        direction: DVec3::new(0.0, north, up),
        horizontal_radius: 0.0047,
        vertical_radius: 0.0047,
        irradiance: [1.0; 3],
        surface: Surface::LimbDarkened([[0.4, 0.2]; 3]),
    };
    for width in [256, 4096] {
        let settings = ProbeSettings { width, ..Default::default() };
        let grid = settings.grid();
        let row_of = |altitude_deg: f64| ((90.0 - altitude_deg) / 180.0 * width as f64 / 2.0) as usize;
        // Light in the picture, and that more than a tenth of a degree above the edge of the blind.
        let lit = |hidden: bool| {
            let mut light = Layers::new(0.0);
            light.add(Layer::Sun, 1.0, Part::discs(vec![disc.clone()]));
            if hidden {
                let blind = Part::default().at(Distance::Clouds).with_transmittance(std::sync::Arc::new(Blind));
                light.add(Layer::Sky, 1.0, blind);
            }
            let probe = render(&light, &settings, &Progress::silent()).unwrap();
            let pixels = probe.pixels.chunks(3).enumerate().map(|(i, rgb)| {
                let (column, row) = (i % width, i / width);
                (row, f64::from(rgb[1]) * grid.footprint(column, row).solid_angle)
            });
            pixels.fold((0.0, 0.0), |(all, high), (row, energy)| {
                (all + energy, if row < row_of(40.1) { high + energy } else { high })
            })
        };
        let (whole, half) = (lit(false), lit(true));
        assert!((half.0 / whole.0 - 0.5).abs() < 0.01, "{width}: {half:?} {whole:?}");
        if width == 4096 {
            assert!(whole.1 > 0.1 * whole.0 && half.1 < 0.01 * whole.0, "{half:?} {whole:?}");
        }
    }
}
