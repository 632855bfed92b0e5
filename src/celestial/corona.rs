//! The Sun's corona around the eclipsed Sun: electrons (K) and dust (F), in the colour of sunlight.
//!
//! B(r) = 1e-6 (2.565 r^-17 + 1.425 r^-7 + 0.0532 r^-2.5) times the brightness of the middle of the Sun's disc,
//!
//! r: distance from the Sun's centre in its radii. Source: Baumbach, Astronomische Nachrichten 263, 121 (1937), as quoted by Golub &
//! Pasachoff, The Solar Corona: a mean of many eclipses. The corona of a year of many spots is about half as bright
//! again, that of a quiet Sun less, flattened at the poles and streaked; here it is round.

use super::angle;
use super::eclipsed_sunlight::{EclipsedSunlight, free_half_arc};
use super::limb_darkening::mean_intensity;
use crate::numerics::gauss::legendre;
use glam::DVec3;
use std::f64::consts::PI;

/// Where the corona is taken to end, in radii of the Sun: beyond, the dust goes over into the zodiacal light.
pub const REACH: f64 = 12.0;

/// Coefficients and powers of the equation.
const TERMS: [(f64, f64); 3] = [(2.565e-6, -17.0), (1.425e-6, -7.0), (0.0532e-6, -2.5)];

/// Radiance at `r` solar radii over the mean radiance of the Sun's disc; 0 within the disc and beyond [`REACH`].
pub fn relative_radiance(r: f64) -> f64 {
    if !(1.0..=REACH).contains(&r) {
        return 0.0;
    }
    TERMS.iter().map(|&(coefficient, power)| coefficient * r.powf(power)).sum::<f64>() / mean_intensity(550.0)
}

/// The corona that an eclipse leaves free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corona {
    eclipse: EclipsedSunlight,
}

impl Corona {
    /// Of the given eclipse (or of the uneclipsed Sun, where it drowns in the light of the sky).
    pub fn new(eclipse: EclipsedSunlight) -> Self {
        Self { eclipse }
    }

    /// Angular radius of the drawn part [radians].
    pub fn angular_radius(&self) -> f64 {
        REACH * self.eclipse.sun_radius()
    }

    /// Radiance in `direction` (unit vector) over the mean radiance of the Sun's disc; 0 where the Moon or the Sun's disc is.
    pub fn at(&self, direction: DVec3) -> f64 {
        if self.eclipse.covers(direction) {
            return 0.0;
        }
        relative_radiance(angle(direction, self.eclipse.sun_direction()) / self.eclipse.sun_radius())
    }

    /// Irradiance of the free corona over that of the whole Sun.
    pub fn irradiance_ratio(&self) -> f64 {
        let moon = self.eclipse.moon_radius() / self.eclipse.sun_radius();
        let separation = self.eclipse.separation() / self.eclipse.sun_radius();
        let mut knots = vec![1.0, 1.2, 2.0, 4.0, REACH];
        knots.extend([(moon - separation).abs(), moon + separation].into_iter().filter(|&knot| knot > 1.0 && knot < REACH));
        knots.sort_by(f64::total_cmp);
        let rule = legendre(16);
        let mut sum = 0.0;
        for piece in knots.windows(2) {
            let (middle, half) = (0.5 * (piece[0] + piece[1]), 0.5 * (piece[1] - piece[0]));
            for &(x, weight) in &rule {
                let r = middle - half * (PI * x).cos();
                let measure = weight * half * PI * (PI * x).sin() * r * 2.0 * free_half_arc(r, moon, separation);
                sum += measure * relative_radiance(r);
            }
        }
        sum / PI
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corona(moon_over_sun: f64, separation: f64) -> Corona {
        let radius: f64 = 0.2666;
        let away = (radius * separation).to_radians();
        let eclipse = EclipsedSunlight::new(DVec3::Y, radius, DVec3::new(0.0, away.cos(), away.sin()), radius * moon_over_sun);
        Corona::new(eclipse.unwrap())
    }

    #[test]
    fn it_is_half_a_full_moon() {
        // Closed form up to REACH: 2 sum of c (1 - REACH^(p + 2)) / (-p - 2).
        let exact: f64 =
            TERMS.iter().map(|&(c, p)| 2.0 * c * (REACH.powf(p + 2.0) - 1.0) / (p + 2.0)).sum::<f64>() / mean_intensity(550.0);
        let whole = corona(1.0, 0.0).irradiance_ratio();
        assert!((whole / exact - 1.0).abs() < 1e-6, "{whole} {exact}");
        // checked against: common textbooks: half of the full Moon's light (2.1 to 2.5e-6 of the Sun's), half of that at spot minimum
        let total = corona(1.03, 0.0).irradiance_ratio();
        println!("corona beyond 1.03 radii: {total:.3e} of the Sun");
        assert!((0.57e-6..1.3e-6).contains(&total), "{total}");
    }

    #[test]
    fn it_falls_outwards_and_hides_behind_the_moon() {
        assert!((relative_radiance(1.0) * mean_intensity(550.0) - 4.0432e-6).abs() < 1e-12);
        assert!(relative_radiance(2.0) < 0.01 * relative_radiance(1.0));
        assert_eq!((relative_radiance(0.5), relative_radiance(REACH + 1.0)), (0.0, 0.0));
        let corona = corona(1.05, 0.04);
        assert_eq!(corona.at(corona.eclipse.moon_direction()), 0.0);
        let beside = DVec3::new((1.2 * corona.eclipse.sun_radius()).sin(), (1.2 * corona.eclipse.sun_radius()).cos(), 0.0);
        assert!((corona.at(beside) / relative_radiance(1.2) - 1.0).abs() < 1e-6);
    }
}
