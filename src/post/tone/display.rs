//! From light on a screen to the numbers in a file: primaries, transfer function, steps.
//!
//! 8-bit values are dithered by interleaved gradient noise (Jimenez 2014, "Next generation post processing in Call of Duty"), because a sky is smooth enough to show the steps of 8 bits:
//! code = floor(255 v + noise), whose mean over many pixels is 255 v. 16-bit values are rounded to the nearest.

use crate::spectrum::color_space::{Chromaticities, ColorSpace};
use crate::words::words;
use std::sync::LazyLock;

/// What shows the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Display {
    /// sRGB (IEC 61966-2-1): nearly every screen, and what a file without a word about it is taken for.
    #[default]
    Srgb,
    /// Display P3: primaries of SMPTE RP 431-2, white D65, transfer function of sRGB.
    DisplayP3,
    /// A television: primaries of ITU-R BT.709, the power 2.4 of ITU-R BT.1886 with a black of 0.
    Rec709,
    /// Primaries of Rec. 709, values in proportion to light.
    Linear,
}

words!(Display, "display", { Srgb => "srgb", DisplayP3 => "display_p3", Rec709 => "rec709", Linear => "linear" });

impl Display {
    /// Primaries and white.
    pub fn chromaticities(self) -> Chromaticities {
        let rec709 = ColorSpace::LinRec709.chromaticities();
        match self {
            // SMPTE RP 431-2: DCI-P3; Display P3 has its primaries with the white of sRGB.
            Self::DisplayP3 => Chromaticities { red: [0.680, 0.320], green: [0.265, 0.690], blue: [0.150, 0.060], ..rec709 },
            Self::Srgb | Self::Rec709 | Self::Linear => rec709,
        }
    }

    /// Code values of PNG's chunk `cICP` (ITU-T H.273): primaries and transfer function.
    pub const fn code_points(self) -> [u8; 2] {
        match self {
            Self::Srgb => [1, 13],
            Self::DisplayP3 => [12, 13],
            Self::Rec709 => [1, 1],
            Self::Linear => [1, 8],
        }
    }

    /// The signal for light of 0 to 1.
    pub fn encode(self, light: f64) -> f64 {
        match self {
            Self::Srgb | Self::DisplayP3 if light <= 0.003_130_8 => 12.92 * light,
            Self::Srgb | Self::DisplayP3 => 1.055 * light.powf(1.0 / 2.4) - 0.055,
            Self::Rec709 => light.powf(1.0 / 2.4),
            Self::Linear => light,
        }
    }

    /// The light of a signal of 0 to 1.
    pub fn decode(self, signal: f64) -> f64 {
        match self {
            Self::Srgb | Self::DisplayP3 if signal <= 0.040_45 => signal / 12.92,
            Self::Srgb | Self::DisplayP3 => ((signal + 0.055) / 1.055).powf(2.4),
            Self::Rec709 => signal.powf(2.4),
            Self::Linear => signal,
        }
    }

    /// 255 times the signal for light between 0 and 1, within 0.005 for sRGB.
    fn signal_of_8_bits(self, table: &[f32], light: f32) -> f32 {
        if self == Self::Rec709 {
            // Infinitely steep at 0: no table.
            return 255.0 * light.powf(1.0 / 2.4);
        }
        let position = light * TABLE as f32;
        let left = (position as usize).min(TABLE - 1);
        table[left] + (position - left as f32) * (table[left + 1] - table[left])
    }

    /// 8-bit codes of row `row` of display-linear `light` (RGB, between 0 and 1), dithered.
    pub fn quantise_8(self, row: usize, light: &[f32], out: &mut [u8]) {
        let table: &[f32] = if self == Self::Linear { &LINEAR } else { &SRGB };
        for (column, (out, light)) in out.as_chunks_mut::<3>().0.iter_mut().zip(light.as_chunks::<3>().0).enumerate() {
            for channel in 0..3 {
                // Channels are dithered apart, or grey would move as a whole.
                let noise = noise(column, row + 37 * channel);
                out[channel] = (self.signal_of_8_bits(table, light[channel].clamp(0.0, 1.0)) + noise).min(255.0) as u8;
            }
        }
    }

