//! What arrives at the observer of a sky, by wavelength: radiance and Stokes parameters by direction, irradiance.

use super::irradiance::{Irradiance, Nodes};
use super::place_and_time::Sky;
use super::sunlight::Sunlight;
use crate::ephemeris::horizontal_from_direction;
use crate::error::{Error, Result, check_finite};
use crate::light::{Gathered, LightField, transverse};
use crate::numerics::CubicSpline;
use crate::progress::Progress;
use glam::DVec3;
use rayon::prelude::*;

impl Sky {
    /// Spectral radiance without the Sun's disc towards unit vectors `directions` (east, north, up) at `wavelengths_nm`:
    /// shape (directions, wavelengths), row-major [W m-2 sr-1 nm-1]. Between the solved wavelengths the radiance relative to the Sun's spectrum is interpolated.
    ///
    /// It is sunlight alone: at night next to nothing. [`Self::has_more_than_sunlight`] tells whether this sky has other light.
    ///
    /// # Errors
    /// [`Error::Input`] for directions that are not unit vectors and wavelengths that were not solved; [`Error::Cancelled`].
    pub fn spectral_radiance(&self, directions: &[DVec3], wavelengths_nm: &[f64], progress: &Progress) -> Result<Vec<f64>> {
        self.atmosphere().check_wavelengths(wavelengths_nm)?;
        check_directions(directions)?;
        let field = self.field(progress)?;
        let sunlight = Sunlight::of(self).sunlight_in_the_air(wavelengths_nm);
        let rows = self.gather_each(field, directions, progress, |gathered, look| {
            let relative: Vec<f64> = (0..gathered.wavelengths).map(|w| field.radiance(gathered, 0, w, look.cosine)).collect();
            check_finite("the radiance", &relative)?;
            let absolute = self.at_wavelengths(&relative, wavelengths_nm, &sunlight);
            Ok(absolute.iter().map(|value| value * look.gain).collect::<Vec<_>>())
        })?;
        Ok(rows.into_iter().collect::<Result<Vec<_>>>()?.concat())
    }

    /// Stokes parameters I, Q, U of the sky in `directions` at `wavelengths_nm` [W m-2 sr-1 nm-1], the Sun's disc excluded, row-major, shape
    /// (directions, wavelengths, 3). Directions are unit vectors (east, north, up). Q > 0 is polarised vertically, in the plane of view direction and zenith; U > 0 along the direction
    /// 45 degrees clockwise from the vertical as the observer sees it.
    ///
    /// It is sunlight alone: at night next to nothing. [`Self::has_more_than_sunlight`] tells whether this sky has other light.
    ///
    /// # Errors
    /// As [`Self::spectral_radiance`]; [`Error::Input`] if the atmosphere was made without polarisation.
    pub fn stokes(&self, directions: &[DVec3], wavelengths_nm: &[f64], progress: &Progress) -> Result<Vec<f64>> {
        self.atmosphere().check_wavelengths(wavelengths_nm)?;
        check_directions(directions)?;
        if !self.atmosphere().is_polarised() {
            return Err(Error::input("polarisation", "false", "true, to know more of the light than its radiance"));
        }
        let field = self.field(progress)?;
        let sunlight = Sunlight::of(self).sunlight_in_the_air(wavelengths_nm);
        let nodes = &self.atmosphere().profile().wavelengths_nm;
        let rows = self.gather_each(field, directions, progress, |gathered, look| {
            let stokes: Vec<[f64; 3]> =
                (0..gathered.wavelengths).map(|w| field.stokes(gathered, 0, w, look.transverse, look.cosine)).collect();
            check_finite("the light", stokes.as_flattened())?;
            let radiance = self.at_wavelengths(&stokes.iter().map(|s| s[0]).collect::<Vec<_>>(), wavelengths_nm, &sunlight);
            // The degree of polarisation is what is smooth over wavelength and may be negative.
            let [q, u] = [1, 2].map(|k| {
                CubicSpline::new(nodes, &stokes.iter().map(|s| if s[0] > 0.0 { s[k] / s[0] } else { 0.0 }).collect::<Vec<_>>())
            });
            let at = |(&wavelength, i): (&f64, f64)| {
                [i, i * q.value(wavelength), i * u.value(wavelength)].map(|value| value * look.gain)
            };
            Ok(wavelengths_nm.iter().zip(radiance).flat_map(at).collect::<Vec<f64>>())
        })?;
        Ok(rows.into_iter().collect::<Result<Vec<_>>>()?.concat())
    }

