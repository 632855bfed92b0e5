use super::super::cache::Cache;
use super::*;
use crate::atmosphere::{AerosolType, AirParameters, Ground, PhaseFunction, PhaseTable, Preset, StandardAtmosphere};
use crate::light::{LightField, Observer};
use crate::progress::Progress;
use crate::quality::Quality;
use crate::spectrum::wavelengths;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::Arc;

/// Uniform numbers (xorshift64*).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn one_of<T: Copy>(&mut self, of: &[T]) -> T {
        of[((self.next() * of.len() as f64) as usize).min(of.len() - 1)]
    }

    /// One of the values, or none at all, as often: so that two airs often differ in few things.
    fn perhaps<T: Copy>(&mut self, of: &[T]) -> Option<T> {
        (self.next() < 0.5).then(|| self.one_of(of))
    }
}

/// Air of parameters, of which many have round values that other airs have too.
fn random_air(random: &mut Random) -> AirParameters {
    let aerosol = random.one_of(&AerosolType::ALL[1..]);
    AirParameters {
        preset: random.one_of(&[Preset::Clear, Preset::Hazy, Preset::Urban, Preset::Volcanic]),
        aerosol: Some(aerosol),
        relative_humidity: random.perhaps(&[0.0, 50.0, 80.0]),
        aod550: Some(random.one_of(&[0.1, 0.3])),
        angstrom_exponent: random.perhaps(&[1.2, 1.3]),
        single_scattering_albedo: random.perhaps(&[0.9, 0.95]),
        phase_function: random.perhaps(&[PhaseFunction::HenyeyGreenstein, PhaseFunction::CornetteShanks]),
        aerosol_scale_height_km: random.perhaps(&[1.0, 2.0]),
        stratospheric_aod550: random.perhaps(&[0.0, 0.05]),
        stratospheric_altitude_km: random.perhaps(&[18.0, 20.0]),
        ozone_du: random.perhaps(&[0.0, 300.0, 301.0]),
        standard_atmosphere: random.perhaps(&StandardAtmosphere::ALL),
        surface_pressure_hpa: random.perhaps(&[900.0, 1013.25]),
        ground: random.perhaps(&[Ground::Albedo(0.0), Ground::Albedo(0.2), Ground::Albedo(0.25)]),
        ..AirParameters::default()
    }
}

fn tabulated(random: &mut Random) -> Phase {
    let peak = random.one_of(&[0.1, 0.2, 0.3]);
    let angles: Vec<f64> = (0..=90).map(|i| f64::from(i) / 90.0 * PI).collect();
    // 1 + a cos + b (cos^2 - 1/3) is normalised for all a and b.
    let square = random.one_of(&[0.0, 0.1]);
    let values: Vec<f64> = angles.iter().map(|x| 1.0 + peak * x.cos() + square * (x.cos().powi(2) - 1.0 / 3.0)).collect();
    Phase::Tabulated(Arc::new(PhaseTable::new(&angles, &values).unwrap()))
}

/// Air given in full.
fn random_profile(random: &mut Random) -> OpticalProfile {
    let mut profile = random_air(random).optical_profile(&wavelengths(random.one_of(&[8, 9]))).unwrap();
    let scatterer = profile.components.iter_mut().find(|component| component.name == "aerosol").unwrap();
    let asymmetry = random.one_of(&[-0.5, 0.5, 0.6]);
    scatterer.phase = Some(match random.one_of(&[0, 1, 2, 3]) {
        0 => Phase::HenyeyGreenstein { asymmetry },
        1 => Phase::CornetteShanks { asymmetry },
        2 => Phase::Rayleigh { depolarisation: vec![0.5 + 0.5 * asymmetry] },
        _ => tabulated(random),
    });
    profile.planet_radius_km = random.one_of(&[3390.0, 6371.0]);
    profile.sun_angular_radius_deg = random.one_of(&[0.0, 0.2, 0.2664]);
    profile
}

/// What a solution depends on, as the types compare it.
fn same(a: &OpticalProfile, b: &OpticalProfile) -> bool {
    let parts = |p: &OpticalProfile| {
        let components: Vec<_> =
            p.components.iter().map(|c| (c.scattering_per_km.clone(), c.absorption_per_km.clone(), c.phase.clone())).collect();
        let numbers = [p.planet_radius_km, p.sun_angular_radius_deg];
        (p.altitudes_km.clone(), p.wavelengths_nm.clone(), p.ground_albedo.clone(), numbers, components)
    };
    parts(a) == parts(b)
}

#[test]
fn of_two_thousand_random_airs_no_two_different_ones_share_a_key_and_equal_ones_do() {
    let numbers = Quality::Draft.numbers();
    let mut random = Random(0x5eed);
    let mut seen: HashMap<String, OpticalProfile> = HashMap::new();
    let mut shared = 0;
    for k in 0..2000 {
        let state = random.0;
        let draw = |random: &mut Random| match k % 2 {
            0 => random_air(random).optical_profile(&wavelengths(8)).unwrap(),
            _ => random_profile(random),
        };
        let profile = draw(&mut random);
        let key = of(&profile, &numbers, true);
        // Made once more, it is the same air.
        assert!(of(&draw(&mut Random(state)), &numbers, true) == key);
        assert!(of(&profile, &numbers, false) != key);
        match seen.get(&format!("{key:?}")) {
            Some(other) => {
                assert!(same(other, &profile), "air {k}");
                shared += 1;
            }
            None => assert!(seen.insert(format!("{key:?}"), profile).is_none()),
        }
    }
    assert!(seen.values().count() > 1500 && shared < 500, "{shared}");
}

