//! The polarised path tracer against the exact tables of the polarised Rayleigh sky on a flat planet (Natraj, Li & Yung 2009).

use crate::common::{FLAT_RADIUS_KM, Row, own_table, shared_table};
use glam::DVec3;
use skyprobe::atmosphere::{Component, OpticalProfile, Phase};
use skyprobe::light::{Guiding, PathTracer};
use std::f64::consts::PI;

const PATHS: usize = 20_000;

/// Molecules without depolarisation of optical depth `tau`; so low that the planet is flat even for rays along the horizon.
fn molecules(tau: f64, ground_albedo: f64) -> OpticalProfile {
    OpticalProfile {
        altitudes_km: vec![0.0, 1.0],
        wavelengths_nm: vec![550.0],
        components: vec![Component {
            name: "molecules".into(),
            scattering_per_km: vec![tau; 2],
            absorption_per_km: vec![0.0; 2],
            phase: Some(Phase::Rayleigh { depolarisation: vec![0.0] }),
        }],
        ground_albedo: vec![ground_albedo],
        solar_irradiance: vec![1.0],
        planet_radius_km: FLAT_RADIUS_KM,
        sun_angular_radius_deg: 0.0,
    }
}

/// Compares I, Q and U row by row.
fn compare(name: &str, rows: &[(f64, &Row)]) {
    let (mut squares, mut worst, mut relative) = ([0.0; 3], 0.0_f64, 0.0);
    let mut airs: Vec<(f64, f64)> = rows.iter().map(|(tau, row)| (*tau, row["albedo"])).collect();
    airs.sort_by(|a, b| a.partial_cmp(b).unwrap());
    airs.dedup();
    let profiles: Vec<OpticalProfile> = airs.iter().map(|&(tau, albedo)| molecules(tau, albedo)).collect();
    let tracers: Vec<PathTracer> = profiles
        .iter()
        .map(|profile| PathTracer::new(profile, 0).unwrap().with_polarisation(true).with_guiding(Guiding::Always))
        .collect();
    for (seed, (tau, row)) in rows.iter().enumerate() {
        let tracer = &tracers[airs.iter().position(|&air| air == (*tau, row["albedo"])).unwrap()];
        let (mu, azimuth) = (row["mu"], row["phi_deg"].to_radians());
        // At the zenith the table still turns its axes with the azimuth: a hair beside it they are the library's.
        let sine = (1.0 - mu * mu).max(1e-12).sqrt();
        let view = DVec3::new(sine * azimuth.cos(), sine * azimuth.sin(), mu).normalize();
        let found = tracer.stokes(0.0, row["mu0"].acos().to_degrees(), view, PATHS, seed as u64).unwrap();
        // The table is for an irradiance of pi, and its signs of Q and U are the other way round.
        let expected = [row["I"] / PI, -row["Q"] / PI, -row["U"] / PI];
        for i in 0..3 {
            // 1e-5 of the intensity: the table's rounding and the quadrature of single scattering.
            let error = found[i].standard_error.hypot(2e-5 * expected[0]);
            let deviation = (found[i].mean - expected[i]) / error;
            assert!(found[i].standard_error < 0.01 * expected[0], "too noisy to judge: {found:?} {row:?}");
            assert!(deviation.abs() < 4.0, "Stokes parameter {i}, {deviation} standard errors: {found:?} {expected:?} {row:?}");
            squares[i] += deviation * deviation;
            worst = worst.max(deviation.abs());
        }
        relative += (found[0].mean / expected[0] - 1.0).powi(2);
    }
    let n = rows.len() as f64;
    let rms = squares.map(|sum| (sum / n).sqrt());
    println!(
        "{name}: {n} rows, I within {:.3} % rms; rms of I, Q, U {:.2} {:.2} {:.2}, worst {worst:.2} standard errors",
        100.0 * (relative / n).sqrt(),
        rms[0],
        rms[1],
        rms[2]
    );
    // Were it all noise, each rms would be 1 within 1 / sqrt(2 n).
    assert!(rms.iter().all(|&rms| rms < 1.0 + 3.0 / (2.0 * n).sqrt()), "{rms:?}");
}

#[test]
fn agrees_with_published_rows_of_the_polarised_sky() {
    let rows = own_table("natraj2009.csv");
    compare("published rows", &rows.iter().map(|row| (row["tau"], row)).collect::<Vec<_>>());
}

#[test]
#[ignore = "needs ../shared/reference"]
fn agrees_with_the_published_tables_of_the_polarised_sky() {
    for (tau, step) in [(0.1, 97), (0.5, 89)] {
        let name = format!("natraj2009/downwelling_tau_{tau}.csv");
        let rows = shared_table(&name);
        compare(&name, &rows.iter().step_by(step).map(|row| (tau, row)).collect::<Vec<_>>());
    }
}
