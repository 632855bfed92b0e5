//! For tests: our times of events against those of an almanac.

use crate::time::{Time, ZoneChoice};

/// Furthest that two times of one event may lie apart [s]: both are rounded to the second.
const TOLERANCE_S: f64 = 1.5;

/// Asserts that `ours` are the times of `theirs` (empty: the event does not happen) and returns how many were compared; `row` says in a message where.
pub(super) fn count_equal<'a>(ours: impl IntoIterator<Item = &'a Option<Time>>, theirs: &[&str], row: &str) -> usize {
    let mut compared = 0;
    let mut ours = ours.into_iter();
    for theirs in theirs {
        match (ours.next().expect("as many times as the almanac has"), *theirs) {
            (None, "") => {}
            (Some(time), text) if !text.is_empty() => {
                let expected = Time::parse(text, ZoneChoice::InText).unwrap();
                assert!(time.seconds_until(&expected).abs() <= TOLERANCE_S, "{row}: {time}, not {text}");
                compared += 1;
            }
            (ours, theirs) => panic!("{row}: {ours:?}, not {theirs:?}"),
        }
    }
    assert!(ours.next().is_none(), "{row}: more times than the almanac has");
    compared
}
