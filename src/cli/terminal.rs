//! Ctrl-C and the progress bar: what a person at the terminal sees of long work.
//!
//! The first Ctrl-C, or polite request to end, stops long work at its next report, which it makes several times a second; whatever does not stop within
//! [`PATIENCE`], and what is not long work, ends at once, as everything does at the second one. No unfinished file is left. Once the last files of a command have got their names
//! the work is done, and the exit code says so.

use crate::error::Result;
use crate::io::atomic;
use crate::progress::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// What a shell reports for a program that was interrupted: 128 + SIGINT.
pub const EXIT_CODE: u8 = 130;

/// How long work has to stop by itself.
const PATIENCE: Duration = Duration::from_secs(1);

/// Set by the first signal.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Whether files are still to come after those that are worked on.
static MORE_TO_COME: AtomicBool = AtomicBool::new(false);

/// How many calls of [`with_progress`] go on.
static WORKING: AtomicUsize = AtomicUsize::new(0);

/// Makes signals end the process tidily. Without a handler it would die while the temporary file of an output lies beside its target.
pub fn handle_signals() {
    begin_files(false);
    // It can fail only if a handler of this crate is there already, from an earlier run in the same process.
    let _ = ctrlc::set_handler(|| {
        let is_first = !INTERRUPTED.swap(true, Ordering::SeqCst);
        if is_first && WORKING.load(Ordering::SeqCst) > 0 {
            std::thread::spawn(|| {
                std::thread::sleep(PATIENCE);
                end_unless_done();
            });
        } else if is_first {
            end_unless_done();
        } else {
            end();
        }
    });
}

/// Says that work on files begins which get their names together, from their reading on, and whether there is `more_to_come` after them.
pub fn begin_files(more_to_come: bool) {
    // In this order: what was written before is never taken for the last.
    atomic::begin();
    MORE_TO_COME.store(more_to_come, Ordering::SeqCst);
}

/// What was done is told to the end: that takes no time.
fn end_unless_done() {
    if MORE_TO_COME.load(Ordering::SeqCst) || !atomic::is_committed() {
        end();
    }
}

/// Ends the process. Only who has written all files is told that all is done.
fn end() -> ! {
    let is_last = !MORE_TO_COME.load(Ordering::SeqCst);
    let is_done = atomic::abandon() && is_last;
    std::process::exit(if is_done { 0 } else { EXIT_CODE.into() })
}

/// Does `work` with a progress bar, if the standard error is a terminal, until it is done or interrupted.
pub fn with_progress<T>(work: impl FnOnce(&Progress<'_>) -> Result<T>) -> Result<T> {
    WORKING.fetch_add(1, Ordering::SeqCst);
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
        !INTERRUPTED.load(Ordering::SeqCst)
    };
    let progress = Progress::new(&listen);
    let outcome = progress.report("", 0.0).and_then(|()| work(&progress));
    bar.finish_and_clear();
    WORKING.fetch_sub(1, Ordering::SeqCst);
    outcome
}