    /// 16-bit codes of display-linear `light` between 0 and 1, rounded to the nearest.
    pub fn quantise_16(self, light: &[f32], out: &mut [u16]) {
        for (out, &light) in out.iter_mut().zip(light) {
            *out = (65_535.0 * self.encode(f64::from(light.clamp(0.0, 1.0)))).round() as u16;
        }
    }
}

/// Intervals of the tables of signals: at the bend of sRGB, where it is curved most, straight lines between them are off by 0.005 of an 8-bit step.
const TABLE: usize = 4096;

static SRGB: LazyLock<Vec<f32>> = LazyLock::new(|| table(Display::Srgb));
static LINEAR: LazyLock<Vec<f32>> = LazyLock::new(|| table(Display::Linear));

fn table(display: Display) -> Vec<f32> {
    (0..=TABLE).map(|k| (255.0 * display.encode(k as f64 / TABLE as f64)) as f32).collect()
}

/// Well-spread numbers in [0, 1).
fn noise(x: usize, y: usize) -> f32 {
    (52.982_918_9 * (0.067_110_56 * x as f64 + 0.005_837_15 * y as f64).fract()).fract() as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signals_are_those_of_the_standards() {
        // checked against: IEC 61966-2-1, 18 % grey is 117.6 of 255; BT.1886, 0.5^(1/2.4)
        assert!((255.0 * Display::Srgb.encode(0.18) - 117.6).abs() < 0.1);
        assert!((Display::Rec709.encode(0.5) - 0.749_154).abs() < 1e-6);
        for display in Display::ALL {
            for signal in [0.0, 0.02, 0.3, 1.0] {
                assert!((display.encode(display.decode(signal)) - signal).abs() < 1e-6, "{display:?} {signal}");
            }
            assert_eq!(display.name().parse::<Display>().unwrap(), display);
        }
        assert!("p3".parse::<Display>().unwrap_err().to_string().starts_with("display = \"p3\": must be one of srgb"));
        // checked against: Apple's Display P3 profile, D65 matrix, Y of red, green, blue 0.2290, 0.6917, 0.0793
        let luminances = Display::DisplayP3.chromaticities().matrix_to_xyz()[1];
        for (got, expected) in luminances.into_iter().zip([0.2290, 0.6917, 0.0793]) {
            assert!((got - expected).abs() < 1e-4, "{luminances:?}");
        }
    }

    #[test]
    fn dithered_codes_have_the_mean_of_the_signal() {
        for display in Display::ALL {
            for light in [0.0, 1e-4, 0.003, 0.01, 0.1803, 0.5, 0.999, 1.0] {
                let row = vec![light as f32; 3 * 256];
                let (mut sum, mut codes) = ([0.0; 3], vec![0; row.len()]);
                for y in 0..256 {
                    display.quantise_8(y, &row, &mut codes);
                    codes.iter().enumerate().for_each(|(k, &code)| sum[k % 3] += f64::from(code));
                }
                let signal = 255.0 * display.encode(f64::from(light as f32));
                for sum in sum {
                    let mean = sum / (256.0 * 256.0);
                    // The mean of the noise over such a square is 0.5 within 0.003; the table adds 0.005.
                    assert!((mean - signal).abs() < 0.01, "{display:?} {light}: {mean} for {signal}");
                }
            }
        }
    }

    #[test]
    fn sixteen_bits_are_rounded_exactly() {
        for display in Display::ALL {
            let codes: Vec<u16> = (0..=u16::MAX).step_by(7).collect();
            let light: Vec<f32> = codes.iter().map(|&code| display.decode(f64::from(code) / 65_535.0) as f32).collect();
            let mut back = vec![0; codes.len()];
            display.quantise_16(&light, &mut back);
            assert!(back == codes, "{display:?}");
        }
    }

    #[test]
    fn what_is_outside_becomes_black_or_white() {
        let mut codes = [7; 6];
        Display::Srgb.quantise_8(3, &[-1.0, 2.0, 0.0, f32::INFINITY, -0.0, f32::NEG_INFINITY], &mut codes);
        assert_eq!(codes, [0, 255, 0, 255, 0, 0]);
    }
}
