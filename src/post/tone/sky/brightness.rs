//! How bright a world looks to an eye that is adapted to it.
//!
//! ```text
//! brightness = (A / (A + A0))^d,   A0 = 1000 cd m-2
//! ```
//! A is the luminance that the eye is adapted to: constant by daylight, and a power of A at night, as brightness is a power of luminance (Stevens 1961; for a fully adapted eye CIECAM02 has the
//! third power of its adaptation factor 0.2 L_A, to about 0.22 in brightness Q and so about 0.3 in the luminance that a screen would have to show). That whole range, 7 stops from noon to
//! starlight, a screen in a lit room cannot show: d = 1/5, two thirds of it, shows full moonlight 3.1 stops and starlight 4.3 stops below a noon.

/// Adaptation luminance about which the darkening begins [cd m-2].
const DAYLIGHT: f64 = 1000.0;

/// Brightness of a world of luminance `adaptation` [cd m-2] with the power `darkening`: 1 for very bright ones.
pub fn brightness(adaptation: f64, darkening: f64) -> f64 {
    (adaptation / (adaptation + DAYLIGHT)).powf(darkening)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brightness_rises_without_a_step_over_thirteen_decades() {
        let at = |decades: f64| brightness(10f64.powf(decades), 0.2);
        for step in 0..1300 {
            let decades = -8.0 + 0.01 * f64::from(step);
            let ratio = at(decades + 0.01) / at(decades);
            // A hundredth of a decade is at most a fifth of it in brightness: 0.5 %.
            assert!(ratio > 1.0 && ratio < 10f64.powf(0.01 / 5.0) + 1e-9, "{decades} {ratio}");
        }
        assert!(at(5.0) > 0.995);
        // Full moonlight, 0.02 cd m-2, and starlight, 3e-4 cd m-2, in stops below a noon of 5000 cd m-2.
        let stops = |luminance: f64| (brightness(5000.0, 0.2) / brightness(luminance, 0.2)).log2();
        assert!((stops(0.02) - 3.07).abs() < 0.02 && (stops(3e-4) - 4.28).abs() < 0.02, "{} {}", stops(0.02), stops(3e-4));
    }
}
