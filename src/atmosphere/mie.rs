//! Light scattered by a homogeneous sphere: Mie theory.
//!
//! Symbols and formulas are those of Bohren & Huffman, Absorption and Scattering of Light by Small Particles (1983), chapter 4: the size
//! parameter x = 2 pi r / wavelength, the coefficients a_n and b_n (eq. 4.88), the angular functions pi_n and tau_n (eq. 4.47) and the
//! amplitudes S_1 and S_2 (eq. 4.74). The logarithmic derivative comes from downward recurrence, and the series ends where Wiscombe
//! (Applied Optics 19, 1505, 1980) ends it. A refractive index n + i k absorbs where k > 0.

use super::complex::Complex;

/// Efficiencies of a sphere: cross-sections divided by its geometric one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Efficiencies {
    /// Extinction.
    pub extinction: f64,
    /// Scattering.
    pub scattering: f64,
    /// Asymmetry parameter: mean cosine of the scattering angle.
    pub asymmetry: f64,
}

/// The scattering coefficients of one sphere.
#[derive(Clone, Debug)]
pub struct Sphere {
    size_parameter: f64,
    a: Vec<Complex>,
    b: Vec<Complex>,
}

/// Number of terms of the series for size parameter `x` (Wiscombe 1980, eq. 22; the middle form is used for all x > 8).
pub fn terms(x: f64) -> usize {
    if x <= 8.0 { (x + 4.0 * x.cbrt() + 2.0).ceil() as usize } else { (x + 4.05 * x.cbrt() + 2.0).ceil() as usize }
}

impl Sphere {
    /// The sphere with size parameter `x` (0.001 to 10 000) and the refractive index `real` + i `imaginary` relative to its surroundings,
    /// imaginary >= 0.
    pub fn new(x: f64, real: f64, imaginary: f64) -> Self {
        let m = Complex::new(real, imaginary);
        let count = terms(x);
        let derivatives = logarithmic_derivatives(m * x, count);
        // Riccati-Bessel functions psi_n and chi_n by upward recurrence from orders -1 and 0; xi_n = psi_n - i chi_n.
        let (mut psi_before, mut psi) = (x.cos(), x.sin());
        let (mut chi_before, mut chi) = (-x.sin(), x.cos());
        let (mut a, mut b) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for (n, &derivative) in derivatives.iter().enumerate().skip(1) {
            let order = n as f64;
            let (psi_n, chi_n) = ((2.0 * order - 1.0) / x * psi - psi_before, (2.0 * order - 1.0) / x * chi - chi_before);
            (psi_before, psi, chi_before, chi) = (psi, psi_n, chi, chi_n);
            let (xi, xi_before) = (Complex::new(psi, -chi), Complex::new(psi_before, -chi_before));
            let coefficient = |factor: Complex| (factor * psi + -psi_before) / (factor * xi - xi_before);
            a.push(coefficient(derivative / m + order / x));
            b.push(coefficient(derivative * m + order / x));
        }
        Self { size_parameter: x, a, b }
    }

    /// Extinction and scattering efficiency and asymmetry (Bohren & Huffman, eqs. 4.61, 4.62 and the end of section 4.5).
    pub fn efficiencies(&self) -> Efficiencies {
        let (mut extinction, mut scattering, mut asymmetry) = (0.0, 0.0, 0.0);
        for (k, (&a, &b)) in self.a.iter().zip(&self.b).enumerate() {
            let n = (k + 1) as f64;
            extinction += (2.0 * n + 1.0) * (a.re + b.re);
            scattering += (2.0 * n + 1.0) * (a.norm() + b.norm());
            asymmetry += (2.0 * n + 1.0) / (n * (n + 1.0)) * (a * b.conjugate()).re;
            if let (Some(&next_a), Some(&next_b)) = (self.a.get(k + 1), self.b.get(k + 1)) {
                asymmetry += n * (n + 2.0) / (n + 1.0) * ((a * next_a.conjugate()).re + (b * next_b.conjugate()).re);
            }
        }
        let factor = 2.0 / (self.size_parameter * self.size_parameter);
        Efficiencies { extinction: factor * extinction, scattering: factor * scattering, asymmetry: 2.0 * asymmetry / scattering }
    }

