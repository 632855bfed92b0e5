//! Finding places by what a person types, at every key stroke.
//!
//! A text is read as a name, or as the beginning of one, and as region and country that it must lie in: after commas, or as the last words:
//! "Lund, Sweden", "lund se", "portland, maine, usa". Places are ordered by how exactly their name is met (the whole name, its beginning, a
//! word within it), then by how exactly region or country is, then by their number of inhabitants.

use super::fold::fold;
use super::gazetteer::{GAZETTEER, Gazetteer, NamedPlace, OTHER_COUNTRY_NAMES, Region};
use memchr::memmem;
use std::cmp::Reverse;

/// Words that are written in two ways at the beginning of names.
const ABBREVIATIONS: [(&str, &str); 5] = [("st", "saint"), ("ste", "sainte"), ("mt", "mount"), ("ft", "fort"), ("pt", "point")];

/// Letters that are written for one with an accent.
const DIGRAPHS: [(&str, &str); 4] = [("oe", "o"), ("ae", "a"), ("ue", "u"), ("aa", "a")];

/// Great cities have many other names, which would come before every main name while one types: their beginnings count as if the city had a twentieth of
/// its inhabitants, in codes of the gazetteer: 22 ln 20.
const OTHER_NAME_CODES: u8 = 66;

/// How exactly a name is met: smaller is better.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Exactness {
    Whole,
    Beginning,
    Within,
}

/// Whether region or country is only begun without a comma, which any two words of a name may seem to be; how exactly the name is met; how exactly region
/// or country; inhabitants; the place.
type Rank = (bool, Exactness, u8, Reverse<u8>, u32);

/// Longest text that is searched [bytes], and in how many parts and words at most: main names have up to 12 words, and the work grows with all three.
const LONGEST_TEXT: usize = 200;
const MOST_PARTS: usize = 7;
const MOST_WORDS: usize = 16;

/// Most words at the end of the first part that may be region and country.
const MOST_LAST_WORDS: usize = 8;

/// Places whose name, or another name, matches `text`: the best first, at most `limit`. Takes up to 3 ms, 5 ms for a single letter; the first time some 0.1 s.
///
/// Case, accents and hyphens do not count: "goteborg" finds Göteborg, and so does "gothenburg". Words may be begun only: "los ang". Region
/// and country may follow the name, by name, by its beginning or by code; after a comma one letter will do, without it a code or
/// three letters. An empty text finds nothing, and neither does one of more than 200 bytes, 16 words or 6 commas.
pub fn search(text: &str, limit: usize) -> Vec<NamedPlace> {
    let found = search_all(text, limit);
    // Labels have the town that stands for a country or an island in brackets.
    match text.split_once(" (") {
        Some((before, _)) if found.is_empty() => search_all(before, limit),
        _ => found,
    }
}

/// Name and what follows it after commas, folded; `None` if there is nothing, or more than anyone writes.
pub(super) fn parts(text: &str) -> Option<(String, Vec<String>)> {
    if text.len() > LONGEST_TEXT {
        return None;
    }
    let mut parts = text.split(',').map(fold).filter(|part| !part.is_empty());
    let (name, after_commas) = (parts.next()?, parts.collect::<Vec<_>>());
    let mut words = std::iter::once(&name).chain(&after_commas).map(|part| part.split(' ').count());
    (after_commas.len() < MOST_PARTS && words.all(|count| count <= MOST_WORDS)).then_some((name, after_commas))
}

fn search_all(text: &str, limit: usize) -> Vec<NamedPlace> {
    let gazetteer = &*GAZETTEER;
    let Some((name, after_commas)) = parts(text) else { return Vec::new() };
    let words: Vec<&str> = name.split(' ').collect();
    let mut ranks = Vec::new();
    let fewest = words.len().saturating_sub(MOST_LAST_WORDS).max(1);
    for (name, last_words) in (fewest..=words.len()).map(|count| words.split_at(count)) {
        let Some(qualities) = qualities(gazetteer, last_words, &after_commas) else { continue };
        for variant in variants(name) {
            match_names(gazetteer, &variant, &qualities, &mut |exactness, quality, population, place| {
                ranks.push((!last_words.is_empty() && quality > 0, exactness, quality, Reverse(population), place));
            });
        }
    }
    best(ranks, limit).into_iter().map(|index| gazetteer.place(index as usize)).collect()
}

