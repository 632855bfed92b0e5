//! Anderson's acceleration of a fixed-point iteration x = g(x) (Walker & Ni 2011, SIAM J. Numer. Anal. 49, 1715).
//!
//! The next iterate is the combination of the last few g(x) whose residuals g(x) - x cancel best in the least-squares sense; each wavelength has
//! its own coefficients. Residuals are measured relative to the magnitude of their node, so that twilight counts as much as noon.

use super::lanes::{Lanes, splat};
use super::source::{Field, mean};

/// How many earlier iterates are combined.
const DEPTH: usize = 4;

/// History of an iteration.
pub struct Anderson<const N: usize> {
    /// Differences of successive results g(x), newest last.
    results: Vec<Vec<Lanes<N>>>,
    /// Differences of successive residuals, newest last.
    residuals: Vec<Vec<Lanes<N>>>,
    last: Option<(Vec<Lanes<N>>, Vec<Lanes<N>>)>,
}

impl<const N: usize> Anderson<N> {
    /// Without history.
    pub fn new() -> Self {
        Self { results: Vec::new(), residuals: Vec::new(), last: None }
    }

    /// Replaces `field` = x, for which the operator gave `result` = g(x), by the next iterate; without acceleration if `accelerate` is false.
    /// Returns the root mean square of the residual relative to the field, in the worst wavelength.
    pub fn step(&mut self, field: &mut Field<N>, result: Field<N>, accelerate: bool) -> f32 {
        let weights = inverse_magnitudes(&result);
        let x = flatten(field);
        let g = flatten(&result);
        let f: Vec<Lanes<N>> = g.iter().zip(&x).map(|(g, x)| Lanes::from_fn(|n| g[n] - x[n])).collect();
        let change = relative_size(&f, &weights);
        let mut next = g.clone();
        if accelerate {
            if let Some((last_g, last_f)) = &self.last {
                self.results.push(difference(&g, last_g));
                self.residuals.push(difference(&f, last_f));
                if self.results.len() > DEPTH {
                    self.results.remove(0);
                    self.residuals.remove(0);
                }
                let coefficients = self.coefficients(&f, &weights);
                for (c, d) in coefficients.iter().zip(&self.results) {
                    for (value, step) in next.iter_mut().zip(d) {
                        for n in 0..N {
                            value[n] -= c[n] * step[n];
                        }
                    }
                }
            }
            self.last = Some((g, f));
        }
        let values = field.values.len();
        // Extrapolation may not make light negative: the energy of a node stays at least a part of the plain iterate's.
        let count = field.shape.count();
        let plain = &result;
        for (k, value) in next.iter_mut().enumerate() {
            let energy = if k < values { (k % count == 0).then(|| &plain.values[k]) } else { Some(&plain.ground[k - values]) };
            if let Some(energy) = energy {
                for n in 0..N {
                    value[n] = value[n].max(0.2 * energy[n]);
                }
            }
        }
        field.values.copy_from_slice(&next[..values]);
        field.ground.copy_from_slice(&next[values..]);
        change
    }

    /// Least-squares coefficients of the residual in the differences of residuals, by wavelength.
    fn coefficients(&self, f: &[Lanes<N>], weights: &[f32]) -> Vec<Lanes<N>> {
        let k = self.residuals.len();
        let mut gram = vec![[0.0_f64; N]; k * k];
        let mut right = vec![[0.0_f64; N]; k];
        for (place, &w) in weights.iter().enumerate() {
            let w2 = f64::from(w) * f64::from(w);
            for a in 0..k {
                let da = &self.residuals[a][place];
                for n in 0..N {
                    right[a][n] += w2 * f64::from(da[n]) * f64::from(f[place][n]);
                }
                for b in 0..=a {
                    let db = &self.residuals[b][place];
                    for n in 0..N {
                        gram[a * k + b][n] += w2 * f64::from(da[n]) * f64::from(db[n]);
                    }
                }
            }
        }
        let mut out = vec![splat(0.0); k];
        for n in 0..N {
            let matrix: Vec<f64> = (0..k * k).map(|i| gram[(i / k).max(i % k) * k + (i / k).min(i % k)][n]).collect();
            let solution = solve_symmetric(matrix, (0..k).map(|a| right[a][n]).collect());
            for a in 0..k {
                out[a][n] = solution[a] as f32;
            }
        }
        out
    }
}

