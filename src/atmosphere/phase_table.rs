//! A phase function given by numbers: Mie theory's, another code's, a measured one.
//!
//! Between its angles the logarithm of the phase function is linear in the angle, so it is positive everywhere and its integrals over
//! an interval have a closed form. Tables of sharp functions need close angles where they bend: the error is about a quarter of
//! the square of the step times the bend.

use crate::error::{Error, Result};
use multiversion::multiversion;
use std::f64::consts::PI;
use std::fmt;

/// Largest relative deviation of a given table's integral over the sphere from 4 pi.
const LARGEST_DEVIATION: f64 = 0.05;

/// A value of zero counts as this.
const SMALLEST_VALUE: f64 = 1e-30;

/// Cells of the lookup from the angle to its interval; they are uniform in the square root of the angle.
const CELLS: usize = 1024;

/// A tabulated phase function, by wavelength or one for all, normalised to 4 pi over the sphere.
#[derive(Clone, PartialEq)]
pub struct PhaseTable {
    /// Scattering angles [radians], from 0 to pi.
    angles: Vec<f64>,
    wavelengths: usize,
    /// Logarithm of the phase function, row-major, shape (wavelengths, angles).
    ln_values: Vec<f64>,
    /// First interval that reaches into each cell.
    first_interval: Vec<u32>,
    largest_deviation: f64,
}

impl fmt::Debug for PhaseTable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "PhaseTable {{ wavelengths: {}, angles: {} }}", self.wavelengths, self.angles.len())
    }
}

impl PhaseTable {
    /// The table of `values`, row-major, shape (wavelengths, angles), at the scattering angles `angles_rad`, ascending from 0 to pi.
    /// One row stands for all wavelengths. The values are scaled so that the integral over the sphere is 4 pi exactly.
    ///
    /// # Errors
    /// [`Error::Input`] if the angles are fewer than two, not ascending, or do not reach from 0 to pi; if values are negative or not finite
    /// or their number is not a multiple of the angles'; if an integral is further than 5 % from 4 pi.
    pub fn new(angles_rad: &[f64], values: &[f64]) -> Result<Self> {
        let ascending = angles_rad.windows(2).all(|pair| pair[0] < pair[1]);
        let ends = angles_rad.first().is_some_and(|&a| a == 0.0) && angles_rad.last().is_some_and(|a| (a - PI).abs() < 1e-6);
        if angles_rad.len() < 2 || !ascending || !ends {
            let given = format!("{} angles", angles_rad.len());
            return Err(Error::input("angles", given, "strictly ascending from 0 to 180 degrees, both included"));
        }
        if values.is_empty() || !values.len().is_multiple_of(angles_rad.len()) {
            let given = format!("{} values", values.len());
            return Err(Error::input("values", given, format!("a multiple of {}, one for each angle", angles_rad.len())));
        }
        if let Some(wrong) = values.iter().find(|value| !value.is_finite() || **value < 0.0) {
            return Err(Error::input("values", wrong, "finite and not negative"));
        }
        let mut angles = angles_rad.to_vec();
        *angles.last_mut().expect("two angles") = PI;
        let table = Self::from_logarithms(angles, values.iter().map(|value| value.max(SMALLEST_VALUE).ln()).collect());
        if table.largest_deviation <= LARGEST_DEVIATION {
            return Ok(table);
        }
        let given = format!("an integral over the sphere that is {:.1} % off", 100.0 * table.largest_deviation);
        Err(Error::input("values", given, "a phase function with an integral of 4 pi, within 5 %"))
    }

