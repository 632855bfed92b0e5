//! Relative albedo of the Moon's surface: maria, highlands, rays.
//!
//! `data/moon_albedo.png`: 1024 x 512 pixels of 8 bits, reflectance = (pixel / 255)^2 up to a factor, equirectangular: longitude
//! -180 degrees at the left edge, 0 in the middle, 180 at the right, east positive (Mare Crisium at +59, 17); latitude 90 degrees at the top. Source
//! and licence: `data/README.md`.

use glam::DVec3;
use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

struct Map {
    width: usize,
    height: usize,
    /// Albedo relative to the mean over the sphere.
    albedo: Vec<f32>,
}

static MAP: LazyLock<Map> = LazyLock::new(|| {
    let picture = image::load_from_memory_with_format(include_bytes!("../../data/moon_albedo.png"), image::ImageFormat::Png)
        .expect("the embedded map is a picture")
        .into_luma8();
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let mut albedo: Vec<f32> = picture.into_raw().into_iter().map(|pixel| (f32::from(pixel) / 255.0).powi(2)).collect();
    let (mut sum, mut weights) = (0.0, 0.0);
    for (row, values) in albedo.chunks(width).enumerate() {
        let weight = ((row as f64 + 0.5) / height as f64 * PI).sin();
        sum += weight * values.iter().map(|&value| f64::from(value)).sum::<f64>();
        weights += weight * width as f64;
    }
    let mean = (sum / weights) as f32;
    albedo.iter_mut().for_each(|value| *value /= mean);
    Map { width, height, albedo }
});

/// Albedo relative to the mean over the sphere at a unit vector in the Moon's body-fixed frame: x to longitude 0 on the equator (the mean
/// direction of the Earth), y to longitude 90 degrees east, z to the north pole. Bilinear.
pub fn relative_albedo(body_fixed: DVec3) -> f64 {
    let map = &*MAP;
    let longitude = body_fixed.y.atan2(body_fixed.x);
    let latitude = body_fixed.z.clamp(-1.0, 1.0).asin();
    let column = (longitude / TAU + 0.5) * map.width as f64 - 0.5;
    let row = ((0.5 - latitude / PI) * map.height as f64 - 0.5).clamp(0.0, (map.height - 1) as f64);
    let (left, top) = (column.floor(), (row as usize).min(map.height - 2));
    let (x, y) = ((column - left) as f32, (row - top as f64) as f32);
    let width = map.width as isize;
    let at = |row: usize, column: isize| map.albedo[row * map.width + column.rem_euclid(width) as usize];
    let left = left as isize;
    let upper = at(top, left) * (1.0 - x) + at(top, left + 1) * x;
    let lower = at(top + 1, left) * (1.0 - x) + at(top + 1, left + 1) * x;
    f64::from(upper * (1.0 - y) + lower * y)
}

/// Unit vector in the body-fixed frame of a selenographic longitude (east positive) and latitude [degrees].
pub fn body_fixed(longitude_deg: f64, latitude_deg: f64) -> DVec3 {
    let (longitude, latitude) = (longitude_deg.to_radians(), latitude_deg.to_radians());
    DVec3::new(latitude.cos() * longitude.cos(), latitude.cos() * longitude.sin(), latitude.sin())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_where_the_gazetteer_has_them() {
        // checked against: IAU Gazetteer of Planetary Nomenclature, longitudes east, latitudes north
        let at = |longitude: f64, latitude: f64| relative_albedo(body_fixed(longitude, latitude));
        for (name, longitude, latitude) in [
            ("Mare Crisium", 59.1, 17.0),
            ("Mare Serenitatis", 18.0, 27.3),
            ("Mare Humorum", -38.6, -24.4),
            ("Plato", -9.4, 51.6),
            ("Grimaldi", -68.3, -5.4),
            ("Mare Moscoviense", 147.9, 27.3),
        ] {
            assert!(at(longitude, latitude) < 0.75, "{name}: {}", at(longitude, latitude));
        }
        // No mirror image: on the far side seas are few.
        for (name, longitude, latitude) in [("Mare Moscoviense", 147.9, 27.3), ("Mare Smythii", 87.5, -1.7)] {
            assert!(at(-longitude, latitude) > 1.3 * at(longitude, latitude), "{name}: {}", at(longitude, latitude));
        }
        for (name, longitude, latitude) in [("Tycho", -11.2, -43.3), ("Aristarchus", -47.5, 23.7), ("Copernicus", -20.1, 9.6)] {
            let far = at(longitude, latitude - 4.0).max(at(longitude - 4.0, latitude));
            assert!(at(longitude, latitude) > 1.15 * far, "{name}: {} {far}", at(longitude, latitude));
        }
    }

    #[test]
    fn the_mean_is_one_and_the_seam_is_closed() {
        let mut sum = 0.0;
        for row in 0..180 {
            for column in 0..360 {
                let latitude = 89.5 - f64::from(row);
                sum += latitude.to_radians().cos() * relative_albedo(body_fixed(f64::from(column) - 179.5, latitude));
            }
        }
        let mean = sum / (4.0 * PI) * (PI / 180.0).powi(2);
        assert!((mean - 1.0).abs() < 2e-3, "{mean}");
        let gap = relative_albedo(body_fixed(180.0 - 1e-7, 10.0)) - relative_albedo(body_fixed(-180.0 + 1e-7, 10.0));
        assert!(gap.abs() < 1e-4);
        assert!(relative_albedo(DVec3::Z).is_finite() && relative_albedo(DVec3::ZERO).is_finite());
    }
}
