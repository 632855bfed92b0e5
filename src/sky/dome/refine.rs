//! Directions of a dome placed where light changes: circles and azimuths are added until those that were not there before agree with what was interpolated.
//!
//! The dome starts with few circles and azimuths. Between each two circles another is gathered; where its radiance is further than the tolerance from the interpolated one, at any
//! azimuth and in X, Y or Z, its own two intervals are halved again. Then azimuths are doubled as long as those in between are off. As cubic interpolation gains about four bits with each
//! halving, and what was gathered to check is kept, the error that remains is mostly far below the tolerance.
//! The thesis chose its pixels so: it rendered more where neighbours differ by more than a tolerance (figures 11 to 13).

use super::gathering::Side;
use super::half::Half;
use super::shade::{CHUNK, Looks, Places};
use crate::error::Result;
use crate::light::BLOCK;
use crate::numerics::Axis;
use crate::progress::Progress;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Intervals between circles to start with: above the horizon, below it.
const FIRST_CIRCLES: [usize; 2] = [8, 4];
/// Intervals of azimuth to start with, from the Sun to opposite it.
const FIRST_AZIMUTHS: usize = 8;
/// Where refining ends: circles of one half, intervals of azimuth, and the width of an interval of positions.
const MOST_CIRCLES: usize = 256;
const MOST_AZIMUTHS: usize = 128;
const NARROWEST: f64 = 1.0 / 1024.0;
/// Circles on which azimuths are checked.
const CHECKED_CIRCLES: usize = 17;
/// Share of the dome's mean radiance below which differences do not count.
const FLOOR: f64 = 0.01;

type Row = Vec<[f32; 3]>;

/// The halves of a dome, each interpolating within `tolerance`.
pub(super) fn refine(sides: &[Side; 2], tolerance: f64, progress: &Progress) -> Result<[Half; 2]> {
    let report = |fraction: f64| progress.report("gather", fraction);
    report(0.0)?;
    let mut grids = Vec::with_capacity(2);
    for (side, intervals) in sides.iter().zip(FIRST_CIRCLES) {
        grids.push(Circles::even(side, intervals, &|| report(0.0))?);
    }
    let (sum, weight) = grids
        .iter()
        .map(Circles::total)
        .fold(([0.0; 3], 0.0), |(sum, weight), (more, with)| (std::array::from_fn(|k| sum[k] + more[k]), weight + with));
    let floor = sum.map(|total: f64| (FLOOR * total / weight).max(f64::MIN_POSITIVE));
    for (s, grid) in grids.iter_mut().enumerate() {
        grid.add_circles(tolerance, floor, &|done| report(0.5 * (s as f64 + 0.8 * done)))?;
        grid.add_azimuths(tolerance, floor, &|| report(0.5 * (s as f64 + 0.8)))?;
    }
    report(1.0)?;
    let mut halves = grids.into_iter().map(Circles::into_half);
    Ok(std::array::from_fn(|_| halves.next().expect("two sides")))
}

/// The gathered circles of one half, ascending from the horizon.
struct Circles<'a> {
    side: &'a Side<'a>,
    positions: Vec<f64>,
    rows: Vec<Row>,
    /// Intervals of azimuth.
    azimuths: usize,
}

impl<'a> Circles<'a> {
    fn even(side: &'a Side<'a>, intervals: usize, report: &(impl Fn() -> Result<()> + Sync)) -> Result<Self> {
        let positions: Vec<f64> = (0..=intervals).map(|c| c as f64 / intervals as f64).collect();
        let azimuths = nodes(FIRST_AZIMUTHS);
        let gather = |position: &f64| report().map(|()| side.gather(*position, &azimuths));
        let rows = positions.par_iter().map(gather).collect::<Result<Vec<_>>>()?;
        Ok(Self { side, positions, rows, azimuths: FIRST_AZIMUTHS })
    }

    /// Sum of the radiance times solid angle, and of the solid angle.
    fn total(&self) -> ([f64; 3], f64) {
        let mut total = ([0.0; 3], 0.0);
        let azimuths = nodes(self.azimuths);
        for (&position, row) in self.positions.iter().zip(&self.rows) {
            // The share of the way from the horizon is the square of the position.
            let weight = position * self.side.altitude(position).cos();
            for xyz in self.side.radiance(position, &azimuths, row) {
                (0..3).for_each(|k| total.0[k] += weight * f64::from(xyz[k]));
                total.1 += weight;
            }
        }
        total
    }

