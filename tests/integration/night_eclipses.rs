//! Eclipses of Sun and Moon as a probe shows them.

use crate::common::night::{AIR, light, place, sky};
use glam::DVec3;
use skyprobe::ephemeris::SunModel;
use skyprobe::probe::{Probe, ProbeSettings, Rows, render};
use skyprobe::progress::Progress;
use skyprobe::sky::{Disc, Layer, Model, Sky, SkyLight};
use skyprobe::spectrum::ColorSpace;

fn probe(light: &dyn SkyLight, settings: ProbeSettings) -> Probe {
    render(light, &ProbeSettings { color_space: ColorSpace::Xyz, ..settings }, &Progress::silent()).unwrap()
}

/// Sum over the pixels of irradiance times direction, by Y [W m-2].
fn vector_sum(probe: &Probe) -> DVec3 {
    let grid = probe.grid();
    let mut sum = DVec3::ZERO;
    for row in 0..probe.height {
        for column in 0..probe.width {
            let y = f64::from(probe.pixel(column, row)[1]);
            if y > 0.0 {
                let footprint = grid.footprint(column, row);
                sum += y * footprint.solid_angle * footprint.mean_direction;
            }
        }
    }
    sum
}

/// The same sky with a whole Sun at 1 au, and the square of 1 au over the Sun's distance.
fn without_eclipse(sky: &Sky) -> (Sky, f64) {
    let sun = sky.sun();
    let whole = Sky::with_sun(sun.altitude_deg, sun.azimuth_deg, sky.elevation_m(), AIR.clone()).unwrap();
    (whole, sun.distance_au.powi(-2))
}

const LUND: &str = "1999-08-11T12:45:00+02:00";

#[test]
fn local_circumstances_of_1999_are_the_published_ones() {
    // checked against: Espenak & Anderson, NASA Reference Publication 1398 (Total Solar Eclipse of 1999 August 11), table 21: magnitude and obscuration at maximum
    for (latitude, longitude, when, magnitude, obscuration) in [
        (59.9167, 10.75, "1999-08-11T10:35:29Z", 0.718, 0.651),
        (54.3833, 18.6667, "1999-08-11T10:46:51Z", 0.818, 0.776),
        (49.8167, 19.0333, "1999-08-11T10:50:02Z", 0.931, 0.920),
    ] {
        let sky = sky(latitude, longitude, 0.0, when);
        let eclipse = sky.solar_eclipse().unwrap();
        println!("{latitude}: {:.4} {:.4}", eclipse.magnitude, eclipse.obscuration);
        assert!((eclipse.magnitude - magnitude).abs() < 0.0015, "{latitude}: {}", eclipse.magnitude);
        assert!((eclipse.obscuration - obscuration).abs() < 0.0015, "{latitude}: {}", eclipse.obscuration);
    }
}

#[test]
fn the_crescent_of_1999_in_lund_is_the_right_one() {
    let sky = sky(55.71, 13.19, 0.0, LUND);
    let eclipse = sky.solar_eclipse().unwrap();
    assert!((eclipse.magnitude - 0.797).abs() < 0.001, "{}", eclipse.magnitude);
    let left_over = sky.eclipsed_sunlight().unwrap();
    let visible = left_over.visible_fraction(555.0);
    let layers = light(&sky);
    let sun = layers.only(Layer::Sun);
    let (whole, nearness) = without_eclipse(&sky);
    let whole = light(&whole).discs()[0].irradiance[1] * nearness;
    let left = sun.discs()[0].irradiance[1];
    assert!((left / (whole * visible) - 1.0).abs() < 0.002, "{left} {whole} {visible}");
    let to_sun = sky.sun().apparent_direction();
    let away = (left_over.sun_direction() - left_over.moon_direction()).normalize();
    let expected = centroid(&sun.discs()[0]);
    assert!(expected.dot(away) > 0.3 * left_over.sun_radius(), "the uncovered side is the one away from the Moon");
    for rows in [Rows::Centre, Rows::Corner] {
        let drawn = vector_sum(&probe(&sun, ProbeSettings { width: 4096, rows, ..Default::default() }));
        assert!((drawn.length() / left - 1.0).abs() < 1e-3, "{rows:?}: {}", drawn.length() / left);
        let offset = drawn.normalize() - to_sun;
        let error = (offset - expected).length() / left_over.sun_radius();
        println!("{rows:?}: centroid off by {error:.5} radii of the Sun, of {:.3}", expected.length() / left_over.sun_radius());
        assert!(error < 0.01, "{rows:?}: {offset} {expected}");
    }
}

/// Offset of the mean direction of a disc's light from its middle [radians].
fn centroid(disc: &Disc) -> DVec3 {
    const N: usize = 400;
    let right = disc.direction.cross(DVec3::Z).normalize();
    let up = right.cross(disc.direction);
    let (mut sum, mut offset) = (0.0, DVec3::ZERO);
    let at = |i: usize| 2.0 * (i as f64 + 0.5) / N as f64 - 1.0;
    for (x, y) in (0..N * N).map(|k| (at(k % N), at(k / N))).filter(|(x, y)| x * x + y * y < 1.0) {
        let brightness = disc.surface.brightness(x, y)[1];
        sum += brightness;
        offset += brightness * (x * disc.horizontal_radius * right + y * disc.vertical_radius * up);
    }
    offset / sum
}

/// Radiance of the sky's layer towards the zenith, of the ground below, and near the horizon towards north, by Y.
fn smooth(sky: &Sky) -> [f64; 3] {
    let layers = light(sky);
    [89.9_f64, -60.0, 0.05].map(|altitude| {
        let mut out = [[0.0; 3]];
        layers.only(Layer::Sky).radiance_circle(altitude.to_radians(), &[0.0], &mut out);
        f64::from(out[0][1])
    })
}