fn flatten<const N: usize>(field: &Field<N>) -> Vec<Lanes<N>> {
    field.values.iter().chain(&field.ground).copied().collect()
}

fn difference<const N: usize>(a: &[Lanes<N>], b: &[Lanes<N>]) -> Vec<Lanes<N>> {
    a.iter().zip(b).map(|(a, b)| Lanes::from_fn(|n| a[n] - b[n])).collect()
}

/// One over the magnitude of the node to which each number of the flattened field belongs.
fn inverse_magnitudes<const N: usize>(field: &Field<N>) -> Vec<f32> {
    let count = field.shape.count();
    let nodes = field.magnitudes().into_iter().flat_map(|m| std::iter::repeat_n(1.0 / m, count));
    nodes.chain(field.ground.iter().map(|g| 1.0 / mean(g))).map(|w| w.min(1e15)).collect()
}

fn relative_size<const N: usize>(f: &[Lanes<N>], weights: &[f32]) -> f32 {
    let mut sums = [0.0_f64; N];
    for (value, &w) in f.iter().zip(weights) {
        for n in 0..N {
            sums[n] += f64::from(value[n] * w).powi(2);
        }
    }
    (sums.iter().fold(0.0, |a: f64, &b| a.max(b)) / f.len() as f64).sqrt() as f32
}

/// Solves a small symmetric positive system by Gaussian elimination, with a ridge that keeps nearly dependent directions harmless.
fn solve_symmetric(mut a: Vec<f64>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    let trace: f64 = (0..n).map(|i| a[i * n + i]).sum();
    if trace <= 0.0 {
        return vec![0.0; n];
    }
    for i in 0..n {
        a[i * n + i] += 1e-10 * trace;
    }
    for i in 0..n {
        for r in i + 1..n {
            let factor = a[r * n + i] / a[i * n + i];
            for c in i..n {
                a[r * n + c] -= factor * a[i * n + c];
            }
            b[r] -= factor * b[i];
        }
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|c| a[i * n + c] * b[c]).sum();
        b[i] = (b[i] - known) / a[i * n + i];
    }
    b
}

#[cfg(test)]
mod tests {
    use super::super::harmonics::Orders;
    use super::super::source::Shape;
    use super::*;

    #[test]
    fn solves_small_systems() {
        let x = solve_symmetric(vec![4.0, 1.0, 1.0, 3.0], vec![1.0, 2.0]);
        assert!((x[0] - 1.0 / 11.0).abs() < 1e-8 && (x[1] - 7.0 / 11.0).abs() < 1e-8);
    }

    /// A linear contraction with two eigenvalues is solved exactly with two differences.
    #[test]
    fn a_linear_iteration_ends_after_few_steps() {
        let operator = |x: &Field<16>| {
            let mut y = x.clone();
            for (k, value) in y.values.iter_mut().enumerate() {
                *value = value.map(|v| 1.0 + if k % 2 == 0 { 0.9 } else { 0.5 } * v);
            }
            y
        };
        let shape = Shape { orders: Orders::new(0, 0), polarised: false };
        let mut x = Field { shape, values: vec![splat(0.0); 10], ground: vec![splat(1.0); 2] };
        let mut anderson = Anderson::new();
        let mut change = 1.0;
        for _ in 0..6 {
            let y = operator(&x);
            change = anderson.step(&mut x, y, true);
        }
        assert!(change < 1e-4, "{change}");
        assert!((x.values[0][3] - 10.0).abs() < 1e-2 && (x.values[1][3] - 2.0).abs() < 1e-3);
    }
}
