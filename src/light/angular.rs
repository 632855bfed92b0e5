//! The dependence of scattered light on the angle from the Sun, as a sum of few functions.
//!
//! The field holds light in the orders l <= L of the spherical harmonics, and for it forward peaks are not scattering at all ([`super::air`]). What a direction sees of light that came
//! straight from the Sun is then two parts:
//! - strength x the phase function without its forward peak, sum_{l <= L} (2 l + 1) P_l (chi_l - f) / (1 - f), in air where the peak is transmission;
//! - direct strength x the forward peak, all its repetitions included. Light that is scattered several times into the peak has stayed near a line, and in this small-angle limit a chain of n scatterings
//!   has the moments chi_l^n, so that along a path of scattering optical depth X all of them together have (exp(X chi_l) - 1) / X, in units of the first without any others
//!   (Goudsmit & Saunderson 1940; van de Hulst 1980, ch. 14):
//! ```text
//! sum_l (2 l + 1) P_l (exp(X c_l) - 1) / X,   c_l = chi_l for l > L, f for l <= L
//! ```
//! The Sun is a disc, not a point: its own moments multiply those of the peak, which a fog's diffraction peak feels at several degrees.
//! At X = 0 both parts are the phase function. This carries delta-M with its TMS and IMS corrections (Nakajima & Tanaka 1988, J. Quant. Spectrosc. Radiat. Transfer 40, 51) to all orders.
//!
//! As a function of the scattering angle this is needed for each wavelength and path. All these functions are nearly combinations of a few of them, which a pivoted
//! Gram-Schmidt process picks: sums over wavelengths can then be done before the angle is known, and a pixel costs a few products.

mod rows;

pub use rows::{BLOCK, FunctionRows, Located};

use super::air::forward_share;
use crate::atmosphere::Phase;
use crate::numerics::Axis;
use multiversion::multiversion;
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::sync::atomic::{AtomicBool, Ordering};

/// Entries of the tables of functions, equidistant in sqrt(sin(angle / 2)).
const ENTRIES: usize = 1025;

/// Paths at which functions are made; between them, weights are interpolated, beyond the last they stay.
const PATHS: [f64; 13] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0];

/// Most Legendre moments that are asked for.
const MOST_MOMENTS: usize = 1200;

/// Moments smaller than this do not matter.
const SMALLEST_MOMENT: f64 = 3e-4;

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
    /// (entry, function): those of the forward peak, then those of the rest.
    entries: Vec<f32>,
    count: usize,
    /// How many functions belong to the forward peak.
    peak: usize,
    paths: Axis,
    /// Weights by (wavelength, path, function) of the forward peak times exp(-`growth` path).
    peak_weights: Vec<f64>,
    /// Growth of the peak with the path, by wavelength.
    growth: Vec<f64>,
    /// Weights by (wavelength, function) of the rest.
    rest_weights: Vec<f64>,
}

/// What is gathered of light scattered once, at one wavelength; see [`super::Gathered`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Once {
    /// Strength without the forward peak [sr-1].
    pub strength: f64,
    /// Strength of light that came straight from the Sun and straight to the observer [sr-1].
    pub direct_strength: f64,
    /// Scattering optical depth that it passed.
    pub path: f64,
}

impl AngularFunctions {
    /// For `phase` at a number of wavelengths, beside a field that holds orders up to `order`, and a Sun of angular radius `sun_radius` [radians].
    pub fn new(phase: &Phase, wavelengths: usize, order: usize, sun_radius: f64) -> Self {
        Self::unless(&AtomicBool::new(false), phase, wavelengths, order, sun_radius)
    }

    /// The same, soon and of no use if `given_up` is set on the way.
    pub fn unless(given_up: &AtomicBool, phase: &Phase, wavelengths: usize, order: usize, sun_radius: f64) -> Self {
        if let Some(weights) = (0..wavelengths).map(|w| phase.molecular_weights(w)).collect() {
            return Self::Molecules(weights);
        }
        Self::Table(Table::new(given_up, phase, wavelengths, order, sun_radius))
    }

    /// Number of functions.
    #[allow(clippy::len_without_is_empty, reason = "there is always at least one")]
    pub fn len(&self) -> usize {
        match self {
            Self::Molecules(_) => 2,
            Self::Table(table) => table.count,
        }
    }

