use super::super::tests::{clear_air, flux, isotropic, slab, view};
use super::super::{Estimate, Guiding, PathTracer};
use super::*;
use crate::atmosphere::{AirParameters, Component, OpticalProfile};
use crate::numerics::locate;

/// Ends of the layer that is both a field and shells [km].
const LAYER_KM: (f64, f64) = (2.0, 3.0);

/// A field whose extinction is any function of the point.
struct Given<E> {
    extinction: E,
    majorant: f64,
    altitudes: (f64, f64),
    albedo: f64,
    phase: Phase,
}

impl<E: Fn(DVec3) -> f64 + Sync> Field for Given<E> {
    fn extinction_per_km(&self, point_km: DVec3) -> f64 {
        (self.extinction)(point_km)
    }

    fn majorant_per_km(&self) -> f64 {
        self.majorant
    }

    fn altitudes_km(&self) -> (f64, f64) {
        self.altitudes
    }

    fn single_scattering_albedo(&self) -> f64 {
        self.albedo
    }

    fn phase(&self) -> &Phase {
        &self.phase
    }
}

fn forward() -> Phase {
    Phase::HenyeyGreenstein { asymmetry: 0.85 }
}

/// `profile` with a homogeneous layer: as good as discontinuous at its ends.
fn with_layer(profile: &OpticalProfile, depth: f64, albedo: f64) -> OpticalProfile {
    const EDGE_KM: f64 = 1e-7;
    let (lower, upper) = LAYER_KM;
    let mut with = profile.clone();
    with.altitudes_km.retain(|z| ![lower, upper].contains(z));
    with.altitudes_km.extend([lower - EDGE_KM, lower, upper, upper + EDGE_KM]);
    with.altitudes_km.sort_by(f64::total_cmp);
    let at = |values: &[f64], altitude: f64| {
        let (i, fraction) = locate(&profile.altitudes_km, altitude);
        values[i] * (1.0 - fraction) + values[i + 1] * fraction
    };
    for (new, old) in with.components.iter_mut().zip(&profile.components) {
        new.scattering_per_km = with.altitudes_km.iter().map(|&z| at(&old.scattering_per_km, z)).collect();
        new.absorption_per_km = with.altitudes_km.iter().map(|&z| at(&old.absorption_per_km, z)).collect();
    }
    let constant = |value: f64| with.altitudes_km.iter().map(|z| if (lower..=upper).contains(z) { value } else { 0.0 }).collect();
    let extinction = depth / (upper - lower);
    with.components.push(Component {
        name: "layer".into(),
        scattering_per_km: constant(albedo * extinction),
        absorption_per_km: constant((1.0 - albedo) * extinction),
        phase: Some(forward()),
    });
    with
}

/// The same layer as a field, which does not know where it ends.
fn layer(planet_radius: f64, depth: f64, albedo: f64) -> Given<impl Fn(DVec3) -> f64 + Sync> {
    let (lower, upper) = LAYER_KM;
    let density = depth / (upper - lower);
    let extinction = move |point: DVec3| {
        let altitude = point.length() - planet_radius;
        if (lower..=upper).contains(&altitude) { density } else { 0.0 }
    };
    Given { extinction, majorant: 1.5 * density, altitudes: (lower - 0.5, upper + 1.0), albedo, phase: forward() }
}

