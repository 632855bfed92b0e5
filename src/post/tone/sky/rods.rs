//! Night vision: what rods see of a colour, how much of it is seen by them, and as what.
//!
//! **Response.** The light that rods see, integral of L(lambda) V'(lambda), V' of CIE 1951, is estimated from XYZ by a sum w . XYZ. Three numbers cannot tell spectra apart, so w is
//! chosen for the lights of a natural night: exact for sunlight-like 5000 K (the Moon, the average star) and for the same scattered by air (times lambda^-4), and among such w the one whose w . (xbar, ybar, zbar) is nearest to V' in
//! least squares. It is computed from the tables when it is needed first. Ratios of scotopic to photopic luminance are then right within 1.6 % for radiators from 2300 to 20 000 K (3 % at 1800 K) and 1.2 % for D65;
//! line spectra are not (airglow's 557.7 nm twice too bright, sodium lamps by 1.6, white LED 11 %). Plain least squares on V' without the two lights are 14 % too dark for D65 and 26 % for lamps of 2856 K.
//! The sum is scaled so that D65 of luminance 1 gives 1: white looks equally bright to rods and cones, reds darker, blues brighter.
//!
//! **Share.** From CIE 191:2010: rods alone below 0.005 cd m-2, cones alone above 5, smooth between in the logarithm.
//!
//! **Colour.** Rods know none; their light is shown bluish, as painters do and as moonlight looks: a mixture of white and the blue x = y = 0.25 that Jensen et al. 2000 ("Night rendering") took from
//! paintings of the night. (Kirk & O'Brien 2011 derive the shift from how rods share the cones' nerves; for a sky, grey already, theirs comes to a bluish grey too.)

use super::Sky;
use crate::spectrum::binned::columns;
use crate::spectrum::observer::matching_functions;
use std::sync::LazyLock;

/// Luminances between which both rods and cones see [cd m-2] (CIE 191:2010).
pub const MESOPIC: (f64, f64) = (0.005, 5.0);

/// Part of the adaptation luminance that counts for a dark place.
const ADAPTED: f64 = 1.0 / 30.0;

/// Chromaticity of the rods' blue (Jensen et al. 2000, section 3.2).
const BLUE: [f64; 2] = [0.25, 0.25];

/// White of the pictures, D65.
const WHITE: [f64; 2] = [0.3127, 0.3290];

/// Weights of X, Y and Z in what rods see; 1 for D65 of Y = 1.
static WEIGHTS: LazyLock<[f64; 3]> = LazyLock::new(|| {
    let [wavelengths, efficiency] = columns::<2>(include_str!("../../../../data/scotopic1951.csv"));
    let functions: Vec<[f64; 3]> = wavelengths.iter().map(|&wavelength| matching_functions(wavelength)).collect();
    // X, Y, Z and scotopic light of a spectrum.
    let seen = |spectrum: &dyn Fn(f64) -> f64| {
        let mut sums = [0.0; 4];
        for ((&wavelength, &rods), cones) in wavelengths.iter().zip(&efficiency).zip(&functions) {
            let light = spectrum(wavelength);
            (0..3).for_each(|k| sums[k] += light * cones[k]);
            sums[3] += light * rods;
        }
        sums
    };
    let lights =
        [seen(&|wavelength| planck(wavelength, 5000.0)), seen(&|wavelength| planck(wavelength, 5000.0) * wavelength.powi(-4))];
    // All weights that are right for both lights: one of them, and any multiple of the direction that neither light notices.
    let [a, b] = lights.map(|[x, y, z, _]| glam::DVec3::new(x, y, z));
    let free = a.cross(b);
    let one = glam::DMat3::from_cols(a, b, free).transpose().inverse() * glam::DVec3::new(lights[0][3], lights[1][3], 0.0);
    let free = free.normalize();
    let (mut above, mut below) = (0.0, 0.0);
    for (&rods, &cones) in efficiency.iter().zip(&functions) {
        let cones = glam::DVec3::from(cones);
        above += free.dot(cones) * (rods - one.dot(cones));
        below += free.dot(cones).powi(2);
    }
    let weights = one + free * (above / below);
    let white = glam::DVec3::from(xyz_of(WHITE));
    (weights / weights.dot(white)).into()
});

/// Radiance of a black body of `temperature` [K], any unit (second radiation constant 1.438777e-2 m K, CODATA 2018).
fn planck(wavelength_nm: f64, temperature: f64) -> f64 {
    let scaled = wavelength_nm * 1e-3;
    scaled.powi(-5) / ((1.438_777e7 / (wavelength_nm * temperature)).exp() - 1.0)
}

fn xyz_of([x, y]: [f64; 2]) -> [f64; 3] {
    [x / y, 1.0, (1.0 - x - y) / y]
}

/// The rods of an eye that is adapted to a luminance.
#[derive(Clone, Copy, Debug)]
pub struct Rods {
    weights: [f32; 3],
    /// XYZ of the rods' grey of Y = 1.
    grey: [f32; 3],
    adapted: f32,
    strength: f32,
}

impl Rods {
    /// The rods of `sky`'s eye, adapted to `adaptation` [cd m-2]; nothing if cones see all.
    pub fn new(sky: &Sky, adaptation: f64) -> Option<Self> {
        if sky.rods == 0.0 || Self::share_of(0.0, adaptation) == 0.0 {
            return None;
        }
        let (white, blue) = (xyz_of(WHITE), xyz_of(BLUE));
        let grey = std::array::from_fn(|k| (white[k] + (blue[k] - white[k]) * sky.blue_shift) as f32);
        let weights = WEIGHTS.map(|weight| weight as f32);
        Some(Self { weights, grey, adapted: (ADAPTED * adaptation) as f32, strength: sky.rods as f32 })
    }

