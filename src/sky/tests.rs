use super::composition::lamp;
use super::sunlight::Sunlight;
use super::*;
use crate::atmosphere::AirParameters;
use crate::ephemeris::{Place, SunModel};
use crate::error::Error;
use crate::progress::Progress;
use crate::quality::Quality;
use crate::spectrum::{ColorSpace, Gamut};
use crate::time::{Time, ZoneChoice};
use crate::units::Scale;
use glam::DVec3;
use std::sync::Arc;

fn sky(atmosphere: &Arc<Atmosphere>, altitude_deg: f64, elevation_m: f64) -> Sky {
    Sky::with_sun(altitude_deg, 200.0, elevation_m, Arc::clone(atmosphere)).unwrap()
}

/// XYZ by one gather in just this direction.
fn directly(sky: &Sky, altitude: f64, azimuth: f64) -> [f64; 3] {
    let field = sky.field(&Progress::silent()).unwrap();
    let from_sun = azimuth - sky.sun().azimuth_deg.to_radians();
    let gathered = field.gather(&sky.observer(), altitude.sin(), &[from_sun]);
    let sun = sky.sun().altitude_deg.to_radians();
    let cosine = altitude.sin() * sun.sin() + altitude.cos() * sun.cos() * from_sun.cos();
    let mut xyz = [0.0; 3];
    for (w, weight) in Sunlight::of(sky).xyz_weights().unwrap().iter().enumerate() {
        let value = field.radiance(&gathered, 0, w, cosine);
        for k in 0..3 {
            xyz[k] += value * weight[k];
        }
    }
    xyz
}

/// Rms and largest relative error of Y of `dome` against gathers in just those directions, and where the largest is.
fn errors(sky: &Sky, dome: &SkyDome) -> (f64, (f64, f64, f64)) {
    let mut squares = 0.0;
    let mut worst = (0.0_f64, 0.0, 0.0);
    let n = 300;
    for i in 0..n {
        // Spiral over the whole sphere.
        let altitude = (1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(n)).asin();
        let azimuth = 2.399_963 * f64::from(i) % std::f64::consts::TAU;
        let mut seen = [[0.0; 3]];
        dome.radiance_circle(altitude, &[azimuth], &mut seen);
        let expected = directly(sky, altitude, azimuth);
        let error = f64::from(seen[0][1]) / expected[1] - 1.0;
        squares += error * error;
        if error.abs() > worst.0.abs() {
            worst = (error, altitude.to_degrees(), azimuth.to_degrees());
        }
    }
    ((squares / f64::from(n)).sqrt(), worst)
}

const SUNS_AND_HEIGHTS: [(f64, f64); 6] = [(60.0, 0.0), (20.0, 0.0), (3.0, 0.0), (-2.0, 0.0), (-6.0, 0.0), (30.0, 10_000.0)];

#[test]
fn the_dome_is_what_is_gathered_in_each_direction() {
    let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    for (sun, elevation) in SUNS_AND_HEIGHTS {
        let sky = sky(&atmosphere, sun, elevation);
        let (rms, worst) = errors(&sky, &sky.light(&Progress::silent()).unwrap());
        println!(
            "Sun {sun}, {elevation} m: rms {:.3} %, worst {:+.2} % at {:.1} {:.1}",
            100.0 * rms,
            100.0 * worst.0,
            worst.1,
            worst.2
        );
        assert!(rms < 0.01 && worst.0.abs() < 0.05, "Sun at {sun}: rms {rms}, worst {worst:?}");
    }
}

