//! Long work with the interpreter released, a progress callback and Ctrl-C.
//!
//! The work runs on a thread of its own; the thread that called from Python waits for it and alone talks to Python. So a callback
//! is always called on the thread that asked for the work, and signals, which Python handles on its main thread only, are seen
//! while the work runs.

use super::errors::{Cancelled, DataError};
use super::fork::{AtWork, in_parallel};
use crate::error::Result;
use crate::progress::Progress;
use pyo3::prelude::*;
use std::borrow::Cow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Duration;

/// How often a waiting thread looks for signals and reports progress.
const POLL: Duration = Duration::from_millis(40);

/// Steps that the work has reported and the listener has not heard of yet; of each stage only the latest.
#[derive(Default)]
struct News {
    steps: Vec<(String, f64)>,
    last_word: LastWord,
    finished: bool,
}

/// Before files get their names the work waits until the listener has heard all and agrees. Then nothing can be cancelled any more.
#[derive(Clone, Copy, Default, PartialEq)]
enum LastWord {
    #[default]
    NotAsked,
    Asked,
    Given,
}

/// Does `work` with the interpreter released and returns what it returns.
///
/// `callback(stage: str, fraction: float)` hears of each stage at least once; `False` from it raises `Cancelled`. An exception that
/// it raises, or `KeyboardInterrupt`, cancels the work and is raised here: then there is no file of it. Once files have their names nothing is told any more, and a signal
/// is left to Python. A panic of the work becomes a `DataError`. A process that was forked works
/// with threads of its own, see [`super::fork`].
pub fn run<T, F>(py: Python<'_>, callback: Option<&Bound<'_, PyAny>>, work: F) -> PyResult<T>
where
    T: Send,
    F: FnOnce(&Progress<'_>) -> Result<T> + Send,
{
    let begun = AtWork::begin()?;
    let callback: Option<Py<PyAny>> = callback.map(|callback| callback.clone().unbind());
    let cancel = AtomicBool::new(false);
    let news = Mutex::new(News::default());
    let (wake, answer) = (Condvar::new(), Condvar::new());
    let listen = |stage: &str, fraction: f64| {
        let mut news = news.lock().unwrap_or_else(PoisonError::into_inner);
        match news.steps.last_mut() {
            // Parts finish on any thread, so a smaller fraction may arrive late.
            Some((last, done)) if last == stage => *done = done.max(fraction),
            _ => news.steps.push((stage.to_string(), fraction)),
        }
        !cancel.load(Ordering::Relaxed)
    };

    let last_word = || {
        let mut news = news.lock().unwrap_or_else(PoisonError::into_inner);
        news.last_word = LastWord::Asked;
        wake.notify_one();
        let _news = answer.wait_while(news, |news| news.last_word == LastWord::Asked).unwrap_or_else(PoisonError::into_inner);
        !cancel.load(Ordering::Relaxed)
    };

    let (outcome, stopped) = py.detach(|| {
        std::thread::scope(|scope| {
            let worker = scope.spawn(|| {
                let _announce = Announce { news: &news, wake: &wake };
                in_parallel(&begun, || work(&Progress::with_last_word(&listen, &last_word)))
            });
            let mut stopped: Option<PyErr> = None;
            let mut settled = false;
            loop {
                let (steps, asked, finished) = wait(&news, &wake);
                if stopped.is_none() && !settled {
                    stopped = Python::attach(|py| tell(py, callback.as_ref(), &steps)).err();
                    if stopped.is_some() {
                        cancel.store(true, Ordering::Relaxed);
                    }
                }
                if asked {
                    settled = stopped.is_none();
                    news.lock().unwrap_or_else(PoisonError::into_inner).last_word = LastWord::Given;
                    answer.notify_one();
                }
                if finished {
                    break;
                }
            }
            (worker.join(), stopped)
        })
    });
    if let Some(reason) = stopped {
        return Err(reason);
    }
    match outcome {
        Ok(result) => result,
        Err(panic) => Err(DataError::new_err(format!("internal error: {}", panic_message(panic.as_ref())))),
    }
}

/// Does short `work` with the interpreter released: it tells nothing and cannot be cancelled.
pub fn apart<T, F>(py: Python<'_>, work: F) -> PyResult<T>
where
    T: Send,
    F: FnOnce() -> Result<T> + Send,
{
    let begun = AtWork::begin()?;
    py.detach(|| in_parallel(&begun, work))
}

/// Says that the work is over, also when it panics.
struct Announce<'a> {
    news: &'a Mutex<News>,
    wake: &'a Condvar,
}

impl Drop for Announce<'_> {
    fn drop(&mut self) {
        self.news.lock().unwrap_or_else(PoisonError::into_inner).finished = true;
        self.wake.notify_one();
    }
}

/// Steps since the last time, whether the last word is asked for, and whether the work is over.
fn wait(news: &Mutex<News>, wake: &Condvar) -> (Vec<(String, f64)>, bool, bool) {
    let guard = news.lock().unwrap_or_else(PoisonError::into_inner);
    let is_quiet = |news: &mut News| !news.finished && news.last_word != LastWord::Asked;
    let (mut guard, _) = wake.wait_timeout_while(guard, POLL, is_quiet).unwrap_or_else(PoisonError::into_inner);
    (std::mem::take(&mut guard.steps), guard.last_word == LastWord::Asked, guard.finished)
}

fn tell(py: Python<'_>, callback: Option<&Py<PyAny>>, steps: &[(String, f64)]) -> PyResult<()> {
    py.check_signals()?;
    let Some(callback) = callback else { return Ok(()) };
    for (stage, fraction) in steps {
        let answer = callback.bind(py).call1((stage, fraction))?;
        if !answer.is_none() && !answer.is_truthy()? {
            return Err(Cancelled::new_err("cancelled"));
        }
    }
    Ok(())
}

fn panic_message(panic: &(dyn std::any::Any + Send)) -> Cow<'static, str> {
    if let Some(text) = panic.downcast_ref::<&'static str>() {
        return Cow::Borrowed(text);
    }
    panic.downcast_ref::<String>().map_or(Cow::Borrowed("panic"), |text| Cow::Owned(text.clone()))
}
