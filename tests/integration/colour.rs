//! The colour of a sky from the few wavelengths of a quality level, against the same from 96.

use skyprobe::atmosphere::AirParameters;
use skyprobe::light::{LightField, Observer};
use skyprobe::progress::Progress;
use skyprobe::quality::{Numbers, Quality};
use skyprobe::spectrum::{solar, wavelengths, xyz_weights};

/// XYZ, by Sun altitude and direction, of the light solved at `count` wavelengths.
fn colours(numbers: &Numbers, count: usize) -> Vec<[f64; 3]> {
    let nodes = wavelengths(count);
    let profile = AirParameters::default().optical_profile(&nodes).unwrap();
    let field = LightField::solve(&profile, numbers, true, &Progress::silent()).unwrap();
    let weights = xyz_weights(&nodes, |wavelength| solar::irradiance(wavelength, 1.0));
    let mut out = Vec::new();
    for sun_deg in [60.0, 5.0, -4.0_f64] {
        let sun_zenith = (90.0 - sun_deg).to_radians();
        for (zenith_deg, azimuth_deg) in [(0.0, 0.0), (45.0, 90.0), (75.0, 180.0), (85.0, 20.0), (88.0, 120.0)] {
            let ((sine, mu), azimuth) = (f64::to_radians(zenith_deg).sin_cos(), f64::to_radians(azimuth_deg));
            let gathered = field.gather(&Observer { altitude_km: 0.0, sun_zenith }, mu, &[azimuth]);
            let cosine = mu * sun_zenith.cos() + sine * sun_zenith.sin() * azimuth.cos();
            let mut xyz = [0.0; 3];
            for (w, weight) in weights.iter().enumerate() {
                let radiance = field.radiance(&gathered, 0, w, cosine);
                xyz.iter_mut().zip(weight).for_each(|(sum, weight)| *sum += radiance * weight);
            }
            out.push(xyz);
        }
    }
    out
}

#[test]
fn few_wavelengths_give_the_colour_of_many() {
    for (quality, limit) in [(Quality::Standard, 0.005), (Quality::High, 0.002)] {
        let numbers = quality.numbers();
        // The grids are those of the draft in both: here only wavelengths are judged.
        let grids = Quality::Draft.numbers();
        let (few, many) = (colours(&grids, numbers.wavelengths), colours(&grids, 96));
        let mut worst = 0.0_f64;
        for (few, many) in few.iter().zip(&many) {
            for k in 0..3 {
                worst = worst.max((few[k] - many[k]).abs() / many[1].max(many[k]));
            }
        }
        println!("{quality:?}, {} wavelengths: worst {:.3} %", numbers.wavelengths, 100.0 * worst);
        assert!(worst < limit, "{quality:?}: {worst}");
    }
}
