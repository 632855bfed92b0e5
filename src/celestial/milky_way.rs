//! The Milky Way: the light of the stars that are too faint to be drawn, and of the dust that they light.
//!
//! L = b(direction) (1 + (D - d) / m) F(lambda),
//!
//! b: `data/milky_way.bin`, the light fainter than V 8.5 in S10(V), with mean m = 65.1 over the sphere; D = 34.9 S10(V): mean
//! light of the whole catalogue; d: mean light of the stars drawn, V <= limit. So drawn stars and map together always average 100
//! S10(V) (integrated starlight and diffuse galactic light: Leinert et al. 1998, A&AS 127, 1, sections 10 and 11). F: spectrum of
//! 1 S10(V) of the catalogue's own stars of V 7 to 8.5 together (B - V about 0.7).
//!
//! The map's shape is a picture, turned into light by star counts (`data/scripts/milky_way.py`): at 2 degrees the light of the
//! stars of magnitude 8.3 to 9.8 is met within 13 % rms. Structure finer than that and the contrast of single clouds are the
//! picture's; a factor of 1.3 locally is to be expected.

use super::diffuse::DiffuseLight;
use super::photometry::SQUARE_DEGREES_PER_STERADIAN;
use super::star_spectra::{self, StarSpectra};
use super::stars::stars_to;
use crate::error::{Result, check_range};
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

const MAGIC: &[u8; 8] = b"SKYMILKY";

/// Faint end of the drawn catalogue: the map holds what is fainter [V].
const CATALOGUE_LIMIT: f64 = 8.5;

struct Map {
    height: usize,
    width: usize,
    /// By row from north to south; right ascension falls from 90 degrees along a row [S10(V)].
    brightness: Vec<f32>,
    /// Over the sphere [S10(V)].
    mean: f64,
}

static MAP: LazyLock<Map> =
    LazyLock::new(|| read(include_bytes!("../../data/milky_way.bin")).expect("the embedded map is whole"));

/// Spectral radiance of 1 S10(V) at the wavelengths of the table of spectra [W m-2 sr-1 nm-1].
static SPECTRUM: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let spectra = StarSpectra::new(&star_spectra::nodes_nm());
    let mut light = vec![0.0; spectra.row_count()];
    let bright = stars_to(7.0).len();
    for star in &stars_to(CATALOGUE_LIMIT)[bright..] {
        light[spectra.row_of(star.b_minus_v)] += 10f64.powf(-0.4 * star.v_magnitude);
    }
    let unit = 1e-4 * SQUARE_DEGREES_PER_STERADIAN / light.iter().sum::<f64>();
    let mut spectrum = vec![0.0; spectra.row(0).len()];
    for (row, share) in light.iter().enumerate() {
        spectrum.iter_mut().zip(spectra.row(row)).for_each(|(sum, value)| *sum += unit * share * value);
    }
    spectrum
});

/// Layout: magic, height, width (u32), smallest brightness, ratio (f32), then one byte a pixel: smallest times ratio to that
/// power; little endian.
fn read(bytes: &[u8]) -> Option<Map> {
    let (head, codes) = bytes.strip_prefix(MAGIC)?.split_first_chunk::<16>()?;
    let word = |i: usize| [head[4 * i], head[4 * i + 1], head[4 * i + 2], head[4 * i + 3]];
    let (height, width) = (u32::from_le_bytes(word(0)) as usize, u32::from_le_bytes(word(1)) as usize);
    let (smallest, ratio) = (f32::from_le_bytes(word(2)), f32::from_le_bytes(word(3)));
    if codes.len() != height * width || codes.is_empty() {
        return None;
    }
    let brightness: Vec<f32> = codes.iter().map(|&code| smallest * ratio.powi(code.into())).collect();
    let (mut sum, mut weights) = (0.0, 0.0);
    for (row, values) in brightness.chunks_exact(width).enumerate() {
        let weight = ((row as f64 + 0.5) / height as f64 * PI).sin();
        sum += weight * values.iter().map(|&value| f64::from(value)).sum::<f64>();
        weights += weight * width as f64;
    }
    Some(Map { height, width, brightness, mean: sum / weights })
}

impl Map {
    /// Brightness at an ICRS unit vector, bilinear [S10(V)].
    fn brightness(&self, direction: DVec3) -> f64 {
        let y = direction.z.clamp(-1.0, 1.0).acos() / PI * self.height as f64 - 0.5;
        let turn = (0.25 - direction.y.atan2(direction.x) / TAU).rem_euclid(1.0);
        let x = turn * self.width as f64 - 0.5;
        let (row, column) = (y.floor(), x.floor());
        let (b, a) = (y - row, x - column);
        let last = self.height as f64 - 1.0;
        let rows = [row, row + 1.0].map(|row| row.clamp(0.0, last) as usize * self.width);
        let columns = [column, column + 1.0].map(|column| column.rem_euclid(self.width as f64) as usize % self.width);
        let value = |i: usize, j: usize| f64::from(self.brightness[rows[i] + columns[j]]);
        (value(0, 0) * (1.0 - a) + value(0, 1) * a) * (1.0 - b) + (value(1, 0) * (1.0 - a) + value(1, 1) * a) * b
    }
}

