//! By which model, through which filter and how exactly a sky is rendered.

use super::filter::PolarisingFilter;
use super::layers::{LAYERS, LayerScales};
use crate::error::{Error, Result};
use crate::parameter::{Checked, Parameter, row};
use crate::words::{Words, words};
use serde::{Deserialize, Serialize};

/// By which model a sky is rendered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Model {
    /// Multiple scattering of light in the air, solved: day, twilight and night.
    #[default]
    Scattering,
    /// The analytic sky of [`Preetham`](crate::sky::Preetham), Shirley & Smits 1999: by day, at turbidities from 2 to 10.
    Preetham,
    /// The thesis's ray marching with random steps, light scattered once and twice ([`Thesis`](crate::light::Thesis)): slow and noisy, for small probes.
    Thesis,
    /// The same, light scattered once only.
    ThesisSingle,
}

words!(Model, "model", {
    Scattering => "scattering",
    Preetham => "preetham",
    Thesis => "thesis",
    ThesisSingle => "thesis_single",
});

/// By which model, through which filter and how exactly a sky is rendered.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightOptions {
    /// The model.
    pub model: Model,
    /// What is held before the sky; for [`Model::Scattering`] of polarised light only.
    pub polarising_filter: Option<PolarisingFilter>,
    /// Relative error that interpolation between gathered directions may have, 0.0001 to 0.5: directions are added until those that were not there before agree.
    /// Without it their number is that of the quality. For [`Model::Scattering`] only.
    pub tolerance: Option<f64>,
    /// Factors on the light of single layers.
    pub layers: LayerScales,
}

/// Checks a tolerance.
pub(in crate::sky) fn check_tolerance(tolerance: f64) -> Result<f64> {
    tolerance.check(&TOLERANCE, TOLERANCE.name)?;
    Ok(tolerance)
}

const TOLERANCE: Parameter = row::number(1e-4, 0.5, "")
    .named("", "tolerance", "Relative error that interpolated directions may have")
    .by("as many directions as the quality says")
    .option("tolerance", "SHARE");

impl LightOptions {
    /// The row of the model in the table of parameters.
    pub const MODEL: &'static [Parameter] = &[row::words(Model::WORDS)
        .named("", "model", "By which model the sky is rendered")
        .default("\"scattering\"")
        .option("model", "NAME")
        .more(
            "scattering: solved light, day, twilight and night. preetham: the analytic sky of 1999, by day at turbidities from 2 to 10. thesis, \
             thesis_single: ray marching with random steps, light scattered at most twice or once: noisy, for small images. Only scattering knows the night.",
        )];

    /// The other rows, but for those of [`PolarisingFilter`].
    pub const PARAMETERS: &'static [Parameter] = &[TOLERANCE, LAYERS];

    /// Checks the numbers, and that the model can do what is asked for.
    ///
    /// # Errors
    /// [`Error::Input`] that names the parameter.
    pub fn validate(&self) -> Result<()> {
        self.layers.validate()?;
        let left_out = || format!("left out for the model {}", self.model.name());
        if let Some(filter) = &self.polarising_filter {
            filter.validate()?;
            if self.model != Model::Scattering {
                return Err(Error::input("polarising_filter", "given", left_out()));
            }
        }
        if let Some(tolerance) = self.tolerance {
            check_tolerance(tolerance)?;
            if self.model != Model::Scattering {
                return Err(Error::input("tolerance", tolerance, left_out()));
            }
        }
        Ok(())
    }
}

impl From<Model> for LightOptions {
    fn from(model: Model) -> Self {
        Self { model, ..Self::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for model in Model::ALL {
            assert_eq!(model.name().parse::<Model>().unwrap(), model);
            assert_eq!(serde_json::to_string(&model).unwrap(), format!("\"{}\"", model.name()));
        }
        assert!("hosek".parse::<Model>().unwrap_err().to_string().starts_with("model = \"hosek\": must be one of scattering"));
    }
}
