//! Progress of long work, and the way to cancel it.

use crate::error::{Error, Result};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Receives the stage of the work ("solve", "gather", "render", "write") and the fraction of that stage
/// that is done (0 to 1); returns `false` to cancel. It may be called from any thread.
pub type Callback<'a> = dyn Fn(&str, f64) -> bool + Sync + 'a;

/// Asked once when all is done but what cannot be undone; returns `false` to cancel.
pub type LastWord<'a> = dyn Fn() -> bool + Sync + 'a;

/// Handed down to long work, which reports to it and stops when it says so.
#[derive(Clone, Copy, Default)]
pub struct Progress<'a> {
    callback: Option<&'a Callback<'a>>,
    last_word: Option<&'a LastWord<'a>>,
}

impl<'a> Progress<'a> {
    /// Nobody listens and nobody cancels.
    pub const fn silent() -> Self {
        Self { callback: None, last_word: None }
    }

    /// Reports to `callback`.
    pub const fn new(callback: &'a Callback<'a>) -> Self {
        Self { callback: Some(callback), last_word: None }
    }

    /// Reports to `callback`, which may hear of it later; `last_word` waits until it has heard all, and tells its answer.
    pub const fn with_last_word(callback: &'a Callback<'a>, last_word: &'a LastWord<'a>) -> Self {
        Self { callback: Some(callback), last_word: Some(last_word) }
    }

    /// Says that `fraction` (0 to 1) of `stage` is done.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the listener wants the work to stop.
    pub fn report(&self, stage: &str, fraction: f64) -> Result<()> {
        match self.callback {
            Some(callback) if !callback(stage, fraction.clamp(0.0, 1.0)) => Err(Error::Cancelled),
            _ => Ok(()),
        }
    }

    /// Asks a last time, as the whole stage "write", before finished files get their names. From then on nothing is reported any more, and nothing is cancelled.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the listener wants the work to stop.
    pub fn confirm(&self) -> Result<()> {
        self.report("write", 1.0)?;
        match self.last_word {
            Some(last_word) if !last_word() => Err(Error::Cancelled),
            _ => Ok(()),
        }
    }

    /// Counts `total` equal parts of `stage` that may finish on any thread.
    pub fn parts(&self, stage: &'static str, total: usize) -> Parts<'a> {
        Parts { progress: *self, stage, total: total.max(1), done: AtomicUsize::new(0) }
    }
}

/// Equal parts of one stage; see [`Progress::parts`].
pub struct Parts<'a> {
    progress: Progress<'a>,
    stage: &'static str,
    total: usize,
    done: AtomicUsize,
}

impl Parts<'_> {
    /// Says that one more part is done.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the listener wants the work to stop.
    pub fn finish_one(&self) -> Result<()> {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.progress.report(self.stage, done as f64 / self.total as f64)
    }

    /// Asks, within a part that takes long, whether to go on.
    ///
    /// # Errors
    /// [`Error::Cancelled`] if the listener wants the work to stop.
    pub fn check(&self) -> Result<()> {
        self.progress.report(self.stage, self.done.load(Ordering::Relaxed) as f64 / self.total as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_listener_that_says_no_cancels() {
        let stop = |_: &str, fraction: f64| fraction < 0.5;
        let progress = Progress::new(&stop);
        assert!(progress.report("solve", 0.25).is_ok());
        assert!(matches!(progress.report("solve", 0.75), Err(Error::Cancelled)));
        assert!(Progress::silent().report("solve", 1.0).is_ok());
    }

    #[test]
    fn the_last_word_counts() {
        let go_on = |_: &str, _: f64| true;
        for answer in [true, false] {
            let last_word = || answer;
            assert_eq!(Progress::with_last_word(&go_on, &last_word).confirm().is_ok(), answer);
        }
        let stop = |stage: &str, fraction: f64| (stage, fraction) != ("write", 1.0);
        assert!(matches!(Progress::new(&stop).confirm(), Err(Error::Cancelled)));
        assert!(Progress::silent().confirm().is_ok());
    }

    #[test]
    fn parts_add_up_to_one() {
        let last = std::sync::Mutex::new(0.0);
        let listen = |_: &str, fraction: f64| {
            *last.lock().unwrap() = fraction;
            true
        };
        let parts = Progress::new(&listen).parts("render", 4);
        for _ in 0..4 {
            parts.finish_one().unwrap();
        }
        assert_eq!(*last.lock().unwrap(), 1.0);
    }
}
