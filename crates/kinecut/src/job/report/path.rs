//! The path of a program as lines by their roles.

use serde::{Deserialize, Serialize};

use crate::page::{Colour, Dash, Ink, Plan, PlanLine, Width};

/// Purpose of a piece of path; decides colour, dash and word.
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

    /// Line in drawings.
    pub(crate) fn ink(self) -> Ink {
        let line = |n: u8, width: Width, dash: Dash| Ink::Line(Colour::Path(n), width, dash);
        match self {
            PathRole::Rapid => line(0, Width::Thin, Dash::Dashes),
            PathRole::Link => line(1, Width::Thin, Dash::Dots),
            PathRole::Lead => line(2, Width::Thin, Dash::Chain),
            PathRole::Feed => line(3, Width::Thin, Dash::Full),
            PathRole::Rough => line(4, Width::Thin, Dash::Full),
            PathRole::Finish => line(5, Width::Bold, Dash::Full),
        }
    }

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

/// A stretch of a piece of path with the engagement of its tool.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EngagedRun {
    /// Fraction of the piece at its end.
    pub to: f32,
    /// Arc of contact [deg]; 0 in air.
    pub arc: f32,
    /// Greatest thickness of a chip [mm], where it is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chip: Option<f32>,
}

/// A stretch of tool tip path that one program line makes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathPiece {
    /// Line of the program text, from 0.
    pub block: u32,
    /// Its purpose.
    pub role: PathRole,
    /// Index in [`Report::tools`](super::Report::tools).
    pub tool: u32,
    /// Direction from the tool tip to the spindle in part coordinates, unit.
    pub axis: [f32; 3],
    /// The polyline, part coordinates [mm].
    pub points: Vec<[f32; 3]>,
    /// Part of the way of all moves that may take material that is done at its end, from 0 to 1.
    #[serde(default)]
    pub done: f32,
    /// Positions of the joints of the machine at each point [mm or rad], those of a point one after the other; empty where they are not
    /// known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<f32>,
    /// Engagement of the tool on it, from its beginning to its end; empty where it was not measured, or is air.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub engaged: Vec<EngagedRun>,
}

impl PathPiece {
    /// A piece cut by the first tool with its axis along Z.
    pub fn new(block: u32, role: PathRole, points: Vec<[f32; 3]>) -> PathPiece {
        PathPiece {
            block,
            role,
            tool: 0,
            axis: [0.0, 0.0, 1.0],
            points,
            done: 0.0,
            joints: Vec::new(),
            engaged: Vec::new(),
        }
    }
}

/// The whole path from above; neighbours of one role are one line, without links.
pub(crate) fn seen_from_above(path: &[PathPiece]) -> Plan {
    let mut lines: Vec<(PathRole, PlanLine)> = Vec::new();
    for piece in path {
        let points = piece.points.iter().map(|p| [f64::from(p[0]), f64::from(p[1])]);
        match lines.last_mut().filter(|(role, _)| *role == piece.role) {
            Some((_, line)) => line.points.extend(points),
            None => {
                lines.push((piece.role, PlanLine::new(piece.role.ink(), piece.role.word(), points.collect())))
            }
        }
    }
    // The role that matters most lies on top.
    lines.sort_by_key(|(role, _)| PathRole::ALL.iter().position(|r| r == role));
    Plan { lines: lines.into_iter().map(|l| l.1).collect(), ..Plan::new("Path from above") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::plan::figure;

    #[test]
    fn layers_that_look_alike_are_drawn_once() {
        let mut path = Vec::new();
        for layer in 0..500u32 {
            let z = -(layer as f32);
            path.push(PathPiece::new(3 * layer, PathRole::Link, vec![[0.0, 0.0, z + 1.0], [0.0, 0.0, z]]));
            path.push(PathPiece::new(3 * layer + 1, PathRole::Rough, vec![[0.0, 0.0, z], [50.0, 0.0, z]]));
            path.push(PathPiece::new(3 * layer + 2, PathRole::Rough, vec![[50.0, 0.0, z], [50.0, 30.0, z]]));
        }
        let plan = seen_from_above(&path);
        assert_eq!(plan.lines.len(), 1000);
        let page = figure(&plan).into_string();
        let look = format!("{} curve\" d=\"", PathRole::Rough.ink().class());
        let d = page.split(&look).nth(1).unwrap().split('"').next().unwrap();
        assert_eq!((d.matches('M').count(), d.matches('L').count()), (1, 2));
    }

    #[test]
    fn a_strange_path_is_drawn_as_nothing() {
        let strange =
            PathPiece::new(0, PathRole::Rapid, vec![[f32::NAN, 0.0, 0.0], [f32::INFINITY, 1.0, 0.0]]);
        assert!(figure(&seen_from_above(&[strange])).into_string().contains("nothing to draw"));
        let point = PathPiece::new(0, PathRole::Rapid, vec![[5.0, 5.0, 0.0]]);
        assert!(!figure(&seen_from_above(&[point])).into_string().contains("NaN"));
    }
}
