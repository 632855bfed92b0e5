//! The whole dome of the sky and the ground below, gathered at some hundreds of directions and smooth between them.
//!
//! What is interpolated is not radiance but fields that are smooth even around the Sun: radiance = sum over the functions f of the scattering angle
//! ([`crate::light::AngularFunctions`]) of f F_f + rest, all as XYZ. The functions, sharp around the Sun, are applied in each direction exactly; through a polarising filter, so
//! is the polarisation of light scattered once.
//! Interpolation is cubic in the square root of the angular distance from the horizon, where light changes fastest, and in azimuth from the Sun, in which the fields are even (U odd).
//! The circles of equal altitude that are gathered are those of the quality, or as many as a tolerance needs (`refine`).

mod refine;

use super::SkyLight;
use super::disc::Disc;
use super::filter::PolarisingFilter;
use crate::error::Result;
use crate::light::{AngularFunctions, Axis, Gathered, LightField, Observer, Once};
use crate::progress::{Parts, Progress};
use crate::quality::Numbers;
use multiversion::multiversion;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

/// Directions that are treated together.
const CHUNK: usize = 64;

/// Directions from which on a circle is interpolated whole rather than where it is asked for.
const WHOLE_CIRCLE: usize = 48;

/// Light in all directions around one observer at one moment.
pub struct SkyDome {
    above: Half,
    below: Half,
    horizon: f64,
    /// Unit vector to the Sun's centre, geometric: altitude and azimuth [radians].
    sun_altitude: f64,
    sun_azimuth: f64,
    terms: Terms,
    discs: Vec<Disc>,
}

/// What a direction's radiance is a sum of.
struct Terms {
    /// The functions of each component; then follows the rest (I, and Q and U behind a filter).
    functions: Arc<Vec<AngularFunctions>>,
    filter: Option<PolarisingFilter>,
    /// Number of fields.
    count: usize,
}

/// The fields on one side of the horizon.
struct Half {
    /// Square root of the share of the way from the horizon to the zenith or nadir.
    circles: Axis,
    azimuths: usize,
    /// Number of fields: functions and the rest.
    fields: usize,
    /// Which field is odd in azimuth.
    odd: Option<usize>,
    /// XYZ of each field, (circle, azimuth, field).
    values: Vec<[f32; 3]>,
}

/// What a dome is gathered from.
pub(super) struct Gathering<'a> {
    pub field: &'a LightField,
    pub numbers: &'a Numbers,
    pub filter: Option<PolarisingFilter>,
    /// Relative error that interpolation may have, instead of the quality's numbers of circles and azimuths.
    pub tolerance: Option<f64>,
    /// Weights that turn radiance per unit solar irradiance into XYZ.
    pub weights: Vec<[f64; 3]>,
    pub observer: Observer,
    pub horizon: f64,
    /// Altitude and azimuth of the Sun's centre, geometric [radians].
    pub sun: (f64, f64),
}

impl SkyDome {
    /// Gathers the light.
    pub(super) fn gather(what: &Gathering, discs: Vec<Disc>, progress: &Progress) -> Result<Self> {
        let functions = what.field.functions();
        let count = functions.iter().map(AngularFunctions::len).sum::<usize>() + if what.filter.is_some() { 3 } else { 1 };
        let terms = Terms { functions: Arc::clone(functions), filter: what.filter, count };
        let sides = [Side { what, terms: &terms, above: true }, Side { what, terms: &terms, above: false }];
        let [above, below] = match what.tolerance {
            None => {
                let circles = [what.numbers.dome_circles, what.numbers.dome_circles / 2];
                let parts = progress.parts("gather", circles[0] + circles[1]);
                [sides[0].even(circles[0], &parts)?, sides[1].even(circles[1], &parts)?]
            }
            Some(tolerance) => refine::refine(&sides, tolerance, progress)?,
        };
        let (sun_altitude, sun_azimuth) = what.sun;
        Ok(Self { above, below, horizon: what.horizon, sun_altitude, sun_azimuth, terms, discs })
    }

