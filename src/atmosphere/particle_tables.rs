//! Mie theory's results for the [`Particle`]s, tabulated once and embedded, and mixtures of them.
//!
//! `data/aerosol_particles.bin`, made by [`tabulate`] (`cargo run --release --example tabulate_mie`), little-endian:
//!
//! | content | type |
//! |---|---|
//! | `SKYMIE1` and a zero byte | 8 bytes |
//! | numbers of tables T, wavelengths W, angles A | 3 x u32 |
//! | wavelengths [nm]; scattering angles [degrees] | f32 x W; f32 x A |
//! | T times, particles in the order of [`Particle::ALL`], humidities ascending: | |
//! | extinction, scattering cross-section [um2]; asymmetry | 3 x f32 x W |
//! | logarithm of the phase function, by wavelength and angle | f32 x W x A |
//!
//! Between humidities, the logarithms of cross-sections and phase function are linear in -ln(1 - humidity), in which the radii of the
//! particles grow almost exponentially. Between wavelengths they follow a cubic spline over the logarithm of the wavelength.

use super::mie::AngularFunctions;
use super::particles::{Particle, WAVELENGTHS_NM};
use super::phase_table::PhaseTable;
use crate::numerics::CubicSpline;
use crate::numerics::spline::cardinal_functions;
use rayon::prelude::*;
use std::sync::LazyLock;

const MAGIC: &[u8; 8] = b"SKYMIE1\0";

/// How many angles of a mixture's phase function there are for each tabulated one. It is tabulated so coarsely that a cubic is needed
/// between the angles, and looked up so finely that its logarithm may be taken as linear.
const FINER_ANGLES: usize = 4;

/// Scattering angles of the tables [degrees]: 9 thousandths of a degree apart at 0, where coarse particles have their narrow peak, a fifth
/// of a degree at 180, where glories are, and at most 1.3 degrees between.
pub fn angles_deg() -> Vec<f64> {
    let coordinate = |angle: f64| 16.0 * (angle / 0.15).asinh() + 0.5 * angle - 8.0 * ((180.0 - angle) / 1.5).asinh();
    let (first, last) = (coordinate(0.0), coordinate(180.0));
    let count = (last - first).round() as usize;
    let mut angles: Vec<f64> = (0..=count)
        .map(|i| {
            let wanted = first + (last - first) * i as f64 / count as f64;
            let (mut low, mut high) = (0.0, 180.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if coordinate(middle) < wanted { low = middle } else { high = middle }
            }
            // The file holds single precision: compute at exactly the angles that it holds.
            f64::from((0.5 * (low + high)) as f32)
        })
        .collect();
    (angles[0], angles[count]) = (0.0, 180.0);
    angles
}

/// The content of `data/aerosol_particles.bin`, from Mie theory.
pub fn tabulate() -> Vec<u8> {
    let angles = angles_deg();
    let cosines: Vec<f64> = angles.iter().map(|angle| angle.to_radians().cos()).collect();
    let most_terms = Particle::ALL.iter().map(|p| p.size_distribution(0).terms(WAVELENGTHS_NM[0] / 1000.0)).max().unwrap_or(0);
    let angular = AngularFunctions::new(&cosines, most_terms);
    let rows: Vec<(Particle, usize)> =
        Particle::ALL.iter().flat_map(|&particle| (0..particle.humidities().len()).map(move |h| (particle, h))).collect();
    let tables: Vec<Vec<f32>> = rows
        .par_iter()
        .map(|&(particle, humidity)| {
            let distribution = particle.size_distribution(humidity);
            let refinement = match particle {
                Particle::Fog | Particle::SeaSaltAccumulation | Particle::Sulphate | Particle::VolcanicSulphate => 3.0,
                _ => 1.0,
            };
            let ensembles: Vec<_> = (0..WAVELENGTHS_NM.len())
                .into_par_iter()
                .map(|k| {
                    let index = particle.refractive_index(k, humidity);
                    distribution.ensemble(WAVELENGTHS_NM[k] / 1000.0, index, &angular, refinement)
                })
                .collect();
            let mut table: Vec<f32> = ensembles.iter().map(|e| e.extinction_um2 as f32).collect();
            table.extend(ensembles.iter().map(|e| e.scattering_um2 as f32));
            table.extend(ensembles.iter().map(|e| e.asymmetry as f32));
            table.extend(ensembles.iter().flat_map(|e| e.phase.iter().map(|p| p.ln() as f32)));
            table
        })
        .collect();
    let mut bytes = MAGIC.to_vec();
    for number in [tables.len(), WAVELENGTHS_NM.len(), angles.len()] {
        bytes.extend((number as u32).to_le_bytes());
    }
    let numbers = WAVELENGTHS_NM.iter().chain(&angles).map(|&v| v as f32).chain(tables.into_iter().flatten());
    bytes.extend(numbers.flat_map(f32::to_le_bytes));
    bytes
}

