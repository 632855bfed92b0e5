//! Visual magnitudes of the planets (Mallama & Hilton 2018, Astronomy and Computing 25, 10; arXiv 1808.01973).
//!
//! V = 5 log10(r d) + V(1, 0) + f(phase angle, tilt, year), r = distance from the Sun, d = from the observer [au]
//!
//! | planet | eq. | f depends on |
//! |---|---|---|
//! | Mercury | 2 | phase angle to 6th order |
//! | Venus | 3, 4 | phase angle, forward scattering by its clouds beyond 163.7 degrees |
//! | Mars | 6, 7 | phase angle; see below |
//! | Jupiter | 8 | phase angle |
//! | Saturn | 10 | phase angle and tilt of the rings, which are part of the light |
//! | Uranus | 14 | latitude that faces Sun and Earth, phase angle beyond 3.1 degrees |
//! | Neptune | 15 to 17 | year: brightening from 1980 to 2000; phase angle beyond 1.9 degrees |
//!
//! Mars besides varies with the face that it shows (L1, by the mean of the longitudes below Earth and Sun) and with its season (L2, by the longitude
//! of the Sun seen from it), each within 0.09 magnitudes (Mallama 2007, Icarus 192, 404). That part is a number of its own
//! ([`mars_surface_magnitude`]): most almanacs and codes leave it out, and dust storms change as much.

use std::f64::consts::PI;

/// What the magnitude of a planet depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Circumstances {
    /// Distance from the Sun [au].
    pub sun_distance_au: f64,
    /// Distance from the observer [au].
    pub distance_au: f64,
    /// Angle at the planet between Sun and observer [degrees].
    pub phase_angle_deg: f64,
    /// Planetocentric latitude below the observer [degrees].
    pub sub_observer_latitude_deg: f64,
    /// Planetocentric latitude below the Sun [degrees].
    pub sub_solar_latitude_deg: f64,
    /// Julian year.
    pub year: f64,
}

impl Circumstances {
    fn with_distances(&self, magnitude: f64) -> f64 {
        magnitude + 5.0 * (self.sun_distance_au * self.distance_au).log10()
    }
}

fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

pub(super) fn mercury(at: &Circumstances) -> f64 {
    const PHASE: [f64; 7] = [-0.613, 6.3280e-2, -1.6336e-3, 3.3644e-5, -3.4265e-7, 1.6893e-9, -3.0334e-12];
    at.with_distances(polynomial(&PHASE, at.phase_angle_deg))
}

pub(super) fn venus(at: &Circumstances) -> f64 {
    const CRESCENT_DEG: f64 = 163.7;
    const PHASE: [f64; 5] = [-4.384, -1.044e-3, 3.687e-4, -2.814e-6, 8.938e-9];
    const CRESCENT: [f64; 3] = [236.058_28, -2.819_14, 8.390_34e-3];
    let coefficients: &[f64] = if at.phase_angle_deg < CRESCENT_DEG { &PHASE } else { &CRESCENT };
    at.with_distances(polynomial(coefficients, at.phase_angle_deg))
}

pub(super) fn mars(at: &Circumstances) -> f64 {
    const LIMIT_DEG: f64 = 50.0;
    let coefficients =
        if at.phase_angle_deg <= LIMIT_DEG { [-1.601, 2.267e-2, -1.302e-4] } else { [-0.367, -0.025_73, 3.445e-4] };
    at.with_distances(polynomial(&coefficients, at.phase_angle_deg))
}

pub(super) fn jupiter(at: &Circumstances) -> f64 {
    at.with_distances(polynomial(&[-9.395, -3.7e-4, 6.16e-4], at.phase_angle_deg))
}

/// Eq. 10 holds to a phase angle of 6.5 and a tilt of 27 degrees: all that is seen from the Earth.
pub(super) fn saturn(at: &Circumstances) -> f64 {
    let product = at.sub_observer_latitude_deg * at.sub_solar_latitude_deg;
    // Where Sun and Earth stand on different sides of the rings, their dark side is seen.
    let tilt = product.max(0.0).sqrt().to_radians().sin();
    let phase = at.phase_angle_deg;
    at.with_distances(-8.914 - 1.825 * tilt + 0.026 * phase - 0.378 * tilt * (-2.25 * phase).exp())
}

/// Eq. 14. As in the authors' program its phase function begins at 3.1 degrees, which is reached from the Earth only around Uranus's perihelion; below, it is
/// part of the constant.
pub(super) fn uranus(at: &Circumstances) -> f64 {
    /// Square of equatorial over polar radius: 25559 / 24973 km (IAU WGCCRE).
    const FLATTENING: f64 = (25_559.0 / 24_973.0) * (25_559.0 / 24_973.0);
    const LIMIT_DEG: f64 = 3.1;
    let planetographic = |latitude: f64| (FLATTENING * latitude.to_radians().tan()).atan().to_degrees().abs();
    let latitude = 0.5 * (planetographic(at.sub_observer_latitude_deg) + planetographic(at.sub_solar_latitude_deg));
    let phase = if at.phase_angle_deg > LIMIT_DEG { polynomial(&[0.0, 6.587e-3, 1.045e-4], at.phase_angle_deg) } else { 0.0 };
    at.with_distances(-7.110 - 0.000_84 * latitude + phase)
}

