//! What a user says about the air, the same keys in Rust, Python, JSON and on the command line, and what follows from it.
//!
//! The amount of aerosol can be said in three ways, tau being vertical optical depths at 550 nm above the ground:
//!
//! - `aod550`: tau_aerosol itself;
//! - `turbidity` T = (tau_aerosol + tau_molecules) / tau_molecules (thesis, section 5.1; 1 is pure air, 64 light fog);
//! - `visibility_km` V = 3.912 / (beta_aerosol + beta_molecules) with the extinction beta [km-1] at the ground
//!   (Koschmieder 1924, contrast threshold 2 %).
//!
//! All three mean the aerosol near the ground; that of the stratosphere is said by itself and comes on top.

use super::aerosol::AerosolType;
use super::air::Air;
use super::ground::{Ground, Surface};
use super::molecules;
use super::optical_profile::OpticalProfile;
use super::phase_function::PhaseFunction;
use super::preset::{Amount, Preset};
use super::profile;
use super::standard_atmosphere::StandardAtmosphere;
use crate::error::{Error, Result, check_range};
use crate::parameter::parameters;
use crate::words::Words;

/// -ln 0.02: how many optical depths away a black object vanishes against the horizon.
const KOSCHMIEDER: f64 = 3.912;

/// Shortest visibility that is accepted [km].
const SHORTEST_VISIBILITY_KM: f64 = 0.05;

/// Largest vertical optical depth of the aerosol that is accepted.
const LARGEST_AOD550: f64 = 50.0;

