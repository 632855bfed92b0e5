//! From radiances at a few wavelengths to XYZ, with the source's fine structure integrated beforehand.
//!
//! XYZ = integral of f(lambda) E(lambda) cmf(lambda) d lambda = sum over i of f(lambda_i) w_i,
//! w_i = integral of C_i(lambda) E(lambda) cmf(lambda) d lambda,
//!
//! where f is the radiance per unit irradiance of the source [sr-1] (smooth: the air's scattering and absorption), E the source's
//! irradiance [W m-2 nm-1] with all its lines, cmf the CIE 1931 colour matching functions and C_i the cardinal functions of the
//! cubic spline on the nodes lambda_i. The weights cost nothing at run time. Any other three responses than cmf do as well: see [`Sensor`].

use super::{observer, solar};
use crate::numerics::spline::cardinal_functions;
use std::collections::BTreeSet;

/// The weights w_i of the module's equation for the nodes `wavelengths_nm` [nm] (ascending, at least one) and the irradiance
/// `source` of a light source [W m-2 nm-1], given as means over 1 nm by wavelength.
///
/// Returns one X, Y, Z triple a node; the sum of f times them is in W m-2 sr-1 (scale `blender`: times 683 is luminance). With
/// `|_| 1.0` as source the weights apply to spectral radiance itself.
///
/// # Panics
/// If there are no wavelengths.
pub fn xyz_weights(wavelengths_nm: &[f64], source: impl Fn(f64) -> f64) -> Vec<[f64; 3]> {
    Sensor::xyz(wavelengths_nm).of(source)
}

/// Three responses to light of any spectrum, for values that are known at fixed nodes only: X, Y and Z of the standard observer, or bands at three wavelengths. It holds
/// C_i(lambda) r(lambda) of the module's equation with the responses r in place of cmf: what the weights of all sources have in common.
#[derive(Clone, Debug)]
pub struct Sensor {
    /// Wavelengths at which a source is asked for [nm].
    nanometres: Vec<f64>,
    /// (node, nanometre, response).
    products: Vec<Vec<[f64; 3]>>,
}

impl Sensor {
    /// X, Y and Z of values at the nodes `wavelengths_nm` [nm] (ascending, at least one).
    ///
    /// # Panics
    /// If there are no wavelengths.
    pub fn xyz(wavelengths_nm: &[f64]) -> Self {
        let fine: Vec<f64> = whole_nanometres().collect();
        let matching: Vec<[f64; 3]> = fine.iter().map(|&wavelength| observer::matching_functions(wavelength)).collect();
        let product =
            |cardinal: Vec<f64>| cardinal.iter().zip(&matching).map(|(share, cmf)| cmf.map(|value| value * share)).collect();
        Self { products: cardinal_functions(wavelengths_nm, &fine).into_iter().map(product).collect(), nanometres: fine }
    }

    /// Spectral values at `bands_nm`, three a sensor, the last ones filled up with the last band: f at the middle of each band times the mean of the source over
    /// [`solar::BAND_WIDTH_NM`] around it, as far as the table of the Sun's spectrum reaches. For values at the nodes `wavelengths_nm` [nm] (ascending, at least one).
    ///
    /// # Panics
    /// If there are no wavelengths.
    pub fn bands(wavelengths_nm: &[f64], bands_nm: &[f64]) -> Vec<Self> {
        let cardinal = cardinal_functions(wavelengths_nm, bands_nm);
        let of_three = |(three, bands): (usize, &[f64])| {
            let band = |k: usize| k.min(bands.len() - 1);
            let nanometres = nanometres_around(bands);
            let responses: [Vec<f64>; 3] = std::array::from_fn(|k| band_response(bands[band(k)], &nanometres));
            let product = |shares: &Vec<f64>| {
                let at = |n: usize| std::array::from_fn(|k| shares[3 * three + band(k)] * responses[k][n]);
                (0..nanometres.len()).map(at).collect()
            };
            Self { products: cardinal.iter().map(product).collect(), nanometres }
        };
        bands_nm.chunks(3).enumerate().map(of_three).collect()
    }

    /// Wavelengths at which a source is asked for: ascending whole nanometres, which may have gaps [nm].
    pub fn nanometres(&self) -> &[f64] {
        &self.nanometres
    }

    /// The weights for the irradiance `source`, as [`xyz_weights`] gives them.
    pub fn of(&self, source: impl Fn(f64) -> f64) -> Vec<[f64; 3]> {
        self.of_means(&self.nanometres.iter().map(|&nanometre| source(nanometre)).collect::<Vec<_>>())
    }

    /// The same for a source given by its means over 1 nm at [`Self::nanometres`].
    pub fn of_means(&self, source: &[f64]) -> Vec<[f64; 3]> {
        let node = |products: &Vec<[f64; 3]>| {
            let mut sums = [0.0; 3];
            for (product, value) in products.iter().zip(source) {
                (0..3).for_each(|k| sums[k] += product[k] * value);
            }
            sums
        };
        self.products.iter().map(node).collect()
    }

    /// The responses to `source` itself: the sum of its weights, as the cardinal functions add up to 1.
    pub fn response(&self, source: impl Fn(f64) -> f64) -> [f64; 3] {
        self.of(source).into_iter().fold([0.0; 3], |sum, weight| std::array::from_fn(|k| sum[k] + weight[k]))
    }
}

