//! Several airs of the reference tables solved at once, and their radiance row by row.

use super::{Row, reference_air_on};
use skyprobe::atmosphere::OpticalProfile;
use skyprobe::light::{LightField, Observer};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;

/// The columns of a table that say which air a row is in.
const AIR: [&str; 4] = ["tau_rayleigh", "tau_aerosol", "tau_ozone", "ground_albedo"];

/// Airs of the same make stand side by side as wavelengths of one profile, so that one solve serves them all.
pub struct Airs {
    keys: Vec<[u64; 4]>,
    /// The airs, in the order in which the rows first name them.
    pub profile: OpticalProfile,
    field: LightField,
}

impl Airs {
    /// Solves the airs that `rows` name, at quality `high`.
    pub fn solve(rows: &[Row], planet_radius_km: f64) -> Self {
        let mut keys: Vec<[u64; 4]> = Vec::new();
        for row in rows {
            let key = key(row);
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        let single: Vec<OpticalProfile> = keys
            .iter()
            .map(|key| {
                let [rayleigh, aerosol, ozone, albedo] = key.map(f64::from_bits);
                reference_air_on(planet_radius_km, rayleigh, aerosol, ozone, albedo)
            })
            .collect();
        let mut profile = single[0].clone();
        let count = single.len();
        profile.wavelengths_nm = (0..count).map(|i| 400.0 + i as f64).collect();
        profile.solar_irradiance = vec![1.0; count];
        profile.ground_albedo = single.iter().map(|p| p.ground_albedo[0]).collect();
        for (c, component) in profile.components.iter_mut().enumerate() {
            let levels = profile.altitudes_km.len();
            let side_by_side = |pick: &dyn Fn(&OpticalProfile) -> &Vec<f64>| {
                (0..levels).flat_map(|z| single.iter().map(move |p| pick(p)[z])).collect()
            };
            component.scattering_per_km = side_by_side(&|p| &p.components[c].scattering_per_km);
            component.absorption_per_km = side_by_side(&|p| &p.components[c].absorption_per_km);
        }
        profile.validate().unwrap();
        let start = std::time::Instant::now();
        let field = LightField::solve(&profile, &Quality::High.numbers(), false, &Progress::silent()).unwrap();
        println!("{count} airs solved in {:.1} s", start.elapsed().as_secs_f64());
        Self { keys, profile, field }
    }

    /// Radiance per unit solar irradiance for a row of a table.
    pub fn radiance(&self, row: &Row, altitude_km: f64) -> f64 {
        let air = self.keys.iter().position(|found| *found == key(row)).unwrap();
        let sun = row["sun_zenith_deg"].to_radians();
        let (sine, mu) = row["view_zenith_deg"].to_radians().sin_cos();
        let azimuth = row["relative_azimuth_deg"].to_radians();
        let gathered = self.field.gather(&Observer { altitude_km, sun_zenith: sun }, mu, &[azimuth]);
        let cosine = mu * sun.cos() + sine * sun.sin() * azimuth.cos();
        self.field.radiance(&gathered, 0, air, cosine)
    }
}

fn key(row: &Row) -> [u64; 4] {
    AIR.map(|name| row[name].to_bits())
}

/// Root mean square and largest of relative errors, printed.
pub fn summary(name: &str, errors: &[f64]) -> (f64, f64) {
    assert!(!errors.is_empty(), "{name}: no rows");
    let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
    let worst = errors.iter().fold(0.0, |a: f64, e| a.max(e.abs()));
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    println!(
        "{name}: {} rows, mean {:+.2} %, rms {:.2} %, worst {:.2} %",
        errors.len(),
        100.0 * mean,
        100.0 * rms,
        100.0 * worst
    );
    (rms, worst)
}
