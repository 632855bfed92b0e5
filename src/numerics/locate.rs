//! The interval of a short ascending table that holds a value. [`super::Axis`] is for loops that look up many.

/// Index of the node below `x` and the share of the way to the next, 0 to 1: outside the table that of its end.
/// `nodes`: at least two, strictly ascending.
#[inline]
pub fn locate(nodes: &[f64], x: f64) -> (usize, f64) {
    locate_by(nodes, |&node| node, x)
}

/// As [`locate`], in rows whose node `of` gives.
#[inline]
pub fn locate_by<Row>(rows: &[Row], of: impl Fn(&Row) -> f64, x: f64) -> (usize, f64) {
    let right = rows.partition_point(|row| of(row) <= x).clamp(1, rows.len() - 1);
    let (low, high) = (of(&rows[right - 1]), of(&rows[right]));
    (right - 1, ((x - low) / (high - low)).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn nodes_begin_their_interval_and_ends_are_kept() {
        let nodes = [1.0, 2.0, 4.0];
        let expected = [
            (0.5, (0, 0.0)),
            (1.0, (0, 0.0)),
            (1.25, (0, 0.25)),
            (2.0, (1, 0.0)),
            (3.0, (1, 0.5)),
            (4.0, (1, 1.0)),
            (9.0, (1, 1.0)),
        ];
        for (x, found) in expected {
            assert_eq!(locate(&nodes, x), found, "{x}");
        }
        assert_eq!(locate_by(&[(0.0, "low"), (2.0, "high")], |row| row.0, 0.5), (0, 0.25));
    }

    proptest! {
        #[test]
        fn what_is_located_is_found_again(steps in prop::collection::vec(1e-3..10.0, 2..20), share in 0.0..1.0) {
            let nodes: Vec<f64> = steps.iter().scan(0.0, |sum, step| { *sum += step; Some(*sum) }).collect();
            let x = nodes[0] + share * (nodes[nodes.len() - 1] - nodes[0]);
            let (i, t) = locate(&nodes, x);
            prop_assert!((nodes[i] + t * (nodes[i + 1] - nodes[i]) - x).abs() < 1e-9);
        }
    }
}
