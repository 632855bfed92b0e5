//! A polarising filter between the sky and the picture.
//!
//! Through an ideal filter whose axis stands at the angle c from the vertical (clockwise as the observer sees it) comes (I + Q cos 2c + U sin 2c) / 2. The half that any filter takes
//! is made up for, as a photographer's exposure does: what is left is I + strength (Q cos 2c + U sin 2c).

use crate::error::Result;
use crate::parameter::parameters;
use glam::DVec3;

parameters! {
    /// A polarising filter.
    #[derive(Copy)]
    pub struct PolarisingFilter in "polarising_filter", named "polarising_filter." in messages {
        /// See the sky through a polarising filter of this strength: 1 is ideal.
        strength: f64 = 1.0 => number(0.0, 1.0, "").default("1.0").option("polarising-filter", "STRENGTH")
            .more("Exposed so that unpolarised light stays as it is.");
        /// Angle of the filter's axis from the vertical, clockwise as one sees it.
        angle_deg: f64 = 0.0 => number(-180.0, 180.0, "degrees").default("0.0").option("filter-angle", "DEG");
        /// Altitude and azimuth towards which the filter is held, one piece of glass for the whole picture.
        ///
        /// In other directions it acts by its axis as it is seen from there, and with the square of the sine of the angle between axis and view less. Without it the
        /// filter turns with the view: in every direction its axis stands at the same angle from the vertical.
        #[serde(skip_serializing_if = "Option::is_none")]
        held_towards_deg: Option<[f64; 2]> = None => direction().option("filter-towards", "ALT,AZ")
            .by("it turns with the view").more("The closer one looks along its axis, the less it does.");
    }
}

impl PolarisingFilter {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`crate::Error::Input`] that names the one out of range.
    pub fn validate(&self) -> Result<()> {
        self.check_ranges()
    }

    /// What Q and U count in the direction of `altitude` and `azimuth` [radians, from north through east].
    pub(in crate::sky) fn weights(&self, altitude: f64, azimuth: f64) -> [f64; 2] {
        let angle = self.angle_deg.to_radians();
        let Some(towards) = self.held_towards_deg else {
            return [self.strength * (2.0 * angle).cos(), self.strength * (2.0 * angle).sin()];
        };
        let [up, right] = up_and_right(towards[0].to_radians(), towards[1].to_radians());
        let axis = angle.cos() * up + angle.sin() * right;
        let [up, right] = up_and_right(altitude, azimuth);
        // Along its own axis the glass is seen edge on and has no direction: towards it the filter fades out, or the picture would have a vortex there.
        let (a, b) = (axis.dot(up), axis.dot(right));
        [self.strength * (a * a - b * b), self.strength * 2.0 * a * b]
    }
}

/// Unit vectors upwards and to the right of an observer who looks towards `altitude`, `azimuth` [radians].
fn up_and_right(altitude: f64, azimuth: f64) -> [DVec3; 2] {
    let ((sine, cosine), (east, north)) = (altitude.sin_cos(), azimuth.sin_cos());
    [DVec3::new(-sine * east, -sine * north, cosine), DVec3::new(north, -east, 0.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_filter_is_one_that_turns_where_it_is_held() {
        let turning = PolarisingFilter { strength: 0.8, angle_deg: 30.0, held_towards_deg: None };
        let held = PolarisingFilter { held_towards_deg: Some([40.0, 200.0]), ..turning };
        let (a, b) = (turning.weights(0.3, 1.0), held.weights(40_f64.to_radians(), 200_f64.to_radians()));
        assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12, "{a:?} {b:?}");
        // Elsewhere its axis stands otherwise, and its strength goes with the square of the sine of the angle to the axis.
        let [up, right] = up_and_right(40_f64.to_radians(), 200_f64.to_radians());
        let axis = 30_f64.to_radians().cos() * up + 30_f64.to_radians().sin() * right;
        let view = DVec3::new(0.2_f64.cos() * 1_f64.sin(), 0.2_f64.cos() * 1_f64.cos(), 0.2_f64.sin());
        let c = held.weights(0.2, 1.0);
        assert!((c[0].hypot(c[1]) - 0.8 * (1.0 - axis.dot(view).powi(2))).abs() < 1e-12 && (c[0] - a[0]).abs() > 0.01);
        // Along the axis there is nothing left, from whichever side one comes.
        let (altitude, azimuth) = (axis.z.asin(), axis.x.atan2(axis.y));
        assert!(held.weights(altitude, azimuth).into_iter().all(|weight| weight.abs() < 1e-12));
    }

    #[test]
    fn numbers_out_of_range_are_named() {
        let message = PolarisingFilter { strength: 1.5, ..Default::default() }.validate().unwrap_err().to_string();
        assert!(message.starts_with("polarising_filter.strength = 1.5"), "{message}");
    }
}
