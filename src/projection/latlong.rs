//! Latitude-longitude images: which pixel is which direction, and what a pixel stands for.
//!
//! Continuous image coordinates (x, y) count pixels from the upper left corner; the middle of pixel (i, j) is (i + 0.5, j + 0.5).
//! With azimuth from north through east and theta the zenith angle:
//! ```text
//! x / W = 1/4 + (azimuth + turn) / 2 pi    (without turn north at 1/4, east in the middle, south at 3/4, west at the seam)
//! theta = span y / H                  rows = centre (Blender)
//! theta = span (y - 0.5) / (H - 1)    rows = corner (Mitsuba: the first and the last row are the poles)
//! ```
//! `span` is pi for the whole sphere and pi / 2 for the upper half.
//!
//! # Footprints
//! A pixel stands for a footprint: a weight k(theta, azimuth), and all footprints add up to 1 everywhere. A pixel's value is the mean of
//! the radiance over its footprint, so the sum over pixels of value times solid angle, integral of k d omega, is the
//! integral of the radiance exactly.
//! - rows = centre: k is 1 inside the pixel's cell of one row by one column, and 0 outside (a renderer that takes the
//!   closest pixel).
//! - rows = corner: k is what Mitsuba makes of one pixel by bilinear interpolation: a tent that falls from 1 at the pixel's direction to
//!   0 at the neighbouring rows and columns; at the first and last row half a tent, which ends at the pole.

use super::choices::{Extent, Projection, Rows};
use super::geometry::{Footprint, Geometry};
use crate::numerics::GaussLegendre;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// One row of a [`LatLong`] image: angles are zenith angles [radians].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The row's own zenith angle.
    pub theta: f64,
    /// Upper end of its footprint.
    pub from: f64,
    /// Lower end of its footprint.
    pub to: f64,
    /// Solid angle of one pixel of the row [sr].
    pub solid_angle: f64,
    /// Mean of cos(theta) over the footprint.
    pub mean_cosine: f64,
    /// Mean of max(cos(theta), 0) over the footprint: what a pixel adds to a horizontal plane, per energy.
    pub mean_upward: f64,
    /// Length of the horizontal part of the mean direction of one pixel.
    pub mean_horizontal: f64,
}

/// The geometry of a latitude-longitude image.
#[derive(Clone, Debug)]
pub struct LatLong {
    width: usize,
    rows: Rows,
    span: f64,
    step: f64,
    table: Vec<Row>,
    /// Columns by which the sky is turned to the right.
    turn: f64,
}

impl LatLong {
    /// The geometry of an image `width` pixels wide, for a width that [`Projection::check_width`] accepts.
    pub fn new(width: usize, rows: Rows, extent: Extent) -> Self {
        let span = match extent {
            Extent::Full => PI,
            Extent::Upper => FRAC_PI_2,
        };
        Self::with_span(width, Projection::LatLong.height(width, extent), rows, span)
    }

    /// The geometry of a picture of any size: the upper half of one if it is at least four times as wide as high.
    pub fn of_size(width: usize, height: usize, rows: Rows) -> Self {
        Self::with_span(width, height, rows, if 4 * height <= width { FRAC_PI_2 } else { PI })
    }

    fn with_span(width: usize, height: usize, rows: Rows, span: f64) -> Self {
        let step = match rows {
            Rows::Centre => span / height as f64,
            Rows::Corner => span / steps(height),
        };
        let mut image = Self { width, rows, span, step, table: Vec::new(), turn: 0.0 };
        let rule = GaussLegendre::new(8);
        image.table = (0..height).map(|j| image.make_row(j, height, &rule)).collect();
        image
    }

    /// The same with the sky turned clockwise by `turn_deg` [degrees], to the right in the image.
    pub fn turned(self, turn_deg: f64) -> Self {
        let columns = turn_deg / 360.0 * self.width as f64;
        // Whole columns stay whole, so that such a picture is the other one rolled.
        let turn = if (columns - columns.round()).abs() < 1e-9 * self.width as f64 { columns.round() } else { columns };
        Self { turn, ..self }
    }

