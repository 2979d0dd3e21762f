//! Tool paths with directions of the tool, checked.

use std::sync::Arc;

use glam::DVec3;

use super::PathTable;
use super::path_point::PathPoint;
use super::plan::{PlannedPath, planned};
use super::points::points;
use crate::base::bounded::{MAX_LENGTH, length, positive};
use crate::base::{Code, Finding, Loader, Result};
use crate::machine::Machine;
use crate::nc::Control;
use crate::operations::kind::{self, Attempt};
use crate::operations::{Around, CalledTool, Milling, OrientationName, Setting, milling};
use crate::tool::Tool;

/// A tool path that comes from elsewhere.
#[derive(Clone, Debug)]
pub struct PathOperation {
    /// As written.
    pub table: PathTable,
    /// Tool, speed, coolant, tolerance.
    pub milling: Milling,
    /// The points [mm, work offset].
    pub points: Vec<PathPoint>,
    /// Feed [mm/s].
    pub feed: f64,
    /// Distance along the tool before the first point and behind the last [mm].
    pub clearance: f64,
}

impl PathOperation {
    /// Whether the tool leaves the Z of the work offset.
    pub fn is_multi_axis(&self) -> bool {
        self.points.iter().filter_map(|p| p.axis).any(|axis| axis != DVec3::Z)
    }
}

impl kind::Checked for PathOperation {
    type Plan = PlannedPath;

    fn milling(&self) -> &Milling {
        &self.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.milling
    }

    fn name(&self) -> String {
        format!("path of {} points", self.points.len())
    }

    fn not_compared(&self) -> Option<&'static str> {
        Some("the surface that a path leaves")
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedPath>> {
        planned(self, setting)
    }
}

impl kind::Table for PathTable {
    type Of = PathOperation;

    fn check(&self, around: &Around<'_>) -> Result<PathOperation> {
        operation(self, around.tools, (around.machine, (around.orientation, around.control)), around.loader)
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn file(&self) -> Option<(&'static str, &str)> {
        self.file.as_ref().map(|name| ("path", name.as_str()))
    }
}

fn operation(
    t: &PathTable,
    tools: &[Tool],
    (machine, post): (Option<&Machine>, (OrientationName, Control)),
    loader: &dyn Loader,
) -> Result<PathOperation> {
    let operation = PathOperation {
        milling: milling(&t.tool, t.speed, t.coolant, None, tools)?,
        feed: positive("feed", t.feed, 1e6, "mm/min")? / 60.0,
        clearance: length("clearance", t.clearance.unwrap_or(10.0), 0.0, MAX_LENGTH)?,
        points: points(t, loader)?,
        table: t.clone(),
    };
    if operation.is_multi_axis() && machine.is_none_or(|m| !m.is_multi_axis()) {
        return Err(Finding::error(
            Code::JOB_REFERENCE,
            "the path turns the tool, and the job has no machine with rotary axes",
        )
        .help("give the job such a machine")
        .into());
    }
    if operation.is_multi_axis() && post == (OrientationName::Axes, Control::Heidenhain) {
        return Err(Finding::error(
            Code::POST_CONTROL,
            "HEIDENHAIN has no inverse time, so the feed of the tip cannot be said with axis positions",
        )
        .help("write post.orientation = \"angles\" or \"vectors\"")
        .into());
    }
    Ok(operation)
}
