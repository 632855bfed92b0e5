//! From light to files without the picture in memory: a band of rows is rendered and packed while the one before is being written.

use super::atomic::{Pending, commit};
use super::exr::Largest;
use super::row_file::RowFile;
use super::{FileOptions, Metadata, each_once};
use crate::error::Result;
use crate::probe::{Painter, Probe, ProbeSettings};
use crate::progress::Progress;
use crate::sky::SkyLight;
use rayon::prelude::*;
use std::ops::Range;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Rows are handed over in multiples of this: the rows of a block of OpenEXR.
const BLOCK_ROWS: usize = 16;

/// Rows of a band: enough for every thread, and little memory, of so many pictures.
fn band_rows(width: usize, pictures: usize) -> usize {
    let for_threads = 2 * rayon::current_num_threads();
    let row_bytes = 12 * width * pictures;
    let (least, most) = ((4 << 20) / (row_bytes * BLOCK_ROWS), (96 << 20) / (row_bytes * BLOCK_ROWS));
    BLOCK_ROWS * for_threads.max(least).min(most).max(1)
}

/// Renders the light of `sky` into the files `paths`, each in the format that its suffix names: all of them whole, or none at all. One that is named twice is written once. The pixels are those of
/// [`render`](crate::probe::render), but only a band of rows of them is in memory at a time: but for PNG, whose exposure needs the whole picture.
/// Half floats are rendered twice, because the first rows depend on the brightest pixel. Progress is the stage "render", then
/// "write".
///
/// # Errors
/// [`Error::Input`](crate::Error::Input) for settings that no image can have, an unknown suffix, options out of range, or pixels that half
/// floats cannot hold; [`Error::Data`](crate::Error::Data) for light that is not finite; [`Error::File`](crate::Error::File); [`Error::Cancelled`](crate::Error::Cancelled).
pub fn render_to_files<P: AsRef<Path>>(
    sky: &dyn SkyLight,
    settings: &ProbeSettings,
    paths: &[P],
    options: &FileOptions,
    metadata: &Metadata,
    progress: &Progress,
) -> Result<()> {
    render_with(Vec::new(), (sky, settings), paths, (options, metadata), progress)
}

/// As [`render_to_files`]; the files `others`, which are written already, get their names together with these.
pub(crate) fn render_with<P: AsRef<Path>>(
    others: Vec<Pending>,
    (sky, settings): (&dyn SkyLight, &ProbeSettings),
    paths: &[P],
    (options, metadata): (&FileOptions, &Metadata),
    progress: &Progress,
) -> Result<()> {
    settings.validate()?;
    let whole = progress;
    let measured = Mutex::new(None);
    let largest = || {
        let mut measured = measured.lock().unwrap_or_else(PoisonError::into_inner);
        if measured.is_none() {
            let first_half = |stage: &str, fraction: f64| progress.report(stage, 0.5 * fraction).is_ok();
            *measured = Some(largest_value(sky, settings, &Progress::new(&first_half))?);
        }
        Ok(measured.unwrap_or_default())
    };
    let layers = if options.layers { sky.layers() } else { Vec::new() };
    let names: Vec<&'static str> = layers.iter().map(|(name, _)| *name).collect();
    let files = each_once(paths).into_iter();
    let files = files.map(|path| RowFile::create(path.as_ref(), settings, &names, (options, metadata), largest));
    let files = files.collect::<Result<Vec<_>>>()?;
    let twice = measured.lock().unwrap_or_else(PoisonError::into_inner).is_some();
    let second_half = |stage: &str, fraction: f64| progress.report(stage, 0.5 + 0.5 * fraction).is_ok();
    let rest = Progress::new(&second_half);
    let progress = if twice { &rest } else { progress };
    if layers.is_empty() {
        return write_bands(&[Painter::new(sky, settings, progress)?], files, others, whole);
    }
    let count = layers.len() as f64;
    let shares: Vec<_> = (0..layers.len())
        .map(|k| move |stage: &str, fraction: f64| progress.report(stage, (k as f64 + fraction) / count).is_ok())
        .collect();
    let shares: Vec<Progress> = shares.iter().map(|share| Progress::new(share)).collect();
    let painters = layers.iter().zip(&shares).map(|((_, light), share)| Painter::new(&**light, settings, share));
    write_bands(&painters.collect::<Result<Vec<_>>>()?, files, others, whole)
}

