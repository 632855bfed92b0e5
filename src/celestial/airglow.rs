//! Airglow: the upper atmosphere's own light at night.
//!
//! L = A [ V_90(z) (sum of lines and continuum of the mesopause) + V_250(z) (red lines of oxygen) ],
//! V_h(z) = 1 / sqrt(1 - ((R + e) sin z / (R + h))^2)   (van Rhijn 1921),
//!
//! z: zenith angle; R: radius of the Earth; e: elevation of the observer; h: 90 km for the green line, sodium, hydroxyl and the
//! continuum, 250 km for 630.0 and 636.4 nm.
//!
//! - A: such that the zenith has 112 ucd m-2 at the long-term mean S = 1.3 of the solar radio flux at 10.7 cm in MJy, and grows with it as 145 + 130 (S - 0.8) / 1.2
//!   (in S10(V), as in Benn & Ellison 1998, who find the sky 0.4 mag brighter at solar maximum; yearly means of the airglow over Mauna Kea vary more, by a factor of 4.5: Krisciunas 1997, PASP 109, 1181).
//!   The mean is what makes a natural zenith at high latitudes, between the stars and away from the Milky Way, V 21.9 to 22.0: the reference of maps of artificial light (V 22, 1.7e-4 cd m-2: Falchi et al.
//!   2016, Science Advances 2, e1600377). Measured skies scatter about it: Paranal at high activity V 21.6 +- 0.2 (Patat 2003), here 21.75; La Palma at minimum V 21.9 (Benn & Ellison 1998, New Astron. Rev.
//!   42, 503), here 22.05, which would ask for 166 ucd m-2 at the mean. Single nights differ by a factor of 2 either way: `strength`.
//! - Lines at that mean in rayleigh: OI 557.7 nm 200, Na 589.0/589.6 nm 50, OI 630.0 nm 60, 636.4 nm 20: rounded, within the range of published nights (after Leinert et al. 1998, A&AS 127, 1, on
//!   airglow). Hydroxyl bands 9-3, 6-1, 7-2 and 8-3: rounded; they hold 2 % of the
//!   luminance.
//! - Continuum (NO2, FeO, O2 bands unresolved) in rayleigh per nm: shape of the zenith spectrum of Kitt Peak at solar minimum
//!   (Neugent & Massey 2010, PASP 122, 1246) less zodiacal light, starlight and half of the bump around 595 nm, which there is
//!   partly from sodium lamps.

use super::diffuse::DiffuseLight;
use super::photometry::{add_line, luminous, visible_nm};
use crate::error::{Result, check_range};
use crate::numerics::locate_by;
use crate::units::EARTH_RADIUS_KM;
use glam::DVec3;

/// Luminance of the zenith at the long-term mean of solar activity [cd m-2].
const MEAN_ZENITH_LUMINANCE: f64 = 112e-6;

/// Height of the mesopause's and of the red lines' layer [km].
const LAYER_HEIGHTS_KM: [f64; 2] = [90.0, 250.0];

/// Smallest cosine of the angle to the layer's normal: a layer 10 km thick, seen along its tangent.
const SMALLEST_COSINE: f64 = 0.039;

/// Wavelength [nm] and photon radiance (rayleigh) of the mesopause's lines.
const LINES: [(f64, f64); 3] = [(557.73, 200.0), (589.0, 33.0), (589.6, 17.0)];

/// Wavelength [nm] and photon radiance (rayleigh) of the red oxygen lines.
const RED_LINES: [(f64, f64); 2] = [(630.03, 60.0), (636.38, 20.0)];

/// First, last wavelength [nm] and photon radiance (rayleigh) of the hydroxyl bands 9-3, 6-1, 7-2, 8-3.
const BANDS: [(f64, f64, f64); 4] = [(624.0, 634.0, 40.0), (647.0, 660.0, 30.0), (683.0, 697.0, 90.0), (723.0, 740.0, 250.0)];

/// Wavelength [nm] and photon radiance (rayleigh per nm) of the continuum.
const CONTINUUM: [(f64, f64); 17] = [
    (360.0, 1.6),
    (385.0, 1.8),
    (400.0, 2.5),
    (410.0, 3.2),
    (440.0, 3.9),
    (500.0, 4.2),
    (540.0, 4.6),
    (560.0, 5.3),
    (580.0, 6.3),
    (595.0, 7.0),
    (610.0, 6.0),
    (630.0, 5.6),
    (650.0, 5.3),
    (680.0, 5.0),
    (700.0, 5.0),
    (760.0, 5.2),
    (830.0, 5.5),
];

