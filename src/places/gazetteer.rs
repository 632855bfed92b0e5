//! The gazetteer: towns and villages of the world, countries, regions, islands and landmarks, and some observatories.
//!
//! `data/places.bin` has the places of GeoNames (CC BY 4.0, which must be credited) with at least 500 inhabitants or the seat of a
//! district, 22 observatories and the landmarks of `data/landmarks.txt`; `data/scripts/places.py` makes it and states its layout. A country stands where
//! its capital is, a region where its seat is, an island where its chief town is. Coordinates are rounded to 0.001 degrees,
//! elevations are those of GeoNames (surveyed, or of its elevation model with an error of some 10 m; the coarse map of the
//! heights where it has none), populations are within 3 %.

use super::fold::{fold, fold_onto};
use miniz_oxide::inflate::decompress_to_vec_zlib;
use std::sync::LazyLock;

const MAGIC: &[u8; 8] = b"SKYPLAC1";

/// Names of countries that people use beside the ones in the gazetteer, folded, and their codes.
pub(super) const OTHER_COUNTRY_NAMES: [(&str, &str); 32] = [
    ("usa", "us"),
    ("uk", "gb"),
    ("great britain", "gb"),
    ("britain", "gb"),
    ("united states of america", "us"),
    ("america", "us"),
    ("uae", "ae"),
    ("holland", "nl"),
    ("czech republic", "cz"),
    ("turkiye", "tr"),
    ("burma", "mm"),
    ("cape verde", "cv"),
    ("swaziland", "sz"),
    ("macedonia", "mk"),
    ("east timor", "tl"),
    ("congo", "cg"),
    ("congo brazzaville", "cg"),
    ("dr congo", "cd"),
    ("drc", "cd"),
    ("congo kinshasa", "cd"),
    ("korea", "kr"),
    ("republic of korea", "kr"),
    ("faroe", "fo"),
    ("faroes", "fo"),
    ("cote d ivoire", "ci"),
    ("cote d'ivoire", "ci"),
    ("cote divoire", "ci"),
    ("russian federation", "ru"),
    ("bosnia", "ba"),
    ("trinidad", "tt"),
    ("vatican", "va"),
    ("falklands", "fk"),
];

/// What kind of place it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlaceKind {
    /// A town, a village or a part of one.
    Town,
    /// An observatory.
    Observatory,
    /// A country, at its capital.
    Country,
    /// A state, province or county, at its seat.
    Region,
    /// An island, at its chief town.
    Island,
    /// A mountain, a building, a lake or the like.
    Landmark,
}

impl PlaceKind {
    /// Its name: "town", "observatory", "country", "region", "island" or "landmark".
    pub fn name(self) -> &'static str {
        match self {
            Self::Town => "town",
            Self::Observatory => "observatory",
            Self::Country => "country",
            Self::Region => "region",
            Self::Island => "island",
            Self::Landmark => "landmark",
        }
    }

    fn of(letter: u8) -> Option<Self> {
        Some(match letter {
            b't' => Self::Town,
            b'o' => Self::Observatory,
            b'c' => Self::Country,
            b'r' => Self::Region,
            b'i' => Self::Island,
            b'l' => Self::Landmark,
            _ => return None,
        })
    }

    /// Whether coordinates are called by it: places that have one point.
    pub(super) fn is_point(self) -> bool {
        matches!(self, Self::Town | Self::Observatory)
    }

    /// Whether it has the coordinates of a town.
    fn has_seat(self) -> bool {
        matches!(self, Self::Country | Self::Region | Self::Island)
    }
}