    /// The directions that were gathered, altitude and azimuth [radians, from north through east]: all on the counterclockwise side of the Sun, whose other side follows by symmetry.
    pub fn sample_directions(&self) -> Vec<[f64; 2]> {
        let of_half = |half: &Half, way: f64| -> Vec<[f64; 2]> {
            let step = PI / (half.azimuths - 1) as f64;
            let circles = half.circles.nodes().iter().map(|position| self.horizon + way * position * position);
            circles.flat_map(|altitude| (0..half.azimuths).map(move |a| [altitude, self.sun_azimuth - step * a as f64])).collect()
        };
        [of_half(&self.above, FRAC_PI_2 - self.horizon), of_half(&self.below, -FRAC_PI_2 - self.horizon)].concat()
    }
}

/// The sky or the ground of a dome that is being gathered.
struct Side<'a> {
    what: &'a Gathering<'a>,
    terms: &'a Terms,
    above: bool,
}

impl Side<'_> {
    /// Altitude of the circle at `position`, the square root of the share of the way from the horizon.
    fn altitude(&self, position: f64) -> f64 {
        // A hair inside each side, so that the ray along the horizon is on the side it belongs to.
        const HAIR: f64 = 1e-7;
        let (horizon, share) = (self.what.horizon, position * position);
        if self.above {
            horizon + HAIR + (FRAC_PI_2 - horizon - HAIR) * share
        } else {
            horizon - HAIR - (FRAC_PI_2 + horizon - HAIR) * share
        }
    }

    /// XYZ of each field, (azimuth, field), on the circle at `position` in `azimuths` from the Sun.
    fn gather(&self, position: f64, azimuths: &[f64]) -> Vec<[f32; 3]> {
        let gathered = self.what.field.gather(&self.what.observer, self.altitude(position).sin(), azimuths);
        let mut row = Vec::with_capacity(azimuths.len() * self.terms.count);
        for a in 0..azimuths.len() {
            self.terms.push_fields(&gathered, a, &self.what.weights, &mut row);
        }
        row
    }

    /// The half with `circles` circles at even positions.
    fn even(&self, circles: usize, parts: &Parts) -> Result<Half> {
        let last = self.what.numbers.dome_azimuths - 1;
        let azimuths: Vec<f64> = (0..=last).map(|a| PI * a as f64 / last as f64).collect();
        let positions: Vec<f64> = (0..circles).map(|c| c as f64 / (circles - 1) as f64).collect();
        let gather = |position: &f64| {
            let row = self.gather(*position, &azimuths);
            parts.finish_one().map(|()| row)
        };
        let rows = positions.par_iter().map(gather).collect::<Result<Vec<_>>>()?;
        Ok(self.half(positions, azimuths.len(), &rows))
    }

    fn half(&self, positions: Vec<f64>, azimuths: usize, rows: &[Vec<[f32; 3]>]) -> Half {
        let odd = self.terms.filter.map(|_| self.terms.count - 1);
        Half { circles: Axis::new(positions), azimuths, fields: self.terms.count, odd, values: rows.concat() }
    }
}

impl Terms {
    /// Adds the fields, as XYZ, of one gathered direction to `out`.
    fn push_fields(&self, gathered: &Gathered, azimuth: usize, weights: &[[f64; 3]], out: &mut Vec<[f32; 3]>) {
        for (c, functions) in self.functions.iter().enumerate() {
            let (strength, direct) = (gathered.strength(azimuth, c), gathered.direct_strength(azimuth, c));
            let path = gathered.path(azimuth, c);
            let mut sums = vec![[0.0; 3]; functions.len()];
            let mut shares = vec![0.0; functions.len()];
            for (w, weight) in weights.iter().enumerate() {
                let [strength, direct_strength, path] = [strength, direct, path].map(|values| f64::from(values[w]));
                functions.weights(w, &Once { strength, direct_strength, path }, &mut shares);
                for (sum, share) in sums.iter_mut().zip(&shares) {
                    for k in 0..3 {
                        sum[k] += share * weight[k];
                    }
                }
            }
            out.extend(sums.into_iter().map(|xyz| xyz.map(|v| v as f32)));
        }
        for parameter in 0..if self.filter.is_some() { 3 } else { 1 } {
            let mut xyz = [0.0; 3];
            for (&value, weight) in gathered.rest(azimuth, parameter).iter().zip(weights) {
                for k in 0..3 {
                    xyz[k] += f64::from(value) * weight[k];
                }
            }
            out.push(xyz.map(|v| v as f32));
        }
    }
}

/// Directions of one circle, relative to the Sun.
struct Places<'a> {
    altitude: f64,
    sun_altitude: f64,
    sun_azimuth: f64,
    azimuths: &'a [f64],
}