#[test]
fn a_tolerance_holds_and_a_looser_one_costs_less() {
    let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    for (sun, elevation) in SUNS_AND_HEIGHTS {
        let sky = sky(&atmosphere, sun, elevation);
        let mut costs = Vec::new();
        let mut found = Vec::new();
        for tolerance in [0.2, 0.05, 0.01, 0.001] {
            let dome = sky.filtered_light(None, Some(tolerance), &Progress::silent()).unwrap();
            let (rms, worst) = errors(&sky, &dome);
            costs.push(dome.sample_directions().len());
            found.push(rms);
            println!(
                "Sun {sun}, {elevation} m, tolerance {tolerance}: {} samples, rms {:.4} %, worst {:+.3} % at {:.1} {:.1}",
                costs[costs.len() - 1],
                100.0 * rms,
                100.0 * worst.0,
                worst.1,
                worst.2
            );
            assert!(rms < 2.0 * tolerance, "Sun at {sun}: rms {rms}, worst {worst:?}");
        }
        assert!(costs.is_sorted() && costs[0] < costs[3], "{costs:?}");
        assert!(found[3] < 0.6 * found[0], "{found:?}");
    }
    let low = sky(&atmosphere, 10.0, 0.0);
    let refused = low.filtered_light(None, Some(0.0), &Progress::silent()).err().unwrap().to_string();
    assert!(refused.starts_with("tolerance = 0: must be a number from 0.0001 to 0.5"), "{refused}");
}

/// Through a filter the light is I + strength (Q cos 2c + U sin 2c) of the Stokes parameters, at every side of the Sun.
#[test]
fn a_tolerance_holds_through_a_filter_too() {
    let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    let sky = sky(&atmosphere, 25.0, 0.0);
    let filter = PolarisingFilter { strength: 0.9, angle_deg: 35.0, held_towards_deg: Some([30.0, 100.0]) };
    let dome = sky.filtered_light(Some(&filter), Some(0.01), &Progress::silent()).unwrap();
    let weights = Sunlight::of(&sky).xyz_weights().unwrap();
    let field = sky.field(&Progress::silent()).unwrap();
    let light = &air_light::air_lights(&sky, field, &[], &Progress::silent()).unwrap()[0];
    let mut squares = 0.0;
    let n = 150;
    for i in 0..n {
        let altitude = (1.0 - (f64::from(i) + 0.5) / f64::from(n)).asin();
        let azimuth = 2.399_963 * f64::from(i) % std::f64::consts::TAU;
        let direction = DVec3::new(altitude.cos() * azimuth.sin(), altitude.cos() * azimuth.cos(), altitude.sin());
        let [q, u] = filter.weights(altitude, azimuth);
        let rows = sky
            .gather_each(field, light, &[direction], &Progress::silent(), |gathered, look| {
                let through = |w: usize| {
                    let stokes = field.stokes(gathered, 0, w, look.transverse, look.cosine);
                    (stokes[0] + q * stokes[1] + u * stokes[2]) * weights[w][1]
                };
                (0..gathered.wavelengths).map(through).sum::<f64>()
            })
            .unwrap();
        let mut seen = [[0.0; 3]];
        dome.radiance_circle(altitude, &[azimuth], &mut seen);
        squares += (f64::from(seen[0][1]) / rows[0] - 1.0).powi(2);
    }
    let rms = (squares / f64::from(n)).sqrt();
    println!("through a filter: {} samples, rms {:.4} %", dome.sample_directions().len(), 100.0 * rms);
    assert!(rms < 0.01, "{rms}");
}

