//! Polarised light against the exact tables of Natraj, Li & Yung 2009 (Rayleigh scattering without depolarisation on a flat planet).

use crate::common::airs::summary;
use crate::common::{FLAT_RADIUS_KM, Row, own_table, reference_air_on, shared_table};
use skyprobe::light::{LightField, Observer, transverse};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use std::f64::consts::PI;

/// The rows of a table for one optical depth, solved for all albedos at once: errors of I (relative) and of the degree of polarisation. `sign` is the table's of Q and U
/// relative to the library's.
fn errors(tau: f64, rows: &[Row], sign: f64) -> Vec<(f64, f64, String)> {
    let albedos = [0.0, 0.25, 0.8];
    let mut profile = reference_air_on(FLAT_RADIUS_KM, tau, 0.0, 0.0, 0.0);
    profile.sun_angular_radius_deg = 0.0;
    profile.components.truncate(1);
    profile.wavelengths_nm = vec![400.0, 401.0, 402.0];
    profile.solar_irradiance = vec![1.0; 3];
    profile.ground_albedo = albedos.to_vec();
    let component = &mut profile.components[0];
    for values in [&mut component.scattering_per_km, &mut component.absorption_per_km] {
        *values = values.iter().flat_map(|&v| [v; 3]).collect();
    }
    let start = std::time::Instant::now();
    let field = LightField::solve(&profile, &Quality::High.numbers(), true, &Progress::silent()).unwrap();
    println!("solved in {:.2} s", start.elapsed().as_secs_f64());
    rows.iter()
        .filter(|row| row["mu"] >= 0.1)
        .map(|row| {
            let (mu0, mu, phi) = (row["mu0"], row["mu"], row["phi_deg"].to_radians());
            let sun_zenith = mu0.acos();
            let gathered = field.gather(&Observer { altitude_km: 0.0, sun_zenith }, mu, &[phi]);
            let cosine = mu * mu0 + ((1.0 - mu * mu) * (1.0 - mu0 * mu0)).max(0.0).sqrt() * phi.cos();
            let air = albedos.iter().position(|&a| a == row["albedo"]).unwrap();
            let [i, q, u] = field.stokes(&gathered, 0, air, transverse(mu, phi, sun_zenith), cosine).map(|v| PI * v);
            let expected = [row["I"], sign * row["Q"], sign * row["U"]];
            let polarised = (q - expected[1]).hypot(u - expected[2]) / expected[0];
            (i / expected[0] - 1.0, polarised, format!("{row:?}: {i} {q} {u}"))
        })
        .collect()
}

/// Largest root mean square error of I at these optical depths.
const LIMITS: [(f64, f64); 7] = [(0.02, 5e-4), (0.05, 5e-4), (0.1, 5e-4), (0.15, 5e-4), (0.25, 5e-4), (0.5, 1e-3), (1.0, 2.5e-3)];

fn judge(tau: f64, limit: f64, rows: &[Row], sign: f64) {
    let errors = errors(tau, rows, sign);
    let (rms, _) = summary(&format!("tau {tau}, I"), &errors.iter().map(|e| e.0).collect::<Vec<_>>());
    let (_, worst) = summary(&format!("tau {tau}, degree of polarisation"), &errors.iter().map(|e| e.1).collect::<Vec<_>>());
    if let Some(bad) = errors.iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs())) {
        println!("largest: {bad:?}");
    }
    if let Some(bad) = errors.iter().max_by(|a, b| a.1.total_cmp(&b.1)) {
        println!("largest in polarisation: {bad:?}");
    }
    assert!(rms < limit && worst < 2e-3, "tau {tau}: {rms} {worst}");
}

#[test]
#[ignore = "needs ../shared/reference"]
fn rayleigh_skies_are_those_of_the_exact_tables() {
    for (tau, limit) in LIMITS.into_iter().filter(|(tau, _)| [0.1, 0.5].contains(tau)) {
        let rows = shared_table(&format!("natraj2009/downwelling_tau_{tau}.csv"));
        // The tables have the opposite sign of Q and U.
        judge(tau, limit, &rows, -1.0);
    }
}

/// checked against: doubling, exact to 1e-6 (`tests/reference/make_rayleigh.py`), at the optical depths between and beyond those tables.
#[test]
fn rayleigh_skies_are_those_of_doubling() {
    let rows = own_table("rayleigh_polarised.csv");
    let mut judged = 0;
    for (tau, limit) in LIMITS {
        let part: Vec<Row> = rows.iter().filter(|row| row["tau"] == tau).cloned().collect();
        if !part.is_empty() {
            judge(tau, limit, &part, 1.0);
            judged += part.len();
        }
    }
    assert_eq!(judged, rows.len());
}
