//! Light around an observer, as whoever makes a picture of it asks for it.

use super::disc::{Disc, Point};

/// The light around an observer as a probe needs it: a smooth part that can be asked for in any direction, and discs
/// and points so small and bright that they must be drawn with their exact energy.
///
/// XYZ values are integrals of spectral radiance times the CIE 1931 colour matching functions over wavelength,
/// so that Y is luminance / 683 lm W-1 [W m-2 sr-1].
pub trait SkyLight: Sync {
    /// Writes the smooth radiance (discs excluded) along a circle of equal altitude: XYZ [W m-2 sr-1] for
    /// each of `azimuths` [radians, from north through east] at `altitude` [radians above the horizontal] into `out`, which has the same length.
    /// Above the horizon it is the sky, below it the ground seen through the air.
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]);

    /// Altitude of the horizon [radians], 0 or negative: where the smooth radiance jumps from sky to ground.
    fn horizon_altitude(&self) -> f64;

    /// The discs above the horizon.
    fn discs(&self) -> Vec<Disc>;

    /// The points of light above the horizon.
    fn points(&self) -> Vec<Point> {
        Vec::new()
    }

    /// The layers whose sum this light is, with their names, in the order of these; empty if it has none.
    fn layers(&self) -> Vec<(&'static str, Box<dyn SkyLight + '_>)> {
        Vec::new()
    }
}
