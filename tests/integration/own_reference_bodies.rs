//! Moon and planets against the project's own table, 64 places and times from 1900 to 2050 (Skyfield with JPL's DE421): see `tests/reference`.

use skyprobe::ephemeris::{Bodies, Body, MoonModel, Place, Refraction, SunModel, bodies, direction_from_horizontal};
use skyprobe::time::Time;
use std::collections::BTreeMap;

struct Row<'a> {
    name: &'a str,
    place: Place,
    time: Time,
    altitude_deg: f64,
    azimuth_deg: f64,
    distance_au: f64,
    phase_angle_deg: f64,
    magnitude: Option<f64>,
}

fn rows() -> Vec<Row<'static>> {
    let table = include_str!("../reference/ephemeris_bodies.csv");
    let row = |line: &'static str| {
        let fields: Vec<&str> = line.split(',').collect();
        let n = |i: usize| fields[i].parse::<f64>().unwrap();
        Row {
            name: fields[0],
            place: Place::new(n(1), n(2), n(3)).unwrap(),
            time: Time::from_tt_ut1(n(4), n(5)).unwrap(),
            altitude_deg: n(6),
            azimuth_deg: n(7),
            distance_au: n(8),
            phase_angle_deg: n(9),
            magnitude: fields[10].parse().ok(),
        }
    };
    table.lines().skip(1).map(row).collect()
}

fn state(row: &Row<'_>, moon_model: MoonModel) -> Bodies {
    bodies(&row.place, &row.time, SunModel::Iau, moon_model, &Refraction::none())
}

fn gap_arcsec(row: &Row<'_>, body: &Body) -> f64 {
    let (a, b) = (body.direction(), direction_from_horizontal(row.altitude_deg, row.azimuth_deg));
    a.cross(b).length().atan2(a.dot(b)).to_degrees() * 3600.0
}

#[test]
fn an_independent_ephemeris() {
    /// Position [arcseconds], distance [relative], phase angle [degrees], magnitude: largest differences.
    type Gaps = [f64; 4];
    let mut worst: BTreeMap<&str, Gaps> = BTreeMap::new();
    for row in rows() {
        let bodies = state(&row, MoonModel::Elp);
        let body = bodies.all().find(|body| body.name == row.name).unwrap();
        let gaps = [
            gap_arcsec(&row, body),
            (body.distance_au / row.distance_au - 1.0).abs(),
            (body.phase_angle_deg.unwrap() - row.phase_angle_deg).abs(),
            row.magnitude.map_or(0.0, |magnitude| (body.magnitude.unwrap() - magnitude).abs()),
        ];
        let entry = worst.entry(row.name).or_default();
        *entry = std::array::from_fn(|i| entry[i].max(gaps[i]));
    }
    assert_eq!(worst.len(), 8);
    for (name, [arcsec, distance, phase, magnitude]) in worst {
        println!("{name}: {arcsec:.3} arcseconds, {distance:.1e} of the distance, {phase:.4} degrees, {magnitude:.4} magnitudes");
        let limit = match name {
            "Moon" => 0.15,
            "Mercury" | "Venus" | "Mars" => 0.3,
            "Jupiter" | "Saturn" => 0.6,
            _ => 1.0,
        };
        assert!(arcsec < limit && distance < 3e-6, "{name}: {arcsec} {distance}");
        // The Moon's: aberration of the sunlight, which the Moon sees too.
        assert!(phase < 0.012 && magnitude < 0.002, "{name}: {phase} {magnitude}");
    }
}

#[test]
fn the_gap_of_the_thesis_is_known() {
    let moons: Vec<_> = rows().into_iter().filter(|row| row.name == "Moon").collect();
    let worst = moons.iter().map(|row| gap_arcsec(row, &state(row, MoonModel::Thesis).moon.body)).fold(0.0, f64::max);
    println!("Moon of the thesis against DE421: {:.3} degrees at most", worst / 3600.0);
    assert!((0.9..1.2).contains(&(worst / 3600.0)), "{worst}");
}
