//! The catalogue: 61 762 stars to V 8.5 with places, motions, magnitudes and colours.
//!
//! `data/stars.bin` holds Hipparcos (places and proper motions: van Leeuwen 2007), V and B - V of the same stars as in
//! d3-celestial, and 22 entries of the Bright Star Catalogue that Hipparcos has not; it is ordered by V, the brightest first.
//! Every entry of the Bright Star Catalogue is in it, alone or in the light of a pair that Hipparcos counts as one. Long-period
//! variables have their mean light.
//!
//! u(t) = normalised u_0 + t (e mu_alpha cos(delta) + n mu_delta), t in years after J2000.0; e, n: east and north at the star.
//! Parallax (at most 0.8 arcseconds), radial velocity and orbits of double stars are left out.

use glam::DVec3;
use std::sync::LazyLock;

const MAGIC: &[u8; 8] = b"SKYSTAR1";
const BYTES_PER_STAR: usize = 16;

/// A star as it shines outside the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Unit vector at J2000.0, ICRS.
    pub place: DVec3,
    /// Motion across the sky [radians per year], ICRS, normal to `place`.
    pub motion: DVec3,
    /// Visual magnitude V.
    pub v_magnitude: f64,
    /// Colour B - V; 0.6 where none is published.
    pub b_minus_v: f64,
}

impl Star {
    /// ICRS unit vector `years` (Julian) after J2000.0.
    pub fn direction(&self, years: f64) -> DVec3 {
        (self.place + self.motion * years).normalize()
    }
}

/// The stars of magnitude V <= `limit`, the brightest first; the catalogue ends at V 8.5 (a few variables are fainter).
pub fn stars_to(limit: f64) -> &'static [Star] {
    &CATALOGUE[..CATALOGUE.partition_point(|star| star.v_magnitude <= limit)]
}

/// The star with a proper name of the IAU's list, for the brightest and Polaris; exact spelling.
pub fn star_named(name: &str) -> Option<&'static Star> {
    let (_, ra_deg, dec_deg) = NAMES.iter().find(|(other, ..)| *other == name)?;
    let (sin_ra, cos_ra) = ra_deg.to_radians().sin_cos();
    let (sin_dec, cos_dec) = dec_deg.to_radians().sin_cos();
    let near = DVec3::new(cos_dec * cos_ra, cos_dec * sin_ra, sin_dec);
    // The brightest star within a tenth of a degree.
    CATALOGUE.iter().find(|star| star.place.dot(near) > 0.1f64.to_radians().cos())
}

/// Name, right ascension and declination, J2000, to a hundredth of a degree (IAU Catalog of Star Names).
const NAMES: [(&str, f64, f64); 22] = [
    ("Sirius", 101.29, -16.72),
    ("Canopus", 95.99, -52.70),
    ("Rigil Kentaurus", 219.90, -60.83),
    ("Arcturus", 213.92, 19.18),
    ("Vega", 279.23, 38.78),
    ("Capella", 79.17, 46.00),
    ("Rigel", 78.63, -8.20),
    ("Procyon", 114.83, 5.22),
    ("Achernar", 24.43, -57.24),
    ("Betelgeuse", 88.79, 7.41),
    ("Hadar", 210.96, -60.37),
    ("Altair", 297.70, 8.87),
    ("Acrux", 186.65, -63.10),
    ("Aldebaran", 68.98, 16.51),
    ("Antares", 247.35, -26.43),
    ("Spica", 201.30, -11.16),
    ("Pollux", 116.33, 28.03),
    ("Fomalhaut", 344.41, -29.62),
    ("Deneb", 310.36, 45.28),
    ("Mimosa", 191.93, -59.69),
    ("Regulus", 152.09, 11.97),
    ("Polaris", 37.95, 89.26),
];

static CATALOGUE: LazyLock<Vec<Star>> =
    LazyLock::new(|| read(include_bytes!("../../data/stars.bin")).expect("the embedded catalogue is whole"));

/// Layout: magic, number of stars (u32), then for each right ascension (u32, 2^32 a turn), declination (i32, 2^31 - 1 a right
/// angle), V and B - V (i16, thousandths), motion in right ascension times cos(declination) and in declination (i16, mas per
/// year); little endian.
fn read(bytes: &[u8]) -> Option<Vec<Star>> {
    let (count, rows) = bytes.strip_prefix(MAGIC)?.split_first_chunk::<4>()?;
    let stars: Vec<Star> = rows.chunks_exact(BYTES_PER_STAR).filter_map(star).collect();
    (stars.len() == u32::from_le_bytes(*count) as usize && rows.len() == stars.len() * BYTES_PER_STAR).then_some(stars)
}

