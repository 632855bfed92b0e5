//! What planes receive from an image: the integral of the pixels over their footprints times the cosine of incidence, for many planes at once.
//!
//! A plane that faces n sees, at zenith angle theta, the azimuths where
//! ```text
//! c = n_z cos(theta) + n_h sin(theta) cos(azimuth - azimuth_n) > 0,    n_h = hypot(n_x, n_y):
//! ```
//! one arc. Along a row of a latitude-longitude image the light L is constant in each column (rows = centre) or linear from one column's middle to the next (corner), so sums from the
//! first column on of the integrals of L, L cos and L sin over azimuth give the integral of L c over any arc, exactly, from its two ends. The sums are made once for all planes; what is
//! left is an integral over theta, by Gauss-Legendre nodes between the row's kinks and the angles at which the arc appears or becomes the whole circle, where tan(theta) = n_z / n_h.
//!
//! The pixels of an image whose rows are no circles are summed one by one; those that the plane cuts, in parts.

use super::image::Probe;
use crate::numerics::GaussLegendre;
use crate::projection::{Geometry, LatLong, Row, Rows};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Sums of R, G and B.
type Rgb = [f64; 3];

/// Pieces of the image that are summed apart, so that sums do not depend on the number of threads.
const PIECES: usize = 64;

/// Planes that share one pass over the pixels.
const PLANES: usize = 4096;

/// Gauss nodes where the integrand is smooth, and where an arc begins or closes within a row.
const NODES: [usize; 2] = [3, 10];

/// Irradiance of planes that face `normals` (any length; a plane of length 0 receives nothing), in their order.
pub(super) fn irradiances(probe: &Probe, normals: &[DVec3]) -> Vec<Rgb> {
    of(&*probe.grid(), probe.pixels.as_chunks::<3>().0, normals)
}

/// The same for `pixels` of a given geometry.
pub(super) fn of(grid: &dyn Geometry, pixels: &[[f32; 3]], normals: &[DVec3]) -> Vec<Rgb> {
    normals
        .chunks(PLANES)
        .flat_map(|normals| {
            let normals: Vec<DVec3> = normals.iter().map(|&normal| unit_or_zero(normal)).collect();
            match grid.latlong() {
                Some(image) => on_circles(pixels, image, &normals),
                None => in_parts(pixels, grid, &normals),
            }
        })
        .collect()
}

/// Squares of components as long or as short as numbers go are not numbers any more: the largest comes to 1 first.
fn unit_or_zero(normal: DVec3) -> DVec3 {
    let largest = normal.abs().max_element();
    if largest > 0.0 { (normal / largest).normalize_or_zero() } else { DVec3::ZERO }
}

/// Sums `of_row` over the rows, in pieces.
fn sum_rows(height: usize, planes: usize, of_rows: impl Fn(std::ops::Range<usize>, &mut [Rgb]) + Sync) -> Vec<Rgb> {
    let size = height.div_ceil(PIECES);
    let piece = |first: usize| {
        let mut sums = vec![[0.0; 3]; planes];
        of_rows(first..(first + size).min(height), &mut sums);
        sums
    };
    let pieces: Vec<Vec<Rgb>> = (0..height.div_ceil(size)).into_par_iter().map(|k| piece(k * size)).collect();
    pieces.into_iter().fold(vec![[0.0; 3]; planes], |mut sums, piece| {
        sums.iter_mut().zip(piece).for_each(|(sum, more)| add(sum, 1.0, more));
        sums
    })
}

fn add(sum: &mut Rgb, factor: f64, value: Rgb) {
    for (sum, value) in sum.iter_mut().zip(value) {
        *sum += factor * value;
    }
}

/// Integrals over azimuth of L, L cos and L sin.
type Moments = [Rgb; 3];

/// What is the same for all rows: angles count from the first knot of the columns.
struct Columns {
    rows: Rows,
    step: f64,
    /// Cosine and sine at the knots, the first once more at the end.
    knots: Vec<(f64, f64)>,
    /// What the values at the beginning and at the end of each interval count in its moments.
    shares: Vec<[[f64; 3]; 2]>,
}

