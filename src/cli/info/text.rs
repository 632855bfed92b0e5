//! The report as text, for people.

use super::{Day, Light, Report, is_up, named, zone_source};
use crate::ephemeris::{Bodies, Body, RiseAndSet};
use crate::time::Time;

/// Lines of a name and what there is to say.
#[derive(Default)]
struct Lines(Vec<String>);

impl Lines {
    fn add(&mut self, name: &str, text: impl AsRef<str>) {
        self.0.push(format!("{name:<20}{}", text.as_ref()).trim_end().to_string());
    }
}

impl Report<'_> {
    pub(super) fn as_text(&self) -> String {
        let mut lines = Lines::default();
        self.add_place(&mut lines);
        let sun = self.sky.sun();
        lines
            .add("Sun's altitude", format!("{:.4} deg airless, {:.4} deg apparent", sun.altitude_deg, sun.apparent_altitude_deg));
        lines.add("Sun's azimuth", format!("{:.4} deg from north through east", sun.azimuth_deg));
        lines.add("Sun's distance", format!("{:.6} au", sun.distance_au));
        lines.add("Sun's diameter", format!("{:.4} deg", sun.angular_diameter_deg));
        if let (Some(day), Some(bodies)) = (&self.day, self.sky.bodies_of_place()) {
            self.add_sun_day(&mut lines, day);
            self.add_moon_day(&mut lines, day, bodies);
            add_eclipses(&mut lines, bodies);
            add_table(&mut lines, bodies);
        }
        if let Some(light) = &self.light {
            self.add_light(&mut lines, light);
        }
        lines.0.join("\n")
    }

    fn add_place(&self, lines: &mut Lines) {
        let (Some(place), Some(time)) = (self.sky.place(), self.sky.time()) else { return };
        let (north, east) = (place.latitude_deg, place.longitude_deg);
        let side = |value: f64, positive: char, negative: char| if value < 0.0 { negative } else { positive };
        if let Some(label) = &self.config.place_label {
            lines.add("place", label);
        }
        lines.add(
            if self.config.place_label.is_some() { "" } else { "place" },
            format!(
                "{:.4} deg {}, {:.4} deg {}, {} m",
                north.abs(),
                side(north, 'N', 'S'),
                east.abs(),
                side(east, 'E', 'W'),
                place.elevation_m
            ),
        );
        lines.add("time", time.to_string());
        if let Some(notice) = time.notice() {
            lines.add("", notice);
        }
        lines.add("zone", format!("{} ({})", time.zone_name().unwrap_or("fixed offset"), zone_source(self.config, time)));
    }

    fn clock(&self, time: Option<&Time>) -> String {
        time.map_or_else(|| "none on this day".to_string(), |time| clock(time, self.sky.time()))
    }

    fn add_sun_day(&self, lines: &mut Lines, day: &Day) {
        let events = &day.sun;
        for (name, time) in named(events) {
            let note =
                if name == "solar noon" { format!("  (altitude {:.3} deg)", events.noon_altitude_deg) } else { String::new() };
            lines.add(name, self.clock(time) + &note);
        }
        if events.sunrise.is_none() && events.sunset.is_none() {
            lines.add("", if events.noon_altitude_deg > 0.0 { "the Sun does not set" } else { "the Sun does not rise" });
        }
    }

    fn add_moon_day(&self, lines: &mut Lines, day: &Day, bodies: &Bodies) {
        let moon = &bodies.moon;
        lines.add(
            "Moon",
            format!(
                "{}, {:.1} % lit, {:.1} deg from the Sun, {:.0} km away",
                day.phase(),
                100.0 * moon.illumination.illuminated_fraction,
                moon.illumination.elongation_deg,
                moon.distance_km()
            ),
        );
        let RiseAndSet { rise, transit, transit_altitude_deg, set, up_at_midnight } = &day.moon;
        let note = transit_altitude_deg.map_or_else(String::new, |altitude| format!("  (altitude {altitude:.3} deg)"));
        lines.add("Moon's rise", self.clock(rise.as_ref()));
        lines.add("Moon's transit", self.clock(transit.as_ref()) + &note);
        lines.add("Moon's set", self.clock(set.as_ref()));
        if rise.is_none() && set.is_none() {
            lines.add("", if *up_at_midnight { "the Moon does not set" } else { "the Moon does not rise" });
        }
        for (index, (phase, time)) in day.phases.iter().enumerate() {
            let civil = time.civil();
            let date = format!("{:04}-{:02}-{:02}", civil.year, civil.month, civil.day);
            let name = if index == 0 { "Moon's next phases" } else { "" };
            lines.add(name, format!("{:<14}{date} {}", phase.name(), clock(time, Some(time))));
        }
    }

    fn add_light(&self, lines: &mut Lines, light: &Light) {
        let lx = &light.illuminance;
        lines.add("illuminance", format!("global {} lx on the horizontal", rounded(lx.global_horizontal_lx)));
        let facing = |lines: &mut Lines, what: &str, values: [f64; 2], unit: &str, whom: &str| {
            let [horizontal, normal] = values.map(rounded);
            lines.add("", format!("{what} {horizontal} {unit} on the horizontal, {normal} facing the {whom}"));
        };
        facing(lines, "direct", [lx.direct_horizontal_lx, lx.direct_normal_lx], "lx", "Sun");
        if self.sky.bodies_of_place().is_some() {
            facing(lines, "Moon", [lx.moon_horizontal_lx, lx.moon_normal_lx], "lx", "Moon");
        }
        lines.add("", format!("diffuse {} lx on the horizontal", rounded(lx.diffuse_horizontal_lx)));
        let unit = format!("W m-2 ({:.0}-{:.0} nm)", light.from_nm, light.to_nm);
        let [normal, horizontal, diffuse] = light.irradiance_w_m2;
        lines.add("irradiance", format!("global {} {unit} by sunlight on the horizontal", rounded(horizontal + diffuse)));
        facing(lines, "direct", [horizontal, normal], &unit, "Sun");
        lines.add("", format!("diffuse {} {unit} on the horizontal", rounded(diffuse)));
    }
}

