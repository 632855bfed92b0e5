//! Refraction in the air of a sky. Tracing it takes as long as a preview, and a sky that follows a clock or a place on a map at one height asks for
//! the same again and again: the last few are kept.

use super::atmosphere::Atmosphere;
use crate::atmosphere::{StandardAtmosphere, molecules};
use crate::ephemeris::Refraction;
use std::sync::{Arc, Mutex, PoisonError};

/// Wavelength for which refraction is traced: near the peak of daylight vision [nm].
const REFRACTION_NM: f64 = 550.0;

/// How many are kept, the latest.
const KEPT: usize = 8;

/// All that refraction depends on: temperatures and pressures, radius of the planet [m], elevation of the observer [m].
type Key = (StandardAtmosphere, u64, u64);

/// The latest of all skies.
static LATEST: Latest = Latest(Mutex::new(Vec::new()));

/// Refraction in the air of a preset, seen from `elevation_m`; a profile says nothing of refraction, so its air has none.
pub(super) fn refraction(atmosphere: &Atmosphere, elevation_m: f64) -> Arc<Refraction> {
    let air = atmosphere.parameters().and_then(|parameters| parameters.resolve().ok());
    let Some(air) = air else { return Arc::new(Refraction::none()) };
    LATEST.refraction(air.standard_atmosphere, 1000.0 * atmosphere.profile().planet_radius_km, elevation_m)
}

/// Traced refraction, the latest first.
struct Latest(Mutex<Vec<(Key, Arc<Refraction>)>>);

impl Latest {
    fn refraction(&self, air: StandardAtmosphere, radius_m: f64, elevation_m: f64) -> Arc<Refraction> {
        let key = (air, radius_m.to_bits(), elevation_m.to_bits());
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, kept)) = lock().iter().find(|(kept, _)| *kept == key) {
            return kept.clone();
        }
        let refractivity = |altitude_m| molecules::refractivity_in(air, altitude_m, REFRACTION_NM);
        let traced = Arc::new(Refraction::new(refractivity, radius_m, elevation_m));
        let mut latest = lock();
        latest.insert(0, (key, traced.clone()));
        latest.truncate(KEPT);
        traced
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_is_traced_once_another_height_or_air_is_not_the_same_and_few_are_kept() {
        let (air, radius_m) = (StandardAtmosphere::default(), 6_371_000.0);
        let latest = Latest(Mutex::new(Vec::new()));
        let low = latest.refraction(air, radius_m, 10.0);
        assert!(Arc::ptr_eq(&low, &latest.refraction(air, radius_m, 10.0)));
        let high = latest.refraction(air, radius_m, 3000.0);
        assert!(high.horizon_deg() < low.horizon_deg() - 1.0, "{} {}", high.horizon_deg(), low.horizon_deg());
        let cold = latest.refraction("subarctic_winter".parse().unwrap(), radius_m, 10.0);
        assert!(cold.apparent_altitude_deg(0.0) > low.apparent_altitude_deg(0.0) + 0.02, "cold air is dense and bends more");
        for step in 0..KEPT {
            latest.refraction(air, radius_m, 100.0 + step as f64);
        }
        assert_eq!(latest.0.lock().unwrap().len(), KEPT);
        assert!(!Arc::ptr_eq(&low, &latest.refraction(air, radius_m, 10.0)));
    }
}
