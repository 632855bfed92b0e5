//! Zodiacal light and gegenschein: sunlight scattered by interplanetary dust.
//!
//! L = I(|lambda - lambda_sun|, |beta|) E_sun(lambda) / E_sun(500 nm) f_co(epsilon, lambda),
//! f_co = 1 + c(epsilon) log10(lambda / 500 nm),
//!
//! I: radiance at 500 nm, Leinert et al. 1998 (A&AS 127, 1), table 17, bilinear in ecliptic longitude from the Sun and latitude.
//! f_co: reddening, of the same source: c = 1.2 below 500 nm and 0.8 above it at elongation epsilon <= 30 degrees, 0.9 and 0.6 from 90
//! degrees on, linear between. So the light has two parts of fixed spectrum (30 and 90 degrees), which share I.
//!
//! Within 30 degrees of the Sun in both coordinates the ratio of the table to a power law is interpolated instead of the table
//! itself, and where the table is empty (within 10 degrees of the Sun) the power law stands alone: I = I(15, 0) (e / 15
//! degrees)^-2.1, e = (|dlambda|^1.55 + (1.856 |beta|)^1.55)^(1/1.55); it fits five nodes around the gap within 3 %.
//! Nearer than the Sun's limb e is kept at 0.27 degrees. The inner light is the F corona: with a corona drawn, take one of the
//! two ([`ZodiacalLight::beyond`]).
//!
//! The table is an annual mean at 1 au; the tilt of the dust's plane of symmetry changes the light by up to 10 % in the course of
//! the year.

use super::diffuse::DiffuseLight;
use crate::ephemeris::icrs_to_ecliptic_j2000;
use crate::numerics::locate;
use crate::spectrum::binned::columns;
use crate::spectrum::solar;
use glam::{DMat3, DVec3};
use std::sync::LazyLock;

const LATITUDES_DEG: [f64; 11] = [0.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 45.0, 60.0, 75.0, 90.0];

/// Unit of the table [W m-2 sr-1 nm-1]: 1e-8 W m-2 sr-1 um-1.
const TABLE_UNIT: f64 = 1e-11;

/// Extent of the region near the Sun where ratios to the power law are interpolated [degrees].
const INNER_DEG: f64 = 30.0;

struct Table {
    longitudes_deg: Vec<f64>,
    /// By longitude, then latitude; 0 where there is no value.
    values: Vec<[f64; 11]>,
}

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    let cells: [Vec<f64>; 12] = columns(include_str!("../../data/zodiacal_light.csv"));
    let values = (0..cells[0].len()).map(|row| std::array::from_fn(|column| cells[column + 1][row])).collect();
    Table { longitudes_deg: cells[0].clone(), values }
});

/// The power law of the inner zodiacal light [unit of the table] at longitude from the Sun and latitude [degrees].
fn power_law(longitude_deg: f64, latitude_deg: f64) -> f64 {
    let elongation = (longitude_deg.powf(1.55) + (1.856 * latitude_deg).powf(1.55)).powf(1.0 / 1.55);
    11_500.0 * (elongation.max(0.27) / 15.0).powf(-2.1)
}

/// Radiance at 500 nm at longitude from the Sun 0 to 180 and latitude 0 to 90 [degrees]; W m-2 sr-1 nm-1.
fn radiance_500(longitude_deg: f64, latitude_deg: f64) -> f64 {
    let table = &*TABLE;
    let (row, a) = locate(&table.longitudes_deg, longitude_deg);
    let (column, b) = locate(&LATITUDES_DEG, latitude_deg);
    let inner = longitude_deg < INNER_DEG && latitude_deg < INNER_DEG;
    let node = |i: usize, j: usize| {
        let value = table.values[i][j];
        if !inner {
            value
        } else if value > 0.0 {
            value / power_law(table.longitudes_deg[i], LATITUDES_DEG[j])
        } else {
            1.0
        }
    };
    let low = node(row, column) * (1.0 - b) + node(row, column + 1) * b;
    let high = node(row + 1, column) * (1.0 - b) + node(row + 1, column + 1) * b;
    let value = low * (1.0 - a) + high * a;
    TABLE_UNIT * if inner { value * power_law(longitude_deg, latitude_deg) } else { value }
}

