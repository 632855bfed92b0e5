//! Temperature, pressure and density of the air against altitude.
//!
//! US Standard Atmosphere 1976 (NOAA-S/T 76-1562): hydrostatic layers of constant temperature gradient in geopotential height
//! H = r0 z / (r0 + z), r0 = 6356.766 km, up to z = 86 km:
//!
//! p = p_b (T_b / T)^(34.1632 / L) or p_b exp(-34.1632 (H - H_b) / T_b) for gradient L [K/km] = 0.
//!
//! Above, its temperature formulas and its tabulated pressure to 140 km, whose logarithm is interpolated by a cubic spline. The other models are the tables of AFGL-TR-86-0110
//! (Anderson et al. 1986) to 120 km, continued exponentially. Number density n = p / (k T).

use crate::numerics::CubicSpline;
use crate::spectrum::binned::columns;
use crate::words::words;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Top of every model [km]: above, the density is taken as zero. At 140 km it is 1e-9 of that at the ground.
pub const TOP_KM: f64 = 140.0;

const BOLTZMANN: f64 = 1.380_649e-23;
const RADIUS_KM: f64 = 6356.766;
/// g0 M0 / R* [K/km].
const HYDROSTATIC: f64 = 9.80665 * 28.9644 / 8.31432;

/// Base geopotential height [km], base temperature [K], gradient [K/km], base pressure [Pa] (table 4 of the standard).
const LAYERS: [[f64; 4]; 7] = [
    [0.0, 288.15, -6.5, 101_325.0],
    [11.0, 216.65, 0.0, 22_632.06],
    [20.0, 216.65, 1.0, 5_474.889],
    [32.0, 228.65, 2.8, 868.018_7],
    [47.0, 270.65, 0.0, 110.906_3],
    [51.0, 270.65, -2.8, 66.938_87],
    [71.0, 214.65, -2.0, 3.956_420],
];

/// Altitude [km] and pressure [Pa] above the layers (table I of the standard).
const HIGH_PRESSURES: [[f64; 2]; 12] = [
    [86.0, 3.7338e-1],
    [90.0, 1.8359e-1],
    [95.0, 7.5966e-2],
    [100.0, 3.2011e-2],
    [105.0, 1.4477e-2],
    [110.0, 7.1042e-3],
    [115.0, 4.0096e-3],
    [120.0, 2.5382e-3],
    [125.0, 1.7354e-3],
    [130.0, 1.2505e-3],
    [135.0, 9.3568e-4],
    [140.0, 7.2028e-4],
];

static HIGH_LOG_PRESSURE: LazyLock<CubicSpline> = LazyLock::new(|| {
    let [altitudes, logarithms] = [HIGH_PRESSURES.map(|row| row[0]), HIGH_PRESSURES.map(|row| row[1].ln())];
    CubicSpline::new(&altitudes, &logarithms)
});

/// A model of the air's temperature and density.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum StandardAtmosphere {
    /// US Standard Atmosphere 1976 (mid-latitude mean): 288.15 K and 1013.25 hPa at sea level.
    #[default]
    UsStandard1976,
    /// AFGL 1986, 15 degrees north, annual mean.
    Tropical,
    /// AFGL 1986, 45 degrees north, July.
    MidlatitudeSummer,
    /// AFGL 1986, 45 degrees north, January.
    MidlatitudeWinter,
    /// AFGL 1986, 60 degrees north, July.
    SubarcticSummer,
    /// AFGL 1986, 60 degrees north, January.
    SubarcticWinter,
}

words!(StandardAtmosphere, "standard_atmosphere", {
    UsStandard1976 => "us_standard_1976",
    Tropical => "tropical",
    MidlatitudeSummer => "midlatitude_summer",
    MidlatitudeWinter => "midlatitude_winter",
    SubarcticSummer => "subarctic_summer",
    SubarcticWinter => "subarctic_winter",
});

impl StandardAtmosphere {
    /// Temperature [K] at `altitude_km` above sea level; that of the ends outside 0 to 140 km.
    pub fn temperature_k(self, altitude_km: f64) -> f64 {
        let z = altitude_km.clamp(0.0, TOP_KM);
        match self {
            Self::UsStandard1976 => us_temperature_k(z),
            _ => self.table().interpolate(z, &self.table().temperature_k),
        }
    }

