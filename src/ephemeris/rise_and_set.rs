//! Rise, upper transit and set of Sun, Moon and planets on a local civil date, from midnight to midnight by the clock on the wall.
//!
//! The Moon rises 50 minutes later every day, so that each month one date has no moonrise and one no moonset; near the poles it stays up or down for
//! days. The altitude is looked at every half hour; where its curve only touches the horizon between two looks, its summit is sought.
//! [`super::sun_events()`] orders the Sun's day around noon instead, with twilight.

use super::place::Place;
use super::root::bracketed_root;
use super::target::Target;
use crate::error::Result;
use crate::time::Time;

/// When a body rises, stands highest and sets on one date, to the second; `None` for what does not happen on it.
#[derive(Clone, Debug, PartialEq)]
pub struct RiseAndSet {
    /// It appears above the horizon. If it does so twice on the date, for the first time.
    pub rise: Option<Time>,
    /// It passes the meridian above the pole.
    pub transit: Option<Time>,
    /// Its airless altitude then [degrees].
    pub transit_altitude_deg: Option<f64>,
    /// It disappears below the horizon. If it does so twice on the date, for the first time.
    pub set: Option<Time>,
    /// It is above the horizon when the date begins: with neither rise nor set, all day.
    pub up_at_midnight: bool,
}

const STEP_S: f64 = 1800.0;

/// Rise, transit and set of `target` at `place` on the local civil date of `time`, in its zone. Refraction at the horizon is 34 arcminutes; Sun and Moon
/// count with their upper limb; the horizon is unobstructed and at the height of the observer.
///
/// # Errors
/// [`crate::Error::Input`] for `time` if the day touches the end of the years 1000 to 3000.
pub fn rise_and_set(target: Target, place: &Place, time: &Time) -> Result<RiseAndSet> {
    let (start, length_s) = local_date(time)?;
    let after = |seconds: f64| start.plus_seconds(seconds);
    // Inside the date every time exists: the value for those that do not is never used.
    let height = |seconds: f64| after(seconds).map_or(0.0, |time| target.height_above_rise_deg(place, &time));
    let hour_angle = |seconds: f64| after(seconds).map_or(0.0, |time| target.hour_angle_and_altitude_deg(place, &time).0);

    let steps = (length_s / STEP_S).ceil() as usize;
    let times: Vec<f64> = (0..=steps).map(|step| (step as f64 * STEP_S).min(length_s)).collect();
    let mut nodes: Vec<(f64, f64)> = times.iter().map(|seconds| (*seconds, height(*seconds))).collect();
    add_summits(&mut nodes, height);

    let crossing = |rising: bool| -> Option<f64> {
        let pair = nodes.windows(2).find(|pair| (pair[0].1 < 0.0) == rising && (pair[1].1 < 0.0) != rising)?;
        Some(bracketed_root(height, pair[0].0, pair[1].0, 0.05))
    };
    let angles: Vec<f64> = times.iter().map(|seconds| hour_angle(*seconds)).collect();
    let transit = times
        .windows(2)
        .zip(angles.windows(2))
        .find(|(_, angle)| angle[0] < 0.0 && angle[1] >= 0.0 && angle[1] - angle[0] < 180.0)
        .map(|(pair, _)| bracketed_root(hour_angle, pair[0], pair[1], 0.05));

    let moment = |seconds: Option<f64>| seconds.map(after).transpose().map(|time| time.map(|time| time.rounded_to_second()));
    let transit = moment(transit)?;
    Ok(RiseAndSet {
        rise: moment(crossing(true))?,
        transit_altitude_deg: transit.as_ref().map(|time| target.hour_angle_and_altitude_deg(place, time).1),
        transit,
        set: moment(crossing(false))?,
        up_at_midnight: nodes.first().is_some_and(|node| node.1 >= 0.0),
    })
}

/// The midnight that begins the local date of `time`, and the length of the date [s].
fn local_date(time: &Time) -> Result<(Time, f64)> {
    let noon = time.local_noon()?;
    let midnight = |hours: f64| -> Result<Time> {
        let near = noon.plus_hours(hours)?;
        // On a day when the clocks change the clock shows 23, 0 or 1 o'clock there.
        let clock = near.civil();
        let past = f64::from(clock.hour) + f64::from(clock.minute) / 60.0;
        near.plus_hours(if past > 12.0 { 24.0 - past } else { -past })
    };
    let (start, end) = (midnight(-12.0)?, midnight(12.0)?);
    let length = start.seconds_until(&end);
    Ok((start, length))
}

