//! Quick, coarse tables of the air and of the sunlight in it, for the guide alone.
//!
//! Altitude enters as u = sqrt(z / top), which is fine near the ground; the Sun's height by the cosine of its zenith angle
//! over that of the local horizon, e = c - h, as sqrt(e), which is fine where the Sun sets.

use crate::light::chord::Chord;
use crate::light::path_tracer::air::Air;
use crate::light::path_tracer::medium::Medium;
use crate::light::path_tracer::shells::End;

const COLUMN_ROWS: usize = 400;
const SUNLIGHT_LEVELS: usize = 36;
const SUNLIGHT_HEIGHTS: usize = 48;
/// Largest e of the table; greater ones count as this.
const HIGHEST: f64 = 1.0;
/// ln of the transmittance below which it counts as none.
const DARK: f64 = -300.0;

/// The coefficients at one altitude.
pub(in crate::light::path_tracer) struct Coefficients<'a> {
    row: &'a [f64],
    above: &'a [f64],
    fraction: f64,
}

impl Coefficients<'_> {
    fn at(&self, index: usize) -> f64 {
        self.row[index] + (self.above[index] - self.row[index]) * self.fraction
    }

    /// Extinction coefficient [km-1].
    pub fn extinction(&self) -> f64 {
        self.at(0)
    }

    /// Scattering coefficient of all components [km-1].
    pub fn scattering(&self) -> f64 {
        self.at(1)
    }

    /// Scattering coefficient of one component [km-1].
    pub fn scatterer(&self, component: usize) -> f64 {
        self.at(2 + component)
    }
}

pub(super) struct Tables {
    pub radius: f64,
    pub top: f64,
    columns: Vec<f64>,
    stride: usize,
    ln_sunlight: Vec<f64>,
}

impl Tables {
    pub fn new(air: &Air) -> Self {
        let (radius, top) = (air.shells.planet_radius, air.shells.top());
        let mut columns = Vec::new();
        for i in 0..=COLUMN_ROWS {
            let place = air.shells.locate(top * (i as f64 / COLUMN_ROWS as f64).powi(2));
            columns.extend([air.extinction(place), air.scattering(place)]);
            columns.extend(air.scatterers.iter().map(|s| s.scattering(place)));
        }
        let mut ln_sunlight = Vec::new();
        for level in 0..SUNLIGHT_LEVELS {
            let altitude = top * (level as f64 / (SUNLIGHT_LEVELS - 1) as f64).powi(2);
            let horizon = horizon_cosine(radius, altitude);
            for i in 0..SUNLIGHT_HEIGHTS {
                // A hair above the horizon, so that rounding does not end the ray on the ground.
                let above = HIGHEST * (i as f64 / (SUNLIGHT_HEIGHTS - 1) as f64).powi(2) + 1e-9;
                let chord = Chord { altitude, radius: radius + altitude, cosine: (horizon + above).min(1.0) };
                let (end, length) = air.shells.end(&chord);
                let depth = if end == End::Ground { -DARK } else { air.shells.optical_depth(&chord, length) };
                ln_sunlight.push((-depth).max(DARK));
            }
        }
        Self { radius, top, columns, stride: 2 + air.scatterers.len(), ln_sunlight }
    }

    /// The coordinate u, 0 to 1, of an altitude [km].
    pub fn level(&self, altitude: f64) -> f64 {
        (altitude / self.top).clamp(0.0, 1.0).sqrt()
    }

    pub fn coefficients(&self, level: f64) -> Coefficients<'_> {
        let (i, fraction) = split(level, COLUMN_ROWS);
        let start = i * self.stride;
        let (row, above) = self.columns[start..start + 2 * self.stride].split_at(self.stride);
        Coefficients { row, above, fraction }
    }

    /// Fraction of the light of the Sun's centre that arrives where its zenith angle has this cosine.
    pub fn sunlight(&self, level: f64, altitude: f64, cosine: f64) -> f64 {
        let above = cosine - horizon_cosine(self.radius, altitude);
        if above <= 0.0 {
            return 0.0;
        }
        let (i, up) = split(level, SUNLIGHT_LEVELS - 1);
        let (j, across) = split((above / HIGHEST).min(1.0).sqrt(), SUNLIGHT_HEIGHTS - 1);
        bilinear(&self.ln_sunlight, SUNLIGHT_HEIGHTS, (i, up), (j, across)).exp()
    }
}

/// Cosine of the zenith angle of the geometric horizon at `altitude` [km].
pub(super) fn horizon_cosine(radius: f64, altitude: f64) -> f64 {
    let r = radius + altitude;
    -(altitude.max(0.0) * (radius + r)).sqrt() / r
}

/// Interval and the fraction of the way through it of the position `part` (0 to 1) in `intervals` equal ones.
pub(super) fn split(part: f64, intervals: usize) -> (usize, f64) {
    let position = part * intervals as f64;
    let i = (position as usize).min(intervals - 1);
    (i, position - i as f64)
}

/// Interpolates a table with rows of length `width`.
pub(super) fn bilinear(table: &[f64], width: usize, (i, up): (usize, f64), (j, across): (usize, f64)) -> f64 {
    let at = |i: usize| table[i * width + j] * (1.0 - across) + table[i * width + j + 1] * across;
    at(i) * (1.0 - up) + at(i + 1) * up
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::AirParameters;
    use crate::light::path_tracer::tests::clear_air;
    use glam::DVec3;

    #[test]
    fn the_tables_are_near_the_air() {
        let profile = clear_air(&AirParameters::default(), 550.0);
        let air = Air::new(&profile, 0).unwrap();
        let tables = Tables::new(&air);
        for altitude in [0.0, 0.7, 4.0, 15.0, 31.0, 70.0] {
            let level = tables.level(altitude);
            let exact = air.extinction(air.shells.locate(altitude));
            assert!((tables.coefficients(level).extinction() / exact - 1.0).abs() < 0.03);
            for sun_deg in [10.0, 60.0, 85.0, 89.5, 92.0, 95.0_f64] {
                let (sine, cosine) = sun_deg.to_radians().sin_cos();
                let point = DVec3::Z * (air.shells.planet_radius + altitude);
                let (found, exact) =
                    (tables.sunlight(level, altitude, cosine), air.exact_sunlight(point, DVec3::new(sine, 0.0, cosine)));
                assert!((found - exact).abs() < 0.03 + 0.1 * exact, "{altitude} km, {sun_deg} deg: {found} {exact}");
            }
        }
    }
}
