//! A rendered probe: pixels, and what they mean.

use super::grid::Grid;
use super::quadrature::GaussLegendre;
use super::settings::{ProbeSettings, Rows};
use crate::error::{Error, Result};
use glam::DVec3;
use rayon::prelude::*;

/// An image of the light from all directions: linear, in the colour space and scale of its settings.
#[derive(Clone, Debug)]
pub struct Probe {
    /// Width [pixels].
    pub width: usize,
    /// Height [pixels].
    pub height: usize,
    /// Values, row-major from the upper left, (height, width, 3).
    pub pixels: Vec<f32>,
    /// What was asked for.
    pub settings: ProbeSettings,
}

impl Probe {
    /// A probe of given `pixels`, row-major (height, width, 3).
    ///
    /// # Errors
    /// [`Error::Input`] for settings that no image can have, [`Error::Data`] if the number of values is not that of the settings or a value is not finite.
    pub fn new(pixels: Vec<f32>, settings: ProbeSettings) -> Result<Self> {
        settings.validate()?;
        let probe = Self { width: settings.width, height: settings.height(), pixels, settings };
        probe.validate()?;
        Ok(probe)
    }

    /// Checks that the pixels are as many as the settings say, and finite.
    ///
    /// # Errors
    /// [`Error::Data`] that says what is wrong, with the first pixel that is.
    pub fn validate(&self) -> Result<()> {
        let expected = 3 * self.width * self.height;
        if self.pixels.len() != expected {
            return Err(Error::data(format!(
                "a probe of {} x {} pixels has {} values, not {expected}",
                self.width,
                self.height,
                self.pixels.len()
            )));
        }
        // A block of values without a branch is checked as fast as memory can be read.
        let sound = |block: &[f32]| block.iter().fold(true, |sound, value| sound & value.is_finite());
        if self.pixels.par_chunks(1 << 14).all(sound) {
            return Ok(());
        }
        match self.pixels.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(k) => Err(Error::data(format!(
                "the probe's pixel (column {}, row {}) is not finite",
                k / 3 % self.width,
                k / 3 / self.width
            ))),
        }
    }

    /// The geometry of the pixels.
    pub fn grid(&self) -> Grid {
        Grid::new(&self.settings)
    }

    /// The three values of pixel (`column`, `row`).
    ///
    /// # Panics
    /// If there is no such pixel.
    pub fn pixel(&self, column: usize, row: usize) -> [f32; 3] {
        assert!(column < self.width && row < self.height, "no pixel ({column}, {row})");
        let k = 3 * (row * self.width + column);
        [self.pixels[k], self.pixels[k + 1], self.pixels[k + 2]]
    }

    /// Irradiance of a plane that faces `normal` (east, north, up; any length but 0): the integral of the pixels over their
    /// footprints times the cosine, in the probe's colour space and scale times sr.
    pub fn irradiance(&self, normal: DVec3) -> [f64; 3] {
        let normal = normal.normalize_or_zero();
        let grid = self.grid();
        let rule = GaussLegendre::new(6);
        (0..self.height)
            .into_par_iter()
            .map(|row| {
                let mut sum = [0.0; 3];
                for column in 0..self.width {
                    let pixel = self.pixel(column, row);
                    if pixel == [0.0; 3] {
                        continue;
                    }
                    let weight = cosine_weight(&grid, &rule, column, row, normal);
                    for (sum, value) in sum.iter_mut().zip(pixel) {
                        *sum += weight * f64::from(value);
                    }
                }
                sum
            })
            .reduce(|| [0.0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]])
    }
}

/// Integral of max(normal . direction, 0) over the footprint of a pixel [sr].
fn cosine_weight(grid: &Grid, rule: &GaussLegendre, column: usize, row: usize, normal: DVec3) -> f64 {
    let image = match grid {
        Grid::LatLong(image) => image,
        Grid::Fisheye(image) => {
            let mut sum = 0.0;
            image.visit_parts(column, row, image.parts(column, row), |direction, weight| {
                sum += weight * normal.dot(direction).max(0.0)
            });
            return sum;
        }
    };
    let found = &image.table()[row];
    if normal == DVec3::Z {
        return found.solid_angle * found.mean_upward;
    }
    if normal == -DVec3::Z {
        return found.solid_angle * (found.mean_upward - found.mean_cosine);
    }
    let mean = normal.dot(image.mean_direction(column, row));
    let reach = if image.rows() == Rows::Centre { 0.5 } else { 1.0 };
    let half_column = reach * std::f64::consts::TAU / image.width() as f64;
    if mean.abs() > 1.1 * ((found.to - found.from) + half_column) {
        return found.solid_angle * mean.max(0.0);
    }
    // The plane cuts the footprint.
    let parts = 16;
    let (mut sum, mut total) = (0.0, 0.0);
    for piece in [(found.from, found.theta), (found.theta, found.to)] {
        for (theta, weight) in rule.on(piece.0, piece.1) {
            let weight = weight * theta.sin() * image.row_weight(found, theta);
            for k in 0..parts {
                let offset = 2.0 * reach * ((k as f64 + 0.5) / parts as f64 - 0.5);
                let weight = if image.rows() == Rows::Centre { weight } else { weight * (1.0 - offset.abs()) };
                let direction = super::latlong::direction(theta, image.azimuth(column as f64 + 0.5 + offset));
                total += weight;
                sum += weight * normal.dot(direction).max(0.0);
            }
        }
    }
    found.solid_angle * sum / total
}