/// North turns the finished picture where it is shown (a mapping, a transform): it is no part of a probe and cannot cause a solve either.
#[test]
fn a_new_time_place_height_or_sun_needs_no_new_solve() {
    let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    assert!(!atmosphere.is_solved());
    let stages = std::sync::Mutex::new(Vec::new());
    let listen = |stage: &str, _: f64| {
        stages.lock().unwrap().push(stage.to_string());
        true
    };
    let progress = Progress::new(&listen);
    sky(&atmosphere, 30.0, 0.0).light(&progress).unwrap();
    assert!(stages.lock().unwrap().iter().any(|stage| stage == "solve"));
    stages.lock().unwrap().clear();
    sky(&atmosphere, -3.0, 2500.0).light(&progress).unwrap();
    for (latitude, longitude, elevation, text, model) in [
        (55.7, 13.2, 0.0, "2005-06-21T11:00Z", SunModel::Iau),
        (55.7, 13.2, 0.0, "2005-06-21T20:30Z", SunModel::Iau),
        (-33.9, 151.2, 0.0, "2005-06-21T20:30Z", SunModel::Iau),
        (-33.9, 151.2, 8000.0, "2005-06-21T20:30Z", SunModel::Iau),
        (-33.9, 151.2, 8000.0, "2005-06-21T20:30Z", SunModel::Thesis),
    ] {
        let place = Place::new(latitude, longitude, elevation).unwrap();
        let time = Time::parse(text, crate::time::ZoneChoice::Named("UTC")).unwrap();
        let sky = Sky::new(place, time, model, Arc::clone(&atmosphere)).unwrap();
        sky.filtered_light(Some(&PolarisingFilter::default()), Some(0.1), &progress).unwrap();
        sky.illuminance(&progress).unwrap();
    }
    let stages = stages.lock().unwrap();
    assert!(!stages.is_empty() && stages.iter().all(|stage| stage == "gather"), "{stages:?}");
}

#[test]
fn cancelling_leaves_the_air_unsolved_and_usable() {
    let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap());
    let stop = |_: &str, fraction: f64| fraction < 0.2;
    assert!(matches!(atmosphere.solve(&Progress::new(&stop)), Err(Error::Cancelled)));
    assert!(!atmosphere.is_solved());
    assert!(atmosphere.solve(&Progress::silent()).is_ok());
}

/// Lamps get these: what a renderer cannot have is not in them, and their luminance is that of the light.
#[test]
fn colours_of_sun_and_moon_are_in_their_space_however_low_they_stand() {
    let clear = AirParameters::default();
    let haze = AirParameters { aod550: Some(2.0), ..AirParameters::default() };
    let (scale, silent) = (Scale::Luminance, Progress::silent());
    let spaces = [ColorSpace::LinRec709, ColorSpace::AcesCg, ColorSpace::LinRec2020, ColorSpace::Xyz];
    let check = |of: &dyn Fn(ColorSpace, Gamut) -> [f64; 3], what: &str| {
        let [_, luminance, _] = of(ColorSpace::Xyz, Gamut::Keep);
        let mut outside = false;
        for space in spaces {
            let rgb = of(space, Gamut::Desaturate);
            assert!(rgb.iter().all(|&value| value >= 0.0), "{what} {space:?}: {rgb:?}");
            let found = crate::spectrum::color_space::transform(&space.matrix_to_xyz(), rgb)[1];
            assert!((found - luminance).abs() <= 1e-9 * luminance, "{what} {space:?}: {found} is not {luminance}");
            outside |= of(space, Gamut::Keep).iter().any(|&value| value < 0.0);
        }
        (luminance > 0.0, outside)
    };
    let mut outside = 0;
    for air in [clear, haze] {
        let atmosphere = Arc::new(Atmosphere::new(&air, Quality::Draft, true).unwrap());
        for altitude in [30.0, 4.0, 2.0, 1.0, 0.0, -0.4, -0.75, -3.0] {
            let sky = sky(&atmosphere, altitude, 0.0);
            let (_, negative) =
                check(&|space, gamut| sky.sun_irradiance_rgb(scale, space, gamut, &silent).unwrap(), &altitude.to_string());
            outside += usize::from(negative);
        }
        // The Moon rises reddened, and in the shadow of the Earth it is red up high.
        for (latitude, longitude, text) in [(55.7, 13.2, "2005-01-25T15:27Z"), (20.0, -156.0, "2018-01-31T13:29:50Z")] {
            let place = Place::new(latitude, longitude, 0.0).unwrap();
            let time = Time::parse(text, crate::time::ZoneChoice::Named("UTC")).unwrap();
            let sky = Sky::new(place, time, SunModel::Iau, Arc::clone(&atmosphere)).unwrap();
            let (seen, _) = check(&|space, gamut| sky.moon_irradiance_rgb(scale, space, gamut, &silent).unwrap(), text);
            assert!(seen, "{text}");
        }
    }
    assert!(outside >= 5, "the test has colours outside Rec. 709");
}