/// The layer in the profile against the same layer as a field. Paths of shells fly by distances that never leave the air, whose weights a thick layer makes wild: there
/// the shells have an empty field, so that they fly by their exact collisions.
#[test]
fn a_layer_is_the_same_as_a_field_and_as_shells() {
    let profile = clear_air(&AirParameters::default(), 550.0);
    let empty = Given { extinction: |_| 0.0, majorant: 1e-9, altitudes: (0.0, 20.0), albedo: 1.0, phase: isotropic() };
    let (mut squares, mut numbers, mut worst, mut noisiest) = (0.0, 0.0, 0.0_f64, 0.0_f64);
    // Optical depth, albedo; altitude [km], zenith angle, azimuth, length of the line of sight [km]: from below, within and above.
    for (seed, (depth, albedo, altitude, zenith, azimuth, length)) in [
        (1.0, 1.0, 0.0, 20.0, 40.0, None),
        (1.0, 0.9, 0.0, 75.0, 100.0, Some(10.0)),
        (1.0, 1.0, 2.5, 60.0, 90.0, None),
        (1.0, 0.9, 2.5, 120.0, 30.0, None),
        (1.0, 0.9, 10.0, 140.0, 60.0, None),
        (5.0, 1.0, 0.0, 20.0, 40.0, None),
        (5.0, 0.9, 0.0, 40.0, 150.0, None),
        (5.0, 0.9, 2.5, 60.0, 90.0, None),
        (5.0, 1.0, 10.0, 140.0, 60.0, None),
    ]
    .into_iter()
    .enumerate()
    {
        let (shells, field) = (with_layer(&profile, depth, albedo), layer(profile.planet_radius_km, depth, albedo));
        let (polarised, seed) = (depth == 1.0, 2 * seed as u64);
        let tracer = |profile| {
            let tracer = PathTracer::new(profile, 0).unwrap().with_polarisation(polarised);
            if let Some(length) = length { tracer.with_length_km(length) } else { tracer }
        };
        let view = view(zenith, azimuth);
        let (plain, flown) = (tracer(&shells), tracer(&shells).with_field(&empty).unwrap());
        let fielded = tracer(&profile).with_field(&field).unwrap();
        let paths = if depth > 1.0 { 100_000 } else { 50_000 };
        let expected = if depth > 1.0 {
            flown.stokes(altitude, 50.0, view, paths, seed).unwrap()
        } else {
            plain.stokes(altitude, 50.0, view, paths, seed).unwrap()
        };
        let found = fielded.stokes(altitude, 50.0, view, paths, seed + 1).unwrap();
        for i in 0..if polarised { 3 } else { 1 } {
            let error = found[i].standard_error.hypot(expected[i].standard_error);
            let deviation = (found[i].mean - expected[i].mean) / error;
            println!(
                "depth {depth}, albedo {albedo}, {altitude} km, view {zenith} {azimuth}, {}: {:.4e} {:.4e}, {:.2} % {:.2} %, {deviation:+.2} standard errors",
                ["I", "Q", "U"][i],
                expected[i].mean,
                found[i].mean,
                100.0 * expected[i].standard_error / expected[0].mean,
                100.0 * found[i].standard_error / found[0].mean,
            );
            noisiest = noisiest.max(error / expected[0].mean);
            worst = worst.max(deviation.abs());
            squares += deviation * deviation;
            numbers += 1.0;
        }
    }
    println!("rms {:.2}, worst {worst:.2} standard errors of at most {:.2} %", f64::sqrt(squares / numbers), 100.0 * noisiest);
    assert!(noisiest < 0.025, "too noisy to judge: {noisiest}");
    assert!(worst < 3.0 && squares / numbers < 1.8, "{worst} {squares} {numbers}");
}

/// Mean and standard error of `value` over many random numbers.
fn mean(value: impl Fn(&mut Random) -> f64) -> Estimate {
    let mut random = Random::new(5, 0);
    let n = 50_000;
    let values: Vec<f64> = (0..n).map(|_| value(&mut random)).collect();
    let mean = values.iter().sum::<f64>() / f64::from(n);
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / f64::from(n);
    Estimate { mean, standard_error: (variance / f64::from(n)).sqrt(), largest_share: 0.0 }
}

