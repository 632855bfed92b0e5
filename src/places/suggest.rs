//! Places whose names are spelled nearly as a text: what may have been meant where the search finds nothing.
//!
//! Nearness is the number of letters that are missing, too many, wrong, or swapped with their neighbour (optimal string alignment).

use super::gazetteer::{GAZETTEER, NamedPlace};
use super::search::{parts, qualities};
use std::cmp::Reverse;
use std::sync::LazyLock;

/// Fewest and most letters of a name that others are suggested for.
const LETTERS: std::ops::RangeInclusive<usize> = 3..=40;

/// Up to how many letters one wrong letter is allowed; two in longer names.
const SHORT: usize = 4;

/// Most words at the end that may name region or country.
const MOST_LAST_WORDS: usize = 3;

/// Of every key of the gazetteer, so that most need not be read.
static SKETCHES: LazyLock<Vec<Sketch>> = LazyLock::new(|| {
    let keys = &GAZETTEER.keys;
    (0..keys.starts.len()).map(|key| Sketch::of(keys.text(key).chars())).collect()
});

/// At most `limit` places whose names differ from `text` by up to two letters (one in names of four letters or fewer): the nearest first, then the largest.
/// Region and country may follow, as for [`super::search`]. Takes up to 3 ms, the first time some 15 ms more; nothing is suggested for more than 40 letters.
pub fn suggest(text: &str, limit: usize) -> Vec<NamedPlace> {
    let gazetteer = &*GAZETTEER;
    let Some((name, after_commas)) = parts(text) else { return Vec::new() };
    let words: Vec<&str> = name.split(' ').collect();
    let mut ranks = Vec::new();
    for last in 0..words.len().min(MOST_LAST_WORDS + 1) {
        let (name, last_words) = words.split_at(words.len() - last);
        let wanted: Vec<char> = name.join(" ").chars().collect();
        if !LETTERS.contains(&wanted.len()) {
            continue;
        }
        // Region or country may be misspelled, too: then they do not count.
        let Some(qualities) = qualities(gazetteer, last_words, &after_commas)
            .or_else(|| if last == 0 { qualities(gazetteer, &[], &[]) } else { None })
        else {
            continue;
        };
        let most = if wanted.len() <= SHORT { 1 } else { 2 };
        let pattern = Pattern::new(wanted, most);
        let keys = &gazetteer.keys;
        for (key, _) in SKETCHES.iter().enumerate().filter(|(_, sketch)| pattern.may_be_near(sketch)) {
            let place = keys.places[key];
            let row = &gazetteer.rows[place as usize];
            if qualities[usize::from(row.region)].is_none() {
                continue;
            }
            if let Some(distance) = pattern.distance(keys.text(key)) {
                ranks.push((place, distance, Reverse(row.weight())));
            }
        }
    }
    ranks.sort_unstable();
    ranks.dedup_by_key(|rank| rank.0);
    ranks.sort_unstable_by_key(|&(place, distance, weight)| (distance, weight, place));
    ranks.into_iter().take(limit).map(|(place, ..)| gazetteer.place(place as usize)).collect()
}

/// How many letters a name has, and which: names whose sketches are far from each other are, too.
struct Sketch {
    /// The bits of all letters.
    mask: u32,
    /// Their number, at most 255.
    count: u8,
}

impl Sketch {
    fn of(letters: impl Iterator<Item = char>) -> Self {
        let start = Self { mask: 0, count: 0 };
        letters.fold(start, |Self { mask, count }, letter| Self { mask: mask | bit(letter), count: count.saturating_add(1) })
    }
}

/// A name that others are compared with.
struct Pattern {
    letters: Vec<char>,
    sketch: Sketch,
    /// Largest distance that counts.
    most: usize,
}

impl Pattern {
    fn new(letters: Vec<char>, most: usize) -> Self {
        Self { sketch: Sketch::of(letters.iter().copied()), letters, most }
    }

