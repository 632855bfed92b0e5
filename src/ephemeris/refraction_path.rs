//! The bending of one ray through a spherical atmosphere.
//!
//! With the refractive index n(r), the ray keeps n r sin psi = a (Bouguer), psi its zenith angle at radius r. Its total bending is
//!
//! R = - integral over psi from 0 to the observer's psi_0 of (d ln n / d ln r) / (1 + d ln n / d ln r)
//!
//! with r(psi) from Bouguer's law: an integrand without the singularity that the textbook integral has at the horizon (Auer &
//! Standish 2000, AJ 119, 2472, eq. 3). For psi_0 > 90 degrees it holds as it stands: the ray comes down to its lowest point at psi = 90
//! degrees and rises to the observer.
//!
//! Symbols: z altitude [m], r = planet radius + z [m], psi [radians].

/// Altitude above which the bending is neglected [m]: n - 1 is below 1e-11 there.
const TOP_M: f64 = 120_000.0;

/// Largest curvature of a ray in units of the planet's: a layer that bent it more would be a duct, which has no horizon.
const LARGEST_CURVATURE: f64 = 0.9;

/// A thin shell of air in which n is linear in r.
#[derive(Clone, Copy, Debug)]
struct Shell {
    low_r: f64,
    high_r: f64,
    low_index: f64,
    /// dn / dr [m-1].
    slope: f64,
}

impl Shell {
    /// n r sin psi of a horizontal ray at radius r.
    fn invariant(&self, r: f64) -> f64 {
        (self.low_index + self.slope * (r - self.low_r)) * r
    }

    /// Bending between two zenith angles, both at most a right angle, of a ray with n r sin psi = `a`.
    fn bending(&self, a: f64, psi_high: f64, psi_low: f64) -> f64 {
        // Gauss-Legendre, 2 points: the shells are thin.
        let (middle, half) = (0.5 * (psi_high + psi_low), 0.5 * (psi_low - psi_high));
        let offset = half / 3.0_f64.sqrt();
        half * (self.integrand(a, middle - offset) + self.integrand(a, middle + offset))
    }

    fn integrand(&self, a: f64, psi: f64) -> f64 {
        // n r = a / sin psi is quadratic in the height x above the shell's bottom; this form of its root has no cancellation.
        let b = self.low_index + self.slope * self.low_r;
        let c = self.low_index * self.low_r - a / psi.sin();
        let x = -2.0 * c / (b + (b * b - 4.0 * self.slope * c).max(0.0).sqrt());
        let log_slope = (self.low_r + x) * self.slope / (self.low_index + self.slope * x);
        -log_slope / (1.0 + log_slope)
    }
}

/// The air as shells, from the lowest point that a ray can reach to the top.
#[derive(Clone, Debug)]
pub(super) struct Shells {
    below_observer: Vec<Shell>,
    above_observer: Vec<Shell>,
    observer_invariant: f64,
    ground_invariant: f64,
}

impl Shells {
    /// `refractivity` is n - 1 at an altitude [m]; the ground is at altitude 0, or at the observer if that is lower.
    pub(super) fn new(refractivity: &impl Fn(f64) -> f64, planet_radius_m: f64, observer_elevation_m: f64) -> Self {
        let ground = observer_elevation_m.min(0.0);
        let below = shells(refractivity, planet_radius_m, ground, observer_elevation_m);
        let above = shells(refractivity, planet_radius_m, observer_elevation_m, TOP_M.max(observer_elevation_m + 1.0));
        let bottom = |shells: &[Shell]| shells.first().map(|shell| shell.invariant(shell.low_r));
        let observer_invariant = bottom(&above).unwrap_or(planet_radius_m);
        let ground_invariant = bottom(&below).unwrap_or(observer_invariant);
        Self { below_observer: below, above_observer: above, observer_invariant, ground_invariant }
    }

    /// Apparent altitude of the horizon, 0 or negative [radians].
    pub(super) fn horizon(&self) -> f64 {
        -(self.ground_invariant / self.observer_invariant).min(1.0).acos()
    }

    /// Bending [radians] of the ray that arrives at an apparent altitude [radians], which is not below the horizon.
    pub(super) fn bending(&self, apparent_altitude: f64) -> f64 {
        let a = self.observer_invariant * apparent_altitude.cos();
        let above = crossing(&self.above_observer, a);
        if apparent_altitude >= 0.0 {
            return above;
        }
        // Down to the lowest point and up again.
        above + 2.0 * crossing(&self.below_observer, a)
    }
}

/// Bending of a ray with n r sin psi = `a` in all shells, or their parts, that it reaches, once.
fn crossing(shells: &[Shell], a: f64) -> f64 {
    let zenith_angle = |invariant: f64| (a / invariant).min(1.0).asin();
    shells
        .iter()
        .map(|shell| {
            let high = shell.invariant(shell.high_r);
            if high <= a {
                return 0.0;
            }
            shell.bending(a, zenith_angle(high), zenith_angle(shell.invariant(shell.low_r)))
        })
        .sum()
}

fn shells(refractivity: &impl Fn(f64) -> f64, planet_radius_m: f64, low_m: f64, high_m: f64) -> Vec<Shell> {
    let index = |z: f64| {
        let n = refractivity(z);
        1.0 + if n.is_finite() { n.max(0.0) } else { 0.0 }
    };
    let mut shells = Vec::new();
    let mut low = low_m;
    while low < high_m {
        let step = if low < 15_000.0 { 50.0 } else { (low / 100.0).min(1000.0) };
        let high = if low + 1.5 * step < high_m { low + step } else { high_m };
        let (low_index, low_r) = (index(low), planet_radius_m + low);
        let steepest = -LARGEST_CURVATURE * low_index / (planet_radius_m + high);
        let slope = ((index(high) - low_index) / (high - low)).max(steepest);
        shells.push(Shell { low_r, high_r: planet_radius_m + high, low_index, slope });
        low = high;
    }
    shells
}