    /// The table of logarithms `ln_values`, shape (wavelengths, angles), at the angles `angles` [radians] from 0 to pi.
    pub(super) fn from_logarithms(angles: Vec<f64>, ln_values: Vec<f64>) -> Self {
        let count = angles.len();
        let wavelengths = ln_values.len() / count;
        let mut table = Self { first_interval: first_intervals(&angles), angles, wavelengths, ln_values, largest_deviation: 0.0 };
        let sines: Vec<(f64, f64)> = table.angles.iter().map(|angle| angle.sin_cos()).collect();
        for wavelength in 0..wavelengths {
            let row = wavelength * count..(wavelength + 1) * count;
            let ln_values = &mut table.ln_values[row];
            let mut whole = 0.0;
            for i in 1..count {
                let slope = (ln_values[i] - ln_values[i - 1]) / (table.angles[i] - table.angles[i - 1]);
                let antiderivative = |at: usize| ln_values[at].exp() * (slope * sines[at].0 - sines[at].1);
                // Rounding must not make the smallest interval negative.
                let part = ((antiderivative(i) - antiderivative(i - 1)) / (1.0 + slope * slope)).max(0.0);
                whole += 0.5 * part;
            }
            table.largest_deviation = table.largest_deviation.max((whole - 1.0).abs());
            let shift = whole.ln();
            ln_values.iter_mut().for_each(|value| *value -= shift);
        }
        table
    }

    /// Number of wavelengths: 1 if one row stands for all.
    pub fn wavelengths(&self) -> usize {
        self.wavelengths
    }

    /// Scattering angles [radians].
    pub fn angles_rad(&self) -> &[f64] {
        &self.angles
    }

    /// How far the integral over the sphere, divided by 4 pi, was from 1 before it was made 1: the largest of all wavelengths.
    pub fn largest_deviation(&self) -> f64 {
        self.largest_deviation
    }

    /// The values that tell this function from any other: its angles [radians] and logarithms, row-major, shape (wavelengths, angles).
    pub fn defining_values(&self) -> [&[f64]; 2] {
        // By name, so that a new field cannot be forgotten. The others follow from these, or are only told.
        let Self { angles, wavelengths: _, ln_values, first_interval: _, largest_deviation: _ } = self;
        [angles, ln_values]
    }

    fn row(&self, wavelength: usize) -> std::ops::Range<usize> {
        let first = if self.wavelengths == 1 { 0 } else { wavelength * self.angles.len() };
        first..first + self.angles.len()
    }

    /// The phase function at wavelength index `wavelength` and scattering angle cosine `cosine`.
    #[inline]
    pub fn value(&self, wavelength: usize, cosine: f64) -> f64 {
        let (interval, fraction) = self.locate(cosine.clamp(-1.0, 1.0).acos());
        let row = &self.ln_values[self.row(wavelength)];
        (row[interval] + fraction * (row[interval + 1] - row[interval])).exp()
    }

    /// Interval of `angle` and the position in it.
    #[inline]
    fn locate(&self, angle: f64) -> (usize, f64) {
        let cell = ((angle / PI).sqrt() * CELLS as f64) as usize;
        let mut interval = self.first_interval[cell.min(CELLS - 1)] as usize;
        while interval + 2 < self.angles.len() && self.angles[interval + 1] < angle {
            interval += 1;
        }
        let (low, high) = (self.angles[interval], self.angles[interval + 1]);
        (interval, (angle - low) / (high - low))
    }

    /// Legendre moment of order `l`: 1/2 of the integral of P P_l over the cosine. For more than one, [`Self::legendre_moments`] is faster.
    pub fn legendre_moment(&self, l: usize, wavelength: usize) -> f64 {
        let wavelength = if self.wavelengths == 1 { 0 } else { wavelength };
        self.moments(l + 1, wavelength..wavelength + 1)[l]
    }

    /// The first `count` Legendre moments at wavelength index `wavelength`; that of order 0 is 1.
    pub fn legendre_moments(&self, count: usize, wavelength: usize) -> Vec<f64> {
        let wavelength = if self.wavelengths == 1 { 0 } else { wavelength };
        self.moments(count, wavelength..wavelength + 1)
    }

    /// The first `count` Legendre moments at all wavelengths, shape (orders, [`Self::wavelengths`]): one recurrence serves them all.
    pub fn all_legendre_moments(&self, count: usize) -> Vec<f64> {
        self.moments(count, 0..self.wavelengths)
    }

