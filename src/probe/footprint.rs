//! How the footprints of a latitude-longitude image are sampled.
//!
//! Rows are integrated over cos(theta), in which solid angle is uniform, by Gauss-Legendre nodes on pieces between
//! the kinks of the footprint and the horizon, so that a row which the horizon cuts gets exactly its shares of sky and ground.
//! Columns are sampled in the same way. How many nodes there are depends on the width ([`Sampling::of`]): a pixel of 0.2 degrees needs one.

use super::settings::GroundView;
use crate::numerics::GaussLegendre;
use crate::projection::{LatLong, Row, Rows};
use std::f64::consts::FRAC_PI_2;

/// How finely a footprint is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sampling {
    /// Gauss nodes per smooth piece of a row.
    pub rows: usize,
    /// Gauss nodes of a column.
    pub columns: usize,
    /// Whether the irradiance of the horizontal plane needs [`restore_upward`](super::moments::restore_upward).
    pub restore: bool,
}

impl Sampling {
    /// What an image of `width` needs.
    pub fn of(width: usize) -> Self {
        let (rows, columns, restore) = match width {
            ..128 => (6, 3, true),
            128..256 => (4, 3, true),
            256..1024 => (2, 2, true),
            1024..2048 => (2, 2, false),
            _ => (1, 1, false),
        };
        Self { rows, columns, restore }
    }
}

/// A circle of equal altitude with its share of a row.
pub(super) struct Node {
    pub altitude: f64,
    pub weight: f64,
    /// max(cos(theta), 0) minus its mean over the row.
    pub excess: f64,
}

/// The circles that make up `row`; the weights of all, seen or not, add up to 1. `horizon` is a zenith angle [radians].
/// `rule` has [`Sampling::rows`] nodes, but at least 2.
pub(super) fn nodes(
    image: &LatLong,
    row: &Row,
    (sampling, rule): (Sampling, &GaussLegendre),
    horizon: f64,
    ground: GroundView,
    out: &mut Vec<Node>,
) {
    out.clear();
    let inside = |knot: f64| row.from + 1e-12 < knot && knot < row.to - 1e-12;
    let cut = inside(horizon) || inside(FRAC_PI_2);
    if sampling.rows == 1 && !cut {
        let theta = row.mean_cosine.clamp(-1.0, 1.0).acos();
        out.push(Node { altitude: FRAC_PI_2 - theta, weight: 1.0, excess: 0.0 });
    } else {
        let mut knots = vec![row.from, row.theta, horizon, FRAC_PI_2, row.to];
        if image.rows() == Rows::Centre {
            knots.remove(1);
        }
        knots.retain(|&knot| knot == row.from || knot == row.to || inside(knot));
        knots.sort_by(f64::total_cmp);
        for piece in knots.windows(2) {
            for (cosine, weight) in rule.on(piece[1].cos(), piece[0].cos()) {
                let theta = cosine.clamp(-1.0, 1.0).acos();
                let weight = weight * image.row_weight(row, theta);
                out.push(Node { altitude: FRAC_PI_2 - theta, weight, excess: cosine.max(0.0) - row.mean_upward });
            }
        }
        let sum: f64 = out.iter().map(|node| node.weight).sum();
        out.iter_mut().for_each(|node| node.weight /= sum);
    }
    match ground {
        GroundView::On => {}
        GroundView::Off => out.retain(|node| node.altitude >= FRAC_PI_2 - horizon),
        GroundView::Mirrored => out.iter_mut().for_each(|node| node.altitude = node.altitude.abs()),
    }
}

/// Adds a circle with its weight.
pub(super) fn accumulate(sum: &mut [[f32; 3]], circle: &[[f32; 3]], weight: f64) {
    let weight = weight as f32;
    for (sum, value) in sum.iter_mut().zip(circle) {
        for channel in 0..3 {
            sum[channel] += weight * value[channel];
        }
    }
}

/// Places of `count` samples a column [columns, from the left edge of the image's first], and which of them make up a pixel: numbers counted from
/// the column's first, with weights that add up to 1. Gauss-Legendre nodes between the kinks of the footprints, which are the edges of the columns
/// for rows = centre and their middles for rows = corner.
pub(super) fn column_samples(rows: Rows, count: usize) -> (Vec<f64>, Vec<(isize, f32)>) {
    if count == 1 {
        return (vec![0.5], vec![(0, 1.0)]);
    }
    let rule = GaussLegendre::new(count);
    match rows {
        Rows::Centre => {
            let kernel = rule.on(0.0, 1.0).enumerate().map(|(k, (_, weight))| (k as isize, weight as f32));
            (rule.on(0.0, 1.0).map(|(at, _)| at).collect(), kernel.collect())
        }
        Rows::Corner => {
            let after = rule.on(0.0, 1.0).enumerate().map(|(k, (at, weight))| (k as isize, (weight * (1.0 - at)) as f32));
            let before =
                rule.on(0.0, 1.0).enumerate().map(|(k, (at, weight))| (k as isize - count as isize, (weight * at) as f32));
            (rule.on(0.5, 1.5).map(|(at, _)| at).collect(), before.chain(after).collect())
        }
    }
}

/// Means of the sub-columns over each pixel, around the seam.
pub(super) fn fold(circle: &[[f32; 3]], columns: usize, kernel: &[(isize, f32)], out: &mut [[f32; 3]]) {
    if columns == 1 && kernel == [(0, 1.0)] {
        out.copy_from_slice(circle);
        return;
    }
    let count = circle.len() as isize;
    for (i, pixel) in out.iter_mut().enumerate() {
        *pixel = [0.0; 3];
        for &(offset, weight) in kernel {
            let mut k = (i * columns) as isize + offset;
            if k < 0 {
                k += count;
            } else if k >= count {
                k -= count;
            }
            let value = circle[k as usize];
            for channel in 0..3 {
                pixel[channel] += weight * value[channel];
            }
        }
    }
}