    /// Adds `weight` times the scattered intensity (|S_1|^2 + |S_2|^2) / 2 of natural light to `sum`, one value for each angle of
    /// `angular`. The phase function is 4 times that intensity divided by x^2 and the scattering efficiency.
    ///
    /// # Panics
    /// If `angular` has too few terms or another number of angles than `sum`.
    pub fn add_intensity(&self, angular: &AngularFunctions, weight: f64, sum: &mut [f64]) {
        let count = angular.angles;
        assert!(sum.len() == count && angular.sums.len() >= self.a.len() * count, "angular functions for this sphere and sum");
        // S_1 + S_2 = sum of (a + b) (pi + tau) and S_1 - S_2 = sum of (a - b) (pi - tau), each times (2n + 1) / (n (n + 1)).
        let mut parts = vec![[0.0; 4]; count];
        for (n, (&a, &b)) in self.a.iter().zip(&self.b).enumerate() {
            let (plus, minus) = (a + b, a - b);
            let row = n * count..(n + 1) * count;
            for ((part, s), d) in parts.iter_mut().zip(&angular.sums[row.clone()]).zip(&angular.differences[row]) {
                part[0] += plus.re * s;
                part[1] += plus.im * s;
                part[2] += minus.re * d;
                part[3] += minus.im * d;
            }
        }
        for (sum, part) in sum.iter_mut().zip(parts) {
            *sum += 0.25 * weight * part.iter().map(|p| p * p).sum::<f64>();
        }
    }
}

/// D_n(z) = psi_n'(z) / psi_n(z) for n = 0 to `count`, by downward recurrence (Bohren & Huffman, eq. 4.89). It starts at 0 so far above
/// |z|, eight widths of the turning point, that this error is lost; with the usual 15 orders, the efficiencies at x = 100 are off by 3e-6.
fn logarithmic_derivatives(z: Complex, count: usize) -> Vec<Complex> {
    let size = z.norm().sqrt();
    let start = count.max((size + 8.0 * size.cbrt()).ceil() as usize) + 16;
    let inverse = z.inverse();
    let mut derivatives = vec![Complex::new(0.0, 0.0); count + 1];
    let mut d = Complex::new(0.0, 0.0);
    for n in (1..=start).rev() {
        let ratio = inverse * n as f64;
        d = ratio - (d + ratio).inverse();
        if n <= count + 1 {
            derivatives[n - 1] = d;
        }
    }
    derivatives
}

/// The angular functions of the series at given scattering angles, shared by all spheres.
#[derive(Clone, Debug)]
pub struct AngularFunctions {
    angles: usize,
    /// (2n + 1) / (n (n + 1)) (pi_n + tau_n), row-major, shape (terms, angles).
    sums: Vec<f64>,
    /// The same of pi_n - tau_n.
    differences: Vec<f64>,
}

impl AngularFunctions {
    /// Number of angles.
    #[allow(clippy::len_without_is_empty, reason = "not a collection")]
    pub fn len(&self) -> usize {
        self.angles
    }