/// Mean light over the sphere of the catalogue's stars of V <= `limit` [S10(V)].
pub fn starlight_to(limit: f64) -> f64 {
    let sum: f64 = stars_to(limit).iter().map(|star| 10f64.powf(-0.4 * (star.v_magnitude - 10.0))).sum();
    sum / (4.0 * PI * SQUARE_DEGREES_PER_STERADIAN)
}

/// The diffuse Milky Way beside stars drawn to some magnitude. Scalar: brightness [S10(V)]. Directions are ICRS.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MilkyWay {
    factor: f64,
}

impl MilkyWay {
    /// What is left when the stars of V <= `drawn_limit` (-2, none, to 8.5, all of the catalogue) are drawn one by one.
    ///
    /// # Errors
    /// [`crate::Error::Input`] if the limit is outside its range.
    pub fn new(drawn_limit: f64) -> Result<Self> {
        check_range("star_limit", drawn_limit, -2.0, CATALOGUE_LIMIT, "magnitudes")?;
        let undrawn = starlight_to(CATALOGUE_LIMIT) - starlight_to(drawn_limit);
        Ok(Self { factor: 1.0 + undrawn / MAP.mean })
    }

    /// Mean brightness over the sphere [S10(V)].
    pub fn mean(&self) -> f64 {
        self.factor * MAP.mean
    }
}

impl DiffuseLight<1> for MilkyWay {
    fn spectra(&self, wavelengths_nm: &[f64]) -> [Vec<f64>; 1] {
        [wavelengths_nm.iter().map(|&wavelength| star_spectra::between_nodes(&SPECTRUM, wavelength)).collect()]
    }

    fn scalars(&self, direction: DVec3) -> [f64; 1] {
        [self.factor * MAP.brightness(direction)]
    }
}

#[cfg(test)]
mod tests {
    use super::super::photometry::{S10_LUMINANCE, v_magnitude};
    use super::*;
    use crate::ephemeris::direction_from_longitude_latitude as unit_vector;

    fn at(light: &MilkyWay, ra_deg: f64, dec_deg: f64) -> f64 {
        light.scalars(unit_vector(ra_deg, dec_deg))[0]
    }

    #[test]
    fn drawn_stars_and_map_average_a_hundred() {
        for limit in [-2.0, 4.0, 6.5, 8.0, 8.5] {
            let sum = MilkyWay::new(limit).unwrap().mean() + starlight_to(limit);
            assert!((sum - 100.0).abs() < 0.5, "{limit}: {sum}");
        }
        assert!(MilkyWay::new(9.0).is_err() && MilkyWay::new(f64::NAN).is_err());
    }

    #[test]
    fn poles_and_clouds_have_published_brightness() {
        let light = MilkyWay::new(6.5).unwrap();
        // checked against: Leinert et al. 1998: some 25 to 30 S10(V) at the galactic poles without the naked-eye
        // stars
        for (ra, dec) in [(192.86, 27.13), (12.86, -27.13)] {
            assert!((23.0..31.0).contains(&at(&light, ra, dec)), "{}", at(&light, ra, dec));
        }
        // The star clouds of Sagittarius and Scutum are ten times brighter than the poles.
        assert!(at(&light, 271.0, -29.0) > 250.0 && at(&light, 281.0, -6.3) > 200.0);
        // The galactic anticentre is four to six times fainter.
        assert!((50.0..160.0).contains(&at(&light, 86.4, 28.9)));
    }

    #[test]
    fn the_map_is_not_mirrored() {
        let light = MilkyWay::new(8.5).unwrap();
        // Large and Small Magellanic Cloud against the sky beside them; the Coalsack against Carina.
        assert!(at(&light, 80.9, -69.5) > 1.5 * at(&light, 110.0, -80.0));
        assert!(at(&light, 13.2, -72.8) > 1.3 * at(&light, 346.8, -72.8));
        assert!(at(&light, 161.0, -59.5) > 1.5 * at(&light, 193.0, -63.2));
    }

    #[test]
    fn one_unit_is_a_star_of_tenth_magnitude_per_square_degree() {
        let light = MilkyWay::new(6.5).unwrap();
        let square_degree = |w: f64| light.spectra(&[w])[0][0] / SQUARE_DEGREES_PER_STERADIAN;
        let coarse =
            |w: f64| if w % 10.0 == 0.0 { square_degree(w) } else { 0.5 * (square_degree(w - 5.0) + square_degree(w + 5.0)) };
        let v = v_magnitude(|w| coarse(5.0 * (w / 5.0).round()));
        assert!((v - 10.0).abs() < 0.02, "{v}");
        // The eye's curve is not the V band: some per cent between an A star and this colour.
        let luminance = light.luminance(DVec3::Z) / light.scalars(DVec3::Z)[0];
        assert!((luminance / S10_LUMINANCE - 1.0).abs() < 0.06, "{luminance}");
    }

    #[test]
    fn the_seam_and_the_poles_are_smooth() {
        let light = MilkyWay::new(8.5).unwrap();
        assert!((at(&light, 89.9999, 20.0) / at(&light, 90.0001, 20.0) - 1.0).abs() < 1e-3);
        assert!((at(&light, 10.0, 89.9999) / at(&light, 190.0, 89.9999) - 1.0).abs() < 0.05);
        assert!(read(b"SKYMILKY").is_none());
    }
}