/// Radiance of one photon rayleigh at `wavelength_nm` [W m-2 sr-1]: 1e10 / 4 pi photons m-2 s-1 sr-1 of energy h c / lambda.
fn rayleigh(wavelength_nm: f64) -> f64 {
    const PLANCK_TIMES_LIGHT_SPEED: f64 = 6.626_070_15e-34 * 299_792_458.0;
    1e10 / (4.0 * std::f64::consts::PI) * PLANCK_TIMES_LIGHT_SPEED / (wavelength_nm * 1e-9)
}

fn continuum(wavelength_nm: f64) -> f64 {
    let (row, share) = locate_by(&CONTINUUM, |row| row.0, wavelength_nm);
    let (before, after) = (CONTINUUM[row].1, CONTINUUM[row + 1].1);
    before + (after - before) * share
}

/// Spectra of the two layers at mean activity, before they are scaled to the published brightness.
fn unscaled(wavelengths_nm: &[f64]) -> [Vec<f64>; 2] {
    let mut mesopause: Vec<f64> = wavelengths_nm.iter().map(|&w| continuum(w) * rayleigh(w)).collect();
    for (line, intensity) in LINES {
        add_line(&mut mesopause, wavelengths_nm, line, intensity * rayleigh(line));
    }
    for (first, last, intensity) in BANDS {
        // A band as a comb of 1 nm.
        let steps = (last - first) as usize;
        for i in 0..steps {
            let line = first + i as f64 + 0.5;
            add_line(&mut mesopause, wavelengths_nm, line, intensity / steps as f64 * rayleigh(line));
        }
    }
    let mut red = vec![0.0; wavelengths_nm.len()];
    for (line, intensity) in RED_LINES {
        add_line(&mut red, wavelengths_nm, line, intensity * rayleigh(line));
    }
    [mesopause, red]
}

/// Path length through a thin layer at `height_km` seen at `zenith_angle_rad` (0 to pi) from `elevation_km`, vertical = 1.
///
/// From below the layer every line of sight crosses it once (the ground, which may hide it, is not looked at). From above, only
/// lines that dip far enough do: once if they end at the ground, twice at the limb.
pub fn van_rhijn(zenith_angle_rad: f64, height_km: f64, elevation_km: f64) -> f64 {
    let (observer, layer) = (EARTH_RADIUS_KM + elevation_km, EARTH_RADIUS_KM + height_km);
    let nearest = observer * zenith_angle_rad.sin();
    let sine = nearest / layer;
    let crossings = if observer < layer {
        1.0
    } else if sine >= 1.0 || zenith_angle_rad <= std::f64::consts::FRAC_PI_2 {
        0.0
    } else if nearest < EARTH_RADIUS_KM {
        1.0
    } else {
        2.0
    };
    crossings / (1.0 - sine.min(1.0).powi(2)).sqrt().max(SMALLEST_COSINE)
}

/// The airglow over an observer. Scalars: [`van_rhijn`] of the layers at 90 and 250 km. Directions: z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Airglow {
    solar_flux_sfu: f64,
    strength: f64,
    elevation_km: f64,
}

impl Airglow {
    /// Long-term mean of the solar radio flux at 10.7 cm [solar flux units, 1e-22 W m-2 Hz-1].
    pub const MEAN_SOLAR_FLUX_SFU: f64 = 130.0;

    /// Airglow at a solar radio flux (60 to 300; 70 at minimum, 130 mean, 200 at maximum) [sfu], times `strength` (0 to 10; 1:
    /// the average night), over an observer at `elevation_m` [m].
    ///
    /// # Errors
    /// [`crate::Error::Input`] if a value is outside its range or not finite.
    pub fn new(solar_flux_sfu: f64, strength: f64, elevation_m: f64) -> Result<Self> {
        check_range("solar_flux_sfu", solar_flux_sfu, 60.0, 300.0, "sfu")?;
        check_range("airglow", strength, 0.0, 10.0, "")?;
        check_range("elevation_m", elevation_m, -1000.0, 1e6, "m")?;
        Ok(Self { solar_flux_sfu, strength, elevation_km: 0.001 * elevation_m })
    }

    /// Luminance of the zenith from the ground [cd m-2].
    pub fn zenith_luminance(&self) -> f64 {
        let growth = |flux_sfu: f64| 145.0 + 130.0 * (0.01 * flux_sfu - 0.8) / 1.2;
        self.strength * MEAN_ZENITH_LUMINANCE * growth(self.solar_flux_sfu) / growth(Self::MEAN_SOLAR_FLUX_SFU)
    }
}

