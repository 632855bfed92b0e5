//! The solver at quality `high` against the path tracer where it is hardest: polarised twilight down to the Sun at -12 degrees, and particles with sharp forward peaks.

use glam::DVec3;
use skyprobe::atmosphere::{AerosolType, AirParameters, OpticalProfile};
use skyprobe::light::{Guiding, LightField, Observer, PathTracer};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;

struct Case {
    sun_deg: f64,
    zenith_deg: f64,
    azimuth_deg: f64,
    wavelength: usize,
}

impl Case {
    fn view(&self) -> DVec3 {
        let ((sine, cosine), (across, along)) = (self.zenith_deg.to_radians().sin_cos(), self.azimuth_deg.to_radians().sin_cos());
        DVec3::new(sine * along, sine * across, cosine)
    }

    fn solved(&self, field: &LightField) -> f64 {
        let (view, sun_zenith) = (self.view(), (90.0 - self.sun_deg).to_radians());
        let gathered = field.gather(&Observer { altitude_km: 0.0, sun_zenith }, view.z, &[self.azimuth_deg.to_radians()]);
        let cosine = view.z * sun_zenith.cos() + view.x * sun_zenith.sin();
        field.radiance(&gathered, 0, self.wavelength, cosine)
    }
}

fn solve(profile: &OpticalProfile, polarised: bool) -> LightField {
    LightField::solve(profile, &Quality::High.numbers(), polarised, &Progress::silent()).unwrap()
}

#[test]
fn twilight_is_that_of_the_path_tracer() {
    let profile = AirParameters::default().optical_profile(&[450.0, 600.0]).unwrap();
    let field = solve(&profile, true);
    for wavelength in [0, 1] {
        let tracer = PathTracer::new(&profile, wavelength).unwrap().with_polarisation(true);
        // Sun, paths, largest standard error that still judges.
        for (sun_deg, paths, limit) in [(-6.0, 12_000, 0.01), (-8.0, 8_000, 0.02), (-12.0, 6_000, 0.05)] {
            for (zenith_deg, azimuth_deg) in [(0.0, 0.0), (60.0, 0.0), (60.0, 180.0), (85.0, 0.0), (85.0, 90.0)] {
                let case = Case { sun_deg, zenith_deg, azimuth_deg, wavelength };
                let solved = case.solved(&field);
                let traced = tracer.stokes(0.0, 90.0 - sun_deg, case.view(), paths, 7).unwrap()[0];
                let (error, noise) = (solved / traced.mean - 1.0, traced.standard_error / traced.mean);
                println!(
                    "{sun_deg} {zenith_deg} {azimuth_deg} {}: {solved:.3e}, {:+.2} %, standard error {:.2} %",
                    profile.wavelengths_nm[wavelength],
                    100.0 * error,
                    100.0 * noise
                );
                assert!(noise <= limit, "too noisy to judge: {noise}");
                // The solver's own error is below half a per cent (examples/convergence.rs).
                assert!(error.abs() <= 3.0 * noise + 0.005, "{sun_deg} {zenith_deg} {azimuth_deg}: {error}");
            }
        }
    }
}

/// Two quadratures of the same integral, which no noise hides: the edge of the planet's shadow lies across the ray.
#[test]
fn light_scattered_once_in_twilight_is_that_of_a_finer_quadrature() {
    let mut profile = AirParameters::default().optical_profile(&[450.0, 600.0]).unwrap();
    profile.components.retain(|component| component.name != "aerosol");
    let field = solve(&profile, false);
    for sun_deg in [5.0, 0.5, -2.0, -4.0, -6.0, -8.0, -12.0] {
        for (zenith_deg, azimuth_deg) in [(0.0, 0.0), (40.0, 90.0), (60.0, 0.0), (60.0, 180.0), (85.0, 0.0), (89.0, 120.0)] {
            for wavelength in [0, 1] {
                let case = Case { sun_deg, zenith_deg, azimuth_deg, wavelength };
                let view = case.view();
                let observer = Observer { altitude_km: 0.0, sun_zenith: (90.0 - sun_deg).to_radians() };
                let rest = field.gather(&observer, view.z, &[azimuth_deg.to_radians()]).rest(0, 0)[wavelength];
                let all = case.solved(&field);
                let tracer = PathTracer::new(&profile, wavelength).unwrap();
                let once = tracer.single_scattering(0.0, 90.0 - sun_deg, view).unwrap();
                let error = (all - f64::from(rest) - once) / all;
                assert!(error.abs() <= 0.003, "{sun_deg} {zenith_deg} {azimuth_deg} {wavelength}: {error}");
            }
        }
    }
}

#[test]
fn sharp_particles_are_those_of_the_path_tracer() {
    for (aerosol, own) in [(AerosolType::Desert, 0.01), (AerosolType::Fog, 0.01)] {
        let air = AirParameters { aerosol: Some(aerosol), aod550: Some(0.5), ..Default::default() };
        let profile = air.optical_profile(&[550.0]).unwrap();
        let field = solve(&profile, false);
        let tracer = PathTracer::new(&profile, 0).unwrap().with_guiding(Guiding::Automatic);
        // The path tracer has too much noise behind a fog.
        let farthest = if aerosol == AerosolType::Fog { 100.0 } else { 180.0 };
        for azimuth_deg in [1.8, 4.0, 12.0, 40.0, 100.0, 180.0].into_iter().filter(|a| *a <= farthest) {
            let case = Case { sun_deg: 30.0, zenith_deg: 60.0, azimuth_deg, wavelength: 0 };
            let solved = case.solved(&field);
            let traced = tracer.radiance(0.0, 60.0, case.view(), 30_000, 11).unwrap();
            let (error, noise) = (solved / traced.mean - 1.0, traced.standard_error / traced.mean);
            println!(
                "{aerosol:?} azimuth {azimuth_deg}: {solved:.4e}, {:+.2} %, standard error {:.2} %",
                100.0 * error,
                100.0 * noise
            );
            assert!(noise <= 0.03 && error.abs() <= 3.0 * noise + own, "{aerosol:?} {azimuth_deg}: {error} {noise}");
        }
    }
}
