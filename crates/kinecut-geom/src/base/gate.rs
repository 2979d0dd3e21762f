//! The gate for numbers from outside: the things that they ask for are counted before they are built.
//!
//! A number may be fine by itself and still ask for a thousand million teeth. Code that builds something whose size
//! follows from a number of this kind announces it here first: how many of what, and so how many bytes. Counts beyond
//! the bound are refused; the counts let through are summed up, so that a test can compare them with a budget.

use std::sync::atomic::{AtomicU64, Ordering};

use super::{Code, Finding, Result};

/// A bound on how many of a thing are built at once.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::base::{CountBound, Code};
/// let turns = CountBound { what: "turns", most: 999.0, bytes: 64, code: Code::JOB_VALUE, help: "write fewer" };
/// assert!(turns.check(999.0).is_ok());
/// assert_eq!(turns.check(1e9).unwrap_err().to_string(), "too many turns: 1000000000, bound 999; write fewer");
/// assert!(turns.check(f64::NAN).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CountBound {
    /// The thing, as in "too many turns".
    pub what: &'static str,
    /// Most of them.
    pub most: f64,
    /// Memory that each takes, about [bytes].
    pub bytes: u64,
    /// Code of the finding beyond it.
    pub code: Code,
    /// The help: a value to write instead.
    pub help: &'static str,
}

impl CountBound {
    /// Announces that `count` of them are to be built.
    ///
    /// # Errors
    /// A finding with count, bound and help when they are too many, or no number.
    pub fn check(&self, count: f64) -> Result<()> {
        if count <= self.most {
            let bytes = count.max(0.0) * self.bytes as f64;
            ASKED.fetch_add(bytes as u64, Ordering::Relaxed);
            return Ok(());
        }
        Err(Finding::error(self.code, format!("too many {}", self.what))
            .value(count, "")
            .bound(self.most, "")
            .help(self.help)
            .into())
    }
}

static ASKED: AtomicU64 = AtomicU64::new(0);

/// Bytes that were announced by all threads since the process began.
pub fn bytes_asked() -> u64 {
    ASKED.load(Ordering::Relaxed)
}

/// Refuses counts that only together are too many: the sum of a program, not of one of its lines.
///
/// ```
/// # use kinecut_geom as kinecut;
/// use kinecut::base::{CountBound, Code, Sum};
/// let holes = CountBound { what: "holes", most: 5.0, bytes: 0, code: Code::NC_STATE, help: "" };
/// let mut sum = Sum::default();
/// assert!(sum.add(&holes, 3.0).is_ok() && sum.add(&holes, 2.0).is_ok() && sum.add(&holes, 1.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sum(f64);

impl Sum {
    /// Announces that `count` more are to be built.
    ///
    /// # Errors
    /// As [`CountBound::check`], of the sum.
    pub fn add(&mut self, bound: &CountBound, count: f64) -> Result<()> {
        self.0 += count;
        if self.0 <= bound.most { bound.check(count) } else { bound.check(self.0) }
    }
}
