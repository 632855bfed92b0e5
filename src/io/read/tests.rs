//! Files of others, made here by the crate `exr`, our own, and damaged ones.

use super::super::{FileOptions, Metadata, save, tests::gradient, write_picture};
use super::*;
use crate::post::picture::DEFAULT_FIELD_OF_VIEW_DEG;
use crate::post::tone::{Frame, ToneMapper, ToneMapping};
use crate::probe::{ProbeSettings, Projection};
use crate::progress::Progress;
use ::exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, LineOrder, Text, Vec2, WritableImage, f16,
};

fn list(channels: Vec<(&str, FlatSamples)>) -> AnyChannels<FlatSamples> {
    AnyChannels::sort(channels.into_iter().map(|(name, samples)| AnyChannel::new(name, samples)).collect())
}

fn floats(start: f32) -> FlatSamples {
    FlatSamples::F32((0..20 * 12).map(|k| start + k as f32 * 0.25).collect())
}

fn halves(start: f32) -> FlatSamples {
    FlatSamples::F16((0..20 * 12).map(|k| f16::from_f32(start + k as f32 * 0.25)).collect())
}

fn write(path: &Path, channels: AnyChannels<FlatSamples>, encoding: Encoding, name: Option<&str>) {
    let attributes = LayerAttributes { layer_name: name.map(|name| Text::new_or_none(name).unwrap()), ..Default::default() };
    let layer = Layer::new((20, 12), attributes, encoding, channels);
    Image::from_layer(layer).write().to_file(path).unwrap();
}

#[test]
fn scan_lines_tiles_halves_and_compressions_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.EXR");
    let encodings = [
        (Compression::Uncompressed, Blocks::ScanLines),
        (Compression::RLE, Blocks::Tiles(Vec2(7, 5))),
        (Compression::ZIP1, Blocks::ScanLines),
        (Compression::ZIP16, Blocks::Tiles(Vec2(16, 16))),
        (Compression::PIZ, Blocks::ScanLines),
    ];
    for (compression, blocks) in encodings {
        for samples in [floats, halves] {
            let channels = list(vec![("R", samples(0.0)), ("G", samples(100.0)), ("B", samples(200.0)), ("A", samples(7.0))]);
            write(&path, channels, Encoding { compression, blocks, line_order: LineOrder::Increasing }, None);
            let picture = read_picture(&path, &PictureHints::default()).unwrap();
            assert_eq!((picture.width, picture.height, picture.color_space), (20, 12, ColorSpace::LinRec709));
            assert_eq!(picture.view, View::Perspective { horizontal_field_of_view_deg: DEFAULT_FIELD_OF_VIEW_DEG });
            assert_eq!(picture.white_luminance, 683.0);
            for (k, pixel) in picture.pixels.as_chunks::<3>().0.iter().enumerate() {
                let value = k as f32 * 0.25;
                assert_eq!(*pixel, [value, 100.0 + value, 200.0 + value], "{compression:?}");
            }
        }
    }
}

#[test]
fn compressions_with_loss_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    for compression in [Compression::PXR24, Compression::B44, Compression::B44A, Compression::DWAA(None), Compression::DWAB(None)]
    {
        // Not from 0: B44 keeps the logarithms of 16 neighbours with as many steps, whatever lies between the least and the greatest.
        let channels = list(vec![("R", halves(50.0)), ("G", halves(100.0)), ("B", halves(200.0))]);
        let encoding = Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
        write(&path, channels, encoding, None);
        let picture = read_picture(&path, &PictureHints::default()).unwrap();
        for (k, pixel) in picture.pixels.as_chunks::<3>().0.iter().enumerate() {
            for (found, start) in pixel.iter().zip([50.0, 100.0, 200.0]) {
                let value = start + k as f32 * 0.25;
                assert!((found - value).abs() <= 0.02 * value, "{compression:?}: {found} {value}");
            }
        }
    }
}

