//! The fields on one side of the horizon, as vectors over the fields, and their values along one circle of equal altitude.

use super::compact::compact;
use super::lanes::Lanes;
use crate::light::BLOCK;
use crate::numerics::Axis;

/// XYZ of the fields of one block.
pub(super) type Planes = [[f32; BLOCK]; 3];

/// The fields on one side of the horizon.
pub(super) struct Half {
    /// Square root of the share of the way from the horizon to the zenith or nadir.
    pub circles: Axis,
    /// Number of azimuths, from the Sun's to the opposite one.
    pub azimuths: usize,
    /// What the fields count.
    pub lanes: Lanes,
    blocks: usize,
    /// (circle, azimuth, block); azimuths go one beyond either end, where fields are even, or odd, about it.
    values: Vec<Planes>,
}

impl Half {
    /// The half with circles at `positions`, of which `rows` hold XYZ of each field that `lanes` names, (azimuth, field).
    pub fn new(positions: Vec<f64>, rows: &[Vec<[f32; 3]>], lanes: &Lanes) -> Self {
        let compact = compact(rows, lanes.rows(), lanes.mixed());
        let lanes = lanes.remade(&compact.functions);
        let fields = lanes.count();
        let azimuths = compact.rows[0].len() / fields;
        let blocks = fields.div_ceil(BLOCK);
        let mut values = vec![[[0.0; BLOCK]; 3]; rows.len() * (azimuths + 2) * blocks];
        for (row, out) in compact.rows.iter().zip(values.chunks_exact_mut((azimuths + 2) * blocks)) {
            for (place, out) in out.chunks_exact_mut(blocks).enumerate() {
                let inside = if place == 0 { 1 } else { (place - 1).min(2 * azimuths - 1 - place) };
                let mirrored = place != inside + 1;
                for (field, xyz) in row[inside * fields..(inside + 1) * fields].iter().enumerate() {
                    let sign = if mirrored && lanes.odd() == Some(field) { -1.0 } else { 1.0 };
                    for (plane, value) in out[field / BLOCK].iter_mut().zip(xyz) {
                        plane[field % BLOCK] = sign * value;
                    }
                }
            }
        }
        Self { circles: Axis::new(positions), azimuths, lanes, blocks, values }
    }

    fn stride(&self) -> usize {
        (self.azimuths + 2) * self.blocks
    }
}

/// The fields along one circle of equal altitude: only azimuth is left to interpolate.
pub(super) struct Circle<'a> {
    half: &'a Half,
    first: usize,
    weights: [f32; 4],
    /// The interpolated circle, (azimuth, block) as in [`Half`], if all of it is needed.
    whole: Vec<Planes>,
}

impl<'a> Circle<'a> {
    /// The circle at `position` of the axis, interpolated at once or where it is asked for.
    pub fn new(half: &'a Half, position: f64, whole: bool) -> Self {
        let across = half.circles.cubic(position);
        let mut circle = Self { half, first: across.first, weights: across.weights, whole: Vec::new() };
        if whole {
            circle.whole = vec![[[0.0; BLOCK]; 3]; half.stride()];
            for (a, &weight) in across.weights.iter().enumerate() {
                let start = (across.first + a) * half.stride();
                let values = half.values[start..start + half.stride()].as_flattened().as_flattened();
                for (sum, value) in circle.whole.as_flattened_mut().as_flattened_mut().iter_mut().zip(values) {
                    *sum += weight * value;
                }
            }
        }
        circle
    }

    /// What the fields count.
    pub fn lanes(&self) -> &Lanes {
        &self.half.lanes
    }

    /// Number of intervals of azimuth from the Sun's to the opposite one.
    pub fn intervals(&self) -> usize {
        self.half.azimuths - 1
    }

    /// XYZ of the fields of `block` at `place`, the azimuth after next of which interval `place` is the first.
    #[inline(always)]
    fn at(&self, place: usize, block: usize) -> Planes {
        let index = place * self.half.blocks + block;
        if let Some(planes) = self.whole.get(index) {
            return *planes;
        }
        let mut sum = [[0.0; BLOCK]; 3];
        for (a, weight) in self.weights.iter().enumerate() {
            let planes = &self.half.values[(self.first + a) * self.half.stride() + index];
            for (sum, value) in sum.as_flattened_mut().iter_mut().zip(planes.as_flattened()) {
                *sum += weight * value;
            }
        }
        sum
    }

    /// Coefficients, by power, of the cubics through the four azimuths around interval `interval` (Lagrange), for X, Y and Z of the fields of `block`.
    #[inline(always)]
    pub fn cubics(&self, interval: usize, block: usize) -> [[[f32; BLOCK]; 4]; 3] {
        let [a, b, c, d] = std::array::from_fn(|i| self.at(interval + i, block));
        let mut out = [[[0.0; BLOCK]; 4]; 3];
        for (k, out) in out.iter_mut().enumerate() {
            for n in 0..BLOCK {
                let (a, b, c, d) = (a[k][n], b[k][n], c[k][n], d[k][n]);
                out[0][n] = b;
                out[1][n] = c - a * (1.0 / 3.0) - 0.5 * b - d * (1.0 / 6.0);
                out[2][n] = 0.5 * (a + c) - b;
                out[3][n] = (d - a) * (1.0 / 6.0) + 0.5 * (b - c);
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::Phase;
    use crate::light::AngularFunctions;
    use crate::sky::PolarisingFilter;

    #[test]
    fn fields_are_even_or_odd_beyond_either_end() {
        let azimuths = 6;
        let functions = [AngularFunctions::new(&Phase::Rayleigh { depolarisation: vec![0.03] }, 1, 6, 0.005)];
        let lanes = Lanes::new(&functions, Some(PolarisingFilter::default()));
        let (fields, odd) = (lanes.count(), lanes.count() - 1);
        let value = |azimuth: f32, field: usize| if field == odd { azimuth.powi(3) } else { azimuth.powi(2) };
        let row: Vec<[f32; 3]> = (0..azimuths).flat_map(|a| (0..fields).map(move |f| [value(a as f32, f), 0.0, 1.0])).collect();
        let half = Half::new(vec![0.0, 0.3, 0.6, 1.0], &vec![row; 4], &lanes);
        for whole in [false, true] {
            let circle = Circle::new(&half, 0.4, whole);
            assert_eq!(circle.intervals(), 5);
            // Even squares and odd cubes go on beyond the first end, and cubics through them are exact.
            for field in [0, odd] {
                let [x, y, _] = circle.cubics(0, 0).map(|c| (0..4).map(|p| c[p][field] * 0.25_f32.powi(p as i32)).sum::<f32>());
                assert!((x - value(0.25, field)).abs() < 1e-4 && y.abs() < 1e-6, "{field}: {x} {y}");
            }
            // At the other end what lies beyond is what lies before it, odd fields with the other sign.
            for (field, sign) in [(0, 1.0), (odd, -1.0)] {
                let last = circle.cubics(4, 0);
                let mirrored: f32 = (0..4).map(|p| last[0][p][field] * 2.0_f32.powi(p as i32)).sum();
                assert!((mirrored - sign * value(4.0, field)).abs() < 1e-3, "{field}: {mirrored}");
            }
        }
    }
}
