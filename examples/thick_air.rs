//! How well the light of thick air is found: diffuse irradiance of the ground against the path tracer, and the error that the solver itself expects.
use skyprobe::atmosphere::{AirParameters, Component, OpticalProfile, Phase};
use skyprobe::light::{LightField, gauss};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;

fn main() -> skyprobe::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let quality: Quality = arguments.next().unwrap_or("draft".into()).parse()?;
    let kinds = arguments.next().unwrap_or("fog,clear,desert,urban".into());
    let depths = arguments.next().unwrap_or("1,2,3,4,6,8,10,12,15,18,25,50".into());
    let extra = arguments.next().unwrap_or_default();
    let dump = std::env::var_os("DUMP").is_some();
    let wavelengths = skyprobe::spectrum::wavelengths(quality.numbers().wavelengths);
    for kind in kinds.split(',') {
        for depth in depths.split(',') {
            let profile = if kind == "slab" {
                let mut parts = extra.split('/');
                let g: f64 = parts.next().unwrap_or("").parse().unwrap_or(0.0);
                let albedo: f64 = parts.next().unwrap_or("").parse().unwrap_or(0.0);
                let d: f64 = depth.parse().unwrap();
                let phase = if g == 0.0 {
                    Phase::Rayleigh { depolarisation: vec![0.0] }
                } else {
                    Phase::HenyeyGreenstein { asymmetry: g }
                };
                OpticalProfile {
                    altitudes_km: vec![0.0, 10.0],
                    wavelengths_nm: vec![550.0],
                    components: vec![Component {
                        name: "slab".into(),
                        scattering_per_km: vec![d / 10.0; 2],
                        absorption_per_km: vec![0.0; 2],
                        phase: Some(phase),
                    }],
                    ground_albedo: vec![albedo],
                    solar_irradiance: vec![1.0],
                    planet_radius_km: 6371.0,
                    sun_angular_radius_deg: 0.2664,
                }
            } else {
                let air: AirParameters =
                    serde_json::from_str(&format!(r#"{{"preset": "{kind}", "aod550": {depth}{extra}}}"#)).unwrap();
                air.optical_profile(&wavelengths)?
            };
            let k = profile.wavelengths_nm.iter().position(|&w| w > 549.0).unwrap();
            let count = profile.wavelengths_nm.len();
            let start = std::time::Instant::now();
            let field = match LightField::solve(&profile, &quality.numbers(), false, &Progress::silent()) {
                Ok(field) => field,
                Err(error) => {
                    println!("{kind:8} {depth:>5}  {:5.1} s  {error}", start.elapsed().as_secs_f64());
                    continue;
                }
            };
            let seconds = start.elapsed().as_secs_f64();
            let cosines: Vec<f64> = gauss::legendre(16).iter().map(|n| n.0).collect();
            let solved: Vec<f64> = cosines.iter().map(|mu| field.ground_irradiance(mu.acos())[k]).collect();
            let all = field.errors_on_the_ground();
            let worst = all.iter().fold(0.0_f64, |a, b| if b.abs() > a.abs() || b.is_nan() { *b } else { a });
            if dump {
                let column = |values: &[f64]| -> Vec<f64> { values.iter().skip(k).step_by(count).copied().collect() };
                let components: Vec<_> = profile.components.iter().map(|c| serde_json::json!({"s": column(&c.scattering_per_km), "a": column(&c.absorption_per_km), "m": c.phase.as_ref().map(|p| p.legendre_moments(40, k))})).collect();
                println!(
                    "{}",
                    serde_json::json!({"kind": kind, "depth": depth, "z": profile.altitudes_km, "components": components, "albedo": profile.ground_albedo[k], "cosines": cosines, "solved": solved, "expected": all[k], "worst": worst, "seconds": seconds})
                );
            } else {
                println!(
                    "{kind:8} {depth:>5}  {seconds:5.1} s   overhead {:.4e}, expected {:+.1} %, worst {:+.1} %",
                    solved[15],
                    100.0 * all[k],
                    100.0 * worst
                );
            }
        }
    }
    Ok(())
}
