//! Polarised light: Stokes parameters in the frame of a ray, and what a dipole makes of the light at a point.
//!
//! Look direction w at zenith cosine mu, s = sqrt(1 - mu^2), azimuth p from the Sun. The ray's frame is
//! ```text
//! e_theta = (mu cos p, mu sin p, -s),   e_phi = (-sin p, cos p, 0)
//! ```
//! and with the coherency matrix C of the light, I = Ctt + Cpp, Q = Ctt - Cpp, U = 2 Ctp: Q > 0 is vertical. Every local vertical that a straight ray
//! meets lies in the ray's own vertical plane, so this frame is the same all along the ray and I, Q, U are plain sums over its points.
//!
//! A dipole that is lit by light with the tensor T = integral of C over all directions sends (3 / 8 pi) P T P into w, P = 1 - w w^T. An anisotropic molecule with depolarisation
//! ratio d does so with the share D = (1 - d) / (1 + d / 2) of its scattering; the rest is unpolarised and isotropic (Rayleigh's phase matrix: Chandrasekhar 1950, I.16;
//! Hansen & Travis 1974, section 2.2).

use super::lanes::Lanes;

/// Share D of a molecule's scattering that is a dipole's, for the depolarisation ratio `d`.
pub fn dipole_share(d: f64) -> f64 {
    (1.0 - d) / (1.0 + 0.5 * d)
}

/// Components along e_theta and e_phi, of a look direction with zenith cosine `mu` at `azimuth` [radians, counterclockwise from the Sun seen from above], of the unit
/// vector to a Sun at `sun_zenith` [radians].
pub fn transverse(mu: f64, azimuth: f64, sun_zenith: f64) -> [f64; 2] {
    let (sine, cosine) = sun_zenith.sin_cos();
    [sine * azimuth.cos() * mu - cosine * (1.0 - mu * mu).max(0.0).sqrt(), -sine * azimuth.sin()]
}

/// I, Q, U that a dipole scatters once, relative to its strength (P = 3/4 (1 + cos^2) for I): `a` and `b` are the components of the direction to the Sun along e_theta and e_phi.
#[inline(always)]
pub fn single_dipole([a, b]: [f64; 2]) -> [f64; 3] {
    [0.75 * (2.0 - a * a - b * b), 0.75 * (b * b - a * a), -1.5 * a * b]
}

/// Factors with which A, Z, X, B make the azimuthal parts of a dipole's source at zenith cosine `mu`; times 3 / (8 pi) and the scattering coefficient of the dipoles.
#[derive(Clone, Copy, Debug)]
pub struct DipoleSource {
    /// A in I, m = 0.
    pub i0_a: f32,
    /// Z in I, m = 0.
    pub i0_z: f32,
    /// Z - A in Q, m = 0.
    pub q0_za: f32,
    /// X in I and Q, m = 1.
    pub iq1_x: f32,
    /// B in I, m = 2.
    pub i2_b: f32,
    /// B in Q, m = 2.
    pub q2_b: f32,
    /// X in U, m = 1 (sine).
    pub u1_x: f32,
    /// B in U, m = 2 (sine).
    pub u2_b: f32,
}

impl DipoleSource {
    /// At zenith cosine `mu`.
    #[inline(always)]
    pub fn new(mu: f64) -> Self {
        let s2 = (1.0 - mu * mu).max(0.0);
        let s = s2.sqrt();
        let [one, s2, s, mu] = [1.0 + mu * mu, s2, s, mu].map(|v| v as f32);
        Self { i0_a: one, i0_z: s2, q0_za: s2, iq1_x: -2.0 * mu * s, i2_b: -s2, q2_b: one, u1_x: 2.0 * s, u2_b: -2.0 * mu }
    }
}

/// Adds to A, Z, X, B what light from zenith cosine `mu` with quadrature weight `weight` (which includes nothing of azimuth) gives: its azimuthal integrals
/// of I cos(m p) and Q cos(m p) for m = 0, 1, 2 and of U sin(m p) for m = 1, 2.
#[inline(always)]
pub fn add_tensor<const N: usize>(
    tensor: &mut [Lanes<N>],
    mu: f64,
    weight: f64,
    i: &[Lanes<N>; 3],
    q: &[Lanes<N>; 3],
    u: &[Lanes<N>; 2],
) {
    let s2 = (1.0 - mu * mu).max(0.0);
    let s = s2.sqrt();
    let w = weight as f32;
    let [mu, s2, s] = [mu, s2, s].map(|v| v as f32);
    let (sum, difference) = (0.25 * w * (1.0 + mu * mu), 0.25 * w * (mu * mu - 1.0));
    for n in 0..N {
        tensor[0][n] += sum * i[0][n] + difference * q[0][n];
        tensor[1][n] += 0.5 * w * s2 * (i[0][n] + q[0][n]);
        tensor[2][n] += 0.5 * w * (s * u[0][n] - mu * s * (i[1][n] + q[1][n]));
        tensor[3][n] += difference * i[2][n] + sum * q[2][n] - 0.5 * w * mu * u[1][n];
    }
}

