use super::*;
use crate::atmosphere::{AirParameters, Phase};
use crate::progress::Progress;
use crate::quality::Quality;
use std::f64::consts::PI;
use std::sync::LazyLock;

const ALBEDO: f64 = 0.3;

/// Molecules, ozone and aerosol over a ground.
static CLEAR: LazyLock<LightField> = LazyLock::new(|| field(true, Quality::High));

/// The same without aerosol: no forward peak.
static WITHOUT_HAZE: LazyLock<LightField> = LazyLock::new(|| field(false, Quality::High));

const WAVELENGTHS_NM: [f64; 4] = [400.0, 500.0, 600.0, 700.0];

fn field(haze: bool, quality: Quality) -> LightField {
    let mut profile = AirParameters::default().optical_profile(&WAVELENGTHS_NM).unwrap();
    profile.ground_albedo = vec![ALBEDO; WAVELENGTHS_NM.len()];
    profile.components.retain(|component| haze || matches!(component.phase, None | Some(Phase::Rayleigh { .. })));
    LightField::solve(&profile, &quality.numbers(), true, &Progress::silent()).unwrap()
}

fn segments(field: &LightField, observer: &Observer, mu: f64, azimuth: f64, distances_km: &[f64]) -> Segments {
    let mut out = Segments::default();
    field.segments(observer, mu, &[azimuth], distances_km, &mut out);
    out
}

/// (altitude [km], cosine of the view's zenith angle, azimuth, solar zenith angle [degrees]).
const CASES: [(f64, f64, f64, f64); 9] = [
    (0.0, 1.0, 0.0, 60.0),
    (0.0, 0.3, 1.0, 40.0),
    (0.0, 0.02, 2.5, 75.0),
    (0.0, 0.0, 0.6, 88.0),
    (2.0, -0.3, 2.0, 50.0),
    (10.0, -0.04, 1.3, 70.0),
    (30.0, -1.0, 0.0, 80.0),
    (0.5, 0.2, 0.4, 96.0),
    (400.0, -0.5, 1.0, 30.0),
];

fn look((altitude_km, mu, azimuth, sun_zenith_deg): (f64, f64, f64, f64)) -> (Observer, f64, f64) {
    (Observer { altitude_km, sun_zenith: sun_zenith_deg.to_radians() }, mu, azimuth)
}

/// Distance to the ground of `field` [km], and what it shines with, by wavelength [sr-1].
fn ground(field: &LightField, observer: &Observer, mu: f64, azimuth: f64) -> Option<(f64, Vec<f64>)> {
    let radius = field.blocks[0].air.radius;
    let r0 = radius + observer.altitude_km;
    let square = radius * radius - r0 * r0 * (1.0 - mu * mu);
    if mu >= 0.0 || square <= 0.0 {
        return None;
    }
    let distance = -r0 * mu - square.sqrt();
    let on_ray = SunOnRay::new(r0, mu, (azimuth.cos(), azimuth.sin()), observer.sun_zenith.sin_cos());
    let zenith = on_ray.zenith_cosine(distance, radius).acos();
    Some((distance, field.ground_irradiance(zenith).iter().map(|e| e * ALBEDO / PI).collect()))
}

#[test]
fn the_end_of_a_ray_has_the_light_of_the_sky_and_the_ground() {
    let mut worst = 0.0_f64;
    for case in CASES {
        let (observer, mu, azimuth) = look(case);
        let gathered = CLEAR.gather(&observer, mu, &[azimuth]);
        let cosine = SunOnRay::new(1.0, mu, (azimuth.cos(), azimuth.sin()), observer.sun_zenith.sin_cos()).scattering_cosine;
        let lit = ground(&CLEAR, &observer, mu, azimuth);
        let far = lit.as_ref().map_or(f64::INFINITY, |(distance, _)| *distance);
        let out = segments(&CLEAR, &observer, mu, azimuth, &[0.0, 0.3, 7.0, far, f64::INFINITY]);
        for w in 0..WAVELENGTHS_NM.len() {
            let seen = CLEAR.radiance(&gathered, 0, w, cosine);
            for end in [3, 4] {
                let behind = lit.as_ref().map_or(0.0, |(_, radiance)| radiance[w] * out.transmittance(end)[w]);
                worst = worst.max(((out.radiance(0, end)[w] + behind) / seen - 1.0).abs());
            }
            assert_eq!((out.radiance(0, 0)[w], out.transmittance(0)[w]), (0.0, 1.0));
            assert!((0..4).all(|d| out.radiance(0, d)[w] <= out.radiance(0, d + 1)[w] * (1.0 + 2e-3)));
            assert!((0..4).all(|d| out.transmittance(d)[w] * (1.0 + 1e-6) >= out.transmittance(d + 1)[w]));
        }
    }
    println!("end of the ray against the gathered light: {worst:.1e}");
    assert!(worst < 1e-5, "{worst}");
}

