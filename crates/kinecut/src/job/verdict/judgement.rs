//! The one word of a verdict.

use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::base::{Finding, Severity};

/// The outcome of a verdict: the worst of its findings in one word.
///
/// ```
/// use kinecut::base::{Code, Finding};
/// use kinecut::job::Judgement;
/// let warning = Finding::warning(Code::FEED_IN_AIR, "feeds through air");
/// let doubt = Finding::doubt(Code::NOTHING_REMOVED, "removes nothing");
/// assert_eq!(Judgement::of(&[warning.clone()]), Judgement::Safe);
/// assert_eq!(Judgement::of(&[warning, doubt]).word(), "NOT PROVEN");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Judgement {
    /// No error was found, and all that could touch something was followed.
    Safe,
    /// No error was found, but something could not be proven.
    NotProven,
    /// An error was found.
    NotSafe,
}

impl Judgement {
    /// The outcome of findings.
    pub fn of(findings: &[Finding]) -> Judgement {
        match findings.iter().map(|f| f.severity).max() {
            Some(Severity::Error) => Judgement::NotSafe,
            Some(Severity::Doubt) => Judgement::NotProven,
            Some(Severity::Warning | Severity::Note) | None => Judgement::Safe,
        }
    }

    /// Whether it is safe.
    pub fn is_safe(self) -> bool {
        self == Judgement::Safe
    }

    /// As shown: "SAFE", "NOT PROVEN", "NOT SAFE".
    pub fn word(self) -> &'static str {
        match self {
            Judgement::Safe => "SAFE",
            Judgement::NotProven => "NOT PROVEN",
            Judgement::NotSafe => "NOT SAFE",
        }
    }
}

impl fmt::Display for Judgement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
