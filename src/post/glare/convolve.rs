//! Convolution of a flat picture with a kernel as large as wanted, by FFT.
//!
//! The picture is padded with black to at least its size plus the reach of the kernel, so that nothing wraps around; sizes are products of 2, 3 and 5. In double precision: a Sun of
//! 1e9 in single precision would leave noise of 1e2 all over the sky. Rows that are black padding are neither transformed nor kept, and one channel is worked on at a time:
//! a picture of 3840 x 2160 with a kernel of full size needs 0.7 GB, by night, where channels differ, 0.8.

use crate::error::Result;
use crate::progress::{Parts, Progress};
use rayon::prelude::*;
use realfft::{RealFftPlanner, num_complex::Complex};
use rustfft::FftPlanner;

/// Columns that are transposed together: two lines of memory.
const TILE: usize = 8;

/// A kernel that is the same for all pixels.
pub trait Kernel: Sync {
    /// Share of the light of each channel that arrives `right` and `up` pixels from its source.
    fn at(&self, right: isize, up: isize) -> [f32; 3];

    /// Light that is not scattered: a line of pixels from offset 0 on, the same to both sides, sum 1. It is spread by this line along rows and along columns.
    fn unscattered(&self) -> Vec<f64>;

    /// Distance [pixels] beyond which all channels are the same; 0 if they are everywhere.
    fn coloured_within(&self) -> f64;
}

/// A plan for pictures of one size.
pub struct Convolution<'a> {
    size: (usize, usize),
    padded: (usize, usize),
    reach: (usize, usize),
    kernel: &'a dyn Kernel,
}

/// Spectrum of a kernel by columns, and what it leaves of the unscattered light.
struct Spectrum {
    columns: Vec<Complex<f64>>,
    scattered: f64,
}

impl<'a> Convolution<'a> {
    /// For pictures of `size` (width, height) and offsets up to `reach`.
    pub fn new(size: (usize, usize), reach: (usize, usize), kernel: &'a dyn Kernel) -> Self {
        let reach = (reach.0.min(size.0 - 1), reach.1.min(size.1 - 1));
        // Even, so that a row has a middle frequency.
        let padded = (2 * good_size((size.0 + reach.0).div_ceil(2)), good_size(size.1 + reach.1));
        Self { size, padded, reach, kernel }
    }

    /// Half of the frequencies of a row: the others are their conjugates.
    fn frequencies(&self) -> usize {
        self.padded.0 / 2 + 1
    }

    /// Adds to each channel of `pixels` (RGB) the convolution of its part `share`, and takes that part away. Returns the share of each channel that was not scattered: what the kernel within
    /// its reach leaves of 1.
    ///
    /// # Errors
    /// [`Error::Cancelled`](crate::Error::Cancelled).
    pub fn apply(&self, pixels: &mut [f32], share: &[f32], progress: &Progress<'_>) -> Result<[f64; 3]> {
        let kernels = if self.kernel.coloured_within() > 0.0 { 3 } else { 1 };
        let (blocks, rows) = (self.frequencies().div_ceil(TILE), self.size.1);
        let total = kernels * (self.padded.1 + blocks) + 3 * (2 * rows + blocks);
        let parts = progress.parts("glare", total);
        let mut unscattered = [0.0; 3];
        let mut spectrum = None;
        let first = if kernels == 3 { self.first_channel(&parts)? } else { Vec::new() };
        for (channel, unscattered) in unscattered.iter_mut().enumerate() {
            if channel < kernels {
                drop(spectrum.take());
                spectrum = Some(self.spectrum(channel, &first, &parts)?);
            }
            if let Some(spectrum) = &spectrum {
                *unscattered = 1.0 - spectrum.scattered;
                self.apply_channel(pixels, share, channel, spectrum, &parts)?;
            }
        }
        Ok(unscattered)
    }

