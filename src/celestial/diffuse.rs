//! The common form of diffuse light: scalar maps times fixed spectra.

use glam::DVec3;

/// Diffuse light as a sum of `N` scalar maps times fixed spectra; see the [module](super).
pub trait DiffuseLight<const N: usize> {
    /// The spectra F_i at `wavelengths_nm` (ascending) [W m-2 sr-1 nm-1 per unit of the scalar].
    fn spectra(&self, wavelengths_nm: &[f64]) -> [Vec<f64>; N];

    /// The scalars s_i of the unit vector `direction`, in the component's own frame.
    fn scalars(&self, direction: DVec3) -> [f64; N];

    /// Spectral radiance from `direction` at `wavelengths_nm` [W m-2 sr-1 nm-1]. For many directions take the two factors.
    fn radiance(&self, direction: DVec3, wavelengths_nm: &[f64]) -> Vec<f64> {
        let (spectra, scalars) = (self.spectra(wavelengths_nm), self.scalars(direction));
        (0..wavelengths_nm.len()).map(|k| spectra.iter().zip(scalars).map(|(spectrum, s)| s * spectrum[k]).sum()).collect()
    }

    /// Luminance from `direction`, CIE 1931 [cd m-2]; integrates at 1 nm, so for tests and printing.
    fn luminance(&self, direction: DVec3) -> f64 {
        let wavelengths: Vec<f64> = super::photometry::visible_nm().collect();
        super::photometry::luminous(&self.radiance(direction, &wavelengths))
    }
}
