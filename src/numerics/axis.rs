//! Ascending axes of tables: finding the interval of a value in constant time, and cubic interpolation weights.

/// Strictly ascending nodes with a table that finds the interval of a value without a search.
#[derive(Clone, Debug)]
pub struct Axis {
    nodes: Vec<f64>,
    /// Interval in which each of the equally wide bins begins.
    starts: Vec<u32>,
    bins_per_unit: f64,
    /// For each interval: the first node of its cubic stencil and the inverse Lagrange denominators of the stencil's four nodes.
    stencils: Vec<(u32, [f64; 4])>,
}

impl Axis {
    /// An axis through `nodes`: at least two, strictly ascending.
    pub fn new(nodes: Vec<f64>) -> Self {
        debug_assert!(nodes.len() >= 2 && nodes.windows(2).all(|w| w[0] < w[1]));
        let span = nodes[nodes.len() - 1] - nodes[0];
        let narrowest = nodes.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        let bins = (2.0 * span / narrowest).ceil().clamp(1.0, 8192.0) as usize;
        let bins_per_unit = bins as f64 / span;
        let mut starts = Vec::with_capacity(bins + 1);
        let mut interval = 0;
        for bin in 0..=bins {
            let left = nodes[0] + bin as f64 / bins_per_unit;
            while interval + 2 < nodes.len() && nodes[interval + 1] <= left {
                interval += 1;
            }
            starts.push(interval as u32);
        }
        let stencils = (0..nodes.len() - 1).map(|i| stencil(&nodes, i)).collect();
        Self { nodes, starts, bins_per_unit, stencils }
    }

    /// The nodes.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Number of nodes.
    #[allow(clippy::len_without_is_empty, reason = "an axis has at least two nodes")]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The last node.
    pub fn last(&self) -> f64 {
        self.nodes[self.nodes.len() - 1]
    }

    /// Index of the interval that holds `x` (clamped to the axis).
    #[inline(always)]
    pub fn interval(&self, x: f64) -> usize {
        let bin = ((x - self.nodes[0]) * self.bins_per_unit).max(0.0) as usize;
        let mut interval = self.starts[bin.min(self.starts.len() - 1)] as usize;
        while interval + 2 < self.nodes.len() && self.nodes[interval + 1] <= x {
            interval += 1;
        }
        interval
    }

    /// Interval of `x` and the position in it, 0 to 1; values outside the axis are clamped to its ends.
    #[inline(always)]
    pub fn locate(&self, x: f64) -> (usize, f32) {
        let i = self.interval(x);
        let fraction = (x - self.nodes[i]) / (self.nodes[i + 1] - self.nodes[i]);
        (i, fraction.clamp(0.0, 1.0) as f32)
    }

    /// First node and weights of the cubic through the four nodes around `x` (Lagrange; the outermost four near the ends).
    /// The axis must have at least four nodes.
    #[inline(always)]
    pub fn cubic(&self, x: f64) -> Cubic {
        let interval = self.interval(x);
        let (first, inverse) = self.stencils[interval];
        let first = first as usize;
        let d: [f64; 4] = std::array::from_fn(|a| x - self.nodes[first + a]);
        Cubic {
            first,
            interval,
            weights: [
                (d[1] * d[2] * d[3] * inverse[0]) as f32,
                (d[0] * d[2] * d[3] * inverse[1]) as f32,
                (d[0] * d[1] * d[3] * inverse[2]) as f32,
                (d[0] * d[1] * d[2] * inverse[3]) as f32,
            ],
        }
    }
}

/// Four neighbouring nodes and what each counts.
#[derive(Clone, Copy, Debug)]
pub struct Cubic {
    /// The first of the four nodes.
    pub first: usize,
    /// The interval that holds the value; its nodes are `interval` and `interval + 1`.
    pub interval: usize,
    /// Weights of the four nodes; their sum is 1.
    pub weights: [f32; 4],
}

fn stencil(nodes: &[f64], interval: usize) -> (u32, [f64; 4]) {
    if nodes.len() < 4 {
        return (0, [0.0; 4]);
    }
    let first = interval.saturating_sub(1).min(nodes.len() - 4);
    let inverse =
        std::array::from_fn(|a| 1.0 / (0..4).filter(|&b| b != a).map(|b| nodes[first + a] - nodes[first + b]).product::<f64>());
    (first as u32, inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uneven() -> Axis {
        Axis::new((0..20).map(|i| (i as f64 / 19.0).powf(2.2) * 100.0).collect())
    }

    #[test]
    fn interval_holds_its_value() {
        let axis = uneven();
        for i in 0..=1000 {
            let x = i as f64 * 0.1;
            let n = axis.interval(x);
            assert!(axis.nodes()[n] <= x && x <= axis.nodes()[n + 1]);
        }
        assert_eq!(axis.interval(-5.0), 0);
        assert_eq!(axis.interval(500.0), 18);
    }

    #[test]
    fn cubic_reproduces_cubics() {
        let axis = uneven();
        let f = |x: f64| 3.0 - x + 0.02 * x * x - 1e-4 * x * x * x;
        for x in [0.0, 0.01, 3.3, 47.0, 99.0, 100.0] {
            let cubic = axis.cubic(x);
            let value: f64 = (0..4).map(|a| f64::from(cubic.weights[a]) * f(axis.nodes()[cubic.first + a])).sum();
            assert!((value - f(x)).abs() < 1e-3, "{x}: {value} {}", f(x));
        }
    }
}
