//! Gauss-Legendre quadrature.
//!
//! The integral of f over [a, b] is approximated by (b - a) / 2 times the sum of w_i f((a + b) / 2 + x_i (b - a) / 2), with x_i the
//! roots of the Legendre polynomial P_n and w_i = 2 / ((1 - x_i^2) P_n'(x_i)^2): exact for polynomials up to degree 2 n - 1.
//! Sources: Abramowitz & Stegun 1964, 25.4.29 and 22.16.6 (first guess of the roots); Press et al., Numerical Recipes, 4.6 (Newton's iteration).

/// Newton's iteration takes 4 to 6 steps; a root at which rounding never lets it settle is good to the same digits.
const MOST_STEPS: usize = 100;

/// The rule with one number of nodes, for any interval.
#[derive(Clone, Debug)]
pub struct GaussLegendre {
    nodes: Vec<(f64, f64)>,
}

impl GaussLegendre {
    /// The rule with `count` nodes (at least 1).
    pub fn new(count: usize) -> Self {
        Self { nodes: legendre(count.max(1)) }
    }

    /// Nodes and weights for the interval from `from` to `to`, beginning at `from`; the weights sum to `to` - `from`.
    pub fn on(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let length = to - from;
        self.nodes.iter().map(move |&(x, weight)| (from + length * x, length * weight))
    }
}

/// Nodes, ascending, and weights of the rule with `n` nodes on 0 to 1; no nodes for `n` = 0.
pub fn legendre(n: usize) -> Vec<(f64, f64)> {
    (0..n).map(|i| node(n, i)).collect()
}

fn node(n: usize, i: usize) -> (f64, f64) {
    let mut x = -((i as f64 + 0.75) / (n as f64 + 0.5) * std::f64::consts::PI).cos();
    let mut slope = 1.0;
    for _ in 0..MOST_STEPS {
        let (mut before, mut now) = (0.0, 1.0);
        for k in 0..n {
            let k = k as f64;
            (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
        }
        slope = n as f64 * (x * now - before) / (x * x - 1.0);
        let step = now / slope;
        x -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_twice_the_order_are_exact() {
        for n in 1..20 {
            let sum: f64 = legendre(n).iter().map(|&(x, w)| w * x.powi(2 * n as i32 - 1)).sum();
            assert!((sum - 1.0 / (2.0 * n as f64)).abs() < 1e-14, "{n}: {sum}");
            let rule = GaussLegendre::new(n);
            let exact = (3f64.powi(2 * n as i32) - 1.0) / (2.0 * n as f64);
            let sum: f64 = rule.on(1.0, 3.0).map(|(x, weight)| weight * x.powi(2 * n as i32 - 1)).sum();
            assert!((sum / exact - 1.0).abs() < 1e-13, "{n} nodes");
        }
    }

    #[test]
    fn two_and_three_nodes_are_those_of_the_table() {
        // checked against: Abramowitz & Stegun 1964, table 25.4
        let table = [
            vec![(-0.577350269189626, 1.0), (0.577350269189626, 1.0)],
            vec![(-0.774596669241483, 0.555555555555556), (0.0, 0.888888888888889), (0.774596669241483, 0.555555555555556)],
        ];
        for nodes in table {
            for (found, expected) in GaussLegendre::new(nodes.len()).on(-1.0, 1.0).zip(nodes) {
                assert!((found.0 - expected.0).abs() < 1e-14 && (found.1 - expected.1).abs() < 1e-14, "{found:?} {expected:?}");
            }
        }
    }

    #[test]
    fn many_nodes_ascend_mirror_each_other_and_weigh_one() {
        for n in [64, 127, 128, 500, 1001] {
            let nodes = legendre(n);
            assert!(nodes.windows(2).all(|pair| pair[0].0 < pair[1].0));
            assert!(nodes.iter().zip(nodes.iter().rev()).all(|(a, b)| (a.0 + b.0 - 1.0).abs() < 1e-14));
            assert!((nodes.iter().map(|node| node.1).sum::<f64>() - 1.0).abs() < 1e-12, "{n}");
        }
    }
}