impl Columns {
    fn new(image: &LatLong) -> Self {
        let (width, rows) = (image.width(), image.rows());
        let step = TAU / width as f64;
        let at = |k: usize| (step * k as f64).sin_cos();
        let knots: Vec<(f64, f64)> = (0..=width).map(|k| at(k % width)).map(|(sine, cosine)| (cosine, sine)).collect();
        let mut columns = Self { rows, step, knots, shares: Vec::new() };
        columns.shares = (0..width).map(|k| columns.part(k, step, columns.knots[k + 1])).collect();
        columns
    }

    /// What the values at either end of interval `k` count in the moments of its first `angle`, at whose end cosine and sine are `end`.
    fn part(&self, k: usize, angle: f64, end: (f64, f64)) -> [[f64; 3]; 2] {
        let ((c0, s0), (c1, s1)) = (self.knots[k], end);
        let whole = [angle, s1 - s0, c0 - c1];
        if self.rows == Rows::Centre {
            return [whole, [0.0; 3]];
        }
        // Integrals of t, t cos and t sin, with t from 0 to 1 over the whole interval.
        let second = [0.5 * angle * angle, angle * s1 + c1 - c0, s1 - s0 - angle * c1].map(|value| value / self.step);
        [std::array::from_fn(|n| whole[n] - second[n]), second]
    }
}

/// One row: moments from the first knot on.
struct Sums<'a> {
    columns: &'a Columns,
    pixels: &'a [[f32; 3]],
    from_first: &'a mut Vec<Moments>,
}

impl<'a> Sums<'a> {
    fn new(columns: &'a Columns, pixels: &'a [[f32; 3]], from_first: &'a mut Vec<Moments>) -> Self {
        from_first.clear();
        let mut sum = [[0.0; 3]; 3];
        from_first.push(sum);
        for (k, shares) in columns.shares.iter().enumerate() {
            add_interval(&mut sum, pixels, k, shares);
            from_first.push(sum);
        }
        Self { columns, pixels, from_first }
    }

    fn whole(&self) -> Moments {
        self.from_first[self.pixels.len()]
    }

    /// Moments from the first knot to `angle` [radians, 0 to 2 pi].
    fn until(&self, angle: f64) -> Moments {
        let k = ((angle / self.columns.step) as usize).min(self.pixels.len() - 1);
        let (sine, cosine) = angle.sin_cos();
        let mut sum = self.from_first[k];
        let inside = (angle - k as f64 * self.columns.step).max(0.0);
        add_interval(&mut sum, self.pixels, k, &self.columns.part(k, inside, (cosine, sine)));
        sum
    }

    /// Integral of L (along + across cos(azimuth - middle)) over the arc in which the bracket is positive.
    fn seen(&self, along: f64, across: f64, middle: f64) -> Rgb {
        let (sine, cosine) = middle.sin_cos();
        let [once, by_cosine, by_sine] = if along >= across {
            self.whole()
        } else if along <= -across {
            return [0.0; 3];
        } else {
            let half = (-along / across).acos();
            let from = (middle - half).rem_euclid(TAU);
            let to = from + 2.0 * half;
            let (before, mut after) = (self.until(from), self.until(if to > TAU { to - TAU } else { to }));
            if to > TAU {
                let whole = self.whole();
                after.iter_mut().zip(whole).for_each(|(after, whole)| add(after, 1.0, whole));
            }
            std::array::from_fn(|n| std::array::from_fn(|c| after[n][c] - before[n][c]))
        };
        std::array::from_fn(|c| along * once[c] + across * (cosine * by_cosine[c] + sine * by_sine[c]))
    }
}

#[inline(always)]
fn add_interval(sum: &mut Moments, pixels: &[[f32; 3]], k: usize, [first, second]: &[[f64; 3]; 2]) {
    let begin = pixels[k].map(f64::from);
    let end = pixels[if k + 1 == pixels.len() { 0 } else { k + 1 }].map(f64::from);
    for n in 0..3 {
        for c in 0..3 {
            sum[n][c] += first[n] * begin[c] + second[n] * end[c];
        }
    }
}

/// A plane as latitude-longitude images see it.
struct Plane {
    up: f64,
    horizontal: f64,
    /// Angle from the first knot of the columns to its azimuth [radians].
    middle: f64,
    /// Zenith angles at which its arc begins or closes.
    ends: [f64; 2],
}

