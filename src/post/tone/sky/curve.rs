//! From exposed colours to the screen: straight, then a shoulder with no end.
//!
//! On the largest channel m, with s the end of the straight part and q the power of the shoulder:
//! ```text
//! m <= s:  m
//! m > s:   1 - (1 - s) (1 + (m - s) / (q (1 - s)))^-q
//! ```
//! Value and slope meet at s. Far above, the distance from white falls as m^-q: with q = 0.6 a light of m = 10 is shown at 0.918, one of 100 at 0.979, one of 1000 at 0.995, and only the Sun's disc
//! (a hundred thousand) is the last code of 8 bits. (1 - exp(-m), the thesis's curve, is at it from m = 6 on, a hyperbola from 300 on.)
//!
//! The other channels: with r = (channel / largest)^contrast,
//! ```text
//! shown channel = shown largest (1 - k + k sqrt(r))^2,   k = 1 up to s, ((1 - shown) / (1 - s))^(1/2) above
//! ```
//! Bright colours fade to white, and nothing leaves the gamut. They fade as mixtures with white of the square roots of light: mixtures of light itself keep the dominant wavelength and yet look like another
//! hue (Abney 1909), an orange glow turns pink and a blue one purple. In Oklab (Ottosson 2020), made to know of that, colours of skies keep their hue within 3 degrees this way, and are off by 5 to 14 by
//! mixing light.

use super::Sky;

/// End of the straight part.
pub const STRAIGHT: f32 = 0.4;

/// The curve of a setting.
#[derive(Clone, Copy, Debug)]
pub struct Curve {
    power: f32,
    contrast: f32,
}

impl Curve {
    /// The curve of `sky`.
    pub fn new(sky: &Sky) -> Self {
        Self { power: sky.shoulder as f32, contrast: sky.colour_contrast as f32 }
    }

    /// What the largest channel becomes.
    #[inline]
    pub fn largest(&self, value: f32) -> f32 {
        if value <= STRAIGHT {
            return value;
        }
        let room = 1.0 - STRAIGHT;
        let over = 1.0 + (value - STRAIGHT) / (self.power * room);
        1.0 - room * over.powf(-self.power)
    }

    /// What an exposed colour without negative components becomes.
    #[inline]
    pub fn colour(&self, rgb: [f32; 3]) -> [f32; 3] {
        let largest = rgb[0].max(rgb[1]).max(rgb[2]);
        if largest <= 0.0 {
            return [0.0; 3];
        }
        let shown = self.largest(largest);
        let kept = if shown > STRAIGHT { ((1.0 - shown) / (1.0 - STRAIGHT)).max(0.0).sqrt() } else { 1.0 };
        let power = 0.5 * self.contrast;
        rgb.map(|value| {
            let ratio = value / largest;
            // The largest channel itself needs no power.
            if ratio < 1.0 {
                let root = 1.0 + (ratio.powf(power) - 1.0) * kept;
                shown * root * root
            } else {
                shown
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> Curve {
        Curve::new(&Sky::default())
    }

    #[test]
    fn the_curve_rises_without_a_step_and_ends_in_white() {
        let curve = curve();
        for value in [0.01, 0.2, STRAIGHT - 1e-3, STRAIGHT + 1e-3, 1.0, 5.0, 1e3] {
            let slope = (curve.largest(value * 1.001) - curve.largest(value * 0.999)) / (0.002 * value);
            assert!(slope > 0.0 && slope < 1.0 + 1e-3, "{value} {slope}");
        }
        let (below, above) = (curve.largest(STRAIGHT - 1e-3), curve.largest(STRAIGHT + 1e-3));
        assert!((above - below - 2e-3).abs() < 1e-5, "{below} {above}");
        assert!(curve.largest(1e15) <= 1.0 && curve.largest(1e9) > 0.9999);
    }

    #[test]
    fn the_shoulder_is_where_the_documentation_says() {
        for (light, expected) in [(10.0, 0.918), (100.0, 0.979), (1000.0, 0.995)] {
            assert!((curve().largest(light) - expected).abs() < 6e-4, "{light} {}", curve().largest(light));
        }
        let code = |light: f32| 255.0 * crate::post::tone::Display::Srgb.encode(f64::from(curve().largest(light)));
        assert!(code(3000.0) < 254.75 && code(1e5) > 254.9, "{} {}", code(3000.0), code(1e5));
    }

    #[test]
    fn colours_keep_their_order_and_end_white() {
        let curve = curve();
        for scale in [1e-3, 0.1, 1.0, 10.0, 100.0] {
            let blue = curve.colour([0.2 * scale, 0.5 * scale, scale]);
            assert!(0.0 < blue[0] && blue[0] < blue[1] && blue[1] < blue[2] && blue[2] < 1.0, "{blue:?}");
        }
        assert!(curve.colour([2e9, 1e9, 5e8]).iter().all(|&value| (value - 1.0).abs() < 0.01));
        assert_eq!(curve.colour([0.0; 3]), [0.0; 3]);
        // Below the shoulder without more contrast of the channels light stays as it is.
        let straight = Curve { contrast: 1.0, ..curve };
        let shown = straight.colour([0.05, 0.1, 0.3]);
        [0.05, 0.1, 0.3].into_iter().zip(shown).for_each(|(a, b)| assert!((a - b).abs() < 1e-6, "{shown:?}"));
    }

    /// Hue in Oklab of linear Rec. 709 \[degrees\] (Ottosson 2020).
    fn hue([r, g, b]: [f32; 3]) -> f32 {
        let l = (0.412_221_47 * r + 0.536_332_54 * g + 0.051_445_99 * b).cbrt();
        let m = (0.211_903_5 * r + 0.680_699_5 * g + 0.107_397 * b).cbrt();
        let s = (0.088_302_46 * r + 0.281_718_84 * g + 0.629_978_7 * b).cbrt();
        let (a, b) =
            (1.977_998_5 * l - 2.428_592_2 * m + 0.450_593_7 * s, 0.025_904_04 * l + 0.782_771_77 * m - 0.808_675_77 * s);
        b.atan2(a).to_degrees()
    }

    #[test]
    fn glows_keep_the_hue_that_is_seen() {
        // An orange of a sunset, a blue of the zenith, through the whole shoulder.
        let straight = Curve { contrast: 1.0, ..curve() };
        for (colour, mixed_beyond) in
            [([1.0, 0.45, 0.12], 9.0), ([1.0, 0.3, 0.05], 12.0), ([0.15, 0.35, 1.0], 7.0), ([0.3, 0.55, 1.0], 5.0)]
        {
            let (mut worst, mut worst_mixed) = (0.0f32, 0.0f32);
            for light in [0.5, 1.0, 3.0, 10.0, 30.0, 100.0] {
                let shown = straight.colour(colour.map(|value| value * light));
                worst = worst.max((hue(shown) - hue(colour)).abs());
                // The mixture with white that leaves as much of the colour.
                let smallest = shown.into_iter().fold(1.0, f32::min) / shown.into_iter().fold(0.0, f32::max);
                let least = colour.into_iter().fold(1.0, f32::min);
                let share = (1.0 - smallest) / (1.0 - least);
                worst_mixed = worst_mixed.max((hue(colour.map(|value| 1.0 + (value - 1.0) * share)) - hue(colour)).abs());
            }
            assert!(worst < 3.0 && worst_mixed > mixed_beyond, "{colour:?}: {worst} {worst_mixed}");
        }
    }
}
