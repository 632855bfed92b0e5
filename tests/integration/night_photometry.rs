//! Single lights of the night as a probe shows them: moonlight, zodiacal light, extinction of stars; layers that add up to the whole.

use crate::common::night::{AIR, NO_AIR, light, lux_of, place, sky, time};
use glam::DVec3;
use skyprobe::celestial::photometry::surface_brightness_of_luminance;
use skyprobe::ephemeris::{SunModel, icrs_to_ecliptic_j2000};
use skyprobe::probe::{Probe, ProbeSettings, render};
use skyprobe::progress::Progress;
use skyprobe::sky::{Layer, LayerScales, LightOptions, NightOptions, Sky, SkyLight, When};
use skyprobe::spectrum::{ColorSpace, observer, solar};
use skyprobe::units::LUMINOUS_EFFICACY;

/// Luminance [cd m-2] of the smooth light of `light` towards `direction`.
fn luminance(light: &dyn SkyLight, direction: DVec3) -> f64 {
    let mut out = [[0.0; 3]];
    light.radiance_circle(direction.z.clamp(-1.0, 1.0).asin(), &[direction.x.atan2(direction.y)], &mut out);
    LUMINOUS_EFFICACY * f64::from(out[0][1])
}

fn probe(light: &dyn SkyLight, settings: ProbeSettings) -> Probe {
    render(light, &ProbeSettings { color_space: ColorSpace::Xyz, ..settings }, &Progress::silent()).unwrap()
}

#[test]
fn the_full_moon_near_the_zenith_gives_a_quarter_of_a_lux() {
    // Phase 6.4 degrees, 2.6 degrees from the zenith, 386 240 km away.
    let sky = sky(21.0, 0.0, 0.0, "2022-11-09T00:00:00Z");
    let moon = &sky.bodies_of_place().unwrap().moon.body;
    assert!(moon.altitude_deg > 87.0 && (6.0..7.0).contains(&moon.phase_angle_deg.unwrap()));
    let parts = sky.illuminance(&Progress::silent()).unwrap();
    let probe = probe(&light(&sky), ProbeSettings { width: 1024, ..Default::default() });
    let lux = LUMINOUS_EFFICACY * probe.irradiance(DVec3::Z)[1];
    println!("full Moon: {lux:.4} lx of the probe, {parts:?}");
    // checked against: Kyba, Mohar & Posch 2017, Astronomy & Geophysics 58, 1.31: up to 0.32 lx, at perigee high over the tropics; Krisciunas & Schaefer 1991, eqs. 8 and 20:
    // 0.27 lx outside the air at this phase, of which clear air lets 0.2 lx through directly
    assert!((0.2..0.32).contains(&lux), "{lux}");
    assert!((0.19..0.27).contains(&parts.moon_normal_lx), "{parts:?}");
    assert!((lux / parts.global_horizontal_lx - 1.0).abs() < 0.005, "{lux} {parts:?}");
}

#[test]
fn zodiacal_light_without_air_is_the_table() {
    // checked against: Leinert et al. 1998, table 17 [1e-11 W m-2 sr-1 nm-1 at 500 nm]
    for (longitude, latitude, value) in
        [(180.0, 0.0, 230.0), (90.0, 0.0, 259.0), (0.0, 90.0, 77.0), (120.0, 30.0, 113.0), (-60.0, 15.0, 292.0)]
    {
        // By the clock round: wherever the node is above the horizon.
        let found = (0..24).find_map(|hour| {
            let when = time("2021-03-20T00:00:00Z").plus_hours(f64::from(hour)).unwrap();
            let sky = Sky::new(place(30.0, 0.0, 0.0), when, SunModel::Iau, NO_AIR.clone()).unwrap();
            let sky = sky.with_night(NightOptions { when: When::Always, ..Default::default() }).unwrap();
            let bodies = sky.bodies_of_place().unwrap();
            let ecliptic = direction(bodies.sun_ecliptic_longitude_deg + longitude, latitude);
            let node = bodies.observer.to_horizon() * (icrs_to_ecliptic_j2000().transpose() * ecliptic);
            (node.z > 0.3).then(|| luminance(&light(&sky).only(Layer::Zodiacal), node))
        });
        // By the source's formula: redder than the Sun, less at 90 degrees from it and beyond than at 30.
        let elongation = (longitude.to_radians().cos() * latitude.to_radians().cos()).acos().to_degrees();
        let far = ((elongation - 30.0) / 60.0).clamp(0.0, 1.0);
        let (blue, red) = (1.2 + (0.9 - 1.2) * far, 0.8 + (0.6 - 0.8) * far);
        let per_value: f64 = (360..=830)
            .map(f64::from)
            .map(|w| {
                let reddening = 1.0 + if w < 500.0 { blue } else { red } * (w / 500.0).log10();
                observer::matching_functions(w)[1] * reddening * solar::irradiance(w, 10.0) / solar::irradiance(500.0, 10.0)
            })
            .sum();
        let ratio = found.unwrap() / (LUMINOUS_EFFICACY * value * 1e-11 * per_value);
        assert!((ratio - 1.0).abs() < 0.004, "{longitude} {latitude}: {ratio}");
    }
}

/// Unit vector at ecliptic longitude and latitude [degrees].
fn direction(longitude_deg: f64, latitude_deg: f64) -> DVec3 {
    skyprobe::ephemeris::direction_from_longitude_latitude(longitude_deg, latitude_deg)
}