/// The places of the `count` best ranks, each once, the best first.
fn best(mut ranks: Vec<Rank>, count: usize) -> Vec<u32> {
    // A place may be met by several of its names: the best counts.
    ranks.sort_unstable_by_key(|&(is_begun, exactness, quality, population, place)| {
        (place, is_begun, exactness, quality, population)
    });
    ranks.dedup_by_key(|&mut (.., place)| place);
    if count < ranks.len() {
        ranks.select_nth_unstable(count);
        ranks.truncate(count);
    }
    ranks.sort_unstable();
    ranks.into_iter().map(|(.., place)| place).collect()
}

/// The words as they are, and as they would be written otherwise.
fn variants(words: &[&str]) -> Vec<String> {
    let plain = words.join(" ");
    let undone = DIGRAPHS.iter().fold(plain.clone(), |text, (two, one)| text.replace(two, one));
    let swapped: Vec<&str> = words
        .iter()
        .map(|&word| {
            let other = ABBREVIATIONS.iter().find_map(|&(short, long)| match word {
                _ if word == short => Some(long),
                _ if word == long => Some(short),
                _ => None,
            });
            other.unwrap_or(word)
        })
        .collect();
    let mut variants = vec![plain];
    for other in [undone, swapped.join(" ")] {
        if !variants.contains(&other) {
            variants.push(other);
        }
    }
    variants
}

/// Calls `found` for each name that is met by `wanted` of a place in a region of any quality: exactness, quality, code of the population, place.
fn match_names(gazetteer: &Gazetteer, wanted: &str, qualities: &[Option<u8>], found: &mut impl FnMut(Exactness, u8, u8, u32)) {
    let keys = &gazetteer.keys;
    let words: Vec<&str> = wanted.split(' ').collect();
    let mut key = 0;
    for at in memmem::find_iter(keys.text.as_bytes(), words[0].as_bytes()) {
        if !matches!(keys.text.as_bytes()[at - 1], b'\n' | b' ') {
            continue;
        }
        while keys.starts.get(key + 1).is_some_and(|&start| start as usize <= at) {
            key += 1;
        }
        let place = keys.places[key];
        let row = &gazetteer.rows[place as usize];
        let Some(quality) = qualities[usize::from(row.region)] else { continue };
        let end = keys.starts[key] as usize + keys.text(key).len();
        if let Some(exactness) = exactness(&keys.text[at..end], &words, at == keys.starts[key] as usize) {
            let is_main_name = key == 0 || keys.places[key - 1] != place;
            let counts_in_full = is_main_name || exactness == Exactness::Whole;
            let population = row.weight().saturating_sub(if counts_in_full { 0 } else { OTHER_NAME_CODES });
            found(exactness, quality, population, place);
        }
    }
}

/// How exactly `key`, from the word on in which the first of `words` begins, is met by `words`: each must begin one of its words, in order.
fn exactness(key: &str, words: &[&str], from_start: bool) -> Option<Exactness> {
    let mut rest = key.split(' ');
    let (mut whole, mut gapless) = (true, true);
    for (index, word) in words.iter().enumerate() {
        let (skipped, met) = rest.by_ref().enumerate().find(|(_, part)| part.starts_with(word))?;
        gapless &= skipped == 0;
        whole &= met == *word;
        // Only the last word may still be typed.
        gapless &= met == *word || index + 1 == words.len();
    }
    Some(match (from_start && gapless, whole && rest.next().is_none()) {
        (true, true) => Exactness::Whole,
        (true, false) => Exactness::Beginning,
        (false, _) => Exactness::Within,
    })
}

