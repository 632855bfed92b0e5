//! Draws a disc so that it lights a scene rightly at any resolution.
//!
//! Three steps. Every pixel first gets the disc's energy inside its footprint (exact coverage, [`super::disc_scan`]; a disc lower than a row
//! goes to one row): at high resolution that is a sharp, round,
//! limb-darkened disc. But a pixel shines from its own mean direction m, not from where the disc stood in it, so the vector sum of energy times m is
//! not yet irradiance times direction; a Sun inside one pixel of a small image would stand up to half a pixel off. So, second, a
//! fraction a of all energy moves one row and a fraction b one column on, and all is scaled by s, such that
//! ```text
//! s [(1-a)(1-b) F(0,0) + a(1-b) F(1,0) + (1-a) b F(0,1) + a b F(1,1)] = target
//! ```
//! with F(i, j) the sum over the raster moved by i rows and j columns of energy times (m_x, m_y, mean of max(z, 0)), and the same of the disc itself as target.
//! This is a Newton iteration in (s, a, b) for each choice of neighbours; at high resolution a and b are a few hundredths.
//! Third, energies are divided by the pixels' solid angles.
//!
//! The third component is the irradiance of a horizontal plane rather than the z of the vector sum (below the horizontal plane: that of a plane
//! facing down). They differ only for a disc within half a row of the horizontal plane (one and a half with rows = corner, whose tents overlap), whose energy rows on either side share:
//! there the horizontal plane and walls get the right light, and the vector sum points too low by less than half a row.
//! The scale s differs from 1 by less than 0.4 % at 64 pixels and 1e-4 at 512: a mean of directions spread over a pixel is shorter than 1, and irradiance is kept
//! rather than energy.

use super::disc_scan::scan;
use super::seams::Mover;
use crate::projection::{Geometry, direction};
use crate::sky::Disc;
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

/// Relative error of the vector below which the raster is left as it is.
const GOOD_ENOUGH: f64 = 1e-5;

/// Energies (irradiance of X, Y and Z) [W m-2] of pixels, by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Raster {
    width: usize,
    rows: BTreeMap<usize, Vec<[f64; 3]>>,
}

impl Raster {
    fn new(width: usize) -> Self {
        Self { width, rows: BTreeMap::new() }
    }

    fn add(&mut self, column: usize, row: usize, energy: [f64; 3]) {
        let row = self.rows.entry(row).or_insert_with(|| vec![[0.0; 3]; self.width]);
        for (sum, value) in row[column].iter_mut().zip(energy) {
            *sum += value;
        }
    }

    /// (column, row, energy) of the pixels that are not dark.
    pub(crate) fn pixels(&self) -> impl Iterator<Item = (usize, usize, [f64; 3])> + '_ {
        self.rows.iter().flat_map(|(&row, energies)| {
            energies
                .iter()
                .enumerate()
                .filter(|(_, energy)| energy.iter().any(|&value| value > 0.0))
                .map(move |(column, &energy)| (column, row, energy))
        })
    }
}

/// What the drawn disc has to give: sums over the part of the disc inside the image, for X, Y and Z.
struct Target {
    vector: [DVec3; 3],
    upward: [f64; 3],
}

/// The energies of the pixels of `grid` that draw `disc`, of which only the part above `horizon_altitude` [radians] is seen.
///
/// The disc's irradiance belongs to that part; if an image of the upper half cuts more of it off, that much is missing.
pub(crate) fn draw(disc: &Disc, horizon_altitude: f64, grid: &dyn Geometry) -> Raster {
    let (raster, target) = cover(disc, horizon_altitude, grid);
    let Some(target) = target else { return raster };
    let down = target.vector[1].z < 0.0;
    let goal = |channel: usize| {
        let (vector, upward) = (target.vector[channel], target.upward[channel]);
        DVec3::new(vector.x, vector.y, if down { upward - vector.z } else { upward })
    };
    let movers = Mover::of(grid, raster.pixels());
    let moments = Moments::of(&movers, grid, down);
    let mut moved = Raster::new(raster.width);
    // Limb darkening differs between X, Y and Z, and with it the share of each row: every channel has its own fit.
    for channel in 0..3 {
        let sums = &moments.sums[channel];
        let Some(shift) = fit(sums, goal(channel)) else { continue };
        let reached = shift.mix(sums);
        let scale = goal(channel).dot(reached) / reached.length_squared();
        for (mover, energy) in &movers {
            for (down, along_rows) in [(0, 1.0 - shift.row_fraction), (shift.row, shift.row_fraction)] {
                for (right, along_columns) in [(0, 1.0 - shift.column_fraction), (shift.column, shift.column_fraction)] {
                    let weight = along_rows * along_columns;
                    if weight > 0.0 {
                        let (column, row) = mover.moved(grid, right, down);
                        let mut part = [0.0; 3];
                        part[channel] = energy[channel] * scale * weight;
                        moved.add(column, row, part);
                    }
                }
            }
        }
    }
    moved
}

