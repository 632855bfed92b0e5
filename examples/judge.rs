//! The solver against the path tracer in the same air, direction by direction.
//!
//! ```text
//! cargo run --release --example judge -- --sun -12 --view 60 --azimuth 0 --wavelength 550 --paths 100000
//! ```
//!
//! Each option takes one number or several with commas between; all combinations are computed. Others: `--altitude` (observer, km), `--aod`, `--aerosol`, `--asymmetry`, `--quality`, `--seed`,
//! `--only` (names of components to keep, such as `molecules,ozone`), `--albedo` (of the ground), `--sun-radius` (degrees; 0 is a point), `--polarised` (the path tracer then follows polarisation and prints Q/I and U/I too), `--plain` (paths without a guide), `--guided` (with it by day too), `--batches N` (repeats each
//! estimate with N seeds and prints the scatter of the means over the standard error, which is 1 where the standard error tells the truth).
//!
//! Any number of the quality can be replaced: `--altitudes`, `--solar-zenith-angles`, `--iteration-altitudes`, `--iteration-solar-zenith-angles`, `--shells`, `--step` (km), `--rising`, `--limb`,
//! `--ground` and `--azimuths` (directions of the last applications), `--order`, `--azimuthal-order`, `--applications`. With `--paths 2` only the solver and single scattering are worth reading.
//!
//! In pure air what is scattered once and the rest are compared apart too: columns `once` (quadrature against quadrature) and `rest` (with its standard error).

use glam::DVec3;
use skyprobe::atmosphere::{AirParameters, Phase};
use skyprobe::light::{Guiding, LightField, Observer, PathTracer};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use std::collections::HashMap;
use std::time::Instant;

/// The options that were given, and their defaults.
struct Options(HashMap<String, String>);

impl Options {
    fn parse() -> Self {
        let mut given = HashMap::new();
        let mut arguments = std::env::args().skip(1);
        while let Some(name) = arguments.next() {
            let name = name.trim_start_matches("--").to_string();
            let flag = matches!(name.as_str(), "polarised" | "plain" | "guided");
            let value = if flag { String::from("1") } else { arguments.next().unwrap_or_default() };
            given.insert(name, value);
        }
        Self(given)
    }

    fn numbers(&self, name: &str, default: &str) -> Vec<f64> {
        let text = self.0.get(name).map_or(default, String::as_str);
        text.split(',').map(|value| value.parse().unwrap_or_else(|_| panic!("--{name} {text}: not numbers"))).collect()
    }

    fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }
}

/// The solver's radiance for a solar irradiance of 1 \[sr-1\] at wavelength index `wavelength`, and what of it is not single scattering.
fn solved(field: &LightField, wavelength: usize, altitude_km: f64, sun_deg: f64, view: DVec3) -> [f64; 2] {
    let sun = sun_deg.to_radians();
    let gathered = field.gather(&Observer { altitude_km, sun_zenith: sun }, view.z, &[view.y.atan2(view.x)]);
    let cosine = view.z * sun.cos() + view.x * sun.sin();
    [field.radiance(&gathered, 0, wavelength, cosine), f64::from(gathered.rest(0, 0)[wavelength])]
}