#[test]
fn a_cube_lets_through_what_beers_law_says() {
    let mut profile = slab(0.01, 0.01, 20.0, isotropic(), 0.0);
    profile.planet_radius_km = 6371.0;
    let radius = profile.planet_radius_km;
    // A cube of 4 km in which the extinction grows with x.
    let inside = |point: DVec3| (point - DVec3::Z * (radius + 5.0)).abs().max_element() <= 2.0;
    let extinction = |point: DVec3| if inside(point) { 0.6 + 0.25 * point.x } else { 0.0 };
    let field = Given { extinction, majorant: 1.5, altitudes: (0.0, 9.0), albedo: 0.5, phase: forward() };
    let medium = AirWithField::new(Air::new(&profile, 0).unwrap(), &field).unwrap();
    // Starts relative to the middle of the cube, directions, and where the ray enters and leaves the cube [km].
    for (start, direction, enters, leaves) in [
        (DVec3::new(0.0, 0.0, -5.0), DVec3::Z, 3.0, 7.0),
        (DVec3::new(-6.0, 0.5, 1.0), DVec3::X, 4.0, 8.0),
        (DVec3::new(1.5, 0.0, 0.0), DVec3::Y, 0.0, 2.0),
        (DVec3::new(-3.0, 0.0, -3.0), DVec3::new(0.6, 0.0, 0.8), 5.0 / 3.0, 6.25),
        (DVec3::new(-3.0, 2.5, 0.0), DVec3::X, 1.0, 1.0),
    ] {
        let ray = medium.ray(start + DVec3::Z * (radius + 5.0), direction);
        let (_, length) = medium.end(&ray);
        let middle = 0.6 + 0.25 * ray.at(0.5 * (enters + leaves)).x;
        let expected = (-middle * (leaves - enters)).exp();
        let air = medium.air.transmittance(&ray, length, &mut Random::new(0, 0));
        let ratio = mean(|random| medium.transmittance(&ray, length, random) / air);
        let delta = mean(|random| f64::from(u8::from(medium.collide(&ray, length, random).is_none())));
        for (name, found) in [("ratio", ratio), ("delta", delta)] {
            println!("{name} tracking: {:.5} +- {:.5}, exact {expected:.5}", found.mean, found.standard_error);
            assert!((found.mean - expected).abs() < 3.5 * found.standard_error + 1e-12, "{direction} {found:?} {expected}");
            assert!(found.standard_error < 0.02 * expected);
        }
    }
}

#[test]
fn what_enters_broken_clouds_without_absorption_over_a_white_ground_leaves_them() {
    let mut profile = slab(0.02, 0.0, 10.0, isotropic(), 1.0);
    profile.planet_radius_km = 6.371e5;
    let radius = profile.planet_radius_km;
    const SHIFTS: u64 = 8;
    let leaving: f64 = (0..SHIFTS)
        .map(|shift| {
            // Rolls of cloud along y, periodic in x: the mean over shifts is that over the plane.
            let extinction = move |point: DVec3| {
                let phase = (point.x / 6.0 + shift as f64 / SHIFTS as f64) * std::f64::consts::TAU;
                let height = point.z - radius;
                if (3.0..=5.0).contains(&height) { 1.5 * phase.sin().max(0.0) } else { 0.0 }
            };
            let field = Given { extinction, majorant: 1.5, altitudes: (2.0, 6.0), albedo: 1.0, phase: forward() };
            let tracer = PathTracer::new(&profile, 0).unwrap().with_field(&field).unwrap();
            flux(true, |direction| tracer.radiance(10.0, 50.0, direction, 1500, 40 + shift).unwrap().mean) / SHIFTS as f64
        })
        .sum();
    let share = leaving / 50.0_f64.to_radians().cos();
    println!("{share} of the light leaves");
    assert!((share - 1.0).abs() < 0.01, "{share}");
}

#[test]
fn a_seed_repeats_on_any_number_of_threads() {
    let profile = slab(0.03, 0.0, 10.0, isotropic(), 0.5);
    let field = layer(profile.planet_radius_km, 3.0, 0.95);
    let tracer = PathTracer::new(&profile, 0).unwrap().with_field(&field).unwrap();
    let run = |seed| tracer.stokes(0.0, 60.0, view(40.0, 20.0), 3000, seed).unwrap();
    let on = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| run(11));
    assert_eq!(on(1), on(2));
    assert_ne!(on(1), run(12));
}

