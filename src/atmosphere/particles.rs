//! The kinds of particles that hazes are mixed from: their sizes and refractive indices as published.
//!
//! Modes, humidity growth and numbers: OPAC (Hess, Koepke & Schult, Bull. Am. Meteorol. Soc. 79, 831, 1998, tables 1 and 2).
//! Refractive indices: d'Almeida, Koepke & Shettle, Atmospheric Aerosols (1991); water Hale & Querry, Applied Optics 12, 555 (1973).
//! Particles are spheres; a wet one is a volume mixture of the dry substance and water. The droplets of volcanic sulphuric acid (75 % by
//! weight, 215 K: Hummel, Shettle & Longtin 1988, AFGL-TR-88-0166, interpolated) have the effective radius of 0.5 um that was found
//! three to six months after the eruption of Pinatubo (Russell et al., J. Geophys. Res. 101, 18745, 1996) and a chosen width.

use super::size_distribution::SizeDistribution;
use crate::words::words;

/// Wavelengths of the tables [nm].
pub const WAVELENGTHS_NM: [f64; 10] = [350.0, 400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0, 750.0, 800.0];

/// Relative humidities for which OPAC gives mode radii [%].
pub const HUMIDITIES: [f64; 8] = [0.0, 50.0, 70.0, 80.0, 90.0, 95.0, 98.0, 99.0];

/// A kind of particle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Particle {
    /// Insoluble: soil and organic matter (OPAC `inso`).
    Insoluble,
    /// Water soluble: sulphates, nitrates, organic substances (`waso`).
    WaterSoluble,
    /// Soot (`soot`).
    Soot,
    /// Sea salt, accumulation mode (`ssam`).
    SeaSaltAccumulation,
    /// Sea salt, coarse mode (`sscm`).
    SeaSaltCoarse,
    /// Mineral dust, nucleation mode (`minm`).
    MineralNucleation,
    /// Mineral dust, accumulation mode (`miam`).
    MineralAccumulation,
    /// Mineral dust, coarse mode (`micm`).
    MineralCoarse,
    /// Mineral dust carried far (`mitr`).
    MineralTransported,
    /// Sulphate droplets (`suso`).
    Sulphate,
    /// Droplets of sulphuric acid in the stratosphere some months after a great eruption.
    VolcanicSulphate,
    /// Fog droplets (`fogr`).
    Fog,
}

words!(Particle, "particle", {
    Insoluble => "insoluble",
    WaterSoluble => "water_soluble",
    Soot => "soot",
    SeaSaltAccumulation => "sea_salt_accumulation",
    SeaSaltCoarse => "sea_salt_coarse",
    MineralNucleation => "mineral_nucleation",
    MineralAccumulation => "mineral_accumulation",
    MineralCoarse => "mineral_coarse",
    MineralTransported => "mineral_transported",
    Sulphate => "sulphate",
    VolcanicSulphate => "volcanic_sulphate",
    Fog => "fog",
});

const WATER: [f64; 10] = [1.343, 1.339, 1.337, 1.335, 1.333, 1.332, 1.331, 1.331, 1.330, 1.329];

const SULPHURIC_ACID: [f64; 10] = [1.480, 1.464, 1.459, 1.455, 1.454, 1.453, 1.452, 1.452, 1.451, 1.450];

impl Particle {
    /// Median radius at each of the [`HUMIDITIES`] [um] and geometric standard deviation; one radius if the particle does not grow.
    fn mode(self) -> (&'static [f64], f64) {
        match self {
            Self::Insoluble => (&[0.471], 2.51),
            Self::WaterSoluble => (&[0.0212, 0.0262, 0.0285, 0.0306, 0.0348, 0.0399, 0.0476, 0.0534], 2.24),
            Self::Soot => (&[0.0118], 2.00),
            Self::SeaSaltAccumulation => (&[0.209, 0.336, 0.378, 0.416, 0.497, 0.605, 0.801, 0.995], 2.03),
            Self::SeaSaltCoarse => (&[1.75, 2.82, 3.17, 3.49, 4.18, 5.11, 6.84, 8.59], 2.03),
            Self::MineralNucleation => (&[0.07], 1.95),
            Self::MineralAccumulation => (&[0.39], 2.00),
            Self::MineralCoarse => (&[1.90], 2.15),
            Self::MineralTransported => (&[0.50], 2.20),
            Self::Sulphate => (&[0.0695, 0.0983, 0.109, 0.118, 0.135, 0.158, 0.195, 0.231], 2.03),
            Self::VolcanicSulphate => (&[0.331], 1.5),
            Self::Fog => (&[8.06], 1.0),
        }
    }

    /// Relative humidities that have a table [%].
    pub fn humidities(self) -> &'static [f64] {
        &HUMIDITIES[..self.mode().0.len()]
    }

    /// Size distribution at the humidity with index `humidity` of [`Self::humidities`].
    pub fn size_distribution(self, humidity: usize) -> SizeDistribution {
        if self == Self::Fog {
            return SizeDistribution::ModifiedGamma { alpha: 4.0, b: 0.0562, gamma: 1.77, largest_um: 50.0 };
        }
        let (radii, sigma) = self.mode();
        let largest_um = match self {
            Self::Insoluble => 7.5,
            Self::SeaSaltCoarse | Self::MineralCoarse => 60.0,
            Self::MineralTransported => 5.0,
            _ => 20.0,
        };
        SizeDistribution::LogNormal { radius_um: radii[humidity], sigma, smallest_um: 0.005, largest_um }
    }

    /// Refractive index, real and imaginary part (positive where it absorbs), at the wavelength with index `wavelength` of
    /// [`WAVELENGTHS_NM`] and the humidity with index `humidity` of [`Self::humidities`].
    pub fn refractive_index(self, wavelength: usize, humidity: usize) -> (f64, f64) {
        let (real, imaginary) = self.dry_refractive_index(wavelength);
        let radii = self.mode().0;
        let dry = (radii[0] / radii[humidity]).powi(3);
        (dry * real + (1.0 - dry) * WATER[wavelength], dry * imaginary)
    }

    fn dry_refractive_index(self, wavelength: usize) -> (f64, f64) {
        let imaginary = |values: [f64; 10]| values[wavelength];
        match self {
            Self::Insoluble => (1.53, 0.008),
            Self::WaterSoluble => (1.53, imaginary([0.005, 0.005, 0.005, 0.005, 0.006, 0.006, 0.007, 0.007, 0.0085, 0.01])),
            Self::Soot => (1.75, imaginary([0.465, 0.46, 0.455, 0.45, 0.44, 0.435, 0.435, 0.43, 0.43, 0.43])),
            Self::SeaSaltAccumulation | Self::SeaSaltCoarse => {
                (1.50, imaginary([3e-8, 3e-8, 2e-8, 1e-8, 1e-8, 1e-8, 1e-8, 1e-8, 1e-8, 1e-8]))
            }
            Self::MineralNucleation | Self::MineralAccumulation | Self::MineralCoarse | Self::MineralTransported => {
                (1.53, imaginary([0.017, 0.013, 0.0085, 0.0078, 0.0055, 0.0045, 0.0045, 0.004, 0.004, 0.004]))
            }
            Self::Sulphate => (1.43, 1e-8),
            Self::VolcanicSulphate => (SULPHURIC_ACID[wavelength], 1e-8),
            Self::Fog => (WATER[wavelength], 0.0),
        }
    }
}