fn star(row: &[u8]) -> Option<Star> {
    let (angles, small) = row.split_at_checked(8)?;
    let (ra, dec) = angles.split_at_checked(4)?;
    let ra = f64::from(u32::from_le_bytes(ra.try_into().ok()?)) / 2f64.powi(32) * std::f64::consts::TAU;
    let dec = f64::from(i32::from_le_bytes(dec.try_into().ok()?)) / f64::from(i32::MAX) * std::f64::consts::FRAC_PI_2;
    let number = |i: usize| f64::from(i16::from_le_bytes([small[2 * i], small[2 * i + 1]]));
    let milliarcsecond = (1.0 / 3.6e6_f64).to_radians();
    let ((sin_ra, cos_ra), (sin_dec, cos_dec)) = (ra.sin_cos(), dec.sin_cos());
    let east = DVec3::new(-sin_ra, cos_ra, 0.0);
    let north = DVec3::new(-sin_dec * cos_ra, -sin_dec * sin_ra, cos_dec);
    Some(Star {
        place: DVec3::new(cos_dec * cos_ra, cos_dec * sin_ra, sin_dec),
        motion: (east * number(2) + north * number(3)) * milliarcsecond,
        v_magnitude: 0.001 * number(0),
        b_minus_v: 0.001 * number(1),
    })
}

#[cfg(test)]
mod tests {
    use super::super::photometry::SQUARE_DEGREES_PER_STERADIAN;
    use super::*;
    use crate::ephemeris::direction_from_longitude_latitude as unit_vector;

    fn light_s10(limit: f64) -> f64 {
        let sum: f64 = stars_to(limit).iter().map(|star| 10f64.powf(-0.4 * (star.v_magnitude - 10.0))).sum();
        sum / (4.0 * std::f64::consts::PI * SQUARE_DEGREES_PER_STERADIAN)
    }

    #[test]
    fn naked_eye_stars_give_the_published_light() {
        // checked against: Bright Star Catalogue, 9110 entries to about V 6.5; Hipparcos: 23 S10(V) on average over the sphere
        assert!((light_s10(6.5) - 23.0).abs() < 2.0, "{}", light_s10(6.5));
        let count = stars_to(6.5).len();
        assert!((8_800..9_110).contains(&count), "{count}");
        // checked against: Allen, Astrophysical Quantities (1973): about 41 000 stars to V 8
        assert!((38_000..44_000).contains(&stars_to(8.0).len()), "{}", stars_to(8.0).len());
    }

    #[test]
    fn stars_are_ordered_and_whole() {
        assert_eq!(CATALOGUE.len(), 61_762);
        assert!(CATALOGUE.windows(2).all(|pair| pair[0].v_magnitude <= pair[1].v_magnitude));
        for star in CATALOGUE.iter() {
            assert!((star.place.length() - 1.0).abs() < 1e-12 && star.motion.dot(star.place).abs() < 1e-15);
            assert!((-0.6..5.8).contains(&star.b_minus_v), "{star:?}");
        }
    }

    #[test]
    fn known_stars_are_where_they_belong() {
        // checked against: SIMBAD (Hipparcos, van Leeuwen 2007), ICRS J2000.0: degrees, V, B - V
        for (name, ra, dec, v, colour) in [
            ("Sirius", 101.287_155, -16.716_116, -1.46, 0.0),
            ("Arcturus", 213.915_300, 19.182_409, -0.05, 1.23),
            ("Polaris", 37.954_561, 89.264_109, 2.02, 0.6),
            ("Vega", 279.234_735, 38.783_689, 0.03, 0.0),
        ] {
            let star = star_named(name).unwrap();
            let separation = (star.place - unit_vector(ra, dec)).length().to_degrees() * 3600.0;
            assert!(separation < 0.1, "{name}: {separation} arcseconds");
            assert!((star.v_magnitude - v).abs() < 0.06 && (star.b_minus_v - colour).abs() < 0.05, "{name}: {star:?}");
        }
        assert!(NAMES.iter().all(|(name, ..)| star_named(name).is_some_and(|star| star.v_magnitude < 2.1)));
        assert!(star_named("Nemesis").is_none());
    }

    #[test]
    fn fast_stars_move() {
        // checked against: SIMBAD, 61 Cygni A: 4164 mas per year east, 3250 north; Arcturus moves 2.279 arcseconds per year
        let arcturus = star_named("Arcturus").unwrap();
        let century = (arcturus.direction(100.0) - arcturus.place).length().to_degrees() * 3600.0;
        assert!((century - 227.9).abs() < 0.2, "{century}");
        let cygni = stars_to(5.5).iter().map(|star| star.motion.length()).fold(0.0, f64::max);
        assert!((cygni.to_degrees() * 3600.0 - 5.28).abs() < 0.03, "{cygni}");
    }

    #[test]
    fn a_damaged_file_is_refused() {
        assert!(read(b"SKYSTAR1\x02\0\0\0").is_none() && read(b"nonsense").is_none());
    }
}
