//! Thick air: solved rightly, or refused with a message; nothing between.

use skyprobe::atmosphere::{AirParameters, Component, OpticalProfile, Phase, Preset};
use skyprobe::light::LightField;
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::spectrum::wavelengths;
use skyprobe::{Error, Result};

/// Cosine of the solar zenith angle of the reference: one of its directions.
const COSINE: f64 = 0.8089381222013219;

fn air(preset: &str, aod550: f64) -> OpticalProfile {
    let parameters: AirParameters = serde_json::from_str(&format!(r#"{{"preset": "{preset}", "aod550": {aod550}}}"#)).unwrap();
    parameters.optical_profile(&wavelengths(32)).unwrap()
}

/// A homogeneous layer of 10 km of molecules that do not absorb.
fn slab(optical_depth: f64, ground_albedo: f64) -> OpticalProfile {
    OpticalProfile {
        altitudes_km: vec![0.0, 10.0],
        wavelengths_nm: vec![550.0],
        components: vec![Component {
            name: "slab".into(),
            scattering_per_km: vec![optical_depth / 10.0; 2],
            absorption_per_km: vec![0.0; 2],
            phase: Some(Phase::Rayleigh { depolarisation: vec![0.0] }),
        }],
        ground_albedo: vec![ground_albedo],
        solar_irradiance: vec![1.0],
        planet_radius_km: 6371.0,
        sun_angular_radius_deg: 0.2664,
    }
}

fn solve(profile: &OpticalProfile, quality: Quality, polarised: bool) -> Result<LightField> {
    LightField::solve(profile, &quality.numbers(), polarised, &Progress::silent())
}

/// Irradiance of the ground at 550 nm.
fn at_550_nm(profile: &OpticalProfile, field: &LightField) -> f64 {
    let k = profile.wavelengths_nm.iter().position(|&w| w > 549.0).unwrap();
    field.ground_irradiance(COSINE.acos())[k]
}

/// By adding and doubling with 16 directions a hemisphere (`docs/validation/thick_air.py`), plane-parallel and scalar.
#[test]
fn what_is_solved_is_right() {
    for (profile, expected) in [
        (air("fog", 2.0), 0.6625),
        (air("fog", 5.0), 0.5527),
        (air("clear", 3.0), 0.4418),
        (air("clear", 5.0), 0.3154),
        (air("desert", 3.0), 0.3209),
        (air("desert", 5.0), 0.1718),
        (air("urban", 3.0), 0.2153),
        (slab(1.0, 0.0), 0.4942),
        (slab(2.0, 0.0), 0.3516),
        (slab(2.0, 1.0), 0.9018),
    ] {
        let solved = at_550_nm(&profile, &solve(&profile, Quality::Draft, false).unwrap());
        assert!((solved / expected - 1.0).abs() < 0.025, "{solved} {expected}");
    }
}

#[test]
fn every_preset_and_ordinary_haze_is_solved() {
    let of = |json: &str| serde_json::from_str::<AirParameters>(json).unwrap().optical_profile(&wavelengths(32)).unwrap();
    let mut airs: Vec<OpticalProfile> = Preset::ALL
        .iter()
        .map(|&preset| AirParameters { preset, ..Default::default() }.optical_profile(&wavelengths(32)).unwrap())
        .collect();
    for aerosol in ["continental_average", "continental_polluted", "urban", "desert", "maritime_clean"] {
        airs.push(of(&format!(r#"{{"aerosol": "{aerosol}", "aod550": 2.5, "ground": "snow"}}"#)));
    }
    for (k, profile) in airs.iter().enumerate() {
        let field = solve(profile, Quality::Draft, k % 2 == 0).unwrap_or_else(|error| panic!("air {k}: {error}"));
        let worst = field.errors_on_the_ground().into_iter().fold(0.0, |worst: f64, error| worst.max(error.abs()));
        assert!(worst < 0.04, "air {k}: {worst}");
    }
}

#[test]
fn what_cannot_be_solved_is_told_with_what_would_help() {
    for profile in [
        air("fog", 50.0),
        air("clear", 25.0),
        air("clear", 50.0),
        air("desert", 50.0),
        slab(20.0, 0.0),
        slab(20.0, 1.0),
        slab(100.0, 1.0),
        slab(1e7, 0.5),
    ] {
        let Err(Error::Unsolved { what }) = solve(&profile, Quality::Draft, true) else { panic!("solved") };
        assert!(what.contains("vertical optical depth of") && what.contains("What helps is less"), "{what}");
    }
}

/// Between what is solved and what is refused there is nothing that is wrong in silence.
#[test]
fn at_the_border_light_is_right_or_refused() {
    let mut refused = 0;
    for (profile, expected) in [
        (air("fog", 8.0), 0.4713),
        (air("fog", 12.0), 0.3938),
        (air("fog", 15.0), 0.3506),
        (air("fog", 25.0), 0.2568),
        (air("clear", 8.0), 0.1956),
        (air("clear", 12.0), 0.1055),
        (air("desert", 8.0), 0.06739),
        (air("desert", 12.0), 0.01946),
        (air("urban", 8.0), 0.02468),
        (slab(5.0, 0.0), 0.1872),
    ] {
        match solve(&profile, Quality::Draft, false) {
            Ok(field) => {
                let solved = at_550_nm(&profile, &field);
                assert!((solved / expected - 1.0).abs() < 0.06, "{solved} {expected}");
            }
            Err(Error::Unsolved { .. }) => refused += 1,
            Err(other) => panic!("{other}"),
        }
    }
    assert!(refused > 0);
}

/// Ordinary air at one wavelength or several, with a vertical optical depth of absorption for each.
fn absorbing(scattering: f64, absorption: &[f64]) -> OpticalProfile {
    let mut profile = slab(scattering, 0.2);
    let count = absorption.len();
    profile.wavelengths_nm = (0..count).map(|w| 550.0 + w as f64).collect();
    profile.ground_albedo = vec![0.2; count];
    profile.solar_irradiance = vec![1.0; count];
    let component = &mut profile.components[0];
    component.scattering_per_km = vec![scattering / 10.0; 2 * count];
    component.absorption_per_km = absorption.iter().chain(absorption).map(|depth| depth / 10.0).collect();
    component.phase = Some(Phase::Rayleigh { depolarisation: vec![0.0; count] });
    profile
}

/// Rounding over next to nothing is no light from nowhere.
#[test]
fn ground_that_absorption_darkens_is_right_when_it_is_dark() {
    for scattering in [0.01, 0.2] {
        for depth in [10.0, 20.0, 30.0, 40.0, 50.0, 100.0] {
            let profile = absorbing(scattering, &[depth]);
            let field = solve(&profile, Quality::Draft, true).unwrap_or_else(|error| panic!("{scattering} {depth}: {error}"));
            let on_the_ground = field.ground_irradiance(COSINE.acos())[0];
            let direct = COSINE * (-(depth + scattering) / COSINE).exp();
            assert!(
                on_the_ground >= 0.9 * direct - 1e-9 && on_the_ground < 1.5 * direct + 1e-6,
                "{scattering} {depth}: {on_the_ground}"
            );
        }
        let alone = absorbing(scattering, &[0.1]);
        let among = absorbing(scattering, &[0.1, 50.0, 0.1, 100.0]);
        let [alone, among] = [alone, among].map(|profile| solve(&profile, Quality::Draft, true).unwrap());
        let [alone, among] = [alone, among].map(|field| field.ground_irradiance(COSINE.acos())[0]);
        assert!((among / alone - 1.0).abs() < 5e-3, "{scattering}: {among} {alone}");
    }
}

/// Nothing of what can be typed here is beyond the solver.
#[test]
fn extremes_that_can_be_typed_are_solved() {
    let mut airs: Vec<String> =
        [r#"{"turbidity": 64}"#, r#"{"preset": "fog", "visibility_km": 0.1}"#, r#"{"ozone_du": 1000}"#].map(String::from).into();
    for aerosol in ["continental_clean", "continental_average", "continental_polluted", "urban", "desert", "maritime_clean"] {
        airs.push(format!(r#"{{"aerosol": "{aerosol}", "aod550": 5, "ground": "snow"}}"#));
    }
    for json in airs {
        let parameters: AirParameters = serde_json::from_str(&json).unwrap();
        let solved = solve(&parameters.optical_profile(&wavelengths(32)).unwrap(), Quality::Draft, true);
        let errors = solved.unwrap_or_else(|error| panic!("{json}: {error}")).errors_on_the_ground();
        assert!(errors.iter().all(|error| error.abs() < 0.03), "{json}: {errors:?}");
    }
}
