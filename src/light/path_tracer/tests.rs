use super::*;
use crate::atmosphere::{AirParameters, Component, Phase};
use crate::numerics::gauss::legendre;

/// The air of `parameters` at one wavelength.
pub(super) fn clear_air(parameters: &AirParameters, wavelength_nm: f64) -> OpticalProfile {
    parameters.optical_profile(&[wavelength_nm]).unwrap()
}

/// One component with constant coefficients up to `top_km`, on a planet so large that it is flat.
pub(super) fn slab(
    scattering_per_km: f64,
    absorption_per_km: f64,
    top_km: f64,
    phase: Phase,
    ground_albedo: f64,
) -> OpticalProfile {
    OpticalProfile {
        altitudes_km: vec![0.0, top_km],
        wavelengths_nm: vec![550.0],
        components: vec![Component {
            name: "air".into(),
            scattering_per_km: vec![scattering_per_km; 2],
            absorption_per_km: vec![absorption_per_km; 2],
            phase: Some(phase),
        }],
        ground_albedo: vec![ground_albedo],
        solar_irradiance: vec![1.0],
        planet_radius_km: 6.371e6,
        sun_angular_radius_deg: 0.0,
    }
}

pub(super) fn isotropic() -> Phase {
    Phase::Rayleigh { depolarisation: vec![1.0] }
}

pub(super) fn view(zenith_deg: f64, azimuth_deg: f64) -> DVec3 {
    let (sine, cosine) = zenith_deg.to_radians().sin_cos();
    let (sine_azimuth, cosine_azimuth) = azimuth_deg.to_radians().sin_cos();
    DVec3::new(sine * cosine_azimuth, sine * sine_azimuth, cosine)
}

/// Mean over the hemisphere of `value(direction)` times pi: the flux through a horizontal plane.
pub(super) fn flux(upward: bool, value: impl Fn(DVec3) -> f64) -> f64 {
    let mut sum = 0.0;
    for (cosine, weight) in legendre(6) {
        let zenith_deg = cosine.acos().to_degrees();
        for azimuth in 0..4 {
            let direction = view(if upward { 180.0 - zenith_deg } else { zenith_deg }, 45.0 * azimuth as f64 + 22.5);
            sum += weight * cosine * 0.5 * PI * value(direction);
        }
    }
    sum
}

#[test]
fn single_scattering_of_a_slab_is_the_textbook_formula() {
    let phase = Phase::HenyeyGreenstein { asymmetry: 0.6 };
    let (scattering, absorption, top) = (0.02, 0.01, 10.0);
    let profile = slab(scattering, absorption, top, phase.clone(), 0.5);
    let tracer = PathTracer::new(&profile, 0).unwrap();
    let (mu_sun, depth) = (60.0_f64.to_radians().cos(), 0.3);
    for (zenith_deg, azimuth_deg) in [(0.0, 0.0), (30.0, 90.0), (75.0, 0.0), (75.0, 180.0)] {
        let view = view(zenith_deg, azimuth_deg);
        let p = phase.value(0, view.dot(DVec3::new((1.0 - mu_sun * mu_sun).sqrt(), 0.0, mu_sun)));
        // checked against: Liou 2002, An Introduction to Atmospheric Radiation, eq. 6.1.27 (light transmitted by a layer)
        let mu = view.z;
        let albedo = scattering / (scattering + absorption);
        let expected = albedo * p / (4.0 * PI) * mu_sun / (mu - mu_sun) * ((-depth / mu).exp() - (-depth / mu_sun).exp());
        let found = tracer.single_scattering(0.0, 60.0, view).unwrap();
        assert!((found / expected - 1.0).abs() < 1e-4, "{zenith_deg}: {found} {expected}");
    }
}

#[test]
fn thin_air_scatters_its_depth_times_the_phase_function() {
    let profile = slab(1e-6, 0.0, 10.0, Phase::Rayleigh { depolarisation: vec![0.0] }, 0.0);
    let found = PathTracer::new(&profile, 0).unwrap().radiance(0.0, 30.0, view(60.0, 90.0), 512, 1).unwrap();
    let cosine = view(60.0, 90.0).dot(view(30.0, 0.0));
    let expected = 1e-5 / 0.5 * 0.75 * (1.0 + cosine * cosine) / (4.0 * PI);
    assert!((found.mean / expected - 1.0).abs() < 1e-4);
}

#[test]
fn air_that_only_absorbs_is_dark_and_dims_the_ground() {
    let profile = slab(0.0, 0.05, 10.0, isotropic(), 0.3);
    let tracer = PathTracer::new(&profile, 0).unwrap();
    assert_eq!(tracer.radiance(0.0, 40.0, view(20.0, 0.0), 512, 1).unwrap(), Estimate::ZERO);
    let mu_sun = 40.0_f64.to_radians().cos();
    let expected = 0.3 / PI * mu_sun * (-0.5 / mu_sun).exp() * (-0.5_f64 / 0.5).exp();
    let found = tracer.radiance(20.0, 40.0, view(120.0, 0.0), 200_000, 1).unwrap();
    assert!((found.mean - expected).abs() < 4.0 * found.standard_error, "{found:?} {expected}");
    assert!(found.standard_error < 0.01 * expected);
}

