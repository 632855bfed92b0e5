//! The lenticular halo in colour: the ring of each wavelength where equation 15 puts it, seen by the CIE 1931 observer.
//!
//! ```text
//! h_c(theta) = integral of E(lambda) f3(theta, lambda) m_c(lambda) d lambda / N_c
//! ```
//! with E the Sun's spectrum, m_c the matching functions of channel c, and N_c such that each channel has the integral 1 over the sphere: a white source has a white halo on the
//! whole, with the red outside. A picture knows three numbers of a source's spectrum: each channel of the source makes its channel of the halo, which is right for
//! sunlight and for what moonlight makes of it, and an approximation for coloured lamps. Channels are negative where the ring's colour lies outside the space.

use super::psf::lenticular_halo;
use crate::spectrum::{ColorSpace, observer, solar};
use std::f64::consts::TAU;

/// From this angle on there is no halo [degrees]: the ring of 830 nm has its middle at 4.4.
pub const END_DEG: f64 = 5.5;

const STEP_DEG: f64 = 0.01;

/// The halo by angle.
#[derive(Clone, Debug)]
pub struct Halo {
    table: Vec<[f64; 3]>,
}

impl Halo {
    /// The halo of white light in `space`.
    pub fn new(space: ColorSpace) -> Self {
        let matrix = space.matrix_from_xyz();
        let at = |angle: f64| {
            let mut xyz = [0.0; 3];
            for nm in (observer::RANGE_NM.0..=observer::RANGE_NM.1).map(f64::from) {
                let weight = solar::irradiance(nm, 1.0) * lenticular_halo(angle, nm);
                let functions = observer::matching_functions(nm);
                (0..3).for_each(|i| xyz[i] += weight * functions[i]);
            }
            crate::spectrum::color_space::transform(&matrix, xyz)
        };
        let count = (END_DEG / STEP_DEG).round() as usize;
        let mut table: Vec<[f64; 3]> = (0..=count).map(|k| at(STEP_DEG * k as f64)).collect();
        let mut total = [0.0; 3];
        for (k, value) in table.iter().enumerate() {
            let weight = TAU * STEP_DEG.to_radians() * (STEP_DEG * k as f64).to_radians().sin();
            (0..3).for_each(|c| total[c] += weight * value[c]);
        }
        table.iter_mut().for_each(|value| (0..3).for_each(|c| value[c] /= total[c]));
        Self { table }
    }

    /// The halo at an angle [degrees] by channel [sr-1].
    pub fn at(&self, angle_deg: f64) -> [f64; 3] {
        let position = angle_deg / STEP_DEG;
        let left = position as usize;
        if left + 1 >= self.table.len() {
            return [0.0; 3];
        }
        let part = position - left as f64;
        std::array::from_fn(|c| self.table[left][c] * (1.0 - part) + self.table[left + 1][c] * part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_is_blue_inside_and_red_outside() {
        let halo = Halo::new(ColorSpace::LinRec709);
        let dominant = |angle: f64| (0..3).max_by(|&a, &b| halo.at(angle)[a].total_cmp(&halo.at(angle)[b])).unwrap();
        // Rings of 450, 540 and 640 nm: 3 lambda / 568 degrees.
        assert_eq!([dominant(2.377), dominant(2.852), dominant(3.380)], [2, 1, 0]);
        assert_eq!(halo.at(END_DEG), [0.0; 3]);
        assert!(halo.at(0.5).iter().all(|value| value.abs() < 1e-12));
    }

    #[test]
    fn luminance_stands_where_the_observer_sees_the_suns_light() {
        let halo = Halo::new(ColorSpace::Xyz);
        let sum = |weigh: &dyn Fn(f64) -> f64| -> f64 {
            (0..5500).map(|k| 0.001 * f64::from(k)).map(|angle| weigh(angle) * angle.to_radians().sin() * halo.at(angle)[1]).sum()
        };
        // checked against: mean wavelength of solar irradiance times ybar, 560 nm within 3, so a mean radius of 3 x 560 / 568 and a little more by the ring's own width
        let mean = sum(&|angle| angle) / sum(&|_| 1.0);
        assert!((mean - 2.968).abs() < 0.03, "{mean}");
    }
}
