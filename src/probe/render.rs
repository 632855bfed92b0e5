//! Fills an image with the light of a sky: every pixel the mean of the radiance over its footprint.
//!
//! Latitude-longitude rows are integrated over cos(theta), in which solid angle is uniform, by Gauss-Legendre nodes on pieces between
//! the kinks of the footprint and the horizon, so that a row which the horizon cuts gets exactly its shares of sky and ground.
//! Along a row, equal sub-columns. How many of each falls with the width ([`Sampling::of`]): a pixel of 0.2 degrees needs one.

use super::disc;
use super::fisheye::Fisheye;
use super::grid::Grid;
use super::image::Probe;
use super::latlong::{LatLong, Row};
use super::moments::restore_upward;
use super::quadrature::GaussLegendre;
use super::settings::{Extent, GroundView, ProbeSettings, Rows};
use crate::error::Result;
use crate::progress::{Parts, Progress};
use crate::sky::SkyLight;
use crate::spectrum::color_space::transform;
use crate::spectrum::{ColorSpace, Gamut};
use rayon::prelude::*;
use std::f64::consts::FRAC_PI_2;

/// Renders the light of `sky` into an image. Progress is the stage "render"; cancelling takes effect within a row per thread.
///
/// # Errors
/// [`Error::Input`](crate::Error::Input) for settings that no image can have, [`Error::Cancelled`](crate::Error::Cancelled).
pub fn render(sky: &dyn SkyLight, settings: &ProbeSettings, progress: &Progress) -> Result<Probe> {
    settings.validate()?;
    progress.report("render", 0.0)?;
    let grid = Grid::new(settings);
    let (width, height) = grid.size();
    let mut pixels = vec![0.0_f32; 3 * width * height];
    match &grid {
        Grid::LatLong(image) => render_latlong(sky, settings, image, &mut pixels, progress)?,
        Grid::Fisheye(image) => render_fisheye(sky, settings, image, &mut pixels, progress)?,
    }
    if settings.sun_disc {
        for disc in sky.discs() {
            for (column, row, energy) in disc::draw(&disc, sky.horizon_altitude(), &grid).pixels() {
                let solid_angle = grid.footprint(column, row).solid_angle;
                if solid_angle > 0.0 {
                    let pixel = &mut pixels[3 * (row * width + column)..][..3];
                    for (value, energy) in pixel.iter_mut().zip(energy) {
                        *value += (energy / solid_angle) as f32;
                    }
                }
            }
        }
    }
    convert(settings, &mut pixels);
    Probe::new(pixels, settings.clone())
}

/// From XYZ to the colour space and scale of the settings, in place.
fn convert(settings: &ProbeSettings, pixels: &mut [f32]) {
    let factor = settings.scale.factor();
    let matrix = settings.color_space.matrix_from_xyz().map(|row| row.map(|value| value * factor));
    let luminance_weights = settings.color_space.matrix_to_xyz()[1];
    let gamut = if settings.color_space == ColorSpace::Xyz { Gamut::Keep } else { settings.gamut };
    pixels.par_chunks_mut(3 * settings.width).for_each(|row| {
        for pixel in row.chunks_exact_mut(3) {
            let rgb = transform(&matrix, [0, 1, 2].map(|channel| f64::from(pixel[channel])));
            for (value, rgb) in pixel.iter_mut().zip(gamut.apply(rgb, luminance_weights)) {
                *value = rgb as f32;
            }
        }
    });
}

/// How finely a footprint is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sampling {
    /// Gauss nodes per smooth piece of a row.
    rows: usize,
    /// Equal parts of a column.
    columns: usize,
    /// Whether the irradiance of the horizontal plane needs [`restore_upward`].
    restore: bool,
}

impl Sampling {
    fn of(width: usize) -> Self {
        let (rows, columns, restore) = match width {
            ..128 => (6, 6, true),
            128..256 => (4, 4, true),
            256..1024 => (3, 3, true),
            1024..2048 => (2, 2, false),
            _ => (1, 1, false),
        };
        Self { rows, columns, restore }
    }
}

/// A circle of equal altitude with its share of a row.
struct Node {
    altitude: f64,
    weight: f64,
    /// max(cos(theta), 0) minus its mean over the row.
    excess: f64,
}