/// For each region how exactly it, or its country, is what was asked for; `None` for the whole if none is.
pub(super) fn qualities(gazetteer: &Gazetteer, last_words: &[&str], after_commas: &[String]) -> Option<Vec<Option<u8>>> {
    let mut wanted: Vec<Wanted> = after_commas.iter().map(|part| Wanted::new(&part.split(' ').collect::<Vec<_>>(), 1)).collect();
    if !last_words.is_empty() {
        wanted.push(Wanted::new(last_words, 3));
    }
    let quality = |region: &Region| wanted.iter().try_fold(0, |worst: u8, wanted| Some(worst.max(wanted.quality(region)?)));
    let qualities: Vec<Option<u8>> = gazetteer.regions.iter().map(quality).collect();
    qualities.iter().any(Option::is_some).then_some(qualities)
}

/// Region or country, or both, that a place must lie in.
struct Wanted {
    whole: Phrase,
    /// The words cut in two, for region and country.
    pairs: Vec<(Phrase, Phrase)>,
}

impl Wanted {
    /// Beginnings have at least `shortest` letters.
    fn new(words: &[&str], shortest: usize) -> Self {
        let phrase = |words: &[&str]| Phrase::new(words.join(" "), shortest);
        let pairs = (1..words.len()).map(|at| (phrase(&words[..at]), phrase(&words[at..]))).collect();
        Self { whole: phrase(words), pairs }
    }

    /// 0 if it is name or code of the region or of its country, or both in this order; 1 if it is the beginning of a name; `None` otherwise.
    fn quality(&self, region: &Region) -> Option<u8> {
        let whole = self.whole.of_region(region).into_iter().chain(self.whole.of_country(region)).min();
        whole.or_else(|| {
            self.pairs.iter().find_map(|(in_region, in_country)| {
                let of_region = in_region.of_region(region)?;
                Some(of_region.max(in_country.of_country(region)?))
            })
        })
    }
}

/// Words that may be a region or a country.
struct Phrase {
    text: String,
    may_be_begun: bool,
    /// Code of the country that is also called so.
    other_country: Option<&'static str>,
}

impl Phrase {
    fn new(text: String, shortest: usize) -> Self {
        let other_country = OTHER_COUNTRY_NAMES.iter().find(|(name, _)| *name == text).map(|&(_, code)| code);
        Self { may_be_begun: text.chars().count() >= shortest, other_country, text }
    }

    fn of_region(&self, region: &Region) -> Option<u8> {
        self.quality(&region.names[0], &region.codes[..1])
    }

    fn of_country(&self, region: &Region) -> Option<u8> {
        match self.other_country {
            Some(code) if region.codes[1] == code => Some(0),
            _ => self.quality(&region.names[1], &region.codes[1..]),
        }
    }

