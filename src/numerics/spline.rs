//! Cubic splines: values at a few nodes become a curve, and integrals of that curve become weights.
//!
//! Not-a-knot end conditions, so that four nodes or more reproduce a cubic polynomial; three nodes give a parabola, two a line,
//! one a constant. Outside the nodes the curve keeps its end value. Source: de Boor, A Practical Guide to Splines, chapter IV.

/// The interpolating cubic spline through given values.
#[derive(Clone, Debug)]
pub struct CubicSpline {
    nodes: Vec<f64>,
    values: Vec<f64>,
    second_derivatives: Vec<f64>,
}

impl CubicSpline {
    /// The spline through `values` at `nodes` (ascending, as many as values, at least one).
    ///
    /// # Panics
    /// If the lengths differ or are zero.
    pub fn new(nodes: &[f64], values: &[f64]) -> Self {
        assert!(!nodes.is_empty() && nodes.len() == values.len(), "a spline needs one value for each node");
        Self { nodes: nodes.to_vec(), values: values.to_vec(), second_derivatives: second_derivatives(nodes, values) }
    }

    /// Value at `x`; the end value outside the nodes, not a number for not a number.
    pub fn value(&self, x: f64) -> f64 {
        let last = self.nodes.len() - 1;
        if x.is_nan() {
            return x;
        }
        if x <= self.nodes[0] {
            return self.values[0];
        }
        if x >= self.nodes[last] {
            return self.values[last];
        }
        let right = self.nodes.partition_point(|&node| node <= x);
        let left = right - 1;
        let h = self.nodes[right] - self.nodes[left];
        let (a, b) = ((self.nodes[right] - x) / h, (x - self.nodes[left]) / h);
        let bend = (a * a * a - a) * self.second_derivatives[left] + (b * b * b - b) * self.second_derivatives[right];
        a * self.values[left] + b * self.values[right] + bend * h * h / 6.0
    }
}

/// Cardinal functions of the spline at `x`: row i of the result is the value at `x[..]` of the spline that is 1 at node i and 0
/// at the others, so that the interpolated value at `x[k]` is the sum over i of `result[i][k]` times the value at node i.
///
/// # Panics
/// If there are no nodes.
pub fn cardinal_functions(nodes: &[f64], x: &[f64]) -> Vec<Vec<f64>> {
    let mut unit = vec![0.0; nodes.len()];
    (0..nodes.len())
        .map(|i| {
            unit[i] = 1.0;
            let spline = CubicSpline::new(nodes, &unit);
            unit[i] = 0.0;
            x.iter().map(|&x| spline.value(x)).collect()
        })
        .collect()
}

fn second_derivatives(nodes: &[f64], values: &[f64]) -> Vec<f64> {
    let n = nodes.len();
    if n < 3 {
        return vec![0.0; n];
    }
    let h: Vec<f64> = nodes.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slope: Vec<f64> = (0..n - 1).map(|i| (values[i + 1] - values[i]) / h[i]).collect();
    if n == 3 {
        return vec![2.0 * (slope[1] - slope[0]) / (h[0] + h[1]); 3];
    }
    // Continuity of the first derivative at the inner nodes; the end conditions are put into the first and last row.
    let inner = n - 2;
    let mut below: Vec<f64> = (0..inner).map(|i| h[i]).collect();
    let mut diagonal: Vec<f64> = (0..inner).map(|i| 2.0 * (h[i] + h[i + 1])).collect();
    let mut above: Vec<f64> = (0..inner).map(|i| h[i + 1]).collect();
    let mut right: Vec<f64> = (0..inner).map(|i| 6.0 * (slope[i + 1] - slope[i])).collect();
    let (first, last) = (h[0] / h[1], h[n - 2] / h[n - 3]);
    diagonal[0] += h[0] * (1.0 + first);
    above[0] -= h[0] * first;
    diagonal[inner - 1] += h[n - 2] * (1.0 + last);
    below[inner - 1] -= h[n - 2] * last;
    for i in 1..inner {
        let factor = below[i] / diagonal[i - 1];
        diagonal[i] -= factor * above[i - 1];
        right[i] -= factor * right[i - 1];
    }
    let mut second = vec![0.0; n];
    for i in (0..inner).rev() {
        let known = if i + 1 < inner { above[i] * second[i + 2] } else { 0.0 };
        second[i + 1] = (right[i] - known) / diagonal[i];
    }
    second[0] = (1.0 + first) * second[1] - first * second[2];
    second[n - 1] = (1.0 + last) * second[n - 2] - last * second[n - 3];
    second
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_the_order_are_reproduced() {
        let nodes = [380.0, 402.0, 455.0, 520.0, 611.0, 740.0];
        for count in 1..=6 {
            let degree = (count - 1).min(3) as i32;
            let polynomial = |x: f64| (0..=degree).map(|k| (f64::from(k) + 0.5) * ((x - 550.0) / 100.0).powi(k)).sum::<f64>();
            let values: Vec<f64> = nodes[..count].iter().map(|&x| polynomial(x)).collect();
            let spline = CubicSpline::new(&nodes[..count], &values);
            for i in 0..=50 {
                let x = nodes[0] + (nodes[count - 1] - nodes[0]) * f64::from(i) / 50.0;
                assert!((spline.value(x) - polynomial(x)).abs() < 1e-11, "{count} nodes at {x} nm");
            }
        }
    }

    #[test]
    fn the_ends_are_kept_outside_the_nodes() {
        let spline = CubicSpline::new(&[1.0, 2.0, 3.0, 5.0], &[7.0, 1.0, 4.0, 9.0]);
        assert_eq!((spline.value(0.0), spline.value(6.0)), (7.0, 9.0));
        assert!(spline.value(f64::NAN).is_nan());
    }

    #[test]
    fn cardinal_functions_sum_to_one_and_interpolate() {
        let nodes = [380.0, 400.0, 470.0, 540.0, 600.0, 740.0];
        let x: Vec<f64> = (370..750).map(f64::from).collect();
        let cardinal = cardinal_functions(&nodes, &x);
        let values = [3.0, -1.0, 2.0, 5.0, 0.0, 1.0];
        let spline = CubicSpline::new(&nodes, &values);
        for k in 0..x.len() {
            let sum: f64 = cardinal.iter().map(|row| row[k]).sum();
            let value: f64 = cardinal.iter().zip(values).map(|(row, v)| row[k] * v).sum();
            assert!((sum - 1.0).abs() < 1e-12 && (value - spline.value(x[k])).abs() < 1e-12);
        }
    }
}
