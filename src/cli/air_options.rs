//! Options that describe the air, shared by the commands.

use crate::error::Result;
use crate::scene::Scene;
use clap::Args;

const AIR: &str = "Air";
const MORE_AIR: &str = "Air, in detail";

/// The state of the air. Each option overrides the value of the preset.
#[derive(Args)]
pub struct AirOptions {
    /// Where to start from: clear, pure, hazy, polluted, urban, maritime, desert, antarctic, fog, volcanic or thesis. Default: clear.
    ///
    /// A preset fills in what is left out: the kind and amount of aerosol, the ground, ozone and temperature.
    #[arg(long, value_name = "NAME", help_heading = AIR)]
    preset: Option<String>,
    /// Kind of haze: none, continental_clean, continental_average, continental_polluted, urban, maritime_clean, maritime_polluted,
    /// maritime_tropical, desert, arctic, antarctic, fog or thesis. Default: the preset's.
    #[arg(long, value_name = "NAME", help_heading = AIR)]
    aerosol: Option<String>,
    /// Amount of haze as its vertical optical depth at 550 nm, 0 to 50. Clear is 0.1, murky 0.5, fog 2 and more.
    #[arg(long, value_name = "TAU", help_heading = AIR, group = "amount")]
    aod550: Option<f64>,
    /// Amount of haze as turbidity, 1 (pure air) to 64 (light fog). Clear is 2, hazy 4 to 6.
    #[arg(long, value_name = "T", help_heading = AIR, group = "amount")]
    turbidity: Option<f64>,
    /// Amount of haze as horizontal visibility at the ground, from 0.05 [km].
    #[arg(long, value_name = "KM", help_heading = AIR, group = "amount")]
    visibility: Option<f64>,
    /// Ozone column, 0 to 1000 [Dobson units]. It makes the twilight blue. Default: the preset's, mostly 300.
    #[arg(long, value_name = "DU", help_heading = AIR)]
    ozone: Option<f64>,
    /// Ground: grass, forest, soil, desert, snow, sea, city, asphalt, or one albedo from 0 to 1. Default: the preset's.
    #[arg(long, value_name = "NAME|ALBEDO", help_heading = AIR)]
    ground: Option<String>,
    /// How finely the light is solved: draft, standard, high or reference. Default: standard.
    #[arg(long, value_name = "NAME", help_heading = AIR)]
    quality: Option<String>,
    /// Solve light as a scalar, which is wrong by several per cent: only to compare with scalar codes.
    #[arg(long, help_heading = MORE_AIR, hide_short_help = true)]
    no_polarisation: bool,
    /// Optical depth at 550 nm of a volcanic haze in the stratosphere, 0 to 1. Default: the preset's, mostly 0.
    #[arg(long, value_name = "TAU", help_heading = MORE_AIR, hide_short_help = true)]
    stratospheric_aod550: Option<f64>,
    /// Altitude of the middle of the volcanic haze, 12 to 40 [km]. Default: 20.
    #[arg(long, value_name = "KM", help_heading = MORE_AIR, hide_short_help = true)]
    stratospheric_altitude: Option<f64>,
    /// Relative humidity, 0 to 99 [%]: the haze's particles grow with it. Default: 80.
    #[arg(long, value_name = "PERCENT", help_heading = MORE_AIR, hide_short_help = true)]
    relative_humidity: Option<f64>,
    /// How the haze scatters: mie, henyey_greenstein or cornette_shanks. Default: mie, unless an asymmetry is given.
    #[arg(long, value_name = "NAME", help_heading = MORE_AIR, hide_short_help = true)]
    phase_function: Option<String>,
    /// Spectral slope of the haze's extinction, -1 to 4. Default: the aerosol's own spectrum.
    #[arg(long, value_name = "ALPHA", help_heading = MORE_AIR, hide_short_help = true)]
    angstrom_exponent: Option<f64>,
    /// Share of the haze's extinction that is scattering, 0 to 1. Default: the aerosol's own spectrum.
    #[arg(long, value_name = "SHARE", help_heading = MORE_AIR, hide_short_help = true)]
    single_scattering_albedo: Option<f64>,
    /// How much the haze scatters forward, -0.99 to 0.99, by the function of Henyey and Greenstein. Default: the aerosol's.
    #[arg(long, value_name = "G", help_heading = MORE_AIR, hide_short_help = true)]
    asymmetry: Option<f64>,
    /// Height in which the haze thins out to 1/e, or depth of a layer of fog, 0.1 to 20 [km]. Default: the aerosol's.
    #[arg(long, value_name = "KM", help_heading = MORE_AIR, hide_short_help = true)]
    aerosol_scale_height: Option<f64>,
    /// Profile of temperature and density, such as us_standard_1976 or tropical. Default: the preset's.
    #[arg(long, value_name = "NAME", help_heading = MORE_AIR, hide_short_help = true)]
    standard_atmosphere: Option<String>,
    /// Pressure at the ground, 100 to 1100 [hPa]. Default: that of the standard atmosphere.
    #[arg(long, value_name = "HPA", help_heading = MORE_AIR, hide_short_help = true)]
    surface_pressure: Option<f64>,
}

impl AirOptions {
    /// Writes what was given over `config`.
    pub fn apply(&self, config: &mut Scene) -> Result<()> {
        let air = &mut config.atmosphere.air;
        if let Some(name) = &self.preset {
            air.preset = name.parse()?;
        }
        if let Some(name) = &self.aerosol {
            air.aerosol = Some(name.parse()?);
        }
        if self.aod550.or(self.turbidity).or(self.visibility).is_some() {
            (air.aod550, air.turbidity, air.visibility_km) = (self.aod550, self.turbidity, self.visibility);
        }
        if let Some(ground) = &self.ground {
            air.ground = Some(ground.parse()?);
        }
        if let Some(name) = &self.phase_function {
            air.phase_function = Some(name.parse()?);
        }
        if let Some(name) = &self.standard_atmosphere {
            air.standard_atmosphere = Some(name.parse()?);
        }
        air.ozone_du = self.ozone.or(air.ozone_du);
        air.relative_humidity = self.relative_humidity.or(air.relative_humidity);
        air.stratospheric_aod550 = self.stratospheric_aod550.or(air.stratospheric_aod550);
        air.stratospheric_altitude_km = self.stratospheric_altitude.or(air.stratospheric_altitude_km);
        air.angstrom_exponent = self.angstrom_exponent.or(air.angstrom_exponent);
        air.single_scattering_albedo = self.single_scattering_albedo.or(air.single_scattering_albedo);
        air.asymmetry = self.asymmetry.or(air.asymmetry);
        air.aerosol_scale_height_km = self.aerosol_scale_height.or(air.aerosol_scale_height_km);
        air.surface_pressure_hpa = self.surface_pressure.or(air.surface_pressure_hpa);
        if let Some(name) = &self.quality {
            config.atmosphere.quality = name.parse()?;
        }
        config.atmosphere.polarisation &= !self.no_polarisation;
        Ok(())
    }
}
