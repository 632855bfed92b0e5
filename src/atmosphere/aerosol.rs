//! Haze: its extinction, single scattering albedo, asymmetry and phase function by wavelength.
//!
//! The types are mixtures of particles by number, those of OPAC (Hess, Koepke & Schult 1998, table 3), with Mie theory over their size
//! distributions at any humidity ([`super::particle_tables`]; that reproduces OPAC's table 4 at 550 nm and 80 % humidity within 0.003 in
//! albedo and asymmetry). Scale heights are OPAC's optical depth divided by its extinction at the ground, rounded.

use super::particle_tables::Mixture;
use super::particles::{Particle, WAVELENGTHS_NM};
use crate::numerics::CubicSpline;
use crate::words::words;
use serde::{Deserialize, Serialize};

/// Wavelength at which the amount of aerosol is given [nm].
pub const REFERENCE_NM: f64 = 550.0;

/// A kind of aerosol.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum AerosolType {
    /// No aerosol at all.
    None,
    /// Remote continental air, nearly without soot. Also read as `rural`.
    #[default]
    ContinentalClean,
    /// Continental air with some soot.
    ContinentalAverage,
    /// Continental air polluted by man.
    ContinentalPolluted,
    /// Air over a city: much soot.
    Urban,
    /// Air over the open sea: sea salt and sulphate.
    MaritimeClean,
    /// Air over the sea near polluted coasts: with soot.
    MaritimePolluted,
    /// Air over the sea in the trade winds: little but sea salt.
    MaritimeTropical,
    /// Mineral dust.
    Desert,
    /// Air over the Arctic: sulphate and soot from afar.
    Arctic,
    /// Air over the Antarctic: sulphate droplets.
    Antarctic,
    /// Droplets of water near the ground.
    Fog,
    /// The haze of the original thesis: extinction proportional to wavelength^-0.84 (its section 6.2.2), scattering only. The thesis
    /// says that its asymmetry is close to one and gives no number: 0.8 here.
    Thesis,
}

words!(AerosolType, "aerosol", {
    None => "none",
    ContinentalClean => "continental_clean" | "rural",
    ContinentalAverage => "continental_average",
    ContinentalPolluted => "continental_polluted",
    Urban => "urban",
    MaritimeClean => "maritime_clean",
    MaritimePolluted => "maritime_polluted",
    MaritimeTropical => "maritime_tropical",
    Desert => "desert",
    Arctic => "arctic",
    Antarctic => "antarctic",
    Fog => "fog",
    Thesis => "thesis",
});

/// Optical properties of one kind of aerosol at one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AerosolOptics {
    /// Extinction relative to that at 550 nm.
    pub relative_extinction: f64,
    /// Scattering divided by extinction (0 to 1).
    pub single_scattering_albedo: f64,
    /// Mean cosine of the scattering angle.
    pub asymmetry: f64,
}

impl AerosolType {
    /// Particles and how many there are in a cm3 (OPAC, table 3); empty for types that are not made of particles.
    pub fn particles(self) -> &'static [(Particle, f64)] {
        use Particle::*;
        match self {
            Self::None | Self::Thesis => &[],
            Self::ContinentalClean => &[(WaterSoluble, 2600.0), (Insoluble, 0.15)],
            Self::ContinentalAverage => &[(WaterSoluble, 7000.0), (Insoluble, 0.4), (Soot, 8300.0)],
            Self::ContinentalPolluted => &[(WaterSoluble, 15_700.0), (Insoluble, 0.6), (Soot, 34_300.0)],
            Self::Urban => &[(WaterSoluble, 28_000.0), (Insoluble, 1.5), (Soot, 130_000.0)],
            Self::MaritimeClean => &[(WaterSoluble, 1500.0), (SeaSaltAccumulation, 20.0), (SeaSaltCoarse, 3.2e-3)],
            Self::MaritimePolluted => {
                &[(WaterSoluble, 3800.0), (SeaSaltAccumulation, 20.0), (SeaSaltCoarse, 3.2e-3), (Soot, 5180.0)]
            }
            Self::MaritimeTropical => &[(WaterSoluble, 590.0), (SeaSaltAccumulation, 10.0), (SeaSaltCoarse, 1.3e-3)],
            Self::Desert => {
                &[(WaterSoluble, 2000.0), (MineralNucleation, 269.5), (MineralAccumulation, 30.5), (MineralCoarse, 0.142)]
            }
            Self::Arctic => &[(WaterSoluble, 1300.0), (Insoluble, 0.01), (Soot, 5300.0), (SeaSaltAccumulation, 1.9)],
            Self::Antarctic => &[(Sulphate, 42.9), (SeaSaltAccumulation, 0.047), (MineralTransported, 0.0053)],
            Self::Fog => &[(Fog, 15.0)],
        }
    }

    /// Whether the type has phase functions by Mie theory.
    pub fn is_made_of_particles(self) -> bool {
        !self.particles().is_empty()
    }

    /// Properties at `relative_humidity` (0 to 99) [%].
    pub fn spectrum(self, relative_humidity: f64) -> AerosolSpectrum {
        if !self.is_made_of_particles() {
            return AerosolSpectrum::thesis();
        }
        AerosolSpectrum::new(&Mixture::new(self.particles(), relative_humidity))
    }

    /// Scale height of the exponential vertical profile; for fog, the depth of a layer as dense as at the ground [km].
    pub fn scale_height_km(self) -> f64 {
        match self {
            Self::Fog => 0.3,
            Self::MaritimeClean | Self::MaritimePolluted | Self::MaritimeTropical => 1.0,
            Self::Thesis => 1.2,
            Self::Antarctic => 6.0,
            _ => 2.0,
        }
    }

    /// Density at `altitude_km` relative to that at the ground, with the scale height (or depth) `height_km`.
    ///
    /// Fog has a top: exp(-(z / s)^4) with s = height / Gamma(5/4), so that its column is that of a uniform layer of this depth.
    pub fn relative_density(self, altitude_km: f64, height_km: f64) -> f64 {
        /// Gamma(5/4).
        const GAMMA: f64 = 0.906_402_477_055_477;
        match self {
            Self::Fog => (-(GAMMA * altitude_km / height_km).powi(4)).exp(),
            _ => (-altitude_km / height_km).exp(),
        }
    }
}