    /// Halves intervals between circles until the circles in their middle are no news. `report` takes the share of the way that is done.
    fn add_circles(&mut self, tolerance: f64, floor: [f64; 3], report: &(impl Fn(f64) -> Result<()> + Sync)) -> Result<()> {
        let azimuths = nodes(self.azimuths);
        let mut pending = vec![true; self.positions.len() - 1];
        while pending.contains(&true) && self.positions.len() < MOST_CIRCLES {
            self.balance(&mut pending);
            let left = self.positions.windows(2).zip(&pending).map(|(ends, &p)| if p { ends[1] - ends[0] } else { 0.0 });
            let done = 1.0 - left.sum::<f64>();
            let axis = Axis::new(self.positions.clone());
            let halved: Vec<usize> = (0..pending.len()).filter(|&i| pending[i]).collect();
            let middle = |i: usize| 0.5 * (self.positions[i] + self.positions[i + 1]);
            let found = halved.par_iter().map(|&i| {
                report(done)?;
                let position = middle(i);
                let row = self.side.gather(position, &azimuths);
                let missed = self.side.error(position, &azimuths, &row, &self.interpolated(&axis, position), floor) > tolerance;
                Ok((position, row, missed))
            });
            let mut found = found.collect::<Result<Vec<_>>>()?.into_iter();
            let (positions, rows) = (std::mem::take(&mut self.positions), std::mem::take(&mut self.rows));
            let mut next = Vec::new();
            for (i, (position, row)) in positions.into_iter().zip(rows).enumerate() {
                self.positions.push(position);
                self.rows.push(row);
                if pending.get(i) == Some(&true)
                    && let Some((middle, row, missed)) = found.next()
                {
                    next.extend([missed && 0.5 * (middle - position) > NARROWEST; 2]);
                    self.positions.push(middle);
                    self.rows.push(row);
                } else if i < pending.len() {
                    next.push(false);
                }
            }
            pending = next;
        }
        Ok(())
    }

    /// Adds to the intervals that are to be halved their wider neighbours: no interval becomes more than twice as wide as the next, where cubics would swing.
    fn balance(&self, pending: &mut [bool]) {
        let width = |i: usize| self.positions[i + 1] - self.positions[i];
        for _ in 0..pending.len() {
            let before = pending.to_vec();
            for (i, pending) in pending.iter_mut().enumerate() {
                let wider = |other: usize| before[other] && width(i) > 1.5 * width(other);
                *pending |= (i > 0 && wider(i - 1)) || (i + 1 < before.len() && wider(i + 1));
            }
            if before == pending {
                return;
            }
        }
    }

    /// What the circles say about the one at `position`.
    fn interpolated(&self, axis: &Axis, position: f64) -> Row {
        let cubic = axis.cubic(position);
        let mut row = vec![[0.0; 3]; self.rows[0].len()];
        for (known, weight) in self.rows[cubic.first..].iter().zip(cubic.weights) {
            add(&mut row, weight, known);
        }
        row
    }

    /// Doubles the azimuths until those in between are no news on some of the circles.
    fn add_azimuths(&mut self, tolerance: f64, floor: [f64; 3], report: &(impl Fn() -> Result<()> + Sync)) -> Result<()> {
        while self.azimuths < MOST_AZIMUTHS {
            let between: Vec<f64> = (0..self.azimuths).map(|a| PI * (a as f64 + 0.5) / self.azimuths as f64).collect();
            let last = self.positions.len() - 1;
            let checked: Vec<usize> = (0..CHECKED_CIRCLES).map(|i| i * last / (CHECKED_CIRCLES - 1)).collect();
            let gather = |c: usize| report().map(|()| self.side.gather(self.positions[c], &between));
            let errors = checked.par_iter().map(|&c| {
                let row = gather(c)?;
                Ok(self.side.error(self.positions[c], &between, &row, &self.between(c), floor))
            });
            if errors.collect::<Result<Vec<_>>>()?.into_iter().all(|error| error <= tolerance) {
                return Ok(());
            }
            let found = (0..=last).into_par_iter().map(gather).collect::<Result<Vec<_>>>()?;
            let fields = self.side.terms.lanes.count();
            for (row, new) in self.rows.iter_mut().zip(found) {
                let old = std::mem::take(row);
                let mut new = new.chunks_exact(fields);
                for node in old.chunks_exact(fields) {
                    row.extend_from_slice(node);
                    row.extend_from_slice(new.next().unwrap_or_default());
                }
            }
            self.azimuths *= 2;
        }
        Ok(())
    }