#[cfg(test)]
mod tests {
    use super::super::lanes::splat;
    use super::*;
    use glam::{DMat3, DVec3};

    fn outer(a: DVec3, b: DVec3) -> DMat3 {
        DMat3::from_cols(a * b.x, a * b.y, a * b.z)
    }

    fn frame(mu: f64, p: f64) -> [DVec3; 3] {
        let s = (1.0 - mu * mu).sqrt();
        [DVec3::new(mu * p.cos(), mu * p.sin(), -s), DVec3::new(-p.sin(), p.cos(), 0.0), DVec3::new(s * p.cos(), s * p.sin(), mu)]
    }

    /// The source of a tensor, against P T P written out.
    #[test]
    fn sources_are_the_projected_tensor() {
        let (a, z, x, b) = (0.7, 0.4, 0.1, -0.2);
        let tensor = DMat3::from_cols(DVec3::new(a + b, 0.0, x), DVec3::new(0.0, a - b, 0.0), DVec3::new(x, 0.0, z));
        for (mu, p) in [(0.3, 0.5), (-0.8, 2.0), (1.0, 0.4), (0.0, 3.0)] {
            let [theta, phi, _] = frame(mu, p);
            let (tt, pp, tp) = (theta.dot(tensor * theta), phi.dot(tensor * phi), theta.dot(tensor * phi));
            let f = DipoleSource::new(mu);
            let g = |v: f32| f64::from(v);
            let (c1, c2, s1, s2) = (p.cos(), (2.0 * p).cos(), p.sin(), (2.0 * p).sin());
            let i = g(f.i0_a) * a + g(f.i0_z) * z + g(f.iq1_x) * x * c1 + g(f.i2_b) * b * c2;
            let q = g(f.q0_za) * (z - a) + g(f.iq1_x) * x * c1 + g(f.q2_b) * b * c2;
            let u = g(f.u1_x) * x * s1 + g(f.u2_b) * b * s2;
            for (found, expected) in [(i, tt + pp), (q, tt - pp), (u, 2.0 * tp)] {
                assert!((found - expected).abs() < 1e-6, "{mu} {p}: {found} {expected}");
            }
        }
    }

    /// The tensor of light from one direction and its mirror image.
    #[test]
    fn tensors_are_integrals_of_the_coherency_matrix() {
        let (i, q, u) = (1.3, 0.4, -0.3);
        for (mu, p) in [(0.3, 0.5), (-0.8, 2.0), (0.9, 1.0)] {
            let mut expected = DMat3::ZERO;
            for (p, u) in [(p, u), (-p, -u)] {
                let [theta, phi, _] = frame(mu, p);
                expected += 0.5
                    * (outer(theta, theta) * (0.5 * (i + q))
                        + outer(phi, phi) * (0.5 * (i - q))
                        + (outer(theta, phi) + outer(phi, theta)) * (0.5 * u));
            }
            let lanes = |v: f64| splat::<16>(v as f32);
            let waves = |v: f64| [lanes(v), lanes(v * p.cos()), lanes(v * (2.0 * p).cos())];
            let mut tensor = [lanes(0.0); 4];
            let sines = [lanes(u * p.sin()), lanes(u * (2.0 * p).sin())];
            add_tensor(&mut tensor, mu, 1.0, &waves(i), &waves(q), &sines);
            let found = tensor.map(|lanes| f64::from(lanes[0]));
            let m = expected;
            let wanted = [0.5 * (m.x_axis.x + m.y_axis.y), m.z_axis.z, m.x_axis.z, 0.5 * (m.x_axis.x - m.y_axis.y)];
            for k in 0..4 {
                assert!((found[k] - wanted[k]).abs() < 1e-6, "{mu} {p} {k}: {found:?} {wanted:?}");
            }
        }
    }

    /// Sunlight is unpolarised: its projection on the plane across the ray is what a dipole sends there.
    #[test]
    fn single_scattering_is_the_dipole_in_sunlight() {
        for (mu, p, zenith) in [(0.3, 0.5, 0.9), (-0.8, 2.0, 1.4), (1.0, 0.4, 0.3)] {
            let sun = DVec3::new(f64::sin(zenith), 0.0, f64::cos(zenith));
            let tensor = (DMat3::IDENTITY - outer(sun, sun)) * 0.5;
            let [theta, phi, view] = frame(mu, p);
            let [i, q, u] = single_dipole([sun.dot(theta), sun.dot(phi)]);
            let (tt, pp, tp) = (theta.dot(tensor * theta), phi.dot(tensor * phi), theta.dot(tensor * phi));
            // 4 pi times (3 / 8 pi).
            for (found, expected) in [(i, 1.5 * (tt + pp)), (q, 1.5 * (tt - pp)), (u, 3.0 * tp)] {
                assert!((found - expected).abs() < 1e-12, "{mu} {p}: {found} {expected}");
            }
            assert!((i - 0.75 * (1.0 + view.dot(sun).powi(2))).abs() < 1e-12);
        }
    }
}
