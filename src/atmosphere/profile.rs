//! From the state of the air to its optical profile.
//!
//! Components, in this order: molecules, ozone, aerosol (always all three, so that an index means the same thing everywhere), then
//! the stratospheric aerosol if there is any.
//! Each coefficient is sampled on the altitude grid and scaled so that the profile's own integral, which is linear between altitudes,
//! is exactly the column that was asked for.

use super::aerosol::{AerosolOptics, AerosolSpectrum, angstrom};
use super::air::Air;
use super::molecules;
use super::optical_profile::{Component, OpticalProfile};
use super::ozone;
use super::particle_tables::Mixture;
use super::particles::Particle;
use super::phase::Phase;
use super::phase_function::PhaseFunction;
use super::standard_atmosphere::StandardAtmosphere;
use crate::error::{Result, check_range};
use crate::spectrum::solar;
use crate::units::EARTH_RADIUS_KM;
use std::sync::Arc;

/// Top of the profile [km]. What is above matters to twilight alone: at Sun -18 degrees, 20 km more change the radiance by about a per cent.
pub const TOP_KM: f64 = super::standard_atmosphere::TOP_KM;

/// Angular radius of the Sun's disc at 1 au [degrees].
pub const SUN_ANGULAR_RADIUS_DEG: f64 = 0.2664;

/// Standard deviation of the Gaussian profile of the stratospheric aerosol [km]: some months after a great eruption most of it is
/// found in the ten kilometres above the tropopause (chosen).
pub const STRATOSPHERIC_WIDTH_KM: f64 = 3.0;

/// Wavelengths for which there are data [nm].
pub const WAVELENGTH_RANGE_NM: (f64, f64) = (300.0, 1000.0);

/// Altitudes of the profile [km]: every 100 m up to 5 km, then in steps that grow by a tenth to 2 km, up to [`TOP_KM`].
pub fn altitudes_km() -> Vec<f64> {
    let mut altitudes: Vec<f64> = (0..=50).map(|i| f64::from(i) / 10.0).collect();
    let (mut altitude, mut step) = (5.0, 0.1_f64);
    loop {
        step = (step * 1.1).min(2.0);
        altitude += step;
        if altitude > TOP_KM - 0.5 * step {
            altitudes.push(TOP_KM);
            return altitudes;
        }
        altitudes.push(altitude);
    }
}

/// Molecules of air in a vertical column of `atmosphere` above sea level [m-2].
pub(super) fn air_column_per_m2(atmosphere: StandardAtmosphere) -> f64 {
    use std::sync::OnceLock;
    static COLUMNS: [OnceLock<f64>; StandardAtmosphere::ALL.len()] = [const { OnceLock::new() }; StandardAtmosphere::ALL.len()];
    *COLUMNS[atmosphere as usize].get_or_init(|| atmosphere.column_per_m2())
}

/// The optical profile of `air` at `wavelengths_nm`.
pub(super) fn optical_profile(air: &Air, wavelengths_nm: &[f64]) -> Result<OpticalProfile> {
    for &wavelength in wavelengths_nm {
        check_range("wavelengths_nm", wavelength, WAVELENGTH_RANGE_NM.0, WAVELENGTH_RANGE_NM.1, "nm")?;
    }
    let altitudes_km = altitudes_km();
    let mut components = vec![
        molecules_component(air, &altitudes_km, wavelengths_nm),
        ozone_component(air, &altitudes_km, wavelengths_nm),
        aerosol_component(air, &altitudes_km, wavelengths_nm),
    ];
    let volcanic = air.filled.stratospheric_aod550.unwrap_or(0.0);
    if volcanic > 0.0 {
        let altitude_km = air.filled.stratospheric_altitude_km.unwrap_or(20.0);
        components.push(stratospheric_component(volcanic, altitude_km, &altitudes_km, wavelengths_nm));
    }
    let profile = OpticalProfile {
        components,
        ground_albedo: air.ground.albedo(wavelengths_nm),
        solar_irradiance: solar::band_means(wavelengths_nm),
        altitudes_km,
        wavelengths_nm: wavelengths_nm.to_vec(),
        planet_radius_km: EARTH_RADIUS_KM,
        sun_angular_radius_deg: SUN_ANGULAR_RADIUS_DEG,
    };
    profile.validate()?;
    Ok(profile)
}

