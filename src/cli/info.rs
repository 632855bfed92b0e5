//! `skyprobe info`: where the Sun is, its day, and the light that arrives.

use super::air_options::AirOptions;
use super::options::{ConfigOptions, PlaceOptions};
use super::{say, terminal};
use crate::ephemeris::{SunEvents, sun_events};
use crate::error::Result;
use crate::io::Config;
use crate::progress::Progress;
use crate::sky::Sky;
use crate::time::Time;
use clap::Args;
use serde_json::{Value, json};
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  The Sun over Ithaca, and how much light it sends through clear air:
    skyprobe info --lat 42.44 --lon -76.48 --time 2013-05-27T12:00
  The same for a program, without the light (which takes a second or two to solve):
    skyprobe info --lat 42.44 --lon -76.48 --time 2013-05-27T12:00 --no-light --json

Times are local, in the zone that is named. Sunrise and sunset are those of almanacs: centre of the Sun at -50 arcminutes,
level horizon. Twilights: civil to -6, nautical to -12, astronomical to -18 degrees.
";

/// Options of `skyprobe info`.
#[derive(Args)]
#[command(allow_negative_numbers = true, after_long_help = EXAMPLES, after_help = "Examples: skyprobe info --help")]
pub struct Options {
    #[command(flatten)]
    place: PlaceOptions,
    #[command(flatten)]
    air: AirOptions,
    /// Print JSON instead of text.
    #[arg(long)]
    json: bool,
    /// Leave out illuminance and irradiance, which need the light to be solved.
    #[arg(long)]
    no_light: bool,
    #[command(flatten)]
    config: ConfigOptions,
}

/// Prints the report.
pub fn run(options: &Options) -> Result<()> {
    let mut config = options.config.read()?;
    options.place.apply(&mut config)?;
    options.air.apply(&mut config)?;
    config.validate()?;
    if options.config.dump_config {
        return say(&config.to_json());
    }
    let sky = config.sky(Arc::new(options.config.atmosphere(&config)?))?;
    let events = match (sky.place(), sky.time()) {
        (Some(place), Some(time)) => Some(sun_events(place, time)?),
        _ => None,
    };
    let light = if options.no_light { None } else { Some(terminal::with_progress(|progress| Light::of(&sky, progress))?) };
    if options.json {
        return say(&format!("{:#}", as_json(&sky, &config, events.as_ref(), light.as_ref())));
    }
    say(&as_text(&sky, &config, events.as_ref(), light.as_ref()))
}

/// What arrives, in luminous and in radiant units.
struct Light {
    illuminance_lx: [f64; 3],
    irradiance_w_m2: [f64; 3],
    from_nm: f64,
    to_nm: f64,
}

/// The order of the values of [`Light`].
const KINDS: [&str; 3] = ["direct_normal", "direct_horizontal", "diffuse_horizontal"];

impl Light {
    fn of(sky: &Sky, progress: &Progress<'_>) -> Result<Self> {
        let lx = sky.illuminance(progress)?;
        let wavelengths_nm = &sky.atmosphere().profile().wavelengths_nm;
        let spectrum = sky.irradiance(wavelengths_nm, progress)?;
        let integral = |values: &[f64]| -> f64 {
            let steps = wavelengths_nm.windows(2).zip(values.windows(2));
            steps.map(|(nm, value)| (nm[1] - nm[0]) * 0.5 * (value[0] + value[1])).sum()
        };
        Ok(Self {
            illuminance_lx: [lx.direct_normal_lx, lx.direct_horizontal_lx, lx.diffuse_horizontal_lx],
            irradiance_w_m2: [
                integral(&spectrum.direct_normal),
                integral(&spectrum.direct_horizontal),
                integral(&spectrum.diffuse_horizontal),
            ],
            from_nm: wavelengths_nm[0],
            to_nm: wavelengths_nm[wavelengths_nm.len() - 1],
        })
    }
}

/// The events of a day in order, with their names.
fn named(events: &SunEvents) -> [(&'static str, Option<&Time>); 9] {
    [
        ("astronomical dawn", events.astronomical_dawn.as_ref()),
        ("nautical dawn", events.nautical_dawn.as_ref()),
        ("civil dawn", events.civil_dawn.as_ref()),
        ("sunrise", events.sunrise.as_ref()),
        ("solar noon", Some(&events.solar_noon)),
        ("sunset", events.sunset.as_ref()),
        ("civil dusk", events.civil_dusk.as_ref()),
        ("nautical dusk", events.nautical_dusk.as_ref()),
        ("astronomical dusk", events.astronomical_dusk.as_ref()),
    ]
}

/// Where the zone comes from.
fn zone_source(config: &Config, time: &Time) -> &'static str {
    match (&config.zone, time.zone_name()) {
        (Some(_), _) => "as given",
        (None, Some("UTC")) => "as the time says",
        (None, Some(_)) if config.time.as_deref().is_some_and(|text| text.contains('[')) => "as the time says",
        (None, Some(_)) => "found from the place",
        (None, None) => "offset as the time says",
    }
}

