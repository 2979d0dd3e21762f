//! Chamfers, checked.

use std::sync::Arc;

use super::ChamferTable;
use super::plan::PlannedChamfer;
use crate::base::{Code, Finding, Result};
use crate::contouring::EdgeBreak;
use crate::cutting::StartCut;
use crate::operations::edge::{self, EdgeOperation, edge_keys, v_cutter};
use crate::operations::kind::{self, Attempt};
use crate::operations::named::NamedOutline;
use crate::operations::outlines::OutlineEntry;
use crate::operations::{Around, CalledTool, CuttingKeys, FeedKeys, Milling, PlaneTable, Setting};
use crate::tool::{Cutter, Tool};

/// Noun of the operation.
const NOUN: &str = "chamfer";

/// Chamfering along an outline, or along edges of a face.
#[derive(Clone, Debug)]
pub struct ChamferOperation {
    /// As written.
    pub table: ChamferTable,
    /// The edge that is broken.
    pub edge: EdgeOperation,
}

impl kind::Checked for ChamferOperation {
    type Plan = PlannedChamfer;

    const NOUN: &'static str = NOUN;

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

    fn plan(self: &Arc<Self>, setting: &Setting<'_>) -> Result<Attempt<PlannedChamfer>> {
        edge::planned(&self.edge, setting, |edge| PlannedChamfer { of: Arc::clone(self), edge })
    }
}

impl kind::Table for ChamferTable {
    type Of = ChamferOperation;

    fn check(&self, around: &Around<'_>) -> Result<ChamferOperation> {
        let keys = edge_keys!(self, NOUN);
        let edge = edge::operation(&keys, around, |tool| cut(self, tool))?;
        Ok(ChamferOperation { table: self.clone(), edge })
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

/// The chamfer of a tool, which has to be a V cutter.
fn cut(t: &ChamferTable, tool: &Tool) -> Result<EdgeBreak> {
    let Cutter::Tapered { tip_diameter, half_angle } = tool.cutter else {
        let finding = Finding::error(Code::JOB_REFERENCE, format!("{} has no conical edge", tool.number));
        return Err(finding
            .help("use a tapered tool: type = \"tapered\" with half_angle")
            .key("tool")
            .into());
    };
    let chamfer = v_cutter(tool, (tip_diameter, half_angle), t.width, t.tip_clearance, t.wall_height)?;
    Ok(EdgeBreak::Chamfer(chamfer))
}
