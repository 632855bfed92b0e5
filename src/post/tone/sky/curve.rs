//! From exposed colours to the screen: straight, then a shoulder with no end.
//!
//! On the largest channel m, with s the end of the straight part and q the power of the shoulder:
//! ```text
//! m <= s:  m
//! m > s:   1 - (1 - s) (1 + (m - s) / (q (1 - s)))^-q
//! ```
//! Value and slope meet at s. Far above, the distance from white falls as m^-q: with q = 1/2 what is a hundred times brighter than the middle of the screen is at 0.96, a thousand times 0.99, and only a Sun's disc
//! (a hundred thousand times) is white in 8 bits. (1 - exp(-m), the thesis's curve, is white from 6 times on, a hyperbola from 200 times on.)
//!
//! The other channels: shown / largest = (channel / largest)^contrast, then mixed with white by w = 1 - ((1 - shown) / (1 - s))^(1/2) above s: mixing with white keeps the hue, and nothing leaves the gamut.

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
        // The square root is the default and much cheaper.
        let left = if self.power == 0.5 { 1.0 / over.sqrt() } else { over.powf(-self.power) };
        1.0 - room * left
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
        rgb.map(|value| {
            let ratio = value / largest;
            // The largest channel itself needs no power.
            let ratio = if ratio < 1.0 { ratio.powf(self.contrast) } else { 1.0 };
            shown * (1.0 + (ratio - 1.0) * kept)
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
        // A square root in place of a power changes nothing.
        let other = Curve { power: 0.500_001, ..curve };
        assert!((other.largest(37.0) - curve.largest(37.0)).abs() < 1e-5);
    }

    #[test]
    fn colours_keep_their_order_and_hue_and_end_white() {
        let curve = curve();
        // Hue as an angle about the grey axis of RGB.
        let hue = |[r, g, b]: [f32; 3]| (3f32.sqrt() * (g - b)).atan2(2.0 * r - g - b);
        let straight = Curve { contrast: 1.0, ..curve };
        for scale in [1e-3, 0.1, 1.0, 10.0, 100.0] {
            let colour = [0.2 * scale, 0.5 * scale, scale];
            let blue = curve.colour(colour);
            assert!(0.0 < blue[0] && blue[0] < blue[1] && blue[1] < blue[2] && blue[2] < 1.0, "{blue:?}");
            // Without more contrast of the channels the hue is exactly that of the light.
            assert!((hue(straight.colour(colour)) - hue(colour)).abs() < 1e-4, "{scale}");
        }
        assert!(curve.colour([2e9, 1e9, 5e8]).iter().all(|&value| (value - 1.0).abs() < 0.01));
        assert_eq!(curve.colour([0.0; 3]), [0.0; 3]);
    }
}