/// What a gamut makes of a colour that is not finite looks sound.
#[test]
fn light_that_is_not_finite_is_an_error_before_its_colour_is_changed() {
    let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap());
    let silent = Progress::silent();
    for distance_au in [0.0, f64::NAN] {
        let sky = sky(&atmosphere, 30.0, 0.0).with_sun_distance_au(distance_au);
        for gamut in [Gamut::Keep, Gamut::Clip, Gamut::Desaturate] {
            let lamp = sky.sun_irradiance_rgb(Scale::Luminance, ColorSpace::LinRec709, gamut, &silent);
            assert!(matches!(lamp, Err(Error::Data { .. })), "{distance_au} {gamut:?}: {lamp:?}");
        }
        assert!(matches!(sky.illuminance(&silent), Err(Error::Data { .. })), "{distance_au}");
        assert!(matches!(sky.irradiance(&[550.0], &silent), Err(Error::Data { .. })), "{distance_au}");
    }
    let lamp = lamp([1.0, f64::NAN, 1.0], Scale::Luminance, ColorSpace::LinRec709, Gamut::Clip);
    assert!(matches!(lamp, Err(Error::Data { .. })), "{lamp:?}");
}

/// By the colours of a dome, and by spectra that are gathered in each of very many directions.
#[test]
fn the_illuminance_of_the_sky_is_the_integral_of_its_spectra() {
    use crate::sky::irradiance::Nodes;
    for parameters in [AirParameters::default(), AirParameters { aod550: Some(0.6), ..AirParameters::default() }] {
        let atmosphere = Arc::new(Atmosphere::new(&parameters, Quality::Standard, true).unwrap());
        // Gathering in few directions is 1.6e-3 off under the highest of these Suns, whose aureole is at the zenith.
        for (altitude, tolerance) in [(88.0, 1e-3), (40.0, 1e-3), (8.0, 1e-3), (0.0, 1e-3), (-4.0, 1e-3), (-10.0, 2e-3)] {
            let sky = sky(&atmosphere, altitude, 0.0);
            let field = sky.field(&Progress::silent()).unwrap();
            let weights = Sunlight::of(&sky).sky_weights().unwrap();
            let by_spectra = |nodes: Nodes| {
                let spectrum = Sunlight::of(&sky).diffuse_horizontal(field, nodes, &Progress::silent()).unwrap();
                crate::units::LUMINOUS_EFFICACY * spectrum.iter().zip(&weights).map(|(value, w)| value * w[1]).sum::<f64>()
            };
            let exact = by_spectra(Nodes { circles: 96, azimuths: 400 });
            let found = sky.illuminance(&Progress::silent()).unwrap().diffuse_horizontal_lx;
            let few = by_spectra(Nodes::FEW);
            println!("Sun {altitude}: {found} lx, {:+.2e}; by few spectra {:+.2e}", found / exact - 1.0, few / exact - 1.0);
            assert!((found / exact - 1.0).abs() < tolerance, "Sun {altitude}: {found} is not {exact}");
        }
    }
}

/// Without air there is only the Sun: its illuminance is that of the solar spectrum.
#[test]
fn outside_the_air_the_sun_has_its_whole_illuminance() {
    let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap());
    let high = sky(&atmosphere, 60.0, 60_000.0).illuminance(&Progress::silent()).unwrap();
    // checked against: Darula, Kittler & Gueymard 2005, luminous solar constant 133.334 klx; ozone below 60 km and 380-740 nm take part of a per cent.
    assert!((high.direct_normal_lx / 133_334.0 - 1.0).abs() < 0.005, "{high:?}");
    assert!(high.diffuse_horizontal_lx < 100.0, "{high:?}");
}

