//! Lanes of work: in each the newest request counts, and an older one stops.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use serde::{Deserialize, Serialize};
use tokio::sync::Notify;

/// A kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Work {
    /// Planned and posted.
    Plan,
    /// Cut.
    Simulate,
    /// A planner by itself.
    Verb,
    /// A job guessed of a program.
    Guess,
    /// Run, and its files written.
    Write,
}

/// A lane: who asks, for what, about which file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Lane {
    pub(crate) client: String,
    pub(crate) work: Work,
    pub(crate) file: String,
}

/// Whether work is still wanted.
#[derive(Debug, Default)]
pub(crate) struct Cancel {
    done: AtomicBool,
    notify: Notify,
}

impl Cancel {
    pub(crate) fn is_cancelled(&self) -> bool {
        self.done.load(Ordering::Relaxed)
    }

    pub(crate) fn cancel(&self) {
        self.done.store(true, Ordering::Relaxed);
        self.notify.notify_waiters();
    }

    /// Waits until it is no longer wanted.
    pub(crate) async fn cancelled(&self) {
        let notified = self.notify.notified();
        // Between the question and the wait nothing is missed: the wait began first.
        if !self.is_cancelled() {
            notified.await;
        }
    }
}

/// All lanes in which there is work.
#[derive(Default)]
pub(crate) struct Lanes {
    next: AtomicU64,
    running: Mutex<BTreeMap<Lane, (u64, Arc<Cancel>)>>,
}

/// A piece of work in its lane; when it goes, so does the wish for it.
pub(crate) struct Ticket {
    lanes: Arc<Lanes>,
    lane: Lane,
    number: u64,
    pub(crate) cancel: Arc<Cancel>,
}

impl Lanes {
    fn running(&self) -> MutexGuard<'_, BTreeMap<Lane, (u64, Arc<Cancel>)>> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins a piece of work; an older one of the lane is cancelled.
    pub(crate) fn begin(self: &Arc<Lanes>, lane: Lane) -> Ticket {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let cancel = Arc::new(Cancel::default());
        if let Some((_, older)) = self.running().insert(lane.clone(), (number, Arc::clone(&cancel))) {
            older.cancel();
        }
        Ticket { lanes: Arc::clone(self), lane, number, cancel }
    }

    /// Cancels the work of a client of a kind, about one file or all; how much that was.
    pub(crate) fn stop(&self, client: &str, work: Work, file: Option<&str>) -> usize {
        let running = self.running();
        let those = running.iter().filter(|(lane, _)| {
            lane.client == client && lane.work == work && file.is_none_or(|file| file == lane.file)
        });
        those.map(|(_, (_, cancel))| cancel.cancel()).count()
    }

    /// Cancels all work.
    pub(crate) fn stop_all(&self) {
        self.running().values().for_each(|(_, cancel)| cancel.cancel());
    }

    /// Number of lanes with work.
    pub(crate) fn count(&self) -> usize {
        self.running().len()
    }
}

impl Drop for Ticket {
    fn drop(&mut self) {
        self.cancel.cancel();
        let mut running = self.lanes.running();
        if running.get(&self.lane).is_some_and(|(number, _)| *number == self.number) {
            running.remove(&self.lane);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_of_a_lane_counts_and_lanes_know_nothing_of_one_another() {
        let lanes = Arc::new(Lanes::default());
        let lane = |client: &str, work| Lane { client: client.to_owned(), work, file: "f".to_owned() };
        let first = lanes.begin(lane("a", Work::Plan));
        let others = [lanes.begin(lane("b", Work::Plan)), lanes.begin(lane("a", Work::Simulate))];
        let second = lanes.begin(lane("a", Work::Plan));
        assert!(first.cancel.is_cancelled() && !second.cancel.is_cancelled());
        drop(first);
        assert!(lanes.count() == 3 && others.iter().all(|t| !t.cancel.is_cancelled()));
        assert_eq!(lanes.stop("a", Work::Plan, Some("g")), 0);
        assert_eq!(lanes.stop("a", Work::Plan, None), 1);
        assert!(second.cancel.is_cancelled());
        drop((second, others));
        assert_eq!(lanes.count(), 0);
    }
}