    /// Moments of a range of wavelengths, shape (orders, wavelengths), by Gauss's rule on pieces of the intervals in which neither P_l nor
    /// ln P changes much.
    fn moments(&self, count: usize, wavelengths: std::ops::Range<usize>) -> Vec<f64> {
        let lanes = wavelengths.len();
        let mut moments = vec![0.0; count * lanes];
        let mut weighted = vec![0.0; lanes * BLOCK];
        let mut cosines = [0.0; BLOCK];
        let mut filled = 0;
        let angles = self.angles.len();
        for interval in 0..angles - 1 {
            let (low, width) = (self.angles[interval], self.angles[interval + 1] - self.angles[interval]);
            let steepest =
                wavelengths.clone().map(|w| self.ln_values[w * angles + interval + 1] - self.ln_values[w * angles + interval]);
            let change = steepest.map(f64::abs).fold(count as f64 * width, f64::max);
            let pieces = (0.5 * change).ceil().max(1.0) as usize;
            let rule: &[(f64, f64)] = if change < 0.5 { &GAUSS_2 } else { &GAUSS_3 };
            for piece in 0..pieces {
                for (node, weight) in rule {
                    let fraction = (piece as f64 + node) / pieces as f64;
                    let (sine, cosine) = (low + fraction * width).sin_cos();
                    cosines[filled] = cosine;
                    for (lane, w) in wavelengths.clone().enumerate() {
                        let ends = &self.ln_values[w * angles + interval..];
                        let value = (ends[0] + fraction * (ends[1] - ends[0])).exp();
                        weighted[lane * BLOCK + filled] = 0.5 * value * sine * weight * width / pieces as f64;
                    }
                    filled += 1;
                    if filled == BLOCK {
                        add_moments(&mut moments, &cosines, &weighted);
                        filled = 0;
                    }
                }
            }
        }
        (0..lanes).for_each(|lane| weighted[lane * BLOCK + filled..(lane + 1) * BLOCK].fill(0.0));
        add_moments(&mut moments, &cosines, &weighted);
        for lane in 0..lanes {
            let whole = moments[lane];
            moments.iter_mut().skip(lane).step_by(lanes).for_each(|moment| *moment /= whole);
        }
        moments
    }
}

/// Quadrature nodes that are worked on together.
const BLOCK: usize = 64;

/// Adds what the nodes at `cosines` with `weighted` values, shape (wavelengths, nodes), give to `moments`, shape (orders, wavelengths).
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn add_moments(moments: &mut [f64], cosines: &[f64; BLOCK], weighted: &[f64]) {
    let (mut before, mut now) = ([0.0; BLOCK], [1.0; BLOCK]);
    for (l, row) in moments.chunks_exact_mut(weighted.len() / BLOCK).enumerate() {
        for (moment, weighted) in row.iter_mut().zip(weighted.chunks_exact(BLOCK)) {
            // Eight sums at a time, which the compiler can keep in vector registers.
            let mut sums = [0.0; 8];
            for (p, w) in now.chunks_exact(8).zip(weighted.chunks_exact(8)) {
                for k in 0..8 {
                    sums[k] += p[k] * w[k];
                }
            }
            *moment += sums.iter().sum::<f64>();
        }
        let (up, down) = ((2 * l + 1) as f64 / (l + 1) as f64, l as f64 / (l + 1) as f64);
        for i in 0..BLOCK {
            (before[i], now[i]) = (now[i], up * cosines[i] * now[i] - down * before[i]);
        }
    }
}

/// Gauss's rule with two nodes on the unit interval: node, weight.
const GAUSS_2: [(f64, f64); 2] = [(0.211_324_865_405_187_1, 0.5), (0.788_675_134_594_812_9, 0.5)];

