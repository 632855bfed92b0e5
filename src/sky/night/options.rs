//! What of the night is shown, and how bright what varies is.

use crate::celestial::{Airglow, Lamps, LightPollution, bortle_zenith_brightness};
use crate::error::{Error, Result, check_range};
use serde::{Deserialize, Serialize};

/// When the lights of the night are part of a sky.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum When {
    /// Moon and planets always; moonlight in the air, stars and diffuse light with the Sun below the horizon or totally eclipsed, where they are more than a thousandth of the light.
    #[default]
    Auto,
    /// All of them always.
    Always,
    /// None.
    Never,
}

impl std::str::FromStr for When {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        match text {
            "auto" => Ok(Self::Auto),
            "always" => Ok(Self::Always),
            "never" => Ok(Self::Never),
            _ => Err(Error::input("night.when", format!("{text:?}"), "auto, always or never")),
        }
    }
}

/// The night: what no place and time say of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NightOptions {
    /// When the lights of the night are part of a sky with place and time. A sky with a Sun that was put has no night.
    pub when: When,
    /// Stars to this magnitude V are drawn, -2 to 8.5; fainter ones are part of the Milky Way.
    pub star_limit: f64,
    /// Solar radio flux at 10.7 cm, on which the airglow depends, 60 to 300: 70 at minimum, 130 mean, 200 at maximum [solar flux units].
    pub solar_flux_sfu: f64,
    /// Brightness of the zenith over a lit country, natural light (V 22.0) included, 15 to 22 [mag arcsec-2]; without it there is no artificial light.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zenith_brightness: Option<f64>,
    /// The same as a class of Bortle's scale, 1 (dark) to 9 (inner city).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bortle: Option<u8>,
    /// Share of the artificial light that comes from white LEDs, 0 to 1; the rest from high-pressure sodium lamps.
    pub led_share: f64,
}

impl Default for NightOptions {
    fn default() -> Self {
        Self {
            when: When::Auto,
            star_limit: 8.5,
            solar_flux_sfu: Airglow::MEAN_SOLAR_FLUX_SFU,
            zenith_brightness: None,
            bortle: None,
            led_share: 0.5,
        }
    }
}

impl NightOptions {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`Error::Input`] that names the one out of range, or both of two that exclude each other.
    pub fn validate(&self) -> Result<()> {
        check_range("night.star_limit", self.star_limit, -2.0, 8.5, "")?;
        check_range("night.solar_flux_sfu", self.solar_flux_sfu, 60.0, 300.0, "solar flux units")?;
        check_range("night.led_share", self.led_share, 0.0, 1.0, "")?;
        if self.zenith_brightness.is_some() && self.bortle.is_some() {
            return Err(Error::input("night.bortle", "given", "left out where night.zenith_brightness is given"));
        }
        self.light_pollution().map(|_| ())
    }

    /// The artificial light, if there is any.
    ///
    /// # Errors
    /// [`Error::Input`] for a brightness or a class out of range.
    pub fn light_pollution(&self) -> Result<Option<LightPollution>> {
        let zenith = match (self.zenith_brightness, self.bortle) {
            (Some(zenith), _) => check_range("night.zenith_brightness", zenith, 15.0, 22.0, "mag arcsec-2")?,
            (None, Some(class)) => {
                bortle_zenith_brightness(class).map_err(|_| Error::input("night.bortle", class, "a whole number from 1 to 9"))?
            }
            (None, None) => return Ok(None),
        };
        Ok(Some(LightPollution::new(zenith, Lamps::new(self.led_share)?)?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_out_of_range_are_named() {
        let fail = |options: NightOptions| options.validate().unwrap_err().to_string();
        assert!(fail(NightOptions { star_limit: 9.0, ..Default::default() }).starts_with("night.star_limit = 9: must be"));
        assert!(fail(NightOptions { solar_flux_sfu: f64::NAN, ..Default::default() }).starts_with("night.solar_flux_sfu = NaN"));
        assert!(fail(NightOptions { bortle: Some(0), ..Default::default() }).starts_with("night.bortle = 0"));
        let both = NightOptions { bortle: Some(3), zenith_brightness: Some(20.0), ..Default::default() };
        assert!(fail(both).contains("left out"));
        assert!(NightOptions::default().validate().is_ok() && NightOptions::default().light_pollution().unwrap().is_none());
        assert!(NightOptions { bortle: Some(5), ..Default::default() }.light_pollution().unwrap().is_some());
    }

    #[test]
    fn json_has_the_names_of_the_fields() {
        let options: NightOptions = serde_json::from_str(r#"{"when": "always", "bortle": 4, "star_limit": 6}"#).unwrap();
        assert_eq!((options.when, options.bortle, options.star_limit), (When::Always, Some(4), 6.0));
        assert!(serde_json::from_str::<NightOptions>(r#"{"stars": 6}"#).is_err());
    }
}
