//! The bytes of a file, of which no more are taken than are there.

use crate::error::{Error, Result};
use crate::io::limits;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

/// A file that is read, with its name for messages.
pub struct Source<'a, R> {
    path: &'a Path,
    reader: R,
    at: u64,
    length: u64,
}

impl<'a, R: Read + Seek> Source<'a, R> {
    /// The bytes of `reader`, from the first to the last.
    ///
    /// # Errors
    /// [`Error::File`] for what cannot be sought in, such as a pipe.
    pub fn new(path: &'a Path, mut reader: R) -> Result<Self> {
        let failed = |error: std::io::Error| Error::file(path, error);
        let length = reader.seek(SeekFrom::End(0)).map_err(failed)?;
        reader.seek(SeekFrom::Start(0)).map_err(failed)?;
        Ok(Self { path, reader, at: 0, length })
    }

    /// The name of the file.
    pub fn path(&self) -> &'a Path {
        self.path
    }

    /// Where the next byte stands.
    pub fn at(&self) -> u64 {
        self.at
    }

    /// How many bytes there are.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// How many bytes follow.
    pub fn rest(&self) -> u64 {
        self.length - self.at
    }

    /// The error for content that contradicts the format.
    pub fn damaged(&self, reason: impl std::fmt::Display) -> Error {
        Error::file(self.path, format!("not a sound OpenEXR file ({reason})"))
    }

    /// The error for a sound file of a kind that is not read.
    pub fn unread(&self, what: impl std::fmt::Display) -> Error {
        Error::file(self.path, what)
    }

    fn check(&self, count: u64) -> Result<()> {
        if count > self.rest() { Err(self.damaged("it ends early")) } else { Ok(()) }
    }

    /// The next `N` bytes.
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N]> {
        self.check(N as u64)?;
        let mut bytes = [0; N];
        self.reader.read_exact(&mut bytes).map_err(|error| Error::file(self.path, error))?;
        self.at += N as u64;
        Ok(bytes)
    }

    /// The next number.
    pub fn int(&mut self) -> Result<i32> {
        self.array().map(i32::from_le_bytes)
    }

    /// The next `count` bytes.
    pub fn bytes(&mut self, count: u64) -> Result<Vec<u8>> {
        self.check(count)?;
        let mut bytes = limits::zeros(self.path, count as usize)?;
        self.reader.read_exact(&mut bytes).map_err(|error| Error::file(self.path, error))?;
        self.at += count;
        Ok(bytes)
    }

    /// Bytes up to a zero, at most 255 of them.
    pub fn name(&mut self) -> Result<Vec<u8>> {
        let mut name = Vec::new();
        loop {
            match self.array()? {
                [0] => return Ok(name),
                [byte] if name.len() < 255 => name.push(byte),
                _ => return Err(self.damaged("a name of more than 255 bytes")),
            }
        }
    }

    /// Goes on at `to`.
    pub fn seek(&mut self, to: u64) -> Result<()> {
        if to > self.length {
            return Err(self.damaged("it ends early"));
        }
        // A relative step keeps what is buffered.
        self.reader.seek_relative(to as i64 - self.at as i64).map_err(|error| Error::file(self.path, error))?;
        self.at = to;
        Ok(())
    }

    /// Leaves out `count` bytes.
    pub fn skip(&mut self, count: u64) -> Result<()> {
        self.check(count)?;
        self.seek(self.at + count)
    }
}
