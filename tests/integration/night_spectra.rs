//! Spectra of the night against pictures of it: integrated with the observer's functions they are the pictures' X, Y and Z.

use crate::common::night::{place, time};
use glam::DVec3;
use skyprobe::atmosphere::AirParameters;
use skyprobe::ephemeris::SunModel;
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, Layer, LayerScales, LightOptions, NightOptions, Sky, SkyLight, When};
use skyprobe::spectrum::observer;
use skyprobe::units::LUMINOUS_EFFICACY;
use std::sync::{Arc, LazyLock};

/// Clear air at wavelengths that reach over all that the observer sees.
static AIR: LazyLock<Arc<Atmosphere>> = LazyLock::new(|| {
    let nodes: Vec<f64> = (0..24).map(|i| 360.0 + 470.0 / 23.0 * f64::from(i)).collect();
    Arc::new(Atmosphere::at_wavelengths(&AirParameters::default(), &nodes, Quality::Draft, true).unwrap())
});

const STEP_NM: f64 = 5.0;

/// From end to end of the observer's table.
fn wavelengths() -> Vec<f64> {
    (0..95).map(|i| 360.0 + STEP_NM * f64::from(i)).collect()
}

fn sky(latitude: f64, longitude: f64, elevation: f64, when: &str, night: NightOptions) -> Sky {
    let sky = Sky::new(place(latitude, longitude, elevation), time(when), SunModel::Iau, AIR.clone()).unwrap();
    sky.with_night(night).unwrap()
}

fn full_moon() -> Sky {
    sky(55.71, 13.19, 0.0, "2005-01-25T00:30:00+01:00", NightOptions::default())
}

fn moonless() -> Sky {
    sky(-24.63, -70.40, 2635.0, "2005-07-06T02:00:00Z", NightOptions { bortle: Some(3), star_limit: 5.0, ..Default::default() })
}

/// A crescent above dusk.
fn dusk() -> Sky {
    sky(55.71, 13.19, 0.0, "2005-04-10T20:40:00+02:00", NightOptions::default())
}

/// The Moon in the Earth's shadow.
fn eclipsed_moon() -> Sky {
    sky(19.82, -155.47, 4200.0, "2018-01-31T13:29:50Z", NightOptions::default())
}

/// Evenly over the sphere, sky and ground.
fn directions(count: u32) -> Vec<DVec3> {
    let one = |i: u32| {
        let z = 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(count);
        let (sin, cos) = (2.399_963 * f64::from(i)).sin_cos();
        DVec3::new((1.0 - z * z).sqrt() * sin, (1.0 - z * z).sqrt() * cos, z)
    };
    (0..count).map(one).collect()
}

/// X, Y and Z of spectral values at [`wavelengths`].
fn xyz(spectrum: &[f64]) -> [f64; 3] {
    let functions = wavelengths().into_iter().map(observer::matching_functions);
    spectrum.iter().zip(functions).fold([0.0; 3], |sum, (value, cmf)| std::array::from_fn(|k| sum[k] + STEP_NM * value * cmf[k]))
}

fn seen(light: &dyn SkyLight, direction: DVec3) -> [f64; 3] {
    let mut out = [[0.0; 3]];
    light.radiance_circle(direction.z.asin(), &[direction.x.atan2(direction.y)], &mut out);
    out[0].map(f64::from)
}

/// Largest deviation of the spectra's X, Y and Z from the picture's.
fn worst(name: &str, sky: &Sky) -> f64 {
    let progress = Progress::silent();
    let options = LightOptions { tolerance: Some(1e-3), ..Default::default() };
    let picture = sky.light_by(&options, &progress).unwrap();
    let directions = directions(300);
    let spectra = sky.spectral_radiance(&directions, &wavelengths(), &progress).unwrap();
    let (mut worst, mut sums) = ([0.0_f64; 3], [0.0; 3]);
    for (direction, spectrum) in directions.iter().zip(spectra.chunks_exact(wavelengths().len())) {
        let (got, expected) = (xyz(spectrum), seen(&picture, *direction));
        for k in 0..3 {
            let error = (got[k] / expected[k] - 1.0).abs();
            worst[k] = worst[k].max(error);
            sums[k] += error / directions.len() as f64;
        }
    }
    let percent = |values: [f64; 3]| values.map(|value| format!("{:.3} %", 100.0 * value)).join(", ");
    println!("{name}: worst {}; mean {}", percent(worst), percent(sums));
    worst.into_iter().fold(0.0, f64::max)
}

