use super::*;
use crate::spectrum::{observer, solar};

const MOON_KM: f64 = 384_400.0;
const SUN_KM: f64 = 1.496e8;

fn shadow(limb: &EarthLimb) -> ShadowedSunlight {
    ShadowedSunlight::new(limb, MOON_KM, SUN_KM).unwrap()
}

fn minutes(minutes: f64) -> f64 {
    (minutes / 60.0).to_radians()
}

/// Mean transmission with a weight by wavelength.
fn mean(shadow: &ShadowedSunlight, angle: f64, weight: impl Fn(f64) -> f64) -> f64 {
    let wavelengths = || (0..WAVELENGTHS).map(|i| WAVELENGTHS_NM.0 + i as f64 * WAVELENGTHS_NM.2);
    wavelengths().map(|w| weight(w) * shadow.transmission(angle, w)).sum::<f64>() / wavelengths().map(weight).sum::<f64>()
}

/// Transmission of the Sun's light as the eye sees it.
fn visual(shadow: &ShadowedSunlight, angle: f64) -> f64 {
    mean(shadow, angle, |w| solar::irradiance(w, 10.0) * observer::matching_functions(w)[1])
}

#[test]
fn it_is_quick() {
    limb_rays();
    let start = std::time::Instant::now();
    let shadow = shadow(&EarthLimb::default());
    println!("{} nodes in {:.1} ms", shadow.angles.len(), start.elapsed().as_secs_f64() * 1e3);
    for at in [0.0, 10.0, 20.0, 30.0, 35.0, 38.0, 40.0, 41.0, 42.0, 45.0, 50.0, 60.0, 70.0] {
        println!("{at:4.0}': {:6.2} mag", -2.5 * visual(&shadow, minutes(at)).log10());
    }
}

#[test]
fn without_air_it_is_geometry() {
    // Clouds to beyond the air leave only what is seen beside it; half of a uniform Sun's diameter... the centre of the Sun on the
    // edge of the dark disc.
    let sky = Sky::new(MOON_KM, SUN_KM);
    let free = sky.beside_the_air(sky.air + 1.5 * sky.sun)[0];
    assert!((free / (PI * sky.sun * sky.sun) - 1.0).abs() < 1e-6, "{free}");
    // Two circles of radii R and s at distance R: the part of the small one inside the large one, a lens.
    let (r, s) = (sky.air, sky.sun);
    let d = r;
    let lens = s * s * ((d * d + s * s - r * r) / (2.0 * d * s)).acos()
        + r * r * ((d * d + r * r - s * s) / (2.0 * d * r)).acos()
        - 0.5 * ((-d + s + r) * (d + s - r) * (d - s + r) * (d + s + r)).sqrt();
    let seen = sky.beside_the_air(d)[0];
    assert!((seen / (PI * s * s - lens) - 1.0).abs() < 1e-5, "{}", seen / (PI * s * s - lens));
}

#[test]
fn a_transparent_lens_of_air_keeps_its_light() {
    // Behind the Earth on the axis, with air that only bends: the ring seen has radiance 1, so T is the ring's solid angle over the Sun's.
    let sky = Sky::new(MOON_KM, SUN_KM);
    let mut ring = 0.0;
    for ray in limb_rays() {
        if let Some(moments) = sky.through_the_air(ray, 0.0) {
            ring += moments[0];
        }
    }
    // epsilon = +-sun at the ring's edges.
    let edge = |epsilon: f64| {
        let rays = limb_rays();
        let i = rays
            .windows(2)
            .position(|p| {
                (p[0].impact_km / MOON_KM).asin() - p[0].bending * sky.lever <= epsilon
                    && (p[1].impact_km / MOON_KM).asin() - p[1].bending * sky.lever > epsilon
            })
            .unwrap_or(0);
        rays[i].impact_km / MOON_KM
    };
    let (inner, outer) = (edge(-sky.sun).max(sky.earth), edge(sky.sun));
    let expected = PI * (outer * outer - inner * inner);
    assert!((ring / expected - 1.0).abs() < 0.05, "{ring} {expected}");
}

