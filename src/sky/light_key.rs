//! The key under which solved light is kept: every value that the solution depends on, bit by bit.
//!
//! Everything is taken apart by its fields' names, so that a new one cannot be forgotten: the compiler asks what it means here.

use super::cache::{Key, KeyBuilder};
use crate::atmosphere::{Component, OpticalProfile, Phase};
use crate::quality::Numbers;

/// The key of the light of `profile` solved with `numbers`, polarised or as a scalar.
pub(super) fn of(profile: &OpticalProfile, numbers: &Numbers, polarised: bool) -> Key {
    let mut key = KeyBuilder::of_this_solver();
    // The solution is relative to the Sun's irradiance.
    let OpticalProfile {
        altitudes_km,
        wavelengths_nm,
        components,
        ground_albedo,
        solar_irradiance: _,
        planet_radius_km,
        sun_angular_radius_deg,
    } = profile;
    for values in [altitudes_km, wavelengths_nm, ground_albedo] {
        add(&mut key, values);
    }
    add(&mut key, &[*planet_radius_km, *sun_angular_radius_deg, components.len() as f64]);
    for Component { name: _, scattering_per_km, absorption_per_km, phase } in components {
        add(&mut key, scattering_per_km);
        add(&mut key, absorption_per_km);
        add_phase(&mut key, phase.as_ref());
    }
    add_numbers(&mut key, numbers);
    key.text(if polarised { "polarised" } else { "scalar" });
    key.finish()
}

/// Adds numbers; 0 and -0 are the same air.
fn add(key: &mut KeyBuilder, values: &[f64]) {
    key.numbers(&values.iter().map(|value| value + 0.0).collect::<Vec<_>>());
}

fn add_phase(key: &mut KeyBuilder, phase: Option<&Phase>) {
    match phase {
        None => key.text("none"),
        Some(Phase::Rayleigh { depolarisation }) => {
            key.text("rayleigh");
            add(key, depolarisation);
        }
        Some(Phase::HenyeyGreenstein { asymmetry }) => {
            key.text("henyey_greenstein");
            add(key, &[*asymmetry]);
        }
        Some(Phase::CornetteShanks { asymmetry }) => {
            key.text("cornette_shanks");
            add(key, &[*asymmetry]);
        }
        Some(Phase::Tabulated(table)) => {
            key.text("tabulated");
            for values in table.defining_values() {
                add(key, values);
            }
        }
    }
}

fn add_numbers(key: &mut KeyBuilder, numbers: &Numbers) {
    // The dome is gathered from the solution.
    let Numbers {
        wavelengths,
        altitudes,
        solar_zenith_angles,
        iteration_altitudes,
        iteration_solar_zenith_angles,
        shells,
        iteration_zenith_nodes,
        zenith_nodes,
        azimuth_nodes,
        order,
        azimuthal_order,
        full_applications,
        convergence,
        step_km,
        dome_circles: _,
        dome_azimuths: _,
    } = numbers;
    let counts = [
        *wavelengths,
        *altitudes,
        *solar_zenith_angles,
        *iteration_altitudes,
        *iteration_solar_zenith_angles,
        *shells,
        *order,
        *azimuthal_order,
        *full_applications,
    ];
    let nodes = iteration_zenith_nodes.iter().chain(zenith_nodes).chain(azimuth_nodes);
    let values: Vec<f64> = counts.iter().chain(nodes).map(|&count| count as f64).collect();
    add(key, &values);
    add(key, &[f64::from(*convergence), *step_km]);
}

#[cfg(test)]
mod tests;
