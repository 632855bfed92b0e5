//! The dependence of scattered light on the angle from the Sun, as a sum of few functions.
//!
//! A component's singly scattered light is strength x phase function. The solved field holds the light scattered more often only in the orders l <= L of the spherical harmonics. Above L,
//! where only forward peaks have anything to say, light that is scattered several times has stayed near a line: in the small-angle limit
//! light that passed the scattering optical depth X has, order by order, the moments (exp(X chi_l) - 1) instead of X chi_l (the moments of a chain of n scatterings are
//! chi_l^n: Goudsmit & Saunderson 1940; van de Hulst 1980, ch. 14). So strength multiplies, instead of the phase function P,
//! ```text
//! P + sum_{l > L} (2 l + 1) P_l(cos) [ (exp(X chi_l) - 1) / X - chi_l ]
//! ```
//! with X the path, [`super::single::add_strengths_and_paths`]. It widens aureoles, and cancels the ripples that the cut at L leaves in the field.
//!
//! As a function of the scattering angle this is needed for each wavelength and path. All these functions are nearly combinations of a few of them, which a pivoted
//! Gram-Schmidt process picks: sums over wavelengths can then be done before the angle is known, and a pixel costs a few products.

use super::axis::Axis;
use crate::atmosphere::Phase;

/// Entries of the tables of functions, equidistant in sqrt(sin(angle / 2)).
const ENTRIES: usize = 1025;

/// Paths at which functions are made; between them, weights are interpolated, beyond the last they stay.
const PATHS: [f64; 13] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0];

/// Most Legendre moments that are asked for.
const MOST_MOMENTS: usize = 1200;

/// Moments smaller than this do not matter.
const SMALLEST_MOMENT: f64 = 1e-3;

/// Relative error at which the functions that were picked suffice for all others.
const TOLERANCE: f64 = 1e-3;

/// The functions of one component.
pub enum AngularFunctions {
    /// 1 and cos^2 with their weights by wavelength: exact.
    Molecules(Vec<[f64; 2]>),
    /// Tabulated.
    Table(Table),
}

/// Functions in a table, and how they combine.
pub struct Table {
    /// (entry, function).
    entries: Vec<f32>,
    count: usize,
    paths: Axis,
    /// Weights by (wavelength, path, function) of the phase function, and of the addition for a path times exp(-`growth` path).
    weights: Vec<f64>,
    /// Growth of the addition with the path, by wavelength.
    growth: Vec<f64>,
}

impl AngularFunctions {
    /// For `phase` at a number of wavelengths, beside a field that holds orders up to `order`.
    pub fn new(phase: &Phase, wavelengths: usize, order: usize) -> Self {
        if let Phase::Rayleigh { .. } = phase {
            return Self::Molecules((0..wavelengths).map(|w| [phase.basis_weight(0, w), phase.basis_weight(1, w)]).collect());
        }
        Self::Table(Table::new(phase, wavelengths, order))
    }

    /// Number of functions.
    #[allow(clippy::len_without_is_empty, reason = "there is always at least one")]
    pub fn len(&self) -> usize {
        match self {
            Self::Molecules(_) => 2,
            Self::Table(table) => table.count,
        }
    }

    /// Writes the functions at scattering angles, given as haversines (1 - cos) / 2: function f of angle i to `out[f][i]`.
    #[inline(always)]
    pub fn values<const M: usize>(&self, haversines: &[f32], out: &mut [[f32; M]]) {
        match self {
            Self::Molecules(_) => {
                for (i, haversine) in haversines.iter().enumerate() {
                    let cosine = 1.0 - 2.0 * haversine;
                    out[0][i] = 1.0;
                    out[1][i] = cosine * cosine;
                }
            }
            Self::Table(table) => {
                let n = table.count;
                for (i, haversine) in haversines.iter().enumerate() {
                    let position = haversine.clamp(0.0, 1.0).sqrt().sqrt() * (ENTRIES - 1) as f32;
                    let entry = (position as usize).min(ENTRIES - 2);
                    let fraction = position - entry as f32;
                    let (a, b) = table.entries[entry * n..(entry + 2) * n].split_at(n);
                    for ((row, a), b) in out.iter_mut().zip(a).zip(b) {
                        row[i] = a + fraction * (b - a);
                    }
                }
            }
        }
    }

