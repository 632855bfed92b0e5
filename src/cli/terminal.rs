//! Ctrl-C and the progress bar: what a person at the terminal sees of long work.

use crate::error::Result;
use crate::progress::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// What a shell reports for a program that was interrupted: 128 + SIGINT.
pub const EXIT_CODE: u8 = 130;

/// Set by Ctrl-C, and by a polite request to end. Without a handler the process would die while the temporary file of an output lies
/// beside its target; with it, the work stops at the next report of progress and every temporary file is removed.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Does `work` with a progress bar, if the standard error is a terminal, until it is done or interrupted.
pub fn with_progress<T>(work: impl FnOnce(&Progress<'_>) -> Result<T>) -> Result<T> {
    // It can fail only if a handler of this crate is there already, from an earlier run in the same process.
    let _ = ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed));
    let quiet = super::QUIET.load(Ordering::Relaxed);
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(10) };
    let bar = ProgressBar::with_draw_target(Some(1000), target);
    if let Ok(style) = ProgressStyle::with_template("{prefix:>8} [{bar:40}] {percent:>3} % {elapsed}") {
        bar.set_style(style.progress_chars("=> "));
    }
    let stage_shown = Mutex::new(String::new());
    let listen = |stage: &str, fraction: f64| {
        if let Ok(mut shown) = stage_shown.lock()
            && *shown != stage
        {
            *shown = stage.to_string();
            bar.set_prefix(stage.to_string());
        }
        bar.set_position((fraction * 1000.0) as u64);
        !INTERRUPTED.load(Ordering::Relaxed)
    };
    let outcome = work(&Progress::new(&listen));
    bar.finish_and_clear();
    outcome
}
