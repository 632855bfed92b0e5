//! Linear RGB spaces: from CIE XYZ to the numbers in a picture.
//!
//! RGB = M XYZ, M the inverse of the matrix whose columns are the primaries' XYZ, scaled so that the white is (1, 1, 1)
//! (SMPTE RP 177-1993). A white of D65 stays (1, 1, 1) in every RGB space: for ACEScg, whose own white is near D60, XYZ is first
//! adapted from D65 by the Bradford transform (Lam 1985), as the usual OpenColorIO configurations do.

use crate::words::words;
use serde::{Deserialize, Serialize};

/// Rows of a matrix.
pub type Matrix = [[f64; 3]; 3];

const D65: [f64; 2] = [0.3127, 0.3290];

const BRADFORD: Matrix = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

/// Where the primaries and the white of a space lie: CIE 1931 x, y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chromaticities {
    /// Red primary.
    pub red: [f64; 2],
    /// Green primary.
    pub green: [f64; 2],
    /// Blue primary.
    pub blue: [f64; 2],
    /// White.
    pub white: [f64; 2],
}

impl Chromaticities {
    /// The matrix from the space with these primaries to CIE XYZ, with the adaptation from its white to D65.
    pub fn matrix_to_xyz(&self) -> Matrix {
        let Self { red, green, blue, white } = *self;
        let primaries = transpose(&[xyz_of(red), xyz_of(green), xyz_of(blue)]);
        let scale = transform(&inverse(&primaries), xyz_of(white));
        let own = primaries.map(|row| std::array::from_fn(|i| row[i] * scale[i]));
        if white == D65 { own } else { product(&bradford(white, D65), &own) }
    }

    /// The space that has them, if it is one of ours: each coordinate within 0.001.
    pub fn space(&self) -> Option<ColorSpace> {
        let flat = |c: &Self| [c.red, c.green, c.blue, c.white].concat();
        let own = flat(self);
        let is = |space: &ColorSpace| flat(&space.chromaticities()).iter().zip(&own).all(|(a, b)| (a - b).abs() < 1e-3);
        [ColorSpace::LinRec709, ColorSpace::AcesCg, ColorSpace::LinRec2020, ColorSpace::Xyz].into_iter().find(is)
    }

    /// Whether they make a space: numbers, primaries that are not on one line, a white that has luminance and lies between them. Files with others mean nothing by them.
    pub fn is_usable(&self) -> bool {
        if self.space().is_some() {
            return true;
        }
        let Self { red: [a, b], green: [c, d], blue: [e, f], white: [g, h] } = *self;
        let triangle = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2], [cx, cy]: [f64; 2]| (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
        let area = triangle(self.red, self.green, self.blue);
        let (red, green, blue, white) = (self.red, self.green, self.blue, self.white);
        let parts = [triangle(white, green, blue), triangle(red, white, blue), triangle(red, green, white)];
        let numbers = [a, b, c, d, e, f, g, h].iter().all(|value| value.is_finite() && value.abs() < 1e3);
        numbers
            && area.abs() > 1e-6
            && [b, d, f].iter().all(|y| *y != 0.0)
            && h > 0.0
            && parts.iter().all(|part| part / area > 1e-6)
    }

    /// The inverse of [`Self::matrix_to_xyz`].
    pub fn matrix_from_xyz(&self) -> Matrix {
        inverse(&self.matrix_to_xyz())
    }
}

/// A linear colour space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum ColorSpace {
    /// Rec. 709 and sRGB primaries, white D65 (ITU-R BT.709).
    #[default]
    LinRec709,
    /// ACEScg: AP1 primaries, ACES white (S-2014-004).
    AcesCg,
    /// Rec. 2020 primaries, white D65 (ITU-R BT.2020).
    LinRec2020,
    /// CIE 1931 XYZ itself.
    Xyz,
}

words!(ColorSpace, "color_space", { LinRec709 => "lin_rec709", AcesCg => "acescg", LinRec2020 => "lin_rec2020", Xyz => "xyz" });