#[test]
fn what_enters_conservative_air_over_a_white_ground_leaves_it() {
    for phase in [isotropic(), Phase::HenyeyGreenstein { asymmetry: 0.7 }, Phase::CornetteShanks { asymmetry: 0.5 }] {
        let profile = slab(0.05, 0.0, 10.0, phase.clone(), 1.0);
        let tracer = PathTracer::new(&profile, 0).unwrap();
        let leaving = flux(true, |direction| tracer.radiance(10.0, 50.0, direction, 4000, 3).unwrap().mean);
        assert!((leaving / 50.0_f64.to_radians().cos() - 1.0).abs() < 0.01, "{phase:?}: {leaving}");
    }
}

/// Chandrasekhar's H function for isotropic scattering, from his nonlinear integral equation by iteration.
fn chandrasekhar_h(albedo: f64, cosine: f64) -> f64 {
    let rule = legendre(40);
    let mut values = vec![1.0; rule.len()];
    let next = |mu: f64, values: &[f64]| {
        let sum: f64 = rule.iter().zip(values).map(|(&(x, w), h)| w * h * x / (mu + x)).sum();
        1.0 / ((1.0 - albedo).sqrt() + 0.5 * albedo * sum)
    };
    for _ in 0..500 {
        // Half a step: the whole one swings for ever where nothing is absorbed.
        values = rule.iter().zip(&values).map(|(&(mu, _), now)| 0.5 * (now + next(mu, &values))).collect();
    }
    next(cosine, &values)
}

#[test]
fn a_half_space_reflects_as_chandrasekhar_says() {
    // checked against: Chandrasekhar 1950, Radiative Transfer, table XI, H(1) for isotropic scattering without absorption
    assert!((chandrasekhar_h(1.0, 1.0) - 2.9078).abs() < 5e-4);
    let albedo = 0.5;
    let profile = slab(1.0 * albedo, 1.0 - albedo, 40.0, isotropic(), 0.0);
    let tracer = PathTracer::new(&profile, 0).unwrap();
    for (sun_deg, view_deg) in [(0.0, 180.0), (60.0, 120.0), (30.0, 150.0)] {
        let (mu_sun, mu) = (f64::to_radians(sun_deg).cos(), -f64::to_radians(view_deg).cos());
        let expected =
            albedo / (4.0 * PI) * mu_sun / (mu + mu_sun) * chandrasekhar_h(albedo, mu) * chandrasekhar_h(albedo, mu_sun);
        let found = tracer.radiance(40.0, sun_deg, view(view_deg, 90.0), 20_000, 5).unwrap();
        assert!((found.mean - expected).abs() < 4.0 * found.standard_error + 1e-4 * expected, "{found:?} {expected}");
        assert!(found.standard_error < 0.01 * expected);
    }
}

#[test]
fn a_seed_repeats_on_any_number_of_threads() {
    let profile = slab(0.03, 0.0, 10.0, isotropic(), 0.5);
    let tracer = PathTracer::new(&profile, 0).unwrap();
    let run = || tracer.radiance(0.0, 88.0, view(80.0, 20.0), 3000, 11).unwrap();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(run);
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap().install(run);
    assert_eq!(one, three);
    assert_ne!(one, tracer.radiance(0.0, 88.0, view(80.0, 20.0), 3000, 12).unwrap());
}

#[test]
fn a_path_that_begins_on_black_ground_ends_there() {
    let profile = slab(0.02, 0.0, 10.0, isotropic(), 0.0);
    let found = PathTracer::new(&profile, 0).unwrap().multiple_scattering(0.0, 30.0, -DVec3::Z, 300, 1).unwrap();
    assert_eq!(found, Estimate::ZERO);
}

#[test]
fn a_guided_line_of_sight_that_ends_before_the_air_begins_is_dark() {
    let profile = slab(0.02, 0.0, 10.0, isotropic(), 0.3);
    let tracer = PathTracer::new(&profile, 0).unwrap().with_guiding(Guiding::Always).with_length_km(5.0);
    assert_eq!(tracer.radiance(50.0, 30.0, -DVec3::Z, 100, 1).unwrap(), Estimate::ZERO);
}

#[test]
fn bad_input_is_named() {
    let profile = slab(0.02, 0.0, 10.0, isotropic(), 0.3);
    assert!(PathTracer::new(&profile, 1).is_err());
    let tracer = PathTracer::new(&profile, 0).unwrap();
    for (altitude, sun, view, samples) in
        [(-1.0, 30.0, DVec3::Z, 10), (0.0, f64::NAN, DVec3::Z, 10), (0.0, 30.0, DVec3::splat(1.0), 10), (0.0, 30.0, DVec3::Z, 1)]
    {
        assert!(matches!(tracer.radiance(altitude, sun, view, samples, 1), Err(Error::Input { .. })));
    }
    assert_eq!(tracer.radiance(50.0, 30.0, DVec3::Z, 10, 1).unwrap().mean, 0.0, "nothing above the air");
}