/// A place of the gazetteer.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NamedPlace {
    /// Its name, as GeoNames writes it: mostly that of its country's language, in Latin letters.
    pub name: &'static str,
    /// The state, province or county that it lies in; empty where none is known, and of countries and regions.
    pub region: &'static str,
    /// English name of the country.
    pub country: &'static str,
    /// Code of the country, two letters (ISO 3166-1).
    pub country_code: &'static str,
    /// What it is.
    pub kind: PlaceKind,
    /// The town whose coordinates, elevation and zone stand for a country (its capital), a region (its seat) or an island (its chief town); empty for others.
    pub seat: &'static str,
    /// Geodetic latitude, positive north [degrees], to 0.001.
    pub latitude_deg: f64,
    /// Longitude, positive east [degrees], to 0.001.
    pub longitude_deg: f64,
    /// Height above the sea [m].
    pub elevation_m: f64,
    /// Inhabitants, to two digits; `None` if unknown.
    pub population: Option<u32>,
    /// IANA time zone that GeoNames states. [`crate::time::zone_of_place`] finds the zone of any coordinates; near borders they may differ.
    pub time_zone: &'static str,
}

impl NamedPlace {
    /// Name, region and country, such as "Lund, Skåne, Sweden", and the town whose coordinates stand for it where one does: "Iceland (Reykjavík)".
    /// [`super::search`] for it finds the place, or a larger one that is called the same.
    pub fn label(&self) -> String {
        let mut label = self.name.to_string();
        for part in [self.region, self.country] {
            if !part.is_empty() && part != self.name {
                label.push_str(", ");
                label.push_str(part);
            }
        }
        if !self.seat.is_empty() {
            label.push_str(" (");
            label.push_str(self.seat);
            label.push(')');
        }
        label
    }
}

/// Number of places.
pub fn count() -> usize {
    GAZETTEER.rows.len()
}

pub(super) static GAZETTEER: LazyLock<Gazetteer> =
    LazyLock::new(|| Gazetteer::read(include_bytes!("../../data/places.bin")).expect("the embedded gazetteer is whole"));

/// All places, and their names as they are searched.
pub(super) struct Gazetteer {
    /// Names of all places, one after the other.
    names: String,
    countries: Vec<Country>,
    pub regions: Vec<Region>,
    zones: Vec<String>,
    pub rows: Vec<Row>,
    pub keys: Keys,
}

/// A place as it is kept.
pub(super) struct Row {
    name_end: u32,
    /// [0.001 degrees]
    pub latitude: i32,
    /// [0.001 degrees]
    pub longitude: i32,
    elevation_m: i16,
    zone: u16,
    pub region: u16,
    /// See [`population`].
    population: u8,
    pub kind: PlaceKind,
}

/// What an island or a country weighs at least among places of the same name: as a town of 200 000 inhabitants, 22 ln (200 000 / 300).
const LEAST_WEIGHT: u8 = 143;

/// What a landmark weighs: as a town of a million inhabitants, 22 ln (1 000 000 / 300).
const LANDMARK_WEIGHT: u8 = 178;

impl Row {
    /// How important it is, in codes of populations.
    pub fn weight(&self) -> u8 {
        match self.kind {
            PlaceKind::Town | PlaceKind::Observatory | PlaceKind::Region => self.population,
            PlaceKind::Country | PlaceKind::Island => self.population.max(LEAST_WEIGHT),
            PlaceKind::Landmark => LANDMARK_WEIGHT,
        }
    }
}

struct Country {
    code: String,
    /// Three letters.
    code3: String,
    name: String,
}

/// A region, with what it and its country may be called, folded.
pub(super) struct Region {
    name: String,
    country: u16,
    pub names: [String; 2],
    /// Codes, where they have letters: of the region; of the country, two and three letters.
    pub codes: [String; 3],
}

/// All names, folded: each is followed by a line break, and a line break stands before the first.
pub(super) struct Keys {
    pub text: String,
    /// Where each begins in the text.
    pub starts: Vec<u32>,
    /// Of which place each is the name.
    pub places: Vec<u32>,
}

impl Keys {
    /// The key of that index.
    pub fn text(&self, key: usize) -> &str {
        let end = self.starts.get(key + 1).map_or(self.text.len(), |&next| next as usize) - 1;
        &self.text[self.starts[key] as usize..end]
    }
}