impl ColorSpace {
    /// Name of the space in the attribute `colorInteropID` of OpenEXR files (Color Interop Forum).
    pub fn interop_id(self) -> &'static str {
        match self {
            Self::LinRec709 => "lin_rec709_scene",
            Self::AcesCg => "lin_ap1_scene",
            Self::LinRec2020 => "lin_rec2020_scene",
            Self::Xyz => "lin_ciexyzd65_scene",
        }
    }

    /// Primaries and white, for the attribute `chromaticities` of OpenEXR files.
    pub fn chromaticities(self) -> Chromaticities {
        let (red, green, blue, white) = match self {
            Self::LinRec709 => ([0.64, 0.33], [0.30, 0.60], [0.15, 0.06], D65),
            Self::AcesCg => ([0.713, 0.293], [0.165, 0.830], [0.128, 0.044], [0.32168, 0.33767]),
            Self::LinRec2020 => ([0.708, 0.292], [0.170, 0.797], [0.131, 0.046], D65),
            Self::Xyz => ([1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0 / 3.0, 1.0 / 3.0]),
        };
        Chromaticities { red, green, blue, white }
    }

    /// The matrix from CIE XYZ to this space.
    pub fn matrix_from_xyz(self) -> Matrix {
        inverse(&self.matrix_to_xyz())
    }

    /// The matrix from this space to CIE XYZ (for ACEScg with the adaptation from its own white to D65).
    pub fn matrix_to_xyz(self) -> Matrix {
        if self == Self::Xyz {
            return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        }
        self.chromaticities().matrix_to_xyz()
    }

    /// The colour `xyz` in this space; components are negative outside the gamut, see [`Gamut`].
    pub fn from_xyz(self, xyz: [f64; 3]) -> [f64; 3] {
        transform(&self.matrix_from_xyz(), xyz)
    }

    /// The colour `xyz` in this space, and what `gamut` makes of it where it is outside. XYZ holds every colour and leaves it as it is.
    pub fn from_xyz_within(self, xyz: [f64; 3], gamut: Gamut) -> [f64; 3] {
        match self {
            Self::Xyz => xyz,
            _ => gamut.apply(self.from_xyz(xyz), self.matrix_to_xyz()[1]),
        }
    }
}

/// What happens to a colour outside the gamut. The blue of twilight is outside Rec. 709, and renderers cannot use negative numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Gamut {
    /// It moves towards the grey of its own luminance until no component is negative: luminance and hue direction are kept.
    #[default]
    Desaturate,
    /// Negative components become zero: the luminance grows.
    Clip,
    /// It keeps its negative components.
    Keep,
}

words!(Gamut, "gamut", { Desaturate => "desaturate", Clip => "clip", Keep => "keep" });

impl Gamut {
    /// Applies the rule to `rgb`, a linear colour whose luminance is the dot product with `luminance_weights`, the second row of
    /// [`ColorSpace::matrix_to_xyz`]. Not for [`ColorSpace::Xyz`], where nothing is out of gamut.
    #[inline]
    pub fn apply(self, rgb: [f64; 3], luminance_weights: [f64; 3]) -> [f64; 3] {
        let lowest = rgb[0].min(rgb[1]).min(rgb[2]);
        if lowest >= 0.0 || self == Self::Keep {
            return rgb;
        }
        if self == Self::Clip {
            return rgb.map(|component| component.max(0.0));
        }
        let luminance = rgb[0] * luminance_weights[0] + rgb[1] * luminance_weights[1] + rgb[2] * luminance_weights[2];
        if luminance <= 0.0 {
            return [0.0; 3];
        }
        let kept = luminance / (luminance - lowest);
        rgb.map(|component| (luminance + (component - luminance) * kept).max(0.0))
    }
}

/// `matrix` times `vector`.
#[inline]
pub fn transform(matrix: &Matrix, vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2])
}

fn xyz_of([x, y]: [f64; 2]) -> [f64; 3] {
    [x / y, 1.0, (1.0 - x - y) / y]
}

fn bradford(from: [f64; 2], to: [f64; 2]) -> Matrix {
    let (from, to) = (transform(&BRADFORD, xyz_of(from)), transform(&BRADFORD, xyz_of(to)));
    let gain: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| if i == j { to[i] / from[i] } else { 0.0 }));
    product(&inverse(&BRADFORD), &product(&gain, &BRADFORD))
}