impl DiffuseLight<2> for Airglow {
    fn spectra(&self, wavelengths_nm: &[f64]) -> [Vec<f64>; 2] {
        let fine: Vec<f64> = visible_nm().collect();
        let luminance: f64 = unscaled(&fine).iter().map(|part| luminous(part)).sum();
        let scale = self.zenith_luminance() / luminance;
        unscaled(wavelengths_nm).map(|part| part.into_iter().map(|value| value * scale).collect())
    }

    fn scalars(&self, direction: DVec3) -> [f64; 2] {
        let zenith_angle = direction.z.clamp(-1.0, 1.0).acos();
        LAYER_HEIGHTS_KM.map(|height| van_rhijn(zenith_angle, height, self.elevation_km))
    }
}

#[cfg(test)]
mod tests {
    use super::super::photometry::surface_brightness_of_luminance;
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn mean() -> Airglow {
        Airglow::new(Airglow::MEAN_SOLAR_FLUX_SFU, 1.0, 0.0).unwrap()
    }

    #[test]
    fn the_zenith_has_the_stated_brightness_and_grows_with_activity_as_published() {
        let zenith = |flux: f64| Airglow::new(flux, 1.0, 0.0).unwrap().luminance(DVec3::Z);
        assert!((zenith(Airglow::MEAN_SOLAR_FLUX_SFU) / MEAN_ZENITH_LUMINANCE - 1.0).abs() < 1e-3);
        // checked against: Benn & Ellison 1998: 275 S10(V) at solar maximum (S = 2.0 MJy) against 145 at minimum (0.8)
        assert!((zenith(200.0) / zenith(80.0) - 275.0 / 145.0).abs() < 1e-3);
        let magnitude = surface_brightness_of_luminance(mean().luminance(DVec3::Z));
        assert!((magnitude - 22.46).abs() < 0.02, "{magnitude}");
    }

    #[test]
    fn scaling_to_the_published_brightness_leaves_the_published_lines() {
        let fine: Vec<f64> = visible_nm().collect();
        let green = mean().spectra(&fine)[0][(558 - 360) as usize] / (rayleigh(557.73) * 0.73);
        // checked against: Leinert et al. 1998: OI 557.7 nm 250 R; Neugent & Massey 2010: 125 R at solar minimum
        assert!((125.0..250.0).contains(&green), "{green}");
        // checked against: Neugent & Massey 2010, Kitt Peak zenith at solar minimum: 4.2 R/nm at 500 nm left after zodiacal light
        // and faint stars, with some artificial light in it
        let blue = Airglow::new(80.0, 1.0, 0.0).unwrap().spectra(&[500.0])[0][0] / rayleigh(500.0);
        assert!((1.8..4.2).contains(&blue), "{blue}");
    }

    #[test]
    fn the_layer_brightens_towards_the_horizon() {
        // checked against: closed form at the horizon, 1 / sqrt(1 - (6371/6461)^2) = 6.01
        assert!((van_rhijn(FRAC_PI_2, 90.0, 0.0) - 6.01).abs() < 0.01);
        assert!((van_rhijn(FRAC_PI_2, 250.0, 0.0) - 3.67).abs() < 0.01);
        assert_eq!(van_rhijn(0.0, 90.0, 3.0), 1.0);
        assert!(van_rhijn(FRAC_PI_2, 90.0, 4.0) > van_rhijn(FRAC_PI_2, 90.0, 0.0));
        // The plane-parallel limit at small angles.
        assert!((van_rhijn(0.1, 90.0, 0.0) * 0.1f64.cos() - 1.0).abs() < 2e-3);
    }

    #[test]
    fn from_orbit_the_layer_is_below() {
        assert_eq!(van_rhijn(0.3, 90.0, 400.0), 0.0);
        assert!((van_rhijn(PI, 90.0, 400.0) - 1.0).abs() < 1e-12);
        let limb = PI - ((EARTH_RADIUS_KM + 80.0) / (EARTH_RADIUS_KM + 400.0)).asin();
        assert!(van_rhijn(limb, 90.0, 400.0) > 30.0 && van_rhijn(FRAC_PI_2, 90.0, 400.0) == 0.0);
    }

    #[test]
    fn values_outside_their_range_are_named() {
        let message = Airglow::new(10.0, 1.0, 0.0).unwrap_err().to_string();
        assert_eq!(message, "solar_flux_sfu = 10: must be a number from 60 to 300 sfu");
        assert!(Airglow::new(130.0, f64::NAN, 0.0).is_err());
    }
}
