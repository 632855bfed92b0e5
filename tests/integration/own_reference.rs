//! The solver at quality `high` against the project's own reference tables, which independent codes computed: see `tests/reference`.

use crate::common::airs::{Airs, summary};
use crate::common::{FLAT_RADIUS_KM, Row, SPHERICAL_RADIUS_KM, own_table};
use std::collections::HashMap;

/// Relative errors of the solver, by row.
fn errors(rows: &[Row], planet_radius_km: f64, expected: impl Fn(&Row) -> f64) -> Vec<f64> {
    let airs = Airs::solve(rows, planet_radius_km);
    rows.iter().map(|row| airs.radiance(row, row["observer_altitude_km"]) / expected(row) - 1.0).collect()
}

/// Prints the errors of the rows that share a value of `column`, for each value.
fn summaries_by(column: &str, rows: &[Row], errors: &[f64]) {
    let mut values: Vec<f64> = rows.iter().map(|row| row[column]).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    for value in values {
        let part: Vec<f64> = rows.iter().zip(errors).filter(|(row, _)| row[column] == value).map(|(_, e)| *e).collect();
        summary(&format!("  {column} {value}"), &part);
    }
}

/// Prints the errors by what they may depend on, and the rows with the largest; returns rms and largest error of all.
fn judge(name: &str, rows: &[Row], errors: &[f64]) -> (f64, f64) {
    for column in ["tau_aerosol", "observer_altitude_km", "sun_zenith_deg", "view_zenith_deg"] {
        summaries_by(column, rows, errors);
    }
    let (rms, worst) = summary(name, errors);
    for (row, error) in rows.iter().zip(errors).filter(|(_, e)| e.abs() > 0.8 * worst) {
        println!("{:+.2} % {row:?}", 100.0 * error);
    }
    (rms, worst)
}

#[test]
fn agrees_with_discrete_ordinates_in_a_flat_atmosphere() {
    let rows = own_table("plane_parallel_disort.csv");
    let errors = errors(&rows, FLAT_RADIUS_KM, |row| row["radiance"]);
    let (_, worst) = judge("plane-parallel", &rows, &errors);
    for (aerosol, limit) in [(0.0, 0.003), (0.2, 0.006), (0.5, 0.006), (1.0, 0.01)] {
        let part: Vec<f64> = rows.iter().zip(&errors).filter(|(row, _)| row["tau_aerosol"] == aerosol).map(|(_, e)| *e).collect();
        let (rms, _) = summary(&format!("aerosol optical depth {aerosol}"), &part);
        assert!(rms <= limit, "aerosol optical depth {aerosol}: {rms}");
    }
    assert!(worst <= 0.04);
}

/// Down to Sun zenith 60 degrees the table of multiple scattering is within 1 % rms of the path tracer; at 80 it is 1.8 %, up to 4.7 %, off,
/// no better than what it would judge.
#[test]
fn agrees_with_successive_orders_in_a_spherical_atmosphere() {
    let case = |row: &Row| {
        let mut numbers: Vec<(String, u64)> = row
            .iter()
            .filter(|(name, _)| !name.ends_with("scattering") && *name != "error")
            .map(|(n, v)| (n.clone(), v.to_bits()))
            .collect();
        numbers.sort();
        numbers
    };
    let once: HashMap<_, f64> =
        own_table("spherical_single_scattering.csv").iter().map(|row| (case(row), row["single_scattering"])).collect();
    let mut rows = own_table("spherical_multiple_scattering.csv");
    rows.retain(|row| row["sun_zenith_deg"] <= 60.0);
    assert!(rows.len() >= 270);
    let total = |row: &Row| once[&case(row)] + row["multiple_scattering"];
    let (rms, worst) = judge("spherical", &rows, &errors(&rows, SPHERICAL_RADIUS_KM, total));
    assert!(rms <= 0.02 && worst <= 0.06);
}
