//! The progress of a piece of work as events, and its end.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use kinecut::base::{Code, Finding, Progress, Result};
use serde::Serialize;

use crate::events::Events;
use crate::lanes::{Cancel, Work};

/// Least time between two events.
const PAUSE: Duration = Duration::from_millis(100);

/// Who waits for a piece of work, and for which.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Asked {
    pub(crate) client: String,
    pub(crate) kind: Work,
    pub(crate) file: String,
    pub(crate) generation: u64,
}

/// Watches a piece of work.
pub(crate) struct Watch {
    pub(crate) asked: Asked,
    pub(crate) begun: Instant,
    cancel: Arc<Cancel>,
    events: Arc<Events>,
    stage: Mutex<Stage>,
    done: AtomicU64,
}

#[derive(Default)]
struct Stage {
    name: String,
    steps: u64,
    told: Option<Instant>,
}

#[derive(Serialize)]
struct Told<'a> {
    #[serde(flatten)]
    asked: &'a Asked,
    stage: &'a str,
    done: u64,
    of: u64,
    note: Option<&'a str>,
}

#[derive(Serialize)]
struct Ended<'a> {
    #[serde(flatten)]
    asked: &'a Asked,
    state: &'a str,
    seconds: f64,
}

impl Watch {
    pub(crate) fn new(asked: Asked, cancel: Arc<Cancel>, events: Arc<Events>) -> Watch {
        let (begun, stage, done) = (Instant::now(), Mutex::default(), AtomicU64::new(0));
        Watch { asked, begun, cancel, events, stage, done }
    }

    /// Whether somebody still waits.
    pub(crate) fn is_wanted(&self) -> bool {
        !self.cancel.is_cancelled()
    }

    /// Ends work that nobody waits for.
    ///
    /// # Errors
    /// `KC0009` when it was cancelled.
    pub(crate) fn still_wanted(&self) -> Result<()> {
        match self.is_wanted() {
            true => Ok(()),
            false => Err(Finding::error(Code::CANCELLED, "the work was cancelled").into()),
        }
    }

    /// Time since the request [s].
    pub(crate) fn seconds(&self) -> f64 {
        self.begun.elapsed().as_secs_f64()
    }

    /// Tells that the work has ended.
    pub(crate) fn end(&self, state: &str) {
        let ended = Ended { asked: &self.asked, state, seconds: self.seconds() };
        self.events.send(Some(&self.asked.client), "end", &ended);
    }

    fn tell(&self, stage: &mut Stage, note: Option<&str>, now: bool) {
        if !now && stage.told.is_some_and(|told| told.elapsed() < PAUSE) {
            return;
        }
        stage.told = Some(Instant::now());
        let (asked, done, of) = (&self.asked, self.done.load(Ordering::Relaxed), stage.steps);
        let told = Told { asked, stage: &stage.name, done: done.min(of), of, note };
        self.events.send(Some(&self.asked.client), "progress", &told);
    }
}

impl Progress for Watch {
    fn stage(&self, name: &str, steps: u64) {
        let mut stage = self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        self.done.store(0, Ordering::Relaxed);
        *stage = Stage { name: name.to_owned(), steps: steps.max(1), told: stage.told };
        self.tell(&mut stage, None, false);
    }

    fn advance(&self, steps: u64) {
        self.done.fetch_add(steps, Ordering::Relaxed);
        // A thread that finds another one telling goes on.
        if let Ok(mut stage) = self.stage.try_lock() {
            self.tell(&mut stage, None, false);
        }
    }

    fn note(&self, text: &str) {
        let mut stage = self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        self.tell(&mut stage, Some(text), true);
    }

    fn cancelled(&self) -> bool {
        self.cancel.is_cancelled()
    }
}
