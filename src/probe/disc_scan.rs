//! The light of a possibly flattened disc, cut by the horizon, as a quadrature over circles of equal zenith angle.
//!
//! With a direction w, the disc's centre s, its horizontal tangent h and its upward tangent v, and the angular radii a and b along them, the
//! disc is
//! ```text
//! r^2 = (w.h / sin a)^2 + (w.v / sin b)^2 <= 1,   w.s > 0,
//! ```
//! which is exactly a spherical cap for a = b. Its brightness is that of its surface at (w.h / sin a, w.v / sin b). On the circle of zenith angle theta, at azimuth phi from the
//! centre (zenith angle theta_0), with q = sin^2(phi / 2):
//! ```text
//! (w.h)^2 = 4 sin^2(theta) q (1 - q),   w.v = sin(theta_0 - theta) + 2 sin(theta) cos(theta_0) q,
//! ```
//! (differences of angles, so that nothing cancels for a disc of 0.005 radians), and the ends of the chord are a root of a quadratic in q.
//! Both integrals use the sine of a parameter as variable, which removes the square roots at the ends; they are cut at
//! knots where the caller's integrand has edges, so that the coverage of pixels is exact rather than sampled.

use crate::numerics::GaussLegendre;
use crate::sky::Disc;
use std::f64::consts::PI;

/// A point of the quadrature.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sample {
    /// Zenith angle [radians].
    pub theta: f64,
    /// Azimuth [radians], not reduced.
    pub azimuth: f64,
    /// Brightness relative to the centre times solid angle [sr], for X, Y and Z.
    pub weight: [f64; 3],
}

/// Greatest length of a piece in the sine parameter; four nodes on it are exact to about 1e-9.
const PIECE: f64 = PI / 8.0;

struct Chord {
    sine: f64,
    /// w.v at the azimuth of the centre, and its slope in q.
    above: f64,
    slope: f64,
    /// Half of the chord in azimuth [radians]; pi for a whole circle.
    half: f64,
}

struct Shape {
    theta: f64,
    /// Squares of the sines of the radii.
    across: f64,
    along: f64,
}

impl Shape {
    fn chord(&self, theta: f64) -> Option<Chord> {
        let sine = theta.sin();
        let above = (self.theta - theta).sin();
        let slope = 2.0 * sine * self.theta.cos();
        // a q^2 + b q + c <= 0 is the inside of the disc.
        let c = above * above / self.along - 1.0;
        if c >= 0.0 {
            return None;
        }
        let a = slope * slope / self.along - 4.0 * sine * sine / self.across;
        let b = 4.0 * sine * sine / self.across + 2.0 * above * slope / self.along;
        let discriminant = b * b - 4.0 * a * c;
        let denominator = b + discriminant.max(0.0).sqrt();
        let q = if discriminant < 0.0 || denominator <= 0.0 { 1.0 } else { (-2.0 * c / denominator).min(1.0) };
        Some(Chord { sine, above, slope, half: 2.0 * q.sqrt().asin() })
    }

    /// Place on the disc, to the right and upwards in units of the radii, at `azimuth` from the centre on a chord.
    fn place(&self, chord: &Chord, azimuth: f64) -> (f64, f64) {
        let q = (0.5 * azimuth).sin().powi(2);
        let (across, along) = (chord.sine * azimuth.sin(), chord.above + chord.slope * q);
        (across / self.across.sqrt(), along / self.along.sqrt())
    }
}

/// Calls `visit` with samples whose weights add up to the integral of the disc's relative brightness over its part with zenith
/// angle up to `cut` [radians].
///
/// `row_knots` are zenith angles in ascending order, and `column_knots(theta, from, to, knots)` appends azimuths in ascending order within
/// (`from`, `to`): no interval of quadrature spans a knot.
pub(crate) fn scan(
    disc: &Disc,
    cut: f64,
    row_knots: &[f64],
    mut column_knots: impl FnMut(f64, f64, f64, &mut Vec<f64>),
    mut visit: impl FnMut(Sample),
) {
    let rule = GaussLegendre::new(4);
    let centre = disc.direction.truncate().length().atan2(disc.direction.z);
    let azimuth = disc.direction.x.atan2(disc.direction.y);
    let radius = disc.vertical_radius;
    let shape = Shape { theta: centre, across: disc.horizontal_radius.sin().powi(2), along: radius.sin().powi(2) };
    let (top, bottom) = ((centre - radius).max(0.0), (centre + radius).min(PI).min(cut));
    if top >= bottom {
        return;
    }
    let parameter = |theta: f64| ((theta - centre) / radius).clamp(-1.0, 1.0).asin();

    // Circles closer to a pole than its distance to the disc's edge are whole: the chord has a kink there.
    let mut thetas = vec![top, bottom];
    let first = row_knots.partition_point(|&knot| knot <= top);
    thetas.extend(row_knots[first..].iter().copied().take_while(|&knot| knot < bottom));
    for (kink, end) in [(radius - centre, bottom), (2.0 * PI - centre - radius, top)] {
        if kink > top && kink < bottom {
            // It opens like a square root: pieces that shrink towards it.
            thetas.extend([0.0, 1e-3, 4e-3, 0.016, 0.064, 0.25].map(|share| kink + share * (end - kink)));
        }
    }
    thetas.sort_by(f64::total_cmp);

    let mut azimuths = Vec::new();
    for rows in thetas.windows(2) {
        for (at, row_weight) in pieces(&rule, parameter(rows[0]), parameter(rows[1])) {
            let theta = centre + radius * at.sin();
            let Some(chord) = shape.chord(theta) else { continue };
            let row_weight = row_weight * radius * at.cos() * chord.sine;
            azimuths.clear();
            azimuths.push(azimuth - chord.half);
            column_knots(theta, azimuth - chord.half, azimuth + chord.half, &mut azimuths);
            azimuths.push(azimuth + chord.half);
            for columns in azimuths.windows(2) {
                let along = |azimuth_: f64| ((azimuth_ - azimuth) / chord.half).clamp(-1.0, 1.0).asin();
                for (on, column_weight) in pieces(&rule, along(columns[0]), along(columns[1])) {
                    let offset = chord.half * on.sin();
                    let (right, up) = shape.place(&chord, offset);
                    let weight = row_weight * column_weight * chord.half * on.cos();
                    let weight = disc.surface.brightness(right, up).map(|brightness| weight * brightness);
                    visit(Sample { theta, azimuth: azimuth + offset, weight });
                }
            }
        }
    }
}

