//! Tables of 1 nm means, and the reader of the tables that are embedded from `data/`.
//!
//! A spectrum with fine structure (the Sun's lines, ozone's bands) must be integrated, not sampled. [`BinnedSpectrum`] holds
//! means over 1 nm bins centred on whole nanometres, so that any band mean conserves energy.

/// Means of a spectral quantity over consecutive bins of 1 nm, each centred on a whole nanometre.
#[derive(Clone, Debug, PartialEq)]
pub struct BinnedSpectrum {
    first_nm: f64,
    values: Vec<f64>,
    /// Integral from the low edge of the first bin to the low edge of each bin, and to the end.
    integral: Vec<f64>,
}

impl BinnedSpectrum {
    /// Means `values`, the first for the bin centred on `first_nm` [nm]. There must be at least one.
    pub fn new(first_nm: u32, values: Vec<f64>) -> Self {
        let mut integral = Vec::with_capacity(values.len() + 1);
        integral.push(0.0);
        for &value in &values {
            integral.push(integral[integral.len() - 1] + value);
        }
        Self { first_nm: f64::from(first_nm), values, integral }
    }

    /// Low and high edge of what the table covers [nm].
    pub fn range_nm(&self) -> (f64, f64) {
        (self.first_nm - 0.5, self.first_nm - 0.5 + self.values.len() as f64)
    }

    /// Integral from `low_nm` to `high_nm`; the quantity is zero outside the table. Unit: that of the table times nm.
    pub fn integral(&self, low_nm: f64, high_nm: f64) -> f64 {
        self.integral_to(high_nm) - self.integral_to(low_nm)
    }

    /// Mean over the part of the band of `width_nm` around `centre_nm` that the table covers; 0 where it covers none of it.
    pub fn mean(&self, centre_nm: f64, width_nm: f64) -> f64 {
        let (start, end) = self.range_nm();
        let low = (centre_nm - 0.5 * width_nm).max(start);
        let high = (centre_nm + 0.5 * width_nm).min(end);
        if high > low { self.integral(low, high) / (high - low) } else { 0.0 }
    }

    fn integral_to(&self, wavelength_nm: f64) -> f64 {
        let position = (wavelength_nm - self.range_nm().0).clamp(0.0, self.values.len() as f64);
        let bin = (position as usize).min(self.values.len() - 1);
        self.integral[bin] + (position - bin as f64) * self.values[bin]
    }
}

/// Columns of an embedded table: lines that start with `#` are comments, the first other line names the columns, the rest are
/// numbers separated by commas.
pub(crate) fn columns<const N: usize>(table: &str) -> [Vec<f64>; N] {
    let mut columns = std::array::from_fn(|_| Vec::new());
    for line in table.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let mut cells = line.split(',');
        for column in &mut columns {
            let cell = cells.next().and_then(|cell| cell.trim().parse().ok());
            column.push(cell.expect("an embedded table has a number in each cell"));
        }
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn band_means_conserve_energy() {
        let spectrum = BinnedSpectrum::new(400, vec![1.0, 4.0, 2.0, 8.0]);
        let whole = spectrum.integral(300.0, 500.0);
        assert!((whole - 15.0).abs() < 1e-12);
        let parts: f64 = (0..8).map(|i| spectrum.mean(399.75 + 0.5 * f64::from(i), 0.5) * 0.5).sum();
        assert!((parts - whole).abs() < 1e-12);
        assert!((spectrum.mean(401.0, 1.0) - 4.0).abs() < 1e-12);
        assert!((spectrum.mean(401.5, 1.0) - 3.0).abs() < 1e-12);
        assert_eq!(spectrum.mean(500.0, 10.0), 0.0);
    }

    #[test]
    fn comments_and_names_are_skipped() {
        let [wavelengths, values] = columns("# a comment\nx,y\n1,2\n3,4e-1\n");
        assert_eq!((wavelengths, values), (vec![1.0, 3.0], vec![2.0, 0.4]));
    }
}
