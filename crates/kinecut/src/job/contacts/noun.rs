//! Nouns of what meets.

use crate::contact::ToolPart;

/// Noun of a part of a tool.
pub(in crate::job) fn noun(part: ToolPart) -> &'static str {
    match part {
        ToolPart::Cutter => "tool",
        ToolPart::Shank => "shank",
        ToolPart::Holder => "holder",
    }
}
