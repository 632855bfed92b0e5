//! From radiances at a few wavelengths to XYZ, with the source's fine structure integrated beforehand.
//!
//! XYZ = integral of f(lambda) E(lambda) cmf(lambda) d lambda = sum over i of f(lambda_i) w_i,
//! w_i = integral of C_i(lambda) E(lambda) cmf(lambda) d lambda,
//!
//! where f is the radiance per unit irradiance of the source [sr-1] (smooth: the air's scattering and absorption), E the source's
//! irradiance [W m-2 nm-1] with all its lines, cmf the CIE 1931 colour matching functions and C_i the cardinal functions of the
//! cubic spline on the nodes lambda_i. The weights cost nothing at run time.

use super::observer;
use crate::numerics::spline::cardinal_functions;

/// The weights w_i of the module's equation for the nodes `wavelengths_nm` [nm] (ascending, at least one) and the irradiance
/// `source` of a light source [W m-2 nm-1], given as means over 1 nm by wavelength.
///
/// Returns one X, Y, Z triple a node; the sum of f times them is in W m-2 sr-1 (scale `blender`: times 683 is luminance). With
/// `|_| 1.0` as source the weights apply to spectral radiance itself.
///
/// # Panics
/// If there are no wavelengths.
pub fn xyz_weights(wavelengths_nm: &[f64], source: impl Fn(f64) -> f64) -> Vec<[f64; 3]> {
    WeightsOfAnySource::new(wavelengths_nm).of(source)
}

/// C_i(lambda) cmf(lambda) of the module's equation for fixed nodes: what the weights of all sources have in common.
#[derive(Clone, Debug)]
pub struct WeightsOfAnySource {
    /// (node, nanometre, X Y Z).
    products: Vec<Vec<[f64; 3]>>,
}

impl WeightsOfAnySource {
    /// For the nodes `wavelengths_nm` [nm] (ascending, at least one).
    ///
    /// # Panics
    /// If there are no wavelengths.
    pub fn new(wavelengths_nm: &[f64]) -> Self {
        let fine: Vec<f64> = whole_nanometres().collect();
        let matching: Vec<[f64; 3]> = fine.iter().map(|&wavelength| observer::matching_functions(wavelength)).collect();
        let product =
            |cardinal: Vec<f64>| cardinal.iter().zip(&matching).map(|(share, cmf)| cmf.map(|value| value * share)).collect();
        Self { products: cardinal_functions(wavelengths_nm, &fine).into_iter().map(product).collect() }
    }

    /// The weights for the irradiance `source`, as [`xyz_weights`] gives them.
    pub fn of(&self, source: impl Fn(f64) -> f64) -> Vec<[f64; 3]> {
        let source: Vec<f64> = whole_nanometres().map(source).collect();
        let node = |products: &Vec<[f64; 3]>| {
            let mut sums = [0.0; 3];
            for (product, value) in products.iter().zip(&source) {
                (0..3).for_each(|k| sums[k] += product[k] * value);
            }
            sums
        };
        self.products.iter().map(node).collect()
    }
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