/// The zodiacal light of the sky with the Sun in a given direction. Scalars: radiance at 500 nm of the part reddened as at 30
/// degrees from the Sun and of the part as at 90 degrees [W m-2 sr-1 nm-1]. Directions are ICRS.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZodiacalLight {
    sun: DVec3,
    sun_longitude_rad: f64,
    to_ecliptic: DMat3,
    /// Elongation within which there is nothing [radians].
    inner: f64,
}

impl ZodiacalLight {
    /// With the Sun in the direction `sun`: ICRS unit vector, as seen from the Earth.
    pub fn new(sun: DVec3) -> Self {
        let to_ecliptic = icrs_to_ecliptic_j2000();
        let ecliptic = to_ecliptic * sun;
        Self { sun, sun_longitude_rad: ecliptic.y.atan2(ecliptic.x), to_ecliptic, inner: 0.0 }
    }

    /// The same without the light within `elongation` of the Sun's centre [radians].
    pub fn beyond(self, elongation: f64) -> Self {
        Self { inner: elongation, ..self }
    }

    /// Radiance at 500 nm from `direction` (ICRS unit vector) [W m-2 sr-1 nm-1].
    pub fn radiance_500(&self, direction: DVec3) -> f64 {
        let ecliptic = self.to_ecliptic * direction;
        let latitude = ecliptic.z.clamp(-1.0, 1.0).asin().abs().to_degrees();
        let difference = (ecliptic.y.atan2(ecliptic.x) - self.sun_longitude_rad).to_degrees().abs();
        radiance_500(if difference > 180.0 { 360.0 - difference } else { difference }, latitude)
    }
}

impl DiffuseLight<2> for ZodiacalLight {
    fn spectra(&self, wavelengths_nm: &[f64]) -> [Vec<f64>; 2] {
        let reference = solar::irradiance(500.0, solar::BAND_WIDTH_NM);
        [(1.2, 0.8), (0.9, 0.6)].map(|(blue, red)| {
            wavelengths_nm
                .iter()
                .map(|&wavelength| {
                    let slope = if wavelength < 500.0 { blue } else { red };
                    let reddening = 1.0 + slope * (wavelength / 500.0).log10();
                    solar::irradiance(wavelength, solar::BAND_WIDTH_NM) / reference * reddening
                })
                .collect()
        })
    }

    fn scalars(&self, direction: DVec3) -> [f64; 2] {
        let elongation = direction.dot(self.sun).clamp(-1.0, 1.0).acos();
        if elongation < self.inner {
            return [0.0; 2];
        }
        let value = self.radiance_500(direction);
        let far = ((elongation.to_degrees() - 30.0) / 60.0).clamp(0.0, 1.0);
        [value * (1.0 - far), value * far]
    }
}

#[cfg(test)]
mod tests {
    use super::super::photometry::surface_brightness_of_luminance;
    use super::*;

    /// ICRS direction at ecliptic longitude and latitude [degrees].
    fn icrs(longitude_deg: f64, latitude_deg: f64) -> DVec3 {
        let ecliptic = crate::ephemeris::direction_from_longitude_latitude(longitude_deg, latitude_deg);
        DVec3::new(
            ecliptic.dot(icrs_to_ecliptic_j2000() * DVec3::X),
            ecliptic.dot(icrs_to_ecliptic_j2000() * DVec3::Y),
            ecliptic.dot(icrs_to_ecliptic_j2000() * DVec3::Z),
        )
    }