    fn make_row(&self, j: usize, height: usize, rule: &GaussLegendre) -> Row {
        let (theta, from, to) = match self.rows {
            Rows::Centre => {
                let edge = |j: usize| self.span * j as f64 / height as f64;
                (0.5 * (edge(j) + edge(j + 1)), edge(j), edge(j + 1))
            }
            Rows::Corner => {
                let theta = |j: usize| self.span * j as f64 / steps(height);
                (theta(j), theta(j.saturating_sub(1)), theta((j + 1).min(height - 1)))
            }
        };
        let column = TAU / self.width as f64;
        let mut row = Row { theta, from, to, solid_angle: 0.0, mean_cosine: 0.0, mean_upward: 0.0, mean_horizontal: 0.0 };
        let mut knots = vec![from, theta, FRAC_PI_2, to];
        knots.retain(|knot| (from..=to).contains(knot));
        knots.sort_by(f64::total_cmp);
        for piece in knots.windows(2) {
            for (at, weight) in rule.on(piece[0], piece[1]) {
                let (sine, cosine) = at.sin_cos();
                let weight = weight * self.row_weight(&row, at) * sine;
                row.solid_angle += weight;
                row.mean_cosine += weight * cosine;
                row.mean_upward += weight * cosine.max(0.0);
                row.mean_horizontal += weight * sine;
            }
        }
        // The mean of a unit vector over a box (or a tent) of azimuth is shorter by sin(x) / x (or its square).
        let shortening = (0.5 * column).sin() / (0.5 * column);
        let power = if self.rows == Rows::Centre { 1 } else { 2 };
        row.mean_cosine /= row.solid_angle;
        row.mean_upward /= row.solid_angle;
        row.mean_horizontal *= shortening.powi(power) / row.solid_angle;
        row.solid_angle *= column;
        row
    }

    /// Width [pixels].
    pub fn width(&self) -> usize {
        self.width
    }

    /// Height [pixels].
    pub fn height(&self) -> usize {
        self.table.len()
    }

    /// Where the rows lie.
    pub fn rows(&self) -> Rows {
        self.rows
    }

    /// Zenith angle of the lower edge of the image [radians]: pi, or pi / 2 for the upper half.
    pub fn span(&self) -> f64 {
        self.span
    }

    /// Difference in zenith angle between one row and the next [radians].
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The rows, from the zenith down.
    pub fn table(&self) -> &[Row] {
        &self.table
    }

    /// Azimuth [radians] of the continuous column coordinate `x`.
    pub fn azimuth(&self, x: f64) -> f64 {
        TAU * ((x - self.turn) / self.width as f64 - 0.25)
    }

    /// Column coordinate in [0, W) of an azimuth [radians].
    pub fn x_of_azimuth(&self, azimuth: f64) -> f64 {
        let width = self.width as f64;
        let x = ((azimuth / TAU + 0.25).rem_euclid(1.0) * width + self.turn).rem_euclid(width);
        if x >= self.width as f64 { 0.0 } else { x }
    }

    /// Weight of `row`'s footprint at zenith angle `theta`.
    pub fn row_weight(&self, row: &Row, theta: f64) -> f64 {
        match self.rows {
            Rows::Centre => 1.0,
            Rows::Corner => (1.0 - (theta - row.theta).abs() / self.step).max(0.0),
        }
    }

    /// The one or two rows whose footprints hold the zenith angle `theta`, with their weights there; `None` outside the image.
    pub(crate) fn rows_at(&self, theta: f64) -> Option<[(usize, f64); 2]> {
        if !(0.0..=self.span).contains(&theta) {
            return None;
        }
        let last = self.table.len() - 1;
        let y = theta / self.step;
        let first = (y as usize).min(last);
        Some(match self.rows {
            Rows::Centre => [(first, 1.0), (first, 0.0)],
            Rows::Corner => [(first, 1.0 - (y - first as f64).min(1.0)), ((first + 1).min(last), (y - first as f64).min(1.0))],
        })
    }

