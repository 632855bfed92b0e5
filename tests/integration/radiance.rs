//! The solved radiance against independent codes: discrete ordinates in a flat and Monte Carlo in a spherical atmosphere.

use crate::common::airs::{Airs, summary};
use crate::common::{FLAT_RADIUS_KM, Row, SPHERICAL_RADIUS_KM, shared_table};

#[test]
#[ignore = "needs ../shared/reference"]
fn flat_atmosphere_agrees_with_discrete_ordinates() {
    let rows = shared_table("radiance/plane_parallel_scalar_disort.csv");
    let airs = Airs::solve(&rows, FLAT_RADIUS_KM);
    let errors: Vec<f64> = rows.iter().map(|row| airs.radiance(row, 0.0) / row["radiance"] - 1.0).collect();
    for (aerosol, limit) in [(0.0, 0.003), (0.1, 0.006), (0.4, 0.006), (1.0, 0.01)] {
        let part: Vec<f64> = rows.iter().zip(&errors).filter(|(row, _)| row["tau_aerosol"] == aerosol).map(|(_, e)| *e).collect();
        if !part.is_empty() {
            let (rms, _) = summary(&format!("plane-parallel, aerosol optical depth {aerosol}"), &part);
            assert!(rms <= limit, "aerosol optical depth {aerosol}: {rms}");
        }
    }
    let (rms, worst) = summary("plane-parallel", &errors);
    for (row, error) in rows.iter().zip(&errors).filter(|(_, e)| e.abs() > 0.7 * worst) {
        println!("{:+.2} % {row:?}", 100.0 * error);
    }
    assert!(rms <= 0.004 && worst <= 0.02);
}

#[test]
#[ignore = "needs ../shared/reference"]
fn spherical_atmosphere_agrees_with_monte_carlo() {
    let rows = shared_table("radiance/spherical_scalar_monte_carlo.csv");
    let airs = Airs::solve(&rows, SPHERICAL_RADIUS_KM);
    let error = |row: &Row| {
        let expected = row["single_scattering"] + row["multiple_scattering"];
        airs.radiance(row, row["observer_altitude_km"]) / expected - 1.0
    };
    for zenith in [30.0, 60.0, 75.0, 80.0, 85.0, 88.0, 90.0, 92.0, 94.0, 96.0, 98.0, 100.0] {
        let part: Vec<f64> = rows.iter().filter(|row| row["sun_zenith_deg"] == zenith).map(error).collect();
        if !part.is_empty() {
            summary(&format!("spherical, Sun zenith {zenith}"), &part);
        }
    }
    let tested: Vec<&Row> = rows.iter().filter(|row| row["sun_zenith_deg"] <= 96.0).collect();
    let errors: Vec<f64> = tested.iter().map(|row| error(row)).collect();
    let (rms, _) = summary("spherical to Sun zenith 96", &errors);
    // Each row within three standard errors and one per cent.
    let excess = |row: &Row, error: f64| {
        let all = row["single_scattering"] + row["multiple_scattering"];
        error.abs() - 3.0 * row["standard_error"] / all - 0.01
    };
    let missed: Vec<_> = tested.iter().zip(&errors).filter(|(row, error)| excess(row, **error) > 0.0).collect();
    for (row, error) in &missed {
        println!("{:+.2} % (3 standard errors {:.2} %) {row:?}", 100.0 * **error, 100.0 * (-excess(row, 0.0) - 0.01));
    }
    println!("{} of {} rows beyond three standard errors and one per cent", missed.len(), tested.len());
    assert!(rms <= 0.015 && missed.is_empty());
}
