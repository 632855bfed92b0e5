//! Options that say what of the night is in the sky, shared by the commands.

use crate::error::{Error, Result};
use crate::sky::NightOptions;
use clap::Args;

const NIGHT: &str = "Night";

/// The night over a place. A Sun that is put has none.
#[derive(Args)]
pub struct NightCommandOptions {
    /// When Moon, stars and the other lights of the night are in the sky: auto, always or never. Default: auto.
    ///
    /// auto: Moon and planets always, all else while the Sun's centre is below the horizon or the Sun totally eclipsed; by day it is less than a thousandth of the light.
    #[arg(long, value_name = "WHEN", help_heading = NIGHT)]
    night: Option<String>,
    /// Draw stars to this magnitude, -2 to 8.5; the light of fainter ones is part of the Milky Way. Default: 8.5.
    #[arg(long, value_name = "V", help_heading = NIGHT)]
    star_limit: Option<f64>,
    /// Class of light pollution on Bortle's scale, 1 (as dark as it gets) to 9 (inner city). Default: no artificial light.
    #[arg(long, value_name = "CLASS", help_heading = NIGHT, group = "towns")]
    bortle: Option<i64>,
    /// The same as the brightness of the moonless zenith, 15 (city) to 22 (natural) [mag arcsec-2].
    #[arg(long, value_name = "MAG", help_heading = NIGHT, group = "towns")]
    zenith_brightness: Option<f64>,
    /// Share of the artificial light that comes from white LEDs, 0 to 1; the rest is that of sodium lamps. Default: 0.5.
    #[arg(long, value_name = "SHARE", help_heading = NIGHT)]
    led_share: Option<f64>,
    /// Solar radio flux at 10.7 cm, on which the airglow depends, 60 to 300 [solar flux units]: 70 at the Sun's minimum, 200 at its maximum. Default: 130.
    #[arg(long, value_name = "SFU", help_heading = NIGHT)]
    solar_flux: Option<f64>,
}

impl NightCommandOptions {
    /// Writes what was given over `night`.
    pub fn apply(&self, night: &mut NightOptions) -> Result<()> {
        if let Some(when) = &self.night {
            night.when = when.parse()?;
        }
        if self.bortle.is_some() || self.zenith_brightness.is_some() {
            // One takes the other's place.
            (night.bortle, night.zenith_brightness) = (self.bortle.map(class).transpose()?, self.zenith_brightness);
        }
        night.star_limit = self.star_limit.unwrap_or(night.star_limit);
        night.led_share = self.led_share.unwrap_or(night.led_share);
        night.solar_flux_sfu = self.solar_flux.unwrap_or(night.solar_flux_sfu);
        Ok(())
    }
}

fn class(number: i64) -> Result<u8> {
    u8::try_from(number).map_err(|_| Error::input("night.bortle", number, "a whole number from 1 to 9"))
}
