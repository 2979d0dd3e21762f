//! Threads of the work: those of plans never wait for simulations.

use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::{ThreadPool, ThreadPoolBuilder};
use tokio::sync::{Semaphore, oneshot};

use crate::lanes::Work;

/// Pieces of long work at once.
const RUNNING: usize = 2;
/// Bytes of the stack of a thread: as many as the main thread of a program has.
const STACK: usize = 8 << 20;

/// The pools, and the places in them.
pub(crate) struct Pools {
    quick: ThreadPool,
    long: ThreadPool,
    quick_places: Arc<Semaphore>,
    long_places: Arc<Semaphore>,
    waiting: Arc<AtomicUsize>,
    most_waiting: usize,
}

/// Why work has no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoResult {
    /// Too much waits already.
    Busy,
    /// It panicked.
    Defect,
}

impl Pools {
    /// Pools in which so many pieces of work may wait.
    ///
    /// # Errors
    /// That of a system without threads.
    pub(crate) fn new(most_waiting: usize) -> io::Result<Pools> {
        let pool = |name: &'static str| {
            let named = ThreadPoolBuilder::new().thread_name(move |i| format!("{name}-{i}"));
            named.stack_size(STACK).build().map_err(io::Error::other)
        };
        Ok(Pools {
            quick: pool("plan")?,
            long: pool("simulate")?,
            quick_places: Arc::new(Semaphore::new(RUNNING)),
            long_places: Arc::new(Semaphore::new(RUNNING)),
            waiting: Arc::default(),
            most_waiting,
        })
    }

    /// Pieces of work that wait or run.
    pub(crate) fn waiting(&self) -> usize {
        self.waiting.load(Ordering::Relaxed)
    }

    /// Does a piece of work when there is place for it.
    ///
    /// # Errors
    /// Too much waits, or it panicked.
    pub(crate) async fn run<T: Send + 'static>(
        &self,
        work: Work,
        job: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, NoResult> {
        if self.waiting() >= self.most_waiting {
            return Err(NoResult::Busy);
        }
        let waits = Waits::one_more(&self.waiting);
        let (pool, places) = match work {
            Work::Plan | Work::Verb | Work::Guess => (&self.quick, &self.quick_places),
            Work::Simulate | Work::Write => (&self.long, &self.long_places),
        };
        // Places are never closed.
        let place = Arc::clone(places).acquire_owned().await.map_err(|_| NoResult::Defect)?;
        let (into, from) = oneshot::channel();
        pool.spawn(move || {
            let done = catch_unwind(AssertUnwindSafe(job));
            drop((place, waits));
            // Whoever asked may have gone.
            let _ = into.send(done.map_err(|_| NoResult::Defect));
        });
        from.await.unwrap_or(Err(NoResult::Defect))
    }
}

/// One piece of work that waits or runs.
struct Waits(Arc<AtomicUsize>);

impl Waits {
    fn one_more(count: &Arc<AtomicUsize>) -> Waits {
        count.fetch_add(1, Ordering::Relaxed);
        Waits(Arc::clone(count))
    }
}

impl Drop for Waits {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_defect_and_the_next_piece_of_work_is_done() {
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        let pools = Pools::new(4).unwrap();
        for work in [Work::Plan, Work::Simulate] {
            for _ in 0..3 {
                let failed = runtime.block_on(pools.run(work, || -> u32 { panic!("a defect, on purpose") }));
                assert_eq!(failed, Err(NoResult::Defect));
            }
            assert_eq!(runtime.block_on(pools.run(work, || 7)), Ok(7));
        }
        assert_eq!(pools.waiting(), 0);
    }
}
