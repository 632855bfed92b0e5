//! A contact sheet: one picture by many operators, side by side, labelled.

use super::display::Display;
use super::frame::Frame;
use super::lettering;
use super::{Operator, OperatorName, ToneMapper, ToneMapping};
use crate::error::{Error, Result};
use crate::progress::Progress;

/// Width of a cell at most [pixels].
const CELL_WIDTH: usize = 640;

/// Grey of the paper and of the letters.
const PAPER: u8 = 24;
const INK: u8 = 220;

/// Margin between cells [pixels].
const MARGIN: usize = 8;

/// Pixels for one pixel of a letter.
const LETTER_SIZE: usize = 2;

/// A sheet of pictures in equal cells, with a line of text under each.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Width [pixels].
    pub width: usize,
    /// Height [pixels].
    pub height: usize,
    /// 8 bits, row-major (height, width, 3).
    pub pixels: Vec<u8>,
    columns: usize,
    cell: (usize, usize),
}

impl Sheet {
    /// An empty sheet for `count` pictures of `cell` (width, height) in `columns`.
    ///
    /// # Errors
    /// [`Error::Input`] without a column.
    pub fn new(count: usize, columns: usize, cell: (usize, usize)) -> Result<Self> {
        if columns == 0 || count == 0 {
            return Err(Error::input("columns", columns, "at least 1, for at least one picture"));
        }
        let columns = columns.min(count);
        let step = Self::step(cell);
        let (width, height) = (MARGIN + columns * step.0, MARGIN + count.div_ceil(columns) * step.1);
        Ok(Self { width, height, pixels: vec![PAPER; 3 * width * height], columns, cell })
    }

    fn step((width, height): (usize, usize)) -> (usize, usize) {
        (width + MARGIN, height + LETTER_SIZE * (lettering::HEIGHT + 2) + MARGIN)
    }

    /// Puts what `mapper` shows into cell `index` with `label` under it: each pixel the mean of the light that falls on it.
    ///
    /// # Panics
    /// If there is no such cell.
    pub fn put(&mut self, index: usize, mapper: &ToneMapper<'_>, display: Display, label: &str) {
        let step = Self::step(self.cell);
        let (x, y) = (MARGIN + index % self.columns * step.0, MARGIN + index / self.columns * step.1);
        let (width, height) = self.cell;
        let (full_width, full_height) = (mapper.width(), mapper.height());
        let bounds = |k: usize, cells: usize, full: usize| {
            let first = k * full / cells;
            (first, ((k + 1) * full / cells).max(first + 1).min(full))
        };
        let rows = super::rows(height, |row| {
            let (first, end) = bounds(row, height, full_height);
            let mut sums = vec![0.0; 3 * width];
            let mut light = vec![0.0; 3 * full_width];
            for full_row in first..end {
                mapper.row(full_row, &mut light);
                for column in 0..width {
                    let (from, to) = bounds(column, width, full_width);
                    let share = 1.0 / ((to - from) * (end - first)) as f32;
                    for pixel in &light.as_chunks::<3>().0[from..to] {
                        (0..3).for_each(|k| sums[3 * column + k] += share * pixel[k]);
                    }
                }
            }
            let mut codes = vec![0; 3 * width];
            display.quantise_8(y + row, &sums, &mut codes);
            codes
        });
        for (row, codes) in rows.iter().enumerate() {
            self.pixels[3 * ((y + row) * self.width + x)..][..3 * width].copy_from_slice(codes);
        }
        let below = (x + LETTER_SIZE, y + height + LETTER_SIZE);
        lettering::write(&mut self.pixels, self.width, below, LETTER_SIZE, INK, label);
    }

    /// `picture` by all operators: `settings` with their own numbers, the other operators with their default ones, all with the exposure of `settings` relative to their own automatic one.
    ///
    /// # Errors
    /// As [`ToneMapper::new`].
    pub fn compare<'a>(picture: impl Into<Frame<'a>>, settings: &ToneMapping, progress: &Progress) -> Result<Self> {
        let frame = picture.into();
        let width = frame.width.min(CELL_WIDTH);
        let height = (width * frame.height / frame.width).max(1);
        let mut sheet = Self::new(OperatorName::ALL.len(), 3, (width, height))?;
        for (index, name) in OperatorName::ALL.into_iter().enumerate() {
            let operator = if settings.operator.name() == name { settings.operator } else { Operator::from(name) };
            let mapper = ToneMapper::new(frame, &ToneMapping { operator, ..*settings }, progress)?;
            sheet.put(index, &mapper, settings.display, &format!("{}  EV {:.1}", name.name(), mapper.ev100()));
            progress.report("compare", (index + 1) as f64 / OperatorName::ALL.len() as f64)?;
        }
        Ok(sheet)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::post::Picture;
    use crate::post::picture::View;
    use crate::spectrum::ColorSpace;

    #[test]
    fn every_operator_has_its_cell_and_its_word() {
        let view = View::Perspective { horizontal_field_of_view_deg: 60.0 };
        let picture = Picture::new(120, 80, vec![0.5; 3 * 120 * 80], ColorSpace::LinRec709, 683.0, view).unwrap();
        let sheet = Sheet::compare(&picture, &ToneMapping::default(), &Progress::silent()).unwrap();
        let step = Sheet::step((120, 80));
        assert_eq!((sheet.width, sheet.height), (8 + 3 * 128, 8 + 3 * step.1));
        for index in 0..9 {
            let (x, y) = (MARGIN + index % 3 * step.0, MARGIN + index / 3 * step.1);
            let at = |dx: usize, dy: usize| sheet.pixels[3 * ((y + dy) * sheet.width + x + dx)];
            assert!(at(60, 40) > 60, "{index}: {}", at(60, 40));
            assert!((0..20).any(|dy| (0..120).any(|dx| at(dx, 80 + dy) == INK)), "{index} has no label");
        }
        assert!(Sheet::new(3, 0, (8, 8)).is_err());
    }

    #[test]
    fn a_small_cell_shows_the_mean() {
        let view = View::Perspective { horizontal_field_of_view_deg: 60.0 };
        // Columns of 0 and 1 in turn: the mean light of a screen is half, whatever the code.
        let pixels = (0..3 * 64 * 8).map(|k| if k / 3 % 2 == 0 { 0.0 } else { 1.0 }).collect();
        let picture = Picture::new(64, 8, pixels, ColorSpace::LinRec709, 683.0, view).unwrap();
        let exposure = super::super::Exposure::Value { ev100: (683f64 / 1.2).log2() };
        let settings = ToneMapping { exposure, ..ToneMapping::with(OperatorName::Linear) };
        let mapper = ToneMapper::new(&picture, &settings, &Progress::silent()).unwrap();
        let mut sheet = Sheet::new(1, 1, (16, 4)).unwrap();
        sheet.put(0, &mapper, Display::Srgb, "");
        let code = sheet.pixels[3 * (10 * sheet.width + 12)];
        // checked against: sRGB of 0.5, 187.5 of 255
        assert!((187..=188).contains(&code), "{code}");
    }
}