impl Gazetteer {
    pub fn place(&'static self, index: usize) -> NamedPlace {
        let row = &self.rows[index];
        let region = &self.regions[usize::from(row.region)];
        let country = &self.countries[usize::from(region.country)];
        let is_whole = matches!(row.kind, PlaceKind::Country | PlaceKind::Region);
        NamedPlace {
            name: self.name(index),
            region: if is_whole { "" } else { &region.name },
            country: &country.name,
            country_code: &country.code,
            kind: row.kind,
            seat: if row.kind.has_seat() { self.seat(index) } else { "" },
            latitude_deg: f64::from(row.latitude) / 1000.0,
            longitude_deg: f64::from(row.longitude) / 1000.0,
            elevation_m: f64::from(row.elevation_m),
            population: population(row.population).filter(|_| row.kind.is_point()),
            time_zone: &self.zones[usize::from(row.zone)],
        }
    }

    fn name(&self, index: usize) -> &str {
        let start = if index == 0 { 0 } else { self.rows[index - 1].name_end };
        &self.names[start as usize..self.rows[index].name_end as usize]
    }

    /// The largest town with the coordinates of the place: it stands beside it, as rows are sorted by region and latitude.
    fn seat(&self, index: usize) -> &str {
        let here = &self.rows[index];
        let beside = |row: &&(usize, &Row)| (row.1.region, row.1.latitude) == (here.region, here.latitude);
        let before = self.rows[..index].iter().enumerate().rev();
        let after = self.rows.iter().enumerate().skip(index);
        let near = before.take_while(|row| beside(&row)).chain(after.take_while(|row| beside(&row)));
        let towns = near.filter(|(_, row)| row.kind == PlaceKind::Town && row.longitude == here.longitude);
        towns.max_by_key(|(_, row)| row.population).map_or("", |(index, _)| self.name(index))
    }

    fn read(bytes: &[u8]) -> Option<Self> {
        let content = decompress_to_vec_zlib(bytes.strip_prefix(MAGIC)?).ok()?;
        let mut bytes = Bytes(&content);
        let [countries, regions, zones, places] = [bytes.number()?, bytes.number()?, bytes.number()?, bytes.number()?];
        let countries: Vec<Country> =
            bytes.text()?.split('\n').map(Country::read).collect::<Option<Vec<_>>>().filter(of(countries))?;
        let regions: Vec<Region> = bytes
            .text()?
            .split('\n')
            .map(|line| Region::read(line, &countries))
            .collect::<Option<Vec<_>>>()
            .filter(of(regions))?;
        let zones: Vec<String> = Some(bytes.text()?.split('\n').map(str::to_string).collect()).filter(of(zones))?;
        let (names, others, kinds) = (bytes.text()?, bytes.text()?, bytes.text()?.as_bytes());
        let region_sizes: Vec<usize> = regions.iter().map(|_| bytes.number()).collect::<Option<_>>()?;
        let mut region_of = region_sizes.iter().enumerate().flat_map(|(region, &size)| std::iter::repeat_n(region as u16, size));
        let zone_of = bytes.take(2 * places)?;
        let [latitudes, longitudes, elevations] =
            [bytes.differences(places)?, bytes.differences(places)?, bytes.differences(places)?];
        let populations = bytes.take(places)?;
        let mut gazetteer = Self {
            names: String::with_capacity(names.len()),
            countries,
            regions,
            zones,
            rows: Vec::with_capacity(places),
            keys: Keys::with_capacity(names.len() + others.len(), places),
        };
        for (index, (name, others)) in names.split('\n').zip(others.split('\n')).enumerate() {
            gazetteer.names.push_str(name);
            for key in std::iter::once(name).chain(others.split('\t').filter(|other| !other.is_empty())) {
                gazetteer.keys.add(key, index);
            }
            let (kind, region) = (PlaceKind::of(*kinds.get(index)?)?, region_of.next()?);
            if kind == PlaceKind::Country {
                let code = &gazetteer.regions.get(usize::from(region))?.codes[1];
                let others = OTHER_COUNTRY_NAMES.iter().filter(|(_, other)| other == code);
                others.for_each(|(name, _)| gazetteer.keys.add(name, index));
            }
            gazetteer.rows.push(Row {
                name_end: gazetteer.names.len() as u32,
                latitude: *latitudes.get(index)?,
                longitude: *longitudes.get(index)?,
                elevation_m: i16::try_from(*elevations.get(index)?).ok()?,
                zone: u16::from_le_bytes([*zone_of.get(2 * index)?, *zone_of.get(2 * index + 1)?]),
                region,
                population: *populations.get(index)?,
                kind,
            });
        }
        let whole = gazetteer.rows.len() == places && bytes.0.is_empty();
        let zones_known = gazetteer.rows.iter().all(|row| usize::from(row.zone) < gazetteer.zones.len());
        (whole && zones_known).then_some(gazetteer)
    }
}