#[test]
fn the_centre_of_a_clean_shadow() {
    // checked against: Vollmer & Gedzelman 2008: cloudless molecular air without ozone on a smooth Earth: the Moon at the centre of
    // the umbra is 2400 times darker (their weighting of the visible is between all light and the eye's: the light is red); with
    // aerosol, ozone, clouds and mountains some 100 times darker still
    let clean = shadow(&EarthLimb { ozone_du: 0.0, aod550: 0.0, stratospheric_aod550: 0.0, cloud_height_km: 0.0 });
    let all = mean(&clean, 0.0, |w| if (380.0..=740.0).contains(&w) { solar::irradiance(w, 10.0) } else { 0.0 });
    println!("clean: 1 / {:.0} for the eye, 1 / {:.0} of all light", 1.0 / visual(&clean, 0.0), 1.0 / all);
    assert!(visual(&clean, 0.0) < 1.0 / 2400.0 && all > 1.0 / 2400.0 && all < 3.0 * visual(&clean, 0.0));
    let further = visual(&clean, 0.0) / visual(&shadow(&EarthLimb::default()), 0.0);
    println!("default: {further:.0} times darker");
    assert!((30.0..200.0).contains(&further), "{further}");
}

#[test]
fn the_umbra_is_red_within_and_turquoise_at_its_edge() {
    // checked against: Vollmer & Gedzelman 2008; Garcia Munoz & Palle 2011: red centre; at the periphery ozone's Chappuis band (550 to
    // 620 nm) is missing, so that blue is stronger than orange
    let shadow = shadow(&EarthLimb::default());
    let at = |arcminutes: f64, wavelength: f64| shadow.transmission(minutes(arcminutes), wavelength);
    assert!(at(0.0, 680.0) > 20.0 * at(0.0, 550.0) && at(0.0, 550.0) > 20.0 * at(0.0, 440.0));
    assert!(at(40.0, 440.0) > 1.15 * at(40.0, 600.0) && at(40.0, 500.0) > 1.15 * at(40.0, 600.0));
    let colorless = ShadowedSunlight::new(&EarthLimb { ozone_du: 0.0, ..EarthLimb::default() }, MOON_KM, SUN_KM).unwrap();
    assert!(colorless.transmission(minutes(40.0), 440.0) < colorless.transmission(minutes(40.0), 600.0));
    let mut last = 0.0;
    for step in 0..=300 {
        let now = visual(&shadow, minutes(f64::from(step) * 0.25));
        // To the steps of the rays.
        assert!(now >= last * (1.0 - 4e-3), "{step}: {now} {last}");
        last = now;
    }
    assert_eq!(shadow.transmission(shadow.reach(), 550.0), 1.0);
    // checked against: Garcia Munoz & Palle 2011 and Link 1962: 12 to 16 magnitudes at the centre
    assert!((12.0..16.0).contains(&(-2.5 * visual(&shadow, 0.0).log10())));
}

#[test]
fn the_table_is_fine_enough() {
    let shadow = shadow(&EarthLimb::default());
    // Half of the nodes predict the others.
    for node in (1..shadow.last_node() - 1).step_by(2) {
        for wavelength in [450.0, 550.0, 650.0] {
            let [before, here, after] = [node - 1, node, node + 1].map(|node| shadow.node_transmission(node, wavelength));
            let share = (shadow.angles[node] - shadow.angles[node - 1]) / (shadow.angles[node + 1] - shadow.angles[node - 1]);
            let gap = (before + (after - before) * share) / here - 1.0;
            // The error within one step is a quarter of this.
            assert!(gap.abs() < 0.06, "{:.2}', {wavelength} nm: {gap}", shadow.angles[node].to_degrees() * 60.0);
        }
    }
}

#[test]
fn bad_limbs_are_named() {
    let error =
        ShadowedSunlight::new(&EarthLimb { ozone_du: -1.0, ..EarthLimb::default() }, MOON_KM, SUN_KM).unwrap_err().to_string();
    assert!(error.starts_with("ozone_du = -1"), "{error}");
    assert!(ShadowedSunlight::new(&EarthLimb::default(), f64::NAN, SUN_KM).is_err());
}
