//! Files that ask for more than there is.

use super::maker::{FLOAT, assemble, channel_list, file, floats, header, ints, small};
use super::{message, read};
use crate::error::Error;
use crate::io::{PictureHints, PictureLimits, read_exr_bytes};
use std::time::Instant;

/// Files that ask for more than there is. Each was seen to take gigabytes or minutes, or to end the process, in one reader or another.
fn hostile() -> Vec<(&'static str, Vec<u8>)> {
    let rgb = channel_list(["B", "G", "R"].map(|name| (name, FLOAT, (1, 1))));
    let one = || (vec![0], floats(&[1.0, 1.0, 1.0]));
    let display = |window: [i32; 4]| ("displayWindow", "box2i", ints(&window));
    let compression = |number: u8| ("compression", "compression", vec![number]);
    let tiles = |side: u32, mode: u8| ("tiles", "tiledesc", [&side.to_le_bytes()[..], &side.to_le_bytes(), &[mode]].concat());
    let (least, most) = (i32::MIN, i32::MAX);
    let counters = [2_u64, 1 << 46, 10, 10, 10, 10, 1 << 46, 1 << 46, 1 << 46, 1 << 46, 1].map(u64::to_le_bytes).concat();
    let many: Vec<String> = (0..36_000).map(|k| format!("{k:05}.R")).collect();
    let mut attribute = header(0, &rgb, [0, 0, 0, 0], &[]);
    attribute.truncate(attribute.len() - 1);
    attribute.extend([&b"preview\0preview\0"[..], &ints(&[most])].concat());
    let table = [header(0x200, &rgb, [0, 0, 16383, 16383], &[tiles(1, 0)]), vec![0; 4096]].concat();
    let parts = [&[0x76, 0x2f, 0x31, 0x01, 2, 0x10, 0, 0][..], &b"x\0string\0\0\0\0\0\0".repeat(100_000)].concat();
    let dwa = |bytes: Vec<u8>| assemble(header(0, &rgb, [0, 0, 15, 15], &[compression(8)]), &[(vec![0], bytes)]);
    // Codes of PIZ that name no values, and a table of values that ends too late.
    let piz =
        assemble(header(0, &rgb, [0, 0, 63, 31], &[compression(4)]), &[(vec![0], [[255; 4].to_vec(), vec![0; 900]].concat())]);
    vec![
        ("a pixel in a large window", assemble(header(0, &rgb, [0; 4], &[display([0, 0, 32767, 32767])]), &[one()])),
        ("a pixel in a window within the limits", assemble(header(0, &rgb, [0; 4], &[display([0, 0, 15999, 15999])]), &[one()])),
        (
            "a pixel in a window of all numbers",
            assemble(header(0, &rgb, [0; 4], &[display([least, least, most, most])]), &[one()]),
        ),
        ("data of all numbers", assemble(header(0, &rgb, [least, least, most, most], &[]), &[one()])),
        ("a window inside out", assemble(header(0, &rgb, [most, most, least, least], &[]), &[one()])),
        ("much data in a few bytes", assemble(header(0, &rgb, [0, 0, 15999, 15999], &[compression(9)]), &[one()])),
        ("zip of much data", [header(0, &rgb, [0, 0, 15999, 15999], &[compression(3)]), vec![0; 131_072]].concat()),
        ("tiles of one pixel", table),
        ("a mip map of tiles of one pixel", header(0x200, &rgb, [0, 0, 16383, 16383], &[tiles(1, 0x11)])),
        ("a rip map of tiles of one pixel", header(0x200, &rgb, [0, 0, 16383, 16383], &[tiles(1, 2)])),
        ("tiles without size", header(0x200, &rgb, [0, 0, 15, 15], &[tiles(0, 0)])),
        ("one tile of all", header(0x200, &rgb, [0, 0, 15, 15], &[tiles(u32::MAX, 0)])),
        ("counters of 70 terabytes", dwa([counters, vec![0; 100]].concat())),
        ("half a block of counters", dwa(vec![7; 40])),
        ("codes of no values", piz),
        (
            "thousands of channels",
            header(0, &channel_list(many.iter().map(|name| (name.as_str(), FLOAT, (1, 1)))), [0, 0, 0, 0], &[]),
        ),
        ("an attribute of two gigabytes", attribute),
        ("a hundred thousand parts", parts),
        ("nothing", Vec::new()),
        ("four bytes", vec![0x76, 0x2f, 0x31, 0x01]),
    ]
}

#[test]
fn hostile_files_are_refused_before_they_cost_anything() {
    for (name, bytes) in hostile() {
        let start = Instant::now();
        let error = read(&bytes).unwrap_err();
        println!("{name}: {error} ({:?})", start.elapsed());
        assert!(matches!(error, Error::File { .. } | Error::Input { .. }), "{name}: {error}");
        // An hour's work, done in a blink.
        assert!(start.elapsed().as_secs() < 10, "{name}: {:?}", start.elapsed());
    }
    let bomb = &hostile()[0].1;
    let told = message(bomb);
    assert!(told.starts_with("max_megapixels = 256: must be at least 1073.742 to read"), "{told}");
    let few = PictureHints { limits: PictureLimits { max_megapixels: 1e-5 }, ..Default::default() };
    assert!(read_exr_bytes(&file(&small(&[("Y", 1.0)]), [0, 0, 3, 1], &[]), &few).is_ok());
    let fewer = PictureHints { limits: PictureLimits { max_megapixels: 4e-6 }, ..Default::default() };
    assert!(read_exr_bytes(&file(&small(&[("Y", 1.0)]), [0, 0, 3, 1], &[]), &fewer).is_err());
}
