//! The observer as a moving point of the solar system with a horizon: turns the place of any body in space into where it is seen.
//!
//! For a body at r_b(t) and an observer at r_o(t) with velocity v_o (BCRS):
//! - light time: tau = |r_b(t - tau) - r_o(t)| / c, by iteration;
//! - deflection: the Sun's mass bends the light of bodies other than itself (SOFA `ld`), 1.75 arcseconds at its limb;
//! - aberration: the natural direction is turned by the observer's velocity (SOFA `ab`: special relativity and the Sun's potential);
//! - horizon: u_ENU = H R(ERA) C u, with C the IAU 2006/2000A precession-nutation to the intermediate system, R the rotation by the
//!   Earth rotation angle of UT1 (together SOFA `c2t06a`), H the local axes on the WGS84 ellipsoid.
//!
//! The observer takes part in the rotation of the Earth, so parallax and diurnal aberration are included. Neglected: polar
//! motion (<= 0.6 arcseconds), deflection of light by the planets.
//! Sources: IERS Conventions 2010; SOFA, "Tools for Earth Attitude" and "SOFA Astrometry Tools".

use super::earth::EarthState;
use super::place::Place;
use crate::time::{JulianDate, Time};
use crate::units::ASTRONOMICAL_UNIT_KM;
use glam::{DMat3, DVec3};

/// Light time for one astronomical unit [days].
const LIGHT_DAYS_PER_AU: f64 = ASTRONOMICAL_UNIT_KM / 299_792.458 / 86_400.0;

/// Rotation of the Earth in inertial space [radians per day of UT1] (IERS Conventions 2010, eq. 5.15).
const EARTH_ROTATION_PER_DAY: f64 = 1.002_737_811_911_354_6 * std::f64::consts::TAU;

/// A place at an instant: where it is in the solar system, how it moves and where its horizon points.
#[derive(Clone, Debug, PartialEq)]
pub struct Observer {
    position: DVec3,
    velocity: DVec3,
    earth: EarthState,
    to_horizon: DMat3,
    tt: JulianDate,
    north: DVec3,
}

/// Where a body is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apparent {
    /// Airless direction, unit vector, x = east, y = north, z = up.
    pub direction: DVec3,
    /// Distance that the light has travelled [au].
    pub distance_au: f64,
    /// Time that the light has travelled [days].
    pub light_days: f64,
    /// From the observer to where the body was when it sent the light, before deflection and aberration [au, GCRS].
    pub astrometric: DVec3,
}

impl Observer {
    /// The observer at `place` and `time`. Costs some 0.2 ms (1400 terms of nutation); then any number of bodies can be asked for.
    pub fn new(place: &Place, time: &Time) -> Self {
        Self::at_site(wgs84_au(place), horizon_axes(place), time)
    }

    /// An observer at the centre of the Earth, whose "horizon" is that of the north pole: for what almanacs define geocentrically.
    pub(super) fn geocentric(time: &Time) -> Self {
        Self::at_site(DVec3::ZERO, DMat3::IDENTITY, time)
    }

    fn at_site(site: DVec3, axes: DMat3, time: &Time) -> Self {
        let (tt, ut1) = (time.tt(), time.ut1());
        let earth = EarthState::at(tt);
        // SOFA matrices act on columns and are stored by rows.
        let rows = sofars::pnp::c2t06a(tt.day, tt.fraction, ut1.day, ut1.fraction, 0.0, 0.0);
        let to_terrestrial = DMat3::from_cols_array_2d(&rows).transpose();
        let to_celestial = to_terrestrial.transpose();
        let rotation = EARTH_ROTATION_PER_DAY * DVec3::new(-site.y, site.x, 0.0);
        Self {
            position: earth.earth + to_celestial * site,
            velocity: earth.earth_velocity + to_celestial * rotation,
            earth,
            to_horizon: axes * to_terrestrial,
            tt,
            north: axes * DVec3::Z,
        }
    }

