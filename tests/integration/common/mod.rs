//! What the integration tests share: the air of the reference tables and the tables themselves.

#![allow(dead_code)]

pub mod airs;
pub mod night;

use skyprobe::atmosphere::{Component, OpticalProfile, Phase};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Planet radius of the spherical reference tables [km].
pub const SPHERICAL_RADIUS_KM: f64 = 6_371.0;

/// Planet radius that makes the planet flat for the plane-parallel reference tables [km].
pub const FLAT_RADIUS_KM: f64 = 6.371e6;

/// The air of the reference tables on a planet of 6371 km; see [`reference_air_on`].
pub fn reference_air(tau_rayleigh: f64, tau_aerosol: f64, tau_ozone: f64, ground_albedo: f64) -> OpticalProfile {
    reference_air_on(SPHERICAL_RADIUS_KM, tau_rayleigh, tau_aerosol, tau_ozone, ground_albedo)
}

/// The air of the reference tables at one wavelength (550 nm stands for it): vertical profiles on a 0.5 km grid from 0 to 100 km,
/// each normalised by the trapezoid rule to its column. Molecules exp(-z / 8 km) without depolarisation; aerosol exp(-z / 1.5
/// km), Henyey-Greenstein 0.7, single scattering albedo 0.95 (`tau_aerosol` is extinction); ozone a triangle 10-25-40 km that
/// only absorbs. Solar irradiance 1; the Sun a disc of 0.00465 rad.
pub fn reference_air_on(
    planet_radius_km: f64,
    tau_rayleigh: f64,
    tau_aerosol: f64,
    tau_ozone: f64,
    ground_albedo: f64,
) -> OpticalProfile {
    let altitudes_km: Vec<f64> = (0..=200).map(|i| 0.5 * i as f64).collect();
    let column = |tau: f64, shape: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let values: Vec<f64> = altitudes_km.iter().map(|&z| shape(z)).collect();
        let integral: f64 = values.windows(2).map(|pair| 0.25 * (pair[0] + pair[1])).sum();
        values.iter().map(|value| value * tau / integral).collect()
    };
    let times = |values: &[f64], factor: f64| values.iter().map(|value| value * factor).collect::<Vec<f64>>();
    let none = vec![0.0; altitudes_km.len()];
    let aerosol = column(tau_aerosol, &|z| (-z / 1.5).exp());
    OpticalProfile {
        components: vec![
            Component {
                name: "molecules".into(),
                scattering_per_km: column(tau_rayleigh, &|z| (-z / 8.0).exp()),
                absorption_per_km: none.clone(),
                phase: Some(Phase::Rayleigh { depolarisation: vec![0.0] }),
            },
            Component {
                name: "aerosol".into(),
                scattering_per_km: times(&aerosol, 0.95),
                absorption_per_km: times(&aerosol, 0.05),
                phase: Some(Phase::HenyeyGreenstein { asymmetry: 0.7 }),
            },
            Component {
                name: "ozone".into(),
                scattering_per_km: none,
                absorption_per_km: column(tau_ozone, &|z| (1.0 - (z - 25.0).abs() / 15.0).max(0.0)),
                phase: None,
            },
        ],
        altitudes_km,
        wavelengths_nm: vec![550.0],
        ground_albedo: vec![ground_albedo],
        solar_irradiance: vec![1.0],
        planet_radius_km,
        sun_angular_radius_deg: 0.00465_f64.to_degrees(),
    }
}

/// One row of a reference table: numbers by column name.
pub type Row = HashMap<String, f64>;

/// Reads a table with a header line of column names; lines that begin with `#` are comments.
pub fn read_table(path: &Path) -> Vec<Row> {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    let names: Vec<&str> = lines.next().expect("a header line").split(',').collect();
    lines
        .map(|line| {
            let values: Vec<f64> = line.split(',').map(|v| v.parse().unwrap_or_else(|_| panic!("{line}"))).collect();
            assert_eq!(values.len(), names.len(), "{line}");
            names.iter().map(|name| name.to_string()).zip(values).collect()
        })
        .collect()
}

/// A table of the project's own, in `tests/reference`.
pub fn own_table(name: &str) -> Vec<Row> {
    read_table(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name))
}

/// A file or folder beside the checkout, in `../shared/reference` or in the folder that the environment variable `SKYPROBE_REFERENCE` names.
///
/// Not everybody has it, and the test harness cannot skip at run time: each test that needs one is marked `#[ignore = "needs ../shared/reference"]`, and
/// `tests/run.sh` asks for those tests where the folder is (`cargo test -- --include-ignored`).
///
/// # Panics
///
/// Where it is absent.
pub fn shared_reference(name: &str) -> PathBuf {
    let folder = std::env::var_os("SKYPROBE_REFERENCE")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference"), PathBuf::from);
    let path = folder.join(name);
    assert!(path.exists(), "there is no {}: SKYPROBE_REFERENCE names the folder of the shared reference", path.display());
    path
}

/// A table of the shared reference; see [`shared_reference`].
pub fn shared_table(name: &str) -> Vec<Row> {
    read_table(&shared_reference(name))
}
