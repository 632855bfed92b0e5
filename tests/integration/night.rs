//! The night as a whole: what arrives at the ground from Moon, stars and diffuse light, against published brightness; eclipses; energy at every resolution.

use glam::DVec3;
use skyprobe::Progress;
use skyprobe::atmosphere::AirParameters;
use skyprobe::celestial::photometry::{S10_LUMINANCE, surface_brightness_of_luminance};
use skyprobe::ephemeris::{Place, SunModel};
use skyprobe::probe::{ProbeSettings, Rows, render};
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, Disc, Layer, LayerScales, LightOptions, NightOptions, Sky, SkyLight, When};
use skyprobe::time::{Time, ZoneChoice};
use skyprobe::units::LUMINOUS_EFFICACY;
use std::sync::{Arc, LazyLock};

/// Clear air, solved once for all tests.
static AIR: LazyLock<Arc<Atmosphere>> =
    LazyLock::new(|| Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap()));

fn sky(latitude: f64, longitude: f64, elevation_m: f64, time: &str) -> Sky {
    let time = Time::parse(time, ZoneChoice::InText).unwrap();
    Sky::new(Place::new(latitude, longitude, elevation_m).unwrap(), time, SunModel::Iau, Arc::clone(&AIR)).unwrap()
}

fn light(sky: &Sky) -> skyprobe::sky::Layers {
    sky.light_by(&LightOptions::default(), &Progress::silent()).unwrap()
}

/// Luminance towards an altitude and an azimuth [cd m-2].
fn luminance(light: &dyn SkyLight, altitude_deg: f64, azimuth_deg: f64) -> f64 {
    let mut xyz = [[0.0_f32; 3]];
    light.radiance_circle(altitude_deg.to_radians(), &[azimuth_deg.to_radians()], &mut xyz);
    LUMINOUS_EFFICACY * f64::from(xyz[0][1])
}

#[test]
fn a_full_moon_near_the_zenith_lights_the_ground_as_measured() {
    // Full on 2025-02-12 at 13:53 UTC; two hours later it passes near the zenith of 20 N, 126 E, near its mean distance.
    let sky = sky(20.0, 126.0, 0.0, "2025-02-12T15:50:00Z");
    let moon = &sky.bodies_of_place().unwrap().moon;
    let (altitude, phase) = (moon.body.altitude_deg, moon.body.phase_angle_deg.unwrap());
    let lux = sky.illuminance(&Progress::silent()).unwrap();
    println!("altitude {altitude:.1}, phase {phase:.2}, distance {:.0} km: {lux:?}", moon.distance_km());
    assert!(altitude > 80.0 && phase < 7.0);
    // checked against: Kyba, Mohar & Posch 2017, Astronomy & Geophysics 58, 1.31: full Moon typically 0.05 to 0.1 lx, up to 0.32 lx high over the tropics
    assert!((0.2..0.32).contains(&lux.global_horizontal_lx), "{lux:?}");
    assert!(lux.moon_horizontal_lx > 0.7 * lux.global_horizontal_lx);
    // Moonlit air is as blue against the Moon as the day's sky against the Sun, and brighter than the stars' light by far.
    let light = light(&sky);
    let mut xyz = [[0.0_f32; 3]];
    light.only(Layer::Sky).radiance_circle(40_f64.to_radians(), &[0.0], &mut xyz);
    let disc = light.only(Layer::Moon).discs()[0].irradiance;
    let blue = |xyz: [f64; 3]| xyz[2] / xyz[1];
    assert!(blue(xyz[0].map(f64::from)) > 1.3 * blue(disc), "{xyz:?} {disc:?}");
}

#[test]
fn a_moonless_night_is_as_dark_as_measured() {
    // New Moon, the Sun far down, mean solar activity, no towns; the Milky Way not overhead.
    for (place, sky) in [
        ("Lund in winter", sky(55.71, 13.19, 0.0, "2026-01-20T22:00:00Z")),
        ("Lund in spring", sky(55.71, 13.19, 0.0, "2026-03-18T23:00:00Z")),
        ("Atacama", sky(-24.6, -70.4, 0.0, "2026-10-11T02:00:00Z")),
        ("Mauna Kea", sky(19.82, -155.47, 4205.0, "2026-04-17T10:00:00Z")),
    ] {
        assert!(sky.bodies_of_place().unwrap().moon.body.altitude_deg < 0.0 && sky.sun().altitude_deg < -30.0, "{place}");
        let zenith = surface_brightness_of_luminance(luminance(&light(&sky), 90.0, 0.0));
        let lux = sky.illuminance(&Progress::silent()).unwrap().global_horizontal_lx;
        println!("{place}: zenith V {zenith:.2}, {:.3} mlx", 1e3 * lux);
        // checked against: Patat 2003, A&A 400, 1183 (Paranal, dark time, V 21.6 +- 0.2); Falchi et al. 2016, Science Advances 2, e1600377 (natural zenith V 22)
        assert!((21.6..22.0).contains(&zenith), "{place}: {zenith}");
        // checked against: common tables (Schlyter, Radiometry and photometry in astronomy): clear moonless sky with airglow up to 0.002 lx
        assert!((0.0005..0.002).contains(&lux), "{place}: {lux}");
    }
    let sky = sky(55.71, 13.19, 0.0, "2026-01-20T22:00:00Z");
    // Towns of Bortle's class 5 make it V 20.
    let options = NightOptions { bortle: Some(5), ..Default::default() };
    let lit = sky.with_night(options).unwrap();
    let zenith = surface_brightness_of_luminance(luminance(&self::light(&lit), 90.0, 0.0));
    assert!((19.8..20.1).contains(&zenith), "{zenith}");
}

