//! Celestial frames: from ICRS to ecliptic and galactic axes.

use glam::{DMat3, DVec3};

/// Mean obliquity of the ecliptic at J2000 [arcseconds]: IAU 2006 (Hilton et al. 2006).
const OBLIQUITY_ARCSECONDS: f64 = 84_381.406;

/// `direction` (ICRS) on the axes of the mean ecliptic and equinox of J2000. The frame bias (0.02 arcseconds) is left out.
pub fn ecliptic_from_icrs(direction: DVec3) -> DVec3 {
    let (sin, cos) = (OBLIQUITY_ARCSECONDS / 3600.0).to_radians().sin_cos();
    DVec3::new(direction.x, cos * direction.y + sin * direction.z, cos * direction.z - sin * direction.y)
}

/// `direction` (ICRS) on galactic axes: x to the galactic centre, z to the north galactic pole.
/// Source: The Hipparcos and Tycho Catalogues, ESA SP-1200 (1997), vol. 1, eq. 1.5.11.
pub fn galactic_from_icrs(direction: DVec3) -> DVec3 {
    const TO_GALACTIC: DMat3 = DMat3::from_cols(
        DVec3::new(-0.054_875_560_4, 0.494_109_427_9, -0.867_666_149_0),
        DVec3::new(-0.873_437_090_2, -0.444_829_630_0, -0.198_076_373_4),
        DVec3::new(-0.483_835_015_5, 0.746_982_244_5, 0.455_983_776_2),
    );
    TO_GALACTIC * direction
}

/// Unit vector of right ascension (or longitude) and declination (or latitude) [degrees].
#[cfg(test)]
pub(super) fn unit_vector(longitude_deg: f64, latitude_deg: f64) -> DVec3 {
    let (sin_l, cos_l) = longitude_deg.to_radians().sin_cos();
    let (sin_b, cos_b) = latitude_deg.to_radians().sin_cos();
    DVec3::new(cos_b * cos_l, cos_b * sin_l, sin_b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn galactic_pole_and_centre_are_where_the_iau_put_them() {
        // checked against: ESA SP-1200, section 1.5.3: pole at 192.85948, +27.12825; node of the galactic plane at l = 32.93192
        let pole = galactic_from_icrs(unit_vector(192.859_48, 27.128_25));
        assert!((pole - DVec3::Z).length() < 1e-9, "{pole}");
        let node = galactic_from_icrs(unit_vector(192.859_48 + 90.0, 0.0));
        assert!((node - unit_vector(32.931_92, 0.0)).length() < 1e-8, "{node}");
    }

    #[test]
    fn the_ecliptic_pole_is_in_draco() {
        let pole = ecliptic_from_icrs(unit_vector(270.0, 90.0 - OBLIQUITY_ARCSECONDS / 3600.0));
        assert!((pole - DVec3::Z).length() < 1e-14);
        assert_eq!(ecliptic_from_icrs(DVec3::X), DVec3::X);
    }
}