    /// Whether a name of this sketch can be at a distance that counts.
    fn may_be_near(&self, other: &Sketch) -> bool {
        let own = &self.sketch;
        usize::from(own.count.abs_diff(other.count)) <= self.most
            && (other.mask & !own.mask).count_ones().max((own.mask & !other.mask).count_ones()) as usize <= self.most
    }

    /// Distance from `key`, if it is small enough.
    fn distance(&self, key: &str) -> Option<usize> {
        let key: Vec<char> = key.chars().collect();
        if key.len().abs_diff(self.letters.len()) > self.most {
            return None;
        }
        let width = key.len() + 1;
        // Rows of distances between beginnings: two before this one, one before, this.
        let (mut older, mut old, mut row) = (vec![usize::MAX; width], (0..width).collect::<Vec<_>>(), vec![0; width]);
        for (i, &letter) in self.letters.iter().enumerate() {
            row[0] = i + 1;
            for (j, &other) in key.iter().enumerate() {
                let replaced = old[j] + usize::from(letter != other);
                row[j + 1] = replaced.min(old[j + 1] + 1).min(row[j] + 1);
                if i > 0 && j > 0 && letter == key[j - 1] && self.letters[i - 1] == other {
                    row[j + 1] = row[j + 1].min(older[j - 1] + 1);
                }
            }
            if row.iter().all(|&distance| distance > self.most) {
                return None;
            }
            (older, old, row) = (old, row, older);
        }
        Some(old[width - 1]).filter(|&distance| distance <= self.most)
    }
}

/// One bit of 32 for a letter: letters of the alphabet have one each, others share the rest.
fn bit(letter: char) -> u32 {
    match letter {
        'a'..='z' => 1 << (letter as u32 - 'a' as u32),
        _ => 1 << (26 + letter as u32 % 6),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspelled_names_suggest_what_was_meant() {
        for (text, name) in [
            ("Stockhlom", "Stockholm"),
            ("Reykjavic", "Reykjavík"),
            ("Lodnon", "London"),
            ("new yrok", "New York City"),
            ("Stockhlom, Sweden", "Stockholm"),
            ("stockhlom sweden", "Stockholm"),
            ("Stockhlom, Sweeden", "Stockholm"),
            ("Santorni", "Santorini"),
            ("Stonehedge", "Stonehenge"),
            ("Icelnad", "Iceland"),
            ("Москвы", "Moscow"),
            ("Ulru", "Uluru"),
        ] {
            let found: Vec<_> = suggest(text, 3).iter().map(|place| place.name).collect();
            assert!(found.contains(&name), "{text}: {found:?}");
        }
    }

    #[test]
    fn nothing_near_suggests_nothing() {
        for text in ["", "x", "qqqqxxxxqq", "99", &"a".repeat(41), &"stockhlom ".repeat(100)] {
            assert!(suggest(text, 5).is_empty(), "{text}");
        }
        assert!(suggest("Stockhlom", 0).is_empty());
    }

    #[test]
    fn distances_are_those_of_optimal_string_alignment() {
        let distance = |one: &str, other: &str| Pattern::new(one.chars().collect(), 2).distance(other);
        for (one, other, expected) in [
            ("lund", "lund", Some(0)),
            ("lund", "lundt", Some(1)),
            ("lund", "lud", Some(1)),
            ("lund", "lnud", Some(1)),
            ("lund", "land", Some(1)),
            ("lund", "unld", Some(2)),
            ("lund", "oslo", None),
            ("ca", "abc", None),
        ] {
            assert_eq!((distance(one, other), distance(other, one)), (expected, expected), "{one} {other}");
        }
    }

    #[test]
    fn no_sketch_hides_a_name_that_is_near() {
        for (text, most) in [("stockhlom", 2), ("ulru", 1), ("москвы", 2), ("saint deniss", 2)] {
            let pattern = Pattern::new(text.chars().collect(), most);
            let keys = &GAZETTEER.keys;
            for key in 0..keys.starts.len() {
                let hidden = !pattern.may_be_near(&SKETCHES[key]);
                assert!(!hidden || pattern.distance(keys.text(key)).is_none(), "{text}: {}", keys.text(key));
            }
        }
    }
}