#[test]
fn spectra_of_nights_and_twilight_integrate_to_their_pictures() {
    for (name, sky) in
        [("full Moon", full_moon()), ("no Moon", moonless()), ("dusk", dusk()), ("eclipse of the Moon", eclipsed_moon())]
    {
        assert!(worst(name, &sky) < 0.005, "{name}");
    }
}

#[test]
fn each_diffuse_light_has_its_spectrum() {
    let progress = Progress::silent();
    let sky = moonless();
    let all = sky.spectral_radiance(&[DVec3::Z], &wavelengths(), &progress).unwrap();
    // What the layers show, one by one, is there, and nothing else.
    let picture = sky.light_by(&LightOptions::default(), &progress).unwrap();
    let layers = [Layer::Airglow, Layer::Zodiacal, Layer::MilkyWay, Layer::LightPollution];
    let sum: f64 = layers.into_iter().map(|layer| seen(&picture.only(layer), DVec3::Z)[1]).sum();
    assert!((xyz(&all)[1] / sum - 1.0).abs() < 0.005, "{} {sum}", xyz(&all)[1]);
    // The green line of oxygen: 200 rayleigh at the mean, scaled to the brightness of the zenith, spread over 10 nm.
    let at = |wavelength: f64| sky.spectral_radiance(&[DVec3::Z], &[wavelength], &progress).unwrap()[0];
    let line = at(557.7) - 0.5 * (at(545.0) + at(571.0));
    let rayleigh = 1e10 / (4.0 * std::f64::consts::PI) * 6.626_070_15e-34 * 299_792_458.0 / 557.7e-9;
    let strength = 10.0 * line / rayleigh;
    println!("green line: {strength:.0} R through the air");
    assert!((100.0..200.0).contains(&strength), "{strength}");
}

#[test]
fn irradiance_integrates_to_illuminance() {
    let progress = Progress::silent();
    for (name, sky) in
        [("full Moon", full_moon()), ("no Moon", moonless()), ("dusk", dusk()), ("eclipse of the Moon", eclipsed_moon())]
    {
        let (spectral, lux) = (sky.irradiance(&wavelengths(), &progress).unwrap(), sky.illuminance(&progress).unwrap());
        for (part, spectrum, expected) in [
            ("Moon", &spectral.moon_normal, lux.moon_normal_lx),
            ("Moon, horizontal", &spectral.moon_horizontal, lux.moon_horizontal_lx),
            ("diffuse", &spectral.diffuse_horizontal, lux.diffuse_horizontal_lx),
            ("global", &spectral.global_horizontal, lux.global_horizontal_lx),
        ] {
            let got = LUMINOUS_EFFICACY * xyz(spectrum)[1];
            println!("{name}, {part}: {got:.6e} lx, {expected:.6e} lx, {:+.3} %", 100.0 * (got / expected - 1.0));
            assert!((got - expected).abs() <= 0.005 * expected, "{name}, {part}: {got} {expected}");
        }
    }
}

