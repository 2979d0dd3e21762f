//! Deburring, checked.

use std::sync::Arc;

use super::DeburrTable;
use super::plan::PlannedDeburr;
use crate::base::{Code, Finding, Result};
use crate::contouring::EdgeBreak;
use crate::cutting::StartCut;
use crate::operations::edge::{self, EdgeOperation, ball, edge_keys, v_cutter};
use crate::operations::kind::{self, Attempt};
use crate::operations::named::NamedOutline;
use crate::operations::outlines::OutlineEntry;
use crate::operations::{Around, CalledTool, CuttingKeys, FeedKeys, Milling, PlaneTable, Setting};
use crate::tool::{Cutter, Tool};

/// Noun of the operation.
const NOUN: &str = "deburr";
/// Width where the job does not say it [mm].
const USUAL_WIDTH: f64 = 0.2;

/// Deburring along edges of a face, or along an outline.
#[derive(Clone, Debug)]
pub struct DeburrOperation {
    /// As written.
    pub table: DeburrTable,
    /// The edge that is broken.
    pub edge: EdgeOperation,
}

impl kind::Checked for DeburrOperation {
    type Plan = PlannedDeburr;

    const NOUN: &'static str = "deburring";

    fn milling(&self) -> &Milling {
        &self.edge.milling
    }

    fn milling_mut(&mut self) -> &mut Milling {
        &mut self.edge.milling
    }

    fn name(&self) -> String {
        self.edge.name()
    }

    fn is_left_hand(&self) -> bool {
        self.edge.is_left_hand()
    }

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedDeburr>> {
        edge::planned(&self.edge, setting, |edge| PlannedDeburr { of: Arc::clone(self), edge })
    }
}

impl kind::Table for DeburrTable {
    type Of = DeburrOperation;

    fn check(&self, around: &Around<'_>) -> Result<DeburrOperation> {
        let keys = edge_keys!(self, NOUN);
        let edge = edge::operation(&keys, around, |tool| cut(self, tool))?;
        Ok(DeburrOperation { table: self.clone(), edge })
    }

    fn called(&mut self) -> &mut CalledTool {
        &mut self.tool
    }

    fn data(&mut self) -> Option<CuttingKeys<'_>> {
        let feed = Some(FeedKeys { feed: &mut self.feed, per_tooth: &mut self.feed_per_tooth });
        Some(CuttingKeys {
            speed: &mut self.speed,
            cutting_speed: &mut self.cutting_speed,
            feed,
            per_rev: None,
            cut: StartCut::Edge,
        })
    }

    fn plane(&self) -> Option<&PlaneTable> {
        self.plane.as_ref()
    }

    fn named_outline(&self) -> Option<NamedOutline<'_>> {
        edge::named_outline(&edge_keys!(self, NOUN))
    }

    fn file(&self) -> Option<(&'static str, &str)> {
        match &self.outline {
            Some(OutlineEntry::Name(name)) => Some(("outline", name)),
            _ => None,
        }
    }
}

/// The break that a tool makes: a V cutter or a ball.
fn cut(t: &DeburrTable, tool: &Tool) -> Result<EdgeBreak> {
    let width = t.width.unwrap_or(USUAL_WIDTH);
    match tool.cutter {
        Cutter::Tapered { tip_diameter, half_angle } => {
            let shape = (tip_diameter, half_angle);
            Ok(EdgeBreak::Chamfer(v_cutter(tool, shape, width, t.tip_clearance, t.wall_height)?))
        }
        Cutter::BallNose { diameter } => {
            if t.tip_clearance.is_some() {
                let finding = Finding::error(Code::JOB_SHAPE, "a ball has no `tip_clearance`");
                let help = "leave it out: the width says where the ball runs";
                return Err(finding.help(help).key("tip_clearance").into());
            }
            Ok(EdgeBreak::Ball(ball(diameter, width, t.wall_height)?))
        }
        _ => {
            let what = format!("{} has no conical edge and no ball", tool.number);
            let help = "use a tapered tool (type = \"tapered\" with half_angle) or a ball-nose end mill";
            Err(Finding::error(Code::JOB_REFERENCE, what).help(help).key("tool").into())
        }
    }
}