fn molecules_component(air: &Air, altitudes_km: &[f64], wavelengths_nm: &[f64]) -> Component {
    let model = air.standard_atmosphere;
    let pressure_ratio = air.surface_pressure_hpa * 100.0 / model.pressure_pa(0.0);
    let column = air_column_per_m2(model) * pressure_ratio;
    let shape = unit_column(altitudes_km, |z| model.number_density_per_m3(z));
    let depths: Vec<f64> = wavelengths_nm.iter().map(|&w| molecules::cross_section_m2(w) * column).collect();
    Component {
        name: "molecules".into(),
        scattering_per_km: outer_product(&shape, &depths),
        absorption_per_km: vec![0.0; shape.len() * depths.len()],
        phase: Some(Phase::Rayleigh { depolarisation: wavelengths_nm.iter().map(|&w| molecules::depolarisation(w)).collect() }),
    }
}

fn ozone_component(air: &Air, altitudes_km: &[f64], wavelengths_nm: &[f64]) -> Component {
    let shape = unit_column(altitudes_km, |z| air.standard_atmosphere.ozone_per_m3(z));
    let depths = ozone::optical_depth(wavelengths_nm, air.filled.ozone_du.unwrap_or(300.0));
    Component {
        name: "ozone".into(),
        scattering_per_km: vec![0.0; shape.len() * depths.len()],
        absorption_per_km: outer_product(&shape, &depths),
        phase: None,
    }
}

fn aerosol_component(air: &Air, altitudes_km: &[f64], wavelengths_nm: &[f64]) -> Component {
    let shape = unit_column(altitudes_km, |z| air.aerosol.relative_density(z, air.aerosol_scale_height_km));
    let spectrum = air.aerosol.spectrum(air.relative_humidity);
    let (scattering, absorption) = depths(wavelengths_nm, |wavelength| {
        let AerosolOptics { relative_extinction, single_scattering_albedo, .. } = spectrum.at(wavelength);
        let relative = air.filled.angstrom_exponent.map_or(relative_extinction, |exponent| angstrom(wavelength, exponent));
        (air.aod550 * relative, air.filled.single_scattering_albedo.unwrap_or(single_scattering_albedo))
    });
    let phase = match air.phase_function {
        PhaseFunction::Mie => {
            let mixture = Mixture::new(air.aerosol.particles(), air.relative_humidity);
            Phase::Tabulated(Arc::new(mixture.phase_table(wavelengths_nm)))
        }
        PhaseFunction::HenyeyGreenstein => Phase::HenyeyGreenstein { asymmetry: air.asymmetry },
        PhaseFunction::CornetteShanks => Phase::cornette_shanks_of_asymmetry(air.asymmetry),
    };
    Component {
        name: "aerosol".into(),
        scattering_per_km: outer_product(&shape, &scattering),
        absorption_per_km: outer_product(&shape, &absorption),
        phase: Some(phase),
    }
}

fn stratospheric_component(aod550: f64, altitude_km: f64, altitudes_km: &[f64], wavelengths_nm: &[f64]) -> Component {
    let shape = unit_column(altitudes_km, |z| (-0.5 * ((z - altitude_km) / STRATOSPHERIC_WIDTH_KM).powi(2)).exp());
    let droplets = Mixture::new(&[(Particle::VolcanicSulphate, 1.0)], 0.0);
    let spectrum = AerosolSpectrum::new(&droplets);
    let (scattering, absorption) = depths(wavelengths_nm, |wavelength| {
        let optics = spectrum.at(wavelength);
        (aod550 * optics.relative_extinction, optics.single_scattering_albedo)
    });
    Component {
        name: "stratospheric_aerosol".into(),
        scattering_per_km: outer_product(&shape, &scattering),
        absorption_per_km: outer_product(&shape, &absorption),
        phase: Some(Phase::Tabulated(Arc::new(droplets.phase_table(wavelengths_nm)))),
    }
}

