//! Glare on a latitude-longitude probe, right at every altitude and across the seam.
//!
//! Light goes from a pixel s to a pixel t by a kernel that depends on both rows and on the difference of their columns only, for rays in the frame of the source too (its up is the
//! direction to the zenith). So for each pair of rows the sum over columns is a circular convolution:
//! ```text
//! out(t, i) = sum over rows s, columns j of  L(s, j) omega(s) P(s, t, i - j)
//! ```
//! with L radiance, omega the solid angle of a pixel, P the point spread function averaged over the target's pixel. Convolutions in azimuth are exact products of Fourier
//! series; nothing wraps where it should not, and nothing is stretched. The unscattered light stays in its pixel, 1 - (sum of P omega(t) over all other light): that keeps the energy of each
//! pixel exactly. The part of it that eq. 11 puts outside a pixel is neglected; it is below 1 % down to pixels of 0.05 degrees and matters from 0.02 degrees on (16384 columns).
//!
//! Streaks belong to points: a source that is extended blurs its own. So pixels with less than [`STREAKED_FROM`] of the light of the brightest scatter by the mean around the source. That kernel
//! is even and, d rows away, smooth over d rows: d / 12 columns are one sample of it, which leaves out nothing above 1e-12 of its Fourier series. That makes a smooth sky cheap: the cost is
//! (rows with streaks x rows + 150 x rows that glare) x columns, see `docs/finish.md`.

use super::scatter::Scatter;
use super::streaks::LAST_CHORD_SQUARED;
use crate::error::{Error, Result};
use crate::post::Picture;
use crate::progress::{Parts, Progress};
use crate::projection::{LatLong, Row};
use rayon::prelude::*;
use realfft::{RealFftPlanner, RealToComplex, num_complex::Complex};
use std::f64::consts::PI;
use std::sync::{Arc, Mutex, PoisonError};

/// What lies closer than this many pixels is averaged over the area of its pixel.
const AVERAGED_WITHIN: f32 = 12.0;

/// Pixels with this share of the light of the brightest pixel have streaks.
pub const STREAKED_FROM: f64 = 1e-3;

/// Sources that are spread over a row between two questions whether to go on.
const SOURCES_PER_CHECK: usize = 16;

/// Samples of a smooth kernel per distance from its source.
const SAMPLES_PER_DISTANCE: f64 = 12.0;

/// The geometry of a latitude-longitude picture.
///
/// # Errors
/// [`Error::Input`] for a picture of another projection, or if its sides are those of none.
pub fn geometry(picture: &Picture) -> Result<LatLong> {
    let (width, height) = (picture.width, picture.height);
    let grid = picture.grid();
    let Some(image) = grid.latlong() else {
        return Err(Error::input("projection", picture.view, "latlong, perspective or fisheye"));
    };
    if height < 2 || (width != 2 * height && width != 4 * height) {
        let allowed = "left out for a picture that is neither 2:1 (latitude-longitude, full) nor 4:1 (its upper half)";
        return Err(Error::input("projection", format!("latlong, {width} x {height}"), allowed));
    }
    Ok(image.clone())
}

/// Light of a row that glares: its spectrum by channel.
struct Source {
    row: usize,
    has_streaks: bool,
    spectra: [Vec<Complex<f64>>; 3],
}

/// A row to which light goes; those below an upper half only count what is lost to them.
struct Target {
    row: Row,
    index: Option<usize>,
}

struct Sphere<'a> {
    scatter: &'a Scatter,
    width: usize,
    /// Size of a pixel across rows [radians].
    step: f64,
    /// sin^2 of half of the difference in azimuth, and its sine, by difference of columns.
    turns: Vec<(f32, f32)>,
    /// Transforms of a row, of half a row and so on.
    forward: Vec<Arc<dyn RealToComplex<f64>>>,
    /// Light of a pixel from which on it has streaks.
    streaked_from: f64,
}