fn on_circles(pixels: &[[f32; 3]], image: &LatLong, normals: &[DVec3]) -> Vec<Rgb> {
    let columns = Columns::new(image);
    let first_knot = image.azimuth(image.column_knot_offset());
    let planes: Vec<Plane> = normals
        .iter()
        .map(|normal| {
            let horizontal = normal.truncate().length();
            let end = normal.z.abs().atan2(horizontal);
            let end = if normal.z < 0.0 { end } else { PI - end };
            Plane {
                up: normal.z,
                horizontal,
                middle: (normal.x.atan2(normal.y) - first_knot).rem_euclid(TAU),
                ends: [PI - end, end],
            }
        })
        .collect();
    let rules = NODES.map(GaussLegendre::new);
    sum_rows(image.height(), planes.len(), |rows, sums| {
        let mut from_first = Vec::with_capacity(image.width() + 1);
        for j in rows {
            let pixels = &pixels[j * image.width()..(j + 1) * image.width()];
            if pixels.iter().all(|&pixel| pixel == [0.0; 3]) {
                continue;
            }
            let row = Sums::new(&columns, pixels, &mut from_first);
            for (plane, sum) in planes.iter().zip(sums.iter_mut()) {
                add_row(&row, image, &image.table()[j], plane, &rules, sum);
            }
        }
    })
}

/// Adds what `plane` receives from one row.
fn add_row(row: &Sums, image: &LatLong, found: &Row, plane: &Plane, rules: &[GaussLegendre; 2], sum: &mut Rgb) {
    let inside = |knot: &f64| found.from < *knot && *knot < found.to;
    let ends = plane.ends.map(|end| if inside(&end) { end } else { found.from });
    let mut knots = [found.from, found.theta, ends[0], ends[1], FRAC_PI_2.clamp(found.from, found.to), found.to];
    knots.sort_by(f64::total_cmp);
    let rule = &rules[usize::from(ends != [found.from; 2])];
    for piece in knots.windows(2).filter(|piece| piece[1] > piece[0]) {
        for (theta, weight) in rule.on(piece[0], piece[1]) {
            let (sine, cosine) = theta.sin_cos();
            let weight = weight * sine * image.row_weight(found, theta);
            add(sum, weight, row.seen(plane.up * cosine, plane.horizontal * sine, plane.middle));
        }
    }
}