#[test]
fn drawn_stars_keep_their_energy_at_every_width() {
    let sky = sky(55.71, 13.19, 0.0, "2026-01-20T21:00:00Z");
    let light = light(&sky);
    let stars = light.only(Layer::Stars);
    let points: f64 = stars.points().iter().map(|point| point.irradiance[1]).sum();
    for rows in [Rows::Centre, Rows::Corner] {
        for width in [512, 2048, 8192] {
            let settings = ProbeSettings { width, rows, gamut: skyprobe::spectrum::Gamut::Keep, ..Default::default() };
            let probe = render(&stars, &settings, &Progress::silent()).unwrap();
            let grid = probe.grid();
            let luminance =
                |pixel: [f32; 3]| 0.2126 * f64::from(pixel[0]) + 0.7152 * f64::from(pixel[1]) + 0.0722 * f64::from(pixel[2]);
            let row = |row| grid.footprint(0, row).solid_angle * (0..width).map(|i| luminance(probe.pixel(i, row))).sum::<f64>();
            let drawn: f64 = (0..probe.height).map(row).sum();
            println!("{rows:?} {width}: {:.4} %", 100.0 * (drawn / points - 1.0));
            assert!((drawn / points - 1.0).abs() < 0.005, "{rows:?} {width}: {drawn} {points}");
        }
    }
}

#[test]
fn naked_eye_stars_have_the_published_light() {
    // Both hemispheres at one instant from opposite places see all stars once; the observer is above the air.
    let options = NightOptions { star_limit: 6.5, when: When::Always, ..Default::default() };
    let sum: f64 = [(90.0, 0.0), (-90.0, 0.0)]
        .into_iter()
        .map(|(latitude, longitude)| {
            let sky = sky(latitude, longitude, 60_000.0, "2026-01-20T21:00:00Z").with_night(options).unwrap();
            let above = |point: &skyprobe::sky::Point| if point.direction.z > 0.0 { point.irradiance[1] } else { 0.0 };
            light(&sky).only(Layer::Stars).points().iter().map(above).sum::<f64>()
        })
        .sum();
    let s10 = LUMINOUS_EFFICACY * sum / (4.0 * std::f64::consts::PI) / S10_LUMINANCE;
    println!("stars to V 6.5: {s10:.2} S10(V)");
    // checked against: Leinert et al. 1998, and the sum over the Bright Star Catalogue: 23 S10(V). Luminance is not V: bluer stars count for a per cent or two less.
    assert!((21.0..25.0).contains(&s10), "{s10}");
}

/// Centre of light of a disc, to the right and upwards in units of its radius, and the light over that of a disc as bright as the brightest channel everywhere.
fn centroid(disc: &Disc) -> (f64, f64) {
    let (mut sum, mut right_sum, mut up_sum) = (0.0, 0.0, 0.0);
    let n = 200;
    for i in 0..n {
        for j in 0..n {
            let (right, up) = (2.0 * (f64::from(i) + 0.5) / f64::from(n) - 1.0, 2.0 * (f64::from(j) + 0.5) / f64::from(n) - 1.0);
            if right * right + up * up < 1.0 {
                let brightness = disc.surface.brightness(right, up)[1];
                sum += brightness;
                right_sum += brightness * right;
                up_sum += brightness * up;
            }
        }
    }
    (right_sum / sum, up_sum / sum)
}

