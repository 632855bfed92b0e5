//! A picture file that takes shape row by row; it appears when it is finished, or not at all.

use super::atomic::Pending;
use super::exr::{self, Packing};
use super::{FileOptions, Format, Half, Metadata, hdr, png};
use crate::error::{Error, Result};
use crate::post::tone::{Frame, ToneMapper, ToneMapping};
use crate::probe::{Probe, ProbeSettings};
use crate::progress::Progress;
use std::fs::File;
use std::io::{BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// Turns rows into what the file holds of them, on any thread.
#[derive(Clone, Debug)]
pub enum Encoder {
    Exr(Packing),
    Hdr {
        width: usize,
    },
    /// A PNG's exposure needs the whole picture.
    Png,
}

impl Encoder {
    /// The pieces of the file that hold `pictures`, the picture and its layers: whole rows from row `first` on, a multiple of 16, and so is their number unless they are the last.
    pub fn encode(&self, first: usize, pictures: &[&[f32]]) -> Vec<Vec<u8>> {
        match self {
            Self::Exr(packing) => packing.pack(first, pictures),
            Self::Hdr { width } => hdr::encode_rows(*width, pictures[0]),
            Self::Png => Vec::new(),
        }
    }
}

/// The file while it is written.
pub struct RowFile {
    path: PathBuf,
    pending: Pending,
    out: BufWriter<File>,
    encoder: Encoder,
    settings: ProbeSettings,
    tone: ToneMapping,
    /// Where the next piece begins [bytes].
    position: u64,
    /// Where each piece begins.
    offsets: Vec<u64>,
    /// The picture so far, if the format needs all of it.
    pixels: Vec<f32>,
}

impl RowFile {
    /// Begins the file `path` in the format that its suffix names, with `layers` if it is EXR. `largest` tells the largest value of the picture; only half floats ask for it.
    ///
    /// # Errors
    /// [`Error::Input`] for an unknown suffix, options out of range, or pixels that half floats cannot hold; [`Error::File`].
    pub fn create(
        path: &Path,
        settings: &ProbeSettings,
        layers: &[&'static str],
        (options, metadata): (&FileOptions, &Metadata),
        largest: impl FnOnce() -> Result<exr::Largest>,
    ) -> Result<Self> {
        let format = Format::of(path)?;
        let tone = options.tone_mapping()?;
        let (width, height) = (settings.width, settings.height());
        let (encoder, head) = match format {
            Format::Exr => {
                let half = options.half != Half::Off;
                let scale = if half { exr::pixel_scale(options.half, largest()?, width)? } else { 1.0 };
                let packing = Packing::new((width, height), half, scale, layers.to_vec());
                let table = vec![0; 8 * packing.blocks()];
                let head = [exr::header(settings, metadata, &packing), table].concat();
                (Encoder::Exr(packing), head)
            }
            Format::Hdr => (Encoder::Hdr { width }, hdr::header(settings, metadata).into_bytes()),
            Format::Png => (Encoder::Png, Vec::new()),
        };
        let pending = Pending::new(path)?;
        let mut out = BufWriter::with_capacity(1 << 20, pending.open()?);
        out.write_all(&head).map_err(|error| Error::file(path, error))?;
        Ok(Self {
            path: path.to_path_buf(),
            pending,
            out,
            encoder,
            settings: settings.clone(),
            tone,
            position: head.len() as u64,
            offsets: Vec::new(),
            pixels: Vec::new(),
        })
    }

    /// What turns rows into pieces of this file.
    pub fn encoder(&self) -> Encoder {
        self.encoder.clone()
    }

    /// Appends the rows `pixels`, which the encoder made `pieces` of.
    ///
    /// # Errors
    /// [`Error::File`].
    pub fn append(&mut self, pixels: &[f32], pieces: &[Vec<u8>]) -> Result<()> {
        for piece in pieces {
            self.offsets.push(self.position);
            self.position += piece.len() as u64;
            self.out.write_all(piece).map_err(|error| Error::file(&self.path, error))?;
        }
        if matches!(self.encoder, Encoder::Png) {
            self.pixels.extend_from_slice(pixels);
        }
        Ok(())
    }

    /// Completes the file, which then waits for its name.
    ///
    /// # Errors
    /// [`Error::File`], [`Error::Cancelled`].
    pub fn finish(mut self, progress: &Progress<'_>) -> Result<Pending> {
        let failed = |error| Error::file(&self.path, error);
        match &self.encoder {
            Encoder::Exr(packing) => {
                let table: Vec<u8> = self.offsets.iter().flat_map(|offset| offset.to_le_bytes()).collect();
                let first = self.offsets.first().copied().unwrap_or(self.position);
                debug_assert_eq!(self.offsets.len(), packing.blocks());
                self.out.seek(SeekFrom::Start(first - table.len() as u64)).map_err(failed)?;
                self.out.write_all(&table).map_err(failed)?;
            }
            Encoder::Hdr { .. } => {}
            Encoder::Png => {
                let probe = Probe::new(std::mem::take(&mut self.pixels), self.settings.clone())?;
                let mapper = ToneMapper::new(Frame::from(&probe), &self.tone, progress)?;
                png::write_mapped(&mut self.out, &self.path, &mapper, png::Depth::Eight, progress)?;
            }
        }
        self.out.flush().map_err(failed)?;
        Ok(self.pending)
    }
}