/// Whole nanometres that touch the bands around `bands_nm`, and on each side two more, to which a line between the bands may go.
fn nanometres_around(bands_nm: &[f64]) -> Vec<f64> {
    let half = 0.5 * solar::BAND_WIDTH_NM;
    let around = |band: &f64| (band - half).round() as i64 - 2..=(band + half).round() as i64 + 2;
    bands_nm.iter().flat_map(around).collect::<BTreeSet<i64>>().into_iter().map(|nanometre| nanometre as f64).collect()
}

/// Shares of the band around `band_nm` that lie within 0.5 nm of each of `nanometres`; of a band that reaches beyond the Sun's spectrum, of its part within.
fn band_response(band_nm: f64, nanometres: &[f64]) -> Vec<f64> {
    let half = 0.5 * solar::BAND_WIDTH_NM;
    let (mut low, mut high) = (band_nm - half, band_nm + half);
    let (first, last) = solar::range_nm();
    if low < last && high > first {
        (low, high) = (low.max(first), high.min(last));
    }
    let share = |&nanometre: &f64| ((nanometre + 0.5).min(high) - (nanometre - 0.5).max(low)).max(0.0) / (high - low);
    nanometres.iter().map(share).collect()
}

fn whole_nanometres() -> impl Iterator<Item = f64> {
    (observer::RANGE_NM.0..=observer::RANGE_NM.1).map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::{molecules, ozone};
    use crate::spectrum::{solar, wavelengths};

    fn sun(wavelength: f64) -> f64 {
        solar::irradiance(wavelength, 1.0)
    }

    fn tristimulus(weights: &[[f64; 3]], f: impl Fn(usize) -> f64) -> [f64; 3] {
        std::array::from_fn(|c| weights.iter().enumerate().map(|(i, w)| w[c] * f(i)).sum())
    }

    #[test]
    fn a_flat_reflectance_gives_the_colour_of_the_source_for_any_number_of_nodes() {
        let exact: [f64; 3] =
            std::array::from_fn(|c| (360..=830).map(|w| sun(w.into()) * observer::matching_functions(w.into())[c]).sum());
        for nodes in [vec![550.0], vec![450.0, 600.0], vec![450.0, 550.0, 650.0], wavelengths(16), wavelengths(32)] {
            let flat = tristimulus(&xyz_weights(&nodes, sun), |_| 1.0);
            (0..3).for_each(|c| assert!((flat[c] / exact[c] - 1.0).abs() < 1e-12, "{} nodes", nodes.len()));
        }
    }

    #[test]
    fn bands_are_means_of_the_source_times_values_at_their_middle() {
        let (nodes, asked) = (wavelengths(16), [523.7, 440.0, 700.0, 400.0]);
        let sensors = Sensor::bands(&nodes, &asked);
        assert_eq!(sensors.len(), 2);
        let smooth = |wavelength: f64| 1.0 + 0.3 * (wavelength / 70.0).sin();
        for (k, &band) in asked.iter().enumerate() {
            let sensor = &sensors[k / 3];
            let expected = solar::irradiance(band, solar::BAND_WIDTH_NM);
            assert!((sensor.response(sun)[k % 3] / expected - 1.0).abs() < 1e-12, "{band}");
            let seen = tristimulus(&sensor.of(sun), |i| smooth(nodes[i]))[k % 3];
            assert!((seen / (expected * smooth(band)) - 1.0).abs() < 1e-4, "{band}");
        }
        assert_eq!(sensors[1].response(sun)[0], sensors[1].response(sun)[2]);
        // At the ends of the Sun's spectrum its mean is that of what there is.
        for end in [300.0, 998.0] {
            let sensor = &Sensor::bands(&[300.0, 1000.0], &[end])[0];
            assert!((sensor.response(sun)[0] / solar::irradiance(end, 10.0) - 1.0).abs() < 1e-12, "{end}");
            assert!((sensor.response(|_| 1.0)[0] - 1.0).abs() < 1e-12);
        }
        assert!((Sensor::bands(&[2000.0], &[2000.0])[0].response(|_| 1.0)[1] - 1.0).abs() < 1e-12);
    }

    /// Largest relative error of X, Y, Z for light through and from a clear sky at air masses 1, 10 and 38, against 1 nm steps.
    fn largest_error(nodes: &[f64]) -> f64 {
        let weights = xyz_weights(nodes, sun);
        let width = ozone::band_width(nodes);
        let radiance = |mass: f64, scattered: bool, wavelength: f64, ozone_width: f64| {
            let air = molecules::sea_level_optical_depth(wavelength);
            let ozone = ozone::cross_section_cm2(wavelength, ozone_width) * 300.0 * ozone::MOLECULES_PER_CM2_IN_DOBSON_UNIT;
            if scattered { (1.0 - (-air).exp()) * (-mass * (0.5 * air + ozone)).exp() } else { (-mass * (air + ozone)).exp() }
        };
        let mut largest: f64 = 0.0;
        for mass in [1.0, 10.0, 38.0] {
            for scattered in [false, true] {
                let got = tristimulus(&weights, |i| radiance(mass, scattered, nodes[i], width[i]));
                for (c, &got) in got.iter().enumerate() {
                    let exact: f64 = (360..=830)
                        .map(f64::from)
                        .map(|w| radiance(mass, scattered, w, 1.0) * sun(w) * observer::matching_functions(w)[c])
                        .sum();
                    largest = largest.max((got / exact - 1.0).abs());
                }
            }
        }
        largest
    }

    #[test]
    fn a_few_dozen_wavelengths_are_enough() {
        let errors = [16, 32, 48, 96].map(|count| largest_error(&wavelengths(count)));
        for (error, allowed) in errors.into_iter().zip([4e-3, 1e-3, 5e-4, 1.5e-4]) {
            assert!(error < allowed, "{errors:?}");
        }
    }
}
