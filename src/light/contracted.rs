//! The light that the solved field scatters into a ray at one of its points.
//!
//! The source is S = sum_m cos(m p) sum_l [sum over components sigma chi_l] y_lm(mu) I_lm, and for the dipoles of polarised light likewise in A, Z, X, B
//! ([`super::stokes`]). For a fixed point of a ray the sum over l, over components and the interpolation in altitude do not depend on the Sun: they are done once for all solar zenith
//! angles ([`Contracted::fill`]); then each position of the Sun and each azimuth costs a few terms ([`Contracted::add`]).

use super::air::Air;
use super::grid::Grid;
use super::harmonics;
use super::lanes::{Lanes, add_product, exp_one, splat};
use super::ray::RayPoint;
use super::source::{FLOOR, MAX_ORDER, Relative, Shape, TENSOR, log_magnitude};
use super::stokes::DipoleSource;
use super::suns::Suns;
use super::zenith_axis::Stencil;
use std::f64::consts::PI;
use std::ops::Range;

/// Parts of Q (m = 0, 1, 2) and U (m = 1, 2) in the terms of a node, after those of I.
const POLARISED_TERMS: usize = 5;

/// Orders that scatter less than this part of all light at a point are left out there.
const NEGLIGIBLE: f32 = 1e-5;

/// Work space: for one point of a ray, what remains when altitude, l and components are summed.
pub struct Contracted<const N: usize> {
    shape: Shape,
    /// (solar zenith angle, term), relative to the magnitude of the solar zenith angle.
    terms: Vec<Lanes<N>>,
    log_magnitudes: Vec<f32>,
    /// Highest m at the point.
    azimuthal: usize,
    stencils: Vec<(f32, Stencil)>,
}

impl<const N: usize> Contracted<N> {
    /// For fields of `shape`.
    pub fn new(grid: &Grid, shape: Shape) -> Self {
        let n = grid.zeniths.len();
        let stride = Self::stride(shape);
        Self { shape, terms: vec![splat(0.0); n * stride], log_magnitudes: vec![0.0; n], azimuthal: 0, stencils: Vec::new() }
    }

    fn stride(shape: Shape) -> usize {
        shape.orders.azimuthal + 1 + if shape.polarised { POLARISED_TERMS } else { 0 }
    }

    /// Sums over altitude, l and components at `point` for the solar zenith angles in `range`.
    #[inline(always)]
    pub fn fill(&mut self, grid: &Grid, source: &Relative<N>, air: &Air<N>, point: &RayPoint<N>, range: Range<usize>) {
        let Shape { orders, polarised } = self.shape;
        let mut harmonic = [0.0; harmonics::Orders::new(MAX_ORDER, MAX_ORDER).count()];
        harmonics::evaluate(orders, point.zenith_cosine, &mut harmonic);
        // Strength of each order, and of the dipoles: weight of the point times the sum over components of scattering times Legendre moment.
        let mut strength = [splat::<N>(0.0); MAX_ORDER + 1];
        let mut dipole = splat::<N>(0.0);
        let mut total = splat::<N>(0.0);
        for scatterer in air.scatterers() {
            let mut weighted = scatterer.coefficient(point.place);
            for n in 0..N {
                weighted[n] *= point.weight[n];
                total[n] += weighted[n];
            }
            for l in 0..=orders.order {
                add_product(&mut strength[l], &weighted, &scatterer.moments[l]);
            }
            if let Some(share) = &scatterer.dipole_share {
                for n in 0..N {
                    dipole[n] += (3.0 / (8.0 * PI)) as f32 * share[n] * weighted[n];
                }
            }
        }
        let matters = |l: usize| strength[l].iter().zip(&total).any(|(s, t)| s.abs() > NEGLIGIBLE * t);
        let order = (0..=orders.order).rev().find(|&l| matters(l)).unwrap_or(0);
        self.azimuthal = orders.last(order).max(if polarised { 2.min(orders.azimuthal) } else { 0 });
        let stride = Self::stride(self.shape);
        let zeniths = grid.zeniths.len();
        let cubic = grid.altitudes.cubic(point.altitude);
        let count = self.shape.count();
        let factors = DipoleSource::new(point.zenith_cosine);
        for j in range {
            let logs: [f32; 4] = std::array::from_fn(|k| source.log_magnitudes[(cubic.first + k) * zeniths + j]);
            self.log_magnitudes[j] =
                log_magnitude(&Stencil { first: 0, inner: cubic.interval - cubic.first, weights: cubic.weights }, &logs);
            let nodes: [&[Lanes<N>]; 4] = std::array::from_fn(|k| {
                let start = ((cubic.first + k) * zeniths + j) * count;
                &source.values[start..start + count]
            });
            let terms = &mut self.terms[j * stride..(j + 1) * stride];
            for m in 0..=self.azimuthal {
                let mut sum = splat::<N>(0.0);
                for l in m..=order {
                    let lm = orders.start(l) + m;
                    let w = cubic.weights.map(|w| w * harmonic[lm]);
                    let [a, b, c, d] = nodes.map(|node| &node[lm]);
                    let strength = &strength[l];
                    for n in 0..N {
                        sum[n] += strength[n] * ((w[0] * a[n] + w[1] * b[n]) + (w[2] * c[n] + w[3] * d[n]));
                    }
                }
                terms[m] = sum;
            }
            if polarised {
                let w = cubic.weights;
                let tensor: [Lanes<N>; TENSOR] = std::array::from_fn(|t| {
                    let [a, b, c, d] = nodes.map(|node| &node[count - TENSOR + t]);
                    let mut value = splat(0.0);
                    for n in 0..N {
                        value[n] = dipole[n] * ((w[0] * a[n] + w[1] * b[n]) + (w[2] * c[n] + w[3] * d[n]));
                    }
                    value
                });
                let (i, qu) = terms.split_at_mut(orders.azimuthal + 1);
                add_dipole(&factors, &tensor, i, qu);
            }
        }
    }

