//! Rows of an image, in any order and by any number of threads: what a whole picture and a picture that streams to a file are both made of.

use super::conversion::Conversion;
use super::disc;
use super::footprint::{Node, Sampling, accumulate, column_samples, fold, nodes};
use super::moments::restore_upward;
use super::points;
use super::settings::{GroundView, ProbeSettings};
use crate::error::{Error, Result};
use crate::numerics::GaussLegendre;
use crate::progress::{Parts, Progress};
use crate::projection::{Extent, Geometry, Grid, LatLong};
use crate::sky::SkyLight;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Paints the rows of one image of a sky.
pub struct Painter<'a> {
    sky: &'a dyn SkyLight,
    settings: ProbeSettings,
    grid: Grid,
    sampling: Sampling,
    rule: GaussLegendre,
    /// Azimuths of the samples of an image whose rows are circles [radians].
    azimuths: Vec<f64>,
    kernel: Vec<(isize, f32)>,
    conversion: Conversion,
    /// Radiance that discs and points add, by row: (column, XYZ).
    drawn: BTreeMap<usize, Vec<(usize, [f32; 3])>>,
    /// The smooth part of a small image, whose rows lend each other energy; empty if rows stand alone.
    smooth: Vec<f32>,
    parts: Parts<'a>,
}

/// What a thread needs for one row after the other.
struct Workspace {
    nodes: Vec<Node>,
    circle: Vec<[f32; 3]>,
    sum: Vec<[f32; 3]>,
    missing: Vec<[f32; 3]>,
    /// Directions and solid angles [sr] of the parts of a pixel.
    parts: Vec<(DVec3, f64)>,
}

impl<'a> Painter<'a> {
    /// Gets ready to paint; most of an image less than 1024 pixels wide is painted here. Progress is the stage "render".
    ///
    /// # Errors
    /// [`Error::Input`] for settings that no image can have, [`Error::Cancelled`].
    pub fn new(sky: &'a dyn SkyLight, settings: &ProbeSettings, progress: &Progress<'a>) -> Result<Self> {
        settings.validate()?;
        Self::on(settings.grid(), sky, settings, progress)
    }

    /// The same for a given geometry of the image.
    pub(super) fn on(grid: Grid, sky: &'a dyn SkyLight, settings: &ProbeSettings, progress: &Progress<'a>) -> Result<Self> {
        progress.report("render", 0.0)?;
        let sampling = Sampling::of(settings.width);
        let (azimuths, kernel) = match grid.latlong() {
            Some(image) => {
                let (places, kernel) = column_samples(image.rows(), sampling.columns);
                let azimuth = |column: usize| places.iter().map(move |at| image.azimuth(column as f64 + at));
                ((0..image.width()).flat_map(azimuth).collect(), kernel)
            }
            None => (Vec::new(), Vec::new()),
        };
        let mut painter = Self {
            sky,
            settings: settings.clone(),
            sampling,
            rule: GaussLegendre::new(sampling.rows.max(2)),
            azimuths,
            kernel,
            conversion: Conversion::new(settings),
            drawn: drawn(sky, settings, &*grid),
            smooth: Vec::new(),
            parts: progress.parts("render", grid.size().1),
            grid,
        };
        if sampling.restore {
            painter.smooth = match painter.grid.latlong() {
                Some(image) => painter.restored(image)?,
                None => Vec::new(),
            };
        }
        Ok(painter)
    }

    /// Width and height [pixels].
    pub fn size(&self) -> (usize, usize) {
        self.grid.size()
    }

    /// What is painted.
    pub fn settings(&self) -> &ProbeSettings {
        &self.settings
    }

    /// Paints whole rows from row `first` on into `out`, in the colour space and scale of the settings, with the threads of the pool.
    ///
    /// # Errors
    /// [`Error::Data`] for light that is not finite, [`Error::Cancelled`].
    ///
    /// # Panics
    /// If `out` is not a number of whole rows that the image has.
    pub fn paint(&self, first: usize, out: &mut [f32]) -> Result<()> {
        let stride = 3 * self.size().0;
        assert!(out.len().is_multiple_of(stride) && first + out.len() / stride <= self.size().1, "rows that there are");
        out.par_chunks_mut(stride)
            .enumerate()
            .try_for_each_init(|| self.workspace(), |space, (row, out)| self.paint_row(first + row, space, out))
    }