    fn quality(&self, name: &str, codes: &[String]) -> Option<u8> {
        let text = self.text.as_str();
        if text == name || codes.iter().any(|code| code == text) {
            return Some(0);
        }
        if !self.may_be_begun || text.len() > name.len() {
            return None;
        }
        // The beginning of any word: "götaland" for Västra Götaland.
        let begins = name.starts_with(text) || name.match_indices(text).any(|(at, _)| name.as_bytes()[at - 1] == b' ');
        begins.then_some(1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(text: &str, limit: usize) -> Vec<String> {
        search(text, limit).iter().map(NamedPlace::label).collect()
    }

    fn country_of(text: &str) -> (&'static str, &'static str) {
        let place = search(text, 1)[0];
        (place.name, place.country_code)
    }

    #[test]
    fn accents_and_case_do_not_count() {
        for (text, name, country) in [
            ("malmo", "Malmö", "SE"),
            ("MALMÖ", "Malmö", "SE"),
            ("sao paulo", "São Paulo", "BR"),
            ("lodz", "Łódź", "PL"),
            ("tromso", "Tromsø", "NO"),
            ("duesseldorf", "Düsseldorf", "DE"),
        ] {
            assert_eq!(country_of(text), (name, country), "{text}");
        }
    }

    #[test]
    fn other_names_are_known() {
        for (text, country) in [
            ("München", "DE"),
            ("Munich", "DE"),
            ("Gothenburg", "SE"),
            ("Göteborg", "SE"),
            ("goteborg", "SE"),
            ("koeln", "DE"),
            ("København", "DK"),
            ("Wien", "AT"),
            ("Praha", "CZ"),
            ("Firenze", "IT"),
            ("Cologne", "DE"),
            ("東京", "JP"),
            ("Москва", "RU"),
            ("القاهرة", "EG"),
            ("Αθήνα", "GR"),
            ("서울", "KR"),
        ] {
            assert_eq!(country_of(text).1, country, "{text}");
        }
    }

    #[test]
    fn region_and_country_restrict() {
        for (text, label) in [
            ("lund", "Lund, Skåne, Sweden"),
            ("lund se", "Lund, Skåne, Sweden"),
            ("Lund, Sweden", "Lund, Skåne, Sweden"),
            ("lund, skåne, sweden", "Lund, Skåne, Sweden"),
            ("lund skane sweden", "Lund, Skåne, Sweden"),
            ("portland", "Portland, Oregon, United States"),
            ("portland, maine", "Portland, Maine, United States"),
            ("portland me", "Portland, Maine, United States"),
            ("portland, me, usa", "Portland, Maine, United States"),
            ("paris", "Paris, Île-de-France, France"),
            ("paris texas", "Paris, Texas, United States"),
            ("san jose ca", "San Jose, California, United States"),
            ("san jose cr", "San José, San José, Costa Rica"),
            ("york uk", "York, England, United Kingdom"),
            ("london, canada", "London, Ontario, Canada"),
            ("lund, s", "Lund, Skåne, Sweden"),
        ] {
            assert_eq!(
                labels(text, 1).first().map_or("", String::as_str),
                label.replace("San José, San José", "San José"),
                "{text}"
            );
        }
        assert!(search("lund, japan", 5).is_empty());
        assert!(search("lund, kenya", 5).is_empty());
    }

    #[test]
    fn exact_names_come_first_then_the_largest() {
        let york = labels("york", 30);
        assert_eq!(york[0], "York, England, United Kingdom");
        assert!(york.iter().position(|label| label.starts_with("New York")).is_none_or(|at| at > 5), "{york:?}");
        assert_eq!(search("los ang", 1)[0].name, "Los Angeles");
        // Angeles in the Philippines before Los Angeles.
        assert_eq!(country_of("angeles").1, "PH");
        assert!(search("janeiro", 5).iter().any(|place| place.name == "Rio de Janeiro"));
        assert_eq!(search("rio janeiro", 1)[0].name, "Rio de Janeiro");
        assert_eq!(country_of("st petersburg, russia"), ("Saint Petersburg", "RU"));
        assert_eq!(country_of("mount isa").1, "AU");
        assert_eq!(country_of("mt isa").1, "AU");
    }

    #[test]
    fn what_is_typed_begins_main_names_before_other_names_of_greater_cities() {
        for (text, name) in [("mil", "Milan"), ("new y", "New York City"), ("par", "Paris"), ("reyk", "Reykjavík")] {
            let found = labels(text, 3);
            assert!(found.iter().any(|label| label.starts_with(name)), "{text}: {found:?}");
        }
        // But other names are there, too: København.
        assert!(search("koben", 3).iter().any(|place| place.name == "Copenhagen"));
    }

    #[test]
    fn observatories_are_found() {
        for (text, name) in [
            ("paranal", "Paranal Observatory"),
            ("mauna kea", "Mauna Kea Observatories"),
            ("kitt peak", "Kitt Peak National Observatory"),
            ("hanle, india", "Indian Astronomical Observatory"),
        ] {
            assert!(search(text, 3).iter().any(|place| place.name == name), "{text}: {:?}", labels(text, 3));
        }
    }

    #[test]
    fn a_name_being_typed_finds_more_and_more_exactly() {
        let found = |text: &str| search(text, 20).iter().position(|place| place.name == "Reykjavík");
        assert!(found("reyk").is_some());
        assert!(found("reykj") <= found("reyk"));
        assert_eq!(found("reykjavik"), Some(0));
    }

    #[test]
    fn nothing_is_found_for_nothing_and_no_more_than_asked() {
        assert!(search("", 10).is_empty());
        assert!(search(" , ,", 10).is_empty());
        assert!(search("qqqqxxxx", 10).is_empty());
        assert!(search("lund", 0).is_empty());
        assert_eq!(search("a", 7).len(), 7);
    }

    /// A place is found by its label, or one is that has the same label and at least as many inhabitants.
    #[test]
    fn a_label_finds_its_place() {
        let gazetteer = &*GAZETTEER;
        for index in (0..gazetteer.rows.len()).step_by(977) {
            let place = gazetteer.place(index);
            let found = search(&place.label(), 1);
            let found = found.first().unwrap_or_else(|| panic!("{} finds nothing", place.label()));
            let as_good = fold(&found.label()) == fold(&place.label()) || found.population >= place.population;
            assert!(as_good && found.country == place.country, "{} finds {}", place.label(), found.label());
        }
    }

    #[test]
    fn countries_islands_and_landmarks_are_found_before_villages() {
        for (text, name, country) in [
            ("Santorini", "Santorini", "GR"),
            ("thera", "Santorini", "GR"),
            ("bora bora", "Bora Bora", "PF"),
            ("bora-bora", "Bora Bora", "PF"),
            ("Uluru", "Uluru", "AU"),
            ("ayers rock", "Uluru", "AU"),
            ("stonehenge", "Stonehenge", "GB"),
            ("Iceland", "Iceland", "IS"),
            ("Bali", "Bali", "ID"),
            ("hawaii", "Hawaii", "US"),
            ("Sicily", "Sicily", "IT"),
            ("tasmania", "Tasmania", "AU"),
            ("Greenland", "Greenland", "GL"),
            ("japan", "Japan", "JP"),
            ("easter island", "Easter Island", "CL"),
            ("rapa nui", "Easter Island", "CL"),
            ("Mallorca", "Mallorca", "ES"),
            ("isle of skye", "Skye", "GB"),
            ("mount everest", "Mount Everest", "NP"),
            ("machu picchu", "Machu Picchu", "PE"),
            ("south pole", "South Pole", "AQ"),
            ("usa", "United States", "US"),
            ("uk", "United Kingdom", "GB"),
            ("holland", "The Netherlands", "NL"),
            ("czech republic", "Czechia", "CZ"),
            ("congo", "Republic of the Congo", "CG"),
            ("DR Congo", "Democratic Republic of the Congo", "CD"),
            ("korea", "South Korea", "KR"),
            ("Faroe", "Faroe Islands", "FO"),
            ("Côte d'Ivoire", "Ivory Coast", "CI"),
            ("kilimanjaro", "Kilimanjaro", "TZ"),
            ("borneo", "Borneo", "ID"),
            ("antarctica", "South Pole", "AQ"),
            // A town that a region or country is called after is meant.
            ("new york", "New York City", "US"),
            ("luxembourg", "Luxembourg", "LU"),
            ("quebec", "Québec", "CA"),
            ("washington", "Washington", "US"),
        ] {
            assert_eq!(country_of(text), (name, country), "{text}: {:?}", labels(text, 5));
        }
    }

    #[test]
    fn a_landmark_comes_before_a_region_of_its_name() {
        assert_eq!(search("kilimanjaro", 1)[0].elevation_m, 5895.0);
    }

    #[test]
    fn more_than_anyone_writes_finds_nothing() {
        assert!(search(&"lund ".repeat(17), 5).is_empty());
        assert!(search(&"lund,".repeat(8), 5).is_empty());
        assert!(search(&"l".repeat(201), 5).is_empty());
        assert!(search(&"9 ".repeat(40_000), 5).is_empty());
        assert_eq!(search("lund,,,,,,,sweden", 1)[0].name, "Lund");
    }

    proptest! {
        /// Words that begin regions and countries are the most work: each may end the name.
        #[test]
        fn the_work_is_bounded(words in proptest::collection::vec("(san|new|sou|uni|north|st|a|de|[a-z]{1,3}|[0-9]{1,4}|e\u{301}{1,9})[ ,-]?", 1..400)) {
            prop_assert!(search(&words.concat(), 3).len() <= 3);
            prop_assert!(search(&words.join(" "), 3).len() <= 3);
            prop_assert!(super::super::suggest(&words.join(" "), 3).len() <= 3);
        }

        #[test]
        fn no_text_brings_the_search_down(text in ".{0,40}") {
            prop_assert!(search(&text, 3).len() <= 3);
        }
    }
}
