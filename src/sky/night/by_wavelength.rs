//! The lights of the night by wavelength: the sources of pictures, seen by sensors of three bands each instead of X, Y and Z.

use super::super::irradiance::{Nodes, horizontal_irradiance};
use super::super::layers::Layers;
use super::super::options::{LayerScales, When};
use super::super::place_and_time::Sky;
use super::super::sky_light::SkyLight;
use super::points::{SeenStars, planet_points};
use super::{add_diffuse, diffuse_air, moon_disc};
use crate::error::{Result, check_finite};
use crate::light::LightField;
use crate::progress::Progress;
use crate::spectrum::Sensor;
use glam::DVec3;
use rayon::prelude::*;

/// Radiance of zodiacal light, Milky Way, airglow and light of towns from `directions` at `wavelengths_nm`, row-major [W m-2 sr-1 nm-1]; `None` where there is no night.
pub(in crate::sky) fn diffuse_radiance(
    sky: &Sky,
    field: &LightField,
    directions: &[DVec3],
    wavelengths_nm: &[f64],
    progress: &Progress,
) -> Result<Option<Vec<f64>>> {
    let Some(bodies) = sky.bodies_of_place().filter(|_| sky.is_night()) else { return Ok(None) };
    let air = diffuse_air(sky, field);
    let sensors = sky.atmosphere().bands(wavelengths_nm);
    let mut radiance = vec![0.0; directions.len() * wavelengths_nm.len()];
    let parts = progress.parts("gather", sensors.len());
    for (three, sensor) in sensors.iter().enumerate() {
        let mut layers = Layers::new(sky.horizon());
        add_diffuse(sky, bodies, &LayerScales::default(), &air, sensor, &mut layers)?;
        let rows = radiance.par_chunks_exact_mut(wavelengths_nm.len()).zip(directions);
        rows.for_each(|(row, direction)| {
            let direction = direction.normalize();
            let mut seen = [[0.0; 3]];
            layers.radiance_circle(direction.z.clamp(-1.0, 1.0).asin(), &[direction.x.atan2(direction.y)], &mut seen);
            row.iter_mut().skip(3 * three).zip(seen[0]).for_each(|(value, seen)| *value = f64::from(seen));
        });
        parts.finish_one()?;
    }
    check_finite("the light of the night", &radiance)?;
    Ok(Some(positive(radiance)))
}

/// Irradiance of the horizontal plane by all that shines at night but Moon and moonlight, stars and planets among it, at `wavelengths_nm` [W m-2 nm-1]; `None` where there is no night.
pub(in crate::sky) fn horizontal_without_moonlight(
    sky: &Sky,
    field: &LightField,
    wavelengths_nm: &[f64],
    progress: &Progress,
) -> Result<Option<Vec<f64>>> {
    let Some(bodies) = sky.bodies_of_place().filter(|_| sky.is_night()) else { return Ok(None) };
    let air = diffuse_air(sky, field);
    let sensors = sky.atmosphere().bands(wavelengths_nm);
    let stars = SeenStars::new(sky, field, bodies, sky.night().star_limit);
    let parts = progress.parts("gather", sensors.len());
    let by_sensor = |sensor: &Sensor| {
        let mut layers = Layers::new(sky.horizon());
        add_diffuse(sky, bodies, &LayerScales::default(), &air, sensor, &mut layers)?;
        let smooth = horizontal_irradiance(&layers, Nodes::FEW, 0.0, |_| 1.0);
        let planets = planet_points(sky, field, bodies, sensor)?;
        let stars = stars.points(sensor);
        let all = planets
            .iter()
            .chain(&stars)
            .fold(smooth, |sum, point| std::array::from_fn(|k| sum[k] + point.irradiance[k] * point.direction.z.max(0.0)));
        parts.finish_one().map(|()| all)
    };
    let irradiance = by_band(&sensors, wavelengths_nm.len(), by_sensor)?;
    check_finite("the irradiance by the night", &irradiance)?;
    Ok(Some(irradiance))
}

/// Irradiance by the Moon's disc through the air on a surface that faces it at `wavelengths_nm` [W m-2 nm-1], and its cosine of incidence on the horizontal plane; zero as in pictures where
/// there is no disc.
pub(in crate::sky) fn moon_by_wavelength(sky: &Sky, field: &LightField, wavelengths_nm: &[f64]) -> Result<(Vec<f64>, f64)> {
    let nothing = || (vec![0.0; wavelengths_nm.len()], 0.0);
    let Some(bodies) = sky.bodies_of_place().filter(|_| sky.night().when != When::Never) else { return Ok(nothing()) };
    let by_sensor = |sensor: &Sensor| Ok(moon_disc(sky, field, bodies, sensor)?.map_or([0.0; 3], |disc| disc.irradiance));
    let irradiance = by_band(&sky.atmosphere().bands(wavelengths_nm), wavelengths_nm.len(), by_sensor)?;
    check_finite("the irradiance by the Moon", &irradiance)?;
    Ok((irradiance, bodies.moon.body.apparent_direction().z.max(0.0)))
}

/// The responses of sensors of three bands each, as far as there are bands.
fn by_band(sensors: &[Sensor], bands: usize, of: impl Fn(&Sensor) -> Result<[f64; 3]>) -> Result<Vec<f64>> {
    let mut values = sensors.iter().map(of).collect::<Result<Vec<_>>>()?.concat();
    values.truncate(bands);
    Ok(positive(values))
}

/// Between wavelengths of the air the interpolated transmittance of a long path may be a hair below 0.
fn positive(values: Vec<f64>) -> Vec<f64> {
    values.into_iter().map(|value| value.max(0.0)).collect()
}