#[test]
fn the_air_refracts_as_the_standard_atmosphere() {
    let atmosphere = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, false).unwrap());
    // checked against: an independent ray trace (Auer-Standish integral) of the US Standard Atmosphere 1976, 550 nm, sea level:
    // refraction in arc minutes by apparent altitude in degrees.
    for (apparent_deg, minutes) in
        [(0.0, 33.009), (0.5, 27.652), (1.0, 23.543), (2.0, 17.785), (5.0, 9.664), (10.0, 5.222), (20.0, 2.598), (45.0, 0.953)]
    {
        let seen = sky(&atmosphere, apparent_deg - minutes / 60.0, 0.0).sun().apparent_altitude_deg;
        assert!((seen - apparent_deg).abs() < 0.005 * minutes / 60.0, "{apparent_deg}: {seen}");
    }
}

#[test]
fn the_layers_that_are_named_are_those_that_are_made() {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    let place = Place::new(55.7, 13.2, 0.0).unwrap();
    let night = NightOptions { star_limit: 3.0, ..Default::default() };
    for (text, night, model, count) in [
        ("2005-06-21T13:00:00+02:00", night, Model::Scattering, 4),
        ("2005-01-10T23:00:00+01:00", night, Model::Scattering, 8),
        ("2005-01-10T23:00:00+01:00", NightOptions { bortle: Some(5), ..night }, Model::Scattering, 9),
        ("2005-01-10T23:00:00+01:00", NightOptions { when: When::Never, ..night }, Model::Scattering, 2),
        ("2005-06-21T13:00:00+02:00", NightOptions { when: When::Always, ..night }, Model::Scattering, 8),
        ("2005-06-21T13:00:00+02:00", NightOptions { when: When::Always, ..night }, Model::Preetham, 2),
    ] {
        let time = Time::parse(text, ZoneChoice::InText).unwrap();
        let sky = Sky::new(place, time, SunModel::Iau, air.clone()).unwrap().with_night(night).unwrap();
        let named = sky.layers_by(model);
        assert_eq!(named, sky.light_by(&model.into(), &Progress::silent()).unwrap().names(), "{text} {night:?}");
        assert_eq!(named.len(), count, "{text} {night:?}");
    }
    let put = Sky::with_sun(-20.0, 0.0, 0.0, air).unwrap();
    assert_eq!(put.layers_by(Model::Scattering), [Layer::Sky, Layer::Sun]);
}

#[test]
fn a_sky_says_whether_it_has_other_light_than_the_suns() {
    let air = Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap());
    let lund = Place::new(55.7, 13.2, 0.0).unwrap();
    let at = |text: &str, place: Place, when: When| {
        let time = Time::parse(text, ZoneChoice::InText).unwrap();
        let sky = Sky::new(place, time, SunModel::Iau, air.clone()).unwrap();
        sky.with_night(NightOptions { when, ..Default::default() }).unwrap().has_more_than_sunlight()
    };
    let (noon, midnight) = ("2005-06-21T13:00:00+02:00", "2005-01-10T00:30:00+01:00");
    assert!(!at(noon, lund, When::Auto) && at(noon, lund, When::Always));
    assert!(at(midnight, lund, When::Auto) && at(midnight, lund, When::Always) && !at(midnight, lund, When::Never));
    // The Sun totally eclipsed over Reims.
    assert!(at("1999-08-11T10:26:30Z", Place::new(49.254, 4.03, 100.0).unwrap(), When::Auto));
    let put = |altitude: f64| Sky::with_sun(altitude, 0.0, 0.0, air.clone()).unwrap().has_more_than_sunlight();
    assert!(!put(30.0) && !put(-6.0) && put(-20.0) && put(-90.0));
}
