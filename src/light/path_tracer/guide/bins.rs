//! Bins of direction about a point in the air: the local frame has z up and x towards the Sun's azimuth, and the bins follow the
//! local horizon, so that a bin means the same at every altitude.
//!
//! Three bands of zenith cosine mu, with the horizon's cosine h <= 0: the sky, mu = t^2; the limb, mu = h (1 - t^1.5); the ground,
//! mu = h - (1 + h) t^2, each with equal steps of t. Azimuths are densest at the Sun's, and the same on both sides of it.

use std::f64::consts::PI;

const SKY: usize = 8;
const LIMB: usize = 5;
const GROUND: usize = 3;

/// Number of bins in zenith angle.
pub(super) const ZENITHS: usize = SKY + LIMB + GROUND;

/// Number of bins in azimuth on one side of the Sun.
pub(super) const AZIMUTHS: usize = 8;

/// Number of bins on one side of the Sun: zenith after zenith.
pub(super) const BINS: usize = ZENITHS * AZIMUTHS;

/// Lower and upper zenith cosine of bin `i` where the horizon's cosine is `horizon`.
pub(super) fn zenith_range(i: usize, horizon: f64) -> (f64, f64) {
    let edge = |i: usize| {
        if i <= SKY {
            let t = i as f64 / SKY as f64;
            (1.0 - t) * (1.0 - t)
        } else if i <= SKY + LIMB {
            let t = (i - SKY) as f64 / LIMB as f64;
            horizon * t.powf(1.5)
        } else {
            let t = (i - SKY - LIMB) as f64 / GROUND as f64;
            horizon - (1.0 + horizon) * t * t
        }
    };
    (edge(i + 1), edge(i))
}

/// Bin of a zenith cosine.
pub(super) fn zenith_bin(cosine: f64, horizon: f64) -> usize {
    let within = |t: f64, bins: usize| ((t * bins as f64) as usize).min(bins - 1);
    if cosine >= 0.0 {
        within(1.0 - cosine.min(1.0).sqrt(), SKY)
    } else if cosine > horizon {
        SKY + within((cosine / horizon).powf(1.0 / 1.5), LIMB)
    } else {
        let depth = if horizon > -1.0 { (horizon - cosine) / (1.0 + horizon) } else { 0.0 };
        SKY + LIMB + within(depth.max(0.0).sqrt(), GROUND)
    }
}

/// Least and greatest azimuth of bin `j`, from the Sun's [radians].
pub(super) fn azimuth_range(j: usize) -> (f64, f64) {
    let edge = |j: usize| PI * (j as f64 / AZIMUTHS as f64).powf(1.5);
    (edge(j), edge(j + 1))
}

/// Bin of an azimuth from the Sun's, 0 to pi.
pub(super) fn azimuth_bin(azimuth: f64) -> usize {
    (((azimuth / PI).powf(1.0 / 1.5) * AZIMUTHS as f64) as usize).min(AZIMUTHS - 1)
}

/// Solid angle of the bin (i, j) on one side of the Sun [sr].
pub(super) fn solid_angle(i: usize, j: usize, horizon: f64) -> f64 {
    let ((low, high), (near, far)) = (zenith_range(i, horizon), azimuth_range(j));
    (high - low) * (far - near)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bins_tile_the_sphere() {
        for horizon in [0.0, -1e-4, -0.06, -0.2, -0.9] {
            let whole: f64 = (0..BINS).map(|b| 2.0 * solid_angle(b / AZIMUTHS, b % AZIMUTHS, horizon)).sum();
            assert!((whole - 4.0 * PI).abs() < 1e-9);
            for i in 0..ZENITHS {
                let (low, high) = zenith_range(i, horizon);
                if high - low > 1e-9 {
                    for part in [1e-6, 0.5, 1.0 - 1e-6] {
                        assert_eq!(zenith_bin(low + part * (high - low), horizon), i);
                    }
                }
            }
        }
        for j in 0..AZIMUTHS {
            let (near, far) = azimuth_range(j);
            assert_eq!(azimuth_bin(0.5 * (near + far)), j);
        }
        assert!((azimuth_bin(PI), zenith_bin(1.0, -0.1), zenith_bin(-1.0, -0.1)) == (AZIMUTHS - 1, 0, ZENITHS - 1));
    }
}