    /// Gathers in each direction and takes what `result` makes of it.
    pub(super) fn gather_each<T: Send>(
        &self,
        field: &LightField,
        directions: &[DVec3],
        progress: &Progress,
        result: impl Fn(&Gathered, &Look) -> T + Sync,
    ) -> Result<Vec<T>> {
        let observer = self.observer();
        let sun = self.sun().direction();
        let gain = Sunlight::of(self).gain_under_eclipse(field, progress)?;
        let parts = progress.parts("gather", directions.len());
        directions
            .par_iter()
            .map(|direction| {
                let direction = direction.normalize();
                let mu = direction.z.clamp(-1.0, 1.0);
                // Counterclockwise from the Sun, against the compass.
                let azimuth = (self.sun().azimuth_deg - horizontal_from_direction(direction).1).to_radians();
                let look = Look {
                    cosine: direction.dot(sun),
                    transverse: transverse(mu, azimuth, observer.sun_zenith),
                    gain: gain.as_ref().map_or(1.0, |gain| gain.at(mu.asin())),
                };
                let value = result(&field.gather(&observer, mu, &[azimuth]), &look);
                parts.finish_one()?;
                Ok(value)
            })
            .collect()
    }

    /// Spectral irradiance by the Sun (at a total eclipse by its corona) and by the sky at `wavelengths_nm`.
    ///
    /// It is sunlight alone: at night next to nothing. [`Self::has_more_than_sunlight`] tells whether this sky has other light.
    ///
    /// # Errors
    /// [`Error::Input`] for wavelengths that were not solved; [`Error::Cancelled`].
    pub fn irradiance(&self, wavelengths_nm: &[f64], progress: &Progress) -> Result<Irradiance> {
        self.atmosphere().check_wavelengths(wavelengths_nm)?;
        let field = self.field(progress)?;
        let sunlight = Sunlight::of(self).sunlight(wavelengths_nm);
        let transmittance = Sunlight::of(self).direct_transmittance(field);
        let direct_normal = self.at_wavelengths(&transmittance, wavelengths_nm, &sunlight);
        let diffuse = Sunlight::of(self).diffuse_horizontal(field, Nodes::FEW, progress)?;
        let diffuse_horizontal =
            self.at_wavelengths(&diffuse, wavelengths_nm, &Sunlight::of(self).sunlight_in_the_air(wavelengths_nm));
        check_finite("the irradiance by the Sun", &direct_normal)?;
        check_finite("the irradiance by the sky", &diffuse_horizontal)?;
        Ok(Irradiance {
            direct_horizontal: direct_normal.iter().map(|e| e * Sunlight::of(self).disc_cosine()).collect(),
            direct_normal,
            diffuse_horizontal,
        })
    }

    /// Takes values per unit solar irradiance at the solved wavelengths to absolute values at `wavelengths_nm`.
    fn at_wavelengths(&self, relative: &[f64], wavelengths_nm: &[f64], sunlight: &[f64]) -> Vec<f64> {
        let nodes = &self.atmosphere().profile().wavelengths_nm;
        // Light varies by factors with wavelength: its logarithm is what is smooth.
        let logs: Vec<f64> = relative.iter().map(|v| v.max(1e-30).ln()).collect();
        let spline = CubicSpline::new(nodes, &logs);
        wavelengths_nm
            .iter()
            .zip(sunlight)
            .map(|(&wavelength, sun)| {
                let value = match nodes.iter().position(|&node| node == wavelength) {
                    Some(node) => relative[node],
                    None => spline.value(wavelength).exp(),
                };
                value * sun
            })
            .collect()
    }
}

fn check_directions(directions: &[DVec3]) -> Result<()> {
    match directions.iter().find(|d| !(0.999..=1.001).contains(&d.length())) {
        Some(bad) => {
            let value = format!("[{}, {}, {}]", bad.x, bad.y, bad.z);
            Err(Error::input("directions", value, "unit vectors (east, north, up)"))
        }
        None => Ok(()),
    }
}

/// A look direction relative to the Sun.
pub(super) struct Look {
    /// Cosine of the angle between them.
    pub cosine: f64,
    /// Components of the direction to the Sun across the look direction.
    pub transverse: [f64; 2],
    /// Factor on the sky's light during an eclipse of the Sun.
    gain: f64,
}
