//! What arrives at the observer of a sky, as numbers: radiance and Stokes parameters by direction and wavelength, irradiance, illuminance.

use super::super::disc::Disc;
use super::super::eclipse;
use super::super::irradiance::{Illuminance, Irradiance, Nodes, diffuse_horizontal, horizontal_irradiance};
use super::super::layers::{Layer, LayerScales};
use super::Sky;
use super::pictured::Wanted;
use crate::ephemeris::horizontal_from_direction;
use crate::error::{Error, Result, check_finite};
use crate::light::{Gathered, LightField, transverse};
use crate::numerics::CubicSpline;
use crate::progress::Progress;
use crate::sky::SkyLight;
use crate::units::LUMINOUS_EFFICACY;
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
        self.atmosphere.check_wavelengths(wavelengths_nm)?;
        check_directions(directions)?;
        let field = self.field(progress)?;
        let sunlight = self.sunlight_in_the_air(wavelengths_nm);
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
        self.atmosphere.check_wavelengths(wavelengths_nm)?;
        check_directions(directions)?;
        if !self.atmosphere.is_polarised() {
            return Err(Error::input("polarisation", "false", "true, to know more of the light than its radiance"));
        }
        let field = self.field(progress)?;
        let sunlight = self.sunlight_in_the_air(wavelengths_nm);
        let nodes = &self.atmosphere.profile().wavelengths_nm;
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
        let sun = self.sun.direction();
        let gain = self.eclipse_gain(field, progress)?;
        let parts = progress.parts("gather", directions.len());
        directions
            .par_iter()
            .map(|direction| {
                let direction = direction.normalize();
                let mu = direction.z.clamp(-1.0, 1.0);
                // Counterclockwise from the Sun, against the compass.
                let azimuth = (self.sun.azimuth_deg - horizontal_from_direction(direction).1).to_radians();
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
        self.atmosphere.check_wavelengths(wavelengths_nm)?;
        let field = self.field(progress)?;
        let sunlight = self.sunlight(wavelengths_nm);
        let transmittance = self.direct_transmittance(field);
        let direct_normal = self.at_wavelengths(&transmittance, wavelengths_nm, &sunlight);
        let diffuse = self.diffuse_horizontal(field, Nodes::FEW, progress)?;
        let diffuse_horizontal = self.at_wavelengths(&diffuse, wavelengths_nm, &self.sunlight_in_the_air(wavelengths_nm));
        check_finite("the irradiance by the Sun", &direct_normal)?;
        check_finite("the irradiance by the sky", &diffuse_horizontal)?;
        Ok(Irradiance {
            direct_horizontal: direct_normal.iter().map(|e| e * self.disc_cosine()).collect(),
            direct_normal,
            diffuse_horizontal,
        })
    }

    /// Illuminance by the Sun (at a total eclipse by its corona), by the Moon and by the sky with all that shines in it.
    ///
    /// # Errors
    /// [`Error::Input`] if the wavelengths of the air make no colour; [`Error::Cancelled`].
    pub fn illuminance(&self, progress: &Progress) -> Result<Illuminance> {
        let (weights, sky_weights) = (self.xyz_weights()?, self.sky_weights()?);
        let field = self.field(progress)?;
        let luminous = |values: &[f64], weights: &[[f64; 3]]| {
            LUMINOUS_EFFICACY * values.iter().zip(weights).map(|(v, w)| v * w[1]).sum::<f64>()
        };
        let direct_normal_lx = luminous(&self.direct_transmittance(field), &weights);
        let direct_horizontal_lx = direct_normal_lx * self.disc_cosine();
        // Colours of some hundreds of directions, with the aureole applied exactly between them, cost a quarter of spectra in all that the integral needs.
        let dome = self.dome(field, &self.sun, sky_weights, Wanted::FROM_ABOVE, Vec::new(), progress)?;
        let uncovered = self.uncovered_at(&[eclipse::MIDDLE_NM])[0];
        let by_sunlight = horizontal_irradiance(&dome, Nodes::MANY, self.sun.azimuth_deg.to_radians(), |altitude| {
            eclipse::gain_of_sky(uncovered, altitude)
        })[1];
        let night = self.night_light(field, &LayerScales::default(), Wanted::FROM_ABOVE, progress)?;
        let moons = night.only(Layer::Moon).discs();
        // A sum of nothing would be -0.
        let by_the_moon = |cosine: fn(&Disc) -> f64| {
            moons.iter().fold(0.0, |sum, disc| sum + LUMINOUS_EFFICACY * disc.irradiance[1] * cosine(disc))
        };
        let moon_normal_lx = by_the_moon(|_| 1.0);
        let moon_horizontal_lx = by_the_moon(|disc| disc.direction.z.max(0.0));
        let diffuse_horizontal_lx =
            LUMINOUS_EFFICACY * (by_sunlight + horizontal_irradiance(&night, Nodes::FEW, 0.0, |_| 1.0)[1]);
        check_finite(
            "the illuminance",
            &[direct_normal_lx, direct_horizontal_lx, moon_normal_lx, moon_horizontal_lx, diffuse_horizontal_lx],
        )?;
        Ok(Illuminance {
            direct_normal_lx,
            direct_horizontal_lx,
            moon_normal_lx,
            moon_horizontal_lx,
            diffuse_horizontal_lx,
            global_horizontal_lx: direct_horizontal_lx + moon_horizontal_lx + diffuse_horizontal_lx,
        })
    }

    /// Irradiance of the horizontal plane by the sky per unit of what [`eclipse::sky_share`] leaves of sunlight, by wavelength.
    pub(super) fn diffuse_horizontal(&self, field: &LightField, nodes: Nodes, progress: &Progress) -> Result<Vec<f64>> {
        let uncovered = self.uncovered_at(&[eclipse::MIDDLE_NM])[0];
        diffuse_horizontal(field, &self.observer(), nodes, |altitude| eclipse::gain_of_sky(uncovered, altitude), progress)
    }

    /// Takes values per unit solar irradiance at the solved wavelengths to absolute values at `wavelengths_nm`.
    fn at_wavelengths(&self, relative: &[f64], wavelengths_nm: &[f64], sunlight: &[f64]) -> Vec<f64> {
        let nodes = &self.atmosphere.profile().wavelengths_nm;
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