#[test]
fn layers_add_up_to_the_whole_and_follow_their_scales() {
    let night = NightOptions { bortle: Some(4), ..Default::default() };
    let sky = sky(21.0, 0.0, 0.0, "2022-11-09T03:00:00Z").with_night(night).unwrap();
    let whole = light(&sky);
    assert_eq!(whole.names(), Layer::ALL.into_iter().filter(|layer| whole.names().contains(layer)).collect::<Vec<_>>());
    for layer in Layer::ALL {
        assert!(whole.names().contains(&layer), "{}", layer.name());
    }
    let settings = || ProbeSettings { width: 512, color_space: ColorSpace::Xyz, ..Default::default() };
    let mut sum = vec![0.0_f64; 3 * 512 * 256];
    for layer in whole.names() {
        let part = probe(&whole.only(layer), settings());
        sum.iter_mut().zip(&part.pixels).for_each(|(sum, &value)| *sum += f64::from(value));
    }
    let all = probe(&whole, settings());
    for (value, sum) in all.pixels.iter().zip(&sum) {
        assert!((f64::from(*value) - sum).abs() <= 2e-5 * sum.abs() + 1e-14, "{value} {sum}");
    }
    let scales = [(Layer::Stars, 3.0), (Layer::Moon, 0.0), (Layer::Airglow, 0.5)].into();
    let options = LightOptions { layers: LayerScales(scales), ..Default::default() };
    let scaled = sky.light_by(&options, &Progress::silent()).unwrap();
    assert!(!scaled.names().contains(&Layer::Moon));
    let [three, one] = [&scaled, &whole].map(|light| light.only(Layer::Stars).points()[0].irradiance[1]);
    assert!((three / one - 3.0).abs() < 1e-6);
    let [half, full] = [&scaled, &whole].map(|light| luminance(&light.only(Layer::Airglow), DVec3::Z));
    assert!((half / full - 0.5).abs() < 1e-6);
    // Town light of Bortle's class 4: V 21.09 less the natural sky.
    let towns = luminance(&whole.only(Layer::LightPollution), DVec3::Z);
    let natural = 10_f64.powf(-0.4 * (22.0 - surface_brightness_of_luminance(1.0)));
    let expected = 10_f64.powf(-0.4 * (21.09 - surface_brightness_of_luminance(1.0))) - natural;
    assert!((towns / expected - 1.0).abs() < 0.02, "{towns} {expected}");
}

#[test]
fn the_night_comes_when_it_is_asked_for() {
    let names = |when: When, hour: &str| {
        let sky = sky(21.0, 0.0, 0.0, hour).with_night(NightOptions { when, ..Default::default() }).unwrap();
        light(&sky).names()
    };
    let (noon, midnight) = ("2022-11-09T12:00:00Z", "2022-11-09T00:00:00Z");
    assert!(names(When::Always, noon).contains(&Layer::Stars) && names(When::Auto, midnight).contains(&Layer::Stars));
    assert!(!names(When::Auto, noon).contains(&Layer::Stars) && names(When::Auto, noon).contains(&Layer::Planets));
    assert_eq!(names(When::Never, midnight), [Layer::Sky, Layer::Sun]);
    let put = Sky::with_sun(-30.0, 0.0, 0.0, AIR.clone()).unwrap();
    let put = put.with_night(NightOptions { when: When::Always, ..Default::default() }).unwrap();
    let put = light(&put);
    assert_eq!(put.names(), [Layer::Sky, Layer::Sun]);
    assert!(put.points().is_empty() && lux_of(&put) < 1e-6);
}

#[test]
fn stars_are_dimmed_by_the_law_of_bouguer() {
    let when = "2021-01-13T22:00:00+01:00";
    let dimmed = sky(55.71, 13.19, 0.0, when);
    let free = Sky::new(place(55.71, 13.19, 0.0), time(when), SunModel::Iau, NO_AIR.clone()).unwrap();
    let [seen, outside] = [&dimmed, &free].map(|sky| light(sky).only(Layer::Stars).points());
    let profile = AIR.profile();
    let count = profile.wavelengths_nm.len();
    let middle = (0..count).min_by_key(|&w| (profile.wavelengths_nm[w] - 550.0).abs() as i64).unwrap();
    let mut depth = 0.0;
    for (level, ends) in profile.altitudes_km.windows(2).enumerate() {
        for component in &profile.components {
            let of = |values: &[f64]| {
                0.5 * (ends[1] - ends[0]) * (values[level * count + middle] + values[(level + 1) * count + middle])
            };
            depth += of(&component.scattering_per_km) + of(&component.absorption_per_km);
        }
    }
    let mut near = 0;
    for point in &seen {
        // The brightest come first in both.
        let altitude = point.direction.z.asin().to_degrees();
        if (altitude - 30.0).abs() > 1.0 || near == 12 {
            continue;
        }
        let twin =
            outside.iter().max_by(|a, b| a.direction.dot(point.direction).total_cmp(&b.direction.dot(point.direction))).unwrap();
        let transmittance = point.irradiance[1] / twin.irradiance[1];
        // Luminous means over the spectrum are within a few per cent of the middle of it.
        let expected = (-depth / point.direction.z).exp();
        assert!((transmittance / expected - 1.0).abs() < 0.04, "{altitude}: {transmittance} {expected}");
        near += 1;
    }
    assert_eq!(near, 12);
}