    /// What circle `c` says about the middles between its azimuths.
    fn between(&self, c: usize) -> Row {
        let fields = self.side.terms.lanes.count();
        let last = self.azimuths as isize;
        let mut row = vec![[0.0; 3]; self.azimuths * fields];
        for (a, middle) in row.chunks_exact_mut(fields).enumerate() {
            for (offset, weight) in [(-1, -0.0625), (0, 0.5625), (1, 0.5625), (2, -0.0625)] {
                let node = a as isize + offset;
                let inside = if node > last { 2 * last - node } else { node.abs() };
                let first = inside as usize * fields;
                let known = &self.rows[c][first..first + fields];
                add(middle, weight, known);
                if inside != node && self.side.terms.lanes.filter().is_some() {
                    // The last field, U, is odd about the Sun's meridian.
                    add(&mut middle[fields - 1..], -2.0 * weight, &known[fields - 1..]);
                }
            }
        }
        row
    }

    fn into_half(self) -> Half {
        Half::new(self.positions, &self.rows, &self.side.terms.lanes)
    }
}

/// Azimuths of `intervals` even intervals from the Sun to opposite it.
fn nodes(intervals: usize) -> Vec<f64> {
    (0..=intervals).map(|a| PI * a as f64 / intervals as f64).collect()
}

fn add(sum: &mut [[f32; 3]], weight: f32, values: &[[f32; 3]]) {
    for (sum, value) in sum.iter_mut().zip(values) {
        (0..3).for_each(|k| sum[k] += weight * value[k]);
    }
}

impl Side<'_> {
    /// XYZ that the fields `row` make in `azimuths` from the Sun on the circle at `position`: on one side of the Sun, through a filter on both.
    fn radiance(&self, position: f64, azimuths: &[f64], row: &[[f32; 3]]) -> Row {
        let (sun_altitude, sun_azimuth) = self.what.sun;
        let altitude = self.altitude(position);
        let mut out = Vec::with_capacity(2 * azimuths.len());
        let sides: &[f64] = if self.terms.lanes.filter().is_some() { &[-1.0, 1.0] } else { &[-1.0] };
        for side in sides {
            for (azimuths, row) in azimuths.chunks(CHUNK).zip(row.chunks(CHUNK * self.terms.lanes.count())) {
                let azimuths: Vec<f64> = azimuths.iter().map(|azimuth| sun_azimuth + side * azimuth).collect();
                let places = Places { altitude, sun_altitude, sun_azimuth, azimuths: &azimuths };
                let looks = Looks::new(&self.terms.lanes, &places);
                for (i, fields) in row.chunks_exact(self.terms.lanes.count()).enumerate() {
                    let mut sum = [0.0_f32; 3];
                    for (block, fields) in fields.chunks(BLOCK).enumerate() {
                        for (factor, field) in looks.factors(&self.terms.lanes, i, block).into_iter().zip(fields) {
                            (0..3).for_each(|k| sum[k] += factor * field[k]);
                        }
                    }
                    out.push(sum);
                }
            }
        }
        out
    }

    /// Largest difference between the radiances of `gathered` and `interpolated` fields, relative to the gathered one and a floor.
    fn error(&self, position: f64, azimuths: &[f64], gathered: &[[f32; 3]], interpolated: &[[f32; 3]], floor: [f64; 3]) -> f64 {
        let (is, seems) = (self.radiance(position, azimuths, gathered), self.radiance(position, azimuths, interpolated));
        let error = |k: usize, is: f32, seems: f32| f64::from((seems - is).abs()) / (f64::from(is.abs()) + floor[k]);
        is.iter().zip(&seems).flat_map(|(is, seems)| (0..3).map(move |k| error(k, is[k], seems[k]))).fold(0.0, f64::max)
    }
}