    /// Adds the scattered light to the sums of each position of the Sun and azimuth in `suns`, which are placed at the point that was filled in: I, or I, Q, U.
    #[inline(always)]
    pub fn add(&mut self, grid: &Grid, suns: &Suns, sums: &mut [Lanes<N>]) {
        let stride = Self::stride(self.shape);
        let first_polarised = self.shape.orders.azimuthal + 1;
        self.stencils.clear();
        self.stencils.extend(suns.positions.iter().map(|&position| {
            if position < 0.0 {
                return (0.0, Stencil::default());
            }
            let stencil = grid.zeniths.stencil(position);
            (exp_one(log_magnitude(&stencil, &self.log_magnitudes)), stencil)
        }));
        let stokes = if self.shape.polarised { 3 } else { 1 };
        for (k, ((magnitude, stencil), sum)) in self.stencils.iter().zip(sums.chunks_exact_mut(stokes)).enumerate() {
            if *magnitude < 4.0 * FLOOR {
                continue;
            }
            let weights = stencil.weights.map(|w| w * magnitude);
            let nodes = &self.terms[stencil.first * stride..(stencil.first + 4) * stride];
            let (cosine, sine) = (suns.azimuth_cosines[k], suns.azimuth_sines[k]);
            // cos(m p) by Chebyshev's recurrence.
            let (mut before, mut now) = (cosine, 1.0_f32);
            for m in 0..=self.azimuthal {
                add_term(&mut sum[0], weights, now, nodes, stride, m);
                (before, now) = (now, 2.0 * cosine * now - before);
            }
            if let [_, q, u] = sum {
                let double = 2.0 * cosine * cosine - 1.0;
                for (wave, term) in [(1.0, 0), (cosine, 1), (double, 2)] {
                    add_term(q, weights, wave, nodes, stride, first_polarised + term);
                }
                for (wave, term) in [(sine, 3), (2.0 * sine * cosine, 4)] {
                    add_term(u, weights, wave, nodes, stride, first_polarised + term);
                }
            }
        }
    }
}

/// Adds `wave` times term `term`, interpolated between four nodes.
#[inline(always)]
fn add_term<const N: usize>(sum: &mut Lanes<N>, weights: [f32; 4], wave: f32, nodes: &[Lanes<N>], stride: usize, term: usize) {
    let [w0, w1, w2, w3] = weights.map(|w| w * wave);
    let (a, b, c, d) = (&nodes[term], &nodes[stride + term], &nodes[2 * stride + term], &nodes[3 * stride + term]);
    for n in 0..N {
        sum[n] += (w0 * a[n] + w1 * b[n]) + (w2 * c[n] + w3 * d[n]);
    }
}

/// Adds the source of the dipoles in the light with `tensor` = A, Z, X, B to the terms of I, and sets those of Q and U.
#[inline(always)]
fn add_dipole<const N: usize>(f: &DipoleSource, tensor: &[Lanes<N>; TENSOR], i: &mut [Lanes<N>], qu: &mut [Lanes<N>]) {
    let [a, z, x, b] = tensor;
    for n in 0..N {
        i[0][n] += f.i0_a * a[n] + f.i0_z * z[n];
        i[1][n] += f.iq1_x * x[n];
        i[2][n] += f.i2_b * b[n];
        qu[0][n] = f.q0_za * (z[n] - a[n]);
        qu[1][n] = f.iq1_x * x[n];
        qu[2][n] = f.q2_b * b[n];
        qu[3][n] = f.u1_x * x[n];
        qu[4][n] = f.u2_b * b[n];
    }
}
