//! An eye that takes time: for sequences of pictures, without flicker.
//!
//! The eye's adaptation follows the logarithm of the metered luminance through two equal stages one after the other,
//! ```text
//! d ln A_1 / dt = (ln L - ln A_1) / tau,   d ln A / dt = (ln A_1 - ln A) / tau
//! ```
//! each solved exactly over a step of time (L constant within it). tau is that of light adaptation where the target is brighter and of dark adaptation where it is darker; between them it goes over
//! smoothly within a quarter of a natural logarithm, so that small noise about a level is averaged nearly alike in both directions: a mere switch would follow every bright frame and forget it slowly.
//! Two stages leave of noise from frame to frame, at 24 frames a second and the time constants for time-lapses, less than a hundredth.
//!
//! The state is nothing but the two logarithms: equal inputs give equal outputs, at any speed of computing.

use super::metering::DARKNESS;
use crate::error::{Result, check_range};

/// Difference of logarithms over which the direction of adaptation is decided.
const DIRECTION: f64 = 0.25;

/// Time constants of adaptation, and its state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adaptation {
    light_s: f64,
    dark_s: f64,
    /// ln of the luminance after each stage.
    state: Option<[f64; 2]>,
}

impl Adaptation {
    /// Time constants of light and dark adaptation [s].
    pub const fn time_constants_s(&self) -> [f64; 2] {
        [self.light_s, self.dark_s]
    }

    /// With a time constant of light adaptation `light_s` and of dark adaptation `dark_s`, 0.001 to 1e5 \[s\].
    ///
    /// # Errors
    /// [`Error::Input`](crate::Error::Input) that names the number.
    pub fn new(light_s: f64, dark_s: f64) -> Result<Self> {
        check_range("light_s", light_s, 1e-3, 1e5, "s")?;
        check_range("dark_s", dark_s, 1e-3, 1e5, "s")?;
        Ok(Self { light_s, dark_s, state: None })
    }

    /// For time-lapses, in seconds of the film: 0.5 s towards light, 1 s towards darkness.
    pub const fn time_lapse() -> Self {
        Self { light_s: 0.5, dark_s: 1.0, state: None }
    }

    /// Of an eye, in seconds of the world: 0.4 s towards light; 110 s towards darkness, in which the pigment of the cones comes back (Rushton & Henry 1968; Pattanaik et al. 2000, who have 400 s for
    /// the rods).
    pub const fn eye() -> Self {
        Self { light_s: 0.4, dark_s: 110.0, state: None }
    }

    /// Goes on by `seconds`, 0 to 1e9, during which the picture has the metered `luminance` [cd m-2], and returns the luminance that the eye is adapted to then. The first step takes the
    /// picture's own.
    ///
    /// # Errors
    /// [`Error::Input`](crate::Error::Input) for a time out of range.
    pub fn step(&mut self, luminance: f64, seconds: f64) -> Result<f64> {
        check_range("seconds", seconds, 0.0, 1e9, "s")?;
        // Darkness, and what is no number, is as dark as can be told.
        let target = luminance.clamp(DARKNESS, 1e30).max(DARKNESS).ln();
        let [mut first, mut second] = self.state.unwrap_or([target; 2]);
        first += self.moved(target - first, seconds);
        second += self.moved(first - second, seconds);
        self.state = Some([first, second]);
        Ok(second.exp())
    }

    /// Luminance that the eye is adapted to [cd m-2]; `None` before the first step.
    pub fn luminance(&self) -> Option<f64> {
        self.state.map(|[_, second]| second.exp())
    }

    /// Forgets all, as at a cut.
    pub fn reset(&mut self) {
        self.state = None;
    }

