//! Whether a value is what its row allows.

use super::{Kind, Parameter};
use crate::error::{Error, Result, check_range};
use crate::words::Words;

/// A type whose values a row can judge.
pub(crate) trait Checked {
    /// # Errors
    /// [`Error::Input`] that names the parameter `name`, the value and the range of `row`.
    fn check(&self, row: &Parameter, name: &str) -> Result<()>;

    /// This value, or `usual` where nothing was given.
    fn or_usual(self, _usual: Self) -> Self
    where
        Self: Sized,
    {
        self
    }
}

impl Checked for f64 {
    fn check(&self, row: &Parameter, name: &str) -> Result<()> {
        match row.kind {
            Kind::Number { low, high } | Kind::WordsOrNumber { low, high, .. } | Kind::Factors { low, high, .. } => {
                check_range(name, *self, low, high, row.unit).map(|_| ())
            }
            _ => Ok(()),
        }
    }
}

macro_rules! whole {
    ($($type:ty),+) => {$(
        impl Checked for $type {
            fn check(&self, row: &Parameter, name: &str) -> Result<()> {
                let Kind::Whole { low, high } = row.kind else { return Ok(()) };
                if u32::try_from(*self).is_ok_and(|value| (low..=high).contains(&value)) {
                    return Ok(());
                }
                let space = if row.unit.is_empty() { "" } else { " " };
                Err(Error::input(name, self, format!("a whole number from {low} to {high}{space}{}", row.unit)))
            }
        }
    )+};
}

whole!(u8, usize, i64);

impl<T: Checked> Checked for Option<T> {
    fn check(&self, row: &Parameter, name: &str) -> Result<()> {
        self.as_ref().map_or(Ok(()), |value| value.check(row, name))
    }

    fn or_usual(self, usual: Self) -> Self {
        self.or(usual)
    }
}

impl Checked for [f64; 2] {
    fn check(&self, row: &Parameter, name: &str) -> Result<()> {
        if row.kind == Kind::Direction {
            check_range(&format!("{name} altitude"), self[0], -90.0, 90.0, "degrees")?;
            check_range(&format!("{name} azimuth"), self[1], -360.0, 360.0, "degrees")?;
        }
        Ok(())
    }
}

impl Checked for bool {
    fn check(&self, _: &Parameter, _: &str) -> Result<()> {
        Ok(())
    }
}

// A word that was read is one of the list.
impl<T: Words> Checked for T {
    fn check(&self, _: &Parameter, _: &str) -> Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::row;
    use super::*;

    #[test]
    fn values_out_of_range_are_named_with_the_range() {
        let message = |outcome: Result<()>| outcome.unwrap_err().to_string();
        let ozone = row::number(0.0, 1000.0, "Dobson units");
        assert!(300.0.check(&ozone, "ozone_du").is_ok() && None::<f64>.check(&ozone, "ozone_du").is_ok());
        assert_eq!(
            message(Some(2000.0).check(&ozone, "ozone_du")),
            "ozone_du = 2000: must be a number from 0 to 1000 Dobson units"
        );
        assert!(message(f64::NAN.check(&ozone, "ozone_du")).starts_with("ozone_du = NaN"));
        let width = row::whole(64, 16384, "pixels");
        assert!(64_usize.check(&width, "width").is_ok() && 16384_usize.check(&width, "width").is_ok());
        assert_eq!(
            message(usize::MAX.check(&width, "w")),
            format!("w = {}: must be a whole number from 64 to 16384 pixels", usize::MAX)
        );
        assert_eq!(message(0_u8.check(&row::whole(1, 9, ""), "bortle")), "bortle = 0: must be a whole number from 1 to 9");
    }
}
