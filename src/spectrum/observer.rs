//! The CIE 1931 standard observer (2 degrees): CIE 018:2019 at 1 nm, 360 to 830 nm.

use super::binned::columns;
use std::sync::LazyLock;

/// First and last wavelength of the observer's table [nm]; the functions are taken as zero outside.
pub const RANGE_NM: (u32, u32) = (360, 830);

static FUNCTIONS: LazyLock<Vec<[f64; 3]>> = LazyLock::new(|| {
    let [_, x, y, z] = columns::<4>(include_str!("../../data/cie1931.csv"));
    x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]).collect()
});

/// The colour matching functions xbar, ybar, zbar at `wavelength_nm`, linear between whole nanometres; dimensionless.
pub fn matching_functions(wavelength_nm: f64) -> [f64; 3] {
    let position = wavelength_nm - f64::from(RANGE_NM.0);
    let last = FUNCTIONS.len() - 1;
    if !(0.0..=last as f64).contains(&position) {
        return [0.0; 3];
    }
    let left = (position as usize).min(last - 1);
    let fraction = position - left as f64;
    std::array::from_fn(|i| FUNCTIONS[left][i] * (1.0 - fraction) + FUNCTIONS[left + 1][i] * fraction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Y_INTEGRAL_NM;

    #[test]
    fn integrals_are_those_of_the_standard() {
        let mut sums = [0.0; 3];
        for wavelength in RANGE_NM.0..=RANGE_NM.1 {
            let functions = matching_functions(wavelength.into());
            (0..3).for_each(|i| sums[i] += functions[i]);
        }
        // checked against: CIE 018:2019, sums at 1 nm 106.865, 106.857, 106.892
        assert!((sums[0] - 106.865).abs() < 5e-3 && (sums[2] - 106.892).abs() < 5e-3, "{sums:?}");
        assert!((sums[1] - Y_INTEGRAL_NM).abs() < 1e-3);
        assert!((matching_functions(555.0)[1] - 1.0).abs() < 1e-12);
        assert_eq!(matching_functions(359.9), [0.0; 3]);
    }
}