/// Eqs. 15 to 17; the phase function (known after 2000 only) begins at 1.9 degrees, the largest phase angle seen from the Earth.
pub(super) fn neptune(at: &Circumstances) -> f64 {
    const LIMIT_DEG: f64 = 1.9;
    let phase = if at.phase_angle_deg > LIMIT_DEG { polynomial(&[0.0, 7.944e-3, 9.617e-5], at.phase_angle_deg) } else { 0.0 };
    at.with_distances((-6.89 - 0.0054 * (at.year - 1980.0)).clamp(-7.00, -6.89) + phase)
}

/// Mallama 2007, as the authors' program tabulates it: every 10 degrees from 0, magnitudes.
const MARS_FACE: [f64; 36] = [
    0.036, 0.045, 0.038, 0.023, 0.015, 0.011, 0.000, -0.012, -0.018, -0.036, -0.044, -0.059, -0.060, -0.055, -0.043, -0.041,
    -0.041, -0.036, -0.036, -0.018, -0.038, -0.011, 0.002, 0.004, 0.018, 0.019, 0.035, 0.050, 0.035, 0.027, 0.037, 0.048, 0.025,
    0.022, 0.024, 0.034,
];
const MARS_SEASON: [f64; 36] = [
    -0.029, -0.017, -0.014, -0.006, -0.018, -0.020, -0.014, -0.030, -0.008, -0.040, -0.024, -0.037, -0.036, -0.032, 0.010, 0.010,
    -0.001, 0.044, 0.025, -0.004, -0.016, -0.008, 0.029, -0.054, -0.033, 0.055, 0.017, 0.052, 0.006, 0.087, 0.006, 0.064, 0.030,
    0.019, -0.030, -0.017,
];

/// What the face and the season of Mars add to its magnitude: L1 + L2, linear between the tables' values.
///
/// `sub_observer_west_deg`, `sub_solar_west_deg`: longitudes on Mars, positive west; `solar_longitude_deg`: the season Ls, 0 at the northern spring equinox.
pub(super) fn mars_surface_magnitude(sub_observer_west_deg: f64, sub_solar_west_deg: f64, solar_longitude_deg: f64) -> f64 {
    // The mean of two directions: the middle of the shorter arc between them.
    let half_arc = 0.5 * ((sub_solar_west_deg - sub_observer_west_deg + 180.0).rem_euclid(360.0) - 180.0);
    periodic(&MARS_FACE, sub_observer_west_deg + half_arc) + periodic(&MARS_SEASON, solar_longitude_deg)
}

fn periodic(table: &[f64; 36], angle_deg: f64) -> f64 {
    let position = angle_deg.rem_euclid(360.0) / 10.0;
    let below = position.floor();
    let index = below as usize % 36;
    table[index] + (position - below) * (table[(index + 1) % 36] - table[index])
}

