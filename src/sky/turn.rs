//! One thread at a time, where those that wait can be cancelled, and a process that was forked meanwhile does not wait for a thread that it does not have.

use crate::error::Result;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// How often a waiting thread looks whether it is its turn.
const POLL: Duration = Duration::from_millis(5);

/// The process whose thread has the turn; 0 if none has. No operating system gives that number to a program.
#[derive(Default)]
pub(super) struct Turn(AtomicU32);

/// A turn that was taken; it ends when this is dropped.
pub(super) struct Taken<'a>(&'a Turn);

impl Turn {
    /// Waits for the turn and takes it; `go_on` is asked again and again while it waits.
    ///
    /// # Errors
    /// What `go_on` returns.
    pub fn take(&self, go_on: impl Fn() -> Result<()>) -> Result<Taken<'_>> {
        let this_process = std::process::id();
        loop {
            let holder = self.0.load(Ordering::Relaxed);
            // A fork copies the memory but not the other threads.
            if holder != this_process
                && self.0.compare_exchange(holder, this_process, Ordering::Acquire, Ordering::Relaxed).is_ok()
            {
                return Ok(Taken(self));
            }
            go_on()?;
            std::thread::sleep(POLL);
        }
    }
}

impl Drop for Taken<'_> {
    fn drop(&mut self) {
        self.0.0.store(0, Ordering::Release);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;

    #[test]
    fn the_turn_is_one_threads_until_it_ends_and_never_another_processs() {
        let turn = Turn::default();
        let stop = || Err(Error::Cancelled);
        let taken = turn.take(stop).unwrap();
        assert!(matches!(turn.take(stop), Err(Error::Cancelled)));
        drop(taken);
        assert!(turn.take(stop).is_ok());
        // As a child sees it whose parent's thread had the turn.
        turn.0.store(std::process::id().wrapping_add(1), Ordering::Relaxed);
        assert!(turn.take(stop).is_ok());
    }

    #[test]
    fn one_thread_after_the_other_gets_its_turn() {
        let (turn, inside) = (Turn::default(), AtomicU32::new(0));
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    let _taken = turn.take(|| Ok(())).unwrap();
                    assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0);
                    std::thread::sleep(Duration::from_millis(2));
                    inside.fetch_sub(1, Ordering::SeqCst);
                });
            }
        });
    }
}
