//! A bracketed root by the Illinois method: regula falsi that halves the weight of an end that stays.

/// Root of `f` between `low` and `high` to within `tolerance`, where `f` has opposite signs (or is 0) at the two ends.
pub(super) fn bracketed_root(mut f: impl FnMut(f64) -> f64, low: f64, high: f64, tolerance: f64) -> f64 {
    let (mut a, mut b) = (low, high);
    let (mut at_a, mut at_b) = (f(a), f(b));
    for _ in 0..100 {
        if at_a == 0.0 || (b - a).abs() <= tolerance && at_a.abs() < at_b.abs() {
            return a;
        }
        if at_b == 0.0 || (b - a).abs() <= tolerance {
            return b;
        }
        let middle = b - at_b * (b - a) / (at_b - at_a);
        let at_middle = f(middle);
        if at_middle.signum() == at_b.signum() {
            at_a *= 0.5;
        } else {
            (a, at_a) = (b, at_b);
        }
        if (middle - b).abs() <= 0.1 * tolerance {
            return middle;
        }
        (b, at_b) = (middle, at_middle);
    }
    b
}

#[cfg(test)]
mod tests {
    use super::bracketed_root;

    #[test]
    fn roots_of_curved_functions() {
        let mut calls = 0;
        let root = bracketed_root(
            |x: f64| {
                calls += 1;
                x.powi(5) - 2.0
            },
            0.0,
            2.0,
            1e-12,
        );
        assert!((root - 2.0_f64.powf(0.2)).abs() < 1e-11);
        assert!(calls < 30, "{calls}");
        assert_eq!(bracketed_root(|x| x, 0.0, 1.0, 1e-9), 0.0);
        assert!((bracketed_root(|x| 3.0 - x, 10.0, 2.0, 1e-9) - 3.0).abs() < 1e-9);
    }
}