impl SkyLight for SkyDome {
    fn radiance_circle(&self, altitude: f64, azimuths: &[f64], out: &mut [[f32; 3]]) {
        let (half, share) = if altitude >= self.horizon {
            (&self.above, (altitude - self.horizon) / (FRAC_PI_2 - self.horizon))
        } else {
            (&self.below, (self.horizon - altitude) / (FRAC_PI_2 + self.horizon))
        };
        let circle = Circle::new(half, share.clamp(0.0, 1.0).sqrt(), azimuths.len() > WHOLE_CIRCLE);
        let mut factors = vec![[0.0_f32; CHUNK]; self.terms.count];
        for (azimuths, out) in azimuths.chunks(CHUNK).zip(out.chunks_mut(CHUNK)) {
            let places = Places { altitude, sun_altitude: self.sun_altitude, sun_azimuth: self.sun_azimuth, azimuths };
            shade(&circle, &self.terms, &places, &mut factors, out);
        }
    }

    fn horizon_altitude(&self) -> f64 {
        self.horizon
    }

    fn discs(&self) -> Vec<Disc> {
        self.discs.clone()
    }
}

/// The fields along one circle of equal altitude: only azimuth is left to interpolate.
struct Circle<'a> {
    half: &'a Half,
    first: usize,
    weights: [f32; 4],
    /// The interpolated circle, (azimuth, field), if all of it is needed.
    whole: Vec<[f32; 3]>,
}

impl<'a> Circle<'a> {
    fn new(half: &'a Half, position: f64, whole: bool) -> Self {
        let across = half.circles.cubic(position);
        let mut circle = Self { half, first: across.first, weights: across.weights, whole: Vec::new() };
        if whole {
            let width = half.azimuths * half.fields;
            let mut row = vec![[0.0_f32; 3]; width];
            for (a, &weight) in across.weights.iter().enumerate() {
                let start = (across.first + a) * width;
                for (sum, value) in row.iter_mut().zip(&half.values[start..start + width]) {
                    for k in 0..3 {
                        sum[k] += weight * value[k];
                    }
                }
            }
            circle.whole = row;
        }
        circle
    }

    /// XYZ of `field` at azimuth node `node`, which may lie one beyond either end: a field is even, or odd, about both.
    #[inline(always)]
    fn node(&self, node: isize, field: usize) -> [f32; 3] {
        let last = self.half.azimuths as isize - 1;
        let inside = if node < 0 {
            -node
        } else if node > last {
            2 * last - node
        } else {
            node
        };
        let sign = if inside != node && self.half.odd == Some(field) { -1.0 } else { 1.0 };
        let index = inside as usize * self.half.fields + field;
        let value = if let Some(value) = self.whole.get(index) {
            *value
        } else {
            let width = self.half.azimuths * self.half.fields;
            let mut sum = [0.0; 3];
            for (a, weight) in self.weights.iter().enumerate() {
                let value = &self.half.values[(self.first + a) * width + index];
                for k in 0..3 {
                    sum[k] += weight * value[k];
                }
            }
            sum
        };
        value.map(|v| sign * v)
    }

    /// Coefficients, by power, of the cubic through four nodes around interval `interval` (Lagrange) for XYZ of `field`.
    #[inline(always)]
    fn cubic(&self, interval: usize, field: usize) -> [[f32; 4]; 3] {
        let i = interval as isize;
        let [a, b, c, d] = [i - 1, i, i + 1, i + 2].map(|node| self.node(node, field));
        std::array::from_fn(|k| {
            let (a, b, c, d) = (a[k], b[k], c[k], d[k]);
            [b, c - a / 3.0 - 0.5 * b - d / 6.0, 0.5 * (a + c) - b, (d - a) / 6.0 + 0.5 * (b - c)]
        })
    }
}