#[test]
fn every_single_value_makes_another_key() {
    let profile = AirParameters::default().optical_profile(&wavelengths(8)).unwrap();
    let numbers = Quality::Standard.numbers();
    let whole = of(&profile, &numbers, true);
    let mut keys = vec![whole];
    let mut with = |change: &dyn Fn(&mut OpticalProfile)| {
        let mut other = profile.clone();
        change(&mut other);
        keys.push(of(&other, &numbers, true));
    };
    let step = |value: &mut f64| *value += value.abs().max(1e-3) * 4.0 * f64::EPSILON;
    with(&|p| step(&mut p.altitudes_km[7]));
    with(&|p| step(&mut p.wavelengths_nm[3]));
    with(&|p| step(&mut p.ground_albedo[2]));
    with(&|p| step(&mut p.planet_radius_km));
    with(&|p| step(&mut p.sun_angular_radius_deg));
    for component in 0..profile.components.len() {
        with(&|p| step(&mut p.components[component].scattering_per_km[11]));
        with(&|p| step(&mut p.components[component].absorption_per_km[11]));
        with(&|p| p.components[component].phase = Some(Phase::HenyeyGreenstein { asymmetry: 0.1 }));
        with(&|p| p.components[component].phase = Some(Phase::HenyeyGreenstein { asymmetry: -0.1 }));
        with(&|p| p.components[component].phase = Some(Phase::CornetteShanks { asymmetry: 0.1 }));
        with(&|p| p.components[component].phase = Some(Phase::Rayleigh { depolarisation: vec![0.1] }));
        with(&|p| drop(p.components.remove(component)));
    }
    with(&|p| p.components.swap(0, 2));
    let two = |last: f64| Phase::Tabulated(Arc::new(PhaseTable::new(&[0.0, 1.0, PI], &[1.0, 1.0, last]).unwrap()));
    with(&|p| p.components[2].phase = Some(two(1.0)));
    with(&|p| p.components[2].phase = Some(two(1.01)));
    for quality in [Quality::Draft, Quality::High, Quality::Reference] {
        keys.push(of(&profile, &quality.numbers(), true));
    }
    keys.push(of(&profile, &Numbers { convergence: 0.5 * numbers.convergence, ..numbers }, true));
    keys.push(of(&profile, &Numbers { full_applications: 3, ..numbers }, true));
    keys.push(of(&profile, &numbers, false));
    for (k, one) in keys.iter().enumerate() {
        assert!(keys[k + 1..].iter().all(|other| one != other), "key {k}");
    }
    // What does not enter the solution makes no other one.
    let mut other = profile.clone();
    other.components[0].name = "gas".to_string();
    other.solar_irradiance.fill(1.0);
    other.components[1].scattering_per_km.iter_mut().for_each(|value| *value = -*value);
    assert!(of(&other, &Numbers { dome_circles: 7, ..numbers }, true) == whole, "-0 is 0");
}

/// Radiances in some directions.
fn seen(field: &LightField) -> Vec<f64> {
    let observer = Observer { altitude_km: 0.3, sun_zenith: 1.1 };
    let gathered = field.gather(&observer, 0.4, &[0.0, 2.0]);
    (0..2)
        .flat_map(|a| (0..gathered.wavelengths).map(move |w| (a, w)))
        .map(|(a, w)| field.radiance(&gathered, a, w, 0.3))
        .collect()
}

/// The light of `profile` by way of `cache`, as an [`super::super::Atmosphere`] keeps it.
fn kept_or_solved(cache: &Cache, profile: &OpticalProfile, numbers: &Numbers) -> LightField {
    let key = of(profile, numbers, false);
    match cache.load(&key).and_then(|kept| LightField::from_sections(profile, numbers, false, &kept).ok()) {
        Some(field) => field,
        None => {
            let field = LightField::solve(profile, numbers, false, &Progress::silent()).unwrap();
            cache.store(&key, &field.to_sections());
            field
        }
    }
}

#[test]
fn with_the_cache_every_air_has_the_light_that_it_has_without() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::new(folder.path(), 1 << 30);
    let numbers = Quality::Draft.numbers();
    // The same extinction and albedo at all wavelengths: only the phase functions differ.
    let of_type = |aerosol: AerosolType| AirParameters {
        aerosol: Some(aerosol),
        aod550: Some(0.3),
        angstrom_exponent: Some(1.2),
        single_scattering_albedo: Some(0.9),
        aerosol_scale_height_km: Some(2.0),
        ..AirParameters::default()
    };
    let wavelengths = wavelengths(8);
    let [urban, desert] = [AerosolType::Urban, AerosolType::Desert].map(|t| of_type(t).optical_profile(&wavelengths).unwrap());
    let mut random = Random(7);
    let mut airs = vec![urban, desert];
    // SKYPROBE_RANDOM_AIRS=100 looks at more of them.
    let count = std::env::var("SKYPROBE_RANDOM_AIRS").ok().and_then(|count| count.parse().ok()).unwrap_or(4);
    airs.extend((0..count).map(|k| match k % 2 {
        0 => random_profile(&mut random),
        _ => random_air(&mut random).optical_profile(&wavelengths).unwrap(),
    }));
    let mut other = airs[2].clone();
    for profile in [&mut airs[2], &mut other] {
        profile.components[2].phase = Some(tabulated(&mut random));
    }
    airs.push(other);
    for profile in &airs {
        let without = seen(&LightField::solve(profile, &numbers, false, &Progress::silent()).unwrap());
        assert!(seen(&kept_or_solved(&cache, profile, &numbers)) == without, "solved and stored");
        assert!(seen(&kept_or_solved(&cache, profile, &numbers)) == without, "loaded");
    }
}