    /// Writes the weights of the functions at wavelength index `wavelength` for the scattering optical depth `path` to `out`, which has [`Self::len`] places.
    pub fn weights(&self, wavelength: usize, path: f64, out: &mut [f64]) {
        match self {
            Self::Molecules(weights) => out.copy_from_slice(&weights[wavelength]),
            Self::Table(table) => {
                let path = path.clamp(0.0, PATHS[PATHS.len() - 1]);
                let n = table.count;
                let cubic = table.paths.cubic(path);
                let of = |p: usize| &table.weights[(wavelength * PATHS.len() + p) * n..][..n];
                // At path 0 stands the phase function itself, and the addition there is 0.
                out.copy_from_slice(of(0));
                let growth = (table.growth[wavelength] * path).exp();
                for (a, weight) in cubic.weights.into_iter().enumerate().filter(|(a, _)| cubic.first + a > 0) {
                    for (sum, value) in out.iter_mut().zip(of(cubic.first + a)) {
                        *sum += growth * f64::from(weight) * value;
                    }
                }
            }
        }
    }

    /// The sum of functions times weights.
    pub fn value(&self, wavelength: usize, path: f64, cosine: f64) -> f64 {
        let (mut values, mut weights) = (vec![[0.0]; self.len()], vec![0.0; self.len()]);
        self.values(&[(0.5 * (1.0 - cosine)) as f32], &mut values);
        self.weights(wavelength, path, &mut weights);
        values.iter().zip(&weights).map(|(v, w)| f64::from(v[0]) * w).sum()
    }
}

/// Cosine of the scattering angle of an entry.
fn cosine_at(entry: usize) -> f64 {
    1.0 - 2.0 * (entry as f64 / (ENTRIES - 1) as f64).powi(4)
}

impl Table {
    fn new(phase: &Phase, wavelengths: usize, order: usize) -> Self {
        let cosines: Vec<f64> = (0..ENTRIES).map(cosine_at).collect();
        let moments: Vec<Vec<f64>> = (0..wavelengths).map(|w| moments(phase, w)).collect();
        let most = moments.iter().map(Vec::len).max().unwrap_or(0);
        let legendre = legendre_table(most, &cosines);
        let mut growth = Vec::with_capacity(wavelengths);
        let mut functions = Vec::with_capacity(wavelengths * PATHS.len());
        // Relative to the mean phase function, so that backward directions count as much as the aureole.
        let mut scale = vec![0.0; ENTRIES];
        for (w, moments) in moments.iter().enumerate() {
            let rate = moments.get(order + 1..).unwrap_or(&[]).iter().fold(0.0, |a: f64, &b| a.max(b));
            growth.push(rate);
            for path in PATHS {
                let mut function = vec![0.0; ENTRIES];
                if path == 0.0 {
                    for ((value, sum), &cosine) in function.iter_mut().zip(&mut scale).zip(&cosines) {
                        *value = phase.value(w, cosine);
                        *sum += *value / wavelengths as f64;
                    }
                } else {
                    for (l, &chi) in moments.iter().enumerate().skip(order + 1) {
                        let addition = ((path * chi).exp_m1() / path - chi) * (-rate * path).exp() * (2 * l + 1) as f64;
                        for (value, p) in function.iter_mut().zip(&legendre[l]) {
                            *value += addition * p;
                        }
                    }
                }
                functions.push(function);
            }
        }
        for function in &mut functions {
            for (value, scale) in function.iter_mut().zip(&scale) {
                *value /= scale.max(1e-12);
            }
        }
        let (basis, weights) = pick(&functions);
        let count = basis.len();
        let entries =
            (0..ENTRIES).flat_map(|e| basis.iter().map(move |b| (e, b)).map(|(e, b)| (b[e] * scale[e]) as f32)).collect();
        Self { entries, count, paths: Axis::new(PATHS.to_vec()), weights, growth }
    }
}

/// Legendre moments that matter.
fn moments(phase: &Phase, wavelength: usize) -> Vec<f64> {
    let mut moments: Vec<f64> = (0..64).map(|l| phase.legendre_moment(l, wavelength)).collect();
    if moments[63].abs() > SMALLEST_MOMENT {
        moments = (0..MOST_MOMENTS).map(|l| phase.legendre_moment(l, wavelength)).collect();
    }
    let last = moments.iter().rposition(|m| m.abs() > SMALLEST_MOMENT).unwrap_or(0);
    moments.truncate(last + 1);
    moments
}

