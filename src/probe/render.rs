//! Fills an image with the light of a sky: every pixel the mean of the radiance over its footprint.

use super::image::Probe;
use super::painter::Painter;
use super::settings::ProbeSettings;
use crate::error::Result;
use crate::progress::Progress;
use crate::sky::SkyLight;

/// Renders the light of `sky` into an image. Progress is the stage "render"; cancelling takes effect within a row per thread.
///
/// # Errors
/// [`Error::Input`](crate::Error::Input) for settings that no image can have, [`Error::Data`](crate::Error::Data) for light that is not finite,
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub fn render(sky: &dyn SkyLight, settings: &ProbeSettings, progress: &Progress) -> Result<Probe> {
    let painter = Painter::new(sky, settings, progress)?;
    let (width, height) = painter.size();
    let mut pixels = vec![0.0_f32; 3 * width * height];
    painter.paint(0, &mut pixels)?;
    Ok(Probe { width, height, pixels, settings: settings.clone() })
}
