//! The layers of a sky's light by name, and factors on them: each can be scaled, left out, or looked at alone.

use crate::error::Result;
use crate::parameter::{Checked, Kind, Parameter};
use crate::words::{Words, words};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A source of light, or several that are of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Layer {
    /// Light of Sun and Moon scattered by the air, and the ground.
    Sky,
    /// The Sun's disc, and at a total eclipse its corona.
    Sun,
    /// The Moon's disc.
    Moon,
    /// The stars, one by one.
    Stars,
    /// The planets.
    Planets,
    /// The light of all other stars, and of what they light.
    MilkyWay,
    /// Sunlight scattered by the dust between the planets.
    Zodiacal,
    /// The glow of the upper air.
    Airglow,
    /// Light from towns, scattered by the air.
    LightPollution,
}

words!(Layer, "layers", {
    Sky => "sky",
    Sun => "sun",
    Moon => "moon",
    Stars => "stars",
    Planets => "planets",
    MilkyWay => "milky_way",
    Zodiacal => "zodiacal",
    Airglow => "airglow",
    LightPollution => "light_pollution",
});

/// The row of the table of parameters.
pub(super) const LAYERS: Parameter = Parameter::new(Kind::Factors { words: Layer::WORDS, low: 0.0, high: 1e9 }, "")
    .named("", "layers", "Factors on the light of layers, 0 to leave one out, as in stars=2")
    .option("layer", "NAME=FACTOR");

/// Factors on the light of layers, 0 (left out) to 1e9; layers that are not named count as they are.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct LayerScales(pub BTreeMap<Layer, f64>);

impl LayerScales {
    /// The factor on `layer`.
    pub fn of(&self, layer: Layer) -> f64 {
        self.0.get(&layer).copied().unwrap_or(1.0)
    }

    /// Checks the factors.
    ///
    /// # Errors
    /// [`Error::Input`] that names the layer.
    pub fn validate(&self) -> Result<()> {
        self.0.iter().try_for_each(|(layer, scale)| scale.check(&LAYERS, &format!("layers.{}", layer.name())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back_and_factors_have_a_range() {
        for layer in Layer::ALL {
            assert_eq!(layer.name().parse::<Layer>().unwrap(), layer);
            assert_eq!(serde_json::to_string(&layer).unwrap(), format!("\"{}\"", layer.name()));
        }
        assert!("comets".parse::<Layer>().is_err());
        let scales = LayerScales([(Layer::Stars, -1.0)].into());
        assert!(scales.validate().unwrap_err().to_string().starts_with("layers.stars = -1: must be"));
        assert_eq!(LayerScales::default().of(Layer::Moon), 1.0);
    }
}
