//! From XYZ to the colour space and scale that a probe is asked for.

use super::settings::ProbeSettings;
use crate::spectrum::color_space::{ColorSpace, Gamut};

/// The matrix and the rule for colours that it takes out of the gamut.
pub(super) struct Conversion {
    matrix: [[f32; 3]; 3],
    gamut: Gamut,
    luminance_weights: [f64; 3],
}

impl Conversion {
    /// What `settings` ask for.
    pub fn new(settings: &ProbeSettings) -> Self {
        let factor = settings.scale.factor();
        let matrix = settings.color_space.matrix_from_xyz().map(|row| row.map(|value| value * factor));
        Self {
            matrix: matrix.map(|row| row.map(|value| value as f32)),
            gamut: if settings.color_space == ColorSpace::Xyz { Gamut::Keep } else { settings.gamut },
            luminance_weights: settings.color_space.matrix_to_xyz()[1],
        }
    }

    /// Converts a row in place.
    pub fn apply(&self, row: &mut [[f32; 3]]) {
        let m = &self.matrix;
        for pixel in row {
            let [x, y, z] = *pixel;
            let rgb = [0, 1, 2].map(|k: usize| m[k][0] * x + m[k][1] * y + m[k][2] * z);
            let inside = rgb[0].min(rgb[1]).min(rgb[2]) >= 0.0 || self.gamut == Gamut::Keep;
            *pixel = if inside { rgb } else { self.outside(rgb) };
        }
    }

    fn outside(&self, rgb: [f32; 3]) -> [f32; 3] {
        self.gamut.apply(rgb.map(f64::from), self.luminance_weights).map(|value| value as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_those_of_the_exact_matrix_inside_and_outside_the_gamut() {
        let settings = ProbeSettings::default();
        let conversion = Conversion::new(&settings);
        let mut row = [[3.0, 3.1, 3.5], [0.02, 0.05, 0.4], [1e5, 1e5, 9e4], [0.0; 3]];
        let before = row;
        conversion.apply(&mut row);
        for (xyz, rgb) in before.into_iter().zip(row) {
            let expected = settings.color_space.from_xyz(xyz.map(f64::from));
            let expected = settings.gamut.apply(expected, settings.color_space.matrix_to_xyz()[1]);
            for (got, expected) in rgb.into_iter().zip(expected) {
                assert!((f64::from(got) - expected).abs() <= 1e-6 * f64::from(xyz[1]), "{xyz:?}: {rgb:?}");
            }
        }
        assert!(row[1].iter().all(|&value| value >= 0.0) && row[1].contains(&0.0));
    }
}
