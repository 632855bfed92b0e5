//! A filmic curve in the manner of AgX. Per channel, in primaries moved towards white.
//!
//! AgX (T. Sobotka 2022) renders light in three steps, which this operator takes too, with numbers of its own:
//! 1. the primaries are moved inwards, c' = (1 - i) c + i g, g the mean of the channels, so that no channel of a pure colour is ever far from the others and bright colours fade to white;
//! 2. a logarithm, x = log2(c' / 0.18), from 10 stops below middle grey to 6.5 above, and a sigmoid
//!    ```text
//!    y = y0 + s (x - x0) / (1 + (s |x - x0| / (end - y0))^p)^(1/p)
//!    ```
//!    about middle grey x0 with slope s (over the whole range of stops), with end = 1 above and 0 below (J. Smith's tunable sigmoid, as AgX uses it), scaled so that the ends of the range are exactly 0 and 1;
//! 3. y^2.4 is light again, and the primaries are moved outwards by a part of what they were moved in.
//!
//! What it is not: AgX itself, whose inset turns the primaries and comes as a fixed matrix, and whose looks come as tables; a picture differs from Blender's "AgX" in the hue of pure colours.

use super::operator::Field;

/// Stops from middle grey to black and to white.
const RANGE_STOPS: (f64, f64) = (-10.0, 6.5);

/// Light of middle grey, before and after.
const MIDDLE_GREY: f64 = super::exposure::MIDDLE_GREY;

/// Power from the sigmoid to light.
const DISPLAY_POWER: f64 = 2.4;

/// How much of the inset is taken back.
const OUTSET: f64 = 0.75;

/// The operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filmic {
    /// Slope s of the sigmoid at middle grey, 1.5 to 5: contrast.
    pub contrast: f64,
    /// Inset i of the primaries, 0 to 0.5: how soon colours fade.
    pub inset: f64,
    /// Power p of the sigmoid above and below middle grey, 1 to 6: how late it bends.
    pub power: f64,
}

impl Default for Filmic {
    fn default() -> Self {
        Self { contrast: 2.4, inset: 0.2, power: 1.5 }
    }
}

/// One side of the sigmoid.
#[derive(Clone, Copy, Debug)]
struct Side {
    slope_over_room: f32,
    power: f32,
    /// Factor that brings the end of the range to the end of the curve.
    scale: f32,
}

impl Side {
    /// `length` of the side in units of the range, `room` the way of y from the middle to the end.
    fn new(length: f64, room: f64, contrast: f64, power: f64) -> Self {
        let slope_over_room = contrast / room;
        let reached = saturating(slope_over_room * length, power);
        Self { slope_over_room: slope_over_room as f32, power: power as f32, scale: (room / reached) as f32 }
    }

    /// How far y is from the middle at `distance` of x from it.
    fn at(self, distance: f32) -> f32 {
        let steep = self.slope_over_room * distance;
        self.scale * steep / (1.0 + steep.powf(self.power)).powf(1.0 / self.power)
    }
}

fn saturating(steep: f64, power: f64) -> f64 {
    steep / (1.0 + steep.powf(power)).powf(1.0 / power)
}

impl Filmic {
    pub(super) fn fields(&mut self) -> Vec<Field<'_>> {
        vec![
            Field::new("contrast", &mut self.contrast, 1.5, 5.0),
            Field::new("inset", &mut self.inset, 0.0, 0.5),
            Field::new("power", &mut self.power, 1.0, 6.0),
        ]
    }

    /// What a grey of exposed value becomes.
    pub fn curve(&self) -> impl Fn(f32) -> f32 + Sync + use<> {
        let (below, above) = RANGE_STOPS;
        let whole = above - below;
        let (x0, y0) = (-below / whole, MIDDLE_GREY.powf(1.0 / DISPLAY_POWER));
        let shoulder = Side::new(1.0 - x0, 1.0 - y0, self.contrast, self.power);
        let toe = Side::new(x0, y0, self.contrast, self.power);
        let (x0, y0, per_stop, grey) = (x0 as f32, y0 as f32, (1.0 / whole) as f32, (1.0 / MIDDLE_GREY) as f32);
        move |value| {
            // The least of the range is black.
            let stops = (value * grey).max(1e-4).log2();
            let distance = (stops * per_stop).min(1.0 - x0);
            if distance <= -x0 {
                return 0.0;
            }
            let signal = if distance >= 0.0 { y0 + shoulder.at(distance) } else { y0 - toe.at(-distance) };
            signal.clamp(0.0, 1.0).powf(DISPLAY_POWER as f32)
        }
    }

    /// What an exposed colour becomes.
    pub fn colour(&self) -> impl Fn([f32; 3]) -> [f32; 3] + Sync + use<> {
        let curve = self.curve();
        let inset = self.inset as f32;
        // (1 - out) c + out g undoes an inset i for out = -i / (1 - i).
        let back = (OUTSET * self.inset) as f32;
        let outset = -back / (1.0 - back);
        let moved = |rgb: [f32; 3], share: f32| {
            let mean = (rgb[0] + rgb[1] + rgb[2]) / 3.0;
            rgb.map(|value| value + (mean - value) * share)
        };
        move |rgb| moved(moved(rgb, inset).map(&curve), outset).map(|value| value.clamp(0.0, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn middle_grey_stays_and_the_ends_of_the_range_are_black_and_white() {
        let curve = Filmic::default().curve();
        let at_stops = |stops: f32| curve(0.18 * stops.exp2());
        // checked against: AgX's range as published, 10 stops below and 6.5 above a middle grey of 0.18
        assert!((at_stops(0.0) - 0.18).abs() < 1e-5);
        assert!(at_stops(6.5) > 0.9999 && at_stops(6.4) < 0.9999, "{} {}", at_stops(6.5), at_stops(6.4));
        assert!(at_stops(-10.0) < 1e-6 && at_stops(-9.0) > 1e-6);
        assert_eq!((curve(0.0), curve(1e15)), (0.0, 1.0));
    }

    #[test]
    fn the_slope_in_the_middle_is_the_contrast() {
        let filmic = Filmic { power: 6.0, ..Filmic::default() };
        let curve = filmic.curve();
        let signal = |stops: f64| f64::from(curve((0.18 * stops.exp2()) as f32)).powf(1.0 / 2.4);
        let slope = (signal(0.05) - signal(-0.05)) / 0.1 * 16.5;
        assert!((slope / filmic.contrast - 1.0).abs() < 0.02, "{slope}");
    }

    #[test]
    fn bright_colours_fade_and_dark_ones_stay() {
        let colour = Filmic::default().colour();
        let saturation = |scale: f32| {
            let [r, _, b] = colour([0.1 * scale, 0.3 * scale, scale]);
            1.0 - r / b
        };
        assert!(saturation(0.1) > 0.8 && saturation(100.0) < 0.1, "{} {}", saturation(0.1), saturation(100.0));
    }
}