/// The same with three.
const GAUSS_3: [(f64, f64); 3] = [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

fn first_intervals(angles: &[f64]) -> Vec<u32> {
    (0..CELLS)
        .map(|cell| {
            let start = PI * (cell as f64 / CELLS as f64).powi(2);
            // The last interval that begins at or before the cell; rounding of the lookup may fall one cell short, never long.
            let interval = angles.partition_point(|&angle| angle <= start).max(1) - 1;
            interval.min(angles.len() - 2) as u32
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::phase::Phase;
    use super::*;

    fn angles(count: usize) -> Vec<f64> {
        // Close at 0, as a peak needs it.
        (0..=count).map(|i| PI * (i as f64 / count as f64).powf(1.7)).collect()
    }

    /// Henyey-Greenstein functions at two "wavelengths".
    fn table(count: usize) -> PhaseTable {
        let angles = angles(count);
        let phases = [0.6, 0.9].map(|asymmetry| Phase::HenyeyGreenstein { asymmetry });
        let values: Vec<f64> = phases.iter().flat_map(|phase| angles.iter().map(|a| phase.value(0, a.cos()))).collect();
        PhaseTable::new(&angles, &values).unwrap()
    }

    #[test]
    fn values_and_moments_are_those_of_the_tabulated_function() {
        let table = table(2000);
        assert!(table.largest_deviation() < 1e-5, "{}", table.largest_deviation());
        for (wavelength, g) in [(0, 0.6), (1, 0.9)] {
            let exact = Phase::HenyeyGreenstein { asymmetry: g };
            for i in 0..=1000 {
                let cosine = -1.0 + f64::from(i) / 500.0;
                assert!((table.value(wavelength, cosine) / exact.value(0, cosine) - 1.0).abs() < 2e-5, "{cosine}");
            }
            let moments = table.legendre_moments(200, wavelength);
            for (l, moment) in moments.iter().enumerate() {
                assert!((moment - g.powi(l as i32)).abs() < 1e-5, "{l}: {moment}");
            }
            assert!((table.legendre_moment(7, wavelength) - moments[7]).abs() < 1e-6);
        }
        let all = table.all_legendre_moments(50);
        assert_eq!(all.len(), 100);
        assert!((all[2 * 30 + 1] - 0.9_f64.powi(30)).abs() < 1e-5);
    }

    #[test]
    fn the_lookup_finds_the_interval_of_every_angle() {
        for count in [2, 3, 50, 3000] {
            let flat = PhaseTable::new(&angles(count), &vec![1.0; count + 1]).unwrap();
            for i in 0..=5000 {
                let angle = PI * (f64::from(i) / 5000.0).powi(3);
                let (interval, fraction) = flat.locate(angle);
                assert!(flat.angles[interval] <= angle + 1e-15 && (-1e-9..=1.0 + 1e-9).contains(&fraction), "{angle}");
            }
            for (i, &angle) in flat.angles.iter().enumerate() {
                let (interval, fraction) = flat.locate(angle);
                assert!((interval as f64 + fraction - i as f64).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_bad_table_is_refused() {
        let angles = angles(30);
        let flat = vec![1.0; 31];
        for (angles, values, start) in [
            (&angles[1..], &flat[1..], "angles = 30 angles"),
            (&angles[..30], &flat[..30], "angles = 30 angles"),
            (&[0.0, 2.0, 1.0, PI], &flat[..4], "angles = 4 angles"),
            (&angles[..], &flat[..30], "values = 30 values"),
            (&angles[..], &[], "values = 0 values"),
            (&angles[..], &[f64::NAN; 31], "values = NaN"),
            (&angles[..], &[-1.0; 31], "values = -1"),
            (&angles[..], &[2.0; 31], "values = an integral over the sphere that is 100.0 % off"),
            (&angles[..], &[0.0; 31], "values = an integral"),
        ] {
            let message = PhaseTable::new(angles, values).unwrap_err().to_string();
            assert!(message.starts_with(start), "{message}");
        }
        assert_eq!(PhaseTable::new(&angles, &flat).unwrap().wavelengths(), 1);
    }
}
