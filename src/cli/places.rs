//! `skyprobe places`: which places a name may mean, and what is known of coordinates.

use super::answer;
use crate::error::Result;
use crate::places::{Coordinates, Location, NamedPlace, locate, search};
use crate::time::zone_of_place;
use clap::Args;
use serde_json::{Value, json};

const EXAMPLES: &str = "\
Examples:
  Places that are called Portland, the largest first; the one in Maine:
    skyprobe places portland
    skyprobe places portland, maine
  The nearest place, the rough height of the land and the time zone of coordinates in any spelling:
    skyprobe places 33 52 S 151 12 E
    skyprobe places https://www.openstreetmap.org/#map=12/55.71/13.19

Names are those of GeoNames (geonames.org, CC BY 4.0): towns and villages from 500 inhabitants on, countries and regions (where their capitals are); and islands,
landmarks, observatories. A name that is not found has the nearest spellings in the message.
";

/// Options of `skyprobe places`.
#[derive(Args)]
#[command(allow_negative_numbers = true, after_long_help = EXAMPLES, after_help = "Examples: skyprobe places --help")]
pub struct Options {
    /// Name, or its beginning, with region or country after it; or coordinates. Several words need no quotes.
    #[arg(required = true, value_name = "NAME")]
    text: Vec<String>,
    /// How many places to list at most, 1 to 1000.
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u16).range(1..=1000))]
    limit: u16,
    /// Print JSON instead of text.
    #[arg(long)]
    json: bool,
}

/// Prints the list.
pub fn run(options: &Options) -> Result<()> {
    let text = options.text.join(" ");
    // Says what is wrong with a text that is neither name nor coordinates.
    let location = locate(&text)?;
    let rows = match location.place {
        Some(_) => search(&text, options.limit.into()).into_iter().map(Row::of_place).collect(),
        None => vec![Row::of_coordinates(&location)?],
    };
    if options.json {
        return answer(&format!("{:#}", rows.iter().map(Row::as_json).collect::<Value>()));
    }
    let width = rows.iter().map(|row| row.label.chars().count()).max().unwrap_or(0);
    let coordinates = rows.iter().map(|row| row.coordinates.to_string().len()).max().unwrap_or(0);
    let lines: Vec<String> = rows.iter().map(|row| row.as_text(width, coordinates)).collect();
    answer(&lines.join("\n"))
}

/// What is told of a place.
struct Row {
    label: String,
    coordinates: Coordinates,
    elevation_m: f64,
    zone: &'static str,
    place: Option<NamedPlace>,
}

impl Row {
    fn of_place(place: NamedPlace) -> Self {
        Self {
            label: place.label(),
            coordinates: Coordinates { latitude_deg: place.latitude_deg, longitude_deg: place.longitude_deg },
            elevation_m: place.elevation_m,
            zone: place.time_zone,
            place: Some(place),
        }
    }

    fn of_coordinates(location: &Location) -> Result<Self> {
        let Location { latitude_deg, longitude_deg, elevation_m, .. } = *location;
        Ok(Self {
            label: location.label.clone(),
            coordinates: Coordinates { latitude_deg, longitude_deg },
            elevation_m,
            zone: zone_of_place(latitude_deg, longitude_deg)?,
            place: None,
        })
    }

    fn as_text(&self, label_width: usize, coordinates_width: usize) -> String {
        let Self { label, coordinates, elevation_m, zone, place } = self;
        let inhabitants = match place {
            Some(NamedPlace { population: Some(population), .. }) => format!("{population:>9} inhabitants  "),
            Some(_) => " ".repeat(23),
            None => String::new(),
        };
        let coordinates = coordinates.to_string();
        format!("{label:<label_width$}  {coordinates:<coordinates_width$}  {elevation_m:>5.0} m  {inhabitants}{zone}")
    }

    fn as_json(&self) -> Value {
        json!({
            "label": self.label,
            "name": self.place.map(|place| place.name),
            "region": self.place.map(|place| place.region),
            "country": self.place.map(|place| place.country),
            "kind": self.place.map(|place| place.kind.name()),
            "country_code": self.place.map(|place| place.country_code),
            "latitude": self.coordinates.latitude_deg,
            "longitude": self.coordinates.longitude_deg,
            "elevation_m": self.elevation_m,
            "population": self.place.and_then(|place| place.population),
            "time_zone": self.zone,
        })
    }
}
