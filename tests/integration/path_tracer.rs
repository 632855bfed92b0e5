//! The path tracer against independent codes in the same air: Monte Carlo on the sphere, discrete ordinates on the plane.

use crate::common::{FLAT_RADIUS_KM, Row, own_table, reference_air, reference_air_on, shared_table};
use glam::DVec3;
use skyprobe::atmosphere::OpticalProfile;
use skyprobe::light::PathTracer;

/// Every so many rows of the table are tested; prime, so that all Suns, observers and views take part.
const ROW_STEP: usize = 7;

/// Direction of sight in the frame z up, x towards the Sun's azimuth.
fn view(row: &Row) -> DVec3 {
    let (sine, cosine) = row["view_zenith_deg"].to_radians().sin_cos();
    let (sine_azimuth, cosine_azimuth) = row["relative_azimuth_deg"].to_radians().sin_cos();
    DVec3::new(sine * cosine_azimuth, sine * sine_azimuth, cosine)
}

#[test]
#[ignore = "needs ../shared/reference"]
fn agrees_with_the_spherical_monte_carlo_table() {
    let rows = shared_table("radiance/spherical_scalar_monte_carlo.csv");
    let rows: Vec<&Row> = rows.iter().filter(|row| row["sun_zenith_deg"] <= 96.0).step_by(ROW_STEP).collect();
    let (mut worst, mut squares) = (0.0_f64, 0.0);
    for (seed, row) in rows.iter().enumerate() {
        let profile = reference_air(row["tau_rayleigh"], row["tau_aerosol"], row["tau_ozone"], row["ground_albedo"]);
        let (altitude, sun_zenith) = (row["observer_altitude_km"], row["sun_zenith_deg"]);

        // The table's single scattering takes the light from the centre of the Sun, its multiple scattering from the disc.
        let mut point_sun = profile.clone();
        point_sun.sun_angular_radius_deg = 0.0;
        let single = PathTracer::new(&point_sun, 0).unwrap().single_scattering(altitude, sun_zenith, view(row)).unwrap();
        let tolerance = if sun_zenith <= 90.0 { 2e-4 } else { 5e-3 };
        let floor = 1e-3 * row["multiple_scattering"];
        assert!((single - row["single_scattering"]).abs() <= tolerance * single + floor, "{single} {row:?}");

        let tracer = PathTracer::new(&profile, 0).unwrap();
        let multiple = tracer.multiple_scattering(altitude, sun_zenith, view(row), 10_000, seed as u64).unwrap();
        let error = multiple.standard_error.hypot(row["standard_error"]);
        let deviation = (multiple.mean - row["multiple_scattering"]) / error;
        assert!(error < 0.1 * multiple.mean, "too noisy to judge: {multiple:?} {row:?}");
        assert!(deviation.abs() < 3.5, "{deviation} standard errors: {multiple:?} {row:?}");
        worst = worst.max(deviation.abs());
        squares += deviation * deviation;
    }
    let rms = (squares / rows.len() as f64).sqrt();
    println!("{} rows: rms {rms:.2}, worst {worst:.2} combined standard errors", rows.len());
    assert!(rms < 1.3, "rms of {rms} standard errors over {} rows", rows.len());
}

#[test]
fn agrees_with_discrete_ordinates_on_a_flat_planet() {
    let rows = own_table("plane_parallel_disort.csv");
    // Every so many rows, prime again.
    let rows: Vec<&Row> = rows.iter().step_by(31).collect();
    let mut squares = 0.0;
    for (seed, row) in rows.iter().enumerate() {
        let mut profile =
            reference_air_on(FLAT_RADIUS_KM, row["tau_rayleigh"], row["tau_aerosol"], row["tau_ozone"], row["ground_albedo"]);
        profile.sun_angular_radius_deg = 0.0;
        let tracer = PathTracer::new(&profile, 0).unwrap();
        let found = tracer.radiance(row["observer_altitude_km"], row["sun_zenith_deg"], view(row), 10_000, seed as u64).unwrap();
        let error = found.standard_error.hypot(row["relative_error"] * row["radiance"]);
        let deviation = (found.mean - row["radiance"]) / error;
        assert!(error < 0.06 * found.mean, "too noisy to judge: {found:?} {row:?}");
        assert!(deviation.abs() < 4.0, "{deviation} standard errors: {found:?} {row:?}");
        squares += deviation * deviation;
    }
    let rms = (squares / rows.len() as f64).sqrt();
    println!("{} rows: rms {rms:.2} standard errors", rows.len());
    assert!(rms < 1.5, "rms of {rms} standard errors over {} rows", rows.len());
}

/// The air of a row of the project's spherical tables, with the Sun as a point.
fn spherical_air(row: &Row) -> OpticalProfile {
    let mut profile = reference_air(row["tau_rayleigh"], row["tau_aerosol"], row["tau_ozone"], row["ground_albedo"]);
    profile.sun_angular_radius_deg = 0.0;
    profile
}

#[test]
fn agrees_with_single_scattering_on_a_sphere() {
    for row in own_table("spherical_single_scattering.csv").iter().step_by(5) {
        let profile = spherical_air(row);
        let tracer = PathTracer::new(&profile, 0).unwrap();
        let single = tracer.single_scattering(row["observer_altitude_km"], row["sun_zenith_deg"], view(row)).unwrap();
        assert!((single / row["single_scattering"] - 1.0).abs() < 2e-4, "{single} {row:?}");
    }
}

#[test]
fn agrees_with_successive_orders_on_a_sphere() {
    let rows = own_table("spherical_multiple_scattering.csv");
    // Every so many rows, prime again.
    let rows: Vec<&Row> = rows.iter().step_by(17).collect();
    let mut mean = 0.0;
    for (seed, row) in rows.iter().enumerate() {
        let profile = spherical_air(row);
        let tracer = PathTracer::new(&profile, 0).unwrap();
        let (altitude, sun_zenith) = (row["observer_altitude_km"], row["sun_zenith_deg"]);
        let found = tracer.radiance(altitude, sun_zenith, view(row), 10_000, seed as u64).unwrap();
        let single = tracer.single_scattering(altitude, sun_zenith, view(row)).unwrap();
        let expected = single + row["multiple_scattering"];
        // Successive orders are off by as much where the Sun is low: tests/reference/README.md.
        let tolerance = if sun_zenith > 70.0 { 0.04 } else { 0.02 };
        let difference = found.mean - expected;
        assert!(difference.abs() < 3.0 * found.standard_error + tolerance * expected, "{difference} {found:?} {row:?}");
        mean += difference / expected / rows.len() as f64;
    }
    println!("{} rows: mean difference {:+.2} % of the total", rows.len(), 100.0 * mean);
    assert!(mean.abs() < 0.015, "mean difference {mean}");
}
