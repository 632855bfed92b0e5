//! The analytic sky of Preetham, Shirley & Smits 1999 ("A practical analytic model for daylight", SIGGRAPH): the real-time sky of the thesis (its section 5.1 and appendix C), to compare
//! with.
//!
//! Luminance Y and chromaticity x, y each follow
//! ```text
//! v(theta, gamma) = v_zenith F(theta, gamma) / F(0, theta_s),
//! F(theta, gamma) = (1 + A exp(B / cos theta)) (1 + C exp(D gamma) + E cos^2 gamma)      (Perez et al. 1993)
//! ```
//! with theta the zenith angle, gamma the angle to the Sun, theta_s the Sun's zenith angle, and coefficients A to E of their own for Y, x and y, linear
//! in the turbidity (Preetham et al., table 2). The thesis prints its equations 40 and 41 with the F of Y; they are meant, and done here, with that of x and of y.
//!
//! Around the Sun luminance is multiplied by f = 1 + exp(c (cos gamma - 1)) (thesis, eq. 1). The thesis does not give c; here it is 5000: the factor falls to
//! 1 + 1 / e at 1.1 degrees. Below the horizon lies a Lambertian ground that is lit by the sky and the Sun. The Sun's disc is dimmed by molecules and haze as in appendix A.1 of Preetham et
//! al. and by 0.35 cm of ozone with this crate's cross-sections; mixed gases and water vapour, which take 1 % of visible light, are left out.
//!
//! The fit holds for turbidities from 2 to 10 and a Sun above the horizon. It knows neither height, nor kind of haze, nor night.

use super::disc::{Disc, SOLAR_LIMB_DARKENING, Surface};
use super::place_and_time::Sky;
use super::sky_light::SkyLight;
use crate::atmosphere::ozone;
use crate::ephemeris::Body;
use crate::error::{Error, Result, check_range};
use crate::spectrum::{solar, wavelengths, xyz_weights};
use crate::units::LUMINOUS_EFFICACY;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Coefficients A to E of Y, x and y: (slope in turbidity, value at 0). Preetham et al. 1999, appendix A.2.
const DISTRIBUTION: [[[f64; 2]; 5]; 3] = [
    [[0.1787, -1.4630], [-0.3554, 0.4275], [-0.0227, 5.3251], [0.1206, -2.5771], [-0.0670, 0.3703]],
    [[-0.0193, -0.2592], [-0.0665, 0.0008], [-0.0004, 0.2125], [-0.0641, -0.8989], [-0.0033, 0.0452]],
    [[-0.0167, -0.2608], [-0.0950, 0.0092], [-0.0079, 0.2102], [-0.0441, -1.6537], [-0.0109, 0.0529]],
];

/// Chromaticity of the zenith: rows for T^2, T, 1, columns for theta_s^3, theta_s^2, theta_s, 1. The same appendix; the thesis has them rounded (eqs. 44, 45).
const ZENITH_X: [[f64; 4]; 3] =
    [[0.00166, -0.00375, 0.00209, 0.0], [-0.02903, 0.06377, -0.03202, 0.00394], [0.11693, -0.21196, 0.06052, 0.25886]];
const ZENITH_Y: [[f64; 4]; 3] =
    [[0.00275, -0.00610, 0.00317, 0.0], [-0.04214, 0.08970, -0.04153, 0.00516], [0.15346, -0.26756, 0.06670, 0.26688]];

/// The constant c of the thesis's equation 1.
const SUN_SIZE: f64 = 5000.0;

/// Ozone of Preetham et al. [Dobson units].
const OZONE_DU: f64 = 350.0;

/// Wavelengths of the Sun's spectrum.
const WAVELENGTHS: usize = 32;

/// The sky of the model for one Sun.
#[derive(Clone, Debug)]
pub struct Preetham {
    sun: DVec3,
    /// Coefficients A to E of Y, x, y.
    distribution: [[f64; 5]; 3],
    /// Y [W m-2 sr-1] (luminance / 683), x, y at the zenith, each divided by F(0, theta_s).
    scale: [f64; 3],
    ground: [f32; 3],
    disc: Disc,
}

/// Luminance [cd m-2] and chromaticity x, y of the zenith for turbidity `t` and Sun zenith angle `theta` [radians]: thesis, eqs. 42 to 45.
fn zenith(t: f64, theta: f64) -> [f64; 3] {
    let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * theta);
    let kilocandelas = (4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192;
    let cubic = |row: &[f64; 4]| ((row[0] * theta + row[1]) * theta + row[2]) * theta + row[3];
    let chromaticity = |rows: &[[f64; 4]; 3]| (cubic(&rows[0]) * t + cubic(&rows[1])) * t + cubic(&rows[2]);
    [1000.0 * kilocandelas, chromaticity(&ZENITH_X), chromaticity(&ZENITH_Y)]
}