#[test]
fn moonlight_is_polarised_as_sunlight_is_and_the_rest_is_not() {
    let (progress, green) = (Progress::silent(), [550.0]);
    let sky = full_moon();
    let directions = directions(40);
    let of = |sky: &Sky| sky.stokes(&directions, &green, &progress).unwrap();
    let all = of(&sky);
    let radiance = sky.spectral_radiance(&directions, &green, &progress).unwrap();
    // The Sun in the Moon's place.
    let moon = &sky.bodies_of_place().unwrap().moon.body;
    let day = Sky::with_sun(moon.altitude_deg, moon.azimuth_deg, 0.0, AIR.clone()).unwrap();
    let sunlit = of(&day);
    let moonlit = |i: usize, k: usize| sunlit[3 * i + k] / sunlit[1].hypot(sunlit[2]) * all[1].hypot(all[2]);
    for i in 0..directions.len() {
        assert!((all[3 * i] / radiance[i] - 1.0).abs() < 1e-12);
        for k in [1, 2] {
            assert!((all[3 * i + k] - moonlit(i, k)).abs() < 1e-4 * all[3 * i], "{i} {k}: {} {}", all[3 * i + k], moonlit(i, k));
        }
        // Diffuse light, here some hundredth, is added to I alone.
        let (with, without) = (all[3 * i] / moonlit(i, 0), 1.0);
        assert!(with > without && with < 1.1, "{i}: {with}");
    }
    let dark = of(&moonless());
    assert!(dark.chunks_exact(3).all(|s| s[0] > 1e-11 && s[1].abs() < 1e-5 * s[0] && s[2].abs() < 1e-5 * s[0]));
}

#[test]
fn the_options_of_the_night_hold() {
    let progress = Progress::silent();
    let zenith = |night: NightOptions, when: &str| {
        let sky = sky(55.71, 13.19, 0.0, when, night);
        let radiance = sky.spectral_radiance(&[DVec3::Z], &[550.0], &progress).unwrap()[0];
        (radiance, sky.irradiance(&[550.0], &progress).unwrap())
    };
    let (midnight, noon) = ("2005-01-25T00:30:00+01:00", "2005-01-25T12:00:00+01:00");
    let of = |when: When| NightOptions { when, ..Default::default() };
    let [never, auto, town] = [of(When::Never), of(When::Auto), NightOptions { bortle: Some(9), ..Default::default() }]
        .map(|night| zenith(night, midnight));
    assert!(never.0 < 1e-20 && never.1.moon_normal == [0.0] && never.1.global_horizontal[0] < 1e-20, "{never:?}");
    assert!(auto.0 > 1e-9 && town.0 > 1.5 * auto.0, "{auto:?} {town:?}");
    // By day the lights of the night are left out, as from pictures, but for the Moon's disc; asked for, they are there.
    let [by_day, sunlight, always] = [When::Auto, When::Never, When::Always].map(|when| zenith(of(when), noon));
    assert_eq!((by_day.0, &by_day.1.diffuse_horizontal), (sunlight.0, &sunlight.1.diffuse_horizontal));
    assert!(always.0 > by_day.0 && always.0 < 1.001 * by_day.0);
    assert!(always.1.diffuse_horizontal > by_day.1.diffuse_horizontal);
    // A Sun that is put has no night.
    let put = Sky::with_sun(-30.0, 0.0, 0.0, AIR.clone()).unwrap().with_night(of(When::Always)).unwrap();
    assert!(put.spectral_radiance(&[DVec3::Z], &[550.0], &progress).unwrap()[0] < 1e-12);
}

/// Spectra need no colour: one wavelength is enough.
#[test]
fn air_of_one_wavelength_has_a_night() {
    let progress = Progress::silent();
    let one = Arc::new(Atmosphere::at_wavelengths(&AirParameters::default(), &[550.0], Quality::Draft, true).unwrap());
    let night = |air: &Arc<Atmosphere>| {
        let sky = Sky::new(place(55.71, 13.19, 0.0), time("2005-01-25T00:30:00+01:00"), SunModel::Iau, air.clone()).unwrap();
        let radiance = sky.spectral_radiance(&[DVec3::Z], &[550.0], &progress).unwrap()[0];
        (radiance, sky.irradiance(&[550.0], &progress).unwrap().global_horizontal[0], sky)
    };
    let (alone, among) = (night(&one), night(&AIR));
    // Ozone is averaged over narrower bands where there are more wavelengths.
    assert!(
        (alone.0 / among.0 - 1.0).abs() < 0.01 && (alone.1 / among.1 - 1.0).abs() < 0.01,
        "{alone:?} {among:?}",
        alone = alone.0,
        among = among.0
    );
    let picture = alone.2.light_by(&LightOptions { layers: LayerScales::default(), ..Default::default() }, &progress);
    assert!(picture.err().unwrap().to_string().contains("to make a colour"));
}
