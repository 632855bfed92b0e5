//! What of the night is shown, and how bright what varies is.

use crate::celestial::{Airglow, Lamps, LightPollution, bortle_zenith_brightness};
use crate::error::{Error, Result};
use crate::parameter::parameters;
use crate::words::{Words, words};
use serde::{Deserialize, Serialize};

/// When the lights of the night are part of a sky.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum When {
    /// Moon and planets always; moonlight in the air, stars and diffuse light with the Sun below the horizon or totally eclipsed, where they are more than a thousandth of the light.
    #[default]
    Auto,
    /// All of them always.
    Always,
    /// None.
    Never,
}

words!(When, "night.when", { Auto => "auto", Always => "always", Never => "never" });

parameters! {
    /// The night: what no place and time say of it.
    #[derive(Copy)]
    pub struct NightOptions in "night", named "night." in messages {
        /// When Moon, stars and the other lights of the night are in the sky.
        when: When = When::Auto => words(When::WORDS).default("\"auto\"").option("night", "WHEN")
            .more("auto: Moon and planets always, all else while the Sun's centre is below the horizon or the Sun totally eclipsed; by day it is less than a \
                   thousandth of the light. A Sun that is put has no night.");
        /// Stars to this magnitude are drawn one by one.
        star_limit: f64 = 8.5 => number(-2.0, 8.5, "V").default("8.5").option("star-limit", "V")
            .more("The light of fainter ones is part of the Milky Way.");
        /// Solar radio flux at 10.7 cm, on which the airglow depends.
        solar_flux_sfu: f64 = Airglow::MEAN_SOLAR_FLUX_SFU => number(60.0, 300.0, "solar flux units").default("130.0").option("solar-flux", "SFU")
            .more("70 at the Sun's minimum, 130 on average, 200 at its maximum.");
        /// Brightness of the moonless zenith over a lit country, natural light (22.0) included.
        #[serde(skip_serializing_if = "Option::is_none")]
        zenith_brightness: Option<f64> = None => number(15.0, 22.0, "mag arcsec-2").by("no artificial light").option("zenith-brightness", "MAG").group("towns");
        /// The same as a class of light pollution on Bortle's scale: 1 is as dark as it gets, 9 an inner city.
        #[serde(skip_serializing_if = "Option::is_none")]
        bortle: Option<u8> = None => whole(1, 9, "").by("no artificial light").option("bortle", "CLASS").group("towns");
        /// Share of the artificial light that comes from white LEDs; the rest is that of sodium lamps.
        led_share: f64 = 0.5 => number(0.0, 1.0, "").default("0.5").option("led-share", "SHARE");
    }
}

impl NightOptions {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`Error::Input`] that names the one out of range, or both of two that exclude each other.
    pub fn validate(&self) -> Result<()> {
        self.check_ranges()?;
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
            (Some(zenith), _) => zenith,
            (None, Some(class)) => bortle_zenith_brightness(class)?,
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