    /// Share of the rods, 0 to 1, where the luminance is `luminance` for an eye that is adapted to `adaptation` [cd m-2].
    pub fn share_of(luminance: f64, adaptation: f64) -> f64 {
        f64::from(share((luminance + ADAPTED * adaptation) as f32))
    }

    /// The colour `xyz` [cd m-2] as cones and rods see it together, the rods what `blurred` says.
    #[inline]
    pub fn seen(&self, xyz: [f32; 3], blurred: [f32; 3]) -> [f32; 3] {
        let share = self.strength * share(xyz[1].max(0.0) + self.adapted);
        if share <= 0.0 {
            return xyz;
        }
        let rods = share * self.light(blurred);
        std::array::from_fn(|k| (1.0 - share) * xyz[k] + rods * self.grey[k])
    }

    /// What rods see of `xyz`; that of D65 is its luminance.
    #[inline]
    pub fn light(&self, xyz: [f32; 3]) -> f32 {
        (self.weights[0] * xyz[0] + self.weights[1] * xyz[1] + self.weights[2] * xyz[2]).max(0.0)
    }
}

/// Share of the rods at `luminance` [cd m-2].
#[inline]
fn share(luminance: f32) -> f32 {
    let (scotopic, photopic) = (MESOPIC.0 as f32, MESOPIC.1 as f32);
    if luminance >= photopic {
        return 0.0;
    }
    if luminance <= scotopic {
        return 1.0;
    }
    let cones = (luminance / scotopic).ln() / (photopic / scotopic).ln();
    1.0 - cones * cones * (3.0 - 2.0 * cones)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(spectrum: impl Fn(f64) -> f64) -> (f64, f64) {
        let [wavelengths, efficiency] = columns::<2>(include_str!("../../../../data/scotopic1951.csv"));
        let (mut xyz, mut rods) = ([0.0; 3], 0.0);
        for (&wavelength, &efficiency) in wavelengths.iter().zip(&efficiency) {
            let functions = matching_functions(wavelength);
            (0..3).for_each(|k| xyz[k] += spectrum(wavelength) * functions[k]);
            rods += spectrum(wavelength) * efficiency;
        }
        // Maximum luminous efficacies 1700 (scotopic) and 683 lm W-1.
        let true_ratio = 1700.0 * rods / (683.0 * xyz[1]);
        let weights = *WEIGHTS;
        (true_ratio, (0..3).map(|k| weights[k] * xyz[k]).sum::<f64>() / xyz[1])
    }

    #[test]
    fn natural_lights_have_the_scotopic_ratio_of_their_spectrum() {
        // checked against: scotopic to photopic ratio of illuminant A 1.41 (CIE 1951 and 1931 observers)
        let (illuminant_a, _) = ratio(|wavelength| planck(wavelength, 2856.0));
        assert!((illuminant_a - 1.41).abs() < 0.01, "{illuminant_a}");
        let (sun, of_sun) = ratio(|wavelength| planck(wavelength, 5000.0));
        let scale = sun / of_sun;
        for temperature in [2300.0, 2856.0, 4000.0, 6500.0, 10_000.0, 20_000.0] {
            let (expected, got) = ratio(|wavelength| planck(wavelength, temperature));
            assert!((got * scale / expected - 1.0).abs() < 0.017, "{temperature} K: {} for {expected}", got * scale);
        }
        let (expected, got) = ratio(|wavelength| planck(wavelength, 5000.0) * wavelength.powi(-4));
        assert!((got * scale / expected - 1.0).abs() < 1e-6);
        // checked against: scotopic to photopic ratio of D65, 2.47, which the scale of the weights takes for 1
        assert!((scale - 2.47).abs() < 0.05, "{scale}");
    }

    #[test]
    fn shares_are_those_of_the_standard_and_have_no_step() {
        // checked against: CIE 191:2010, mesopic from 0.005 to 5 cd m-2
        assert_eq!((share(0.005), share(5.0), share(0.0)), (1.0, 0.0, 1.0));
        assert!((share(0.158_11) - 0.5).abs() < 1e-4);
        let mut last = 1.0;
        for step in 0..2000 {
            let found = share(10f32.powf(-4.0 + 0.003 * step as f32));
            assert!(found <= last && last - found < 0.004, "{step}");
            last = found;
        }
    }

    #[test]
    fn a_dark_place_by_day_is_not_seen_by_rods() {
        assert!(Rods::new(&Sky::default(), 3000.0).is_none());
        assert_eq!(Rods::share_of(0.0, 3000.0), 0.0);
        assert!(Rods::share_of(0.0, 1e-3) > 0.999);
    }

    #[test]
    fn at_night_white_stays_as_bright_reds_darken_and_all_is_bluish_grey() {
        let rods = Rods::new(&Sky::default(), 1e-4).unwrap();
        let white = xyz_of(WHITE).map(|value| (1e-4 * value) as f32);
        let seen = rods.seen(white, white);
        assert!((seen[1] / 1e-4 - 1.0).abs() < 1e-3 && seen[2] > 1.2 * seen[1], "{seen:?}");
        // Rec. 709 (1, 0.2, 0.1) as XYZ: the light of embers.
        let embers = [5.02e-5, 3.63e-5, 1.38e-5];
        let red = rods.seen(embers, embers);
        assert!(red[1] < 0.6 * embers[1] && red[1] > 0.0, "{red:?}");
        let ratio = seen[2] / seen[1];
        assert!((red[2] / red[1] - ratio).abs() < 1e-3 * ratio);
    }
}
