//! Kernels of flat pictures: a pinhole camera, a fisheye.
//!
//! One kernel stands for all pixels: the one of a source in the centre of the picture, with the true angle gamma between the directions of a pixel and of the centre, times the pixel's
//! solid angle, so that a sum over pixels is an integral over directions. With r the distance in pixels:
//! ```text
//! perspective: tan(gamma) = r / f,   solid angle 1 / f^2 cos^3(gamma),     f = (W / 2) / tan(field of view / 2)
//! fisheye:     gamma = a r,          solid angle a^2 sin(gamma) / gamma,   a = field of view / W, nothing beyond 180 degrees
//! ```
//! Off the axis that is an approximation: there a pinhole camera shows the same glare larger, by 1 / cos^2 of the angle from the axis along the radius and 1 / cos across: 13 and 6 % at the
//! border of a picture of 40 degrees, 33 and 15 % for 60, 100 and 41 % for 90. A fisheye shows it larger across the radius by gamma / sin(gamma): 11 % at 45 degrees, 57 % at 90. On a
//! latitude-longitude probe glare is right everywhere ([`sphere`](super::sphere)).

use super::scatter::Scatter;
use crate::projection::Azimuthal;

/// What lies within this distance [pixels] is averaged over the area of its pixel.
const AVERAGED_WITHIN: f32 = 24.0;

/// The scattered part of a source's light by the offset from it in pixels.
pub struct PlanarKernel<'a> {
    scatter: &'a Scatter,
    image: &'a dyn Azimuthal,
}

impl<'a> PlanarKernel<'a> {
    /// For the pixels of `image`.
    pub fn new(image: &'a dyn Azimuthal, scatter: &'a Scatter) -> Self {
        Self { scatter, image }
    }

    /// Distance [pixels] beyond which channels are the same; 0 if they are everywhere.
    pub fn coloured_within(&self) -> f64 {
        let distance = self.image.distance(super::halo::END_DEG.to_radians());
        // A pixel of the border has parts inside.
        if self.scatter.has_halo() { 1.01 * distance + 2.0 } else { 0.0 }
    }

    /// Share of the light of each channel that arrives in the pixel `right` and `up` of the source.
    pub fn at(&self, right: isize, up: isize) -> [f32; 3] {
        let (x, y) = (right as f32, up as f32);
        let distance = x.hypot(y);
        let parts = if distance > AVERAGED_WITHIN { 1 } else { (AVERAGED_WITHIN / distance.max(1.0)).ceil() as usize };
        if parts == 1 {
            return self.point(x, y, 1.0);
        }
        let mut sum = [0.0; 3];
        let offset = |k: usize| (k as f32 + 0.5) / parts as f32 - 0.5;
        for i in 0..parts {
            for j in 0..parts {
                let value = self.point(x + offset(i), y + offset(j), 1.0 / parts as f32);
                (0..3).for_each(|c| sum[c] += value[c]);
            }
        }
        sum.map(|value| value / (parts * parts) as f32)
    }

    #[inline]
    fn point(&self, x: f32, y: f32, size: f32) -> [f32; 3] {
        let square = x * x + y * y;
        let Some((chord_squared, solid_angle)) = self.image.chord_squared_and_solid_angle(square) else { return [0.0; 3] };
        let width = if self.scatter.has_streaks() { size / square.sqrt().max(1e-6) } else { 0.0 };
        self.scatter.at(chord_squared, (x, y), width).map(|value| value * solid_angle)
    }

    /// Equation 11 across one line of pixels, from offset 0 on, with the sum 1 over both sides: it is the product of such a line along x and one along y.
    pub fn unscattered(&self) -> Vec<f64> {
        let size = f64::from(self.image.step()).to_degrees() / 0.02;
        // Larger pixels hold more than 0.999999 of it.
        if size > 7.0 {
            return vec![1.0];
        }
        let count = (5.0 / size).ceil() as usize;
        let cell = |k: usize| -> f64 {
            let at = |part: usize| size * (k as f64 - 0.5 + (part as f64 + 0.5) / 64.0);
            (0..64).map(|part| (-at(part).powi(2)).exp()).sum()
        };
        let line: Vec<f64> = (0..=count).map(cell).collect();
        let total = line[0] + 2.0 * line[1..].iter().sum::<f64>();
        line.into_iter().map(|value| value / total).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::psf::{self, AdaptationState};
    use super::*;
    use crate::projection::{Fisheye, Perspective};
    use crate::spectrum::ColorSpace;

    fn perspective(angle: f64) -> Perspective {
        Perspective::new(1000, 2, angle)
    }

    #[test]
    fn pixels_stand_at_their_true_angles() {
        let scatter = Scatter::new(AdaptationState::Photopic, ColorSpace::LinRec709, 0, 0.0);
        let expected = |angle: f64, solid_angle: f64| (0.478 * psf::corona(angle) + 0.138 * psf::veil(angle)) * solid_angle;
        let wide = perspective(90.0);
        // The border of a picture of 90 degrees stands at 45 degrees: focal length 500 pixels.
        let found = PlanarKernel::new(&wide, &scatter).at(0, -500)[1];
        assert!((f64::from(found) / expected(45.0, 0.125f64.sqrt() / 250_000.0) - 1.0).abs() < 1e-4);
        let round = Fisheye::of_size(1000, 2, 180.0);
        let kernel = PlanarKernel::new(&round, &scatter);
        let step = 0.18f64.to_radians();
        let found = kernel.at(300, -400)[0];
        assert!((f64::from(found) / expected(90.0, step * step / (0.5 * std::f64::consts::PI)) - 1.0).abs() < 1e-4);
        assert_eq!(kernel.at(1001, 0), [0.0; 3]);
    }

    #[test]
    fn unscattered_light_adds_up_to_one_and_stays_in_large_pixels() {
        let scatter = Scatter::new(AdaptationState::Photopic, ColorSpace::LinRec709, 0, 0.0);
        for angle in [1.0, 5.0, 40.0, 170.0] {
            let line = PlanarKernel::new(&perspective(angle), &scatter).unscattered();
            assert!((line[0] + 2.0 * line[1..].iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
        let fine = perspective(10.0);
        let line = PlanarKernel::new(&fine, &scatter).unscattered();
        // checked against: erf(0.25) and erf(0.75) - erf(0.25), halved, pixels of 0.01 degrees (0.010025 in the centre of the picture), Abramowitz & Stegun table 7.1
        assert!((line[0] - 0.276_326_4).abs() < 1e-3 && (line[1] - 0.5 * (0.711_155_6 - 0.276_326_4)).abs() < 1e-3, "{line:?}");
    }
}