/// The radiance of at most [`CHUNK`] directions of one circle.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma", "x86_64+avx2+fma"))]
fn shade(circle: &Circle, terms: &Terms, places: &Places, factors: &mut [[f32; CHUNK]], out: &mut [[f32; 3]]) {
    let count = out.len();
    let intervals = circle.half.azimuths - 1;
    let positions = angular_factors(terms, places, factors).map(|from_sun| 2.0 * from_sun.abs() * intervals as f32);
    if let Some(filter) = &terms.filter {
        filter_factors(terms, filter, places, factors);
    }
    let mut xyz = [[0.0_f32; CHUNK]; 3];
    let mut start = 0;
    while start < count {
        let interval = (positions[start] as usize).min(intervals - 1);
        let same = |p: &f32| (*p as usize).min(intervals - 1) == interval;
        let end = start + positions[start..count].iter().take_while(|p| same(p)).count();
        let mut x = [0.0_f32; CHUNK];
        for (x, position) in x.iter_mut().zip(&positions[start..end]) {
            *x = position - interval as f32;
        }
        for (field, factor) in factors.iter().enumerate().take(terms.count) {
            let cubics = circle.cubic(interval, field);
            // Slices of equal length, so that the loop becomes vector instructions.
            let (x, factor) = (&x[..end - start], &factor[start..end]);
            for (sum, c) in xyz.iter_mut().zip(&cubics) {
                for ((sum, x), factor) in sum[start..end].iter_mut().zip(x).zip(factor) {
                    *sum += factor * (c[0] + x * (c[1] + x * (c[2] + x * c[3])));
                }
            }
        }
        start = end;
    }
    for (i, pixel) in out.iter_mut().enumerate() {
        *pixel = [xyz[0][i].max(0.0), xyz[1][i].max(0.0), xyz[2][i].max(0.0)];
    }
}

/// Writes the functions of the scattering angle to the factors of the fields, and 1 for the rest; returns the azimuths from the Sun [turns, -1/2 to 1/2].
#[inline(always)]
fn angular_factors(terms: &Terms, places: &Places, factors: &mut [[f32; CHUNK]]) -> [f32; CHUNK] {
    let count = places.azimuths.len();
    // Haversine of the angle to the Sun: exact for small angles in single precision.
    let height = (0.5 * (places.altitude - places.sun_altitude)).sin().powi(2) as f32;
    let cosines = (places.altitude.cos() * places.sun_altitude.cos()) as f32;
    let mut haversines = [0.0_f32; CHUNK];
    let mut from_sun = [0.0_f32; CHUNK];
    for (from_sun, azimuth) in from_sun.iter_mut().zip(places.azimuths) {
        let turns = (azimuth - places.sun_azimuth) * (1.0 / TAU);
        *from_sun = (turns - turns.round()) as f32;
    }
    for (haversine, &from_sun) in haversines.iter_mut().zip(&from_sun) {
        let sine = half_sine(from_sun);
        *haversine = height + cosines * sine * sine;
    }
    let mut first = 0;
    for functions in terms.functions.iter() {
        functions.values(&haversines[..count], &mut factors[first..first + functions.len()]);
        first += functions.len();
    }
    factors[first] = [1.0; CHUNK];
    from_sun
}

/// Adds what the filter makes of Q and U to the factors of the fields.
fn filter_factors(terms: &Terms, filter: &PolarisingFilter, places: &Places, factors: &mut [[f32; CHUNK]]) {
    for (i, &azimuth) in places.azimuths.iter().enumerate() {
        let [q, u] = filter.weights(places.altitude, azimuth);
        let around = places.sun_azimuth - azimuth;
        let [a, b] = crate::light::transverse(places.altitude.sin(), around, FRAC_PI_2 - places.sun_altitude);
        let mut first = 0;
        for functions in terms.functions.iter() {
            if let AngularFunctions::Molecules(_) = functions {
                // The field of cos^2 is that of the dipoles.
                factors[first + 1][i] += (q * (b * b - a * a) - 2.0 * u * a * b) as f32;
            }
            first += functions.len();
        }
        factors[first + 1][i] = q as f32;
        // The fields know azimuths on one side of the Sun: U changes sign on the other.
        let side = if around.sin() < 0.0 { -1.0 } else { 1.0 };
        factors[first + 2][i] = (side * u) as f32;
    }
}

/// sin(pi turns) for -1/2 to 1/2 turns; error below 1e-7.
#[inline(always)]
fn half_sine(turns: f32) -> f32 {
    let x = turns * std::f32::consts::PI;
    let y = x * x;
    x * (1.0 + y * (-0.166_666_67 + y * (8.333_333e-3 + y * (-1.984_127e-4 + y * (2.755_731_9e-6 - y * 2.505_21e-8)))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_sines_are_those_of_the_library() {
        for i in -500..=500 {
            let turns = f64::from(i) / 1000.0;
            assert!((f64::from(half_sine(turns as f32)) - (PI * turns).sin()).abs() < 3e-7, "{turns}");
        }
    }
}
