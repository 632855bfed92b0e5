//! The Sun against every Sun row of the shared reference table (Skyfield with DE421).

use crate::common::shared_reference;
use skyprobe::ephemeris::{Place, Refraction, SunModel, direction_from_horizontal, sun};
use skyprobe::time::{Time, ZoneChoice};

#[test]
#[ignore = "needs ../shared/reference"]
fn the_sun_of_every_reference_row_within_an_arcsecond() {
    let table = std::fs::read_to_string(shared_reference("ephemeris.csv")).unwrap();
    let mut lines = table.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let mut compared = 0;
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        let text = |name: &str| fields[names.iter().position(|n| *n == name).unwrap()];
        let number = |name: &str| text(name).parse::<f64>().unwrap();
        if text("body") != "Sun" {
            continue;
        }
        let place = Place::new(number("lat"), number("lon"), number("h_m")).unwrap();
        let by_date = Time::from_tt_ut1(number("jd_tt"), number("jd_ut1")).unwrap();
        let by_text = Time::parse(&format!("{}Z", text("input")), ZoneChoice::InText).unwrap();
        let expected = direction_from_horizontal(number("alt"), number("az"));
        for (time, way) in [(by_date, "Julian dates"), (by_text, "text")] {
            let body = sun(&place, &time, SunModel::Iau, &Refraction::none());
            let gap = body.direction().angle_between(expected).to_degrees() * 3600.0;
            println!("{} by {way}: {gap:.3} arcseconds", text("case"));
            assert!(gap < 1.0, "{} by {way}: {gap}", text("case"));
            assert!((body.distance_au - number("dist_au")).abs() < 1e-6);
            assert!((body.angular_diameter_deg - number("sun_ang_diam_deg")).abs() < 1e-4);
        }
        compared += 1;
    }
    assert!(compared > 0);
}
