//! A planned chamfer: its moves, its wall, its part of report and plan.

use std::sync::Arc;

use super::ChamferOperation;
use crate::base::Result;
use crate::operations::edge::{EdgeJson, PlannedEdge, section};
use crate::operations::kind;
use crate::operations::wanted::WantedWall;
use crate::operations::{Found, Judged, Pen, PostedPlan, Shown};
use crate::page::Section;

/// A planned chamfer.
#[derive(Clone, Debug)]
pub struct PlannedChamfer {
    /// The operation.
    pub of: Arc<ChamferOperation>,
    /// The break of the edge.
    pub edge: PlannedEdge,
}

impl kind::Plan for PlannedChamfer {
    type Json = EdgeJson;

    const LIST: &'static str = "chamfers";

    fn write(&mut self, pen: &mut Pen<'_>) -> Result<()> {
        self.edge.write(pen);
        Ok(())
    }

    fn walls(&self) -> Vec<WantedWall> {
        self.edge.walls()
    }

    fn judge(&mut self, name: &str, _posted: &PostedPlan<'_>, _found: &Found<'_>) -> Judged {
        self.edge.judged(name)
    }

    fn sections(all: &[(&PlannedChamfer, &Shown<'_>)]) -> Vec<Section> {
        all.iter().map(|(plan, shown)| section(&plan.edge, shown)).collect()
    }

    fn json(&self, shown: &Shown<'_>) -> Option<EdgeJson> {
        Some(EdgeJson::new(&self.edge, shown.number))
    }
}
