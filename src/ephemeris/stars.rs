//! Where stars are seen.
//!
//! catalogue (ICRS, J2000) -> space motion and parallax -> deflection by the Sun -> aberration -> horizon. The last three are the same for all stars:
//! [`StarFrame`] holds them for one observer, and a star then costs some twenty multiplications.
//!
//! - motion: p = p_0 + mu t - pi r_o (normalised), mu = proper motion [radians a year], r_o = the observer's barycentric place [au],
//!   pi = parallax [radians]; radial velocity is left out (Sirius: 0.03 arcseconds in a century);
//! - deflection: p + 2 G M / (c^2 d) (e - (p.e) p) / (1 + p.e), e = unit vector from Sun to observer, d its distance;
//! - aberration: p / gamma + (1 + p.v / (1 + 1 / gamma)) v + w (v - (p.v) p), v in units of c, w = the Sun's potential (SOFA `ab`).
//!
//! Source: SOFA Astrometry Tools; Klioner 2003, AJ 125, 1580.

use super::celestial_frames::direction_from_longitude_latitude;
use super::observer::Observer;
use crate::error::{Result, check_range};
use crate::time::JulianDate;
use glam::{DMat3, DVec3};

const MILLIARCSECOND: f64 = std::f64::consts::PI / 648_000_000.0;

/// Schwarzschild radius of the Sun [au] (SOFA).
const SUN_SCHWARZSCHILD_AU: f64 = 1.974_125_743_36e-8;

/// A star's place and motion in the ICRS at the epoch J2000.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarPosition {
    /// Unit vector at J2000.0, seen from the barycentre of the solar system.
    pub direction: DVec3,
    /// Change of the direction [radians a Julian year].
    pub proper_motion: DVec3,
    /// Parallax [radians].
    pub parallax: f64,
}

impl StarPosition {
    /// A star without motion and parallax at right ascension and declination (ICRS) [degrees].
    ///
    /// # Errors
    /// [`crate::Error::Input`] for `right_ascension_deg` outside -360 to 360, `declination_deg` outside -90 to 90 degrees.
    pub fn fixed(right_ascension_deg: f64, declination_deg: f64) -> Result<Self> {
        Self::moving(right_ascension_deg, declination_deg, [0.0, 0.0], 0.0, 2000.0)
    }

    /// A star of a catalogue: right ascension and declination (ICRS) [degrees] at the epoch `epoch_year` (Julian year: 2000 or, for Hipparcos, 1991.25),
    /// proper motion in right ascension (times cos declination) and declination [milliarcseconds a year], parallax [milliarcseconds].
    ///
    /// # Errors
    /// [`crate::Error::Input`] for angles as [`StarPosition::fixed`], proper motions beyond 20000, `parallax_mas` outside 0 to 1000, `epoch_year` outside
    /// 1800 to 2200.
    pub fn moving(
        right_ascension_deg: f64,
        declination_deg: f64,
        proper_motion_mas: [f64; 2],
        parallax_mas: f64,
        epoch_year: f64,
    ) -> Result<Self> {
        check_range("right_ascension_deg", right_ascension_deg, -360.0, 360.0, "degrees")?;
        check_range("declination_deg", declination_deg, -90.0, 90.0, "degrees")?;
        for motion in proper_motion_mas {
            check_range("proper_motion_mas", motion, -20_000.0, 20_000.0, "milliarcseconds a year")?;
        }
        check_range("parallax_mas", parallax_mas, 0.0, 1000.0, "milliarcseconds")?;
        check_range("epoch_year", epoch_year, 1800.0, 2200.0, "")?;
        let direction = direction_from_longitude_latitude(right_ascension_deg, declination_deg);
        let (sin, cos) = right_ascension_deg.to_radians().sin_cos();
        let east = DVec3::new(-sin, cos, 0.0);
        let north = direction.cross(east);
        let proper_motion = MILLIARCSECOND * (proper_motion_mas[0] * east + proper_motion_mas[1] * north);
        let direction = (direction + (2000.0 - epoch_year) * proper_motion).normalize();
        Ok(Self { direction, proper_motion, parallax: parallax_mas * MILLIARCSECOND })
    }
}

