//! The field that is consistent with itself, by iteration.

use super::anderson::Anderson;
use super::lanes::LANES;
use super::source::Field;
use crate::error::{Error, Result};

/// Most iterations with acceleration, which clear air needs five of, and most without. Acceleration is lost where a few nodes at the terminator do not come to rest.
const MAX_ACCELERATED: usize = 40;
const MAX_PLAIN: usize = 80;

/// A relative change from which nothing good comes any more.
const HOPELESS: f32 = 1e3;

/// Iterations over which it is judged how fast the change falls.
const PATIENCE: usize = 15;

/// Accelerated iterations within which the change must fall below this part of what it was: they go nowhere else.
const STUCK: usize = 10;
const PROGRESS: f32 = 0.7;

/// Relative change that may be left where iterations come to no rest: what it does to the light is for the balance of the energy to judge.
const ACCEPTABLE: f32 = 0.01;

/// The field that `scatter_once_more` takes to itself, but for a relative change of `convergence`, or the one that it changes least; it gets the field and the number of the iteration.
///
/// # Errors
/// [`Error::Unsolved`] if it changes every field by more than 1 %, and what it says itself.
pub fn iterate(
    once: &Field<LANES>,
    convergence: f32,
    scatter_once_more: impl Fn(&Field<LANES>, usize) -> Result<Field<LANES>>,
) -> Result<Field<LANES>> {
    let (mut iterations, mut nearest, mut best) = (0, f32::INFINITY, once.clone());
    for (most, accelerated) in [(MAX_ACCELERATED, true), (MAX_PLAIN, false)] {
        // Plain iterations go on from the best of the others.
        let mut low = best.clone();
        let mut anderson = Anderson::new();
        let mut changes: Vec<f32> = Vec::new();
        let mut mark = (0, f32::INFINITY);
        for iteration in 0..most {
            let next = scatter_once_more(&low, iterations)?;
            iterations += 1;
            let plain = next.clone();
            let change = anderson.step(&mut low, next, accelerated && iteration >= 1);
            changes.push(change);
            // What is left to come of plain iterations is a geometric series.
            let rate = if accelerated { 0.0 } else { rate(&changes) };
            let left = change * (rate / (1.0 - rate)).max(1.0);
            if left < convergence {
                return Ok(low);
            }
            if left < nearest {
                (nearest, best) = (left, plain);
            }
            if left < PROGRESS * mark.1 {
                mark = (iteration, left);
            }
            let in_vain = rate > 0.0 && left * rate.powi((most - iteration) as i32) > 2.0 * convergence;
            let stuck = accelerated && iteration - mark.0 >= STUCK;
            if change.is_nan() || change > HOPELESS || stuck || (iteration >= PATIENCE && in_vain) {
                break;
            }
        }
    }
    if nearest < ACCEPTABLE {
        return Ok(best);
    }
    Err(Error::unsolved(if nearest.is_finite() {
        format!(
            "after {iterations} iterations the orders of scattering that are still missing would change it by {:.2} %",
            100.0 * nearest
        )
    } else {
        "its orders of scattering have no finite sum".into()
    }))
}

/// How much smaller each of the latest changes is than the one before, below 1.
fn rate(changes: &[f32]) -> f32 {
    let last = changes.len() - 1;
    let before = last.saturating_sub(PATIENCE).max(last / 2);
    if last == before {
        return 0.0;
    }
    (changes[last] / changes[before]).powf(1.0 / (last - before) as f32).clamp(0.0, 0.995)
}
