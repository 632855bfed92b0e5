//! The light field on the grid.
//!
//! At each node (altitude, solar zenith angle) it is the moments I_lm of the radiance in the local frame (z up, x towards the Sun's side) and, if light
//! is polarised, the tensor T = integral over all directions of the coherency matrix of the light, which is all that a dipole needs to know of it. By the mirror
//! symmetry of the plane through Sun and vertical T has four numbers: A = (Txx + Tyy) / 2, Z = Tzz, X = Txz, B = (Txx - Tyy) / 2.
//!
//! In twilight the field falls by orders of magnitude from node to node. So a node is kept as its magnitude and a field relative to it, and both, the logarithm
//! of the magnitude and the relative field, are interpolated by cubics in altitude and in the solar zenith angle.

use super::grid::Grid;
use super::harmonics::Orders;
use super::lanes::{Lanes, add_scaled, exp_one, splat};
use super::zenith_axis::Stencil;

/// Highest supported order of the spherical harmonics.
pub const MAX_ORDER: usize = 24;

/// Numbers of the tensor at a node.
pub const TENSOR: usize = 4;

/// Magnitudes below this are as good as dark.
pub const FLOOR: f32 = 1e-20;

/// What a node holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// The moments of the radiance.
    pub orders: Orders,
    /// Whether the tensor follows them.
    pub polarised: bool,
}

impl Shape {
    /// How many numbers a node holds.
    #[inline(always)]
    pub fn count(self) -> usize {
        self.orders.count() + if self.polarised { TENSOR } else { 0 }
    }

    /// The same with fewer orders.
    pub fn truncated(self, order: usize) -> Self {
        Self { orders: Orders::new(order.min(self.orders.order), self.orders.azimuthal), ..self }
    }
}

/// The light field on the grid, and the diffuse irradiance of the ground.
#[derive(Clone)]
pub struct Field<const N: usize> {
    /// What a node holds.
    pub shape: Shape,
    /// Moments and tensor [per unit solar irradiance], (altitude, solar zenith angle, number).
    pub values: Vec<Lanes<N>>,
    /// Diffuse irradiance on the ground per unit solar irradiance, by solar zenith angle.
    pub ground: Vec<Lanes<N>>,
}

impl<const N: usize> Field<N> {
    /// A dark field.
    pub fn dark(grid: &Grid, shape: Shape) -> Self {
        let nodes = grid.altitudes.len() * grid.zeniths.len();
        Self { shape, values: vec![splat(0.0); nodes * shape.count()], ground: vec![splat(0.0); grid.zeniths.len()] }
    }

    /// Adds `other`, of the same shape.
    pub fn add(&mut self, other: &Self) {
        debug_assert_eq!(self.shape, other.shape);
        for (a, b) in self.values.iter_mut().zip(&other.values) {
            add_scaled(a, 1.0, b);
        }
        for (a, b) in self.ground.iter_mut().zip(&other.ground) {
            add_scaled(a, 1.0, b);
        }
    }

    /// Mean over wavelengths of I_00 at each node: the magnitude that scales interpolation.
    pub fn magnitudes(&self) -> Vec<f32> {
        self.values.chunks_exact(self.shape.count()).map(|node| mean(&node[0])).collect()
    }
}

/// Mean of the lanes, at least the floor of darkness.
pub fn mean<const N: usize>(lanes: &Lanes<N>) -> f32 {
    (lanes.iter().sum::<f32>() / N as f32).max(FLOOR)
}

/// A field prepared for interpolation.
pub struct Relative<const N: usize> {
    /// What a node holds.
    pub shape: Shape,
    /// The field divided by the magnitude of its node, (altitude, solar zenith angle, number).
    pub values: Vec<Lanes<N>>,
    /// ln of the magnitude, (altitude, solar zenith angle).
    pub log_magnitudes: Vec<f32>,
    /// Irradiance of the ground divided by its magnitude, by solar zenith angle.
    pub ground: Vec<Lanes<N>>,
    /// ln of that magnitude.
    pub ground_log_magnitudes: Vec<f32>,
}

