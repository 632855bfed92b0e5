//! The Moon's centre by the semi-analytical theory ELP/MPP02 (Chapront & Francou 2003, A&A 404, 735), constants fitted to DE405.
//!
//! longitude, latitude, distance = sum of A t^p sin(phase + sum of m_i a_i(t)), on the mean ecliptic of date; the longitude besides
//! W1(t), the Moon's mean longitude. t: Julian centuries TDB from J2000; a_1..a_13: D, F, l, l' (Delaunay), mean
//! longitudes of Mercury to Neptune, zeta = W1 + precession. Laskar's P and Q turn the ecliptic of date into that of J2000,
//! two angles this into the GCRS (DE405: obliquity 84381.40960 arcseconds, equinox -0.05028 arcseconds; Chapront, Chapront-Touze & Francou 2002,
//! A&A 387, 700).
//!
//! 2199 terms (`data/scripts/moon_elp_mpp02.py`): within 0.13 arcseconds and 0.2 km of JPL's DE423 from 1900 to 2100.

use super::table_bytes::TableBytes;
use crate::time::JulianDate;
use crate::units::ASTRONOMICAL_UNIT_KM;
use glam::{DMat3, DVec3};
use std::f64::consts::PI;
use std::sync::LazyLock;

const ARCSECOND: f64 = PI / 648_000.0;

/// A polynomial in t, constant first [arcseconds].
type Polynomial = [f64; 5];

/// Mean longitude of the Moon.
const W1: Polynomial =
    [785_939.955_71 - 0.070_08, 1_732_559_343.736_04 - 0.351_06, -6.8084 - 0.037_43, 0.006_604 - 1.8865e-4, -3.169e-5 - 1.024e-5];

/// Longitude of the Moon's perigee. The corrections of the rates of perigee and node consist of a fitted part (0.08017, -0.04317) and of what the
/// corrected mean motions, inclination and eccentricities do to the secular motions (the paper's partial derivatives).
const W2: Polynomial =
    [300_071.674_75 + 0.207_94, 14_643_420.317_1 + 0.076_071_502_6, -38.2631 + 0.004_706_02, -0.045_047 - 2.5213e-4, 2.1301e-4];

/// Longitude of the Moon's node.
const W3: Polynomial =
    [450_160.398_16 - 0.072_15, -6_967_919.538_3 - 0.043_169_060_7, 6.359 - 0.002_610_7, 0.007_625 - 1.0712e-4, -3.586e-5];

/// Mean longitude of the Earth-Moon barycentre.
const EARTH: Polynomial = [361_679.138_85 - 3.3e-4, 129_597_742.293 + 0.007_32, -0.0202, 9e-6, 1.5e-7];

/// Longitude of its perihelion.
const PERIHELION: Polynomial = [370_574.457_66 - 0.007_49, 1_161.243_42, 0.529_265, -1.1814e-4, 1.1379e-5];

/// Mean longitudes of Mercury to Neptune at J2000 [arcseconds] and their rates [arcseconds a century].
const PLANETS: [(f64, f64); 8] = [
    (908_103.216_919, 538_101_628.668_88),
    (655_124.758_419, 210_664_136.457_77),
    (361_679.138_850, 129_597_742.293),
    (1_279_563.642_778, 68_905_077.659_36),
    (123_665.379_392, 10_925_660.573_35),
    (180_278.902_495, 4_399_609.336_32),
    (1_130_584.354_234, 1_542_482.578_45),
    (1_095_656.808_371, 786_547.897),
];

/// Rate of precession, with its correction [arcseconds a century].
const PRECESSION: f64 = 5_029.096_6 - 0.299_65;

/// Ratio of the semi-major axes of DE405 and of ELP, which the series of the distance is scaled by.
const AXIS_RATIO: f64 = 384_747.961_370_173 / 384_747.980_674_318;

struct Block {
    coordinate: usize,
    power: i32,
    terms: Vec<Term>,
}

struct Term {
    amplitude: f64,
    phase: f64,
    multipliers: [i8; 13],
}

static SERIES: LazyLock<Vec<Block>> = LazyLock::new(|| {
    let mut table = TableBytes(include_bytes!("../../data/moon_elp_mpp02.bin"));
    std::iter::from_fn(|| read_block(&mut table)).collect()
});

fn read_block(table: &mut TableBytes<'_>) -> Option<Block> {
    let (coordinate, power) = (usize::from(table.byte()?).min(2), i32::from(table.byte()?));
    let count = table.short()?;
    let term = |_| Some(Term { amplitude: table.number()?, phase: table.number()?, multipliers: table.signed_bytes()? });
    Some(Block { coordinate, power, terms: (0..count).map_while(term).collect() })
}

fn polynomial(coefficients: &Polynomial, t: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * t + c)
}

