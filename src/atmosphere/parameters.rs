//! What a user says about the air, the same keys in Rust, Python, JSON and on the command line.
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
use super::ground::{Ground, Surface};
use super::phase_function::PhaseFunction;
use super::preset::Preset;
use super::standard_atmosphere::StandardAtmosphere;
use crate::parameter::parameters;
use crate::words::Words;

/// Shortest visibility that is accepted [km].
pub(super) const SHORTEST_VISIBILITY_KM: f64 = 0.05;

/// Largest vertical optical depth of the aerosol that is accepted.
pub(super) const LARGEST_AOD550: f64 = 50.0;

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
