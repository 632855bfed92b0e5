//! Keeps the irradiance of the horizontal plane in small images.
//!
//! A pixel's value is the mean radiance L of its footprint k, so the energy is exact; but the plane sees L cos(theta), and where L changes within
//! a row the product of means is not the mean of the product. What is missing,
//! ```text
//! D_j = integral of k_j L (max(cos theta, 0) - c_j) d omega,     c_j = mean of max(cos theta, 0) over k_j,
//! ```
//! is given back by moving energy D_j / (c_(j-1) - c_(j+1)) from row j + 1 to row j - 1 of the same column: energy stays, the plane gets
//! its light. For a sky that brightens sevenfold towards the horizon D is 0.6 % of the whole at 64 pixels and falls with the
//! square of the width.

use crate::projection::LatLong;

/// Gives back what is missing. `pixels` are XYZ radiances, row-major; `missing` holds D_j of X, Y and Z per pixel [W m-2].
pub(crate) fn restore_upward(image: &LatLong, pixels: &mut [f32], missing: &[f32]) {
    let stride = 3 * image.width();
    let table = image.table();
    let rows = table.iter().take_while(|row| row.theta < std::f64::consts::FRAC_PI_2).count();
    if rows < 2 {
        return;
    }
    for row in 0..table.len() {
        // The last rows that see the sky at all may lie below the plane by half a footprint.
        if table[row].mean_upward <= 0.0 {
            break;
        }
        let (above, below) = (row.saturating_sub(1).min(rows - 2), (row + 1).min(rows - 1));
        let lever = table[above].mean_upward - table[below].mean_upward;
        let (head, tail) = pixels.split_at_mut(below * stride);
        let upper = &mut head[above * stride..(above + 1) * stride];
        let lower = &mut tail[..stride];
        let shortage = &missing[row * stride..(row + 1) * stride];
        let (upper_solid_angle, lower_solid_angle) = (table[above].solid_angle, table[below].solid_angle);
        for ((high, low), &shortage) in upper.iter_mut().zip(lower).zip(shortage) {
            // Never more than a pixel has.
            let energy =
                (f64::from(shortage) / lever).clamp(-f64::from(*high) * upper_solid_angle, f64::from(*low) * lower_solid_angle);
            *high += (energy / upper_solid_angle) as f32;
            *low -= (energy / lower_solid_angle) as f32;
        }
    }
}