/// Angstrom's law: extinction relative to 550 nm, (wavelength / 550 nm)^-exponent.
pub fn angstrom(wavelength_nm: f64, exponent: f64) -> f64 {
    (wavelength_nm / REFERENCE_NM).powf(-exponent)
}

/// Optical properties of an aerosol at any wavelength.
#[derive(Clone, Debug)]
pub struct AerosolSpectrum(Spectrum);

#[derive(Clone, Debug)]
enum Spectrum {
    PowerLaw { exponent: f64, asymmetry: f64 },
    Tabulated { log_extinction: CubicSpline, albedo: CubicSpline, asymmetry: CubicSpline },
}

impl AerosolSpectrum {
    /// That of a mixture of particles.
    pub fn new(mixture: &Mixture) -> Self {
        let optics = mixture.optics();
        let at_reference = optics.extinction[WAVELENGTHS_NM.iter().position(|&w| w == REFERENCE_NM).expect("a node")];
        let logarithms: Vec<f64> = optics.extinction.iter().map(|extinction| (extinction / at_reference).ln()).collect();
        Self(Spectrum::Tabulated {
            log_extinction: CubicSpline::new(&WAVELENGTHS_NM.map(f64::ln), &logarithms),
            albedo: CubicSpline::new(&WAVELENGTHS_NM, &optics.single_scattering_albedo),
            asymmetry: CubicSpline::new(&WAVELENGTHS_NM, &optics.asymmetry),
        })
    }

    fn thesis() -> Self {
        Self(Spectrum::PowerLaw { exponent: 0.84, asymmetry: 0.8 })
    }

    /// Properties at `wavelength_nm`. Between 350 and 800 nm from the table; outside, the extinction continues with the exponent of
    /// the outermost 50 nm and the rest stays.
    pub fn at(&self, wavelength_nm: f64) -> AerosolOptics {
        match &self.0 {
            &Spectrum::PowerLaw { exponent, asymmetry } => {
                let relative_extinction = angstrom(wavelength_nm, exponent);
                AerosolOptics { relative_extinction, single_scattering_albedo: 1.0, asymmetry }
            }
            Spectrum::Tabulated { log_extinction, albedo, asymmetry } => AerosolOptics {
                relative_extinction: continued(log_extinction, wavelength_nm.ln()).exp(),
                single_scattering_albedo: albedo.value(wavelength_nm).min(1.0),
                asymmetry: asymmetry.value(wavelength_nm),
            },
        }
    }
}

/// The spline at `x`, the logarithm of a wavelength; outside the table the line through the outermost two nodes.
fn continued(spline: &CubicSpline, x: f64) -> f64 {
    let nodes = WAVELENGTHS_NM.map(f64::ln);
    let last = nodes.len() - 1;
    let slope = |a: usize, b: usize| (spline.value(nodes[b]) - spline.value(nodes[a])) / (nodes[b] - nodes[a]);
    let beyond = if x < nodes[0] {
        slope(0, 1) * (x - nodes[0])
    } else if x > nodes[last] {
        slope(last - 1, last) * (x - nodes[last])
    } else {
        0.0
    };
    spline.value(x) + beyond
}

