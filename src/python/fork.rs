//! Work in a process that was forked from one that has worked already.
//!
//! A fork copies the memory and one thread. Rayon's threads are not in the child, and what waits for them waits for ever: so the child works with a pool of its own. What another
//! thread of the parent held locked at that moment stays locked in the child: a child of a parent that was at work says so at once instead of waiting.
//!
//! So all that computes ([`super::work`]), uses a table made at first use, or makes files (which locks the list of unfinished ones) asks here first. `Component`, `Phase`, `Night`,
//! `PolarisingFilter`, `Adaptation`, coordinates as text and the getters of results do not: they take numbers and words, without threads, tables or locks that work holds.

use crate::error::Result;
use pyo3::exceptions::PyRuntimeError;
use pyo3::{PyErr, PyResult};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// The process that rayon's own pool belongs to; 0 before any work.
static FIRST: AtomicU32 = AtomicU32::new(0);

/// The process whose work is counted, and how much of it goes on with the interpreter released.
static COUNTED: AtomicU32 = AtomicU32::new(0);
static AT_WORK: AtomicUsize = AtomicUsize::new(0);

/// The pool of a child, with its process. It is locked at work only, and a child of a parent at work does not come here.
static OF_CHILD: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Work that is counted until this is dropped.
pub struct AtWork(());

impl AtWork {
    /// Counts work that begins. The caller holds the interpreter, so that no other thread of Python forks meanwhile.
    ///
    /// # Errors
    /// `RuntimeError` in a process that was forked while its parent was at work.
    pub fn begin() -> PyResult<Self> {
        let this_process = std::process::id();
        let _ = FIRST.compare_exchange(0, this_process, Ordering::SeqCst, Ordering::SeqCst);
        if COUNTED.load(Ordering::SeqCst) != this_process {
            if AT_WORK.load(Ordering::SeqCst) != 0 {
                return Err(PyRuntimeError::new_err(
                    "this process was forked while another thread of its parent was at work in skyprobe, and would wait for that thread for ever: \
                     fork when no work goes on, or use multiprocessing's \"spawn\" or \"forkserver\"",
                ));
            }
            COUNTED.store(this_process, Ordering::SeqCst);
        }
        AT_WORK.fetch_add(1, Ordering::SeqCst);
        Ok(Self(()))
    }
}

/// Refuses short work with the interpreter held in a child that would wait for ever: tables that are made at first use may be half made in it, and what guards files may be
/// locked.
///
/// # Errors
/// As [`AtWork::begin`].
pub fn check() -> PyResult<()> {
    AtWork::begin().map(drop)
}

impl Drop for AtWork {
    fn drop(&mut self) {
        AT_WORK.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Does `work` with threads that this process has.
///
/// # Errors
/// `RuntimeError` if a child gets no threads.
pub fn in_parallel<T: Send>(_begun: &AtWork, work: impl FnOnce() -> Result<T> + Send) -> PyResult<T> {
    let this_process = std::process::id();
    if FIRST.load(Ordering::SeqCst) == this_process {
        return Ok(work()?);
    }
    let pool = {
        let mut kept = OF_CHILD.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.as_ref().is_none_or(|(process, _)| *process != this_process) {
            let pool = ThreadPoolBuilder::new()
                .build()
                .map_err(|error| PyErr::new::<PyRuntimeError, _>(format!("no threads for a process that was forked: {error}")))?;
            // An ancestor's pool has no threads here that could end.
            std::mem::forget(kept.replace((this_process, Arc::new(pool))));
        }
        kept.as_ref().map(|(_, pool)| pool.clone())
    };
    match pool {
        Some(pool) => Ok(pool.install(work)?),
        None => Ok(work()?),
    }
}