#[test]
fn the_picture_among_the_channels_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let plain = Encoding::UNCOMPRESSED;
    let first = |channels: Vec<(&str, FlatSamples)>, name: Option<&str>| {
        write(&path, list(channels), plain, name);
        read_picture(&path, &PictureHints::default()).map(|picture| [picture.pixels[0], picture.pixels[1], picture.pixels[2]])
    };
    let blender = vec![
        ("ViewLayer.Ambient.R", floats(7.0)),
        ("ViewLayer.Ambient.G", floats(7.0)),
        ("ViewLayer.Ambient.B", floats(7.0)),
        ("ViewLayer.Combined.R", floats(1.0)),
        ("ViewLayer.Combined.G", floats(2.0)),
        ("ViewLayer.Combined.B", floats(3.0)),
        ("ViewLayer.Combined.A", floats(4.0)),
        ("ViewLayer.Depth.Z", floats(9.0)),
    ];
    assert_eq!(first(blender, None).unwrap(), [1.0, 2.0, 3.0]);
    let part = vec![("R", floats(1.0)), ("G", floats(2.0)), ("B", floats(3.0))];
    assert_eq!(first(part, Some("ViewLayer.Combined")).unwrap(), [1.0, 2.0, 3.0]);
    let layer = vec![("diffuse.R", floats(5.0)), ("diffuse.G", floats(6.0)), ("diffuse.B", floats(7.0)), ("Y", floats(1.0))];
    assert_eq!(first(layer, None).unwrap(), [5.0, 6.0, 7.0]);
    assert_eq!(first(vec![("Y", halves(5.0))], None).unwrap(), [5.0; 3]);
    let luminance_and_chroma = vec![("Y", floats(5.0)), ("RY", floats(0.5)), ("BY", floats(-0.25))];
    let [red, green, blue] = first(luminance_and_chroma, None).unwrap();
    // By the definition of chroma, and luminance of Rec. 709.
    assert_eq!((red, blue), (7.5, 3.75));
    assert!((0.2126 * red + 0.7152 * green + 0.0722 * blue - 5.0).abs() < 1e-3);
    let message = first(vec![("Z", floats(5.0)), ("id.X", floats(1.0))], None).unwrap_err().to_string();
    assert!(message.contains("or Y among Z, id.X"), "{message}");
}

#[test]
fn windows_place_the_data_in_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let attributes = LayerAttributes { layer_position: Vec2(2, -1), ..Default::default() };
    let layer = Layer::new((20, 12), attributes, Encoding::UNCOMPRESSED, list(vec![("Y", floats(1.0))]));
    let window = IntegerBounds::new((0, 0), (16, 20));
    Image::empty(ImageAttributes::new(window)).with_layer(layer).write().to_file(&path).unwrap();
    let picture = read_picture(&path, &PictureHints::default()).unwrap();
    assert_eq!((picture.width, picture.height), (16, 20));
    let at = |x: usize, y: usize| picture.pixels[3 * (y * 16 + x)];
    // The second line of the data, from its first column on.
    assert_eq!([at(1, 0), at(2, 0), at(15, 0), at(2, 11)], [0.0, 6.0, 9.25, 0.0]);
}

#[test]
fn our_own_files_say_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    for (name, projection, extent, rows) in [
        ("a.exr", Projection::LatLong, Extent::Full, Rows::Corner),
        ("a.hdr", Projection::LatLong, Extent::Upper, Rows::Corner),
        ("b.exr", Projection::Fisheye, Extent::Upper, Rows::Centre),
        ("b.hdr", Projection::Fisheye, Extent::Full, Rows::Centre),
    ] {
        let settings = ProbeSettings {
            width: 64,
            projection,
            extent,
            rows,
            scale: Scale::Mitsuba,
            color_space: ColorSpace::AcesCg,
            ..Default::default()
        };
        let probe = gradient(settings);
        let path = folder.path().join(name);
        save(&path, &probe, &FileOptions::default(), &Metadata::default()).unwrap();
        let picture = read_picture(&path, &PictureHints::default()).unwrap();
        let expected = Picture::from(probe);
        assert_eq!((picture.view, picture.color_space), (expected.view, expected.color_space), "{name}");
        assert!((picture.white_luminance / expected.white_luminance - 1.0).abs() < 1e-6);
        let pairs = || picture.pixels.iter().zip(&expected.pixels);
        if name.ends_with("exr") {
            assert!(picture.pixels == expected.pixels);
        } else {
            // Half a step of 256 of the largest component of the pixel.
            assert!(pairs().all(|(a, b)| (a - b).abs() < 1.5), "{name}");
        }
    }
}