impl<const N: usize> Relative<N> {
    /// Of `field`.
    pub fn new(field: &Field<N>) -> Self {
        let magnitudes = field.magnitudes();
        let divided = |lanes: &Lanes<N>, magnitude: f32| lanes.map(|value| value / magnitude);
        let nodes = field.values.chunks_exact(field.shape.count()).zip(&magnitudes);
        let ground: Vec<f32> = field.ground.iter().map(mean).collect();
        Self {
            shape: field.shape,
            values: nodes.flat_map(|(node, &magnitude)| node.iter().map(move |lanes| divided(lanes, magnitude))).collect(),
            log_magnitudes: magnitudes.iter().map(|m| m.ln()).collect(),
            ground: field.ground.iter().zip(&ground).map(|(lanes, &magnitude)| divided(lanes, magnitude)).collect(),
            ground_log_magnitudes: ground.iter().map(|m| m.ln()).collect(),
        }
    }

    /// How many sections [`Self::to_sections`] gives.
    pub const SECTIONS: usize = 4;

    /// All its numbers.
    pub fn to_sections(&self) -> [Vec<f32>; 4] {
        [
            Lanes::concat(&self.values),
            self.log_magnitudes.clone(),
            Lanes::concat(&self.ground),
            self.ground_log_magnitudes.clone(),
        ]
    }

    /// The field on `grid` of which [`Self::to_sections`] gave `sections`; `None` if they are not as many or as long as that.
    pub fn from_sections(grid: &Grid, shape: Shape, sections: &[Vec<f32>]) -> Option<Self> {
        let [values, log_magnitudes, ground, ground_log_magnitudes] = sections else { return None };
        let zeniths = grid.zeniths.len();
        let nodes = grid.altitudes.len() * zeniths;
        let lengths = [nodes * shape.count() * N, nodes, zeniths * N, zeniths];
        let fits = sections.iter().zip(lengths).all(|(section, length)| section.len() == length);
        fits.then(|| Self {
            shape,
            values: Lanes::split(values),
            log_magnitudes: log_magnitudes.clone(),
            ground: Lanes::split(ground),
            ground_log_magnitudes: ground_log_magnitudes.clone(),
        })
    }

    /// Diffuse irradiance of the ground per unit solar irradiance for the cosine of the solar zenith angle.
    #[inline(always)]
    pub fn ground_irradiance(&self, grid: &Grid, zenith_cosine: f64) -> Lanes<N> {
        let mut sum = splat(0.0);
        if let Some(position) = grid.zeniths.position(zenith_cosine as f32) {
            let stencil = grid.zeniths.stencil(position);
            let magnitude = exp_one(log_magnitude(&stencil, &self.ground_log_magnitudes));
            for (weight, ground) in stencil.weights.into_iter().zip(&self.ground[stencil.first..]) {
                add_scaled(&mut sum, magnitude * weight, ground);
            }
        }
        sum
    }
}

/// The cubic through four logarithms of magnitudes, kept near those of the two nodes around the place: next to a node in the dark it could overshoot wildly.
#[inline(always)]
pub fn log_magnitude(stencil: &Stencil, nodes: &[f32]) -> f32 {
    let logs = &nodes[stencil.first..stencil.first + 4];
    let w = &stencil.weights;
    let log = (w[0] * logs[0] + w[1] * logs[1]) + (w[2] * logs[2] + w[3] * logs[3]);
    let (one, other) = (logs[stencil.inner], logs[stencil.inner + 1]);
    // Magnitudes are finite, so that nothing has to be done about NaN, as `min` and `max` would at twice the cost.
    let (low, high) = if one < other { (one - 0.2, other + 0.2) } else { (other - 0.2, one + 0.2) };
    let log = if log < high { log } else { high };
    if log > low { log } else { low }
}
