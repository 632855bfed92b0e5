//! Where Earth and Sun are in the solar system.
//!
//! From 1900 to 2100 by the series of Bretagnon after VSOP2000 (SOFA `epv00`): 13 km at most against DE405, which is 0.02 arcseconds
//! of the Sun. Outside those years the Earth-Moon barycentre by Simon et al. 1994 (SOFA `plan94`) less the Moon's pull on the Earth
//! by Meeus 1998 (SOFA `moon98`): within 10 arcseconds of the Sun from 1000 to 3000. There the Sun stands for the barycentre of the solar system,
//! which changes the aberration by 0.01 arcseconds.

use crate::time::JulianDate;
use glam::DVec3;

/// Positions [au] and velocities [au per day] of Earth and Sun, in the BCRS.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarthState {
    /// Position of the Earth's centre.
    pub earth: DVec3,
    /// Velocity of the Earth's centre.
    pub earth_velocity: DVec3,
    /// Position of the Sun's centre.
    pub sun: DVec3,
    /// Velocity of the Sun's centre.
    pub sun_velocity: DVec3,
}

impl EarthState {
    /// The state at the date `tt` (which stands for TDB: 2 ms at most).
    pub fn at(tt: JulianDate) -> Self {
        match sofars::eph::epv00(tt.day, tt.fraction) {
            Some((heliocentric, barycentric)) => {
                let (earth, earth_velocity) = (DVec3::from(barycentric[0]), DVec3::from(barycentric[1]));
                Self {
                    earth,
                    earth_velocity,
                    sun: earth - DVec3::from(heliocentric[0]),
                    sun_velocity: earth_velocity - DVec3::from(heliocentric[1]),
                }
            }
            None => Self::low_precision(tt),
        }
    }

    fn low_precision(tt: JulianDate) -> Self {
        /// Mass of the Moon in units of Earth and Moon together (IAU 2009: Earth / Moon = 81.300568).
        const MOON_SHARE: f64 = 1.0 / 82.300_568;
        const EARTH_MOON_BARYCENTRE: i32 = 3;
        // plan94 refuses nothing but an unknown planet.
        let barycentre =
            sofars::eph::plan94(tt.day, tt.fraction, EARTH_MOON_BARYCENTRE).map_or([[0.0; 3]; 2], |(state, _)| state);
        let moon = sofars::eph::moon98(tt.day, tt.fraction);
        // moon98 is in the GCRS, plan94 in the mean equator and equinox of J2000, 0.02 arcseconds from it.
        Self {
            earth: DVec3::from(barycentre[0]) - MOON_SHARE * DVec3::from(moon[0]),
            earth_velocity: DVec3::from(barycentre[1]) - MOON_SHARE * DVec3::from(moon[1]),
            sun: DVec3::ZERO,
            sun_velocity: DVec3::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn separation_arcsec(a: DVec3, b: DVec3) -> f64 {
        a.angle_between(b).to_degrees() * 3600.0
    }

    #[test]
    fn the_low_precision_state_is_close_to_the_precise_one() {
        let mut worst: f64 = 0.0;
        for step in 0..400 {
            let tt = JulianDate::from_days(2_415_021.0 + 182.4 * f64::from(step));
            let (fine, coarse) = (EarthState::at(tt), EarthState::low_precision(tt));
            let (a, b) = (fine.earth - fine.sun, coarse.earth);
            worst = worst.max(separation_arcsec(a, b));
            assert!((a.length() - b.length()).abs() < 2e-5);
            let velocity = fine.earth_velocity - fine.sun_velocity;
            assert!((velocity - coarse.earth_velocity).length() < 2e-6);
        }
        println!("plan94 and moon98 against epv00, 1900 to 2100: {worst:.2} arcseconds at most");
        assert!(worst < 10.0, "{worst}");
    }

    #[test]
    fn there_is_a_sun_in_every_year() {
        for jd in [2_086_302.5, 2_415_019.9, 2_488_070.1, 2_817_151.5] {
            let state = EarthState::at(JulianDate::from_days(jd));
            let distance = (state.earth - state.sun).length();
            assert!((0.98..1.02).contains(&distance), "{jd}: {distance}");
        }
    }
}