#[test]
fn pictures_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let views = [
        View::LatLong { rows: Rows::Corner },
        View::Perspective { horizontal_field_of_view_deg: 51.25 },
        View::Fisheye { field_of_view_deg: 210.5 },
    ];
    for (view, color_space) in views.into_iter().zip([ColorSpace::LinRec2020, ColorSpace::Xyz, ColorSpace::LinRec709]) {
        let pixels = (0..64 * 32 * 3).map(|k| k as f32 * 0.5).collect();
        let picture = Picture::new(64, 32, pixels, color_space, 1234.5, view).unwrap();
        for name in ["a.exr", "a.hdr"] {
            let path = folder.path().join(name);
            write_picture(&path, &picture, &Progress::silent()).unwrap();
            let found = read_picture(&path, &PictureHints::default()).unwrap();
            assert_eq!((found.view, found.color_space, found.white_luminance), (view, color_space, 1234.5), "{name}");
            assert!(name == "a.hdr" || found.pixels == picture.pixels);
            assert!(found.pixels.iter().zip(&picture.pixels).all(|(a, b)| (a - b).abs() <= 8.0));
        }
    }
    let hints = PictureHints {
        projection: Some(PictureProjection::Perspective),
        field_of_view_deg: Some(90.0),
        white_luminance: Some(2.0),
        color_space: Some(ColorSpace::AcesCg),
        ..Default::default()
    };
    let found = read_picture(folder.path().join("a.exr"), &hints).unwrap();
    assert_eq!(found.view, View::Perspective { horizontal_field_of_view_deg: 90.0 });
    assert_eq!((found.white_luminance, found.color_space), (2.0, ColorSpace::AcesCg));
    let wide = PictureHints { field_of_view_deg: Some(200.0), ..hints };
    assert!(read_picture(folder.path().join("a.exr"), &wide).unwrap_err().to_string().starts_with("field_of_view_deg = 200"));
    assert!(read_picture(folder.path().join("a.jpg"), &hints).unwrap_err().to_string().starts_with("input = "));
    assert!(matches!(read_picture(folder.path().join("none.exr"), &hints), Err(Error::File { .. })));
    assert!(write_picture(folder.path().join("a.png"), &found, &Progress::silent()).is_err());
}

#[test]
fn unknown_primaries_are_converted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("aces.exr");
    let layer = Layer::new((1, 1), LayerAttributes::default(), Encoding::UNCOMPRESSED, {
        let one = || FlatSamples::F32(vec![1.0]);
        list(vec![("R", one()), ("G", FlatSamples::F32(vec![0.0])), ("B", FlatSamples::F32(vec![0.0]))])
    });
    let mut attributes = ImageAttributes::new(IntegerBounds::new((0, 0), (1, 1)));
    let pair = |x: f32, y: f32| Vec2(x, y);
    attributes.chromaticities = Some(::exr::meta::attribute::Chromaticities {
        red: pair(0.7347, 0.2653),
        green: pair(0.0, 1.0),
        blue: pair(0.0001, -0.077),
        white: pair(0.32168, 0.33767),
    });
    Image::empty(attributes).with_layer(layer).write().to_file(&path).unwrap();
    let found = read_picture(&path, &PictureHints::default()).unwrap();
    assert_eq!(found.color_space, ColorSpace::LinRec709);
    // checked against: OpenColorIO's matrix from ACES2065-1 to linear Rec. 709 with Bradford adaptation, first column 2.521686, -0.276480, -0.015378
    for (value, expected) in found.pixels.iter().zip([2.521_686, -0.276_480, -0.015_378]) {
        assert!((value - expected).abs() < 1e-3, "{:?}", found.pixels);
    }
}

#[test]
fn a_white_luminance_that_is_none_counts_as_not_said() {
    let picture = |header: &str| {
        let bytes = [b"#?RADIANCE\n", header.as_bytes(), b"\n-Y 1 +X 1\n", &[128, 128, 128, 129]].concat();
        read_hdr_bytes(&bytes, &PictureHints::default()).unwrap()
    };
    for (header, luminance, notes) in [
        ("skyprobe.white_luminance=20\nskyprobe.scale=mitsuba\n", Some(20.0), 0),
        ("skyprobe.scale=luminance\n", Some(1.0), 0),
        ("skyprobe.white_luminance=0\nskyprobe.scale=luminance\n", Some(1.0), 1),
        ("skyprobe.white_luminance=nan\n", None, 1),
        ("skyprobe.white_luminance=-5\n", None, 1),
        ("skyprobe.white_luminance=1e300\n", None, 1),
        ("skyprobe.white_luminance=bright\nskyprobe.scale=dark\n", None, 2),
        ("\tskyprobe.scale=mitsuba\n", None, 0),
        ("", None, 0),
    ] {
        let found = picture(header);
        assert_eq!((found.white_luminance, found.notes.len()), (luminance.unwrap_or(683.0), notes), "{header}");
        assert_eq!(found.assumption().is_some(), luminance.is_none(), "{header}");
    }
}

