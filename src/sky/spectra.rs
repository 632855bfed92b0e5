//! What arrives at the observer of a sky, by wavelength: radiance and Stokes parameters by direction, irradiance.

use super::air_light::{AirLight, air_lights, moon_in_the_air};
use super::eclipse::Gain;
use super::irradiance::{Irradiance, Nodes, diffuse_horizontal};
use super::night::{diffuse_radiance, horizontal_without_moonlight, moon_by_wavelength};
use super::place_and_time::Sky;
use super::sunlight::Sunlight;
use crate::ephemeris::{Body, horizontal_from_direction};
use crate::error::{Error, Result, check_finite};
use crate::light::{Gathered, LightField, Segments, transverse};
use crate::numerics::CubicSpline;
use crate::progress::Progress;
use glam::DVec3;
use rayon::prelude::*;

impl Sky {
    /// Spectral radiance of sky and ground towards unit vectors `directions` (east, north, up) at `wavelengths_nm`: shape (directions, wavelengths), row-major [W m-2 sr-1 nm-1]. Discs (Sun, Moon)
    /// and points (stars, planets) have no radiance in a direction and are not in it; all else that pictures have by [`Self::night`] is: light of the Sun and of the Moon in the air, zodiacal light,
    /// Milky Way, airglow, light of towns. A sky without place and time is lit by the Sun alone.
    ///
    /// Light of bodies and of the night are means over 10 nm ([`crate::spectrum::solar::BAND_WIDTH_NM`]). Between the solved wavelengths what the air does to them is interpolated.
    ///
    /// # Errors
    /// [`Error::Input`] for directions that are not unit vectors and wavelengths that were not solved; [`Error::Cancelled`].
    pub fn spectral_radiance(&self, directions: &[DVec3], wavelengths_nm: &[f64], progress: &Progress) -> Result<Vec<f64>> {
        self.atmosphere().check_wavelengths(wavelengths_nm)?;
        check_directions(directions)?;
        let field = self.field(progress)?;
        let mut lights = Vec::new();
        for light in air_lights(self, field, wavelengths_nm, progress)? {
            let rows = self.gather_each(field, &light, directions, progress, |gathered, look| {
                let relative: Vec<f64> = (0..gathered.wavelengths).map(|w| field.radiance(gathered, 0, w, look.cosine)).collect();
                check_finite("the radiance", &relative)?;
                let absolute = self.at_wavelengths(&relative, wavelengths_nm, &light.irradiance);
                Ok(absolute.iter().map(|value| value * look.gain).collect::<Vec<_>>())
            })?;
            lights.push(rows.into_iter().collect::<Result<Vec<_>>>()?.concat());
        }
        lights.extend(diffuse_radiance(self, field, directions, wavelengths_nm, progress)?);
        Ok(sum_of(lights))
    }

