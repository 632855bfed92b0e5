//! Sun and Moon as they shine on the air, outside it.

use crate::celestial::{EclipsedSunlight, MoonDisc, MoonView};
use crate::ephemeris::{Bodies, SolarEclipse};
use crate::error::Result;
use crate::spectrum::solar;
use crate::units::ASTRONOMICAL_UNIT_KM;

/// The light of the Sun behind the Moon, if the Moon covers any of it.
pub(super) fn eclipsed_sunlight(bodies: &Bodies) -> Result<Option<EclipsedSunlight>> {
    let light = |eclipse: SolarEclipse| {
        let (sun, moon) = (bodies.sun.direction(), bodies.moon.body.direction());
        EclipsedSunlight::new(sun, eclipse.sun_radius_deg, moon, eclipse.moon_radius_deg)
    };
    bodies.solar_eclipse().map(light).transpose()
}

/// The Moon as the observer sees it, airless.
pub(super) fn moon(bodies: &Bodies) -> Result<MoonDisc> {
    let state = &bodies.moon;
    let to_moon_km = state.body.distance_au * ASTRONOMICAL_UNIT_KM * state.body.direction();
    let to_earth_km = bodies.observer.earth_centre() * ASTRONOMICAL_UNIT_KM;
    let from_moon = to_earth_km - to_moon_km;
    MoonDisc::new(MoonView {
        direction: state.body.direction(),
        distance_km: to_moon_km.length(),
        sun_direction: state.illumination.sun_direction,
        sun_distance_au: state.illumination.sun_distance_au,
        earth_direction: from_moon.normalize(),
        earth_distance_km: from_moon.length(),
        body_to_frame: state.orientation,
    })
}

/// The Moon's irradiance outside the air by wavelength [nm]: means over 1 nm [W m-2 nm-1].
pub(super) fn moonlight(moon: &MoonDisc) -> impl Fn(f64) -> f64 {
    let integrals = moon.component_integrals();
    move |wavelength| solar::irradiance(wavelength, 1.0) * irradiance_ratio(moon, integrals, wavelength)
}

/// The Moon's irradiance outside the air over the Sun's at 1 au, for the integrals of its components.
fn irradiance_ratio(moon: &MoonDisc, integrals: &[f64], wavelength_nm: f64) -> f64 {
    integrals.iter().enumerate().map(|(c, integral)| integral * moon.spectrum(c, wavelength_nm)).sum()
}