/// Whether there are as many as announced.
fn of<T>(count: usize) -> impl Fn(&Vec<T>) -> bool {
    move |list| list.len() == count
}

/// Inhabitants that a code stands for, 300 exp(code / 22), to two digits.
fn population(code: u8) -> Option<u32> {
    let inhabitants = 300.0 * (f64::from(code) / 22.0).exp();
    let unit = 10_f64.powf(inhabitants.log10().floor() - 1.0);
    (code > 0).then_some(((inhabitants / unit).round() * unit).round() as u32)
}

impl Country {
    fn read(line: &str) -> Option<Self> {
        let mut fields = line.split('\t').map(str::to_string);
        Some(Self { code: fields.next()?, code3: fields.next()?, name: fields.next()? })
    }
}

impl Region {
    fn read(line: &str, countries: &[Country]) -> Option<Self> {
        let mut fields = line.split('\t');
        let (country, code, name) = (fields.next()?, fields.next()?, fields.next()?);
        let index = countries.iter().position(|other| other.code == country)?;
        let Country { code: code2, code3, name: country } = &countries[index];
        let has_letters = code.chars().all(char::is_alphabetic);
        Some(Self {
            name: name.to_string(),
            country: index as u16,
            names: [fold(name), fold(country)],
            codes: [fold(if has_letters { code } else { "" }), fold(code2), fold(code3)],
        })
    }
}

impl Keys {
    fn with_capacity(bytes: usize, places: usize) -> Self {
        let mut text = String::with_capacity(bytes + bytes / 8);
        text.push('\n');
        Self { text, starts: Vec::with_capacity(2 * places), places: Vec::with_capacity(2 * places) }
    }

    fn add(&mut self, name: &str, place: usize) {
        self.starts.push(self.text.len() as u32);
        self.places.push(place as u32);
        fold_onto(name, &mut self.text);
        self.text.push('\n');
    }
}