/// F of the module's documentation, for the cosine of theta (0 to 1), gamma [radians] and its cosine.
fn perez([a, b, c, d, e]: [f64; 5], cosine: f64, gamma: f64, gamma_cosine: f64) -> f64 {
    (1.0 + a * (b / cosine).exp()) * (1.0 + c * (d * gamma).exp() + e * gamma_cosine * gamma_cosine)
}

impl Preetham {
    /// The sky under `sun` at `turbidity`, over a ground of the albedos `ground_albedo` for X, Y and Z (0 to 1). `angular_radius` is that of the Sun's disc [radians].
    ///
    /// # Errors
    /// [`Error::Input`] for a turbidity outside 2 to 10, or a Sun below the horizon.
    pub fn new(turbidity: f64, sun: &Body, angular_radius: f64, ground_albedo: [f64; 3]) -> Result<Self> {
        check_range("turbidity", turbidity, 2.0, 10.0, "with model = preetham")?;
        if sun.altitude_deg < 0.0 {
            return Err(Error::input(
                "model",
                format!("preetham with the Sun at {:.3} degrees", sun.altitude_deg),
                "scattering for a Sun below the horizon",
            ));
        }
        let theta = (90.0 - sun.altitude_deg).to_radians();
        let distribution = DISTRIBUTION.map(|rows| rows.map(|[slope, value]| slope * turbidity + value));
        let mut scale = zenith(turbidity, theta);
        scale[0] /= LUMINOUS_EFFICACY;
        for (scale, coefficients) in scale.iter_mut().zip(distribution) {
            *scale /= perez(coefficients, 1.0, theta, theta.cos());
        }
        let nodes = wavelengths(WAVELENGTHS);
        let weights = xyz_weights(&nodes, |wavelength| solar::irradiance(wavelength, 1.0));
        let mut irradiance = [0.0; 3];
        for (transmittance, weights) in transmittance(&nodes, turbidity, sun.altitude_deg).iter().zip(weights) {
            for (sum, weight) in irradiance.iter_mut().zip(weights) {
                *sum += transmittance * weight * sun.distance_au.powi(-2);
            }
        }
        let disc = Disc {
            is_sun: true,
            direction: sun.apparent_direction(),
            horizontal_radius: angular_radius,
            vertical_radius: angular_radius,
            irradiance,
            surface: Surface::LimbDarkened(SOLAR_LIMB_DARKENING),
        };
        let mut sky = Self { sun: sun.direction(), distribution, scale, ground: [0.0; 3], disc };
        let (sky_light, upward) = (sky.diffuse_horizontal(), sky.disc.direction.z.max(0.0));
        sky.ground = [0, 1, 2].map(|k| (ground_albedo[k] / PI * (sky_light[k] + upward * irradiance[k])) as f32);
        Ok(sky)
    }

    /// XYZ [W m-2 sr-1] towards a direction above the horizon.
    fn radiance(&self, direction: DVec3) -> [f64; 3] {
        let cosine = direction.dot(self.sun).clamp(-1.0, 1.0);
        let gamma = cosine.acos();
        let [luminance, x, y] =
            [0, 1, 2].map(|k| self.scale[k] * perez(self.distribution[k], direction.z.max(0.0), gamma, cosine));
        let luminance = luminance.max(0.0) * (1.0 + (SUN_SIZE * (cosine - 1.0)).exp());
        [luminance * x / y, luminance, luminance * (1.0 - x - y) / y]
    }

    /// Irradiance of the horizontal plane by the sky: XYZ [W m-2].
    fn diffuse_horizontal(&self) -> [f64; 3] {
        const CIRCLES: usize = 48;
        const AZIMUTHS: usize = 96;
        let mut sum = [0.0; 3];
        for circle in 0..CIRCLES {
            // Equal shares of cos^2: each direction lights the plane alike.
            let cosine = ((circle as f64 + 0.5) / CIRCLES as f64).sqrt();
            for k in 0..AZIMUTHS {
                let azimuth = TAU * (k as f64 + 0.5) / AZIMUTHS as f64;
                let direction = ((1.0 - cosine * cosine).sqrt() * DVec3::new(azimuth.sin(), azimuth.cos(), 0.0)).with_z(cosine);
                let radiance = self.radiance(direction);
                (0..3).for_each(|k| sum[k] += radiance[k] * PI / (CIRCLES * AZIMUTHS) as f64);
            }
        }
        sum
    }
}

