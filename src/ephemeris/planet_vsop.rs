//! Planets by semi-analytical theories: VSOP87A (Bretagnon & Francou 1988, A&A 202, 309) for Mercury to Saturn,
//! VSOP2013 (Simon, Francou, Fienga & Manche 2013, A&A 557, A49) for Uranus and Neptune.
//!
//! variable = sum of A t^p cos(phase + frequency t), t in Julian millennia TDB from J2000. The variables of VSOP87A are heliocentric x, y, z on
//! the ecliptic of J2000; those of VSOP2013 the elements a, lambda, k = e cos w, h = e sin w, q = sin(i/2) cos W, p = sin(i/2) sin W.
//!
//! Largest geocentric errors from 1900 to 2100 against JPL's DE423 [arcseconds], with the cut of `data/scripts/planets_vsop.py`: Mercury 0.1, Venus 0.2,
//! Mars 0.4, Jupiter 0.5, Saturn 0.4, Uranus 0.9, Neptune 0.6. VSOP87's own Uranus and Neptune are 1.7 and 2.6 arcseconds off.

use super::planet::Planet;
use super::table_bytes::TableBytes;
use crate::time::JulianDate;
use glam::{DMat3, DVec3};
use std::sync::LazyLock;

const ARCSECOND: f64 = std::f64::consts::PI / 648_000.0;

struct Block {
    planet: u8,
    variable: usize,
    power: i32,
    terms: Vec<Term>,
}

struct Term {
    amplitude: f64,
    phase: f64,
    frequency: f64,
}

static SERIES: LazyLock<Vec<Block>> = LazyLock::new(|| {
    let mut table = TableBytes(include_bytes!("../../data/planets_vsop.bin"));
    std::iter::from_fn(|| read_block(&mut table)).collect()
});

fn read_block(table: &mut TableBytes<'_>) -> Option<Block> {
    let [planet, variable, power, _] = [table.byte()?, table.byte()?, table.byte()?, table.byte()?];
    let count = table.count()?;
    let term = |_| Some(Term { amplitude: table.number()?, phase: table.number()?, frequency: table.number()? });
    let terms = (0..count).map_while(term).collect();
    Some(Block { planet, variable: usize::from(variable).min(5), power: i32::from(power), terms })
}

/// The planet's centre (of Mars to Neptune: with its moons) seen from the Sun's, without light time [au, ICRS], at the date `tt` (which stands for TDB).
pub(super) fn heliocentric(planet: Planet, tt: JulianDate) -> DVec3 {
    let t = (tt - JulianDate::from_days(2_451_545.0)) / 365_250.0;
    let variables = variables(number_in_table(planet), t);
    match planet {
        Planet::Uranus | Planet::Neptune => vsop2013_to_icrs() * position_from_elements(variables),
        _ => vsop87_to_icrs() * DVec3::new(variables[0], variables[1], variables[2]),
    }
}

/// Counted from the Sun, the Earth is 3.
fn number_in_table(planet: Planet) -> u8 {
    match planet {
        Planet::Mercury => 1,
        Planet::Venus => 2,
        Planet::Mars => 4,
        Planet::Jupiter => 5,
        Planet::Saturn => 6,
        Planet::Uranus => 7,
        Planet::Neptune => 8,
    }
}

fn variables(planet: u8, t: f64) -> [f64; 6] {
    let mut variables = [0.0; 6];
    for block in SERIES.iter().filter(|block| block.planet == planet) {
        let sum: f64 = block.terms.iter().map(|term| term.amplitude * (term.phase + term.frequency * t).cos()).sum();
        variables[block.variable] += sum * t.powi(block.power);
    }
    variables
}

