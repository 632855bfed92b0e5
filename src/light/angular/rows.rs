//! All functions of the scattering angle side by side, so that one direction reads them as vectors.

use super::{AngularFunctions, ENTRIES, Table, cosine_at};

/// Functions in a block: a vector of the widest processors.
pub const BLOCK: usize = 16;

/// The functions of several components and the number 1 in one table: lane f of entry e is function f at the scattering angle of e, lanes beyond the last are 0.
///
/// Between entries values are linear in the fourth root of the haversine; cos^2, the steepest of those that are known exactly, is off by 2e-5 at most.
#[derive(Clone)]
pub struct FunctionRows {
    blocks: usize,
    /// (entry, block).
    rows: Vec<[f32; BLOCK]>,
}

/// Where directions are found in the table.
#[derive(Clone, Copy, Debug, Default)]
pub struct Located {
    entry: u32,
    fraction: f32,
}

impl FunctionRows {
    /// The table of `functions`, in their order, with 1 in the lane after them and room for `lanes` lanes in all.
    pub fn new(functions: &[AngularFunctions], lanes: usize) -> Self {
        let blocks = lanes.div_ceil(BLOCK);
        let mut rows = vec![[0.0_f32; BLOCK]; ENTRIES * blocks];
        for (entry, row) in rows.chunks_exact_mut(blocks).enumerate() {
            let mut lane = row.as_flattened_mut().iter_mut();
            let mut push = |value: f32| lane.by_ref().take(1).for_each(|lane| *lane = value);
            for functions in functions {
                match functions {
                    AngularFunctions::Molecules(_) => {
                        push(1.0);
                        push((cosine_at(entry) * cosine_at(entry)) as f32);
                    }
                    AngularFunctions::Table(Table { entries, count, .. }) => {
                        entries[entry * count..(entry + 1) * count].iter().copied().for_each(&mut push);
                    }
                }
            }
            push(1.0);
        }
        Self { blocks, rows }
    }

    /// A table whose lane f is the sum of this one's lanes times `mixes[f]`.
    pub fn mixed(&self, mixes: &[Vec<f64>]) -> Self {
        let blocks = mixes.len().div_ceil(BLOCK);
        let mut rows = vec![[0.0_f32; BLOCK]; ENTRIES * blocks];
        for (entry, row) in rows.chunks_exact_mut(blocks).enumerate() {
            let own = self.entry(entry);
            for (lane, mix) in row.as_flattened_mut().iter_mut().zip(mixes) {
                *lane = mix.iter().zip(own).map(|(weight, &value)| weight * f64::from(value)).sum::<f64>() as f32;
            }
        }
        Self { blocks, rows }
    }

    /// Number of entries.
    pub fn entries(&self) -> usize {
        ENTRIES
    }

    /// All lanes of an entry.
    pub fn entry(&self, entry: usize) -> &[f32] {
        self.rows[entry * self.blocks..(entry + 1) * self.blocks].as_flattened()
    }

    /// Number of blocks of lanes.
    pub fn blocks(&self) -> usize {
        self.blocks
    }

    /// Where a scattering angle is found whose haversine is (1 - cos) / 2.
    #[inline(always)]
    pub fn locate(haversine: f32) -> Located {
        let position = haversine.clamp(0.0, 1.0).sqrt().sqrt() * (ENTRIES - 1) as f32;
        let entry = (position as u32).min(ENTRIES as u32 - 2);
        Located { entry, fraction: position - entry as f32 }
    }

    /// The entries of one block on either side, and the share of the way from the one to the other.
    #[inline(always)]
    pub fn around(&self, at: Located, block: usize) -> (&[f32; BLOCK], &[f32; BLOCK], f32) {
        let first = at.entry as usize * self.blocks + block;
        (&self.rows[first], &self.rows[first + self.blocks], at.fraction)
    }

    /// The functions of one block there.
    pub fn values(&self, at: Located, block: usize) -> [f32; BLOCK] {
        let (a, b, fraction) = self.around(at, block);
        std::array::from_fn(|n| a[n] + fraction * (b[n] - a[n]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::Phase;

    #[test]
    fn rows_hold_each_function_and_one() {
        let phases = [
            Phase::Rayleigh { depolarisation: vec![0.03] },
            Phase::HenyeyGreenstein { asymmetry: 0.8 },
            Phase::CornetteShanks { asymmetry: 0.6 },
        ];
        let functions: Vec<_> = phases.iter().map(|phase| AngularFunctions::new(phase, 1, 6, 0.005)).collect();
        let count: usize = functions.iter().map(AngularFunctions::len).sum();
        for lanes in [count + 1, 40] {
            let rows = FunctionRows::new(&functions, lanes);
            for degrees in [0.0, 0.3, 4.0, 60.0, 133.0, 180.0_f64] {
                let haversine = (0.5 * degrees.to_radians()).sin().powi(2) as f32;
                let found: Vec<f32> =
                    (0..rows.blocks()).flat_map(|block| rows.values(FunctionRows::locate(haversine), block)).collect();
                let mut expected = vec![[0.0_f32; 1]; count];
                let mut first = 0;
                for functions in &functions {
                    functions.values(&[haversine], &mut expected[first..first + functions.len()]);
                    first += functions.len();
                }
                for (found, [expected]) in found.iter().zip(&expected) {
                    assert!((found - expected).abs() < 3e-5 * expected.abs().max(1.0), "{degrees}: {found} {expected}");
                }
                assert_eq!(found[count], 1.0);
                assert!(found[count + 1..].iter().all(|&lane| lane == 0.0));
            }
        }
    }
}