/// The energy inside each footprint, and what the disc itself gives; no target if nothing of it is seen.
fn cover(disc: &Disc, horizon_altitude: f64, grid: &dyn Geometry) -> (Raster, Option<Target>) {
    let (width, height) = grid.size();
    let mut raster = Raster::new(width);
    let reach = grid.reach();
    let mut seen = [DVec3::ZERO; 3];
    let mut target = Target { vector: [DVec3::ZERO; 3], upward: [0.0; 3] };
    let cut = FRAC_PI_2 - horizon_altitude;
    let circles = grid.latlong();
    let (row_knots, column_step) = knots(disc, grid);
    let column_knots = |theta: f64, from: f64, to: f64, out: &mut Vec<f64>| {
        let (step, offset) = match circles {
            Some(image) => (column_step, (image.azimuth(image.column_knot_offset()) / column_step).rem_euclid(1.0)),
            None => (column_step / theta.sin().max(0.01), 0.0),
        };
        let first = (from / step - offset).floor() + 1.0;
        let last = (to / step - offset).ceil();
        out.extend((0..(last - first).max(0.0) as usize).map(|k| (first + k as f64 + offset) * step));
    };
    let only_row = only_row(disc, cut, grid);
    scan(disc, cut, &row_knots, column_knots, |sample| {
        let direction = direction(sample.theta, sample.azimuth);
        for (sum, weight) in seen.iter_mut().zip(sample.weight) {
            *sum += weight * direction;
        }
        if sample.theta > reach {
            return;
        }
        for channel in 0..3 {
            target.vector[channel] += sample.weight[channel] * direction;
            target.upward[channel] += sample.weight[channel] * direction.z.max(0.0);
        }
        match circles {
            Some(image) => {
                let columns = image.columns_at(sample.azimuth);
                let rows = only_row.map(|row| [(row, 1.0), (row, 0.0)]).or_else(|| image.rows_at(sample.theta));
                for (row, along_rows) in rows.into_iter().flatten() {
                    for (column, along_columns) in columns {
                        let weight = along_rows * along_columns;
                        if weight > 0.0 {
                            raster.add(column, row, sample.weight.map(|value| value * weight));
                        }
                    }
                }
            }
            None => {
                let Some((x, y)) = grid.coordinates(direction) else { return };
                raster.add((x.max(0.0) as usize).min(width - 1), (y.max(0.0) as usize).min(height - 1), sample.weight);
            }
        }
    });
    if raster.rows.is_empty() || seen.iter().any(|vector| vector.length() <= 0.0) {
        return (Raster::new(raster.width), None);
    }
    let scale: [f64; 3] = std::array::from_fn(|channel| disc.irradiance[channel] / seen[channel].length());
    target.vector.iter_mut().zip(scale).for_each(|(vector, factor)| *vector *= factor);
    target.upward.iter_mut().zip(scale).for_each(|(upward, factor)| *upward *= factor);
    for energy in raster.rows.values_mut().flatten() {
        for (value, factor) in energy.iter_mut().zip(scale) {
            *value *= factor;
        }
    }
    (raster, Some(target))
}

/// The row that holds the middle of a disc lower than a row: all its energy starts there, so that the fit shares it among two rows and never three.
fn only_row(disc: &Disc, cut: f64, grid: &dyn Geometry) -> Option<usize> {
    let image = grid.latlong()?;
    if 2.0 * disc.vertical_radius > image.step() {
        return None;
    }
    let centre = disc.direction.truncate().length().atan2(disc.direction.z).min(cut).min(image.span());
    image.rows_at(centre)?.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(row, _)| row)
}

/// Zenith angles and step in azimuth (for images whose rows are no circles, along the circle) [radians] between which footprints are smooth.
fn knots(disc: &Disc, grid: &dyn Geometry) -> (Vec<f64>, f64) {
    let centre = disc.direction.truncate().length().atan2(disc.direction.z);
    let (from, to) = (centre - disc.vertical_radius, centre + disc.vertical_radius);
    let (mut rows, step) = match grid.latlong() {
        Some(image) => {
            (image.row_knots().filter(|knot| (from..to).contains(knot)).collect::<Vec<_>>(), 2.0 * PI / image.width() as f64)
        }
        // Pixels lie across the circles, so there is no knot: parts of a quarter of a pixel instead.
        None => {
            let step = 0.25 * grid.pixel_angle();
            ((0..=((to - from) / step) as usize).map(|k| from + k as f64 * step).collect(), step)
        }
    };
    rows.extend([FRAC_PI_2, grid.reach()].into_iter().filter(|knot| (from..to).contains(knot)));
    rows.sort_by(f64::total_cmp);
    (rows, step)
}