/// Spreads the part `share` of each pixel of `picture`. Returns the mean share, over the light, of each channel that was not scattered.
///
/// # Errors
/// [`Error::Input`] for a picture that is not such a probe; [`Error::Cancelled`].
pub fn apply(picture: &mut Picture, share: &[f32], scatter: &Scatter, progress: &Progress<'_>) -> Result<[f64; 3]> {
    let image = geometry(picture)?;
    let (width, height) = (picture.width, picture.height);
    let column = |k: usize| PI * k as f64 / width as f64;
    let turns = (0..width).map(|k| (column(k).sin().powi(2) as f32, (2.0 * column(k)).sin() as f32)).collect();
    let mut planner = RealFftPlanner::<f64>::new();
    let halvings = width.trailing_zeros().min((width / 8).max(1).ilog2());
    let forward = (0..=halvings).map(|k| planner.plan_fft_forward(width >> k)).collect();
    let brightest =
        (0..picture.pixels.len() / 3).into_par_iter().map(|k| light(picture, share, image.table(), k)).reduce(|| 0.0, f64::max);
    // Without streaks every pixel is smooth.
    let streaked_from = if scatter.has_streaks() { STREAKED_FROM * brightest } else { f64::INFINITY };
    let sphere = Sphere { scatter, width, step: image.step(), turns, forward, streaked_from };
    let sources = sphere.sources(picture, share, image.table(), progress)?;
    if sources.is_empty() {
        return Ok([1.0; 3]);
    }

    let mut targets: Vec<Target> = image.table().iter().enumerate().map(|(k, &row)| Target { row, index: Some(k) }).collect();
    if image.span() < 2.0 {
        let below = |row: &Row| Row { theta: PI - row.theta, from: PI - row.to, to: PI - row.from, ..*row };
        targets.extend(image.table().iter().map(|row| Target { row: below(row), index: None }));
    }
    let lost = Mutex::new(vec![[0.0; 3]; sources.len()]);
    let parts = progress.parts("glare", targets.len());
    let scattered = targets
        .par_iter()
        .map(|target| {
            let (light, sums) = sphere.gather(target, &sources, image.table(), &parts)?;
            let mut lost = lost.lock().unwrap_or_else(PoisonError::into_inner);
            lost.iter_mut().zip(&sums).for_each(|(lost, sum)| (0..3).for_each(|c| lost[c] += sum[c]));
            parts.finish_one().map(|()| light)
        })
        .collect::<Result<Vec<Vec<f32>>>>()?;
    // What rounding makes negative of light is black.
    let floor = if picture.pixels.par_iter().all(|&value| value >= 0.0) { 0.0 } else { f32::MIN };
    let lost = lost.into_inner().unwrap_or_else(PoisonError::into_inner);

    // By row, for smooth light and for light with streaks.
    let mut kept = vec![[[1.0; 3]; 2]; height];
    for (source, lost) in sources.iter().zip(&lost) {
        kept[source.row][usize::from(source.has_streaks)] = lost.map(|lost| 1.0 - lost);
    }
    let (mut unscattered, mut total) = ([0.0; 3], [0.0; 3]);
    for source in &sources {
        for c in 0..3 {
            let light = source.spectra[c][0].re;
            unscattered[c] += light * kept[source.row][usize::from(source.has_streaks)][c];
            total[c] += light;
        }
    }
    let has_streaks: Vec<bool> =
        (0..width * height).into_par_iter().map(|k| light(picture, share, image.table(), k) >= sphere.streaked_from).collect();
    let rows = picture.pixels.par_chunks_mut(3 * width).zip(share.par_chunks(width)).zip(has_streaks.par_chunks(width));
    rows.zip(scattered.par_iter().zip(&kept)).for_each(|(((pixels, share), has_streaks), (scattered, kept))| {
        for (k, value) in pixels.iter_mut().enumerate() {
            let share = f64::from(share[k / 3]);
            let kept = kept[usize::from(has_streaks[k / 3])][k % 3];
            *value = (f64::from(*value) * (1.0 - share + share * kept) + f64::from(scattered[k].max(floor))) as f32;
        }
    });
    Ok(std::array::from_fn(|c| if total[c] > 0.0 { unscattered[c] / total[c] } else { 1.0 }))
}

