//! Fewer functions of the scattering angle that do for one dome.
//!
//! A light field holds the functions that particles' light needs at every wavelength and path ([`crate::light::AngularFunctions`]): some dozens. As XYZ, in one half of one dome, nearly all light of
//! particles is a combination of a few of them, which the Gram-Schmidt process picks: the direction whose light is least well known next. Products of functions are means over
//! the entries of their table, relative to the mean light of particles, so that backward directions count as much as the aureole.

use crate::light::FunctionRows;

/// Rms error over all scattering angles at which the light of every direction is known, relative to the light of particles there.
const TOLERANCE: f64 = 1e-4;

/// Light of less than this share of the mean counts as if it were this bright.
const DARKEST: f64 = 1e-4;

/// Fields and functions before and after.
pub(super) struct Compact {
    /// For each new lane, what the old lanes count in its function.
    pub functions: Vec<Vec<f64>>,
    /// XYZ of the new fields, (direction, field), by circle.
    pub rows: Vec<Vec<[f32; 3]>>,
}

/// Replaces the fields of the lanes for which `mixed` is true by fewer, which stand where the first of them stood; all others stay. `rows` hold XYZ of each field, (direction, field), by circle.
pub(super) fn compact(rows: &[Vec<[f32; 3]>], table: &FunctionRows, mixed: &[bool]) -> Compact {
    let lanes: Vec<usize> = (0..mixed.len()).filter(|&lane| mixed[lane]).collect();
    let fields = mixed.len();
    let vectors = || rows.iter().flat_map(|row| row.chunks_exact(fields)).flat_map(|fields| (0..3).map(move |k| (fields, k)));
    let mut rest: Vec<Vec<f64>> =
        vectors().map(|(fields, k)| lanes.iter().map(|&lane| f64::from(fields[lane][k])).collect()).collect();
    let (product, lengths) = products(&rest, &lanes, table);
    for (vector, length) in rest.iter_mut().zip(&lengths) {
        vector.iter_mut().for_each(|value| *value /= length);
    }
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut weights: Vec<Vec<f32>> = vec![Vec::new(); rest.len()];
    let square = |vector: &[f64]| dot(vector, &apply(&product, vector));
    while basis.len() < lanes.len() {
        let squares = rest.iter().map(|vector| square(vector)).enumerate();
        let Some((worst, largest)) = squares.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if largest.is_nan() || largest < TOLERANCE * TOLERANCE {
            break;
        }
        let direction: Vec<f64> = rest[worst].iter().map(|value| value / largest.sqrt()).collect();
        let dual = apply(&product, &direction);
        for ((vector, weights), length) in rest.iter_mut().zip(&mut weights).zip(&lengths) {
            let share = dot(vector, &dual);
            vector.iter_mut().zip(&direction).for_each(|(value, d)| *value -= share * d);
            weights.push((share * length) as f32);
        }
        basis.push(direction);
    }
    let functions = new_functions(mixed, &lanes, &basis);
    let first = mixed.iter().position(|&mixed| mixed).unwrap_or(fields);
    let mut weights = weights.chunks_exact(3);
    let rows = rows.iter().map(|row| {
        let renew = |fields: &[[f32; 3]]| {
            let weights = weights.next().unwrap_or_default();
            let kept = |range: std::ops::Range<usize>| range.filter(|&lane| !mixed[lane]).map(|lane| fields[lane]);
            let new = (0..basis.len()).map(|b| std::array::from_fn(|k| weights[k][b]));
            kept(0..first).chain(new).chain(kept(first..fields.len())).collect::<Vec<_>>()
        };
        row.chunks_exact(fields).flat_map(renew).collect()
    });
    Compact { rows: rows.collect(), functions }
}

