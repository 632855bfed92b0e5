//! To which luminance an eye before the picture is adapted.

use super::sphere;
use crate::error::Result;
use crate::post::Picture;
use rayon::prelude::*;

/// Geometric mean of the luminance of all pixels that have any [cd m-2], as Reinhard et al. 2002 (eq. 1) take for a scene's key; pixels of a latitude-longitude picture count by their solid angle.
/// 0 for a black picture.
///
/// # Errors
/// [`Error::Input`](crate::Error::Input) for a latitude-longitude picture that is neither 2:1 nor 4:1.
pub fn mean_luminance(picture: &Picture) -> Result<f64> {
    let weights = picture.color_space.matrix_to_xyz()[1].map(|weight| weight * picture.white_luminance);
    let row_weights: Vec<f64> = match picture.grid().azimuthal() {
        Some(_) => vec![1.0; picture.height],
        None => sphere::geometry(picture)?.table().iter().map(|row| row.solid_angle).collect(),
    };
    let row_sum = |(row, weight): (&[f32], &f64)| {
        let (mut sum, mut count) = (0.0, 0.0);
        for pixel in row.as_chunks::<3>().0 {
            let luminance: f64 = (0..3).map(|c| weights[c] * f64::from(pixel[c])).sum();
            if luminance > 0.0 {
                sum += weight * luminance.ln();
                count += weight;
            }
        }
        (sum, count)
    };
    let rows = picture.pixels.par_chunks(3 * picture.width).zip(&row_weights);
    // Rows in order, so that the mean does not depend on threads.
    let (sum, count) = rows.map(row_sum).collect::<Vec<_>>().into_iter().fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
    Ok(if count > 0.0 { (sum / count).exp() } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::projection::{Rows, View};
    use crate::spectrum::ColorSpace;

    #[test]
    fn the_mean_is_geometric_weighted_by_solid_angle_and_without_black() {
        let flat = View::Perspective { horizontal_field_of_view_deg: 40.0 };
        let pixels = [[1.0f32; 3], [100.0; 3], [0.0; 3]].concat();
        let picture = Picture::new(3, 1, pixels, ColorSpace::LinRec709, 2.0, flat).unwrap();
        assert!((mean_luminance(&picture).unwrap() - 20.0).abs() < 1e-5);
        let rows = [[100.0f32; 24], [1.0; 24], [1.0; 24], [100.0; 24]].concat();
        let probe = Picture::new(8, 4, rows, ColorSpace::LinRec709, 1.0, View::LatLong { rows: Rows::Centre }).unwrap();
        // The two middle rows of four hold cos(45 degrees) of the sphere.
        let expected = 100f64.powf(1.0 - 0.5f64.sqrt());
        assert!((mean_luminance(&probe).unwrap() / expected - 1.0).abs() < 1e-6);
        let black = Picture::new(1, 1, vec![0.0; 3], ColorSpace::LinRec709, 1.0, flat).unwrap();
        assert_eq!(mean_luminance(&black).unwrap(), 0.0);
    }
}