    fn workspace(&self) -> Workspace {
        let count = if self.smooth.is_empty() { self.azimuths.len() } else { 0 };
        Workspace {
            nodes: Vec::new(),
            circle: vec![[0.0; 3]; count],
            sum: vec![[0.0; 3]; count],
            missing: Vec::new(),
            parts: Vec::new(),
        }
    }

    fn paint_row(&self, row: usize, space: &mut Workspace, out: &mut [f32]) -> Result<()> {
        if !self.smooth.is_empty() {
            out.copy_from_slice(&self.smooth[row * out.len()..(row + 1) * out.len()]);
        }
        let pixels = out.as_chunks_mut::<3>().0;
        if self.smooth.is_empty() {
            match self.grid.latlong() {
                Some(image) => self.paint_circles(image, row, space, pixels),
                None => self.paint_parts(row, &mut space.parts, pixels),
            }
            self.parts.finish_one()?;
        }
        for &(column, light) in self.drawn.get(&row).into_iter().flatten() {
            for (value, light) in pixels[column].iter_mut().zip(light) {
                *value += light;
            }
        }
        // A gamut would make 0 of what is not a number.
        check_finite(row, pixels)?;
        self.conversion.apply(pixels);
        check_finite(row, pixels)
    }

    /// One row of a latitude-longitude image.
    fn paint_circles(&self, image: &LatLong, row: usize, space: &mut Workspace, out: &mut [[f32; 3]]) {
        let (mirrored, height) = (self.mirrored(), image.height());
        let row = &image.table()[if mirrored { row.min(height - 1 - row) } else { row }];
        nodes(image, row, (self.sampling, &self.rule), self.horizon(), self.settings.ground, &mut space.nodes);
        if let [node] = &space.nodes[..]
            && node.weight == 1.0
            && self.kernel == [(0, 1.0)]
        {
            return self.sky.radiance_circle(node.altitude, &self.azimuths, out);
        }
        self.add_circles(space, 0.0);
        fold(&space.sum, self.sampling.columns, &self.kernel, out);
    }

    /// Sums the circles of `space.nodes`, and what the horizontal plane misses for a pixel of `solid_angle` if that is asked for.
    fn add_circles(&self, space: &mut Workspace, solid_angle: f64) {
        space.sum.fill([0.0; 3]);
        space.missing.fill([0.0; 3]);
        for node in &space.nodes {
            self.sky.radiance_circle(node.altitude, &self.azimuths, &mut space.circle);
            accumulate(&mut space.sum, &space.circle, node.weight);
            if !space.missing.is_empty() {
                accumulate(&mut space.missing, &space.circle, node.weight * node.excess * solid_angle);
            }
        }
    }

    /// The smooth part of a small image, in XYZ.
    fn restored(&self, image: &LatLong) -> Result<Vec<f32>> {
        let (width, height) = (image.width(), image.height());
        let drawn = if self.mirrored() { height.div_ceil(2) } else { height };
        let mut pixels = vec![0.0_f32; 3 * width * height];
        let mut missing = vec![0.0_f32; 3 * width * height];
        let space = || Workspace { missing: vec![[0.0; 3]; self.azimuths.len()], ..self.workspace() };
        let rows = pixels.par_chunks_mut(3 * width).zip(missing.par_chunks_mut(3 * width));
        rows.enumerate().try_for_each_init(space, |space, (j, (out, missing))| {
            if j < drawn {
                let row = &image.table()[j];
                nodes(image, row, (self.sampling, &self.rule), self.horizon(), self.settings.ground, &mut space.nodes);
                self.add_circles(space, row.solid_angle);
                fold(&space.sum, self.sampling.columns, &self.kernel, out.as_chunks_mut::<3>().0);
                fold(&space.missing, self.sampling.columns, &self.kernel, missing.as_chunks_mut::<3>().0);
                check_finite(j, out.as_chunks::<3>().0)?;
                check_finite(j, missing.as_chunks::<3>().0)?;
            }
            self.parts.finish_one()
        })?;
        restore_upward(image, &mut pixels, &missing);
        for j in drawn..height {
            let source = 3 * width * (height - 1 - j);
            pixels.copy_within(source..source + 3 * width, 3 * width * j);
        }
        Ok(pixels)
    }

