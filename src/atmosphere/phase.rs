//! Phase functions: where a scatterer sends the light. Normalised so that the integral over the sphere is 4 pi.

use super::phase_table::PhaseTable;
use crate::error::{Error, Result, check_range};
use std::sync::Arc;

/// A phase function, with its parameters by wavelength where they depend on it.
#[derive(Clone, Debug, PartialEq)]
pub enum Phase {
    /// Molecules: P = 3 / (4 (1 + 2 gamma)) ((1 + 3 gamma) + (1 - gamma) cos^2), gamma = d / (2 - d), with the depolarisation ratio d
    /// by wavelength (Chandrasekhar 1950; Bucholtz 1995, eq. 12).
    Rayleigh {
        /// Depolarisation ratio of natural light (0 to 1), one for each wavelength or a single one for all.
        depolarisation: Vec<f64>,
    },
    /// P = (1 - g^2) / (1 + g^2 - 2 g cos)^(3/2) (Henyey & Greenstein 1941; eq. 5 of the thesis).
    HenyeyGreenstein {
        /// Asymmetry parameter (-1 < g < 1).
        asymmetry: f64,
    },
    /// P = 3 (1 - g^2) / (2 (2 + g^2)) (1 + cos^2) / (1 + g^2 - 2 g cos)^(3/2) (Cornette & Shanks 1992, eq. 8).
    CornetteShanks {
        /// Parameter g (-1 < g < 1); the asymmetry of the function is slightly larger.
        asymmetry: f64,
    },
    /// Values by angle and wavelength: Mie theory's or any other.
    Tabulated(Arc<PhaseTable>),
}

impl Phase {
    pub(crate) fn validate(&self, component: &str, wavelengths: usize) -> Result<()> {
        match self {
            Self::Rayleigh { depolarisation } => {
                if depolarisation.len() != 1 && depolarisation.len() != wavelengths {
                    return Err(Error::input(
                        format!("{component}.depolarisation"),
                        format!("{} values", depolarisation.len()),
                        format!("1 value or {wavelengths}, one for each wavelength"),
                    ));
                }
                for &ratio in depolarisation {
                    check_range("depolarisation", ratio, 0.0, 1.0, "")?;
                }
            }
            Self::HenyeyGreenstein { asymmetry } | Self::CornetteShanks { asymmetry } => {
                check_range("asymmetry", *asymmetry, -0.99, 0.99, "")?;
            }
            Self::Tabulated(table) => {
                if table.wavelengths() != 1 && table.wavelengths() != wavelengths {
                    return Err(Error::input(
                        format!("{component}.phase"),
                        format!("a table of {} wavelengths", table.wavelengths()),
                        format!("a table of 1 wavelength or {wavelengths}, those of the profile"),
                    ));
                }
            }
        }
        Ok(())
    }

    /// Weights of 1 and cos^2 in the phase function of molecules at the wavelength with index `wavelength`; `None` for any other phase function.
    pub fn molecular_weights(&self, wavelength: usize) -> Option<[f64; 2]> {
        let Self::Rayleigh { depolarisation } = self else { return None };
        let d = depolarisation[if depolarisation.len() == 1 { 0 } else { wavelength }];
        let gamma = d / (2.0 - d);
        let norm = 0.75 / (1.0 + 2.0 * gamma);
        Some([norm * (1.0 + 3.0 * gamma), norm * (1.0 - gamma)])
    }

    /// The phase function at wavelength index `wavelength` and scattering angle cosine `cosine`.
    pub fn value(&self, wavelength: usize, cosine: f64) -> f64 {
        match self {
            Self::Rayleigh { .. } => {
                let [constant, square] = self.molecular_weights(wavelength).unwrap_or_default();
                constant + square * cosine * cosine
            }
            Self::HenyeyGreenstein { asymmetry: g } => henyey_greenstein(*g, cosine),
            Self::CornetteShanks { asymmetry: g } => {
                1.5 / (2.0 + g * g) * (1.0 + cosine * cosine) * henyey_greenstein(*g, cosine)
            }
            Self::Tabulated(table) => table.value(wavelength, cosine),
        }
    }

    /// Legendre moment of order `l`: 1/2 of the integral of P P_l over the cosine; the moment of order 0 is 1.
    pub fn legendre_moment(&self, l: usize, wavelength: usize) -> f64 {
        match self {
            Self::Rayleigh { .. } => match l {
                0 => 1.0,
                // From the cos^2 term: cos^2 = 1/3 + 2/3 P_2.
                2 => self.molecular_weights(wavelength).unwrap_or_default()[1] * 2.0 / 15.0,
                _ => 0.0,
            },
            Self::HenyeyGreenstein { asymmetry: g } => g.powi(l as i32),
            Self::CornetteShanks { asymmetry: g } => {
                // (1 + x^2) P_l by the recurrence of Legendre polynomials, with HG moments g^l of each term.
                let n = l as f64;
                let up = (n + 1.0) * (n + 2.0) / ((2.0 * n + 1.0) * (2.0 * n + 3.0));
                let same = (n + 1.0).powi(2) / ((2.0 * n + 1.0) * (2.0 * n + 3.0))
                    + if l > 0 { n * n / ((2.0 * n + 1.0) * (2.0 * n - 1.0)) } else { 0.0 };
                let down = if l > 1 { n * (n - 1.0) / ((2.0 * n + 1.0) * (2.0 * n - 1.0)) } else { 0.0 };
                let moment = |k: i32| g.powi(k);
                let below = if l > 1 { down * moment(l as i32 - 2) } else { 0.0 };
                1.5 / (2.0 + g * g) * ((1.0 + same) * moment(l as i32) + up * moment(l as i32 + 2) + below)
            }
            Self::Tabulated(table) => table.legendre_moment(l, wavelength),
        }
    }

