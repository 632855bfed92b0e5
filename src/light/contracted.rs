//! The light that the solved field scatters into a ray at one of its points.
//!
//! The source is S = sum_m cos(m p) sum_l [sum over components sigma chi_l] y_lm(mu) I_lm, and for the dipoles of polarised light likewise in A, Z, X, B
//! ([`super::stokes`]). For a fixed point of a ray the sum over l, over components and the interpolation in altitude do not depend on the Sun: they are done once for all solar zenith
//! angles ([`Contracted::fill`]); then each position of the Sun and each azimuth costs a few terms ([`Contracted::add`]).

use super::air::Air;
use super::grid::Grid;
use super::harmonics;
use super::lanes::{Lanes, add_product, exp_one, multiply_add, splat};
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

/// Logarithm of no light at all.
const DARK: f32 = -100.0;

/// Work space: for one point of a ray, what remains when altitude, l and components are summed. `FUSED`: see [`multiply_add`].
pub struct Contracted<const N: usize, const FUSED: bool> {
    shape: Shape,
    /// (solar zenith angle, term), relative to the magnitude of the solar zenith angle.
    terms: Vec<Lanes<N>>,
    log_magnitudes: Vec<f32>,
    /// What each moment of the light counts at the point.
    moment_strengths: Vec<Lanes<N>>,
    /// Highest m at the point.
    azimuthal: usize,
    /// Work space by position of the Sun and azimuth.
    stencils: Vec<Stencil>,
    magnitudes: Vec<f32>,
}

