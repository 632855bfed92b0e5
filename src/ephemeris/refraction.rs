//! Atmospheric refraction: between where a body is and where it is seen, through a given spherical air.
//!
//! true altitude = apparent altitude - R(apparent altitude), with R the bending of the ray (`refraction_path.rs`). R is
//! tabulated once for an air and an observer's elevation, from the horizon (below 0 degrees for an elevated observer: the dip) to
//! the zenith, and looked up with an error below 0.01 arcminutes for observers up to 2 km. From 60 km it reaches 1 arcminute for the one ray
//! that grazes the tropopause: bending has a cusp wherever the temperature gradient has a step.
//!
//! A body below the horizon sends no ray. To keep motion smooth there, R fades from its value at the horizon to 0 over the next
//! 3 degrees of true altitude; below that the airless altitude is returned.

use super::refraction_path::Shells;
use super::root::bracketed_root;

/// Intervals of the table; they are quadratically closer towards the horizon.
const INTERVALS: usize = 240;

/// Range below the horizon in which refraction fades out [degrees of true altitude].
const FADE_DEG: f64 = 3.0;

/// What the air does to altitudes, for one air and one elevation of the observer.
#[derive(Clone, Debug, Default)]
pub struct Refraction {
    table: Option<Table>,
}

#[derive(Clone, Debug)]
struct Table {
    /// Apparent altitude of the horizon [degrees].
    horizon_deg: f64,
    /// R at the apparent altitudes horizon + (90 - horizon) (i / INTERVALS)^2 [degrees].
    bending_deg: Vec<f64>,
}

impl Refraction {
    /// Traces rays through air of `refractivity(altitude_m)` = n - 1 around a planet of `planet_radius_m` to an observer at
    /// `observer_elevation_m`. Takes 5 to 10 ms.
    ///
    /// The refractivity is asked for from the ground (altitude 0, or the observer if lower) to 120 km; negative or
    /// infinite values count as 0, and decreases so steep that light would circle the planet are limited. A radius that is not
    /// positive or an elevation that is not finite gives [`Refraction::none`].
    pub fn new(refractivity: impl Fn(f64) -> f64, planet_radius_m: f64, observer_elevation_m: f64) -> Self {
        let is_planet = planet_radius_m.is_finite() && planet_radius_m > 0.0;
        if !is_planet || !observer_elevation_m.is_finite() || observer_elevation_m <= -planet_radius_m {
            return Self::none();
        }
        let shells = Shells::new(&refractivity, planet_radius_m, observer_elevation_m);
        let horizon_deg = shells.horizon().to_degrees();
        let bending_deg = (0..=INTERVALS)
            .map(|i| {
                let apparent = if i == 0 { horizon_deg } else { Table::altitude_deg(horizon_deg, i as f64) };
                shells.bending(apparent.to_radians()).to_degrees()
            })
            .collect();
        Self { table: Some(Table { horizon_deg, bending_deg }) }
    }

    /// No air: apparent and true altitude are the same, and the horizon is at 0.
    pub fn none() -> Self {
        Self { table: None }
    }

    /// Apparent altitude of a body at an airless altitude [degrees].
    pub fn apparent_altitude_deg(&self, true_altitude_deg: f64) -> f64 {
        match &self.table {
            Some(table) => table.apparent_deg(true_altitude_deg),
            None => true_altitude_deg,
        }
    }

    /// Airless altitude of what is seen at an apparent altitude [degrees]; the inverse of [`Refraction::apparent_altitude_deg`].
    pub fn true_altitude_deg(&self, apparent_altitude_deg: f64) -> f64 {
        match &self.table {
            Some(table) => table.true_deg(apparent_altitude_deg),
            None => apparent_altitude_deg,
        }
    }

    /// Apparent altitude of the horizon: 0 at the ground, less than 0 for an elevated observer [degrees].
    pub fn horizon_deg(&self) -> f64 {
        self.table.as_ref().map_or(0.0, |table| table.horizon_deg)
    }

    /// Airless altitude of a body that is seen at the horizon [degrees].
    pub fn horizon_true_altitude_deg(&self) -> f64 {
        self.table.as_ref().map_or(0.0, Table::lowest_true_deg)
    }

