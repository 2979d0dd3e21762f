//! Origins of items.

use serde::{Deserialize, Serialize};

use crate::base::Span;

/// Index of an origin in a program; items whose origins differ in their place in the text only share it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct OriginId(pub u32);

/// Purpose of a move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// Into or out of the cut.
    Lead,
    /// Removing the bulk.
    Rough,
    /// Making the final surface.
    Finish,
    /// Between cuts.
    #[default]
    Link,
}

/// Origin of an item: a place in a text, or an operation of a planner, or both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// Place in the NC text or job file.
    pub span: Option<Span>,
    /// The call that led here (subprogram, cycle).
    pub parent: Option<OriginId>,
    /// Number of the operation in the job, counted over all setups.
    pub operation: Option<u32>,
    /// Purpose of the move.
    pub role: Role,
}
