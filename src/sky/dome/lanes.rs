//! What the fields of a dome count in a direction: the functions of the scattering angle, and what a filter makes of polarised light.
//!
//! Fields are lanes of vectors, in blocks: the functions of each component, then the rest (I, and Q and U behind a filter).

use crate::light::{AngularFunctions, BLOCK, FunctionRows};
use crate::sky::PolarisingFilter;

/// The lanes of one set of fields.
#[derive(Clone)]
pub(super) struct Lanes {
    rows: FunctionRows,
    count: usize,
    /// Which lanes are functions that may be replaced by combinations of them.
    mixed: Vec<bool>,
    /// The lanes of cos^2 of the molecules: those of the dipoles, which polarise.
    dipoles: Vec<usize>,
    filter: Option<PolarisingFilter>,
    /// By block, the lanes of a filter's three factors: of the dipoles, of Q, of U.
    filter_lanes: Vec<[[f32; BLOCK]; 3]>,
}

impl Lanes {
    /// The lanes of `functions` and of the rest, seen through `filter`.
    pub fn new(functions: &[AngularFunctions], filter: Option<PolarisingFilter>) -> Self {
        let (mut mixed, mut dipoles) = (Vec::new(), Vec::new());
        for functions in functions {
            let molecules = matches!(functions, AngularFunctions::Molecules(_));
            if molecules {
                dipoles.push(mixed.len() + 1);
            }
            mixed.resize(mixed.len() + functions.len(), !molecules);
        }
        mixed.resize(mixed.len() + if filter.is_some() { 3 } else { 1 }, false);
        Self::assemble(FunctionRows::new(functions, mixed.len()), mixed, dipoles, filter)
    }

    fn assemble(rows: FunctionRows, mixed: Vec<bool>, dipoles: Vec<usize>, filter: Option<PolarisingFilter>) -> Self {
        let count = mixed.len();
        let mut filter_lanes = vec![[[0.0; BLOCK]; 3]; if filter.is_some() { count.div_ceil(BLOCK) } else { 0 }];
        if filter.is_some() {
            let factors = dipoles.iter().map(|&lane| (0, lane)).chain([(1, count - 2), (2, count - 1)]);
            factors.for_each(|(factor, lane)| filter_lanes[lane / BLOCK][factor][lane % BLOCK] = 1.0);
        }
        Self { rows, count, mixed, dipoles, filter, filter_lanes }
    }

    /// The lanes whose functions are these, times `mixes` ([`FunctionRows::mixed`]): those of the dipoles and of the rest must be among them.
    pub fn remade(&self, mixes: &[Vec<f64>]) -> Self {
        let is = |mix: &[f64], lane: usize| mix[lane] == 1.0 && mix.iter().filter(|&&weight| weight != 0.0).count() == 1;
        let dipoles = self.dipoles.iter().filter_map(|&lane| mixes.iter().position(|mix| is(mix, lane))).collect();
        Self::assemble(self.rows.mixed(mixes), vec![false; mixes.len()], dipoles, self.filter)
    }

    /// Number of fields.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The functions by scattering angle: 1 for I of the rest, 0 for its Q and U.
    #[inline(always)]
    pub fn rows(&self) -> &FunctionRows {
        &self.rows
    }

    /// Which lanes may be replaced by combinations of them.
    pub fn mixed(&self) -> &[bool] {
        &self.mixed
    }

    /// What the light is seen through.
    pub fn filter(&self) -> Option<&PolarisingFilter> {
        self.filter.as_ref()
    }

    /// The lane whose field is odd in azimuth: U.
    pub fn odd(&self) -> Option<usize> {
        self.filter.map(|_| self.count - 1)
    }

    /// Behind a filter, the lanes of a block that its three factors belong to: of the dipoles, of Q, of U.
    #[inline(always)]
    pub fn filter_lanes(&self, block: usize) -> &[[f32; BLOCK]; 3] {
        &self.filter_lanes[block]
    }
}
