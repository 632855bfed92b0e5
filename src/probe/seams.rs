//! Moves of several pixels in one direction, also where the image is folded between them.
//!
//! In some projections borders join that are turned against each other: what goes on to the right on one side comes back from the right on the other. A raster that lies across such a seam
//! moves as a whole only if each pixel counts its columns and rows as the raster's brightest pixel does, in quarter turns.

use crate::projection::Geometry;
use glam::DVec3;

/// One of the pixels that move together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mover {
    column: usize,
    row: usize,
    /// Quarter turns from the brightest pixel's columns to its own.
    turns: usize,
}

impl Mover {
    /// The pixels of a raster, (column, row, energy) each, in their order.
    pub fn of(grid: &dyn Geometry, pixels: impl Iterator<Item = (usize, usize, [f64; 3])>) -> Vec<(Self, [f64; 3])> {
        let mut movers: Vec<_> = pixels.map(|(column, row, energy)| (Self { column, row, turns: 0 }, energy)).collect();
        // Rows that are circles meet at the poles alone, at every angle: there pixels move along their circles.
        let brightest = movers.iter().max_by(|(_, a), (_, b)| a[1].total_cmp(&b[1])).map(|&(mover, _)| mover);
        if let Some(brightest) = brightest.filter(|_| grid.latlong().is_none()) {
            let expected = brightest.steps(grid);
            for (mover, _) in &mut movers {
                let likeness = |turns: usize| {
                    let steps = Self { turns, ..*mover }.steps(grid);
                    steps[0].dot(expected[0]) + steps[1].dot(expected[1])
                };
                // The first of equals: no turn where the image ends all around.
                mover.turns = (1..4)
                    .fold((0, likeness(0)), |best, turns| {
                        Some((turns, likeness(turns))).filter(|next| next.1 > best.1).unwrap_or(best)
                    })
                    .0;
            }
        }
        movers
    }

    /// The pixel `right` columns and `down` rows (each -1, 0 or 1) from it, as the brightest pixel counts them.
    pub fn moved(self, grid: &dyn Geometry, right: isize, down: isize) -> (usize, usize) {
        let (mut right, mut down) = (right, down);
        for _ in 0..self.turns {
            (right, down) = (-down, right);
        }
        grid.neighbour(self.column, self.row, right, down)
    }

    /// Where the next column and the next row lie.
    fn steps(self, grid: &dyn Geometry) -> [DVec3; 2] {
        let here = grid.footprint(self.column, self.row).mean_direction;
        [(1, 0), (0, 1)].map(|(right, down)| {
            let (column, row) = self.moved(grid, right, down);
            grid.footprint(column, row).mean_direction - here
        })
    }
}
