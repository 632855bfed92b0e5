//! Where the air bends so sharply that steps of rays have to end there.

/// Part of the vertical optical depth that a bend must move for a step of a ray to end there: the top of a fog does, the bends of a gas between the altitudes of a profile don't.
const SHARP_BEND: f64 = 0.005;

/// Altitudes at which `density`, linear between `altitudes`, bends so sharply that the two points of a step across it would miss much of the optical depth.
pub fn sharp_bends(altitudes: &[f64], density: &[f64]) -> Vec<f64> {
    let step = |i: usize| altitudes[i + 1] - altitudes[i];
    let slope = |i: usize| (density[i + 1] - density[i]) / step(i);
    let column: f64 = (0..altitudes.len() - 1).map(|i| 0.5 * step(i) * (density[i] + density[i + 1])).sum();
    let bends = (1..altitudes.len() - 1).filter(|&i| {
        let length = 0.5 * (step(i - 1) + step(i));
        (slope(i) - slope(i - 1)).abs() * length * length > SHARP_BEND * column
    });
    bends.map(|i| altitudes[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_fog_is_a_bend_and_a_gas_has_none() {
        let altitudes: Vec<f64> = (0..=100).map(|i| f64::from(i) * 0.1).collect();
        let gas: Vec<f64> = altitudes.iter().map(|z| (-z / 8.0).exp()).collect();
        assert!(sharp_bends(&altitudes, &gas).is_empty());
        let fog: Vec<f64> = altitudes.iter().zip(&gas).map(|(z, gas)| 0.01 * gas + if *z < 0.25 { 1.0 } else { 0.0 }).collect();
        assert_eq!(sharp_bends(&altitudes, &fog), [altitudes[2], altitudes[3]]);
    }
}