impl<const N: usize, const FUSED: bool> Contracted<N, FUSED> {
    /// For fields of `shape`.
    pub fn new(grid: &Grid, shape: Shape) -> Self {
        let n = grid.zeniths.len();
        let stride = Self::stride(shape);
        Self {
            shape,
            terms: vec![splat(0.0); n * stride],
            log_magnitudes: vec![0.0; n],
            moment_strengths: vec![splat(0.0); shape.orders.count()],
            azimuthal: 0,
            stencils: Vec::new(),
            magnitudes: Vec::new(),
        }
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
        for l in 0..=order {
            for m in 0..=self.azimuthal.min(l) {
                let lm = orders.start(l) + m;
                self.moment_strengths[lm] = strength[l].map(|strength| strength * harmonic[lm]);
            }
        }
        let stride = Self::stride(self.shape);
        let zeniths = grid.zeniths.len();
        let cubic = grid.altitudes.cubic(point.altitude);
        let count = self.shape.count();
        let factors = DipoleSource::new(point.zenith_cosine);
        for j in range {
            let logs = [0, 1, 2, 3].map(|k| source.log_magnitudes[(cubic.first + k) * zeniths + j]);
            self.log_magnitudes[j] =
                log_magnitude(&Stencil { first: 0, inner: cubic.interval - cubic.first, weights: cubic.weights }, &logs);
            let nodes: [&[Lanes<N>]; 4] = [0, 1, 2, 3].map(|k| {
                let start = ((cubic.first + k) * zeniths + j) * count;
                &source.values[start..start + count]
            });
            let terms = &mut self.terms[j * stride..(j + 1) * stride];
            for m in 0..=self.azimuthal {
                let mut sum = splat::<N>(0.0);
                for l in m..=order {
                    let lm = orders.start(l) + m;
                    let w = cubic.weights;
                    let [a, b, c, d] = nodes.map(|node| &node[lm]);
                    let strength = &self.moment_strengths[lm];
                    for n in 0..N {
                        sum[n] = multiply_add::<FUSED>(strength[n], combine::<FUSED>(w, [a[n], b[n], c[n], d[n]]), sum[n]);
                    }
                }
                terms[m] = sum;
            }
            if polarised {
                let w = cubic.weights;
                let mut tensor = [splat::<N>(0.0); TENSOR];
                for (t, value) in tensor.iter_mut().enumerate() {
                    let [a, b, c, d] = nodes.map(|node| &node[count - TENSOR + t]);
                    for n in 0..N {
                        value[n] = dipole[n] * combine::<FUSED>(w, [a[n], b[n], c[n], d[n]]);
                    }
                }
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
        let n = suns.positions.len();
        self.magnitudes.resize(n, 0.0);
        self.stencils.resize(n, Stencil::default());
        let logs = &mut self.magnitudes[..n];
        for k in 0..n {
            let stencil = grid.zeniths.stencil(suns.positions[k].max(0.0));
            let log = log_magnitude(&stencil, &self.log_magnitudes);
            logs[k] = if suns.positions[k] < 0.0 { DARK } else { log };
            self.stencils[k] = stencil;
        }
        for k in 0..n {
            logs[k] = exp_one(logs[k]);
        }
        let stokes = if self.shape.polarised { 3 } else { 1 };
        for (k, sum) in sums.chunks_exact_mut(stokes).enumerate() {
            let (magnitude, stencil) = (self.magnitudes[k], &self.stencils[k]);
            if magnitude < 4.0 * FLOOR {
                continue;
            }
            let weights = stencil.weights.map(|w| w * magnitude);
            let nodes = &self.terms[stencil.first * stride..(stencil.first + 4) * stride];
            let (cosine, sine) = (suns.azimuth_cosines[k], suns.azimuth_sines[k]);
            // cos(m p) by Chebyshev's recurrence.
            let (mut before, mut now) = (cosine, 1.0_f32);
            let mut i = sum[0];
            for m in 0..=self.azimuthal {
                add_term::<N, FUSED>(&mut i, weights, now, nodes, stride, m);
                (before, now) = (now, 2.0 * cosine * now - before);
            }
            sum[0] = i;
            if let [_, q_sum, u_sum] = sum {
                let double = 2.0 * cosine * cosine - 1.0;
                let mut q = *q_sum;
                add_term::<N, FUSED>(&mut q, weights, 1.0, nodes, stride, first_polarised);
                add_term::<N, FUSED>(&mut q, weights, cosine, nodes, stride, first_polarised + 1);
                add_term::<N, FUSED>(&mut q, weights, double, nodes, stride, first_polarised + 2);
                *q_sum = q;
                let mut u = *u_sum;
                add_term::<N, FUSED>(&mut u, weights, sine, nodes, stride, first_polarised + 3);
                add_term::<N, FUSED>(&mut u, weights, 2.0 * sine * cosine, nodes, stride, first_polarised + 4);
                *u_sum = u;
            }
        }
    }
}

/// The sum of four values with these weights.
#[inline(always)]
fn combine<const FUSED: bool>(weights: [f32; 4], values: [f32; 4]) -> f32 {
    let ([w0, w1, w2, w3], [a, b, c, d]) = (weights, values);
    multiply_add::<FUSED>(w0, a, multiply_add::<FUSED>(w1, b, multiply_add::<FUSED>(w2, c, w3 * d)))
}

/// Adds `wave` times term `term`, interpolated between four nodes.
#[inline(always)]
fn add_term<const N: usize, const FUSED: bool>(
    sum: &mut Lanes<N>,
    weights: [f32; 4],
    wave: f32,
    nodes: &[Lanes<N>],
    stride: usize,
    term: usize,
) {
    let (a, b, c, d) = (&nodes[term], &nodes[stride + term], &nodes[2 * stride + term], &nodes[3 * stride + term]);
    for n in 0..N {
        sum[n] = multiply_add::<FUSED>(wave, combine::<FUSED>(weights, [a[n], b[n], c[n], d[n]]), sum[n]);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::{Component, OpticalProfile, Phase};
    use crate::light::harmonics::Orders;
    use crate::light::ray::{Ray, StepLimits};
    use crate::light::source::Field;
    use crate::light::stokes::add_tensor;
    use crate::light::suns::SunOnRay;
    use crate::quality::Quality;

    const N: usize = 16;

    fn molecules() -> OpticalProfile {
        let altitudes: Vec<f64> = (0..=200).map(|i| 0.5 * f64::from(i)).collect();
        OpticalProfile {
            components: vec![Component {
                name: "molecules".into(),
                scattering_per_km: altitudes.iter().map(|z| 0.03 * (-z / 8.0).exp()).collect(),
                absorption_per_km: vec![0.0; altitudes.len()],
                phase: Some(Phase::Rayleigh { depolarisation: vec![0.03] }),
            }],
            altitudes_km: altitudes,
            wavelengths_nm: vec![450.0],
            ground_albedo: vec![0.0],
            solar_irradiance: vec![1.0],
            planet_radius_km: 6371.0,
            sun_angular_radius_deg: 0.2664,
        }
    }

    /// Moments up to l = 2, and the tensor, of the unpolarised light I = 1 + 0.3 mu + s (0.2 + 0.4 mu) cos p + 0.25 s^2 cos 2p + 0.5 mu^2.
    fn unpolarised(shape: Shape) -> Vec<Lanes<N>> {
        let mut node = vec![splat(0.0); shape.count()];
        let orders = shape.orders;
        for (t, weight) in crate::numerics::gauss::legendre(8) {
            let mu = 2.0 * t - 1.0;
            let s = (1.0 - mu * mu).sqrt();
            let waves = [1.0 + 0.3 * mu + 0.5 * mu * mu, s * (0.2 + 0.4 * mu), 0.25 * s * s];
            // Integrals over azimuth of I cos(m p).
            let parts = [2.0 * PI * waves[0], PI * waves[1], PI * waves[2]].map(|v| v * 2.0 * weight);
            let mut harmonic = vec![0.0; orders.count()];
            harmonics::evaluate(orders, mu, &mut harmonic);
            for (m, part) in parts.iter().enumerate() {
                for l in m..=orders.order {
                    let lm = orders.start(l) + m;
                    node[lm] = node[lm].map(|v| v + harmonic[lm] * *part as f32);
                }
            }
            if shape.polarised {
                let dark = splat(0.0);
                add_tensor(&mut node[orders.count()..], mu, 1.0, &parts.map(|v| splat(v as f32)), &[dark; 3], &[dark; 2]);
            }
        }
        node
    }

    /// I, Q and U, at several Suns and azimuths, that a ray receives from a field of that light.
    fn received<const FUSED: bool>(polarised: bool) -> Vec<[f32; 3]> {
        let profile = molecules();
        let numbers = Quality::Draft.numbers();
        let [grid, _] = Grid::new(&numbers, &profile);
        let air = Air::<N>::new(&profile, 0, 2, polarised);
        let shape = Shape { orders: Orders::new(2, 2), polarised };
        let mut field = Field::dark(&grid, shape);
        let node = unpolarised(shape);
        field.values = node.iter().copied().cycle().take(field.values.len()).collect();
        let source = Relative::new(&field);
        let limits = StepLimits { length_km: 25.0, optical_depth: 1.0 };
        let mut out = Vec::new();
        for mu in [0.9, 0.2, -0.6] {
            let ray = Ray::trace(&air, &grid.shells, 20.0, mu, limits);
            let on_rays: Vec<SunOnRay> = [(0.3, 0.1), (1.2, 2.0), (1.5, 3.0)]
                .into_iter()
                .map(|(zenith, azimuth): (f64, f64)| {
                    SunOnRay::new(6391.0, mu, (azimuth.cos(), azimuth.sin()), (zenith.sin(), zenith.cos()))
                })
                .collect();
            let mut suns = Suns::new(&on_rays);
            let mut contracted = Contracted::<N, FUSED>::new(&grid, shape);
            let stokes = if polarised { 3 } else { 1 };
            let mut sums = vec![splat(0.0); on_rays.len() * stokes];
            for point in &ray.points {
                contracted.fill(&grid, &source, &air, point, 0..grid.zeniths.len());
                suns.place(&grid, 6391.0, point.distance, point.radius);
                contracted.add(&grid, &suns, &mut sums);
            }
            out.extend(
                sums.chunks_exact(stokes).map(|sum| std::array::from_fn(|parameter| sum.get(parameter).map_or(0.0, |v| v[0]))),
            );
        }
        out
    }

    /// The vector code in light without polarisation, Q = U = 0, scatters what the scalar code does.
    #[test]
    fn unpolarised_light_is_scattered_as_a_scalar() {
        for ([vector, ..], [scalar, ..]) in received::<false>(true).into_iter().zip(received::<false>(false)) {
            assert!(scalar > 0.0 && (vector / scalar - 1.0).abs() < 1e-5, "{vector} {scalar}");
        }
    }

    #[test]
    fn processors_that_fuse_find_the_same_light() {
        for (fused, plain) in received::<true>(true).into_iter().zip(received::<false>(true)) {
            assert!(plain[0] > 0.0 && plain[1] != 0.0 && plain[2] != 0.0);
            for (fused, value) in fused.iter().zip(plain) {
                assert!((fused - value).abs() < 1e-5 * plain[0], "{fused} {value}");
            }
        }
    }
}