#[cfg(test)]
mod tests {
    use super::*;

    fn optics(kind: AerosolType, wavelength_nm: f64) -> AerosolOptics {
        kind.spectrum(80.0).at(wavelength_nm)
    }

    #[test]
    fn types_are_those_of_opac_at_550_nm() {
        // checked against: Hess, Koepke & Schult 1998, table 4, 80 % humidity: extinction [1/km], single scattering albedo, asymmetry,
        // Angstrom exponent 500-800 nm
        let table = [
            (AerosolType::ContinentalClean, 0.026, 0.972, 0.709, 1.42),
            (AerosolType::ContinentalAverage, 0.075, 0.925, 0.703, 1.42),
            (AerosolType::ContinentalPolluted, 0.175, 0.892, 0.698, 1.45),
            (AerosolType::Urban, 0.353, 0.817, 0.689, 1.43),
            (AerosolType::MaritimeClean, 0.090, 0.997, 0.772, 0.08),
            (AerosolType::MaritimePolluted, 0.115, 0.975, 0.756, 0.35),
            (AerosolType::MaritimeTropical, 0.043, 0.998, 0.774, 0.04),
            (AerosolType::Desert, 0.145, 0.888, 0.729, 0.17),
            (AerosolType::Arctic, 0.023, 0.887, 0.721, 0.89),
            (AerosolType::Antarctic, 0.011, 1.000, 0.784, 0.73),
        ];
        for (kind, extinction, albedo, asymmetry, exponent) in table {
            let at = optics(kind, 550.0);
            assert!((at.relative_extinction - 1.0).abs() < 1e-4, "{}", kind.name());
            assert!((at.single_scattering_albedo - albedo).abs() < 0.003, "{}: {at:?}", kind.name());
            assert!((at.asymmetry - asymmetry).abs() < 0.003, "{}: {at:?}", kind.name());
            let ratio = optics(kind, 800.0).relative_extinction / optics(kind, 500.0).relative_extinction;
            assert!((-ratio.ln() / 1.6_f64.ln() - exponent).abs() < 0.03, "{}", kind.name());
            // um2 x cm-3 = 1e-3 km-1
            let per_km = Mixture::new(kind.particles(), 80.0).optics().extinction[4] * 1e-3;
            assert!((per_km - extinction).abs() < 0.0006 + 0.01 * extinction, "{}: {per_km}", kind.name());
        }
    }

    #[test]
    fn dry_air_absorbs_more() {
        // checked against: Gasteiger & Wiegner 2018 (MOPSMAP), figure 5: single scattering albedo of OPAC's types at 532 nm, dry
        for (kind, albedo) in [
            (AerosolType::Urban, 0.673),
            (AerosolType::ContinentalPolluted, 0.785),
            (AerosolType::ContinentalAverage, 0.845),
            (AerosolType::MaritimePolluted, 0.927),
            (AerosolType::Arctic, 0.749),
            (AerosolType::ContinentalClean, 0.939),
        ] {
            let dry = kind.spectrum(0.0).at(532.0).single_scattering_albedo;
            assert!((dry - albedo).abs() < 0.006, "{}: {dry}", kind.name());
            assert!(kind.spectrum(95.0).at(532.0).single_scattering_albedo > albedo + 0.02);
        }
    }

    #[test]
    fn the_table_continues_without_a_step() {
        for kind in [AerosolType::Urban, AerosolType::Desert] {
            for edge in [350.0, 800.0] {
                let (below, above) = (optics(kind, edge - 1e-6), optics(kind, edge + 1e-6));
                assert!((below.relative_extinction / above.relative_extinction - 1.0).abs() < 1e-6);
            }
            assert!(optics(kind, 950.0).relative_extinction < optics(kind, 800.0).relative_extinction);
        }
    }

    #[test]
    fn the_haze_of_the_thesis_follows_its_exponent() {
        let ratio =
            optics(AerosolType::Thesis, 400.0).relative_extinction / optics(AerosolType::Thesis, 800.0).relative_extinction;
        assert!((ratio - 2.0_f64.powf(0.84)).abs() < 1e-12);
    }

    #[test]
    fn fog_is_as_deep_as_it_says() {
        let steps = 10_000;
        let column: f64 = (0..steps).map(|i| AerosolType::Fog.relative_density(f64::from(i) * 1e-4, 0.3) * 1e-4).sum();
        assert!((column - 0.3).abs() < 1e-4, "{column}");
    }
}
