//! The components together: how dark a natural night is.

use super::photometry::{S10_LUMINANCE, surface_brightness_of_luminance};
use super::*;
use crate::ephemeris::direction_from_longitude_latitude as unit_vector;
use glam::DVec3;

/// ICRS direction of the north ecliptic pole.
fn ecliptic_pole() -> DVec3 {
    unit_vector(270.0, 66.560_72)
}

#[test]
fn a_moonless_zenith_is_as_dark_as_published() {
    let galactic_pole = unit_vector(192.859_48, 27.128_25);
    let starlight = MilkyWay::new(6.5).unwrap();
    let zodiacal = ZodiacalLight::new(DVec3::X);
    let zenith = |flux: f64| {
        let airglow = Airglow::new(flux, 1.0, 0.0).unwrap();
        let luminance = airglow.luminance(DVec3::Z) + zodiacal.luminance(ecliptic_pole()) + starlight.luminance(galactic_pole);
        surface_brightness_of_luminance(luminance)
    };
    // checked against: Benn & Ellison 1998, New Astron. Rev. 42, 503: V 21.9 at solar minimum, zenith, high latitudes; Patat 2003, A&A 400, 1183: Paranal, 21.6 +- 0.2 at high solar activity
    assert!((zenith(80.0) - 21.9).abs() < 0.2, "{}", zenith(80.0));
    assert!((zenith(175.0) - 21.6).abs() < 0.2, "{}", zenith(175.0));
    // checked against: Falchi et al. 2016, Science Advances 2, e1600377: natural zenith between the stars V 22; here starlight too
    assert!((21.75..22.0).contains(&zenith(Airglow::MEAN_SOLAR_FLUX_SFU)), "{}", zenith(Airglow::MEAN_SOLAR_FLUX_SFU));
}

#[test]
fn the_natural_shares_are_the_published_ones() {
    // checked against: Leinert et al. 1998 and Benn & Ellison 1998: zodiacal light at the ecliptic pole 60 S10(V)
    let zodiacal = ZodiacalLight::new(DVec3::X).luminance(ecliptic_pole()) / S10_LUMINANCE;
    assert!((zodiacal - 60.0).abs() < 6.0, "{zodiacal}");
    let gegenschein = ZodiacalLight::new(DVec3::X).luminance(-DVec3::X) / S10_LUMINANCE;
    assert!((gegenschein / zodiacal - 230.0 / 77.0).abs() < 1e-6, "{gegenschein}");
}

#[test]
fn scalars_and_spectra_make_radiance() {
    let wavelengths = [420.0, 557.0, 640.0];
    let light = ZodiacalLight::new(DVec3::X);
    let direction = unit_vector(50.0, 10.0);
    let [near, far] = light.scalars(direction);
    let [red, blue] = light.spectra(&wavelengths);
    for (k, radiance) in light.radiance(direction, &wavelengths).into_iter().enumerate() {
        assert!((radiance - near * red[k] - far * blue[k]).abs() < 1e-18);
    }
}