/// What is found at a distance does not hang on which other distances and azimuths are asked for.
#[test]
fn distances_and_azimuths_do_not_disturb_each_other() {
    let (observer, mu, azimuth) = look(CASES[4]);
    let alone = segments(&CLEAR, &observer, mu, azimuth, &[3.0]);
    let mut many = segments(&CLEAR, &observer, 0.4, 0.1, &[1.0, 2.0, 30.0]);
    CLEAR.segments(&observer, mu, &[0.2, azimuth], &[0.01, 2.9, 3.0, 3.0, 3.1], &mut many);
    for d in [2, 3] {
        assert_eq!(many.transmittance(d), alone.transmittance(0));
        for (a, b) in many.radiance(1, d).iter().zip(alone.radiance(0, 0)) {
            assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
        }
    }
}

/// The worst errors of two parts against the whole.
#[derive(Clone, Copy, Debug, Default)]
struct Halves {
    /// Relative, of the light of parts that end before the ray does.
    light: f64,
    /// The same, of parts up to the end of the ray.
    to_the_end: f64,
    /// Of the product of the transmittances.
    transmittance: f64,
}

fn halves(field: &LightField) -> Halves {
    let mut worst = Halves::default();
    for case in CASES {
        let (observer, mu, azimuth) = look(case);
        let r0 = field.blocks[0].air.radius + observer.altitude_km;
        let ground = ground(field, &observer, mu, azimuth).map(|(distance, _)| distance);
        let end = ground.unwrap_or(200.0);
        for (a, b) in [(0.1, 0.3), (0.05, 0.9), (0.3, 0.6), (0.5, 1.0)].map(|(a, b)| (a * end, b * end)) {
            let whole = segments(field, &observer, mu, azimuth, &[a, b]);
            // The place at `a`, with its own zenith and its own Sun.
            let radius = (r0 * r0 + 2.0 * r0 * mu * a + a * a).sqrt();
            let on_ray = SunOnRay::new(r0, mu, (azimuth.cos(), azimuth.sin()), observer.sun_zenith.sin_cos());
            let there = Observer {
                altitude_km: observer.altitude_km + (2.0 * r0 * mu * a + a * a) / (radius + r0),
                sun_zenith: on_ray.zenith_cosine(a, radius).acos(),
            };
            let mu_there = ((r0 * mu + a) / radius).clamp(-1.0, 1.0);
            let (sun_sine, sun_cosine) = there.sun_zenith.sin_cos();
            let sine = (1.0 - mu_there * mu_there).sqrt();
            let azimuth_there = if sine * sun_sine > 1e-9 {
                ((on_ray.scattering_cosine - mu_there * sun_cosine) / (sine * sun_sine)).clamp(-1.0, 1.0).acos()
            } else {
                0.0
            };
            let second = segments(field, &there, mu_there, azimuth_there, &[b - a]);
            let far = Observer { altitude_km: there.altitude_km + mu_there * (b - a), ..there };
            let is_end = ground.is_some_and(|ground| b > 0.9 * ground) || far.altitude_km > 0.85 * field.blocks[0].air.top;
            let light = if is_end { &mut worst.to_the_end } else { &mut worst.light };
            for w in 0..WAVELENGTHS_NM.len() {
                let through = whole.transmittance(0)[w];
                let sum = whole.radiance(0, 0)[w] + through * second.radiance(0, 0)[w];
                let all = whole.radiance(0, 1)[w];
                // An observer above the air may not have reached it yet.
                *light = light.max(if all > 0.0 { (sum / all - 1.0).abs() } else { sum });
                worst.transmittance =
                    worst.transmittance.max((through * second.transmittance(0)[w] - whole.transmittance(1)[w]).abs());
            }
        }
    }
    worst
}

#[test]
fn two_parts_make_the_whole() {
    // With haze the aureole, which reaches far at low orders, is the rest.
    let fields = [
        ("draft, without haze", &field(false, Quality::Draft), 1e-4),
        ("high, without haze", &WITHOUT_HAZE, 1e-4),
        ("high", &CLEAR, 3e-4),
    ];
    for (name, field, limit) in fields {
        let found = halves(field);
        assert!(found.transmittance < 1e-6 && found.light < limit, "{name}: {found:?}");
        // The end has what pictures have, whose steps are longer.
        assert!(found.to_the_end < 5e-4, "{name}: {found:?}");
    }
}