#[test]
fn an_empty_field_is_clear_air() {
    let profile = clear_air(&AirParameters::default(), 550.0);
    let field = Given { extinction: |_| 0.0, majorant: 0.0, altitudes: (0.0, 10.0), albedo: 1.0, phase: isotropic() };
    let fielded = PathTracer::new(&profile, 0).unwrap().with_field(&field).unwrap();
    let found = fielded.radiance(0.0, 50.0, view(30.0, 90.0), 20_000, 1).unwrap();
    let expected = PathTracer::new(&profile, 0).unwrap().radiance(0.0, 50.0, view(30.0, 90.0), 20_000, 2).unwrap();
    let error = found.standard_error.hypot(expected.standard_error);
    assert!(error < 0.01 * expected.mean && (found.mean - expected.mean).abs() < 3.0 * error, "{found:?} {expected:?}");
}

#[test]
fn a_field_that_cannot_be_is_named() {
    let profile = slab(0.02, 0.0, 10.0, isotropic(), 0.3);
    let field = |extinction: f64, majorant: f64, altitudes: (f64, f64), albedo: f64| {
        let extinction = move |_: DVec3| extinction;
        Given { extinction, majorant, altitudes, albedo, phase: isotropic() }
    };
    let named = |error: Error, name: &str| matches!(error, Error::Input { parameter, .. } if parameter == name);
    for (name, bad) in [
        ("majorant_per_km", field(1.0, f64::NAN, (1.0, 2.0), 0.5)),
        ("majorant_per_km", field(1.0, f64::INFINITY, (1.0, 2.0), 0.5)),
        ("majorant_per_km", field(1.0, -1.0, (1.0, 2.0), 0.5)),
        ("single_scattering_albedo", field(1.0, 1.0, (1.0, 2.0), 1.1)),
        ("altitudes_km", field(1.0, 1.0, (-1.0, 2.0), 0.5)),
        ("altitudes_km", field(1.0, 1.0, (2.0, 2.0), 0.5)),
        ("altitudes_km", field(1.0, 1.0, (1.0, 10.5), 0.5)),
        ("altitudes_km", field(1.0, 1.0, (f64::NAN, 2.0), 0.5)),
    ] {
        let error = PathTracer::new(&profile, 0).unwrap().with_field(&bad).err().unwrap();
        assert!(named(error, name), "{name}");
    }
    let sharp = Given { phase: Phase::HenyeyGreenstein { asymmetry: 1.5 }, ..field(1.0, 1.0, (1.0, 2.0), 0.5) };
    assert!(named(PathTracer::new(&profile, 0).unwrap().with_field(&sharp).err().unwrap(), "asymmetry"));
    for extinction in [1.2, -0.1, f64::NAN, f64::INFINITY] {
        let bad = field(extinction, 1.0, (1.0, 2.0), 0.5);
        let tracer = PathTracer::new(&profile, 0).unwrap().with_field(&bad).unwrap();
        assert!(named(tracer.radiance(0.0, 30.0, DVec3::Z, 1000, 1).unwrap_err(), "extinction_per_km"), "{extinction}");
    }
    let good = field(1.0, 1.0, (1.0, 2.0), 0.5);
    let always = PathTracer::new(&profile, 0).unwrap().with_guiding(Guiding::Always);
    assert!(named(always.with_field(&good).err().unwrap(), "guiding"));
    let tracer = PathTracer::new(&profile, 0).unwrap().with_field(&good).unwrap();
    assert!(named(tracer.radiance(0.0, 30.0, DVec3::Z, 1, 1).unwrap_err(), "samples"));
    assert!(named(tracer.radiance(f64::NAN, 30.0, DVec3::Z, 10, 1).unwrap_err(), "observer_altitude_km"));
    assert_eq!(tracer.radiance(50.0, 30.0, DVec3::Z, 10, 1).unwrap().mean, 0.0, "nothing above the air");
}