parameters! {
    /// The state of the air as the user gives it. Everything but the preset may be left out: the preset fills it in.
    pub struct AirParameters in "atmosphere", named "" in messages {
        /// Where to start from.
        preset: Preset = Preset::default() => words(Preset::WORDS).default("\"clear\"").option("preset", "NAME")
            .more("A preset fills in what is left out: the kind and amount of aerosol, the ground, ozone and temperature.");
        /// Kind of aerosol.
        #[serde(skip_serializing_if = "Option::is_none")]
        aerosol: Option<AerosolType> = None => words(AerosolType::WORDS).by("the preset's").option("aerosol", "NAME");
        /// Amount of aerosol as its vertical optical depth at 550 nm.
        #[serde(skip_serializing_if = "Option::is_none")]
        aod550: Option<f64> = None => number(0.0, LARGEST_AOD550, "").by("the preset's").option("aod550", "TAU").group("amount")
            .more("Clear is 0.1, murky 0.5, fog 2 and more.");
        /// Amount of aerosol as turbidity: the optical depth of aerosol and molecules over that of the molecules at 550 nm.
        #[serde(skip_serializing_if = "Option::is_none")]
        turbidity: Option<f64> = None => number(1.0, 64.0, "").by("the preset's").option("turbidity", "T").group("amount")
            .more("Pure air is 1, clear 2, hazy 4 to 6, light fog 64.");
        /// Amount of aerosol as horizontal visibility at the ground.
        #[serde(skip_serializing_if = "Option::is_none")]
        visibility_km: Option<f64> = None => number(SHORTEST_VISIBILITY_KM, 4000.0, "km").by("the preset's").option("visibility", "KM").group("amount")
            .more("At most that of pure air, about 340 km at the sea; the optical depth must not exceed 50.");
        /// Ozone column.
        #[serde(skip_serializing_if = "Option::is_none")]
        ozone_du: Option<f64> = None => number(0.0, 1000.0, "Dobson units").by("the preset's, mostly 300").option("ozone", "DU")
            .more("It makes the twilight blue.");
        /// The ground by name, or its albedo.
        #[serde(skip_serializing_if = "Option::is_none")]
        ground: Option<Ground> = None => words_or_number(Surface::WORDS, 0.0, 1.0).by("the preset's").option("ground", "NAME|ALBEDO");
        /// Optical depth at 550 nm of volcanic haze in the stratosphere.
        #[serde(skip_serializing_if = "Option::is_none")]
        stratospheric_aod550: Option<f64> = None => number(0.0, 1.0, "").by("the preset's, mostly 0").option("stratospheric-aod550", "TAU").detail()
            .more("Droplets of sulphuric acid, as after a great eruption; they come on top of the aerosol near the ground.");
        /// Altitude of the middle of the volcanic haze.
        #[serde(skip_serializing_if = "Option::is_none")]
        stratospheric_altitude_km: Option<f64> = None => number(12.0, 40.0, "km").by("20").option("stratospheric-altitude", "KM").detail();
        /// Relative humidity, with which the particles grow.
        #[serde(skip_serializing_if = "Option::is_none")]
        relative_humidity: Option<f64> = None => number(0.0, 99.0, "%").by("80").option("relative-humidity", "PERCENT").detail()
            .more("Amounts are those of the grown particles.");
        /// How the aerosol scatters.
        #[serde(skip_serializing_if = "Option::is_none")]
        phase_function: Option<PhaseFunction> = None => words(PhaseFunction::WORDS).option("phase-function", "NAME").detail()
            .by("mie; henyey_greenstein if an asymmetry is given or the aerosol is not made of particles");
        /// Spectral slope of the aerosol's extinction, which becomes (wavelength / 550 nm)^-exponent.
        #[serde(skip_serializing_if = "Option::is_none")]
        angstrom_exponent: Option<f64> = None => number(-1.0, 4.0, "").by("the aerosol's own spectrum").option("angstrom-exponent", "ALPHA").detail();
        /// Share of the aerosol's extinction that is scattering, at all wavelengths.
        #[serde(skip_serializing_if = "Option::is_none")]
        single_scattering_albedo: Option<f64> = None => number(0.0, 1.0, "").by("the aerosol's own spectrum").option("single-scattering-albedo", "SHARE").detail();
        /// Asymmetry parameter: how much the aerosol scatters forward, by the function of Henyey and Greenstein.
        #[serde(skip_serializing_if = "Option::is_none")]
        asymmetry: Option<f64> = None => number(-0.99, 0.99, "").by("the aerosol's").option("asymmetry", "G").detail();
        /// Height in which the aerosol thins out to 1/e, or depth of a layer of fog.
        #[serde(skip_serializing_if = "Option::is_none")]
        aerosol_scale_height_km: Option<f64> = None => number(0.1, 20.0, "km").by("the aerosol's").option("aerosol-scale-height", "KM").detail();
        /// Profile of temperature and density, and shape of the ozone profile.
        #[serde(skip_serializing_if = "Option::is_none")]
        standard_atmosphere: Option<StandardAtmosphere> = None => words(StandardAtmosphere::WORDS).by("the preset's").option("standard-atmosphere", "NAME").detail();
        /// Pressure at the ground, which scales the molecules at all altitudes.
        #[serde(skip_serializing_if = "Option::is_none")]
        surface_pressure_hpa: Option<f64> = None => number(100.0, 1100.0, "hPa").by("that of the standard atmosphere").option("surface-pressure", "HPA").detail();
    }
}

impl AirParameters {
    /// Checks every value that is given.
    ///
    /// # Errors
    /// [`Error::Input`] that names the first parameter that cannot be used.
    pub fn validate(&self) -> Result<()> {
        self.resolve().map(|_| ())
    }