/// The matrix of products of the functions of `lanes`, and the length of each vector: its mean light relative to the mean light of all.
fn products(vectors: &[Vec<f64>], lanes: &[usize], table: &FunctionRows) -> (Vec<Vec<f64>>, Vec<f64>) {
    let n = lanes.len();
    let mut mean = vec![0.0; n];
    for vector in vectors {
        mean.iter_mut().zip(vector).for_each(|(mean, value)| *mean += value / vectors.len() as f64);
    }
    let mut product = vec![vec![0.0; n]; n];
    let mut level = vec![0.0; n];
    let mut count = 0;
    for entry in 0..table.entries() {
        let values: Vec<f64> = lanes.iter().map(|&lane| f64::from(table.entry(entry)[lane])).collect();
        let light = dot(&values, &mean);
        if light > 0.0 {
            let values: Vec<f64> = values.iter().map(|value| value / light).collect();
            for (row, a) in product.iter_mut().zip(&values) {
                row.iter_mut().zip(&values).for_each(|(sum, b)| *sum += a * b);
            }
            level.iter_mut().zip(&values).for_each(|(sum, value)| *sum += value);
            count += 1;
        }
    }
    let scale = 1.0 / f64::from(count.max(1));
    product.iter_mut().flatten().chain(&mut level).for_each(|value| *value *= scale);
    let lengths = vectors.iter().map(|vector| dot(&level, vector).max(DARKEST)).collect();
    (product, lengths)
}

/// Unit vectors for the lanes that stay, `basis` for those that are mixed.
fn new_functions(mixed: &[bool], lanes: &[usize], basis: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut functions = Vec::new();
    for (lane, &is_mixed) in mixed.iter().enumerate() {
        if !is_mixed {
            functions.push((0..mixed.len()).map(|other| if other == lane { 1.0 } else { 0.0 }).collect());
        } else if lanes.first() == Some(&lane) {
            for direction in basis {
                let mut function = vec![0.0; mixed.len()];
                lanes.iter().zip(direction).for_each(|(&lane, &weight)| function[lane] = weight);
                functions.push(function);
            }
        }
    }
    functions
}

fn apply(matrix: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| dot(row, vector)).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::Phase;
    use crate::light::{AngularFunctions, BLOCK};

    /// Fields that are combinations of three: two functions do for them, and the light stays the same at every angle.
    #[test]
    fn few_functions_do_for_the_light_of_many() {
        let phase = Phase::HenyeyGreenstein { asymmetry: 0.8 };
        let molecules = Phase::Rayleigh { depolarisation: vec![0.0] };
        let functions = [&molecules, &phase].map(|phase| AngularFunctions::new(phase, 1, 6, 0.005));
        let table = FunctionRows::new(&functions, functions.iter().map(AngularFunctions::len).sum::<usize>() + 1);
        let count = functions[1].len();
        assert!(count > 4);
        let mixed: Vec<bool> = (0..count + 3).map(|lane| lane > 1 && lane < count + 2).collect();
        // Light of two paths and two strengths of the rest: three vectors for the particles.
        let mut shares = vec![vec![0.0; count]; 3];
        for (shares, (strength, path)) in shares.iter_mut().zip([(0.2, 0.0), (0.5, 1.0), (0.9, 2.5)]) {
            functions[1].weights(0, &crate::light::Once { strength, direct_strength: 1.0, path }, shares);
        }
        let fields = |i: usize| -> Vec<[f32; 3]> {
            let level = 0.001 * 10.0_f64.powi(i as i32 % 4);
            let share = |j: usize| (0..3).map(|s| shares[s][j] * ((i * (s + 2)) % 7) as f64).sum::<f64>() * level;
            [1.0, 2.0]
                .into_iter()
                .chain((0..count).map(share))
                .chain([3.0])
                .map(|v| [v as f32, 0.5 * v as f32, v as f32])
                .collect()
        };
        let rows: Vec<Vec<[f32; 3]>> = (0..5).map(|c| (0..8).flat_map(|a| fields(1 + 8 * c + a)).collect()).collect();
        let compact = compact(&rows, &table, &mixed);
        let new = compact.functions.len();
        assert!((5..=6).contains(&new) && new < BLOCK, "{new}");
        let remade = table.mixed(&compact.functions);
        for (row, new_row) in rows.iter().zip(&compact.rows) {
            for (old, fields) in row.chunks_exact(count + 3).zip(new_row.chunks_exact(new)) {
                for entry in (0..table.entries()).step_by(64) {
                    let light = |table: &FunctionRows, fields: &[[f32; 3]]| -> f32 {
                        table.entry(entry).iter().zip(fields).map(|(function, field)| function * field[0]).sum()
                    };
                    let (expected, found) = (light(&table, old), light(&remade, fields));
                    assert!((found / expected - 1.0).abs() < 1e-3, "{entry}: {found} {expected}");
                }
            }
        }
    }
}