/// Light of pixel `k` that glares: the sum of the magnitudes of its channels times its solid angle.
fn light(picture: &Picture, share: &[f32], table: &[Row], k: usize) -> f64 {
    let sum: f64 = picture.pixels[3 * k..3 * k + 3].iter().map(|value| f64::from(value.abs())).sum();
    f64::from(share[k]) * table[k / picture.width].solid_angle * sum
}

impl Sphere<'_> {
    fn sources(&self, picture: &Picture, share: &[f32], table: &[Row], progress: &Progress<'_>) -> Result<Vec<Source>> {
        let row_sources = |row: usize| -> Result<Vec<Source>> {
            progress.report("glare", 0.0)?;
            let range = row * self.width..(row + 1) * self.width;
            let of_kind = |has_streaks: bool| {
                let is_in = |k: usize| share[k] > 0.0 && (light(picture, share, table, k) >= self.streaked_from) == has_streaks;
                let chosen: Vec<bool> = range.clone().map(is_in).collect();
                if !chosen.contains(&true) {
                    return None;
                }
                let spectra = std::array::from_fn(|channel| {
                    let value = |(k, &chosen): (usize, &bool)| {
                        let part = f64::from(share[k]) * table[row].solid_angle;
                        if chosen { part * f64::from(picture.pixels[3 * k + channel]) } else { 0.0 }
                    };
                    let mut line: Vec<f64> = range.clone().zip(&chosen).map(value).collect();
                    self.spectrum(&mut line)
                });
                Some(Source { row, has_streaks, spectra })
            };
            Ok([false, true].into_iter().filter_map(of_kind).collect())
        };
        let rows = (0..picture.height).into_par_iter().map(row_sources).collect::<Result<Vec<_>>>()?;
        Ok(rows.into_iter().flatten().collect())
    }

    fn spectrum(&self, line: &mut [f64]) -> Vec<Complex<f64>> {
        let mut spectrum = self.forward[0].make_output_vec();
        // Lengths are those of the plan.
        let _ = self.forward[0].process(line, &mut spectrum);
        spectrum
    }

    /// What arrives in a row, (width, 3), and the share of the light of each source that does.
    fn gather(&self, target: &Target, sources: &[Source], table: &[Row], parts: &Parts<'_>) -> Result<(Vec<f32>, Vec<[f64; 3]>)> {
        let frequencies = self.width / 2 + 1;
        let mut sums = Vec::with_capacity(sources.len());
        let mut arriving = vec![[Complex::<f64>::default(); 3]; frequencies];
        let mut kernels: [Vec<f64>; 3] = std::array::from_fn(|_| vec![0.0; self.width]);
        let mut spectra: [Vec<Complex<f64>>; 3] = std::array::from_fn(|_| self.forward[0].make_output_vec());
        let mut scratch = self.forward[0].make_scratch_vec();
        for (k, source) in sources.iter().enumerate() {
            if k % SOURCES_PER_CHECK == 0 {
                parts.check()?;
            }
            let nearest = Pair::new(table[source.row].theta, target.row.theta).chord_squared;
            let (halvings, coloured) = if source.has_streaks && nearest < LAST_CHORD_SQUARED {
                (0, self.fill(&table[source.row], &target.row, &mut kernels))
            } else {
                self.fill_smooth(&table[source.row], &target.row, &mut kernels)
            };
            let count = if coloured { 3 } else { 1 };
            let (samples, share) = (self.width >> halvings, (1 << halvings) as f64);
            let sum: [f64; 3] =
                std::array::from_fn(|c| if c < count { share * kernels[c][..samples].iter().sum::<f64>() } else { 0.0 });
            let sum = if coloured { sum } else { [sum[0]; 3] };
            sums.push(sum.map(|sum| sum * target.row.solid_angle));
            if target.index.is_none() {
                continue;
            }
            for (kernel, spectrum) in kernels.iter_mut().zip(&mut spectra).take(count) {
                // Lengths are those of the plan.
                let _ = self.forward[halvings].process_with_scratch(
                    &mut kernel[..samples],
                    &mut spectrum[..samples / 2 + 1],
                    &mut scratch,
                );
            }
            let of = |c: usize| if coloured { c } else { 0 };
            for c in 0..3 {
                let pairs = spectra[of(c)][..samples / 2 + 1].iter().zip(&source.spectra[c]);
                arriving.iter_mut().zip(pairs).for_each(|(sum, (kernel, light))| sum[c] += kernel * (light * share));
            }
        }
        if target.index.is_none() {
            return Ok((Vec::new(), sums));
        }
        let inverse = RealFftPlanner::<f64>::new().plan_fft_inverse(self.width);
        let mut light = vec![0.0; 3 * self.width];
        let mut line = inverse.make_output_vec();
        for c in 0..3 {
            let mut spectrum: Vec<Complex<f64>> = arriving.iter().map(|sum| sum[c] / self.width as f64).collect();
            // Rounding leaves imaginary parts where a real row has none.
            spectrum[0].im = 0.0;
            if self.width.is_multiple_of(2) {
                spectrum[frequencies - 1].im = 0.0;
            }
            // Lengths are those of the plan.
            let _ = inverse.process(&mut spectrum, &mut line);
            line.iter().zip(light[c..].iter_mut().step_by(3)).for_each(|(&value, out)| *out = value as f32);
        }
        Ok((light, sums))
    }

    /// The kernel between two rows by difference of columns [sr-1], and whether its channels differ: if not, only the first is written.
    fn fill(&self, source: &Row, target: &Row, kernels: &mut [Vec<f64>; 3]) -> bool {
        let difference = target.theta - source.theta;
        let nearest = 4.0 * (0.5 * difference).sin().powi(2);
        let coloured = self.scatter.is_coloured(nearest as f32);
        let far = 2.0 * f64::from(AVERAGED_WITHIN) * self.step;
        let pair = Pair::new(source.theta, target.theta);
        let across = self.step as f32;
        let along = (2.0 * PI / self.width as f64 * target.theta.sin()) as f32;
        let size = (across * along).sqrt().max(1e-9);
        let may_be_near = difference.abs() < far;
        let near = (AVERAGED_WITHIN * across.max(along)).powi(2);
        for (k, &turn) in self.turns.iter().enumerate() {
            let chord_squared = pair.chord_squared(turn);
            let value = if may_be_near && chord_squared < near {
                self.mean(source, target, k, (chord_squared, true), (across, along))
            } else {
                self.scatter.at(chord_squared, pair.position(turn), size / chord_squared.sqrt())
            };
            kernels[0][k] = f64::from(value[0]);
            if coloured {
                kernels[1][k] = f64::from(value[1]);
                kernels[2][k] = f64::from(value[2]);
            }
        }
        coloured
    }

    /// The kernel without streaks, in every 2^n-th column only, and n: where it is that smooth.
    fn fill_smooth(&self, source: &Row, target: &Row, kernels: &mut [Vec<f64>; 3]) -> (usize, bool) {
        let difference = (target.theta - source.theta).abs();
        let pair = Pair::new(source.theta, target.theta);
        let coloured = self.scatter.is_coloured(pair.chord_squared);
        let columns = difference / self.step / SAMPLES_PER_DISTANCE;
        let halvings = if coloured || columns < 2.0 { 0 } else { (columns.log2() as usize).min(self.forward.len() - 1) };
        let (across, along) = (self.step as f32, (2.0 * PI / self.width as f64 * target.theta.sin()) as f32);
        let may_be_near = difference < 2.0 * f64::from(AVERAGED_WITHIN) * self.step;
        let near = (AVERAGED_WITHIN * across.max(along)).powi(2);
        let samples = self.width >> halvings;
        for k in 0..=samples / 2 {
            let column = k << halvings;
            let chord_squared = pair.chord_squared(self.turns[column]);
            let value = if may_be_near && chord_squared < near {
                self.mean(source, target, column, (chord_squared, false), (across, along))
            } else {
                self.scatter.smooth(chord_squared)
            };
            for (kernel, value) in kernels.iter_mut().zip(value).take(if coloured { 3 } else { 1 }) {
                kernel[k] = f64::from(value);
                // The same to the other side.
                kernel[(samples - k) % samples] = f64::from(value);
            }
        }
        (halvings, coloured)
    }

    /// Mean over the pixel of the target, with or without streaks, whose sides are `sides` (across rows, along the row) [radians].
    fn mean(
        &self,
        source: &Row,
        target: &Row,
        difference: usize,
        (chord_squared, has_streaks): (f32, bool),
        sides: (f32, f32),
    ) -> [f32; 3] {
        let distance = chord_squared.sqrt().max(0.5 * sides.0.min(sides.1)).max(1e-9);
        let parts = |side: f32| ((AVERAGED_WITHIN * side / distance).ceil() as usize).clamp(1, 24);
        let (rows, columns) = (parts(sides.0), parts(sides.1));
        let (mut sum, mut total) = ([0.0; 3], 0.0);
        let size = (sides.0 * sides.1 / (rows * columns) as f32).sqrt().max(1e-9);
        for i in 0..rows {
            let theta = target.from + (target.to - target.from) * (i as f64 + 0.5) / rows as f64;
            let pair = Pair::new(source.theta, theta);
            let weight = theta.sin() as f32;
            for j in 0..columns {
                let half = PI / self.width as f64 * (difference as f64 + (j as f64 + 0.5) / columns as f64 - 0.5);
                let turn = (half.sin().powi(2) as f32, (2.0 * half).sin() as f32);
                let chord_squared = pair.chord_squared(turn);
                let value = if has_streaks {
                    self.scatter.at(chord_squared, pair.position(turn), size / chord_squared.sqrt().max(1e-9))
                } else {
                    self.scatter.smooth(chord_squared)
                };
                (0..3).for_each(|c| sum[c] += weight * value[c]);
                total += weight;
            }
        }
        sum.map(|sum| sum / total)
    }
}

/// Two zenith angles, ready for any difference of azimuth. Forms without cancellation: directions that are close stay apart.
struct Pair {
    /// 4 sin^2 of half of the difference.
    chord_squared: f32,
    /// 4 times the product of the sines.
    sines: f32,
    /// Sine of the target, of the difference, and 2 sin(target) cos(source).
    right: f32,
    up: f32,
    bend: f32,
}

impl Pair {
    fn new(source: f64, target: f64) -> Self {
        Self {
            chord_squared: (4.0 * (0.5 * (target - source)).sin().powi(2)) as f32,
            sines: (4.0 * source.sin() * target.sin()) as f32,
            right: target.sin() as f32,
            up: (source - target).sin() as f32,
            bend: (2.0 * target.sin() * source.cos()) as f32,
        }
    }

    /// Square of the chord, for sin^2 of half of the difference of azimuth and its sine.
    #[inline]
    fn chord_squared(&self, turn: (f32, f32)) -> f32 {
        self.chord_squared + self.sines * turn.0
    }

    /// Where the target lies as seen from the source: right and up.
    #[inline]
    fn position(&self, turn: (f32, f32)) -> (f32, f32) {
        (self.right * turn.1, self.up + self.bend * turn.0)
    }
}