/// Transmittance to the Sun at `altitude_deg` by wavelength: Preetham et al. 1999, appendix A.1, with the relative optical mass there.
fn transmittance(wavelengths_nm: &[f64], turbidity: f64, altitude_deg: f64) -> Vec<f64> {
    let mass = 1.0 / (altitude_deg.to_radians().sin() + 0.15 * (3.885 + altitude_deg).powf(-1.253));
    let haze = 0.04608 * turbidity - 0.04586;
    let ozone = ozone::optical_depth(wavelengths_nm, OZONE_DU);
    let depth = |(&wavelength, ozone): (&f64, &f64)| {
        let micrometres = wavelength / 1000.0;
        0.008735 * micrometres.powf(-4.08) + haze * micrometres.powf(-1.3) + ozone
    };
    wavelengths_nm.iter().zip(&ozone).map(|pair| (-mass * depth(pair)).exp()).collect()
}

/// The analytic sky of Preetham et al. for this Sun, turbidity and ground.
///
/// # Errors
/// [`Error::Input`] for air given as a profile, which has no turbidity, and as [`Preetham::new`].
pub(super) fn preetham(sky: &Sky) -> Result<Preetham> {
    let atmosphere = sky.atmosphere();
    let Some(parameters) = atmosphere.parameters() else {
        return Err(Error::input("model", "preetham", "scattering for air given as a profile: it has no turbidity"));
    };
    let profile = atmosphere.profile();
    let radius = (profile.sun_angular_radius_deg / sky.sun().distance_au).to_radians();
    let weights = xyz_weights(&profile.wavelengths_nm, |wavelength| solar::irradiance(wavelength, 1.0));
    let mean = |k: usize| {
        let (sum, total) = weights
            .iter()
            .zip(&profile.ground_albedo)
            .fold((0.0, 0.0), |(sum, total), (weight, albedo)| (sum + weight[k] * albedo, total + weight[k]));
        sum / total
    };
    Preetham::new(parameters.resolve()?.turbidity, sky.sun(), radius, [mean(0), mean(1), mean(2)])
}