#[test]
fn half_a_sun_lights_half_a_sky() {
    let sky = (0..120)
        .map(|minute| sky(55.71, 13.19, 0.0, LUND).time().unwrap().plus_seconds(-60.0 * f64::from(minute)).unwrap())
        .map(|time| Sky::new(place(55.71, 13.19, 0.0), time, SunModel::Iau, AIR.clone()).unwrap())
        .find(|sky| sky.eclipsed_sunlight().is_some_and(|light| light.visible_fraction(550.0) > 0.5))
        .unwrap();
    let visible = sky.eclipsed_sunlight().unwrap().visible_fraction(555.0);
    assert!((0.5..0.53).contains(&visible));
    let (whole, nearness) = without_eclipse(&sky);
    for (left, whole) in smooth(&sky).into_iter().zip(smooth(&whole)) {
        // Blue light comes from the middle of the disc: less of it is left than of green.
        assert!((left / (whole * nearness) - visible).abs() < 0.004, "{} {visible}", left / (whole * nearness));
    }
    let [left, whole] = [&sky, &whole].map(|sky| sky.illuminance(&Progress::silent()).unwrap());
    let ratio = left.global_horizontal_lx / (whole.global_horizontal_lx * nearness);
    assert!((ratio - visible).abs() < 0.004, "{ratio} {visible}");
}

#[test]
fn totality_leaves_the_corona_and_a_ten_thousandth_of_the_sky() {
    // Munich, in the path of 1999-08-11.
    let sky = sky(48.2, 11.4, 500.0, "1999-08-11T12:38:00+02:00");
    assert!(sky.solar_eclipse().unwrap().is_total());
    let (whole, nearness) = without_eclipse(&sky);
    let [zenith, ground, horizon] = std::array::from_fn(|i| smooth(&sky)[i] / (smooth(&whole)[i] * nearness));
    println!("zenith {zenith:.2e}, ground {ground:.2e}, horizon {horizon:.2e} of the normal light");
    // checked against: Shaw 1975, Applied Optics 14, 388: 1e-4 in the zenith; the horizon: celestial::eclipsed_sunlight
    assert!((zenith / 1e-4 - 1.0).abs() < 0.01 && (horizon / 1e-3 - 1.0).abs() < 0.02);
    let lit = sky.illuminance(&Progress::silent()).unwrap();
    // checked against: Mollmann & Vollmer 2006, European Journal of Physics 27, 1299: some lux at totality
    assert!((1.0..10.0).contains(&lit.global_horizontal_lx), "{lit:?}");
    let full = whole.illuminance(&Progress::silent()).unwrap().global_horizontal_lx * nearness;
    assert!((ground / (lit.global_horizontal_lx / full) - 1.0).abs() < 0.1, "the ground is lit by corona and sky: {ground}");
    let layers = light(&sky);
    let corona = layers.only(Layer::Sun).discs();
    assert_eq!(corona.len(), 1);
    let share = corona[0].irradiance[1] / (light(&whole).discs()[0].irradiance[1] * nearness);
    // checked against: common textbooks: the corona has half of the full Moon's light (2.1 to 2.5e-6 of the Sun's), half of that at spot minimum
    assert!((0.57e-6..1.3e-6).contains(&share), "{share}");
    let seen = probe(&layers, ProbeSettings { width: 1024, ..Default::default() }).irradiance(DVec3::Z)[1] * 683.002;
    let expected = lit.global_horizontal_lx;
    assert!((seen / expected - 1.0).abs() < 0.005, "{seen} {expected}");
    // The corona is all that is left of direct light, in illuminance and in spectral irradiance.
    println!("corona {:.3} lx, sky {:.3} lx", lit.direct_normal_lx, lit.diffuse_horizontal_lx);
    assert!((lit.direct_normal_lx / (683.002 * corona[0].irradiance[1]) - 1.0).abs() < 1e-5, "{lit:?}");
    let [direct, whole] = [&sky, &whole].map(|sky| sky.irradiance(&[550.0], &Progress::silent()).unwrap().direct_normal[0]);
    assert!((direct / (whole * nearness * share) - 1.0).abs() < 0.001, "{direct} {whole}");
}

#[test]
fn stars_are_shown_while_the_sun_is_totally_eclipsed() {
    let names = |time: &str| sky(48.2, 11.4, 500.0, time).layers_by(Model::Scattering);
    let night = [Layer::Stars, Layer::MilkyWay, Layer::Zodiacal, Layer::Airglow];
    for (time, total) in [("12:30", false), ("12:38", true), ("12:45", false)] {
        let names = names(&format!("1999-08-11T{time}:00+02:00"));
        assert!(night.iter().all(|layer| names.contains(layer) == total), "{time}: {names:?}");
    }
    let at_totality = sky(48.2, 11.4, 500.0, "1999-08-11T12:38:00+02:00");
    let layers = light(&at_totality);
    assert_eq!(layers.names(), at_totality.layers_by(Model::Scattering));
    assert!(layers.only(Layer::Stars).points().len() > 20_000);
    // Within the corona there is no zodiacal light beside it.
    let sun = at_totality.sun();
    let zodiacal = |off_deg: f64| {
        let mut out = [[0.0_f32; 3]];
        let azimuth = sun.azimuth_deg.to_radians();
        layers.only(Layer::Zodiacal).radiance_circle((sun.apparent_altitude_deg + off_deg).to_radians(), &[azimuth], &mut out);
        out[0][1]
    };
    assert!(zodiacal(1.0) < 0.01 * zodiacal(4.0), "{} {}", zodiacal(1.0), zodiacal(4.0));
}