/// Heliocentric position on VSOP2013's ecliptic of J2000 [au]: Kepler's equation F - k sin F + h cos F = lambda by Newton's method, then the ellipse.
fn position_from_elements([axis, longitude, k, h, q, p]: [f64; 6]) -> DVec3 {
    let longitude = longitude.rem_euclid(std::f64::consts::TAU);
    let mut eccentric = longitude;
    // Eccentricities below 0.05: four steps reach the last digit.
    for _ in 0..6 {
        let (sin, cos) = eccentric.sin_cos();
        eccentric -= (eccentric - k * sin + h * cos - longitude) / (1.0 - k * cos - h * sin);
    }
    let (sin, cos) = eccentric.sin_cos();
    let shape = 1.0 / (1.0 + (1.0 - h * h - k * k).sqrt());
    let x = axis * ((1.0 - h * h * shape) * cos + h * k * shape * sin - k);
    let y = axis * ((1.0 - k * k * shape) * sin + h * k * shape * cos - h);
    DVec3::new(
        x * (1.0 - 2.0 * p * p) + y * 2.0 * p * q,
        x * 2.0 * p * q + y * (1.0 - 2.0 * q * q),
        2.0 * (1.0 - p * p - q * q).sqrt() * (y * q - x * p),
    )
}

/// From the dynamical ecliptic and equinox of VSOP87 to FK5, which is the ICRS within 0.02 arcseconds (Bretagnon & Francou 1988).
fn vsop87_to_icrs() -> DMat3 {
    DMat3::from_cols(
        DVec3::new(1.0, -4.799_66e-7, 0.0),
        DVec3::new(4.403_60e-7, 0.917_482_137_087, 0.397_776_982_902),
        DVec3::new(-1.909_19e-7, -0.397_776_982_902, 0.917_482_137_087),
    )
}

/// From VSOP2013's ecliptic and equinox of J2000 to the ICRS: obliquity 84381.41136 arcseconds, equinox -0.05188 arcseconds (Simon et al. 2013).
fn vsop2013_to_icrs() -> DMat3 {
    DMat3::from_rotation_z(-0.051_88 * ARCSECOND) * DMat3::from_rotation_x(84_381.411_36 * ARCSECOND)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_table_is_read() {
        assert_eq!(SERIES.iter().map(|block| block.terms.len()).sum::<usize>(), 10_068);
    }

    #[test]
    fn published_positions() {
        // checked against: the crate vsop87 3.0.0 (after the authors' vsop87.chk), VSOP87A at JD 2451545.0, x, y, z on the ecliptic [au]. The terms left out
        // amount to some 0.2 arcseconds at the smallest distance from the Earth.
        for (planet, x, y, z) in [
            (1, -0.130_093_411_5, -0.447_287_671_6, -0.024_598),
            (2, -0.718_302_279_7, -0.032_654_601_7, 0.041_014),
            (4, 1.390_715_926_4, -0.013_415_704_3, -0.034_468),
            (5, 4.001_174_026_8, 2.938_581_007_7, -0.101_784),
            (6, 6.406_406_857_3, 6.569_992_944_9, -0.369_077),
        ] {
            let v = variables(planet, 0.0);
            let gap = DVec3::new(v[0] - x, v[1] - y, v[2] - z).length();
            println!("planet {planet}: {gap:.1e} au");
            assert!(gap < 1.5e-6 * x.hypot(y), "{planet}: {v:?}");
        }
    }

    #[test]
    fn a_circle_and_an_ellipse() {
        let circle = position_from_elements([2.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
        assert!((circle - 2.0 * DVec3::new(1.0_f64.cos(), 1.0_f64.sin(), 0.0)).length() < 1e-15);
        // Perihelion at longitude 0: at lambda = 0 the distance is a (1 - e), at pi a (1 + e).
        assert!((position_from_elements([2.0, 0.0, 0.04, 0.0, 0.0, 0.0]).length() - 1.92).abs() < 1e-14);
        assert!((position_from_elements([2.0, std::f64::consts::PI, 0.04, 0.0, 0.0, 0.0]).length() - 2.08).abs() < 1e-14);
        // Ascending node at longitude 0, inclination 60 degrees: a quarter of a turn later the height is a sin i.
        let tilted = position_from_elements([1.0, std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.5, 0.0]);
        assert!((tilted - DVec3::new(0.0, 0.5, 0.75_f64.sqrt())).length() < 1e-14);
    }
}