/// Inserts the summit (or the lowest point) of `height` where it lies on the other side of zero from both neighbours of a look.
fn add_summits(nodes: &mut Vec<(f64, f64)>, height: impl Fn(f64) -> f64) {
    /// Within half an hour the altitude of a summit differs by less from its neighbour's [degrees].
    const REACH_DEG: f64 = 0.7;
    let mut summits = Vec::new();
    for three in nodes.windows(3) {
        let side = if three[1].1 < 0.0 { 1.0 } else { -1.0 };
        let [before, at, after] = [0, 1, 2].map(|i| side * three[i].1);
        if before.max(after) < 0.0 && at >= before && at >= after && at > -REACH_DEG {
            let summit = summit_between(|seconds| side * height(seconds), three[0].0, three[2].0);
            summits.push((summit, height(summit)));
        }
    }
    nodes.extend(summits);
    nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
}

/// Where `f` is largest between `low` and `high`, within a second, by golden section.
fn summit_between(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut at_a, mut at_b) = (f(a), f(b));
    while high - low > 1.0 {
        if at_a > at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - GOLDEN * (high - low);
            at_a = f(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + GOLDEN * (high - low);
            at_b = f(b);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::almanac::count_equal;
    use crate::ephemeris::{Planet, sun_events};
    use crate::time::ZoneChoice;

    fn day(target: Target, latitude: f64, longitude: f64, text: &str) -> RiseAndSet {
        let time = Time::parse(text, ZoneChoice::InText).unwrap();
        rise_and_set(target, &Place::new(latitude, longitude, 0.0).unwrap(), &time).unwrap()
    }

    fn target(name: &str) -> Target {
        match name {
            "Sun" => Target::Sun,
            "Moon" => Target::Moon,
            planet => Target::Planet(planet.parse().unwrap()),
        }
    }

    #[test]
    fn almanac_times() {
        // checked against: Skyfield 1.55 with DE421, find_discrete on altitude and hour angle: body, place, day, rise, transit, set.
        let rows = include_str!("../../tests/reference/ephemeris_rise_and_set.csv");
        let mut compared = 0;
        for row in rows.lines().skip(1) {
            let fields: Vec<&str> = row.split(',').collect();
            let ours = day(target(fields[0]), fields[1].parse().unwrap(), fields[2].parse().unwrap(), fields[3]);
            compared += count_equal([&ours.rise, &ours.transit, &ours.set], &fields[4..], row);
        }
        assert!(compared > 100, "{compared}");
    }

    #[test]
    fn the_sun_as_in_its_own_day() {
        let text = "2005-03-27T15:00:00[Europe/Stockholm]";
        let time = Time::parse(text, ZoneChoice::InText).unwrap();
        let own = sun_events(&Place::new(55.7, 13.2, 0.0).unwrap(), &time).unwrap();
        let general = day(Target::Sun, 55.7, 13.2, text);
        assert_eq!((general.rise, general.transit, general.set), (own.sunrise, Some(own.solar_noon), own.sunset));
        assert!((general.transit_altitude_deg.unwrap() - own.noon_altitude_deg).abs() < 0.001 && !general.up_at_midnight);
    }

    #[test]
    fn the_clocks_change_and_the_date_has_its_hours() {
        for (text, hours) in [
            ("2005-03-27T12:00:00[Europe/Stockholm]", 23.0),
            ("2005-10-30T01:00:00[Europe/Stockholm]", 25.0),
            ("2005-06-21T23:59:00[Europe/Stockholm]", 24.0),
        ] {
            let (start, length) = local_date(&Time::parse(text, ZoneChoice::InText).unwrap()).unwrap();
            assert_eq!((length, start.civil().hour, start.civil().minute), (hours * 3600.0, 0, 0), "{text}");
        }
    }

    #[test]
    fn a_body_that_barely_rises() {
        // Near the edge of the polar night the Sun shows its limb for minutes, between two looks.
        let mut short = 0;
        for step in 0..12 {
            let latitude = 67.32 + 0.01 * f64::from(step);
            let day = day(Target::Sun, latitude, 18.96, "2013-12-21T12:00:00+01:00");
            assert_eq!((day.rise.is_some(), day.set.is_some()), (step < 8, step < 8), "{latitude}");
            let (Some(rise), Some(set)) = (&day.rise, &day.set) else { continue };
            let minutes = rise.seconds_until(set) / 60.0;
            println!("{latitude:.2}: {minutes:.1} minutes of sun");
            short += i32::from(minutes < 30.0);
        }
        assert!(short > 0);
    }

    #[test]
    fn the_pole_and_the_end_of_time_are_answered() {
        for latitude in [-90.0, 90.0] {
            assert!(day(Target::Planet(Planet::Jupiter), latitude, 0.0, "2005-06-21T12:00:00Z").rise.is_none());
        }
        let last = Time::parse("3000-12-31T23:00:00Z", ZoneChoice::InText).unwrap();
        assert!(rise_and_set(Target::Moon, &Place::new(0.0, 0.0, 0.0).unwrap(), &last).is_err());
    }
}