/// Longitude of the Sun seen from a planet whose pole and ascending node of the orbit are known, in the plane of the orbit from its spring equinox [degrees].
pub(super) fn season_deg(to_sun: glam::DVec3, pole: glam::DVec3, orbit_normal: glam::DVec3) -> f64 {
    // At the northern spring equinox the Sun crosses the equator northwards: it stands in the direction pole x orbit normal.
    let equinox = pole.cross(orbit_normal);
    let ahead = orbit_normal.cross(equinox);
    let angle = to_sun.dot(ahead).atan2(to_sun.dot(equinox));
    angle.rem_euclid(2.0 * PI).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn at(r: f64, d: f64, phase: f64) -> Circumstances {
        Circumstances {
            sun_distance_au: r,
            distance_au: d,
            phase_angle_deg: phase,
            sub_observer_latitude_deg: 0.0,
            sub_solar_latitude_deg: 0.0,
            year: 2018.0,
        }
    }

    #[test]
    fn the_authors_own_test_cases() {
        // checked against: Ap_Mag_Input_V3.txt of Mallama & Hilton (magnitudes of JPL Horizons): r, d, phase angle, magnitude.
        type Case = (fn(&Circumstances) -> f64, f64, f64, f64, f64);
        let cases: [Case; 8] = [
            (mercury, 0.310_295_423_552, 1.321_826_436_257_54, 1.1677, -2.477),
            (mercury, 0.413_629_222_334, 0.926_448_087_186_13, 90.1662, 0.181),
            (mercury, 0.448_947_624_811, 0.560_049_732_178_83, 178.7284, 7.167),
            (venus, 0.722_722_540_169, 1.716_074_895_540_51, 1.3232, -3.917),
            (venus, 0.721_480_714_554, 0.377_625_112_062_78, 124.1348, -4.916),
            (venus, 0.726_166_592_736, 0.288_895_824_206_42, 179.1845, -3.090),
            (jupiter, 5.446_231_815_414, 6.449_858_674_590_88, 0.2446, -1.667),
            (jupiter, 4.957_681_473_205, 3.953_930_781_360_13, 0.3431, -2.934),
        ];
        for (model, r, d, phase, expected) in cases {
            let ours = model(&at(r, d, phase));
            assert!((ours - expected).abs() < 0.0006, "{r} {d} {phase}: {ours}, not {expected}");
        }
        let ringed = Circumstances {
            sub_observer_latitude_deg: -26.332_275_66,
            sub_solar_latitude_deg: -26.224_864_13,
            ..at(9.014_989_659_493, 8.031_604_705_468_89, 0.1055)
        };
        assert!((saturn(&ringed) + 0.552).abs() < 0.0006);
        // The file has planetographic latitudes of Uranus: turned into planetocentric ones.
        let centric = |graphic: f64| (graphic.to_radians().tan() * (24_973.0_f64 / 25_559.0).powi(2)).atan().to_degrees();
        for (r, d, observer, sun, expected) in [
            (18.321_003_215_845, 17.322_972_852_510_8, -20.28, -20.29, 5.381),
            (20.096_361_095_266, 21.088_847_014_527_6, 0.97, 1.02, 6.025),
        ] {
            let tilted = Circumstances {
                sub_observer_latitude_deg: centric(observer),
                sub_solar_latitude_deg: centric(sun),
                ..at(r, d, 0.05)
            };
            assert!((uranus(&tilted) - expected).abs() < 0.0006);
        }
        let from_behind = Circumstances {
            sub_observer_latitude_deg: centric(55.11),
            sub_solar_latitude_deg: centric(-71.16),
            ..at(19.380_030_717_75, 11.188_424_380_138_3, 161.7728)
        };
        assert!((uranus(&from_behind) - 8.318).abs() < 0.0006);
        let near = Circumstances { year: 2018.1409, ..at(29.943_863_119_56, 0.009_409_689_422_51, 88.4363) };
        assert!((neptune(&near) + 8.296).abs() < 0.0006);
        for (r, d, year, expected) in [
            (30.322_109_867_761, 31.309_161_009_821_4, 1970.8963, 7.997),
            (30.207_767_693_725, 29.817_237_085_753, 1990.3240, 7.827),
            (30.028_181_709_541, 29.015_852_166_574_4, 2009.6299, 7.701),
        ] {
            assert!((neptune(&Circumstances { year, ..at(r, d, 1.0) }) - expected).abs() < 0.0006);
        }
    }

    #[test]
    fn mars_with_its_face_and_season() {
        // checked against: the same file, which adds L1 and L2: face and season make up the difference of 0.1 magnitudes at most.
        for (r, d, phase, expected) in
            [(1.381_191_244_505, 0.372_743_810_979_11, 4.8948, -2.862), (1.664_150_453_905, 2.589_951_645_184_60, 11.5877, 1.788)]
        {
            assert!((mars(&at(r, d, phase)) - expected).abs() < 0.1);
        }
        assert!((mars_surface_magnitude(120.0, 120.0, 0.0) - (-0.060 - 0.029)).abs() < 1e-12);
        assert!((mars_surface_magnitude(355.0, 5.0, 355.0) - (0.036 + 0.5 * (-0.017 - 0.029))).abs() < 1e-12);
    }

    #[test]
    fn rings_edge_on_and_lit_from_behind_add_nothing() {
        let dark = Circumstances { sub_observer_latitude_deg: -3.0, sub_solar_latitude_deg: 2.0, ..at(9.5, 8.6, 2.0) };
        let edge_on = Circumstances { sub_observer_latitude_deg: 0.0, ..dark };
        assert_eq!(saturn(&dark), saturn(&edge_on));
        let south = Circumstances { sub_observer_latitude_deg: -20.0, sub_solar_latitude_deg: -22.0, ..dark };
        let north = Circumstances { sub_observer_latitude_deg: 20.0, sub_solar_latitude_deg: 22.0, ..dark };
        assert!(saturn(&south) == saturn(&north) && saturn(&south) < saturn(&dark) - 0.5);
    }

    #[test]
    fn the_seasons_of_a_tilted_planet() {
        let (pole, normal) = (DVec3::new(0.4, 0.0, 0.9).normalize(), DVec3::Z);
        // The north pole leans towards the Sun: northern summer.
        assert!((season_deg(DVec3::X, pole, normal) - 90.0).abs() < 1e-9);
        assert!((season_deg(-DVec3::X, pole, normal) - 270.0).abs() < 1e-9);
        // The Earth: its pole leans to ecliptic longitude 90 degrees, and at the March equinox the Sun stands at 0.
        let pole = DVec3::new(0.0, 0.4, 0.9).normalize();
        assert!((season_deg(DVec3::new(1.0, -1.0, 0.0), pole, normal) - 315.0).abs() < 1e-9);
        assert!((season_deg(DVec3::Y, pole, normal) - 90.0).abs() < 1e-9);
    }
}