    /// Earth and Sun at the instant of observation.
    pub fn earth(&self) -> &EarthState {
        &self.earth
    }

    /// Where a body is seen whose centre was at `position_before(days)` [au, BCRS], that many days before the observation.
    pub fn apparent(&self, position_before: impl Fn(f64) -> DVec3) -> Apparent {
        let mut light_days = 0.0;
        let mut path = position_before(0.0) - self.position;
        // Each step shrinks the error by the body's speed over that of light, 1e-4 and less.
        for _ in 0..3 {
            let next = path.length() * LIGHT_DAYS_PER_AU;
            if (next - light_days).abs() < 1e-12 {
                break;
            }
            light_days = next;
            path = position_before(light_days) - self.position;
        }
        let distance_au = path.length();
        let natural = self.deflected(path / distance_au, self.position + path - self.earth.sun);
        Apparent { direction: self.to_horizon * self.aberrated(natural), distance_au, light_days, astrometric: path }
    }

    /// The unit vector `direction` as the Sun's mass bends the light from it, of a body at `from_sun` [au].
    pub(super) fn deflected(&self, direction: DVec3, from_sun: DVec3) -> DVec3 {
        /// Closer to the Sun's centre than this a body is the Sun [au].
        const SUN_AU: f64 = 0.01;
        /// Within about 5 arcminutes of the Sun's centre the bending is held, as SOFA's `ldsun` does.
        const LIMIT: f64 = 1e-6;
        let source = from_sun.length();
        if source < SUN_AU {
            return direction;
        }
        let sun_to_observer = self.position - self.earth.sun;
        let distance = sun_to_observer.length();
        let unit = (sun_to_observer / distance).to_array();
        DVec3::from(sofars::astro::ld(1.0, direction.to_array(), (from_sun / source).to_array(), unit, distance, LIMIT))
    }

    /// The unit vector `natural` (GCRS) as the moving observer sees it (GCRS).
    fn aberrated(&self, natural: DVec3) -> DVec3 {
        let velocity = self.velocity * LIGHT_DAYS_PER_AU;
        let inverse_lorentz = (1.0 - velocity.length_squared()).sqrt();
        let sun_distance = (self.earth.sun - self.position).length();
        DVec3::from(sofars::astro::ab(&natural.to_array(), &velocity.to_array(), sun_distance, inverse_lorentz)).normalize()
    }

    /// The date of observation.
    pub fn tt(&self) -> JulianDate {
        self.tt
    }

    /// Position in the BCRS [au].
    pub(super) fn position(&self) -> DVec3 {
        self.position
    }

    /// From the observer to the Earth's centre [au], x = east, y = north, z = up.
    pub fn earth_centre(&self) -> DVec3 {
        self.to_horizon * (self.earth.earth - self.position)
    }

    /// Velocity in the BCRS in units of the speed of light.
    pub(super) fn velocity_over_c(&self) -> DVec3 {
        self.velocity * LIGHT_DAYS_PER_AU
    }

    /// Matrix from the GCRS to x = east, y = north, z = up.
    pub fn to_horizon(&self) -> DMat3 {
        self.to_horizon
    }

    /// Direction of the celestial north pole of date, x = east, y = north, z = up.
    pub fn celestial_north(&self) -> DVec3 {
        self.north
    }

    /// Where an apparent direction of date is seen that is already known in the GCRS (unit vector): only turned to the horizon.
    pub fn horizontal(&self, gcrs: DVec3) -> DVec3 {
        self.to_horizon * gcrs
    }
}

