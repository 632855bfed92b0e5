//! Visual magnitude of the Moon from the reflectance of its whole disc, measured by the Robotic Lunar Observatory
//! (ROLO: Kieffer & Stone 2005, AJ 129, 2887).
//!
//! ln A = sum a_i g^i + sum b_j Phi^(2j-1) + c1 theta + c2 phi + c3 Phi theta + c4 Phi phi + d1 exp(-g/p1) + d2 exp(-g/p2) + d3 cos((g - p3)/p4)
//!
//! V = V_Sun - 2.5 log10(A W / pi) + 5 log10((d / 384400 km) (r / 1 au)), W = 6.4177e-5 sr
//!
//! g: phase angle (radians in the sum of powers, degrees elsewhere); Phi: selenographic longitude of the Sun [radians]; theta, phi: selenographic latitude and
//! longitude of the observer [degrees]; d, r: distance of the Moon from observer and Sun. The mean of ln A at 549.1 and 553.8 nm stands for the V band.
//!
//! Waxing phases are 6 to 13 % brighter than waning ones. Measured from 1.55 to 97 degrees, about 1 % scatter. Below, the exponentials are continued;
//! beyond 97 degrees, the curve goes on with the shape of 0.026 g + 4e-9 g^4 magnitudes (Krisciunas & Schaefer 1991, PASP 103, 1033, after Allen 1976).

use super::moon_orientation::SurfacePoint;

/// Visual magnitude of the Sun at 1 au (Willmer 2018, ApJS 236, 47).
const SUN: f64 = -26.76;

/// Solid angle of the Moon at the standard distance [sr].
const SOLID_ANGLE: f64 = 6.4177e-5;
const STANDARD_DISTANCE_KM: f64 = 384_400.0;

/// Largest phase angle of the measurements [degrees].
const LIMIT_DEG: f64 = 97.0;

/// a0..a3, b1..b3, d1..d3 at 549.1 and at 553.8 nm.
const BANDS: [[f64; 10]; 2] = [
    [-2.107_82, -1.667_36, 0.416_97, -0.220_26, 0.034_51, 0.014_52, -0.005_17, 0.368_14, -0.098_15, 0.0],
    [-2.125_04, -1.659_70, 0.384_09, -0.206_55, 0.040_52, 0.010_09, -0.003_88, 0.372_06, -0.107_45, 0.003_47],
];
const C: [f64; 4] = [3.4115e-4, -1.3425e-3, 9.5906e-4, 6.6229e-4];
const P: [f64; 4] = [4.060_54, 12.8802, -30.5858, 16.7498];

/// Magnitude at a phase angle [degrees], distance from the observer [km] and from the Sun [au], with the places below observer and Sun.
pub(super) fn moon_magnitude(
    phase_angle_deg: f64,
    distance_km: f64,
    sun_distance_au: f64,
    observer: SurfacePoint,
    sun: SurfacePoint,
) -> f64 {
    let disc = reflectance(phase_angle_deg.min(LIMIT_DEG), observer, sun.longitude_deg.clamp(-LIMIT_DEG, LIMIT_DEG));
    let crescent = allen(phase_angle_deg.max(LIMIT_DEG)) - allen(LIMIT_DEG);
    let distances = 5.0 * (distance_km / STANDARD_DISTANCE_KM * sun_distance_au).log10();
    SUN - 2.5 * (disc * SOLID_ANGLE / std::f64::consts::PI).log10() + crescent + distances
}

fn allen(phase_angle_deg: f64) -> f64 {
    0.026 * phase_angle_deg + 4e-9 * phase_angle_deg.powi(4)
}

/// A: the irradiance of the whole Moon in units of that of a white Lambertian disc that faces Sun and observer.
fn reflectance(phase_angle_deg: f64, observer: SurfacePoint, sun_longitude_deg: f64) -> f64 {
    let (g, sun) = (phase_angle_deg.to_radians(), sun_longitude_deg.to_radians());
    let mean = |i: usize| 0.5 * (BANDS[0][i] + BANDS[1][i]);
    let powers = mean(0) + g * (mean(1) + g * (mean(2) + g * mean(3)));
    let waxing = sun * (mean(4) + sun * sun * (mean(5) + sun * sun * mean(6)));
    let libration = (C[0] + C[2] * sun) * observer.latitude_deg + (C[1] + C[3] * sun) * observer.longitude_deg;
    let opposition = mean(7) * (-phase_angle_deg / P[0]).exp() + mean(8) * (-phase_angle_deg / P[1]).exp();
    let wave = mean(9) * ((phase_angle_deg - P[2]) / P[3]).cos();
    (powers + waxing + libration + opposition + wave).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIDDLE: SurfacePoint = SurfacePoint { longitude_deg: 0.0, latitude_deg: 0.0 };

    fn magnitude(phase: f64, sun_longitude: f64) -> f64 {
        moon_magnitude(phase, 384_400.0, 1.0, MIDDLE, SurfacePoint { longitude_deg: sun_longitude, latitude_deg: 0.0 })
    }

    /// With the illuminance of the Sun outside the air, 134.6 klx for V = -26.76 (ASTM E490 with CIE 1931: 133.3 to 134.6).
    fn lux(phase: f64, sun_longitude: f64) -> f64 {
        134_000.0 * 10_f64.powf(-0.4 * (magnitude(phase, sun_longitude) - SUN))
    }

    #[test]
    fn illuminance_of_the_moon_outside_the_air() {
        // checked against: spectral irradiances of the same measurements, summed for the eye: 0.28 lx at 7, 0.11 at 45, 0.03 at 90 degrees, waxing.
        for (phase, expected) in [(7.0, 0.28), (45.0, 0.11), (90.0, 0.03)] {
            let ours = lux(phase, phase);
            println!("{phase} degrees: {ours:.4} lx, V {:.3}", magnitude(phase, phase));
            assert!((ours / expected - 1.0).abs() < 0.05, "{phase}: {ours}");
        }
    }

    #[test]
    fn waxing_is_brighter_than_waning() {
        // checked against: Kieffer & Stone 2005: the maria make waning phases darker; 7 to 15 % by the design's figures.
        for phase in [45.0, 60.0, 75.0, 90.0] {
            let ratio = lux(phase, phase) / lux(phase, -phase);
            assert!((1.06..1.16).contains(&ratio), "{phase}: {ratio}");
        }
    }

    #[test]
    fn near_the_older_formula_for_all_phases() {
        // checked against: Krisciunas & Schaefer 1991, after Allen 1976: V = -12.73 + 0.026 g + 4e-9 g^4, without opposition surge below 7 degrees.
        for phase in [7.0, 20.0, 40.0, 60.0, 80.0, 96.0, 98.0, 120.0, 150.0] {
            let ours = 0.5 * (magnitude(phase, phase) + magnitude(phase, -phase));
            assert!((ours - (-12.73 + allen(phase))).abs() < 0.2, "{phase}: {ours}");
        }
        assert!(magnitude(2.0, 2.0) < -12.8 && magnitude(0.0, 0.0) < magnitude(2.0, 2.0));
    }

    #[test]
    fn it_is_continuous_and_falls_with_distance() {
        assert!((magnitude(96.999, 96.999) - magnitude(97.001, 97.001)).abs() < 1e-3);
        let far = moon_magnitude(30.0, 2.0 * 384_400.0, 1.0, MIDDLE, MIDDLE);
        assert!((far - moon_magnitude(30.0, 384_400.0, 1.0, MIDDLE, MIDDLE) - 5.0 * 2.0_f64.log10()).abs() < 1e-12);
    }
}