/// Writes the picture of one painter, or the sum of several and, in files that have layers, each. All files get their names in the end, after `others`.
fn write_bands(painters: &[Painter], mut files: Vec<RowFile>, mut others: Vec<Pending>, progress: &Progress) -> Result<()> {
    let (width, height) = painters[0].size();
    let pictures = if painters.len() == 1 { 1 } else { painters.len() + 1 };
    let encoders: Vec<_> = files.iter().map(RowFile::encoder).collect();
    let spare = Mutex::new(Vec::<Vec<Vec<f32>>>::new());
    let make = |rows: Range<usize>| {
        let mut bands = spare.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_else(|| vec![Vec::new(); pictures]);
        bands.iter_mut().for_each(|pixels| pixels.resize(3 * width * rows.len(), 0.0));
        if let [painter] = painters {
            painter.paint(rows.start, &mut bands[0])?;
        } else {
            let (sum, layers) = bands.split_at_mut(1);
            sum[0].fill(0.0);
            for (painter, layer) in painters.iter().zip(layers) {
                painter.paint(rows.start, layer)?;
                sum[0].par_iter_mut().zip(&*layer).for_each(|(sum, value)| *sum += value);
            }
        }
        let pictures: Vec<&[f32]> = bands.iter().map(Vec::as_slice).collect();
        let pieces: Vec<_> = encoders.iter().map(|encoder| encoder.encode(rows.start, &pictures)).collect();
        Ok((bands, pieces))
    };
    let write = |(bands, pieces): (Vec<Vec<f32>>, Vec<Vec<Vec<u8>>>)| {
        for (file, pieces) in files.iter_mut().zip(&pieces) {
            file.append(&bands[0], pieces)?;
        }
        spare.lock().unwrap_or_else(PoisonError::into_inner).push(bands);
        Ok(())
    };
    in_order(bands(width, height, pictures), make, write)?;
    for file in files {
        others.push(file.finish(progress)?);
    }
    commit(others, progress)
}

/// Writes `probe` to `path`; see [`save_with_progress`](super::save_with_progress).
pub(super) fn write_probe(
    path: &Path,
    probe: &Probe,
    (options, metadata): (&FileOptions, &Metadata),
    progress: &Progress,
) -> Result<()> {
    let stride = 3 * probe.width;
    let largest = || Ok(Largest::of(0, &probe.pixels));
    let mut file = RowFile::create(path, &probe.settings, &[], (options, metadata), largest)?;
    let encoder = file.encoder();
    let values = |rows: &Range<usize>| &probe.pixels[stride * rows.start..stride * rows.end];
    let make = |rows: Range<usize>| {
        progress.report("write", rows.start as f64 / probe.height as f64)?;
        Ok((encoder.encode(rows.start, &[values(&rows)]), rows))
    };
    in_order(bands(probe.width, probe.height, 1), make, |(pieces, rows)| file.append(values(&rows), &pieces))?;
    commit(vec![file.finish(progress)?], progress)
}

/// The value of greatest magnitude in the whole picture.
fn largest_value(sky: &dyn SkyLight, settings: &ProbeSettings, progress: &Progress) -> Result<Largest> {
    let painter = Painter::new(sky, settings, progress)?;
    let (width, height) = painter.size();
    let mut pixels = Vec::new();
    let mut largest = Largest::default();
    for rows in bands(width, height, 1) {
        pixels.resize(3 * width * rows.len(), 0.0);
        painter.paint(rows.start, &mut pixels)?;
        largest = largest.or(Largest::of(3 * width * rows.start, &pixels));
    }
    Ok(largest)
}

fn bands(width: usize, height: usize, pictures: usize) -> impl Iterator<Item = Range<usize>> {
    let rows = band_rows(width, pictures);
    (0..height).step_by(rows).map(move |first| first..(first + rows).min(height))
}

/// Makes one item after the other with all threads, while the one before is written.
fn in_order<T: Send>(
    bands: impl Iterator<Item = Range<usize>>,
    make: impl Fn(Range<usize>) -> Result<T> + Sync,
    mut write: impl FnMut(T) -> Result<()> + Send,
) -> Result<()> {
    let mut ready: Option<T> = None;
    for band in bands {
        let before = ready.take();
        let (made, written) = rayon::join(|| make(band), || before.map_or(Ok(()), &mut write));
        written?;
        ready = Some(made?);
    }
    ready.map_or(Ok(()), write)
}

#[cfg(test)]
mod tests;
