//! Gauss-Legendre quadrature on an interval.
//!
//! The integral of f over [a, b] is approximated by (b - a) / 2 times the sum of w_i f((a + b) / 2 + x_i (b - a) / 2), with x_i the
//! roots of the Legendre polynomial P_n and w_i = 2 / ((1 - x_i^2) P_n'(x_i)^2): exact for polynomials up to degree 2 n - 1.
//! Source: Abramowitz & Stegun 1964, 25.4.29 and 22.16.6 (first guess of the roots).

/// Nodes and weights of one order, for the interval [0, 1].
#[derive(Clone, Debug)]
pub(crate) struct GaussLegendre {
    nodes: Vec<(f64, f64)>,
}

impl GaussLegendre {
    /// The rule with `count` nodes (at least 1).
    pub(crate) fn new(count: usize) -> Self {
        let count = count.max(1);
        let n = count as f64;
        let nodes = (0..count)
            .map(|i| {
                let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
                let mut slope = 1.0;
                for _ in 0..12 {
                    let (mut previous, mut value) = (1.0, x);
                    for k in 2..=count {
                        let k = k as f64;
                        (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
                    }
                    slope = n * (x * value - previous) / (x * x - 1.0);
                    x -= value / slope;
                }
                (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
            })
            .collect();
        Self { nodes }
    }

    /// Nodes and weights for the interval [`from`, `to`], in ascending order.
    pub(crate) fn on(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let length = to - from;
        self.nodes.iter().map(move |&(x, weight)| (from + length * x, length * weight))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_twice_the_order_are_exact() {
        for count in 1..12 {
            let rule = GaussLegendre::new(count);
            let degree = 2 * count as i32 - 1;
            let exact = (3f64.powi(degree + 1) - 1.0) / f64::from(degree + 1);
            assert!(
                (rule.on(1.0, 3.0).map(|(x, weight)| weight * x.powi(degree)).sum::<f64>() / exact - 1.0).abs() < 1e-13,
                "{count} nodes"
            );
        }
    }

    #[test]
    fn two_nodes_stand_at_the_inverse_root_of_three() {
        // checked against: Abramowitz & Stegun 1964, table 25.4
        let nodes: Vec<_> = GaussLegendre::new(2).on(-1.0, 1.0).collect();
        assert!((nodes[1].0 - 0.577350269189626).abs() < 1e-14 && (nodes[1].1 - 1.0).abs() < 1e-14);
    }
}