    /// Pressure [Pa] at `altitude_km` above sea level; that of the ground below 0 km, 0 above 140 km.
    pub fn pressure_pa(self, altitude_km: f64) -> f64 {
        if altitude_km > TOP_KM {
            return 0.0;
        }
        let z = altitude_km.max(0.0);
        match self {
            Self::UsStandard1976 => us_pressure_pa(z),
            _ => self.table().interpolate_logarithm(z, &self.table().log_pressure_pa),
        }
    }

    /// Number density of the air [m-3] at `altitude_km` above sea level; that of the ground below 0 km, 0 above 140 km.
    pub fn number_density_per_m3(self, altitude_km: f64) -> f64 {
        if altitude_km > TOP_KM {
            return 0.0;
        }
        let z = altitude_km.max(0.0);
        match self {
            Self::UsStandard1976 => us_pressure_pa(z) / (BOLTZMANN * us_temperature_k(z)),
            _ => self.table().interpolate_logarithm(z, &self.table().log_air_per_m3),
        }
    }

    /// Number density of ozone [m-3] at `altitude_km` above sea level in the AFGL profile of this climate (for
    /// [`Self::UsStandard1976`] the AFGL US Standard profile), 0 above 120 km. Only its shape is used: the column is a parameter.
    pub fn ozone_per_m3(self, altitude_km: f64) -> f64 {
        let table = self.table();
        if altitude_km > table.altitudes_km[table.altitudes_km.len() - 1] {
            return 0.0;
        }
        table.interpolate_logarithm(altitude_km.max(0.0), &table.log_ozone_per_m3)
    }

    /// Molecules of air in a vertical column above sea level [m-2], integrated in steps of 20 m.
    pub fn column_per_m2(self) -> f64 {
        const STEP_KM: f64 = 0.02;
        let steps = (TOP_KM / STEP_KM) as usize;
        let density = |i: usize| self.number_density_per_m3(i as f64 * STEP_KM);
        let ends = 0.5 * (density(0) + density(steps));
        (ends + (1..steps).map(density).sum::<f64>()) * STEP_KM * 1000.0
    }

    fn table(self) -> &'static Table {
        &TABLES[match self {
            Self::Tropical => 0,
            Self::MidlatitudeSummer => 1,
            Self::MidlatitudeWinter => 2,
            Self::SubarcticSummer => 3,
            Self::SubarcticWinter => 4,
            Self::UsStandard1976 => 5,
        }]
    }
}

fn us_temperature_k(z: f64) -> f64 {
    if z < 86.0 {
        let [base, temperature, gradient, _] = layer(geopotential_km(z));
        return temperature + gradient * (geopotential_km(z) - base);
    }
    if z < 91.0 {
        186.8673
    } else if z < 110.0 {
        263.1905 - 76.3232 * (1.0 - ((z - 91.0) / 19.9429).powi(2)).sqrt()
    } else if z < 120.0 {
        240.0 + 12.0 * (z - 110.0)
    } else {
        1000.0 - 640.0 * (-0.01875 * (z - 120.0) * (RADIUS_KM + 120.0) / (RADIUS_KM + z)).exp()
    }
}

fn us_pressure_pa(z: f64) -> f64 {
    if z >= 86.0 {
        return HIGH_LOG_PRESSURE.value(z).exp();
    }
    let height = geopotential_km(z);
    let [base, temperature, gradient, pressure] = layer(height);
    if gradient == 0.0 {
        pressure * (-HYDROSTATIC * (height - base) / temperature).exp()
    } else {
        pressure * (temperature / (temperature + gradient * (height - base))).powf(HYDROSTATIC / gradient)
    }
}

fn geopotential_km(z: f64) -> f64 {
    RADIUS_KM * z / (RADIUS_KM + z)
}

fn layer(height: f64) -> [f64; 4] {
    LAYERS[LAYERS.partition_point(|layer| layer[0] <= height).saturating_sub(1)]
}

struct Table {
    altitudes_km: Vec<f64>,
    temperature_k: Vec<f64>,
    log_pressure_pa: Vec<f64>,
    log_air_per_m3: Vec<f64>,
    log_ozone_per_m3: Vec<f64>,
}

/// Levels of each AFGL model.
const LEVELS: usize = 50;