/// One particle at one humidity.
struct Table {
    extinction: Vec<f64>,
    scattering: Vec<f64>,
    asymmetry: Vec<f64>,
    ln_phase: Vec<f32>,
}

struct Tables {
    angles_rad: Vec<f64>,
    tables: Vec<Table>,
}

static TABLES: LazyLock<Tables> =
    LazyLock::new(|| read(include_bytes!("../../data/aerosol_particles.bin")).expect("the embedded table is whole"));

fn read(bytes: &[u8]) -> Option<Tables> {
    let mut numbers = bytes.strip_prefix(MAGIC)?.chunks_exact(4).map(|b| [b[0], b[1], b[2], b[3]]);
    let mut count = || numbers.next().map(|b| u32::from_le_bytes(b) as usize);
    let (tables, wavelengths, angles) = (count()?, count()?, count()?);
    let mut floats = |count: usize| -> Option<Vec<f32>> {
        let values: Vec<f32> = numbers.by_ref().take(count).map(f32::from_le_bytes).collect();
        (values.len() == count).then_some(values)
    };
    let double = |values: Vec<f32>| -> Vec<f64> { values.into_iter().map(f64::from).collect() };
    if double(floats(wavelengths)?) != WAVELENGTHS_NM {
        return None;
    }
    let angles_rad = floats(angles)?.into_iter().map(|angle| f64::from(angle).to_radians()).collect();
    let tables = (0..tables)
        .map(|_| {
            Some(Table {
                extinction: double(floats(wavelengths)?),
                scattering: double(floats(wavelengths)?),
                asymmetry: double(floats(wavelengths)?),
                ln_phase: floats(wavelengths * angles)?,
            })
        })
        .collect::<Option<Vec<Table>>>()?;
    Some(Tables { angles_rad, tables })
}

/// Optical properties of a mixture, by wavelength of [`WAVELENGTHS_NM`].
#[derive(Clone, Debug, PartialEq)]
pub struct MixtureOptics {
    /// Extinction of all particles together: cross-sections [um2] times numbers.
    pub extinction: Vec<f64>,
    /// Scattering divided by extinction.
    pub single_scattering_albedo: Vec<f64>,
    /// Asymmetry parameter.
    pub asymmetry: Vec<f64>,
}

/// Particles of several kinds side by side.
pub struct Mixture {
    parts: Vec<Part>,
}

/// One kind of particle: `number` of it, between two tables.
struct Part {
    number: f64,
    dry: &'static Table,
    wet: &'static Table,
    fraction: f64,
}

impl Part {
    fn new(particle: Particle, number: f64, relative_humidity: f64) -> Self {
        let before = Particle::ALL.iter().take_while(|&&other| other != particle);
        let first: usize = before.map(|other| other.humidities().len()).sum();
        let humidities = particle.humidities();
        let last = humidities.len() - 1;
        let upper = humidities.partition_point(|&h| h < relative_humidity).min(last);
        let lower = upper.saturating_sub(1);
        let growth = |humidity: f64| -(1.0 - 0.01 * humidity).ln();
        let fraction = if upper == lower {
            0.0
        } else {
            let (low, high) = (growth(humidities[lower]), growth(humidities[upper]));
            ((growth(relative_humidity) - low) / (high - low)).clamp(0.0, 1.0)
        };
        let tables = &TABLES.tables[first..];
        Self { number, dry: &tables[lower], wet: &tables[upper], fraction }
    }

    fn between(&self, dry: f64, wet: f64) -> f64 {
        dry + self.fraction * (wet - dry)
    }

    fn extinction(&self, k: usize) -> f64 {
        self.number * self.between(self.dry.extinction[k].ln(), self.wet.extinction[k].ln()).exp()
    }

    fn scattering(&self, k: usize) -> f64 {
        self.number * self.between(self.dry.scattering[k].ln(), self.wet.scattering[k].ln()).exp()
    }

    fn asymmetry(&self, k: usize) -> f64 {
        self.between(self.dry.asymmetry[k], self.wet.asymmetry[k])
    }
}

impl Mixture {
    /// Particles with their relative numbers, at `relative_humidity` (0 to 99) [%].
    pub fn new(particles: &[(Particle, f64)], relative_humidity: f64) -> Self {
        Self { parts: particles.iter().map(|&(particle, number)| Part::new(particle, number, relative_humidity)).collect() }
    }