#[test]
fn damaged_files_are_told_from_sound_ones_and_never_panic() {
    let folder = tempfile::tempdir().unwrap();
    let view = View::LatLong { rows: Rows::Centre };
    let pixels = (0..64 * 32 * 3).map(|k| (k as f32).sqrt()).collect();
    let picture = Picture::new(64, 32, pixels, ColorSpace::LinRec709, 683.0, view).unwrap();
    for name in ["a.exr", "a.hdr"] {
        let path = folder.path().join(name);
        write_picture(&path, &picture, &Progress::silent()).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        for part in 0..40 {
            std::fs::write(&path, &bytes[..bytes.len() * part / 40]).unwrap();
            let error = read_picture(&path, &PictureHints::default()).unwrap_err();
            assert!(matches!(error, Error::File { .. }), "{name} cut to {part} / 40: {error}");
        }
        for k in (0..bytes.len()).step_by(7) {
            let mut wrong = bytes.clone();
            wrong[k] ^= 0x91;
            std::fs::write(&path, &wrong).unwrap();
            // Any answer but a panic: many damaged values are values.
            let _ = read_picture(&path, &PictureHints::default());
        }
    }
}

#[test]
fn a_turn_goes_from_file_to_file() {
    let folder = tempfile::tempdir().unwrap();
    for (name, next) in [("a.exr", "b.hdr"), ("c.hdr", "d.exr")] {
        let [path, next] = [name, next].map(|name| folder.path().join(name));
        let probe = gradient(ProbeSettings { width: 64, turn_deg: -12.5, ..Default::default() });
        save(&path, &probe, &FileOptions::default(), &Metadata::default()).unwrap();
        let picture = read_picture(&path, &PictureHints::default()).unwrap();
        assert_eq!(picture.turn_deg, -12.5, "{name}");
        write_picture(&next, &picture, &Progress::silent()).unwrap();
        assert_eq!(read_picture(&next, &PictureHints::default()).unwrap().turn_deg, -12.5);
        let toned = ToneMapper::new(Frame::from(&picture), &ToneMapping::default(), &Progress::silent()).unwrap();
        assert_eq!(toned.to_picture(&Progress::silent()).unwrap().turn_deg, -12.5);
    }
    let plain = folder.path().join("e.exr");
    save(&plain, &gradient(ProbeSettings { width: 64, ..Default::default() }), &FileOptions::default(), &Metadata::default())
        .unwrap();
    assert_eq!(read_picture(&plain, &PictureHints::default()).unwrap().turn_deg, 0.0);
}

#[test]
fn a_field_of_ours_that_is_not_understood_does_not_refuse_the_picture() {
    let file = |fields: &str| format!("#?RADIANCE\n{fields}\n-Y 1 +X 2\n").into_bytes();
    let fields = "skyprobe.projection=mirrorball\nskyprobe.rows=9\nskyprobe.extent=most\nskyprobe.field_of_view_deg=1e9\nskyprobe.turn_deg=abc\n";
    let bytes = [file(fields), vec![128, 64, 32, 129, 128, 64, 32, 129]].concat();
    let picture = read_hdr_bytes(&bytes, &PictureHints::default()).unwrap();
    assert_eq!(picture.view, PictureProjection::Perspective.view(Rows::Centre, DEFAULT_FIELD_OF_VIEW_DEG));
    assert_eq!((picture.turn_deg, picture.notes.len()), (0.0, 5));
    assert!(picture.notes.iter().all(|note| note.ends_with("not understood, left aside")), "{:?}", picture.notes);
    // What the caller knows better still counts.
    let hints = PictureHints { projection: Some(PictureProjection::Fisheye), ..Default::default() };
    assert_eq!(read_hdr_bytes(&bytes, &hints).unwrap().view, PictureProjection::Fisheye.view(Rows::Centre, 180.0));
}

#[cfg(unix)]
#[test]
fn only_plain_files_are_read() {
    for name in ["/dev/zero.exr", "/dev/zero.hdr"] {
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join(Path::new(name).file_name().unwrap());
        std::os::unix::fs::symlink("/dev/zero", &link).unwrap();
        let message = read_picture(&link, &PictureHints::default()).unwrap_err().to_string();
        assert!(message.ends_with("no plain file"), "{message}");
    }
}