    /// Fills in the preset and expresses the amount of aerosol in all three ways.
    ///
    /// # Errors
    /// [`Error::Input`] that names the first parameter that cannot be used.
    pub fn resolve(&self) -> Result<Air> {
        self.check_ranges()?;

        let defaults = self.preset.defaults();
        let standard_atmosphere = self.standard_atmosphere.unwrap_or(defaults.standard_atmosphere);
        let standard_pressure_hpa = standard_atmosphere.pressure_pa(0.0) / 100.0;
        let surface_pressure_hpa = self.surface_pressure_hpa.unwrap_or(standard_pressure_hpa);
        let aerosol = self.aerosol.unwrap_or(defaults.aerosol);
        let scale_height = self.aerosol_scale_height_km.unwrap_or(aerosol.scale_height_km());

        let pressure_ratio = surface_pressure_hpa / standard_pressure_hpa;
        let cross_section = molecules::cross_section_m2(550.0) * pressure_ratio;
        let molecules_depth = cross_section * profile::air_column_per_m2(standard_atmosphere);
        let molecules_per_km = cross_section * standard_atmosphere.number_density_per_m3(0.0) * 1000.0;
        let aod550 = match self.amount(molecules_per_km)? {
            None if aerosol == AerosolType::None => 0.0,
            given => {
                let depth = match given.unwrap_or(defaults.amount) {
                    Amount::OpticalDepth(depth) => depth,
                    Amount::Turbidity(turbidity) => (turbidity - 1.0) * molecules_depth,
                    Amount::VisibilityKm(visibility) => (KOSCHMIEDER / visibility - molecules_per_km).max(0.0) * scale_height,
                };
                if aerosol == AerosolType::None && depth > 1e-12 {
                    let kinds: Vec<&str> = AerosolType::ALL[1..].iter().map(|kind| kind.name()).collect();
                    let allowed = format!("one of {} when an amount of aerosol is given", kinds.join(", "));
                    return Err(Error::input("aerosol", "\"none\"", allowed));
                }
                if let (Some(visibility), true) = (self.visibility_km, depth > LARGEST_AOD550) {
                    let shortest = KOSCHMIEDER / (molecules_per_km + LARGEST_AOD550 / scale_height);
                    let allowed = format!("{shortest:.3} km or more in haze with a scale height of {scale_height} km");
                    return Err(Error::input("visibility_km", visibility, allowed));
                }
                depth
            }
        };
        let phase_function = self.resolved_phase_function(aerosol)?;
        let relative_humidity = self.relative_humidity.unwrap_or(80.0);
        Ok(Air {
            aerosol,
            relative_humidity,
            aod550,
            turbidity: 1.0 + aod550 / molecules_depth,
            visibility_km: KOSCHMIEDER / (molecules_per_km + aod550 / scale_height),
            angstrom_exponent: self.angstrom_exponent,
            single_scattering_albedo: self.single_scattering_albedo,
            asymmetry: self.asymmetry.unwrap_or_else(|| aerosol.spectrum(relative_humidity).at(550.0).asymmetry),
            phase_function,
            aerosol_scale_height_km: scale_height,
            stratospheric_aod550: self.stratospheric_aod550.unwrap_or(defaults.stratospheric_aod550),
            stratospheric_altitude_km: self.stratospheric_altitude_km.unwrap_or(20.0),
            ozone_du: self.ozone_du.unwrap_or(defaults.ozone_du),
            standard_atmosphere,
            surface_pressure_hpa,
            ground: self.ground.unwrap_or(Ground::Surface(defaults.ground)),
        })
    }

    /// The optical properties of this air at `wavelengths_nm` (ascending, 300 to 1000 nm), up to [`profile::TOP_KM`].
    ///
    /// # Errors
    /// [`Error::Input`] that names the first parameter that cannot be used.
    pub fn optical_profile(&self, wavelengths_nm: &[f64]) -> Result<OpticalProfile> {
        profile::optical_profile(&self.resolve()?, wavelengths_nm)
    }

    fn resolved_phase_function(&self, aerosol: AerosolType) -> Result<PhaseFunction> {
        let has_mie = self.asymmetry.is_none() && aerosol.is_made_of_particles();
        match self.phase_function {
            Some(PhaseFunction::Mie) if !has_mie => {
                let why = if self.asymmetry.is_some() {
                    "when asymmetry is given".to_string()
                } else {
                    format!("for the aerosol {:?}, which is not made of particles", aerosol.name())
                };
                Err(Error::input("phase_function", "\"mie\"", format!("henyey_greenstein or cornette_shanks {why}")))
            }
            Some(given) => Ok(given),
            None => Ok(if has_mie { PhaseFunction::Mie } else { PhaseFunction::HenyeyGreenstein }),
        }
    }

