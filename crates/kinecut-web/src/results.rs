//! Results that are kept for questions about them: the newest few, and of a file of a client one.

use std::collections::VecDeque;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use kinecut::job::Outcome;
use kinecut::job::report::Report;

/// A simulated job.
pub(crate) struct Kept {
    pub(crate) outcome: Outcome,
    pub(crate) report: Report,
}

struct Numbered {
    number: u64,
    of: (String, String),
    kept: Arc<Kept>,
}

/// The newest results, the newest last.
pub(crate) struct Results {
    next: AtomicU64,
    most: usize,
    kept: Mutex<VecDeque<Numbered>>,
}

impl Results {
    pub(crate) fn new(most: usize) -> Results {
        Results { next: AtomicU64::new(1), most, kept: Mutex::default() }
    }

    /// Keeps one in the place of the older one of the same client and file; its name.
    pub(crate) fn keep(&self, of: (String, String), kept: Kept) -> (String, Arc<Kept>) {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let mut all = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        all.retain(|one| one.of != of);
        let kept = Arc::new(kept);
        all.push_back(Numbered { number, of, kept: Arc::clone(&kept) });
        while all.len() > self.most {
            all.pop_front();
        }
        (format!("r{number}"), kept)
    }

    /// The result of a name.
    pub(crate) fn get(&self, name: &str) -> Option<Arc<Kept>> {
        let number: u64 = name.strip_prefix('r')?.parse().ok()?;
        let all = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        all.iter().find(|one| one.number == number).map(|one| Arc::clone(&one.kept))
    }

    /// Number of results kept.
    pub(crate) fn count(&self) -> usize {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner).len()
    }
}