/// The thirteen arguments [radians].
fn arguments(t: f64) -> [f64; 13] {
    let [moon, perigee, node, earth, perihelion] = [W1, W2, W3, EARTH, PERIHELION].map(|p| polynomial(&p, t));
    let mut arguments = [0.0; 13];
    arguments[..4].copy_from_slice(&[moon - earth + 648_000.0, moon - node, moon - perigee, earth - perihelion]);
    for (argument, (longitude, rate)) in arguments[4..12].iter_mut().zip(PLANETS) {
        *argument = longitude + rate * t;
    }
    arguments[12] = moon + PRECESSION * t;
    arguments.map(|arcseconds| arcseconds.rem_euclid(1_296_000.0) * ARCSECOND)
}

/// The Moon's centre seen from the Earth's centre, without light time [au, GCRS], at the date `tt` (which stands for TDB: 2 ms at most).
pub(super) fn geocentric(tt: JulianDate) -> DVec3 {
    let t = (tt - JulianDate::from_days(2_451_545.0)) / 36_525.0;
    let arguments = arguments(t);
    let mut sums = [0.0; 3];
    for block in SERIES.iter() {
        let sum: f64 = block
            .terms
            .iter()
            .map(|term| {
                let phase = term.multipliers.iter().zip(&arguments).fold(term.phase, |sum, (m, a)| sum + f64::from(*m) * a);
                term.amplitude * phase.sin()
            })
            .sum();
        sums[block.coordinate] += sum * t.powi(block.power);
    }
    let longitude = (polynomial(&W1, t).rem_euclid(1_296_000.0) + sums[0]) * ARCSECOND;
    let (sin_latitude, cos_latitude) = (sums[1] * ARCSECOND).sin_cos();
    let direction = DVec3::new(cos_latitude * longitude.cos(), cos_latitude * longitude.sin(), sin_latitude);
    let to_gcrs = DMat3::from_rotation_z(-0.050_28 * ARCSECOND) * DMat3::from_rotation_x(84_381.409_6 * ARCSECOND);
    to_gcrs * ecliptic_of_date(t) * direction * (sums[2] * AXIS_RATIO / ASTRONOMICAL_UNIT_KM)
}

/// Matrix from the inertial mean ecliptic of date to that of J2000 (Laskar 1986: p = sin(pi/2) sin Pi, q = sin(pi/2) cos Pi).
fn ecliptic_of_date(t: f64) -> DMat3 {
    let p = t * polynomial(&[1.018_039_1e-5, 4.702_043_9e-7, -5.417_367e-10, -2.507_948e-12, 4.634_86e-15], t);
    let q = t * polynomial(&[-1.134_690_02e-4, 1.237_267_4e-7, 1.265_417e-9, -1.371_808e-12, -3.203_34e-15], t);
    let root = 2.0 * (1.0 - p * p - q * q).sqrt();
    DMat3::from_cols(
        DVec3::new(1.0 - 2.0 * p * p, 2.0 * p * q, -p * root),
        DVec3::new(2.0 * p * q, 1.0 - 2.0 * q * q, q * root),
        DVec3::new(p * root, -q * root, 1.0 - 2.0 * (p * p + q * q)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_table_is_read() {
        let counts: Vec<usize> = SERIES.iter().map(|block| block.terms.len()).collect();
        assert_eq!(counts.iter().sum::<usize>(), 2199, "{counts:?}");
        assert!(SERIES.iter().all(|block| (0..4).contains(&block.power)));
    }

    #[test]
    fn an_independent_integration_of_the_moon() {
        // checked against: JPL DE421 through Skyfield 1.55, geocentric, x, y, z of the ICRS [km].
        let rows = include_str!("../../tests/reference/ephemeris_moon_geocentric.csv");
        let (mut worst_arcsec, mut worst_km): (f64, f64) = (0.0, 0.0);
        for row in rows.lines().skip(1) {
            let numbers: Vec<f64> = row.split(',').map(|field| field.parse().unwrap()).collect();
            let expected = DVec3::new(numbers[1], numbers[2], numbers[3]);
            let ours = geocentric(JulianDate::from_days(numbers[0])) * ASTRONOMICAL_UNIT_KM;
            worst_arcsec = worst_arcsec.max(ours.angle_between(expected) / ARCSECOND);
            worst_km = worst_km.max((ours.length() - expected.length()).abs());
        }
        println!("Moon against DE421: {worst_arcsec:.3} arcseconds, {worst_km:.2} km at most");
        assert!(worst_arcsec < 0.2 && worst_km < 0.4, "{worst_arcsec} {worst_km}");
    }

    #[test]
    fn the_ecliptic_turns_rigidly() {
        let turned = ecliptic_of_date(-5.0);
        assert!((turned.determinant() - 1.0).abs() < 1e-12);
        assert!((turned * turned.transpose() - DMat3::IDENTITY).to_cols_array().iter().all(|v| v.abs() < 1e-12));
    }
}
