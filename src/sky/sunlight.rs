//! The light of the Sun over a place: what of it is outside the air, what reaches the observer directly, and what an eclipse takes from both.

use super::disc::{Disc, SOLAR_LIMB_DARKENING, Surface};
use super::eclipse::{self, Gain};
use super::irradiance::{Nodes, diffuse_horizontal};
use super::place_and_time::Sky;
use crate::error::Result;
use crate::light::LightField;
use crate::progress::Progress;

/// The Sun of a sky as a source of light.
#[derive(Clone, Copy)]
pub(super) struct Sunlight<'a> {
    sky: &'a Sky,
}

impl<'a> Sunlight<'a> {
    /// The light of the Sun of `sky`.
    pub fn of(sky: &'a Sky) -> Self {
        Self { sky }
    }

    /// Irradiance by the disc, at a total eclipse by the corona, through the air on a surface that faces it: XYZ [W m-2].
    ///
    /// # Errors
    /// As [`Self::xyz_weights`].
    pub fn direct_irradiance_xyz(&self, field: &LightField) -> Result<[f64; 3]> {
        Ok(sum_of_products(&self.direct_transmittance(field), &self.xyz_weights()?))
    }

    /// Square of 1 au over the Sun's distance.
    fn nearness(&self) -> f64 {
        self.sky.sun().distance_au.powi(-2)
    }

    /// Weights by wavelength that turn radiance per unit solar irradiance outside the air into XYZ, for the whole Sun [W m-2].
    ///
    /// # Errors
    /// As [`Atmosphere::xyz_weights`](super::Atmosphere).
    pub fn xyz_weights(&self) -> Result<Vec<[f64; 3]>> {
        let nearness = self.nearness();
        Ok(self.sky.atmosphere().xyz_weights()?.into_iter().map(|xyz| xyz.map(|w| w * nearness)).collect())
    }

    /// The same for what lights the sky: less during an eclipse.
    ///
    /// # Errors
    /// As [`Self::xyz_weights`].
    pub fn sky_weights(&self) -> Result<Vec<[f64; 3]>> {
        let share = |(xyz, uncovered): ([f64; 3], f64)| xyz.map(|w| w * eclipse::sky_share(uncovered));
        Ok(self.xyz_weights()?.into_iter().zip(self.uncovered()).map(share).collect())
    }

    /// Part of the Sun's light that the Moon does not cover, at the solved wavelengths.
    fn uncovered(&self) -> Vec<f64> {
        self.uncovered_at(&self.sky.atmosphere().profile().wavelengths_nm)
    }

    /// The same at `wavelengths_nm`.
    pub fn uncovered_at(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        self.sky
            .eclipsed_sunlight()
            .map_or_else(|| vec![1.0; wavelengths_nm.len()], |eclipse| eclipse.visible_fractions(wavelengths_nm))
    }

    /// Solar irradiance outside the air that lights the sky: less during an eclipse [W m-2 nm-1].
    pub fn sunlight_in_the_air(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        let shares = self.uncovered_at(wavelengths_nm).into_iter().map(eclipse::sky_share);
        self.sunlight(wavelengths_nm).into_iter().zip(shares).map(|(sunlight, share)| sunlight * share).collect()
    }

    /// Solar irradiance outside the air [W m-2 nm-1].
    pub fn sunlight(&self, wavelengths_nm: &[f64]) -> Vec<f64> {
        self.sky.atmosphere().solar_irradiance(wavelengths_nm).into_iter().map(|e| e * self.nearness()).collect()
    }

    /// Transmittance to the disc where it is seen, times the part that the Moon does not cover.
    fn disc_transmittance(&self, field: &LightField) -> Vec<f64> {
        let transmittance = self.sky.transmittance_towards(field, self.sky.sun().apparent_altitude_deg.to_radians());
        transmittance.iter().zip(self.uncovered()).map(|(transmittance, uncovered)| transmittance * uncovered).collect()
    }

    /// The same with the corona, where there is one to be seen.
    pub fn direct_transmittance(&self, field: &LightField) -> Vec<f64> {
        let transmittance = self.sky.transmittance_towards(field, self.sky.sun().apparent_altitude_deg.to_radians());
        let corona = self.corona_share();
        transmittance
            .iter()
            .zip(self.uncovered())
            .map(|(transmittance, uncovered)| transmittance * (uncovered + corona))
            .collect()
    }

    /// Light of the corona over that of the whole Sun; 0 where the Sun outshines it.
    fn corona_share(&self) -> f64 {
        self.sky.eclipsed_sunlight().copied().and_then(eclipse::corona).map_or(0.0, |corona| corona.irradiance_ratio())
    }