    /// Apparent height over width of a disc whose centre is at an airless altitude and whose angular diameter is
    /// `diameter_deg` [degrees]: 1 without refraction, 0.83 for the Sun at the horizon.
    pub fn flattening(&self, true_altitude_deg: f64, diameter_deg: f64) -> f64 {
        let radius = (0.5 * diameter_deg).max(1e-4);
        let top = self.apparent_altitude_deg((true_altitude_deg + radius).min(90.0));
        let bottom = self.apparent_altitude_deg((true_altitude_deg - radius).max(-90.0));
        (top - bottom) / ((true_altitude_deg + radius).min(90.0) - (true_altitude_deg - radius).max(-90.0))
    }
}

impl Table {
    fn altitude_deg(horizon_deg: f64, position: f64) -> f64 {
        horizon_deg + (90.0 - horizon_deg) * (position / INTERVALS as f64).powi(2)
    }

    fn lowest_true_deg(&self) -> f64 {
        self.horizon_deg - self.bending_deg[0]
    }

    /// R at an apparent altitude between horizon and zenith [degrees], by a cubic through the four nearest nodes.
    fn bending(&self, apparent_deg: f64) -> f64 {
        let share = ((apparent_deg - self.horizon_deg) / (90.0 - self.horizon_deg)).clamp(0.0, 1.0);
        let position = share.sqrt() * INTERVALS as f64;
        let first = (position as usize).clamp(1, INTERVALS - 2) - 1;
        let x = position - first as f64;
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| self.bending_deg[first + i]);
        let (x1, x2, x3) = (x - 1.0, x - 2.0, x - 3.0);
        -a * x1 * x2 * x3 / 6.0 + b * x * x2 * x3 / 2.0 - c * x * x1 * x3 / 2.0 + d * x * x1 * x2 / 6.0
    }

    fn true_deg(&self, apparent_deg: f64) -> f64 {
        if apparent_deg >= 90.0 {
            return apparent_deg;
        }
        if apparent_deg >= self.horizon_deg {
            return apparent_deg - self.bending(apparent_deg);
        }
        let low = apparent_deg - self.bending_deg[0];
        bracketed_root(|altitude| altitude + self.faded(altitude) - apparent_deg, low, apparent_deg, 1e-10)
    }

    fn apparent_deg(&self, true_deg: f64) -> f64 {
        if true_deg >= 90.0 {
            return true_deg;
        }
        let lowest = self.lowest_true_deg();
        if true_deg <= lowest {
            return true_deg + self.faded(true_deg);
        }
        let low = true_deg.max(self.horizon_deg);
        let high = (true_deg + self.bending_deg[0]).min(90.0);
        bracketed_root(|apparent| apparent - self.bending(apparent) - true_deg, low, high, 1e-10)
    }

    /// R below the horizon [degrees]: a smooth step to 0.
    fn faded(&self, true_deg: f64) -> f64 {
        let x = ((self.lowest_true_deg() - true_deg) / FADE_DEG).clamp(0.0, 1.0);
        self.bending_deg[0] * (1.0 - x).powi(2) * (1.0 + 2.0 * x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EARTH_M: f64 = 6_356_766.0;

    /// n - 1 at 550 nm of the US Standard Atmosphere 1976 up to 86 km, exponential above (5.9 km scale).
    fn standard_air(altitude_m: f64) -> f64 {
        if altitude_m > 86_000.0 {
            return standard_air(86_000.0) * (-(altitude_m - 86_000.0) / 5900.0).exp();
        }
        // Geopotential altitude of the layer's base [km], temperature [K] and its gradient [K/km].
        const LAYERS: [(f64, f64, f64); 7] = [
            (0.0, 288.15, -6.5),
            (11.0, 216.65, 0.0),
            (20.0, 216.65, 1.0),
            (32.0, 228.65, 2.8),
            (47.0, 270.65, 0.0),
            (51.0, 270.65, -2.8),
            (71.0, 214.65, -2.0),
        ];
        // g M / R* [K/km].
        const LAPSE: f64 = 34.163_195;
        let h = altitude_m * EARTH_M / (EARTH_M + altitude_m) / 1000.0;
        let mut pressure = 1.0;
        for (i, &(base, temperature, gradient)) in LAYERS.iter().enumerate() {
            let top = LAYERS.get(i + 1).map_or(f64::INFINITY, |layer| layer.0);
            let thickness = h.min(top) - base;
            let here = temperature + gradient * thickness;
            pressure *= if gradient == 0.0 {
                (-LAPSE * thickness / temperature).exp()
            } else {
                (temperature / here).powf(LAPSE / gradient)
            };
            if h <= top {
                return 2.778_23e-4 * pressure * 288.15 / here;
            }
        }
        0.0
    }

    fn minutes(refraction: &Refraction, apparent: f64) -> f64 {
        (apparent - refraction.true_altitude_deg(apparent)) * 60.0
    }

    #[test]
    fn standard_refraction_at_sea_level() {
        let refraction = Refraction::new(standard_air, 6_371_000.0, 0.0);
        // checked against: another ray trace of the same air at 550 nm [arcminutes].
        for (apparent, expected) in [
            (0.0, 33.009),
            (0.5, 27.652),
            (1.0, 23.543),
            (2.0, 17.785),
            (3.0, 14.050),
            (5.0, 9.664),
            (10.0, 5.222),
            (15.0, 3.503),
            (20.0, 2.598),
            (30.0, 1.646),
            (45.0, 0.953),
            (60.0, 0.551),
        ] {
            let ours = minutes(&refraction, apparent);
            println!("{apparent:5.1} deg: {ours:.3}', reference {expected:.3}', {:+.2} %", 100.0 * (ours / expected - 1.0));
            assert!((ours / expected - 1.0).abs() < 0.003, "{apparent}: {ours}");
        }
        assert!(minutes(&refraction, 90.0).abs() < 1e-9);
    }

    #[test]
    fn an_index_that_falls_by_a_power_of_the_radius() {
        // n = (top / r)^k up to the top: d ln n / d ln r = -k is constant, so R = k / (1 - k) (psi_0 - psi_top) exactly.
        let (k, radius, top) = (0.092_f64, 6_371_000.0_f64, 6_391_000.0_f64);
        let index = |r: f64| (top / r).powf(k);
        let refraction = Refraction::new(|z| if radius + z < top { index(radius + z) - 1.0 } else { 0.0 }, radius, 0.0);
        for altitude in [0.0_f64, 0.5, 5.0, 20.0, 45.0, 80.0] {
            let zenith = (90.0 - altitude).to_radians();
            let at_top = (index(radius) * radius * zenith.sin() / top).asin();
            let exact = (k / (1.0 - k) * (zenith - at_top)).to_degrees() * 60.0;
            let ours = minutes(&refraction, altitude);
            assert!((ours / exact - 1.0).abs() < 1e-4, "{altitude}: {ours} {exact}");
        }
    }

    #[test]
    fn high_up_it_is_proportional_to_the_refractivity_at_the_observer() {
        // Laplace: near the zenith R = N cot h, whatever the structure of the air above (to 1 part in 800 = scale height / radius).
        for elevation in [0.0, 4205.0, 30_000.0] {
            let refraction = Refraction::new(standard_air, 6_371_000.0, elevation);
            let expected = (standard_air(elevation) / 80.0_f64.to_radians().tan()).to_degrees() * 60.0;
            let ours = minutes(&refraction, 80.0);
            assert!((ours / expected - 1.0).abs() < 3e-3, "{elevation}: {ours} {expected}");
        }
    }

    #[test]
    fn there_and_back_everywhere() {
        for elevation in [-430.0, 0.0, 4205.0, 60_000.0] {
            let refraction = Refraction::new(standard_air, 6_371_000.0, elevation);
            let mut last = f64::NEG_INFINITY;
            for step in -9000..=9000 {
                let altitude = f64::from(step) / 100.0;
                let apparent = refraction.apparent_altitude_deg(altitude);
                assert!((refraction.true_altitude_deg(apparent) - altitude).abs() < 1e-7, "{elevation} {altitude}");
                assert!(apparent > last && apparent >= altitude - 1e-9, "{elevation} {altitude}");
                assert!(apparent - last < 0.0301 || step == -9000, "a jump at {elevation} {altitude}");
                last = apparent;
            }
            assert_eq!(refraction.apparent_altitude_deg(-30.0), -30.0);
        }
    }

    #[test]
    fn the_look_up_is_as_good_as_the_trace() {
        for (elevation, limit) in [(0.0, 0.001), (2000.0, 0.01), (60_000.0, 1.0)] {
            let start = std::time::Instant::now();
            let refraction = Refraction::new(standard_air, 6_371_000.0, elevation);
            println!("table at {elevation} m in {:.1} ms", start.elapsed().as_secs_f64() * 1e3);
            let shells = Shells::new(&standard_air, 6_371_000.0, elevation);
            let mut worst: f64 = 0.0;
            for step in 0..2000 {
                let apparent = refraction.horizon_deg() + (90.0 - refraction.horizon_deg()) * (f64::from(step) / 2000.0).powi(3);
                let traced = shells.bending(apparent.to_radians()).to_degrees();
                let gap = (apparent - refraction.true_altitude_deg(apparent) - traced).abs() * 60.0;
                worst = worst.max(gap);
            }
            println!("look-up at {elevation} m: {worst:.5} arcminutes at most");
            assert!(worst < limit, "{elevation}: {worst}");
        }
    }

    #[test]
    fn an_elevated_observer_looks_down_to_the_horizon() {
        let at = |elevation: f64| Refraction::new(standard_air, 6_371_000.0, elevation);
        assert_eq!(at(0.0).horizon_deg(), 0.0);
        assert_eq!(at(-430.0).horizon_deg(), 0.0);
        // checked against: Bowditch, dip = 1.76' sqrt(height in m) (terrestrial refraction of the standard air).
        let dip = -at(1000.0).horizon_deg() * 60.0;
        assert!((dip / (1.76 * 1000.0_f64.sqrt()) - 1.0).abs() < 0.02, "{dip}");
        // From outside the air a grazing ray is bent on its way down and up: twice what it is at the ground.
        let grazing = at(100_000.0);
        let bending = grazing.horizon_deg() - grazing.horizon_true_altitude_deg();
        assert!((bending * 60.0 / (2.0 * minutes(&at(0.0), 0.0)) - 1.0).abs() < 1e-3, "{bending}");
        // Without air the dip is the tangent from the observer.
        let airless = Refraction::new(|_| 0.0, 6_371_000.0, 10_000.0);
        let tangent = (6_371_000.0_f64 / 6_381_000.0).acos().to_degrees();
        assert!((airless.horizon_deg() + tangent).abs() < 1e-6);
        assert!((airless.apparent_altitude_deg(-1.0) + 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_setting_sun_is_flattened() {
        let refraction = Refraction::new(standard_air, 6_371_000.0, 0.0);
        // The lower limb on the horizon: 33.0' there and 28' half a degree higher make 0.83 of the height.
        let centre = refraction.horizon_true_altitude_deg() + 0.267;
        assert!((refraction.flattening(centre, 0.533) - 0.84).abs() < 0.02);
        assert!((refraction.flattening(89.9, 0.533) - 1.0).abs() < 1e-3);
        assert_eq!(Refraction::none().flattening(0.0, 0.5), 1.0);
    }

    #[test]
    fn odd_air_and_odd_planets_are_survived() {
        for refraction in [
            Refraction::new(|_| f64::NAN, 6_371_000.0, 0.0),
            Refraction::new(|z| 5e-4 * (-z / 50.0).exp(), 6_371_000.0, 0.0),
            Refraction::new(|z| -z, 6_371_000.0, 100.0),
            Refraction::new(standard_air, -1.0, 0.0),
            Refraction::new(standard_air, f64::NAN, 0.0),
            Refraction::new(standard_air, 6.371e9, 2000.0),
            Refraction::new(standard_air, 6_371_000.0, f64::INFINITY),
        ] {
            for altitude in [-90.0, -1.0, 0.0, 0.3, 45.0, 90.0] {
                assert!(refraction.apparent_altitude_deg(altitude).is_finite());
                assert!(refraction.true_altitude_deg(altitude).is_finite());
            }
        }
    }
}