    /// How far a stage moves that is off by `distance`.
    fn moved(&self, distance: f64, seconds: f64) -> f64 {
        let brighter = 1.0 / (1.0 + (-distance / DIRECTION).exp());
        let constant = (brighter * self.light_s.ln() + (1.0 - brighter) * self.dark_s.ln()).exp();
        distance * -(-seconds / constant).exp_m1()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Well-spread numbers between -1 and 1.
    fn noise(k: usize) -> f64 {
        2.0 * (k as f64 * 0.618_033_988_75 + 0.37 * ((k * k) as f64 * 0.754_877_666).fract()).fract() - 1.0
    }

    #[test]
    fn a_noisy_dusk_gives_a_smooth_exposure() {
        // From noon to starlight in 20 s at 24 frames a second, every frame off by up to 10 %.
        let mut eye = Adaptation::time_lapse();
        let (mut last, mut last_change, mut last_input): (Option<f64>, Option<f64>, Option<f64>) = (None, None, None);
        let (mut roughest, mut roughest_input) = (0.0f64, 0.0f64);
        for frame in 0..480 {
            let ramp = 8000f64.ln() + (3e-4f64 / 8000.0).ln() * frame as f64 / 480.0;
            let input = ramp + 0.1 * noise(frame);
            let found = eye.step(input.exp(), 1.0 / 24.0).unwrap().ln();
            if let Some(last) = last {
                let change = found - last;
                if let Some(last_change) = last_change {
                    roughest = roughest.max((change - last_change).abs());
                }
                // Once the dusk is on its way it never turns back to brighter.
                assert!(frame < 24 || change < 0.0, "{frame}: {change}");
                last_change = Some(change);
            }
            if let Some(last_input) = last_input {
                roughest_input = roughest_input.max((input - last_input).abs());
            }
            (last, last_input) = (Some(found), Some(input));
        }
        assert!(roughest_input > 0.1 && roughest < 2e-3, "{roughest_input} {roughest}");
    }

    #[test]
    fn noise_about_a_level_is_averaged() {
        let mut eye = Adaptation::time_lapse();
        let mut found = Vec::new();
        for frame in 0..2400 {
            found.push(eye.step(100.0 * (0.1 * noise(frame)).exp(), 1.0 / 24.0).unwrap());
        }
        let settled = &found[240..];
        let (low, high) = settled.iter().fold((f64::MAX, 0.0f64), |(low, high), &found| (low.min(found), high.max(found)));
        // Light is followed faster, so the mean is a little too bright; but it is still.
        assert!(low > 98.0 && high < 102.5, "{low} {high}");
        let step = settled.windows(2).map(|pair| (pair[1] / pair[0] - 1.0).abs()).fold(0.0, f64::max);
        assert!(step < 3e-3, "{step}");
    }

    #[test]
    fn light_is_faster_than_darkness_and_both_arrive() {
        let after = |from: f64, to: f64, seconds: f64| {
            let mut eye = Adaptation::eye();
            eye.step(from, 0.0).unwrap();
            (0..1000).map(|_| eye.step(to, seconds / 1000.0).unwrap()).last().unwrap()
        };
        assert!(after(1e-3, 1e3, 5.0) > 700.0, "{}", after(1e-3, 1e3, 5.0));
        assert!((after(1e-3, 1e3, 60.0) / 1e3 - 1.0).abs() < 0.01);
        assert!(after(1e3, 1e-3, 5.0) > 100.0);
        assert!((after(1e3, 1e-3, 3000.0) / 1e-3 - 1.0).abs() < 0.01);
    }

    #[test]
    fn two_stages_have_their_analytic_step_response() {
        // With equal time constants: 1 - (1 + t / tau) exp(-t / tau).
        let mut eye = Adaptation::new(2.0, 2.0).unwrap();
        eye.step(1.0, 0.0).unwrap();
        for step in 1..=4000 {
            let found = eye.step(10.0, 1e-3).unwrap().log10();
            let t = 1e-3 * f64::from(step) / 2.0;
            assert!((found - (1.0 - (1.0 + t) * (-t).exp())).abs() < 5e-4, "{t} {found}");
        }
    }

    #[test]
    fn darkness_and_nonsense_are_steps_too() {
        let mut eye = Adaptation::eye();
        assert_eq!(eye.luminance(), None);
        for luminance in [0.0, f64::NAN, -1.0, f64::INFINITY, 1e9] {
            assert!(eye.step(luminance, 0.1).unwrap().is_finite(), "{luminance}");
        }
        assert!(eye.step(1.0, -1.0).unwrap_err().to_string().starts_with("seconds = -1: must be"));
        assert!(Adaptation::new(0.0, 1.0).unwrap_err().to_string().starts_with("light_s = 0: must be"));
        let before = eye.luminance();
        eye.step(77.0, 0.0).unwrap();
        assert!((eye.luminance().unwrap() / before.unwrap() - 1.0).abs() < 1e-12);
        eye.reset();
        assert!((eye.step(5.0, 1.0).unwrap() - 5.0).abs() < 1e-9);
    }
}