/// Nodes and weights on [`from`, `to`], in equal pieces no longer than [`PIECE`].
fn pieces(rule: &GaussLegendre, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
    let count = ((to - from) / PIECE).ceil().max(1.0);
    let step = (to - from) / count;
    (0..count as usize).flat_map(move |k| rule.on(from + k as f64 * step, from + (k + 1) as f64 * step))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::projection::direction;
    use crate::sky::Surface;
    use glam::DVec3;

    fn disc(theta: f64, azimuth: f64, horizontal: f64, vertical: f64, limb: [f64; 2]) -> Disc {
        Disc {
            is_sun: true,
            direction: direction(theta, azimuth),
            horizontal_radius: horizontal,
            vertical_radius: vertical,
            irradiance: [1.0; 3],
            surface: Surface::LimbDarkened([limb; 3]),
        }
    }

    fn moments(disc: &Disc, cut: f64) -> (f64, DVec3) {
        let (mut sum, mut vector) = (0.0, DVec3::ZERO);
        scan(
            disc,
            cut,
            &[],
            |_, _, _, _| {},
            |sample| {
                sum += sample.weight[1];
                vector += sample.weight[1] * direction(sample.theta, sample.azimuth);
            },
        );
        (sum, vector)
    }

    #[test]
    fn a_uniform_round_disc_has_the_solid_angle_of_a_cap_wherever_it_stands() {
        let radius: f64 = 0.00465;
        let cap = 4.0 * PI * (0.5 * radius).sin().powi(2);
        for theta in [0.0, 0.5 * radius, radius, 1.5 * radius, 0.3, 1.2, PI / 2.0, 2.0, PI - 0.001, PI] {
            let (sum, vector) = moments(&disc(theta, 2.0, radius, radius, [0.0; 2]), PI);
            assert!((sum / cap - 1.0).abs() < 1e-6, "theta {theta}: {}", sum / cap);
            assert!(vector.normalize().distance(direction(theta, 2.0)) < 1e-8, "theta {theta}");
        }
    }

    #[test]
    fn limb_darkening_dims_as_its_closed_form_says() {
        // The mean of 1 - u (1 - m) - v (1 - m)^2 over the disc, with weight 2 m dm, is 1 - u / 3 - v / 6.
        let radius = 0.001;
        let (plain, _) = moments(&disc(1.0, 0.0, radius, radius, [0.0; 2]), PI);
        let (dark, _) = moments(&disc(1.0, 0.0, radius, radius, [0.5, 0.2]), PI);
        assert!((dark / plain - (1.0 - 0.5 / 3.0 - 0.2 / 6.0)).abs() < 1e-6, "{}", dark / plain);
    }

    #[test]
    fn a_flattened_disc_shrinks_by_its_axes_and_half_of_it_remains_at_the_horizon() {
        let (whole, _) = moments(&disc(PI / 2.0, 1.0, 0.005, 0.004, [0.4, 0.3]), PI);
        let (round, _) = moments(&disc(PI / 2.0, 1.0, 0.005, 0.005, [0.4, 0.3]), PI);
        assert!((whole / round - 0.8).abs() < 1e-5);
        let (half, vector) = moments(&disc(PI / 2.0, 1.0, 0.005, 0.004, [0.0; 2]), PI / 2.0);
        let (uniform, _) = moments(&disc(PI / 2.0, 1.0, 0.005, 0.004, [0.0; 2]), PI);
        assert!((half / uniform - 0.5).abs() < 1e-6);
        // Centroid of half an ellipse: 4 b / 3 pi.
        assert!((vector.z / half - 4.0 * 0.004 / (3.0 * PI)).abs() < 1e-7);
        assert_eq!(moments(&disc(1.7, 1.0, 0.005, 0.005, [0.0; 2]), PI / 2.0).0, 0.0);
    }
}