    fn apply_channel(
        &self,
        pixels: &mut [f32],
        share: &[f32],
        channel: usize,
        kernel: &Spectrum,
        parts: &Parts<'_>,
    ) -> Result<()> {
        let (width, height) = self.size;
        let source = |y: usize, row: &mut [f64]| {
            let range = y * width..(y + 1) * width;
            let values = pixels[3 * range.start + channel..].iter().step_by(3);
            for ((value, share), pixel) in row.iter_mut().zip(&share[range]).zip(values) {
                *value = f64::from(*share) * f64::from(*pixel);
            }
            0.0
        };
        let (rows, _) = self.forward_rows(height, &source, parts)?;
        let mut columns = self.transposed(&rows, height, height, parts)?;
        drop(rows);
        self.multiply(&mut columns, kernel, parts)?;

        // What rounding makes negative of light is black.
        let floor = if pixels[channel..].par_iter().step_by(3).all(|&value| value >= 0.0) { 0.0 } else { f64::MIN };
        let scale = 1.0 / (self.padded.0 * self.padded.1) as f64;
        let frequencies = self.frequencies();
        let plan = RealFftPlanner::<f64>::new().plan_fft_inverse(self.padded.0);
        let bands = pixels.par_chunks_mut(3 * width * TILE).zip(share.par_chunks(width * TILE)).enumerate();
        bands.try_for_each(|(band, (pixels, share))| {
            let count = share.len() / width;
            let mut tile = vec![Complex::default(); count * frequencies];
            for (f, column) in columns.chunks(height).enumerate() {
                (0..count).for_each(|row| tile[row * frequencies + f] = column[band * TILE + row]);
            }
            let mut line = plan.make_output_vec();
            let mut scratch = plan.make_scratch_vec();
            for (row, spectrum) in tile.chunks_mut(frequencies).enumerate() {
                // Rounding leaves imaginary parts where a real row has none.
                spectrum[0].im = 0.0;
                spectrum[frequencies - 1].im = 0.0;
                // Lengths are those of the plan.
                let _ = plan.process_with_scratch(spectrum, &mut line, &mut scratch);
                let range = row * width..(row + 1) * width;
                let values = pixels[3 * range.start + channel..].iter_mut().step_by(3);
                for ((value, share), spread) in values.zip(&share[range]).zip(&line) {
                    let kept = f64::from(*value) * (1.0 - f64::from(*share));
                    *value = (kept + (scale * spread).max(floor)) as f32;
                }
                parts.finish_one()?;
            }
            Ok(())
        })
    }

    /// Spectra of `count` rows that `fill` writes, and the sum of what it returns.
    fn forward_rows(
        &self,
        count: usize,
        fill: &(dyn Fn(usize, &mut [f64]) -> f64 + Sync),
        parts: &Parts<'_>,
    ) -> Result<(Vec<Complex<f64>>, f64)> {
        let plan = RealFftPlanner::<f64>::new().plan_fft_forward(self.padded.0);
        let mut rows = vec![Complex::default(); count * self.frequencies()];
        let sums = rows.par_chunks_mut(self.frequencies()).enumerate().map_init(
            || (plan.make_input_vec(), plan.make_scratch_vec()),
            |(line, scratch), (y, spectrum)| {
                line.fill(0.0);
                let sum = fill(y, line);
                // Lengths are those of the plan.
                let _ = plan.process_with_scratch(line, spectrum, scratch);
                parts.finish_one().map(|()| sum)
            },
        );
        let sum = sums.try_reduce(|| 0.0, |a, b| Ok(a + b))?;
        Ok((rows, sum))
    }

    /// Columns of `length`, the rest zero, of `count` rows of spectra.
    fn transposed(&self, rows: &[Complex<f64>], count: usize, length: usize, parts: &Parts<'_>) -> Result<Vec<Complex<f64>>> {
        let frequencies = self.frequencies();
        let mut columns = vec![Complex::default(); frequencies * length];
        columns.par_chunks_mut(TILE * length).enumerate().try_for_each(|(tile, columns)| {
            parts.check()?;
            for y in 0..count {
                let row = &rows[y * frequencies + tile * TILE..];
                for (column, value) in columns.chunks_mut(length).zip(row) {
                    column[y] = *value;
                }
            }
            Ok(())
        })?;
        Ok(columns)
    }

    /// Columns of the picture become columns of its convolution, before the inverse transform of rows.
    fn multiply(&self, columns: &mut [Complex<f64>], kernel: &Spectrum, parts: &Parts<'_>) -> Result<()> {
        let (height, length) = (self.size.1, self.padded.1);
        let mut planner = FftPlanner::<f64>::new();
        let (forward, inverse) = (planner.plan_fft_forward(length), planner.plan_fft_inverse(length));
        let scratch_length = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
        let work = columns.par_chunks_mut(TILE * height).zip(kernel.columns.par_chunks(TILE * length));
        work.try_for_each_init(
            || (vec![Complex::default(); length], vec![Complex::default(); scratch_length]),
            |(line, scratch), (columns, kernel)| {
                for (column, kernel) in columns.chunks_mut(height).zip(kernel.chunks(length)) {
                    line[..height].copy_from_slice(column);
                    line[height..].fill(Complex::default());
                    forward.process_with_scratch(line, scratch);
                    line.iter_mut().zip(kernel).for_each(|(value, factor)| *value *= factor);
                    inverse.process_with_scratch(line, scratch);
                    column.copy_from_slice(&line[..height]);
                }
                parts.finish_one()
            },
        )
    }