/// What all stars share at one place and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StarFrame {
    years: f64,
    position: DVec3,
    sun_to_observer: DVec3,
    bending: f64,
    velocity: DVec3,
    inverse_lorentz: f64,
    potential: f64,
    to_horizon: DMat3,
}

impl StarFrame {
    /// The frame of `observer`.
    pub fn new(observer: &Observer) -> Self {
        let from_sun = observer.position() - observer.earth().sun;
        let velocity = observer.velocity_over_c();
        Self {
            years: (observer.tt() - JulianDate::from_days(2_451_545.0)) / 365.25,
            position: observer.position(),
            sun_to_observer: from_sun.normalize(),
            bending: SUN_SCHWARZSCHILD_AU / from_sun.length(),
            velocity,
            inverse_lorentz: (1.0 - velocity.length_squared()).sqrt(),
            potential: SUN_SCHWARZSCHILD_AU / from_sun.length(),
            to_horizon: observer.to_horizon(),
        }
    }

    /// Airless direction of a star, unit vector, x = east, y = north, z = up.
    pub fn direction(&self, star: &StarPosition) -> DVec3 {
        let moved = star.direction + self.years * star.proper_motion - star.parallax * self.position;
        self.direction_of(moved.normalize())
    }

    /// Airless direction of a fixed point of the sky, `icrs` a unit vector, x = east, y = north, z = up.
    pub fn direction_of(&self, icrs: DVec3) -> DVec3 {
        /// Keeps the bending finite within 5 arcminutes of the Sun's centre, as SOFA's `ldsun` does.
        const LIMIT: f64 = 1e-6;
        let along = icrs.dot(self.sun_to_observer);
        let bent = icrs + self.bending / (1.0 + along).max(LIMIT) * (self.sun_to_observer - along * icrs);
        let forward = bent.dot(self.velocity);
        let seen = self.inverse_lorentz * bent
            + (1.0 + forward / (1.0 + self.inverse_lorentz)) * self.velocity
            + self.potential * (self.velocity - forward * bent);
        self.to_horizon * seen.normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::Place;
    use crate::time::{Time, ZoneChoice};

    fn observer() -> Observer {
        let time = Time::parse("2026-11-22T01:00:00Z", ZoneChoice::InText).unwrap();
        Observer::new(&Place::new(-77.8419, 166.6863, 10.0).unwrap(), &time)
    }

    #[test]
    fn the_formula_is_that_of_bodies_at_a_great_distance() {
        let observer = observer();
        let frame = StarFrame::new(&observer);
        for count in 0..50 {
            let icrs = direction_from_longitude_latitude(37.0 * f64::from(count), 3.5 * f64::from(count) - 87.0);
            let far = observer.apparent(|_| 1e9 * icrs);
            assert!((frame.direction_of(icrs) - far.direction).length() < 1e-9, "{icrs}");
        }
    }

    #[test]
    fn a_year_of_proper_motion_and_parallax() {
        let star = StarPosition::moving(0.0, 0.0, [1000.0, -500.0], 750.0, 1999.0).unwrap();
        let arcseconds = star.direction / MILLIARCSECOND / 1000.0;
        assert!((arcseconds.y - 1.0).abs() < 1e-9 && (arcseconds.z + 0.5).abs() < 1e-9);
        let frame = StarFrame::new(&observer());
        let fixed = StarPosition { proper_motion: DVec3::ZERO, parallax: 0.0, ..star };
        let gap = (frame.direction(&star) - frame.direction(&fixed)).length() / MILLIARCSECOND / 1000.0;
        let motion = 26.89 * 1.25_f64.sqrt();
        assert!((gap - motion).abs() < 0.76, "{gap} {motion}");
    }

    #[test]
    fn bad_catalogues_are_refused() {
        assert!(StarPosition::fixed(10.0, 90.1).is_err() && StarPosition::fixed(f64::NAN, 0.0).is_err());
        assert!(StarPosition::moving(0.0, 0.0, [0.0, 2e4 + 1.0], 0.0, 2000.0).is_err());
        assert!(StarPosition::moving(0.0, 0.0, [0.0, 0.0], -1.0, 2000.0).is_err());
    }
}