static TABLES: LazyLock<Vec<Table>> = LazyLock::new(|| {
    let [_, altitude, pressure, temperature, air, ozone] = columns(include_str!("../../data/afgl1986.csv"));
    let logarithms = |values: &[f64], unit: f64| values.iter().map(|value| (value * unit).ln()).collect();
    (0..altitude.len() / LEVELS)
        .map(|model| {
            let rows = model * LEVELS..(model + 1) * LEVELS;
            Table {
                altitudes_km: altitude[rows.clone()].to_vec(),
                temperature_k: temperature[rows.clone()].to_vec(),
                log_pressure_pa: logarithms(&pressure[rows.clone()], 100.0),
                log_air_per_m3: logarithms(&air[rows.clone()], 1e6),
                log_ozone_per_m3: logarithms(&ozone[rows], 1e6),
            }
        })
        .collect()
});

impl Table {
    /// Linear in altitude, the end value above the top.
    fn interpolate(&self, z: f64, values: &[f64]) -> f64 {
        self.linear(z.min(self.altitudes_km[LEVELS - 1]), values)
    }

    /// Exponential in altitude; above the top it continues with the last slope.
    fn interpolate_logarithm(&self, z: f64, logarithms: &[f64]) -> f64 {
        self.linear(z, logarithms).exp()
    }

    fn linear(&self, z: f64, values: &[f64]) -> f64 {
        let right = self.altitudes_km.partition_point(|&altitude| altitude <= z).clamp(1, LEVELS - 1);
        let (low, high) = (self.altitudes_km[right - 1], self.altitudes_km[right]);
        values[right - 1] + (values[right] - values[right - 1]) * (z - low) / (high - low)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const US: StandardAtmosphere = StandardAtmosphere::UsStandard1976;

    #[test]
    fn the_us_standard_is_its_table() {
        // checked against: US Standard Atmosphere 1976, table I; geometric altitude, temperature, pressure
        let table = [
            (0.0, 288.150, 101_325.0),
            (5.0, 255.676, 54_048.0),
            (11.0, 216.774, 22_700.0),
            (20.0, 216.650, 5_529.3),
            (50.0, 270.650, 79.779),
            (80.0, 198.639, 1.0524),
            (86.0, 186.87, 0.373_38),
            (100.0, 195.08, 0.032_011),
            (120.0, 360.0, 0.002_538_2),
        ];
        for (z, temperature, pressure) in table {
            assert!((US.temperature_k(z) - temperature).abs() < 0.02, "{z} km: {} K", US.temperature_k(z));
            assert!((US.pressure_pa(z) / pressure - 1.0).abs() < 2e-4, "{z} km: {} Pa", US.pressure_pa(z));
        }
        assert!((US.number_density_per_m3(0.0) / 2.546_9e25 - 1.0).abs() < 1e-4);
    }

    #[test]
    fn density_falls_smoothly_to_the_top() {
        for model in StandardAtmosphere::ALL {
            let mut before = model.number_density_per_m3(0.0);
            for step in 1..=280 {
                let z = f64::from(step) * 0.5;
                let now = model.number_density_per_m3(z);
                assert!(now < before && now > 0.89 * before, "{} at {z} km", model.name());
                before = now;
            }
            assert_eq!(model.number_density_per_m3(140.1), 0.0);
        }
    }

    #[test]
    fn the_column_carries_the_pressure_at_the_ground() {
        for model in StandardAtmosphere::ALL {
            // Molecules of 4.8097e-26 kg under a gravity that falls with height: 9.80665 at the ground, about 0.45 % less at the mean
            // height of the mass (only at 45 degrees; the AFGL models are for other latitudes).
            let pressure = model.column_per_m2() * 4.8097e-26 * 9.80665 * 0.9978;
            assert!((pressure / model.pressure_pa(0.0) - 1.0).abs() < 6e-3, "{}: {pressure} Pa", model.name());
        }
    }

    #[test]
    fn ozone_columns_are_those_of_the_report() {
        // checked against: AFGL-TR-86-0110, ozone columns in Dobson units: 277, 332, 377, 345, 376, 344
        let expected = [344.0, 277.0, 332.0, 377.0, 345.0, 376.0];
        for (model, expected) in StandardAtmosphere::ALL.iter().zip(expected) {
            let column: f64 = (0..2400).map(|i| model.ozone_per_m3((f64::from(i) + 0.5) * 0.05) * 50.0).sum();
            let dobson = column / 2.6868e20;
            assert!((dobson / expected - 1.0).abs() < 0.02, "{}: {dobson}", model.name());
        }
    }
}