    /// The first `count` Legendre moments, orders 0 to `count` - 1; see [`Phase::legendre_moment`].
    pub fn legendre_moments(&self, count: usize, wavelength: usize) -> Vec<f64> {
        match self {
            Self::Tabulated(table) => table.legendre_moments(count, wavelength),
            _ => (0..count).map(|l| self.legendre_moment(l, wavelength)).collect(),
        }
    }

    /// The function of Cornette and Shanks whose asymmetry is `asymmetry` (-0.99 to 0.99), not its parameter g: solves
    /// asymmetry = 3 g (4 + g^2) / (5 (2 + g^2)) (their eq. 9).
    pub fn cornette_shanks_of_asymmetry(asymmetry: f64) -> Self {
        let mut g = asymmetry;
        for _ in 0..20 {
            let value = 0.6 * g * (4.0 + g * g) / (2.0 + g * g);
            let slope = 0.6 * (8.0 - 2.0 * g * g + g.powi(4) + 4.0 * g * g) / (2.0 + g * g).powi(2);
            g -= (value - asymmetry) / slope;
        }
        Self::CornetteShanks { asymmetry: g.clamp(-0.99, 0.99) }
    }
}

fn henyey_greenstein(g: f64, cosine: f64) -> f64 {
    let d = 1.0 + g * g - 2.0 * g * cosine;
    (1.0 - g * g) / (d * d.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment_by_quadrature(phase: &Phase, l: usize) -> f64 {
        let n = 200_000;
        let legendre = |x: f64| {
            let (mut before, mut now) = (0.0, 1.0);
            for k in 0..l {
                let next = ((2 * k + 1) as f64 * x * now - k as f64 * before) / (k + 1) as f64;
                (before, now) = (now, next);
            }
            now
        };
        (0..n)
            .map(|i| {
                let x = -1.0 + (i as f64 + 0.5) * 2.0 / n as f64;
                phase.value(0, x) * legendre(x) / n as f64
            })
            .sum()
    }

    #[test]
    fn moments_are_the_integrals() {
        let phases = [
            Phase::Rayleigh { depolarisation: vec![0.0] },
            Phase::Rayleigh { depolarisation: vec![0.03] },
            Phase::HenyeyGreenstein { asymmetry: 0.7 },
            Phase::CornetteShanks { asymmetry: 0.76 },
        ];
        for phase in &phases {
            for l in 0..7 {
                let expected = moment_by_quadrature(phase, l);
                assert!((phase.legendre_moment(l, 0) - expected).abs() < 1e-6, "{phase:?}, order {l}");
            }
        }
    }

    #[test]
    fn all_moments_at_once_are_the_single_ones() {
        let angles: Vec<f64> = (0..=900).map(|i| f64::from(i) / 900.0 * std::f64::consts::PI).collect();
        let values: Vec<f64> = angles.iter().map(|a| henyey_greenstein(0.5, a.cos())).collect();
        let tabulated = Phase::Tabulated(Arc::new(PhaseTable::new(&angles, &values).unwrap()));
        for phase in [tabulated, Phase::Rayleigh { depolarisation: vec![0.03] }, Phase::CornetteShanks { asymmetry: 0.76 }] {
            for (l, moment) in phase.legendre_moments(6, 0).into_iter().enumerate() {
                assert!((moment - phase.legendre_moment(l, 0)).abs() < 1e-6, "{phase:?}, order {l}");
                assert!((moment - moment_by_quadrature(&phase, l)).abs() < 1e-5, "{phase:?}, order {l}");
            }
        }
    }

    #[test]
    fn the_function_of_cornette_and_shanks_is_found_by_its_asymmetry() {
        for asymmetry in [-0.9, -0.3, 0.0, 0.5, 0.8, 0.98] {
            let phase = Phase::cornette_shanks_of_asymmetry(asymmetry);
            assert!((phase.legendre_moment(1, 0) - asymmetry).abs() < 1e-9, "{asymmetry}: {phase:?}");
        }
    }

    #[test]
    fn rayleigh_without_depolarisation_is_the_textbook_form() {
        let phase = Phase::Rayleigh { depolarisation: vec![0.0] };
        assert!((phase.value(0, 0.3) - 0.75 * (1.0 + 0.09)).abs() < 1e-15);
        assert!((phase.legendre_moment(2, 0) - 0.1).abs() < 1e-15);
    }
}
