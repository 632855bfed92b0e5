//! The look of the Academy Color Encoding System, by Stephen Hill's fit of its reference rendering transform (RRT) and the output transform for sRGB. Per channel, in the primaries of the fit.
//!
//! ```text
//! shown = OUTPUT f(INPUT c),   f(v) = (v (v + 0.0245786) - 0.000090537) / (v (0.983729 v + 0.4329510) + 0.238081)
//! ```
//! c the exposed colour in linear Rec. 709. INPUT goes to ACES primaries and desaturates as the RRT does, OUTPUT back. Bright colours fade to white; hues change, as with ACES.
//! It is a fit of ACES 1.0's curve, not ACES: no gamut mapping, no glow, no red modifier. Middle grey 0.18 becomes 0.105; f tends to 1.0165.
//! Numbers: S. Hill in M. Pettineo & D. Neubelt, Baking Lab, ACES.hlsl (2016), MIT licence; the code here is our own.

use super::display::Display;
use crate::spectrum::color_space::{ColorSpace, Matrix, product};

/// From linear Rec. 709 to the primaries of the curve.
const INPUT: Matrix = [[0.597_19, 0.354_58, 0.048_23], [0.076_00, 0.908_34, 0.015_66], [0.028_40, 0.133_83, 0.837_77]];

/// From the primaries of the curve to linear Rec. 709.
const OUTPUT: Matrix = [[1.604_75, -0.531_08, -0.073_67], [-0.102_08, 1.108_13, -0.006_05], [-0.003_27, -0.072_76, 1.076_02]];

/// The operator.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Aces;

impl Aces {
    /// What an exposed colour becomes in the primaries of `display`.
    pub fn colour(&self, display: Display) -> impl Fn([f32; 3]) -> [f32; 3] + Sync + use<> {
        let own = display.chromaticities();
        let rec709 = ColorSpace::LinRec709;
        let input = single(&product(&INPUT, &product(&rec709.matrix_from_xyz(), &own.matrix_to_xyz())));
        let output = single(&product(&product(&own.matrix_from_xyz(), &rec709.matrix_to_xyz()), &OUTPUT));
        move |rgb| {
            let shown = times(&input, rgb).map(fit);
            times(&output, shown).map(|value| value.clamp(0.0, 1.0))
        }
    }
}

/// The curve, 0 for 0. The published one is slightly negative below 0.00325, which the clamp removes.
fn fit(value: f32) -> f32 {
    let upper = value * (value + 0.024_578_6) - 0.000_090_537;
    upper / (value * (0.983_729 * value + 0.432_951) + 0.238_081)
}

fn single(matrix: &Matrix) -> [[f32; 3]; 3] {
    matrix.map(|row| row.map(|value| value as f32))
}

fn times(matrix: &[[f32; 3]; 3], rgb: [f32; 3]) -> [f32; 3] {
    matrix.map(|row| row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_is_shown_as_the_fit_says() {
        let shown = Aces.colour(Display::Srgb);
        // checked against: the published polynomial by hand. v = 0.18: (0.18 x 0.2045786 - 0.000090537) / (0.18 x 0.61002222 + 0.238081) = 0.1055
        // The rows of both matrices add up to 1 within 1e-5.
        for (grey, expected) in [(0.18, 0.105_55), (1.0, 0.619_1), (10.0, 0.973_82)] {
            let got = shown([grey; 3]);
            assert!(got.iter().all(|value| (value - expected).abs() < 2e-4), "{grey}: {got:?}");
        }
        assert_eq!(shown([0.0; 3]), [0.0; 3]);
        assert_eq!(shown([1e15; 3]), [1.0; 3]);
    }

    #[test]
    fn a_wide_screen_shows_the_same_colours() {
        let (narrow, wide) = (Aces.colour(Display::Srgb), Aces.colour(Display::DisplayP3));
        let to_wide = single(&product(
            &Display::DisplayP3.chromaticities().matrix_from_xyz(),
            &Display::Srgb.chromaticities().matrix_to_xyz(),
        ));
        let colour = [0.3, 0.5, 0.9];
        let (a, b) = (times(&to_wide, narrow(colour)), wide(times(&to_wide, colour)));
        (0..3).for_each(|k| assert!((a[k] - b[k]).abs() < 1e-5, "{a:?} {b:?}"));
    }
}
