//! The planets: where they stand, how they are lit, how bright they are.

use super::body::Body;
use super::illumination::Illumination;
use super::moon_orientation::SurfacePoint;
use super::observer::{Apparent, Observer};
use super::planet::Planet;
use super::planet_magnitude as magnitude;
use super::planet_vsop::heliocentric;
use super::position_angle::separation;
use super::refraction::Refraction;
use crate::time::JulianDate;
use glam::{DMat3, DVec3};

/// A planet as it stands in the sky.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanetState {
    /// Which one.
    pub planet: Planet,
    /// Position, size and magnitude; the magnitude of Mars without [`PlanetState::surface_magnitude`].
    pub body: Body,
    /// Phase and bright limb.
    pub illumination: Illumination,
    /// Planetocentric latitude below the observer of Mars, Saturn and Uranus; for Saturn the opening of the rings, positive if
    /// their northern side is seen [degrees].
    pub sub_observer_latitude_deg: Option<f64>,
    /// What the face and the season of Mars add to its magnitude, -0.12 to 0.14; 0 for the others.
    pub surface_magnitude: f64,
}

/// Where `planet` is seen by `observer`.
pub(super) fn observe(observer: &Observer, planet: Planet) -> Apparent {
    let earth = *observer.earth();
    let tt = observer.tt();
    observer.apparent(|days| earth.sun - days * earth.sun_velocity + heliocentric(planet, tt.plus_seconds(-86_400.0 * days)))
}

/// The state of `planet` for `observer`, who sees the Sun at `sun`.
pub(super) fn planet_state(observer: &Observer, planet: Planet, sun: &Apparent, refraction: &Refraction) -> PlanetState {
    let seen = observe(observer, planet);
    let sent = observer.tt().plus_seconds(-86_400.0 * seen.light_days);
    let from_sun = heliocentric(planet, sent);
    let illumination =
        Illumination::of(seen.direction * seen.distance_au, sun.direction * sun.distance_au, observer.celestial_north());
    let axes = planet.body_fixed_to_icrs(sent).map(|matrix| matrix.transpose());
    let latitude = |direction: DVec3| axes.map(|axes| SurfacePoint::below(axes * direction).latitude_deg);
    let phase_angle = separation(from_sun, seen.astrometric);
    let circumstances = magnitude::Circumstances {
        sun_distance_au: from_sun.length(),
        distance_au: seen.distance_au,
        phase_angle_deg: phase_angle.to_degrees(),
        sub_observer_latitude_deg: latitude(-seen.astrometric).unwrap_or(0.0),
        sub_solar_latitude_deg: latitude(-from_sun).unwrap_or(0.0),
        year: 2000.0 + (observer.tt() - JulianDate::from_days(2_451_545.0)) / 365.25,
    };
    let visual = match planet {
        Planet::Mercury => magnitude::mercury(&circumstances),
        Planet::Venus => magnitude::venus(&circumstances),
        Planet::Mars => magnitude::mars(&circumstances),
        Planet::Jupiter => magnitude::jupiter(&circumstances),
        Planet::Saturn => magnitude::saturn(&circumstances),
        Planet::Uranus => magnitude::uranus(&circumstances),
        Planet::Neptune => magnitude::neptune(&circumstances),
    };
    let mut body = Body::seen(planet.name(), &seen, planet.radius_km(), refraction);
    body.magnitude = Some(visual);
    body.phase_angle_deg = Some(circumstances.phase_angle_deg);
    body.illuminated_fraction = Some(0.5 * (1.0 + phase_angle.cos()));
    PlanetState {
        planet,
        body,
        illumination,
        sub_observer_latitude_deg: latitude(-seen.astrometric),
        surface_magnitude: match (planet, axes) {
            (Planet::Mars, Some(axes)) => mars_surface(axes, -seen.astrometric, -from_sun),
            _ => 0.0,
        },
    }
}

fn mars_surface(axes: DMat3, to_observer: DVec3, to_sun: DVec3) -> f64 {
    // Normal of Mars's orbit: inclination 1.85 degrees, node 49.56 degrees on the ecliptic of J2000 (Standish & Williams, JPL).
    let (inclination, node, obliquity) = (1.8497_f64.to_radians(), 49.5595_f64.to_radians(), 23.4393_f64.to_radians());
    let ecliptic = DVec3::new(inclination.sin() * node.sin(), -inclination.sin() * node.cos(), inclination.cos());
    let orbit_normal = DMat3::from_rotation_x(obliquity) * ecliptic;
    let pole = axes.transpose() * DVec3::Z;
    let west = |direction: DVec3| -SurfacePoint::below(axes * direction).longitude_deg;
    magnitude::mars_surface_magnitude(west(to_observer), west(to_sun), magnitude::season_deg(to_sun, pole, orbit_normal))
}
