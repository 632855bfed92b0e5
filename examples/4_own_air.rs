//! 4. An air of your own, given in full: a thin layer of dust over molecules that scatter as 1 / wavelength^4, around a planet as large as Mars.
//!
//!     cargo run --release --example 4_own_air -- mars.exr

use skyprobe::prelude::*;
use std::sync::Arc;

fn main() -> Result<()> {
    write(&std::env::args().nth(1).unwrap_or_else(|| "own_air.exr".to_owned()))
}

pub fn write(file: &str) -> Result<()> {
    let altitudes_km: Vec<f64> = (0..=30).map(|i| f64::from(i) * 3.0).collect();
    let wavelengths_nm: Vec<f64> = (0..=6).map(|i| 400.0 + 50.0 * f64::from(i)).collect();
    // Coefficients [1/km] by altitude and wavelength, row by row.
    let table = |ground: f64, scale_height_km: f64, exponent: f64| -> Vec<f64> {
        let rows = altitudes_km.iter().map(|z| ground * (-z / scale_height_km).exp());
        rows.flat_map(|beta| wavelengths_nm.iter().map(move |w| beta * (w / 550.0).powf(exponent))).collect()
    };
    let part = |name: &str, scattering: Vec<f64>, absorption: Vec<f64>, phase: Phase| Component {
        name: name.to_owned(),
        scattering_per_km: scattering,
        absorption_per_km: absorption,
        phase: Some(phase),
    };
    let nothing = vec![0.0; altitudes_km.len() * wavelengths_nm.len()];
    let gas = part("gas", table(2e-4, 11.0, -4.0), nothing, Phase::Rayleigh { depolarisation: vec![0.0] });
    let dust = part("dust", table(0.04, 11.0, 1.0), table(0.004, 11.0, -3.0), Phase::HenyeyGreenstein { asymmetry: 0.7 });
    let profile = OpticalProfile {
        ground_albedo: wavelengths_nm.iter().map(|w| 0.05 + 0.0008 * (w - 400.0)).collect(),
        solar_irradiance: vec![0.8; wavelengths_nm.len()],
        components: vec![gas, dust],
        altitudes_km,
        wavelengths_nm,
        planet_radius_km: 3390.0,
        sun_angular_radius_deg: 0.175,
    };
    let air = Arc::new(Atmosphere::from_profile(profile, Quality::Draft, false)?);
    let sky = Sky::with_sun(25.0, 200.0, 0.0, air)?;
    let settings = ProbeSettings { width: 512, ..Default::default() };
    let probe = render(&sky.light_by(&LightOptions::default(), &Progress::silent())?, &settings, &Progress::silent())?;
    save(file, &probe, &FileOptions::default(), &describe(&sky, SunModel::Iau, &LightOptions::default(), &settings))
}
