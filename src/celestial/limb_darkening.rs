//! Limb darkening of the Sun by wavelength.
//!
//! I(mu) / I(1) = sum over k = 0..5 of A_k(lambda) mu^k,
//!
//! mu: cosine of the angle between the surface's normal and the line of sight, sqrt(1 - r^2) at r radii from the disc's centre.
//! Source: Neckel & Labs, Solar Physics 153, 91 (1994), table I (continuum windows between 303 and 1099 nm, here from 374.086 nm).
//! Between its wavelengths the coefficients are linear.

use crate::numerics::locate_by;

/// Wavelength [nm] and A_0 to A_5.
const TABLE: [(f64, [f64; 6]); 22] = [
    (374.086, [0.12579, 0.85402, 0.54601, -1.15048, 0.88928, -0.26462]),
    (390.915, [0.12995, 0.91836, -0.07566, 0.19149, -0.28712, 0.12298]),
    (401.970, [0.12323, 1.08648, -0.43974, 0.45912, -0.32759, 0.09850]),
    (416.319, [0.12814, 1.19947, -0.84407, 1.07201, -0.79537, 0.23982]),
    (427.930, [0.14249, 1.28796, -1.19564, 1.68603, -1.36658, 0.44572]),
    (443.885, [0.16220, 1.24893, -0.92165, 0.89978, -0.50148, 0.11220]),
    (445.125, [0.15248, 1.38517, -1.49615, 1.99886, -1.48155, 0.44119]),
    (457.345, [0.16604, 1.38544, -1.52275, 2.00232, -1.45969, 0.42864]),
    (477.427, [0.19571, 1.30551, -1.25845, 1.50626, -1.05472, 0.30570]),
    (492.905, [0.20924, 1.30798, -1.20411, 1.21505, -0.67196, 0.14381]),
    (519.930, [0.23695, 1.29927, -1.28034, 1.37760, -0.85054, 0.21706]),
    (541.760, [0.26073, 1.27428, -1.30352, 1.47085, -0.96618, 0.26384]),
    (559.950, [0.26892, 1.34319, -1.58427, 1.91271, -1.31350, 0.37295]),
    (579.880, [0.28392, 1.36896, -1.75998, 2.22154, -1.56074, 0.44630]),
    (610.975, [0.30854, 1.36620, -1.83572, 2.33221, -1.63082, 0.45959]),
    (640.970, [0.33644, 1.30590, -1.79238, 2.45040, -1.89979, 0.59943]),
    (669.400, [0.34685, 1.37539, -2.04425, 2.70493, -1.94290, 0.55999]),
    (700.875, [0.37885, 1.25553, -1.70908, 2.19647, -1.59554, 0.47378]),
    (748.710, [0.40627, 1.22842, -1.67877, 2.05535, -1.39972, 0.38845]),
    (811.760, [0.42977, 1.25182, -1.85164, 2.31949, -1.59101, 0.44155]),
    (869.600, [0.45396, 1.25101, -2.02958, 2.75410, -2.02287, 0.59338]),
    (948.850, [0.47855, 1.19813, -1.86296, 2.36939, -1.64367, 0.46056]),
];

/// A_0 to A_5 at `wavelength_nm`; those of the ends outside 374 to 949 nm.
pub fn coefficients(wavelength_nm: f64) -> [f64; 6] {
    let (row, share) = locate_by(&TABLE, |row| row.0, wavelength_nm);
    let (before, after) = (TABLE[row].1, TABLE[row + 1].1);
    std::array::from_fn(|k| before[k] + (after[k] - before[k]) * share)
}

/// I(mu) / I(1) at `wavelength_nm` for `mu` from 0 (limb) to 1 (centre).
pub fn relative_intensity(mu: f64, wavelength_nm: f64) -> f64 {
    coefficients(wavelength_nm).iter().rev().fold(0.0, |sum, a| sum * mu + a)
}

/// Mean of I over the disc / I(1): the integral of 2 mu I(mu) d mu.
pub fn mean_intensity(wavelength_nm: f64) -> f64 {
    coefficients(wavelength_nm).iter().zip(DISC_MEAN_OF_POWERS).map(|(a, mean)| a * mean).sum()
}

/// Mean of mu^k over the disc: 2 / (k + 2).
pub(super) const DISC_MEAN_OF_POWERS: [f64; 6] = [1.0, 2.0 / 3.0, 0.5, 0.4, 1.0 / 3.0, 2.0 / 7.0];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_centre_is_one_and_the_mean_is_the_published_one() {
        // checked against: Neckel & Labs 1994, table I, last column: mean over the disc / centre. With the sums it finds any misprint.
        let published = [
            0.7288, 0.7204, 0.7303, 0.7380, 0.7495, 0.7588, 0.7596, 0.7651, 0.7751, 0.7823, 0.7925, 0.8002, 0.8061, 0.8125,
            0.8221, 0.8290, 0.8360, 0.8434, 0.8524, 0.8621, 0.8701, 0.8773,
        ];
        for ((wavelength, a), mean) in TABLE.into_iter().zip(published) {
            assert!((a.iter().sum::<f64>() - 1.0).abs() < 3e-5, "{wavelength}");
            assert!((mean_intensity(wavelength) - mean).abs() < 2e-4, "{wavelength}: {}", mean_intensity(wavelength));
        }
    }

    #[test]
    fn it_is_near_the_later_closed_formula() {
        // checked against: Neckel, Solar Physics 229, 13 (2005): A_k = a_k0 + a_k1 / lambda + a_k5 / lambda^5, 422.57 to 1100 nm
        for wavelength in [450.0, 500.0, 550.0, 600.0, 650.0, 700.0, 740.0] {
            let inverse: f64 = 1000.0 / wavelength;
            let fifth = inverse.powi(5);
            let mut a = [
                0.75267 - 0.265_577 * inverse,
                0.0,
                -1.89287 + 0.012_582 * fifth,
                2.42234 - 0.017_117 * fifth,
                -1.71150 + 0.011_977 * fifth,
                0.49062 - 0.003_347 * fifth,
            ];
            a[1] = 1.0 - a.iter().sum::<f64>();
            for mu in [0.2_f64, 0.5, 0.8] {
                let formula = a.iter().rev().fold(0.0, |sum, a| sum * mu + a);
                let ours = relative_intensity(mu, wavelength);
                assert!((ours - formula).abs() < 0.012, "{wavelength} nm, mu {mu}: {ours} {formula}");
            }
        }
    }
}