fn add_eclipses(lines: &mut Lines, bodies: &Bodies) {
    let below = |body: &Body| if is_up(body) { "" } else { ", below the horizon" };
    if let Some(eclipse) = bodies.solar_eclipse() {
        let (magnitude, share) = (eclipse.magnitude, 100.0 * eclipse.obscuration);
        let text = format!("{}, magnitude {magnitude:.3}, {share:.1} % of the disc covered", eclipse.kind());
        lines.add("eclipse of the Sun", text + below(&bodies.sun));
    }
    if let Some(shadow) = bodies.lunar_eclipse() {
        let (umbral, penumbral) = (shadow.umbral_magnitude, shadow.penumbral_magnitude);
        let text = format!("{}, magnitude {umbral:.3} in the umbra, {penumbral:.3} in the penumbra", shadow.kind());
        lines.add("eclipse of the Moon", text + below(&bodies.moon.body));
    }
}

fn add_table(lines: &mut Lines, bodies: &Bodies) {
    let up: Vec<&Body> = bodies.all().filter(|body| is_up(body)).collect();
    if up.is_empty() {
        return lines.add("above the horizon", "nothing of Sun, Moon and planets");
    }
    lines.add(
        "above the horizon",
        format!("{:>12}{:>12}{:>12}{:>12}{:>10}", "altitude deg", "azimuth deg", "magnitude", "diameter", "lit"),
    );
    for body in up {
        let magnitude = body.magnitude.map_or_else(String::new, |magnitude| format!("{magnitude:.2}"));
        let lit = body.illuminated_fraction.map_or_else(String::new, |fraction| format!("{:.1} %", 100.0 * fraction));
        lines.add(
            &format!("  {}", body.name),
            format!(
                "{:>12.4}{:>12.4}{magnitude:>12}{:>12}{lit:>10}",
                body.altitude_deg,
                body.azimuth_deg,
                size(body.angular_diameter_deg)
            ),
        );
    }
}

/// An angle in arcminutes, or arcseconds if it is smaller than one.
fn size(angle_deg: f64) -> String {
    if angle_deg < 1.0 / 60.0 { format!("{:.1}\"", 3600.0 * angle_deg) } else { format!("{:.2}'", 60.0 * angle_deg) }
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

    #[test]
    fn sizes_are_in_arcminutes_or_arcseconds() {
        assert_eq!((size(0.5244).as_str(), size(40.3 / 3600.0).as_str()), ("31.46'", "40.3\""));
    }
}