    /// Stokes parameters I, Q, U of the sky in `directions` at `wavelengths_nm` [W m-2 sr-1 nm-1], row-major, shape (directions, wavelengths, 3), of the light of [`Self::spectral_radiance`],
    /// which is I. Directions are unit vectors (east, north, up). Q > 0 is polarised vertically, in the plane of view direction and zenith; U > 0 along the direction
    /// 45 degrees clockwise from the vertical as the observer sees it. Zodiacal light, Milky Way, airglow and light of towns are taken as unpolarised.
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
        let nodes = &self.atmosphere().profile().wavelengths_nm;
        let mut lights = Vec::new();
        for light in air_lights(self, field, wavelengths_nm, progress)? {
            let rows = self.gather_each(field, &light, directions, progress, |gathered, look| {
                let stokes: Vec<[f64; 3]> =
                    (0..gathered.wavelengths).map(|w| field.stokes(gathered, 0, w, look.transverse, look.cosine)).collect();
                check_finite("the light", stokes.as_flattened())?;
                let relative: Vec<f64> = stokes.iter().map(|s| s[0]).collect();
                let radiance = self.at_wavelengths(&relative, wavelengths_nm, &light.irradiance);
                // The degree of polarisation is what is smooth over wavelength and may be negative.
                let [q, u] = [1, 2].map(|k| {
                    CubicSpline::new(
                        nodes,
                        &stokes.iter().map(|s| if s[0] > 0.0 { s[k] / s[0] } else { 0.0 }).collect::<Vec<_>>(),
                    )
                });
                let at = |(&wavelength, i): (&f64, f64)| {
                    [i, i * q.value(wavelength), i * u.value(wavelength)].map(|value| value * look.gain)
                };
                Ok(wavelengths_nm.iter().zip(radiance).flat_map(at).collect::<Vec<f64>>())
            })?;
            lights.push(rows.into_iter().collect::<Result<Vec<_>>>()?.concat());
        }
        let unpolarised = diffuse_radiance(self, field, directions, wavelengths_nm, progress)?;
        lights.extend(unpolarised.map(|radiance| radiance.into_iter().flat_map(|i| [i, 0.0, 0.0]).collect()));
        Ok(sum_of(lights))
    }

    /// Gathers the light of `light` in each direction and takes what `result` makes of it.
    pub(super) fn gather_each<T: Send>(
        &self,
        field: &LightField,
        light: &AirLight,
        directions: &[DVec3],
        progress: &Progress,
        result: impl Fn(&Gathered, &Look) -> T + Sync,
    ) -> Result<Vec<T>> {
        let observer = self.observer_under(light.body);
        let parts = progress.parts("gather", directions.len());
        directions
            .par_iter()
            .map(|direction| {
                let look = self.look(direction.normalize(), light.body, light.gain.as_ref());
                let value = result(&field.gather(&observer, look.mu, &[look.azimuth]), &look);
                parts.finish_one()?;
                Ok(value)
            })
            .collect()
    }

    /// Where a unit vector looks relative to `body`, whose light in the air has a `gain`.
    fn look(&self, direction: DVec3, body: &Body, gain: Option<&Gain>) -> Look {
        let mu = direction.z.clamp(-1.0, 1.0);
        // Counterclockwise from the body, against the compass.
        let azimuth = (body.azimuth_deg - horizontal_from_direction(direction).1).to_radians();
        Look {
            mu,
            azimuth,
            cosine: direction.dot(body.direction()),
            transverse: transverse(mu, azimuth, self.observer_under(body).sun_zenith),
            gain: gain.map_or(1.0, |gain| gain.at(mu.asin())),
        }
    }

    /// The light of parts of the lines of sight along unit vectors `directions` (east, north, up): from the observer to each of `distances_m` (0 to infinity, in any order), at `wavelengths_nm`. A
    /// line ends on the ground or in space. With a surface of radiance L at a distance, what is seen is L x transmittance + in-scattered radiance.
    ///
    /// The transmittance is that of light that is neither scattered nor absorbed; what haze turns into a line of sight is in-scattered light, with the light that this sky has along the line. It is light of the
    /// Sun and, at night, of the Moon: what the air scatters of stars, airglow and towns is left out. [`Self::has_more_than_sunlight`] tells whether this sky has such light.
    ///
    /// # Errors
    /// As [`Self::spectral_radiance`]; [`Error::Input`] for distances that are negative or no numbers.
    pub fn segment(
        &self,
        directions: &[DVec3],
        distances_m: &[f64],
        wavelengths_nm: &[f64],
        progress: &Progress,
    ) -> Result<SegmentLight> {
        self.atmosphere().check_wavelengths(wavelengths_nm)?;
        check_directions(directions)?;
        if let Some((index, distance)) =
            distances_m.iter().enumerate().find(|(_, distance)| distance.is_nan() || **distance < 0.0)
        {
            return Err(Error::input(format!("distances_m[{index}]"), distance, "0 m or more, or infinity"));
        }
        let mut order: Vec<usize> = (0..distances_m.len()).collect();
        order.sort_by(|&a, &b| distances_m[a].total_cmp(&distances_m[b]));
        let ascending_km: Vec<f64> = order.iter().map(|&index| distances_m[index] / 1000.0).collect();
        let field = self.field(progress)?;
        let lights = air_lights(self, field, wavelengths_nm, progress)?;
        let whole = vec![1.0; wavelengths_nm.len()];
        let parts = progress.parts("gather", directions.len());
        let of = |segments: &mut Segments, direction: &DVec3| -> Result<[Vec<f64>; 2]> {
            let row = order.len() * wavelengths_nm.len();
            let [mut transmittance, mut radiance] = [vec![0.0; row], vec![0.0; row]];
            for light in &lights {
                let look = self.look(direction.normalize(), light.body, light.gain.as_ref());
                field.segments(&self.observer_under(light.body), look.mu, &[look.azimuth], &ascending_km, segments);
                for (ascending, &index) in order.iter().enumerate() {
                    let places = index * wavelengths_nm.len()..(index + 1) * wavelengths_nm.len();
                    let passing = self.at_wavelengths(segments.transmittance(ascending), wavelengths_nm, &whole);
                    transmittance[places.clone()].iter_mut().zip(passing).for_each(|(out, value)| *out = value.min(1.0));
                    let relative = segments.radiance(0, ascending);
                    check_finite("the in-scattered light", relative)?;
                    if relative.iter().any(|&value| value > 0.0) {
                        let scattered = self.at_wavelengths(relative, wavelengths_nm, &light.irradiance);
                        radiance[places].iter_mut().zip(scattered).for_each(|(sum, value)| *sum += value * look.gain);
                    }
                }
            }
            parts.finish_one()?;
            Ok([transmittance, radiance])
        };
        let rows = directions.par_iter().map_init(Segments::default, of).collect::<Result<Vec<_>>>()?;
        let (transmittance, in_scattered): (Vec<_>, Vec<_>) = rows.into_iter().map(|[t, l]| (t, l)).unzip();
        Ok(SegmentLight { transmittance: transmittance.concat(), in_scattered_radiance: in_scattered.concat() })
    }

    /// Spectral irradiance at `wavelengths_nm` by the Sun (at a total eclipse by its corona), by the Moon and by the sky: what [`Self::illuminance`] is of. By day planets, a billionth of the light, are
    /// left out of it. A sky without place and time is lit by the Sun alone.
    ///
    /// # Errors
    /// [`Error::Input`] for wavelengths that were not solved; [`Error::Cancelled`].
    pub fn irradiance(&self, wavelengths_nm: &[f64], progress: &Progress) -> Result<Irradiance> {
        self.atmosphere().check_wavelengths(wavelengths_nm)?;
        let field = self.field(progress)?;
        let sunlight = Sunlight::of(self).sunlight(wavelengths_nm);
        let transmittance = Sunlight::of(self).direct_transmittance(field);
        let direct_normal = self.at_wavelengths(&transmittance, wavelengths_nm, &sunlight);
        let by_sunlight = Sunlight::of(self).diffuse_horizontal(field, Nodes::FEW, progress)?;
        let mut diffuse =
            vec![self.at_wavelengths(&by_sunlight, wavelengths_nm, &Sunlight::of(self).sunlight_in_the_air(wavelengths_nm))];
        if let Some(moon) = moon_in_the_air(self, wavelengths_nm)? {
            let by_moonlight = diffuse_horizontal(field, &self.observer_under(moon.body), Nodes::FEW, |_| 1.0, progress)?;
            diffuse.push(self.at_wavelengths(&by_moonlight, wavelengths_nm, &moon.irradiance));
        }
        diffuse.extend(horizontal_without_moonlight(self, field, wavelengths_nm, progress)?);
        let diffuse_horizontal = sum_of(diffuse);
        let (moon_normal, moon_cosine) = moon_by_wavelength(self, field, wavelengths_nm)?;
        check_finite("the irradiance by the Sun", &direct_normal)?;
        check_finite("the irradiance by the sky", &diffuse_horizontal)?;
        let times = |values: &[f64], factor: f64| values.iter().map(|value| value * factor).collect::<Vec<_>>();
        let direct_horizontal = times(&direct_normal, Sunlight::of(self).disc_cosine());
        let moon_horizontal = times(&moon_normal, moon_cosine);
        let global_horizontal = sum_of(vec![direct_horizontal.clone(), moon_horizontal.clone(), diffuse_horizontal.clone()]);
        Ok(Irradiance { direct_normal, direct_horizontal, moon_normal, moon_horizontal, diffuse_horizontal, global_horizontal })
    }

    /// Takes values per unit irradiance of a body at the solved wavelengths to absolute values at `wavelengths_nm`, where it has the `irradiance`.
    fn at_wavelengths(&self, relative: &[f64], wavelengths_nm: &[f64], irradiance: &[f64]) -> Vec<f64> {
        let nodes = &self.atmosphere().profile().wavelengths_nm;
        // Light varies by factors with wavelength: its logarithm is what is smooth.
        let logs: Vec<f64> = relative.iter().map(|v| v.max(1e-30).ln()).collect();
        let spline = CubicSpline::new(nodes, &logs);
        wavelengths_nm
            .iter()
            .zip(irradiance)
            .map(|(&wavelength, outside)| {
                let value = match nodes.iter().position(|&node| node == wavelength) {
                    Some(node) => relative[node],
                    None => spline.value(wavelength).exp(),
                };
                value * outside
            })
            .collect()
    }
}

/// The sum, value by value, of at least one list of equal lengths.
fn sum_of(lists: Vec<Vec<f64>>) -> Vec<f64> {
    let add = |mut sum: Vec<f64>, list: Vec<f64>| {
        sum.iter_mut().zip(list).for_each(|(sum, value)| *sum += value);
        sum
    };
    lists.into_iter().reduce(add).unwrap_or_default()
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

/// The light of parts of lines of sight, row-major, shape (directions, distances, wavelengths).
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentLight {
    /// Part of the light from a distance that arrives at the observer, 0 to 1.
    pub transmittance: Vec<f64>,
    /// What the air before it scatters to the observer [W m-2 sr-1 nm-1].
    pub in_scattered_radiance: Vec<f64>,
}

/// A look direction relative to the body that lights the air.
pub(super) struct Look {
    /// Cosine of its zenith angle.
    mu: f64,
    /// Azimuth from the body, counterclockwise [radians].
    azimuth: f64,
    /// Cosine of the angle between them.
    pub cosine: f64,
    /// Components of the direction to the body across the look direction.
    pub transverse: [f64; 2],
    /// Factor on the sky's light during an eclipse of the Sun.
    gain: f64,
}