/// Position of a place in the ITRS [au].
fn wgs84_au(place: &Place) -> DVec3 {
    const EQUATORIAL_RADIUS_KM: f64 = 6_378.137;
    const FLATTENING: f64 = 1.0 / 298.257_223_563;
    let (sin_latitude, cos_latitude) = place.latitude_deg.to_radians().sin_cos();
    let (sin_longitude, cos_longitude) = place.longitude_deg.to_radians().sin_cos();
    let axis_ratio = (1.0 - FLATTENING).powi(2);
    let normal = EQUATORIAL_RADIUS_KM / (cos_latitude.powi(2) + axis_ratio * sin_latitude.powi(2)).sqrt();
    let height = place.elevation_m / 1000.0;
    let across = (normal + height) * cos_latitude;
    DVec3::new(across * cos_longitude, across * sin_longitude, (axis_ratio * normal + height) * sin_latitude)
        / ASTRONOMICAL_UNIT_KM
}

/// Matrix from the ITRS to east, north, up.
fn horizon_axes(place: &Place) -> DMat3 {
    let (sin_latitude, cos_latitude) = place.latitude_deg.to_radians().sin_cos();
    let (sin_longitude, cos_longitude) = place.longitude_deg.to_radians().sin_cos();
    let east = DVec3::new(-sin_longitude, cos_longitude, 0.0);
    let up = DVec3::new(cos_latitude * cos_longitude, cos_latitude * sin_longitude, sin_latitude);
    DMat3::from_cols(east, up.cross(east), up).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::ZoneChoice;

    fn observer(latitude: f64, longitude: f64) -> Observer {
        let time = Time::parse("2018-01-31T13:30:00Z", ZoneChoice::InText).unwrap();
        Observer::new(&Place::new(latitude, longitude, 0.0).unwrap(), &time)
    }

    #[test]
    fn the_ellipsoid() {
        // checked against: ERFA 2.0.1 gd2gc.
        let site = wgs84_au(&Place::new(55.7047, 13.191, 50.0).unwrap()) * ASTRONOMICAL_UNIT_KM;
        assert!((site - DVec3::new(3_507.038_860_436, 821.987_369_932, 5_246.027_988_594)).length() < 1e-6, "{site}");
        let pole = wgs84_au(&Place::new(90.0, 0.0, 1000.0).unwrap()) * ASTRONOMICAL_UNIT_KM;
        assert!((pole.z - 6_356.752_314_245 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_horizon_axes_are_right_handed_and_orthonormal() {
        let observer = observer(-36.8, 174.7);
        let axes = observer.to_horizon;
        assert!((axes.determinant() - 1.0).abs() < 1e-12);
        assert!((axes * axes.transpose() - DMat3::IDENTITY).to_cols_array().iter().all(|v| v.abs() < 1e-12));
    }

    #[test]
    fn the_celestial_pole_stands_as_high_as_the_latitude() {
        for latitude in [-60.0, 0.0, 35.5, 90.0] {
            // The pole of date: 18 years of precession after J2000 turn it by 0.1 degrees, so only roughly the GCRS pole.
            let altitude = observer(latitude, 20.0).horizontal(DVec3::Z).z.asin().to_degrees();
            assert!((altitude - latitude).abs() < 0.12, "{latitude}: {altitude}");
        }
    }

    #[test]
    fn the_ground_moves_east_with_the_speed_of_the_equator() {
        let observer = observer(0.0, 100.0);
        let ground = observer.to_horizon * (observer.velocity - observer.earth.earth_velocity);
        let metres_per_second = ground * ASTRONOMICAL_UNIT_KM * 1000.0 / 86_400.0;
        // checked against: 2 pi 6378.137 km in a sidereal day of 86164.1 s = 465.10 m/s.
        assert!((metres_per_second - DVec3::new(465.10, 0.0, 0.0)).length() < 0.05, "{metres_per_second}");
    }

    #[test]
    fn an_object_overhead_is_at_the_zenith() {
        let observer = observer(45.0, 7.0);
        let up = observer.to_horizon.transpose() * DVec3::Z;
        // It moves with the observer, so that aberration and light time cancel.
        let seen = observer.apparent(|days| observer.position + 1e-4 * up - observer.velocity * days);
        assert!(seen.direction.z > 1.0 - 1e-14);
        assert!((seen.distance_au - 1e-4).abs() < 2e-8);
    }
}