fn main() -> skyprobe::Result<()> {
    let options = Options::parse();
    let wavelengths = options.numbers("wavelength", "550");
    let paths = options.numbers("paths", "100000")[0] as usize;
    let (altitude, seed) = (options.numbers("altitude", "0")[0], options.numbers("seed", "1")[0] as u64);
    let batches = options.numbers("batches", "1")[0].max(1.0) as u64;
    let given = |name: &str| options.has(name).then(|| options.numbers(name, "0")[0]);
    let aerosol = options.0.get("aerosol").map(|name| name.parse()).transpose()?;
    let air = AirParameters { aerosol, aod550: given("aod"), asymmetry: given("asymmetry"), ..AirParameters::default() };
    let quality: Quality = options.0.get("quality").map_or("high", String::as_str).parse()?;
    let mut profile = air.optical_profile(&wavelengths)?;
    if let Some(names) = options.0.get("only") {
        profile.components.retain(|component| names.split(',').any(|name| name == component.name));
    }
    if let Some(albedo) = given("albedo") {
        profile.ground_albedo.fill(albedo);
    }
    if let Some(radius) = given("sun-radius") {
        profile.sun_angular_radius_deg = radius;
    }
    let mut numbers = quality.numbers();
    let [rising, limb, ground] = &mut numbers.zenith_nodes;
    for (name, number) in [
        ("altitudes", &mut numbers.altitudes),
        ("solar-zenith-angles", &mut numbers.solar_zenith_angles),
        ("iteration-altitudes", &mut numbers.iteration_altitudes),
        ("iteration-solar-zenith-angles", &mut numbers.iteration_solar_zenith_angles),
        ("shells", &mut numbers.shells),
        ("rising", rising),
        ("limb", limb),
        ("ground", ground),
        ("azimuths", &mut numbers.azimuth_nodes[1]),
        ("order", &mut numbers.order),
        ("azimuthal-order", &mut numbers.azimuthal_order),
        ("applications", &mut numbers.full_applications),
    ] {
        *number = given(name).map_or(*number, |value| value as usize);
    }
    numbers.step_km = given("step").unwrap_or(numbers.step_km);
    let start = Instant::now();
    let field = LightField::solve(&profile, &numbers, options.has("polarised"), &Progress::silent())?;
    println!("solved in {:.2} s", start.elapsed().as_secs_f64());
    println!("   sun  view azimuth    nm   single/all  path tracer   +- %  largest %  seconds      solver      %  errors");
    for (index, wavelength) in wavelengths.iter().enumerate() {
        let guiding = match (options.has("plain"), options.has("guided")) {
            (true, _) => Guiding::Never,
            (_, true) => Guiding::Always,
            _ => Guiding::Automatic,
        };
        let tracer = PathTracer::new(&profile, index)?.with_polarisation(options.has("polarised")).with_guiding(guiding);
        for sun in options.numbers("sun", "-6") {
            for zenith in options.numbers("view", "0,60,85") {
                for azimuth in options.numbers("azimuth", "0,180") {
                    let (sine, cosine) = zenith.to_radians().sin_cos();
                    let (sine_azimuth, cosine_azimuth) = azimuth.to_radians().sin_cos();
                    let view = DVec3::new(sine * cosine_azimuth, sine * sine_azimuth, cosine);
                    let sun_zenith = 90.0 - sun;
                    let single = tracer.single_scattering(altitude, sun_zenith, view)?;
                    let start = Instant::now();
                    let runs: Vec<_> = (0..batches)
                        .map(|b| tracer.stokes(altitude, sun_zenith, view, paths, seed + b))
                        .collect::<Result<_, _>>()?;
                    let seconds = start.elapsed().as_secs_f64();
                    let n = batches as f64;
                    let mean = |i: usize| runs.iter().map(|run| run[i].mean).sum::<f64>() / n;
                    let error = (runs.iter().map(|run| run[0].standard_error.powi(2)).sum::<f64>()).sqrt() / n;
                    let largest = runs.iter().map(|run| run[0].largest_share).fold(0.0, f64::max);
                    let traced = mean(0);
                    let [solver, rest] = solved(&field, index, altitude, sun_zenith, view);
                    print!(
                        "{sun:6.1} {zenith:5.1} {azimuth:7.1} {wavelength:5.0} {:12.4} {traced:12.5e} {:6.2} {:10.2} {seconds:8.1} {solver:11.4e} {:+6.2} {:+7.2}",
                        single / traced,
                        100.0 * error / traced,
                        100.0 * largest,
                        100.0 * (solver / traced - 1.0),
                        (solver - traced) / error
                    );
                    if batches > 1 {
                        let chi2: f64 = runs.iter().map(|run| ((run[0].mean - traced) / run[0].standard_error).powi(2)).sum();
                        print!("  scatter {:.2}", (chi2 / (n - 1.0)).sqrt());
                    }
                    if profile.components.iter().all(|c| c.phase.as_ref().is_none_or(|p| matches!(p, Phase::Rayleigh { .. }))) {
                        let (once, multiple) = (100.0 * ((solver - rest) / single - 1.0), traced - single);
                        print!(
                            "  once {once:+.3} rest {rest:.5e} {:+.2} +- {:.2}",
                            100.0 * (rest / multiple - 1.0),
                            100.0 * error / multiple
                        );
                    }
                    if options.has("polarised") {
                        print!("  Q/I {:+.4} U/I {:+.4}", mean(1) / traced, mean(2) / traced);
                    }
                    println!();
                }
            }
        }
    }
    Ok(())
}
