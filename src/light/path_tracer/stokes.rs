//! Stokes vectors (I, Q, U) and the matrices that act on them. Circular polarisation is left out: dipoles never couple it to the rest.
//!
//! A direction w is the way one looks, against the light. Its transverse plane has the basis e_th = (mu cos p, mu sin p, -s),
//! e_ph = (-sin p, cos p, 0), with mu = cosine of the zenith angle at the observer, s = its sine, p = azimuth. With the coherency
//! matrix C in that basis I = C_tt + C_pp, Q = C_tt - C_pp, U = 2 C_tp: Q > 0 is light that swings in the vertical plane of the view.
//! The observer's vertical serves as the pole at every vertex of a path, so no rotation of bases is ever needed: a dipole turns
//! the field E' of the light into E = (e_a . e'_b) E'_b (Chandrasekhar 1950, I.16).

use glam::DVec3;

/// A Stokes vector (I, Q, U).
pub(super) type Stokes = [f64; 3];

/// Basis (e_th, e_ph) of the plane across a direction.
pub(super) type Basis = (DVec3, DVec3);

/// The basis that belongs to `direction`; at the zenith and the nadir that of azimuth 0.
pub(super) fn basis(direction: DVec3) -> Basis {
    let sine = direction.x.hypot(direction.y);
    let (cosine_azimuth, sine_azimuth) = if sine > 0.0 { (direction.x / sine, direction.y / sine) } else { (1.0, 0.0) };
    (DVec3::new(direction.z * cosine_azimuth, direction.z * sine_azimuth, -sine), DVec3::new(-sine_azimuth, cosine_azimuth, 0.0))
}

/// A linear map of Stokes vectors, by rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mueller(pub [Stokes; 3]);

impl Mueller {
    pub const IDENTITY: Self = Self([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);

    /// What leaves unpolarised, whatever comes in.
    pub fn depolarising(factor: f64) -> Self {
        Self([[factor, 0.0, 0.0], [0.0; 3], [0.0; 3]])
    }

    /// Scattering of light seen in the basis `from` into the basis `into` by a dipole, 4 pi times per steradian: for
    /// unpolarised light the Rayleigh phase function 3/4 (1 + cos^2).
    pub fn dipole(into: &Basis, from: &Basis) -> Self {
        let (a, b) = (into.0.dot(from.0), into.0.dot(from.1));
        let (c, d) = (into.1.dot(from.0), into.1.dot(from.1));
        let (aa, bb, cc, dd) = (a * a, b * b, c * c, d * d);
        let k = 0.75;
        Self([
            [k * (aa + bb + cc + dd), k * (aa - bb + cc - dd), 2.0 * k * (a * b + c * d)],
            [k * (aa + bb - cc - dd), k * (aa - bb - cc + dd), 2.0 * k * (a * b - c * d)],
            [2.0 * k * (a * c + b * d), 2.0 * k * (a * c - b * d), 2.0 * k * (a * d + b * c)],
        ])
    }

    /// Share of unpolarised light that arrives as intensity: the weight of a path.
    pub fn intensity(&self) -> f64 {
        self.0[0][0]
    }

    pub fn scaled(&self, factor: f64) -> Self {
        Self(self.0.map(|row| row.map(|x| factor * x)))
    }

    /// This after `inner`.
    pub fn times(&self, inner: &Self) -> Self {
        Self(self.0.map(|row| std::array::from_fn(|j| (0..3).map(|k| row[k] * inner.0[k][j]).sum())))
    }

    pub fn applied_to(&self, stokes: &Stokes) -> Stokes {
        self.0.map(|row| row[0] * stokes[0] + row[1] * stokes[1] + row[2] * stokes[2])
    }
}

/// Unpolarised light from `source` scattered into the basis `into` by a dipole: the first column of [`Mueller::dipole`].
pub(super) fn dipole_of_natural_light(into: &Basis, source: DVec3) -> Stokes {
    let (a, b) = (source.dot(into.0), source.dot(into.1));
    [0.75 * (2.0 - a * a - b * b), 0.75 * (b * b - a * a), -1.5 * a * b]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn directions() -> Vec<DVec3> {
        [(0.3, 0.4, 0.866), (-0.7, 0.1, -0.2), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.9, -0.43, 0.05)]
            .map(|(x, y, z)| DVec3::new(x, y, z).normalize())
            .to_vec()
    }

    #[test]
    fn the_basis_is_right_handed_and_its_first_vector_points_down_the_vertical_plane() {
        for w in directions() {
            let (e_th, e_ph) = basis(w);
            assert!(e_th.cross(e_ph).distance(w) < 1e-12);
            assert!(e_th.z <= 0.0 && e_ph.z == 0.0);
        }
    }

    #[test]
    fn natural_light_takes_the_first_column() {
        for w in directions() {
            for s in directions() {
                let matrix = Mueller::dipole(&basis(w), &basis(s));
                let column = dipole_of_natural_light(&basis(w), s);
                for i in 0..3 {
                    assert!((matrix.0[i][0] - column[i]).abs() < 1e-12);
                }
                assert!((column[0] - 0.75 * (1.0 + w.dot(s).powi(2))).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_right_angle_polarises_fully_and_across_the_plane_of_scattering() {
        // Looking at the horizon below a Sun in the zenith: light swings horizontally.
        let stokes = dipole_of_natural_light(&basis(DVec3::X), DVec3::Z);
        assert!((stokes[0] - 0.75).abs() < 1e-12 && (stokes[1] + 0.75).abs() < 1e-12 && stokes[2].abs() < 1e-12);
    }

    #[test]
    fn the_matrix_is_that_of_the_dipoles_field() {
        // C = J C' J^T for a fully polarised wave with E' = (cos x, sin x).
        let (into, from) = (basis(directions()[0]), basis(directions()[1]));
        for x in [0.0, 0.4, 1.3, 2.6_f64] {
            let field = from.0 * x.cos() + from.1 * x.sin();
            let (t, p) = (field.dot(into.0), field.dot(into.1));
            let expected = [t * t + p * p, t * t - p * p, 2.0 * t * p].map(|v| 1.5 * v);
            let found = Mueller::dipole(&into, &from).applied_to(&[1.0, (2.0 * x).cos(), (2.0 * x).sin()]);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {expected:?}");
        }
    }
}