#[test]
fn the_eclipse_of_1999_over_lund_leaves_the_right_crescent() {
    let at = |time: &str| sky(55.7047, 13.191, 50.0, time);
    let (before, during) = (at("1999-08-11T11:00:00+02:00"), at("1999-08-11T12:45:00+02:00"));
    assert!(before.solar_eclipse().is_none());
    let eclipse = during.solar_eclipse().unwrap();
    // checked against: Espenak & Anderson 1997, NASA RP 1398: magnitude 0.80 in southern Sweden
    assert!((eclipse.magnitude - 0.797).abs() < 0.002, "{}", eclipse.magnitude);
    assert!((eclipse.obscuration - 0.750).abs() < 0.002);
    let disc = &light(&during).only(Layer::Sun).discs()[0];
    let whole = &light(&before).only(Layer::Sun).discs()[0];
    // The air mass of the two differs by some per cent; limb darkening leaves less light than area.
    let left = disc.irradiance[1] / whole.irradiance[1];
    assert!((left - 0.235).abs() < 0.02, "{left}");
    // The crescent lies away from the Moon.
    let (right, up) = centroid(disc);
    let light_left = during.eclipsed_sunlight().unwrap();
    let towards_moon = light_left.moon_direction() - light_left.sun_direction();
    let right_axis = light_left.sun_direction().cross(DVec3::Z).normalize();
    let moon = (towards_moon.dot(right_axis), towards_moon.dot(right_axis.cross(light_left.sun_direction())));
    assert!(right * moon.0 + up * moon.1 < -0.9 * right.hypot(up) * moon.0.hypot(moon.1), "{right} {up} {moon:?}");
    assert!(right.hypot(up) > 0.5);
    // The sky darkens with it.
    let ratio = luminance(&light(&during), 60.0, 0.0) / luminance(&light(&before), 60.0, 0.0);
    assert!((0.2..0.3).contains(&ratio), "{ratio}");
}

#[test]
fn totality_leaves_a_corona_and_a_dark_sky() {
    // checked against: Espenak & Anderson 2004, NASA TP-2004-212762, Dallas 2024-04-08: totality from 18:40:43 to 18:44:33 UTC
    let at = |time: &str| sky(32.78, -96.80, 130.0, time);
    let (before, total) = (at("2024-04-08T17:00:00Z"), at("2024-04-08T18:42:30Z"));
    assert!(total.solar_eclipse().unwrap().is_total());
    let discs = light(&total).only(Layer::Sun).discs();
    assert_eq!(discs.len(), 1);
    let corona = discs[0].irradiance[1] / light(&before).only(Layer::Sun).discs()[0].irradiance[1];
    // checked against: common textbooks: half of the full Moon's light, which is 2.1 to 2.5e-6 of the Sun's, within a factor of 2
    assert!((0.6e-6..1.6e-6).contains(&corona), "{corona}");
    let [zenith, horizon] =
        [80.0, 5.0].map(|altitude| luminance(&light(&total), altitude, 0.0) / luminance(&light(&before), altitude, 0.0));
    println!("corona {corona:.2e}, sky {zenith:.2e} in the zenith, {horizon:.2e} at the horizon");
    assert!((0.5e-4..2e-4).contains(&zenith) && horizon > 3.0 * zenith, "{zenith} {horizon}");
}

#[test]
fn the_eclipsed_moon_of_2018_is_dark_and_red() {
    let at = |time: &str| sky(19.8207, -155.4681, 4205.0, time);
    // checked against: NASA's catalogue, 2018-01-31: totality 12:52 to 14:08 UTC, greatest 13:30
    let [full, total] =
        ["2018-01-31T10:00:00Z", "2018-01-31T13:30:00Z"].map(|time| light(&at(time)).only(Layer::Moon).discs()[0].clone());
    let fainter = -2.5 * (total.irradiance[1] / full.irradiance[1]).log10();
    println!(
        "fainter by {fainter:.2} mag, X/Z {:.2} against {:.2}",
        total.irradiance[0] / total.irradiance[2],
        full.irradiance[0] / full.irradiance[2]
    );
    // checked against: Link 1962, and the magnitudes of 1990 and 2007 in `celestial::moon_disc`: 9 to 13 magnitudes in totality
    assert!((9.0..13.5).contains(&fainter), "{fainter}");
    assert!(total.irradiance[0] / total.irradiance[2] > 4.0 * full.irradiance[0] / full.irradiance[2]);
}

#[test]
fn layers_can_be_scaled_and_left_out_and_a_sun_that_was_put_has_no_night() {
    let sky = sky(55.71, 13.19, 0.0, "2026-01-20T21:00:00Z");
    let whole = light(&sky);
    assert_eq!(whole.names().len(), 8);
    let scales = LayerScales([(Layer::Airglow, 3.0), (Layer::Stars, 0.0)].into());
    let options = LightOptions { layers: scales, ..Default::default() };
    let scaled = sky.light_by(&options, &Progress::silent()).unwrap();
    assert!(!scaled.names().contains(&Layer::Stars) && scaled.points().len() < 8);
    let airglow = |light: &skyprobe::sky::Layers| luminance(&light.only(Layer::Airglow), 45.0, 0.0);
    assert!((airglow(&scaled) / airglow(&whole) - 3.0).abs() < 1e-5);
    let sum: f64 = whole.names().iter().map(|&layer| luminance(&whole.only(layer), 30.0, 50.0)).sum();
    assert!((luminance(&whole, 30.0, 50.0) / sum - 1.0).abs() < 1e-5);
    let never = sky.with_night(NightOptions { when: When::Never, ..Default::default() }).unwrap();
    assert_eq!(light(&never).names(), [Layer::Sky, Layer::Sun]);
    let put = Sky::with_sun(-40.0, 180.0, 0.0, Arc::clone(&AIR)).unwrap();
    assert_eq!(light(&put).names(), [Layer::Sky, Layer::Sun]);
}
