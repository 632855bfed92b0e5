//! Height of the land above the sea anywhere: a default where nothing better is known.
//!
//! `data/terrain.png` has means over 10 arcminutes (18 km) in steps of 28 m, of many open elevation models put together by Mapzen, from the
//! map in pvlib; between the cells it is bilinear. It knows neither valleys nor peaks. From the elevations of 166 000 places in GeoNames it
//! differs by 38 m in the median, by 236 m in one place of ten, by 700 m in one of a hundred, and is 63 m higher on average, because people live
//! in valleys. In Greenland it has the rock under the ice, up to 3000 m too low; in Lake Superior the bottom; of Antarctica's coast north of 70 degrees
//! south much is missing, south of 85 degrees it has the values of that latitude.

use crate::error::{Result, check_range};
use std::sync::LazyLock;

const STEP_M: f64 = 28.0;
const LOWEST_M: f64 = -450.0;

struct Terrain {
    width: usize,
    height: usize,
    /// Row by row from 90 to -90, each from -180 to 180 degrees: 0 is the sea.
    pixels: Vec<u8>,
}

static TERRAIN: LazyLock<Terrain> = LazyLock::new(|| {
    let picture = image::load_from_memory_with_format(include_bytes!("../../data/terrain.png"), image::ImageFormat::Png)
        .expect("the embedded map is a picture")
        .into_luma8();
    Terrain { width: picture.width() as usize, height: picture.height() as usize, pixels: picture.into_raw() }
});

impl Terrain {
    fn cell(&self, row: usize, column: usize) -> f64 {
        match self.pixels[row * self.width + column % self.width] {
            0 => 0.0,
            pixel => LOWEST_M + STEP_M * f64::from(pixel - 1),
        }
    }

    fn elevation_m(&self, latitude_deg: f64, longitude_deg: f64) -> f64 {
        let row = ((90.0 - latitude_deg) / 180.0 * self.height as f64 - 0.5).clamp(0.0, (self.height - 1) as f64);
        // Half a cell west of the first column is the middle between the last and the first.
        let column = (longitude_deg + 180.0) / 360.0 * self.width as f64 - 0.5 + self.width as f64;
        let (top, left) = (row as usize, column as usize);
        let (down, right) = (row.fract(), column.fract());
        let bottom = (top + 1).min(self.height - 1);
        let along = |row: usize| self.cell(row, left) * (1.0 - right) + self.cell(row, left + 1) * right;
        along(top) * (1.0 - down) + along(bottom) * down
    }
}

/// Rough height of the land above the sea at coordinates [degrees]: [m], 0 at sea. A peak may be 2000 m higher.
///
/// # Errors
/// [`crate::Error::Input`] for `latitude` outside -90 to 90 or `longitude` outside -180 to 180 degrees.
pub fn elevation_m(latitude_deg: f64, longitude_deg: f64) -> Result<f64> {
    check_range("latitude", latitude_deg, -90.0, 90.0, "degrees")?;
    check_range("longitude", longitude_deg, -180.0, 180.0, "degrees")?;
    let height_m = TERRAIN.elevation_m(latitude_deg, longitude_deg);
    // Within a step of the map below the sea, flat coasts are meant.
    Ok(if height_m < 0.0 { (height_m + STEP_M).min(0.0) } else { height_m })
}

#[cfg(test)]
mod tests {
    use super::super::gazetteer::{GAZETTEER, PlaceKind};
    use super::*;

    #[test]
    fn wide_plains_and_plateaus_have_their_published_height() {
        // checked against: Salar de Uyuni 3656 m, Qinghai Lake 3196 m, Great Salt Lake 1280 m, Lake Victoria 1134 m,
        // Lake Titicaca 3812 m, middle of the Atlantic 0 m
        for (latitude, longitude, published_m, within_m) in [
            (-20.2, -67.6, 3656.0, 20.0),
            (36.9, 100.2, 3196.0, 20.0),
            (41.1, -112.5, 1280.0, 20.0),
            (-1.0, 33.0, 1134.0, 20.0),
            (-15.8, -69.4, 3812.0, 20.0),
            (30.0, -40.0, 0.0, 0.0),
        ] {
            let height_m = elevation_m(latitude, longitude).unwrap();
            assert!(
                (height_m - published_m).abs() <= within_m,
                "{latitude}, {longitude}: {height_m} m, published {published_m} m"
            );
        }
    }

    /// The figures that the module states.
    #[test]
    fn it_differs_from_the_elevations_of_places_as_stated() {
        let gazetteer = &*GAZETTEER;
        let towns = (0..gazetteer.rows.len()).map(|index| gazetteer.place(index)).filter(|place| place.kind == PlaceKind::Town);
        let mut differences: Vec<f64> = towns
            .map(|place| TERRAIN.elevation_m(place.latitude_deg, place.longitude_deg) - place.elevation_m)
            .map(f64::abs)
            .collect();
        differences.sort_unstable_by(f64::total_cmp);
        let quantile = |share: f64| differences[(share * differences.len() as f64) as usize];
        let (half, tenth, hundredth) = (quantile(0.5), quantile(0.9), quantile(0.99));
        assert!((30.0..40.0).contains(&half), "{half}");
        assert!((200.0..240.0).contains(&tenth), "{tenth}");
        assert!((600.0..710.0).contains(&hundredth), "{hundredth}");
    }

    #[test]
    fn a_flat_coast_is_not_below_the_sea_but_the_dead_sea_is() {
        // Sydney, and the middle of the Netherlands.
        for (latitude, longitude) in [(-33.87, 151.21), (52.4, 5.0)] {
            assert!((0.0..60.0).contains(&elevation_m(latitude, longitude).unwrap()));
        }
        assert!(elevation_m(31.08, 35.42).unwrap() < -200.0);
    }

    #[test]
    fn it_is_continuous_over_the_date_line_and_defined_at_the_poles() {
        for latitude in [-89.99, -75.0, 16.0, 68.0, 90.0] {
            let [west, east] = [-180.0, 180.0].map(|longitude| elevation_m(latitude, longitude).unwrap());
            assert!((west - east).abs() < 1e-9, "{latitude}: {west} {east}");
        }
        assert!(elevation_m(90.1, 0.0).is_err());
        assert!(elevation_m(0.0, f64::INFINITY).is_err());
    }
}