/// P_l at `cosines` for l below `count`.
fn legendre_table(count: usize, cosines: &[f64]) -> Vec<Vec<f64>> {
    let mut table: Vec<Vec<f64>> = Vec::with_capacity(count);
    for l in 0..count {
        let row = match l {
            0 => vec![1.0; cosines.len()],
            1 => cosines.to_vec(),
            _ => {
                let n = l as f64;
                let (one, two) = (&table[l - 1], &table[l - 2]);
                cosines.iter().zip(one).zip(two).map(|((x, a), b)| ((2.0 * n - 1.0) * x * a - (n - 1.0) * b) / n).collect()
            }
        };
        table.push(row);
    }
    table
}

/// Orthonormal functions that reproduce all of `functions` within the tolerance, relative to the largest value of each and to that of the smoothest, and the weights (function, basis) that do.
fn pick(functions: &[Vec<f64>]) -> (Vec<Vec<f64>>, Vec<f64>) {
    let largest = |f: &[f64]| f.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let limits: Vec<f64> = functions.iter().map(|f| TOLERANCE * largest(f).max(1e-2)).collect();
    let mut rest = functions.to_vec();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut weights = vec![Vec::new(); functions.len()];
    while basis.len() < functions.len() {
        let excess = rest.iter().zip(&limits).map(|(f, limit)| largest(f) / limit);
        let Some((worst, excess)) = excess.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if excess < 1.0 {
            break;
        }
        let length = rest[worst].iter().map(|v| v * v).sum::<f64>().sqrt();
        let direction: Vec<f64> = rest[worst].iter().map(|v| v / length).collect();
        for (f, weights) in rest.iter_mut().zip(&mut weights) {
            let share: f64 = f.iter().zip(&direction).map(|(a, b)| a * b).sum();
            f.iter_mut().zip(&direction).for_each(|(a, b)| *a -= share * b);
            weights.push(share);
        }
        basis.push(direction);
    }
    (basis, weights.concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_a_path_the_phase_function_remains() {
        for phase in [
            Phase::HenyeyGreenstein { asymmetry: 0.85 },
            Phase::CornetteShanks { asymmetry: 0.7 },
            Phase::Rayleigh { depolarisation: vec![0.03] },
        ] {
            let functions = AngularFunctions::new(&phase, 1, 8);
            for degrees in [0.0, 0.5, 3.0, 20.0, 90.0, 170.0, 180.0_f64] {
                let cosine = degrees.to_radians().cos();
                let (found, expected) = (functions.value(0, 0.0, cosine), phase.value(0, cosine));
                assert!((found / expected - 1.0).abs() < 2e-3, "{phase:?} {degrees}: {found} {expected}");
            }
        }
    }

    /// For Henyey-Greenstein, n scatterings in line have the phase function with g^n: the series can be summed in closed form.
    #[test]
    fn the_addition_is_light_scattered_repeatedly_in_line() {
        let (g, order) = (0.9_f64, 6);
        let phase = Phase::HenyeyGreenstein { asymmetry: g };
        let functions = AngularFunctions::new(&phase, 1, order);
        for path in [0.3, 1.0, 2.5] {
            for degrees in [1.0, 5.0, 20.0, 60.0, 140.0_f64] {
                let cosine = degrees.to_radians().cos();
                let mut expected = phase.value(0, cosine);
                let mut factor = 1.0;
                for n in 2..30_i32 {
                    factor *= path / f64::from(n);
                    let chain = Phase::HenyeyGreenstein { asymmetry: g.powi(n) };
                    let low: f64 = legendre_table(order + 1, &[cosine])
                        .iter()
                        .enumerate()
                        .map(|(l, p)| (2 * l + 1) as f64 * p[0] * chain.legendre_moment(l, 0))
                        .sum();
                    expected += factor * (chain.value(0, cosine) - low);
                }
                let found = functions.value(0, path, cosine);
                assert!(
                    (found - expected).abs() < 5e-3 * phase.value(0, cosine).max(expected.abs()),
                    "{path} {degrees}: {found} {expected}"
                );
            }
        }
    }
}
