//! A path as lines by their roles.

use serde::{Deserialize, Serialize};

/// What a piece of path is for; decides colour, dash and word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PathRole {
    /// Fast move that must not cut.
    Rapid,
    /// Into or out of the cut.
    Lead,
    /// At feed in a program that others wrote: what for is not known.
    Feed,
    /// Removing the bulk.
    Rough,
    /// Making the final surface.
    Finish,
    /// Between cuts at feed.
    #[default]
    Link,
}

impl PathRole {
    /// The roles in the order of drawing: what matters most comes last.
    pub const ALL: [PathRole; 6] =
        [PathRole::Rapid, PathRole::Link, PathRole::Lead, PathRole::Feed, PathRole::Rough, PathRole::Finish];

    /// The word shown.
    pub fn word(self) -> &'static str {
        match self {
            PathRole::Rapid => "rapid",
            PathRole::Lead => "lead",
            PathRole::Feed => "feed",
            PathRole::Rough => "rough",
            PathRole::Finish => "finish",
            PathRole::Link => "link",
        }
    }
}

/// A stretch of tool tip path that one program line makes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathPiece {
    /// Line of the program text, from 0.
    pub block: u32,
    /// What it is for.
    pub role: PathRole,
    /// Index in [`Report::tools`].
    pub tool: u32,
    /// Direction from the tool tip to the spindle in part coordinates, unit.
    pub axis: [f32; 3],
    /// The polyline, part coordinates [mm].
    pub points: Vec<[f32; 3]>,
}

impl PathPiece {
    /// A piece cut by the first tool with its axis along Z.
    pub fn new(block: u32, role: PathRole, points: Vec<[f32; 3]>) -> PathPiece {
        PathPiece { block, role, tool: 0, axis: [0.0, 0.0, 1.0], points }
    }
}
