//! Entries of the cache: those that were stored come back, those that were damaged in any way do not.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use skyprobe::sky::Cache;
use skyprobe::sky::cache::KeyBuilder;
use std::sync::LazyLock;

static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| tempfile::tempdir().expect("a folder for the entries"));

#[derive(Arbitrary, Debug)]
enum Damage<'a> {
    None,
    Flip(u16, u8),
    Cut(u16),
    Append(&'a [u8]),
    Replace(&'a [u8]),
    Overwrite(u16, &'a [u8]),
}

fuzz_target!(|input: (Vec<Vec<f32>>, Damage)| {
    let (sections, damage) = input;
    let cache = Cache::new(FOLDER.path(), 1 << 20);
    let mut builder = KeyBuilder::of_this_solver();
    builder.text("fuzz");
    let key = builder.finish();
    cache.store(&key, &sections);
    let Some(entry) =
        std::fs::read_dir(FOLDER.path()).unwrap().filter_map(Result::ok).find(|entry| entry.path().extension().is_some())
    else {
        return;
    };
    let before = std::fs::read(entry.path()).unwrap();
    let mut bytes = before.clone();
    match damage {
        Damage::None => {}
        Damage::Flip(at, mask) => {
            let at = at as usize % bytes.len();
            bytes[at] ^= mask;
        }
        Damage::Cut(length) => bytes.truncate(length as usize),
        Damage::Append(more) => bytes.extend_from_slice(more),
        Damage::Replace(all) => bytes = all.to_vec(),
        Damage::Overwrite(at, part) => {
            for (to, from) in bytes.iter_mut().skip(at as usize).zip(part) {
                *to = *from;
            }
        }
    }
    std::fs::write(entry.path(), &bytes).unwrap();
    let loaded = cache.load(&key);
    let bits = |sections: &[Vec<f32>]| -> Vec<Vec<u32>> {
        sections.iter().map(|section| section.iter().map(|value| value.to_bits()).collect()).collect()
    };
    if bytes == before {
        // A cache may refuse what is no light, such as numbers that are not finite, but never changes it.
        assert!(loaded.is_none_or(|loaded| bits(&loaded) == bits(&sections)));
    } else {
        assert!(loaded.is_none(), "a damaged entry was believed");
    }
});
