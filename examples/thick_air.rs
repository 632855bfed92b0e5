//! How well the light of thick air is found: the irradiance of the ground, and its error as the solver expects it from the energy that it loses.
//!
//! ```text
//! cargo run --release --example thick_air -- draft fog,clear,desert 2,5,8,12
//! cargo run --release --example thick_air -- --json draft slab,white_slab 1,2,5 | python docs/validation/thick_air.py
//! ```
//!
//! Quality, presets and optical depths of the aerosol at 550 nm; `slab` is a homogeneous layer of 10 km of molecules that do not absorb, over a black ground, `white_slab` over a white one.
//! With `--json` one line an air, with its profile at 550 nm, for `docs/validation/thick_air.py`, which computes the same by adding and doubling. `--polarised` solves with polarisation.

use skyprobe::atmosphere::{AirParameters, Component, OpticalProfile, Phase};
use skyprobe::light::LightField;
use skyprobe::numerics::gauss;
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use std::time::Instant;

fn slab(optical_depth: f64, ground_albedo: f64) -> OpticalProfile {
    OpticalProfile {
        altitudes_km: vec![0.0, 10.0],
        wavelengths_nm: vec![550.0],
        components: vec![Component {
            name: "slab".into(),
            scattering_per_km: vec![optical_depth / 10.0; 2],
            absorption_per_km: vec![0.0; 2],
            phase: Some(Phase::Rayleigh { depolarisation: vec![0.0] }),
        }],
        ground_albedo: vec![ground_albedo],
        solar_irradiance: vec![1.0],
        planet_radius_km: 6371.0,
        sun_angular_radius_deg: 0.2664,
    }
}

fn main() -> skyprobe::Result<()> {
    let (flags, words): (Vec<String>, Vec<String>) = std::env::args().skip(1).partition(|word| word.starts_with("--"));
    let has = |name: &str| flags.iter().any(|flag| flag == name);
    let word = |k: usize, default: &str| words.get(k).map_or(default, String::as_str).to_string();
    let quality: Quality = word(0, "draft").parse()?;
    let wavelengths = skyprobe::spectrum::wavelengths(quality.numbers().wavelengths);
    let cosines: Vec<f64> = gauss::legendre(16).iter().map(|node| node.0).collect();
    for kind in word(1, "fog,clear,desert,urban").split(',') {
        for depth in word(2, "1,2,3,5,8,12,15,18,25,50").split(',') {
            let aod550: f64 = depth.parse().expect("an optical depth");
            let profile = match kind {
                "slab" => slab(aod550, 0.0),
                "white_slab" => slab(aod550, 1.0),
                _ => AirParameters { preset: kind.parse()?, aod550: Some(aod550), ..Default::default() }
                    .optical_profile(&wavelengths)?,
            };
            let start = Instant::now();
            let solved = LightField::solve(&profile, &quality.numbers(), has("--polarised"), &Progress::silent());
            let seconds = start.elapsed().as_secs_f64();
            let field = match solved {
                Ok(field) => field,
                Err(error) if has("--json") => {
                    println!("{}", serde_json::json!({"kind": kind, "aod550": aod550, "error": error.to_string()}));
                    continue;
                }
                Err(error) => {
                    println!("{kind:10} {aod550:4}  {seconds:5.1} s  {error}");
                    continue;
                }
            };
            let (k, count) = (profile.wavelengths_nm.iter().position(|&w| w > 549.0).unwrap_or(0), profile.wavelengths_nm.len());
            let solved: Vec<f64> = cosines.iter().map(|mu| field.ground_irradiance(mu.acos())[k]).collect();
            let worst = field.errors_on_the_ground().into_iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
            if !has("--json") {
                let (high, expected) = (solved[11], 100.0 * worst);
                println!(
                    "{kind:10} {aod550:4}  {seconds:5.1} s  {high:.4} at Sun cosine 0.81, error {expected:+.1} % in the worst wavelength"
                );
                continue;
            }
            let column = |values: &[f64]| values.iter().skip(k).step_by(count).copied().collect::<Vec<f64>>();
            let components = profile.components.iter().map(|component| {
                serde_json::json!({
                    "scattering_per_km": column(&component.scattering_per_km),
                    "absorption_per_km": column(&component.absorption_per_km),
                    "moments": component.phase.as_ref().map(|phase| phase.legendre_moments(40, k)),
                })
            });
            let components: Vec<_> = components.collect();
            println!(
                "{}",
                serde_json::json!({
                    "kind": kind, "aod550": aod550, "altitudes_km": profile.altitudes_km, "components": components,
                    "ground_albedo": profile.ground_albedo[k], "solved": solved, "worst": worst,
                })
            );
        }
    }
    Ok(())
}