fn in_parts(pixels: &[[f32; 3]], image: &dyn Geometry, normals: &[DVec3]) -> Vec<Rgb> {
    let (width, height) = image.size();
    // Half a diagonal of a pixel, with room.
    let reach = 0.75 * image.pixel_angle();
    sum_rows(height, normals.len(), |rows, sums| {
        let mut parts: Vec<(DVec3, f64)> = Vec::new();
        for (row, column) in rows.flat_map(|row| (0..width).map(move |column| (row, column))) {
            let value = pixels[row * width + column];
            if value == [0.0; 3] {
                continue;
            }
            image.parts(column, row, image.parts_per_side(column, row), &mut parts);
            let vector: DVec3 = parts.iter().map(|(direction, weight)| *weight * *direction).sum();
            let edge = reach * parts.iter().map(|(_, weight)| weight).sum::<f64>();
            for (normal, sum) in normals.iter().zip(sums.iter_mut()) {
                let along = normal.dot(vector);
                let weight = if along.abs() > edge {
                    along.max(0.0)
                } else {
                    parts.iter().map(|(direction, weight)| weight * normal.dot(*direction).max(0.0)).sum()
                };
                add(sum, weight, value.map(f64::from));
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::probe::ProbeSettings;
    use crate::projection::{Extent, Projection, direction};
    use crate::spectrum::ColorSpace;

    /// By brute force: each footprint in many parts.
    fn by_force(probe: &Probe, normal: DVec3) -> Rgb {
        let grid = probe.grid();
        let image = grid.latlong().unwrap();
        let (corner, n) = (image.rows() == Rows::Corner, 60);
        let reach = if corner { 1.0 } else { 0.5 };
        let mut sum = [0.0; 3];
        for (j, row) in image.table().iter().enumerate() {
            for i in 0..image.width() {
                let (mut weights, mut seen) = (0.0, 0.0);
                for (a, b) in (0..n * n).map(|k| (k / n, k % n)) {
                    let theta = row.from + (row.to - row.from) * (f64::from(a) + 0.5) / f64::from(n);
                    let offset = reach * (2.0 * (f64::from(b) + 0.5) / f64::from(n) - 1.0);
                    let weight = theta.sin() * image.row_weight(row, theta) * if corner { 1.0 - offset.abs() } else { 1.0 };
                    let towards = direction(theta, image.azimuth(i as f64 + 0.5 + offset));
                    weights += weight;
                    seen += weight * normal.dot(towards).max(0.0);
                }
                add(&mut sum, row.solid_angle * seen / weights, probe.pixel(i, j).map(f64::from));
            }
        }
        sum
    }

    fn probe(settings: ProbeSettings) -> Probe {
        let count = 3 * settings.width * settings.height();
        // Rough, with a Sun.
        let mut pixels: Vec<f32> = (0..count).map(|k| 0.2 + (k * 7919 % 977) as f32 * 0.01).collect();
        pixels[3 * (settings.width * 5 + 9)] = 4e4;
        Probe::new(pixels, settings).unwrap()
    }

    const NORMALS: [DVec3; 8] = [
        DVec3::Z,
        DVec3::NEG_Z,
        DVec3::X,
        DVec3::NEG_Y,
        DVec3::new(0.3, 0.5, 0.81),
        DVec3::new(-0.9, 0.2, 1e-9),
        DVec3::new(-0.3, -0.7, -0.2),
        DVec3::new(1e-7, 1e-7, 4.0),
    ];

    #[test]
    fn every_plane_receives_what_the_parts_of_the_footprints_give_it() {
        for rows in [Rows::Centre, Rows::Corner] {
            for (extent, turn_deg) in [(Extent::Full, 0.0), (Extent::Upper, 33.3)] {
                let probe = probe(ProbeSettings {
                    width: 64,
                    rows,
                    extent,
                    turn_deg,
                    color_space: ColorSpace::Xyz,
                    ..Default::default()
                });
                let found = irradiances(&probe, &NORMALS);
                for (normal, found) in NORMALS.into_iter().zip(found) {
                    let expected = by_force(&probe, normal.normalize());
                    for (found, expected) in found.into_iter().zip(expected) {
                        assert!(
                            (found - expected).abs() <= 2e-4 * expected + 1e-6,
                            "{rows:?} {extent:?} {normal}: {found} {expected}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn the_length_of_a_normal_does_not_count() {
        for projection in [Projection::LatLong, Projection::Fisheye] {
            let probe = probe(ProbeSettings { width: 64, projection, ..Default::default() });
            let expected = probe.irradiance(DVec3::new(1.0, 0.0, 1.0));
            assert!(expected[0] > 0.0);
            for length in [1e-320, 1e-162, 1e-3, 1e160, 1e200, 1e308] {
                assert_eq!(probe.irradiance(DVec3::new(length, 0.0, length)), expected, "{projection:?} {length}");
            }
        }
    }

    #[test]
    fn a_plane_alone_receives_the_same_bits_as_among_others() {
        for projection in [Projection::LatLong, Projection::Fisheye] {
            let probe = probe(ProbeSettings { width: 128, projection, ..Default::default() });
            let together = irradiances(&probe, &NORMALS);
            for (normal, together) in NORMALS.into_iter().zip(together) {
                assert_eq!(probe.irradiance(normal), together);
            }
            assert_eq!(probe.irradiance(DVec3::ZERO), [0.0; 3]);
        }
    }

    /// A plane and the one that faces away share the sphere: E(n) - E(-n) is n times the vector sum of the light.
    #[test]
    fn planes_back_to_back_receive_the_vector_sum() {
        for projection in [Projection::LatLong, Projection::Fisheye] {
            let probe = probe(ProbeSettings { width: 256, projection, ..Default::default() });
            let grid = probe.grid();
            let mut vector = DVec3::ZERO;
            for (row, column) in (0..probe.height).flat_map(|row| (0..probe.width).map(move |column| (row, column))) {
                let footprint = grid.footprint(column, row);
                vector += footprint.solid_angle * f64::from(probe.pixel(column, row)[1]) * footprint.mean_direction;
            }
            for normal in NORMALS {
                let normal = normal.normalize();
                let difference = probe.irradiance(normal)[1] - probe.irradiance(-normal)[1];
                let sum = probe.irradiance(normal)[1] + probe.irradiance(-normal)[1];
                assert!((difference - normal.dot(vector)).abs() < 1e-7 * sum, "{projection:?} {normal}: {difference}");
            }
        }
    }
}