    /// For scattering angles with cosines `cosines` and spheres with at most `terms` [`terms`].
    pub fn new(cosines: &[f64], terms: usize) -> Self {
        let angles = cosines.len();
        let (mut sums, mut differences) = (Vec::with_capacity(terms * angles), Vec::with_capacity(terms * angles));
        let (mut before, mut now) = (vec![0.0; angles], vec![1.0; angles]);
        for n in 1..=terms {
            let order = n as f64;
            let factor = (2.0 * order + 1.0) / (order * (order + 1.0));
            for ((&mu, before), now) in cosines.iter().zip(&mut before).zip(&mut now) {
                let tau = order * mu * *now - (order + 1.0) * *before;
                sums.push(factor * (*now + tau));
                differences.push(factor * (*now - tau));
                let next = ((2.0 * order + 1.0) * mu * *now - (order + 1.0) * *before) / order;
                (*before, *now) = (*now, next);
            }
        }
        Self { angles, sums, differences }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn intensity(sphere: &Sphere, degrees: &[f64]) -> Vec<f64> {
        let cosines: Vec<f64> = degrees.iter().map(|d| d.to_radians().cos()).collect();
        let mut sum = vec![0.0; degrees.len()];
        sphere.add_intensity(&AngularFunctions::new(&cosines, sphere.a.len()), 1.0, &mut sum);
        sum
    }

    #[test]
    fn the_example_of_bohren_and_huffman() {
        // checked against: Bohren & Huffman 1983, appendix A: radius 0.525 um, wavelength 0.6328 um, m = 1.55; S_11 relative to forward
        let sphere = Sphere::new(std::f64::consts::TAU * 0.525 / 0.6328, 1.55, 0.0);
        let e = sphere.efficiencies();
        assert!((e.extinction - 3.10543).abs() < 1e-5 && (e.scattering - 3.10543).abs() < 1e-5, "{e:?}");
        assert!((e.asymmetry - 0.63314).abs() < 1e-5, "{e:?}");
        let s = intensity(&sphere, &[0.0, 18.0, 27.0, 36.0, 90.0]);
        for (k, expected) in [(1, 0.356_897), (2, 0.076_611_9), (3, 0.035_535_5), (4, 0.012_460_1)] {
            assert!((s[k] / s[0] / expected - 1.0).abs() < 1e-5, "{k}: {}", s[k] / s[0]);
        }
    }

    #[test]
    fn the_test_cases_of_wiscombe() {
        // checked against: Wiscombe, Mie Scattering Calculations, NCAR/TN-140+STR (1979), table of test cases: m, x, Q_ext, Q_sca, g
        let cases = [
            (0.75, 0.0, 0.099, 7.417_859e-6, 7.417_859e-6, 0.001_448),
            (0.75, 0.0, 10.0, 2.232_265, 2.232_265, 0.896_473),
            (0.75, 0.0, 1000.0, 1.997_908, 1.997_908, 0.844_944),
            (1.5, 1.0, 1.0, 2.336_321, 0.663_454, 0.192_136),
            (1.5, 1.0, 100.0, 2.097_502, 1.283_697, 0.850_252),
            (1.5, 1.0, 10_000.0, 2.004_368, 1.236_575, 0.846_310),
            (1.33, 1e-5, 1.0, 0.093_952, 0.093_923, 0.184_517),
            (1.33, 1e-5, 100.0, 2.101_321, 2.096_594, 0.868_959),
        ];
        for (n, k, x, extinction, scattering, asymmetry) in cases {
            let e = Sphere::new(x, n, k).efficiencies();
            for (value, expected) in [(e.extinction, extinction), (e.scattering, scattering), (e.asymmetry, asymmetry)] {
                assert!((value - expected).abs() <= 1e-6 * f64::abs(expected) + 6e-7, "m {n} {k}, x {x}: {e:?}");
            }
        }
    }

    #[test]
    fn a_small_sphere_scatters_like_a_dipole() {
        let sphere = Sphere::new(0.01, 1.5, 0.0);
        let polarisability: f64 = (1.5 * 1.5 - 1.0) / (1.5 * 1.5 + 2.0);
        let e = sphere.efficiencies();
        assert!((e.scattering / (8.0 / 3.0 * 1e-8 * polarisability.powi(2)) - 1.0).abs() < 1e-3);
        let s = intensity(&sphere, &[0.0, 60.0, 90.0]);
        assert!((s[1] / s[0] - 0.625).abs() < 1e-4 && (s[2] / s[0] - 0.5).abs() < 1e-4);
    }

    #[test]
    fn extinction_follows_from_the_forward_amplitude_and_scattering_from_the_intensities() {
        let (x, n, k) = (12.3, 1.4, 0.02);
        let sphere = Sphere::new(x, n, k);
        let e = sphere.efficiencies();
        let count = 20_000;
        let degrees: Vec<f64> = (0..count).map(|i| (f64::from(i) + 0.5) * 180.0 / f64::from(count)).collect();
        let intensities = intensity(&sphere, &degrees);
        let (mut whole, mut forward) = (0.0, 0.0);
        for (i, d) in intensities.iter().zip(&degrees) {
            let (sine, cosine) = d.to_radians().sin_cos();
            whole += i * sine;
            forward += i * sine * cosine;
        }
        let step = std::f64::consts::PI / f64::from(count);
        assert!((2.0 * whole * step / (x * x) / e.scattering - 1.0).abs() < 1e-6);
        assert!((forward / whole - e.asymmetry).abs() < 1e-6);
        assert!(e.extinction > e.scattering);
        let transparent = Sphere::new(x, n, 0.0).efficiencies();
        assert!((transparent.extinction / transparent.scattering - 1.0).abs() < 1e-12);
    }
}
