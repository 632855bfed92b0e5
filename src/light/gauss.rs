//! Gauss-Legendre quadrature.

/// Abscissas and weights of the `n`-point rule on 0..1 (Newton's iteration on the Legendre polynomial; Press et al., Numerical Recipes, 4.6).
pub fn legendre(n: usize) -> Vec<(f64, f64)> {
    (0..n)
        .map(|i| {
            let mut x = -((i as f64 + 0.75) / (n as f64 + 0.5) * std::f64::consts::PI).cos();
            loop {
                let (mut before, mut now) = (0.0, 1.0);
                for k in 0..n {
                    let k = k as f64;
                    (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
                }
                let slope = n as f64 * (x * now - before) / (x * x - 1.0);
                let step = now / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    return (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope));
                }
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_polynomials_exactly() {
        for n in 1..20 {
            let sum: f64 = legendre(n).iter().map(|&(x, w)| w * x.powi(2 * n as i32 - 1)).sum();
            assert!((sum - 1.0 / (2.0 * n as f64)).abs() < 1e-14, "{n}: {sum}");
        }
    }
}