/// The circles that make up `row`; the weights of all, seen or not, add up to 1. `horizon` is a zenith angle [radians].
fn nodes(image: &LatLong, row: &Row, sampling: Sampling, horizon: f64, ground: GroundView, out: &mut Vec<Node>) {
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
        let rule = GaussLegendre::new(sampling.rows.max(2));
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

/// What a thread needs for one row after the other.
struct Workspace {
    nodes: Vec<Node>,
    circle: Vec<[f32; 3]>,
    sum: Vec<[f32; 3]>,
    missing: Vec<[f32; 3]>,
}

fn render_latlong(
    sky: &dyn SkyLight,
    settings: &ProbeSettings,
    image: &LatLong,
    pixels: &mut [f32],
    progress: &Progress,
) -> Result<()> {
    let (width, height) = (image.width(), image.height());
    let sampling = Sampling::of(width);
    let count = width * sampling.columns;
    let azimuths: Vec<f64> = (0..count).map(|k| image.azimuth((k as f64 + 0.5) / sampling.columns as f64)).collect();
    let kernel = column_kernel(image.rows(), sampling.columns);
    let horizon = FRAC_PI_2 - sky.horizon_altitude();
    let mirrored = settings.ground == GroundView::Mirrored && settings.extent == Extent::Full;
    let drawn = if mirrored { height.div_ceil(2) } else { height };
    let mut missing = if sampling.restore { vec![0.0_f32; 3 * width * height] } else { Vec::new() };
    let parts = progress.parts("render", drawn);
    let work = |space: &mut Workspace, j: usize, out: &mut [f32], missing: &mut [f32]| -> Result<()> {
        let row = &image.table()[j];
        nodes(image, row, sampling, horizon, settings.ground, &mut space.nodes);
        space.sum.fill([0.0; 3]);
        space.missing.fill([0.0; 3]);
        for node in &space.nodes {
            sky.radiance_circle(node.altitude, &azimuths, &mut space.circle);
            accumulate(&mut space.sum, &space.circle, node.weight);
            if !missing.is_empty() {
                accumulate(&mut space.missing, &space.circle, node.weight * node.excess * row.solid_angle);
            }
        }
        fold(&space.sum, sampling.columns, &kernel, out);
        if !missing.is_empty() {
            fold(&space.missing, sampling.columns, &kernel, missing);
        }
        parts.finish_one()
    };
    let space = || Workspace {
        nodes: Vec::new(),
        circle: vec![[0.0; 3]; count],
        sum: vec![[0.0; 3]; count],
        missing: vec![[0.0; 3]; if sampling.restore { count } else { 0 }],
    };
    let rows = pixels.par_chunks_mut(3 * width).take(drawn);
    if sampling.restore {
        rows.zip(missing.par_chunks_mut(3 * width))
            .enumerate()
            .try_for_each_init(space, |space, (j, (out, missing))| work(space, j, out, missing))?;
        restore_upward(image, pixels, &missing);
    } else {
        rows.enumerate().try_for_each_init(space, |space, (j, out)| work(space, j, out, &mut []))?;
    }
    if mirrored {
        for j in drawn..height {
            let source = 3 * width * (height - 1 - j);
            pixels.copy_within(source..source + 3 * width, 3 * width * j);
        }
    }
    Ok(())
}

fn accumulate(sum: &mut [[f32; 3]], circle: &[[f32; 3]], weight: f64) {
    let weight = weight as f32;
    for (sum, value) in sum.iter_mut().zip(circle) {
        for channel in 0..3 {
            sum[channel] += weight * value[channel];
        }
    }
}

/// Sub-columns that make up a pixel, counted from its first, with weights that add up to 1.
fn column_kernel(rows: Rows, count: usize) -> Vec<(isize, f32)> {
    match rows {
        Rows::Centre => (0..count as isize).map(|k| (k, 1.0 / count as f32)).collect(),
        Rows::Corner => {
            let count = count as isize;
            (-count..2 * count)
                .map(|k| (k, (1.0 - ((k as f32 + 0.5) / count as f32 - 0.5).abs()) / count as f32))
                .filter(|&(_, weight)| weight > 1e-6)
                .collect()
        }
    }
}

/// Means of the sub-columns over each pixel, around the seam.
fn fold(circle: &[[f32; 3]], columns: usize, kernel: &[(isize, f32)], out: &mut [f32]) {
    let count = circle.len() as isize;
    for (i, pixel) in out.chunks_exact_mut(3).enumerate() {
        pixel.fill(0.0);
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

fn render_fisheye(
    sky: &dyn SkyLight,
    settings: &ProbeSettings,
    image: &Fisheye,
    pixels: &mut [f32],
    progress: &Progress,
) -> Result<()> {
    let width = image.width();
    let count = Sampling::of(width).columns;
    let parts: Parts = progress.parts("render", width);
    let horizon = FRAC_PI_2 - sky.horizon_altitude();
    pixels.par_chunks_mut(3 * width).enumerate().try_for_each(|(row, out)| {
        for (column, pixel) in out.chunks_exact_mut(3).enumerate() {
            let (near, far) = image.zenith_range(column, row);
            if near > image.reach() {
                continue;
            }
            // The horizon is an edge, and the rim cuts pixels.
            let edge = (near..=far).contains(&horizon) || (near..=far).contains(&FRAC_PI_2) || far >= image.reach();
            let count = if edge { count.max(8) } else { count };
            let (mut sum, mut total) = ([0.0_f64; 3], 0.0);
            image.visit_parts(column, row, count, |direction, weight| {
                total += weight;
                let theta = direction.truncate().length().atan2(direction.z);
                let altitude = match settings.ground {
                    GroundView::Off if theta > horizon => return,
                    GroundView::Mirrored => (FRAC_PI_2 - theta).abs(),
                    _ => FRAC_PI_2 - theta,
                };
                let mut value = [[0.0_f32; 3]];
                sky.radiance_circle(altitude, &[direction.x.atan2(direction.y)], &mut value);
                for channel in 0..3 {
                    sum[channel] += weight * f64::from(value[0][channel]);
                }
            });
            if total > 0.0 {
                for (value, sum) in pixel.iter_mut().zip(sum) {
                    *value = (sum / total) as f32;
                }
            }
        }
        parts.finish_one()
    })
}
