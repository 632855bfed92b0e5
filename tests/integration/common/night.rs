//! Skies of the night for the integration tests.

use super::reference_air;
use glam::DVec3;
use skyprobe::atmosphere::AirParameters;
use skyprobe::ephemeris::{Place, SunModel};
use skyprobe::probe::{ProbeSettings, render};
use skyprobe::progress::Progress;
use skyprobe::quality::Quality;
use skyprobe::sky::{Atmosphere, Layers, LightOptions, Sky, SkyLight};
use skyprobe::spectrum::{ColorSpace, solar, wavelengths};
use skyprobe::time::{Time, ZoneChoice};
use skyprobe::units::LUMINOUS_EFFICACY;
use std::sync::{Arc, LazyLock};

/// Clear air; one solve serves all tests.
pub static AIR: LazyLock<Arc<Atmosphere>> =
    LazyLock::new(|| Arc::new(Atmosphere::new(&AirParameters::default(), Quality::Draft, true).unwrap()));

/// No air, a black ground, no refraction.
pub static NO_AIR: LazyLock<Arc<Atmosphere>> = LazyLock::new(|| {
    let mut profile = reference_air(0.0, 0.0, 0.0, 0.0);
    profile.wavelengths_nm = wavelengths(32);
    for component in &mut profile.components {
        for values in [&mut component.scattering_per_km, &mut component.absorption_per_km] {
            *values = vec![0.0; values.len() * 32];
        }
    }
    if let Some(skyprobe::atmosphere::Phase::Rayleigh { depolarisation }) = &mut profile.components[0].phase {
        *depolarisation = vec![0.0; 32];
    }
    profile.ground_albedo = vec![0.0; 32];
    profile.solar_irradiance = solar::band_means(&profile.wavelengths_nm);
    Arc::new(Atmosphere::from_profile(profile, Quality::Draft, true).unwrap())
});

pub fn place(latitude: f64, longitude: f64, elevation: f64) -> Place {
    Place::new(latitude, longitude, elevation).unwrap()
}

pub fn time(text: &str) -> Time {
    Time::parse(text, ZoneChoice::InText).unwrap()
}

/// The sky of clear air.
pub fn sky(latitude: f64, longitude: f64, elevation: f64, when: &str) -> Sky {
    Sky::new(place(latitude, longitude, elevation), time(when), SunModel::Iau, AIR.clone()).unwrap()
}

pub fn light(sky: &Sky) -> Layers {
    sky.light_by(&LightOptions::default(), &Progress::silent()).unwrap()
}

/// Illuminance of the horizontal plane by a probe of `light` [lx].
pub fn lux_of(light: &dyn SkyLight) -> f64 {
    let settings = ProbeSettings { width: 512, color_space: ColorSpace::Xyz, ..Default::default() };
    LUMINOUS_EFFICACY * render(light, &settings, &Progress::silent()).unwrap().irradiance(DVec3::Z)[1]
}