    /// One row of an image whose rows are no circles: each pixel by its parts, which `parts` has room for.
    fn paint_parts(&self, row: usize, parts: &mut Vec<(DVec3, f64)>, out: &mut [[f32; 3]]) {
        let (horizon, reach) = (self.horizon(), self.grid.reach());
        for (column, pixel) in out.iter_mut().enumerate() {
            *pixel = [0.0; 3];
            let (near, far) = self.grid.zenith_range(column, row);
            if near > reach {
                continue;
            }
            // The horizon is an edge, and the rim cuts pixels.
            let edge = (near..=far).contains(&horizon) || (near..=far).contains(&FRAC_PI_2) || far >= reach;
            let count = if edge { self.sampling.columns.max(8) } else { self.sampling.columns };
            self.grid.parts(column, row, count, parts);
            let (mut sum, mut total) = ([0.0_f64; 3], 0.0);
            for &(direction, weight) in &*parts {
                total += weight;
                let theta = direction.truncate().length().atan2(direction.z);
                let altitude = match self.settings.ground {
                    GroundView::Off if theta > horizon => continue,
                    GroundView::Mirrored => (FRAC_PI_2 - theta).abs(),
                    _ => FRAC_PI_2 - theta,
                };
                let mut value = [[0.0_f32; 3]];
                self.sky.radiance_circle(altitude, &[direction.x.atan2(direction.y)], &mut value);
                for channel in 0..3 {
                    sum[channel] += weight * f64::from(value[0][channel]);
                }
            }
            if total > 0.0 {
                *pixel = sum.map(|sum| (sum / total) as f32);
            }
        }
    }

    /// Zenith angle of the horizon [radians].
    fn horizon(&self) -> f64 {
        FRAC_PI_2 - self.sky.horizon_altitude()
    }

    /// Whether the lower rows are the upper ones once more.
    fn mirrored(&self) -> bool {
        self.settings.ground == GroundView::Mirrored && self.settings.extent == Extent::Full
    }
}

/// Checks that all numbers of row `row` are finite; without a branch per value, so that it costs next to nothing.
fn check_finite(row: usize, pixels: &[[f32; 3]]) -> Result<()> {
    if pixels.iter().fold(true, |finite, [a, b, c]| finite & a.is_finite() & b.is_finite() & c.is_finite()) {
        return Ok(());
    }
    Err(Error::data(format!("the light in row {row} of the probe is not finite")))
}

/// Radiance that the discs and points of `sky` add to pixels, by row.
fn drawn(sky: &dyn SkyLight, settings: &ProbeSettings, grid: &dyn Geometry) -> BTreeMap<usize, Vec<(usize, [f32; 3])>> {
    let mut rows: BTreeMap<usize, Vec<(usize, [f32; 3])>> = BTreeMap::new();
    let mut add = |column: usize, row: usize, energy: [f64; 3]| {
        let solid_angle = grid.footprint(column, row).solid_angle;
        if solid_angle > 0.0 {
            rows.entry(row).or_default().push((column, energy.map(|energy| (energy / solid_angle) as f32)));
        }
    };
    for disc in sky.discs().iter().filter(|disc| if disc.is_sun { settings.sun_disc } else { settings.moon_disc }) {
        for (column, row, energy) in disc::draw(disc, sky.horizon_altitude(), grid).pixels() {
            add(column, row, energy);
        }
    }
    points::draw(&sky.points(), grid, add);
    rows
}