    /// How many of the first functions are those of the forward peak, whose weights are those of light that came straight from the Sun.
    pub fn peak_len(&self) -> usize {
        match self {
            Self::Molecules(_) => 0,
            Self::Table(table) => table.peak,
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

    /// Writes the weights [sr-1] of the functions at wavelength index `wavelength` for what was gathered to `out`, which has [`Self::len`] places.
    pub fn weights(&self, wavelength: usize, once: &Once, out: &mut [f64]) {
        match self {
            Self::Molecules(weights) => {
                for (out, weight) in out.iter_mut().zip(weights[wavelength]) {
                    *out = once.strength * weight;
                }
            }
            Self::Table(table) => {
                let path = once.path.clamp(0.0, PATHS[PATHS.len() - 1]);
                let (peak, rest) = out.split_at_mut(table.peak);
                let cubic = table.paths.cubic(path);
                let direct = once.direct_strength * (table.growth[wavelength] * path).exp();
                peak.fill(0.0);
                for (a, weight) in cubic.weights.into_iter().enumerate() {
                    let start = (wavelength * PATHS.len() + cubic.first + a) * table.peak;
                    for (sum, value) in peak.iter_mut().zip(&table.peak_weights[start..]) {
                        *sum += direct * f64::from(weight) * value;
                    }
                }
                let start = wavelength * (table.count - table.peak);
                for (out, weight) in rest.iter_mut().zip(&table.rest_weights[start..]) {
                    *out = once.strength * weight;
                }
            }
        }
    }

    /// The sum of functions times weights [sr-1].
    pub fn value(&self, wavelength: usize, once: &Once, cosine: f64) -> f64 {
        let (mut values, mut weights) = (vec![[0.0]; self.len()], vec![0.0; self.len()]);
        self.values(&[(0.5 * (1.0 - cosine)) as f32], &mut values);
        self.weights(wavelength, once, &mut weights);
        values.iter().zip(&weights).map(|(v, w)| f64::from(v[0]) * w).sum()
    }
}

/// Cosine of the scattering angle of an entry.
fn cosine_at(entry: usize) -> f64 {
    1.0 - 2.0 * (entry as f64 / (ENTRIES - 1) as f64).powi(4)
}

/// The functions of one wavelength.
struct Made {
    /// The phase function.
    whole: Vec<f64>,
    /// Share of its forward peak.
    share: f64,
    /// The phase function without that peak.
    rest: Vec<f64>,
    /// The peak for each path.
    peaks: Vec<Vec<f64>>,
}

impl Table {
    fn new(given_up: &AtomicBool, phase: &Phase, wavelengths: usize, order: usize, sun_radius: f64) -> Self {
        let given_up = || given_up.load(Ordering::Relaxed);
        let cosines: Vec<f64> = (0..ENTRIES).map(cosine_at).collect();
        let moments: Vec<Vec<f64>> =
            (0..wavelengths).into_par_iter().map(|w| if given_up() { vec![1.0] } else { moments(phase, w) }).collect();
        let most = moments.iter().map(Vec::len).max().unwrap_or(0).max(order + 1);
        let legendre = legendre_table(most, &cosines);
        let disc = disc_moments(most, sun_radius);
        let made: Vec<Made> = moments
            .par_iter()
            .enumerate()
            .map(|(w, moments)| {
                let whole: Vec<f64> = cosines.iter().map(|&cosine| phase.value(w, cosine)).collect();
                let share = forward_share(moments, order);
                let (missing, beyond) = (missing(moments.len()), beyond(moments.len()));
                let mut rest = vec![0.0; ENTRIES];
                for (l, chi) in moments.iter().enumerate().take(order + 1) {
                    add_faded(&mut rest, (2 * l + 1) as f64 * (chi - share) / (1.0 - share), &legendre[l], &beyond, 0.0);
                }
                let peak_after = |path: f64| {
                    // The peak of a point without repetitions is the phase function itself less the rest, exactly; the series adds what repetitions and the disc add.
                    let mut peak: Vec<f64> = whole.iter().zip(&rest).map(|(whole, rest)| whole - (1.0 - share) * rest).collect();
                    let orders = if given_up() { 0 } else { most };
                    for l in 0..orders {
                        let chi = if l <= order { share } else { moments.get(l).copied().unwrap_or(0.0) };
                        let repeated = if path > 0.0 { (path * chi).exp_m1() / path } else { chi };
                        let added = repeated * disc[l] - chi;
                        if added != 0.0 {
                            let (value, missing) = ((2 * l + 1) as f64 * added, missing.get(l).copied().unwrap_or(1.0));
                            add_faded(&mut peak, value, &legendre[l], &beyond, missing);
                        }
                    }
                    let factor = (share * path).exp();
                    peak.iter_mut().for_each(|value| *value /= factor);
                    peak
                };
                let peaks = PATHS.map(peak_after).into();
                Made { whole, share, rest, peaks }
            })
            .collect();
        // All functions are relative to the mean phase function, so that backward directions count as much as the aureole.
        let mut scale = vec![0.0; ENTRIES];
        let (mut peaks, mut rests, mut growth) = (Vec::new(), Vec::new(), Vec::new());
        for Made { whole, share, rest, peaks: after } in made {
            scale.iter_mut().zip(&whole).for_each(|(sum, value)| *sum += value / wavelengths as f64);
            growth.push(share);
            rests.push(rest);
            peaks.extend(after);
        }
        for function in peaks.iter_mut().chain(&mut rests) {
            function.iter_mut().zip(&scale).for_each(|(value, scale)| *value /= scale.max(1e-12));
        }
        let growths: Vec<f64> = growth.iter().flat_map(|share| PATHS.map(|path| (share * path).exp())).collect();
        let (peak_basis, peak_weights) = pick(&peaks, &growths);
        let (rest_basis, rest_weights) = pick(&rests, &vec![1.0; wavelengths]);
        let (peak, count) = (peak_basis.len(), peak_basis.len() + rest_basis.len());
        let mut entries = Vec::with_capacity(ENTRIES * count);
        for (e, scale) in scale.iter().enumerate() {
            entries.extend(peak_basis.iter().chain(&rest_basis).map(|function| (function[e] * scale) as f32));
        }
        Self { entries, count, peak, paths: Axis::new(PATHS.to_vec()), peak_weights, growth, rest_weights }
    }
}

/// Adds `value` times the Legendre polynomial `p` to `sum`, less the part `missing` of it where `beyond` is 1.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn add_faded(sum: &mut [f64], value: f64, p: &[f64], beyond: &[f64], missing: f64) {
    for ((sum, p), beyond) in sum.iter_mut().zip(p).zip(beyond) {
        *sum += value * p * (1.0 - beyond * missing);
    }
}

/// By order, what a series of `count` moments lacks where it is faded out: from its middle on, more and more. A series that just ends rings at every angle.
fn missing(count: usize) -> Vec<f64> {
    let late = |l: usize| (2.0 * l as f64 / count as f64 - 1.0).max(0.0);
    (0..count).map(|l| (FRAC_PI_2 * late(l)).sin().powi(2)).collect()
}

/// By entry, 0 to 1: where a series of `count` moments is faded out, at angles that it resolves many times.
fn beyond(count: usize) -> Vec<f64> {
    let from_start = |entry: usize| (cosine_at(entry).acos() * count as f64 / 10.0 - 1.0).clamp(0.0, 1.0);
    (0..ENTRIES).map(|entry| from_start(entry).powi(2) * (3.0 - 2.0 * from_start(entry))).collect()
}

/// Legendre moments that matter.
fn moments(phase: &Phase, wavelength: usize) -> Vec<f64> {
    let mut moments = Vec::new();
    // Their cost grows with the square of how many they are.
    for count in [64, 256, 600, MOST_MOMENTS] {
        moments = phase.legendre_moments(count, wavelength);
        if moments[count - 8..].iter().all(|moment| moment.abs() < SMALLEST_MOMENT) {
            break;
        }
    }
    let last = moments.iter().rposition(|m| m.abs() > SMALLEST_MOMENT).unwrap_or(0);
    moments.truncate(last + 1);
    moments
}

/// Legendre moments of a uniform disc of angular radius `radius` [radians]; that of order 0 is 1.
fn disc_moments(count: usize, radius: f64) -> Vec<f64> {
    if radius <= 0.0 {
        return vec![1.0; count];
    }
    let legendre = legendre_table(count + 2, &[radius.cos()]);
    let height = 2.0 * (0.5 * radius).sin().powi(2);
    let moment = |l: usize| (legendre[l - 1][0] - legendre[l + 1][0]) / ((2 * l + 1) as f64 * height);
    (0..count).map(|l| if l == 0 { 1.0 } else { moment(l) }).collect()
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

/// Orthonormal functions that reproduce all of `functions`, which are relative to the phase function, and the weights (function, basis) that do. At every angle the error of a function times
/// its growth is within the tolerance of what it is added to: 1 and itself.
fn pick(functions: &[Vec<f64>], growths: &[f64]) -> (Vec<Vec<f64>>, Vec<f64>) {
    let mut rest = functions.to_vec();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut weights = vec![Vec::new(); functions.len()];
    while basis.len() < functions.len() {
        let error = |k: usize| {
            let values = rest[k].iter().zip(&functions[k]);
            values.map(|(rest, whole)| rest.abs() / (1.0 / growths[k] + whole.abs())).fold(0.0, f64::max)
        };
        let errors: Vec<f64> = (0..functions.len()).into_par_iter().map(error).collect();
        let Some((worst, error)) = errors.into_iter().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if error < TOLERANCE {
            break;
        }
        let length = rest[worst].iter().map(|v| v * v).sum::<f64>().sqrt();
        let direction: Vec<f64> = rest[worst].iter().map(|v| v / length).collect();
        rest.par_iter_mut().zip(&mut weights).for_each(|(f, weights)| {
            let share: f64 = f.iter().zip(&direction).map(|(a, b)| a * b).sum();
            f.iter_mut().zip(&direction).for_each(|(a, b)| *a -= share * b);
            weights.push(share);
        });
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
            let functions = AngularFunctions::new(&phase, 1, 8, 0.0);
            let share = forward_share(&phase.legendre_moments(10, 0), 8);
            let once = Once { strength: 1.0 - share, direct_strength: 1.0, path: 0.0 };
            for degrees in [0.0, 0.5, 3.0, 20.0, 90.0, 170.0, 180.0_f64] {
                let cosine = degrees.to_radians().cos();
                let (found, expected) = (functions.value(0, &once, cosine), phase.value(0, cosine));
                assert!((found / expected - 1.0).abs() < 3e-3, "{phase:?} {degrees}: {found} {expected}");
            }
        }
    }

    /// A disc of a quarter of a degree changes nothing at ten degrees and beyond: a series that ends abruptly would ring there by a per cent, seen as rings in the sky.
    #[test]
    fn the_disc_of_the_sun_leaves_no_rings() {
        let phase = Phase::HenyeyGreenstein { asymmetry: 0.95 };
        let functions = AngularFunctions::new(&phase, 1, 8, 0.00465);
        let share = forward_share(&phase.legendre_moments(10, 0), 8);
        let once = Once { strength: 1.0 - share, direct_strength: 1.0, path: 0.0 };
        for tenths in 100..=1800 {
            let cosine = (0.1 * f64::from(tenths)).to_radians().cos();
            let (found, expected) = (functions.value(0, &once, cosine), phase.value(0, cosine));
            assert!((found / expected - 1.0).abs() < 3e-3, "{tenths}: {found} {expected}");
        }
    }

    /// Far from the axis the disc's moments are those of a Gaussian of equal width, exp(-(l radius)^2 / 8).
    #[test]
    fn a_disc_has_the_moments_of_its_width() {
        let radius = 0.005;
        for (l, moment) in disc_moments(120, radius).into_iter().enumerate() {
            let x = (l as f64 + 0.5) * radius;
            assert!((moment - (-x * x / 8.0).exp()).abs() < 5e-5 + 0.003 * x.powi(4), "{l}: {moment}");
        }
    }

    /// For Henyey-Greenstein, n scatterings in line have the phase function with g^n: the series can be summed in closed form.
    #[test]
    fn the_peak_is_light_scattered_repeatedly_in_line() {
        let (g, order) = (0.9_f64, 6);
        let phase = Phase::HenyeyGreenstein { asymmetry: g };
        let functions = AngularFunctions::new(&phase, 1, order, 0.0);
        let share = forward_share(&phase.legendre_moments(8, 0), order);
        for path in [0.3, 1.0, 2.5] {
            for degrees in [1.0, 5.0, 20.0, 60.0, 140.0_f64] {
                let cosine = degrees.to_radians().cos();
                let (mut expected, mut factor) = (0.0, 1.0);
                for n in 1..30_i32 {
                    factor *= if n == 1 { 1.0 } else { path / f64::from(n) };
                    let chain = Phase::HenyeyGreenstein { asymmetry: g.powi(n) };
                    let low: f64 = legendre_table(order + 1, &[cosine])
                        .iter()
                        .enumerate()
                        .map(|(l, p)| (2 * l + 1) as f64 * p[0] * (chain.legendre_moment(l, 0) - share.powi(n)))
                        .sum();
                    expected += factor * (chain.value(0, cosine) - low);
                }
                let found = functions.value(0, &Once { strength: 0.0, direct_strength: 1.0, path }, cosine);
                assert!(
                    (found - expected).abs() < 5e-3 * phase.value(0, cosine).max(expected.abs()),
                    "{path} {degrees}: {found} {expected}"
                );
            }
        }
    }
}
