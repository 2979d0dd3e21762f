//! Numbers that an operation was given, with their origins.

use std::fmt;

use crate::cutting::StartChange;
use crate::page::trimmed;

/// Speed and feed that an operation was given.
#[derive(Clone, Debug, PartialEq)]
pub struct TakenData {
    /// Setup, and operation in it, by index.
    pub operation: (usize, usize),
    /// Number of its tool.
    pub tool: u32,
    /// Its cutting speed (m/min), or the speed of its spindle (rev/min), where it had neither.
    pub speed: Option<TakenNumber>,
    /// Its feed per tooth or per revolution [mm], or its feed (mm/min), where it had none.
    pub feed: Option<TakenNumber>,
    /// The limit to which its speed was lowered.
    pub limited: Option<SpeedLimit>,
}

impl TakenData {
    /// Its numbers.
    pub fn numbers(&self) -> impl Iterator<Item = &TakenNumber> {
        self.speed.iter().chain(&self.feed)
    }

    /// Whether one of them is a value to start with.
    pub fn has_start(&self) -> bool {
        self.numbers().any(|number| matches!(number.origin, DataOrigin::Start { .. }))
    }
}

/// A number with its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct TakenNumber {
    /// The key of the operation that it fills.
    pub key: &'static str,
    /// Its value, in the unit of the key.
    pub value: f64,
    /// That unit.
    pub unit: &'static str,
    /// Its origin.
    pub origin: DataOrigin,
    /// The value before all changes.
    pub plain: f64,
    /// Factors by which it was changed.
    pub changes: Vec<StartChange>,
}

/// The origin of a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DataOrigin {
    /// A preset of the tool for this material; the file of the tool, if it is from one.
    Preset {
        /// The material as the preset names it.
        material: String,
        /// The file.
        file: Option<String>,
    },
    /// A row of the shop's own table.
    Table {
        /// The file.
        file: String,
        /// The line of the row, from 1.
        line: u32,
    },
    /// A value to start with.
    Start {
        /// Its row: "C45, carbide, full width".
        row: String,
        /// The material of the tool's edges, where the tool does not say it.
        assumed: Option<&'static str>,
    },
}

/// A speed that was lowered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedLimit {
    /// The wanted one (rev/min).
    pub wanted: f64,
    /// The limit (rev/min).
    pub limit: f64,
    /// The cutting speed at the limit (m/min).
    pub cutting_speed: Option<f64>,
    /// Whether it is the limit of the tool, not of the machine.
    pub of_tool: bool,
}

impl fmt::Display for TakenNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.key, trimmed(self.value, 4), self.unit)
    }
}

impl TakenNumber {
    /// The way from the plain value: "0.06 x 0.8 (full width)"; nothing where it was not changed.
    pub fn way(&self) -> Option<String> {
        let factor = |c: &StartChange| format!(" x {} ({})", trimmed(c.factor, 2), c.what);
        let all: String = self.changes.iter().map(factor).collect();
        (!all.is_empty()).then(|| format!("{}{all}", trimmed(self.plain, 4)))
    }
}
