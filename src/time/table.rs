//! Embedded tables of what the Earth does.

/// Two columns of numbers, comma separated, under one line of names. Only for embedded tables, which the tests read in full.
pub(super) fn read_table(text: &str) -> Vec<(f64, f64)> {
    text.lines()
        .skip(1)
        .filter_map(|line| {
            let (first, second) = line.split_once(',')?;
            Some((first.parse().ok()?, second.parse().ok()?))
        })
        .collect()
}