    /// The optical properties but the phase function.
    pub fn optics(&self) -> MixtureOptics {
        let sum = |what: &dyn Fn(&Part, usize) -> f64| -> Vec<f64> {
            (0..WAVELENGTHS_NM.len()).map(|k| self.parts.iter().map(|part| what(part, k)).sum()).collect()
        };
        let extinction = sum(&|part, k| part.extinction(k));
        let scattering = sum(&|part, k| part.scattering(k));
        let forward = sum(&|part, k| part.scattering(k) * part.asymmetry(k));
        let ratio = |above: &[f64], below: &[f64]| above.iter().zip(below).map(|(a, b)| a / b).collect();
        MixtureOptics {
            single_scattering_albedo: ratio(&scattering, &extinction),
            asymmetry: ratio(&forward, &scattering),
            extinction,
        }
    }

    /// The phase function at `wavelengths_nm`; outside the tabulated wavelengths that of the outermost.
    pub fn phase_table(&self, wavelengths_nm: &[f64]) -> PhaseTable {
        let angles_rad = &TABLES.angles_rad;
        let count = angles_rad.len();
        let ln_phases: Vec<Vec<f64>> = (0..WAVELENGTHS_NM.len())
            .map(|k| {
                let scattering: Vec<f64> = self.parts.iter().map(|part| part.scattering(k)).collect();
                let whole: f64 = scattering.iter().sum();
                (k * count..(k + 1) * count)
                    .map(|i| {
                        let parts = self.parts.iter().zip(&scattering).map(|(part, scattering)| {
                            scattering * part.between(f64::from(part.dry.ln_phase[i]), f64::from(part.wet.ln_phase[i])).exp()
                        });
                        (parts.sum::<f64>() / whole).ln()
                    })
                    .collect()
            })
            .collect();
        let logarithms = |wavelengths: &[f64]| -> Vec<f64> { wavelengths.iter().map(|w| w.ln()).collect() };
        let weights = cardinal_functions(&logarithms(&WAVELENGTHS_NM), &logarithms(wavelengths_nm));
        // The tabulated angles are evenly spaced in a stretched coordinate, which is their index.
        let indices: Vec<f64> = (0..count).map(|i| i as f64).collect();
        let fine: Vec<f64> = (0..=(count - 1) * FINER_ANGLES).map(|i| i as f64 / FINER_ANGLES as f64).collect();
        let stretch = CubicSpline::new(&indices, angles_rad);
        let angles: Vec<f64> = fine.iter().map(|&i| stretch.value(i)).collect();
        let mut ln_values = Vec::with_capacity(wavelengths_nm.len() * fine.len());
        for k in 0..wavelengths_nm.len() {
            let row: Vec<f64> = (0..count)
                .map(|i| weights.iter().zip(&ln_phases).map(|(weight, ln_phase)| weight[k] * ln_phase[i]).sum())
                .collect();
            let spline = CubicSpline::new(&indices, &row);
            ln_values.extend(fine.iter().map(|&i| spline.value(i)));
        }
        PhaseTable::from_logarithms(angles, ln_values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn single(particle: Particle, humidity: f64) -> MixtureOptics {
        Mixture::new(&[(particle, 1.0)], humidity).optics()
    }

    #[test]
    fn particles_are_those_of_opac() {
        // checked against: OPAC's files at 550 nm: extinction [um2], single scattering albedo, asymmetry
        for (particle, humidity, extinction, albedo, asymmetry) in [
            (Particle::WaterSoluble, 70.0, None, 0.981, 0.690),
            (Particle::Sulphate, 99.0, Some(1.209), 1.0, 0.797),
            (Particle::Fog, 0.0, Some(562.0), 1.0, 0.866),
        ] {
            let optics = single(particle, humidity);
            assert!((optics.single_scattering_albedo[4] - albedo).abs() < 1e-3, "{}: {optics:?}", particle.name());
            assert!((optics.asymmetry[4] - asymmetry).abs() < 3e-3, "{}: {optics:?}", particle.name());
            if let Some(expected) = extinction {
                assert!((optics.extinction[4] / expected - 1.0).abs() < 0.02, "{}: {optics:?}", particle.name());
            }
        }
    }

    #[test]
    fn fog_scatters_as_in_opac() {
        // checked against: OPAC's file fogr00, volume phase function [1/km] at 550 nm; extinction 0.562 / km
        let table = Mixture::new(&[(Particle::Fog, 1.0)], 0.0).phase_table(&[550.0]);
        let value = |degrees: f64| table.value(0, degrees.to_radians().cos()) * 0.562 / (4.0 * std::f64::consts::PI);
        for (degrees, expected) in [(0.0, 377.0), (0.2, 352.4), (0.5, 248.3), (1.0, 76.19), (1.4, 22.24)] {
            assert!((value(degrees) / expected - 1.0).abs() < 3e-3, "{degrees}: {}", value(degrees));
        }
        // The fogbow and the glory.
        assert!((value(142.0) / 0.01576 - 1.0).abs() < 0.05, "{}", value(142.0));
        assert!(value(142.0) > 2.0 * value(132.0) && value(142.0) > 1.5 * value(150.0));
        assert!(value(180.0) > 3.0 * value(170.0) && value(178.3) > value(179.2));
    }

    #[test]
    fn values_between_the_nodes_are_those_of_mie_theory() {
        // Half way between wavelengths, at angles that are no nodes.
        for (particle, h) in [(Particle::Fog, 0), (Particle::MineralCoarse, 0), (Particle::WaterSoluble, 4)] {
            let degrees =
                [0.0, 0.07, 0.33, 0.81, 1.7, 4.4, 13.0, 47.3, 90.2, 121.7, 139.1, 141.9, 158.3, 174.9, 178.1, 179.7, 180.0];
            let cosines: Vec<f64> = degrees.iter().map(|d: &f64| d.to_radians().cos()).collect();
            let distribution = particle.size_distribution(h);
            let angular = AngularFunctions::new(&cosines, distribution.terms(0.525));
            let (low, high) = (particle.refractive_index(3, h), particle.refractive_index(4, h));
            let index = (0.5 * (low.0 + high.0), 0.5 * (low.1 + high.1));
            let expected = distribution.ensemble(0.525, index, &angular, 1.0);
            let table = Mixture::new(&[(particle, 1.0)], particle.humidities()[h]).phase_table(&[525.0]);
            for (i, cosine) in cosines.iter().enumerate() {
                let ratio = table.value(0, *cosine) / expected.phase[i];
                assert!((ratio - 1.0).abs() < 0.01, "{} at {}: {ratio}", particle.name(), degrees[i]);
            }
        }
    }

    #[test]
    fn the_file_is_what_mie_theory_gives() {
        let k = 4;
        for (particle, humidity, table) in [(Particle::Soot, 0, 9), (Particle::MineralAccumulation, 0, 27)] {
            let cosines: Vec<f64> = TABLES.angles_rad.iter().map(|angle| angle.cos()).collect();
            let distribution = particle.size_distribution(humidity);
            let angular = AngularFunctions::new(&cosines, distribution.terms(0.55));
            let expected = distribution.ensemble(0.55, particle.refractive_index(k, humidity), &angular, 1.3);
            let table = &TABLES.tables[table];
            assert!((table.extinction[k] / expected.extinction_um2 - 1.0).abs() < 1e-4);
            for (i, value) in expected.phase.iter().enumerate() {
                let tabulated = f64::from(table.ln_phase[k * cosines.len() + i]).exp();
                assert!((tabulated / value - 1.0).abs() < 1e-3, "{}, angle {i}", particle.name());
            }
        }
    }

    #[test]
    fn every_phase_function_is_normalised_and_has_the_asymmetry_of_its_particle() {
        for particle in Particle::ALL {
            for &humidity in particle.humidities() {
                let mixture = Mixture::new(&[(particle, 1.0)], humidity);
                let table = mixture.phase_table(&WAVELENGTHS_NM);
                assert!(table.largest_deviation() < 2e-3, "{} {humidity}: {}", particle.name(), table.largest_deviation());
                for (k, asymmetry) in mixture.optics().asymmetry.iter().enumerate() {
                    let moment = table.legendre_moment(1, k);
                    assert!((moment - asymmetry).abs() < 1e-3, "{} {humidity}: {moment} {asymmetry}", particle.name());
                }
            }
        }
    }

    #[test]
    fn interpolation_between_humidities_is_close_to_a_computation_there() {
        let between = Mixture::new(&[(Particle::WaterSoluble, 1.0)], 85.0).optics();
        let (low, high) = (single(Particle::WaterSoluble, 80.0), single(Particle::WaterSoluble, 90.0));
        for k in 0..WAVELENGTHS_NM.len() {
            assert!(low.extinction[k] < between.extinction[k] && between.extinction[k] < high.extinction[k]);
        }
        assert_eq!(single(Particle::WaterSoluble, 80.0), Mixture::new(&[(Particle::WaterSoluble, 1.0)], 80.0).optics());
        assert_eq!(single(Particle::Soot, 10.0), single(Particle::Soot, 99.0));
    }
}