    /// The one or two columns whose footprints hold an azimuth [radians], with their weights there.
    pub(crate) fn columns_at(&self, azimuth: f64) -> [(usize, f64); 2] {
        let x = self.x_of_azimuth(azimuth);
        match self.rows {
            Rows::Centre => [(x as usize, 1.0), (x as usize, 0.0)],
            Rows::Corner => {
                let x = x + self.width as f64 - 0.5;
                let first = x.floor();
                let second = first as usize + 1;
                [(first as usize % self.width, 1.0 - (x - first)), (second % self.width, x - first)]
            }
        }
    }

    /// Zenith angles at which footprints begin, end or have a kink: the knots between which an integrand is smooth.
    pub(crate) fn row_knots(&self) -> impl Iterator<Item = f64> + '_ {
        let knot = |row: &Row| if self.rows == Rows::Centre { row.from } else { row.theta };
        self.table.iter().map(knot).chain([self.span])
    }

    /// Column coordinate of the first of the column knots, which are whole columns apart: cell edges, or pixel centres, where tents have their kinks.
    pub(crate) fn column_knot_offset(&self) -> f64 {
        if self.rows == Rows::Centre { 0.0 } else { 0.5 }
    }
}

/// Steps from the first to the last of `height` rows; a single row is as good as the pole.
fn steps(height: usize) -> f64 {
    (height - 1).max(1) as f64
}

impl Geometry for LatLong {
    fn size(&self) -> (usize, usize) {
        (self.width, self.height())
    }

    fn reach(&self) -> f64 {
        self.span
    }

    fn pixel_angle(&self) -> f64 {
        TAU / self.width as f64
    }

    /// Beyond the first and the last row the direction is theirs.
    fn direction_and_density(&self, x: f64, y: f64) -> Option<(DVec3, f64)> {
        let theta = match self.rows {
            Rows::Centre => y * self.step,
            Rows::Corner => (y - 0.5) * self.step,
        };
        let direction = direction(theta.clamp(0.0, self.span), self.azimuth(x));
        Some((direction, TAU / self.width as f64 * self.step * direction.truncate().length()))
    }

    /// x lies in [0, W). Directions below an upper half give y > H.
    fn coordinates(&self, direction: DVec3) -> Option<(f64, f64)> {
        let theta = direction.truncate().length().atan2(direction.z);
        let azimuth = direction.x.atan2(direction.y);
        let y = match self.rows {
            Rows::Centre => theta / self.step,
            Rows::Corner => theta / self.step + 0.5,
        };
        Some((self.x_of_azimuth(azimuth), y))
    }

    /// Over the poles and across the left and right border.
    fn neighbour(&self, column: usize, row: usize, right: isize, down: isize) -> (usize, usize) {
        let width = self.width as isize;
        let (mut column, mut row) = (column as isize + right, row as isize + down);
        let last = self.height() as isize - 1;
        // In an image with rows on the poles, the row beyond the pole is row 1, not the pole itself once more.
        let corner = isize::from(self.rows == Rows::Corner);
        if row < 0 {
            (column, row) = (column + width / 2, corner);
        } else if row > last {
            let full = self.span > 3.0;
            (column, row) = if full { (column + width / 2, last - corner) } else { (column, last) };
        }
        (column.rem_euclid(width) as usize, row as usize)
    }

    fn footprint(&self, column: usize, row: usize) -> Footprint {
        let row = &self.table[row];
        let (sine, cosine) = self.azimuth(column as f64 + 0.5).sin_cos();
        let mean_direction = DVec3::new(row.mean_horizontal * sine, row.mean_horizontal * cosine, row.mean_cosine);
        Footprint { solid_angle: row.solid_angle, mean_direction, mean_upward: row.mean_upward }
    }

    fn zenith_range(&self, _: usize, row: usize) -> (f64, f64) {
        (self.table[row].from, self.table[row].to)
    }

    fn latlong(&self) -> Option<&LatLong> {
        Some(self)
    }
}