/// Optical depths of scattering and absorption from `optics`: optical depth of extinction and single scattering albedo by wavelength.
fn depths(wavelengths_nm: &[f64], optics: impl Fn(f64) -> (f64, f64)) -> (Vec<f64>, Vec<f64>) {
    let split = |&wavelength: &f64| {
        let (extinction, albedo) = optics(wavelength);
        (extinction * albedo, extinction * (1.0 - albedo))
    };
    wavelengths_nm.iter().map(split).unzip()
}

/// `density` at the altitudes, scaled so that its integral, linear between altitudes, is 1 [km-1].
fn unit_column(altitudes_km: &[f64], density: impl Fn(f64) -> f64) -> Vec<f64> {
    let values: Vec<f64> = altitudes_km.iter().map(|&z| density(z)).collect();
    let column: f64 = altitudes_km.windows(2).zip(values.windows(2)).map(|(z, v)| 0.5 * (z[1] - z[0]) * (v[0] + v[1])).sum();
    values.into_iter().map(|value| value / column).collect()
}

fn outer_product(rows: &[f64], columns: &[f64]) -> Vec<f64> {
    rows.iter().flat_map(|row| columns.iter().map(move |column| row * column)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::AirParameters;
    use crate::spectrum::wavelengths;

    /// Vertical optical depth of a coefficient at wavelength index `k`.
    fn depth(profile: &OpticalProfile, coefficients: &[f64], k: usize) -> f64 {
        let (z, count) = (&profile.altitudes_km, profile.wavelengths_nm.len());
        (1..z.len()).map(|i| 0.5 * (z[i] - z[i - 1]) * (coefficients[(i - 1) * count + k] + coefficients[i * count + k])).sum()
    }

    #[test]
    fn columns_are_those_asked_for() {
        let parameters: AirParameters =
            serde_json::from_str(r#"{"aod550": 0.37, "aerosol": "desert", "ozone_du": 420, "surface_pressure_hpa": 850}"#)
                .unwrap();
        let profile = parameters.optical_profile(&[400.0, 550.0, 600.0, 700.0]).unwrap();
        let [molecules, ozone, aerosol] = &profile.components[..] else { panic!("three components") };
        assert_eq!([&molecules.name, &ozone.name, &aerosol.name], ["molecules", "ozone", "aerosol"]);
        for (k, wavelength) in profile.wavelengths_nm.iter().enumerate() {
            let expected = molecules::sea_level_optical_depth(*wavelength) * 850.0 / 1013.25;
            assert!((depth(&profile, &molecules.scattering_per_km, k) / expected - 1.0).abs() < 1e-9);
        }
        let aerosol_depth = depth(&profile, &aerosol.scattering_per_km, 1) + depth(&profile, &aerosol.absorption_per_km, 1);
        assert!((aerosol_depth - 0.37).abs() < 1e-4);
        assert!((depth(&profile, &aerosol.scattering_per_km, 1) / aerosol_depth - 0.888).abs() < 0.003);
        let expected = ozone::optical_depth(&profile.wavelengths_nm, 420.0)[2];
        assert!((depth(&profile, &ozone.absorption_per_km, 2) / expected - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_ground_has_the_density_of_the_model() {
        // The scaling to the exact column must not move the coefficients noticeably.
        let profile = AirParameters::default().optical_profile(&[550.0]).unwrap();
        let expected = molecules::cross_section_m2(550.0) * 2.5469e25 * 1000.0;
        assert!((profile.components[0].scattering_per_km[0] / expected - 1.0).abs() < 1e-3);
    }

    #[test]
    fn overrides_replace_the_numbers_of_the_type() {
        let json = r#"{"preset": "urban", "angstrom_exponent": 2, "single_scattering_albedo": 0.5, "asymmetry": 0.1,
            "aerosol_scale_height_km": 4}"#;
        let profile = serde_json::from_str::<AirParameters>(json).unwrap().optical_profile(&[275.0 * 2.0, 778.0]).unwrap();
        let aerosol = &profile.components[2];
        let scattering: Vec<f64> = (0..2).map(|k| depth(&profile, &aerosol.scattering_per_km, k)).collect();
        assert!((scattering[0] / scattering[1] - (778.0_f64 / 550.0).powi(2)).abs() < 1e-9);
        assert!((scattering[0] - 0.2).abs() < 1e-9);
        assert_eq!(aerosol.phase, Some(Phase::HenyeyGreenstein { asymmetry: 0.1 }));
        let at_4_km = profile.altitudes_km.iter().position(|&z| (z - 4.0).abs() < 1e-9).unwrap();
        let ratio = aerosol.scattering_per_km[at_4_km * 2] / aerosol.scattering_per_km[0];
        assert!((ratio - (-1.0_f64).exp()).abs() < 1e-9);
    }

    #[test]
    fn the_aerosol_scatters_as_its_particles_do() {
        let wavelengths = wavelengths(32);
        let profile = AirParameters::default().optical_profile(&wavelengths).unwrap();
        let aerosol = &profile.components[2];
        let Some(Phase::Tabulated(table)) = &aerosol.phase else { panic!("Mie theory") };
        assert_eq!(table.wavelengths(), 32);
        let spectrum = crate::atmosphere::AerosolType::ContinentalClean.spectrum(80.0);
        for (k, &wavelength) in wavelengths.iter().enumerate() {
            assert!((table.legendre_moment(1, k) - spectrum.at(wavelength).asymmetry).abs() < 1e-3);
        }
        let henyey = AirParameters { asymmetry: Some(0.7), ..AirParameters::default() }.optical_profile(&wavelengths).unwrap();
        assert_eq!(henyey.components[2].scattering_per_km, aerosol.scattering_per_km);
    }

    #[test]
    fn fog_is_as_thick_at_the_ground_as_its_visibility_says_and_has_a_top() {
        let parameters: AirParameters = serde_json::from_str(r#"{"preset": "fog", "visibility_km": 0.1}"#).unwrap();
        let profile = parameters.optical_profile(&[550.0]).unwrap();
        let fog = &profile.components[2].scattering_per_km;
        let extinction = fog[0] + profile.components[0].scattering_per_km[0];
        assert!((extinction / 39.12 - 1.0).abs() < 2e-3, "{extinction}");
        let at = |altitude: f64| profile.altitudes_km.iter().position(|z| (z - altitude).abs() < 1e-9).unwrap();
        assert!(fog[at(0.1)] > 0.98 * fog[0] && fog[at(0.5)] < 0.01 * fog[0]);
    }

    #[test]
    fn the_stratospheric_aerosol_lies_where_it_was_put() {
        let parameters: AirParameters =
            serde_json::from_str(r#"{"preset": "volcanic", "stratospheric_aod550": 0.2, "stratospheric_altitude_km": 24}"#)
                .unwrap();
        let profile = parameters.optical_profile(&[450.0, 550.0, 700.0]).unwrap();
        let layer = &profile.components[3];
        assert_eq!(layer.name, "stratospheric_aerosol");
        assert!((depth(&profile, &layer.scattering_per_km, 1) - 0.2).abs() < 1e-4);
        let highest = (0..profile.altitudes_km.len())
            .max_by(|&a, &b| layer.scattering_per_km[a * 3].total_cmp(&layer.scattering_per_km[b * 3]))
            .unwrap();
        assert!((profile.altitudes_km[highest] - 24.0).abs() < 1.1);
        // Droplets of half a micrometre scatter yellow and red light nearly as well as blue: the skies are milky.
        let ratio = depth(&profile, &layer.scattering_per_km, 2) / depth(&profile, &layer.scattering_per_km, 0);
        assert!((0.7..1.1).contains(&ratio), "{ratio}");
    }

    #[test]
    fn every_preset_gives_a_valid_profile() {
        for preset in crate::atmosphere::Preset::ALL {
            let profile = AirParameters { preset, ..AirParameters::default() }.optical_profile(&wavelengths(16)).unwrap();
            assert_eq!((profile.altitudes_km[0], *profile.altitudes_km.last().unwrap()), (0.0, TOP_KM));
            assert!(profile.altitudes_km.len() < 160);
        }
        let message = AirParameters::default().optical_profile(&[250.0, 500.0]).unwrap_err().to_string();
        assert!(message.starts_with("wavelengths_nm = 250: must be"), "{message}");
    }
}