impl SkyLight for Preetham {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        if altitude < 0.0 {
            out.fill(self.ground);
            return;
        }
        let (sine, cosine) = altitude.min(FRAC_PI_2).sin_cos();
        for (out, azimuth) in out.iter_mut().zip(azimuths) {
            let direction = DVec3::new(cosine * azimuth.sin(), cosine * azimuth.cos(), sine);
            *out = self.radiance(direction).map(|value| value as f32);
        }
    }

    fn horizon_altitude(&self) -> f64 {
        0.0
    }

    fn discs(&self) -> Vec<Disc> {
        vec![self.disc.clone()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ephemeris::{Refraction, sun_at};

    fn sun(altitude_deg: f64) -> Body {
        sun_at(altitude_deg, 180.0, &Refraction::none()).unwrap()
    }

    fn sky(turbidity: f64, altitude_deg: f64) -> Preetham {
        Preetham::new(turbidity, &sun(altitude_deg), 0.00465, [0.2; 3]).unwrap()
    }

    fn seen(sky: &Preetham, altitude_deg: f64, azimuth_deg: f64) -> [f64; 3] {
        let mut out = [[0.0; 3]];
        sky.radiance_circle(f64::to_radians(altitude_deg), &[f64::to_radians(azimuth_deg)], &mut out);
        out[0].map(f64::from)
    }

    #[test]
    fn the_zenith_has_the_luminance_and_colour_of_the_formulas() {
        // Eqs. 42 to 45 of the thesis at T = 3, theta_s = 60 degrees: chi = (4/9 - 3/120) pi / 3 = 0.439248,
        // Y = (12.1359 - 4.9710) tan(chi) - 0.6465 + 2.4192 = 5.1392 kcd m-2; with the five decimals of Preetham et al. x = 0.24493, y = 0.25257.
        let [x, y, z] = seen(&sky(3.0, 30.0), 90.0, 0.0);
        assert!((y * 683.0 / 1000.0 - 5.1392).abs() < 5e-4, "{}", y * 0.683);
        let sum = x + y + z;
        assert!((x / sum - 0.244_93).abs() < 1e-5 && (y / sum - 0.252_57).abs() < 1e-5, "{} {}", x / sum, y / sum);
    }

    #[test]
    fn away_from_the_zenith_each_of_luminance_x_and_y_has_its_own_distribution() {
        let model = sky(4.0, 40.0);
        let at = |altitude_deg: f64, azimuth_deg: f64| {
            let [x, y, z] = seen(&model, altitude_deg, azimuth_deg);
            [y, x / (x + y + z), y / (x + y + z)]
        };
        let (zenith, low) = (at(90.0, 0.0), at(20.0, 0.0));
        // theta = 70 degrees, gamma = 120 degrees; the zenith's gamma is 50 degrees.
        let coefficients = [
            [-0.7482, -0.9941, 5.2343, -2.0947, 0.1023],
            [-0.3364, -0.2652, 0.2109, -1.1553, 0.0320],
            [-0.3276, -0.3708, 0.1786, -1.8301, 0.0093],
        ];
        for k in 0..3 {
            let [a, b, c, d, e] = coefficients[k];
            let f = |theta: f64, gamma: f64| {
                let (theta, gamma) = (theta.to_radians(), gamma.to_radians());
                (1.0 + a * (b / theta.cos()).exp()) * (1.0 + c * (d * gamma).exp() + e * gamma.cos().powi(2))
            };
            let expected = f(70.0, 120.0) / f(0.0, 50.0);
            assert!((low[k] / zenith[k] / expected - 1.0).abs() < 1e-5, "{k}: {} {expected}", low[k] / zenith[k]);
        }
    }

    #[test]
    fn the_sun_factor_doubles_the_light_at_the_sun_and_is_gone_ten_degrees_away() {
        let model = sky(2.5, 45.0);
        let plain = |altitude_deg: f64| {
            let gamma = f64::to_radians(altitude_deg - 45.0).abs();
            model.scale[0] * perez(model.distribution[0], f64::to_radians(altitude_deg).sin(), gamma, gamma.cos())
        };
        assert!((seen(&model, 45.0, 180.0)[1] / plain(45.0) - 2.0).abs() < 1e-5);
        assert!((seen(&model, 55.0, 180.0)[1] / plain(55.0) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn daylight_has_the_brightness_of_daylight() {
        // A clear noon: direct sunlight of some 90 klx on a plane that faces it, a blue sky of 10 to 20 klx; haze takes from one and gives to the other.
        let (clear, hazy) = (sky(2.2, 60.0), sky(6.0, 60.0));
        let lx = |values: [f64; 3]| 683.0 * values[1];
        let (direct, diffuse) = (lx(clear.disc.irradiance), lx(clear.diffuse_horizontal()));
        assert!((80e3..115e3).contains(&direct) && (8e3..25e3).contains(&diffuse), "{direct} {diffuse}");
        assert!(lx(hazy.disc.irradiance) < 0.75 * direct && lx(hazy.diffuse_horizontal()) > 1.3 * diffuse);
        let [x, y, z] = clear.ground.map(f64::from);
        let expected = 0.2 / PI * (clear.diffuse_horizontal()[1] + clear.disc.irradiance[1] * clear.disc.direction.z);
        assert!((y / expected - 1.0).abs() < 1e-6 && x > 0.0 && z > 0.0);
    }

    #[test]
    fn transmittance_is_that_of_the_appendix() {
        // checked against: tau_r = exp(-0.008735 l^-4.08 m), tau_a = exp(-beta l^-1.3 m) at 550 nm, m = 1 (Sun in the zenith, 1.0003), T = 2: 0.1001 and 0.1005; ozone 0.03
        let depth = -transmittance(&[540.0, 550.0, 560.0], 2.0, 90.0)[1].ln();
        assert!((depth - (0.1001 + 0.1007) - 0.030).abs() < 0.004, "{depth}");
    }

    #[test]
    fn what_the_fit_does_not_hold_is_refused() {
        let message = |turbidity: f64, altitude_deg: f64| {
            Preetham::new(turbidity, &sun(altitude_deg), 0.00465, [0.0; 3]).unwrap_err().to_string()
        };
        assert!(message(1.9, 30.0).starts_with("turbidity = 1.9: must be a number from 2 to 10"));
        assert!(message(f64::NAN, 30.0).starts_with("turbidity = NaN"));
        assert!(message(3.0, -0.1).starts_with("model = preetham with the Sun at -0.100 degrees"));
        for turbidity in [2.0, 5.0, 10.0] {
            for altitude in [0.0, 1.0, 10.0, 90.0] {
                let model = sky(turbidity, altitude);
                for at in [0.0, 0.01, 0.3, 3.0, 30.0, 90.0] {
                    assert!(seen(&model, at, 100.0).iter().all(|v| v.is_finite() && *v >= 0.0), "{turbidity} {altitude} {at}");
                }
            }
        }
    }
}