    #[test]
    fn nodes_are_the_table() {
        let light = ZodiacalLight::new(icrs(100.0, 0.0));
        let table = &*TABLE;
        for (row, &longitude) in table.longitudes_deg.iter().enumerate() {
            for (column, &latitude) in LATITUDES_DEG.iter().enumerate() {
                let expected = table.values[row][column] * TABLE_UNIT;
                for (sign, pole) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)] {
                    let got = light.radiance_500(icrs(100.0 + sign * longitude, pole * latitude));
                    assert!(expected == 0.0 || (got / expected - 1.0).abs() < 1e-6, "{longitude} {latitude}: {got}");
                    assert!(got > 0.0 && got.is_finite());
                }
            }
        }
        // checked against: Leinert et al. 1998, table 17: gegenschein 230, pole 77 (copies that say 60 are wrong)
        assert!((light.radiance_500(icrs(280.0, 0.0)) - 230e-11).abs() < 1e-16);
        assert!((light.radiance_500(icrs(0.0, 90.0)) - 77e-11).abs() < 1e-16);
    }

    #[test]
    fn the_power_law_continues_the_table() {
        let innermost =
            [(0.0, 15.0, 3140.0), (5.0, 15.0, 2940.0), (10.0, 10.0, 4740.0), (15.0, 0.0, 11_500.0), (15.0, 5.0, 6780.0)];
        for (longitude, latitude, expected) in innermost {
            assert!((power_law(longitude, latitude) / expected - 1.0).abs() < 0.03, "{longitude} {latitude}");
        }
        let steps = |latitude: f64, from: f64| (radiance_500(from - 1e-6, latitude), radiance_500(from + 1e-6, latitude));
        for i in 0..=30 {
            let (inside, outside) = steps(f64::from(i), INNER_DEG);
            assert!((inside / outside - 1.0).abs() < 0.025, "{i}: {inside} {outside}");
        }
        assert!(radiance_500(0.0, 0.0).is_finite() && radiance_500(0.0, 0.0) > radiance_500(0.5, 0.0));
    }

    #[test]
    fn light_is_redder_than_the_sun_and_more_so_near_it() {
        let light = ZodiacalLight::new(icrs(0.0, 0.0));
        let colour = |longitude: f64| {
            let radiance = light.radiance(icrs(longitude, 0.0), &[440.0, 640.0]);
            radiance[1] / radiance[0] * solar::irradiance(440.0, 10.0) / solar::irradiance(640.0, 10.0)
        };
        let expected = |blue: f64, red: f64| (1.0 + red * 1.28f64.log10()) / (1.0 + blue * 0.88f64.log10());
        assert!((colour(20.0) - expected(1.2, 0.8)).abs() < 1e-9 && (colour(150.0) - expected(0.9, 0.6)).abs() < 1e-9);
        assert!((colour(60.0) - 0.5 * (expected(1.2, 0.8) + expected(0.9, 0.6))).abs() < 2e-3);
    }

    #[test]
    fn the_corona_goes_over_into_it() {
        let sun = icrs(100.0, 0.0);
        let reach = super::super::corona::REACH * 0.2666_f64.to_radians();
        let light = ZodiacalLight::new(sun).beyond(reach);
        let at = |share: f64| light.scalars(icrs(100.0 + share * reach.to_degrees(), 0.0));
        assert_eq!(at(0.99), [0.0; 2]);
        assert!(at(1.01)[0] > 0.0);
        // The Sun's disc: its irradiance over its solid angle.
        let disc = solar::irradiance(500.0, 10.0) / (std::f64::consts::PI * 0.2666_f64.to_radians().powi(2));
        let ratio = at(1.001)[0] / (disc * super::super::corona::relative_radiance(super::super::corona::REACH));
        println!("zodiacal light over corona where they meet: {ratio:.2}");
        assert!((0.6..1.6).contains(&ratio), "{ratio}");
    }

    #[test]
    fn the_pole_has_its_visual_brightness() {
        let pole = surface_brightness_of_luminance(ZodiacalLight::new(DVec3::X).luminance(icrs(0.0, 90.0)));
        // checked against: Leinert et al. 1998: 60 S10(V) at the ecliptic pole = 23.33 mag per square arcsecond
        assert!((pole - 23.33).abs() < 0.1, "{pole}");
    }
}
