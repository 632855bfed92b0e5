//! How far the solver is from its own limit: a quality level against the same with every grid doubled, against air that reaches 20 km higher, and against `reference`, which
//! has more orders of the harmonics besides, by the Sun's altitude.
//!
//! ```text
//! cargo run --release --example convergence -- high
//! ```
//!
//! Prints the root mean square and the largest relative difference of radiance over 21 directions and 8 wavelengths. The doubled run takes some thirty times longer.

use skyprobe::atmosphere::{AirParameters, OpticalProfile};
use skyprobe::light::{LightField, Observer};
use skyprobe::progress::Progress;
use skyprobe::quality::{Numbers, Quality};
use std::time::Instant;

const SUNS_DEG: [f64; 10] = [60.0, 20.0, 5.0, 0.0, -4.0, -6.0, -8.0, -10.0, -14.0, -18.0];
const VIEW_ZENITHS_DEG: [f64; 6] = [0.0, 30.0, 60.0, 75.0, 85.0, 89.0];
const AZIMUTHS_DEG: [f64; 4] = [0.0, 60.0, 120.0, 180.0];

/// Every grid twice as fine.
fn doubled(numbers: &Numbers) -> Numbers {
    Numbers {
        altitudes: 2 * numbers.altitudes,
        solar_zenith_angles: 2 * numbers.solar_zenith_angles,
        iteration_altitudes: 2 * numbers.iteration_altitudes,
        iteration_solar_zenith_angles: 2 * numbers.iteration_solar_zenith_angles,
        shells: 2 * numbers.shells,
        iteration_zenith_nodes: numbers.iteration_zenith_nodes.map(|n| 2 * n),
        zenith_nodes: numbers.zenith_nodes.map(|n| 2 * n),
        azimuth_nodes: numbers.azimuth_nodes.map(|n| 2 * n),
        step_km: 0.5 * numbers.step_km,
        convergence: 0.1 * numbers.convergence,
        ..*numbers
    }
}

/// The same air with molecules that continue 20 km beyond its top as they ended.
fn raised(profile: &OpticalProfile) -> OpticalProfile {
    let mut raised = profile.clone();
    let (levels, count) = (profile.altitudes_km.len(), profile.wavelengths_nm.len());
    let top = profile.altitudes_km[levels - 1];
    let step = top - profile.altitudes_km[levels - 2];
    for extra in 1..=10 {
        raised.altitudes_km.push(top + 2.0 * f64::from(extra));
        for (component, original) in raised.components.iter_mut().zip(&profile.components) {
            for (values, known) in [
                (&mut component.scattering_per_km, &original.scattering_per_km),
                (&mut component.absorption_per_km, &original.absorption_per_km),
            ] {
                for w in 0..count {
                    let (below, last) = (known[(levels - 2) * count + w], known[(levels - 1) * count + w]);
                    let ratio = if below > 0.0 && last > 0.0 { last / below } else { 0.0 };
                    values.push(last * ratio.powf(2.0 * f64::from(extra) / step));
                }
            }
        }
    }
    raised
}

fn solve(profile: &OpticalProfile, numbers: &Numbers) -> skyprobe::Result<LightField> {
    let start = Instant::now();
    let field = LightField::solve(profile, numbers, true, &Progress::silent())?;
    eprintln!("solved in {:.1} s", start.elapsed().as_secs_f64());
    Ok(field)
}

/// Radiance by direction and wavelength.
fn radiances(field: &LightField, sun_deg: f64, wavelengths: usize) -> Vec<f64> {
    let sun_zenith = (90.0 - sun_deg).to_radians();
    let observer = Observer { altitude_km: 0.0, sun_zenith };
    let mut out = Vec::new();
    for zenith in VIEW_ZENITHS_DEG {
        let (sine, mu) = zenith.to_radians().sin_cos();
        for azimuth in AZIMUTHS_DEG.map(f64::to_radians).into_iter().take(if zenith == 0.0 { 1 } else { AZIMUTHS_DEG.len() }) {
            let gathered = field.gather(&observer, mu, &[azimuth]);
            let cosine = mu * sun_zenith.cos() + sine * sun_zenith.sin() * azimuth.cos();
            out.extend((0..wavelengths).map(|w| field.radiance(&gathered, 0, w, cosine)));
        }
    }
    out
}

fn main() -> skyprobe::Result<()> {
    let quality: Quality = std::env::args().nth(1).as_deref().unwrap_or("high").parse()?;
    let wavelengths: Vec<f64> = (0..8).map(|i| 400.0 + 40.0 * f64::from(i)).collect();
    let profile = AirParameters::default().optical_profile(&wavelengths)?;
    let numbers = quality.numbers();
    let own = solve(&profile, &numbers)?;
    let others = [
        ("every grid doubled", solve(&profile, &doubled(&numbers))?),
        ("20 km more air", solve(&raised(&profile), &numbers)?),
        ("quality reference", solve(&profile, &Quality::Reference.numbers())?),
    ];
    for (name, other) in others {
        println!("{name}: Sun altitude, rms and largest difference in per cent");
        for sun in SUNS_DEG {
            let pairs = radiances(&own, sun, wavelengths.len()).into_iter().zip(radiances(&other, sun, wavelengths.len()));
            let errors: Vec<f64> = pairs.map(|(a, b)| 100.0 * (a / b - 1.0)).collect();
            let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
            let largest = errors.iter().fold(0.0_f64, |a, &b| if b.abs() > a.abs() { b } else { a });
            println!("{sun:6.1} {rms:8.2} {largest:+8.2}");
        }
    }
    Ok(())
}
