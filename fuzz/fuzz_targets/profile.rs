//! Optical profiles as arrays from anywhere: what is found valid has the shapes and ranges that the solver takes for granted.
#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use skyprobe::atmosphere::{Component, OpticalProfile, Phase, PhaseTable};
use std::sync::Arc;

#[derive(Arbitrary, Debug)]
enum AnyPhase {
    Rayleigh(Vec<f64>),
    HenyeyGreenstein(f64),
    CornetteShanks(f64),
    Tabulated(Vec<f64>, Vec<f64>),
}

#[derive(Arbitrary, Debug)]
struct AnyProfile {
    /// Makes the arrays consistent, which chance alone hardly does.
    consistent: bool,
    altitudes: Vec<f64>,
    wavelengths: Vec<f64>,
    components: Vec<(Vec<f64>, Vec<f64>, Option<AnyPhase>)>,
    albedo: Vec<f64>,
    sun: Vec<f64>,
    radius: f64,
    sun_angle: f64,
}

fn phase(any: AnyPhase) -> Option<Phase> {
    Some(match any {
        AnyPhase::Rayleigh(depolarisation) => Phase::Rayleigh { depolarisation },
        AnyPhase::HenyeyGreenstein(asymmetry) => Phase::HenyeyGreenstein { asymmetry },
        AnyPhase::CornetteShanks(asymmetry) => Phase::CornetteShanks { asymmetry },
        AnyPhase::Tabulated(angles, values) => Phase::Tabulated(Arc::new(PhaseTable::new(&angles, &values).ok()?)),
    })
}

fuzz_target!(|any: AnyProfile| {
    let AnyProfile { consistent, mut altitudes, mut wavelengths, components, mut albedo, mut sun, mut radius, mut sun_angle } =
        any;
    if consistent {
        altitudes.truncate(8);
        wavelengths.truncate(8);
        altitudes
            .iter_mut()
            .enumerate()
            .for_each(|(index, altitude)| *altitude = 10.0 * index as f64 + altitude.clamp(0.0, 1.0) * index.min(1) as f64);
        wavelengths
            .iter_mut()
            .enumerate()
            .for_each(|(index, wavelength)| *wavelength = 400.0 + 20.0 * index as f64 + wavelength.clamp(0.0, 1.0));
        albedo.resize(wavelengths.len(), 0.2);
        sun.resize(wavelengths.len(), 1.5);
        (radius, sun_angle) = (6371.0, 0.2665);
    }
    let cells = altitudes.len() * wavelengths.len();
    let made = components.into_iter().take(6).map(|(mut scattering, mut absorption, any)| {
        if consistent {
            scattering.resize(cells, 0.01);
            absorption.resize(cells, 0.0);
        }
        Component {
            name: "any".to_owned(),
            scattering_per_km: scattering,
            absorption_per_km: absorption,
            phase: any.and_then(phase),
        }
    });
    let profile = OpticalProfile {
        altitudes_km: altitudes,
        wavelengths_nm: wavelengths,
        components: made.collect(),
        ground_albedo: albedo,
        solar_irradiance: sun,
        planet_radius_km: radius,
        sun_angular_radius_deg: sun_angle,
    };
    if profile.validate().is_ok() {
        assert!(profile.altitudes_km.is_sorted() && profile.altitudes_km.len() >= 2);
        let wavelengths = profile.wavelengths_nm.len();
        assert!(wavelengths > 0 && profile.ground_albedo.len() == wavelengths && profile.solar_irradiance.len() == wavelengths);
        for component in &profile.components {
            assert_eq!(component.scattering_per_km.len(), profile.altitudes_km.len() * wavelengths);
            assert_eq!(component.absorption_per_km.len(), profile.altitudes_km.len() * wavelengths);
            assert!(
                component
                    .scattering_per_km
                    .iter()
                    .chain(&component.absorption_per_km)
                    .all(|value| value.is_finite() && *value >= 0.0)
            );
            if let Some(phase) = &component.phase {
                for wavelength in 0..wavelengths {
                    for cosine in [-1.0, -0.3, 0.0, 0.7, 1.0] {
                        let value = phase.value(wavelength, cosine);
                        assert!(value.is_finite() && value >= 0.0, "{value}");
                    }
                }
            }
        }
    }
});