    /// Cosine of incidence of the disc on the horizontal plane.
    pub fn disc_cosine(&self) -> f64 {
        self.sky.sun().apparent_altitude_deg.to_radians().sin().max(0.0)
    }

    /// Irradiance by what is left of the disc on a surface that faces it: XYZ [W m-2].
    fn sun_irradiance_xyz(&self, field: &LightField) -> Result<[f64; 3]> {
        Ok(sum_of_products(&self.disc_transmittance(field), &self.xyz_weights()?))
    }

    /// The same without an eclipse.
    fn whole_sun_irradiance_xyz(&self, field: &LightField) -> Result<[f64; 3]> {
        let transmittance = self.sky.transmittance_towards(field, self.sky.sun().apparent_altitude_deg.to_radians());
        Ok(sum_of_products(&transmittance, &self.xyz_weights()?))
    }

    /// Irradiance of the horizontal plane by the sky per unit of what [`eclipse::sky_share`] leaves of sunlight, by wavelength.
    pub fn diffuse_horizontal(&self, field: &LightField, nodes: Nodes, progress: &Progress) -> Result<Vec<f64>> {
        let uncovered = self.uncovered_at(&[eclipse::MIDDLE_NM])[0];
        diffuse_horizontal(field, &self.sky.observer(), nodes, |altitude| eclipse::gain_of_sky(uncovered, altitude), progress)
    }

    /// What an eclipse of the Sun, if there is one, does to sky and ground beside dimming them alike.
    pub fn gain_under_eclipse(&self, field: &LightField, progress: &Progress) -> Result<Option<Gain>> {
        let Some(eclipse) = self.sky.eclipsed_sunlight() else { return Ok(None) };
        let off_middle = |wavelength: f64| (wavelength - eclipse::MIDDLE_NM).abs();
        let nodes = self.sky.atmosphere().profile().wavelengths_nm.iter().enumerate();
        let middle = nodes.min_by(|a, b| off_middle(*a.1).total_cmp(&off_middle(*b.1))).map_or(0, |(node, _)| node);
        let uncovered = eclipse.visible_fraction(eclipse::MIDDLE_NM);
        let sky = diffuse_horizontal(field, &self.sky.observer(), Nodes::FEW, |_| 1.0, progress)?[middle];
        let sky_left = self.diffuse_horizontal(field, Nodes::FEW, progress)?[middle] * eclipse::sky_share(uncovered);
        let sun =
            self.sky.transmittance_towards(field, self.sky.sun().apparent_altitude_deg.to_radians())[middle] * self.disc_cosine();
        let sun_left = sun * (uncovered + self.corona_share());
        let to_ground = |altitude: f64| field.ray_transmittance(self.sky.altitude_km(), altitude.sin())[middle];
        Ok(Some(Gain::new(eclipse, self.sky.horizon(), [(sun, sun_left), (sky, sky_left)], to_ground)))
    }

    /// What is seen of the Sun: its disc, or a crescent and the corona; nothing below the horizon.
    ///
    /// # Errors
    /// As [`Self::xyz_weights`].
    pub fn discs(&self, field: &LightField) -> Result<Vec<Disc>> {
        let horizontal_radius =
            (self.sky.atmosphere().profile().sun_angular_radius_deg / self.sky.sun().distance_au).to_radians();
        let flattening = self.sky.refraction().flattening(self.sky.sun().altitude_deg, 2.0 * horizontal_radius.to_degrees());
        let vertical_radius = horizontal_radius * flattening;
        let irradiance = self.sun_irradiance_xyz(field)?;
        let whole = self.whole_sun_irradiance_xyz(field)?;
        let hidden = self.sky.sun().apparent_altitude_deg.to_radians() + vertical_radius <= self.sky.horizon();
        if hidden || whole[1] <= 0.0 || horizontal_radius <= 0.0 {
            return Ok(Vec::new());
        }
        let direction = self.sky.sun().apparent_direction();
        let surface = Surface::LimbDarkened(SOLAR_LIMB_DARKENING);
        let disc = Disc { is_sun: true, direction, horizontal_radius, vertical_radius, irradiance, surface };
        Ok(match self.sky.eclipsed_sunlight().copied() {
            None => vec![disc],
            Some(eclipse) => eclipse::discs(eclipse, &Disc { irradiance: whole, ..disc }, irradiance),
        })
    }
}

fn sum_of_products(values: &[f64], weights: &[[f64; 3]]) -> [f64; 3] {
    let mut xyz = [0.0; 3];
    for (value, weight) in values.iter().zip(weights) {
        for k in 0..3 {
            xyz[k] += value * weight[k];
        }
    }
    xyz
}
