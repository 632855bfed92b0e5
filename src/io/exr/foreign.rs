//! Files of others, made here byte by byte: names, sampling, windows, maps of directions, kinds that are not read, and hostile ones.

mod damaged;
mod hostile;
mod maker;

use super::super::{PictureHints, read_exr_bytes};
use crate::error::Result;
use crate::post::{Picture, View};
use crate::probe::Rows;
use crate::spectrum::ColorSpace;
use maker::{
    Attribute, FLOAT, HALF, Made, UINT, assemble, b44, channel_list, dwaa, file, floats, header, ints, pxr24, rows, small, zip,
};

fn read(bytes: &[u8]) -> Result<Picture> {
    read_exr_bytes(bytes, &PictureHints::default())
}

fn message(bytes: &[u8]) -> String {
    read(bytes).unwrap_err().to_string()
}

#[test]
fn colours_of_any_spelling_and_layer_are_read() {
    type Case<'a> = (&'a [(&'a str, f32)], [f32; 3]);
    let cases: [Case<'_>; 8] = [
        (&[("b", 3.0), ("g", 2.0), ("r", 1.0)], [1.0, 2.0, 3.0]),
        (&[("Blue", 3.0), ("GREEN", 2.0), ("red", 1.0)], [1.0, 2.0, 3.0]),
        (&[("C.a", 9.0), ("C.b", 3.0), ("C.g", 2.0), ("C.r", 1.0)], [1.0, 2.0, 3.0]),
        (&[("view.layer.B", 3.0), ("view.layer.G", 2.0), ("view.layer.R", 1.0)], [1.0, 2.0, 3.0]),
        (&[("A", 9.0), ("Y", 5.0)], [5.0; 3]),
        (&[("intensity", 5.0)], [5.0; 3]),
        (&[("Z", 5.0)], [5.0; 3]),
        (&[("R", 5.0)], [5.0; 3]),
    ];
    for (channels, first) in cases {
        let picture = read(&file(&small(channels), [0, 0, 3, 1], &[])).unwrap();
        assert_eq!((picture.width, picture.height, picture.color_space), (4, 2, ColorSpace::LinRec709));
        assert_eq!(picture.pixels[..3], first, "{channels:?}");
        assert_eq!(picture.pixels[21..], first.map(|value| value + 7.0), "{channels:?}");
    }
    let xyz = read(&file(&small(&[("X", 1.0), ("Y", 2.0), ("Z", 3.0)]), [0, 0, 3, 1], &[])).unwrap();
    assert_eq!((xyz.color_space, &xyz.pixels[..3]), (ColorSpace::Xyz, &[1.0, 2.0, 3.0][..]));
    let alpha = message(&file(&small(&[("A", 1.0)]), [0, 0, 3, 1], &[]));
    // A channel of fewer samples than pixels is no picture by itself.
    let half = file(&[("Y", FLOAT, (2, 2), vec![1.0, 2.0])], [0, 0, 3, 1], &[]);
    assert!(message(&half).contains("among Y"));
    let ratio = ("pixelAspectRatio", "float", floats(&[2.0]));
    let wide = read(&file(&small(&[("Y", 1.0)]), [0, 0, 3, 1], &[ratio])).unwrap();
    assert_eq!(wide.notes, ["pixelAspectRatio=2: pixels are taken as square"]);
    assert!(alpha.contains("among A") && !alpha.contains("sound"), "{alpha}");
}

#[test]
fn samples_of_all_types_and_windows_anywhere_are_read() {
    let values = |start: f32| (0..8).map(|k| start + k as f32).collect::<Vec<f32>>();
    let mixed: Vec<Made<'_>> =
        vec![("B", UINT, (1, 1), values(3.0)), ("G", FLOAT, (1, 1), values(2.5)), ("R", HALF, (1, 1), values(1.5))];
    let window = [-10, -20, -7, -19];
    let picture = read(&file(&mixed, window, &[])).unwrap();
    assert_eq!((picture.width, picture.height, &picture.pixels[21..]), (4, 2, &[8.5, 9.5, 10.0][..]));
    // Two of its columns and the lower row are in a window of 3 x 4 from (-9, -19) on.
    let shown = ("displayWindow", "box2i", ints(&[-8, -19, -6, -16]));
    let picture = read(&file(&mixed, window, std::slice::from_ref(&shown))).unwrap();
    assert_eq!((picture.width, picture.height), (3, 4));
    assert_eq!(picture.pixels[..9], [7.5, 8.5, 9.0, 8.5, 9.5, 10.0, 0.0, 0.0, 0.0]);
    assert!(picture.pixels[9..].iter().all(|&value| value == 0.0));
    // Data beside the window leave it black.
    let shown = ("displayWindow", "box2i", ints(&[100, 100, 101, 101]));
    assert!(read(&file(&mixed, window, &[shown])).unwrap().pixels.iter().all(|&value| value == 0.0));
}

#[test]
fn blocks_in_any_order_and_a_table_that_was_never_written_are_read() {
    let channels = small(&[("Y", 1.0)]);
    let mut bytes = file(&channels, [0, 0, 3, 1], &[("lineOrder", "lineOrder", vec![1])]);
    let whole = read(&bytes).unwrap();
    let (table, blocks) = (bytes.len() - 2 * 24 - 16, bytes.len() - 2 * 24);
    let mut turned = bytes.clone();
    turned[blocks..].rotate_left(24);
    turned[table..blocks].rotate_left(8);
    assert_eq!(read(&turned).unwrap(), whole);
    bytes[table..blocks].fill(0);
    assert_eq!(read(&bytes).unwrap(), whole);
    bytes.truncate(bytes.len() - 24);
    assert!(message(&bytes).contains("1 of 2 blocks are not there"), "{}", message(&bytes));
}

/// A smooth picture of 32 x 16 pixels, and its luminance and chroma with these weights and samples.
fn luminance_and_chroma(weights: [f32; 3], sampling: (usize, usize), kind: i32) -> (Vec<[f32; 3]>, Vec<Made<'static>>) {
    let (width, height) = (32, 16);
    let pixel = |k: usize| {
        let (x, y) = ((k % width) as f32, (k / width) as f32);
        [1.0 + 0.3 * (0.2 * x).sin(), 0.9 + 0.2 * (0.15 * y).cos(), 0.7 + 0.1 * (0.1 * (x + y)).sin()]
    };
    let pixels: Vec<[f32; 3]> = (0..width * height).map(pixel).collect();
    let luminance = |pixel: &[f32; 3]| pixel.iter().zip(weights).map(|(a, b)| a * b).sum::<f32>();
    let chroma = |c: usize| {
        let chosen = (0..height).step_by(sampling.1).flat_map(|y| (0..width).step_by(sampling.0).map(move |x| y * width + x));
        chosen.map(|k| (pixels[k][c] - luminance(&pixels[k])) / luminance(&pixels[k])).collect()
    };
    let (red, blue) = (chroma(0), chroma(2));
    let y = pixels.iter().map(luminance).collect();
    (pixels, vec![("BY", kind, sampling, blue), ("RY", kind, sampling, red), ("Y", kind, (1, 1), y)])
}

#[test]
fn luminance_and_chroma_become_colours() {
    let window = [0, 0, 31, 15];
    let check = |bytes: &[u8], pixels: &[[f32; 3]], tolerance: f32| {
        let picture = read(bytes).unwrap();
        for (k, (found, expected)) in picture.pixels.as_chunks::<3>().0.iter().zip(pixels).enumerate() {
            let (x, y) = (k % 32, k / 32);
            // Beyond the borders the filter repeats samples.
            if tolerance > 1e-3 && !((3..28).contains(&x) && (3..12).contains(&y)) {
                continue;
            }
            let close = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < tolerance);
            assert!(close, "{x} {y}: {found:?} {expected:?}");
        }
    };
    for (sampling, kind, tolerance) in
        [((1, 1), FLOAT, 1e-4), ((2, 2), FLOAT, 0.01), ((2, 2), HALF, 0.012), ((2, 1), FLOAT, 0.01), ((4, 4), FLOAT, 0.03)]
    {
        let (pixels, channels) = luminance_and_chroma([0.2126, 0.7152, 0.0722], sampling, kind);
        check(&file(&channels, window, &[]), &pixels, tolerance);
        // A layer of any case.
        let names = ["c.by", "c.ry", "c.y"];
        let layered: Vec<Made<'_>> = channels.into_iter().zip(names).map(|(made, name)| (name, made.1, made.2, made.3)).collect();
        check(&file(&layered, window, &[]), &pixels, tolerance);
    }
    // The weights are those of the primaries.
    let (pixels, channels) = luminance_and_chroma([0.2627, 0.6780, 0.0593], (2, 2), FLOAT);
    let rec2020 = ("chromaticities", "chromaticities", floats(&[0.708, 0.292, 0.170, 0.797, 0.131, 0.046, 0.3127, 0.3290]));
    check(&file(&channels, window, &[rec2020]), &pixels, 0.01);
    // A display window that shows a part.
    let (pixels, channels) = luminance_and_chroma([0.2126, 0.7152, 0.0722], (1, 1), FLOAT);
    let shown = ("displayWindow", "box2i", ints(&[4, 2, 40, 20]));
    let picture = read(&file(&channels, window, &[shown])).unwrap();
    assert_eq!((picture.width, picture.height), (37, 19));
    let found = &picture.pixels[3 * (5 * 37 + 7)..][..3];
    assert!(found.iter().zip(pixels[7 * 32 + 11]).all(|(a, b)| (a - b).abs() < 1e-4), "{found:?}");
}

#[test]
fn sub_sampled_channels_come_out_of_every_compression() {
    let window = [0, 0, 31, 15];
    for kind in [HALF, FLOAT] {
        let (_, mut channels) = luminance_and_chroma([0.2126, 0.7152, 0.0722], (2, 2), kind);
        // Constant in 4 x 4 samples, which B44 holds exactly.
        for (_, _, (step, _), samples) in &mut channels {
            let (old, width) = (samples.clone(), 32 / *step);
            samples.iter_mut().enumerate().for_each(|(k, value)| *value = old[k / (4 * width) * 4 * width + k % width / 4 * 4]);
        }
        let plain = read(&file(&channels, window, &[])).unwrap();
        let raw = rows(&channels, 32, (0, 16));
        // PXR24 keeps 15 bits of a float; cosine transforms have loss.
        for (compression, tolerance) in [(3, 0.0), (5, 3e-4), (6, 0.0), (8, 0.05)] {
            let packed = match compression {
                3 => zip(&raw),
                5 => pxr24(&channels),
                6 => b44(&channels),
                _ => dwaa(&channels, raw.clone()),
            };
            let list = channel_list(channels.iter().map(|(name, kind, sampling, _)| (*name, *kind, *sampling)));
            let start = header(0, &list, window, &[("compression", "compression", vec![compression])]);
            // What does not shrink is stored as it is, and B44 shrinks only halves.
            if compression == 6 && kind == FLOAT {
                continue;
            }
            assert!(packed.len() < raw.len() || compression == 8, "{compression}");
            let found = read(&assemble(start, &[(vec![0], packed)])).unwrap();
            let tolerance = if kind == HALF && compression == 5 { 0.0 } else { tolerance };
            let differences = found.pixels.iter().zip(&plain.pixels).map(|(a, b)| (a - b).abs());
            let largest = differences.fold(0.0, f32::max);
            assert!(largest <= tolerance, "{compression} of {kind}: {largest}");
        }
    }
}

#[test]
fn numbers_that_no_space_and_no_light_have_count_as_absent() {
    let channels = small(&[("B", 3.0), ("G", 2.0), ("R", 1.0)]);
    let plain = read(&file(&channels, [0, 0, 3, 1], &[])).unwrap();
    let nan = f32::NAN;
    let chromaticities = [
        [0.0; 8],
        [0.3127; 8],
        [nan; 8],
        [0.6, 0.3, 0.4, 0.3, 0.2, 0.3, 0.31, 0.33],
        [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.0, 0.0],
    ];
    for numbers in chromaticities {
        let more = ("chromaticities", "chromaticities", floats(&numbers));
        let found = read(&file(&channels, [0, 0, 3, 1], &[more])).unwrap();
        assert_eq!((found.color_space, &found.pixels), (plain.color_space, &plain.pixels), "{numbers:?}");
    }
    for white in [0.0, -1.0, nan, f32::INFINITY] {
        let more = ("whiteLuminance", "float", floats(&[white]));
        let found = read(&file(&channels, [0, 0, 3, 1], &[more])).unwrap();
        assert_eq!(found.white_luminance, 683.0, "{white}");
    }
}

#[test]
fn maps_of_directions_are_latlong_pictures() {
    let values = |count: usize| (0..count).map(|k| k as f32).collect::<Vec<f32>>();
    let channels: Vec<Made<'_>> = vec![("Y", FLOAT, (1, 1), values(64 * 32))];
    let map = |number: u8| ("envmap", "envmap", vec![number]);
    let picture = read(&file(&channels, [0, 0, 63, 31], &[map(0)])).unwrap();
    assert_eq!((picture.width, picture.height, picture.view), (64, 32, View::LatLong { rows: Rows::Corner }));
    // The outer columns lie on the seam: the middle of ours are 63/64 as far apart.
    for x in [0, 31, 63] {
        let found = picture.pixels[3 * (64 + x)] - 64.0;
        assert!((found - (x as f32 + 0.5) * 63.0 / 64.0).abs() < 1e-4, "{x}: {found}");
    }
    let cube: Vec<Made<'_>> = vec![("Y", FLOAT, (1, 1), vec![2.5; 16 * 96])];
    let picture = read(&file(&cube, [0, 0, 15, 95], &[map(1)])).unwrap();
    assert_eq!((picture.width, picture.height, picture.view), (64, 32, View::LatLong { rows: Rows::Centre }));
    assert!(picture.pixels.iter().all(|value| (value - 2.5).abs() < 1e-5));
    let wrong = message(&file(&channels, [0, 0, 63, 31], &[map(1)]));
    assert!(wrong.contains("envmap = cube, 64 x 32 pixels"), "{wrong}");
    // Whoever knows better says so.
    let hints = PictureHints { projection: Some("perspective".parse().unwrap()), ..Default::default() };
    let picture = read_exr_bytes(&file(&channels, [0, 0, 63, 31], &[map(0)]), &hints).unwrap();
    assert_eq!((picture.view.projection(), picture.pixels[3]), ("perspective".parse().unwrap(), 1.0));
}

#[test]
fn sound_files_that_are_not_read_are_told_by_what_they_are() {
    let channels = small(&[("B", 3.0), ("G", 2.0), ("R", 1.0)]);
    let list = channel_list(channels.iter().map(|(name, kind, sampling, _)| (*name, *kind, *sampling)));
    let with = |compression: u8| file(&channels, [0, 0, 3, 1], &[("compression", "compression", vec![compression])]);
    let many: Vec<String> = (0..5000).map(|k| format!("aov{k:05}")).collect();
    let many = channel_list(many.iter().map(|name| (name.as_str(), HALF, (1, 1))));
    let texts = vec![("a", "string", vec![65]); 5000];
    let deep = ("type", "string", b"deepscanline".to_vec());
    for (bytes, told) in [
        (with(10), "HTJ2K"),
        (with(11), "HTJ2K"),
        (with(13), "ZSTD"),
        (with(77), "compression 77"),
        (header(0x800, &list, [0, 0, 3, 1], &[deep]), "deep data"),
        (header(0, &many, [0, 0, 3, 1], &[]), "more channels than the 4096"),
        (header(0, &list, [0, 0, 3, 1], &texts), "more attributes than the 4096"),
        ([&[0x76, 0x2f, 0x31, 0x01][..], &[3, 0, 0, 0, 0]].concat(), "version 3"),
        ([&[0x76, 0x2f, 0x31, 0x01][..], &[2, 0, 1, 0, 0]].concat(), "later version"),
    ] {
        let told_so = message(&bytes);
        assert!(told_so.contains(told) && !told_so.contains("sound") && !told_so.contains("damaged"), "{told_so}");
    }
}

#[test]
fn parts_are_found_by_their_tables() {
    // Two parts: a depth of one row of 2 pixels, then a picture of 2 x 2 in a block of 16 rows.
    let attributes = |name: &str, list: Vec<u8>, rows: i32, chunks: i32| -> Vec<u8> {
        let window = ints(&[0, 0, 1, rows - 1]);
        let all: [Attribute<'_>; 8] = [
            ("channels", "chlist", list),
            ("chunkCount", "int", ints(&[chunks])),
            ("compression", "compression", vec![0]),
            ("dataWindow", "box2i", window.clone()),
            ("displayWindow", "box2i", window),
            ("lineOrder", "lineOrder", vec![0]),
            ("name", "string", name.as_bytes().to_vec()),
            ("type", "string", b"scanlineimage".to_vec()),
        ];
        let one = |(name, kind, value): &Attribute<'_>| {
            [name.as_bytes(), &[0], kind.as_bytes(), &[0], &ints(&[value.len() as i32]), value].concat()
        };
        [all.iter().flat_map(one).collect(), vec![0]].concat()
    };
    let depth = attributes("depth", channel_list([("Z", FLOAT, (1, 1))]), 1, 1);
    let colours = attributes("rgba", channel_list(["B", "G", "R"].map(|name| (name, FLOAT, (1, 1)))), 2, 2);
    let start = [&[0x76, 0x2f, 0x31, 0x01, 2, 0x10, 0, 0][..], &depth, &colours, &[0]].concat();
    let row = |start: f32| floats(&[start + 2.0, start + 12.0, start + 1.0, start + 11.0, start, start + 10.0]);
    let blocks = [(vec![0, 0], floats(&[7.0, 8.0])), (vec![1, 0], row(100.0)), (vec![1, 1], row(200.0))];
    let picture = read(&assemble(start.clone(), &blocks)).unwrap();
    assert_eq!(picture.pixels, [100.0, 101.0, 102.0, 110.0, 111.0, 112.0, 200.0, 201.0, 202.0, 210.0, 211.0, 212.0]);
    let swapped = [blocks[0].clone(), blocks[2].clone(), blocks[1].clone()];
    assert!(message(&assemble(start, &swapped)).contains("says that it is another"));
}
