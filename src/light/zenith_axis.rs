//! The solar zenith angles of the grid: dense around the terminator, and found from a cosine without trigonometry.
//!
//! The nodes are equidistant in a coordinate x(theta) whose derivative is the density of nodes, a smooth function, so that the cubic through four
//! neighbours has the same weights everywhere. x is tabulated against sqrt(1 - cos theta), in which it is smooth from the zenith on.

/// Largest solar zenith angle of the grid [degrees]: beyond, no ray of the lower atmosphere sees light.
const LAST_DEG: f64 = 125.0;
/// Entries of the table.
const TABLE: usize = 4096;

/// Nodes in the solar zenith angle.
pub struct ZenithAxis {
    angles: Vec<f64>,
    table: Vec<f32>,
    per_unit: f32,
}

/// Relative density of nodes: six times higher between 86 and 106 degrees, where the Earth's shadow moves, than by day.
fn density(degrees: f64) -> f64 {
    1.0 + 5.0 / (1.0 + ((degrees - 95.5) / 9.5).powi(4))
}

impl ZenithAxis {
    /// `count` nodes from 0 to 125 degrees.
    pub fn new(count: usize) -> Self {
        // Integral of the density by the midpoint rule on steps much finer than the table's.
        const STEPS: usize = 50_000;
        let step = LAST_DEG / STEPS as f64;
        let mut integral = Vec::with_capacity(STEPS + 1);
        integral.push(0.0);
        for i in 0..STEPS {
            integral.push(integral[i] + density((i as f64 + 0.5) * step) * step);
        }
        let per_node = integral[STEPS] / (count - 1) as f64;
        let x = |degrees: f64| {
            let position = (degrees / step).clamp(0.0, STEPS as f64);
            let i = (position as usize).min(STEPS - 1);
            (integral[i] + (position - i as f64) * (integral[i + 1] - integral[i])) / per_node
        };
        let angles = (0..count)
            .map(|n| {
                let (mut low, mut high) = (0.0, LAST_DEG);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if x(middle) < n as f64 { low = middle } else { high = middle }
                }
                if n == 0 { 0.0 } else { high.to_radians() }
            })
            .collect();
        let reach = (1.0 - LAST_DEG.to_radians().cos()).sqrt();
        let table = (0..TABLE)
            .map(|i| {
                let y = reach * i as f64 / (TABLE - 1) as f64;
                x((1.0 - y * y).acos().to_degrees()) as f32
            })
            .collect();
        Self { angles, table, per_unit: ((TABLE - 1) as f64 / reach) as f32 }
    }

    /// The nodes [radians].
    pub fn angles(&self) -> &[f64] {
        &self.angles
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.angles.len()
    }

    /// Position among the nodes of the angle with this cosine, 0 to [`Self::len`] - 1; `None` beyond the last node.
    #[inline(always)]
    pub fn position(&self, cosine: f32) -> Option<f32> {
        let y = (1.0 - cosine).max(0.0).sqrt() * self.per_unit;
        let i = y as usize;
        let pair = self.table.get(i..i + 2)?;
        Some(pair[0] + (y - i as f32) * (pair[1] - pair[0]))
    }

    /// The four nodes around a position and their cubic weights.
    #[inline(always)]
    pub fn stencil(&self, position: f32) -> Stencil {
        let interval = (position as usize).min(self.angles.len() - 2);
        let first = interval.saturating_sub(1).min(self.angles.len() - 4);
        let u = position - first as f32;
        let (a, b, c) = (u - 1.0, u - 2.0, u - 3.0);
        Stencil {
            first,
            inner: interval - first,
            weights: [-a * b * c * (1.0 / 6.0), 0.5 * u * b * c, -0.5 * u * a * c, u * a * b * (1.0 / 6.0)],
        }
    }
}

/// Four neighbouring nodes and what each counts (Lagrange).
#[derive(Clone, Copy, Debug, Default)]
pub struct Stencil {
    /// The first of the four nodes.
    pub first: usize,
    /// Which of the four is just below the position.
    pub inner: usize,
    /// Weights; their sum is 1.
    pub weights: [f32; 4],
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_are_found_from_their_cosines() {
        for count in [40, 72, 120] {
            let axis = ZenithAxis::new(count);
            for (n, angle) in axis.angles().iter().enumerate().take(count - 1) {
                let position = axis.position(angle.cos() as f32).unwrap();
                assert!((position - n as f32).abs() < 2e-3, "{n}: {position}");
            }
            assert!(axis.position(126_f32.to_radians().cos()).is_none());
            assert!(axis.angles().windows(2).all(|w| w[0] < w[1]));
        }
    }

    #[test]
    fn interpolation_is_accurate_where_light_changes() {
        let axis = ZenithAxis::new(52);
        let f = |theta: f64| theta.cos() + 0.1 * (10.0 * (theta - 1.6)).tanh();
        for degrees in [0.3, 17.0, 60.0, 88.0, 93.3, 101.0, 120.0_f64] {
            let theta = degrees.to_radians();
            let stencil = axis.stencil(axis.position(theta.cos() as f32).unwrap());
            let value: f64 = (0..4).map(|a| f64::from(stencil.weights[a]) * f(axis.angles()[stencil.first + a])).sum();
            assert!((value - f(theta)).abs() < 2e-4, "{degrees}: {value} {}", f(theta));
        }
    }
}
