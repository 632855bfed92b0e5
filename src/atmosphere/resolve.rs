//! From what a user says about the air to an air with nothing left open.

use super::aerosol::AerosolType;
use super::air::Air;
use super::molecules;
use super::optical_profile::OpticalProfile;
use super::parameters::{AirParameters, LARGEST_AOD550, SHORTEST_VISIBILITY_KM};
use super::phase_function::PhaseFunction;
use super::profile;
use super::standard_atmosphere::StandardAtmosphere;
use crate::error::{Error, Result, check_range};

/// -ln 0.02: how many optical depths away a black object vanishes against the horizon.
const KOSCHMIEDER: f64 = 3.912;

/// How the amount of aerosol is said.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Amount {
    /// Vertical optical depth of the aerosol at 550 nm.
    OpticalDepth(f64),
    /// Vertical optical depth of aerosol and molecules divided by that of the molecules, at 550 nm.
    Turbidity(f64),
    /// Horizontal visibility at the ground [km].
    VisibilityKm(f64),
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

        let preset = self.preset.parameters();
        let filled = self.clone().or(preset.clone());
        let standard_atmosphere = filled.standard_atmosphere.unwrap_or(StandardAtmosphere::UsStandard1976);
        let standard_pressure_hpa = standard_atmosphere.pressure_pa(0.0) / 100.0;
        let surface_pressure_hpa = filled.surface_pressure_hpa.unwrap_or(standard_pressure_hpa);
        let aerosol = filled.aerosol.unwrap_or(AerosolType::None);
        let scale_height = filled.aerosol_scale_height_km.unwrap_or(aerosol.scale_height_km());

        let pressure_ratio = surface_pressure_hpa / standard_pressure_hpa;
        let cross_section = molecules::cross_section_m2(550.0) * pressure_ratio;
        let molecules_depth = cross_section * profile::air_column_per_m2(standard_atmosphere);
        let molecules_per_km = cross_section * standard_atmosphere.number_density_per_m3(0.0) * 1000.0;
        let aod550 = match self.amount(molecules_per_km)? {
            None if aerosol == AerosolType::None => 0.0,
            given => {
                let depth = match given.or(preset.amount(molecules_per_km)?) {
                    None => 0.0,
                    Some(Amount::OpticalDepth(depth)) => depth,
                    Some(Amount::Turbidity(turbidity)) => (turbidity - 1.0) * molecules_depth,
                    Some(Amount::VisibilityKm(visibility)) => {
                        (KOSCHMIEDER / visibility - molecules_per_km).max(0.0) * scale_height
                    }
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
        let relative_humidity = filled.relative_humidity.unwrap_or(80.0);
        Ok(Air {
            aerosol,
            relative_humidity,
            aod550,
            turbidity: 1.0 + aod550 / molecules_depth,
            visibility_km: KOSCHMIEDER / (molecules_per_km + aod550 / scale_height),
            asymmetry: filled.asymmetry.unwrap_or_else(|| aerosol.spectrum(relative_humidity).at(550.0).asymmetry),
            phase_function,
            aerosol_scale_height_km: scale_height,
            standard_atmosphere,
            surface_pressure_hpa,
            ground: filled.ground.unwrap_or_default(),
            filled: Self { aod550: None, turbidity: None, visibility_km: None, ..filled },
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
    use super::super::ground::Ground;
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
        assert_eq!((air.ground, air.filled.ozone_du), (Ground::Albedo(0.3), Some(250.0)));
        assert_eq!((air.filled.aod550, resolve(r#"{"preset": "thesis"}"#).unwrap().filled.ozone_du), (None, Some(0.0)));
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
        assert_eq!((volcanic.filled.stratospheric_aod550, clear.filled.stratospheric_aod550), (Some(0.1), None));
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
