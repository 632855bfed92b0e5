//! The operators by name, with their numbers.

use super::{Aces, Ashikhmin, Exponential, Filmic, Linear, Logarithmic, Reinhard, ReinhardLocal, Sky};
use crate::error::{Error, Result, check_range};
use crate::words::words;
use serde::{Deserialize, Serialize};

/// Which operator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum OperatorName {
    /// [`Sky`], made for skies by day and night.
    #[default]
    Sky,
    /// [`Filmic`]: in the manner of AgX.
    Filmic,
    /// [`Aces`], fitted.
    Aces,
    /// [`Exponential`]: 1 - exp(-exposed), the thesis's choice.
    Exposure,
    /// [`Reinhard`] 2002, global.
    Reinhard,
    /// [`ReinhardLocal`]: the same, dodging and burning.
    ReinhardLocal,
    /// [`Ashikhmin`] 2002.
    Ashikhmin,
    /// [`Logarithmic`], clamped.
    Logarithmic,
    /// [`Linear`], clamped.
    Linear,
}

words!(OperatorName, "operator", {
    Sky => "sky",
    Filmic => "filmic",
    Aces => "aces",
    Exposure => "exposure",
    Reinhard => "reinhard",
    ReinhardLocal => "reinhard_local",
    Ashikhmin => "ashikhmin",
    Logarithmic => "logarithmic",
    Linear => "linear",
});

/// An operator with its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub enum Operator {
    Sky(Sky),
    Filmic(Filmic),
    Aces(Aces),
    Exposure(Exponential),
    Reinhard(Reinhard),
    ReinhardLocal(ReinhardLocal),
    Ashikhmin(Ashikhmin),
    Logarithmic(Logarithmic),
    Linear(Linear),
}

impl Default for Operator {
    fn default() -> Self {
        OperatorName::default().into()
    }
}

impl From<OperatorName> for Operator {
    /// The operator with its default numbers.
    fn from(name: OperatorName) -> Self {
        match name {
            OperatorName::Sky => Self::Sky(Sky::default()),
            OperatorName::Filmic => Self::Filmic(Filmic::default()),
            OperatorName::Aces => Self::Aces(Aces),
            OperatorName::Exposure => Self::Exposure(Exponential),
            OperatorName::Reinhard => Self::Reinhard(Reinhard::default()),
            OperatorName::ReinhardLocal => Self::ReinhardLocal(ReinhardLocal::default()),
            OperatorName::Ashikhmin => Self::Ashikhmin(Ashikhmin::default()),
            OperatorName::Logarithmic => Self::Logarithmic(Logarithmic::default()),
            OperatorName::Linear => Self::Linear(Linear::default()),
        }
    }
}

/// A number of an operator by its name.
#[derive(Debug)]
pub struct Field<'a> {
    /// Its name in Rust, in Python and, with hyphens, on the command line.
    pub name: &'static str,
    /// The number.
    pub value: &'a mut f64,
    /// Least value.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
}

impl<'a> Field<'a> {
    pub(super) fn new(name: &'static str, value: &'a mut f64, low: f64, high: f64) -> Self {
        Self { name, value, low, high }
    }
}

impl Operator {
    /// Which operator it is.
    pub const fn name(&self) -> OperatorName {
        match self {
            Self::Sky(_) => OperatorName::Sky,
            Self::Filmic(_) => OperatorName::Filmic,
            Self::Aces(_) => OperatorName::Aces,
            Self::Exposure(_) => OperatorName::Exposure,
            Self::Reinhard(_) => OperatorName::Reinhard,
            Self::ReinhardLocal(_) => OperatorName::ReinhardLocal,
            Self::Ashikhmin(_) => OperatorName::Ashikhmin,
            Self::Logarithmic(_) => OperatorName::Logarithmic,
            Self::Linear(_) => OperatorName::Linear,
        }
    }

    /// Its numbers, with their ranges.
    pub fn fields(&mut self) -> Vec<Field<'_>> {
        match self {
            Self::Sky(sky) => sky.fields(),
            Self::Filmic(filmic) => filmic.fields(),
            Self::Reinhard(reinhard) => reinhard.fields(),
            Self::ReinhardLocal(reinhard) => reinhard.fields(),
            Self::Ashikhmin(ashikhmin) => ashikhmin.fields(),
            Self::Logarithmic(logarithmic) => logarithmic.fields(),
            Self::Linear(linear) => linear.fields(),
            Self::Aces(_) | Self::Exposure(_) => Vec::new(),
        }
    }

    /// Sets one of its numbers.
    ///
    /// # Errors
    /// [`Error::Input`] for a name that this operator does not have, or a value out of range.
    pub fn set(&mut self, name: &str, value: f64) -> Result<()> {
        let operator = self.name().name();
        let mut fields = self.fields();
        let names: Vec<&str> = fields.iter().map(|field| field.name).collect();
        let allowed = match names.len() {
            0 => format!("left out: the operator {operator} has no numbers of its own"),
            _ => format!("left out: the operator {operator} has {}", names.join(", ")),
        };
        let field = fields.iter_mut().find(|field| field.name == name).ok_or_else(|| Error::input(name, value, allowed))?;
        *field.value = check_range(name, value, field.low, field.high, "")?;
        Ok(())
    }

    /// Checks the ranges of its numbers.
    ///
    /// # Errors
    /// [`Error::Input`] that names the number.
    pub fn validate(&self) -> Result<()> {
        let mut copy = *self;
        copy.fields()
            .into_iter()
            .try_for_each(|field| check_range(field.name, *field.value, field.low, field.high, "").map(|_| ()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operators_are_known_by_name_and_numbers_by_theirs() {
        for name in OperatorName::ALL {
            assert_eq!(name.name().parse::<OperatorName>().unwrap(), name);
            assert_eq!(serde_json::to_string(&name).unwrap(), format!("\"{}\"", name.name()));
            let mut operator = Operator::from(name);
            assert_eq!(operator.name(), name);
            operator.validate().unwrap();
            let fields: Vec<(&str, f64)> = operator.fields().iter().map(|field| (field.name, field.high)).collect();
            for (field, high) in fields {
                operator.set(field, high).unwrap();
                let message = operator.set(field, 2.0 * high + 1.0).unwrap_err().to_string();
                assert!(message.starts_with(&format!("{field} = ")), "{message}");
            }
        }
        let message = Operator::from(OperatorName::Linear).set("threshold", 1.0).unwrap_err().to_string();
        assert_eq!(message, "threshold = 1: must be left out: the operator linear has white");
        assert!("Reinhard".parse::<OperatorName>().unwrap_err().to_string().contains("reinhard_local"));
        assert!(Operator::Linear(Linear { white: f64::NAN }).validate().is_err());
    }
}
