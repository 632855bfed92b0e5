use super::*;
use crate::atmosphere::{Component, Phase};
use crate::numerics::gauss;
use crate::progress::Progress;
use crate::quality::Quality;
use crate::spectrum::{solar, wavelengths};

/// The same light everywhere, and more of it in the north by `tilt`.
struct Even {
    tilt: f64,
}

impl DiffuseLight<1> for Even {
    fn spectra(&self, wavelengths_nm: &[f64]) -> [Vec<f64>; 1] {
        [solar::band_means(wavelengths_nm)]
    }

    fn scalars(&self, direction: DVec3) -> [f64; 1] {
        [1.0 + self.tilt * direction.y]
    }
}

/// Air of optical depth `depth` that scatters the share `scattered` of what it takes away, on a planet so large that it is flat.
fn profile(depth: f64, scattered: f64, albedo: f64) -> OpticalProfile {
    let wavelengths_nm = wavelengths(8);
    let count = wavelengths_nm.len();
    let altitudes_km: Vec<f64> = (0..=40).map(|i| 2.5 * f64::from(i)).collect();
    let shape: Vec<f64> = altitudes_km.iter().map(|z| (-z / 8.0).exp()).collect();
    let column: f64 = shape.windows(2).map(|pair| 1.25 * (pair[0] + pair[1])).sum();
    let values = |share: f64| shape.iter().flat_map(|value| vec![share * depth * value / column; count]).collect::<Vec<f64>>();
    OpticalProfile {
        components: vec![Component {
            name: "air".into(),
            scattering_per_km: values(scattered),
            absorption_per_km: values(1.0 - scattered),
            phase: Some(Phase::Rayleigh { depolarisation: vec![0.0; count] }),
        }],
        altitudes_km,
        ground_albedo: vec![albedo; count],
        solar_irradiance: solar::band_means(&wavelengths_nm),
        wavelengths_nm,
        planet_radius_km: 6.371e6,
        sun_angular_radius_deg: 0.2666,
    }
}

fn sky(profile: &OpticalProfile, tilt: f64) -> DiffuseSky<Even, 1> {
    let field = LightField::solve(profile, &Quality::Draft.numbers(), false, &Progress::silent()).unwrap();
    let air = DiffuseAir::new(&field, profile, 0.0, 0.0);
    DiffuseSky::above(Even { tilt }, DMat3::IDENTITY, &air, &Sensor::xyz(&profile.wavelengths_nm))
}

/// Y towards an altitude and an azimuth [radians] over that outside the air.
fn seen(sky: &DiffuseSky<Even, 1>, altitude: f64, azimuth: f64) -> f64 {
    let mut out = [[0.0; 3]];
    sky.radiance_circle(altitude, &[azimuth], &mut out);
    f64::from(out[0][1]) / outside()
}

fn outside() -> f64 {
    let grid = wavelengths(8);
    let weights = Sensor::xyz(&grid).of(|wavelength| solar::irradiance(wavelength, solar::BAND_WIDTH_NM));
    weights.iter().map(|xyz| xyz[1]).sum()
}

/// Irradiance of the horizontal plane over pi.
fn horizontal(sky: &DiffuseSky<Even, 1>) -> f64 {
    gauss::legendre(24).into_iter().map(|(z, weight)| 2.0 * z * weight * seen(sky, z.asin(), 0.0)).sum()
}

#[test]
fn without_air_the_light_is_what_it_is_above() {
    let sky = sky(&profile(0.0, 1.0, 0.5), 0.4);
    for (altitude, azimuth) in [(0.02_f64, 0.0_f64), (0.7, 2.0), (1.5, 4.0)] {
        let expected = 1.0 + 0.4 * altitude.cos() * azimuth.cos();
        assert!((seen(&sky, altitude, azimuth) / expected - 1.0).abs() < 1e-5, "{altitude} {azimuth}");
    }
    // Lambert's law: the ground has albedo times the light that falls on it.
    assert!((seen(&sky, -1.0, 0.3) / 0.5 - 1.0).abs() < 2e-3, "{}", seen(&sky, -1.0, 0.3));
}

#[test]
fn air_that_does_not_absorb_lets_through_what_a_slab_does() {
    // checked against: Heaslet & Warming 1965, Int. J. Heat and Mass Transfer 8, 979: heat through a grey slab in radiative equilibrium, which is the transmittance of an isotropically
    // scattering slab to diffuse light: 0.9157, 0.8491, 0.7040
    for (depth, expected) in [(0.1, 0.9157), (0.2, 0.8491), (0.5, 0.7040)] {
        let got = horizontal(&sky(&profile(depth, 1.0, 0.0), 0.0));
        println!("optical depth {depth}: {got:.4}, slab {expected}");
        assert!((got / expected - 1.0).abs() < 0.03, "{depth}: {got} {expected}");
    }
    // What only absorbs dims, and no more: 2 E3(0.2).
    let black = horizontal(&sky(&profile(0.2, 0.0, 0.0), 0.0));
    assert!((black - 0.7038).abs() < 0.004, "{black}");
}

#[test]
fn a_bright_ground_lights_the_sky_and_is_lit_by_it() {
    let profile = profile(0.2, 1.0, 0.8);
    let sky = sky(&profile, 0.0);
    let down = horizontal(&sky);
    // Reflections between ground and air: t / (1 - albedo (1 - t)).
    let expected = 0.8491 / (1.0 - 0.8 * (1.0 - 0.8491));
    println!("down {down:.4}, expected {expected:.4}; ground {:.4}", seen(&sky, -1.55, 0.0));
    assert!((down / expected - 1.0).abs() < 0.01, "{down} {expected}");
    assert!((seen(&sky, -1.55, 0.0) / (0.8 * expected) - 1.0).abs() < 0.03, "{}", seen(&sky, -1.55, 0.0));
}

#[test]
fn light_made_in_the_air_is_not_dimmed_again() {
    let profile = profile(0.3, 0.9, 0.2);
    let field = LightField::solve(&profile, &Quality::Draft.numbers(), false, &Progress::silent()).unwrap();
    let air = DiffuseAir::new(&field, &profile, 0.0, 0.0);
    let sky = DiffuseSky::round_within(Even { tilt: 0.0 }, &air, &Sensor::xyz(&profile.wavelengths_nm));
    for altitude in [0.01, 0.5, 1.57] {
        assert!((seen(&sky, altitude, 1.0) - 1.0).abs() < 1e-5);
    }
}