fn as_json(sky: &Sky, config: &Config, events: Option<&SunEvents>, light: Option<&Light>) -> Value {
    let sun = sky.sun();
    let mut report = json!({
        "sun": {
            "altitude_deg": sun.altitude_deg,
            "azimuth_deg": sun.azimuth_deg,
            "apparent_altitude_deg": sun.apparent_altitude_deg,
            "distance_au": sun.distance_au,
            "angular_diameter_deg": sun.angular_diameter_deg,
        },
        "elevation_m": sky.elevation_m(),
    });
    if let (Some(place), Some(time)) = (sky.place(), sky.time()) {
        report["place"] = json!({"latitude": place.latitude_deg, "longitude": place.longitude_deg});
        report["time"] = json!(time.to_string());
        report["zone"] = json!(time.zone_name());
        report["zone_source"] = json!(zone_source(config, time));
    }
    if let Some(events) = events {
        let times = named(events).into_iter().map(|(name, time)| (name.replace(' ', "_"), json!(time.map(Time::to_string))));
        report["events"] = Value::Object(times.collect());
        report["noon_altitude_deg"] = json!(events.noon_altitude_deg);
    }
    if let Some(light) = light {
        let table = |values: [f64; 3]| {
            let mut table = json!({"global_horizontal": values[1] + values[2]});
            KINDS.iter().zip(values).for_each(|(kind, value)| table[*kind] = json!(value));
            table
        };
        report["illuminance_lx"] = table(light.illuminance_lx);
        report["irradiance_w_m2"] = table(light.irradiance_w_m2);
        report["irradiance_range_nm"] = json!([light.from_nm, light.to_nm]);
    }
    report
}

fn as_text(sky: &Sky, config: &Config, events: Option<&SunEvents>, light: Option<&Light>) -> String {
    let sun = sky.sun();
    let mut lines = Vec::new();
    let mut line = |name: &str, text: String| lines.push(format!("{name:<20}{text}"));
    if let (Some(place), Some(time)) = (sky.place(), sky.time()) {
        let (north, east) = (place.latitude_deg, place.longitude_deg);
        let side = |value: f64, positive: char, negative: char| if value < 0.0 { negative } else { positive };
        line(
            "place",
            format!(
                "{:.4} deg {}, {:.4} deg {}, {} m",
                north.abs(),
                side(north, 'N', 'S'),
                east.abs(),
                side(east, 'E', 'W'),
                place.elevation_m
            ),
        );
        line("time", time.to_string());
        line("zone", format!("{} ({})", time.zone_name().unwrap_or("fixed offset"), zone_source(config, time)));
    }
    line("Sun's altitude", format!("{:.4} deg airless, {:.4} deg apparent", sun.altitude_deg, sun.apparent_altitude_deg));
    line("Sun's azimuth", format!("{:.4} deg from north through east", sun.azimuth_deg));
    line("Sun's distance", format!("{:.6} au", sun.distance_au));
    line("Sun's diameter", format!("{:.4} deg", sun.angular_diameter_deg));
    if let Some(events) = events {
        for (name, time) in named(events) {
            let missing = || "none on this day".to_string();
            let text = time.map_or_else(missing, |time| clock(time, sky.time()));
            let note =
                if name == "solar noon" { format!("  (altitude {:.3} deg)", events.noon_altitude_deg) } else { String::new() };
            line(name, text + &note);
        }
        if events.sunrise.is_none() && events.sunset.is_none() {
            line("", if events.noon_altitude_deg > 0.0 { "the Sun does not set" } else { "the Sun does not rise" }.to_string());
        }
    }
    if let Some(light) = light {
        let unit_of_radiation = format!("W m-2 ({:.0}-{:.0} nm)", light.from_nm, light.to_nm);
        for (title, values, unit) in
            [("illuminance", light.illuminance_lx, "lx"), ("irradiance", light.irradiance_w_m2, unit_of_radiation.as_str())]
        {
            line(title, format!("global {} {unit} on the horizontal", rounded(values[1] + values[2])));
            line("", format!("direct {} {unit} on the horizontal, {} facing the Sun", rounded(values[1]), rounded(values[0])));
            line("", format!("diffuse {} {unit} on the horizontal", rounded(values[2])));
        }
    }
    lines.join("\n")
}

/// The time of day, with the date if it is not that of `today`.
fn clock(time: &Time, today: Option<&Time>) -> String {
    let civil = time.civil();
    let clock = format!("{:02}:{:02}:{:02.0}", civil.hour, civil.minute, civil.second);
    let same_day = today.map(Time::civil).is_some_and(|t| (t.year, t.month, t.day) == (civil.year, civil.month, civil.day));
    if same_day { clock } else { format!("{clock}  ({:04}-{:02}-{:02})", civil.year, civil.month, civil.day) }
}

/// Four significant digits.
fn rounded(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let digits = 3 - value.abs().log10().floor() as i32;
    if digits > 6 { format!("{value:.3e}") } else { format!("{value:.*}", digits.max(0) as usize) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_four_digits() {
        let cases = [(93_412.4, "93412"), (12.345_6, "12.35"), (0.012_345, "0.01235"), (0.0, "0"), (1.234_4e-9, "1.234e-9")];
        for (value, text) in cases {
            assert_eq!(rounded(value), text);
        }
    }
}