    /// The kernel's first channel, from the lower left on: where channels are the same, they need not be asked for again.
    fn first_channel(&self, parts: &Parts<'_>) -> Result<Vec<f32>> {
        let (reach_x, reach_y) = (self.reach.0 as isize, self.reach.1 as isize);
        let breadth = 2 * self.reach.0 + 1;
        let mut values = vec![0.0; breadth * (2 * self.reach.1 + 1)];
        values.par_chunks_mut(breadth).enumerate().try_for_each(|(k, row)| {
            parts.check()?;
            let up = k as isize - reach_y;
            row.iter_mut().zip(-reach_x..=reach_x).for_each(|(value, right)| *value = self.kernel.at(right, up)[0]);
            Ok(())
        })?;
        Ok(values)
    }

    /// The transform of one channel of the kernel, of which `first` has the first or nothing, with the unscattered light that makes its sum 1.
    fn spectrum(&self, channel: usize, first: &[f32], parts: &Parts<'_>) -> Result<Spectrum> {
        let ((width, height), (reach_x, reach_y)) = (self.padded, self.reach);
        let (left, breadth) = (-(reach_x as isize), 2 * reach_x + 1);
        let coloured = self.kernel.coloured_within();
        let fill = |y: usize, row: &mut [f64]| {
            // Rows count downwards.
            let up = if y <= reach_y { -(y as isize) } else { (height - y) as isize };
            if up > reach_y as isize {
                return 0.0;
            }
            let known = first.get((up + reach_y as isize) as usize * breadth..).filter(|known| !known.is_empty());
            let mut sum = 0.0;
            for (k, right) in (left..=reach_x as isize).enumerate() {
                let value = match known {
                    Some(known) if channel == 0 || (right as f64).hypot(up as f64) > coloured => known[k],
                    _ => self.kernel.at(right, up)[channel],
                };
                row[right.rem_euclid(width as isize) as usize] = f64::from(value);
                sum += f64::from(value);
            }
            sum
        };
        let (rows, scattered) = self.forward_rows(height, &fill, parts)?;
        let mut columns = self.transposed(&rows, height, height, parts)?;
        drop(rows);
        let line = self.kernel.unscattered();
        let (along_x, along_y) = (line_spectrum(&line, width), line_spectrum(&line, height));
        let forward = FftPlanner::<f64>::new().plan_fft_forward(height);
        columns.par_chunks_mut(TILE * height).enumerate().try_for_each_init(
            || vec![Complex::default(); forward.get_inplace_scratch_len()],
            |scratch, (tile, columns)| {
                for (f, column) in columns.chunks_mut(height).enumerate() {
                    forward.process_with_scratch(column, scratch);
                    let weight = (1.0 - scattered) * along_x[tile * TILE + f];
                    column.iter_mut().zip(&along_y).for_each(|(value, factor)| value.re += weight * factor);
                }
                parts.finish_one()
            },
        )?;
        Ok(Spectrum { columns, scattered })
    }
}

/// Transform of length `length` of a line that is the same to both sides of 0, without what does not fit.
fn line_spectrum(line: &[f64], length: usize) -> Vec<f64> {
    let mut values = vec![Complex::default(); length];
    for (k, &value) in line.iter().enumerate() {
        values[k % length].re += value;
        if k > 0 {
            values[(length - k % length) % length].re += value;
        }
    }
    FftPlanner::<f64>::new().plan_fft_forward(length).process(&mut values);
    values.into_iter().map(|value| value.re).collect()
}

/// The smallest product of 2, 3 and 5 that is not below `least`.
fn good_size(least: usize) -> usize {
    let only_small_factors = |mut n: usize| {
        for factor in [2, 3, 5] {
            while n.is_multiple_of(factor) {
                n /= factor;
            }
        }
        n == 1
    };
    (least.max(1)..).find(|&n| only_small_factors(n)).unwrap_or(least)
}
