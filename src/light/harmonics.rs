//! Real spherical harmonics that are even in azimuth: Y_lm(mu, phi) = y_lm(mu) cos(m phi), orthonormal over the sphere.
//!
//! With them the light scattered into w is S(w) = sigma sum_lm chi_l I_lm Y_lm(w), where I_lm are the moments of the radiance
//! and chi_l the Legendre moments of the phase function (addition theorem).

/// Which pairs (l, m) are kept: 0 <= l <= `order`, 0 <= m <= min(l, `azimuthal`). Pairs of lower l come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Orders {
    /// Highest l.
    pub order: usize,
    /// Highest m.
    pub azimuthal: usize,
}

impl Orders {
    /// Up to `order`, and `azimuthal` (at most `order`) around the vertical.
    pub const fn new(order: usize, azimuthal: usize) -> Self {
        Self { order, azimuthal: if azimuthal < order { azimuthal } else { order } }
    }

    /// Highest m of `l`.
    #[inline(always)]
    pub const fn last(self, l: usize) -> usize {
        if l < self.azimuthal { l } else { self.azimuthal }
    }

    /// Number of pairs with an l below `l`.
    #[inline(always)]
    pub const fn start(self, l: usize) -> usize {
        if l <= self.azimuthal + 1 {
            l * (l + 1) / 2
        } else {
            (self.azimuthal + 1) * (self.azimuthal + 2) / 2 + (l - self.azimuthal - 1) * (self.azimuthal + 1)
        }
    }

    /// Number of pairs.
    #[inline(always)]
    pub const fn count(self) -> usize {
        self.start(self.order + 1)
    }
}

/// Writes y_lm(mu) for all pairs of `orders` into `out`, which holds their [`Orders::count`].
pub fn evaluate(orders: Orders, mu: f64, out: &mut [f32]) {
    let s = (1.0 - mu * mu).max(0.0).sqrt();
    // Fully normalised associated Legendre functions by the standard three-term recurrence in l.
    let mut diagonal = (0.25 / std::f64::consts::PI).sqrt();
    for m in 0..=orders.azimuthal {
        if m > 0 {
            diagonal *= s * ((2 * m + 1) as f64 / (2 * m) as f64).sqrt();
        }
        let scale = if m == 0 { 1.0 } else { std::f64::consts::SQRT_2 };
        let (mut before, mut now) = (0.0, diagonal);
        out[orders.start(m) + m] = (scale * now) as f32;
        for l in m + 1..=orders.order {
            let (lf, mf) = (l as f64, m as f64);
            let a = ((4.0 * lf * lf - 1.0) / (lf * lf - mf * mf)).sqrt();
            let b = (((lf - 1.0).powi(2) - mf * mf) / (4.0 * (lf - 1.0).powi(2) - 1.0)).sqrt();
            let next = a * (mu * now - b * before);
            (before, now) = (now, next);
            out[orders.start(l) + m] = (scale * now) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_orthonormal() {
        let orders = Orders::new(6, 4);
        let (nmu, nphi) = (400, 32);
        let mut gram = vec![0.0; orders.count() * orders.count()];
        let mut y = vec![0.0; orders.count()];
        for i in 0..nmu {
            let mu = -1.0 + (f64::from(i) + 0.5) * 2.0 / f64::from(nmu);
            evaluate(orders, mu, &mut y);
            for j in 0..nphi {
                let phi = (f64::from(j) + 0.5) * std::f64::consts::TAU / f64::from(nphi);
                let weight = 2.0 / f64::from(nmu) * std::f64::consts::TAU / f64::from(nphi);
                let values: Vec<f64> = (0..=orders.order)
                    .flat_map(|l| (0..=orders.last(l)).map(move |m| (l, m)))
                    .map(|(l, m)| f64::from(y[orders.start(l) + m]) * (m as f64 * phi).cos())
                    .collect();
                for a in 0..values.len() {
                    for b in 0..values.len() {
                        gram[a * values.len() + b] += weight * values[a] * values[b];
                    }
                }
            }
        }
        for a in 0..orders.count() {
            for b in 0..orders.count() {
                let expected = if a == b { 1.0 } else { 0.0 };
                assert!((gram[a * orders.count() + b] - expected).abs() < 2e-3, "{a} {b}");
            }
        }
    }
}