/// What is left to read.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn number(&mut self) -> Option<usize> {
        Some(u32::from_le_bytes(self.take(4)?.try_into().ok()?) as usize)
    }

    fn text(&mut self) -> Option<&'a str> {
        let length = self.number()?;
        std::str::from_utf8(self.take(length)?).ok()
    }

    /// Sums of differences, each zigzag in groups of 7 bits.
    fn differences(&mut self, count: usize) -> Option<Vec<i32>> {
        let mut value = 0_i32;
        (0..count)
            .map(|_| {
                let (mut coded, mut shift) = (0_u32, 0);
                loop {
                    let byte = self.take(1)?[0];
                    coded |= u32::from(byte & 127).checked_shl(shift)?;
                    shift += 7;
                    if byte < 128 {
                        break;
                    }
                }
                value = value.checked_add((coded >> 1) as i32 ^ -((coded & 1) as i32))?;
                Some(value)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::search;
    use super::*;
    use crate::time::{Time, ZoneChoice};

    fn best(text: &str) -> NamedPlace {
        search(text, 1)[0]
    }

    #[test]
    fn lund_is_where_it_is() {
        let lund = best("Lund, Sweden");
        assert_eq!((lund.name, lund.region, lund.country, lund.country_code), ("Lund", "Skåne", "Sweden", "SE"));
        assert_eq!(lund.label(), "Lund, Skåne, Sweden");
        // checked against: GeoNames 2693678, 55.70584 N, 13.19321 E, 51 m, Europe/Stockholm
        assert_eq!((lund.latitude_deg, lund.longitude_deg, lund.elevation_m), (55.706, 13.193, 51.0));
        assert_eq!((lund.time_zone, lund.kind), ("Europe/Stockholm", PlaceKind::Town));
    }

    #[test]
    fn elevations_are_those_of_the_places_and_not_of_the_land_around() {
        // checked against: the towns' own statements and ESO: Denver 1609 m, Zermatt 1608, Leadville 3094, Jericho -258, Paranal 2635
        for (name, elevation_m, within_m) in [
            ("Denver", 1609.0, 10.0),
            ("Leadville, Colorado", 3094.0, 10.0),
            ("Zermatt", 1608.0, 20.0),
            ("Jericho", -258.0, 30.0),
            ("Paranal", 2635.0, 1.0),
        ] {
            let place = best(name);
            assert!((place.elevation_m - elevation_m).abs() <= within_m, "{place:?}");
        }
    }

    #[test]
    fn every_place_is_on_the_globe_and_in_a_zone_that_is_known() {
        assert!(count() > 150_000);
        assert!(GAZETTEER.rows.iter().all(|row| row.latitude.abs() <= 90_000 && row.longitude.abs() <= 180_000));
        for zone in &GAZETTEER.zones {
            Time::parse("2005-06-21T13:00", ZoneChoice::Named(zone)).unwrap();
        }
    }

    #[test]
    fn countries_regions_and_islands_are_where_their_towns_are() {
        for (name, label, kind) in [
            ("Iceland", "Iceland (Reykjavík)", PlaceKind::Country),
            ("Bali", "Bali, Indonesia (Denpasar)", PlaceKind::Region),
            ("Santorini", "Santorini, South Aegean, Greece (Firá)", PlaceKind::Island),
            ("Uluru", "Uluru, Australia", PlaceKind::Landmark),
        ] {
            let place = best(name);
            assert_eq!((place.label().as_str(), place.kind, place.population), (label, kind, None), "{place:?}");
            assert_eq!(best(label), place);
            if !place.seat.is_empty() {
                let town = best(&format!("{}, {}", place.seat, place.country));
                assert_eq!(
                    (town.latitude_deg, town.longitude_deg, town.elevation_m, town.time_zone),
                    (place.latitude_deg, place.longitude_deg, place.elevation_m, place.time_zone)
                );
            }
        }
        let all = || (0..count()).map(|index| GAZETTEER.place(index));
        assert!(all().filter(|place| place.kind.has_seat()).all(|place| !place.seat.is_empty()));
        let landmarks = all().filter(|place| place.kind == PlaceKind::Landmark);
        assert!(
            landmarks.filter(|place| crate::time::zone_of_place(place.latitude_deg, place.longitude_deg).is_ok()).count() > 100
        );
    }

    #[test]
    fn populations_keep_two_digits() {
        assert_eq!(population(0), None);
        for inhabitants in [500.0, 1234.0, 87_244.0, 2.5e6, 2.4e7_f64] {
            let code = (22.0 * (inhabitants / 300.0).ln()).round() as u8;
            let kept = f64::from(population(code).unwrap());
            // Half a step of the code, 2.3 %, and half a unit of the second digit, up to 5 % / 1.
            assert!((kept / inhabitants - 1.0).abs() < 0.06, "{inhabitants} {kept}");
        }
    }

    #[test]
    fn a_cut_file_is_not_taken_for_a_whole_one() {
        let bytes = include_bytes!("../../data/places.bin");
        assert!(Gazetteer::read(&bytes[..bytes.len() - 100]).is_none());
        assert!(Gazetteer::read(b"SKYPLAC0").is_none());
    }
}