    /// The amount of aerosol that is given, if one is. `molecules_per_km` is the molecules' extinction at the ground.
    fn amount(&self, molecules_per_km: f64) -> Result<Option<Amount>> {
        let given = [("aod550", self.aod550), ("turbidity", self.turbidity), ("visibility_km", self.visibility_km)];
        let mut names = given.iter().filter_map(|&(name, value)| value.map(|value| (name, value)));
        if let (Some((first, _)), Some((second, value))) = (names.next(), names.next()) {
            let allowed = format!(
                "left out when {first} is given: one of aod550, turbidity and visibility_km says how much aerosol there is"
            );
            return Err(Error::input(second, value, allowed));
        }
        if let Some(visibility) = self.visibility_km {
            let pure = (KOSCHMIEDER / molecules_per_km * 10.0).floor() / 10.0;
            check_range("visibility_km", visibility, SHORTEST_VISIBILITY_KM, pure, "km (that of pure air)")?;
            return Ok(Some(Amount::VisibilityKm(visibility)));
        }
        Ok(self.aod550.map(Amount::OpticalDepth).or(self.turbidity.map(Amount::Turbidity)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolve(json: &str) -> Result<Air> {
        serde_json::from_str::<AirParameters>(json).expect("valid JSON").resolve()
    }

    #[test]
    fn three_ways_to_say_how_much_aerosol_agree() {
        let by_depth = resolve(r#"{"aod550": 0.23, "aerosol": "urban"}"#).unwrap();
        assert!((by_depth.aod550 - 0.23).abs() < 1e-15);
        let turbidity = format!(r#"{{"turbidity": {}, "aerosol": "urban"}}"#, by_depth.turbidity);
        let visibility = format!(r#"{{"visibility_km": {}, "aerosol": "urban"}}"#, by_depth.visibility_km);
        for json in [turbidity, visibility] {
            assert!((resolve(&json).unwrap().aod550 - 0.23).abs() < 1e-12, "{json}");
        }
        // tau_molecules = 0.0972, so turbidity 2 is an aerosol of the same optical depth.
        assert!((resolve(r#"{"turbidity": 2}"#).unwrap().aod550 - 0.0972).abs() < 3e-4);
        assert!(resolve(r#"{"turbidity": 1}"#).unwrap().aod550 < 1e-15);
    }

    #[test]
    fn pure_air_has_the_longest_visibility() {
        let pure = resolve(r#"{"preset": "pure"}"#).unwrap();
        // checked against: 3.912 / (4.5102e-27 cm2 x 2.5469e19 cm-3) = 340.6 km
        assert!((pure.visibility_km - 340.6).abs() < 0.3, "{}", pure.visibility_km);
        assert_eq!((pure.aod550, pure.turbidity), (0.0, 1.0));
    }

    #[test]
    fn a_preset_fills_only_what_is_left_out() {
        let air = resolve(r#"{"preset": "maritime", "ground": 0.3, "ozone_du": 250}"#).unwrap();
        assert_eq!((air.aerosol, air.aod550), (AerosolType::MaritimeClean, 0.1));
        assert_eq!((air.ground, air.ozone_du), (Ground::Albedo(0.3), 250.0));
        assert_eq!(resolve(r#"{"preset": "clear", "aerosol": "none"}"#).unwrap().aod550, 0.0);
        assert_eq!(resolve(r#"{"aerosol": "rural"}"#).unwrap().aerosol, AerosolType::ContinentalClean);
        assert!((resolve(r#"{"preset": "thesis"}"#).unwrap().turbidity - 2.0).abs() < 1e-12);
    }

    #[test]
    fn the_phase_function_follows_from_what_is_given() {
        for (json, expected) in [
            ("{}", PhaseFunction::Mie),
            (r#"{"asymmetry": 0.7}"#, PhaseFunction::HenyeyGreenstein),
            (r#"{"asymmetry": 0.7, "phase_function": "cornette_shanks"}"#, PhaseFunction::CornetteShanks),
            (r#"{"phase_function": "henyey_greenstein"}"#, PhaseFunction::HenyeyGreenstein),
            (r#"{"preset": "thesis"}"#, PhaseFunction::HenyeyGreenstein),
            (r#"{"preset": "pure"}"#, PhaseFunction::HenyeyGreenstein),
        ] {
            assert_eq!(resolve(json).unwrap().phase_function, expected, "{json}");
        }
        assert!(resolve(r#"{"relative_humidity": 98}"#).unwrap().asymmetry > resolve("{}").unwrap().asymmetry + 0.02);
    }

    #[test]
    fn fog_is_thick_and_the_volcanic_stratosphere_comes_on_top() {
        let fog = resolve(r#"{"preset": "fog", "visibility_km": 0.1}"#).unwrap();
        assert!((fog.aod550 - 39.12 * 0.3).abs() < 0.02, "{}", fog.aod550);
        let volcanic = resolve(r#"{"preset": "volcanic"}"#).unwrap();
        let clear = resolve("{}").unwrap();
        assert_eq!((volcanic.aod550, volcanic.turbidity), (clear.aod550, clear.turbidity));
        assert_eq!((volcanic.stratospheric_aod550, clear.stratospheric_aod550), (0.1, 0.0));
    }

    #[test]
    fn wrong_values_name_the_parameter() {
        for (json, start) in [
            (r#"{"turbidity": -1}"#, "turbidity = -1: must be"),
            (r#"{"aod550": 51}"#, "aod550 = 51: must be"),
            (r#"{"relative_humidity": 100}"#, "relative_humidity = 100: must be a number from 0 to 99 %"),
            (r#"{"visibility_km": 0.1}"#, "visibility_km = 0.1: must be 0.156 km or more in haze with a scale height of 2 km"),
            (r#"{"stratospheric_aod550": 2}"#, "stratospheric_aod550 = 2: must be"),
            (r#"{"stratospheric_altitude_km": 5}"#, "stratospheric_altitude_km = 5: must be"),
            (r#"{"phase_function": "mie", "asymmetry": 0.7}"#, "phase_function = \"mie\": must be henyey_greenstein or"),
            (r#"{"phase_function": "mie", "preset": "thesis"}"#, "phase_function = \"mie\": must be henyey_greenstein or"),
            (r#"{"visibility_km": 400}"#, "visibility_km = 400: must be a number from 0.05 to 340"),
            (r#"{"visibility_km": 0}"#, "visibility_km = 0: must be"),
            (r#"{"aod550": 0.1, "turbidity": 3}"#, "turbidity = 3: must be left out when aod550 is given"),
            (r#"{"ozone_du": 2000}"#, "ozone_du = 2000: must be"),
            (r#"{"asymmetry": 1}"#, "asymmetry = 1: must be"),
            (r#"{"surface_pressure_hpa": 5}"#, "surface_pressure_hpa = 5: must be"),
            (r#"{"preset": "pure", "aod550": 0.2}"#, "aerosol = \"none\": must be one of"),
        ] {
            let message = resolve(json).unwrap_err().to_string();
            assert!(message.starts_with(start), "{json}: {message}");
        }
        let nan = AirParameters { turbidity: Some(f64::NAN), ..AirParameters::default() };
        assert!(nan.validate().unwrap_err().to_string().starts_with("turbidity = NaN"));
    }

    #[test]
    fn json_refuses_unknown_keys_and_words_and_survives_a_round_trip() {
        for (json, part) in [
            (r#"{"turbidty": 3}"#, "turbidty"),
            (r#"{"aerosol": "smoke"}"#, "aerosol = \"smoke\": must be one of none, continental_clean"),
            (r#"{"preset": "nice"}"#, "preset = \"nice\": must be one of clear"),
            (r#"{"standard_atmosphere": "mars"}"#, "standard_atmosphere = \"mars\": must be one of us_standard_1976"),
        ] {
            let message = serde_json::from_str::<AirParameters>(json).unwrap_err().to_string();
            assert!(message.contains(part), "{message}");
        }
        let json = r#"{"preset":"hazy","aerosol":"urban","visibility_km":12.5,"ground":"sea","standard_atmosphere":"tropical"}"#;
        let parameters: AirParameters = serde_json::from_str(json).unwrap();
        assert_eq!(serde_json::to_string(&parameters).unwrap(), json);
    }
}