fn transpose(m: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// `a` times `b`.
pub(crate) fn product(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The inverse of `m`.
pub(crate) fn inverse(m: &Matrix) -> Matrix {
    let cofactor = |i: usize, j: usize| {
        let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
    std::array::from_fn(|i| std::array::from_fn(|j| cofactor(j, i) / determinant))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [ColorSpace; 4] = [ColorSpace::LinRec709, ColorSpace::AcesCg, ColorSpace::LinRec2020, ColorSpace::Xyz];

    fn assert_close(got: [f64; 3], expected: [f64; 3], tolerance: f64) {
        (0..3).for_each(|i| assert!((got[i] - expected[i]).abs() < tolerance, "{got:?} is not {expected:?}"));
    }

    #[test]
    fn chromaticities_of_no_space_are_known() {
        let make = |red, green, blue, white| Chromaticities { red, green, blue, white };
        let good = make([0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.077], [0.32168, 0.33767]);
        assert!(
            good.is_usable() && [ColorSpace::LinRec709, ColorSpace::Xyz].iter().all(|space| space.chromaticities().is_usable())
        );
        for wrong in [
            make([0.0; 2], [0.0; 2], [0.0; 2], [0.0; 2]),
            make([0.3127, 0.329], [0.3127, 0.329], [0.3127, 0.329], [0.3127, 0.329]),
            make([0.6, 0.3], [0.4, 0.3], [0.2, 0.3], [0.3, 0.3]),
            Chromaticities { white: [0.3, 0.0], ..good },
            Chromaticities { white: [0.3, -0.3], ..good },
            Chromaticities { white: [0.9, 0.9], ..good },
            Chromaticities { red: [f64::NAN, 0.3], ..good },
            Chromaticities { blue: [0.1, f64::INFINITY], ..good },
        ] {
            assert!(!wrong.is_usable(), "{wrong:?}");
        }
    }

    #[test]
    fn white_is_one_and_matrices_invert() {
        for space in ALL {
            if space != ColorSpace::Xyz {
                assert_close(space.from_xyz(xyz_of(D65)), [1.0; 3], 1e-12);
            }
            let identity = product(&space.matrix_to_xyz(), &space.matrix_from_xyz());
            for (i, row) in identity.into_iter().enumerate() {
                assert_close(row, std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 }), 1e-12);
            }
        }
    }

    #[test]
    fn matrices_are_the_published_ones() {
        // checked against: IEC 61966-2-1:1999 amendment 1, matrix from sRGB to XYZ, four decimals
        let rec709 = ColorSpace::LinRec709.matrix_to_xyz();
        assert_close(rec709[0], [0.4124, 0.3576, 0.1805], 6e-5);
        assert_close(rec709[1], [0.2126, 0.7152, 0.0722], 6e-5);
        assert_close(rec709[2], [0.0193, 0.1192, 0.9505], 6e-5);
        // checked against: ITU-R BT.2020-2 table 4, luminance 0.2627 R + 0.6780 G + 0.0593 B
        assert_close(ColorSpace::LinRec2020.matrix_to_xyz()[1], [0.2627, 0.6780, 0.0593], 6e-5);
        // checked against: ACEScg of the reference OpenColorIO configuration, first row of the matrix from linear Rec. 709 with
        // Bradford adaptation: 0.61309740, 0.33952315, 0.04737945
        let combined = product(&ColorSpace::AcesCg.matrix_from_xyz(), &rec709);
        assert_close(combined[0], [0.613_097_40, 0.339_523_15, 0.047_379_45], 2e-5);
    }

    #[test]
    fn desaturation_keeps_luminance_and_leaves_nothing_negative() {
        let weights = ColorSpace::LinRec709.matrix_to_xyz()[1];
        let luminance = |c: [f64; 3]| (0..3).map(|i| c[i] * weights[i]).sum::<f64>();
        let color = [-0.2, 0.3, 1.4];
        let moved = Gamut::Desaturate.apply(color, weights);
        assert!(moved.iter().all(|&c| c >= 0.0) && moved[0] < 1e-15);
        assert!((luminance(moved) - luminance(color)).abs() < 1e-15);
        assert_eq!(Gamut::Clip.apply(color, weights), [0.0, 0.3, 1.4]);
        assert_eq!(Gamut::Keep.apply(color, weights), color);
        assert_eq!(Gamut::Desaturate.apply([0.1, 0.2, 0.3], weights), [0.1, 0.2, 0.3]);
        assert_eq!(Gamut::Desaturate.apply([-3.0, 0.0, 0.1], weights), [0.0; 3]);
    }

    #[test]
    fn the_colours_of_a_low_sun_come_into_every_space_with_their_luminance() {
        // Nearly monochromatic light of 620 nm: outside Rec. 709.
        let xyz = [0.8544, 0.3810, 0.0002];
        assert!(ColorSpace::LinRec709.from_xyz(xyz).iter().any(|&c| c < 0.0));
        for space in ALL {
            let rgb = space.from_xyz_within(xyz, Gamut::Desaturate);
            assert!(rgb.iter().all(|&c| c >= 0.0), "{space:?}: {rgb:?}");
            assert!((transform(&space.matrix_to_xyz(), rgb)[1] - xyz[1]).abs() < 1e-12, "{space:?}: {rgb:?}");
            assert_eq!(space.from_xyz_within(xyz, Gamut::Keep), space.from_xyz(xyz));
        }
    }

    #[test]
    fn names_are_read_back() {
        for space in ALL {
            assert_eq!(space.name().parse::<ColorSpace>().unwrap(), space);
            assert_eq!(serde_json::to_string(&space).unwrap(), format!("\"{}\"", space.name()));
        }
        assert!("srgb".parse::<ColorSpace>().unwrap_err().to_string().starts_with("color_space = \"srgb\": must be"));
    }
}
