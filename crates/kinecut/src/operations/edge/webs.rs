//! Webs: lengths of an edge before inside corners, along which a chamfer is not cut whole.

use crate::base::{Code, Finding};
use crate::contouring::{EdgeBreak, UncutCorner};
use crate::page::trimmed;

/// Webs that a chamfer leaves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Webs {
    /// Number of corners that keep one.
    pub(super) corners: usize,
    /// Length of the edges that they keep in all [mm].
    pub(super) length: f64,
    /// Number of places between two loops, where the cutter does not go.
    pub(super) gaps: usize,
}

impl Webs {
    pub(super) fn of(uncut: &[UncutCorner]) -> Webs {
        let corners = uncut.iter().filter_map(|c| c.length);
        Webs {
            corners: corners.clone().count(),
            length: corners.sum(),
            gaps: uncut.iter().filter(|c| c.length.is_none()).count(),
        }
    }

    /// Edges that stay, in words; empty without any.
    pub(super) fn in_words(&self) -> String {
        let count = |n: usize, one: &str, more: &str| format!("{n} {}", if n == 1 { one } else { more });
        let mut parts = Vec::new();
        if self.corners > 0 {
            let corners = count(self.corners, "inside corner", "inside corners");
            parts.push(format!("{} mm of edge at {corners}", trimmed(self.length, 2)));
        }
        if self.gaps > 0 {
            let gaps = count(self.gaps, "place", "places");
            parts.push(format!("{gaps} between two loops, where the cutter does not go"));
        }
        parts.join("; ")
    }
}

/// A warning about webs, at the first of them.
pub(super) fn warning(uncut: &[UncutCorner], cut: &EdgeBreak) -> Option<Finding> {
    let first = uncut.first()?;
    let smaller = match cut {
        EdgeBreak::Chamfer(_) => "a smaller tip_clearance",
        EdgeBreak::Ball(_) => "a smaller ball",
    };
    let message = format!("a web stays before the chamfer ends: {}", Webs::of(uncut).in_words());
    Some(
        Finding::warning(Code::CORNERS_STAY, message)
            .point([first.at.x, first.at.y, 0.0])
            .help(format!("{smaller} makes it shorter; file the corners, or round them in the drawing")),
    )
}
