//! In-scattered light of parts of rays at quality `high` against the path tracer in the same air: they must agree within 3 standard errors of at most 1 %.

use glam::DVec3;
use skyprobe::atmosphere::AirParameters;
use skyprobe::light::{LightField, Observer, PathTracer, Segments};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;

/// Altitude of the observer [km], zenith angles of Sun and view and azimuth of the view from the Sun [degrees].
const RAYS: [(f64, f64, f64, f64); 20] = [
    (0.0, 50.0, 0.0, 0.0),
    (0.0, 50.0, 40.0, 120.0),
    (0.0, 50.0, 70.0, 60.0),
    (0.0, 50.0, 85.0, 180.0),
    (0.0, 50.0, 89.0, 30.0),
    (0.0, 50.0, 90.0, 90.0),
    (0.0, 75.0, 60.0, 15.0),
    (0.0, 75.0, 87.0, 150.0),
    (0.0, 75.0, 89.5, 45.0),
    (0.0, 88.0, 85.0, 90.0),
    (0.0, 88.0, 89.0, 180.0),
    (0.3, 30.0, 91.0, 60.0),
    (2.0, 50.0, 89.0, 100.0),
    (2.0, 50.0, 95.0, 30.0),
    (2.0, 70.0, 120.0, 170.0),
    (10.0, 50.0, 91.0, 60.0),
    (10.0, 50.0, 94.0, 140.0),
    (10.0, 80.0, 150.0, 0.0),
    (30.0, 60.0, 95.0, 110.0),
    (400.0, 40.0, 160.0, 40.0),
];

/// [km]
const DISTANCES_KM: [f64; 6] = [0.1, 1.0, 5.0, 20.0, 60.0, 200.0];

const PILOT_PATHS: usize = 4_096;

/// Seed of the first pilot; those of the estimates count from 0.
const PILOT_SEED: u64 = 1_000;

/// Standard error that is aimed at, relative to the radiance.
const NOISE: f64 = 0.007;

#[test]
fn parts_of_rays_agree_with_the_path_tracer() {
    let profile = AirParameters::default().optical_profile(&[550.0]).unwrap();
    let field = LightField::solve(&profile, &Quality::High.numbers(), false, &Progress::silent()).unwrap();
    let mut segments = Segments::default();
    let mut deviations = Vec::new();
    println!(
        "altitude km, Sun, view, azimuth, distance km, transmittance, solver, path tracer, standard error %, deviation in % and in standard errors"
    );
    for (i, &(altitude_km, sun_zenith_deg, zenith, azimuth)) in RAYS.iter().enumerate() {
        let (sine, cosine) = f64::to_radians(zenith).sin_cos();
        let view = DVec3::new(sine * azimuth.to_radians().cos(), sine * azimuth.to_radians().sin(), cosine);
        let observer = Observer { altitude_km, sun_zenith: sun_zenith_deg.to_radians() };
        field.segments(&observer, cosine, &[azimuth.to_radians()], &DISTANCES_KM, &mut segments);
        for d in [i % DISTANCES_KM.len(), (i + 3) % DISTANCES_KM.len()] {
            let found = segments.radiance(0, d)[0];
            let tracer = PathTracer::new(&profile, 0).unwrap().with_length_km(DISTANCES_KM[d]);
            let trace = |paths, seed| tracer.radiance(altitude_km, sun_zenith_deg, view, paths, seed).unwrap();
            let pilot = trace(PILOT_PATHS, PILOT_SEED + i as u64);
            if pilot.mean == 0.0 {
                // An observer above the air whose line of sight has not entered it yet.
                assert_eq!(found, 0.0);
                continue;
            }
            let needed = PILOT_PATHS as f64 * (pilot.standard_error / pilot.mean / NOISE).powi(2);
            let traced = trace((needed as usize).clamp(PILOT_PATHS, 400_000), i as u64);
            let (error, noise) = (found / traced.mean - 1.0, traced.standard_error / traced.mean);
            println!(
                "{altitude_km:5} {sun_zenith_deg:4} {zenith:5} {azimuth:5} {:6} {:.5} {found:.5e} {:.5e} {:5.2} {:+6.2} {:+6.2}",
                DISTANCES_KM[d],
                segments.transmittance(d)[0],
                traced.mean,
                100.0 * noise,
                100.0 * error,
                error / noise
            );
            assert!(noise <= 0.01, "too noisy to judge");
            deviations.push(error / noise);
        }
    }
    let worst = deviations.iter().fold(0.0_f64, |worst, value| worst.max(value.abs()));
    let rms = (deviations.iter().map(|v| v * v).sum::<f64>() / deviations.len() as f64).sqrt();
    println!("{} parts of rays: rms {rms:.2}, worst {worst:.2} standard errors", deviations.len());
    assert!(deviations.len() >= 38 && worst <= 3.0 && rms <= 1.5);
}