/// Sums over a raster moved by -1, 0 or 1 rows and columns, `sums[channel][row + 1][column + 1]`.
struct Moments {
    sums: [[[DVec3; 3]; 3]; 3],
}

/// The move that a fit found.
#[derive(Clone, Copy, Debug)]
struct Shift {
    row: isize,
    column: isize,
    row_fraction: f64,
    column_fraction: f64,
}

impl Moments {
    fn of(movers: &[(Mover, [f64; 3])], grid: &dyn Geometry, down: bool) -> Self {
        let mut sums = [[[DVec3::ZERO; 3]; 3]; 3];
        for (mover, energy) in movers {
            for (down_by, right_by) in [-1, 0, 1].into_iter().flat_map(|i| [-1, 0, 1].map(|j| (i, j))) {
                let (column, row) = mover.moved(grid, right_by, down_by);
                let footprint = grid.footprint(column, row);
                let mean = footprint.mean_direction;
                let third = if down { footprint.mean_upward - mean.z } else { footprint.mean_upward };
                for (sum, energy) in sums.iter_mut().zip(energy) {
                    sum[(down_by + 1) as usize][(right_by + 1) as usize] += energy * DVec3::new(mean.x, mean.y, third);
                }
            }
        }
        Self { sums }
    }
}

/// The move whose mix points where `goal` does, or the nearest that there is; `None` if the raster gives nothing at all.
fn fit(sums: &[[DVec3; 3]; 3], goal: DVec3) -> Option<Shift> {
    let still = Shift { row: 0, column: 0, row_fraction: 0.0, column_fraction: 0.0 };
    let mut best = (still, miss(goal, still.mix(sums))?);
    if best.1 < GOOD_ENOUGH {
        return Some(still);
    }
    for (row, column) in [(-1, -1), (-1, 1), (1, -1), (1, 1)] {
        let mut shift = Shift { row, column, ..still };
        let mut scale = 1.0;
        for _ in 0..12 {
            let value = shift.mix(sums);
            let (by_row, by_column) = shift.slopes(sums);
            let matrix = DMat3::from_cols(value, scale * by_row, scale * by_column);
            if matrix.determinant().abs() < 1e-14 * goal.length().powi(3) {
                break;
            }
            let step = matrix.inverse() * (goal - scale * value);
            scale = (scale + step.x).clamp(0.5, 2.0);
            shift.row_fraction = (shift.row_fraction + step.y).clamp(0.0, 1.0);
            shift.column_fraction = (shift.column_fraction + step.z).clamp(0.0, 1.0);
        }
        if let Some(error) = miss(goal, shift.mix(sums)).filter(|&error| error < 0.999 * best.1) {
            best = (shift, error);
        }
    }
    Some(best.0)
}

/// Distance of `reached`, scaled as well as can be, from `goal`, relative to its length.
fn miss(goal: DVec3, reached: DVec3) -> Option<f64> {
    let square = reached.length_squared();
    (square > 0.0 && goal.dot(reached) > 0.0).then(|| (goal - reached * (goal.dot(reached) / square)).length() / goal.length())
}

impl Shift {
    fn corners(&self, sums: &[[DVec3; 3]; 3]) -> [DVec3; 4] {
        let at = |row: isize, column: isize| sums[(row + 1) as usize][(column + 1) as usize];
        [at(0, 0), at(self.row, 0), at(0, self.column), at(self.row, self.column)]
    }

    fn mix(&self, sums: &[[DVec3; 3]; 3]) -> DVec3 {
        let [none, row, column, both] = self.corners(sums);
        let (a, b) = (self.row_fraction, self.column_fraction);
        (1.0 - a) * (1.0 - b) * none + a * (1.0 - b) * row + (1.0 - a) * b * column + a * b * both
    }

    fn slopes(&self, sums: &[[DVec3; 3]; 3]) -> (DVec3, DVec3) {
        let [none, row, column, both] = self.corners(sums);
        let (a, b) = (self.row_fraction, self.column_fraction);
        ((1.0 - b) * (row - none) + b * (both - column), (1.0 - a) * (column - none) + a * (both - row))
    }
}