/// Unit vector (east, north, up) at zenith angle `theta` and `azimuth` [radians].
pub(crate) fn direction(theta: f64, azimuth: f64) -> DVec3 {
    let (sine, cosine) = theta.sin_cos();
    DVec3::new(sine * azimuth.sin(), sine * azimuth.cos(), cosine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const SIZES: [usize; 4] = [64, 66, 512, 4096];

    fn all() -> Vec<LatLong> {
        let mut images = Vec::new();
        for width in SIZES {
            for rows in [Rows::Centre, Rows::Corner] {
                images.push(LatLong::new(width, rows, Extent::Full));
                if width.is_multiple_of(4) {
                    images.push(LatLong::new(width, rows, Extent::Upper));
                }
            }
        }
        images
    }

    #[test]
    fn solid_angles_add_up_to_the_sphere() {
        for image in all() {
            let sum: f64 = image.table().iter().map(|row| row.solid_angle * image.width() as f64).sum();
            let expected = TAU * (1.0 - image.span().cos());
            assert!((sum / expected - 1.0).abs() < 1e-12, "{} {:?}: {sum}", image.width(), image.rows());
        }
    }

    #[test]
    fn a_uniform_sky_gives_pi_to_the_plane_below() {
        for image in all() {
            let sum: f64 = image.table().iter().map(|row| row.solid_angle * row.mean_upward * image.width() as f64).sum();
            assert!((sum / PI - 1.0).abs() < 1e-12, "{} {:?}: {sum}", image.width(), image.rows());
        }
    }

    #[test]
    fn the_compass_lies_where_blender_and_mitsuba_expect_it() {
        // checked against: measured mapping of Cycles (rows = centre) and of Mitsuba's envmap (rows = corner)
        let image = LatLong::new(1024, Rows::Centre, Extent::Full);
        for (direction, x) in [(DVec3::Y, 256.0), (DVec3::X, 512.0), (-DVec3::Y, 768.0), (-DVec3::X, 0.0)] {
            let found = image.coordinates(direction).unwrap();
            assert!((found.0 - x).abs() < 1e-9 && (found.1 - 256.0).abs() < 1e-9, "{direction}: {found:?}");
        }
        let corner = LatLong::new(1024, Rows::Corner, Extent::Full);
        assert_eq!(corner.table()[0].theta, 0.0);
        assert!((corner.table()[511].theta - PI).abs() < 1e-15);
        assert!((corner.coordinates(DVec3::X).unwrap().1 - 256.0).abs() < 1e-9);
    }

    #[test]
    fn interior_cells_have_their_closed_form() {
        let image = LatLong::new(64, Rows::Centre, Extent::Full);
        let row = &image.table()[9];
        let exact = TAU / 64.0 * (row.from.cos() - row.to.cos());
        assert!((row.solid_angle / exact - 1.0).abs() < 1e-13);
        let pole = &LatLong::new(64, Rows::Corner, Extent::Full).table()[0].solid_angle * 64.0 / TAU;
        let step = PI / 31.0;
        assert!((pole / (1.0 - step.sin() / step) - 1.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn directions_come_back(size in 0usize..4, corner: bool, azimuth in -PI..PI, cosine in -1.0f64..1.0) {
            let image = LatLong::new(SIZES[size], if corner { Rows::Corner } else { Rows::Centre }, Extent::Full);
            let there = direction(cosine.acos(), azimuth);
            let (x, y) = image.coordinates(there).unwrap();
            prop_assert!((0.0..image.width() as f64).contains(&x));
            prop_assert!(image.direction(x, y).unwrap().distance(there) < 1e-9);
        }

        #[test]
        fn footprints_add_up_to_one(size in 0usize..4, corner: bool, azimuth in -PI..PI, theta in 0.0..PI) {
            let image = LatLong::new(SIZES[size], if corner { Rows::Corner } else { Rows::Centre }, Extent::Full);
            let rows = image.rows_at(theta).unwrap();
            prop_assert!((rows[0].1 + rows[1].1 - 1.0).abs() < 1e-12);
            let columns = image.columns_at(azimuth);
            prop_assert!((columns[0].1 + columns[1].1 - 1.0).abs() < 1e-12);
            for (row, weight) in rows {
                let found = &image.table()[row];
                if weight > 0.0 {
                    prop_assert!(theta >= found.from - 1e-9 && theta <= found.to + 1e-9);
                    prop_assert!((image.row_weight(found, theta) - weight).abs() < 1e-9);
                }
            }
        }
    }
}
